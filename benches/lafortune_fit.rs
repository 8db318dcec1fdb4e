//! The reflectance of 2048 texels of a measured set on the adapter, beside `scipy.optimize.least_squares(method="lm")` on 64 of
//! them: `cargo bench --bench lafortune_fit -- SOURCE…`. Needs python3 with numpy and scipy.

use std::{env, error::Error, fs, path::Path, process::Command, time::Instant};

use half::f16;
use overpaint::{
    data::{OCTET, Samples},
    gpu::Gpu,
    io,
    model::FitSettings,
    stage,
};

const TEXELS: usize = 2048;
const CHOSEN: usize = 64;

fn main() -> Result<(), Box<dyn Error>> {
    let sources: Vec<String> = env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    if sources.is_empty() {
        println!("lafortune_fit: no sources given, nothing measured");
    }
    let gpu = Gpu::open(env::var("OVERPAINT_ADAPTER").ok().as_deref())?;
    for source in &sources {
        compare(&gpu, Path::new(source))?;
    }
    Ok(())
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

    let start = Instant::now();
    let mut recorder = gpu.recorder();
    let reflectance = brdf_values.record(&mut recorder, &radiance, &samples)?;
    let diffuse = percentile.record(&mut recorder, &reflectance, settings.diffuse_quantile)?;
    let residual = specular_residual.record(&mut recorder, &reflectance, &diffuse)?;
    let fitted = lafortune_fit.record(&mut recorder, &residual, &samples, texels, &settings)?;
    specular_scale.record(&mut recorder, &reflectance, &samples, &diffuse, &fitted.lobes, &settings)?;
    gpu.submit(recorder).wait(gpu)?;
    let seconds = start.elapsed().as_secs_f64();
    println!(
        "{}: {} samples, {:.0} texels/s from radiance to lobe and rho_s on {}",
        btf.name(),
        samples.len(),
        texels as f64 / seconds,
        gpu.adapter().name
    );

    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(btf.name());
    fs::create_dir_all(&folder)?;
    let (residual, lobes) = (residual.read(gpu)?, fitted.lobes.read(gpu)?);
    // Spread over the block by a step that shares no factor with its rows.
    let chosen: Vec<usize> = (0..CHOSEN).map(|index| index * 1_237 % texels).collect();
    let residual: Vec<f64> = chosen
        .iter()
        .flat_map(|&texel| (0..samples.len()).map(move |sample| (texel, sample)))
        .map(|(texel, sample)| f64::from(f16::to_f32(residual[sample / OCTET * texels + texel][sample % OCTET])))
        .collect();
    let lobes: Vec<f64> = chosen.iter().flat_map(|&texel| lobes[texel]).map(f64::from).collect();
    let products: Vec<f64> = samples.products().flatten().collect();
    fs::write(folder.join("residual.f64"), bytemuck::cast_slice(&residual))?;
    fs::write(folder.join("lobes.f64"), bytemuck::cast_slice(&lobes))?;
    fs::write(folder.join("products.f64"), bytemuck::cast_slice(&products))?;
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers/lafortune_fit.py");
    let [least, greatest] = settings.exponents;
    let status = Command::new("python3").arg(script).arg(&folder).args([least.to_string(), greatest.to_string()]).status()?;
    if status.success() { Ok(()) } else { Err("the peer failed; it needs python3 with numpy and scipy".into()) }
}
