use std::sync::Arc;

use glam::{DVec3, dvec3};
use overpaint::{
    data::{Camera, Direction, Environment, Grid, Light, Map, Mesh, MeshView, Projection, Sampling, Shape, Surroundings},
    gpu::Gpu,
    model::{Boundary, Relief, TexelSamples},
    pipeline::{Progress, Renderer},
    reference,
    render::Output,
    stage::Minify,
};

use crate::{
    parity::mesh::{draw, view},
    support::{
        Worst, hold,
        lpca::{self, product},
        random::Random,
        surface::{bumpy, plain, reconstruct, upload, with_heights},
    },
};

crate::suite! {
    gpu:
    the_plane_is_the_reconstruction,
    the_local_pca_on_the_plane_is_its_reconstruction,
    a_far_relief_glints_as_its_texels_do,
    inner_sides_are_seen_from_inside,
    opposite_frames_are_drawn,
    needles_are_drawn,
    rays_of_a_pixel_are_its_quarters,
    a_plateau_has_its_depth,
    a_mirrored_light_gives_the_mirrored_picture,
    mirrored_pieces_are_mirrored,
    mirrored_coordinates_show_the_mirrored_material,
    a_point_light_far_away_is_directional,
    flat_height_is_a_plain_texture,
    no_paint_is_the_bare_material,
    white_paint_sends_back_what_it_gets,
    a_far_material_keeps_its_mean_and_does_not_shimmer,
    a_turn_is_a_turn_of_the_mesh,
    a_uniform_environment_has_its_closed_form,
    lights_stand_for_an_environment;
}

const PARALLEL: Projection = Projection::Orthographic { height: 1.0 };

/// Straight from above, a pixel a texel: the plane reaches from -1 to 1.
fn above(size: [u32; 2]) -> Camera {
    let camera = Camera::around(DVec3::ZERO, 1.0, [0.0, 0.0], PARALLEL, size);
    Camera { projection: Projection::Orthographic { height: 2.0 }, ..camera }
}

fn directional(toward: DVec3) -> [Light; 1] {
    [Light::Directional { toward: toward.normalize(), irradiance: [1.0; 3] }]
}

/// Views along which a pixel is a texel, and the texels: 60 degrees from above, rows are half as far apart as columns.
fn aligned_views() -> [(Direction, [usize; 2]); 3] {
    [(0.0, [32, 32]), (90.0, [32, 16]), (270.0, [32, 16])].map(|(azimuth, texels)| {
        (Direction::from_degrees(if texels[1] == 32 { 0.0 } else { 60.0 }, azimuth), texels)
    })
}

/// Along one of them.
fn aligned(view: Direction, [columns, rows]: [usize; 2]) -> Camera {
    let camera = above([columns as u32, rows as u32]);
    Camera { eye: 3.0 * view.vector(), projection: Projection::Orthographic { height: 2.0 * view.vector().z }, depths: [0.5, 6.0], ..camera }
}

fn the_plane_is_the_reconstruction(gpu: &Gpu) {
    let light = Direction::from_degrees(55.0, 160.0);
    for (from, texels) in aligned_views() {
        let surface = bumpy(texels[0], texels[1], Boundary::Periodic, 2);
        let view = view(Shape::Plane.mesh(), [1.0; 2], aligned(from, texels), &directional(light.vector()));
        let drawn = draw(gpu, &view, &surface, Output::Radiance);
        let reconstructed = reconstruct(gpu, &upload(gpu, &surface), from, light, Relief::default());
        let off = drawn.values().iter().zip(reconstructed.values()).filter(|(a, b)| (0..4).any(|c| (a[c] - b[c]).abs() > 5e-3));
        // A ray that passes an edge of the relief closely may do so on one side here and on the other there.
        hold("mesh: share of the plane's pixels off", off.count() as f64 / surface.heights.values().len() as f64, 0.004);
    }
}

