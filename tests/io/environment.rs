//! Environment maps.

use std::io::Cursor;

use exr::prelude::{Image, SpecificChannels, Vec2, WritableImage};
use half::f16;
use image::{ImageFormat, Rgb, Rgb32FImage};
use overpaint::io::environment::{LoadedEnvironment, load, parse};

use super::{assert_says, encoded};

crate::suite! { plain:
    radiance_hdr_is_read,
    openexr_is_read,
    overflow_and_ringing_are_mended,
    nan_is_refused_with_its_place,
    codes_are_refused,
    wrong_sizes_are_refused,
    what_is_no_image_is_refused;
}

fn exr(size: [usize; 2], value: impl Sync + Fn(usize, usize) -> [f32; 3]) -> Vec<u8> {
    let channels = SpecificChannels::rgb(|Vec2(column, row)| <(f32, f32, f32)>::from(value(column, row)));
    let mut bytes = Cursor::new(Vec::new());
    Image::from_channels((size[0], size[1]), channels).write().to_buffered(&mut bytes).expect("encodes");
    bytes.into_inner()
}

fn value(column: usize, row: usize) -> [f32; 3] {
    [column as f32, row as f32, 0.25]
}

/// Nothing was mended.
fn clean(loaded: LoadedEnvironment) -> overpaint::data::Environment {
    assert_eq!(loaded.warnings, [""; 0]);
    loaded.environment
}

fn radiance_hdr_is_read() {
    let image = Rgb32FImage::from_fn(16, 8, |x, y| Rgb([(1 << x) as f32, (1 << y) as f32, 1.0]));
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, ImageFormat::Hdr).expect("encodes");
    let folder = tempfile::tempdir().expect("is writable");
    let path = folder.path().join("studio.hdr");
    std::fs::write(&path, bytes.get_ref()).expect("is writable");
    let environment = clean(load(&path).expect("loads"));
    assert_eq!((environment.map().width(), environment.map().height()), (16, 8));
    // One exponent for all three: what is below 2^-9 of the largest is lost.
    for (texel, rgb) in environment.map().values().iter().enumerate() {
        let (x, y) = (texel % 16, texel / 16);
        assert!((rgb[0] - (1 << x) as f32).abs() <= (1 << x.max(y)) as f32 / 128.0, "{rgb:?}");
    }
}

fn openexr_is_read() {
    let environment = clean(parse("a.exr", &exr([5, 3], value)).expect("loads"));
    assert_eq!((environment.map().width(), environment.map().height()), (5, 3));
    assert!((0..15).all(|texel| environment.map().values()[texel] == value(texel % 5, texel / 5)));
}

fn overflow_and_ringing_are_mended() {
    let channels = SpecificChannels::rgb(|Vec2(column, _)| {
        let sun = [1.0, 1e6, -0.5][column];
        (f16::from_f32(sun), f16::from_f32(1.0), f16::from_f32(2.0))
    });
    let mut bytes = Cursor::new(Vec::new());
    Image::from_channels((3, 1), channels).write().to_buffered(&mut bytes).expect("encodes");
    let loaded = parse("sun.exr", bytes.get_ref()).expect("loads");
    assert_eq!(loaded.environment.map().values(), [[1.0, 1.0, 2.0], [65504.0, 1.0, 2.0], [0.0, 1.0, 2.0]]);
    let [infinite, negative] = loaded.warnings.as_slice() else { panic!("{:?}", loaded.warnings) };
    assert!(infinite.contains("sun.exr: 1 values are infinite") && infinite.contains("65504"), "{infinite}");
    assert!(negative.contains("sun.exr: 1 values are negative"), "{negative}");
}

fn nan_is_refused_with_its_place() {
    let bytes = exr([4, 2], |column, row| [1.0, if (column, row) == (2, 1) { f32::NAN } else { 0.0 }, 1.0]);
    assert_says(parse("a.exr", &bytes), &["a.exr", "column 2, row 1", "NaN", "from 0"]);
    assert_says(parse("a.exr", &exr([4, 2], |_, _| [1e30, 0.0, 0.0])), &["a.exr", "column 0, row 0", "1e20"]);
}

fn codes_are_refused() {
    for format in [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::Bmp, ImageFormat::Tiff] {
        assert_says(parse("a.hdr", &encoded(format, [12, 6], 1)), &["a.hdr", "codes", "expected linear radiance", ".exr"]);
    }
}

fn wrong_sizes_are_refused() {
    assert_says(parse("a.exr", &exr([1, 3], value)), &["a.exr", "1 x 3 texels", "at least 2 x 1"]);
    let declares = |width: u32, height: u32| format!("#?RADIANCE\n\n-Y {height} +X {width}\n").into_bytes();
    assert_says(parse("a.hdr", &declares(40_000, 1)), &["a.hdr", "40000 x 1 texels", "at most 32768"]);
    assert_says(parse("a.hdr", &declares(u32::MAX, u32::MAX)), &["a.hdr", "4294967295 x 4294967295"]);
    // A size that is taken, of which nothing is there.
    assert_says(parse("a.hdr", &declares(8192, 4096)), &["a.hdr is truncated"]);
}

fn what_is_no_image_is_refused() {
    assert_says(parse("a.hdr", b"hello"), &["a.hdr", "is no image"]);
    assert_says(parse("a.hdr", b""), &["a.hdr", "is no image"]);
    let folder = tempfile::tempdir().expect("is writable");
    assert_says(load(&folder.path().join("missing.exr")), &["missing.exr", "does not exist"]);
    assert_says(load(folder.path()), &["cannot read"]);
}
