//! OpenEXR: channels by name, spectra and XYZ reduced to sRGB.

use std::io::Cursor;

use exr::{
    image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, write::WritableImage},
    math::Vec2,
    meta::{attribute::LineOrder, header::LayerAttributes},
    prelude::{Blocks, Compression},
};
use half::f16;
use overpaint::{
    data::{Block, Transfer},
    io,
    model::{color::linear_from_xyz, spectrum},
};

use super::{assert_says, read, single, texels};

crate::suite! { plain:
    rgb_and_gray_are_read,
    every_layout_is_read,
    xyz_becomes_srgb,
    spectra_become_srgb,
    wavelengths_are_read_however_they_are_written,
    what_is_no_radiance_comes_as_it_is,
    a_finite_value_stays_finite,
    unknown_channels_are_named,
    every_truncation_is_an_error,
    damage_is_never_a_panic,
    a_panic_of_the_decoder_is_an_error,
    an_absurd_size_is_refused_before_it_is_allocated;
}

const SIZE: [usize; 2] = [7, 5];

fn layout(compression: Compression, blocks: Blocks) -> Encoding {
    Encoding { compression, blocks, line_order: LineOrder::Increasing }
}

fn encoded_as(encoding: Encoding, [width, height]: [usize; 2], channels: Vec<(&str, FlatSamples)>) -> Vec<u8> {
    let list = channels.into_iter().map(|(name, samples)| AnyChannel::new(name, samples)).collect();
    let layer = Layer::new((width, height), LayerAttributes::named("image"), encoding, AnyChannels::sort(list));
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes).expect("encodes");
    bytes.into_inner()
}

fn exr(size: [usize; 2], channels: Vec<(&str, FlatSamples)>) -> Vec<u8> {
    encoded_as(layout(Compression::ZIP16, Blocks::ScanLines), size, channels)
}

fn value(texel: usize, channel: usize) -> f32 {
    (texel * 3 + channel) as f32 * 0.0625
}

fn singles(channel: usize) -> FlatSamples {
    FlatSamples::F32((0..SIZE[0] * SIZE[1]).map(|texel| value(texel, channel)).collect())
}

fn halves(channel: usize) -> FlatSamples {
    FlatSamples::F16((0..SIZE[0] * SIZE[1]).map(|texel| f16::from_f32(value(texel, channel))).collect())
}

fn colors() -> Vec<[f32; 3]> {
    (0..SIZE[0] * SIZE[1]).map(|texel| [0, 1, 2].map(|channel| value(texel, channel))).collect()
}

fn rgb_and_gray_are_read() {
    let integers = |channel: u32| FlatSamples::U32((0..35).map(|texel| texel + 100 * channel).collect());
    let folder =
        single("exr", &exr(SIZE, vec![("R", singles(0)), ("G", halves(1)), ("B", singles(2)), ("A", halves(7)), ("depth", halves(1))]));
    let source = io::open(folder.path()).expect("opens");
    assert_eq!((source.btf().size(), source.btf().encoding().transfer), (SIZE, Transfer::Linear));
    assert_eq!(texels(folder.path()).expect("decodes"), colors());
    let folder = single("exr", &exr(SIZE, vec![("R", integers(0)), ("G", integers(1)), ("B", integers(2))]));
    assert_eq!(texels(folder.path()).expect("decodes")[3], [3.0, 103.0, 203.0]);
    let folder = single("exr", &exr(SIZE, vec![("Y", halves(1)), ("A", halves(0))]));
    assert_eq!(texels(folder.path()).expect("decodes"), colors().iter().map(|color| [color[1]; 3]).collect::<Vec<_>>());
}

fn every_layout_is_read() {
    let compressions =
        [Compression::Uncompressed, Compression::RLE, Compression::ZIP1, Compression::ZIP16, Compression::PIZ, Compression::PXR24];
    for compression in compressions {
        for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(3, 2)), Blocks::Tiles(Vec2(64, 64))] {
            let channels = vec![("R", halves(0)), ("G", halves(1)), ("B", halves(2))];
            let bytes = encoded_as(layout(compression, blocks), SIZE, channels);
            let folder = single("exr", &bytes);
            assert_eq!(texels(folder.path()).expect("decodes"), colors(), "{compression:?} {blocks:?}");
            let block = Block { column: 2, row: 1, width: 3, height: 4 };
            let part = read(io::open(folder.path()).expect("opens").as_ref(), &[0], block).expect("decodes");
            assert_eq!(part[12 + 3 + 1].to_f32(), colors()[2 * 7 + 3][1], "row 1, column 1 of the block's green");
        }
    }
}

