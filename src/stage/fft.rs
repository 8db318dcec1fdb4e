//! Two-dimensional complex Fourier transform of any size. Kernel `fft`, twin [`reference::fft`](crate::reference::fft).
//!
//! Stockham's autosorting form (Van Loan 1992, ch. 1.7): rows, then columns, one pass for each factor of the length, no
//! reordering. Factors are primes, pairs of twos taken as four. A factor r costs r multiply-adds a value, so 400 costs
//! 4 + 4 + 5 + 5 along an axis and a prime length p costs p: right for the sizes of measured materials; a plane of large
//! prime size (beyond a few thousand) is better cropped by a texel.

use std::f64::consts::TAU;

use super::scalar::{count, single};
use crate::{
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::Fourier,
    wgsl,
};

gpu_struct! {
    struct Params {
        first: u32,
        end: u32,
        length: u32,
        stride: u32,
        done: u32,
        radix: u32,
        rest: u32,
        sign: f32,
        scale: f32,
    }
}

/// Multiply-adds of one dispatch at most: milliseconds on a GPU, a fraction of a second on a software driver.
const MAX_TERMS: u32 = 1 << 25;

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct Fft {
    kernel: Kernel,
}

/// One axis of a field.
struct Axis {
    length: u32,
    /// Distance of neighbours along the axis.
    stride: u32,
    /// exp(−2πi k/length).
    twiddles: Buffer<[f32; 2]>,
}

impl Fft {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<[f32; 2]>("twiddles"),
            Resource::read::<[f32; 2]>("source"),
            Resource::read_write::<[f32; 2]>("result"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::FFT, wgsl::ALL, &resources)? })
    }

    /// Prime factors of `length` in rising order after its fours, which stand for pairs of twos: the radices of its passes. 1 has the factor
    /// 1: a copy.
    #[must_use]
    pub fn factors(length: u32) -> Vec<u32> {
        if length == 1 {
            return vec![1];
        }
        let mut factors = Vec::new();
        let mut rest = length;
        for radix in std::iter::once(4).chain(2..=length) {
            while rest.is_multiple_of(radix) {
                factors.push(radix);
                rest /= radix;
            }
        }
        factors
    }

    /// The transform of `field` `[row][column]`, (real, imaginary) of [columns, rows] `size`; frequencies in natural order,
    /// zero first.
    ///
    /// # Errors
    /// [`GpuError`] if two fields of that size do not fit the adapter.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, field: &Buffer<[f32; 2]>, size: [u32; 2], fourier: Fourier,
    ) -> Result<Buffer<[f32; 2]>, GpuError> {
        let gpu = recorder.gpu();
        let [width, height] = size;
        let count = width as usize * height as usize;
        let axes = [Axis::new(gpu, width, 1)?, Axis::new(gpu, height, width)?];
        // Each pass reads what the one before it wrote, in turn from one buffer into the other.
        let mut result = gpu.fresh("Fourier transform", count)?;
        let mut spare = gpu.fresh("Fourier transform, every other pass", count)?;
        let passes: Vec<_> = axes.iter().flat_map(Axis::passes).collect();
        for (index, (axis, params)) in passes.iter().enumerate() {
            let last = index + 1 == passes.len();
            let mut params = *params;
            params.sign = if fourier == Fourier::Forward { 1.0 } else { -1.0 };
            params.scale = if last && fourier == Fourier::Inverse { scale(size) } else { 1.0 };
            let source = if index == 0 { field } else { &spare };
            self.dispatch(recorder, axis, params, source, &result, count)?;
            if !last {
                std::mem::swap(&mut result, &mut spare);
            }
        }
        Ok(result)
    }

    /// One pass, in as many dispatches as keep each short.
    fn dispatch(
        &self, recorder: &mut Recorder<'_>, axis: &Axis, pass: Params, source: &Buffer<[f32; 2]>, result: &Buffer<[f32; 2]>, length: usize,
    ) -> Result<(), GpuError> {
        let values = (MAX_TERMS / pass.radix).max(1) as usize;
        for first in (0..length).step_by(values) {
            let end = length.min(first + values);
            let params = Params { first: count(first), end: count(end), ..pass };
            let params = recorder.gpu().uniform("Fourier transform params", &params)?;
            let binds = [bind("params", &params), bind("twiddles", &axis.twiddles), bind("source", source), bind("result", result)];
            recorder.dispatch(&self.kernel, &binds, Grid::threads(end - first))?;
        }
        Ok(())
    }
}

impl Axis {
    fn new(gpu: &Gpu, length: u32, stride: u32) -> Result<Self, GpuError> {
        let twiddle = |k: u32| {
            let (sin, cos) = (TAU * f64::from(k) / f64::from(length)).sin_cos();
            [single(cos), single(-sin)]
        };
        let twiddles: Vec<_> = (0..length).map(twiddle).collect();
        Ok(Self { length, stride, twiddles: gpu.upload("Fourier transform twiddles", &twiddles)? })
    }

    /// The passes along this axis, each with the parameters that belong to it.
    fn passes(&self) -> impl Iterator<Item = (&Self, Params)> {
        let &Self { length, stride, .. } = self;
        let mut done = 1;
        Fft::factors(length).into_iter().map(move |radix| {
            let params = Params { length, stride, done, radix, rest: length / done / radix, ..Params::default() };
            done *= radix;
            (self, params)
        })
    }
}

/// What makes the inverse the inverse: one over the number of values.
fn scale([width, height]: [u32; 2]) -> f32 {
    single(1.0 / (f64::from(width) * f64::from(height)))
}
