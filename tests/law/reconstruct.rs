use overpaint::{
    data::{Direction, Map},
    gpu::{Buffer, Gpu},
    model::{Boundary, Coat, Frame, Relief},
    reference, stage,
};

use crate::support::{
    Worst, hold,
    surface::{bumpy, coat, plain, reconstruct, upload, with_heights},
};

crate::suite! {
    gpu: a_flat_field_is_its_plain_texture, unpainted_texels_know_no_paint, a_mirrored_material_gives_the_mirrored_picture,
        a_plateau_casts_a_shadow_of_its_height_times_tan, a_wide_light_is_covered_by_excess_over_distance, a_plateau_moves_by_its_height_times_tan, hidden_texels_are_not_seen,
        white_reads_the_cosine, a_turned_frame_sees_turned_directions, paint_returns_no_more_than_it_gets, nothing_comes_from_below_the_horizon;
}

fn degrees(theta: f64, phi: f64) -> Direction {
    Direction::from_degrees(theta, phi)
}

/// `height` on columns 20 to 35 of 64, zero elsewhere.
fn plateau(height: f64) -> Map<f64> {
    Map::from_fn(64, 8, |column, _| if (20..36).contains(&column) { height } else { 0.0 })
}

fn a_flat_field_is_its_plain_texture(gpu: &Gpu) {
    let bumpy = bumpy(40, 30, Boundary::Periodic, 9);
    let mut surface = upload(gpu, &with_heights(bumpy, Map::from_fn(40, 30, |_, _| 0.0)));
    let plain = Relief { displace: false, shadow: false, penumbra: 0.1 };
    // Also with bounds wider than the heights.
    for range in [[0.0, 0.0], [-1.3, 0.9]] {
        surface.field.range = range;
        for (view, light) in [(degrees(0.0, 0.0), degrees(30.0, 10.0)), (degrees(70.0, 40.0), degrees(80.0, 100.0))] {
            let off = reconstruct(gpu, &surface, view, light, plain);
            assert!(off == reconstruct(gpu, &surface, view, light, Relief::default()));
        }
    }
}

fn unpainted_texels_know_no_paint(gpu: &Gpu) {
    let mut surface = bumpy(40, 30, Boundary::Mirror, 4);
    for texel in 0..40 * 30 {
        surface.painted[(texel % 40, texel / 40)][3] = 0.0;
    }
    let bare = reference::Surface {
        painted: surface.painted.map(|_| [0.0; 4]),
        coat: surface.coat.map(|_| coat(Coat { refractive_index: 2.2, roughness: 0.05 })),
        ..surface.clone()
    };
    let (view, light) = (degrees(50.0, 200.0), degrees(60.0, 30.0));
    let [with, without] = [&surface, &bare].map(|surface| reconstruct(gpu, &upload(gpu, surface), view, light, Relief::default()));
    assert!(with == without);
}

fn a_mirrored_material_gives_the_mirrored_picture(gpu: &Gpu) {
    let surface = bumpy(48, 40, Boundary::Periodic, 6);
    fn mirror<T: Copy>(map: &Map<T>) -> Map<T> {
        Map::from_fn(map.width(), map.height(), |column, row| map[(map.width() - 1 - column, row)])
    }
    let mirrored = reference::Surface {
        heights: mirror(&surface.heights),
        normals: mirror(&surface.normals).map(|n| [-n[0], n[1], n[2]]),
        diffuse: mirror(&surface.diffuse),
        lobes: surface.lobes.iter().map(|(specular, lobe)| (mirror(specular), mirror(lobe))).collect(),
        painted: mirror(&surface.painted),
        ..surface.clone()
    };
    let picture = reconstruct(gpu, &upload(gpu, &surface), degrees(45.0, 25.0), degrees(65.0, 140.0), Relief::default());
    let other = reconstruct(gpu, &upload(gpu, &mirrored), degrees(45.0, 155.0), degrees(65.0, 40.0), Relief::default());
    let other = mirror(&other);
    let off = picture.values().iter().zip(other.values()).filter(|(a, b)| !(0..3).all(|c| (a[c] - b[c]).abs() <= 1e-3)).count();
    // Places are rounded differently on either side, which a silhouette or the edge of a hard shadow may show.
    hold("reconstruct: share of pixels that mirroring changes", off as f64 / (48.0 * 40.0), 2e-3);
}

fn a_plateau_casts_a_shadow_of_its_height_times_tan(gpu: &Gpu) {
    let surface = upload(gpu, &with_heights(plain(64, 8), plateau(4.0)));
    for theta in [20.0_f64, 50.0, 60.0, 65.0] {
        // Light from the right: the shadow lies to the left of column 20.
        let picture = reconstruct(gpu, &surface, degrees(0.0, 0.0), degrees(theta, 0.0), Relief::measured());
        for row in 0..8 {
            let dark = (0..20).filter(|&column| picture[(column, row)][0] == 0.0).count();
            hold("reconstruct: length of a shadow", (dark as f64 - 4.0 * theta.to_radians().tan()).abs(), 1.0);
            assert!((21..64).all(|column| picture[(column, row)][0] > 0.0), "lit ground is dark at {theta}°");
        }
    }
}

