//! A lobe in frames and what comes with it of the diffuse part.

use glam::{DMat4, DVec3, DVec4};
use half::f16;
use overpaint::{
    data::{Direction, FitStatus, OCTET, Samples},
    gpu::Gpu,
    model::{FitSettings, MIN_LOBE_SAMPLES, in_frame, lafortune},
    reference::{FramedSample, lafortune_framed_change},
    stage::{LafortuneFit, STARTS},
};

use super::lafortune_fit;
use crate::{
    parity::lafortune_framed::views,
    support::{
        Worst, hold,
        local::{Fitted, Local},
        random::Random,
        tile,
    },
};

crate::suite! {
    gpu: known_lobes_come_back_from_tilted_frames, so_they_do_through_noise, a_turned_frame_gives_the_lobe_of_turned_directions,
        a_change_of_the_diffuse_part_makes_none_of_the_lobe, no_lobe_takes_light_away, too_few_lit_samples_have_no_lobe,
        what_a_constant_explains_has_no_lobe, any_data_gives_finite_lobes, a_given_lobe_has_its_best_amplitude;
}

/// Lobes of every kind, (C_x, C_y, C_z, n), and what comes with them of the diffuse part.
const TRUTHS: [([f64; 4], f64); 8] = [
    ([-0.9, -0.9, 0.8, 12.0], 0.3),
    ([-0.7, -1.0, 0.9, 4.0], -0.2),
    // Retro-reflection.
    ([0.9, 0.9, 0.9, 8.0], 0.1),
    ([-0.6, -0.6, 0.6, 1.5], 0.0),
    // Off-specular.
    ([-1.0, -1.0, 0.6, 20.0], 0.05),
    ([0.0, 0.0, 0.7, 2.0], -0.1),
    ([0.9, -0.9, 0.8, 8.0], 0.4),
    ([-1.05, -0.6, 1.0, 10.0], -0.3),
];

/// Residual radiance `[sample][texel]` of `reflectance(texel, sample)`, rounded to halves.
fn radiance(local: &Local, mut reflectance: impl FnMut(usize, &FramedSample) -> f64) -> Vec<f64> {
    let mut residual = vec![0.0; local.shading.len()];
    for texel in 0..local.texels {
        for (index, sample) in local.framed(texel, &residual).iter().enumerate() {
            residual[index * local.texels + texel] = f16::from_f64(sample.shading * reflectance(texel, sample)).to_f64();
        }
    }
    residual
}

/// What a lobe and the change that suits it best make of the samples.
fn reprojected(lobe: [f64; 4], samples: &[FramedSample]) -> Vec<f64> {
    let change = lafortune_framed_change(lobe, samples);
    samples.iter().map(|sample| sample.shading * (lafortune(lobe, sample.product) + change)).collect()
}

fn rms(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    (values.map(|value| value * value).sum::<f64>() / count).sqrt()
}

/// Of each texel's lit samples: their number, and the sums of squares of the reprojected radiance's errors and of the true radiance.
fn recovered(gpu: &Gpu, noise: f64) -> Vec<[f64; 3]> {
    let mut random = Random::new(101);
    let local = views(&mut random, TRUTHS.len(), 2000);
    let clean = |texel: usize, sample: &FramedSample| lafortune(TRUTHS[texel].0, sample.product) + TRUTHS[texel].1;
    let exact = radiance(&local, clean);
    let mut noises = Random::new(102);
    // Uniform noise has a standard deviation of 1/√3 of its bound.
    let mut noisy = |sample: &FramedSample| 3.0_f64.sqrt() * noise * noises.between(-1.0, 1.0) / sample.shading.max(1e-9);
    let residual = radiance(&local, |texel, sample| clean(texel, sample) + noisy(sample));
    let sums = |(texel, found): (usize, Fitted)| {
        let samples = local.framed(texel, &residual);
        let truth = exact.iter().skip(texel).step_by(TRUTHS.len());
        let error = reprojected(found.lobe, &samples).iter().zip(truth.clone()).map(|(found, truth)| (found - truth).powi(2)).sum();
        let lit = samples.iter().filter(|sample| sample.shading > 0.0).count();
        [lit as f64, error, truth.map(|truth| truth * truth).sum()]
    };
    local.fit(gpu, &residual, &FitSettings::default()).into_iter().enumerate().map(sums).collect()
}

