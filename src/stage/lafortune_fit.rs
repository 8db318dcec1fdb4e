//! Levenberg-Marquardt fit of one Lafortune lobe a texel (Lafortune et al. 1997; thesis section 3.2.2, step 5). Kernels
//! `lafortune_energy`, `lafortune_start`, `lafortune_active`, `lafortune_fit` (one step) and `lafortune_result`, twin
//! [`reference::lafortune_fit`](crate::reference::lafortune_fit).
//!
//! The thesis fits (C_x, C_y, C_z, n) as they stand. In these the amplitude |C|^n and the exponent are nearly dependent and
//! single precision stalls in the valley between them; as A·(k·p)^n with a unit vector k the same family of lobes has its
//! linear part apart, and the rest is well conditioned. The result is given as C and n again.
//!
//! The objective has more than one minimum: a highlight's, and others where the lobe traces the edges of shadows. So each
//! texel descends a little way from each of [`STARTS`], and the best of those points goes on until it settles. A descent is a
//! fixed number of passes; every [`STEPS_A_LIST`]th is preceded by a new list of the texels that still run, so that threads
//! side by side all have work.
//!
//! Masked samples take no part: the objective is the mean over a texel's valid samples, and a texel with fewer than
//! [`MIN_LOBE_SAMPLES`] gets no lobe.

use half::f16;

use super::{
    scalar::{count, single},
    tile::upload_products,
};
use crate::{
    data::{OCTET, Samples},
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::{FitSettings, MIN_LOBE_SAMPLES},
    wgsl,
};

gpu_struct! {
    struct FitState {
        point: [f32; 4],
        candidate: [f32; 4],
        diagonal: [f32; 4],
        mixed: [f32; 4],
        gradient: [f32; 4],
        champion: [f32; 4],
        mixed_nu: [f32; 2],
        objective: f32,
        amplitude: f32,
        damping: f32,
        growth: f32,
        foreseen: f32,
        champion_objective: f32,
        energy: f32,
        status: u32,
        iterations: u32,
        champion_amplitude: f32,
    }
}
gpu_struct! {
    struct Energy { valid: u32, sum: f32 }
}
gpu_struct! {
    struct EnergyParams { texels: u32, samples: u32, octets: u32, _pad: u32 }
}
gpu_struct! {
    struct StartParams { start: [f32; 4], texels: u32, first: u32, min_valid: u32, _pad: u32 }
}
gpu_struct! {
    struct StepParams {
        texels: u32, octets: u32, tolerance: f32, min_exponent: f32, max_exponent: f32, _pad0: u32, _pad1: u32, _pad2: u32,
    }
}
gpu_struct! {
    struct ActiveParams { texels: u32, _pad0: u32, _pad1: u32, _pad2: u32 }
}
gpu_struct! {
    struct ResultParams { texels: u32, _pad0: u32, _pad1: u32, _pad2: u32 }
}

/// Starting points (k, n): towards the mirrored light, broad and narrow, as a highlight wants; along the normal, as a
/// diffuse-like residue wants; and back to the light.
pub const STARTS: [[f32; 4]; 4] = [
    [-0.577_350_26, -0.577_350_26, 0.577_350_26, 1.0],
    [-0.577_350_26, -0.577_350_26, 0.577_350_26, 10.0],
    [0.0, 0.0, 1.0, 1.0],
    [0.577_350_26, 0.577_350_26, 0.577_350_26, 1.0],
];

/// Steps of each descent that looks for the best start.
const EXPLORING_STEPS: u32 = 15;

/// Steps between two lists of the running texels: a list costs a small part of a step.
const STEPS_A_LIST: u32 = 4;

/// How much coarser than the last descent's its tolerance is.
const EXPLORING_TOLERANCE: f64 = 100.0;

/// What the fit of a tile gives.
#[derive(Debug)]
pub struct FittedLobes {
    /// `[texel]` (C_x, C_y, C_z, n); C = 0 and n = 1 without a lobe.
    pub lobes: Buffer<[f32; 4]>,
    /// `[texel]` mean squared residual of the valid samples without a lobe and with it, reflectance²; 0 without valid samples.
    pub objectives: Buffer<[f32; 2]>,
    /// `[texel]` [`FitStatus`](crate::data::FitStatus) code and steps tried.
    pub outcomes: Buffer<[u32; 2]>,
}

/// The stage's kernels on one device.
#[derive(Debug)]
pub struct LafortuneFit {
    energy: Kernel,
    start: Kernel,
    active: Kernel,
    step: Kernel,
    result: Kernel,
}

impl LafortuneFit {
    /// Bytes that a fit keeps of each texel between its steps.
    pub const STATE_BYTES: usize = size_of::<FitState>();

