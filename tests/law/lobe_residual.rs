use half::f16;
use overpaint::{
    gpu::Gpu,
    model::{lafortune, product_in_frame},
    stage::{LobeResidual, Refitted, Shaded, upload_directions},
};

use crate::support::{Worst, hold, random::Random, tile};

crate::suite! { gpu: a_model_of_itself_leaves_nothing; }

/// Radiance made of ρ_d and two lobes, less the same, is zero to half's rounding; where there is no light, exactly.
fn a_model_of_itself_leaves_nothing(gpu: &Gpu) {
    let samples = 40;
    let directions = tile::directions(&mut Random::new(3), samples);
    let normal = glam::DVec3::new(0.3, -0.2, 1.0).normalize().as_vec3();
    let lobes = [[-0.9_f32, -0.8, 0.95, 8.0], [0.1, 0.2, 0.9, 2.0]];
    let (diffuse, specular) = (0.25, [0.5, 0.125]);
    let is_lit = |sample: usize| !sample.is_multiple_of(7);
    let shading = |sample: usize, light: glam::DVec3| if is_lit(sample) { normal.as_dvec3().dot(light).max(0.0) } else { 0.0 };
    let (mut lit, mut means) = (vec![[f16::ZERO; 8]; samples / 8], vec![[f16::ZERO; 8]; samples / 8]);
    for (sample, (view, light)) in directions.directions().iter().enumerate() {
        let product = product_in_frame(normal.as_dvec3(), view.vector(), light.vector());
        let of_lobes: f64 = lobes.iter().zip(specular).map(|(lobe, specular)| specular * lafortune(lobe.map(f64::from), product)).sum();
        let shading = f16::from_f64(shading(sample, light.vector()));
        lit[sample / 8][sample % 8] = shading;
        means[sample / 8][sample % 8] = f16::from_f64(shading.to_f64() * (diffuse + of_lobes));
    }
    let gray = |value: f64| [value as f32, value as f32, value as f32, 0.0];
    let shaded = Shaded { shading: gpu.upload("shading", &lit).expect("fits"), means: gpu.upload("means", &means).expect("fits") };
    let refitted = Refitted {
        diffuse: gpu.upload("diffuse", &[gray(diffuse)]).expect("fits"),
        specular: gpu.upload("specular", &specular.map(gray)).expect("fits"),
    };
    let uploaded = upload_directions(gpu, &directions, &vec![0; samples]).expect("fits");
    let normals = gpu.upload("normals", &[normal.extend(0.0).to_array()]).expect("fits");
    let lobes = gpu.upload("lobes", &lobes).expect("fits");
    let mut recorder = gpu.recorder();
    let residual =
        LobeResidual::new(gpu).expect("builds").record(&mut recorder, &shaded, &uploaded, &normals, &lobes, &refitted).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    let found = tile::unpack(&residual.read(gpu).expect("reads"), 1);
    // Half a unit in the last place of halves below 1.
    hold("lobe_residual: a model of itself", found.iter().map(|value| value.abs()).worst(), 2.5e-4);
    assert!((0..samples).filter(|&sample| !is_lit(sample)).all(|sample| found[sample] == 0.0));
}
