//! Height from normals by Frankot and Chellappa 1988. Kernels `slopes`, `slope_sum` and `mirror_slopes` prepare the slopes,
//! [`Fft`] transforms them, `frankot_chellappa` integrates in frequency, `crop_real` takes the height out. Twin
//! [`reference::frankot_chellappa`](crate::reference::frankot_chellappa).
//!
//! The method wants a periodic surface. Under [`Boundary::Mirror`] it gets one of twice the width and height: the sample and
//! its mirror images. Either way the mean height is zero, since Z(0,0) = 0 and all mirror images have the same mean.

use super::{Fft, scalar::single};
use crate::{
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::{Boundary, FitSettings, Fourier},
    wgsl,
};

gpu_struct! {
    struct SlopesParams { texels: u32, max_slope: f32 }
}
gpu_struct! {
    struct SlopeSumParams { columns: u32 }
}
gpu_struct! {
    struct SizeParams { width: u32, height: u32 }
}
gpu_struct! {
    struct CropParams { width: u32, height: u32, field_width: u32 }
}

/// The stage's kernels on one device.
#[derive(Debug)]
pub struct FrankotChellappa {
    slopes: Kernel,
    slope_sum: Kernel,
    mirror_slopes: Kernel,
    fft: Fft,
    integrate: Kernel,
    crop_real: Kernel,
}