fn the_local_pca_on_the_plane_is_its_reconstruction(gpu: &Gpu) {
    let directions: Vec<Direction> = "0:1,30:6,60:12".parse::<Grid>().expect("is a grid").directions();
    let light = directions[3];
    for (from, texels) in aligned_views() {
        let lpca = lpca::random(&mut Random::new(3), texels, product(directions.len(), directions.len()), [5, 3]);
        let btf = || lpca::upload(gpu, &lpca, &directions, &directions, Boundary::Periodic);
        for samples in TexelSamples::ALL {
            let view = view(Shape::Plane.mesh(), [1.0; 2], aligned(from, texels), &directional(light.vector()));
            let view = MeshView { unpainted: Some(samples), sampling: Sampling { rays: 1, pictures: 1 }, ..view };
            let renderer = Renderer::new(gpu).expect("builds");
            let progress = Progress::new(gpu.adapter());
            let worn = upload(gpu, &plain(texels[0], texels[1]));
            let dressed = renderer.show(&view, worn, Some((btf(), samples)), &progress).expect("fits");
            let drawn = renderer.radiance(&dressed, &view.camera, &progress).expect("fits");
            let reconstructed = lpca::reconstruct(gpu, &btf(), samples, from, light);
            let errors = drawn.values().iter().zip(reconstructed.values()).flat_map(|(a, b)| (0..3).map(|c| (a[c] - b[c]).abs()));
            // Places of 32 texels by a few roundings, between texels that have nothing in common.
            hold("mesh: the local PCA on the plane against its reconstruction", errors.worst(), 1e-4);
        }
    }
}

/// Glossy black paint whose texels lean every way, many to a pixel: a coarse level has their mean highlight, which is lower and wider than that
/// of a level surface.
fn a_far_relief_glints_as_its_texels_do(gpu: &Gpu) {
    let mut random = Random::new(15);
    let leaning = |random: &mut Random| {
        let [x, y] = [(); 2].map(|()| (0..4).map(|_| random.between(-0.15, 0.15)).sum::<f64>());
        let length = (1.0 + x * x + y * y).sqrt();
        [x / length, y / length, 1.0 / length]
    };
    let mut surface = plain(64, 64);
    surface.normals = Map::from_fn(64, 64, |_, _| leaning(&mut random));
    surface.painted = surface.painted.map(|_| [0.0, 0.0, 0.0, 1.0]);
    surface.coat = surface.coat.map(|_| [0.2, 0.15]);
    let renderer = Renderer::new(gpu).expect("builds");
    let progress = Progress::new(gpu.adapter());
    let mean = |size: u32, levels: bool, light: DVec3| {
        let mut uploaded = upload(gpu, &surface);
        if levels {
            let mut recorder = gpu.recorder();
            Minify::new(gpu).expect("builds").record(&mut recorder, &mut uploaded).expect("records");
            gpu.submit(recorder).wait(gpu).expect("runs");
        }
        let still = Relief { displace: false, shadow: false, ..Relief::default() };
        let sampling = Sampling { rays: 1, pictures: 1 };
        let view = MeshView { relief: still, sampling, ..view(Shape::Plane.mesh(), [1.0; 2], above([size; 2]), &directional(light)) };
        let dressed = renderer.show(&view, uploaded, None, &progress).expect("fits");
        let seen = renderer.radiance(&dressed, &view.camera, &progress).expect("fits");
        seen.values().iter().map(|pixel| f64::from(pixel[0])).sum::<f64>() / seen.values().len() as f64
    };
    for tilt in [0.0, 20.0, 40.0, 60.0] {
        let light = Direction::from_degrees(tilt, 30.0).vector();
        let (near, far) = (mean(64, false, light), mean(8, true, light));
        // Lobes of GGX have tails without a variance, and so the sum of variances is not quite their sum: it is too high in the middle and too
        // low around. A level surface has F0/(4 alpha^2) there, 4.5 times what these texels have.
        assert!(tilt > 0.0 || 0.2 / (4.0 * 0.15 * 0.15) > 4.0 * near, "the texels lean enough: {near}");
        hold("mesh: highlight of a far relief", (far / near - 1.0).abs(), 0.3);
    }
}

