//! The material as a plane. Shader `plane`, twin [`reference::plane`](crate::reference::plane).
//!
//! The camera is orthographic and looks along −view at the plane's centre. With y the material's up, right is y × view and up is
//! view × right: seen from the zenith, the top row is at the top. Rays are followed from where they cross the base plane z = 0,
//! so the picture's outline is the base plane's, and what a ray meets beyond the edge continues under the boundary rule.

use glam::{DMat2, DVec2, DVec3};

use crate::{
    data::PlaneView,
    gpu::{Buffer, Gpu, GpuError, Raster, Recorder, Resource, Target, bind},
    gpu_struct,
    model::Relief,
    stage::Surface,
    wgsl,
};

gpu_struct! {
    struct Camera {
        size: [f32; 2],
        origin: [f32; 2],
        per_column: [f32; 2],
        per_row: [f32; 2],
        samples: u32,
        _pad0: u32,
        _pad1: u32,
        _pad2: u32,
    }
}

/// Views with a smaller cosine see the plane edge-on: there is nothing to draw (0.06° above the horizon).
const MIN_COSINE: f64 = 0.001;

/// The render pass on one device.
#[derive(Debug)]
pub struct Plane {
    raster: Raster,
}

impl Plane {
    /// Builds the pass.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let mut resources = Surface::resources();
        resources.push(Resource::uniform::<Camera>("camera"));
        Ok(Self { raster: Raster::new(gpu, &wgsl::PLANE, wgsl::ALL, &resources)? })
    }

    /// Draws `surface`: RGB in reflectance units (π·L_o/E) times coverage, coverage in alpha, transparent outside the plane. A
    /// plane seen from behind or edge-on leaves the picture transparent.
    ///
    /// # Errors
    /// [`GpuError`] if the picture does not fit the adapter.
    pub fn draw(&self, recorder: &mut Recorder<'_>, surface: &Surface, shot: &PlaneView, relief: Relief) -> Result<Target, GpuError> {
        let gpu = recorder.gpu();
        let target = Target::new(gpu, shot.size[0], shot.size[1])?;
        let scene = surface.scene(gpu, shot.view, shot.light, relief)?;
        let camera: Buffer<Camera> = gpu.uniform("camera", &camera(surface.field.size, shot))?;
        let mut binds = surface.binds(&scene);
        binds.push(bind("camera", &camera));
        let vertices = if shot.view.vector().z < MIN_COSINE { 0 } else { 6 };
        recorder.draw(&self.raster, &binds, vertices, 1, &target);
        Ok(target)
    }
}

/// Places of the picture's pixels on the base plane.
fn camera(size: [u32; 2], shot: &PlaneView) -> Camera {
    let view = shot.view.vector();
    let right = DVec3::Y.cross(view).normalize_or(DVec3::X);
    let up = view.cross(right);
    let texels = DVec2::new(size[0].into(), size[1].into());
    let pixels = DVec2::new(shot.size[0].into(), shot.size[1].into());
    // Of a step of one texel to the right and one downwards, as seen: columns of this matrix, y of the picture downwards.
    let seen = DMat2::from_cols(DVec2::new(right.x, -up.x), DVec2::new(-right.y, up.y));
    let extent = seen.x_axis.abs() * texels.x + seen.y_axis.abs() * texels.y;
    let scale = (pixels / extent).min_element() * (1.0 - shot.margin);
    let place_from_pixel = (seen * scale).inverse();
    let origin = 0.5 * (texels - 1.0) - place_from_pixel * (0.5 * pixels);
    Camera {
        size: pixels.as_vec2().to_array(),
        origin: origin.as_vec2().to_array(),
        per_column: place_from_pixel.x_axis.as_vec2().to_array(),
        per_row: place_from_pixel.y_axis.as_vec2().to_array(),
        samples: shot.samples.max(1),
        ..Default::default()
    }
}
