use std::{fs, path::Path};

use half::f16;
use overpaint::{
    data::{Block, Btf, Direction, Encoding, Pair, Transfer},
    io::{self, Lost, TreeFormat, TreeWriter},
};

use super::{assert_says, read};
use crate::support::hold;

crate::suite! {
    plain: a_tree_reads_as_it_was_written, what_eight_bits_cannot_hold_is_counted, names_hold_directions_to_a_millionth,
        a_tree_is_written_again_but_over_nothing_else;
}

const SIZE: [usize; 2] = [13, 9];
const TEXELS: usize = 13 * 9;

fn btf(size: [usize; 2]) -> Btf {
    let views = vec![Direction::from_degrees(0.0, 0.0), Direction::from_degrees(23.5, 360.0 / 14.0)];
    let lights = [(0.0, 0.0), (52.5, 7.5), (75.0, 345.0)].map(|(theta, phi)| Direction::from_degrees(theta, phi)).to_vec();
    let pairs = (0..2).flat_map(|view| (0..3).map(move |light| Pair { view, light })).collect();
    Btf::new("small".to_owned(), size, views, lights, pairs, Encoding::photograph(Transfer::Linear)).expect("is one")
}

/// Smooth colours from 0 to 1, another in every sample and channel.
fn radiance() -> Vec<f16> {
    let value = |index: usize| {
        let (texel, plane) = (index % TEXELS, index / TEXELS);
        let (column, row) = (texel % SIZE[0], texel / SIZE[0]);
        f16::from_f64(0.5 + 0.4 * (0.2 * column as f64 + 0.31 * row as f64 + plane as f64).sin())
    };
    (0..6 * 3 * TEXELS).map(value).collect()
}

fn write(folder: &Path, format: TreeFormat, radiance: &[f16]) -> Lost {
    let writer = TreeWriter::begin(folder, &btf(SIZE), format).expect("begins");
    // In two parts, as a source is read view by view.
    let (first, second) = radiance.split_at(3 * 3 * TEXELS);
    writer.write(&[0, 1, 2], first, &|_| {}).expect("writes") + writer.write(&[3, 4, 5], second, &|_| {}).expect("writes")
}

fn a_tree_reads_as_it_was_written() {
    let expected = radiance();
    // Halves come back as they are; sRGB codes are 1/255 apart, and half of it is linear at most 1/2 (1/255) 2.28; a JPEG of quality
    // 95 has steps of one to twelve codes in frequencies, of which a few add up.
    for (format, bound) in [(TreeFormat::Exr, 0.0), (TreeFormat::Png, 4.8e-3), (TreeFormat::Jpeg(95), 6e-2)] {
        let folder = tempfile::tempdir().expect("is made");
        assert_eq!(write(folder.path(), format, &expected), Lost::default());
        let source = io::open(folder.path()).expect("opens");
        let btf = btf(SIZE);
        assert_eq!((source.btf().size(), source.btf().pairs()), (SIZE, btf.pairs()));
        let found = read(source.as_ref(), &[0, 1, 2, 3, 4, 5], Block::whole(SIZE)).expect("reads");
        let worst = found.iter().zip(&expected).map(|(a, b)| (a.to_f64() - b.to_f64()).abs()).fold(0.0, f64::max);
        hold(&format!("tree written and read: {format:?}"), worst, bound);
    }
}

fn what_eight_bits_cannot_hold_is_counted() {
    let mut values = radiance();
    for (index, value) in [(0, 1.5), (7, 60000.0), (300, 1.001), (5, -0.25), (400, f64::NAN), (500, f64::INFINITY), (600, 1.0), (601, -0.0)] {
        values[index] = f16::from_f64(value);
    }
    for format in [TreeFormat::Png, TreeFormat::Jpeg(100)] {
        let folder = tempfile::tempdir().expect("is made");
        assert_eq!(write(folder.path(), format, &values), Lost { clipped: 3, invalid: 3 });
    }
    let folder = tempfile::tempdir().expect("is made");
    write(folder.path(), TreeFormat::Png, &values);
    let found = read(io::open(folder.path()).expect("opens").as_ref(), &[0], Block::whole(SIZE)).expect("reads");
    assert_eq!([0, 7, 300, 5].map(|index| found[index].to_f64()), [1.0, 1.0, 1.0, 0.0]);
    // All of it is kept in linear halves.
    let folder = tempfile::tempdir().expect("is made");
    assert_eq!(write(folder.path(), TreeFormat::Exr, &values), Lost::default());
    let found = read(io::open(folder.path()).expect("opens").as_ref(), &[0, 1, 2, 3, 4, 5], Block::whole(SIZE)).expect("reads");
    assert!(found.iter().zip(&values).all(|(a, b)| a.to_bits() == b.to_bits() || a == b || (a.is_nan() && b.is_nan())));
}

fn names_hold_directions_to_a_millionth() {
    let folder = tempfile::tempdir().expect("is made");
    write(folder.path(), TreeFormat::Png, &radiance());
    for name in [
        "tv000_pv000/00000 tl000 pl000 tv000 pv000.png",
        "tv000_pv000/00001 tl052.5 pl007.5 tv000 pv000.png",
        "tv023.5_pv025.714286/00005 tl075 pl345 tv023.5 pv025.714286.png",
    ] {
        assert!(folder.path().join(name).is_file(), "{name}");
    }
}

fn a_tree_is_written_again_but_over_nothing_else() {
    let folder = tempfile::tempdir().expect("is made");
    write(folder.path(), TreeFormat::Png, &radiance());
    write(folder.path(), TreeFormat::Png, &radiance());
    let is_left = |entry: &fs::DirEntry| entry.file_name().to_string_lossy().starts_with('.');
    for view in fs::read_dir(folder.path()).expect("is there") {
        let view = view.expect("is readable");
        assert!(!is_left(&view) && !fs::read_dir(view.path()).expect("is a folder").any(|file| is_left(&file.expect("is readable"))));
    }
    let begin = |folder: &Path, format| TreeWriter::begin(folder, &btf(SIZE), format);
    assert_says(begin(folder.path(), TreeFormat::Exr), &["left as it is", ".png", "no image of this tree"]);
    fs::write(folder.path().join("notes.txt"), "").expect("is writable");
    assert_says(begin(folder.path(), TreeFormat::Png), &["notes.txt"]);
    let file = folder.path().join("notes.txt");
    assert_says(begin(&file, TreeFormat::Png), &["notes.txt"]);
}
