//! What the user knows better than a reader, and parts of a source.

use std::{fs, path::Path};

use image::{ImageFormat, RgbImage};
use overpaint::gpu::Gpu;
use tempfile::TempDir;

use super::{overpaint, refused};

crate::suite! {
    plain: info_says_what_was_asked_for, a_part_is_described, missing_pairs_are_told, light_files_are_sources, what_is_not_there_is_named;
    gpu: fit_takes_scattered_pairs_and_parts;
}

/// Views at θ 0 and 30 under six lights, 8 x 6 texels, without the pairs of `missing`.
fn tree(missing: &[(u32, u32)]) -> TempDir {
    let folder = tempfile::tempdir().expect("is made");
    for view in [0, 30] {
        for light in 0..6 {
            if missing.contains(&(view, light)) {
                continue;
            }
            let image = RgbImage::from_fn(8, 6, |x, y| image::Rgb([100 + x as u8, 90 + 5 * y as u8, 80 + 10 * light as u8]));
            let name = format!("tv{view:03} pv000 tl{:03} pl{:03}.png", 20 + 5 * (light % 2), 60 * light);
            image.save_with_format(folder.path().join(name), ImageFormat::Png).expect("is written");
        }
    }
    folder
}

/// What `info` prints, which must contain each of `parts`.
#[track_caller]
fn info(folder: &Path, options: &[&str], parts: &[&str]) {
    let ran = overpaint(folder, &[&["info", "."], options].concat());
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    for part in parts {
        assert!(ran.stdout.contains(part), "\"{part}\" in {}", ran.stdout);
    }
}

fn info_says_what_was_asked_for() {
    let folder = tree(&[]);
    info(folder.path(), &[], &["transfer      sRGB", "in the stored values", "top row first", "scale         1\n"]);
    let options = ["--transfer", "gamma:2.2", "--cosine", "excluded", "--rows", "bottom-up", "--scale", "0.5"];
    info(folder.path(), &options, &["gamma 2.2", "not in the stored values, multiplied in", "bottom row first", "scale         0.5\n"]);
    info(folder.path(), &["--transfer", "linear", "--json"], &["\"transfer\": \"linear\"", "\"missing\": 0"]);
}

fn a_part_is_described() {
    let folder = tree(&[]);
    info(folder.path(), &["--region", "2,1,5x4"], &["texels        5 x 4"]);
    info(folder.path(), &["--every", "2"], &["views         1: 1 at θ 0", "lights        3: 2 at θ 20, 1 at θ 25"]);
    info(folder.path(), &["--max-theta", "24.5"], &["views         1: 1 at θ 0", "lights        3: 3 at θ 20"]);
}

fn missing_pairs_are_told() {
    let folder = tree(&[(30, 0), (30, 2), (30, 3), (0, 5), (30, 1)]);
    let first = "view θ 0 φ 0, light θ 25 φ 300";
    info(folder.path(), &[], &["samples       7\n", "missing       5 of 2 x 6 pairs", first, "view θ 30 φ 0, light θ 20 φ 0", "…"]);
    info(folder.path(), &["--json"], &["\"every_pair\": false", "\"missing\": 5", "\"first_missing\": ["]);
}

fn light_files_are_sources() {
    let folder = tempfile::tempdir().expect("is made");
    RgbImage::new(4, 4).save(folder.path().join("a.png")).expect("is written");
    fs::write(folder.path().join("set.lp"), "1\nphotos\\A.jpg 0 0.6 0.8\n").expect("is written");
    info(folder.path(), &[], &["lights        1: 1 at θ 36.869898", "transfer      linear"]);
    let ran = overpaint(folder.path(), &["info", "set.lp"]);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    fs::write(folder.path().join("set.lp"), "1\na.png 0 0.6 -0.8\n").expect("is written");
    refused(&overpaint(folder.path(), &["info", "set.lp"]), 1, "line 2: the light's direction 0 0.6 -0.8 is not above the surface");
}

fn what_is_not_there_is_named() {
    let folder = tree(&[]);
    refused(
        &overpaint(folder.path(), &["info", ".", "--region", "4,0,5x6"]),
        1,
        "5 x 6 texels from column 4, row 0 is not within the 8 x 6",
    );
    let ran = overpaint(folder.path(), &["info", ".", "--max-theta", "10"]);
    refused(&ran, 1, "θ up to 10 degrees; it has 12 samples, views 2 of θ 0.0 to 30.0, lights 6 of θ 20.0 to 25.0");
}

fn fit_takes_scattered_pairs_and_parts(gpu: &Gpu) {
    let folder = tree(&[(30, 1), (30, 4)]);
    let work = tempfile::tempdir().expect("is made");
    let source = folder.path().to_str().expect("is UTF-8");
    let fit = ["fit", source, "-o", "m.zarr", "--region", "1,2,6x3", "--adapter", &gpu.adapter().name];
    let ran = overpaint(work.path(), &fit);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let ran = overpaint(work.path(), &["info", "m.zarr"]);
    assert!(ran.stdout.contains("texels        6 x 3") && ran.stdout.contains("missing       2 of 2 x 6 pairs"), "{}", ran.stdout);
    for option in [["--transfer", "linear"], ["--every", "1"]] {
        refused(&overpaint(work.path(), &[&["info", "m.zarr"], &option[..]].concat()), 2, "m.zarr is a material");
    }
}
