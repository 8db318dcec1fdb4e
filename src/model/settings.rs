//! Settings of the recovery, read by stages and twins alike.

use super::{Boundary, LpcaSettings, MAX_LOBES};

/// How ρ_s is found once the lobe is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SpecularScale {
    /// The least-squares ratio Σ s·lobe / Σ lobe²: of all factors the one with the smallest squared error.
    #[default]
    LeastSquares,
    /// The thesis' mean of s/lobe (eq. 3.6) over samples whose lobe is above [`FitSettings::min_lobe`].
    MeanRatio,
}

/// How the surface is taken when its reflectance is fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SurfaceMode {
    /// As that of the others which leaves the least of some texels' radiance.
    #[default]
    Auto,
    /// Each texel flat: reflectance in the base plane's frame (thesis section 3.2.2).
    Flat,
    /// Rough: samples in shadow left out, and the lobe of one texel in a flat area for all (thesis section 3.2.2).
    Rough,
    /// Each texel in a shading frame of its own, fitted to the radiance itself.
    Local,
}

/// How photometric stereo weighs a texel's samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StereoMethod {
    /// All samples alike: shadows and highlights pull the normal.
    LeastSquares,
    /// The likeliest normal if residuals follow Cauchy's distribution, whose scale each texel's own samples tell; samples that
    /// the light would not reach have no weight. Mean error of normals against that of least squares: 4.74° for 6.17° on a
    /// photographed sphere under 12 lights, 6.44° for 9.54° on the path-traced blocks, 4.44° for 5.55° on the weave.
    #[default]
    Robust,
}

/// Everything that a user may set for `fit`.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct FitSettings {
    /// How the surface is taken.
    pub surface: SurfaceMode,
    /// Lobes of a texel, from 1 to [`MAX_LOBES`]; flat and rough surfaces have one.
    pub lobes: u32,
    /// Column and row of the texel whose lobe serves all of a rough surface; none: the one with the flattest surroundings.
    pub representative: Option<[usize; 2]>,
    /// What lies beyond the sample's edge.
    pub boundary: Boundary,
    /// How photometric stereo weighs a texel's samples.
    pub stereo: StereoMethod,
    /// Photometric stereo's slopes are held to at most this (tan of the angle to the plane's normal).
    pub max_slope: f64,
    /// Under [`Boundary::Mirror`] the mean slope is taken out before integration: it is more often a fault of calibration
    /// than relief. Under [`Boundary::Periodic`] it is always gone, since a plane that repeats has none.
    pub detilt: bool,
    /// Lights with cos θ_i below this carry no weight in the reflectance: division by the cosine would blow up their noise.
    pub min_cos_light: f64,
    /// ρ_d is this quantile of the reflectance (thesis: the 10th percentile).
    pub diffuse_quantile: f64,
    /// Samples whose mean reflectance is below this times that of the texel's medians are taken to lie in shadow and left out of the
    /// quantile (thesis: measurements that are too dark are dropped on rough surfaces).
    pub dark_fraction: f64,
    /// Steps of Levenberg-Marquardt at most, in each descent.
    pub max_iterations: u32,
    /// A descent has converged when a step lowers the objective by less than this, relatively.
    pub tolerance: f64,
    /// The lobe's exponent is held to [least, greatest]. Below 1 a lobe has a vertical edge where its base meets zero, by which the
    /// fit follows the edges of shadows: relative RMS of flat reconstructions at a least exponent of 1, 0.5 and 0.1 is 0.277,
    /// 0.269 and 0.263 on the path-traced weave, 0.423, 0.398 and 0.391 on the blocks. The lower the bound, the more local minima
    /// (one at every sample on the edge) and the harder the edge in pictures between measured directions.
    pub exponents: [f64; 2],
    /// How ρ_s is found.
    pub specular_scale: SpecularScale,
    /// Lobes below this carry no ratio: such samples are left out of the mean, and a texel whose lobes' squares sum to less than
    /// its square has no specular part.
    pub min_lobe: f64,
    /// Local PCA of the original; none: it is left out.
    pub lpca: Option<LpcaSettings>,
}

impl Default for FitSettings {
    fn default() -> Self {
        Self {
            surface: SurfaceMode::Auto,
            lobes: 1,
            representative: None,
            boundary: Boundary::Periodic,
            stereo: StereoMethod::default(),
            // 84°: beyond it a photograph from above says nothing of a slope.
            max_slope: 10.0,
            detilt: true,
            // 80°: keeps all of the usual grids (θ ≤ 75°) and leaves out what cannot be divided by.
            min_cos_light: 0.17,
            diffuse_quantile: 0.1,
            dark_fraction: 0.2,
            max_iterations: 40,
            // Single precision sums thousands of squares to about 1e-6.
            tolerance: 1e-6,
            exponents: [0.5, 1000.0],
            specular_scale: SpecularScale::LeastSquares,
            min_lobe: 0.01,
            lpca: None,
        }
    }
}

/// A setting that no stage can work with.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{setting} is {found}; it must be {expected}")]
pub struct SettingsError {
    /// Name of the setting.
    pub setting: &'static str,
    /// What was given.
    pub found: String,
    /// What is possible.
    pub expected: &'static str,
}

impl FitSettings {
    /// Checks that every setting is one that single precision can work with.
    ///
    /// # Errors
    /// [`SettingsError`] for the first that is not.
    pub fn checked(&self) -> Result<(), SettingsError> {
        let [least, greatest] = self.exponents;
        let most_lobes = if matches!(self.surface, SurfaceMode::Flat | SurfaceMode::Rough) { 1 } else { MAX_LOBES };
        let checks = [
            (
                "lobes",
                format!("{}", self.lobes),
                (1..=most_lobes).contains(&(self.lobes as usize)),
                "from 1 to 3, and 1 with a surface taken as flat or rough",
            ),
            ("max_slope", format!("{}", self.max_slope), (1e-3..=1e3).contains(&self.max_slope), "from 0.001 to 1000"),
            ("min_cos_light", format!("{}", self.min_cos_light), (1e-3..=1.0).contains(&self.min_cos_light), "from 0.001 to 1"),
            ("diffuse_quantile", format!("{}", self.diffuse_quantile), (0.0..=1.0).contains(&self.diffuse_quantile), "from 0 to 1"),
            ("dark_fraction", format!("{}", self.dark_fraction), (0.0..=1.0).contains(&self.dark_fraction), "from 0 to 1"),
            ("max_iterations", format!("{}", self.max_iterations), (1..=10_000).contains(&self.max_iterations), "from 1 to 10000"),
            ("tolerance", format!("{}", self.tolerance), (0.0..1.0).contains(&self.tolerance), "at least 0 and below 1"),
            // C = k A^(1/n) leaves single precision below, and rounding of a base near 1 grows n times above.
            (
                "exponents",
                format!("{least},{greatest}"),
                0.1 <= least && least <= greatest && greatest <= 1e4,
                "two numbers from 0.1 to 10000, the smaller first",
            ),
            ("min_lobe", format!("{}", self.min_lobe), (1e-6..1.0).contains(&self.min_lobe), "at least 1e-6 and below 1"),
        ];
        match checks.into_iter().find(|(_, _, holds, _)| !holds) {
            Some((setting, found, _, expected)) => Err(SettingsError { setting, found, expected }),
            None => self.lpca.map_or(Ok(()), |lpca| lpca.checked()),
        }
    }
}