/// A sphere without one of its triangles, on the far side, looks the same; from inside it is seen all around; one turned inside out does not
/// count as closed.
fn inner_sides_are_seen_from_inside(gpu: &Gpu) {
    let surface = bumpy(32, 32, Boundary::Periodic, 16);
    let sphere = Shape::Sphere.mesh();
    let with = |triangles: Vec<[u32; 3]>| {
        let [positions, normals] = [sphere.positions(), sphere.normals()].map(<[_]>::to_vec);
        Mesh::new(positions, normals, sphere.tangents().to_vec(), sphere.texture_coordinates().to_vec(), triangles).expect("is a mesh")
    };
    let camera = Camera::around(DVec3::ZERO, 1.1, [0.0, 0.0], Projection::Perspective { field_of_view: 0.5 }, [64, 64]);
    let show = |mesh: Mesh, camera: Camera| draw(gpu, &view(mesh, [2.0; 2], camera, &directional(dvec3(0.3, 0.4, 1.0))), &surface, Output::Radiance);
    let whole = show(sphere.clone(), camera);
    let far = sphere.triangles().iter().position(|corners| corners.iter().all(|&corner| sphere.positions()[corner as usize][2] < -0.9));
    let mut open = sphere.triangles().to_vec();
    open.remove(far.expect("is there"));
    let open = show(with(open), camera);
    let off = whole.values().iter().zip(open.values()).filter(|(a, b)| (0..4).any(|c| (a[c] - b[c]).abs() > 1e-6)).count();
    // At the outline the far side's relief may stand before that of the near one, which is seen at 85 degrees and more: a hundredth of the disc.
    hold("mesh: pixels that an opened sphere changes", off as f64 / 4096.0, 0.01);

    let inside = Camera { eye: 0.1 * DVec3::Z, depths: [0.01, 3.0], ..camera };
    assert!(show(sphere.clone(), inside).values().iter().all(|pixel| pixel[3] == 1.0), "all is covered");
    let turned = with(sphere.triangles().iter().map(|&[a, b, c]| [a, c, b]).collect());
    let turned = draw(gpu, &view(turned, [2.0; 2], camera, &[]), &plain(4, 4), Output::Geometry)[(32, 32)];
    let nearest = camera.eye.length() - 1.0;
    // The middle of the nearest triangle stands back behind the sphere by less than a thousandth, as does the pixel's ray.
    hold("mesh: distance of a sphere turned inside out", (f64::from(turned[3]) - nearest).abs(), 5e-3);
}

