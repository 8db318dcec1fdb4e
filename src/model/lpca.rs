//! Settings of local PCA (Müller, Meseth, Klein 2003).

use super::SettingsError;

/// How much a sample counts when clusters and eigenvectors are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Weighting {
    /// All alike: the error of the radiance is least.
    #[default]
    Even,
    /// By cos θ_o of its view: by the area that a piece of the surface covers in a picture.
    Cosine,
    /// By 1 / (mean radiance of the sample's channel + that of all / 16): nearly the error of the radiance's logarithm, so that a highlight
    /// counts no more than what it outshines.
    Log,
}

/// Where clusters are alternated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LpcaMethod {
    /// In a global basis of a few hundred vectors at most: an iteration costs a hundredth.
    #[default]
    Basis,
    /// In the span of the clusters themselves, to which the samples are projected anew in each iteration.
    Direct,
}

/// What numbers of clusters and components are chosen by.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LpcaTarget {
    /// The smallest with a relative RMS error of at most this.
    Error(f64),
    /// The most accurate with at most this many bytes.
    Size(u64),
}

/// Everything that a user may set for local PCA.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct LpcaSettings {
    /// Clusters of texels, from 1 to [`MAX_CLUSTERS`].
    pub clusters: u32,
    /// Eigenvectors of a cluster, from 1 to [`MAX_COMPONENTS`].
    pub components: u32,
    /// What chooses clusters and components in the place of the two numbers.
    pub target: Option<LpcaTarget>,
    /// Vectors of the global basis, at most [`MAX_RANK`]; none: as many as leave out [`LEFT_OUT`](Self::LEFT_OUT) of the variance, and
    /// at most [`auto_rank`](Self::auto_rank).
    pub rank: Option<u32>,
    /// Alternations of assignment and PCA at most.
    pub iterations: u32,
    /// How much a sample counts.
    pub weighting: Weighting,
    /// Where clusters are alternated.
    pub method: LpcaMethod,
    /// Seed of all that is drawn at random.
    pub seed: u32,
}

/// Clusters at most: a texel's is kept in a byte.
pub const MAX_CLUSTERS: u32 = 256;

/// Eigenvectors of a cluster at most: what a thread that renders loops over.
pub const MAX_COMPONENTS: u32 = 32;

/// Vectors of the global basis at most.
pub const MAX_RANK: u32 = 256;

impl LpcaSettings {
    /// Part of the variance that the basis may leave out, where the rank is not set. What it leaves out costs next to nothing: clusters hardly
    /// change, and the eigenvectors are lifted back with the samples themselves. Ranks from 64 to 256 end within 1 % of each other on the
    /// path-traced weave and blocks.
    pub const LEFT_OUT: f64 = 0.01;

    /// Vectors that the basis has at most, where the rank is not set: eight for each eigenvector of a cluster, and 64 or more.
    #[must_use]
    pub fn auto_rank(&self) -> u32 {
        (8 * self.components).clamp(64, MAX_RANK)
    }

    /// An alternation that lowers the energy which clusters leave by less than this, relatively, is the last.
    pub const SETTLED: f64 = 1e-3;

    /// Checks that every setting is in range.
    ///
    /// # Errors
    /// [`SettingsError`] for the first that is not.
    pub fn checked(&self) -> Result<(), SettingsError> {
        let target = match self.target {
            None => true,
            Some(LpcaTarget::Error(error)) => error > 0.0 && error < 1.0,
            Some(LpcaTarget::Size(bytes)) => bytes > 0,
        };
        let checks = [
            ("clusters", self.clusters.to_string(), (1..=MAX_CLUSTERS).contains(&self.clusters), "from 1 to 256"),
            ("components", self.components.to_string(), (1..=MAX_COMPONENTS).contains(&self.components), "from 1 to 32"),
            ("target", format!("{:?}", self.target), target, "an error above 0 and below 1, or a size above 0"),
            ("rank", format!("{:?}", self.rank), self.rank.is_none_or(|rank| (1..=MAX_RANK).contains(&rank)), "from 1 to 256"),
            ("iterations", self.iterations.to_string(), (1..=1000).contains(&self.iterations), "from 1 to 1000"),
        ];
        match checks.into_iter().find(|(_, _, holds, _)| !holds) {
            Some((setting, found, _, expected)) => Err(SettingsError { setting, found, expected }),
            None => Ok(()),
        }
    }
}

impl Default for LpcaSettings {
    fn default() -> Self {
        Self {
            clusters: 16,
            components: 8,
            target: None,
            rank: None,
            iterations: 25,
            weighting: Weighting::Even,
            method: LpcaMethod::Basis,
            seed: 1,
        }
    }
}
