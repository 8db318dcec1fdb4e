//! What is read of each kind, against plain sums in f64.

use std::{path::Path, sync::Arc};

use half::f16;
use overpaint::{
    data::{Block, Direction, RowOrder, Transfer},
    io::{self, Kind, ReadOptions},
};

use super::{
    MASK, PLAIN,
    builder::{self, File, Scene, Storage},
    files, open, read, whole,
};
use crate::support::{Worst, hold, npy, random::Random};

crate::suite! {
    plain: every_kind_reads_as_plain_sums,
        any_block_and_samples_read_the_same_bits,
        directions_and_conventions_are_those_of_the_header,
        a_cosine_that_is_not_within_is_multiplied_in,
        what_the_user_knows_holds,
        what_no_half_holds_is_held_and_faults_come_as_they_are,
        texels_that_were_not_measured_are_no_numbers,
        a_container_is_known_by_its_first_bytes,
        chunks_are_rows_of_a_bounded_size,
        the_fingerprint_tells_files_apart,
        values_beyond_four_gigabytes_are_found;
    data: shared_samples_equal_their_oracles;
}

/// Half a unit in a half's last place is 2^-11 of the value, 4.89e-4; what sums in f32 of 7 terms below 1 add to that is below 1e-6,
/// and is counted as part of 2e-3.
const BOUND: f64 = 5e-4;

fn error(found: f16, expected: f64) -> f64 {
    (found.to_f64() - expected).abs() / (expected.abs() + 2e-3)
}

fn every_kind_reads_as_plain_sums() {
    let (mut below, mut masked) = (0, 0);
    for (what, file) in files() {
        let mut bytes = file.bytes.clone();
        bytes.extend([0xff; 13]);
        let is_dump = what.starts_with("BDI");
        let encoded = ReadOptions { includes_cosine: Some(true), ..ReadOptions::default() };
        let found = whole(open(&bytes, &encoded).as_ref());
        assert_eq!(found.len(), file.stored.len());
        let errors = found.iter().zip(&file.stored).map(|(&found, &stored)| {
            if stored.is_nan() {
                masked += 1;
                return if found.is_nan() { 0.0 } else { f64::NAN };
            }
            below += usize::from(!is_dump && stored < 0.0);
            if is_dump { (found.to_f64() - stored).abs() } else { error(found, stored.max(0.0)) }
        });
        let kind = what.split([',', ' ']).next().expect("has a name");
        hold(&format!("{kind} container, relative"), errors.worst(), if is_dump { 0.0 } else { BOUND });
    }
    assert!(below > 100 && masked > 100, "{below} values below 0, {masked} masked");
}

fn any_block_and_samples_read_the_same_bits() {
    let mut random = Random::new(5);
    for (what, file) in files() {
        let source = open(&file.bytes, &ReadOptions::default());
        let all = whole(source.as_ref());
        for _ in 0..3 {
            let (column, row) = (random.below(5), random.below(4));
            let block = Block { column, row, width: 1 + random.below(5 - column), height: 1 + random.below(4 - row) };
            let samples: Vec<usize> = (0..6).filter(|_| random.below(2) == 0).collect();
            let found = read(source.as_ref(), &samples, block);
            let expected = samples.iter().flat_map(|&sample| {
                let (all, of_sample) = (&all, 3 * sample);
                (0..3).flat_map(move |channel| {
                    block.rows().flat_map(move |row| block.columns().map(move |column| all[(of_sample + channel) * 20 + row * 5 + column]))
                })
            });
            let bits = |values: Vec<f16>| values.into_iter().map(f16::to_bits).collect::<Vec<_>>();
            assert_eq!(bits(found), bits(expected.collect()), "{what}: {block}, samples {samples:?}");
        }
    }
}

/// Strips and runs longer than those of the small files: many samples and texels.
fn larger(scene: &Scene) -> Vec<File> {
    let texels = scene.texels();
    let mask: Vec<u8> = (0..texels).map(|texel| u8::from(texel % 7 != 3)).collect();
    vec![
        builder::fmf(scene, true, None, PLAIN),
        builder::dfmf(scene, true, 0, [PLAIN, Storage { scalar: 4, transposed: true }, PLAIN]),
        builder::pvf(scene, true, false, Storage { scalar: 2, transposed: true }),
        builder::bdi(scene, 7, &mask, true, false),
    ]
}

