use std::f64::consts::FRAC_PI_2;

use overpaint::{
    gpu::Gpu,
    model::{Pattern, Placement},
    stage,
};

use crate::support::{Worst, hold};

crate::suite! {
    plain: lattices_and_waves_are_whole;
    gpu: thickness_stays_in_range, the_plane_repeats, tiles_are_cells_side_by_side, an_offset_shifts, a_quarter_turn_turns,
        resolution_does_not_matter, a_coarse_plane_shows_means, seeds_matter_and_repeat, the_part_asked_for_is_covered, clouds_use_the_range;
}

const PATTERNS: [Pattern; 7] = [
    Pattern::Uniform { drawn: 0.4 },
    Pattern::Splash { seed: 3 },
    Pattern::Flower { seed: 3, petals: 6 },
    Pattern::Brush { seed: 3, width: 0.3 },
    Pattern::Spatter { seed: 3, cover: 0.3 },
    Pattern::Stripes { count: 5, width: 0.4 },
    Pattern::Noise { seed: 3, count: 2 },
];

fn draw(gpu: &Gpu, pattern: Pattern, placement: Placement, [width, height]: [u32; 2]) -> Vec<f32> {
    let stage = stage::Pattern::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let drawn = gpu.fresh("drawn", width as usize * height as usize).expect("fits");
    stage.record(&mut recorder, pattern, placement, [width, height], &drawn, 0).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    drawn.read(gpu).expect("reads")
}

fn mean(drawn: &[f32]) -> f64 {
    drawn.iter().copied().map(f64::from).sum::<f64>() / drawn.len() as f64
}

/// Part of the texels with more than half of what paint has at its edge.
fn covered(drawn: &[f32]) -> f64 {
    drawn.iter().filter(|&&thickness| thickness > 0.28).count() as f64 / drawn.len() as f64
}

/// Whole numbers nearest to what is asked for, and at least one.
fn lattices_and_waves_are_whole() {
    let placed = |rotation: f64, size: f64| Placement { rotation, size, ..Placement::default() };
    assert_eq!(placed(0.3, 1.0).lattice(6, [100, 150]), [6, 9]);
    assert_eq!(placed(0.0, 4.0).lattice(1, [64, 64]), [1, 1]);
    assert_eq!(placed(0.0, 1.0).wave(7, [64, 64]), [0.0, 7.0]);
    assert_eq!(placed(FRAC_PI_2, 1.0).wave(7, [64, 128]), [-7.0, 0.0]);
    assert_eq!(placed(0.0, 4.0).wave(1, [64, 64]), [0.0, 1.0]);
    assert_eq!(placed(-FRAC_PI_2, 4.0).wave(1, [64, 64]), [1.0, 0.0]);
    // tan 0.46 = 0.495: one across for two up.
    assert_eq!(placed(0.46, 1.0).wave(10, [64, 64]), [-4.0, 9.0]);
}

/// Between 0 and 1 everywhere; splash, flower and stroke are bare somewhere and reach nearly full thickness somewhere.
fn thickness_stays_in_range(gpu: &Gpu) {
    for seed in 0..6 {
        let patterns = [
            Pattern::Splash { seed },
            Pattern::Flower { seed, petals: 3 + 2 * seed },
            Pattern::Brush { seed, width: 0.25 },
            Pattern::Spatter { seed, cover: 0.5 },
            Pattern::Stripes { count: 1 + 4 * seed, width: 0.3 },
            Pattern::Noise { seed, count: 4 },
        ];
        for pattern in patterns {
            let drawn = draw(gpu, pattern, Placement::default(), [256, 192]);
            assert!(drawn.iter().all(|thickness| (0.0..=1.0).contains(thickness)), "{pattern:?}");
            assert!(drawn.iter().any(|&thickness| thickness > 0.8), "{pattern:?} has no thick spot");
            let covered = covered(&drawn);
            let sparse = matches!(pattern, Pattern::Splash { .. } | Pattern::Flower { .. } | Pattern::Brush { .. });
            assert!(!sparse || (0.05..0.6).contains(&covered), "{pattern:?} covers {covered}");
        }
    }
}

