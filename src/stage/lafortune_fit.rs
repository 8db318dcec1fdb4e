//! Levenberg-Marquardt fit of one Lafortune lobe a texel (Lafortune et al. 1997; thesis section 3.2.2, step 5). Kernels
//! `lafortune_energy`, `lafortune_start`, `lafortune_active`, `lafortune_sums`, `lafortune_fit` (one step), `lafortune_champion` and
//! `lafortune_result`, twin [`reference::lafortune_fit`](crate::reference::lafortune_fit).
//!
//! The thesis fits (C_x, C_y, C_z, n) as they stand. In these the amplitude |C|^n and the exponent are nearly dependent and
//! single precision stalls in the valley between them; as A·(k·p)^n with a direction k the same family of lobes has its
//! linear part apart, and the rest is well conditioned. The result is given as C and n again.
//!
//! The objective has more than one minimum: a highlight's, and others where the lobe traces the edges of shadows. So each texel
//! descends a little way from each of [`STARTS`] over a part of its samples, the better ones of these go on over all, and the best
//! of those goes on until it settles. List, sums and step are passes of their own: the list keeps the threads busy as fits
//! end, `lafortune_sums` is nearly all of the work and spreads over samples as well as fits, `lafortune_fit` is the step itself.
//!
//! [`LafortuneFit::record_framed`] fits lobes in the frames of seen normals to radiance, with `lafortune_framed_energy` and
//! `lafortune_framed_sums` in place of the kernels that see samples, twin [`reference::lafortune_framed`](crate::reference::lafortune_framed).
//!
//! Masked samples take no part: the objective is the mean over a texel's valid samples, and a texel with fewer than
//! [`MIN_LOBE_SAMPLES`] gets no lobe.

use half::f16;

use super::{
    scalar::{count, single},
    tile::{SampleDirections, upload_products},
};
use crate::{
    data::{OCTET, Samples},
    gpu::{Bind, Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
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
        mixed_nu: [f32; 2],
        objective: f32,
        amplitude: f32,
        damping: f32,
        growth: f32,
        foreseen: f32,
        energy: f32,
        status: u32,
        iterations: u32,
        constant: f32,
        _pad: u32,
    }
}
gpu_struct! {
    struct Gram {
        mm: [f32; 4],
        mr: [f32; 4],
        rr: [f32; 4],
        mx: [f32; 4],
        my: [f32; 4],
        mz: [f32; 4],
        ml: [f32; 4],
        rx: [f32; 4],
        ry: [f32; 4],
        rz: [f32; 4],
        rl: [f32; 4],
        xx: [f32; 4],
        yy: [f32; 4],
        zz: [f32; 4],
        ll: [f32; 4],
        xy: [f32; 4],
        xz: [f32; 4],
        yz: [f32; 4],
        xl: [f32; 4],
        yl: [f32; 4],
        zl: [f32; 4],
        cc: [f32; 4],
        cm: [f32; 4],
        cx: [f32; 4],
        cy: [f32; 4],
        cz: [f32; 4],
        cl: [f32; 4],
        cr: [f32; 4],
    }
}
gpu_struct! {
    struct Energy { valid: u32, sum: f32 }
}
gpu_struct! {
    struct EnergyParams { texels: u32, samples: u32, octets: u32, _pad: u32 }
}
gpu_struct! {
    struct StartParams { texels: u32, fits: u32, min_valid: u32, _pad: u32 }
}
gpu_struct! {
    struct ActiveParams { fits: u32, _pad0: u32, _pad1: u32, _pad2: u32 }
}
gpu_struct! {
    struct SumsParams { texels: u32, octets: u32, stride: u32, quads: u32 }
}
gpu_struct! {
    struct StepParams {
        quads: u32, slices: u32, tolerance: f32, min_exponent: f32, max_exponent: f32, _pad0: u32, _pad1: u32, _pad2: u32,
    }
}
gpu_struct! {
    struct ChampionParams { texels: u32, fits: u32, kept: u32, _pad: u32 }
}
gpu_struct! {
    struct ResultParams { texels: u32, _pad0: u32, _pad1: u32, _pad2: u32 }
}

/// Starting points (k, n): towards the mirrored light, broad and narrow, as a highlight wants; along the normal, as a
/// diffuse-like residue wants; and back to the light.
pub const STARTS: [[f32; 4]; 4] = [[-1.0, -1.0, 1.0, 1.0], [-1.0, -1.0, 1.0, 10.0], [0.0, 0.0, 1.0, 1.0], [1.0, 1.0, 1.0, 1.0]];

/// Fits that a thread of `lafortune_sums` sums for.
const FITS: usize = 4;

/// Visited octets that a thread of `lafortune_sums` sums over.
const SLICE: usize = 64;

