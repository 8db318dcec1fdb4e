use glam::{DVec3, dvec3};
use overpaint::{
    data::{Camera, Direction, Light, Map, Mesh, Projection, Shape},
    gpu::Gpu,
    model::{Boundary, Relief},
    render::Output,
};

use crate::{
    parity::mesh::{draw, view},
    support::{
        Worst, hold,
        surface::{bumpy, plain, reconstruct, upload, with_heights},
    },
};

crate::suite! { gpu: the_plane_from_above_is_the_reconstruction, a_plateau_has_its_depth, a_mirrored_light_gives_the_mirrored_picture, a_point_light_far_away_is_directional; }

const PARALLEL: Projection = Projection::Orthographic { height: 1.0 };

/// Straight from above, a pixel a texel: the plane reaches from -1 to 1.
fn above(size: [u32; 2]) -> Camera {
    let camera = Camera::around(DVec3::ZERO, 1.0, [0.0, 0.0], PARALLEL, size);
    Camera { projection: Projection::Orthographic { height: 2.0 }, ..camera }
}

fn directional(toward: DVec3) -> [Light; 1] {
    [Light::Directional { toward: toward.normalize(), irradiance: [1.0; 3] }]
}

fn the_plane_from_above_is_the_reconstruction(gpu: &Gpu) {
    let surface = bumpy(48, 48, Boundary::Periodic, 2);
    let light = Direction::from_degrees(55.0, 160.0);
    let view = view(Shape::Plane.mesh(), [1.0; 2], above([48, 48]), &directional(light.vector()));
    let drawn = draw(gpu, &view, &surface, Output::Radiance);
    let reconstructed = reconstruct(gpu, &upload(gpu, &surface), Direction::from_degrees(0.0, 0.0), light, Relief::default());
    let errors = drawn.values().iter().zip(reconstructed.values()).flat_map(|(a, b)| (0..4).map(|c| (a[c] - b[c]).abs()));
    // Places come through the vertices' interpolation, good to 2^-16 of the 48 texels, and steep places magnify it.
    hold("mesh: the plane from above against reconstruct", errors.worst(), 5e-3);
}

/// A plateau of 4 texels on a plane 2 long and 64 texels wide stands 4/32 nearer.
fn a_plateau_has_its_depth(gpu: &Gpu) {
    let plateau = Map::from_fn(64, 64, |column, _| if (20..44).contains(&column) { 4.0 } else { 0.0 });
    let surface = with_heights(plain(64, 64), plateau);
    let camera = above([64, 64]);
    let view = view(Shape::Plane.mesh(), [1.0; 2], camera, &directional(DVec3::Z));
    let seen = draw(gpu, &view, &surface, Output::Geometry);
    let [ground, raised] = [seen[(5, 30)][3], seen[(32, 30)][3]];
    hold("mesh: depth of a plateau", (f64::from(ground - raised) - 4.0 / 32.0).abs(), 1e-5);
    let normal = seen[(32, 30)];
    hold("mesh: normal of a plateau", (f64::from(normal[2]) - 1.0).abs(), 1e-6);
}

/// The plane mirrored in x, its light too, is the picture mirrored.
fn a_mirrored_light_gives_the_mirrored_picture(gpu: &Gpu) {
    let one = bumpy(48, 48, Boundary::Periodic, 6);
    let mut level = plain(48, 48);
    level.diffuse = one.diffuse.clone();
    let mirrored = overpaint::reference::Surface {
        diffuse: Map::from_fn(48, 48, |column, row| one.diffuse[(47 - column, row)]),
        ..level.clone()
    };
    let light = dvec3(0.6, 0.2, 0.7);
    let show = |surface, x: f64| {
        let lights = directional(dvec3(x * light.x, light.y, light.z));
        let camera = Camera::around(DVec3::ZERO, 1.4, [x * 0.5, 0.3], Projection::Perspective { field_of_view: 0.5 }, [80, 60]);
draw(gpu, &view(Shape::Plane.mesh(), [1.0; 2], camera, &lights), surface, Output::Radiance)
    };
    let (left, right) = (show(&level, 1.0), show(&mirrored, -1.0));
    let off = (0..80 * 60).filter(|pixel| {
        let (a, b) = (left[(pixel % 80, pixel / 80)], right[(79 - pixel % 80, pixel / 80)]);
        (0..4).any(|c| (a[c] - b[c]).abs() > 1e-3)
    });
    // Pixels whose centre lies on the plane's outline belong to it on one side only.
    hold("mesh: pixels that a mirror changes", off.count() as f64 / 4800.0, 0.005);
}

/// At distance d the irradiance of a light of d² is 1.
fn a_point_light_far_away_is_directional(gpu: &Gpu) {
    let surface = bumpy(32, 32, Boundary::Periodic, 3);
    let toward = dvec3(0.3, 0.5, 0.8).normalize();
    let camera = Camera::around(DVec3::ZERO, 1.4, [0.2, 0.3], Projection::Perspective { field_of_view: 0.5 }, [64, 64]);
    let show = |lights: &[Light], mesh: &Mesh| draw(gpu, &view(mesh.clone(), [1.0; 2], camera, lights), &surface, Output::Radiance);
    for mesh in [Shape::Plane.mesh(), Shape::Sphere.mesh()] {
        let near = show(&directional(toward), &mesh);
        let far = show(&[Light::Point { place: 1e4 * toward, irradiance: [1e8; 3] }], &mesh);
        let errors = near.values().iter().zip(far.values()).flat_map(|(a, b)| (0..3).map(|c| (a[c] - b[c]).abs()));
        // The direction differs by up to 1e-4 from one end of the mesh to the other, and the distance as much; a shadow's edge magnifies it.
        hold("mesh: a point light far away", errors.worst(), 0.02);
    }
}
