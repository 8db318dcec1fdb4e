//! Images of 16 bits and of floating-point numbers.

use std::io::Cursor;

use half::f16;
use image::{ImageBuffer, ImageFormat, Luma, LumaA, Rgb, Rgba};
use overpaint::{
    data::{Transfer, radiance_half},
    io::{self, ReadOptions},
    model::color::linear_from_srgb,
};
use tiff::encoder::{TiffEncoder, TiffValue, colortype};

use super::{assert_says, single, texels};

crate::suite! { plain:
    codes_of_16_bits_are_read,
    floating_point_tiffs_are_read,
    what_is_no_radiance_comes_as_it_is,
    a_finite_value_stays_finite,
    a_truncated_float_tiff_is_an_error,
    other_kinds_are_named;
}

const SIZE: [u32; 2] = [5, 3];

fn code(index: u32, channel: u32) -> u16 {
    (4_099 * (index + 1) + 997 * channel) as u16
}

fn codes_of_16_bits_are_read() {
    let linear = |code: u16| radiance_half(linear_from_srgb(f64::from(code) / 65535.0)).to_f32();
    let index = |x: u32, y: u32| y * SIZE[0] + x;
    let rgb = ImageBuffer::from_fn(SIZE[0], SIZE[1], |x, y| Rgb([0, 1, 2].map(|channel| code(index(x, y), channel))));
    let rgba = ImageBuffer::from_fn(SIZE[0], SIZE[1], |x, y| Rgba([0, 1, 2, 9].map(|channel| code(index(x, y), channel))));
    let gray = ImageBuffer::from_fn(SIZE[0], SIZE[1], |x, y| Luma([code(index(x, y), 0)]));
    let gray_alpha = ImageBuffer::from_fn(SIZE[0], SIZE[1], |x, y| LumaA([code(index(x, y), 0), 77]));
    let colors: Vec<[f32; 3]> = (0..15).map(|index| [0, 1, 2].map(|channel| linear(code(index, channel)))).collect();
    let grays: Vec<[f32; 3]> = (0..15).map(|index| [linear(code(index, 0)); 3]).collect();
    for (format, extension) in [(ImageFormat::Png, "png"), (ImageFormat::Tiff, "tif")] {
        let mut encodings = vec![Cursor::new(Vec::new()), Cursor::new(Vec::new()), Cursor::new(Vec::new())];
        rgb.write_to(&mut encodings[0], format).expect("encodes");
        rgba.write_to(&mut encodings[1], format).expect("encodes");
        gray.write_to(&mut encodings[2], format).expect("encodes");
        let mut expected = vec![&colors, &colors, &grays];
        if format == ImageFormat::Png {
            let mut bytes = Cursor::new(Vec::new());
            gray_alpha.write_to(&mut bytes, format).expect("encodes");
            encodings.push(bytes);
            expected.push(&grays);
        }
        for (bytes, expected) in encodings.iter().zip(expected) {
            let folder = single(extension, bytes.get_ref());
            assert_eq!(io::open(folder.path()).expect("opens").btf().encoding().transfer, Transfer::Srgb);
            assert_eq!(&texels(folder.path()).expect("decodes"), expected);
        }
    }
}

fn tiff<C: colortype::ColorType>(size: [u32; 2], values: &[C::Inner]) -> Vec<u8>
where
    [C::Inner]: TiffValue,
{
    let mut bytes = Cursor::new(Vec::new());
    TiffEncoder::new(&mut bytes).expect("starts").write_image::<C>(size[0], size[1], values).expect("encodes");
    bytes.into_inner()
}