fn directions_and_conventions_are_those_of_the_header() {
    // At the zenith φ means nothing.
    let scene = Scene { views: vec![[0.0, 2.0], [0.5, 1.0]], ..Scene::default() };
    let source = open(&builder::dfmf(&scene, true, 0, [PLAIN; 3]).bytes, &ReadOptions::default());
    let btf = source.btf();
    assert_eq!((btf.name(), btf.size(), btf.views().len(), btf.lights().len()), ("small", [5, 4], 2, 3));
    assert!(btf.is_product());
    assert_eq!(btf.views()[0], Direction { theta: 0.0, phi: 0.0 });
    let (view, light) = btf.directions(5);
    assert_eq!((view.theta, view.phi), (0.5, 1.0));
    assert!((light.phi - (std::f64::consts::TAU - 2.0)).abs() < 1e-9 && (light.theta - 1.2).abs() < 1e-7, "{light:?}");
    let encoding = btf.encoding();
    assert_eq!((encoding.transfer, encoding.rows, encoding.scale), (Transfer::Linear, RowOrder::TopDown, 1.0));
    assert_eq!((encoding.includes_cosine, encoding.texels_per_mm), (true, Some(7.5)));
    // What does not say that the cosine is within has it not.
    for version in 1..=3 {
        let source = open(&builder::pvf(&Scene { version, ..scene.clone() }, false, false, PLAIN).bytes, &ReadOptions::default());
        assert_eq!(source.btf().encoding().includes_cosine, version > 1);
    }
    let legacy = open(&builder::pvf(&scene, false, true, PLAIN).bytes, &ReadOptions::default());
    assert_eq!((legacy.btf().encoding().includes_cosine, legacy.btf().encoding().texels_per_mm), (false, None));
}

fn a_cosine_that_is_not_within_is_multiplied_in() {
    let scene = Scene { cosine: 0, ..Scene::default() };
    for file in [builder::fmf(&scene, true, None, PLAIN), builder::bdi(&scene, 2, &[1; 20], false, false)] {
        let found = whole(open(&file.bytes, &ReadOptions::default()).as_ref());
        for (index, (&found, stored)) in found.iter().zip(&file.stored).enumerate() {
            let expected = stored * f64::from(scene.lights[index / 60 % 3][0]).cos();
            let expected = if file.bytes.starts_with(b"!BDI") { expected } else { expected.max(0.0) };
            hold("container without cosine, relative", error(found, expected), BOUND);
        }
    }
}

fn what_the_user_knows_holds() {
    let half = ReadOptions { scale: Some(0.5), ..ReadOptions::default() };
    let options = ReadOptions { transfer: Some(Transfer::Gamma(2.0)), includes_cosine: Some(true), rows: Some(RowOrder::BottomUp), ..half };
    for file in [builder::pvf(&Scene::default(), true, false, PLAIN), builder::bdi(&Scene::default(), 3, &MASK, true, false)] {
        let is_dump = file.bytes.starts_with(b"!BDI");
        let found = whole(open(&file.bytes, &options).as_ref());
        let errors = found.iter().enumerate().map(|(index, &found)| {
            let (plane, texel) = (index / 20, index % 20);
            let stored = file.stored[plane * 20 + (3 - texel / 5) * 5 + texel % 5];
            let expected = 0.5 * stored * stored.abs();
            if stored.is_nan() {
                return if found.is_nan() { 0.0 } else { f64::NAN };
            }
            error(found, if is_dump { expected } else { expected.max(0.0) })
        });
        hold("container read as the user says, relative", errors.worst(), BOUND);
    }
}

fn what_no_half_holds_is_held_and_faults_come_as_they_are() {
    let scene = Scene { size: [1, 1], ..Scene::default() };
    let mut file = builder::bdi(&scene, 1, &[1], false, false);
    let start = file.at("chunk", 0) + 4;
    let stored = [f16::MAX, f16::MIN, f16::INFINITY, f16::NEG_INFINITY, f16::NAN, f16::NEG_ZERO, f16::from_f32(-0.25), f16::ONE];
    for (index, value) in stored.iter().enumerate() {
        file.bytes[start + 2 * index..start + 2 * index + 2].copy_from_slice(&value.to_le_bytes());
    }
    let options = ReadOptions { scale: Some(2.0), ..ReadOptions::default() };
    let found = whole(open(&file.bytes, &options).as_ref());
    let expected = [f16::MAX, f16::MIN, f16::INFINITY, f16::NEG_INFINITY, f16::NAN, f16::ZERO, f16::from_f32(-0.5), f16::from_f32(2.0)];
    for (found, expected) in found.iter().zip(expected) {
        assert!(found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan(), "{found} is not {expected}");
    }
    // A negative value stays one, however small.
    let found = whole(open(&file.bytes, &ReadOptions { scale: Some(1e-9), ..ReadOptions::default() }).as_ref());
    assert_eq!((found[5], found[6], found[7]), (f16::ZERO, -f16::MIN_POSITIVE_SUBNORMAL, f16::ZERO));
    assert!(found[5].is_sign_positive());
    // Scalars that no f32 holds, and a reconstruction beyond a half.
    let mut file = builder::fmf(&scene, false, Some((1, true)), Storage { scalar: 8, transposed: false });
    let start = file.at("columns", 0) + 4 + 6 * 8;
    for (row, first) in [1e300, 30.0, f64::NAN, -1e300].into_iter().enumerate() {
        file.bytes[start + 48 * row..start + 48 * row + 8].copy_from_slice(&f64::to_le_bytes(first));
    }
    let texel = start + 18 * 48;
    file.bytes[texel..texel + 8].copy_from_slice(&1.0_f64.to_le_bytes());
    let found = whole(open(&file.bytes, &ReadOptions::default()).as_ref());
    assert_eq!((found[0], found[1], found[2].is_nan(), found[3]), (f16::INFINITY, f16::MAX, true, f16::ZERO));
}

