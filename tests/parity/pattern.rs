use overpaint::{gpu::Gpu, model::Pattern, reference, stage};

use crate::support::{hold, worst_difference};

crate::suite! { gpu: agrees_with_its_twin; }

fn agrees_with_its_twin(gpu: &Gpu) {
    let stage = stage::Pattern::new(gpu).expect("builds");
    let patterns = [
        Pattern::Uniform { drawn: 1.0 },
        Pattern::Splash { seed: 1 },
        Pattern::Splash { seed: u32::MAX },
        Pattern::Brush { seed: 1, width: 0.25 },
        Pattern::Brush { seed: u32::MAX, width: 0.4 },
    ];
    let draw = |pattern: Pattern, [width, height]: [u32; 2]| {
        let mut recorder = gpu.recorder();
        let drawn = stage.record(&mut recorder, pattern, [width, height]).expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");
        let found = drawn.read(gpu).expect("reads");
        let expected = reference::pattern(pattern, width, height);
        worst_difference(found.into_iter().map(f64::from), expected.values().iter().copied())
    };
    for pattern in patterns {
        // Both sides of a workgroup, wide and tall planes, and one that is a thousand times as wide as tall.
        for size in [[1, 1], [63, 1], [64, 1], [65, 1], [100, 50], [77, 191], [3000, 3]] {
            // Tile coordinates are exact to 3e-8 of the plane; a splash's outline is 0.009 wide and a bristle's noise cell less
            // than 0.25/19/2 with marks five times as steep, so that thickness changes by a few hundred per unit of length.
            hold("pattern: drawn thickness", draw(pattern, size), 2e-4);
        }
    }
    // One row past 65,535 workgroups of 64.
    hold("pattern: drawn thickness", draw(Pattern::Uniform { drawn: 1.0 }, [64 * 257, 256]), 2e-4);
}
