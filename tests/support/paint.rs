//! Layers of paint laid on the adapter.

use overpaint::{
    gpu::Gpu,
    model::{Layer, Paint},
    stage::{AlphaBlend, KubelkaMunk, PaintStack},
};

/// A layer of grey paint of thickness 1, without relief.
pub fn grey(s: f64, k: f64) -> Layer {
    Layer::new(Paint { name: "grey".to_owned(), k: [k; 3], s: [s; 3] }, 1.0, 0.0)
}

/// A texel's paint, as the adapter has it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Texel {
    /// ρ_d in R, G, B and coverage.
    pub painted: [f32; 4],
    /// F₀ and α of the surface.
    pub coat: [f32; 2],
    /// Texel widths.
    pub height: f32,
}

impl Texel {
    /// Bare material of `diffuse` reflectance at height 0.
    pub fn bare([r, g, b]: [f32; 3]) -> Self {
        Self { painted: [r, g, b, 0.0], coat: [0.0; 2], height: 0.0 }
    }

    /// Reflectance, coverage, F₀ and α.
    pub fn values(&self) -> [f64; 6] {
        let ([r, g, b, coverage], [f0, alpha]) = (self.painted, self.coat);
        [r, g, b, coverage, f0, alpha].map(f64::from)
    }
}

/// `grounds`, `[texel]`, under `layers`, the bottom one first, each with its thickness at every texel, in batches of at
/// most `batch`.
pub fn lay(gpu: &Gpu, grounds: &[Texel], layers: &[(&Layer, &[f32])], batch: usize) -> Vec<Texel> {
    let stage = KubelkaMunk::new(gpu).expect("builds");
    let painted = gpu.upload("painted", &grounds.iter().map(|texel| texel.painted).collect::<Vec<_>>()).expect("fits");
    let coats = gpu.upload("coats", &grounds.iter().map(|texel| texel.coat).collect::<Vec<_>>()).expect("fits");
    let heights = gpu.upload("heights", &grounds.iter().map(|texel| texel.height).collect::<Vec<_>>()).expect("fits");
    let mut stack = PaintStack::new(gpu, painted, coats, heights, layers.len(), batch).expect("fits");
    let mut recorder = gpu.recorder();
    for layers in layers.chunks(batch) {
        let drawn: Vec<f32> = layers.iter().flat_map(|(_, drawn)| drawn.iter().copied()).collect();
        let drawn = gpu.upload("drawn", &drawn).expect("fits");
        let layers: Vec<_> = layers.iter().map(|(layer, _)| (*layer).clone()).collect();
        stage.record(&mut recorder, &mut stack, &drawn, &layers).expect("records");
    }
    gpu.submit(recorder).wait(gpu).expect("runs");
    let painted = stack.painted.read(gpu).expect("reads");
    let (coats, heights) = (stack.coats.read(gpu).expect("reads"), stack.heights.read(gpu).expect("reads"));
    let texels = painted.into_iter().zip(coats).zip(heights);
    texels.map(|((painted, coat), height)| Texel { painted, coat, height }).collect()
}

/// As [`lay`], by alpha blending: colour and coverage.
pub fn blend(gpu: &Gpu, grounds: &[[f32; 4]], layers: &[(&Layer, &[f32])]) -> Vec<[f32; 4]> {
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