fn known_lobes_come_back_from_tilted_frames(gpu: &Gpu) {
    let errors = recovered(gpu, 0.0).into_iter().map(|[_, error, truth]| (error / truth).sqrt());
    // Halves round to 2.4e-4, relatively; the descent stops at a relative decrease of 1e-6, so within 1e-3.
    hold("lafortune_framed: known lobes, relative", errors.worst(), 1e-3);
}

/// To first order the squared error is the noise's projection on the span of five gradients: five times its variance in the mean (Seber,
/// Wild 1989, section 2.1), and of eight such one in a thousand has one of more than 24 times.
fn so_they_do_through_noise(gpu: &Gpu) {
    let noise = 0.02;
    let errors = recovered(gpu, noise).into_iter().map(|[lit, error, _]| {
        assert!(lit > 1000.0);
        error / noise.powi(2)
    });
    hold("lafortune_framed: squared error over the noise's", errors.worst(), 24.0);
}

/// The same directions, once seen from a tilted frame and once turned into the base plane's; and the same residual without shading,
/// fitted as that of a flat texel.
fn a_turned_frame_gives_the_lobe_of_turned_directions(gpu: &Gpu) {
    let mut random = Random::new(103);
    let normal = Direction::from_degrees(35.0, 130.0).vector();
    let (samples, rows) = (700, 7);
    let from: Vec<Direction> = (0..rows).map(|_| Direction::from_degrees(random.between(0.0, 40.0), random.between(0.0, 360.0))).collect();
    let rows: Vec<u32> = (0..samples).map(|_| random.below(rows) as u32).collect();
    let lights = tile::directions(&mut random, samples);
    let tilted: Vec<(Direction, Direction)> = rows.iter().zip(lights.directions()).map(|(row, (light, _))| (from[*row as usize], *light)).collect();
    let turn = |direction: &Direction| Direction::from_vector(in_frame(normal, direction.vector()));
    let turned: Vec<(Direction, Direction)> = tilted.iter().map(|(view, light)| (turn(view), turn(light))).collect();
    let make = |directions: &[(Direction, Direction)], normal: DVec3| Local {
        texels: 1,
        samples: Samples::new(directions.to_vec()),
        rows: rows.clone(),
        normals: vec![normal.as_vec3().extend(0.0).to_array(); 7],
        shading: vec![1.0; samples],
        lobes: Vec::new(),
    };
    let (tilted, turned) = (make(&tilted, normal), make(&turned, DVec3::Z));
    for (lobe, _) in TRUTHS {
        let residual = radiance(&tilted, |_, sample| lafortune(lobe, sample.product));
        let of = |local: &Local| local.fit(gpu, &residual, &FitSettings::default()).remove(0).lobe;
        let mut octets = vec![[f16::ZERO; OCTET]; samples.div_ceil(OCTET)];
        residual.iter().enumerate().for_each(|(sample, value)| octets[sample / OCTET][sample % OCTET] = f16::from_f64(*value));
        let flat = lafortune_fit::fit(gpu, &octets, &turned.samples, &FitSettings::default()).lobes.read(gpu).expect("reads")[0].map(f64::from);
        let (in_tilted, in_turned) = (of(&tilted), of(&turned));
        let apart = |a: [f64; 4], b: [f64; 4]| (0..4).map(|parameter| (a[parameter] - b[parameter]).abs() / b[3].max(1.0)).worst();
        // Single precision; the exponent of a descent that ends at another step is off by the root of the tolerance.
        hold("lafortune_framed: a turned frame", apart(in_tilted, in_turned), 1e-4);
        hold("lafortune_framed: a turned frame as a flat texel", apart(in_tilted, flat), 1e-4);
    }
}

