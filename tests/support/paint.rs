//! Layers of paint laid on the adapter.

use overpaint::{
    gpu::Gpu,
    model::{Layer, Paint},
    stage::{AlphaBlend, KubelkaMunk, PaintStack, PaintedTexel},
};

/// A layer of grey paint of thickness 1, without relief.
pub fn grey(s: f64, k: f64) -> Layer {
    Layer::new(Paint { name: "grey".to_owned(), k: [k; 3], s: [s; 3] }, 1.0, 0.0)
}

/// `grounds`, `[texel]`, and their heights under `layers`, the bottom one first, each with its thickness at every texel, in batches of at
/// most `batch`.
pub fn lay(
    gpu: &Gpu, grounds: &[PaintedTexel], heights: &[f32], layers: &[(&Layer, &[f32])], batch: usize,
) -> (Vec<PaintedTexel>, Vec<f32>) {
    let stage = KubelkaMunk::new(gpu).expect("builds");
    let ground = gpu.upload("ground", grounds).expect("fits");
    let heights = gpu.upload("heights", heights).expect("fits");
    let mut stack = PaintStack::new(gpu, ground, heights, layers.len(), batch).expect("fits");
    let mut recorder = gpu.recorder();
    for layers in layers.chunks(batch) {
        let drawn: Vec<f32> = layers.iter().flat_map(|(_, drawn)| drawn.iter().copied()).collect();
        let drawn = gpu.upload("drawn", &drawn).expect("fits");
        let layers: Vec<_> = layers.iter().map(|(layer, _)| (*layer).clone()).collect();
        stage.record(&mut recorder, &mut stack, &drawn, &layers).expect("records");
    }
    gpu.submit(recorder).wait(gpu).expect("runs");
    (stack.painted.read(gpu).expect("reads"), stack.heights.read(gpu).expect("reads"))
}

/// As [`lay`], by alpha blending.
pub fn blend(gpu: &Gpu, grounds: &[PaintedTexel], layers: &[(&Layer, &[f32])]) -> Vec<PaintedTexel> {
    let stage = AlphaBlend::new(gpu).expect("builds");
    let painted = gpu.upload("ground", grounds).expect("fits");
    let drawn: Vec<f32> = layers.iter().flat_map(|(_, drawn)| drawn.iter().copied()).collect();
    let drawn = gpu.upload("drawn", &drawn).expect("fits");
    let layers: Vec<_> = layers.iter().map(|(layer, _)| (*layer).clone()).collect();
    let mut recorder = gpu.recorder();
    stage.record(&mut recorder, &painted, &drawn, &layers).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    painted.read(gpu).expect("reads")
}

/// Reflectance, coverage, F₀ and α.
pub fn values(texel: &PaintedTexel) -> [f64; 6] {
    let [r, g, b] = texel.reflectance;
    [r, g, b, texel.coverage, texel.f0, texel.roughness].map(f64::from)
}
