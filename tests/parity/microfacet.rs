use glam::DVec3;
use overpaint::{gpu::Gpu, model::microfacet};

use crate::support::{Worst, hold, probe::probe, random::Random};

crate::suite! { gpu: the_lobe_agrees; }

const LOBE: &str = crate::probe!(
    "microfacet",
    "fn probe(index: u32) -> vec4<f32> {
        let view = inputs[3u * index];
        let light = inputs[3u * index + 1u];
        let normal = inputs[3u * index + 2u].xyz;
        return vec4(ggx_specular(normal, view.xyz, light.xyz, view.w, light.w), schlick(light.w, max(dot(view.xyz, light.xyz), 0.0)), 0.0, 0.0);
    }"
);

/// The WGSL lobe against the f64 one, from all sides, also below the horizon.
fn the_lobe_agrees(gpu: &Gpu) {
    const COUNT: usize = 100_000;
    let mut random = Random::new(9);
    let mut direction = |up: f64| {
        let (z, phi) = (random.between(up, 1.0), random.between(0.0, std::f64::consts::TAU));
        let rim = (1.0 - z * z).sqrt();
        DVec3::new(rim * phi.cos(), rim * phi.sin(), z)
    };
    let directions: Vec<_> = (0..COUNT).map(|_| [direction(-0.1), direction(-0.1), direction(0.3)]).collect();
    let settings: Vec<_> = (0..COUNT).map(|_| [random.between(0.05, 1.0), random.between(0.02, 0.2)]).collect();
    let inputs: Vec<_> = directions
        .iter()
        .zip(&settings)
        .flat_map(|([v, l, n], [roughness, f0])| [v.extend(*roughness), l.extend(*f0), n.extend(0.0)].map(|d| d.as_vec4().to_array()))
        .collect();
    let (mut errors, mut schlick_errors) = (Vec::new(), Vec::new());
    let found = probe(gpu, LOBE, &inputs, COUNT);
    for (given, found) in inputs.chunks_exact(3).zip(found) {
        let [view, light, normal] = [0, 1, 2].map(|i| DVec3::from_slice(&given[i].map(f64::from)));
        let [roughness, f0] = [given[0][3], given[1][3]].map(f64::from);
        let expected = microfacet::ggx_specular(normal, view, light, roughness, f0);
        let expected_schlick = microfacet::schlick(f0, view.dot(light).max(0.0));
        let [lobe, schlick, ..] = found.map(f64::from);
        errors.push((lobe - expected).abs() / (1.0 + expected));
        schlick_errors.push((schlick - expected_schlick).abs());
    }
    // Cosines are good to 1e-7. A lobe of 0.05 changes by forty times its size a radian, and the half vector of nearly opposite
    // directions, being short, is worse than they are by another ten.
    hold("microfacet: ggx_specular, relative to 1 + value", errors.into_iter().worst(), 5e-5);
    // The fifth power of 1 - cosine: five roundings.
    hold("microfacet: schlick", schlick_errors.into_iter().worst(), 6e-7);
}
