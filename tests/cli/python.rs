//! What the README shows in Python, run as it stands there.

use std::{fs, path::Path, process::Command};

use libtest_mimic::Trial;
use overpaint::{
    data::Map,
    io,
    pipeline::{Memory, Observer, Progress, import},
};

use crate::support::speckle::Speckle;

/// The tests need python3 with zarr and xarray, and are ignored by name without.
pub fn tests() -> Vec<Trial> {
    let is_there = Command::new("python3").args(["-c", "import zarr, xarray"]).output().is_ok_and(|ran| ran.status.success());
    vec![
        Trial::test("cli::python::a_dataset_opens_in_zarr_and_xarray", || {
            a_dataset_opens_in_zarr_and_xarray();
            Ok(())
        })
        .with_ignored_flag(!is_there),
    ]
}

#[derive(Debug)]
struct Silent;

impl Observer for Silent {}

/// The Python in the README that speaks of `file`.
fn snippet(file: &str) -> String {
    let readme = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).expect("is there");
    let mut snippets = readme.split("```python\n").skip(1).filter_map(|rest| rest.split("```").next());
    snippets.find(|text| text.contains(file)).expect("is shown").to_owned()
}

fn a_dataset_opens_in_zarr_and_xarray() {
    let folder = tempfile::tempdir().expect("is made");
    let source = Speckle::new([40, 30], 0);
    import(&source, &folder.path().join("cloth-btf.zarr"), Memory::default(), &Progress::on_host(Box::new(Silent))).expect("imports");
    let dataset = io::open(&folder.path().join("cloth-btf.zarr")).expect("opens");
    // Sample 2 * 9 + 5 is view 2 under light 5.
    let picture: Map<[f32; 3]> = dataset.picture(23).expect("reads");
    let checks = format!(
        "\nassert picture.shape == (3, 30, 40) and str(picture.dtype) == 'float16'\n\
         assert float(group['radiance'][2, 5, 1, 7, 11]) == {:?}\n\
         assert dict(dataset.sizes) == dict(view=5, light=9, channel=3, row=30, column=40)\n\
         assert float(dataset.radiance[2, 5, 0, 29, 39]) == {:?}\n\
         assert set(dataset.coords) == {{'view_theta', 'view_phi', 'light_theta', 'light_phi'}}\n\
         assert abs(float(dataset.light_theta[5]) - 55) < 1e-9\n",
        f64::from(picture[(11, 7)][1]),
        f64::from(picture[(39, 29)][0])
    );
    let mut python = Command::new("python3");
    python.args(["-c", &(snippet("cloth-btf.zarr") + &checks)]).current_dir(folder.path());
    let ran = python.output().expect("starts");
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
}
