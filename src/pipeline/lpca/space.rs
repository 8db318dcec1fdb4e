//! The space in which a texel is one vector: all of its samples and channels, in lines as the adapter has them.

use super::sketch::Sketch;
use crate::{
    data::{Btf, OCTET},
    gpu::{Buffer, Gpu},
    model::Weighting,
    pipeline::PipelineError,
    stage::Line,
};

/// The vector space of texels, about a centre and with a weight on each axis. Vectors are `[channel][octet][8]`, zero past the last sample. A texel x is
/// s·(x − c) in it, so that distances are weighted errors.
pub struct Space {
    pub samples: usize,
    /// c, the mean of all texels.
    pub centre: Vec<f64>,
    /// s
    pub scale: Vec<f64>,
    pub centre_lines: Buffer<Line>,
    /// s²
    pub weight_lines: Buffer<Line>,
}

impl Space {
    pub fn new(gpu: &Gpu, btf: &Btf, sketch: &Sketch, weighting: Weighting) -> Result<Self, PipelineError> {
        let samples = btf.pairs().len();
        let centre = sketch.mean.clone();
        let scale = scale(btf, &centre, weighting);
        let weights: Vec<f64> = scale.iter().map(|s| s * s).collect();
        let centre_lines = gpu.upload("centre", &Line::of(&centre))?;
        let weight_lines = gpu.upload("weights of samples", &Line::of(&weights))?;
        Ok(Self { samples, centre, scale, centre_lines, weight_lines })
    }

    /// Values of a vector, those past the last sample included.
    pub fn values(&self) -> usize {
        self.centre.len()
    }

    /// Lines of a vector.
    pub fn lines(&self) -> usize {
        self.values() / OCTET
    }

    /// Where a vector has a sample's channel.
    pub fn at(&self, sample: usize, channel: usize) -> usize {
        channel * self.values() / 3 + sample
    }

    /// Σ_d s_d² a_d b_d.
    pub fn product(&self, a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).zip(&self.scale).map(|((a, b), s)| s * s * a * b).sum()
    }

    /// Where a radiance is in the space.
    pub fn vector(&self, radiance: &[f64]) -> Vec<f64> {
        radiance.iter().zip(&self.centre).zip(&self.scale).map(|((x, c), s)| s * (x - c)).collect()
    }

    /// The vectors, which are orthonormal with the weights, times s on each axis: their products with x − c are a texel's coordinates.
    pub fn projectors(&self, vectors: &[Vec<f64>]) -> Vec<Vec<f64>> {
        vectors.iter().map(|vector| vector.iter().zip(&self.scale).map(|(v, s)| v * s).collect()).collect()
    }

    /// The energy Σ_t Σ_d s² x² of texels whose energies about the centre add up to `about_centre`.
    pub fn energy(&self, about_centre: f64, texels: usize) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "a number of texels")]
        let texels = texels as f64;
        about_centre + texels * self.product(&self.centre, &self.centre)
    }
}

/// Square root of each value's weight, at most 1; 0 past the last sample.
fn scale(btf: &Btf, mean: &[f64], weighting: Weighting) -> Vec<f64> {
    let samples = btf.pairs().len();
    let padded = mean.len() / 3;
    #[expect(clippy::cast_precision_loss, reason = "a number of values")]
    let mean_of_all = mean.iter().sum::<f64>() / (3 * samples) as f64;
    let dark = mean_of_all / 16.0;
    let of = |value: usize| {
        let sample = value % padded;
        if sample >= samples {
            return 0.0;
        }
        match weighting {
            Weighting::Even => 1.0,
            Weighting::Cosine => btf.directions(sample).0.theta.cos().max(0.0).sqrt(),
            // The derivative of the logarithm is the root of the weight. A black source has none.
            Weighting::Log if dark > 0.0 => dark / (mean[value].max(0.0) + dark),
            Weighting::Log => 1.0,
        }
    };
    (0..mean.len()).map(of).collect()
}
