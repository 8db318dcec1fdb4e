//! Normals and albedo by photometric stereo. Kernel `photometric_stereo`, twin
//! [`reference::photometric_stereo`](crate::reference::photometric_stereo).
//!
//! Plain least squares over all lights of one view (Rushmeier, Taubin and Guéziec 1997; thesis eq. 3.1, 3.2): the directions
//! are shared by all texels, so their pseudo-inverse is taken once, here, in f64. Shadows and highlights are in the sum like
//! any other sample and pull the normal.

use glam::{DMat3, DVec3};
use half::f16;

use super::{StageError, Tile, scalar::count};
use crate::{
    data::{Direction, OCTET},
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, wgsl,
};

gpu_struct! {
    struct Params { texels: u32, octets: u32 }
}

/// Lights nearer than this to a plane through the surface's point cannot tell normals apart: about half a degree, the
/// rounding of angles given in whole degrees.
const MIN_SPREAD: f64 = 0.01;

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
            Resource::read::<[f32; 4]>("weights"),
            Resource::read_write::<[f32; 4]>("normals"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::PHOTOMETRIC_STEREO, wgsl::ALL, &resources)? })
    }

    /// Unit normal (x right, y up, z out) and, fourth, albedo |g| of each texel; (0, 0, 1) and 0 where all
    /// samples are black.
    ///
    /// `samples` holds linear radiance in reflectance units of one view, near the zenith, lit from
    /// each of `lights` in turn.
    ///
    /// # Errors
    /// [`StageError::TooFewLights`] or [`StageError::CoplanarLights`] if the lights do not determine a normal;
    /// [`StageError::Gpu`] if the result does not fit the adapter.
    pub fn record(&self, recorder: &mut Recorder<'_>, samples: &Tile, lights: &[Direction]) -> Result<Buffer<[f32; 4]>, StageError> {
        let weights = weights(lights)?;
        let gpu = recorder.gpu();
        let params = Params { texels: count(samples.texels), octets: count(samples.octets()) };
        let params = gpu.uniform("photometric stereo params", &params)?;
        let weights = gpu.upload("photometric stereo weights", &weights)?;
        let normals = gpu.fresh("measured normals", samples.texels)?;
        let binds = [bind("params", &params), bind("samples", &samples.values), bind("weights", &weights), bind("normals", &normals)];
        recorder.dispatch(&self.kernel, &binds, Grid::threads(samples.texels))?;
        Ok(normals)
    }
}

/// The columns of (LᵀL)⁻¹Lᵀ, one a light, padded with zeros to whole octets.
fn weights(lights: &[Direction]) -> Result<Vec<[f32; 4]>, StageError> {
    let found = lights.len();
    if found < 3 {
        return Err(StageError::TooFewLights { found });
    }
    let directions: Vec<DVec3> = lights.iter().map(|light| light.vector()).collect();
    let normal_matrix = directions.iter().fold(DMat3::ZERO, |sum, &l| sum + DMat3::from_cols(l * l.x, l * l.y, l * l.z));
    // With eigenvalues a <= b <= c, abc/(ab + ac + bc) is within a third and the whole of a, the lights' summed squared
    // distance from the plane that fits them best. A single direction gives 0/0.
    let trace = |m: DMat3| m.x_axis.x + m.y_axis.y + m.z_axis.z;
    let pairs = 0.5 * (trace(normal_matrix).powi(2) - trace(normal_matrix * normal_matrix));
    #[expect(clippy::cast_precision_loss, reason = "far fewer lights than 2^53")]
    let spread = (normal_matrix.determinant() / pairs / found as f64).max(0.0).sqrt();
    if spread < MIN_SPREAD {
        return Err(StageError::CoplanarLights { found, within: spread.asin().to_degrees() });
    }
    let inverse = normal_matrix.inverse();
    let mut weights: Vec<[f32; 4]> = directions.iter().map(|&l| (inverse * l).as_vec3().extend(0.0).to_array()).collect();
    weights.resize(found.next_multiple_of(OCTET), [0.0; 4]);
    Ok(weights)
}
