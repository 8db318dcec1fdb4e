//! An image as a pattern: the thickness drawn at each texel. Kernels `pattern_image` and `pattern_image_reduce`, twin
//! [`reference::pattern_image`](crate::reference::pattern_image).
//!
//! A texel averages the pixels within two texels' width, each pixel so taking part in about four texels. Of an image with more than
//! eight pixels a texel these would be too many for one dispatch; it is first reduced, by a factor of up to 8 a pass, until four to
//! eight are left.

use super::scalar::{count, single};
use crate::{
    data::Map,
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::Placement,
    wgsl,
};

gpu_struct! {
    struct Params {
        size: [u32; 2], image_size: [u32; 2], cell: [f32; 2], offset: [f32; 2], axes: [f32; 4], reach: [f32; 2], repeats: [u32; 2],
        closed: [u32; 2], first: u32, _pad: u32,
    }
}
gpu_struct! {
    struct ReduceParams { size: [u32; 2], reduced_size: [u32; 2], factor: [u32; 2] }
}

/// Most pixels a texel, along an axis, that are averaged without reducing the image first.
const MOST: f64 = 8.0;
/// So that no rounding decides what a whole number of pixels a texel is.
const MARGIN: f64 = 1e-6;
/// Most repetitions to either side of the nearest that are looked at: a long image, turned in a long cell, meets itself without end.
const MOST_REPEATS: f64 = 16.0;

/// The stage's kernels on one device.
#[derive(Debug)]
pub struct PatternImage {
    draw: Kernel,
    reduce: Kernel,
}

impl PatternImage {
    /// Builds the kernels.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses one.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let draw = [Resource::uniform::<Params>("params"), Resource::read::<f32>("image"), Resource::read_write::<f32>("drawn")];
        let reduce = [Resource::uniform::<ReduceParams>("params"), Resource::read::<f32>("image"), Resource::read_write::<f32>("reduced")];
        Ok(Self {
            draw: Kernel::new(gpu, &wgsl::PATTERN_IMAGE, wgsl::ALL, &draw)?,
            reduce: Kernel::new(gpu, &wgsl::PATTERN_IMAGE_REDUCE, wgsl::ALL, &reduce)?,
        })
    }

    /// Draws `image`, 0 (bare) to 1, at `placement` into `drawn` `[layer][row][column]` as layer number `layer`, on a plane of `size`
    /// columns and rows that repeats.
    ///
    /// The image keeps its shape; at size 1 it is as large as fits into its cell. Around it the plane is bare, and its border falls off
    /// within a texel or a pixel, whichever is wider; but where it reaches exactly from edge to edge of its cell, it goes on with its
    /// other end, so that no seam shows. Where it meets itself, the thicker paint shows. Of more than 33 repetitions that reach a texel
    /// along an edge of the cell, the farthest are left out.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] if the image does not fit the adapter, or another if the adapter is out of memory.
    ///
    /// # Panics
    /// If `drawn` has not that many layers: the caller's bug.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, image: &Map<f32>, placement: Placement, size: [u32; 2], drawn: &Buffer<f32>, layer: usize,
    ) -> Result<(), GpuError> {
        let texels = size[0] as usize * size[1] as usize;
        assert!(drawn.len() >= (layer + 1) * texels, "layers of \"{}\"", drawn.label());
        let gpu = recorder.gpu();
        // An empty image is one bare pixel.
        let mut image_size = [image.width(), image.height()].map(|pixels| count(pixels.max(1)));
        let cell = placement.cell(size);
        // Texels that the image covers along its axes.
        let pixel = (cell[0] / f64::from(image_size[0])).min(cell[1] / f64::from(image_size[1])) * placement.size;
        let extent = image_size.map(|pixels| f64::from(pixels) * pixel);
        let mut pixels = gpu.upload("pattern image", image.values())?;
        while let Some(factor) = factor(image_size, extent) {
            let reduced_size = [0, 1].map(|axis| image_size[axis].div_ceil(factor[axis]));
            let params = gpu.uniform("pattern_image_reduce params", &ReduceParams { size: image_size, reduced_size, factor })?;
            let count = reduced_size[0] as usize * reduced_size[1] as usize;
            let smaller = gpu.fresh("pattern image reduced", count)?;
            let binds = [bind("params", &params), bind("image", &pixels), bind("reduced", &smaller)];
            recorder.dispatch(&self.reduce, &binds, Grid::threads(count))?;
            (image_size, pixels) = (reduced_size, smaller);
        }
        let params = params(placement, size, image_size, extent, count(layer * texels));
        let params = gpu.uniform("pattern_image params", &params)?;
        recorder.dispatch(&self.draw, &[bind("params", &params), bind("image", &pixels), bind("drawn", drawn)], Grid::threads(texels))
    }
}

/// By how much the pixels of an image that covers `extent` texels are to become fewer next, if at all.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "2 to 8")]
fn factor(image_size: [u32; 2], extent: [f64; 2]) -> Option<[u32; 2]> {
    let factor = [0, 1].map(|axis| {
        let a_texel = f64::from(image_size[axis]) / extent[axis];
        if a_texel > MOST + MARGIN && image_size[axis] > 1 { (a_texel / (0.5 * MOST) + MARGIN).clamp(2.0, 8.0) as u32 } else { 1 }
    });
    (factor != [1, 1]).then_some(factor)
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to MOST_REPEATS")]
fn params(placement: Placement, size: [u32; 2], image_size: [u32; 2], extent: [f64; 2], first: u32) -> Params {
    let (cell, [cosine, sine]) = (placement.cell(size), placement.turn());
    let a_texel = [0, 1].map(|axis| f64::from(image_size[axis]) / extent[axis]);
    let reach = a_texel.map(|pixels| pixels.max(1.0));
    // The axis of the cell along which each axis of the image lies, if it lies along one.
    let along = if sine == 0.0 {
        Some([0, 1])
    } else if cosine == 0.0 {
        Some([1, 0])
    } else {
        None
    };
    let closed = [0, 1].map(|axis| along.is_some_and(|along| (extent[axis] - cell[along[axis]]).abs() < 1e-9 * extent[axis]));
    // Half of what the image and its tent cover, along the cell's axes.
    let half = [0, 1].map(|axis| 0.5 * extent[axis] + reach[axis] / a_texel[axis]);
    let reached = [cosine.abs() * half[0] + sine.abs() * half[1], sine.abs() * half[0] + cosine.abs() * half[1]];
    let repeats = [0, 1].map(|axis| {
        let goes_on = along.is_some_and(|along| closed[along[axis]]);
        if goes_on { 0 } else { (reached[axis] / cell[axis] - 0.5).ceil().clamp(0.0, MOST_REPEATS) as u32 }
    });
    let shorter = cell[0].min(cell[1]);
    Params {
        size,
        image_size,
        cell: cell.map(single),
        offset: [0, 1].map(|axis| single((placement.offset[axis] * shorter) % cell[axis])),
        // Rows of an image run downwards.
        axes: [cosine * a_texel[0], sine * a_texel[1], sine * a_texel[0], -cosine * a_texel[1]].map(single),
        reach: reach.map(single),
        repeats,
        closed: closed.map(u32::from),
        first,
        _pad: 0,
    }
}
