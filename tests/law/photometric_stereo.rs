use glam::DVec3;
use half::f16;
use overpaint::{
    data::Direction,
    gpu::Gpu,
    stage::{self, StageError},
};

use crate::support::{hold, random::Random, tile};

crate::suite! {
    gpu: a_lambertian_surface_is_recovered, black_texels_face_out, brightness_is_albedo, tiles_do_not_change_a_texel,
        lights_that_cannot_work_are_refused;
}

fn measure(gpu: &Gpu, lights: &[Direction], texels: usize, value: impl Fn(usize, usize) -> [f16; 3]) -> Result<Vec<[f32; 4]>, StageError> {
    let stage = stage::PhotometricStereo::new(gpu)?;
    let tile = tile::upload(gpu, texels, lights.len(), |channel, sample, texel| value(sample, texel)[channel].to_f64());
    let mut recorder = gpu.recorder();
    let normals = stage.record(&mut recorder, &tile, lights)?;
    gpu.submit(recorder).wait(gpu)?;
    Ok(normals.read(gpu)?)
}

fn ring(theta: f64, count: usize) -> Vec<Direction> {
    (0..count).map(|index| Direction::from_degrees(theta, 360.0 * index as f64 / count as f64)).collect()
}

/// With no light behind any texel, albedo·(n·l) is linear in n and comes back whole.
fn a_lambertian_surface_is_recovered(gpu: &Gpu) {
    let lights = [ring(20.0, 6), ring(45.0, 9)].concat();
    let mut random = Random::new(3);
    let surface: Vec<(DVec3, [f64; 3])> = (0..200)
        .map(|_| {
            let normal = Direction::from_degrees(random.between(0.0, 40.0), random.between(0.0, 360.0)).vector();
            (normal, [0; 3].map(|_| random.between(0.2, 0.9)))
        })
        .collect();
    let found = measure(gpu, &lights, surface.len(), |sample, texel| {
        let (normal, albedo) = surface[texel];
        albedo.map(|albedo| f16::from_f64(albedo * normal.dot(lights[sample].vector())))
    })
    .expect("is measured");
    for (found, (normal, albedo)) in found.iter().zip(&surface) {
        let [x, y, z, measured] = found.map(f64::from);
        // Radiance is stored to one part in 4096 (half of 2^-11), and least squares does not amplify it here.
        hold("photometric stereo: Lambertian normal", (DVec3::new(x, y, z) - *normal).length(), 5e-4);
        hold("photometric stereo: Lambertian albedo", (measured - albedo.iter().sum::<f64>() / 3.0).abs(), 2.5e-4);
    }
}

fn black_texels_face_out(gpu: &Gpu) {
    let found = measure(gpu, &ring(30.0, 5), 70, |_, _| [f16::ZERO; 3]).expect("is measured");
    assert!(found.iter().all(|normal| *normal == [0.0, 0.0, 1.0, 0.0]));
}

/// Twice the light: twice the albedo, the same normal, bit for bit, since a power of two only moves the exponent.
fn brightness_is_albedo(gpu: &Gpu) {
    let lights = ring(40.0, 12);
    let mut random = Random::new(4);
    let values: Vec<f32> = (0..12 * 65).map(|_| random.between(0.1, 0.5) as f32).collect();
    let lit = |factor: f32| {
        measure(gpu, &lights, 65, |sample, texel| {
            [f16::from_f32(values[sample * 65 + texel]); 3].map(|v| f16::from_f32(factor * v.to_f32()))
        })
        .expect("is measured")
    };
    for (once, twice) in lit(1.0).iter().zip(lit(2.0)) {
        assert_eq!([once[0], once[1], once[2], 2.0 * once[3]], twice);
    }
}

fn tiles_do_not_change_a_texel(gpu: &Gpu) {
    let lights = ring(50.0, 10);
    let mut random = Random::new(5);
    let values: Vec<[f16; 3]> = (0..10 * 130).map(|_| [0; 3].map(|_| f16::from_f64(random.unit()))).collect();
    let tile = |first: usize, texels: usize| {
        measure(gpu, &lights, texels, |sample, texel| values[sample * 130 + first + texel]).expect("is measured")
    };
    assert_eq!(tile(0, 130), [tile(0, 33), tile(33, 97)].concat());
}

fn lights_that_cannot_work_are_refused(gpu: &Gpu) {
    let refused = |lights: &[Direction]| measure(gpu, lights, 1, |_, _| [f16::ONE; 3]).expect_err("is refused");
    let two = refused(&ring(30.0, 2));
    assert!(matches!(two, StageError::TooFewLights { found: 2 }), "{two}");
    // An arc through the zenith lies in a plane; a single direction in many.
    let arc: Vec<_> = (0..7).map(|index| Direction::from_degrees(15.0 * f64::from(index), 60.0)).collect();
    let flat = refused(&arc);
    assert!(matches!(flat, StageError::CoplanarLights { found: 7, .. }), "{flat}");
    let one = refused(&[Direction::from_degrees(0.0, 0.0); 4]);
    assert!(matches!(one, StageError::CoplanarLights { found: 4, .. }), "{one}");
    assert!(one.to_string().contains("Add lights at other azimuths"));
    // A ring does not: it is cut by no plane through the point.
    measure(gpu, &ring(30.0, 3), 1, |_, _| [f16::ONE; 3]).expect("is enough");
}
