//! Damaged and foreign containers: each is an error that says what and where, soon and without memory.

use std::time::{Duration, Instant};

use half::f16;
use overpaint::{
    data::Block,
    io::{self, BtfFileError, IoError, ReadOptions},
};

use super::{
    MASK, PLAIN,
    builder::{self, File, Scene, Storage},
    files,
};

crate::suite! { plain:
    every_truncation_is_an_error,
    each_wrong_field_is_named,
    huge_sizes_take_neither_memory_nor_time,
    directions_that_are_none_are_refused,
    channels_other_than_rgb_are_refused,
    views_with_lights_of_their_own_are_refused,
    a_file_that_shrinks_is_an_error_when_it_is_read;
}

fn error(bytes: impl Into<std::sync::Arc<[u8]>>) -> BtfFileError {
    match io::open_btf_bytes("small", bytes, &ReadOptions::default()) {
        Ok(source) => panic!("opens as {:?}", source.btf()),
        Err(IoError::BtfFile(error)) => error,
        Err(error) => panic!("{error}"),
    }
}

/// The error's text, which must name the file, the byte and each of `parts`.
#[track_caller]
fn assert_says(bytes: Vec<u8>, offset: usize, parts: &[&str]) {
    let text = error(bytes).to_string();
    for part in parts.iter().copied().chain(["small", &format!("at byte {offset}")]) {
        assert!(text.contains(part), "\"{text}\" does not contain \"{part}\"");
    }
}

fn every_truncation_is_an_error() {
    for (what, file) in files().into_iter().step_by(7) {
        for length in 0..file.bytes.len() {
            match error(&file.bytes[..length]) {
                BtfFileError::TooShort { expected, found, .. } => assert!(expected > found),
                BtfFileError::Signature { .. } => assert!(length < 10),
                // A signature without its R, or a size that is then read one byte later.
                error => assert!(length < 10, "{what}: {error}"),
            }
        }
    }
}

/// A field of a file, the bytes put there, and what the error says.
#[track_caller]
fn check(file: &File, field: &str, bytes: &[u8], parts: &[&str]) {
    assert_says(file.with(field, bytes), file.at(field, 0), parts);
}