fn floating_point_tiffs_are_read() {
    let values: Vec<f32> = (0..45).map(|index| index as f32 * 0.125).collect();
    let with_alpha: Vec<f32> = values.chunks_exact(3).flat_map(|rgb| [rgb[0], rgb[1], rgb[2], 0.3]).collect();
    let doubles: Vec<f64> = values.iter().map(|&value| f64::from(value)).collect();
    let colors: Vec<[f32; 3]> = values.as_chunks().0.to_vec();
    let grays: Vec<[f32; 3]> = values[..15].iter().map(|&value| [value; 3]).collect();
    for (bytes, expected) in [
        (tiff::<colortype::RGB32Float>(SIZE, &values), &colors),
        (tiff::<colortype::RGBA32Float>(SIZE, &with_alpha), &colors),
        (tiff::<colortype::RGB64Float>(SIZE, &doubles), &colors),
        (tiff::<colortype::Gray32Float>(SIZE, &values[..15]), &grays),
        (tiff::<colortype::Gray64Float>(SIZE, &doubles[..15]), &grays),
    ] {
        let folder = single("tiff", &bytes);
        let source = io::open(folder.path()).expect("opens");
        assert_eq!((source.btf().size(), source.btf().encoding().transfer), ([5, 3], Transfer::Linear));
        assert_eq!(&texels(folder.path()).expect("decodes"), expected);
    }
}

fn what_is_no_radiance_comes_as_it_is() {
    let stored = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -0.5, -1e-20, -0.0];
    let folder = single("tif", &tiff::<colortype::Gray32Float>([6, 1], &stored));
    for transfer in [Transfer::Linear, Transfer::Srgb, Transfer::Gamma(2.0)] {
        let options = ReadOptions { transfer: Some(transfer), ..ReadOptions::default() };
        let found = io::open_with(folder.path(), &options).expect("opens").picture(0).expect("decodes");
        let [nan, infinite, below, negative, small, zero] = [0, 1, 2, 3, 4, 5].map(|index| found.values()[index][1]);
        assert!(nan.is_nan() && infinite == f32::INFINITY && below == f32::NEG_INFINITY, "{transfer:?}");
        assert!(negative < 0.0 && negative.is_finite() && small < 0.0, "{transfer:?}");
        assert_eq!(zero.to_bits(), 0, "{transfer:?}");
    }
}

fn a_finite_value_stays_finite() {
    let stored = [65_504.0, 65_520.0, 1e30, 1e-30, 6e-8];
    let folder = single("tif", &tiff::<colortype::Gray64Float>([5, 1], &stored));
    let found = texels(folder.path()).expect("decodes");
    assert_eq!(first(&found), [65_504.0, 65_504.0, 65_504.0, 0.0, f16::MIN_POSITIVE_SUBNORMAL.to_f32()]);
    let folder = single("tif", &tiff::<colortype::Gray64Float>([2, 1], &[1e300, -1e300]));
    assert_eq!(first(&texels(folder.path()).expect("decodes")), [65_504.0, -65_504.0]);
}

/// The first channel.
fn first(texels: &[[f32; 3]]) -> Vec<f32> {
    texels.iter().map(|texel| texel[0]).collect()
}

fn a_truncated_float_tiff_is_an_error() {
    let values: Vec<f32> = (0..45).map(|index| index as f32 * 0.125).collect();
    let whole = tiff::<colortype::RGB32Float>(SIZE, &values);
    for length in 4..whole.len() {
        match texels(single("tif", &whole[..length]).path()) {
            Ok(found) => assert_eq!(found.as_flattened(), values, "{length} of {} bytes", whole.len()),
            Err(error) => assert!(error.to_string().contains(".tif"), "{error}"),
        }
    }
}

fn other_kinds_are_named() {
    assert_says(texels(single("tif", &tiff::<colortype::GrayI16>([2, 1], &[1, -1])).path()), &[".tif"]);
    assert_says(texels(single("tif", &tiff::<colortype::Gray32>([2, 1], &[1, 2])).path()), &[".tif"]);
    assert_says(texels(single("tif", &tiff::<colortype::CMYK32Float>([1, 1], &[0.0; 4])).path()), &[".tif", "CMYK", "convert"]);
}
