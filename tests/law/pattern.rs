use overpaint::{gpu::Gpu, model::Pattern, stage};

use crate::support::{Worst, hold};

crate::suite! { gpu: thickness_stays_in_range, the_plane_repeats, resolution_does_not_matter, seeds_matter_and_repeat, a_turned_stroke_is_the_stroke_turned; }

const PATTERNS: [Pattern; 3] = [Pattern::Uniform { drawn: 1.0 }, Pattern::Splash { seed: 3 }, Pattern::Brush { seed: 3, width: 0.3 }];

fn draw(gpu: &Gpu, pattern: Pattern, size: [u32; 2]) -> Vec<f32> {
    let stage = stage::Pattern::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let drawn = stage.record(&mut recorder, pattern, size).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    drawn.read(gpu).expect("reads")
}

/// Between 0 and 1 everywhere; splash and stroke are bare somewhere and reach nearly full thickness somewhere.
fn thickness_stays_in_range(gpu: &Gpu) {
    assert!(draw(gpu, Pattern::Uniform { drawn: 1.0 }, [33, 20]).iter().all(|&t| t == 1.0));
    for seed in 0..8 {
        for pattern in [Pattern::Splash { seed }, Pattern::Brush { seed, width: 0.25 }] {
            let drawn = draw(gpu, pattern, [128, 96]);
            assert!(drawn.iter().all(|t| (0.0..=1.0).contains(t)), "{pattern:?}");
            let covered = drawn.iter().filter(|&&t| t > 0.05).count() as f64 / drawn.len() as f64;
            assert!((0.05..0.6).contains(&covered), "{pattern:?} covers {covered}");
            assert!(drawn.iter().any(|&t| t > 0.8), "{pattern:?} has no thick spot");
        }
    }
}

/// Across the seam neighbours differ no more than they do anywhere inside.
fn the_plane_repeats(gpu: &Gpu) {
    let (width, height) = (160, 120);
    for pattern in PATTERNS {
        let drawn = draw(gpu, pattern, [width as u32, height as u32]);
        let step = |a: usize, b: usize| f64::from((drawn[a] - drawn[b]).abs());
        let inside = (0..height)
            .flat_map(|row| (1..width).map(move |column| (row * width + column, row * width + column - 1)))
            .map(|(a, b)| step(a, b))
            .worst();
        let seams = (0..height).map(|row| step(row * width, row * width + width - 1));
        let seams = seams.chain((0..width).map(|column| step(column, (height - 1) * width + column)));
        hold("pattern: steps across the seam less the largest inside", seams.worst() - inside, 0.0);
    }
}

/// The centre of a texel is the centre of the middle one of its 3x3 in a plane of three times the resolution.
fn resolution_does_not_matter(gpu: &Gpu) {
    for pattern in PATTERNS {
        let (coarse, fine) = (draw(gpu, pattern, [90, 60]), draw(gpu, pattern, [270, 180]));
        let pairs = (0..90 * 60).map(|texel| (coarse[texel], fine[(3 * (texel / 90) + 1) * 270 + 3 * (texel % 90) + 1]));
        let worst = pairs.map(|(a, b)| (a - b).abs()).worst();
        // Two roundings of the same place, as in the parity test.
        hold("pattern: coarse against fine", worst, 4e-4);
    }
}

fn seeds_matter_and_repeat(gpu: &Gpu) {
    for pattern in [|seed| Pattern::Splash { seed }, |seed| Pattern::Brush { seed, width: 0.3 }] {
        assert_eq!(draw(gpu, pattern(7), [64, 64]), draw(gpu, pattern(7), [64, 64]));
        assert_ne!(draw(gpu, pattern(7), [64, 64]), draw(gpu, pattern(8), [64, 64]));
    }
}

/// A quarter turn counter-clockwise takes (x, y) to (-y, x): column c and row r go to column r and row n - 1 - c.
fn a_turned_stroke_is_the_stroke_turned(gpu: &Gpu) {
    let n = 96;
    let stroke = |angle| draw(gpu, Pattern::Brush { seed: 2, angle, width: 0.3 }, [n as u32, n as u32]);
    let (flat, turned) = (stroke(0.0), stroke(std::f64::consts::FRAC_PI_2));
    let pairs = (0..n * n).map(|texel| (flat[texel], turned[(n - 1 - texel % n) * n + texel / n]));
    hold("pattern: a quarter turn", pairs.map(|(a, b)| (a - b).abs()).worst(), 4e-4);
}