/// Texels with fewer octets see all of them from the first step: a part of few samples says too little.
const MIN_COARSE_OCTETS: usize = 256;

/// Fits of each texel that go on from the part of the samples to all: the objective has a small minimum at many a sample where the
/// lobe ends, and the best of some descents is lower than one.
const KEPT: usize = 3;

/// One descent of all fits that are left.
#[derive(Debug, Clone, Copy)]
struct Descent {
    /// Fits of each texel.
    fits: usize,
    /// One of this many octets is visited.
    stride: usize,
    /// Steps at most.
    steps: u32,
    /// Relative decrease below which it has converged.
    tolerance: f64,
}

impl Descent {
    /// Parts that the visited octets of `octets` are summed in.
    fn slices(&self, octets: usize) -> usize {
        octets.div_ceil(self.stride).div_ceil(SLICE)
    }
}

/// The descents for `octets`.
fn descents(octets: usize, settings: &FitSettings) -> Vec<Descent> {
    let FitSettings { max_iterations, tolerance, .. } = *settings;
    let coarse = Descent { fits: STARTS.len(), stride: 4, steps: max_iterations.min(10), tolerance: 1e4 * tolerance };
    let all = Descent { fits: STARTS.len(), stride: 1, steps: max_iterations.min(15), tolerance: 1e2 * tolerance };
    let last = Descent { fits: 1, stride: 1, steps: max_iterations, tolerance };
    if octets < MIN_COARSE_OCTETS {
        return vec![all, last];
    }
    vec![coarse, Descent { fits: KEPT, ..all }, last]
}

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
    framed_energy: Kernel,
    start: Kernel,
    active: Kernel,
    sums: Kernel,
    framed_sums: Kernel,
    step: Kernel,
    champion: Kernel,
    result: Kernel,
}

