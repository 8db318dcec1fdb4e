//! Datasets: what is imported comes back, whatever is damaged is named, what was begun is ended.

use std::{
    fs,
    path::{Path, PathBuf},
};

use overpaint::{
    data::Block,
    io::{self, IoError, Kind, Source},
    pipeline::{Imported, Memory, Observer, PipelineError, Progress, import},
};
use tempfile::TempDir;

use crate::support::{
    files::files,
    speckle::{Speckle, bits},
};

crate::suite! { plain:
    everything_comes_back,
    any_block_is_a_cut_of_the_whole,
    a_source_in_blocks_gives_the_same_files,
    little_memory_gives_the_same_files,
    damage_is_named,
    what_was_written_is_kept,
    another_source_is_refused,
    a_half_written_dataset_is_none,
    a_complete_but_unmoved_dataset_is_moved,
    nothing_else_is_replaced;
}

#[derive(Debug)]
struct Silent;

impl Observer for Silent {}

fn imported(source: &dyn Source, target: &Path, memory: Memory) -> Result<Imported, PipelineError> {
    import(source, target, memory, &Progress::on_host(Box::new(Silent)))
}

/// Several chunks, none of which divides the plane.
fn speckle(skip: usize) -> Speckle {
    Speckle { invalid: 1000, ..Speckle::new([150, 131], skip) }
}

fn made(source: &dyn Source) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("is made");
    let path = folder.path().join("speckle.zarr");
    let done = imported(source, &path, Memory::default()).expect("imports");
    assert_eq!((done.chunks, done.kept), (5 * 4, 0));
    assert!(done.invalid > 100, "{done:?}");
    (folder, path)
}

fn everything_comes_back() {
    for skip in [0, 4] {
        let source = speckle(skip);
        let (_folder, path) = made(&source);
        assert_eq!(io::kind(&path), Kind::Source);
        let dataset = io::open(&path).expect("opens");
        let (found, expected) = (dataset.btf(), source.btf());
        assert_eq!((found.name(), found.size(), found.pairs()), (expected.name(), expected.size(), expected.pairs()));
        let degrees = |directions: &[overpaint::data::Direction]| directions.iter().map(ToString::to_string).collect::<Vec<_>>();
        assert_eq!((degrees(found.views()), degrees(found.lights())), (degrees(expected.views()), degrees(expected.lights())));
        let samples: Vec<usize> = (0..expected.pairs().len()).collect();
        let whole = Block::whole(expected.size());
        assert!(bits(dataset.as_ref(), &samples, whole) == bits(&source, &samples, whole), "every bit, those of NaN too");
    }
}

fn any_block_is_a_cut_of_the_whole() {
    let source = speckle(4);
    let (_folder, path) = made(&source);
    let dataset = io::open(&path).expect("opens");
    for (column, row, width, height) in [(0, 0, 1, 1), (149, 130, 1, 1), (120, 100, 30, 31), (5, 127, 140, 2), (127, 3, 2, 128)] {
        let block = Block { column, row, width, height };
        for samples in [&[0][..], &[2, 3, 7, 20, 33]] {
            assert!(bits(dataset.as_ref(), samples, block) == bits(&source, samples, block), "{block}, {samples:?}");
        }
    }
}

fn a_source_in_blocks_gives_the_same_files() {
    let (_folder, path) = made(&speckle(0));
    let (_other, in_blocks) = made(&Speckle { chunk: Some([13, 11]), ..speckle(0) });
    assert!(files(&path) == files(&in_blocks));
}

fn little_memory_gives_the_same_files() {
    let (folder, path) = made(&speckle(0));
    let little = folder.path().join("little.zarr");
    imported(&speckle(0), &little, Memory { host: 1, adapter: 1 }).expect("imports");
    assert!(files(&path) == files(&little));
}

fn damage_is_named() {
    let source = speckle(0);
    let (_folder, path) = made(&source);
    let chunk = path.join("radiance/c/3/0/0/1/0");
    let whole = fs::read(&chunk).expect("is there");
    // Samples of view 3 are 27 to 35.
    let read = |sample| io::open(&path).expect("opens").picture(sample).map(|_| ());
    let says = |parts: &[&str]| super::assert_says(read(30), &[parts, &["radiance", "speckle.zarr"]].concat());
    let mut flipped = whole.clone();
    flipped[whole.len() / 2] ^= 0x10;
    fs::write(&chunk, flipped).expect("is written");
    says(&["radiance/c/3/0/0/1/0"]);
    fs::write(&chunk, &whole[..whole.len() - 9]).expect("is written");
    says(&["radiance/c/3/0/0/1/0"]);
    fs::remove_file(&chunk).expect("is there");
    says(&["radiance/c/3/0/0/1/0 is missing"]);
    read(26).expect("other views stay readable");

    let metadata = path.join("radiance/zarr.json");
    let text = fs::read_to_string(&metadata).expect("is there");
    fs::write(&metadata, text.replace("float16", "float32").replace("0x7e00", "NaN")).expect("is written");
    super::assert_says(io::open(&path).map(|_| ()), &["radiance", "expected data type \"float16\""]);
    fs::write(&metadata, text.replacen("150", "151", 1)).expect("is written");
    super::assert_says(io::open(&path).map(|_| ()), &["radiance", "expected shape [5, 9, 3, 131, 150]"]);
    fs::write(&metadata, text).expect("is written");
    let metadata = path.join("zarr.json");
    let text = fs::read_to_string(&metadata).expect("is there");
    fs::write(&metadata, text.replace("\"format_version\": 1", "\"format_version\": 7")).expect("is written");
    super::assert_says(io::open(&path).map(|_| ()), &["version 7 of the dataset format"]);
}

