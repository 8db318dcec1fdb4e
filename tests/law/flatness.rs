use overpaint::{data::Map, gpu::Gpu, stage::Flatness};

use crate::support::{
    hold,
    surface::{plain, upload, with_heights},
};

crate::suite! { gpu: a_plane_is_flat_and_a_step_is_rough_around_it; }

/// Zero on level ground. A step of height h between two columns has slope h/2 at each of them and curvature ±h there, so that a texel
/// whose square holds both columns reads 2·5·(h²/4 + h²)/25.
fn a_plane_is_flat_and_a_step_is_rough_around_it(gpu: &Gpu) {
    let height = 0.5;
    let heights = Map::from_fn(32, 16, |column, _| if (8..24).contains(&column) { height } else { 0.0 });
    let field = upload(gpu, &with_heights(plain(32, 16), heights)).field;
    let mut recorder = gpu.recorder();
    let flatness = Flatness::new(gpu).expect("builds").record(&mut recorder, &field).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    let flatness = flatness.read(gpu).expect("reads");
    let at = |column: usize| f64::from(flatness[5 * 32 + column]);
    for flat in [0, 4, 15, 16, 28] {
        assert_eq!(at(flat), 0.0);
    }
    for rough in [7, 8, 23, 24] {
        // Rounding of normals and sums.
        hold("flatness: beside a step", (at(rough) - 0.4 * 1.25 * height * height).abs(), 1e-6);
    }
}
