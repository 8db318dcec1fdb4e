//! How the seen points of a tile are lit, and the radiance that reflectance is fitted to. Kernel `shading`, twin
//! [`reference::shading`](crate::reference::shading).

use half::f16;

use super::{
    Seen,
    height_field::{HeightField, Scene},
    scalar::count,
    tile::{SampleDirections, Tile},
};
use crate::{
    data::OCTET,
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::Relief,
    wgsl,
};

gpu_struct! {
    struct Params { texels: u32, octets: u32, samples: u32, _pad: u32 }
}

/// A tile's samples in the light that reaches them, `[octet][texel]`; both are 0 for samples that are masked or unlit.
#[derive(Debug)]
pub struct Shaded {
    /// cos θ_i against the normal seen times the share of the light that reaches the point, and the ambient share of cos θ_i on the base
    /// plane, 0 to 1.
    pub shading: Buffer<[f16; OCTET]>,
    /// Mean radiance of the channels, in reflectance units.
    pub means: Buffer<[f16; OCTET]>,
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct Shading {
    kernel: Kernel,
}

impl Shading {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let mut resources = HeightField::resources().to_vec();
        resources.extend([
            Resource::uniform::<Params>("params"),
            Resource::read::<SampleDirections>("directions"),
            Resource::read::<[f16; OCTET]>("radiance"),
            Resource::read::<[f32; 4]>("seen_normals"),
            Resource::read::<[f32; 4]>("points"),
            Resource::read_write::<[f16; OCTET]>("shading"),
            Resource::read_write::<[f16; OCTET]>("means"),
        ]);
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::SHADING, wgsl::ALL, &resources)? })
    }

    /// Shading and mean radiance of a tile whose samples have the given `directions` and see the points `seen` of `field`; `relief` says
    /// whether the field casts shadows, `ambient` which share of the base plane's light every point gets by way of others.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    #[expect(clippy::too_many_arguments, reason = "what light and surface are to a sample")]
    pub fn record(
        &self, recorder: &mut Recorder<'_>, radiance: &Tile, directions: &Buffer<SampleDirections>, field: &HeightField, seen: &Seen,
        relief: Relief, ambient: f64,
    ) -> Result<Shaded, GpuError> {
        let gpu = recorder.gpu();
        let (texels, octets) = (radiance.texels, radiance.octets());
        let scene: Buffer<Scene> = gpu.uniform("scene", &field.scene(relief).with_ambient(ambient))?;
        let params = Params { texels: count(texels), octets: count(octets), samples: count(radiance.samples), _pad: 0 };
        let params = gpu.uniform("shading params", &params)?;
        let shaded = Shaded { shading: gpu.fresh("shading", octets * texels)?, means: gpu.fresh("mean radiance", octets * texels)? };
        let mut binds = field.binds(&scene).to_vec();
        binds.extend([
            bind("params", &params),
            bind("directions", directions),
            bind("radiance", &radiance.values),
            bind("seen_normals", &seen.normals),
            bind("points", &seen.points),
            bind("shading", &shaded.shading),
            bind("means", &shaded.means),
        ]);
        recorder.dispatch(&self.kernel, &binds, Grid::threads(octets * texels))?;
        Ok(shaded)
    }
}
