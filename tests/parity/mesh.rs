use glam::{DVec3, dvec3};
use overpaint::{
    data::{Camera, Light, Map, Mesh, Projection, Shape},
    gpu::Gpu,
    model::{Boundary, Relief},
    pipeline::{Progress, Renderer},
    reference,
    render::{Output, Worn},
    stage,
};

use crate::support::{
    hold,
    surface::{bumpy, compare, upload},
};

crate::suite! { gpu: agrees_with_its_twin, averages_agree_with_their_twin; }

/// What `output` says of a mesh on the adapter, one ray a pixel.
pub fn draw(
    gpu: &Gpu, mesh: &Mesh, tiling: [f64; 2], surface: &stage::Surface, relief: Relief, camera: &Camera, lights: &[Light], output: Output,
) -> Map<[f32; 4]> {
    let renderer = Renderer::new(gpu).expect("builds");
    let mesh = renderer.upload(mesh, tiling).expect("fits");
    let worn = Worn { surface, compressed: None, relief, silhouette: false };
    renderer.picture(&mesh, worn, camera, lights, output, 1, &Progress::new(gpu.adapter())).expect("fits")
}

fn agrees_with_its_twin(gpu: &Gpu) {
    let surface = bumpy(48, 32, Boundary::Periodic, 11);
    let uploaded = upload(gpu, &surface);
    let lights = [
        Light::Directional { toward: dvec3(0.5, 0.6, 0.8).normalize(), irradiance: [1.0, 0.9, 0.8] },
        Light::Point { place: dvec3(-2.0, 1.0, 2.5), irradiance: [2.0, 3.0, 4.0] },
    ];
    let perspective = Projection::Perspective { field_of_view: 0.6 };
    let cases = [
        (Shape::Plane, [1.0, 1.5], [0.4, 0.7], perspective, [90, 64]),
        (Shape::Plane, [2.0, 2.0], [2.6, -0.4], Projection::Orthographic { height: 1.0 }, [64, 64]),
        (Shape::Sphere, [2.0, 2.0], [0.3, 0.2], perspective, [65, 80]),
    ];
    for (shape, tiling, direction, projection, size) in cases {
        let mesh = shape.mesh();
        let camera = Camera::around(DVec3::ZERO, 1.4, direction, projection, size);
        let found = draw(gpu, &mesh, tiling, &uploaded, Relief::default(), &camera, &lights, Output::Radiance);
        let worn = reference::Worn { surface: &surface, compressed: None, relief: Relief::default() };
        let expected = reference::mesh(&mesh, tiling, &worn, &camera, &lights);
        let [flip, differing] = compare(&found, &expected, 5e-3);
        // As for the plane: pixels near an edge see one side here and the other there.
        hold("mesh: mean FLIP", flip, 0.005);
        hold("mesh: share of pixels off by more than 0.005", differing, 0.02);
    }
}

fn averages_agree_with_their_twin(gpu: &Gpu) {
    let stage = stage::Average::new(gpu).expect("builds");
    for (width, height, stride) in [(1, 1, 16), (63, 2, 64), (65, 77, 80)] {
        let pictures: Vec<_> = (0..3)
            .map(|picture| Map::from_fn(width, height, |x, y| [x, y, picture, x * y].map(|value| value as f64 / 7.0)))
            .collect();
        let mean = gpu.fresh("mean", width * height).expect("fits");
        let mut recorder = gpu.recorder();
        for (index, picture) in pictures.iter().enumerate() {
            let padded = Map::from_fn(stride, height, |x, y| if x < width { picture[(x, y)].map(|v| v as f32) } else { [f32::NAN; 4] });
            let uploaded = gpu.upload("picture", padded.values()).expect("fits");
            stage.record(&mut recorder, &uploaded, &mean, [width, stride], [index as u32, 3]).expect("records");
        }
        gpu.submit(recorder).wait(gpu).expect("runs");
        let found = mean.read(gpu).expect("reads");
        let expected = reference::average(&pictures);
        let worst = crate::support::worst_difference(
            found.into_iter().flatten().map(f64::from),
            expected.values().iter().copied().flatten(),
        );
        // Three roundings of values up to 710.
        hold("average: mean of three", worst, 2e-4);
    }
}
