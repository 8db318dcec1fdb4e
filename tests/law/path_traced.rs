//! The path-traced sets, whose true height is known: an outside oracle for everything from the images to the height.

use std::path::Path;

use half::f16;
use overpaint::{
    data::{Block, Direction, Map},
    gpu::Gpu,
    io,
    model::{Boundary, FitSettings},
    reference,
    stage::{FrankotChellappa, PhotometricStereo},
};

use crate::support::{hold, npy, tile};

crate::suite! { gpu_data: normals_and_height_are_those_of_the_truth; }

/// Plain numpy gets 9.54° and 0.9759 on the blocks, 5.57° and 0.9821 on the weave, by the same method; rounding may differ.
fn normals_and_height_are_those_of_the_truth(gpu: &Gpu, data: &Path) {
    for (set, truth, degrees, correlation) in [
        ("blocks64_ubo81x81.zip", "blocks64_truth_height.npy", 9.56, 0.975),
        ("weave64_51x51.zip", "weave64_truth_height.npy", 5.6, 0.981),
    ] {
        let source = io::open(&data.join(set)).expect("opens");
        let btf = source.btf();
        let [width, height] = btf.size();
        // The truth is in tile widths.
        let truth = Map::new(width, height, npy::read(&data.join(truth))).expect("has the same shape").map(|z| z * width as f64);
        let samples = btf.zenith_samples();
        let lights: Vec<Direction> = samples.iter().map(|&sample| btf.directions(sample).1).collect();
        let mut radiance = vec![f16::ZERO; samples.len() * 3 * btf.texels()];
        source.read(&samples, Block::whole(btf.size()), &mut radiance, &|_| {}).expect("reads");
        let mut recorder = gpu.recorder();
        let tile = tile::upload(gpu, btf.texels(), samples.len(), |channel, sample, texel| {
            radiance[(sample * 3 + channel) * btf.texels() + texel].to_f64()
        });
        let normals = PhotometricStereo::new(gpu).expect("builds").record(&mut recorder, &tile, &lights).expect("records");
        let heights = FrankotChellappa::new(gpu)
            .expect("builds")
            .record(&mut recorder, &normals, [width as u32, height as u32], &FitSettings::default())
            .expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");

        let normals = normals.read(gpu).expect("reads");
        let expected = reference::normals(&truth, Boundary::Periodic);
        let angle = |(found, expected): (&[f32; 4], &[f64; 3])| {
            let cosine: f64 = (0..3).map(|axis| f64::from(found[axis]) * expected[axis]).sum();
            cosine.clamp(-1.0, 1.0).acos().to_degrees()
        };
        let mean = normals.iter().zip(expected.values()).map(angle).sum::<f64>() / btf.texels() as f64;
        hold(&format!("{set}: mean error of normals, degrees"), mean, degrees);
        let found: Vec<f64> = heights.read(gpu).expect("reads").into_iter().map(f64::from).collect();
        hold(&format!("{set}: 1 - correlation of heights"), 1.0 - correlate(&found, truth.values()), 1.0 - correlation);
    }
}

fn correlate(a: &[f64], b: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let (mut ab, mut aa, mut bb) = (0.0, 0.0, 0.0);
    for (a, b) in a.iter().zip(b) {
        let (a, b) = (a - mean_a, b - mean_b);
        (ab, aa, bb) = (ab + a * b, aa + a * a, bb + b * b);
    }
    ab / (aa * bb).sqrt()
}
