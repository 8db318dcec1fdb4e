//! The original's full look, compressed: a local PCA of its texels.

use std::fmt;

use half::f16;

use super::{Map, Pair, ShapeError};

/// A local PCA of a BTF (Müller, Meseth, Klein 2003): every texel is the mean of its cluster plus a weighted sum of the cluster's
/// eigenvectors, L(sample, texel) = term_0 + Σ_c w_c(texel) term_c, the terms being those of the sample and the texel's cluster.
///
/// An eigenvector is stored times the standard deviation of its weight in the cluster. Weights have unit variance so, and terms are radiance like
/// what they were made from, so that halves hold either, however bright the material is.
#[derive(Debug, Clone, PartialEq)]
pub struct Lpca {
    /// View and light of each sample, as indices into [`Provenance::views`](super::Provenance::views) and `lights`.
    pub pairs: Vec<Pair>,
    /// Number of clusters.
    pub clusters: usize,
    /// Number of eigenvectors of a cluster.
    pub components: usize,
    /// Cluster of each texel.
    pub cluster: Map<u32>,
    /// `[row][column][component]`
    pub weights: Vec<f16>,
    /// `[sample][cluster][term][channel]`: term 0 is the cluster's mean, the others its eigenvectors, in reflectance units.
    pub terms: Vec<f16>,
    /// Of each texel √(Σ (R − L)² / Σ L²) over its valid samples and channels, R being what is stored.
    pub error: Map<f32>,
    /// How it was found.
    pub learned: Learned,
}

/// How a local PCA was found.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Learned {
    /// √(Σ (R − L)² / Σ L²) over all valid samples, R being what is stored.
    pub relative_rms: f64,
    /// Vectors of the basis.
    pub rank: usize,
    /// Part of the samples' variance, weighted as they are, that the basis leaves out.
    pub left_out: f64,
    /// Square root of the energy that clusters leave after each assignment over that of the samples, weighted as they are, what the
    /// basis leaves out included.
    pub errors: Vec<f64>,
    /// Numbers of clusters and components that a target chose from, with the bytes that they take and the estimated error.
    pub candidates: Vec<LpcaCandidate>,
}

/// A local PCA that might have been taken.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct LpcaCandidate {
    /// Number of clusters.
    pub clusters: usize,
    /// Number of eigenvectors of a cluster.
    pub components: usize,
    /// Bytes in adapter memory.
    pub bytes: u64,
    /// Estimated relative RMS error.
    pub error: f64,
}

/// In a line: how large it is, and what it leaves.
impl fmt::Display for Lpca {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { clusters, components, learned: Learned { relative_rms, rank, left_out, errors, .. }, .. } = self;
        let (bytes, source) = (self.bytes(), self.source_bytes());
        #[expect(clippy::cast_precision_loss, reason = "bytes, to three digits")]
        let (megabytes, ratio) = (bytes as f64 / 1e6, source as f64 / bytes as f64);
        write!(
            out,
            "{clusters} clusters of {components} components in a basis of {rank} vectors, which leaves out {:.2} % of the variance; \
             {} assignments; relative RMS error {relative_rms:.4}; {megabytes:.2} MB, 1/{ratio:.0} of the samples",
            100.0 * left_out,
            errors.len()
        )
    }
}

impl Lpca {
    /// Bytes of the arrays that a renderer binds, for the given numbers: terms of four halves, a texel's cluster and its weights.
    #[must_use]
    pub fn adapter_bytes(texels: usize, samples: usize, clusters: usize, components: usize) -> u64 {
        let terms = samples * clusters * (1 + components) * 4 * size_of::<f16>();
        let words = texels * (1 + components.div_ceil(2)) * size_of::<u32>();
        (terms + words) as u64
    }

    /// Bytes of this one's arrays in adapter memory.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        Self::adapter_bytes(self.cluster.values().len(), self.pairs.len(), self.clusters, self.components)
    }

    /// Bytes of the source's samples as halves.
    #[must_use]
    pub fn source_bytes(&self) -> u64 {
        (self.cluster.values().len() * self.pairs.len() * 3 * size_of::<f16>()) as u64
    }

    /// The plane laid side by side with itself, as [`Material::repeated`](super::Material::repeated) does.
    #[must_use]
    pub fn repeated(&self, columns: usize, rows: usize) -> Self {
        let [width, components] = [self.cluster.width(), self.components];
        let texel = Map::from_fn(width, self.cluster.height(), |column, row| row * width + column).repeated(columns, rows);
        let weights = texel.values().iter().flat_map(|&texel| &self.weights[texel * components..][..components]);
        Self {
            weights: weights.copied().collect(),
            cluster: self.cluster.repeated(columns, rows),
            error: self.error.repeated(columns, rows),
            ..self.clone()
        }
    }

    /// Checks the shapes against each other and the plane, and that every cluster is one of those there are.
    ///
    /// # Errors
    /// [`ShapeError`] for the first that does not fit.
    pub fn check(&self, [width, height]: [usize; 2]) -> Result<(), ShapeError> {
        let texels = width * height;
        let shapes = [
            (self.cluster.width() * self.cluster.height(), texels),
            (self.error.width() * self.error.height(), texels),
            (self.weights.len(), texels * self.components),
            (self.terms.len(), self.pairs.len() * self.clusters * (1 + self.components) * 3),
            (self.cluster.values().iter().filter(|&&cluster| (cluster as usize) < self.clusters).count(), texels),
        ];
        match shapes.into_iter().find(|(found, expected)| found != expected) {
            Some((found, expected)) => Err(ShapeError { width, height, expected, found }),
            None => Ok(()),
        }
    }
}
