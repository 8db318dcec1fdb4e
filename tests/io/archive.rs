//! The same trees inside .zip archives.

use std::io::{Cursor, Write};

use overpaint::io::{self, Kind};
use rayon::prelude::*;
use tempfile::TempDir;
use zip::{CompressionMethod, ZipWriter, write::SimpleFileOptions};

use super::{assert_says, bonn_name, codes, small_tree, write_tree};

crate::suite! { plain:
    an_archive_reads_as_its_folder,
    many_threads_read_at_once,
    a_file_that_is_no_archive_is_an_error,
    every_truncation_of_an_archive_is_an_error,
    damage_is_an_error,
    declared_sizes_are_not_believed;
}

fn zipped(files: &[(String, Vec<u8>)], method: CompressionMethod) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in files {
        writer.start_file(format!("small/{name}"), SimpleFileOptions::default().compression_method(method)).expect("starts");
        writer.write_all(bytes).expect("writes");
    }
    writer.finish().expect("finishes").into_inner()
}

fn archive(bytes: &[u8]) -> (TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().expect("is writable");
    let path = folder.path().join("small tree.zip");
    std::fs::write(&path, bytes).expect("is writable");
    (folder, path)
}

fn an_archive_reads_as_its_folder() {
    let mut files = small_tree();
    let folder = tempfile::tempdir().expect("is writable");
    write_tree(folder.path(), &files);
    let expected = io::open(folder.path()).expect("opens");
    files.rotate_left(2);
    for method in [CompressionMethod::Stored, CompressionMethod::Deflated] {
        let bytes = zipped(&files, method);
        let (_folder, path) = archive(&bytes);
        assert_eq!(io::kind(&path), Kind::Source);
        let (on_disk, in_memory) = (io::open(&path).expect("opens"), io::open_zip_bytes("small tree", bytes.leak()).expect("opens"));
        for source in [on_disk, in_memory] {
            assert_eq!(source.btf().name(), "small tree");
            assert_eq!(source.btf().pairs(), expected.btf().pairs());
            for sample in 0..6 {
                assert_eq!(source.btf().directions(sample), expected.btf().directions(sample));
                assert_eq!(codes(source.as_ref(), sample).expect("decodes"), codes(expected.as_ref(), sample).expect("decodes"));
            }
        }
    }
}

fn many_threads_read_at_once() {
    let (_folder, path) = archive(&zipped(&small_tree(), CompressionMethod::Deflated));
    let source = io::open(&path).expect("opens");
    let alone: Vec<_> = (0..6).map(|sample| codes(source.as_ref(), sample).expect("decodes")).collect();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(8).build().expect("starts");
    let same =
        pool.install(|| (0..600_usize).into_par_iter().all(|turn| codes(source.as_ref(), turn % 6).expect("decodes") == alone[turn % 6]));
    assert!(same);
}

fn a_file_that_is_no_archive_is_an_error() {
    let (_folder, path) = archive(b"plain text");
    assert_says(io::open(&path), &["small tree.zip is neither a folder nor a .zip archive", "\"plain te\""]);
    assert_eq!(io::kind(&path), Kind::Neither);
}

fn every_truncation_of_an_archive_is_an_error() {
    let whole = zipped(&small_tree()[..2], CompressionMethod::Stored);
    for length in (0..whole.len()).step_by(37).chain([whole.len() - 1]) {
        let (_folder, path) = archive(&whole[..length]);
        assert_says(io::open(&path), &["small tree.zip"]);
    }
}

fn damage_is_an_error() {
    for method in [CompressionMethod::Stored, CompressionMethod::Deflated] {
        let files = small_tree();
        let mut bytes = zipped(&files, method);
        // Somewhere in the second file's data: before its entry in the directory, after its name.
        let name = bonn_name(1, "jpg");
        let start = bytes.windows(name.len()).position(|part| part == name.as_bytes()).expect("is there") + name.len();
        bytes[start + files[1].1.len() / 2] ^= 0x40;
        let (_folder, path) = archive(&bytes);
        let source = io::open(&path).expect("opens");
        assert_says(codes(source.as_ref(), 1), &["small tree.zip: small/", &name, "damaged"]);
        codes(source.as_ref(), 0).expect("the others stay readable");
    }
}

fn declared_sizes_are_not_believed() {
    let mut bytes = zipped(&small_tree(), CompressionMethod::Deflated);
    // In the central directory, the uncompressed size stands 24 bytes after the signature.
    let entry = bytes.windows(4).position(|part| part == b"PK\x01\x02").expect("has a directory");
    for (declared, says) in [(0xf000_0000_u32, "more than the"), (0x0fff_ffff, "damaged")] {
        bytes[entry + 24..entry + 28].copy_from_slice(&declared.to_le_bytes());
        let (_folder, path) = archive(&bytes);
        assert_says(io::open(&path), &["small tree.zip", &bonn_name(0, "jpg"), says]);
    }
}
