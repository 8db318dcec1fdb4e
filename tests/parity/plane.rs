use overpaint::{
    data::{Direction, Map, PlaneView},
    gpu::Gpu,
    model::{Boundary, Relief},
    reference, render, stage,
};

use crate::support::{
    hold,
    surface::{bumpy, compare, upload},
};

crate::suite! { gpu: agrees_with_its_twin; }

/// The picture, from the adapter.
pub fn draw(gpu: &Gpu, surface: &stage::Surface, shot: &PlaneView, relief: Relief) -> Map<[f32; 4]> {
    let pass = render::Plane::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let target = pass.draw(&mut recorder, surface, shot, relief).expect("records");
    let copy = target.record_copy(&mut recorder).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    let pixels = target.unpad(&copy.read(gpu).expect("reads"));
    Map::new(shot.size[0] as usize, shot.size[1] as usize, pixels).expect("one value a pixel")
}

fn agrees_with_its_twin(gpu: &Gpu) {
    let surface = bumpy(48, 32, Boundary::Mirror, 11);
    let uploaded = upload(gpu, &surface);
    for (size, samples, view, light) in
        [([1, 1], 1, (10.0, 0.0), (35.0, 20.0)), ([150, 90], 1, (40.0, 130.0), (60.0, 250.0)), ([65, 130], 3, (70.0, 300.0), (70.0, 45.0))]
    {
        let shot = PlaneView {
            view: Direction::from_degrees(view.0, view.1),
            light: Direction::from_degrees(light.0, light.1),
            size,
            margin: 0.05,
            samples,
        };
        let found = draw(gpu, &uploaded, &shot, Relief::default());
        let expected = reference::plane(&surface, &shot, Relief::default());
        let [flip, differing] = compare(&found, &expected, 5e-3);
        // As for reconstruct; there are more pixels near an edge here, since up to nine rays share one, and at 70° a texel is
        // seen through others for most of its length.
        hold("plane: mean FLIP", flip, 0.005);
        hold("plane: share of pixels off by more than 0.005", differing, 0.015);
    }
}
