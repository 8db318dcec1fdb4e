use std::sync::Arc;

use glam::{DVec3, dvec3};
use overpaint::{
    data::{Camera, Direction, Environment, Grid, Light, Map, Mesh, MeshView, Projection, Sampling, Shape, Surroundings},
    gpu::Gpu,
    model::{Boundary, TexelSamples},
    pipeline::{Progress, Renderer},
    reference::{self, Surface},
    render::Output,
    stage,
};

use crate::support::{
    hold,
    lpca::{self, product},
    random::Random,
    surface::{bumpy, compare, upload},
};

crate::suite! { gpu: agrees_with_its_twin, the_local_pca_agrees, painted_environments_agree, shadows_agree_with_rays, averages_agree_with_their_twin; }

/// What `output` says of `view` on the adapter, one ray a pixel.
pub fn draw(gpu: &Gpu, view: &MeshView, surface: &Surface, output: Output) -> Map<[f32; 4]> {
    let renderer = Renderer::new(gpu).expect("builds");
    let progress = Progress::new(gpu.adapter());
    let view = MeshView { sampling: Sampling { rays: 1, pictures: 1 }, ..view.clone() };
    let dressed = renderer.show(&view, upload(gpu, surface), None, &progress).expect("fits");
    renderer.picture(&dressed, &view.camera, output, &progress).expect("fits")
}

/// `mesh` without shadows, `tiling` pieces of the material on it.
pub fn view(mesh: Mesh, tiling: [f64; 2], camera: Camera, lights: &[Light]) -> MeshView {
    MeshView { tiling, shadows: false, ..MeshView::new(mesh, camera, lights.to_vec()) }
}

fn agrees_with_its_twin(gpu: &Gpu) {
    let surface = bumpy(48, 32, Boundary::Periodic, 11);
    let lights = [
        Light::Directional { toward: dvec3(0.5, 0.6, 0.8).normalize(), irradiance: [1.0, 0.9, 0.8] },
        Light::Point { place: dvec3(-2.0, 1.0, 2.5), irradiance: [2.0, 3.0, 4.0] },
    ];
    let perspective = Projection::Perspective { field_of_view: 0.6 };
    let cases = [
        (Shape::Plane, [1.0, 1.5], [0.4, 0.7], perspective, [90, 64]),
        (Shape::Plane, [2.0, 2.0], [2.6, -0.4], Projection::Orthographic { height: 1.0 }, [64, 64]),
        (Shape::Sphere, [2.0, 2.0], [0.3, 0.2], perspective, [33, 40]),
    ];
    for (shape, tiling, direction, projection, size) in cases {
        let camera = Camera::around(DVec3::ZERO, 1.4, direction, projection, size);
        agree("mesh", gpu, &view(shape.mesh(), tiling, camera, &lights), &surface);
    }
}

/// Holds the adapter's picture to the twin's.
fn agree(what: &str, gpu: &Gpu, view: &MeshView, surface: &Surface) {
    let found = draw(gpu, view, surface, Output::Radiance);
    let expected = reference::mesh(view, reference::Worn { surface, compressed: None });
    let [flip, differing] = compare(&found, &expected, 5e-3);
    // As for the plane: pixels near an edge see one side here and the other there.
    hold(&format!("{what}: mean FLIP"), flip, 0.002);
    hold(&format!("{what}: share of pixels off by more than 0.005"), differing, 0.005);
}

