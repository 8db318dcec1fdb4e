//! Radiance HDR: every orientation and encoding, made here byte by byte, and by the `image` library.

use std::io::Cursor;

use image::{ImageFormat, Rgb, Rgb32FImage};
use overpaint::{data::Transfer, io};

use super::{assert_says, single, texels};

crate::suite! { plain:
    every_orientation_and_encoding_is_read,
    long_runs_have_several_digits,
    another_encoder_is_read,
    exposure_is_undone,
    every_truncation_is_an_error,
    wrong_headers_are_refused,
    wrong_runs_are_refused;
}

const SIZE: [usize; 2] = [11, 9];

/// Mantissas and exponent of a texel, with runs along rows and columns.
fn pixel(column: usize, row: usize) -> [u8; 4] {
    let (x, y) = (column as u8 / 4, row as u8 / 3);
    [200 - 30 * x, 100 + 20 * y, if column == 3 { 7 } else { 90 }, 128 + x - y]
}

fn value([r, g, b, exponent]: [u8; 4]) -> [f32; 3] {
    [r, g, b].map(|mantissa| (f64::from(mantissa) * (f64::from(exponent) - 136.0).exp2()) as f32)
}

fn expected() -> Vec<[f32; 3]> {
    (0..SIZE[0] * SIZE[1]).map(|texel| value(pixel(texel % SIZE[0], texel / SIZE[0]))).collect()
}

/// As the older programs: a repeated texel is a count, its lowest digit first.
fn old_runs(line: &[[u8; 4]]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut at = 0;
    while at < line.len() {
        let same = line[at..].iter().take_while(|texel| **texel == line[at]).count();
        bytes.extend(line[at]);
        let mut more = same - 1;
        while more > 0 {
            bytes.extend([1, 1, 1, more as u8]);
            more >>= 8;
        }
        at += same;
    }
    bytes
}

/// As the newer ones: each component has its runs and its stretches of values.
fn component_runs(line: &[[u8; 4]]) -> Vec<u8> {
    let mut bytes = vec![2, 2, (line.len() >> 8) as u8, line.len() as u8];
    for component in 0..4 {
        let values: Vec<u8> = line.iter().map(|texel| texel[component]).collect();
        for group in values.chunk_by(|a, b| a == b) {
            if group.len() > 2 {
                bytes.extend([128 + group.len() as u8, group[0]]);
            } else {
                bytes.push(group.len() as u8);
                bytes.extend(group);
            }
        }
    }
    bytes
}

fn flat(line: &[[u8; 4]]) -> Vec<u8> {
    line.concat()
}

const SLOW_AND_FAST: [(&str, &str); 8] =
    [("-Y", "+X"), ("-Y", "-X"), ("+Y", "+X"), ("+Y", "-X"), ("+X", "-Y"), ("+X", "+Y"), ("-X", "-Y"), ("-X", "+Y")];

fn file((slow, fast): (&str, &str), encode: fn(&[[u8; 4]]) -> Vec<u8>) -> Vec<u8> {
    let [width, height] = SIZE;
    let length = |axis: &str| if axis.ends_with('X') { width } else { height };
    // The place along an axis of a step: x to the right, y up.
    let place = |axis: &str, step: usize| match axis {
        "+X" | "-Y" => step,
        _ => length(axis) - 1 - step,
    };
    let header = format!("#?RADIANCE\n# made here\nFORMAT=32-bit_rle_rgbe\n\n{slow} {} {fast} {}\n", length(slow), length(fast));
    let mut bytes = header.into_bytes();
    for step in 0..length(slow) {
        let line: Vec<[u8; 4]> = (0..length(fast))
            .map(|along| match slow.ends_with('Y') {
                true => pixel(place(fast, along), place(slow, step)),
                false => pixel(place(slow, step), place(fast, along)),
            })
            .collect();
        bytes.extend(encode(&line));
    }
    bytes
}

fn every_orientation_and_encoding_is_read() {
    for orientation in SLOW_AND_FAST {
        for encode in [flat as fn(&[[u8; 4]]) -> Vec<u8>, old_runs, component_runs] {
            let folder = single("hdr", &file(orientation, encode));
            let source = io::open(folder.path()).expect("opens");
            assert_eq!((source.btf().size(), source.btf().encoding().transfer), (SIZE, Transfer::Linear));
            assert_eq!(texels(folder.path()).expect("decodes"), expected(), "{orientation:?}");
        }
    }
}