/// The constant column takes all of it. Residuals and shading are such that nothing is rounded to halves.
fn a_change_of_the_diffuse_part_makes_none_of_the_lobe(gpu: &Gpu) {
    let mut random = Random::new(104);
    let texels = 65;
    let mut local = views(&mut random, texels, 400);
    local.shading.iter_mut().for_each(|c| *c = (*c * 512.0).round() / 512.0);
    let lobes: Vec<[f64; 4]> = (0..texels).map(|_| [-0.8, -0.9, random.between(0.6, 1.0), random.between(1.5, 6.0)]).collect();
    let residual = radiance(&local, |texel, sample| 0.7 * lafortune(lobes[texel], sample.product) + random.between(-0.02, 0.02));
    let residual: Vec<f64> = residual.into_iter().map(|value| (value * 1024.0).round() / 1024.0).collect();
    let more: Vec<f64> = residual.iter().zip(&local.shading).map(|(value, c)| value + 0.5 * c).collect();
    assert!(more.iter().all(|value| f16::from_f64(*value).to_f64() == *value));
    let (before, after) = (local.fit(gpu, &residual, &FitSettings::default()), local.fit(gpu, &more, &FitSettings::default()));
    let (mut radiances, mut objectives) = (Vec::new(), Vec::new());
    for texel in 0..texels {
        let (samples, with) = (local.framed(texel, &residual), local.framed(texel, &more));
        let [a, b] = [reprojected(before[texel].lobe, &samples), reprojected(after[texel].lobe, &with)];
        let apart = a.iter().zip(&b).zip(&samples).map(|((a, b), sample)| a + 0.5 * sample.shading - b);
        radiances.push(rms(apart) / rms(a.iter().copied()));
        let [energy, objective] = after[texel].objectives;
        objectives.push((before[texel].objectives[1] - objective).abs() / energy);
    }
    // The objective is off by a few steps' tolerance of 1e-6, the radiance by the root of it times the noise's share.
    hold("lafortune_framed: lobes under another diffuse part", radiances.into_iter().worst(), 1e-3);
    // Single precision's sum of hundreds of squares, what a constant explains among them.
    hold("lafortune_framed: objectives under another diffuse part", objectives.into_iter().worst(), 1e-5);
}

/// A residual against which every start's lobe stands: each would have to be negative.
fn no_lobe_takes_light_away(gpu: &Gpu) {
    let mut random = Random::new(105);
    let local = views(&mut random, 3, 300);
    let mut residual = vec![0.0; local.shading.len()];
    for texel in 0..3 {
        let samples = local.framed(texel, &residual);
        let energy: f64 = samples.iter().map(|sample| sample.shading.powi(2)).sum();
        // Without what a constant explains.
        let column = |start: [f32; 4]| -> Vec<f64> {
            let lobe: Vec<f64> = samples.iter().map(|sample| sample.shading * lafortune(start.map(f64::from), sample.product)).collect();
            let constant = lobe.iter().zip(&samples).map(|(value, sample)| value * sample.shading).sum::<f64>() / energy;
            lobe.iter().zip(&samples).map(|(value, sample)| value - constant * sample.shading).collect()
        };
        let columns = STARTS.map(column);
        let gram = columns.each_ref().map(|a| columns.each_ref().map(|b| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>()));
        let weights = DMat4::from_cols_array_2d(&gram).inverse() * DVec4::ONE;
        let against = |sample: usize| -(0..4).map(|start| weights[start] * columns[start][sample]).sum::<f64>();
        let size = (0..samples.len()).map(|sample| against(sample).abs()).worst();
        for sample in 0..samples.len() {
            residual[sample * 3 + texel] = f16::from_f64(against(sample) / size).to_f64();
        }
    }
    for found in local.fit(gpu, &residual, &FitSettings::default()) {
        assert_eq!((found.lobe, found.status), ([0.0, 0.0, 0.0, 1.0], FitStatus::Stalled));
        assert!(found.objectives[0] > 0.0 && found.objectives[0] == found.objectives[1], "{:?}", found.objectives);
    }
    // The other way round each would do.
    residual.iter_mut().for_each(|value| *value = -*value);
    for found in local.fit(gpu, &residual, &FitSettings::default()) {
        assert!(found.lobe[..3].iter().any(|c| *c != 0.0) && found.objectives[1] < found.objectives[0]);
    }
}

