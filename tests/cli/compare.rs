//! A material compared with its source, as a user does it.

use std::{fs, path::Path};

use overpaint::gpu::Gpu;
use serde_json::Value;
use tempfile::TempDir;

use super::{overpaint, refused};

crate::suite! {
    plain: a_folder_that_is_something_else_is_left;
    gpu: a_comparison_has_its_figures_and_pictures, pictures_come_from_the_local_pca, what_does_not_go_together_is_refused;
}

/// A rendered source of 24 x 16 texels and the material that is fitted to it.
fn fitted(gpu: &Gpu) -> TempDir {
    let folder = tempfile::tempdir().expect("is made");
    let small = ["--size", "24x16", "--views", "0:1,50:3", "--lights", "0:1,15:4,60:5"];
    succeed(gpu, folder.path(), &[&["synth", "-o", "btf.zarr", "--height-field", "bumps", "--reflectance", "plastic"], &small[..]].concat());
    succeed(gpu, folder.path(), &["fit", "btf.zarr", "-o", "material.zarr"]);
    folder
}

fn succeed(gpu: &Gpu, folder: &Path, arguments: &[&str]) -> String {
    let ran = overpaint(folder, &[arguments, &["--adapter", &gpu.adapter().name]].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    ran.stdout
}

fn read_json(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).expect("is there")).expect("is JSON")
}

fn a_comparison_has_its_figures_and_pictures(gpu: &Gpu) {
    let folder = fitted(gpu);
    let folder = folder.path();
    let said = succeed(gpu, folder, &["compare", "btf.zarr", "material.zarr", "-o", "compared", "--texel", "20,9"]);
    for part in ["relative RMS 0.", " dB", "over 40 pairs", "bias and PSNR by view elevation", "θ   50", "wrote compared/compare.html"] {
        assert!(said.contains(part), "{part} in {said}");
    }
    let figures = read_json(&folder.join("compared/compare.json"));
    assert_eq!(figures["format"], "overpaint comparison");
    assert_eq!((&figures["source"], &figures["size"]), (&"btf".into(), &serde_json::json!([24, 16])));
    assert_eq!((&figures["adapter"]["name"], &figures["version"]), (&gpu.adapter().name.as_str().into(), &env!("CARGO_PKG_VERSION").into()));
    assert_eq!((&figures["relief"]["displace"], &figures["material"]["settings"]["boundary"]), (&true.into(), &"periodic".into()));
    assert!(figures["seconds"].as_f64().is_some_and(|seconds| seconds > 0.0) && figures["definitions"]["bias"].is_string());
    let overall = &figures["overall"];
    // A fit as if flat of a relief: neither perfect nor lost.
    assert!(overall["relative_rms"].as_f64().is_some_and(|error| (0.01..0.6).contains(&error)), "{overall}");
    assert!(overall["psnr_db"].as_f64().is_some_and(|psnr| (10.0..60.0).contains(&psnr)), "{overall}");
    assert!(overall["bias"].as_f64().is_some_and(|bias| bias.abs() < 0.3), "{overall}");
    let thetas = |of: &str, key: &str| figures[of].as_array().expect("is a list").iter().map(|at| at[key].as_f64().expect("is a number")).collect::<Vec<_>>();
    assert_eq!(thetas("by_view_elevation", "theta_degrees"), [0.0, 50.0]);
    assert_eq!(thetas("by_light_elevation", "theta_degrees"), [0.0, 15.0, 60.0]);
    assert_eq!(thetas("by_view_and_light_elevation", "light_theta_degrees"), [0.0, 15.0, 60.0, 0.0, 15.0, 60.0]);
    assert_eq!(thetas("by_view_elevation", "pairs"), [10.0, 30.0]);
    for (worst, count) in [("worst_pairs", 10), ("worst_texels", 10)] {
        let errors = thetas(worst, "relative_rms");
        assert!(errors.len() == count && errors.is_sorted_by(|a, b| a >= b), "{worst}: {errors:?}");
    }

    let html = fs::read_to_string(folder.join("compared/compare.html")).expect("is there");
    assert!(!html.contains("<script") && !html.contains("http:") && !html.contains("https:"), "the report is self-contained");
    let named: Vec<_> =
        ["src=\"", "href=\""].iter().flat_map(|start| html.split(start).skip(1)).filter_map(|rest| rest.split('"').next()).collect();
    for file in ["errors.svg", "above.png", "oblique.png", "worst.png", "texels.png", "texel.png"] {
        assert!(named.contains(&file), "{file} in {named:?}");
    }
    for file in named {
        assert!(fs::metadata(folder.join("compared").join(file)).is_ok_and(|there| there.len() > 0), "{file}");
    }
    // Three lights from the right; four columns, with four pixels between.
    let sheet = image::open(folder.join("compared/above.png")).expect("is PNG");
    assert_eq!((sheet.width(), sheet.height()), (4 * 28 - 4, 3 * 20 - 4));
    // Four steps of ten lights, measured and fitted, by four views.
    let steps = image::open(folder.join("compared/texel.png")).expect("is PNG");
    assert_eq!((steps.width(), steps.height()), (4 * 14 - 4, 2 * 8 - 4));
    let plot = fs::read_to_string(folder.join("compared/errors.svg")).expect("is there");
    assert!(plot.starts_with("<svg") && ["relative RMS error", "PSNR / dB", "mean signed error / %", "θ of view or light / degrees"].iter().all(|text| plot.contains(text)));

    // The same again in its place, without relief, and less well.
    succeed(gpu, folder, &["compare", "btf.zarr", "material.zarr", "-o", "compared", "--no-relief", "--memory", "1MiB"]);
    let flat = read_json(&folder.join("compared/compare.json"));
    assert_eq!((&flat["relief"]["displace"], &flat["relief"]["shadow"]), (&false.into(), &false.into()));
    assert_ne!(flat["overall"]["relative_rms"], overall["relative_rms"]);
    // Its local PCA, which holds all of it and so is nearer.
    succeed(gpu, folder, &["compare", "btf.zarr", "material.zarr", "-o", "compared", "--model", "lpca"]);
    let compressed = read_json(&folder.join("compared/compare.json"));
    assert_eq!((&compressed["model"], &compressed["texel_samples"], &compressed["relief"]), (&"lpca".into(), &1.into(), &Value::Null));
    let error = |figures: &Value| figures["overall"]["relative_rms"].as_f64().expect("is a number");
    assert!(error(&compressed) < 0.5 * overall["relative_rms"].as_f64().expect("is a number"), "{}", compressed["overall"]);
    // What the fit says that it leaves; compare holds radiance to 0 and above.
    let left = compressed["material"]["lpca"]["learned"]["relative_rms"].as_f64().expect("is a number");
    assert!(error(&compressed) <= 1.001 * left, "{left} in {}", compressed["overall"]);
    for file in ["iterations.svg", "between.png"] {
        assert!(fs::metadata(folder.join("compared").join(file)).is_ok_and(|there| there.len() > 0), "{file}");
    }
    // A part of the source and the material of that part.
    let region = ["--region", "8,4,9x7", "--every", "2"];
    succeed(gpu, folder, &[&["fit", "btf.zarr", "-o", "part.zarr"], &region[..]].concat());
    succeed(gpu, folder, &[&["compare", "btf.zarr", "part.zarr", "-o", "part", "--texel", "8,6"], &region[..]].concat());
    assert_eq!(read_json(&folder.join("part/compare.json"))["size"], serde_json::json!([9, 7]));
}

