//! Normals and albedo by photometric stereo. Kernel `photometric_stereo`, twin
//! [`reference::photometric_stereo`](crate::reference::photometric_stereo).
//!
//! Each texel solves its own normal equations over the samples that are not masked, so a mask costs no more than its samples.
//! Plain least squares (Rushmeier, Taubin and Guéziec 1997; thesis eq. 3.1, 3.2) lets shadows and highlights pull the normal.
//! The robust method reweights it towards the likeliest normal under Cauchy's distribution (Lange, Little and Taylor 1989):
//! weights are smooth, so single precision finds the same normal, and the scale beyond which a sample is an outlier comes from
//! the texel's own residuals, so nothing is set to suit a data set. It starts from a single point, so a texel most of whose
//! samples agree on another normal than the rest may follow them.

use glam::{DMat3, DVec3};
use half::f16;

use super::{
    StageError, Tile,
    scalar::{count, single},
};
use crate::{
    data::{Direction, OCTET},
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::{StereoMethod, stereo},
    wgsl,
};

gpu_struct! {
    struct Params { texels: u32, octets: u32, steps: u32, robust: u32, min_pivot: f32, terminator: f32, noise: f32 }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct PhotometricStereo {
    kernel: Kernel,
}

impl PhotometricStereo {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<[f16; OCTET]>("samples"),
            Resource::read::<[f32; 4]>("lights"),
            Resource::read_write::<[f32; 4]>("normals"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::PHOTOMETRIC_STEREO, wgsl::ALL, &resources)? })
    }

    /// Unit normal (x right, y up, z out) and, fourth, albedo |g| of each texel; (0, 0, 1) and 0 where all
    /// samples are black, or those not masked (with [`StereoMethod::Robust`], those neither masked nor black) have fewer
    /// than three lights or lights in a plane.
    ///
    /// `samples` holds linear radiance in reflectance units of one view, near the zenith, lit from
    /// each of `lights` in turn; a sample is masked where it is negative.
    ///
    /// # Errors
    /// [`StageError::TooFewLights`] or [`StageError::CoplanarLights`] if the lights do not determine a normal;
    /// [`StageError::Gpu`] if the result does not fit the adapter.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, samples: &Tile, lights: &[Direction], method: StereoMethod,
    ) -> Result<Buffer<[f32; 4]>, StageError> {
        let directions: Vec<DVec3> = lights.iter().map(|light| light.vector()).collect();
        check(&directions)?;
        let gpu = recorder.gpu();
        let params = Params {
            texels: count(samples.texels),
            octets: count(samples.octets()),
            steps: match method {
                StereoMethod::LeastSquares => 2,
                StereoMethod::Robust => 1 + stereo::REWEIGHTS,
            },
            robust: u32::from(method == StereoMethod::Robust),
            min_pivot: single(stereo::MIN_SPREAD * stereo::MIN_SPREAD),
            terminator: single(stereo::TERMINATOR),
            noise: single(stereo::NOISE),
        };
        let params = gpu.uniform("photometric stereo params", &params)?;
        let mut lights: Vec<[f32; 4]> = directions.iter().map(|light| light.as_vec3().extend(0.0).to_array()).collect();
        lights.resize(samples.octets() * OCTET, [0.0; 4]);
        let lights = gpu.upload("photometric stereo lights", &lights)?;
        let normals = gpu.fresh("measured normals", samples.texels)?;
        let binds = [bind("params", &params), bind("samples", &samples.values), bind("lights", &lights), bind("normals", &normals)];
        recorder.dispatch(&self.kernel, &binds, Grid::threads(samples.texels))?;
        Ok(normals)
    }
}

/// Whether these lights, none of them masked, determine a normal.
fn check(lights: &[DVec3]) -> Result<(), StageError> {
    let found = lights.len();
    if found < 3 {
        return Err(StageError::TooFewLights { found });
    }
    let normal_matrix = lights.iter().fold(DMat3::ZERO, |sum, &l| sum + DMat3::from_cols(l * l.x, l * l.y, l * l.z));
    // With eigenvalues a <= b <= c, abc/(ab + ac + bc) is within a third and the whole of a, the lights' summed squared
    // distance from the plane that fits them best, and thus below every pivot. A single direction gives 0/0.
    let trace = |m: DMat3| m.x_axis.x + m.y_axis.y + m.z_axis.z;
    let pairs = 0.5 * (trace(normal_matrix).powi(2) - trace(normal_matrix * normal_matrix));
    #[expect(clippy::cast_precision_loss, reason = "far fewer lights than 2^53")]
    let spread = (normal_matrix.determinant() / pairs / found as f64).max(0.0).sqrt();
    if spread < stereo::MIN_SPREAD {
        return Err(StageError::CoplanarLights { found, within: spread.asin().to_degrees() });
    }
    Ok(())
}
