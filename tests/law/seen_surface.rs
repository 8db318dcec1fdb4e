use overpaint::{
    data::{Direction, Map, Samples},
    gpu::Gpu,
    model::{Boundary, Relief},
    reference,
    stage::{SeenSurface, Shading, upload_directions},
};

use crate::support::{
    Worst, hold,
    surface::{plain, upload, with_heights},
    tile,
};

crate::suite! { gpu: a_raised_plane_is_seen_beside_its_place, a_plateau_takes_its_light_from_what_lies_behind; }

/// z = h everywhere is seen at h tan θ along the view's azimuth, lit by cos θ_i.
fn a_raised_plane_is_seen_beside_its_place(gpu: &Gpu) {
    let field = upload(gpu, &with_heights(plain(16, 16), Map::from_fn(16, 16, |_, _| 1.5))).field;
    let angles = [(0.0, 0.0), (30.0, 0.0), (60.0, 90.0), (75.0, 225.0)].map(|(theta, phi)| Direction::from_degrees(theta, phi));
    let samples = Samples::new(angles.iter().map(|&view| (view, angles[(view.theta > 0.7) as usize])).collect());
    let radiance = tile::upload(gpu, 1, samples.len(), |_, _, _| 0.25);
    let mut recorder = gpu.recorder();
    let relief = Relief::measured();
    let seen = SeenSurface::new(gpu).expect("builds").record(&mut recorder, &field, relief, &angles, &[[5, 6]]).expect("records");
    let directions = upload_directions(gpu, &samples, &[0, 1, 2, 3]).expect("fits");
    let shaded = Shading::new(gpu).expect("builds").record(&mut recorder, &radiance, &directions, &field, &seen, relief, 0.0).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    let points = seen.points.read(gpu).expect("reads");
    for (point, view) in points.iter().zip(&angles) {
        let run = 1.5 * view.theta.tan();
        let expected = [5.0 + run * view.phi.cos(), 6.0 - run * view.phi.sin(), 1.5, 0.0];
        // A few roundings of places up to 16.
        hold("seen_surface: a raised plane", (0..4).map(|axis| (f64::from(point[axis]) - expected[axis]).abs()).worst(), 4e-6);
    }
    let shading = tile::unpack(&shaded.shading.read(gpu).expect("reads"), 1);
    let errors = shading.iter().zip(samples.light_cosines()).map(|(found, cosine)| (found - cosine).abs());
    // Half's rounding.
    hold("shading: a raised plane", errors.worst(), 2.5e-4);
}

/// The ground beside a plateau of height 4 lies in its shadow for 4 tan θ texels and no further; from the other side it is lit.
fn a_plateau_takes_its_light_from_what_lies_behind(gpu: &Gpu) {
    let heights = Map::from_fn(64, 1, |column, _| if (20..36).contains(&column) { 4.0 } else { 0.0 });
    // Upright normals, so that shading is the cosine where there is light.
    let surface = reference::Surface { heights, boundary: Boundary::Periodic, ..plain(64, 1) };
    let field = upload(gpu, &surface).field;
    let zenith = Direction::from_degrees(0.0, 0.0);
    let samples = Samples::new([0.0, 180.0].map(|phi| (zenith, Direction::from_degrees(50.0, phi))).to_vec());
    let places: Vec<[u32; 2]> = (0..64).map(|column| [column, 0]).collect();
    let radiance = tile::upload(gpu, 64, 2, |_, _, _| 0.25);
    let mut recorder = gpu.recorder();
    let seen = SeenSurface::new(gpu).expect("builds").record(&mut recorder, &field, Relief::measured(), &[zenith], &places).expect("records");
    let directions = upload_directions(gpu, &samples, &[0, 0]).expect("fits");
    let shaded =
        Shading::new(gpu).expect("builds").record(&mut recorder, &radiance, &directions, &field, &seen, Relief::measured(), 0.0).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    let shading = tile::unpack(&shaded.shading.read(gpu).expect("reads"), 64);
    let length = 4.0 * 50.0_f64.to_radians().tan();
    for (sample, towards) in [(0, 1.0), (1, -1.0)] {
        for column in 0..64 {
            // Texels from the plateau's edge on the side that the light does not come from.
            let distance = if towards > 0.0 { 20.0 - column as f64 } else { column as f64 - 35.0 };
            let found = shading[sample * 64 + column];
            let lit = (found - 50.0_f64.to_radians().cos()).abs() < 3e-4;
            if distance > 1.0 && distance < length - 1.0 {
                assert_eq!(found, 0.0, "column {column} is lit");
            } else if distance > length + 1.0 || distance < -1.0 {
                assert!(lit, "column {column} reads {found}");
            }
        }
    }
}