fn texels_that_were_not_measured_are_no_numbers() {
    for sparse in [false, true] {
        let file = builder::bdi(&Scene::default(), 2, &MASK, sparse, false);
        let source = open(&file.bytes, &ReadOptions::default());
        let missing = whole(source.as_ref()).iter().enumerate().all(|(index, value)| value.is_nan() == (MASK[index % 20] == 0));
        assert!(missing, "sparse {sparse}");
        // One texel at a time, so that nothing of a neighbour can be left over.
        for (texel, &measured) in MASK.iter().enumerate() {
            let found = read(source.as_ref(), &[4], Block { column: texel % 5, row: texel / 5, width: 1, height: 1 });
            assert!(found.iter().all(|value| value.is_nan() == (measured == 0)), "texel {texel}, sparse {sparse}");
        }
    }
    let none = builder::bdi(&Scene::default(), 2, &[0; 20], true, false);
    assert!(whole(open(&none.bytes, &ReadOptions::default()).as_ref()).iter().all(|value| value.is_nan()));
}

fn a_container_is_known_by_its_first_bytes() {
    let folder = tempfile::tempdir().expect("is writable");
    let file = builder::fmf(&Scene::default(), true, None, PLAIN);
    for name in ["cloth.btf", "leather.dat"] {
        let path = folder.path().join(name);
        std::fs::write(&path, &file.bytes).expect("is writable");
        assert_eq!(io::kind(&path), Kind::Source);
        let source = io::open(&path).expect("opens");
        assert_eq!(source.btf().name(), name.split('.').next().expect("has a name"));
        assert_eq!(whole(source.as_ref()), whole(open(&file.bytes, &ReadOptions::default()).as_ref()));
    }
    let path = folder.path().join("other.btf");
    std::fs::write(&path, b"!FMF99XX and so on").expect("is writable");
    assert_eq!(io::kind(&path), Kind::Neither);
    super::super::assert_says(io::open(&path), &["other.btf", "!DFMF08FCR, !DFMF08FC, ", "!BDIF06R2!", "\"!FMF99XX\""]);
}

fn chunks_are_rows_of_a_bounded_size() {
    for (what, file) in files() {
        assert_eq!(open(&file.bytes, &ReadOptions::default()).chunk(), Some([5, 1]), "{what}");
    }
    // 40 x 40 directions of 6 bytes are 9600 bytes a texel: 109 of them are not more than a MiB.
    let directions = |count: usize| (0..count).map(|index| [0.01 * index as f32, 0.0]).collect::<Vec<_>>();
    let scene = Scene { views: directions(40), lights: directions(40), size: [150, 9], ..Scene::default() };
    let [fmf, dfmf, pvf, bdi] = larger(&scene).try_into().unwrap_or_else(|_| panic!("four files"));
    assert_eq!(open(&bdi.bytes, &ReadOptions::default()).chunk(), Some([109, 1]));
    for (file, mut samples) in [(fmf, vec![0, 7, 1599]), (dfmf, vec![3, 4]), (pvf, vec![39, 40, 41, 900]), (bdi, vec![0, 1, 90, 800, 1599])]
    {
        let source = open(&file.bytes, &ReadOptions::default());
        let dump = file.bytes.starts_with(b"!BDI");
        for _ in 0..2 {
            let found = read(source.as_ref(), &samples, Block::whole([150, 9]));
            let planes = samples.iter().flat_map(|&sample| &file.stored[sample * 4050..][..4050]);
            let errors = found.iter().zip(planes).map(|(&found, &stored)| match stored.is_nan() {
                true => f64::from(u8::from(!found.is_nan())),
                false => error(found, if dump { stored } else { stored.max(0.0) }),
            });
            hold("container of several strips, relative", errors.worst(), BOUND);
            samples = (0..1600).step_by(3).collect();
        }
    }
}

