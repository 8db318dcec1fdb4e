use std::{fs, path::Path, process::Stdio};

use overpaint::gpu::Gpu;

use super::{command, overpaint, refused, run};

crate::suite! {
    plain: what_is_not_there_is_named, results_that_cannot_be_written_are_refused_before_the_work, no_adapter_names_the_command_that_helps;
    gpu: adapters_are_listed, an_unknown_adapter_is_refused_with_those_present, a_reader_that_goes_away_is_no_panic;
}

fn what_is_not_there_is_named() {
    let folder = tempfile::tempdir().expect("is made");
    for arguments in [
        &["info", "nowhere"][..],
        &["fit", "nowhere", "-o", "m.zarr"],
        &["reconstruct", "nowhere", "--view", "0,0", "--light", "0,0", "-o", "a.png"],
        &["render", "nowhere", "-o", "a.exr"],
    ] {
        refused(&overpaint(folder.path(), arguments), 1, "nowhere");
    }
}

fn results_that_cannot_be_written_are_refused_before_the_work() {
    let folder = tempfile::tempdir().expect("is made");
    fs::create_dir(folder.path().join("a.png")).expect("is made");
    fs::write(folder.path().join("taken"), "text").expect("is written");
    // The sources and materials named here do not exist: the result is looked at first.
    let refuse = |arguments: &[&str], says: &str| refused(&overpaint(folder.path(), arguments), 1, says);
    refuse(&["render", "nowhere", "-o", "no/such/a.png"], "there is no folder no/such");
    refuse(&["render", "nowhere", "-o", "a.png"], "it is a folder");
    refuse(&["fit", "nowhere", "-o", "no/such/m.zarr"], "there is no folder no/such");
    refuse(&["fit", "nowhere", "-o", "taken"], "no overpaint material");
    refuse(&["demo", "-o", "taken"], "taken");
    refuse(&["demo", "-o", "d", "--timings", "no/such/t.json"], "there is no folder no/such");
    assert_eq!(fs::read_to_string(folder.path().join("taken")).expect("is there"), "text");
}

fn no_adapter_names_the_command_that_helps() {
    if !cfg!(target_os = "linux") {
        return;
    }
    let folder = tempfile::tempdir().expect("is made");
    for arguments in [&["adapters"][..], &["demo"]] {
        let mut command = command(folder.path(), arguments);
        // Both names of the loader's variable: a driver file that is not there leaves no driver.
        command.env("VK_DRIVER_FILES", "none.json").env("VK_ICD_FILENAMES", "none.json");
        refused(&run(command), 1, "sudo apt-get install -y libvulkan1 mesa-vulkan-drivers");
    }
}

fn adapters_are_listed(gpu: &Gpu) {
    let ran = overpaint(Path::new("."), &["adapters"]);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    let adapter = gpu.adapter();
    for part in [&adapter.name, &adapter.driver, &adapter.kind, "storage binding", "workgroup", "timestamps"] {
        assert!(ran.stdout.contains(part), "{part} in {}", ran.stdout);
    }
}

fn an_unknown_adapter_is_refused_with_those_present(gpu: &Gpu) {
    let folder = tempfile::tempdir().expect("is made");
    let ran = overpaint(folder.path(), &["demo", "--adapter", "no such adapter"]);
    refused(&ran, 1, "no such adapter");
    assert!(ran.stderr.contains(&gpu.adapter().name), "{}", ran.stderr);
}

fn a_reader_that_goes_away_is_no_panic(_: &Gpu) {
    let mut child = command(Path::new("."), &["adapters"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("ends");
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
}
