//! Normals of a height field, by central differences. Kernel `normals`, twin [`reference::normals`](crate::reference::normals).

use crate::{
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::Boundary,
    wgsl,
};

gpu_struct! {
    struct Params { width: u32, height: u32, boundary: u32, _pad: u32 }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct Normals {
    kernel: Kernel,
}

impl Normals {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources =
            [Resource::uniform::<Params>("params"), Resource::read::<f32>("heights"), Resource::read_write::<[f32; 4]>("normals")];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::NORMALS, wgsl::ALL, &resources)? })
    }

    /// Unit normals `[row][column]` (x right, y up, z out, fourth component 0) of `heights` `[row][column]` in texel
    /// widths.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, heights: &Buffer<f32>, size: [u32; 2], boundary: Boundary,
    ) -> Result<Buffer<[f32; 4]>, GpuError> {
        let [width, height] = size;
        let texels = width as usize * height as usize;
        let gpu = recorder.gpu();
        let params = gpu.uniform("normals params", &Params { width, height, boundary: boundary.code(), _pad: 0 })?;
        let normals = gpu.fresh("normals", texels)?;
        let binds = [bind("params", &params), bind("heights", heights), bind("normals", &normals)];
        recorder.dispatch(&self.kernel, &binds, Grid::threads(texels))?;
        Ok(normals)
    }
}