/// A file of 5.5 GB, most of it a hole that takes no room on a disk.
fn values_beyond_four_gigabytes_are_found() {
    if cfg!(windows) {
        // There, holes are filled.
        return;
    }
    use std::io::{Seek, SeekFrom, Write};
    let directions: Vec<[f32; 2]> = (0..151).map(|index| [0.01 * index as f32, 0.0]).collect();
    let scene = Scene { views: directions.clone(), lights: directions, size: [400, 100], ..Scene::default() };
    let header = builder::bdi_header(&scene, 4, &[1; 40_000], false).bytes;
    let chunk = 1600 * 22_801 * 6_u64;
    let folder = tempfile::tempdir().expect("is writable");
    let path = folder.path().join("large.btf");
    let mut file = std::fs::File::create(&path).expect("is writable");
    file.write_all(&header).expect("is writable");
    for index in 0..25 {
        file.seek(SeekFrom::Start(header.len() as u64 + index * (chunk + 4))).expect("seeks");
        file.write_all(&u32::try_from(chunk).expect("is below 4 GiB").to_le_bytes()).expect("is writable");
    }
    // The last sample of the last texel but one, and the end of the file.
    let end = header.len() as u64 + 25 * (chunk + 4);
    file.set_len(end).expect("is writable");
    file.seek(SeekFrom::Start(end - 22_801 * 6 - 6)).expect("seeks");
    file.write_all(&[f16::ONE, f16::from_f32(0.5), f16::from_f32(-2.0)].map(f16::to_le_bytes).concat()).expect("is writable");
    drop(file);
    let source = io::open(&path).expect("opens");
    let block = Block { column: 397, row: 98, width: 3, height: 2 };
    let found = read(source.as_ref(), &[0, 22_800], block);
    let mut expected = vec![f16::ZERO; 36];
    (expected[22], expected[28], expected[34]) = (f16::ONE, f16::from_f32(0.5), f16::from_f32(-2.0));
    assert_eq!(found, expected);
}

fn the_fingerprint_tells_files_apart() {
    let file = builder::bdi(&Scene::default(), 2, &MASK, true, false);
    let print = |bytes: &[u8]| open(bytes, &ReadOptions::default()).fingerprint();
    let mut other = file.bytes.clone();
    *other.last_mut().expect("is not empty") ^= 1;
    assert_eq!(print(&file.bytes), print(&file.bytes));
    assert_ne!(print(&file.bytes), print(&other));
    let folder = tempfile::tempdir().expect("is writable");
    let path = folder.path().join("a.btf");
    let of_file = |length: usize| {
        std::fs::write(&path, [file.bytes.clone(), vec![0; length]].concat()).expect("is writable");
        io::open(&path).expect("opens").fingerprint()
    };
    assert_ne!(of_file(0), of_file(1));
}

/// The files hold scalars as f32 or halves, the oracles were computed in f32.
fn shared_samples_equal_their_oracles(data: &Path) {
    let data = data.join("btf-container");
    let stored = ReadOptions { includes_cosine: Some(true), ..ReadOptions::default() };
    let read = |name: &str| {
        let bytes: Arc<[u8]> = std::fs::read(data.join(name)).expect("is readable").into();
        let source = io::open_btf_bytes(name, bytes, &stored).expect("opens");
        assert_eq!(source.btf().encoding().texels_per_mm, Some(7.5));
        whole(source.as_ref())
    };
    for name in ["fmf1", "dfmf"] {
        let oracle = npy::read(&data.join(format!("{name}.npy")));
        let found = read(&format!("{name}.btf"));
        assert_eq!(found.len(), oracle.len());
        let texels = oracle.len() / 27;
        let differences = found.iter().enumerate().map(|(index, found)| {
            let (sample, channel, texel) = (index / (3 * texels), index / texels % 3, index % texels);
            error(*found, oracle[(sample * texels + texel) * 3 + channel])
        });
        hold(&format!("shared container {name}, relative"), differences.worst(), BOUND);
    }
    for name in ["fmf0.btf", "dfmf11.btf"] {
        assert!(read(name).iter().all(|value| value.is_finite()));
    }
}
