//! What is recovered from a BTF: geometry and per-texel reflectance.

use std::fmt;

use super::{Direction, Encoding, Lpca, Map, Painted, ShapeError};
use crate::model::{FitSettings, Frame, SurfaceMode};

/// One lobe of every texel.
#[derive(Debug, Clone, PartialEq)]
pub struct Lobe {
    /// ρ_s per channel.
    pub specular: Map<[f32; 3]>,
    /// (C_x, C_y, C_z, n); the lobe's scale lives in C.
    pub parameters: Map<[f32; 4]>,
}

/// Per-texel reflectance f_r = ρ_d + Σ ρ_s·(C·ω_i ω_o)^n, in π·f_r units (Lafortune et al. 1997; thesis eq. 3.3).
#[derive(Debug, Clone, PartialEq)]
pub struct Svbrdf {
    /// The frame that cosine and lobes are in.
    pub frame: Frame,
    /// Share of the light on the base plane that reaches every point by way of others, 0 to 1: the points of a relief light each other's
    /// shadows. In its own frame a texel is lit by cos θ_i times the light's share that sees it, less this share, and by this share of the
    /// base plane's cos θ_i.
    pub ambient: f64,
    /// ρ_d per channel.
    pub diffuse: Map<[f32; 3]>,
    /// The lobes, 1 to [`MAX_LOBES`](crate::model::MAX_LOBES).
    pub lobes: Vec<Lobe>,
}

/// A way of taking the surface, and how it did.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Candidate {
    /// Flat, rough or local.
    pub surface: SurfaceMode,
    /// The frame that the reflectance is in.
    pub frame: Frame,
    /// Factor on the height as photometric stereo and integration give it.
    pub height_scale: f64,
    /// Height of its mean over the plane that the pictures are rectified to, texel widths.
    pub height_level: f64,
    /// [`Svbrdf::ambient`].
    pub ambient: f64,
    /// What it leaves of some texels' radiance; none if there was nothing to choose.
    pub left: Option<Left>,
}

/// What a reconstruction leaves of the measured radiance.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Left {
    /// Root of the sum of squared errors over that of the radiance's squares.
    pub relative_rms: f64,
    /// Sum of the errors, reconstruction less radiance, over that of the radiance.
    pub bias: f64,
}

impl Left {
    /// By which candidates are ordered: √(relative RMS² + (2 bias)²). An error that all pictures share is seen before one that
    /// varies from place to place.
    #[must_use]
    pub fn cost(self) -> f64 {
        self.relative_rms.hypot(2.0 * self.bias)
    }
}

/// Which way of taking the surface was chosen, and why.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Choice {
    /// The candidates, best first.
    pub candidates: Vec<Candidate>,
    /// Number of texels that they were measured on.
    pub texels: usize,
    /// Column and row of the texel whose lobe serves all of a rough surface, if that was a candidate.
    pub representative: Option<[usize; 2]>,
}

impl Candidate {
    /// One that is not measured, with the height as it was recovered.
    #[must_use]
    pub fn new(surface: SurfaceMode, frame: Frame) -> Self {
        Self { surface, frame, height_scale: 1.0, height_level: 0.0, ambient: 0.0, left: None }
    }

    /// Whether the height is as it was recovered.
    #[must_use]
    pub fn has_measured_height(&self) -> bool {
        self.height_scale == 1.0 && self.height_level == 0.0
    }
}

impl Choice {
    /// A single candidate.
    #[must_use]
    pub fn only(surface: SurfaceMode, frame: Frame) -> Self {
        Self { candidates: vec![Candidate::new(surface, frame)], texels: 0, representative: None }
    }

    /// The best candidate.
    #[must_use]
    pub fn chosen(&self) -> Candidate {
        self.candidates.first().copied().unwrap_or(Candidate::new(SurfaceMode::Flat, Frame::Plane))
    }
}

/// In a line: the candidate chosen, and what each left.
impl fmt::Display for Choice {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}", self.chosen())?;
        if let (Some([column, row]), SurfaceMode::Rough) = (self.representative, self.chosen().surface) {
            write!(out, " with the lobe of texel {column},{row}")?;
        }
        if self.candidates.len() > 1 {
            write!(out, "; on {} texels it leaves the least of the radiance", self.texels)?;
            for (index, candidate) in self.candidates.iter().enumerate() {
                let Some(Left { relative_rms, bias }) = candidate.left else { continue };
                let name = if index == 0 { String::new() } else { format!("{candidate} ") };
                write!(out, "{} {name}{relative_rms:.4} ({:+.1} %)", if index == 1 { ";" } else { "," }, 100.0 * bias)?;
            }
        }
        Ok(())
    }
}

