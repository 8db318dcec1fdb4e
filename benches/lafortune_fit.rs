//! The reflectance of 2048 texels of a measured set on the adapter, beside the same fits by what people would use instead:
//! `cargo bench --bench lafortune_fit -- SOURCE…`. Needs python3 with numpy and scipy.
//!
//! The adapter's time runs from radiance to lobe and ρ_s (reflectance, percentile, residual, fit, scale), the peers' from residual
//! to lobe, each once its code is compiled. Objectives are those of the peers' texels, in double precision, by one function for all.

mod peers {
    pub mod crate_lm;
    pub mod native;
}

use std::{env, error::Error, fs, path::Path, process::Command, time::Instant};

use half::f16;
use overpaint::{
    data::{OCTET, Samples},
    gpu::Gpu,
    io,
    model::{FitSettings, lafortune},
    stage,
};

const TEXELS: usize = 2048;
const CHOSEN: usize = 64;

fn main() -> Result<(), Box<dyn Error>> {
    let sources: Vec<String> = env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    if sources.is_empty() {
        println!("lafortune_fit: no sources given, nothing measured");
        return Ok(());
    }
    let gpu = Gpu::open(env::var("OVERPAINT_ADAPTER").ok().as_deref())?;
    let system = sysinfo::System::new_with_specifics(sysinfo::RefreshKind::nothing().with_cpu(sysinfo::CpuRefreshKind::nothing()));
    let cpu = system.cpus().first().map_or("unknown", |cpu| cpu.brand());
    println!("adapter: {}; CPU: {cpu}, {} cores", gpu.adapter().name, rayon::current_num_threads());
    for source in &sources {
        compare(&gpu, Path::new(source))?;
    }
    Ok(())
}

/// Fits a second and the lobes (C_x, C_y, C_z, n).
type Timed = (f64, Vec<[f64; 4]>);

/// The residuals of some texels, `[texel][sample]`, and what they are fitted with.
struct Problem {
    products: Vec<[f64; 3]>,
    residuals: Vec<f64>,
    settings: FitSettings,
}

impl Problem {
    /// Mean squared residual of each texel.
    fn objectives(&self, lobes: &[[f64; 4]]) -> Vec<f64> {
        let objective = |(residual, lobe): (&[f64], &[f64; 4])| {
            let squares = self.products.iter().zip(residual).map(|(product, s)| (lafortune(*lobe, *product) - s).powi(2));
            squares.sum::<f64>() / residual.len() as f64
        };
        self.residuals.chunks(self.products.len()).zip(lobes).map(objective).collect()
    }

    /// A row of the table: objectives of `lobes` over `ours`.
    fn row(&self, what: &str, fits_a_second: f64, lobes: &[[f64; 4]], ours: &[f64]) {
        let theirs = self.objectives(lobes);
        let mut ratios: Vec<f64> = theirs.iter().zip(ours).map(|(theirs, ours)| theirs / ours.max(1e-30)).collect();
        ratios.sort_by(f64::total_cmp);
        let not_better = ratios.iter().filter(|ratio| 1.0 <= 1.001 * **ratio).count() as f64 / ratios.len() as f64;
        println!(
            "  {what:<44}{fits_a_second:>9.0}{:>11.4}{:>11.4}{:>14.1} %",
            theirs.iter().sum::<f64>() / ours.iter().sum::<f64>(),
            ratios[ratios.len() / 2],
            100.0 * not_better,
        );
    }
}

/// What `work` gives, with the fits a second.
fn timed(fits: usize, work: impl FnOnce() -> Result<Vec<[f64; 4]>, Box<dyn Error>>) -> Result<Timed, Box<dyn Error>> {
    let start = Instant::now();
    let lobes = work()?;
    Ok((fits as f64 / start.elapsed().as_secs_f64(), lobes))
}