impl LafortuneFit {
    /// Bytes that a fit keeps of each texel between its steps, beside what is small against its samples.
    pub const STATE_BYTES: usize = STARTS.len() * (size_of::<FitState>() + size_of::<Gram>() / FITS);

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
        let framed_energy = [
            Resource::uniform::<EnergyParams>("params"),
            Resource::read::<[f16; OCTET]>("shading"),
            Resource::read::<[f16; OCTET]>("residual"),
            Resource::read_write::<Energy>("energies"),
        ];
        let start = [
            Resource::uniform::<StartParams>("params"),
            Resource::read::<[f32; 4]>("starts"),
            Resource::read::<Energy>("energies"),
            Resource::read_write::<FitState>("states"),
        ];
        let active =
            [Resource::uniform::<ActiveParams>("params"), Resource::read::<FitState>("states"), Resource::read_write::<u32>("listed")];
        let sums = [
            Resource::uniform::<SumsParams>("params"),
            Resource::read::<[f32; 4]>("products"),
            Resource::read::<[f16; OCTET]>("residual"),
            Resource::read::<FitState>("states"),
            Resource::read::<u32>("listed"),
            Resource::read_write::<Gram>("grams"),
        ];
        let framed_sums = [
            Resource::uniform::<SumsParams>("params"),
            Resource::read::<SampleDirections>("directions"),
            Resource::read::<[f32; 4]>("seen_normals"),
            Resource::read::<[f16; OCTET]>("shading"),
            Resource::read::<[f16; OCTET]>("residual"),
            Resource::read::<FitState>("states"),
            Resource::read::<u32>("listed"),
            Resource::read_write::<Gram>("grams"),
        ];
        let step = [
            Resource::uniform::<StepParams>("params"),
            Resource::read::<Gram>("grams"),
            Resource::read_write::<FitState>("states"),
            Resource::read::<u32>("listed"),
        ];
        let champion = [Resource::uniform::<ChampionParams>("params"), Resource::read_write::<FitState>("states")];
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
            framed_energy: Kernel::new(gpu, &wgsl::LAFORTUNE_FRAMED_ENERGY, wgsl::ALL, &framed_energy)?,
            start: Kernel::new(gpu, &wgsl::LAFORTUNE_START, wgsl::ALL, &start)?,
            active: Kernel::new(gpu, &wgsl::LAFORTUNE_ACTIVE, wgsl::ALL, &active)?,
            sums: Kernel::new(gpu, &wgsl::LAFORTUNE_SUMS, wgsl::ALL, &sums)?,
            framed_sums: Kernel::new(gpu, &wgsl::LAFORTUNE_FRAMED_SUMS, wgsl::ALL, &framed_sums)?,
            step: Kernel::new(gpu, &wgsl::LAFORTUNE_FIT, wgsl::ALL, &step)?,
            champion: Kernel::new(gpu, &wgsl::LAFORTUNE_CHAMPION, wgsl::ALL, &champion)?,
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
        let products = upload_products(recorder.gpu(), samples)?;
        let data = Data {
            energy: (&self.energy, vec![bind("residual", residual)]),
            sums: (&self.sums, vec![bind("products", &products), bind("residual", residual)]),
            samples: samples.len(),
            texels,
        };
        self.fit(recorder, data, settings)
    }

    /// Fits a lobe in the frames of `normals` `[row][texel]` to each texel's `residual` radiance `[octet][texel]`, and a change of the
    /// diffuse part along with it, under `shading` `[octet][texel]`; both are 0 where a sample is masked or unlit. The objective is in
    /// radiance, over the lit samples.
    ///
    /// # Errors
    /// [`GpuError`] if a result does not fit the adapter.
    #[expect(clippy::too_many_arguments, reason = "what makes a sample in a frame")]
    pub fn record_framed(
        &self, recorder: &mut Recorder<'_>, residual: &Buffer<[f16; OCTET]>, shading: &Buffer<[f16; OCTET]>,
        directions: &Buffer<SampleDirections>, normals: &Buffer<[f32; 4]>, texels: usize, settings: &FitSettings,
    ) -> Result<FittedLobes, GpuError> {
        let data = Data {
            energy: (&self.framed_energy, vec![bind("shading", shading), bind("residual", residual)]),
            sums: (
                &self.framed_sums,
                vec![bind("directions", directions), bind("seen_normals", normals), bind("shading", shading), bind("residual", residual)],
            ),
            samples: directions.len(),
            texels,
        };
        self.fit(recorder, data, settings)
    }

    fn fit(&self, recorder: &mut Recorder<'_>, data: Data<'_>, settings: &FitSettings) -> Result<FittedLobes, GpuError> {
        let descents = descents(data.octets(), settings);
        let fits = Fits::new(recorder.gpu(), self, data, &descents, settings)?;
        fits.start(recorder, &STARTS)?;
        let mut left = STARTS.len();
        for (index, descent) in descents.into_iter().enumerate() {
            if index > 0 {
                fits.keep(recorder, left, descent.fits)?;
            }
            left = descent.fits;
            fits.descend(recorder, descent)?;
        }
        fits.result(recorder)
    }

    /// The lobe (k, n) of `given` for each texel, its amplitude alone fitted to the mean specular residual.
    ///
    /// # Errors
    /// [`GpuError`] if a result does not fit the adapter.
    pub fn record_given(
        &self, recorder: &mut Recorder<'_>, residual: &Buffer<[f16; OCTET]>, samples: &Samples, texels: usize, given: [f32; 4],
        settings: &FitSettings,
    ) -> Result<FittedLobes, GpuError> {
        let products = upload_products(recorder.gpu(), samples)?;
        let data = Data {
            energy: (&self.energy, vec![bind("residual", residual)]),
            sums: (&self.sums, vec![bind("products", &products), bind("residual", residual)]),
            samples: samples.len(),
            texels,
        };
        let evaluation = Descent { fits: 1, stride: 1, steps: 1, tolerance: 0.0 };
        let fits = Fits::new(recorder.gpu(), self, data, &[evaluation], settings)?;
        fits.start(recorder, &[given])?;
        fits.descend(recorder, evaluation)?;
        fits.result(recorder)
    }
}

/// What lobes are fitted to: the kernels that see the samples and what these read beside the state of the fits.
struct Data<'a> {
    energy: (&'a Kernel, Vec<Bind<'a>>),
    sums: (&'a Kernel, Vec<Bind<'a>>),
    samples: usize,
    texels: usize,
}

impl Data<'_> {
    fn octets(&self) -> usize {
        self.samples.div_ceil(OCTET)
    }
}

/// The fits of a tile.
struct Fits<'a> {
    stage: &'a LafortuneFit,
    data: Data<'a>,
    energies: Buffer<Energy>,
    states: Buffer<FitState>,
    listed: Buffer<u32>,
    grams: Buffer<Gram>,
    exponents: [f32; 2],
}

impl<'a> Fits<'a> {
    fn new(gpu: &Gpu, stage: &'a LafortuneFit, data: Data<'a>, descents: &[Descent], settings: &FitSettings) -> Result<Self, GpuError> {
        let (texels, octets) = (data.texels, data.octets());
        let grams = descents.iter().map(|descent| (descent.fits * texels).div_ceil(FITS) * descent.slices(octets));
        Ok(Self {
            stage,
            energies: gpu.fresh("energies", texels)?,
            states: gpu.fresh("fit states", STARTS.len() * texels)?,
            listed: gpu.fresh("running fits", 1 + STARTS.len() * texels)?,
            grams: gpu.fresh("Gram matrices", grams.max().unwrap_or(1))?,
            data,
            exponents: settings.exponents.map(single),
        })
    }