fn each_wrong_field_is_named() {
    let scene = Scene::default();
    let extended = builder::fmf(&scene, true, Some((2, true)), PLAIN);
    let plain = builder::fmf(&scene, false, None, Storage { scalar: 2, transposed: true });
    let dfmf = builder::dfmf(&scene, true, 11, [PLAIN; 3]);
    let pvf = builder::pvf(&scene, true, false, PLAIN);
    let legacy = builder::pvf(&scene, true, true, Storage { scalar: 8, transposed: true });
    let bdi = builder::bdi(&scene, 3, &MASK, true, false);
    let all = [&extended, &plain, &dfmf, &pvf, &legacy, &bdi];
    let zero = 0_u32.to_le_bytes();
    let max = u32::MAX.to_le_bytes();

    for file in [&extended, &plain, &dfmf, &pvf, &bdi] {
        check(file, "meta size", &296_u32.to_le_bytes(), &["size of META 295 bytes", "found 296"]);
        check(file, "meta version", &5_u32.to_le_bytes(), &["version of META is 5", "1 to 4 can be read"]);
        check(file, "meta version", &zero, &["version of META is 0"]);
    }
    for file in all {
        check(file, "views", &zero, &["number of views of 1 or more", "found 0"]);
        check(file, "lights", &zero, &["number of lights of 1 or more", "found 0"]);
        check(file, "width", &zero, &["columns of the texel plane of 1 or more"]);
        check(file, "height", &zero, &["rows of the texel plane of 1 or more"]);
    }
    for file in [&extended, &plain, &dfmf, &pvf, &legacy] {
        check(file, "scalar", &[3], &["size of a scalar 2, 4 or 8 bytes", "found 3"]);
        check(file, "components", &zero, &["number of components of 1 or more", "found 0"]);
    }
    let size = |file: &File, field, value: u32, parts: &[&str]| {
        // The rest is long enough, so that the size is what is wrong.
        let bytes = [file.with(field, &value.to_le_bytes()), vec![0; 4000]].concat();
        assert_says(
            bytes,
            file.at(
                if field == "columns" {
                    "rows"
                } else if field == "dimension" {
                    "weights"
                } else {
                    field
                },
                0,
            ),
            parts,
        );
    };
    check(&extended, "header version", &[3], &["version of the FMF header is 3", "0 to 2"]);
    size(&extended, "rows", 19, &["3·6 x 20", "transposed 3·20 x 6", "found 19 x 20"]);
    size(&plain, "columns", 7, &["3·6 x 20", "found 60 x 7"]);
    check(&dfmf, "model", &2_i32.to_le_bytes(), &["colour model is 2", "0, 1, 3, 4 and 11"]);
    check(&dfmf, "model", &(-1_i32).to_le_bytes(), &["colour model is -1"]);
    size(&dfmf, "rows", 7, &["6 x 20, or transposed 20 x 6", "found 7 x 20"]);
    size(&pvf, "weights", 21, &["20 and 3·3, or transposed 3 and 3·20", "found 21 and 9"]);
    size(&legacy, "dimension", 61, &["found 3 and 61"]);
    check(&pvf, "slots", &3_u32.to_le_bytes(), &["number of factorised views 2", "found 3"]);
    check(&legacy, "slots", &zero, &["number of factorised views 2", "found 0"]);
    check(&bdi, "lines", &zero, &["rows of a chunk of 1 or more"]);
    check(&bdi, "compression", &[1], &["compression is 1 (bzip)", "0 (full) and 2 (sparse)"]);
    check(&bdi, "compression", &[7], &["compression is 7"]);
    check(&bdi, "chunk", &35_u32.to_le_bytes(), &["bytes of a chunk 36 for each of at most 5 x 3 texels", "found 35"]);
    check(&bdi, "chunk", &(16 * 36_u32).to_le_bytes(), &["found 576"]);
    // No more chunks than rows of texels need, all of them empty.
    let mut empty = bdi.bytes.clone();
    empty[bdi.at("chunk", 0)..].fill(0);
    assert_says(empty, bdi.at("chunk", 0) + 8, &["number of texels in all chunks 10, found 0"]);
    for field in ["xml", "channel"] {
        let at = dfmf.at(field, 0) + 4;
        let bytes = dfmf.with(field, &max);
        let found = error(bytes).to_string();
        assert!(found.contains(&format!("at byte {at}")) && found.contains("ends too early") || found.contains("not read"), "{found}");
    }
    assert!(matches!(error(*b"!BDIF06Z2!"), BtfFileError::Signature { .. }));
    assert!(matches!(error([0_u8; 0]), BtfFileError::Signature { .. }));
}

fn huge_sizes_take_neither_memory_nor_time() {
    let start = Instant::now();
    for (what, file) in files().into_iter().step_by(5) {
        for field in
            ["views", "lights", "width", "height", "rotations", "components", "rows", "columns", "weights", "dimension", "chunk", "lines"]
        {
            if !file.marks().contains(&field) {
                continue;
            }
            // The largest values of 31 and 32 bits, and one whose square is beyond 64 bits with any scalar.
            for value in [u32::MAX, i32::MAX as u32, 0xc000_0000] {
                let bytes = file.with(field, &value.to_le_bytes());
                match io::open_btf_bytes("small", bytes, &ReadOptions::default()) {
                    // So many rows a chunk make it one chunk, and matrices are rotated for nothing.
                    Ok(_) => assert!(field == "lines", "{what}: {field} {value} is taken"),
                    Err(IoError::BtfFile(error)) => assert!(error.to_string().contains("small"), "{error}"),
                    Err(error) => panic!("{error}"),
                }
            }
        }
    }
    // Two sizes whose product is beyond 64 bits.
    let bdi = builder::bdi(&Scene::default(), 3, &MASK, true, false);
    let size = bdi.with("width", &[0xff; 8]);
    assert_says(size, bdi.at("mask", 0), &["mask", "18446744065119617025"]);
    let fmf = builder::fmf(&Scene::default(), false, None, PLAIN);
    assert!(matches!(error(fmf.with("components", &[0xff; 12])), BtfFileError::TooShort { .. }));
    let dfmf = builder::dfmf(&Scene::default(), false, 0, [Storage { scalar: 8, transposed: false }; 3]);
    let long = [dfmf.with("rows", &[0xff; 8]), vec![0; 4096]].concat();
    assert!(matches!(error(long), BtfFileError::TooShort { expected, .. } if expected == 8 * 6 * u64::from(u32::MAX)));
    assert!(start.elapsed() < Duration::from_secs(20), "takes {:?}", start.elapsed());
}