/// By texels from none to all: below the least number no lobe, whatever the residuals.
fn too_few_lit_samples_have_no_lobe(gpu: &Gpu) {
    let (texels, samples) = (70, 70);
    let mut random = Random::new(106);
    let mut local = views(&mut random, texels, samples);
    for (index, c) in local.shading.iter_mut().enumerate() {
        *c = if index / texels * 37 % samples < index % texels { 0.5 } else { 0.0 };
    }
    let residual = radiance(&local, |_, sample| lafortune([-0.9, -0.9, 0.9, 2.0], sample.product) + random.between(-0.1, 0.1));
    let least = MIN_LOBE_SAMPLES as usize;
    for (lit, found) in local.fit(gpu, &residual, &FitSettings::default()).into_iter().enumerate() {
        let has_none = found.lobe == [0.0, 0.0, 0.0, 1.0];
        assert_eq!(found.status == FitStatus::TooFewSamples, lit < least, "{lit} lit samples: {:?}", found.status);
        assert!(if lit < least { has_none && found.steps == 0 } else { found.steps > 0 }, "{lit} lit samples: {:?}", found.lobe);
        assert!(lit > 0 || found.objectives == [0.0; 2]);
    }
    let dark = vec![0.0; residual.len()];
    for (lit, found) in local.fit(gpu, &dark, &FitSettings::default()).into_iter().enumerate() {
        assert_eq!(found.status, if lit < least { FitStatus::TooFewSamples } else { FitStatus::NoSpecular });
        assert_eq!((found.lobe, found.objectives), ([0.0, 0.0, 0.0, 1.0], [0.0; 2]));
    }
}

/// One pair of directions: a lobe is a constant, and the diffuse part has it all.
fn what_a_constant_explains_has_no_lobe(gpu: &Gpu) {
    let mut random = Random::new(107);
    let mut local = views(&mut random, 9, 100);
    local.normals = vec![DVec3::new(0.2, 0.1, 1.0).normalize().as_vec3().extend(0.0).to_array(); local.normals.len()];
    local.samples = Samples::new(vec![(Direction::from_degrees(40.0, 20.0), Direction::from_degrees(30.0, 205.0)); 100]);
    let residual = radiance(&local, |_, _| random.between(-0.2, 1.0));
    for found in local.fit(gpu, &residual, &FitSettings::default()) {
        assert_eq!((found.lobe, found.status), ([0.0, 0.0, 0.0, 1.0], FitStatus::Stalled));
    }
}

/// One light, one view, equal shading, and the largest and smallest halves.
fn any_data_gives_finite_lobes(gpu: &Gpu) {
    let texels = 17;
    let check = |local: &Local, residual: &[f64]| {
        for found in local.fit(gpu, residual, &FitSettings::default()) {
            assert!(found.lobe.iter().chain(&found.objectives).all(|value| value.is_finite()), "{:?} {:?}", found.lobe, found.objectives);
            // Without a lobe both are the same sum; with one the constant only lowers it further.
            assert!(found.objectives[1] <= found.objectives[0] * (1.0 + 1e-6), "{:?}", found.objectives);
        }
    };
    let made = || views(&mut Random::new(108), texels, 150);
    let mut one_light = made();
    one_light.samples = Samples::new(one_light.samples.directions().iter().map(|(view, _)| (*view, Direction::from_degrees(50.0, 10.0))).collect());
    let mut one_view = made();
    one_view.rows.fill(0);
    one_view.samples = Samples::new(one_view.samples.directions().iter().map(|(_, light)| (Direction::from_degrees(50.0, 10.0), *light)).collect());
    let mut equal = made();
    equal.shading.fill(0.25);
    let mut faint = made();
    faint.shading.fill(f16::MIN_POSITIVE_SUBNORMAL.to_f64());
    for local in [one_light, one_view, equal, faint, made()] {
        let mut random = Random::new(109);
        check(&local, &radiance(&local, |_, _| random.between(-1.0, 1.0)));
        check(&local, &radiance(&local, |_, _| random.between(0.0, 1.0)));
        check(&local, &radiance(&local, |_, sample| lafortune([-1.0, -1.0, 1.0, 9.0], sample.product)));
        for size in [60_000.0, 1e-6] {
            let signed = |local: &Local, random: &mut Random| -> Vec<f64> {
                local.shading.iter().map(|c| if *c > 0.0 { f16::from_f64(size * random.between(-1.0, 1.0)).to_f64() } else { 0.0 }).collect()
            };
            check(&local, &signed(&local, &mut random));
            let all = vec![f16::from_f64(size).to_f64(); local.shading.len()];
            check(&local, &all.iter().zip(&local.shading).map(|(all, c)| if *c > 0.0 { *all } else { 0.0 }).collect::<Vec<_>>());
        }
    }
}