    /// Builds the kernels.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses one.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let energy = [
            Resource::uniform::<EnergyParams>("params"),
            Resource::read::<[f16; OCTET]>("residual"),
            Resource::read_write::<Energy>("energies"),
        ];
        let start =
            [Resource::uniform::<StartParams>("params"), Resource::read::<Energy>("energies"), Resource::read_write::<FitState>("states")];
        let active =
            [Resource::uniform::<ActiveParams>("params"), Resource::read::<FitState>("states"), Resource::read_write::<u32>("listed")];
        let step = [
            Resource::uniform::<StepParams>("params"),
            Resource::read::<[f32; 4]>("products"),
            Resource::read::<[f16; OCTET]>("residual"),
            Resource::read_write::<FitState>("states"),
            Resource::read::<u32>("listed"),
        ];
        let result = [
            Resource::uniform::<ResultParams>("params"),
            Resource::read::<FitState>("states"),
            Resource::read::<Energy>("energies"),
            Resource::read_write::<[f32; 4]>("lobes"),
            Resource::read_write::<[f32; 2]>("objectives"),
            Resource::read_write::<[u32; 2]>("outcomes"),
        ];
        Ok(Self {
            energy: Kernel::new(gpu, &wgsl::LAFORTUNE_ENERGY, wgsl::ALL, &energy)?,
            start: Kernel::new(gpu, &wgsl::LAFORTUNE_START, wgsl::ALL, &start)?,
            active: Kernel::new(gpu, &wgsl::LAFORTUNE_ACTIVE, wgsl::ALL, &active)?,
            step: Kernel::new(gpu, &wgsl::LAFORTUNE_FIT, wgsl::ALL, &step)?,
            result: Kernel::new(gpu, &wgsl::LAFORTUNE_RESULT, wgsl::ALL, &result)?,
        })
    }

    /// Fits a lobe to each texel's mean specular residual `[octet][texel]`, negative where masked.
    ///
    /// # Errors
    /// [`GpuError`] if a result does not fit the adapter.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, residual: &Buffer<[f16; OCTET]>, samples: &Samples, texels: usize, settings: &FitSettings,
    ) -> Result<FittedLobes, GpuError> {
        let gpu = recorder.gpu();
        let descents = Descents {
            stage: self,
            products: upload_products(gpu, samples)?,
            residual,
            energies: gpu.fresh("energies", texels)?,
            states: gpu.fresh("fit states", texels)?,
            listed: gpu.fresh("running texels", 1 + texels)?,
            texels,
            octets: samples.octets(),
            settings,
        };
        let params = EnergyParams {
            texels: count(texels),
            samples: count(samples.len()),
            octets: count(samples.octets()),
            ..EnergyParams::default()
        };
        let params = gpu.uniform("lafortune_energy params", &params)?;
        recorder.dispatch(
            &self.energy,
            &[bind("params", &params), bind("residual", residual), bind("energies", &descents.energies)],
            Grid::threads(texels),
        )?;
        let [least, greatest] = settings.exponents.map(single);
        for (index, [x, y, z, exponent]) in STARTS.into_iter().enumerate() {
            let start = [x, y, z, exponent.clamp(least, greatest)];
            descents.record(
                recorder,
                start,
                index == 0,
                settings.max_iterations.min(EXPLORING_STEPS),
                EXPLORING_TOLERANCE * settings.tolerance,
            )?;
        }
        let champion = [0.0; 4];
        descents.record(recorder, champion, false, settings.max_iterations, settings.tolerance)?;

        let params = gpu.uniform("lafortune_result params", &ResultParams { texels: count(texels), ..ResultParams::default() })?;
        let fitted = FittedLobes {
            lobes: gpu.fresh("lobes", texels)?,
            objectives: gpu.fresh("objectives", texels)?,
            outcomes: gpu.fresh("outcomes", texels)?,
        };
        let binds = [
            bind("params", &params),
            bind("states", &descents.states),
            bind("energies", &descents.energies),
            bind("lobes", &fitted.lobes),
            bind("objectives", &fitted.objectives),
            bind("outcomes", &fitted.outcomes),
        ];
        recorder.dispatch(&self.result, &binds, Grid::threads(texels))?;
        Ok(fitted)
    }
}

/// What all descents of a tile share.
struct Descents<'a> {
    stage: &'a LafortuneFit,
    products: Buffer<[f32; 4]>,
    residual: &'a Buffer<[f16; OCTET]>,
    energies: Buffer<Energy>,
    states: Buffer<FitState>,
    listed: Buffer<u32>,
    texels: usize,
    octets: usize,
    settings: &'a FitSettings,
}

impl Descents<'_> {
    /// One descent from `start`, of at most `steps`.
    fn record(&self, recorder: &mut Recorder<'_>, start: [f32; 4], first: bool, steps: u32, tolerance: f64) -> Result<(), GpuError> {
        let gpu = recorder.gpu();
        let params = StartParams {
            start,
            texels: count(self.texels),
            first: u32::from(first),
            min_valid: MIN_LOBE_SAMPLES,
            ..StartParams::default()
        };
        let params = gpu.uniform("lafortune_start params", &params)?;
        recorder.dispatch(
            &self.stage.start,
            &[bind("params", &params), bind("energies", &self.energies), bind("states", &self.states)],
            Grid::threads(self.texels),
        )?;

        let params = ActiveParams { texels: count(self.texels), ..ActiveParams::default() };
        let params = gpu.uniform("lafortune_active params", &params)?;
        let active = [bind("params", &params), bind("states", &self.states), bind("listed", &self.listed)];

        let params = StepParams {
            texels: count(self.texels),
            octets: count(self.octets),
            tolerance: single(tolerance),
            min_exponent: single(self.settings.exponents[0]),
            max_exponent: single(self.settings.exponents[1]),
            ..StepParams::default()
        };
        let params = gpu.uniform("lafortune_fit params", &params)?;
        let step = [
            bind("params", &params),
            bind("products", &self.products),
            bind("residual", self.residual),
            bind("states", &self.states),
            bind("listed", &self.listed),
        ];
        for index in 0..steps {
            if index.is_multiple_of(STEPS_A_LIST) {
                recorder.dispatch(&self.stage.active, &active, Grid::threads(1))?;
            }
            recorder.dispatch(&self.stage.step, &step, Grid::threads(self.texels))?;
        }
        Ok(())
    }
}