impl fmt::Display for Candidate {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match (self.surface, self.frame) {
            (SurfaceMode::Flat, _) => "flat",
            (SurfaceMode::Rough, _) => "rough",
            (SurfaceMode::Local | SurfaceMode::Auto, Frame::Seen) => "local in the frames of the points seen",
            (SurfaceMode::Local | SurfaceMode::Auto, _) => "local in each texel's frame",
        })?;
        if !self.has_measured_height() {
            write!(out, " with height times {:.2}, level {:+.2} and ambient {:.2}", self.height_scale, self.height_level, self.ambient)?;
        }
        Ok(())
    }
}

/// How a texel's fit ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum FitStatus {
    /// Out of iterations, still descending.
    Running = 0,
    /// The objective settled.
    Converged = 1,
    /// Nothing above the diffuse part: no lobe, ρ_s = 0.
    NoSpecular = 2,
    /// Settled to rounding: no step, however short, lowers the objective any more in single precision.
    Stalled = 3,
    /// Fewer valid samples than [`MIN_LOBE_SAMPLES`](crate::model::MIN_LOBE_SAMPLES): no lobe, ρ_s = 0.
    TooFewSamples = 4,
    /// Not fitted: the lobe is that of the texel which represents a rough surface.
    Shared = 5,
}

impl FitStatus {
    /// All, in order of their codes.
    pub const ALL: [Self; 6] = [Self::Running, Self::Converged, Self::NoSpecular, Self::Stalled, Self::TooFewSamples, Self::Shared];

    /// From the code that kernels write; `None` for any other number.
    #[must_use]
    pub fn from_code(code: u32) -> Option<Self> {
        Self::ALL.get(code as usize).copied()
    }
}

/// Diagnostics of the Levenberg-Marquardt fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Mean squared residual of the valid samples without any lobe, reflectance².
    pub objective_without_lobe: Map<f32>,
    /// Mean squared residual of the valid samples at the end, reflectance².
    pub objective: Map<f32>,
    /// Steps tried.
    pub iterations: Map<u32>,
    /// How it ended, as [`FitStatus`] codes.
    pub status: Map<u32>,
    /// Number of masked samples: measurements that were NaN, infinite or negative, which take no part in anything.
    pub masked: Map<u32>,
}

/// Where a material came from.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Provenance {
    /// The source's name.
    pub source: String,
    /// Views of the source. Stored as [θ, φ] in degrees, to a billionth.
    #[serde(with = "degrees")]
    pub views: Vec<Direction>,
    /// Lights of the source. Stored as [θ, φ] in degrees, to a billionth.
    #[serde(with = "degrees")]
    pub lights: Vec<Direction>,
    /// Number of samples of the source.
    pub samples: usize,
    /// Name of the source's direction grid if it is a known one.
    pub grid: Option<String>,
    /// How the source's stored values became radiance.
    pub encoding: Encoding,
    /// The adapter that computed it.
    pub adapter: String,
    /// Version of overpaint.
    pub version: String,
    /// Settings of every stage.
    pub settings: FitSettings,
}

/// Directions as [θ, φ] in degrees, to a billionth: what the name of an image says comes back bit by bit.
mod degrees {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::Direction;

