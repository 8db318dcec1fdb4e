//! Lines of a texel's samples, and texels sorted by cluster: what the stages of local PCA share.

use half::f16;

use super::scalar::{count, single};
use crate::{
    data::OCTET,
    gpu::{Buffer, Gpu, GpuError},
    gpu_struct,
};

gpu_struct! {
    /// A line: eight values of the vector that a texel's samples make, an octet of one channel. A vector has `[channel][octet]` lines.
    pub struct Line {
        low: [f32; 4],
        high: [f32; 4],
    }
}

impl Line {
    /// The lines of a vector `[line][8]`.
    ///
    /// # Panics
    /// If its values are no whole lines: the caller's bug.
    #[must_use]
    pub fn of(vector: &[f64]) -> Vec<Self> {
        let (lines, rest) = vector.as_chunks::<OCTET>();
        assert!(rest.is_empty(), "values past the last whole line");
        lines
            .iter()
            .map(|line| {
                let [a, b, c, d, e, f, g, h] = line.map(single);
                Self { low: [a, b, c, d], high: [e, f, g, h] }
            })
            .collect()
    }

    /// Its values.
    #[must_use]
    pub fn values(&self) -> [f32; OCTET] {
        let ([a, b, c, d], [e, f, g, h]) = (self.low, self.high);
        [a, b, c, d, e, f, g, h]
    }
}

/// Vectors `[vector][line][8]`, each times `scale`, as halves `[line][vector]`, filled up with zeros to `width` vectors.
///
/// # Panics
/// If there are more than `width`, or one's values are no whole lines: the caller's bug.
#[must_use]
pub fn octets_by_line(vectors: &[&[f64]], scale: f64, width: usize) -> Vec<[f16; OCTET]> {
    assert!(vectors.len() <= width, "{} vectors for {width}", vectors.len());
    let lines = vectors.first().map_or(0, |vector| vector.len() / OCTET);
    let mut octets = vec![[f16::ZERO; OCTET]; lines * width];
    for (index, vector) in vectors.iter().enumerate() {
        for (line, values) in vector.as_chunks::<OCTET>().0.iter().enumerate() {
            octets[line * width + index] = values.map(|value| f16::from_f64(scale * value));
        }
    }
    octets
}

/// Texels sorted by cluster, those of a cluster in order. Each cluster's members are filled up to fours by repeating the last, so that four at a
/// time are of one cluster.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Members {
    /// `[cluster]` first of its members and one past the last, without those that fill up.
    pub ranges: Vec<[u32; 2]>,
    /// `[member]` texel.
    pub texels: Vec<u32>,
    /// `[four members]` cluster.
    pub clusters: Vec<u32>,
}

impl Members {
    /// The members of `clusters` clusters, given each texel's.
    #[must_use]
    pub fn new(cluster_of: &[u32], clusters: usize) -> Self {
        let mut sorted = vec![Vec::new(); clusters];
        for (texel, &cluster) in cluster_of.iter().enumerate() {
            sorted[cluster as usize].push(count(texel));
        }
        let mut members = Self { ranges: Vec::with_capacity(clusters), texels: Vec::new(), clusters: Vec::new() };
        for (cluster, mut texels) in sorted.into_iter().enumerate() {
            let start = members.texels.len();
            members.ranges.push([count(start), count(start + texels.len())]);
            texels.resize(texels.len().next_multiple_of(4), texels.last().copied().unwrap_or_default());
            members.clusters.extend(std::iter::repeat_n(count(cluster), texels.len() / 4));
            members.texels.append(&mut texels);
        }
        members
    }

    /// Number of members of each cluster.
    pub fn counts(&self) -> impl Iterator<Item = usize> {
        self.ranges.iter().map(|[start, end]| (end - start) as usize)
    }

    /// On the adapter.
    ///
    /// # Errors
    /// [`GpuError`] if they do not fit the adapter.
    pub fn upload(&self, gpu: &Gpu) -> Result<MembersOnGpu, GpuError> {
        Ok(MembersOnGpu {
            ranges: gpu.upload("ranges of members", &self.ranges)?,
            texels: gpu.upload("members", &self.texels)?,
            clusters: gpu.upload("clusters of members", &self.clusters)?,
        })
    }
}

/// [`Members`] on the adapter.
#[derive(Debug)]
pub struct MembersOnGpu {
    pub(super) ranges: Buffer<[u32; 2]>,
    pub(super) texels: Buffer<u32>,
    pub(super) clusters: Buffer<u32>,
}