fn what_was_written_is_kept() {
    let source = speckle(0);
    let (folder, path) = made(&source);
    let expected = files(&path);
    // As it was before it became complete: in the hidden folder, some chunks missing, one damaged.
    let again = folder.path().join("again.zarr");
    let hidden = folder.path().join(".again.zarr.unfinished");
    let writer = io::dataset::DatasetWriter::begin(&again, source.btf(), &source.fingerprint()).expect("begins");
    drop(writer);
    fs::remove_dir_all(hidden.join("result")).expect("is there");
    fs::rename(&path, hidden.join("result")).expect("is moved");
    for lost in ["zarr.json", "view_phi/zarr.json", "radiance/c/0/0/0/0/0", "radiance/c/4/0/0/1/1"] {
        fs::remove_file(hidden.join("result").join(lost)).expect("is there");
    }
    fs::write(hidden.join("result/radiance/c/2/0/0/0/1"), [1; 1000]).expect("is written");
    let done = imported(&source, &again, Memory::default()).expect("imports");
    assert_eq!((done.chunks, done.kept), (20, 17));
    assert!(files(&again) == expected && !hidden.exists());
}

fn another_source_is_refused() {
    let source = speckle(0);
    let folder = tempfile::tempdir().expect("is made");
    let path = folder.path().join("speckle.zarr");
    let begin = |source: &Speckle| io::dataset::DatasetWriter::begin(&path, source.btf(), &source.fingerprint());
    let first = begin(&source).expect("begins");
    match begin(&source) {
        Err(IoError::Running { .. }) => {}
        found => panic!("{found:?}"),
    }
    drop(first);
    super::assert_says(begin(&Speckle { invalid: 7, ..speckle(0) }), &["speckle.zarr", "differs", "files of the source", "remove"]);
    super::assert_says(begin(&speckle(4)), &["pairs"]);
    begin(&source).expect("goes on");
}

fn a_half_written_dataset_is_none() {
    let source = speckle(0);
    let (folder, path) = made(&source);
    let hidden = folder.path().join(".half.zarr.unfinished");
    drop(io::dataset::DatasetWriter::begin(&folder.path().join("half.zarr"), source.btf(), "").expect("begins"));
    assert_eq!(io::kind(&hidden.join("result")), Kind::Neither);
    fs::remove_file(path.join("zarr.json")).expect("is there");
    assert_eq!(io::kind(&path), Kind::Neither);
}

/// Killed between the last write and the renaming, or between the renaming and the end.
fn a_complete_but_unmoved_dataset_is_moved() {
    let source = speckle(0);
    let (folder, path) = made(&source);
    let expected = files(&path);
    let hidden = folder.path().join(".speckle.zarr.unfinished");
    drop(io::dataset::DatasetWriter::begin(&path, source.btf(), &source.fingerprint()).expect("begins"));
    fs::write(hidden.join("complete"), "").expect("is written");
    fs::remove_dir_all(hidden.join("result")).expect("is there");
    let done = imported(&source, &path, Memory::default()).expect("imports");
    assert_eq!(done.kept, 20);
    assert!(files(&path) == expected && !hidden.exists(), "it was moved already");

    drop(io::dataset::DatasetWriter::begin(&path, source.btf(), &source.fingerprint()).expect("begins"));
    fs::remove_dir_all(hidden.join("result")).expect("is there");
    fs::rename(&path, hidden.join("result")).expect("is moved");
    fs::write(hidden.join("complete"), "").expect("is written");
    imported(&source, &path, Memory::default()).expect("imports");
    assert!(files(&path) == expected && !hidden.exists(), "it was not moved yet");
}

fn nothing_else_is_replaced() {
    let source = speckle(0);
    let (folder, path) = made(&source);
    imported(&source, &path, Memory::default()).expect("a dataset replaces a dataset");
    fs::write(path.join("radiance/notes.txt"), "mine").expect("is written");
    match imported(&source, &path, Memory::default()) {
        Err(PipelineError::Source(error)) => super::assert_says::<()>(Err(error), &["notes.txt", "no part of a dataset"]),
        found => panic!("{found:?}"),
    }
    assert!(path.join("radiance/notes.txt").exists() && folder.path().read_dir().expect("is there").count() == 1);
}
