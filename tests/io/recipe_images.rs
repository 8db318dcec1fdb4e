//! Images that recipes draw.

use std::io::Cursor;

use exr::prelude::{Image, SpecificChannels, Vec2, WritableImage};
use image::{DynamicImage, ImageBuffer, ImageFormat, Luma, LumaA, Rgb, Rgba};
use overpaint::{data::Recipe, io::IoError, model::Pattern};

use super::recipe::{folder, load};
use crate::support::{hold, worst_difference};

crate::suite! { plain:
    thickness_is_the_code_over_the_largest,
    colours_count_by_their_luma_and_opacity,
    every_format_is_read,
    floats_are_taken_as_they_are,
    nan_is_refused_with_its_place,
    an_image_is_read_once,
    what_is_no_image_is_refused;
}

fn encode(image: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.into().write_to(&mut bytes, format).expect("encodes");
    bytes.into_inner()
}

/// A recipe of a layer for each (file, inverted).
fn recipe(layers: &[(&str, bool)]) -> String {
    let layer = |(file, invert): &(&str, bool)| {
        format!("[[layer]]\npaint = \"viridian\"\nthickness = 1\npattern = {{ kind = \"image\", file = \"{file}\", invert = {invert} }}\n")
    };
    layers.iter().map(layer).collect()
}

fn read(name: &str, bytes: &[u8], invert: bool) -> Result<Recipe, IoError> {
    load(&folder(&[("r.toml", recipe(&[(name, invert)]).as_bytes()), (name, bytes)]))
}

/// The drawn thickness of an image.
fn drawn(name: &str, bytes: &[u8], invert: bool) -> Vec<f64> {
    let read = read(name, bytes, invert).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((read.layers[0].pattern, read.images.len(), read.images[0].name.as_str()), (Pattern::Image { image: 0 }, 1, name));
    read.images[0].drawn.values().iter().map(|value| f64::from(*value)).collect()
}

fn thickness_is_the_code_over_the_largest() {
    let bytes = encode(ImageBuffer::from_fn(256, 1, |x, _| Luma([x as u8])), ImageFormat::Png);
    let expected: Vec<_> = (0..256).map(|code| f64::from(code) / 255.0).collect();
    // Half a last place of an f32 below 1.
    hold("drawing: 8 bits", worst_difference(drawn("a.png", &bytes, false), expected.iter().copied()), 6e-8);
    hold("drawing: inverted", worst_difference(drawn("a.png", &bytes, true), expected.iter().map(|value| 1.0 - value)), 6e-8);
    let bytes = encode(ImageBuffer::from_fn(256, 256, |x, y| Luma([(256 * y + x) as u16])), ImageFormat::Png);
    hold("drawing: 16 bits", worst_difference(drawn("a.png", &bytes, false), (0..65536).map(|code| f64::from(code) / 65535.0)), 6e-8);
}

fn colours_count_by_their_luma_and_opacity() {
    let rgb = encode(ImageBuffer::from_fn(4, 1, |x, _| Rgb([[255_u8, 0, 0], [0, 255, 0], [0, 0, 255], [7; 3]][x as usize])), ImageFormat::Png);
    hold("drawing: luma", worst_difference(drawn("a.png", &rgb, false), [0.2126, 0.7152, 0.0722, 7.0 / 255.0]), 6e-8);
    let rgba = encode(ImageBuffer::from_fn(3, 1, |x, _| Rgba([255_u8, 255, 255, [0, 51, 255][x as usize]])), ImageFormat::Png);
    hold("drawing: opacity", worst_difference(drawn("a.png", &rgba, false), [0.0, 0.2, 1.0]), 6e-8);
    let la = encode(ImageBuffer::from_fn(2, 1, |x, _| LumaA([65535_u16, [13107, 65535][x as usize]])), ImageFormat::Png);
    hold("drawing: opacity", worst_difference(drawn("a.png", &la, false), [0.2, 1.0]), 6e-8);
}

fn every_format_is_read() {
    for format in [ImageFormat::Png, ImageFormat::Bmp, ImageFormat::Tiff, ImageFormat::Jpeg] {
        let bytes = encode(ImageBuffer::from_pixel(16, 8, Rgb([200_u8; 3])), format);
        let found = drawn("leaf.image", &bytes, false);
        // JPEG may be off by a code.
        hold("drawing: formats", worst_difference(found, vec![200.0 / 255.0; 128]), 1.01 / 255.0);
    }
    for format in [ImageFormat::Png, ImageFormat::Tiff] {
        let bytes = encode(ImageBuffer::from_pixel(3, 2, Rgba([40_000_u16, 40_000, 40_000, 65_535])), format);
        hold("drawing: 16 bits", worst_difference(drawn("leaf", &bytes, false), vec![40_000.0 / 65_535.0; 6]), 6e-8);
    }
}

fn exr(values: &[f32]) -> Vec<u8> {
    let channels = SpecificChannels::rgb(|Vec2(x, _): Vec2<usize>| (values[x], values[x], values[x]));
    let mut bytes = Cursor::new(Vec::new());
    Image::from_channels((values.len(), 1), channels).write().to_buffered(&mut bytes).expect("encodes");
    bytes.into_inner()
}

fn floats_are_taken_as_they_are() {
    let bytes = exr(&[0.0, 0.25, 1.0, -3.0, 7.0, f32::INFINITY]);
    hold("drawing: floats", worst_difference(drawn("a.exr", &bytes, false), [0.0, 0.25, 1.0, 0.0, 1.0, 1.0]), 6e-8);
}

fn nan_is_refused_with_its_place() {
    let error = read("a.exr", &exr(&[0.0, 0.5, f32::NAN]), false).expect_err("has a NaN").to_string();
    assert!(error.contains("r.toml:4:36: ") && error.contains("a.exr: the pixel in column 2, row 0 is not a number"), "{error}");
}

fn an_image_is_read_once() {
    let bytes = encode(ImageBuffer::from_pixel(2, 1, Luma([51_u8])), ImageFormat::Png);
    let text = recipe(&[("a.png", false), ("a.png", true), ("a.png", false), ("b.png", false)]);
    let read = load(&folder(&[("r.toml", text.as_bytes()), ("a.png", &bytes), ("b.png", &bytes)])).expect("is a recipe");
    let used: Vec<_> = read.layers.iter().map(|layer| layer.pattern).collect();
    assert_eq!(used, [0, 1, 0, 2].map(|image| Pattern::Image { image }));
    let images: Vec<_> = read.images.iter().map(|image| (image.name.as_str(), image.drawn[(1, 0)])).collect();
    assert_eq!(images, [("a.png", 0.2), ("a.png", 0.8), ("b.png", 0.2)]);
}

fn what_is_no_image_is_refused() {
    let png = encode(ImageBuffer::from_pixel(20, 20, Luma([51_u8])), ImageFormat::Png);
    let mut huge = png.clone();
    huge[16..24].copy_from_slice(&[0, 0, 0x80, 0, 0, 0, 0x80, 0]);
    let crc = crc32fast::hash(&huge[12..29]).to_be_bytes();
    huge[29..33].copy_from_slice(&crc);
    for (bytes, says) in [
        (&b"leaf"[..], "is no image"),
        (b"", "nothing (it is empty)"),
        (&png[..png.len() / 2], "is truncated"),
        (&huge, "is 32768 x 32768 texels, more than the 67108864"),
    ] {
        let error = read("leaf.png", bytes, false).expect_err("is no image").to_string();
        assert!(error.contains("r.toml:4:36: ") && error.contains("leaf.png") && error.contains(says), "{error}");
    }
}
