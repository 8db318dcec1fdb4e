//! What is told of a material.

use overpaint::{data::Material, io::material};
use serde_json::{Value, json};

use super::overpaint;
use crate::support::material::{local_pca, sample};

crate::suite! { plain: info_tells_of_the_local_pca; }

fn info_tells_of_the_local_pca() {
    let folder = tempfile::tempdir().expect("is made");
    let path = folder.path().join("m.zarr");
    material::save(&path, &sample([10, 6], 1)).expect("saves");
    let ran = overpaint(folder.path(), &["info", "m.zarr"]);
    assert!(ran.stdout.contains("\nlocal PCA     none\n"), "{ran:?}");

    material::save(&path, &Material { lpca: Some(local_pca([10, 6], [6, 3, 4])), ..sample([10, 6], 1) }).expect("saves");
    let stored = material::lpca_bytes(&path).expect("is readable");
    let ran = overpaint(folder.path(), &["info", "m.zarr"]);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    for part in [
        "\nlocal PCA     3 clusters of 4 components, relative RMS error 0.3000\n",
        "basis of 61 vectors, which leaves out 33.333 % of the variance",
        // 720 bytes of terms and as many of texels; 60 texels of 6 samples of 3 halves.
        "1.4 KiB (1/1.5) on the adapter",
        "the source takes 2.1 KiB as halves",
    ] {
        assert!(ran.stdout.contains(part), "\"{part}\" in {}", ran.stdout);
    }
    let ran = overpaint(folder.path(), &["info", "m.zarr", "--json"]);
    let told: Value = serde_json::from_str(&ran.stdout).expect("is JSON");
    let expected = json!({
        "clusters": 3, "components": 4, "rank": 61, "left_out": 1.0 / 3.0, "relative_rms": 0.1 + 0.2,
        "adapter_bytes": 1440, "stored_bytes": stored, "source_bytes": 2160,
    });
    assert_eq!(told["lpca"], expected);
}