/// A floor from -1 to 1 in y = 0, and above its middle a card.
fn floor_and_card() -> Mesh {
    let (mut positions, mut coordinates, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for (half, height) in [(1.0, 0.0), (0.3, 0.5)] {
        let first = positions.len() as u32;
        for [x, z] in [[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]] {
            positions.push([half * x, height, half * z]);
            coordinates.push([0.5 + 0.5 * half * x, 0.5 - 0.5 * half * z]);
        }
        triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    let vertices = positions.len();
    let tangents = vec![[1.0, 0.0, 0.0, 1.0]; vertices];
    Mesh::new(positions, vec![[0.0, 1.0, 0.0]; vertices], tangents, coordinates, triangles).expect("is a mesh")
}

/// Bare parts from a compressed BTF of another size than the surface, painted ones as ever.
fn the_local_pca_agrees(gpu: &Gpu) {
    let mut random = Random::new(12);
    let directions: Vec<Direction> = "0:1,30:6,60:12".parse::<Grid>().expect("is a grid").directions();
    let lpca = lpca::random(&mut random, [16, 8], product(directions.len(), directions.len()), [5, 3]);
    let twin = reference::CompressedBtf::new(&lpca, &directions, &directions, Boundary::Periodic).expect("fits");
    let surface = bumpy(32, 16, Boundary::Periodic, 13);
    let lights = [Light::Directional { toward: dvec3(0.3, 0.4, 0.9).normalize(), irradiance: [1.0; 3] }];
    let camera = Camera::around(DVec3::ZERO, 1.4, [0.4, 0.5], Projection::Perspective { field_of_view: 0.6 }, [30, 24]);
    let renderer = Renderer::new(gpu).expect("builds");
    let progress = Progress::new(gpu.adapter());
    for texel_samples in TexelSamples::ALL {
        let sampling = Sampling { rays: 1, pictures: 1 };
        let view = MeshView { unpainted: Some(texel_samples), sampling, ..view(Shape::Sphere.mesh(), [2.0; 2], camera, &lights) };
        let btf = lpca::upload(gpu, &lpca, &directions, &directions, Boundary::Periodic);
        let dressed = renderer.show(&view, upload(gpu, &surface), Some((btf, texel_samples)), &progress).expect("fits");
        let found = renderer.picture(&dressed, &camera, Output::Radiance, &progress).expect("fits");
        let expected = reference::mesh(&view, reference::Worn { surface: &surface, compressed: Some(&twin) });
        let [_, differing] = compare(&found, &expected, 5e-3);
        // Pixels near an edge; and, of one texel, those on the border of two, which random texels make a jump.
        hold("mesh: share of pixels off by the local PCA", differing, 0.005);
    }
}

fn painted_environments_agree(gpu: &Gpu) {
    let mut surface = bumpy(24, 24, Boundary::Periodic, 14);
    surface.painted = surface.painted.map(|&[r, g, b, _]| [r, g, b, 1.0]);
    let environment = Arc::new(Environment::sky());
    let camera = Camera::around(DVec3::ZERO, 1.4, [0.4, 0.5], Projection::Perspective { field_of_view: 0.6 }, [20, 16]);
    let surroundings = Some(Surroundings { environment, strength: 1.5, turn: 0.7 });
    let view = MeshView { surroundings, ..view(Shape::Plane.mesh(), [1.0; 2], camera, &[]) };
    let found = draw(gpu, &view, &surface, Output::Radiance);
    let expected = reference::mesh(&view, reference::Worn { surface: &surface, compressed: None });
    // Levels are read between four texels of 2 degrees or more and between two roughnesses, and the table of albedos between its entries: a
    // small light's reflection is up to 14 % off (model::environment), here of a sun that gives a few tenths.
    let [flip, differing] = compare(&found, &expected, 0.06);
    hold("mesh: mean FLIP in an environment", flip, 0.03);
    hold("mesh: share of pixels off by more than 0.06 in an environment", differing, 0.03);
}

fn shadows_agree_with_rays(gpu: &Gpu) {
    let surface = bumpy(32, 32, Boundary::Periodic, 5);
    let camera = Camera::around(DVec3::ZERO, 1.2, [0.3, 0.9], Projection::Perspective { field_of_view: 0.6 }, [160, 120]);
    let far = Light::Directional { toward: dvec3(0.3, 0.9, 0.2).normalize(), irradiance: [1.0; 3] };
    let outside = Light::Point { place: dvec3(0.5, 3.0, -0.5), irradiance: [8.0; 3] };
    // Below the card, so that the floor is lit and the card's upper side is not, through five sides of the cube.
    let inside = Light::Point { place: dvec3(0.1, 0.3, 0.2), irradiance: [0.1; 3] };
    for (name, light, lit) in [("far away", far, true), ("outside", outside, true), ("inside", inside, false)] {
        let view = MeshView { shadows: true, ..view(floor_and_card(), [1.0; 2], camera, &[light]) };
        let found = draw(gpu, &view, &surface, Output::Radiance);
        let worn = reference::Worn { surface: &surface, compressed: None };
        let expected = reference::mesh(&view, worn);
        let [_, differing] = compare(&found, &expected, 5e-3);
        // The edge of the card's shadow is 70 pixels long and, averaged over three texels of a map of 2048 across the scene, a fifth of a pixel
        // wide; as many lie on edges of the relief.
        hold(&format!("mesh: share of pixels off, light {name}"), differing, 0.005);
        let unshadowed = reference::mesh(&MeshView { shadows: false, ..view }, worn);
        let changed = expected.values().iter().zip(unshadowed.values()).filter(|(with, without)| with != without).count();
        assert!(lit == (changed > 200), "{name}: shadows on {changed} pixels");
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