impl FrankotChellappa {
    /// Builds the kernels.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses one.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let kernel = |source, resources: &[Resource]| Kernel::new(gpu, source, wgsl::ALL, resources);
        let slopes = [
            Resource::uniform::<SlopesParams>("params"),
            Resource::read::<[f32; 4]>("normals"),
            Resource::read_write::<[f32; 2]>("slopes"),
        ];
        let slope_sum =
            [Resource::uniform::<SlopeSumParams>("params"), Resource::read::<[f32; 2]>("slopes"), Resource::read_write::<[f32; 2]>("sums")];
        let mirror_slopes = [
            Resource::uniform::<SizeParams>("params"),
            Resource::read::<[f32; 2]>("slopes"),
            Resource::read::<[f32; 2]>("total"),
            Resource::read_write::<[f32; 2]>("mirrored"),
        ];
        let integrate = [
            Resource::uniform::<SizeParams>("params"),
            Resource::read::<[f32; 2]>("slope_spectrum"),
            Resource::read_write::<[f32; 2]>("height_spectrum"),
        ];
        let crop_real =
            [Resource::uniform::<CropParams>("params"), Resource::read::<[f32; 2]>("field"), Resource::read_write::<f32>("corner")];
        Ok(Self {
            slopes: kernel(&wgsl::SLOPES, &slopes)?,
            slope_sum: kernel(&wgsl::SLOPE_SUM, &slope_sum)?,
            mirror_slopes: kernel(&wgsl::MIRROR_SLOPES, &mirror_slopes)?,
            fft: Fft::new(gpu)?,
            integrate: kernel(&wgsl::FRANKOT_CHELLAPPA, &integrate)?,
            crop_real: kernel(&wgsl::CROP_REAL, &crop_real)?,
        })
    }

    /// The height field `[row][column]`, in texel widths, mean zero, whose slopes are nearest to those of `normals`
    /// `[row][column]` (x right, y up, z out; the fourth component is not read). Reads `boundary`, `max_slope` and `detilt`.
    ///
    /// # Errors
    /// [`GpuError`] if the complex fields (8 bytes a texel, four times as many texels when mirrored) do not fit the adapter.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, normals: &Buffer<[f32; 4]>, size: [u32; 2], settings: &FitSettings,
    ) -> Result<Buffer<f32>, GpuError> {
        let [width, height] = size;
        let slopes = self.record_slopes(recorder, normals, width * height, settings.max_slope)?;
        let (slopes, field_size) = match settings.boundary {
            Boundary::Periodic => (slopes, size),
            Boundary::Mirror => (self.record_mirror(recorder, &slopes, size, settings.detilt)?, [2 * width, 2 * height]),
        };
        let spectrum = self.fft.record(recorder, &slopes, field_size, Fourier::Forward)?;
        let spectrum = self.record_integrate(recorder, &spectrum, field_size)?;
        let field = self.fft.record(recorder, &spectrum, field_size, Fourier::Inverse)?;
        let gpu = recorder.gpu();
        let params = gpu.uniform("crop params", &CropParams { width, height, field_width: field_size[0] })?;
        let heights = gpu.fresh("heights", texels(size))?;
        let binds = [bind("params", &params), bind("field", &field), bind("corner", &heights)];
        recorder.dispatch(&self.crop_real, &binds, Grid::threads(texels(size)))?;
        Ok(heights)
    }

    fn record_slopes(
        &self, recorder: &mut Recorder<'_>, normals: &Buffer<[f32; 4]>, texels: u32, max_slope: f64,
    ) -> Result<Buffer<[f32; 2]>, GpuError> {
        let gpu = recorder.gpu();
        let params = gpu.uniform("slopes params", &SlopesParams { texels, max_slope: single(max_slope) })?;
        let slopes = gpu.fresh("slopes", texels as usize)?;
        let binds = [bind("params", &params), bind("normals", normals), bind("slopes", &slopes)];
        recorder.dispatch(&self.slopes, &binds, Grid::threads(texels as usize))?;
        Ok(slopes)
    }

    fn record_mirror(
        &self, recorder: &mut Recorder<'_>, slopes: &Buffer<[f32; 2]>, size: [u32; 2], detilt: bool,
    ) -> Result<Buffer<[f32; 2]>, GpuError> {
        let [width, height] = size;
        let gpu = recorder.gpu();
        let total = if detilt {
            let row_sums = self.record_sum(recorder, slopes, size)?;
            self.record_sum(recorder, &row_sums, [height, 1])?
        } else {
            gpu.zeros("no mean slope", 1)?
        };
        let params = gpu.uniform("mirror params", &SizeParams { width, height })?;
        let mirrored = gpu.fresh("mirrored slopes", 4 * texels(size))?;
        let binds = [bind("params", &params), bind("slopes", slopes), bind("total", &total), bind("mirrored", &mirrored)];
        recorder.dispatch(&self.mirror_slopes, &binds, Grid::threads(4 * texels(size)))?;
        Ok(mirrored)
    }

    /// The sum of each row.
    fn record_sum(
        &self, recorder: &mut Recorder<'_>, slopes: &Buffer<[f32; 2]>, [columns, rows]: [u32; 2],
    ) -> Result<Buffer<[f32; 2]>, GpuError> {
        let gpu = recorder.gpu();
        let params = gpu.uniform("slope sum params", &SlopeSumParams { columns })?;
        let sums = gpu.fresh("slope sums", rows as usize)?;
        let binds = [bind("params", &params), bind("slopes", slopes), bind("sums", &sums)];
        // One workgroup a layer.
        recorder.dispatch(&self.slope_sum, &binds, Grid::layers(1, rows))?;
        Ok(sums)
    }

    fn record_integrate(
        &self, recorder: &mut Recorder<'_>, slope_spectrum: &Buffer<[f32; 2]>, size: [u32; 2],
    ) -> Result<Buffer<[f32; 2]>, GpuError> {
        let [width, height] = size;
        let gpu = recorder.gpu();
        let params = gpu.uniform("Frankot-Chellappa params", &SizeParams { width, height })?;
        let height_spectrum = gpu.fresh("height spectrum", texels(size))?;
        let binds = [bind("params", &params), bind("slope_spectrum", slope_spectrum), bind("height_spectrum", &height_spectrum)];
        recorder.dispatch(&self.integrate, &binds, Grid::threads(texels(size)))?;
        Ok(height_spectrum)
    }
}

fn texels([width, height]: [u32; 2]) -> usize {
    width as usize * height as usize
}
