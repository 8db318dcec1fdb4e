use overpaint::{
    data::{Direction, PlaneView},
    gpu::Gpu,
    model::{Boundary, Relief},
};

use crate::{
    parity::plane::draw,
    support::{
        Worst, hold,
        surface::{bumpy, plain, reconstruct, upload},
    },
};

crate::suite! {
    gpu: the_picture_from_the_zenith_is_the_reconstruction, the_plane_is_foreshortened_and_transparent_outside,
        the_materials_up_is_the_pictures_up, a_plane_seen_from_behind_or_edge_on_is_transparent;
}

fn shot(view: (f64, f64), light: (f64, f64), size: [u32; 2]) -> PlaneView {
    PlaneView {
        view: Direction::from_degrees(view.0, view.1),
        light: Direction::from_degrees(light.0, light.1),
        size,
        margin: 0.0,
        samples: 1,
    }
}

/// At the material's own size and without a margin each pixel is a texel.
fn the_picture_from_the_zenith_is_the_reconstruction(gpu: &Gpu) {
    let surface = upload(gpu, &bumpy(45, 70, Boundary::Periodic, 2));
    let shot = shot((0.0, 0.0), (55.0, 160.0), [45, 70]);
    let drawn = draw(gpu, &surface, &shot, Relief::default());
    let reconstructed = reconstruct(gpu, &surface, shot.view, shot.light, Relief::default());
    let errors = drawn.values().iter().zip(reconstructed.values()).flat_map(|(a, b)| (0..4).map(|c| (a[c] - b[c]).abs()));
    // The same WGSL on the same places; a driver may contract the two programs differently.
    hold("plane: zenith against reconstruct", errors.worst(), 1e-6);
}

/// A square seen at 60° along y is half as high as wide, and fills the picture's width.
fn the_plane_is_foreshortened_and_transparent_outside(gpu: &Gpu) {
    let surface = upload(gpu, &plain(16, 16));
    for (samples, tolerance) in [(1, 1.0 / 128.0), (4, 1.0 / 512.0)] {
        let shot = PlaneView { samples, ..shot((60.0, -90.0), (0.0, 0.0), [128, 128]) };
        let picture = draw(gpu, &surface, &shot, Relief::default());
        let covered = picture.values().iter().map(|pixel| f64::from(pixel[3])).sum::<f64>() / (128.0 * 128.0);
        hold("plane: covered share at 60°", (covered - 0.5).abs(), tolerance);
        for pixel in picture.values() {
            // White, lit from the zenith, premultiplied.
            assert_eq!(pixel[0], pixel[3]);
        }
    }
}

/// Brightest where the material is: its upper right corner stays up and right from any side, unless seen from the far side.
fn the_materials_up_is_the_pictures_up(gpu: &Gpu) {
    let mut surface = plain(16, 16);
    for row in 0..16 {
        for column in 0..16 {
            let bright = if row < 8 && column >= 8 { 1.0 } else { 0.0 };
            surface.diffuse[(column, row)] = [bright; 3];
        }
    }
    let surface = upload(gpu, &surface);
    for view in [(0.0, 0.0), (0.0, 77.0), (50.0, 0.0), (50.0, 90.0), (50.0, 180.0), (50.0, 270.0), (35.0, 200.0)] {
        let picture = draw(gpu, &surface, &shot(view, (0.0, 0.0), [64, 64]), Relief::default());
        let (mut x, mut y, mut sum) = (0.0, 0.0, 0.0);
        for row in 0..64 {
            for column in 0..64 {
                let weight = f64::from(picture[(column, row)][0]);
                x += weight * (column as f64 - 31.5);
                y += weight * (31.5 - row as f64);
                sum += weight;
            }
        }
        assert!(x / sum > 2.0 && y / sum > 2.0, "{view:?}: ({}, {})", x / sum, y / sum);
    }
}

fn a_plane_seen_from_behind_or_edge_on_is_transparent(gpu: &Gpu) {
    let surface = upload(gpu, &plain(4, 4));
    for theta in [90.0, 130.0, 180.0] {
        let picture = draw(gpu, &surface, &shot((theta, 90.0), (0.0, 0.0), [8, 8]), Relief::default());
        assert!(picture.values().iter().all(|pixel| *pixel == [0.0; 4]));
    }
}
