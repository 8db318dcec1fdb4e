//! The main job as a user runs it, on the sample inside the program.

use std::{fs, path::Path, sync::OnceLock};

use overpaint::gpu::Gpu;
use serde_json::Value;
use tempfile::TempDir;

use super::{overpaint, refused};

crate::suite! {
    gpu: the_report_names_only_files_that_are_there, the_timings_make_sense, info_tells_of_the_material, reconstructions_are_images_of_the_texel_plane,
        renders_have_the_size_asked_for, a_recipe_is_painted_and_shown, a_material_is_not_written_over_something_else;
}

const DEMO: &str = "demo";
const TIMINGS: &str = "timings.json";
const MATERIAL: &str = "demo/weave64.zarr";

/// The folder in which the demo has run, once for all tests here.
fn demonstrated(gpu: &Gpu) -> &'static Path {
    static FOLDER: OnceLock<TempDir> = OnceLock::new();
    FOLDER
        .get_or_init(|| {
            let folder = tempfile::tempdir().expect("is made");
            let ran = overpaint(folder.path(), &["demo", "-o", DEMO, "--timings", TIMINGS, "--adapter", &gpu.adapter().name]);
            assert_eq!(ran.code, Some(0), "{ran:?}");
            assert!(ran.stdout.contains("report.html") && ran.stdout.contains(&gpu.adapter().name), "{ran:?}");
            folder
        })
        .path()
}

/// Runs a command in the demo's folder that must succeed; returns what it printed.
fn succeed(gpu: &Gpu, arguments: &[&str]) -> String {
    let ran = overpaint(demonstrated(gpu), arguments);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    ran.stdout
}