fn xyz_becomes_srgb() {
    // Gray; white; a colour; one outside sRGB.
    let colors = [[0.190_1, 0.2, 0.2178], [0.9505, 1.0, 1.089], [0.3, 0.2, 0.1], [0.1, 0.4, 0.1]];
    let channel = |channel: usize| FlatSamples::F32(colors.iter().map(|color| color[channel]).collect());
    let folder = single("exr", &exr([4, 1], vec![("X", channel(0)), ("Y", channel(1)), ("Z", channel(2))]));
    let found = texels(folder.path()).expect("decodes");
    for (found, xyz) in found.iter().zip(colors) {
        let expected = linear_from_xyz(xyz.map(f64::from));
        for (found, expected) in found.iter().zip(expected) {
            // A half's last place, and single precision before it.
            assert!((f64::from(*found) - expected.max(0.0)).abs() <= 6e-4 * expected.abs(), "{found} for {expected}");
        }
    }
    assert!(found[3][0] == 0.0 && linear_from_xyz(colors[3].map(f64::from))[0] < 0.0, "a colour outside is brought in");
}

/// Every 10 nm from 400 to 700, and an RGB preview that does not count.
fn spectral(size: [usize; 2], reflectance: impl Fn(f64, usize) -> f64) -> Vec<u8> {
    let names: Vec<String> = (40..=70).map(|tens| format!("{tens}0nm")).collect();
    let texels = size[0] * size[1];
    let samples =
        |index: usize| FlatSamples::F16((0..texels).map(|texel| f16::from_f64(reflectance(400.0 + 10.0 * index as f64, texel))).collect());
    let preview = ["R", "G", "B"].map(|name| (name, FlatSamples::F16(vec![f16::from_f32(0.125); texels])));
    exr(size, names.iter().enumerate().map(|(index, name)| (name.as_str(), samples(index))).chain(preview).collect())
}

fn spectra_become_srgb() {
    let grays = [0.0, 0.125, 0.25, 0.5, 0.75, 1.0, 2.0, 40.0];
    let folder = single("exr", &spectral([8, 1], |_, texel| grays[texel]));
    assert_eq!(texels(folder.path()).expect("decodes"), grays.map(|gray| [gray as f32; 3]), "a constant reflectance is gray, exactly");

    let reflectance = |nm: f64, texel: usize| match texel {
        0 => ((nm - 400.0) / 300.0).powi(2),
        1 => 1.0 - ((nm - 550.0) / 150.0).powi(2),
        // A line of green, outside sRGB.
        _ => f64::from(nm == 520.0),
    };
    let found = texels(single("exr", &spectral([3, 1], reflectance)).path()).expect("decodes");
    let wavelengths: Vec<f64> = (40..=70).map(|tens| 10.0 * f64::from(tens)).collect();
    let weights = spectrum::rgb_weights(&wavelengths);
    for (texel, found) in found.iter().enumerate() {
        for (channel, &found) in found.iter().enumerate() {
            let stored = |nm: f64| f16::from_f64(reflectance(nm, texel)).to_f64();
            let expected: f64 = weights.iter().zip(&wavelengths).map(|(weight, &nm)| weight[channel] * stored(nm)).sum();
            assert!(
                (f64::from(found) - expected.max(0.0)).abs() <= 6e-4 * expected.abs() + 1e-6,
                "{texel} {channel}: {found} for {expected}"
            );
        }
    }
    assert!(found[0][0] > found[0][1] && found[0][1] > found[0][2], "red: {:?}", found[0]);
    assert!(found[2][0] == 0.0 && found[2][1] > 0.0, "green: {:?}", found[2]);
}

fn wavelengths_are_read_however_they_are_written() {
    for names in [
        ["450nm", "550nm", "650nm"],
        ["450", "550", "650"],
        ["450.0", "550.00", "650.5"],
        ["w450nm", "W550nm", "w650.25nm"],
        ["S0.450nm", "S0.550,5nm", "S0.650,25nm"],
        ["T.450nm", "T.550nm", "T.650nm"],
        ["450 nm", "0550 nm", "650NM"],
    ] {
        let folder = single("exr", &exr(SIZE, names.map(|name| (name, FlatSamples::F32(vec![0.25; 35]))).into()));
        assert_eq!(texels(folder.path()).expect("decodes"), [[0.25; 3]; 35], "{names:?}");
    }
}

