use std::f64::consts::{FRAC_PI_2, TAU};

use overpaint::{data::Map, gpu::Gpu, model::Placement, stage};

use crate::support::{Worst, hold, random::Random};

crate::suite! {
    gpu: an_image_at_its_own_resolution_comes_back, tiles_are_cells_side_by_side, a_quarter_turn_turns, an_even_image_stays_even,
        an_image_that_fills_its_cell_has_no_seam, the_rest_of_the_cell_is_bare, the_mean_of_a_smaller_image_is_kept,
        the_images_resolution_does_not_matter, an_empty_image_is_bare;
}

fn draw(gpu: &Gpu, image: &Map<f32>, placement: Placement, [width, height]: [u32; 2]) -> Map<f32> {
    let stage = stage::PatternImage::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let drawn = gpu.fresh("drawn", width as usize * height as usize).expect("fits");
    stage.record(&mut recorder, image, placement, [width, height], &drawn, 0).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    Map::new(width as usize, height as usize, drawn.read(gpu).expect("reads")).expect("one value a texel")
}

fn noise(width: usize, height: usize) -> Map<f32> {
    let mut random = Random::new(11);
    Map::from_fn(width, height, |_, _| random.unit() as f32)
}

/// Bit for bit, also where it is moved by whole texels around the edges.
fn an_image_at_its_own_resolution_comes_back(gpu: &Gpu) {
    let image = noise(77, 53);
    assert_eq!(draw(gpu, &image, Placement::default(), [77, 53]), image);
    let placement = Placement { offset: [-30.0 / 53.0, 20.0 / 53.0], ..Placement::default() };
    let moved = Map::from_fn(77, 53, |column, row| image[((column + 30) % 77, (row + 20) % 53)]);
    assert_eq!(draw(gpu, &image, placement, [77, 53]), moved);
}

fn tiles_are_cells_side_by_side(gpu: &Gpu) {
    let image = noise(40, 30);
    let one = Placement { offset: [0.3, 0.4], rotation: 1.1, size: 1.3, ..Placement::default() };
    let cell = draw(gpu, &image, one, [60, 44]);
    assert_eq!(draw(gpu, &image, Placement { tiling: [3, 2], ..one }, [180, 88]), cell.repeated(3, 2));
}

/// As in the law of procedural patterns; magnified, at its own resolution and reduced.
fn a_quarter_turn_turns(gpu: &Gpu) {
    for (pixels, texels) in [(20, 50), (50, 50), (600, 50)] {
        let image = noise(pixels, pixels);
        let [flat, turned] = [0.0, FRAC_PI_2]
            .map(|rotation| draw(gpu, &image, Placement { rotation, ..Placement::default() }, [texels as u32, texels as u32]));
        let pairs = (0..texels * texels).map(|texel| (texel % texels, texel / texels));
        let worst = pairs.map(|(column, row)| (flat[(column, row)] - turned[(row, texels - 1 - column)]).abs()).worst();
        // The turn itself is exact; sums are taken in another order.
        hold("pattern_image: a quarter turn", worst, 1e-6);
    }
}

/// An image of 0.5 is 0.5 wherever it covers a texel, and nowhere more.
fn an_even_image_stays_even(gpu: &Gpu) {
    for (width, height) in [(4, 3), (40, 30), (1200, 900)] {
        let image = Map::from_fn(width, height, |_, _| 0.5);
        let filled = draw(gpu, &image, Placement { offset: [0.21, 0.77], ..Placement::default() }, [120, 90]);
        // A quotient of sums of about ten weights.
        let uneven = |map: &Map<f32>| map.values().iter().map(|value| (value - 0.5).abs()).worst();
        hold("pattern_image: an even image", uneven(&filled), 1e-6);
        for size in [0.3, 0.8] {
            let placement = Placement { offset: [0.21, 0.77], rotation: 0.6, size, ..Placement::default() };
            let drawn = draw(gpu, &image, placement, [120, 90]);
            hold("pattern_image: an even image, above", drawn.values().iter().map(|value| value - 0.5).worst(), 1e-6);
            let full = drawn.values().iter().filter(|&&value| (value - 0.5).abs() < 1e-6).count() as f64 / (120.0 * 90.0);
            // At the border all around half a pixel is lost, or a texel and a half.
            let border = 3.0 / (90.0 * size) + 1.0 / height as f64;
            assert!(full > size * size * (1.0 - border).powi(2) && full < size * size, "{width} x {height}, {size}: {full}");
        }
    }
}