fn long_runs_have_several_digits() {
    let line: Vec<[u8; 4]> = (0..70_000).map(|x| [if x < 69_999 { 100 } else { 200 }, 50, 25, 128]).collect();
    let bytes = [b"#?RADIANCE\n\n+Y 1 +X 70000\n", old_runs(&line).as_slice()].concat();
    assert_eq!(old_runs(&line).len(), 4 * 5);
    let expected: Vec<[f32; 3]> = line.into_iter().map(value).collect();
    assert!(texels(single("hdr", &bytes).path()).expect("decodes") == expected);
}

fn another_encoder_is_read() {
    for size in [[5, 3], [200, 3], [9, 130]] {
        let image = Rgb32FImage::from_fn(size[0], size[1], |x, y| Rgb([0.5 + (x / 3) as f32, 0.25 * (y + 1) as f32, 1e-3 * x as f32]));
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, ImageFormat::Hdr).expect("encodes");
        let decoded = image::load_from_memory(bytes.get_ref()).expect("decodes").into_rgb32f();
        let expected: Vec<[f32; 3]> = decoded.pixels().map(|pixel| pixel.0.map(|value| half::f16::from_f32(value).to_f32())).collect();
        assert_eq!(texels(single("hdr", bytes.get_ref()).path()).expect("decodes"), expected);
    }
}

fn exposure_is_undone() {
    let text = "#?RGBE\nEXPOSURE=4\nEXPOSURE= 0.5 \nCOLORCORR=1 2 4\nFORMAT=32-bit_rle_rgbe\nVIEW= -vp 0 0 0\n\n-Y 1 +X 1\n";
    let bytes = [text.as_bytes(), &[128, 128, 128, 129]].concat();
    assert_eq!(texels(single("hdr", &bytes).path()).expect("decodes"), [[0.5, 0.25, 0.125]]);
}

fn every_truncation_is_an_error() {
    for encode in [flat as fn(&[[u8; 4]]) -> Vec<u8>, old_runs, component_runs] {
        let whole = file(("+X", "-Y"), encode);
        for length in 2..whole.len() {
            assert_says(texels(single("hdr", &whole[..length]).path()), &["is truncated", ".hdr"]);
        }
    }
}

fn wrong_headers_are_refused() {
    let refuse = |lines: &str, says: &[&str]| {
        let bytes = [b"#?RADIANCE\n", lines.as_bytes(), &[0; 64]].concat();
        assert_says(texels(single("hdr", &bytes).path()), &[&[".hdr"], says].concat());
    };
    for resolution in ["-Y 3 -Y 3", "-Y 3 +X", "Y 3 X 3", "-Y 3 +X 3 +Z 1", "-Y -3 +X 3", "-Y 0 +X 3", "-Y 99999999999 +X 3", ""] {
        refuse(&format!("\n{resolution}\n"), &["its resolution line is", resolution, "-Y 256 +X 256"]);
    }
    refuse("FORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", &["Radiance HDR of format 32-bit_rle_xyze"]);
    refuse("EXPOSURE=0\n\n-Y 1 +X 1\n", &["EXPOSURE=0", "positive numbers"]);
    refuse("COLORCORR=1 1\n\n-Y 1 +X 1\n", &["COLORCORR=1 1", "positive numbers"]);
    refuse("\n-Y 4294967295 +X 4294967295\n", &["4294967295 x 4294967295 texels", "more than the"]);
    // A size that is read, but that so few bytes cannot hold.
    refuse("\n-Y 8000 +X 8000\n", &["is truncated"]);
}

fn wrong_runs_are_refused() {
    let refuse = |line: &[u8], says: &str| {
        let bytes = [b"#?RADIANCE\n\n-Y 1 +X 8\n", line].concat();
        assert_says(texels(single("hdr", &bytes).path()), &[".hdr is damaged", "scan line 0", says]);
    };
    let filler = [5; 64];
    refuse(&[&[2, 2, 0, 9], &filler[..]].concat(), "another length");
    refuse(&[&[2, 2, 0, 8, 137, 5], &filler[..]].concat(), "does not fit");
    refuse(&[&[2, 2, 0, 8, 0], &filler[..]].concat(), "does not fit");
    refuse(&[&[1, 1, 1, 3], &filler[..]].concat(), "does not fit");
    refuse(&[&[9, 9, 9, 9, 1, 1, 1, 8], &filler[..]].concat(), "does not fit");
    // Runs of nothing, one digit after the other.
    refuse(&[&[9, 9, 9, 9], [1, 1, 1, 0].repeat(40).as_slice(), &filler[..]].concat(), "does not fit");
}