fn compare(gpu: &Gpu, path: &Path) -> Result<(), Box<dyn Error>> {
    let source = io::open(path)?;
    let btf = source.btf();
    let samples = Samples::new((0..btf.pairs().len()).map(|sample| btf.directions(sample)).collect());
    let texels = TEXELS.min(btf.texels());
    let mut values = vec![[f16::ZERO; OCTET]; 3 * samples.octets() * texels];
    for sample in 0..samples.len() {
        for (texel, rgb) in source.picture(sample)?.values()[..texels].iter().enumerate() {
            for (channel, &value) in rgb.iter().enumerate() {
                values[(channel * samples.octets() + sample / OCTET) * texels + texel][sample % OCTET] = f16::from_f32(value);
            }
        }
    }

    let settings = FitSettings::default();
    let brdf_values = stage::BrdfValues::new(gpu)?;
    let (percentile, specular_residual) = (stage::Percentile::new(gpu)?, stage::SpecularResidual::new(gpu)?);
    let (lafortune_fit, specular_scale) = (stage::LafortuneFit::new(gpu)?, stage::SpecularScale::new(gpu)?);
    let radiance = stage::Tile { values: gpu.upload("radiance", &values)?, texels, samples: samples.len() };

    let run = || -> Result<_, Box<dyn Error>> {
        let start = Instant::now();
        let mut recorder = gpu.recorder();
        let reflectance = brdf_values.record(&mut recorder, &radiance, &samples)?;
        let diffuse = percentile.record(&mut recorder, &reflectance, settings.diffuse_quantile)?;
        let residual = specular_residual.record(&mut recorder, &reflectance, &diffuse)?;
        let fitted = lafortune_fit.record(&mut recorder, &residual, &samples, texels, &settings)?;
        specular_scale.record(&mut recorder, &reflectance, &samples, &diffuse, &fitted.lobes, &settings)?;
        gpu.submit(recorder).wait(gpu)?;
        Ok((start.elapsed().as_secs_f64(), residual, fitted))
    };
    // The first run has the driver compile the kernels.
    run()?;
    let (seconds, residual, fitted) = run()?;

    let (residual, lobes) = (residual.read(gpu)?, fitted.lobes.read(gpu)?);
    // Spread over the block by a step that shares no factor with its rows.
    let chosen: Vec<usize> = (0..CHOSEN).map(|index| index * 1_237 % texels).collect();
    let problem = Problem {
        products: samples.products().collect(),
        residuals: chosen
            .iter()
            .flat_map(|&texel| (0..samples.len()).map(move |sample| (texel, sample)))
            .map(|(texel, sample)| f64::from(f16::to_f32(residual[sample / OCTET * texels + texel][sample % OCTET])))
            .collect(),
        settings,
    };
    let lobes: Vec<[f64; 4]> = chosen.iter().map(|&texel| lobes[texel].map(f64::from)).collect();
    let ours = problem.objectives(&lobes);

    println!("{}: {} samples, {CHOSEN} of {texels} texels compared", btf.name(), samples.len());
    println!("  {:<44}{:>9}{:>11}{:>11}{:>16}", "", "fits/s", "mean E", "median E", "E >= ours/1.001");
    problem.row("overpaint, radiance to rho_s", texels as f64 / seconds, &lobes, &ours);
    let [least, greatest] = problem.settings.exponents;
    let (rate, lobes) = scipy(&problem, &Path::new(env!("CARGO_TARGET_TMPDIR")).join(btf.name()))?;
    problem.row("scipy, MINPACK f64, one thread, one start", rate, &lobes, &ours);
    let (products, residuals) = (&problem.products, &problem.residuals);
    let (rate, lobes) = timed(CHOSEN, || Ok(peers::crate_lm::fit(products, residuals, [least, greatest])))?;
    problem.row("levenberg-marquardt f64, one thread, one start", rate, &lobes, &ours);
    let (rate, lobes) = timed(CHOSEN, || Ok(peers::crate_lm::fit_on_all_cores(products, residuals, [least, greatest])))?;
    problem.row("levenberg-marquardt f64, all cores, one start", rate, &lobes, &ours);
    #[expect(clippy::cast_possible_truncation, reason = "single precision is what this peer works in")]
    let exponents = [least as f32, greatest as f32];
    let native = |starts: &[[f32; 4]]| {
        let FitSettings { max_iterations, tolerance, .. } = problem.settings;
        timed(CHOSEN, || Ok(peers::native::fit(products, residuals, starts, exponents, max_iterations, tolerance)))
    };
    let (rate, lobes) = native(&stage::STARTS)?;
    problem.row("native f32, all cores, our starts", rate, &lobes, &ours);
    let (rate, lobes) = native(&stage::STARTS[..1])?;
    problem.row("native f32, all cores, one start", rate, &lobes, &ours);
    Ok(())
}

/// Fits a second and lobes of `scipy.optimize.least_squares(method="lm")`, by way of files in `folder`.
fn scipy(problem: &Problem, folder: &Path) -> Result<Timed, Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    fs::write(folder.join("residual.f64"), bytemuck::cast_slice(&problem.residuals))?;
    fs::write(folder.join("products.f64"), bytemuck::cast_slice(problem.products.as_flattened()))?;
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers/lafortune_fit.py");
    let exponents = problem.settings.exponents.map(|exponent| exponent.to_string());
    let output = Command::new("python3").arg(script).arg(folder).args(exponents).output()?;
    if !output.status.success() {
        return Err(format!("the peer failed; it needs python3 with numpy and scipy: {}", String::from_utf8_lossy(&output.stderr)).into());
    }
    let seconds: f64 = String::from_utf8(output.stdout)?.trim().parse()?;
    let lobes: Vec<[f64; 4]> = bytemuck::pod_collect_to_vec(&fs::read(folder.join("lobes.f64"))?);
    Ok((lobes.len() as f64 / seconds, lobes))
}
