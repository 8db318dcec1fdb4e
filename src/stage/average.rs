//! The mean of several pictures, one after the other. Kernel `average`, twin [`reference::average`](crate::reference::average).

use super::scalar::{count, single};
use crate::{
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, wgsl,
};

gpu_struct! {
    struct Params { width: u32, pixels: u32, stride: u32, first: u32, weight: f32, _pad0: u32, _pad1: u32, _pad2: u32 }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct Average {
    kernel: Kernel,
}

impl Average {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources =
            [Resource::uniform::<Params>("params"), Resource::read::<[f32; 4]>("picture"), Resource::read_write::<[f32; 4]>("mean")];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::AVERAGE, wgsl::ALL, &resources)? })
    }

    /// Adds `picture`, number `index` of `pictures`, to `mean` `[row][width]`; the first replaces what was there. The rows of `picture` are
    /// `stride` pixels long.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    ///
    /// # Panics
    /// If `picture` has fewer rows than `mean`: the caller's bug.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, picture: &Buffer<[f32; 4]>, mean: &Buffer<[f32; 4]>, [width, stride]: [usize; 2],
        [index, pictures]: [u32; 2],
    ) -> Result<(), GpuError> {
        let pixels = mean.len();
        assert!(picture.len() >= pixels / width * stride, "rows of \"{}\"", picture.label());
        let params = Params {
            width: count(width),
            pixels: count(pixels),
            stride: count(stride),
            first: (index == 0).into(),
            weight: single(1.0 / f64::from(pictures)),
            ..Default::default()
        };
        let params = recorder.gpu().uniform("average params", &params)?;
        recorder.dispatch(&self.kernel, &[bind("params", &params), bind("picture", picture), bind("mean", mean)], Grid::threads(pixels))
    }
}
