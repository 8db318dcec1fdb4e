use std::{fs, path::Path};

use overpaint::{data::Material, io::material};

use super::{overpaint, refused};
use crate::support::material::{painted, sample};

crate::suite! { gpu: pictures_of_meshes_are_written, a_turntable_goes_on_where_it_stopped; plain: wrong_usage_is_refused; }

fn with_material(folder: &Path) {
    let sample = Material { painted: Some(painted([8, 5], 2)), ..sample([8, 5], 2) };
    material::save(&folder.join("m.zarr"), &sample).expect("saves");
}

fn succeeds(folder: &Path, arguments: &[&str]) {
    let ran = overpaint(folder, arguments);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
}

fn pictures_of_meshes_are_written(_: &overpaint::gpu::Gpu) {
    let folder = tempfile::tempdir().expect("is made");
    with_material(folder.path());
    let channels = "depth,normal,painted,thickness,texel";
    let of_sphere = ["render", "m.zarr", "--mesh", "sphere", "--spp", "1", "--size", "40x30"];
    succeeds(folder.path(), &[&of_sphere[..], &["--environment", "sky", "--lamp", "0,0,3", "--channels", channels, "-o", "s.exr"]].concat());
    let image = exr::prelude::read_first_flat_layer_from_file(folder.path().join("s.exr")).expect("is an EXR");
    let names: Vec<_> = image.layer_data.channel_data.list.iter().map(|channel| channel.name.to_string()).collect();
    assert_eq!(
        names,
        ["A", "B", "G", "R", "Z", "normal.X", "normal.Y", "normal.Z", "painted", "texel.X", "texel.Y", "thickness"]
    );
    let values = |name: &str| {
        let channel = image.layer_data.channel_data.list.iter().find(|channel| channel.name.eq(name)).expect("is there");
        channel.sample_data.values_as_f32().collect::<Vec<_>>()
    };
    let middle = 15 * 40 + 20;
    // The unit sphere in a picture that it fills: the camera's distance less 1, and a normal that is one.
    assert!(values("Z")[middle] > 1.0 && values("Z")[0] == 0.0, "{}", values("Z")[middle]);
    let normal = ["normal.X", "normal.Y", "normal.Z"].map(|name| f64::from(values(name)[middle]));
    assert!((normal.iter().map(|x| x * x).sum::<f64>().sqrt() - 1.0).abs() < 1e-5, "{normal:?}");
    assert!(values("texel.X").iter().all(|&column| (0.0..8.0).contains(&column)));

    // A job says the same as the options.
    fs::write(
        folder.path().join("j.toml"),
        "material = \"m.zarr\"\noutput = \"j.png\"\nsize = [40, 30]\nspp = 1\nmesh = { shape = \"sphere\" }\n",
    )
    .expect("is written");
    succeeds(folder.path(), &["render", "j.toml"]);
    succeeds(folder.path(), &[&of_sphere[..], &["-o", "o.png"]].concat());
    assert_eq!(fs::read(folder.path().join("j.png")).expect("is there"), fs::read(folder.path().join("o.png")).expect("is there"));
}

fn a_turntable_goes_on_where_it_stopped(_: &overpaint::gpu::Gpu) {
    let folder = tempfile::tempdir().expect("is made");
    with_material(folder.path());
    let turn = ["render", "m.zarr", "--mesh", "plane", "--spp", "1", "--size", "16x16", "--turntable", "3", "-o", "t_##.png"];
    succeeds(folder.path(), &turn);
    let picture = |index: u32| folder.path().join(format!("t_0{index}.png"));
    let second = fs::read(picture(1)).expect("is there");
    fs::write(picture(0), "kept").expect("is written");
    fs::remove_file(picture(1)).expect("is removed");
    succeeds(folder.path(), &[&turn[..], &["--resume"]].concat());
    assert_eq!(fs::read(picture(0)).expect("is there"), b"kept");
    assert_eq!(fs::read(picture(1)).expect("is there"), second);
}

fn wrong_usage_is_refused() {
    let folder = tempfile::tempdir().expect("is made");
    fs::write(folder.path().join("j.toml"), "material = \"m.zarr\"").expect("is written");
    let refuse = |arguments: &[&str], says: &str| refused(&overpaint(folder.path(), &[&["render"], arguments].concat()), 2, says);
    refuse(&["j.toml"], "nothing says where the picture goes");
    refuse(&["j.toml", "-o", "p.png", "--mesh", "plane"], "a job says what is shown");
    refuse(&["j.toml", "-o", "p.png", "--size", "9x9"], "a job says what is shown");
    refuse(&["m.zarr", "-o", "p.gif"], "expected a name that ends in .png (sRGB) or .exr");
    refuse(&["m.zarr", "-o", "p.png", "--tiling", "2"], "  --mesh <MESH>\n");
    refuse(&["m.zarr", "-o", "p.png", "--resume"], "--resume is for the pictures of a turntable");
    refuse(&["m.zarr", "-o", "p.png", "--mesh", "cube"], "cube is neither a mesh of this program");
    refuse(&["m.zarr", "-o", "p.mp4", "--mesh", "plane"], "a film is of a turntable");
    refuse(&["m.zarr", "-o", "p.png", "--mesh", "plane", "--turntable", "4"], "put #s into the name");
    refuse(&["m.zarr", "-o", "p.png", "--mesh", "plane", "--channels", "depth"], "only an .exr has further channels");
    refuse(&["m.zarr", "-o", "p.png", "--mesh", "plane", "--sun", "1"], "expected AZIMUTH,ELEVATION");
    refuse(&["m.zarr", "-o", "p.png", "--mesh", "plane", "--lamp", "1,2"], "expected X,Y,Z");
}