/// u texels before a rim that stands h above the ground, under a light at θ of width w, the share (h − u cot θ) sin θ/(u tan w) is
/// hidden (Tatarchuk 2006), whatever the ground is covered with.
fn a_wide_light_is_covered_by_excess_over_distance(gpu: &Gpu) {
    let mut surface = with_heights(plain(64, 8), plateau(4.0));
    let off = Relief { shadow: false, penumbra: 0.5, ..Relief::default() };
    for coverage in [0.0, 0.5, 1.0] {
        surface.painted = Map::from_fn(64, 8, |_, _| [0.8, 0.5, 0.2, coverage]);
        let uploaded = upload(gpu, &surface);
        for theta in [30.0_f64, 45.0, 65.0] {
            let picture = |relief| reconstruct(gpu, &uploaded, degrees(0.0, 0.0), degrees(theta, 0.0), relief);
            let (lit, shadowed) = (picture(off), picture(Relief { shadow: true, ..off }));
            let (sine, cosine) = theta.to_radians().sin_cos();
            let error = (0..19).map(|column| {
                let ahead = f64::from(20 - column);
                let hidden = ((4.0 - ahead * cosine / sine) * sine / (ahead * off.penumbra)).clamp(0.0, 1.0);
                let column = column as usize;
                (f64::from(shadowed[(column, 4)][0] / lit[(column, 4)][0]) - (1.0 - hidden)).abs()
            });
            // The bias of 0.001 texel, two texels from the rim: 0.001 sin θ/(2 · 0.5).
            hold("reconstruct: share of a wide light", error.worst(), 1e-3);
        }
    }
}

fn a_plateau_moves_by_its_height_times_tan(gpu: &Gpu) {
    let mut surface = with_heights(plain(64, 8), plateau(3.0));
    for column in 0..64 {
        for row in 0..8 {
            surface.diffuse[(column, row)] = [column as f64 / 64.0; 3];
        }
    }
    let uploaded = upload(gpu, &surface);
    // Seen from the right the plateau stands further left on the base plane, seen from above (y) further down.
    let picture = reconstruct(gpu, &uploaded, degrees(45.0, 0.0), degrees(0.0, 0.0), Relief::default());
    for row in 0..8 {
        // The rim's own column is a silhouette.
        let moved = (21..36).map(|column| (picture[(column - 3, row)][0] - column as f32 / 64.0).abs()).worst();
        // tan 45° and three texel widths in f32.
        hold("reconstruct: a plateau moves", moved, 1e-6);
    }
    let mut rows = surface;
    rows.heights = Map::from_fn(64, 8, |_, _| 2.0);
    rows.diffuse = Map::from_fn(64, 8, |_, row| [row as f64 / 8.0; 3]);
    let picture = reconstruct(gpu, &upload(gpu, &rows), degrees(45.0, 90.0), degrees(0.0, 0.0), Relief::default());
    for column in 0..64 {
        let moved = (0..8).map(|row| (picture[(column, (row + 2) % 8)][0] - row as f32 / 8.0).abs()).worst();
        hold("reconstruct: rows run against y", moved, 1e-6);
    }
}

/// Red ground behind a plateau, seen from the right at 60°: 4·tan 60° = 6.9 texels to its left are hidden.
fn hidden_texels_are_not_seen(gpu: &Gpu) {
    let mut surface = with_heights(plain(64, 8), plateau(4.0));
    for column in 14..19 {
        for row in 0..8 {
            surface.diffuse[(column, row)] = [1.0, 0.0, 0.0];
        }
    }
    let uploaded = upload(gpu, &surface);
    let is_grey = |pixel: &&[f32; 4]| pixel[1] >= 0.999 * pixel[0];
    let hidden = reconstruct(gpu, &uploaded, degrees(60.0, 0.0), degrees(0.0, 0.0), Relief::default());
    assert_eq!(hidden.values().iter().filter(is_grey).count(), 64 * 8);
    let open = reconstruct(gpu, &uploaded, degrees(60.0, 180.0), degrees(0.0, 0.0), Relief::default());
    assert_eq!(open.values().iter().filter(is_grey).count(), (64 - 5) * 8);
}

fn white_reads_the_cosine(gpu: &Gpu) {
    let surface = upload(gpu, &plain(9, 7));
    for (view, light) in [(0.0, 0.0), (30.0, 40.0), (75.0, 80.0)] {
        let picture = reconstruct(gpu, &surface, degrees(view, 10.0), degrees(light, 200.0), Relief::default());
        let errors = picture.values().iter().flat_map(|pixel| &pixel[..3]).map(|&value| (f64::from(value) - light.to_radians().cos()).abs());
        // One rounding of the cosine.
        hold("reconstruct: white reads cos θ_i", errors.worst(), 6e-8);
    }
}

