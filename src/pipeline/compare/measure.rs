//! Errors of every pair, in one pass over the source.
//!
//! While the adapter reconstructs the pairs of one part of the source and compares them, another thread reads the next. The figures do not
//! depend on the size of a part: a picture's sums are its own, and those of a texel leave the adapter after every [`RUN`] pairs, to be added
//! up in f64.

use std::{
    ops::{AddAssign, Range},
    sync::mpsc,
    thread,
};

use half::f16;

use super::{
    CompareSettings, radiance,
    texel::{self, Framed},
};
use crate::{
    data::{Block, Map},
    gpu::Gpu,
    io::Source,
    pipeline::{Memory, PipelineError, Progress, Studio, Subject, tiles::run},
    stage::{Originals, PictureError, PictureSums},
};

/// Pairs whose errors a texel adds up on the adapter, in single precision.
const RUN: usize = 64;

/// Bytes of samples that are read at once, if the source has no more than eight such parts.
const PART_BYTES: usize = 64 << 20;

/// Sums over values, red, green and blue together. R is the reconstruction, L the original, in reflectance units.
#[derive(Debug, Clone, Copy, Default)]
pub struct Sums {
    pub squared_error: f64,
    pub error: f64,
    pub squared_original: f64,
    pub original: f64,
    /// Of the sRGB values, held to 0 … 1.
    pub squared_shown_error: f64,
    pub texels: f64,
    pub pairs: usize,
}

impl From<PictureSums> for Sums {
    fn from(sums: PictureSums) -> Self {
        let PictureSums { squared_error, error, squared_original, original, squared_shown_error, texels } = sums;
        let [squared_error, error, squared_original, original, squared_shown_error, texels] =
            [squared_error, error, squared_original, original, squared_shown_error, texels].map(f64::from);
        Self { squared_error, error, squared_original, original, squared_shown_error, texels, pairs: 1 }
    }
}

impl AddAssign for Sums {
    fn add_assign(&mut self, other: Self) {
        self.squared_error += other.squared_error;
        self.error += other.error;
        self.squared_original += other.squared_original;
        self.original += other.original;
        self.squared_shown_error += other.squared_shown_error;
        self.texels += other.texels;
        self.pairs += other.pairs;
    }
}

/// What one pass over the source gives.
pub struct Measured {
    /// Of each pair.
    pub pairs: Vec<Sums>,
    /// (Σ (R − L)², Σ L²) over the pairs.
    pub texels: Map<[f64; 2]>,
    /// The texel asked for in each pair; none where it is masked.
    pub texel: Vec<Option<[f32; 3]>>,
    /// The frames of the reflectance of the texel asked for in each pair; none of a local PCA.
    pub framed: Vec<Framed>,
}