fn the_report_names_only_files_that_are_there(gpu: &Gpu) {
    let folder = demonstrated(gpu).join(DEMO);
    let html = fs::read_to_string(folder.join("report.html")).expect("is there");
    assert!(!html.contains("<script") && !html.contains("http:") && !html.contains("https:"), "the report is self-contained");
    assert!(html.contains(&gpu.adapter().name.replace('&', "&amp;")), "the adapter is named");
    let named: Vec<_> =
        ["src=\"", "href=\""].iter().flat_map(|start| html.split(start).skip(1)).filter_map(|rest| rest.split('"').next()).collect();
    assert!(named.len() > 40, "{named:?}");
    for file in named {
        let picture = image::open(folder.join(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
        assert!(picture.width() >= 64 && picture.height() >= 64, "{file}");
    }
}

fn the_timings_make_sense(gpu: &Gpu) {
    let text = fs::read_to_string(demonstrated(gpu).join(TIMINGS)).expect("is there");
    let timings: Value = serde_json::from_str(&text).expect("is JSON");
    assert_eq!(timings["adapter"]["name"], gpu.adapter().name);
    let total = timings["wall_seconds"].as_f64().expect("is a number");
    let stages = timings["stages"].as_array().expect("is a list");
    assert!(stages.len() >= 5, "{stages:?}");
    for stage in stages {
        let wall = stage["wall_seconds"].as_f64().expect("is a number");
        assert!((0.0..=total).contains(&wall), "{stage}");
        // Passes of a stage run within its time on the wall; 1 ms for the adapter's own clock.
        assert!(stage["gpu_seconds"].as_f64().is_none_or(|gpu| (0.0..=wall + 1e-3).contains(&gpu)), "{stage}");
        assert!(stage["texels"].is_u64() && stage["samples"].is_u64(), "{stage}");
    }
    let sum: f64 = stages.iter().filter_map(|stage| stage["wall_seconds"].as_f64()).sum();
    // Nearly all of the job is in some stage; two stages overlap at most.
    assert!((0.5 * total..=2.0 * total).contains(&sum), "{sum} s of {total} s");
}

fn info_tells_of_the_material(gpu: &Gpu) {
    let text = succeed(gpu, &["info", MATERIAL]);
    for part in [
        "64 x 64",
        "51: 1 at θ 0",
        "2601, every view under every light",
        "none of the known ones",
        "sRGB",
        "max_iterations",
        "texel widths",
        &gpu.adapter().name,
    ] {
        assert!(text.contains(part), "{part} in {text}");
    }
    let json: Value = serde_json::from_str(&succeed(gpu, &["info", MATERIAL, "--json"])).expect("is JSON");
    assert_eq!((&json["kind"], &json["width"]), (&"material".into(), &64.into()));
    assert_eq!(json["provenance"]["views"][0], serde_json::json!([0.0, 0.0]));
    let stored = fs::read_to_string(demonstrated(gpu).join(MATERIAL).join("zarr.json")).expect("is there");
    let stored: Value = serde_json::from_str(&stored).expect("is JSON");
    assert_eq!(json["conventions"], stored["attributes"]["conventions"]);
}

fn reconstructions_are_images_of_the_texel_plane(gpu: &Gpu) {
    for file in ["seen.png", "seen.exr"] {
        // A direction that was not measured.
        succeed(gpu, &["reconstruct", MATERIAL, "--view", "23.5,100", "--light", "41,33.3", "-o", file]);
        holds_a_picture(&demonstrated(gpu).join(file), [64, 64]);
    }
    // Side by side on a way over the hemisphere.
    succeed(gpu, &["reconstruct", MATERIAL, "--view", "0,0", "--light", "5,90", "--sweep", "3", "--to-light", "75,90", "-o", "strip.png"]);
    holds_a_picture(&demonstrated(gpu).join("strip.png"), [192, 64]);
}

fn renders_have_the_size_asked_for(gpu: &Gpu) {
    let painted = ["--paint", "watercolour/cadmium yellow", "--thickness", "0.4", "--relief", "1", "--pattern", "splash"];
    for (file, coat) in [("bare.png", &[][..]), ("painted.png", &painted), ("painted.exr", &painted)] {
        let arguments = [&["render", MATERIAL, "--size", "97x65", "-o", file], coat].concat();
        succeed(gpu, &arguments);
        holds_a_picture(&demonstrated(gpu).join(file), [97, 65]);
    }
    let read = |file: &str| fs::read(demonstrated(gpu).join(file)).expect("is there");
    assert_ne!(read("bare.png"), read("painted.png"), "paint shows");
}

const RECIPE: &str = r#"
[[layer]]
paint = "oil/cobalt blue"
pattern = { kind = "splash", seed = 3 }
thickness = 4
relief = 1.5

[[layer]]
paint = "watercolour/hansa yellow"
pattern = { kind = "stripes", count = 3 }
placement = { rotation = 45 }
thickness = 1
"#;

/// Painted first and looked at then, or at once: the same pictures. Alpha blending gives others.
fn a_recipe_is_painted_and_shown(gpu: &Gpu) {
    let folder = demonstrated(gpu);
    fs::write(folder.join("recipe.toml"), RECIPE).expect("is written");
    succeed(gpu, &["paint", MATERIAL, "--recipe", "recipe.toml", "-o", "painted.zarr"]);
    let directions = ["--view", "20,30", "--light", "50,120"];
    for command in ["render", "reconstruct"] {
        let show = |material: &str, file: &str, options: &[&str]| {
            succeed(gpu, &[&[command, material, "-o", file], &directions[..], options].concat());
            values(&folder.join(file))
        };
        let bare = show(MATERIAL, "bare.exr", &[]);
        let stored = show("painted.zarr", "stored.exr", &[]);
        assert!(stored == show(MATERIAL, "at_once.exr", &["--recipe", "recipe.toml"]), "{command}");
        let blended = show(MATERIAL, "blended.exr", &["--recipe", "recipe.toml", "--alpha-blend"]);
        assert!(stored != bare && blended != bare && stored != blended, "{command}");
    }
    let told = succeed(gpu, &["info", "painted.zarr"]);
    assert!(told.contains("oil/cobalt blue, splash, thickness 4, relief 1.5") && told.contains("watercolour/hansa yellow, stripes"), "{told}");
    assert!(succeed(gpu, &["info", MATERIAL]).contains("paint         none"));

    let both = ["render", MATERIAL, "--recipe", "recipe.toml", "--paint", "viridian", "--thickness", "1", "-o", "no.png"];
    refused(&overpaint(folder, &both), 2, "cannot be used with");
    refused(&overpaint(folder, &["render", MATERIAL, "--alpha-blend", "-o", "no.png"]), 2, "--alpha-blend is for paint");
    let of_lpca = ["reconstruct", MATERIAL, "--model", "lpca", "--recipe", "recipe.toml", "-o", "no.png"];
    refused(&overpaint(folder, &[&of_lpca, &directions[..]].concat()), 2, "leave out --model lpca");
    refused(&overpaint(folder, &["paint", MATERIAL, "--recipe", "absent.toml", "-o", "no.zarr"]), 1, "absent.toml");
    fs::write(folder.join("wrong.toml"), RECIPE.replace("cobalt blue", "cobolt blue")).expect("is written");
    refused(&overpaint(folder, &["paint", MATERIAL, "--recipe", "wrong.toml", "-o", "no.zarr"]), 1, "wrong.toml:3:9");
}

fn a_material_is_not_written_over_something_else(gpu: &Gpu) {
    let folder = demonstrated(gpu);
    fs::create_dir_all(folder.join("photographs")).expect("is made");
    refused(&overpaint(folder, &["fit", "cloth.zip", "-o", "photographs"]), 1, "no overpaint material");
    // Files that are no part of a material keep it from being replaced, before anything is computed: the source is not there.
    fs::create_dir_all(folder.join("noted")).expect("is made");
    fs::write(folder.join("noted/zarr.json"), fs::read(folder.join(MATERIAL).join("zarr.json")).expect("is there")).expect("is written");
    fs::write(folder.join("noted/notes.txt"), "mine").expect("is written");
    refused(&overpaint(folder, &["fit", "nowhere", "-o", "noted"]), 1, "notes.txt");
    fs::create_dir_all(folder.join("again")).expect("is made");
    fs::write(folder.join("again/weave64.zarr"), "mine").expect("is written");
    refused(&overpaint(folder, &["demo", "-o", "again", "--adapter", &gpu.adapter().name]), 1, "no overpaint material");
}

/// Columns, rows and values of a picture.
fn values(path: &Path) -> ([usize; 2], Vec<f32>) {
    if path.extension().is_some_and(|extension| extension == "exr") {
        let image = exr::prelude::read_first_flat_layer_from_file(path).expect("is OpenEXR");
        let size = [image.layer_data.size.0, image.layer_data.size.1];
        (size, image.layer_data.channel_data.list.iter().flat_map(|channel| channel.sample_data.values_as_f32()).collect())
    } else {
        let image = image::open(path).expect("is PNG").into_rgb32f();
        ([image.width() as usize, image.height() as usize], image.into_raw())
    }
}

/// The file is a picture of `size` that is neither black nor broken.
fn holds_a_picture(path: &Path, size: [usize; 2]) {
    let (found, values) = values(path);
    assert_eq!(found, size, "{}", path.display());
    assert!(values.iter().all(|value| value.is_finite()) && values.iter().any(|&value| value > 0.01), "{}", path.display());
}
