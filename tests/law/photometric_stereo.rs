use glam::DVec3;
use half::f16;
use overpaint::{
    data::Direction,
    gpu::Gpu,
    model::StereoMethod::{self, LeastSquares, Robust},
    stage::{self, StageError},
};

use crate::support::{hold, random::Random, tile};

crate::suite! {
    gpu: a_lambertian_surface_is_recovered, shadows_of_its_own_do_not_pull_the_robust_normal, outliers_do_not_pull_the_robust_normal,
        masked_samples_have_no_influence, what_the_samples_do_not_determine_faces_out, brightness_is_albedo,
        tiles_do_not_change_a_texel, lights_that_cannot_work_are_refused;
}

const MASKED: [f16; 3] = [f16::NEG_ONE; 3];
const METHODS: [StereoMethod; 2] = [LeastSquares, Robust];

fn measure(
    gpu: &Gpu, lights: &[Direction], texels: usize, method: StereoMethod, value: impl Fn(usize, usize) -> [f16; 3],
) -> Result<Vec<[f32; 4]>, StageError> {
    let stage = stage::PhotometricStereo::new(gpu)?;
    let tile = tile::upload(gpu, texels, lights.len(), |channel, sample, texel| value(sample, texel)[channel].to_f64());
    let mut recorder = gpu.recorder();
    let normals = stage.record(&mut recorder, &tile, lights, method)?;
    gpu.submit(recorder).wait(gpu)?;
    Ok(normals.read(gpu)?)
}

fn ring(theta: f64, count: usize) -> Vec<Direction> {
    (0..count).map(|index| Direction::from_degrees(theta, 360.0 * index as f64 / count as f64)).collect()
}

fn normals(random: &mut Random, count: usize, steepest: f64) -> Vec<DVec3> {
    (0..count).map(|_| Direction::from_degrees(random.between(0.0, steepest), random.between(0.0, 360.0)).vector()).collect()
}

/// Largest distance between found and true normals, and largest difference of the albedo from `albedo`.
fn worst(found: &[[f32; 4]], normals: &[DVec3], albedo: f64) -> (f64, f64) {
    assert_eq!(found.len(), normals.len());
    found.iter().zip(normals).fold((0.0, 0.0), |(angle, brightness), (found, normal)| {
        let [x, y, z, w] = found.map(f64::from);
        assert!(w.is_finite());
        (angle.max((DVec3::new(x, y, z) - *normal).length()), brightness.max((w - albedo).abs()))
    })
}

/// With no light behind any texel, albedo·(n·l) is linear in n and comes back whole.
fn a_lambertian_surface_is_recovered(gpu: &Gpu) {
    let lights = [ring(20.0, 6), ring(45.0, 9)].concat();
    let surface = normals(&mut Random::new(3), 200, 40.0);
    // Of channels that differ the mean counts.
    let color = [0.9, 0.6, 0.3];
    for method in METHODS {
        let found = measure(gpu, &lights, surface.len(), method, |sample, texel| {
            color.map(|albedo| f16::from_f64(albedo * surface[texel].dot(lights[sample].vector())))
        })
        .expect("is measured");
        let (normal, albedo) = worst(&found, &surface, 0.6);
        // Radiance is stored to one part in 4096 (half of 2^-11), and neither method amplifies it here.
        hold(&format!("photometric stereo, {method:?}: Lambertian normal"), normal, 5e-4);
        hold(&format!("photometric stereo, {method:?}: Lambertian albedo"), albedo, 2.5e-4);
    }
}

/// Radiance is max(0, n·l). Under steep slopes and low lights half of the samples may be dark.
fn shadows_of_its_own_do_not_pull_the_robust_normal(gpu: &Gpu) {
    let lights = [ring(15.0, 8), ring(40.0, 16), ring(65.0, 24)].concat();
    let surface = normals(&mut Random::new(6), 300, 60.0);
    let find = |method| {
        let found = measure(gpu, &lights, surface.len(), method, |sample, texel| {
            [f16::from_f64(0.7 * surface[texel].dot(lights[sample].vector()).max(0.0)); 3]
        })
        .expect("is measured");
        worst(&found, &surface, 0.7)
    };
    let (normal, albedo) = find(Robust);
    // As exact as halves are: what the horizon hides has no weight.
    hold("photometric stereo, Robust: normal under its own shadows", normal, 5e-4);
    hold("photometric stereo, Robust: albedo under its own shadows", albedo, 5e-4);
    assert!(find(LeastSquares).0 > 0.1, "least squares is pulled");
}

/// A third of a texel's samples replaced, half of those by shadows, half by highlights.
fn outliers_do_not_pull_the_robust_normal(gpu: &Gpu) {
    let lights = [ring(15.0, 8), ring(40.0, 16), ring(65.0, 24)].concat();
    let mut random = Random::new(7);
    let surface = normals(&mut random, 300, 20.0);
    let replaced: Vec<Vec<usize>> = (0..surface.len())
        .map(|_| {
            let mut order: Vec<usize> = (0..lights.len()).collect();
            (0..order.len()).rev().for_each(|last| order.swap(last, random.below(last + 1)));
            order[..lights.len() / 3].to_vec()
        })
        .collect();
    let find = |method| {
        let found = measure(gpu, &lights, surface.len(), method, |sample, texel| {
            let lit = 0.6 * surface[texel].dot(lights[sample].vector());
            let value = match replaced[texel].iter().position(|&replaced| replaced == sample) {
                Some(index) if index % 2 == 0 => 0.0,
                Some(_) => lit + 0.8,
                None => lit,
            };
            [f16::from_f64(value); 3]
        })
        .expect("is measured");
        worst(&found, &surface, 0.6)
    };
    let (normal, albedo) = find(Robust);
    // The scale settles at its least, 1 % of the albedo. A shadow is 30 to 100 times that off and keeps 1e-3 to 1e-4 of its
    // weight, a highlight less; a third of the samples then pull by about 1e-3 at most, and halves are rounded.
    hold("photometric stereo, Robust: normal under outliers", normal, 2e-3);
    hold("photometric stereo, Robust: albedo under outliers", albedo, 2e-3);
    assert!(find(LeastSquares).0 > 0.1, "least squares is pulled");
}