/// Compares every pair of `source` with its reconstruction.
pub fn measure(
    studio: &Studio<'_>, subject: &Subject, source: &dyn Source, settings: &CompareSettings, memory: Memory, progress: &Progress,
) -> Result<Measured, PipelineError> {
    let (gpu, btf) = (studio.gpu(), source.btf());
    let (samples, texels) = (btf.pairs().len(), btf.texels());
    let errors = PictureError::new(gpu)?;
    let picture = gpu.fresh("reconstructed picture", texels)?;
    let batch = batch(gpu, texels, memory);
    let mut texel_sums = gpu.zeros::<[f32; 2]>("errors of texels", texels)?;
    let mut found =
        Measured { pairs: Vec::with_capacity(samples), texels: Map::from_fn(0, 0, |_, _| [0.0; 2]), texel: Vec::new(), framed: Vec::new() };
    let mut of_texels = vec![[0.0_f64; 2]; texels];
    progress.expect(2 * samples);

    thread::scope(|scope| {
        // A part waits here until the one before is done with; while it is, the next one is read.
        let (send, receive) = mpsc::sync_channel(0);
        let parts = parts(source, memory);
        let mut left = parts.clone().into_iter();
        scope.spawn(move || {
            for part in parts {
                let samples: Vec<usize> = part.collect();
                let mut halves = vec![f16::ZERO; samples.len() * 3 * texels];
                let stage = progress.stage("read", texels, samples.len());
                let read = source.read(&samples, Block::whole(btf.size()), &mut halves, &|samples| progress.advance(samples));
                drop(stage);
                let failed = read.is_err();
                // Nobody receives any more if the work has failed.
                if send.send(read.map(|()| halves)).is_err() || failed {
                    return;
                }
            }
        });
        while let (Some(part), Ok(halves)) = (left.next(), receive.recv()) {
            let halves = halves?;
            if let Some([column, row]) = settings.texel {
                let at = row * btf.size()[0] + column;
                let channels = |sample: &[f16]| [0, 1, 2].map(|channel| sample[channel * texels + at].to_f32());
                found.texel.extend(halves.chunks_exact(3 * texels).map(|sample| radiance(channels(sample))));
            }
            for range in batches(&part, batch) {
                let halves = &halves[3 * texels * (range.start - part.start)..][..3 * texels * range.len()];
                let sums = run(gpu, progress, "compare", [texels, range.len()], |recorder| {
                    let originals = Originals::upload(gpu, halves, texels)?;
                    for (index, sample) in range.clone().enumerate() {
                        let (view, light) = btf.directions(sample);
                        studio.record_picture(recorder, subject, view, light, &picture)?;
                        errors.record(recorder, &originals, index, &picture, &texel_sums)?;
                    }
                    errors.record_sums(recorder, &originals)
                })?;
                found.pairs.extend(sums.read(gpu)?.into_iter().map(Sums::from));
                if range.end.is_multiple_of(RUN) || range.end == samples {
                    for (all, sums) in of_texels.iter_mut().zip(texel_sums.read(gpu)?) {
                        *all = [0, 1].map(|term| all[term] + f64::from(sums[term]));
                    }
                    texel_sums = gpu.zeros("errors of texels", texels)?;
                }
                progress.advance(range.len());
            }
        }
        Ok::<_, PipelineError>(())
    })?;
    let [width, height] = btf.size();
    if let (Some(at), Subject::Surface { surface, relief }) = (settings.texel, subject) {
        found.framed = texel::framed(gpu, surface, btf, at, *relief, progress)?;
    }
    Ok(Measured { texels: Map::new(width, height, of_texels)?, ..found })
}

/// Samples that are read at once: whole views, if the host may hold one, since datasets store a view's samples together; and an eighth of
/// the source, if it may hold that, since other containers are read as a whole for each part.
fn parts(source: &dyn Source, memory: Memory) -> Vec<Range<usize>> {
    let btf = source.btf();
    let sample = 3 * btf.texels() * size_of::<f16>();
    // Two parts: one being read, one being worked on.
    let fitting = (memory.host / 2 / sample).max(1);
    let wanted = btf.pairs().len().div_ceil(8).max(PART_BYTES / sample).clamp(1, fitting);
    let mut parts: Vec<Range<usize>> = Vec::new();
    let mut start = 0;
    for view in btf.pairs().chunk_by(|a, b| a.view == b.view) {
        let end = start + view.len();
        match parts.last_mut() {
            Some(part) if end - part.start <= wanted => part.end = end,
            _ => parts.extend((start..end).step_by(fitting).map(|first| first..(first + fitting).min(end))),
        }
        start = end;
    }
    parts
}

/// Pairs that the adapter holds at once.
fn batch(gpu: &Gpu, texels: usize, memory: Memory) -> usize {
    let array = (3 * texels * size_of::<f16>()) as u64;
    let all = (Originals::TEXEL_BYTES * texels) as u64;
    let fitting = (gpu.max_array_bytes() / array).min(memory.adapter / all);
    usize::try_from(fitting).unwrap_or(usize::MAX).clamp(1, RUN)
}

/// `part` in pieces of at most `batch`, none of which goes over a multiple of [`RUN`].
fn batches(part: &Range<usize>, batch: usize) -> impl Iterator<Item = Range<usize>> {
    let (mut start, end) = (part.start, part.end);
    std::iter::from_fn(move || {
        let next = (start + batch).min((start / RUN + 1) * RUN).min(end);
        let range = start..next;
        start = next;
        (!range.is_empty()).then_some(range)
    })
}
