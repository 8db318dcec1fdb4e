//! How far a neighbourhood of each texel is from flat. Kernel `flatness`, twin [`reference::flatness`](crate::reference::flatness).

use super::height_field::{HeightField, Scene};
use crate::{
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    model::Relief,
    wgsl,
};

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct Flatness {
    kernel: Kernel,
}

impl Flatness {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let mut resources = HeightField::resources().to_vec();
        resources.push(Resource::read_write::<f32>("roughness"));
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::FLATNESS, wgsl::ALL, &resources)? })
    }

    /// Mean squared slope and curvature (by a texel width) over the 5 × 5 texels around each of `field`, `[row][column]`; 0 is flat.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(&self, recorder: &mut Recorder<'_>, field: &HeightField) -> Result<Buffer<f32>, GpuError> {
        let gpu = recorder.gpu();
        let texels = field.heights.len();
        let scene: Buffer<Scene> = gpu.uniform("scene", &field.scene(Relief::default()))?;
        let roughness = gpu.fresh("roughness", texels)?;
        let mut binds = field.binds(&scene).to_vec();
        binds.push(bind("roughness", &roughness));
        recorder.dispatch(&self.kernel, &binds, Grid::threads(texels))?;
        Ok(roughness)
    }
}
