//! Materials that are fully known, the same on both sides, and pictures of them.

use half::f16;
use overpaint::{
    data::{Block, Direction, Map},
    gpu::Gpu,
    model::Boundary,
    reference::SynthSurface,
    stage,
};

use super::surface::bumpy;

/// White and diffuse, of the given heights.
pub fn white(heights: Map<f64>) -> SynthSurface {
    SynthSurface {
        diffuse: heights.map(|_| [1.0; 3]),
        specular: heights.map(|_| [0.0; 3]),
        lobe: heights.map(|_| [-1.0, -1.0, 1.0, 1.0]),
        heights,
    }
}

/// Waves with another reflectance in every texel.
pub fn wavy(width: usize, height: usize, seed: u64) -> SynthSurface {
    let overpaint::reference::Surface { heights, diffuse, mut lobes, .. } = bumpy(width, height, Boundary::Periodic, seed);
    let (specular, lobe) = lobes.remove(0);
    SynthSurface { heights, diffuse, specular, lobe }
}

/// The material on the adapter.
pub fn upload(gpu: &Gpu, surface: &SynthSurface) -> stage::SynthSurface {
    let three = |map: &Map<[f64; 3]>| {
        let values: Vec<_> = map.values().iter().map(|v| [v[0] as f32, v[1] as f32, v[2] as f32, 0.0]).collect();
        gpu.upload("map", &values).expect("fits")
    };
    let size = [surface.heights.width() as u32, surface.heights.height() as u32];
    let values: Vec<f32> = surface.heights.values().iter().map(|&z| z as f32).collect();
    let lobe: Vec<_> = surface.lobe.values().iter().map(|v| v.map(|x| x as f32)).collect();
    let heights = gpu.upload("heights", &values).expect("fits");
    let mut recorder = gpu.recorder();
    let normals = stage::Normals::new(gpu).expect("builds");
    let normals = normals.record(&mut recorder, &heights, size, Boundary::Periodic).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    stage::SynthSurface {
        size,
        heights,
        normals,
        diffuse: three(&surface.diffuse),
        specular: three(&surface.specular),
        lobe: gpu.upload("lobe", &lobe).expect("fits"),
        height_range: [values.iter().copied().fold(f32::INFINITY, f32::min), values.iter().copied().fold(f32::NEG_INFINITY, f32::max)],
    }
}

/// Radiance of a block, one picture a sample.
pub fn render_block(gpu: &Gpu, surface: &stage::SynthSurface, block: Block, samples: &[(Direction, Direction)]) -> Vec<Map<[f64; 3]>> {
    let stage = stage::Synth::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let rendered = stage.record(&mut recorder, surface, block, samples).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    let texels = block.texels();
    let mut radiance = vec![f16::NAN; 3 * samples.len() * texels];
    rendered.read(gpu, &mut radiance).expect("reads");
    let picture = |values: &[f16]| {
        Map::from_fn(block.width, block.height, |column, row| {
            [0, 1, 2].map(|channel| values[channel * texels + row * block.width + column].to_f64())
        })
    };
    radiance.chunks_exact(3 * texels).map(picture).collect()
}

/// Radiance of the whole plane.
pub fn render(gpu: &Gpu, surface: &stage::SynthSurface, samples: &[(Direction, Direction)]) -> Vec<Map<[f64; 3]>> {
    render_block(gpu, surface, Block::whole(surface.size.map(|side| side as usize)), samples)
}