/// Across the seam neighbours differ no more than they do anywhere inside, also where a pattern lies on the seam and turned.
fn the_plane_repeats(gpu: &Gpu) {
    let (width, height) = (160, 120);
    for pattern in PATTERNS {
        for size in [0.7, 1.0, 2.5] {
            let placement = Placement { offset: [0.55, -0.4], rotation: 0.6, size, ..Placement::default() };
            let drawn = draw(gpu, pattern, placement, [width as u32, height as u32]);
            let step = |a: usize, b: usize| f64::from((drawn[a] - drawn[b]).abs());
            let inside = (0..height)
                .flat_map(|row| (1..width).map(move |column| (row * width + column, row * width + column - 1)))
                .chain((1..height).flat_map(|row| (0..width).map(move |column| (row * width + column, (row - 1) * width + column))))
                .map(|(a, b)| step(a, b))
                .worst();
            let seams = (0..height).map(|row| step(row * width, row * width + width - 1));
            let seams = seams.chain((0..width).map(|column| step(column, (height - 1) * width + column)));
            hold("pattern: steps across the seam less the largest inside", seams.worst() - inside, 0.0);
        }
    }
}

fn tiles_are_cells_side_by_side(gpu: &Gpu) {
    let (width, height) = (60_usize, 44_usize);
    for pattern in PATTERNS {
        let one = Placement { offset: [0.3, 0.4], rotation: 1.1, size: 0.8, ..Placement::default() };
        let cell = draw(gpu, pattern, one, [width as u32, height as u32]);
        let plane = draw(gpu, pattern, Placement { tiling: [3, 2], ..one }, [3 * width as u32, 2 * height as u32]);
        for (texel, &thickness) in plane.iter().enumerate() {
            let (column, row) = (texel % (3 * width) % width, texel / (3 * width) % height);
            assert_eq!(thickness, cell[row * width + column], "{pattern:?} at {texel}");
        }
    }
}

/// Right and up by whole texels, around the edges.
fn an_offset_shifts(gpu: &Gpu) {
    let (width, height) = (90_usize, 60_usize);
    let (right, up) = (37_usize, 22_usize);
    for pattern in PATTERNS {
        let at = |offset: [f64; 2]| draw(gpu, pattern, Placement { offset, rotation: 0.3, ..Placement::default() }, [90, 60]);
        let [drawn, moved] = [at([0.0, 0.0]), at([right as f64 / 60.0, up as f64 / 60.0])];
        let pairs = (0..width * height).map(|texel| {
            let (column, row) = ((texel % width + right) % width, (texel / width + height - up) % height);
            (drawn[texel] - moved[row * width + column]).abs()
        });
        // Places are rounded to 6e-8 of the plane after the offset, and no edge is steeper than 1 in a texel of 1/60.
        hold("pattern: an offset", pairs.worst(), 3e-5);
    }
}

/// A quarter turn counter-clockwise takes (x, y) to (-y, x): column c and row r go to column r and row n - 1 - c. What fills its cell
/// with a lattice is not turned.
fn a_quarter_turn_turns(gpu: &Gpu) {
    let n = 96;
    for pattern in PATTERNS.into_iter().filter(|pattern| !matches!(pattern, Pattern::Spatter { .. } | Pattern::Noise { .. })) {
        let at = |rotation| draw(gpu, pattern, Placement { rotation, ..Placement::default() }, [n as u32, n as u32]);
        let (flat, turned) = (at(0.0), at(FRAC_PI_2));
        let pairs = (0..n * n).map(|texel| (flat[texel], turned[(n - 1 - texel % n) * n + texel / n]));
        // The turn itself is exact; sums may be taken in another order.
        hold("pattern: a quarter turn", pairs.map(|(a, b)| (a - b).abs()).worst(), 1e-6);
        assert_eq!(flat, at(-4.0 * FRAC_PI_2));
    }
}