fn directions_that_are_none_are_refused() {
    let file = builder::dfmf(&Scene::default(), true, 0, [PLAIN; 3]);
    let angles = |theta: f32, phi: f32| [theta.to_le_bytes(), phi.to_le_bytes()].concat();
    for (theta, phi) in [
        (f32::NAN, 0.0),
        (std::f32::consts::FRAC_PI_2, 0.0),
        (-0.1, 0.0),
        (3.0, 0.0),
        (f32::INFINITY, 0.0),
        (0.1, f32::NAN),
        (0.1, f32::INFINITY),
    ] {
        for (field, what) in [("view", "view 0"), ("light", "light 0")] {
            check(&file, field, &angles(theta, phi), &[what, "θ must be from 0 to below π/2"]);
        }
    }
    let mut below = file.bytes.clone();
    let at = file.at("light", 2);
    below[at..at + 4].copy_from_slice(&1.6_f32.to_le_bytes());
    assert_says(below, at, &["light 2 is θ 1.6"]);
}

fn channels_other_than_rgb_are_refused() {
    let with = |channels: Vec<&'static str>| {
        let file = builder::fmf(&Scene { channels, ..Scene::default() }, true, None, PLAIN);
        (file.at("channels", 0), file.bytes)
    };
    let (at, spectral) = with(vec!["400", "410", "420", "430"]);
    assert_says(spectral, at, &["the list of channels is 4 channels, \"400\", \"410\", \"420\", …", "R, G, B can be read"]);
    let (at, other) = with(vec!["X", "Y", "Z"]);
    assert_says(other, at, &["\"X\", \"Y\", \"Z\""]);
    let (at, turned) = with(vec!["B", "G", "R"]);
    assert_says(turned, at, &["\"B\", \"G\", \"R\""]);
    let (at, none) = with(vec![]);
    assert_says(none, at, &["0 channels"]);
    let (_, lower) = with(vec!["r", "g", "b"]);
    io::open_btf_bytes("small", lower, &ReadOptions::default()).expect("names in lower case are the same");
}

fn views_with_lights_of_their_own_are_refused() {
    let file = builder::bdi(&Scene::default(), 2, &MASK, true, false);
    let mut other = file.bytes.clone();
    let at = file.at("light", 4);
    other[at] ^= 1;
    assert_says(other, file.at("lights", 1), &["the lights of view 1 differ from those of view 0"]);
}

fn a_file_that_shrinks_is_an_error_when_it_is_read() {
    let folder = tempfile::tempdir().expect("is writable");
    for (name, file) in [
        ("dump.btf", builder::bdi(&Scene::default(), 2, &MASK, true, false)),
        ("factors.btf", builder::fmf(&Scene::default(), true, None, PLAIN)),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, &file.bytes).expect("is writable");
        let source = io::open(&path).expect("opens");
        let length = file.bytes.len() as u64 - 3;
        std::fs::OpenOptions::new().write(true).open(&path).expect("opens").set_len(length).expect("is writable");
        let mut radiance = vec![f16::ZERO; 3 * 20 * 6];
        let read = source.read(&[0, 1, 2, 3, 4, 5], Block::whole([5, 4]), &mut radiance, &|_| {});
        super::super::assert_says(read, &["cannot read", name, "at byte"]);
    }
}
