//! Time of the stages from radiance to lobe and ρ_s by texels and by samples: `cargo bench --bench svbrdf_scaling`.
//!
//! Made data: a lobe over a diffuse part, with noise, for each of 256 materials that repeat over the texels, so that texels are alike
//! in difficulty whatever their number. Texels at 2601 samples, in tiles as large as the adapter binds; samples at 1024 texels.

use std::{env, error::Error, time::Instant};

use half::f16;
use overpaint::{
    data::{Grid, OCTET, Samples},
    gpu::Gpu,
    model::{FitSettings, lafortune},
    stage,
};
use rayon::prelude::*;

const MATERIALS: usize = 256;

fn main() -> Result<(), Box<dyn Error>> {
    let gpu = Gpu::open(env::var("OVERPAINT_ADAPTER").ok().as_deref())?;
    println!("radiance to lobe and rho_s on {}", gpu.adapter().name);
    println!("{:>9}{:>9}{:>7}{:>11}{:>15}{:>20}", "samples", "texels", "tiles", "seconds", "us a texel", "ns a texel sample");
    let chain = Chain::new(&gpu)?;
    let thesis = directions("thesis51")?;
    // The first row has the driver compile the kernels.
    for texels in [1 << 8, 1 << 10, 1 << 12, 1 << 14, 1 << 16] {
        chain.measure(&thesis, texels)?;
    }
    for grid in ["thesis51", "ubo81", "ubo151"] {
        chain.measure(&directions(grid)?, 1 << 10)?;
    }
    Ok(())
}

/// All pairs of a grid's directions, as view and as light.
fn directions(grid: &str) -> Result<Samples, Box<dyn Error>> {
    let directions = grid.parse::<Grid>()?.directions();
    Ok(Samples::new(directions.iter().flat_map(|&view| directions.iter().map(move |&light| (view, light))).collect()))
}

/// A number from 0 to 1 that looks random (Steele, Lea, Flood 2014).
fn noise(seed: u64) -> f64 {
    let mut z = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z >> 11) as f64 / (1u64 << 53) as f64
}

/// Radiance of each material, `[sample][material]`.
fn radiance(samples: &Samples) -> Vec<[f64; MATERIALS]> {
    let lobes: Vec<[f64; 4]> = (0..MATERIALS as u64)
        .map(|material| {
            let between = |index: u64, low: f64, high: f64| low + (high - low) * noise(8 * material + index);
            let scale = between(0, 0.7, 1.0);
            [-scale, -scale * between(1, 0.9, 1.1), scale * between(2, 0.7, 1.1), between(3, 1.5, 20.0)]
        })
        .collect();
    let products: Vec<[f64; 3]> = samples.products().collect();
    let cosines: Vec<f64> = samples.light_cosines().collect();
    (0..samples.len())
        .into_par_iter()
        .map(|sample| {
            std::array::from_fn(|material| {
                let speckle = 0.98 + 0.04 * noise((sample * MATERIALS + material) as u64 + (1 << 40));
                (0.2 + 0.5 * lafortune(lobes[material], products[sample])) * speckle * cosines[sample]
            })
        })
        .collect()
}

struct Chain<'g> {
    brdf_values: stage::BrdfValues,
    percentile: stage::Percentile,
    specular_residual: stage::SpecularResidual,
    lafortune_fit: stage::LafortuneFit,
    specular_scale: stage::SpecularScale,
    gpu: &'g Gpu,
}

impl<'g> Chain<'g> {
    fn new(gpu: &'g Gpu) -> Result<Self, Box<dyn Error>> {
        Ok(Self {
            brdf_values: stage::BrdfValues::new(gpu)?,
            percentile: stage::Percentile::new(gpu)?,
            specular_residual: stage::SpecularResidual::new(gpu)?,
            lafortune_fit: stage::LafortuneFit::new(gpu)?,
            specular_scale: stage::SpecularScale::new(gpu)?,
            gpu,
        })
    }

    /// Prints a row. Tiles are one as another, so one tile is uploaded and worked on as often as there are.
    fn measure(&self, samples: &Samples, texels: usize) -> Result<(), Box<dyn Error>> {
        let gpu = self.gpu;
        let bytes = 3 * samples.octets() * size_of::<[f16; OCTET]>();
        let fitting = usize::try_from(gpu.max_array_bytes())? / bytes;
        let tile_texels = texels.min(fitting / MATERIALS * MATERIALS);
        let materials = radiance(samples);
        let mut values = vec![[f16::ZERO; OCTET]; 3 * samples.octets() * tile_texels];
        let plane = samples.octets() * tile_texels;
        for (index, octet) in values.iter_mut().enumerate() {
            let (row, material) = (index % plane / tile_texels, index % tile_texels % MATERIALS);
            for (lane, value) in octet.iter_mut().enumerate() {
                *value = f16::from_f64(materials.get(row * OCTET + lane).map_or(0.0, |radiance| radiance[material]));
            }
        }
        let tile = stage::Tile { values: gpu.upload("radiance", &values)?, texels: tile_texels, samples: samples.len() };
        let last = texels % tile_texels;
        let rest = if last == 0 {
            None
        } else {
            let values: Vec<_> = values.chunks(tile_texels).flat_map(|row| &row[..last]).copied().collect();
            Some(stage::Tile { values: gpu.upload("radiance", &values)?, texels: last, samples: samples.len() })
        };
        let start = Instant::now();
        for _ in 0..texels / tile_texels {
            self.run(&tile, samples)?;
        }
        if let Some(rest) = &rest {
            self.run(rest, samples)?;
        }
        let seconds = start.elapsed().as_secs_f64();
        println!(
            "{:>9}{texels:>9}{:>7}{seconds:>11.3}{:>15.1}{:>20.2}",
            samples.len(),
            texels.div_ceil(tile_texels),
            seconds / texels as f64 * 1e6,
            seconds / texels as f64 / samples.len() as f64 * 1e9,
        );
        Ok(())
    }

    fn run(&self, radiance: &stage::Tile, samples: &Samples) -> Result<(), Box<dyn Error>> {
        let settings = FitSettings::default();
        let mut recorder = self.gpu.recorder();
        let reflectance = self.brdf_values.record(&mut recorder, radiance, samples)?;
        let diffuse = self.percentile.record(&mut recorder, &reflectance, settings.diffuse_quantile)?;
        let residual = self.specular_residual.record(&mut recorder, &reflectance, &diffuse)?;
        let fitted = self.lafortune_fit.record(&mut recorder, &residual, samples, radiance.texels, &settings)?;
        self.specular_scale.record(&mut recorder, &reflectance, samples, &diffuse, &fitted.lobes, &settings)?;
        self.gpu.submit(recorder).wait(self.gpu)?;
        Ok(())
    }
}
