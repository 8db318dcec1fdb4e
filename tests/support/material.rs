//! Materials of random numbers, for those who write and read them.

use half::f16;
use overpaint::{
    data::{
        Candidate, Choice, Direction, Encoding, Fit, FitStatus, Learned, Left, Lobe, Lpca, LpcaCandidate, MAX_LOBES, Map, Material,
        Painted, Pair, Provenance, Svbrdf, Transfer,
    },
    model::{FitSettings, Frame, Layer, Paint, PaintMethod, Pattern, Placement, SurfaceMode},
};

use super::random::Random;

/// Paint of random numbers on a plane: two layers, one of which draws an image.
pub fn painted([width, height]: [usize; 2], seed: u64) -> Painted {
    let mut random = Random::new(seed);
    let mut value = move || random.between(0.0, 1.0) as f32;
    let layer =
        |name: &str, pattern| Layer { pattern, ..Layer::new(Paint { name: name.to_owned(), k: [0.1 + 0.2; 3], s: [1e-7; 3] }, 0.3, 2.0) };
    let mut turned = layer("watercolour/own", Pattern::Splash { seed: u32::MAX });
    turned.placement = Placement { tiling: [2, 3], offset: [0.1 + 0.2, -1.0], rotation: std::f64::consts::PI, size: 1.0 / 3.0 };
    Painted {
        method: PaintMethod::KubelkaMunk,
        layers: vec![turned, layer("leaf", Pattern::Image { image: 0 })],
        images: vec!["leaf.png".to_owned()],
        height: Map::from_fn(width, height, |_, _| value()),
        normal: Map::from_fn(width, height, |_, _| [value(), value(), value()]),
        reflectance: Map::from_fn(width, height, |_, _| [value(), value(), value()]),
        coverage: Map::from_fn(width, height, |_, _| value()),
        coat: Map::from_fn(width, height, |_, _| [value(), value()]),
    }
}

/// A material of 2 views and 3 lights, without a local PCA.
pub fn sample([width, height]: [usize; 2], seed: u64) -> Material {
    let mut random = Random::new(seed);
    let mut value = move || random.between(-1.0, 1.0) as f32;
    let settings = FitSettings { min_lobe: 0.1 + 0.2, max_slope: std::f64::consts::PI, ..FitSettings::default() };
    let mut height_map = Map::from_fn(width, height, |_, _| value());
    height_map[(0, 0)] = f32::MIN_POSITIVE / 8.0;
    Material {
        height: height_map,
        normal: Map::from_fn(width, height, |_, _| [value(), value(), value()]),
        normal_measured: Map::from_fn(width, height, |_, _| [value(), value(), value()]),
        albedo: Map::from_fn(width, height, |_, _| value()),
        svbrdf: Svbrdf {
            frame: Frame::Seen,
            ambient: 0.1 + 0.2,
            diffuse: Map::from_fn(width, height, |_, _| [value(), value(), value()]),
            lobes: (0..1 + width % MAX_LOBES)
                .map(|_| Lobe {
                    // A plane that is all one value is stored as well.
                    specular: Map::from_fn(width, height, |_, _| [0.0; 3]),
                    parameters: Map::from_fn(width, height, |_, _| [value(), value(), value(), value()]),
                })
                .collect(),
        },
        lpca: None,
        painted: None,
        fit: Fit {
            objective_without_lobe: Map::from_fn(width, height, |_, _| value()),
            objective: Map::from_fn(width, height, |_, _| f32::NAN),
            iterations: Map::from_fn(width, height, |x, y| (x * y) as u32),
            status: Map::from_fn(width, height, |x, y| ((x + y) % FitStatus::ALL.len()) as u32),
            masked: Map::from_fn(width, height, |x, y| (x + 2 * y) as u32),
        },
        choice: Choice {
            candidates: vec![
                Candidate {
                    height_scale: 1.0 / 3.0,
                    height_level: -0.25,
                    ambient: 0.1,
                    left: Some(Left { relative_rms: 0.25, bias: -0.01 }),
                    ..Candidate::new(SurfaceMode::Local, Frame::Seen)
                },
                Candidate::new(SurfaceMode::Rough, Frame::Plane),
            ],
            texels: 144,
            representative: Some([3, 4]),
        },
        provenance: Provenance {
            source: "a \"sample\", θ".to_owned(),
            views: vec![Direction::from_degrees(0.0, 0.0), Direction::from_degrees(23.5, 359.999_999)],
            lights: [15.1, 30.0, 89.999_999].map(|theta| Direction::from_degrees(theta, 3.0 * theta)).to_vec(),
            samples: 6,
            grid: Some("UBO81".to_owned()),
            encoding: Encoding::photograph(Transfer::Linear),
            adapter: "none".to_owned(),
            version: "0.1.0".to_owned(),
            settings,
        },
    }
}

/// A local PCA of the first `samples` pairs of [`sample`]'s directions, over and over.
pub fn local_pca([width, height]: [usize; 2], [samples, clusters, components]: [usize; 3]) -> Lpca {
    let mut random = Random::new(17);
    let mut halves = |count: usize| (0..count).map(|_| f16::from_f64(random.between(-4.0, 4.0))).collect::<Vec<_>>();
    let mut weights = halves(width * height * components);
    weights[0] = f16::MIN_POSITIVE_SUBNORMAL;
    let mut terms = halves(samples * clusters * (1 + components) * 3);
    terms[0] = f16::MAX;
    terms[1] = f16::NEG_ZERO;
    Lpca {
        // Not every view under every light, nor in their order.
        pairs: (0..samples).rev().map(|sample| Pair { view: sample % 2, light: sample / 2 % 3 }).collect(),
        clusters,
        components,
        cluster: Map::from_fn(width, height, |x, y| ((7 * x + 3 * y) % clusters) as u32),
        weights,
        terms,
        error: Map::from_fn(width, height, |x, y| 0.1 * (x + y) as f32),
        learned: Learned {
            relative_rms: 0.1 + 0.2,
            rank: 61,
            left_out: 1.0 / 3.0,
            errors: vec![0.3, 0.1 + 0.2, 5e-324],
            candidates: vec![LpcaCandidate { clusters: 4, components: 2, bytes: u64::MAX, error: 0.1 }],
        },
    }
}