    /// Begins a fit at each of `starts` of each texel.
    fn start(&self, recorder: &mut Recorder<'_>, starts: &[[f32; 4]]) -> Result<(), GpuError> {
        let gpu = recorder.gpu();
        let Data { energy: (kernel, reads), samples, texels, .. } = &self.data;
        let params = EnergyParams { texels: count(*texels), samples: count(*samples), octets: count(self.data.octets()), _pad: 0 };
        let params = gpu.uniform("lafortune_energy params", &params)?;
        let energy = [reads.as_slice(), &[bind("params", &params), bind("energies", &self.energies)]].concat();
        recorder.dispatch(kernel, &energy, Grid::threads(*texels))?;
        let [least, greatest] = self.exponents;
        let fits = starts.len() * texels;
        let starts: Vec<_> = starts.iter().map(|&[x, y, z, exponent]| [x, y, z, exponent.clamp(least, greatest)]).collect();
        let starts = gpu.upload("starts", &starts)?;
        let params = StartParams { texels: count(*texels), fits: count(fits), min_valid: MIN_LOBE_SAMPLES, _pad: 0 };
        let params = gpu.uniform("lafortune_start params", &params)?;
        recorder.dispatch(
            &self.stage.start,
            &[bind("params", &params), bind("starts", &starts), bind("energies", &self.energies), bind("states", &self.states)],
            Grid::threads(fits),
        )
    }

    /// One descent of each texel's first fits.
    fn descend(&self, recorder: &mut Recorder<'_>, descent: Descent) -> Result<(), GpuError> {
        let gpu = recorder.gpu();
        let Data { sums: (kernel, reads), texels, .. } = &self.data;
        let (fits, octets) = (descent.fits * texels, self.data.octets());
        let (quads, slices) = (fits.div_ceil(FITS), descent.slices(octets));
        let params = ActiveParams { fits: count(fits), ..ActiveParams::default() };
        let params = gpu.uniform("lafortune_active params", &params)?;
        let active = [bind("params", &params), bind("states", &self.states), bind("listed", &self.listed)];

        let params = SumsParams { texels: count(*texels), octets: count(octets), stride: count(descent.stride), quads: count(quads) };
        let params = gpu.uniform("lafortune_sums params", &params)?;
        let own = [bind("params", &params), bind("states", &self.states), bind("listed", &self.listed), bind("grams", &self.grams)];
        let sums = [reads.as_slice(), &own].concat();

        let [min_exponent, max_exponent] = self.exponents;
        let params = StepParams {
            quads: count(quads),
            slices: count(slices),
            tolerance: single(descent.tolerance),
            min_exponent,
            max_exponent,
            ..StepParams::default()
        };
        let params = gpu.uniform("lafortune_fit params", &params)?;
        let step = [bind("params", &params), bind("grams", &self.grams), bind("states", &self.states), bind("listed", &self.listed)];
        for _ in 0..descent.steps {
            recorder.dispatch(&self.stage.active, &active, Grid::threads(1))?;
            recorder.dispatch(kernel, &sums, Grid::layers(quads, count(slices)))?;
            recorder.dispatch(&self.stage.step, &step, Grid::threads(fits))?;
        }
        Ok(())
    }

    /// Goes on from the best `kept` of each texel's `fits`.
    fn keep(&self, recorder: &mut Recorder<'_>, fits: usize, kept: usize) -> Result<(), GpuError> {
        let gpu = recorder.gpu();
        let params = ChampionParams { texels: count(self.data.texels), fits: count(fits), kept: count(kept), _pad: 0 };
        let params = gpu.uniform("lafortune_champion params", &params)?;
        recorder.dispatch(&self.stage.champion, &[bind("params", &params), bind("states", &self.states)], Grid::threads(self.data.texels))
    }

    /// Reads the one fit that is left of each texel.
    fn result(&self, recorder: &mut Recorder<'_>) -> Result<FittedLobes, GpuError> {
        let gpu = recorder.gpu();
        let params =
            gpu.uniform("lafortune_result params", &ResultParams { texels: count(self.data.texels), ..ResultParams::default() })?;
        let fitted = FittedLobes {
            lobes: gpu.fresh("lobes", self.data.texels)?,
            objectives: gpu.fresh("objectives", self.data.texels)?,
            outcomes: gpu.fresh("outcomes", self.data.texels)?,
        };
        let binds = [
            bind("params", &params),
            bind("states", &self.states),
            bind("energies", &self.energies),
            bind("lobes", &fitted.lobes),
            bind("objectives", &fitted.objectives),
            bind("outcomes", &fitted.outcomes),
        ];
        recorder.dispatch(&self.stage.result, &binds, Grid::threads(self.data.texels))?;
        Ok(fitted)
    }
}
