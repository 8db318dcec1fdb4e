use overpaint::{
    data::Map,
    gpu::Gpu,
    model::Boundary,
    reference::{self, PaintLevel, Surface},
    stage::Minify,
};

use crate::support::{
    hold,
    surface::{bumpy, upload},
    worst_difference,
};

crate::suite! { gpu: agrees_with_its_twin; }

/// All levels of a surface's paint from the adapter, the finest first.
pub fn levels(gpu: &Gpu, surface: &Surface) -> Vec<PaintLevel> {
    let mut uploaded = upload(gpu, surface);
    let mut recorder = gpu.recorder();
    Minify::new(gpu).expect("builds").record(&mut recorder, &mut uploaded).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    let painted = uploaded.painted.read(gpu).expect("reads");
    let coats = uploaded.coats.read(gpu).expect("reads");
    let normals = uploaded.field.normals.read(gpu).expect("reads");
    let (mut begin, mut size) = (0, uploaded.field.size.map(|side| side as usize));
    let levels = (0..uploaded.levels).map(|_| {
        let [width, height] = size;
        let at = |column: usize, row: usize| begin + row * width + column;
        let level = PaintLevel {
            painted: Map::from_fn(width, height, |x, y| painted[at(x, y)].map(f64::from)),
            coat: Map::from_fn(width, height, |x, y| coats[at(x, y)].map(f64::from)),
            normals: Map::from_fn(width, height, |x, y| normals[at(x, y)].map(f64::from)),
        };
        begin += width * height;
        size = size.map(|side| (side / 2).max(1));
        level
    });
    let levels: Vec<_> = levels.collect();
    assert_eq!(begin, painted.len(), "the last level is one texel");
    levels
}

fn agrees_with_its_twin(gpu: &Gpu) {
    for (width, height) in [(1, 1), (2, 1), (63, 64), (65, 5), (37, 91)] {
        let surface = bumpy(width, height, Boundary::Periodic, 21);
        let levels = levels(gpu, &surface);
        for pair in levels.windows(2) {
            let expected = reference::minify(&pair[0]);
            let bare = |at| expected.painted[at][3] == 0.0;
            let flat = |values: &Map<[f64; 4]>| values.values().iter().copied().flatten().collect::<Vec<_>>();
            // Sums of up to nine products of values up to 1, and a quotient.
            let painted = worst_difference(flat(&pair[1].painted), flat(&expected.painted));
            hold("minify: reflectance and coverage", painted, 1e-6);
            let coat = |level: &PaintLevel| Map::from_fn(level.coat.width(), level.coat.height(), |x, y| if bare((x, y)) { [0.0; 2] } else { level.coat[(x, y)] });
            let coats = worst_difference(coat(&pair[1]).values().iter().copied().flatten(), coat(&expected).values().iter().copied().flatten());
            hold("minify: coats", coats, 1e-6);
            // What is left of 1 less a length near 1 has its rounding, twice.
            hold("minify: normals", worst_difference(flat(&pair[1].normals), flat(&expected.normals)), 2e-6);
        }
    }
}
