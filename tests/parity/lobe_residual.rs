use half::f16;
use overpaint::{
    data::{Direction, OCTET},
    gpu::Gpu,
    reference,
    stage::{LobeResidual, Refitted, Shaded, upload_directions},
};

use crate::support::{hold, random::Random, tile};

crate::suite! { gpu: agrees_with_its_twin; }

fn agrees_with_its_twin(gpu: &Gpu) {
    let mut random = Random::new(21);
    for (texels, samples, lobes) in [(1, 1, 1), (63, 9, 1), (64, 16, 2), (65_usize, 131_usize, 3)] {
        let octets = samples.div_ceil(OCTET);
        let directions = tile::directions(&mut random, samples);
        let rows: Vec<u32> = (0..samples).map(|sample| (sample % 3) as u32).collect();
        let normals: Vec<[f32; 4]> = (0..3 * texels)
            .map(|_| Direction::from_degrees(random.between(0.0, 50.0), random.between(0.0, 360.0)).vector().as_vec3().extend(0.0).to_array())
            .collect();
        let mut plane = |low: f64, high: f64| -> Vec<[f16; OCTET]> {
            (0..octets * texels).map(|_| [(); OCTET].map(|()| f16::from_f64(random.between(low, high).max(0.0)))).collect()
        };
        // A third of the shading is 0, as of masked and unlit samples, whose means are 0, too.
        let shading = plane(-0.5, 1.0);
        let mut means = plane(0.0, 1.0);
        for (mean, shading) in means.iter_mut().flatten().zip(shading.iter().flatten()) {
            if *shading == f16::ZERO {
                *mean = f16::ZERO;
            }
        }
        let mut colour = |count: usize| -> Vec<[f32; 4]> {
            (0..count).map(|_| [random.unit() as f32, random.unit() as f32, random.unit() as f32, 0.0]).collect()
        };
        let (diffuse, specular) = (colour(texels), colour(lobes * texels));
        let parameters: Vec<[f32; 4]> = (0..lobes * texels)
            .map(|_| [random.between(-1.1, 0.3), random.between(-1.1, 0.3), random.between(0.3, 1.1), random.between(0.5, 20.0)].map(|c| c as f32))
            .collect();

        let shaded = Shaded { shading: gpu.upload("shading", &shading).expect("fits"), means: gpu.upload("means", &means).expect("fits") };
        let refitted =
            Refitted { diffuse: gpu.upload("diffuse", &diffuse).expect("fits"), specular: gpu.upload("specular", &specular).expect("fits") };
        let uploaded = upload_directions(gpu, &directions, &rows).expect("fits");
        let (on_gpu, lobes_on_gpu) = (gpu.upload("normals", &normals).expect("fits"), gpu.upload("lobes", &parameters).expect("fits"));
        let mut recorder = gpu.recorder();
        let stage = LobeResidual::new(gpu).expect("builds");
        let residual = stage.record(&mut recorder, &shaded, &uploaded, &on_gpu, &lobes_on_gpu, &refitted).expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");
        let found = tile::unpack(&residual.read(gpu).expect("reads"), texels);
        let (shading, means) = (tile::unpack(&shading, texels), tile::unpack(&means, texels));

        let mean = |c: [f32; 4]| c[..3].iter().map(|&c| f64::from(c)).sum::<f64>() / 3.0;
        for sample in 0..samples {
            for texel in 0..texels {
                let at = sample * texels + texel;
                let normal = normals[rows[sample] as usize * texels + texel];
                let lobes: Vec<(f64, [f64; 4])> =
                    (0..lobes).map(|lobe| lobe * texels + texel).map(|at| (mean(specular[at]), parameters[at].map(f64::from))).collect();
                let normal = [0, 1, 2].map(|axis| f64::from(normal[axis]));
                let expected = reference::lobe_residual(
                    means[at], shading[at], normal, directions.directions()[sample], mean(diffuse[texel]), &lobes,
                );
                // Half's rounding, 2^-11 of the result, and of powers up to 20 of bases up to 2 in single precision: 1e-6 relative.
                let bound = 5e-4 * expected.abs() + 1e-5 * lobes.iter().map(|lobe| lobe.0 * 1.1_f64.powf(lobe.1[3])).sum::<f64>() + 1e-6;
                hold("lobe_residual: error over its bound", (found[at] - expected).abs() / bound, 1.0);
            }
        }
    }
}
