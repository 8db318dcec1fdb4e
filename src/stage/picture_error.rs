//! Errors of pictures against their originals, reduced where they are made. Kernels `picture_error` and `picture_error_sum`, twin
//! [`reference::picture_error`](crate::reference::picture_error).
//!
//! A picture of many texels comes down to six numbers, and many pictures to two numbers a texel, so that a comparison over all pairs of a
//! BTF brings hardly anything back. Sums are folded in a fixed order without atomics: a picture's are the same in whatever batch it comes,
//! a texel's as long as its pictures come in the same order.

use half::f16;

use super::scalar::count;
use crate::{
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, wgsl,
};

gpu_struct! {
    struct Params { texels: u32, groups: u32, pair: u32, _pad: u32 }
}
gpu_struct! {
    struct SumParams { groups: u32 }
}
gpu_struct! {
    /// Sums over the texels of a picture, all but `texels` over red, green and blue together. R is the picture, L its original, in
    /// reflectance units.
    pub struct PictureSums {
        /// Σ (R − L)².
        pub squared_error: f32,
        /// Σ (R − L).
        pub error: f32,
        /// Σ L².
        pub squared_original: f32,
        /// Σ L.
        pub original: f32,
        /// Σ (R − L)² of the sRGB values, held to 0 … 1.
        pub squared_shown_error: f32,
        /// Texels that take part: those whose original is a radiance.
        pub texels: f32,
    }
}

/// Threads of a workgroup, each with one texel.
const WORKGROUP: usize = 64;

/// Originals on the adapter, and room for the errors of their pictures.
#[derive(Debug)]
pub struct Originals {
    /// `[pair][channel][texel]` halves, two a word.
    halves: Buffer<u32>,
    /// `[pair][workgroup]`.
    partials: Buffer<PictureSums>,
    pairs: usize,
    texels: usize,
}

impl Originals {
    /// Bytes that a texel of an original takes on the adapter: its halves, the copy that the driver makes of them, and its part of the sums.
    pub const TEXEL_BYTES: usize = 2 * 3 * size_of::<f16>() + 1;

    /// Uploads `halves`, `[pair][channel][texel]`, linear RGB in reflectance units. What is NaN, infinite or negative is no radiance.
    ///
    /// # Errors
    /// [`GpuError`] if they do not fit the adapter.
    ///
    /// # Panics
    /// If they are not those of whole pictures of `texels` texels: the host's bug.
    pub fn upload(gpu: &Gpu, halves: &[f16], texels: usize) -> Result<Self, GpuError> {
        assert!(!halves.is_empty() && halves.len().is_multiple_of(3 * texels), "halves of whole pictures");
        let pairs = halves.len() / (3 * texels);
        Ok(Self {
            halves: gpu.upload("originals", &bytemuck::pod_collect_to_vec::<f16, u32>(halves))?,
            partials: gpu.fresh("errors of workgroups", pairs * texels.div_ceil(WORKGROUP))?,
            pairs,
            texels,
        })
    }

    /// Number of pictures.
    #[must_use]
    pub fn pairs(&self) -> usize {
        self.pairs
    }

    fn groups(&self) -> usize {
        self.texels.div_ceil(WORKGROUP)
    }
}

/// The stage's kernels on one device.
#[derive(Debug)]
pub struct PictureError {
    errors: Kernel,
    sum: Kernel,
}

impl PictureError {
    /// Builds the kernels.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses one.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let errors = [
            Resource::uniform::<Params>("params"),
            Resource::read::<[f32; 4]>("picture"),
            Resource::read::<u32>("originals"),
            Resource::read_write::<[f32; 2]>("texel_sums"),
            Resource::read_write::<PictureSums>("partials"),
        ];
        let sum = [
            Resource::uniform::<SumParams>("params"),
            Resource::read::<PictureSums>("partials"),
            Resource::read_write::<PictureSums>("sums"),
        ];
        Ok(Self {
            errors: Kernel::new(gpu, &wgsl::PICTURE_ERROR, wgsl::ALL, &errors)?,
            sum: Kernel::new(gpu, &wgsl::PICTURE_ERROR_SUM, wgsl::ALL, &sum)?,
        })
    }

    /// Takes `picture`, linear RGB in reflectance units, as that of original `pair`. Adds its squared error and the squared original to
    /// `texel_sums`, `[texel]`. Once all pictures are recorded, [`Self::record_sums`] joins their errors.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    ///
    /// # Panics
    /// If there is no such original, or `picture` or `texel_sums` has another number of texels: the host's bug.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, originals: &Originals, pair: usize, picture: &Buffer<[f32; 4]>, texel_sums: &Buffer<[f32; 2]>,
    ) -> Result<(), GpuError> {
        let texels = originals.texels;
        assert!(pair < originals.pairs, "one of {} originals", originals.pairs);
        assert_eq!([picture.len(), texel_sums.len()], [texels; 2], "texels of the picture and of the sums");
        let params = Params { texels: count(texels), groups: count(originals.groups()), pair: count(pair), _pad: 0 };
        let params = recorder.gpu().uniform("picture_error params", &params)?;
        recorder.dispatch(
            &self.errors,
            &[
                bind("params", &params),
                bind("picture", picture),
                bind("originals", &originals.halves),
                bind("texel_sums", texel_sums),
                bind("partials", &originals.partials),
            ],
            Grid::threads(texels),
        )
    }

    /// The sums of every picture, `[pair]`.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    pub fn record_sums(&self, recorder: &mut Recorder<'_>, originals: &Originals) -> Result<Buffer<PictureSums>, GpuError> {
        let gpu = recorder.gpu();
        let params = gpu.uniform("picture_error_sum params", &SumParams { groups: count(originals.groups()) })?;
        let sums = gpu.fresh("errors of pictures", originals.pairs)?;
        recorder.dispatch(
            &self.sum,
            &[bind("params", &params), bind("partials", &originals.partials), bind("sums", &sums)],
            Grid::layers(WORKGROUP, count(originals.pairs)),
        )?;
        Ok(sums)
    }
}