/// Corners whose normals and tangents point against each other leave none between them: the first corner's serve.
fn opposite_frames_are_drawn(gpu: &Gpu) {
    let positions = vec![[-1.0, -1.0, 0.0], [1.0, 0.0, 0.0], [-1.0, 1.0, 0.0]];
    let normals = vec![[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
    let tangents = vec![[1.0, 0.0, 0.0, 1.0], [-1.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0]];
    let mesh = Mesh::new(positions, normals, tangents, vec![[0.0, 0.0], [1.0, 0.5], [0.0, 1.0]], vec![[0, 1, 2]]).expect("is a mesh");
    // In the middle column the second corner's share is that of the others; to its right inner sides are seen, which are dark.
    let seen = draw(gpu, &view(mesh, [1.0; 2], above([65, 65]), &directional(dvec3(0.2, 0.3, 1.0))), &plain(32, 32), Output::Radiance);
    assert!(seen.values().iter().flatten().all(|value| value.is_finite()));
    let middle: Vec<_> = (0..65).map(|row| seen[(32, row)]).filter(|pixel| pixel[3] == 1.0).collect();
    assert!(middle.len() > 20 && middle.iter().all(|pixel| pixel[0] > 0.5), "{middle:?}");
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
    let mirrored = reference::Surface {
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

/// Two pieces each way of a mirrored material are symmetric about the middle: under the mirrored light the picture is mirrored. One piece from
/// above is the reconstruction, as of a periodic one.
fn mirrored_pieces_are_mirrored(gpu: &Gpu) {
    let surface = bumpy(24, 24, Boundary::Mirror, 10);
    let light = Direction::from_degrees(40.0, 200.0);
    let one = draw(gpu, &view(Shape::Plane.mesh(), [1.0; 2], above([24, 24]), &directional(light.vector())), &surface, Output::Radiance);
    let reconstructed = reconstruct(gpu, &upload(gpu, &surface), Direction::from_degrees(0.0, 0.0), light, Relief::default());
    let errors = one.values().iter().zip(reconstructed.values()).flat_map(|(a, b)| (0..4).map(|c| (a[c] - b[c]).abs()));
    hold("mesh: a mirrored piece from above against reconstruct", errors.worst(), 5e-3);

    let show = |[x, y]: [f64; 2]| {
        let lights = directional(dvec3(0.5 * x, 0.3 * y, 0.8));
        draw(gpu, &view(Shape::Plane.mesh(), [2.0; 2], above([48, 48]), &lights), &surface, Output::Radiance)
    };
    let plain = show([1.0, 1.0]);
    for (signs, mirrored) in [([-1.0, 1.0], [true, false]), ([1.0, -1.0], [false, true])] {
        let other = show(signs);
        let at = |index: usize, mirror: bool| if mirror { 47 - index } else { index };
        let errors = (0..48 * 48).flat_map(|pixel| {
            let (column, row) = (pixel % 48, pixel / 48);
            let (a, b) = (plain[(column, row)], other[(at(column, mirrored[0]), at(row, mirrored[1]))]);
            (0..3).map(move |c| (a[c] - b[c]).abs())
        });
        let off = errors.filter(|error| *error > 5e-3).count();
        // Places on an edge of the relief, or in the pixels of which two pieces meet, fall to one side or the other.
        hold("mesh: values that a mirror changes in mirrored pieces", off as f64 / (3.0 * 48.0 * 48.0), 0.01);
    }
}

/// A plane whose u runs to the left, and whose frames are left-handed for that, is the plane mirrored under the mirrored light.
fn mirrored_coordinates_show_the_mirrored_material(gpu: &Gpu) {
    let surface = bumpy(32, 32, Boundary::Periodic, 20);
    let plane = Shape::Plane.mesh();
    let mirrored = Mesh::new(
        plane.positions().to_vec(),
        plane.normals().to_vec(),
        plane.tangents().iter().map(|&[x, y, z, w]| [-x, -y, -z, -w]).collect(),
        plane.texture_coordinates().iter().map(|&[u, v]| [1.0 - u, v]).collect(),
        plane.triangles().to_vec(),
    )
    .expect("is a mesh");
    let show = |mesh: Mesh, x: f64| {
        draw(gpu, &view(mesh, [1.0; 2], above([32, 32]), &directional(dvec3(0.5 * x, 0.4, 0.8))), &surface, Output::Radiance)
    };
    let (one, other) = (show(plane, 1.0), show(mirrored, -1.0));
    let off = (0..32 * 32).filter(|pixel| {
        let (a, b) = (one[(pixel % 32, pixel / 32)], other[(31 - pixel % 32, pixel / 32)]);
        (0..4).any(|c| (a[c] - b[c]).abs() > 2e-3)
    });
    // Places on an edge of the relief fall to one side or the other.
    hold("mesh: pixels that mirrored coordinates change", off.count() as f64 / 1024.0, 0.005);
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

/// Of a level material's reflectance a ray sees just that of the texel it crosses, whatever its angle: the picture of a plane is that of a
/// texture of the same reflectance.
fn flat_height_is_a_plain_texture(gpu: &Gpu) {
    let mut surface = plain(8, 8);
    surface.diffuse = Map::from_fn(8, 8, |column, row| [0.1 * column as f64, 0.1 * row as f64, 0.3]);
    let camera = Camera::around(DVec3::ZERO, 1.4, [0.4, 0.5], Projection::Perspective { field_of_view: 0.5 }, [90, 70]);
    let drawn = draw(gpu, &view(Shape::Plane.mesh(), [1.0; 2], camera, &directional(DVec3::Z)), &surface, Output::Radiance);
    let mut errors = Vec::new();
    for (row, column) in (0..70).flat_map(|row| (0..90).map(move |column| (row, column))) {
        let [origin, direction] = camera.ray([column as f64 + 0.5, row as f64 + 0.5]);
        let at = origin - origin.z / direction.z * direction;
        // Between the middles of the outermost texels, where the bilinear mean of the ramps is the ramps themselves.
        let place = [4.0 * (at.x + 1.0) - 0.5, 4.0 * (1.0 - at.y) - 0.5];
        if place.iter().all(|&x| (0.0..7.0).contains(&x)) {
            let seen = drawn[(column, row)];
            errors.push((f64::from(seen[0]) - 0.1 * place[0]).abs().max((f64::from(seen[1]) - 0.1 * place[1]).abs()));
        }
    }
    assert!(errors.len() > 1000, "the plane is seen");
    // Places are good to 2^-16 of the picture.
    hold("mesh: a level material is a texture", errors.into_iter().worst(), 2e-4);
}

/// Paint that covers nothing changes no bit, whatever its colour and coat.
fn no_paint_is_the_bare_material(gpu: &Gpu) {
    let mut bare = bumpy(32, 32, Boundary::Periodic, 8);
    bare.painted = bare.painted.map(|_| [0.0; 4]);
    let mut none = bare.clone();
    none.painted = none.painted.map(|_| [0.9, 0.1, 0.4, 0.0]);
    none.coat = none.coat.map(|_| [0.2, 0.1]);
    let camera = Camera::around(DVec3::ZERO, 1.4, [0.4, 0.5], Projection::Perspective { field_of_view: 0.5 }, [64, 64]);
    let show = |surface| draw(gpu, &view(Shape::Sphere.mesh(), [2.0; 2], camera, &directional(dvec3(0.2, 0.5, 1.0))), surface, Output::Radiance);
    assert!(show(&bare).values() == show(&none).values(), "nothing is painted");
}

/// White paint under a sky of 1 everywhere sends back, towards any view, no more than it gets, and most of it: what its coat does not mirror
/// goes into the paint and comes out again.
fn white_paint_sends_back_what_it_gets(gpu: &Gpu) {
    // Lights even on the disc that the dome projects to (Vogel 1979: a sunflower's), where each has the same irradiance on the plane.
    let sky: Vec<_> = (0..400)
        .map(|index| {
            let (radius, turn) = (((f64::from(index) + 0.5) / 400.0).sqrt(), 2.399_963_229_728_653 * f64::from(index));
            let toward = dvec3(radius * turn.cos(), radius * turn.sin(), (1.0 - radius * radius).sqrt());
            Light::Directional { toward, irradiance: [1.0 / 400.0 / toward.z; 3] }
        })
        .collect();
    let mut surface = plain(4, 4);
    surface.painted = surface.painted.map(|_| [1.0; 4]);
    for f0 in [0.04, 0.25] {
        surface.coat = surface.coat.map(|_| [f0, 1.0]);
        for angle in [0.4_f64, 1.2] {
            let toward = dvec3(angle.sin(), 0.0, angle.cos());
            let camera = Camera { eye: 3.0 * toward, depths: [0.5, 6.0], ..above([9, 9]) };
            let seen = draw(gpu, &view(Shape::Plane.mesh(), [1.0; 2], camera, &sky), &surface, Output::Radiance)[(4, 4)][0];
            // A coat as rough as this mirrors up to 0.4 of what comes and, counting no light that meets two facets, loses up to half of that; the
            // sum over lights is good to a part in a thousand.
            hold("mesh: white paint under a white sky, above 1", (f64::from(seen) - 1.0).max(0.0), 1e-3);
            hold("mesh: white paint under a white sky, below 1", (1.0 - f64::from(seen)).max(0.0), 0.2);
        }
    }
}

/// A chequerboard of paint of whose squares a pixel covers many: its picture has the colours' mean, and moving the camera by parts of a pixel
/// changes next to nothing, where one ray on the finest level sees one square or the other.
fn a_far_material_keeps_its_mean_and_does_not_shimmer(gpu: &Gpu) {
    let mut surface = plain(64, 64);
    surface.painted = Map::from_fn(64, 64, |column, row| if (column / 2 + row / 2) % 2 == 0 { [0.8, 0.8, 0.8, 1.0] } else { [0.2, 0.2, 0.2, 1.0] });
    surface.coat = surface.coat.map(|_| [0.0, 1.0]);
    let renderer = Renderer::new(gpu).expect("builds");
    let progress = Progress::new(gpu.adapter());
    let shimmer = |rays: u32, levels: bool| {
        let mut uploaded = upload(gpu, &surface);
        if levels {
            let mut recorder = gpu.recorder();
            Minify::new(gpu).expect("builds").record(&mut recorder, &mut uploaded).expect("records");
            gpu.submit(recorder).wait(gpu).expect("runs");
        }
        let camera = above([40, 40]);
        let far = MeshView { sampling: Sampling { rays, pictures: 1 }, ..view(Shape::Plane.mesh(), [4.3; 2], camera, &directional(DVec3::Z)) };
        let dressed = renderer.show(&far, uploaded, None, &progress).expect("fits");
        let pictures: Vec<_> = (0..8)
            .map(|step| {
                let aside = dvec3(0.0071, 0.0043, 0.0) * f64::from(step);
                let camera = Camera { eye: camera.eye + aside, target: camera.target + aside, ..camera };
                renderer.picture(&dressed, &camera, Output::Radiance, &progress).expect("fits")
            })
            .collect();
        let inner = || (5..35).flat_map(|row| (5..35).map(move |column| (column, row)));
        let spread = inner().map(|at| {
            let values: Vec<_> = pictures.iter().map(|picture| f64::from(picture[at][0])).collect();
            values.iter().copied().fold(0.0, f64::max) - values.iter().copied().fold(1.0, f64::min)
        });
        let mean = inner().map(|at| f64::from(pictures[0][at][0])).sum::<f64>() / 900.0;
        (spread.sum::<f64>() / 900.0, mean)
    };
    let (lone, _) = shimmer(1, false);
    let (spread, mean) = shimmer(2, true);
    // Alone, a ray sees 0.8 or 0.2. Seen and lit along the normal the paint has 21/20 of its reflectance, what the coat leaves of 20/21 on average.
    assert!(lone > 0.3, "one ray shimmers by {lone}");
    hold("mesh: shimmer of a far chequerboard", spread, 0.03);
    hold("mesh: mean of a far chequerboard", (mean - 0.5 * 21.0 / 20.0).abs(), 1e-4);
}

/// Triangles a hundredth of a pixel wide and less, side by side: what is seen of them is finite, and as deep as they are.
fn needles_are_drawn(gpu: &Gpu) {
    const NEEDLES: u32 = 20_000;
    let surface = bumpy(32, 32, Boundary::Periodic, 19);
    let at = |needle: u32, y: f32| [2.0 * needle as f32 / NEEDLES as f32 - 1.0, y, 0.3 * (needle as f32 * 5e-4).sin()];
    let positions: Vec<_> = (0..=NEEDLES).flat_map(|needle| [at(needle, -1.0), at(needle, 1.0)]).collect();
    let coordinates = positions.iter().map(|[x, y, _]| [0.5 + 0.5 * x, 0.5 + 0.5 * y]).collect();
    let triangles = (0..NEEDLES).flat_map(|needle| [[0, 2, 1], [1, 2, 3]].map(|corners: [u32; 3]| corners.map(|corner| 2 * needle + corner)));
    let (normals, tangents) = (vec![[0.0, 0.0, 1.0]; positions.len()], vec![[1.0, 0.0, 0.0, 1.0]; positions.len()]);
    let mesh = Mesh::new(positions, normals, tangents, coordinates, triangles.collect()).expect("is a mesh");
    let camera = Camera::around(DVec3::ZERO, 1.5, [0.5, 0.2], Projection::Perspective { field_of_view: 0.5 }, [100, 100]);
    let view = view(mesh, [1.0; 2], camera, &directional(dvec3(0.2, 0.3, 1.0)));
    let [seen, geometry] = [Output::Radiance, Output::Geometry].map(|output| draw(gpu, &view, &surface, output));
    assert!(seen.values().iter().chain(geometry.values()).flatten().all(|value| value.is_finite()));
    let covered: Vec<_> = geometry.values().iter().zip(seen.values()).filter(|(_, pixel)| pixel[3] == 1.0).map(|(geometry, _)| geometry[3]).collect();
    assert!(covered.len() > 2000, "{} pixels", covered.len());
    let beyond = covered.iter().map(|&depth| (f64::from(depth) - camera.eye.length()).abs() - 1.5).fold(0.0, f64::max);
    // Within the ball around them; the relief of up to two texels, of 1/16 on slopes up to 3/2, may stand out of it, up to twice
    // as far along a ray.
    hold("mesh: depth of needles beyond them", beyond, 2.0 / 16.0 * 1.35 * 2.0);
}

/// Two by two rays of a pixel see what a picture of twice its columns and rows does, by parallel rays on a plane.
fn rays_of_a_pixel_are_its_quarters(gpu: &Gpu) {
    let surface = bumpy(48, 48, Boundary::Periodic, 18);
    let renderer = Renderer::new(gpu).expect("builds");
    let progress = Progress::new(gpu.adapter());
    let show = |side: u32, rays: u32| {
        let camera = Camera::around(DVec3::ZERO, 1.0, [0.4, 0.6], PARALLEL, [side; 2]);
        let view = view(Shape::Plane.mesh(), [1.0; 2], camera, &directional(dvec3(0.5, 0.3, 1.0)));
        let view = MeshView { sampling: Sampling { rays, pictures: 1 }, ..view };
        let dressed = renderer.show(&view, upload(gpu, &surface), None, &progress).expect("fits");
        renderer.radiance(&dressed, &camera, &progress).expect("fits")
    };
    // A pixel is 2.4 texels wide.
    let (coarse, fine) = (show(20, 2), show(40, 1));
    let quarters = |column: usize, row: usize| [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| fine[(2 * column + x, 2 * row + y)]);
    let pixels = (0..400).map(|pixel| (pixel % 20, pixel / 20)).map(|(column, row)| (coarse[(column, row)], quarters(column, row)));
    let inner: Vec<_> = pixels.filter(|(pixel, quarters)| pixel[3] == 1.0 && quarters.iter().all(|quarter| quarter[3] == 1.0)).collect();
    assert!(inner.len() > 100, "{} pixels", inner.len());
    let error = |(pixel, quarters): &([f32; 4], [[f32; 4]; 4])| {
        (0..3).map(|c| (pixel[c] - 0.25 * quarters.iter().map(|quarter| quarter[c]).sum::<f32>()).abs()).fold(0.0, f32::max)
    };
    let off = inner.iter().map(error).filter(|error| *error > 2e-3).count();
    // Rays that pass an edge of the relief on one side here and on the other there.
    hold("mesh: share of pixels that are not their quarters", off as f64 / inner.len() as f64, 0.01);
}

fn a_turn_is_a_turn_of_the_mesh(gpu: &Gpu) {
    let surface = bumpy(32, 32, Boundary::Periodic, 9);
    let camera = Camera::around(DVec3::ZERO, 1.0, [0.2, 0.3], Projection::Perspective { field_of_view: 0.5 }, [64, 64]);
    let still = MeshView { surroundings: around(Environment::sky()), ..view(Shape::Plane.mesh(), [1.0; 2], camera, &directional(dvec3(0.5, 0.3, 1.0))) };
    let angle: f64 = 0.4;
    let turn = |[x, y, z]: [f32; 3]| {
        let (sine, cosine) = (angle.sin() as f32, angle.cos() as f32);
        [cosine * x + sine * z, y, cosine * z - sine * x]
    };
    let mesh = &still.mesh;
    let turned = Mesh::new(
        mesh.positions().iter().map(|&place| turn(place)).collect(),
        mesh.normals().iter().map(|&normal| turn(normal)).collect(),
        mesh.tangents().iter().map(|&[x, y, z, w]| { let [x, y, z] = turn([x, y, z]); [x, y, z, w] }).collect(),
        mesh.texture_coordinates().to_vec(),
        mesh.triangles().to_vec(),
    )
    .expect("is a mesh");
    let one = draw(gpu, &still.turned(angle), &surface, Output::Radiance);
    let other = draw(gpu, &MeshView { mesh: turned, ..still }, &surface, Output::Radiance);
    let errors = one.values().iter().zip(other.values()).filter(|(a, b)| (0..4).any(|c| (a[c] - b[c]).abs() > 5e-3));
    // Pixels whose centre lies on the outline, or on an edge of the relief.
    hold("mesh: pixels that a turn changes", errors.count() as f64 / 4096.0, 0.01);
}

fn around(environment: Environment) -> Option<Surroundings> {
    Some(Surroundings { environment: Arc::new(environment), strength: 1.0, turn: 0.0 })
}

/// Level paint under 1 from everywhere: what enters comes back by its reflectance where the view lets it, and the coat mirrors its albedo.
fn a_uniform_environment_has_its_closed_form(gpu: &Gpu) {
    let mut surface = plain(4, 4);
    surface.painted = surface.painted.map(|_| [0.5, 0.25, 0.75, 1.0]);
    let white = Environment::uniform([1.0; 3]).expect("is one");
    for (f0, alpha, angle) in [(0.25, 0.3, 1.0_f64)] {
        surface.coat = surface.coat.map(|_| [f0, alpha]);
        let toward = dvec3(angle.sin(), 0.0, angle.cos());
        let camera = Camera { eye: 3.0 * toward, depths: [0.5, 6.0], ..above([9, 9]) };
        let view = MeshView { surroundings: around(white.clone()), ..view(Shape::Plane.mesh(), [1.0; 2], camera, &[]) };
        let seen = draw(gpu, &view, &surface, Output::Radiance)[(4, 4)];
        let cosine = angle.cos();
        let leaving = 1.0 - (f0 + (1.0 - f0) * (1.0 - cosine).powi(5));
        let [scale, bias] = reference::directional_albedo(alpha, cosine, [200, 64]);
        for (channel, reflectance) in [0.5, 0.25, 0.75].into_iter().enumerate() {
            let expected = leaving * reflectance + f0 * scale + bias;
            // The table between its entries is good to 8e-3, held where it is made.
            hold("mesh: paint under a white environment", (f64::from(seen[channel]) - expected).abs(), 8e-3);
        }
    }
}

/// Irradiance from a few directions is that of all of them, but for what a direction that stands for a large part of the sky leaves out; all of
/// the light is there.
fn lights_stand_for_an_environment(gpu: &Gpu) {
    for environment in [Environment::new(Map::from_fn(64, 32, |_, _| [1.0; 3])).expect("is one"), Environment::studio(), Environment::sky()] {
        let flux = |toward: DVec3, lights: &[Light]| {
            lights.iter().map(|light| {
                let Light::Directional { toward: from, irradiance } = light else { panic!("{light:?}") };
                from.dot(toward).max(0.0) * irradiance[1]
            })
            .sum::<f64>()
        };
        // Against very many, which are nearly the integral.
        let (few, many) = (environment.lights(8), environment.lights(2048));
        assert_eq!(few.len(), 8);
        for toward in [DVec3::Y, DVec3::Z, DVec3::X, dvec3(0.5, 0.6, 0.62).normalize()] {
            let (few, many) = (flux(toward, &few), flux(toward, &many));
            // What a plane that cuts a light's part of the sky in two gets of it, an eighth of all, may come whole or not at all: a quarter is
            // two such parts.
            hold("environment: irradiance by eight lights", (few / many - 1.0).abs(), 0.25);
        }
        let total = |lights: &[Light]| lights.iter().map(|light| match light { Light::Directional { irradiance, .. } => irradiance[1], Light::Point { .. } => f64::NAN }).sum::<f64>();
        hold("environment: light of eight and of many", (total(&few) / total(&many) - 1.0).abs(), 1e-6);
    }
    let white = Environment::uniform([1.0; 3]).expect("is one");
    let view = MeshView { surroundings: around(white), ..view(Shape::Plane.mesh(), [1.0; 2], above([9, 9]), &[]) };
    let seen = draw(gpu, &view, &plain(4, 4), Output::Radiance)[(4, 4)];
    hold("mesh: bare white under a white environment", (f64::from(seen[1]) - 1.0).abs(), 0.25);
}
