use std::f64::consts::{PI, TAU};

use overpaint::{
    data::Map,
    gpu::Gpu,
    model::{Boundary, FitSettings},
    stage,
};

use crate::support::{hold, random::Random, worst_difference};

crate::suite! {
    gpu: a_wave_is_recovered_from_its_slopes, a_mirrored_wave_is_recovered_from_its_slopes, a_mirrored_tilt_is_recovered,
        a_tilt_is_taken_out, height_is_linear_in_slope, a_flat_surface_is_zero, the_mean_is_zero, slopes_are_held,
        the_normals_of_a_height_field_give_it_back;
}

fn settings(boundary: Boundary, detilt: bool) -> FitSettings {
    FitSettings { boundary, detilt, ..FitSettings::default() }
}

fn of_normals(gpu: &Gpu, normals: &[[f32; 4]], [width, height]: [usize; 2], settings: &FitSettings) -> Vec<f64> {
    let stage = stage::FrankotChellappa::new(gpu).expect("builds");
    let buffer = gpu.upload("normals", normals).expect("fits");
    let mut recorder = gpu.recorder();
    let heights = stage.record(&mut recorder, &buffer, [width as u32, height as u32], settings).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    heights.read(gpu).expect("reads").into_iter().map(f64::from).collect()
}

fn of_slopes(gpu: &Gpu, slopes: &Map<[f64; 2]>, settings: &FitSettings) -> Vec<f64> {
    let normals: Vec<_> = slopes.values().iter().map(|&[p, q]| [-p as f32, -q as f32, 1.0, 0.0]).collect();
    of_normals(gpu, &normals, [slopes.width(), slopes.height()], settings)
}

fn noise(seed: u64, width: usize, height: usize) -> Map<[f64; 2]> {
    let mut random = Random::new(seed);
    Map::from_fn(width, height, |_, _| [random.between(-1.0, 1.0), random.between(-1.0, 1.0)])
}

fn worst(found: &[f64], expected: &Map<f64>) -> f64 {
    worst_difference(found.iter().copied(), expected.values().iter().copied())
}

/// z = A·sin(2πkx/W + a)·cos(2πly/H + b), y upwards. The phases keep z from being even in y, so that q's sign shows.
fn a_wave_is_recovered_from_its_slopes(gpu: &Gpu) {
    // The last has more workgroups than a dispatch holds along an axis.
    for (width, height, k, l) in [(64, 64, 1, 0), (64, 48, 3, 5), (61, 67, 2, 7), (32, 1, 4, 0), (1, 30, 0, 1), (2160, 1944, 11, 7)] {
        let (u, v, amplitude) = (TAU * f64::from(k) / width as f64, TAU * f64::from(l) / height as f64, 2.5);
        let phases = |column: usize, row: usize| (u * column as f64 + 0.4, 0.7 - v * row as f64);
        let slopes = Map::from_fn(width, height, |column, row| {
            let (across, up) = phases(column, row);
            [amplitude * u * across.cos() * up.cos(), -amplitude * v * across.sin() * up.sin()]
        });
        let expected = Map::from_fn(width, height, |column, row| {
            let (across, up) = phases(column, row);
            amplitude * across.sin() * up.cos()
        });
        let found = of_slopes(gpu, &slopes, &settings(Boundary::Periodic, true));
        // Two transforms' errors, about 1e-6 of the amplitude.
        hold("frankot_chellappa: wave", worst(&found, &expected), 5e-6);
    }
}

/// z = A·cos(πk(x + ½)/W)·cos(πl(y + ½)/H) goes on smoothly in its mirror image, the edge texel doubled.
fn a_mirrored_wave_is_recovered_from_its_slopes(gpu: &Gpu) {
    for (width, height, k, l) in [(64, 48, 1, 3), (61, 67, 2, 1), (16, 1, 3, 0)] {
        let (u, v, amplitude) = (PI * f64::from(k) / width as f64, PI * f64::from(l) / height as f64, 2.5);
        let phases = |column: usize, row: usize| (u * (column as f64 + 0.5), v * (row as f64 + 0.5));
        let slopes = Map::from_fn(width, height, |column, row| {
            let (across, down) = phases(column, row);
            [-amplitude * u * across.sin() * down.cos(), amplitude * v * across.cos() * down.sin()]
        });
        let expected = Map::from_fn(width, height, |column, row| {
            let (across, down) = phases(column, row);
            amplitude * across.cos() * down.cos()
        });
        let found = of_slopes(gpu, &slopes, &settings(Boundary::Mirror, false));
        hold("frankot_chellappa: mirrored wave", worst(&found, &expected), 5e-6);
    }
}

fn a_mirrored_tilt_is_recovered(gpu: &Gpu) {
    let (width, height, p, q) = (48, 30, 0.6, -0.35);
    let slopes = Map::from_fn(width, height, |_, _| [p, q]);
    let expected = Map::from_fn(width, height, |column, row| {
        p * (column as f64 - 0.5 * (width - 1) as f64) - q * (row as f64 - 0.5 * (height - 1) as f64)
    });
    let found = of_slopes(gpu, &slopes, &settings(Boundary::Mirror, false));
    // The mirrored surface is a roof. A band-limited one rounds its ridges off by a fraction of a texel's rise.
    hold("frankot_chellappa: mirrored tilt over a texel's rise", worst(&found, &expected) / (p.abs() + q.abs()), 0.25);
}