/// Where all features are wider than a texel, the centre of a texel is that of the middle one of its 3x3 at three times the resolution.
fn resolution_does_not_matter(gpu: &Gpu) {
    let placement = Placement { size: 4.0, ..Placement::default() };
    let patterns = [Pattern::Splash { seed: 3 }, Pattern::Stripes { count: 4, width: 0.4 }, Pattern::Noise { seed: 3, count: 1 }];
    for pattern in patterns {
        let (coarse, fine) = (draw(gpu, pattern, placement, [120, 80]), draw(gpu, pattern, placement, [360, 240]));
        let pairs = (0..120 * 80).map(|texel| (coarse[texel], fine[(3 * (texel / 120) + 1) * 360 + 3 * (texel % 120) + 1]));
        // Two roundings of the same place, as in the parity test.
        hold("pattern: coarse against fine", pairs.map(|(a, b)| (a - b).abs()).worst(), 1e-4);
    }
}

/// A texel shows about the mean of the 8x8 that it holds at eight times the resolution.
fn a_coarse_plane_shows_means(gpu: &Gpu) {
    let (width, height, times) = (72, 48, 8);
    for pattern in PATTERNS {
        let coarse = draw(gpu, pattern, Placement::default(), [width as u32, height as u32]);
        let fine = draw(gpu, pattern, Placement::default(), [(times * width) as u32, (times * height) as u32]);
        let mut square = 0.0;
        for (texel, &thickness) in coarse.iter().enumerate() {
            let first = texel / width * times * times * width + texel % width * times;
            let sum: f32 = (0..times * times).map(|inner| fine[first + inner / times * times * width + inner % times]).sum();
            square += f64::from(thickness - sum / (times * times) as f32).powi(2);
        }
        let rms = (square / coarse.len() as f64).sqrt();
        if let Pattern::Spatter { .. } = pattern {
            // Drops that lie closer than a few texels are a veil, from which their means stray.
            hold("pattern: coarse spatter against the mean of fine, rms", rms, 0.17);
        } else {
            // A smooth edge over 1.5 texels against a box of one: they differ by up to 0.1 in the few texels that an edge crosses.
            hold("pattern: coarse against the mean of fine, rms", rms, 0.05);
        }
        hold("pattern: mean of coarse against fine", (mean(&coarse) - mean(&fine)).abs(), 0.01);
    }
}

fn seeds_matter_and_repeat(gpu: &Gpu) {
    let patterns = [
        |seed| Pattern::Splash { seed },
        |seed| Pattern::Flower { seed, petals: 5 },
        |seed| Pattern::Brush { seed, width: 0.3 },
        |seed| Pattern::Spatter { seed, cover: 0.3 },
        |seed| Pattern::Noise { seed, count: 3 },
    ];
    for pattern in patterns {
        let at = |seed| draw(gpu, pattern(seed), Placement::default(), [64, 64]);
        assert_eq!(at(7), at(7));
        assert_ne!(at(7), at(8));
    }
}

fn the_part_asked_for_is_covered(gpu: &Gpu) {
    for cover in [0.1, 0.3, 0.6, 0.9] {
        let seeds = 0..6;
        let parts = seeds.map(|seed| covered(&draw(gpu, Pattern::Spatter { seed, cover }, Placement::default(), [512, 512])));
        let found = parts.sum::<f64>() / 6.0;
        // At 0.1 a handful of large drops cover a third of it, and that is up to chance.
        hold("pattern: covered part of a spatter", (found - cover).abs(), 0.04);
    }
    for (count, width) in [(1, 0.01), (7, 0.3), (7, 0.9), (60, 0.5), (500, 0.2)] {
        for rotation in [0.0, 0.4] {
            let placement = Placement { rotation, ..Placement::default() };
            let found = mean(&draw(gpu, Pattern::Stripes { count, width }, placement, [96, 80]));
            // What samples at 80 or more phases leave of the edges' softness.
            hold("pattern: painted part of stripes", (found - width).abs(), 1e-3);
        }
    }
}

fn clouds_use_the_range(gpu: &Gpu) {
    for seed in 0..4 {
        let drawn = draw(gpu, Pattern::Noise { seed, count: 4 }, Placement::default(), [128, 128]);
        assert!(drawn.iter().any(|&thickness| thickness < 0.1) && drawn.iter().any(|&thickness| thickness > 0.9), "seed {seed}");
        assert!((mean(&drawn) - 0.5).abs() < 0.1, "seed {seed}: mean {}", mean(&drawn));
    }
}
