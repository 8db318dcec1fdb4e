use std::f64::consts::TAU;

use overpaint::{gpu::Gpu, model::Fourier, stage};
use rustfft::{FftPlanner, num_complex::Complex};

use crate::support::{fft_bound as bound, hold, random::Random, worst_difference};

crate::suite! {
    plain: factors_are_prime_or_four_and_multiply_to_the_length;
    gpu: the_inverse_undoes_the_transform, energy_is_kept, an_impulse_is_flat, it_is_linear, a_shift_is_a_phase, agrees_with_rustfft;
}

type Field = Vec<[f32; 2]>;

/// Even, odd, prime and mixed.
const SIZES: [[usize; 2]; 6] = [[1, 1], [64, 64], [65, 33], [61, 67], [30, 1], [2, 400]];

fn transform(gpu: &Gpu, field: &[[f32; 2]], [width, height]: [usize; 2], fourier: Fourier) -> Field {
    let stage = stage::Fft::new(gpu).expect("builds");
    let buffer = gpu.upload("field", field).expect("fits");
    let mut recorder = gpu.recorder();
    let result = stage.record(&mut recorder, &buffer, [width as u32, height as u32], fourier).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    result.read(gpu).expect("reads")
}

fn noise(seed: u64, [width, height]: [usize; 2]) -> Field {
    let mut random = Random::new(seed);
    (0..width * height).map(|_| [0; 2].map(|_| random.between(-1.0, 1.0) as f32)).collect()
}

fn energy(field: &[[f32; 2]]) -> f64 {
    field.iter().flatten().map(|&part| f64::from(part).powi(2)).sum()
}

/// Worst difference over the root mean square of `expected`.
fn relative(found: &[[f32; 2]], expected: impl Iterator<Item = [f64; 2]> + Clone) -> f64 {
    let square: f64 = expected.clone().flatten().map(|part| part * part).sum();
    let rms = (square / found.len() as f64).sqrt();
    worst_difference(found.iter().flatten().map(|&part| f64::from(part)), expected.flatten()) / rms
}

fn wide(field: &[[f32; 2]]) -> impl Iterator<Item = [f64; 2]> + Clone {
    field.iter().map(|value| value.map(f64::from))
}

fn the_inverse_undoes_the_transform(gpu: &Gpu) {
    for size in SIZES {
        let field = noise(1, size);
        let spectrum = transform(gpu, &field, size, Fourier::Forward);
        let back = transform(gpu, &spectrum, size, Fourier::Inverse);
        // Two transforms' errors.
        hold("fft: inverse of transform", relative(&back, wide(&field)), 2.0 * (bound(size[0]) + bound(size[1])));
    }
}

/// Parseval: the spectrum has W·H times the energy of the field.
fn energy_is_kept(gpu: &Gpu) {
    for size in SIZES {
        let field = noise(2, size);
        let spectrum = transform(gpu, &field, size, Fourier::Forward);
        let ratio = energy(&spectrum) / (energy(&field) * (size[0] * size[1]) as f64);
        hold("fft: Parseval", (ratio - 1.0).abs(), bound(size[0]) + bound(size[1]));
    }
}

/// All frequencies of an impulse at the origin are equal: each sum has one term other than zero, times one.
fn an_impulse_is_flat(gpu: &Gpu) {
    for size in SIZES {
        let mut field = vec![[0.0; 2]; size[0] * size[1]];
        field[0] = [3.0, -2.0];
        assert!(transform(gpu, &field, size, Fourier::Forward).iter().all(|value| *value == [3.0, -2.0]));
    }
}

fn it_is_linear(gpu: &Gpu) {
    for size in SIZES {
        let (a, b) = (noise(3, size), noise(4, size));
        let sum: Field = a.iter().zip(&b).map(|(a, b)| [a[0] + 0.5 * b[0], a[1] + 0.5 * b[1]]).collect();
        let [a, b, sum] = [a, b, sum].map(|field| transform(gpu, &field, size, Fourier::Forward));
        let expected: Vec<_> = wide(&a).zip(wide(&b)).map(|(a, b)| [a[0] + 0.5 * b[0], a[1] + 0.5 * b[1]]).collect();
        hold("fft: linearity", relative(&sum, expected.iter().copied()), 2.0 * (bound(size[0]) + bound(size[1])));
    }
}

/// Moving the field by (a, b) turns frequency (k, l) by exp(-2πi(ka/W + lb/H)).
fn a_shift_is_a_phase(gpu: &Gpu) {
    for [width, height] in SIZES {
        let size = [width, height];
        let (a, b) = (width / 3, height / 2);
        let field = noise(5, size);
        let shifted: Field =
            (0..width * height).map(|at| field[(at / width + height - b) % height * width + (at % width + width - a) % width]).collect();
        let spectrum = transform(gpu, &field, size, Fourier::Forward);
        let expected: Vec<_> = wide(&spectrum)
            .enumerate()
            .map(|(at, [real, imaginary])| {
                let turns = (at % width * a) as f64 / width as f64 + (at / width * b) as f64 / height as f64;
                let (sin, cos) = (-TAU * turns).sin_cos();
                [real * cos - imaginary * sin, real * sin + imaginary * cos]
            })
            .collect();
        let found = transform(gpu, &shifted, size, Fourier::Forward);
        hold("fft: shift", relative(&found, expected.iter().copied()), 2.0 * (bound(width) + bound(height)));
    }
}

fn agrees_with_rustfft(gpu: &Gpu) {
    // The last has one workgroup more than a dispatch holds along an axis.
    for size in [[64, 48], [61, 67], [1000, 3], [243, 250], [2048, 2048]] {
        let [width, height] = size;
        let field = noise(6, size);
        let found = transform(gpu, &field, size, Fourier::Forward);
        let mut planner = FftPlanner::<f64>::new();
        let mut expected: Vec<_> = wide(&field).map(|[real, imaginary]| Complex::new(real, imaginary)).collect();
        planner.plan_fft_forward(width).process(&mut expected);
        let mut columns: Vec<_> = (0..width * height).map(|at| expected[at % height * width + at / height]).collect();
        planner.plan_fft_forward(height).process(&mut columns);
        let expected = (0..width * height).map(|at| columns[at % width * height + at / width]).map(|value| [value.re, value.im]);
        hold("fft: against rustfft", relative(&found, expected), bound(width) + bound(height));
    }
}

fn factors_are_prime_or_four_and_multiply_to_the_length() {
    for length in 1..=2000 {
        let factors = stage::Fft::factors(length);
        assert_eq!(factors.iter().product::<u32>(), length);
        for factor in factors {
            assert!(factor == 4 || (2..factor).all(|divisor| factor % divisor != 0), "{factor} of {length}");
        }
    }
    assert_eq!(stage::Fft::factors(400), [4, 4, 5, 5]);
    assert_eq!(stage::Fft::factors(4093), [4093]);
    assert_eq!(stage::Fft::factors(1), [1]);
}
