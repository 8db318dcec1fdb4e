//! What the README shows in Python, run as it stands there.

use std::{fs, path::Path, process::Command};

use libtest_mimic::Trial;
use overpaint::{
    data::{Map, Material},
    io::{self, material},
    pipeline::{Memory, Observer, Progress, import},
};

use crate::support::{
    material::{local_pca, sample},
    speckle::Speckle,
};

/// The tests need python3 with zarr and xarray, and are ignored by name without.
pub fn tests() -> Vec<Trial> {
    let is_there = Command::new("python3").args(["-c", "import zarr, xarray"]).output().is_ok_and(|ran| ran.status.success());
    let tests: [(&str, fn()); 2] = [
        ("cli::python::a_dataset_opens_in_zarr_and_xarray", a_dataset_opens_in_zarr_and_xarray),
        ("cli::python::a_local_pca_is_reconstructed", a_local_pca_is_reconstructed),
    ];
    let trial = |(name, test): (&str, fn())| {
        Trial::test(name, move || {
            test();
            Ok(())
        })
        .with_ignored_flag(!is_there)
    };
    tests.into_iter().map(trial).collect()
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
    run(folder.path(), &(snippet("\"cloth-btf.zarr\"") + &checks));
}

fn a_local_pca_is_reconstructed() {
    let folder = tempfile::tempdir().expect("is made");
    let lpca = local_pca([10, 6], [6, 3, 4]);
    let saved = Material { lpca: Some(lpca.clone()), ..sample([10, 6], 1) };
    material::save(&folder.path().join("cloth.zarr"), &saved).expect("saves");
    // Column 7 of row 4.
    let texel = 4 * 10 + 7;
    let term = |sample: usize, term: usize, channel: usize| {
        f64::from(lpca.terms[((sample * 3 + lpca.cluster[(7, 4)] as usize) * 5 + term) * 3 + channel])
    };
    let weights = |component: usize| f64::from(lpca.weights[texel * 4 + component]);
    let radiance = |sample: usize, channel: usize| {
        term(sample, 0, channel) + (0..4).map(|component| weights(component) * term(sample, 1 + component, channel)).sum::<f64>()
    };
    let checks = format!(
        "\nimport xarray\n\
         stored = xarray.open_zarr('cloth.zarr', consolidated=False)\n\
         assert stored.lpca_terms.dims == ('sample', 'cluster', 'term', 'channel') and stored.lpca_terms.shape == (6, 3, 5, 3)\n\
         assert str(stored.lpca_weights.dtype) == 'float16' and stored.lpca_weights.dims == ('row', 'column', 'component')\n\
         assert stored.lpca_pairs.values.tolist() == {:?}\n\
         assert material.attrs['lpca']['clusters'] == 3\n\
         assert radiance.shape == (6, 3)\n\
         assert abs(float(radiance[4, 2]) - {:?}) < 1e-5 and abs(float(radiance[5, 0]) - {:?}) < 1e-5\n",
        lpca.pairs.iter().map(|pair| [pair.view, pair.light]).collect::<Vec<_>>(),
        radiance(4, 2),
        radiance(5, 0),
    );
    run(folder.path(), &(snippet("\"cloth.zarr\"") + &checks));
}

/// Runs a script in `folder`.
fn run(folder: &Path, script: &str) {
    let mut python = Command::new("python3");
    python.args(["-c", script]).current_dir(folder);
    let ran = python.output().expect("starts");
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
}
