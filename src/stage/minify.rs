//! Coarser levels of what paint looks like, for pictures in which a pixel covers several texels. Kernel `minify`, twin
//! [`reference::minify`](crate::reference::minify).
//!
//! Averaged is what may be: reflectance and F₀ by coverage, coverage itself, α², and normals, whose spread goes into α² (Toksvig 2005,
//! Mipmapping normal maps; Olano, Baker 2010, LEAN mapping): of normals n with the mean m, 2(1 - |m|)/|m| is twice the variance of the slopes
//! along an axis, which adds to α² as that of a Beckmann distribution does. Heights, lobes and the local PCA are no linear function of what
//! is seen; pictures average those by rays.

use super::{Surface, scalar::count};
use crate::{
    gpu::{Buffer, Gpu, GpuError, GpuValue, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, wgsl,
};

gpu_struct! {
    struct Params { fine: [u32; 2], coarse: [u32; 2], fine_begin: u32, coarse_begin: u32, _pad0: u32, _pad1: u32 }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct Minify {
    kernel: Kernel,
}

impl Minify {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read_write::<[f32; 4]>("painted"),
            Resource::read_write::<[f32; 2]>("coats"),
            Resource::read_write::<[f32; 4]>("normals"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::MINIFY, wgsl::ALL, &resources)? })
    }

    /// Makes all levels of a surface that has the finest alone, down to one texel; leaves it as it is where the adapter has no arrays that
    /// long.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    pub fn record(&self, recorder: &mut Recorder<'_>, surface: &mut Surface) -> Result<(), GpuError> {
        let gpu = recorder.gpu();
        let sizes = level_sizes(surface.field.size);
        let texels: Vec<_> = sizes.iter().map(|[width, height]| *width as usize * *height as usize).collect();
        let all: usize = texels.iter().sum();
        if (all * size_of::<[f32; 4]>()) as u64 > gpu.max_array_bytes() {
            return Ok(());
        }
        surface.painted = lengthened(recorder, &surface.painted, all)?;
        surface.coats = lengthened(recorder, &surface.coats, all)?;
        surface.field.normals = lengthened(recorder, &surface.field.normals, all)?;
        surface.levels = count(sizes.len());
        let mut begin = 0;
        for (level, fine) in sizes.windows(2).enumerate() {
            let coarse_begin = begin + texels[level];
            let params = Params {
                fine: fine[0],
                coarse: fine[1],
                fine_begin: count(begin),
                coarse_begin: count(coarse_begin),
                ..Default::default()
            };
            let params = gpu.uniform("minify params", &params)?;
            let binds = [
                bind("params", &params),
                bind("painted", &surface.painted),
                bind("coats", &surface.coats),
                bind("normals", &surface.field.normals),
            ];
            recorder.dispatch(&self.kernel, &binds, Grid::threads(texels[level + 1]))?;
            begin = coarse_begin;
        }
        Ok(())
    }
}

/// Columns and rows of each level, from the finest to one texel: halves, of an odd number the smaller one.
fn level_sizes(finest: [u32; 2]) -> Vec<[u32; 2]> {
    let coarser = |size: &[u32; 2]| (*size != [1, 1]).then(|| size.map(|side| (side / 2).max(1)));
    std::iter::successors(Some(finest), coarser).collect()
}

/// A buffer for `len` values that begins with those of `values`.
fn lengthened<T: GpuValue>(recorder: &mut Recorder<'_>, values: &Buffer<T>, len: usize) -> Result<Buffer<T>, GpuError> {
    let longer = recorder.gpu().fresh(values.label(), len)?;
    recorder.copy(values, &longer);
    Ok(longer)
}
