//! Surfaces to look at, the same on both sides, and pictures of them.

use std::f64::consts::TAU;

use nv_flip::{FlipImageRgb8, FlipPool};
use overpaint::{
    data::{Direction, Map},
    gpu::Gpu,
    model::{Boundary, Coat, Frame, PaintMethod, Relief},
    reference, stage,
};

use super::random::Random;

/// A flat, white, diffuse, unpainted surface.
pub fn plain(width: usize, height: usize) -> reference::Surface {
    reference::Surface {
        heights: Map::from_fn(width, height, |_, _| 0.0),
        normals: Map::from_fn(width, height, |_, _| [0.0, 0.0, 1.0]),
        diffuse: Map::from_fn(width, height, |_, _| [1.0; 3]),
        frame: Frame::Plane,
        ambient: 0.0,
        lobes: vec![(Map::from_fn(width, height, |_, _| [0.0; 3]), Map::from_fn(width, height, |_, _| [-1.0, -1.0, 1.0, 1.0]))],
        painted: Map::from_fn(width, height, |_, _| [0.0; 4]),
        boundary: Boundary::Periodic,
        coat: Map::from_fn(width, height, |_, _| coat(Coat::default())),
        method: PaintMethod::default(),
    }
}

/// F₀ and α as both sides have them.
pub fn coat(coat: Coat) -> [f64; 2] {
    [coat.f0(), coat.alpha()].map(single)
}

/// Rounded through f32, so that both sides start from the same numbers.
fn single(value: f64) -> f64 {
    f64::from(value as f32)
}

/// Replaces the heights, and the normals by those of the new heights.
pub fn with_heights(surface: reference::Surface, heights: Map<f64>) -> reference::Surface {
    let heights = heights.map(|&z| single(z));
    let normals = reference::normals(&heights, surface.boundary).map(|normal| normal.map(single));
    reference::Surface { heights, normals, ..surface }
}

/// A bumpy, glossy surface painted in smooth blobs. The relief is a sum of waves of at least eight texels, so that neighbouring
/// patches differ little and only true silhouettes are discontinuous.
pub fn bumpy(width: usize, height: usize, boundary: Boundary, seed: u64) -> reference::Surface {
    let mut random = Random::new(seed);
    let waves: Vec<_> = (0..6)
        .map(|_| {
            let [x, y] = [width, height].map(|texels| random.below(texels.div_euclid(8).min(5) + 1) as f64 / texels as f64);
            (x, y, random.between(0.0, TAU), random.between(0.2, 0.7))
        })
        .collect();
    let wave = |column: usize, row: usize| -> f64 {
        waves.iter().map(|(x, y, phase, amplitude)| amplitude * (TAU * (x * column as f64 + y * row as f64) + phase).cos()).sum()
    };
    let mut colour = |low: f64, high: f64| Map::from_fn(width, height, |_, _| [(); 3].map(|()| single(random.between(low, high))));
    let (diffuse, specular, pigment) = (colour(0.1, 0.5), colour(0.0, 0.5), colour(0.05, 0.9));
    let lobe = Map::from_fn(width, height, |_, _| {
        let c = random.between(-1.0, -0.8);
        [c, c + 0.05, random.between(0.7, 1.0), random.between(2.0, 20.0)].map(single)
    });
    let painted = Map::from_fn(width, height, |column, row| {
        let [r, g, b] = pigment[(column, row)];
        [r, g, b, single((0.5 + wave(row, column)).clamp(0.0, 1.0))]
    });
    let surface = reference::Surface { diffuse, lobes: vec![(specular, lobe)], painted, boundary, ..plain(width, height) };
    with_heights(surface, Map::from_fn(width, height, wave))
}

/// The surface on the adapter.
pub fn upload(gpu: &Gpu, surface: &reference::Surface) -> stage::Surface {
    let three = |map: &Map<[f64; 3]>| map.values().iter().map(|v| [v[0] as f32, v[1] as f32, v[2] as f32, 0.0]).collect::<Vec<_>>();
    let four = |map: &Map<[f64; 4]>| map.values().iter().map(|v| v.map(|x| x as f32)).collect::<Vec<_>>();
    let upload = |values: Vec<[f32; 4]>| gpu.upload("map", &values).expect("fits");
    let heights: Vec<_> = surface.heights.values().iter().map(|&z| z as f32).collect();
    stage::Surface {
        field: stage::HeightField {
            size: [surface.heights.width() as u32, surface.heights.height() as u32],
            heights: gpu.upload("heights", &heights).expect("fits"),
            normals: upload(three(&surface.normals)),
            range: [heights.iter().copied().fold(f32::INFINITY, f32::min), heights.iter().copied().fold(f32::NEG_INFINITY, f32::max)],
            boundary: surface.boundary,
        },
        frame: surface.frame,
        ambient: surface.ambient,
        diffuse: upload(three(&surface.diffuse)),
        specular: upload(surface.lobes.iter().flat_map(|(specular, _)| three(specular)).collect()),
        lobes: upload(surface.lobes.iter().flat_map(|(_, lobe)| four(lobe)).collect()),
        levels: 1,
        painted: upload(four(&surface.painted)),
        coats: gpu.upload("coats", &surface.coat.values().iter().map(|coat| coat.map(|x| x as f32)).collect::<Vec<_>>()).expect("fits"),
        method: surface.method,
    }
}

/// The reconstructed picture, from the adapter.
pub fn reconstruct(gpu: &Gpu, surface: &stage::Surface, view: Direction, light: Direction, relief: Relief) -> Map<[f32; 4]> {
    let stage = stage::Reconstruct::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let picture = stage.record(&mut recorder, surface, view, light, relief).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    let [width, height] = surface.field.size.map(|texels| texels as usize);
    Map::new(width, height, picture.read(gpu).expect("reads")).expect("one pixel a texel")
}

/// How two pictures differ: mean FLIP, share of pixels that differ by more than `tolerance` in some channel. NaN if not finite.
pub fn compare(found: &Map<[f32; 4]>, expected: &Map<[f64; 4]>, tolerance: f64) -> [f64; 2] {
    if found.values().iter().flatten().any(|value| !value.is_finite()) || expected.values().iter().flatten().any(|value| !value.is_finite())
    {
        return [f64::NAN; 2];
    }
    let image = |values: &mut dyn Iterator<Item = [f64; 3]>| {
        let bytes: Vec<_> = values.flat_map(|rgb| rgb.map(|c| (255.0 * c.clamp(0.0, 1.0).powf(1.0 / 2.2)).round() as u8)).collect();
        FlipImageRgb8::with_data(expected.width() as u32, expected.height() as u32, &bytes)
    };
    let found_image = image(&mut found.values().iter().map(|v| [0, 1, 2].map(|c| f64::from(v[c]))));
    let expected_image = image(&mut expected.values().iter().map(|v| [v[0], v[1], v[2]]));
    let flip = nv_flip::flip(expected_image, found_image, nv_flip::DEFAULT_PIXELS_PER_DEGREE);
    let differing =
        found.values().iter().zip(expected.values()).filter(|(f, e)| (0..4).any(|c| (f64::from(f[c]) - e[c]).abs() > tolerance));
    [f64::from(FlipPool::from_image(&flip).mean()), differing.count() as f64 / expected.values().len() as f64]
}