fn pictures_come_from_the_local_pca(gpu: &Gpu) {
    let folder = fitted(gpu);
    let read = |file: &str| image::open(folder.path().join(file)).expect("is PNG").into_rgb8();
    let reconstruct = |more: &[&str], file: &str| {
        let directions = ["reconstruct", "material.zarr", "--view", "20,100", "--light", "30,10", "-o", file];
        succeed(gpu, folder.path(), &[&directions, more].concat());
        read(file)
    };
    let alone = reconstruct(&["--model", "lpca"], "alone.png");
    assert_eq!(alone.dimensions(), (24, 16));
    assert_ne!(alone, reconstruct(&["--model", "svbrdf"], "svbrdf.png"));
    // One pixel a texel: neither softens.
    for samples in ["1", "4"] {
        assert_eq!(alone, reconstruct(&["--model", "lpca", "--texel-samples", samples], "sharp.png"));
    }
    for samples in ["5", "9", "25"] {
        assert_ne!(alone, reconstruct(&["--model", "lpca", "--texel-samples", samples], "soft.png"));
    }
    let strip = reconstruct(&["--model", "lpca", "--sweep", "3", "--to-view", "80,100"], "strip.png");
    assert_eq!(strip.dimensions(), (72, 16));
    assert!(alone.enumerate_pixels().all(|(x, y, pixel)| strip.get_pixel(x, y) == pixel), "the strip begins with it");
}

fn what_does_not_go_together_is_refused(gpu: &Gpu) {
    let folder = fitted(gpu);
    let compare = |arguments: &[&str]| {
        let adapter = ["--adapter", &gpu.adapter().name];
        overpaint(folder.path(), &[&["compare", "btf.zarr", "material.zarr", "-o", "compared"], arguments, &adapter].concat())
    };
    succeed(gpu, folder.path(), &["fit", "btf.zarr", "-o", "bare.zarr", "--no-lpca"]);
    let bare = ["bare.zarr", "--model", "lpca", "--adapter", &gpu.adapter().name];
    let directions = ["--view", "0,0", "--light", "0,0", "-o", "seen.png"];
    for arguments in [[&["reconstruct"], &bare[..], &directions].concat(), [&["compare", "btf.zarr"], &bare[..], &["-o", "compared"]].concat()] {
        refused(&overpaint(folder.path(), &arguments), 1, "has no local PCA; fit it again without --no-lpca");
    }
    refused(&compare(&["--region", "0,0,8x5"]), 1, "has 8 x 5 texels and the material 24 x 16");
    refused(&compare(&["--texel", "24,3"]), 1, "there is no texel 24,3: the plane has columns 0 to 23 and rows 0 to 15");
    assert!(!folder.path().join("compared").exists(), "nothing is left behind");
}

/// Before anything is computed: source and material are not there.
fn a_folder_that_is_something_else_is_left() {
    let folder = tempfile::tempdir().expect("is made");
    fs::create_dir(folder.path().join("photographs")).expect("is made");
    fs::write(folder.path().join("photographs/notes.txt"), "mine").expect("is written");
    fs::create_dir(folder.path().join("other")).expect("is made");
    fs::write(folder.path().join("other/compare.json"), "{\"format\": \"another\"}").expect("is written");
    let refuse = |output: &str, says: &str| refused(&overpaint(folder.path(), &["compare", "nowhere", "m.zarr", "-o", output]), 1, says);
    refuse("photographs", "no overpaint comparison");
    refuse("photographs/notes.txt", "no folder");
    refuse("other", "no overpaint comparison");
    refuse("no/such", "there is no folder no");
    // An empty folder will do: what is missing is told next.
    fs::create_dir(folder.path().join("empty")).expect("is made");
    refuse("empty", "m.zarr");
}
