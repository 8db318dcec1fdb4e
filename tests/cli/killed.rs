//! Import and fit, killed at random moments and run again.

use std::{
    fs,
    path::Path,
    process::Stdio,
    thread,
    time::Instant,
};

use image::RgbImage;
use overpaint::gpu::Gpu;

use super::{command, overpaint};
use crate::support::{files::files, random::Random};

crate::suite! { plain: a_killed_import_is_ended_by_the_next; gpu: a_killed_fit_is_ended_by_the_next; }

const KILLS: usize = 20;

/// An image tree that takes a while: 5 views, 12 lights.
fn write_tree(folder: &Path, side: u32) {
    let views = [(0, 0), (45, 0), (45, 90), (45, 180), (45, 270)];
    let lights: Vec<(u32, u32)> = (0..12).map(|light| (20 + 20 * (light % 3), 30 * light)).collect();
    fs::create_dir(folder).expect("is made");
    let mut random = Random::new(1);
    for (tv, pv) in views {
        for (tl, pl) in &lights {
            let name = format!("tl{tl:03} pl{pl:03} tv{tv:03} pv{pv:03}.png");
            RgbImage::from_fn(side, side, |_, _| image::Rgb([0; 3].map(|_: u8| 40 + random.below(150) as u8)))
                .save(folder.join(name))
                .expect("is written");
        }
    }
}

/// Runs the job until it has been killed often enough, from anew whenever it ends before that, then to its end; whatever stands under the
/// target's name at any time must be the undisturbed result.
fn kill_and_run_again(folder: &Path, arguments: &[&str], seed: u64) {
    let job = |target: &'static str| [arguments, &["-o", target]].concat();
    let start = Instant::now();
    let ran = overpaint(folder, &job("undisturbed.zarr"));
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let whole = start.elapsed();
    let expected = files(&folder.join("undisturbed.zarr"));

    let target = folder.join("disturbed.zarr");
    let mut random = Random::new(seed);
    let (mut kills, mut ended) = (0, 0);
    while kills < KILLS {
        let mut child = command(folder, &job("disturbed.zarr")).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("starts");
        thread::sleep(whole.mul_f64(random.unit() * 0.9));
        // On Unix this is signal 9.
        child.kill().expect("is ours");
        if child.wait().expect("ends").success() {
            ended += 1;
            assert!(files(&target) == expected, "ended after {kills} kills");
            fs::remove_dir_all(&target).expect("is there");
        } else {
            kills += 1;
            assert!(!target.exists() || files(&target) == expected, "what looks complete is complete");
            if target.exists() {
                // Killed after the result was in its place.
                assert_eq!(overpaint(folder, &job("disturbed.zarr")).code, Some(0));
                fs::remove_dir_all(&target).expect("is there");
            }
        }
    }
    let ran = overpaint(folder, &job("disturbed.zarr"));
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(files(&target) == expected, "after {kills} kills and {ended} ends");
    assert!(!folder.join(".disturbed.zarr.unfinished").exists());
}

fn a_killed_import_is_ended_by_the_next() {
    let folder = tempfile::tempdir().expect("is made");
    write_tree(&folder.path().join("tree"), 300);
    kill_and_run_again(folder.path(), &["import", "tree"], 3);
}

fn a_killed_fit_is_ended_by_the_next(gpu: &Gpu) {
    let folder = tempfile::tempdir().expect("is made");
    write_tree(&folder.path().join("tree"), 64);
    // The normals in two tiles, the reflectance in three blocks of 22 rows at most, two tiles each. Few steps, for time's sake.
    let bounds = ["--vram", "1MiB", "--memory", "1MiB", "--steps", "2", "--clusters", "4", "--components", "2", "--iterations", "6"];
    let arguments = [&["fit", "tree", "--adapter", &gpu.adapter().name], &bounds[..]].concat();
    kill_and_run_again(folder.path(), &arguments, 4);
}
