use overpaint::{
    gpu::Gpu,
    model::{Pattern, Placement},
    reference, stage,
};

use crate::support::{hold, worst_difference};

crate::suite! { gpu: agrees_with_its_twin, agrees_wherever_it_is_placed, layers_are_drawn_beside_each_other; }

const PATTERNS: [Pattern; 11] = [
    Pattern::Uniform { drawn: 0.3 },
    Pattern::Splash { seed: 1 },
    Pattern::Splash { seed: u32::MAX },
    Pattern::Flower { seed: 1, petals: 3 },
    Pattern::Flower { seed: u32::MAX, petals: 16 },
    Pattern::Brush { seed: 1, width: 0.25 },
    Pattern::Brush { seed: u32::MAX, width: 0.5 },
    Pattern::Spatter { seed: 1, cover: 0.2 },
    Pattern::Spatter { seed: u32::MAX, cover: 0.9 },
    Pattern::Stripes { count: 7, width: 0.3 },
    Pattern::Noise { seed: u32::MAX, count: 3 },
];

/// Places are exact to a few times 3e-8 of the plane, and edges at most 500 per unit of length steep: 2e-5 for a square plane. A
/// dozen operations in f32, a splash's fourth root and a flower's many layers among them, stay below that.
const BOUND: f64 = 1e-4;

fn worst(gpu: &Gpu, stage: &stage::Pattern, pattern: Pattern, placement: Placement, [width, height]: [u32; 2]) -> f64 {
    let mut recorder = gpu.recorder();
    let drawn = gpu.fresh("drawn", width as usize * height as usize).expect("fits");
    stage.record(&mut recorder, pattern, placement, [width, height], &drawn, 0).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    let found: Vec<f32> = drawn.read(gpu).expect("reads");
    let expected = reference::pattern(pattern, placement, width, height);
    worst_difference(found.into_iter().map(f64::from), expected.values().iter().copied())
}

fn agrees_with_its_twin(gpu: &Gpu) {
    let stage = stage::Pattern::new(gpu).expect("builds");
    let placement = Placement::default();
    for pattern in PATTERNS {
        // Both sides of a workgroup, wide and tall planes, and one that is a thousand times as wide as tall.
        for size in [[1, 1], [63, 1], [64, 1], [65, 1], [100, 50], [77, 191], [160, 160], [3000, 3]] {
            hold("pattern: drawn thickness", worst(gpu, &stage, pattern, placement, size), BOUND);
        }
    }
    // One row past 65,535 workgroups of 64.
    hold("pattern: drawn thickness", worst(gpu, &stage, Pattern::Uniform { drawn: 1.0 }, placement, [64 * 257, 256]), BOUND);
}

fn agrees_wherever_it_is_placed(gpu: &Gpu) {
    let stage = stage::Pattern::new(gpu).expect("builds");
    let placements = [
        Placement { offset: [-0.3, 0.45], rotation: 0.7, ..Placement::default() },
        Placement { tiling: [3, 2], offset: [7.25, -3.5], rotation: -2.0, size: 0.3 },
        Placement { size: 2.5, rotation: 1.0, ..Placement::default() },
        Placement { size: 4.0, offset: [-0.1, -0.2], rotation: 3.0, ..Placement::default() },
        Placement { tiling: [7, 5], rotation: std::f64::consts::FRAC_PI_2, ..Placement::default() },
        // Cells of less than a texel.
        Placement { tiling: [1000, 999], size: 0.001, ..Placement::default() },
    ];
    for pattern in PATTERNS {
        for placement in placements {
            for size in [[90, 60], [64, 97]] {
                hold("pattern: drawn thickness, placed", worst(gpu, &stage, pattern, placement, size), BOUND);
            }
        }
    }
}

fn layers_are_drawn_beside_each_other(gpu: &Gpu) {
    let stage = stage::Pattern::new(gpu).expect("builds");
    let drawn = gpu.fresh("drawn", 3 * 70).expect("fits");
    let mut recorder = gpu.recorder();
    for (layer, thickness) in [(0, 0.25), (2, 0.75), (1, 0.5)] {
        let pattern = Pattern::Uniform { drawn: thickness };
        stage.record(&mut recorder, pattern, Placement::default(), [10, 7], &drawn, layer).expect("records");
    }
    gpu.submit(recorder).wait(gpu).expect("runs");
    let expected: Vec<_> = [0.25, 0.5, 0.75_f32].into_iter().flat_map(|thickness| [thickness; 70]).collect();
    assert_eq!(drawn.read(gpu).expect("reads"), expected);
}