/// What stands in the other channels of a masked sample does not matter, and a masked light might as well not have been.
fn masked_samples_have_no_influence(gpu: &Gpu) {
    let lights = [ring(25.0, 9), ring(55.0, 14)].concat();
    let mut random = Random::new(8);
    let values: Vec<f16> = (0..lights.len() * 70).map(|_| f16::from_f64(random.between(0.1, 0.9))).collect();
    let masked: Vec<bool> = lights.iter().map(|_| random.unit() < 0.3).collect();
    let kept: Vec<usize> = (0..lights.len()).filter(|&sample| !masked[sample]).collect();
    let kept_lights: Vec<Direction> = kept.iter().map(|&sample| lights[sample]).collect();
    for method in METHODS {
        let under = |mask: [f16; 3]| {
            measure(gpu, &lights, 70, method, |sample, texel| if masked[sample] { mask } else { [values[sample * 70 + texel]; 3] })
                .expect("is measured")
        };
        let found = under(MASKED);
        assert_eq!(found, under([f16::from_f64(-0.001), f16::MAX, f16::INFINITY]));
        let without = measure(gpu, &kept_lights, 70, method, |sample, texel| [values[kept[sample] * 70 + texel]; 3]).expect("is measured");
        for (found, without) in found.iter().zip(without) {
            let difference = (0..4).map(|i| f64::from(found[i] - without[i]).abs()).fold(0.0, f64::max);
            // Other sums of the same numbers.
            hold(&format!("photometric stereo, {method:?}: masked or left out"), difference, 1e-6);
        }
    }
}

fn what_the_samples_do_not_determine_faces_out(gpu: &Gpu) {
    // An arc through the zenith, and two lights off it.
    let arc = (0..7).map(|index| Direction::from_degrees(15.0 * f64::from(index), 60.0));
    let lights: Vec<Direction> = arc.chain(ring(30.0, 2)).collect();
    let lit: [&[usize]; 7] = [&[], &[7], &[0, 8], &[7, 8], &[6, 7], &[0, 1, 2, 3, 4, 5, 6], &[3, 5, 6]];
    for method in METHODS {
        let unmasked = |sample: usize, texel: usize| lit[texel].contains(&sample);
        let masked = measure(gpu, &lights, lit.len(), method, |sample, texel| if unmasked(sample, texel) { [f16::ONE; 3] } else { MASKED });
        let black = measure(gpu, &lights, 70, method, |_, _| [f16::ZERO; 3]);
        for found in [masked.expect("is measured"), black.expect("is measured")].concat() {
            assert_eq!(found, [0.0, 0.0, 1.0, 0.0], "{method:?}");
        }
        // Three suffice.
        let three = measure(gpu, &lights, 1, method, |sample, _| if [0, 7, 6].contains(&sample) { [f16::ONE; 3] } else { MASKED });
        assert!(three.expect("is measured")[0][3] > 1.0);
    }
}

/// Twice the light: twice the albedo, the same normal, bit for bit, since a power of two only moves the exponent. A factor of
/// four, whose root is a power of two as well.
fn brightness_is_albedo(gpu: &Gpu) {
    let lights = ring(40.0, 12);
    let mut random = Random::new(4);
    let values: Vec<f32> = (0..12 * 65).map(|_| random.between(0.1, 0.5) as f32).collect();
    for method in METHODS {
        let lit = |factor: f32| {
            measure(gpu, &lights, 65, method, |sample, texel| {
                [f16::from_f32(values[sample * 65 + texel]); 3].map(|v| f16::from_f32(factor * v.to_f32()))
            })
            .expect("is measured")
        };
        for (once, fourfold) in lit(1.0).iter().zip(lit(4.0)) {
            assert_eq!([once[0], once[1], once[2], 4.0 * once[3]], fourfold);
        }
    }
}

fn tiles_do_not_change_a_texel(gpu: &Gpu) {
    let lights = ring(50.0, 10);
    let mut random = Random::new(5);
    let mut sample = || if random.unit() < 0.1 { MASKED } else { [0; 3].map(|_| f16::from_f64(random.unit())) };
    let values: Vec<[f16; 3]> = (0..10 * 130).map(|_| sample()).collect();
    for method in METHODS {
        let tile = |first: usize, texels: usize| {
            measure(gpu, &lights, texels, method, |sample, texel| values[sample * 130 + first + texel]).expect("is measured")
        };
        assert_eq!(tile(0, 130), [tile(0, 33), tile(33, 97)].concat());
    }
}

fn lights_that_cannot_work_are_refused(gpu: &Gpu) {
    let refused = |lights: &[Direction]| measure(gpu, lights, 1, Robust, |_, _| [f16::ONE; 3]).expect_err("is refused");
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
    measure(gpu, &ring(30.0, 3), 1, Robust, |_, _| [f16::ONE; 3]).expect("is enough");
}