fn a_tilt_is_taken_out(gpu: &Gpu) {
    let relief = noise(1, 70, 45);
    let mean = |axis: usize| relief.values().iter().map(|slope| slope[axis]).sum::<f64>() / relief.values().len() as f64;
    let level = relief.map(|slope| [slope[0] - mean(0), slope[1] - mean(1)]);
    let tilted = relief.map(|slope| [slope[0] + 0.8, slope[1] - 0.5]);
    for boundary in [Boundary::Periodic, Boundary::Mirror] {
        let [level, tilted] = [&level, &tilted].map(|slopes| of_slopes(gpu, slopes, &settings(boundary, true)));
        // The tilt's rounding, spread over the spectrum like any other.
        hold("frankot_chellappa: tilt taken out", worst_difference(tilted, level), 1e-5);
    }
}

fn height_is_linear_in_slope(gpu: &Gpu) {
    let slopes = noise(2, 50, 37);
    for boundary in [Boundary::Periodic, Boundary::Mirror] {
        let [once, quarter] =
            [1.0, 0.25].map(|factor| of_slopes(gpu, &slopes.map(|slope| slope.map(|part| factor * part)), &settings(boundary, false)));
        // A power of two only moves exponents.
        assert_eq!(once, quarter.iter().map(|z| 4.0 * z).collect::<Vec<_>>());
    }
}

fn a_flat_surface_is_zero(gpu: &Gpu) {
    for boundary in [Boundary::Periodic, Boundary::Mirror] {
        for [width, height] in [[1, 1], [2, 2], [33, 20]] {
            let heights = of_normals(gpu, &vec![[0.0, 0.0, 1.0, 0.0]; width * height], [width, height], &settings(boundary, false));
            assert!(heights.iter().all(|z| *z == 0.0));
        }
    }
}

fn the_mean_is_zero(gpu: &Gpu) {
    let slopes = noise(3, 90, 61);
    for (boundary, detilt) in [(Boundary::Periodic, true), (Boundary::Mirror, true), (Boundary::Mirror, false)] {
        let heights = of_slopes(gpu, &slopes, &settings(boundary, detilt));
        let mean = heights.iter().sum::<f64>() / heights.len() as f64;
        // Nothing but the heights' own rounding, which is a unit in the last place of about 3 and averages out.
        hold("frankot_chellappa: mean", mean.abs(), 1e-6);
    }
}

/// A steeper slope is as good as the steepest allowed, and so is that of a normal that points away; a normal without a
/// direction in the plane is level.
fn slopes_are_held(gpu: &Gpu) {
    let held = FitSettings { max_slope: 2.0, ..FitSettings::default() };
    let with = |normal: [f32; 4]| {
        let mut normals = vec![[0.0, 0.0, 1.0, 0.0]; 12 * 9];
        normals[40] = normal;
        of_normals(gpu, &normals, [12, 9], &held)
    };
    let steepest = with([-0.6 * 2.0, 0.8 * 2.0, 1.0, 0.0]);
    assert!(steepest.iter().any(|z| z.abs() > 0.1));
    for normal in [[-0.6, 0.8, 0.01, 0.0], [-0.6, 0.8, 0.0, 0.0], [-0.6, 0.8, -1.0, 0.0]] {
        // One rounding of the slope.
        hold("frankot_chellappa: held slopes", worst_difference(with(normal), steepest.iter().copied()), 5e-7);
    }
    for normal in [[0.0; 4], [0.0, 0.0, -1.0, 0.0]] {
        assert!(with(normal).iter().all(|z| *z == 0.0));
    }
}

/// Stage `normals` takes central differences, which fall short of a wave's slope by the factor sin(u)/u.
fn the_normals_of_a_height_field_give_it_back(gpu: &Gpu) {
    let (width, height) = (128, 96);
    let (u, v) = (TAU * 2.0 / width as f64, TAU * 3.0 / height as f64);
    let heights = Map::from_fn(width, height, |column, row| 3.0 * (u * column as f64 + 0.3).sin() + 1.5 * (v * row as f64 + 1.0).sin());
    let narrow: Vec<_> = heights.values().iter().map(|&z| z as f32).collect();
    let stage = stage::Normals::new(gpu).expect("builds");
    let buffer = gpu.upload("heights", &narrow).expect("fits");
    let mut recorder = gpu.recorder();
    let normals = stage.record(&mut recorder, &buffer, [width as u32, height as u32], Boundary::Periodic).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    let normals = normals.read(gpu).expect("reads");
    let found = of_normals(gpu, &normals, [width, height], &settings(Boundary::Periodic, true));
    // 1 - sin(u)/u of either wave's amplitude, and rounding.
    let short = 3.0 * (1.0 - u.sin() / u) + 1.5 * (1.0 - v.sin() / v);
    hold("frankot_chellappa: round trip through normals", worst(&found, &heights), short + 1e-5);
}