fn what_is_no_radiance_comes_as_it_is() {
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -0.25, 0.25];
    let good = || FlatSamples::F32(vec![0.25; 5]);
    let stored = || FlatSamples::F32(bad.to_vec());
    let check = |channels: Vec<(&str, FlatSamples)>, touched: &[usize]| {
        let names: Vec<String> = channels.iter().map(|(name, _)| (*name).to_owned()).collect();
        let found = texels(single("exr", &exr([5, 1], channels)).path()).expect("decodes");
        for &channel in touched {
            let [nan, infinite, below, negative, plain] = [0, 1, 2, 3, 4].map(|texel: usize| found[texel][channel]);
            assert!(nan.is_nan() && infinite == f32::INFINITY && below == f32::NEG_INFINITY, "{names:?}");
            assert!(negative == -0.25 && plain >= 0.0 && plain.is_finite(), "{names:?}");
        }
    };
    check(vec![("R", good()), ("G", stored()), ("B", good())], &[1]);
    check(vec![("Y", stored())], &[0, 1, 2]);
    check(vec![("X", good()), ("Y", stored()), ("Z", good())], &[0, 1, 2]);
    check(vec![("450nm", good()), ("550nm", good()), ("650nm", stored())], &[0, 1, 2]);
}

fn a_finite_value_stays_finite() {
    let large = || FlatSamples::F32(vec![1e30, 70_000.0, 3.0e38]);
    for channels in [vec![("R", large()), ("G", large()), ("B", large())], vec![("450nm", large()), ("550nm", large())]] {
        let found = texels(single("exr", &exr([3, 1], channels)).path()).expect("decodes");
        assert!(found.iter().flatten().all(|&value| value == 65_504.0), "{found:?}");
    }
}

fn unknown_channels_are_named() {
    let some = || FlatSamples::F16(vec![f16::ONE; 4]);
    for names in [&["R", "G"][..], &["X", "Y"], &["U", "V", "N"], &["BY", "RY", "Y"], &["450nm", "450.0"], &["45000"], &["S1.450nm"]] {
        let bytes = exr([2, 2], names.iter().map(|&name| (name, some())).collect());
        let mut sorted = names.to_vec();
        sorted.sort_unstable();
        assert_says(io::open(single("exr", &bytes).path()), &[".exr has the channels", &sorted.join(", "), "X Y Z", "450nm"]);
    }
}

fn every_truncation_is_an_error() {
    for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(3, 2))] {
        let whole = encoded_as(layout(Compression::ZIP1, blocks), SIZE, vec![("R", halves(0)), ("G", halves(1)), ("B", halves(2))]);
        for length in 4..whole.len() {
            assert_says(texels(single("exr", &whole[..length]).path()), &[".exr"]);
        }
    }
}

/// What damage leaves readable is of the right size; everything else is an error that names the file.
fn damage_is_never_a_panic() {
    let whole = encoded_as(layout(Compression::ZIP16, Blocks::ScanLines), SIZE, vec![("450nm", halves(0)), ("550nm", halves(1))]);
    let folder = single("exr", &whole);
    let name = super::bonn_name(0, "exr");
    for at in 4..whole.len() {
        for flip in [0x01, 0x80, 0xff] {
            let mut bytes = whole.clone();
            bytes[at] ^= flip;
            super::write_tree(folder.path(), &[(name.clone(), bytes)]);
            if let Err(error) = texels(folder.path()) {
                assert!(error.to_string().contains(".exr"), "{error}");
            }
        }
    }
}

/// Where overflow is checked, the library panics here; else it makes something of it.
fn a_panic_of_the_decoder_is_an_error() {
    let mut bytes =
        encoded_as(layout(Compression::B44, Blocks::ScanLines), SIZE, vec![("R", halves(0)), ("G", halves(1)), ("B", halves(2))]);
    let end = bytes.len();
    bytes[end - 80..].fill(0);
    let found = texels(single("exr", &bytes).path());
    assert!(found.is_err() || !cfg!(debug_assertions), "{found:?}");
    if found.is_err() {
        assert_says(found, &[".exr is damaged", "its decoder gave up"]);
    }
}

fn an_absurd_size_is_refused_before_it_is_allocated() {
    let mut bytes = exr(SIZE, vec![("R", halves(0)), ("G", halves(1)), ("B", halves(2))]);
    // The data window: name, type, length, then four integers, of which the last two are the largest column and row.
    let start = bytes.windows(11).position(|part| part == b"dataWindow\0").expect("is there") + 11 + 6 + 4;
    for limit in [60_000_i32, 2_000_000_000] {
        bytes[start + 8..start + 16].copy_from_slice([limit.to_le_bytes(); 2].as_flattened());
        assert_says(io::open(single("exr", &bytes).path()), &[".exr"]);
    }
}