/// The amplitude is Σ s m / Σ m² over the valid samples, and the objective that of it; the shape stays as it is.
fn a_given_lobe_has_its_best_amplitude(gpu: &Gpu) {
    let (texels, count) = (65, 530);
    let mut random = Random::new(110);
    let samples = tile::directions(&mut random, count);
    let stage = LafortuneFit::new(gpu).expect("builds");
    let given = [-0.5_f32, -0.6, 0.55, 3.0];
    let mut residual = vec![[f16::ZERO; OCTET]; samples.octets() * texels];
    let unit: Vec<f64> = samples.products().map(|product| lafortune(given.map(f64::from), product)).collect();
    for (sample, texel) in (0..count).flat_map(|sample| (0..texels).map(move |texel| (sample, texel))) {
        // The last texel has nothing, and the one before it too few samples.
        let value = if texel == texels - 1 { 0.0 } else { (3.0 * unit[sample] + random.between(-0.2, 0.3)).max(0.0) };
        let masked = tile::a_quarter(sample, texel) || (texel == texels - 2 && sample >= 5);
        residual[sample / OCTET * texels + texel][sample % OCTET] = if masked { f16::NEG_ONE } else { f16::from_f64(value) };
    }
    let buffer = gpu.upload("residual", &residual).expect("fits");
    let run = |given: [f32; 4]| {
        let mut recorder = gpu.recorder();
        let fitted = stage.record_given(&mut recorder, &buffer, &samples, texels, given, &FitSettings::default()).expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");
        (fitted.lobes.read(gpu).expect("reads"), fitted.objectives.read(gpu).expect("reads"), fitted.outcomes.read(gpu).expect("reads"))
    };
    let (lobes, objectives, outcomes) = run(given);
    let values = tile::unpack(&residual, texels);
    let none = [0.0, 0.0, 0.0, 1.0];
    for texel in 0..texels {
        if texel >= texels - 2 {
            let status = if texel == texels - 1 { FitStatus::NoSpecular } else { FitStatus::TooFewSamples };
            assert_eq!((lobes[texel], outcomes[texel]), (none, [status as u32, 0]));
            continue;
        }
        let valid: Vec<(f64, f64)> = (0..count).map(|sample| (values[sample * texels + texel], unit[sample])).filter(|(s, _)| *s >= 0.0).collect();
        let sum = |of: &dyn Fn(f64, f64) -> f64| valid.iter().map(|(s, m)| of(*s, *m)).sum::<f64>();
        let amplitude = sum(&|s, m| s * m) / sum(&|_, m| m * m);
        let least = sum(&|s, m| (amplitude * m - s).powi(2)) / valid.len() as f64;
        assert_eq!(outcomes[texel], [FitStatus::Running as u32, 1]);
        assert_eq!(lobes[texel][3].to_bits(), given[3].to_bits());
        let factor = amplitude.powf(1.0 / f64::from(given[3]));
        let apart = (0..3).map(|axis| (f64::from(lobes[texel][axis]) / (factor * f64::from(given[axis])) - 1.0).abs()).worst();
        // Single precision's sums of hundreds of squares.
        hold("lafortune_fit: a given lobe's amplitude", apart, 1e-5);
        hold("lafortune_fit: a given lobe's objective", (f64::from(objectives[texel][1]) / least - 1.0).abs(), 1e-5);
    }
    // That of a representative without a lobe, and one that no sample sees.
    for unseen in [none, [0.0, 0.0, -1.0, 2.0]] {
        let (lobes, objectives, _) = run(unseen);
        assert!(lobes.iter().all(|lobe| lobe[..3] == [0.0; 3]));
        assert!(objectives.iter().all(|[energy, objective]| energy == objective));
    }
}
