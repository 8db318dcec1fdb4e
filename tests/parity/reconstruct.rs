use overpaint::{
    data::{Direction, Map},
    gpu::Gpu,
    model::{Boundary, Frame, Relief},
    reference,
};

use crate::support::{
    hold,
    surface::{bumpy, compare, reconstruct, upload},
    worst_difference,
};

crate::suite! { gpu: agrees_with_its_twin, agrees_where_nothing_is_discontinuous, a_repeated_surface_gives_the_repeated_picture; }

const OFF: Relief = Relief { displace: false, shadow: false, penumbra: 0.1 };

fn with_alpha(picture: &Map<[f64; 3]>) -> Map<[f64; 4]> {
    picture.map(|&[r, g, b]| [r, g, b, 1.0])
}

fn agrees_with_its_twin(gpu: &Gpu) {
    for (width, height) in [(1, 1), (63, 1), (64, 1), (65, 1), (1, 65), (50, 100)] {
        for boundary in [Boundary::Periodic, Boundary::Mirror] {
            let surface = bumpy(width, height, boundary, 11);
            let other = bumpy(width, height, boundary, 12).lobes;
            let in_frame = |frame| reference::Surface { frame, ambient: 0.125, lobes: [surface.lobes.clone(), other.clone()].concat(), ..surface.clone() };
            for surface in [surface.clone(), in_frame(Frame::Texel), in_frame(Frame::Seen)] {
            let uploaded = upload(gpu, &surface);
            for (view, light) in [((0.0, 0.0), (35.0, 20.0)), ((40.0, 130.0), (60.0, 250.0)), ((75.0, 300.0), (75.0, 45.0))] {
                let (view, light) = (Direction::from_degrees(view.0, view.1), Direction::from_degrees(light.0, light.1));
                // The kernel's search steps half a texel and its shadows from grid line to grid line, where the twin's crossings
                // and covers are exact: pixels on a silhouette or on the edge of a sharp shadow may fall on its other side.
                // Those are lines, a few pixels in a thousand, and each off by what FLIP calls a full error or less.
                for (light_is, relief) in [("wide", Relief::default()), ("small", Relief::measured())] {
                    let found = reconstruct(gpu, &uploaded, view, light, relief);
                    let expected = with_alpha(&reference::reconstruct(&surface, view, light, relief));
                    let [flip, differing] = compare(&found, &expected, 5e-3);
                    hold(&format!("reconstruct: mean FLIP, {light_is} light"), flip, 0.003);
                    hold(&format!("reconstruct: share of pixels off by more than 0.005, {light_is} light"), differing, 0.002);
                }
            }
            }
        }
    }
}

/// Without relief, and with displacement seen from so high that nothing hides, pixels agree one by one.
fn agrees_where_nothing_is_discontinuous(gpu: &Gpu) {
    let flat = bumpy(50, 100, Boundary::Mirror, 5);
    let frames = [Frame::Plane, Frame::Texel, Frame::Seen].map(|frame| reference::Surface { frame, ..flat.clone() });
    for surface in frames {
    let uploaded = upload(gpu, &surface);
    let light = Direction::from_degrees(50.0, 200.0);
    // Flat: one power with an exponent up to 20 (2e-6 relative) of values below 1.5. Displaced: places off by the secant's error and
    // by rounding, 1e-5 texel, between texels that differ by up to 1.
    for (view, relief, bound) in [((60.0, 70.0), OFF, 4e-6), ((15.0, 70.0), Relief { displace: true, ..OFF }, 2e-5)] {
        let view = Direction::from_degrees(view.0, view.1);
        let found = reconstruct(gpu, &uploaded, view, light, relief);
        let expected = reference::reconstruct(&surface, view, light, relief);
        let found = found.values().iter().flat_map(|v| [v[0], v[1], v[2]].map(f64::from));
        let what = if relief.displace { "reconstruct: displaced pixels" } else { "reconstruct: flat pixels" };
        hold(what, worst_difference(found, expected.values().iter().flatten().copied()), bound);
    }
    }
}

/// One row past 65,535 workgroups of 64, against a picture of one tile of it.
fn a_repeated_surface_gives_the_repeated_picture(gpu: &Gpu) {
    let (tile_width, tile_height) = (64, 32);
    let tile = bumpy(tile_width, tile_height, Boundary::Periodic, 3);
    let (columns, rows) = (257, 8);
    let large = reference::Surface {
        heights: tile.heights.repeated(columns, rows),
        normals: tile.normals.repeated(columns, rows),
        diffuse: tile.diffuse.repeated(columns, rows),
        lobes: tile.lobes.iter().map(|(specular, lobe)| (specular.repeated(columns, rows), lobe.repeated(columns, rows))).collect(),
        painted: tile.painted.repeated(columns, rows),
        coat: tile.coat.repeated(columns, rows),
        ..tile.clone()
    };
    let (view, light) = (Direction::from_degrees(30.0, 70.0), Direction::from_degrees(40.0, 10.0));
    // Without relief no place is rounded, so the pictures are equal.
    let small = reconstruct(gpu, &upload(gpu, &tile), view, light, OFF);
    let large = reconstruct(gpu, &upload(gpu, &large), view, light, OFF);
    assert!(large == small.repeated(columns, rows));
}