    pub(super) fn serialize<S: Serializer>(directions: &[Direction], serializer: S) -> Result<S::Ok, S::Error> {
        let rounded = |degrees: f64| (degrees * 1e9).round() / 1e9;
        let degrees = directions.iter().map(|direction| <[f64; 2]>::from(direction.degrees()).map(rounded));
        degrees.collect::<Vec<_>>().serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Direction>, D::Error> {
        let degrees = Vec::<[f64; 2]>::deserialize(deserializer)?;
        Ok(degrees.into_iter().map(|[theta, phi]| Direction::from_degrees(theta, phi)).collect())
    }
}

/// A recovered material.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Height over the plane that the pictures are rectified to, in texel widths, positive outwards; its mean is 0 unless the views
    /// tell another level ([`Candidate::height_level`]).
    pub height: Map<f32>,
    /// Unit normals of the height field.
    pub normal: Map<[f32; 3]>,
    /// Photometric stereo's normals, before integration.
    pub normal_measured: Map<[f32; 3]>,
    /// Photometric stereo's albedo |g|.
    pub albedo: Map<f32>,
    /// Reflectance.
    pub svbrdf: Svbrdf,
    /// The original's full look, unless it was left out.
    pub lpca: Option<Lpca>,
    /// The paint on it, if there is any. It leaves the other maps as they are.
    pub painted: Option<Painted>,
    /// How the fit went.
    pub fit: Fit,
    /// Which way of taking the surface was chosen.
    pub choice: Choice,
    /// Where it came from.
    pub provenance: Provenance,
}

impl Material {
    /// Columns and rows.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.height.width(), self.height.height()]
    }

    /// The material laid side by side with itself, `columns` times to the right and `rows` times downwards: a larger piece of
    /// one that repeats.
    #[must_use]
    pub fn repeated(&self, columns: usize, rows: usize) -> Self {
        Self {
            height: self.height.repeated(columns, rows),
            normal: self.normal.repeated(columns, rows),
            normal_measured: self.normal_measured.repeated(columns, rows),
            albedo: self.albedo.repeated(columns, rows),
            svbrdf: Svbrdf {
                frame: self.svbrdf.frame,
                ambient: self.svbrdf.ambient,
                diffuse: self.svbrdf.diffuse.repeated(columns, rows),
                lobes: self
                    .svbrdf
                    .lobes
                    .iter()
                    .map(|lobe| Lobe {
                        specular: lobe.specular.repeated(columns, rows),
                        parameters: lobe.parameters.repeated(columns, rows),
                    })
                    .collect(),
            },
            lpca: self.lpca.as_ref().map(|lpca| lpca.repeated(columns, rows)),
            painted: self.painted.as_ref().map(|painted| painted.repeated(columns, rows)),
            fit: Fit {
                objective_without_lobe: self.fit.objective_without_lobe.repeated(columns, rows),
                objective: self.fit.objective.repeated(columns, rows),
                iterations: self.fit.iterations.repeated(columns, rows),
                status: self.fit.status.repeated(columns, rows),
                masked: self.fit.masked.repeated(columns, rows),
            },
            choice: self.choice.clone(),
            provenance: self.provenance.clone(),
        }
    }

    /// Checks that every map covers the same plane.
    ///
    /// # Errors
    /// [`ShapeError`] for the first that does not.
    pub fn checked(self) -> Result<Self, ShapeError> {
        let [width, height] = self.size();
        if let Some(lpca) = &self.lpca {
            lpca.check([width, height])?;
        }
        let shapes = [
            (self.normal.width(), self.normal.height()),
            (self.normal_measured.width(), self.normal_measured.height()),
            (self.albedo.width(), self.albedo.height()),
            (self.svbrdf.diffuse.width(), self.svbrdf.diffuse.height()),
            (self.fit.objective_without_lobe.width(), self.fit.objective_without_lobe.height()),
            (self.fit.objective.width(), self.fit.objective.height()),
            (self.fit.iterations.width(), self.fit.iterations.height()),
            (self.fit.status.width(), self.fit.status.height()),
            (self.fit.masked.width(), self.fit.masked.height()),
        ];
        let of_paint = self.painted.iter().flat_map(|painted| {
            [
                (painted.height.width(), painted.height.height()),
                (painted.normal.width(), painted.normal.height()),
                (painted.reflectance.width(), painted.reflectance.height()),
                (painted.coverage.width(), painted.coverage.height()),
                (painted.coat.width(), painted.coat.height()),
            ]
        });
        let of_lobes = self
            .svbrdf
            .lobes
            .iter()
            .flat_map(|lobe| [(lobe.specular.width(), lobe.specular.height()), (lobe.parameters.width(), lobe.parameters.height())]);
        match shapes.into_iter().chain(of_paint).chain(of_lobes).find(|&shape| shape != (width, height)) {
            Some((w, h)) => Err(ShapeError { width, height, expected: width * height, found: w * h }),
            None => Ok(self),
        }
    }
}
