//! What the views see of a height field at the places of some texels. Kernel `seen_surface`, twin
//! [`reference::seen_surface`](crate::reference::seen_surface).
//!
//! A view's ray through a texel's place on the base plane meets the field beside it, by the height there times the tangent of the view's
//! angle: seen obliquely, one texel of a measurement shows many points of the surface, each with its own normal.

use super::{
    height_field::{HeightField, Scene},
    scalar::count,
};
use crate::{
    data::Direction,
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::Relief,
    wgsl,
};

gpu_struct! {
    struct Params { texels: u32, views: u32 }
}

/// The points that views see, `[view][texel]`.
#[derive(Debug)]
pub struct Seen {
    /// Unit normals, fourth component 0.
    pub normals: Buffer<[f32; 4]>,
    /// Column and row in texels, height in texel widths; fourth component 0.
    pub points: Buffer<[f32; 4]>,
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct SeenSurface {
    kernel: Kernel,
}

impl SeenSurface {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let mut resources = HeightField::resources().to_vec();
        resources.extend([
            Resource::uniform::<Params>("params"),
            Resource::read::<[f32; 4]>("views"),
            Resource::read::<[u32; 2]>("places"),
            Resource::read_write::<[f32; 4]>("seen_normals"),
            Resource::read_write::<[f32; 4]>("points"),
        ]);
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::SEEN_SURFACE, wgsl::ALL, &resources)? })
    }

    /// What `views` see through `places` (column, row) on the base plane of `field`; right above each place if `relief` does not displace.
    /// A view at the horizon sees what is right above the place, too.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, field: &HeightField, relief: Relief, views: &[Direction], places: &[[u32; 2]],
    ) -> Result<Seen, GpuError> {
        let gpu = recorder.gpu();
        let threads = views.len() * places.len();
        let scene: Buffer<Scene> = gpu.uniform("scene", &field.scene(relief))?;
        let params = gpu.uniform("seen_surface params", &Params { texels: count(places.len()), views: count(views.len()) })?;
        let views: Vec<_> = views.iter().map(|view| view.vector().as_vec3().extend(0.0).to_array()).collect();
        let (views, places) = (gpu.upload("views", &views)?, gpu.upload("places", places)?);
        let seen = Seen { normals: gpu.fresh("seen normals", threads)?, points: gpu.fresh("seen points", threads)? };
        let mut binds = field.binds(&scene).to_vec();
        binds.extend([
            bind("params", &params),
            bind("views", &views),
            bind("places", &places),
            bind("seen_normals", &seen.normals),
            bind("points", &seen.points),
        ]);
        recorder.dispatch(&self.kernel, &binds, Grid::threads(threads))?;
        Ok(seen)
    }
}