/// With one normal everywhere, a picture in its frame is the flat one from the directions that the frame sees.
fn a_turned_frame_sees_turned_directions(gpu: &Gpu) {
    let flat = with_heights(bumpy(9, 7, Boundary::Periodic, 2), Map::from_fn(9, 7, |_, _| 0.0));
    let flat = reference::Surface { painted: flat.painted.map(|_| [0.0; 4]), ..flat };
    let (view, light) = (degrees(35.0, 300.0), degrees(55.0, 170.0));
    for (theta, phi) in [(0.0, 0.0), (20.0, 40.0), (30.0, 250.0)] {
        let normal = degrees(theta, phi).vector();
        // Any turn that takes the normal to z will do for directions, but the lobes are not isotropic: the shortest is about the
        // axis n x z, by the angle of the normal, which Rodrigues' formula has in closed form.
        let turned = |direction: Direction| {
            let (sine, cosine) = (-theta.to_radians()).sin_cos();
            let axis = glam::DVec3::new(-phi.to_radians().sin(), phi.to_radians().cos(), 0.0);
            let v = direction.vector();
            let v = v * cosine + axis.cross(v) * sine + axis * axis.dot(v) * (1.0 - cosine);
            Direction { theta: v.z.acos(), phi: v.y.atan2(v.x) }
        };
        let expected = reconstruct(gpu, &upload(gpu, &flat), turned(view), turned(light), Relief::measured());
        for frame in [Frame::Texel, Frame::Seen] {
            let tilted = reference::Surface { frame, normals: flat.normals.map(|_| normal.to_array()), ..flat.clone() };
            let found = reconstruct(gpu, &upload(gpu, &tilted), view, light, Relief::measured());
            let errors = found.values().iter().zip(expected.values()).flat_map(|(f, e)| (0..3).map(move |c| f64::from(f[c] - e[c]).abs()));
            // A power of up to 20 of a base that three roundings went into.
            hold("reconstruct: a turned frame", errors.worst(), 1e-5);
        }
    }
}

/// White paint lit from anywhere: the mean of π f_r cos θ_i over the projected hemisphere of lights is the albedo.
fn paint_returns_no_more_than_it_gets(gpu: &Gpu) {
    let mut surface = plain(1, 1);
    surface.painted[(0, 0)] = [1.0; 4];
    surface.coat = Map::from_fn(1, 1, |_, _| coat(Coat { refractive_index: 1.6, roughness: 0.4 }));
    let surface = upload(gpu, &surface);
    let stage = stage::Reconstruct::new(gpu).expect("builds");
    for theta_view in [0.0, 40.0, 75.0] {
        // Midpoints in cos²θ (equal shares of projected solid angle) and φ; each reading divided by its cosine.
        let (rings, spokes) = (16, 12);
        let mut recorder = gpu.recorder();
        let mut readings = Vec::new();
        for ring in 0..rings {
            let cosine = ((f64::from(ring) + 0.5) / f64::from(rings)).sqrt();
            for spoke in 0..spokes {
                let light = Direction { theta: cosine.acos(), phi: std::f64::consts::TAU * f64::from(spoke) / f64::from(spokes) };
                let picture = stage.record(&mut recorder, &surface, degrees(theta_view, 0.0), light, Relief::default()).expect("records");
                readings.push((picture, cosine));
            }
        }
        gpu.submit(recorder).wait(gpu).expect("runs");
        let share = |(picture, cosine): &(Buffer<[f32; 4]>, f64)| f64::from(picture.read(gpu).expect("reads")[0][0]) / cosine;
        let albedo = readings.iter().map(share).sum::<f64>() / f64::from(rings * spokes);
        // What is reflected is taken from what enters, and single scattering in the facets only loses.
        hold("reconstruct: albedo of white paint", albedo, 1.0);
        // At grazing view the loss is the largest: light that facets throw on to other facets is not followed.
        assert!(albedo > 0.8, "white paint seen at {theta_view}° returns only {albedo}");
    }
}

fn nothing_comes_from_below_the_horizon(gpu: &Gpu) {
    let surface = upload(gpu, &bumpy(20, 20, Boundary::Periodic, 1));
    for (view, light) in [(30.0, 90.0), (30.0, 120.0), (90.0, 30.0), (150.0, 30.0)] {
        let picture = reconstruct(gpu, &surface, degrees(view, 0.0), degrees(light, 0.0), Relief::default());
        assert!(picture.values().iter().all(|pixel| *pixel == [0.0, 0.0, 0.0, 1.0]));
    }
}
