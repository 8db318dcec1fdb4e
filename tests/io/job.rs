use std::{fs, path::Path};

use glam::{DVec3, dvec3};
use overpaint::{
    data::{Channel, Light, Projection},
    io,
    model::{TexelSamples, ToneMap},
};

crate::suite! { plain: every_key_is_read, defaults_are_those_of_the_command_line, faults_say_what_and_where; }

fn read(text: &str) -> Result<io::job::Job, String> {
    let folder = tempfile::tempdir().expect("can be made");
    let path = folder.path().join("j.toml");
    fs::write(&path, text).expect("can be written");
    io::job::load(&path).map_err(|error| error.to_string().replace(&format!("{}/", folder.path().display()), ""))
}

fn every_key_is_read() {
    let job = read(
        r#"
material = "cloth.zarr"
recipe = "splash.toml"
output = "out/spot.exr"
size = [640, 480]
channels = ["depth", "texel"]
unpainted = "lpca"
texel_samples = 9
spp = 16
rays = 3
exposure = -1.5
tone_map = "clip"
turntable = 12
mesh = { shape = "torus-knot", tiling = [6, 2.5], silhouettes = true, shadows = false }
camera = { eye = [0, 1, 8], target = [0, 0.5, 0], angle_of_view = 40 }
[[light]]
azimuth = 90
elevation = 0
irradiance = [1, 0.5, 0.25]
[[light]]
place = [1, 2, 3]
irradiance = 4
"#,
    )
    .expect("is a job");
    let name = |path: &Path| path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    assert_eq!(name(&job.material), "cloth.zarr");
    assert_eq!(job.recipe.as_deref().map(name).as_deref(), Some("splash.toml"));
    assert!(job.output.expect("is named").ends_with("out/spot.exr"));
    assert_eq!(job.channels, [Channel::Depth, Channel::Texel]);
    assert_eq!(job.turntable, Some(12));
    assert_eq!((job.development.exposure, job.development.tone_map), (-1.5, ToneMap::Clip));
    let view = job.view;
    assert_eq!((view.tiling, view.silhouette, view.shadows), ([6.0, 2.5], true, false));
    assert_eq!((view.sampling.pictures, view.sampling.rays), (16, 3));
    assert_eq!(view.unpainted, TexelSamples::ALL.into_iter().find(|samples| samples.count() == 9));
    assert_eq!((view.camera.size, view.camera.eye, view.camera.target), ([640, 480], dvec3(0.0, 1.0, 8.0), dvec3(0.0, 0.5, 0.0)));
    assert_eq!(view.camera.projection, Projection::Perspective { field_of_view: 40_f64.to_radians() });
    let Light::Directional { toward, irradiance } = view.lights[0] else { panic!("{:?}", view.lights[0]) };
    assert!(toward.distance(DVec3::X) < 1e-12 && irradiance == [1.0, 0.5, 0.25]);
    assert_eq!(view.lights[1], Light::Point { place: dvec3(1.0, 2.0, 3.0), irradiance: [4.0; 3] });
}

fn defaults_are_those_of_the_command_line() {
    let view = read("material = \"m\"").expect("is a job").view;
    assert_eq!((view.tiling, view.shadows, view.silhouette, view.unpainted), ([1.0; 2], true, false, None));
    assert_eq!((view.lights, view.camera.size), (Light::pair(), [768, 768]));
}

/// A text and what is said of it, without the excerpt.
const WRONG: &[(&str, &str)] = &[
    ("", "j.toml:1:1: a job has no \"material\"; add it, such as material = \"cloth.zarr\""),
    ("material = 3", "j.toml:1:12: \"material\" must be a string, found the number 3"),
    ("material = \"m\"\nsiez = [1, 1]", "j.toml:2:1: unknown key \"siez\" in a job; its keys are material, recipe,"),
    ("material = \"m\"\nsize = [0, 10]", "j.toml:2:8: \"size\" must be from 1 to 32768 each and 134217728 in all, found [0, 10]"),
    ("material = \"m\"\nsize = [32768, 32768]", "j.toml:2:8: \"size\" must be from 1 to 32768 each"),
    ("material = \"m\"\nchannels = [\"dept\"]", "j.toml:2:13: \"channels\" has no \"dept\"; there are depth, normal, painted, thickness, texel"),
    ("material = \"m\"\nmesh = { shape = \"cube\" }", "j.toml:2:18: \"shape\" has no \"cube\"; there are plane, sphere, torus-knot, cloth"),
    ("material = \"m\"\nmesh = { shape = \"plane\", file = \"a.obj\" }", "j.toml:2:34: the mesh has \"shape\" and \"file\"; keep one"),
    ("material = \"m\"\nmesh = { file = \"none.obj\" }", "j.toml:2:17: "),
    ("material = \"m\"\nmesh = { tiling = 0 }", "j.toml:2:19: \"tiling\" must be from 0.001 to 10000, found [0.0, 0.0]"),
    ("material = \"m\"\ncamera = { elevation = 91 }", "j.toml:2:24: \"elevation\" must be from -90 to 90, found 91"),
    ("material = \"m\"\ncamera = { eye = [0, 0, 3], azimuth = 0 }", "j.toml:2:39: the camera has \"eye\" and \"azimuth or elevation\"; keep one"),
    ("material = \"m\"\ncamera = { eye = [1, 0, 0], target = [1, 0, 0] }", "j.toml:2:18: \"eye\" must be another place, found the target itself"),
    ("material = \"m\"\nlight = [{ azimuth = 3 }]", "j.toml:2:10: a light has no \"elevation\"; add it"),
    ("material = \"m\"\nlight = [{ place = [0, 0], irradiance = 1 }]", "j.toml:2:20: \"place\" must be x, y and z, found an array of 2"),
    ("material = \"m\"\nlight = [{ elevation = 1, irradiance = -1 }]", "j.toml:2:40: \"irradiance\" must be from 0 to 1e6, found [-1.0, -1.0, -1.0]"),
    ("material = \"m\"\nspp = 0", "j.toml:2:7: \"spp\" must be from 1 to 4096, found 0"),
    ("material = \"m\"\ntexel_samples = 7", "j.toml:2:17: \"texel_samples\" must be 1, 4, 5, 9 or 25, found 7"),
];

fn faults_say_what_and_where() {
    for (text, expected) in WRONG {
        let Err(found) = read(text) else { panic!("{text} is read") };
        assert!(found.starts_with(expected), "{text}\n expected {expected}\n found {found}");
    }
}
