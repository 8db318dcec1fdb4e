//! Pictures.

use overpaint::{
    data::Map,
    io::picture,
    model::color::{linear_from_srgb, srgb_from_linear},
};

use super::assert_says;
use crate::support::random::Random;

crate::suite! { plain:
    every_code_survives_a_png,
    a_png_is_clamped_and_not_premultiplied,
    nan_has_no_code,
    an_exr_keeps_every_bit,
    other_extensions_are_refused,
    a_picture_replaces_another_and_leaves_nothing_else;
}

fn every_code_survives_a_png() {
    let folder = tempfile::tempdir().expect("is writable");
    let path = folder.path().join("codes.png");
    let gray = |code: usize| linear_from_srgb(code as f64 / 255.0) as f32;
    picture::write(&path, &Map::from_fn(16, 16, |x, y| [gray(16 * y + x), gray(255 - 16 * y - x), 0.0, 1.0])).expect("writes");
    let codes = image::open(&path).expect("is a PNG").into_rgba8();
    for (code, pixel) in codes.pixels().enumerate() {
        assert_eq!(pixel.0, [code as u8, 255 - code as u8, 0, 255]);
    }
    let read = picture::read(&path).expect("reads");
    assert!(read.values().iter().enumerate().all(|(code, pixel)| *pixel == [gray(code), gray(255 - code), 0.0, 1.0]));
}

fn a_png_is_clamped_and_not_premultiplied() {
    let folder = tempfile::tempdir().expect("is writable");
    let path = folder.path().join("alpha.PNG");
    let half = (linear_from_srgb(128.0 / 255.0) / 2.0) as f32;
    let pixels = vec![[-1.0, 2.0, f32::INFINITY, 1.5], [half, 0.5, 0.0, 0.5], [0.3, 0.3, 0.3, 0.0]];
    picture::write(&path, &Map::new(3, 1, pixels).expect("fits")).expect("writes");
    let codes = image::open(&path).expect("is a PNG").into_rgba8();
    assert_eq!(codes.as_raw().as_slice(), [[0, 255, 255, 255], [128, 255, 0, 128], [0, 0, 0, 0]].as_flattened());
    // Rounded to the nearest code, not down.
    let between = linear_from_srgb(100.6 / 255.0) as f32;
    picture::write(&path, &Map::from_fn(1, 1, |_, _| [between, 0.0, 0.0, 1.0])).expect("writes");
    assert_eq!(image::open(&path).expect("is a PNG").into_rgba8().as_raw()[0], 101);
    assert_eq!((srgb_from_linear(f64::from(between)) * 2550.0).round(), 1006.0);
}

fn nan_has_no_code() {
    let folder = tempfile::tempdir().expect("is writable");
    let path = folder.path().join("nan.png");
    let pixels = Map::from_fn(5, 4, |x, y| [if (x, y) == (3, 2) { f32::NAN } else { 0.0 }, 0.0, 0.0, 1.0]);
    assert_says(picture::write(&path, &pixels), &["nan.png", "column 3, row 2", ".exr"]);
    assert_eq!(std::fs::read_dir(folder.path()).expect("is readable").count(), 0);
}

fn an_exr_keeps_every_bit() {
    let folder = tempfile::tempdir().expect("is writable");
    let path = folder.path().join("float.exr");
    let mut random = Random::new(7);
    let mut picture = Map::from_fn(67, 33, |_, _| [0; 4].map(|_: u8| random.between(-10.0, 1e6) as f32));
    picture[(5, 7)] = [f32::MIN_POSITIVE, 1e-40, f32::MAX, -0.0];
    picture::write(&path, &picture).expect("writes");
    let read = picture::read(&path).expect("reads");
    let bits = |picture: &Map<[f32; 4]>| picture.values().iter().map(|pixel| pixel.map(f32::to_bits)).collect::<Vec<_>>();
    assert_eq!((read.width(), read.height(), bits(&read)), (67, 33, bits(&picture)));
}

fn other_extensions_are_refused() {
    let folder = tempfile::tempdir().expect("is writable");
    let picture = Map::from_fn(1, 1, |_, _| [0.0; 4]);
    for (name, found) in [("a.jpg", ".jpg"), ("a", "none"), ("png", "none")] {
        assert_says(picture::write(&folder.path().join(name), &picture), &[name, ".png", ".exr", &format!("found {found}")]);
    }
    assert_says(picture::write(&folder.path().join("no/such/folder.png"), &picture), &["folder.png", "cannot write"]);
}

fn a_picture_replaces_another_and_leaves_nothing_else() {
    let folder = tempfile::tempdir().expect("is writable");
    let path = folder.path().join("a.png");
    for value in [0.0, 1.0] {
        picture::write(&path, &Map::from_fn(2, 2, |_, _| [value, value, value, 1.0])).expect("writes");
        assert_eq!(picture::read(&path).expect("reads")[(1, 1)], [value, value, value, 1.0]);
    }
    assert_eq!(std::fs::read_dir(folder.path()).expect("is readable").count(), 1);
}
