//! The picture that the source's camera would have recorded. Kernel `reconstruct`, twin
//! [`reference::reconstruct`](crate::reference::reconstruct).
//!
//! The picture is rectified to the base plane z = 0 (the mean height): pixel (column, row) is what an orthographic camera sees
//! along the ray that crosses the plane at that texel's centre. Relief moves and hides texels along that ray and shadows them;
//! [`Relief`] switches each off. A view or light at the horizon or below it gives a black picture.

use crate::{
    data::Direction,
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    model::Relief,
    stage::Surface,
    wgsl,
};

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct Reconstruct {
    kernel: Kernel,
}

impl Reconstruct {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let mut resources = Surface::resources();
        resources.push(Resource::read_write::<[f32; 4]>("picture"));
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::RECONSTRUCT, wgsl::ALL, &resources)? })
    }

    /// The picture `[row][column]` of `surface` in reflectance units (π·L_o/E), fourth component 1.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, surface: &Surface, view: Direction, light: Direction, relief: Relief,
    ) -> Result<Buffer<[f32; 4]>, GpuError> {
        let gpu = recorder.gpu();
        let [width, height] = surface.field.size;
        let picture = gpu.fresh("reconstructed picture", width as usize * height as usize)?;
        self.record_into(recorder, surface, view, light, relief, &picture)?;
        Ok(picture)
    }

    /// As [`Self::record`], over a picture that was there before.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    ///
    /// # Panics
    /// If the picture has not one pixel a texel: the host's bug.
    pub fn record_into(
        &self, recorder: &mut Recorder<'_>, surface: &Surface, view: Direction, light: Direction, relief: Relief,
        picture: &Buffer<[f32; 4]>,
    ) -> Result<(), GpuError> {
        let texels = surface.field.size[0] as usize * surface.field.size[1] as usize;
        assert_eq!(picture.len(), texels, "pixels of the picture");
        let scene = surface.scene(recorder.gpu(), view, light, relief)?;
        let mut binds = surface.binds(&scene);
        binds.push(bind("picture", picture));
        recorder.dispatch(&self.kernel, &binds, Grid::threads(texels))
    }
}