/// A wave that closes goes on across the seam as it does inside.
fn an_image_that_fills_its_cell_has_no_seam(gpu: &Gpu) {
    for (pixels, texels) in [(16, 100), (900, 50)] {
        let wave = |place: usize| 0.25 + 0.25 * (TAU * 2.0 * place as f64 / pixels as f64).sin();
        let image = Map::from_fn(pixels, pixels, |column, row| (wave(column) + wave(row)) as f32);
        let drawn = draw(gpu, &image, Placement { offset: [0.4, 0.1], ..Placement::default() }, [texels as u32, texels as u32]);
        let step = |column: usize, row: usize| {
            let right = drawn[((column + 1) % texels, row)] - drawn[(column, row)];
            let down = drawn[(column, (row + 1) % texels)] - drawn[(column, row)];
            right.abs().max(down.abs())
        };
        let inside = (0..texels - 1).flat_map(|row| (0..texels - 1).map(move |column| (column, row))).map(|(c, r)| step(c, r)).worst();
        let seam = (0..texels).map(|along| step(texels - 1, along).max(step(along, texels - 1))).worst();
        hold("pattern_image: steps across the seam less the largest inside", seam - inside, 1e-6);
    }
}

/// An image twice as wide as high fills the middle half of a square, to its left and right edges.
fn the_rest_of_the_cell_is_bare(gpu: &Gpu) {
    let image = Map::from_fn(64, 32, |_, _| 1.0);
    let drawn = draw(gpu, &image, Placement::default(), [64, 64]);
    let expected = Map::from_fn(64, 64, |_, row| if (16..48).contains(&row) { 1.0 } else { 0.0 });
    assert_eq!(drawn, expected);
}

fn the_mean_of_a_smaller_image_is_kept(gpu: &Gpu) {
    let image = noise(512, 256);
    let mean = |map: &Map<f32>| map.values().iter().copied().map(f64::from).sum::<f64>() / map.values().len() as f64;
    // Whole ratios, without and with reduction: each pixel takes part with the same weight, so that only roundings differ.
    for size in [[256, 128], [64, 32], [32, 16], [2, 1]] {
        let drawn = draw(gpu, &image, Placement::default(), size);
        hold("pattern_image: mean at a whole ratio", (mean(&drawn) - mean(&image)).abs(), 1e-6);
    }
    // Others: weights vary by less than the inverse square of the ratio, over pixels of standard deviation 0.29 that average out.
    for size in [[100, 50], [200, 100], [46, 23]] {
        let drawn = draw(gpu, &image, Placement::default(), size);
        hold("pattern_image: mean at any ratio", (mean(&drawn) - mean(&image)).abs(), 2e-4);
    }
}

/// A smooth picture looks the same from an image of 300 or of 1700 pixels, which is reduced first.
fn the_images_resolution_does_not_matter(gpu: &Gpu) {
    let picture = |pixels: usize| {
        let wave = |place: usize| 0.25 + 0.25 * (TAU * 3.0 * (place as f64 + 0.5) / pixels as f64).sin();
        Map::from_fn(pixels, pixels, |column, row| (wave(column) + wave(row)) as f32)
    };
    for rotation in [0.0, 0.7] {
        let placement = Placement { rotation, size: 0.6, ..Placement::default() };
        let [small, large] = [300, 1700].map(|pixels| draw(gpu, &picture(pixels), placement, [80, 80]));
        let worst = small.values().iter().zip(large.values()).map(|(a, b)| (a - b).abs()).worst();
        // The boxes of the reduction, a quarter of the tent wide, widen it by a sixtieth, at the border too, where a texel's step is 0.5.
        hold("pattern_image: large against small image", worst, 0.02);
    }
}

fn an_empty_image_is_bare(gpu: &Gpu) {
    for (width, height) in [(0, 0), (0, 5), (7, 0)] {
        let drawn = draw(gpu, &Map::from_fn(width, height, |_, _| 1.0), Placement::default(), [20, 20]);
        assert!(drawn.values().iter().all(|&value| value == 0.0));
    }
}
