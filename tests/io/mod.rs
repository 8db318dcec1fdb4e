//! Readers and writers.

crate::suites! {
    archive, btf_file, corpus, dataset, deep, encoding, environment, export_gltf, export_maps, job, lights, material, material_lpca, material_paint, measured, mesh, mesh_gltf, openexr, picture, radiance_hdr, recipe, recipe_errors, recipe_images, selection, tree, tree_writer,
}

use std::{io::Cursor, path::Path};

use half::f16;
use image::{ImageFormat, RgbImage};
use overpaint::{
    data::Block,
    io::{self, IoError, Source},
    model::color,
};
use tempfile::TempDir;

/// An encoded image of smooth colours that depend on `seed`.
fn encoded(format: ImageFormat, [width, height]: [u32; 2], seed: usize) -> Vec<u8> {
    let image = RgbImage::from_fn(width, height, |x, y| image::Rgb([x, y, seed as u32 * 7].map(|value| (40 + 5 * value) as u8)));
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).expect("encodes");
    bytes.into_inner()
}

/// Directions of a small complete tree, in degrees: (view θ, view φ, light θ, light φ), in the order of its samples.
const PAIRS: [[u32; 4]; 6] = [[0, 0, 15, 0], [0, 0, 15, 120], [0, 0, 30, 60], [45, 90, 15, 0], [45, 90, 15, 120], [45, 90, 30, 60]];

/// The name that Bonn would give a sample.
fn bonn_name(sample: usize, extension: &str) -> String {
    let [tv, pv, tl, pl] = PAIRS[sample];
    format!("tv{tv:03}_pv{pv:03}/{sample:05} tl{tl:03} pl{pl:03} tv{tv:03} pv{pv:03}.{extension}")
}

/// The small tree as (name, bytes), 12 x 9 texels, JPEG.
fn small_tree() -> Vec<(String, Vec<u8>)> {
    (0..PAIRS.len()).map(|sample| (bonn_name(sample, "jpg"), encoded(ImageFormat::Jpeg, [12, 9], sample))).collect()
}

fn write_tree(folder: &Path, files: &[(String, Vec<u8>)]) {
    for (name, bytes) in files {
        let path = folder.join(name);
        std::fs::create_dir_all(path.parent().expect("is below the folder")).expect("is writable");
        std::fs::write(path, bytes).expect("is writable");
    }
}

/// The sRGB codes of a sample's radiance, RGBA: those that an 8-bit image stored, since a half is finer than a code.
fn codes(source: &dyn Source, sample: usize) -> Result<Vec<[u8; 4]>, IoError> {
    let code = |linear: f32| (255.0 * color::srgb_from_linear(f64::from(linear))).round() as u8;
    Ok(source.picture(sample)?.values().iter().map(|&[r, g, b]| [code(r), code(g), code(b), 255]).collect())
}

/// A tree of one image.
fn single(extension: &str, bytes: &[u8]) -> TempDir {
    let folder = tempfile::tempdir().expect("is writable");
    write_tree(folder.path(), &[(bonn_name(0, extension), bytes.to_vec())]);
    folder
}

/// Radiance of a block of some samples, `[sample][channel][texel]`.
fn read(source: &dyn Source, samples: &[usize], block: Block) -> Result<Vec<f16>, IoError> {
    let mut radiance = vec![f16::ZERO; 3 * samples.len() * block.texels()];
    source.read(samples, block, &mut radiance, &|_| {})?;
    Ok(radiance)
}

/// RGB of each texel of the only sample of a tree.
fn texels(folder: &Path) -> Result<Vec<[f32; 3]>, IoError> {
    Ok(io::open(folder)?.picture(0)?.values().to_vec())
}

/// The error's text, which must contain each of `parts`.
#[track_caller]
fn assert_says<T>(result: Result<T, IoError>, parts: &[&str]) {
    let text = result.err().expect("must fail").to_string();
    for part in parts {
        assert!(text.contains(part), "\"{text}\" does not contain \"{part}\"");
    }
}
