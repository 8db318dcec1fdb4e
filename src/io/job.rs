//! Jobs: pictures of a mesh that wears a material, as a TOML file.
//!
//! | key | what it is |
//! |---|---|
//! | `material` | the material, beside the job or by a path from there; must be there |
//! | `recipe` | the paint on it ([recipes](super::recipe)); default none, what the material has stays |
//! | `output` | the picture; default what the command line names |
//! | `size` | columns and rows of the picture; default `[768, 768]` |
//! | `channels` | what an `.exr` has beside its colours, of `"depth"`, `"normal"`, `"painted"`, `"thickness"`, `"texel"`; default none |
//! | `unpainted` | what the bare part is made from, `"svbrdf"` or `"lpca"`; default `"svbrdf"` |
//! | `texel_samples` | of the local PCA, the texels that a place is interpolated from: 1, 4, 5, 9 or 25; default 5 |
//! | `spp` | rays a pixel, each a picture of its own, 1 to 4096; default 4 |
//! | `rays` | further rays across a pixel, and down it, at most, where it covers several texels, 1 to 16; default 2 |
//! | `exposure` | powers of two that a `.png` is brighter by, -20 to 20; default 0 |
//! | `tone_map` | of a `.png`, `"neutral"` or `"clip"`; default `"neutral"` |
//! | `turntable` | pictures of a whole turn, 1 to 100000; default none |
//! | `mesh` | the mesh, a table; default a sphere |
//! | `camera` | where it is seen from, a table; default from the front, a little above |
//! | `light` | what shines on it, up to 32 tables, each headed by `[[light]]`; default one from the upper left and a weak one from the right, or none if there is an environment |
//! | `environment` | what is around it, a table; default nothing |
//!
//! | key of `mesh` | what it is |
//! |---|---|
//! | `shape` | `"plane"`, `"sphere"`, `"torus-knot"` or `"cloth"` |
//! | `file` | an OBJ or glTF file instead, beside the job or by a path from there |
//! | `tiling` | pieces of the material per unit of texture coordinates, across and up, or one number for both; default 1 |
//! | `silhouettes` | `true` if rays that leave the sheet of texture coordinates 0 to 1 see through it; default `false` |
//! | `shadows` | `false` if the mesh throws none; default `true` |
//!
//! | key of `camera` | what it is |
//! |---|---|
//! | `azimuth`, `elevation` | where it stands, degrees: from the front to the right, and up; the whole mesh is seen; default 30 and 20 |
//! | `eye`, `target` | where it stands and looks instead, in units of the mesh |
//! | `angle_of_view` | degrees between the upper and the lower edge, up to 170; 0 for parallel rays; default 30 |
//!
//! | key of `light` | what it is |
//! |---|---|
//! | `azimuth`, `elevation` | of a light far away, as a camera's |
//! | `place` | of a light near by, in units of the mesh |
//! | `irradiance` | on a surface that faces it, one number or red, green and blue: under 1 white reads 1; of a light near by at distance 1; default 1 |
//!
//! | key of `environment` | what it is |
//! |---|---|
//! | `name` | `"studio"` or `"sky"` |
//! | `file` | an equirectangular picture in linear light instead, Radiance HDR or OpenEXR |
//! | `strength` | factor on its light, 0.000001 to 1000000; default 1 |
//! | `turn` | about the vertical axis, its front to the right, in degrees; default 0 |
//!
//! World and meshes: x right, y up, z towards the viewer.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use glam::DVec3;

use super::{
    IoError, mesh,
    recipe::{Document, Outcome, Placed, RecipeFault, Table, Value, read},
};
use crate::{
    data::{Camera, Channel, Environment, Light, Mesh, MeshView, Projection, Sampling, Shape, Surroundings},
    model::{Development, TexelSamples, ToneMap},
};

/// The most lights.
pub const MAX_LIGHTS: usize = 32;

/// Pictures of a mesh, and what they are made of.
#[derive(Debug, Clone)]
pub struct Job {
    /// The material.
    pub material: PathBuf,
    /// The paint on it.
    pub recipe: Option<PathBuf>,
    /// Where the picture goes.
    pub output: Option<PathBuf>,
    /// The mesh, and how it is looked at.
    pub view: MeshView,
    /// What the picture has beside its colours.
    pub channels: Vec<Channel>,
    /// What a screen shows of its light.
    pub development: Development,
    /// Pictures of a whole turn.
    pub turntable: Option<u32>,
    /// What was made up for the mesh.
    pub warnings: Vec<String>,
}

/// Reads a job and the mesh that it names.
///
/// # Errors
/// [`IoError::Recipe`] with file, line and column of what is wrong; others if the job itself cannot be read.
pub fn load(path: &Path) -> Result<Job, IoError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let bytes = read(path)?;
    let name = path.display().to_string();
    let document = Document::new(&name, &bytes)?;
    let entries = document.parse()?;
    let keys = [
        "material",
        "recipe",
        "output",
        "size",
        "channels",
        "unpainted",
        "texel_samples",
        "spp",
        "rays",
        "exposure",
        "tone_map",
        "turntable",
        "mesh",
        "camera",
        "light",
        "environment",
    ];
    let root = Table::new("a job", 0..0, &entries).only(&keys);
    root.and_then(|root| job(&root, folder)).map_err(|placed| document.error(placed).into())
}

fn job(root: &Table<'_>, folder: &Path) -> Outcome<Job> {
    let path = |value: Value<'_>| Ok::<_, Placed>(folder.join(value.path()?));
    let size = root.get("size").map_or(Ok([768, 768]), size)?;
    let table = root.get("mesh").map(|value| value.table("the mesh")).transpose()?;
    let (mesh, mut warnings) = table.as_ref().map_or_else(|| Ok((Shape::Sphere.mesh(), Vec::new())), |table| named_mesh(table, folder))?;
    let lights = match root.get("light") {
        None if root.get("environment").is_some() => Vec::new(),
        None => Light::pair(),
        Some(value) => {
            let lights = value.elements("an array of tables, each headed by [[light]]")?;
            if let Some(one) = lights.get(MAX_LIGHTS) {
                return Err(one.fault(RecipeFault::TooMany { found: lights.len(), what: "lights", most: MAX_LIGHTS }));
            }
            lights.into_iter().map(light).collect::<Outcome<_>>()?
        }
    };
    let turning = root.get("turntable").is_some();
    let camera = match root.get("camera") {
        None => Camera::showing(&mesh, MeshView::BEARING, MeshView::ANGLE_OF_VIEW, size, turning),
        Some(value) => camera(&value.table("the camera")?, &mesh, size, turning)?,
    };
    let texel_samples = root.get("texel_samples").map(texel_samples).transpose()?;
    let (surroundings, told) = match root.get("environment") {
        None => (None, Vec::new()),
        Some(value) => surroundings(&value.table("the environment")?, folder)?,
    };
    warnings.extend(told);
    let view = MeshView {
        surroundings,
        tiling: table.as_ref().and_then(|table| table.get("tiling")).map_or(Ok([1.0; 2]), tiling)?,
        shadows: table.as_ref().and_then(|table| table.get("shadows")).map_or(Ok(true), Value::flag)?,
        silhouette: table.as_ref().map_or(Ok(false), |table| table.flag("silhouettes"))?,
        unpainted: choice(root, "unpainted", &[("svbrdf", false), ("lpca", true)])?.then(|| texel_samples.unwrap_or_default()),
        sampling: Sampling { pictures: whole(root, "spp", 4, 4096)?, rays: whole(root, "rays", Sampling::default().rays, 16)? },
        ..MeshView::new(mesh, camera, lights)
    };
    let channels = match root.get("channels") {
        None => Vec::new(),
        Some(value) => distinct(value.elements("an array of names")?.into_iter().map(channel).collect::<Outcome<_>>()?),
    };
    let exposure = root.number("exposure", 0.0)?;
    let tone_map = choice(root, "tone_map", &[("neutral", ToneMap::Neutral), ("clip", ToneMap::Clip)])?;
    Ok(Job {
        material: path(root.need("material", "material = \"cloth.zarr\"")?)?,
        recipe: root.get("recipe").map(path).transpose()?,
        output: root.get("output").map(path).transpose()?,
        view,
        channels,
        development: Development { exposure: within(root, "exposure", exposure, [-20.0, 20.0])?, tone_map },
        turntable: root.get("turntable").map(|_| whole(root, "turntable", 1, 100_000)).transpose()?,
        warnings,
    })
}

fn named_mesh(table: &Table<'_>, folder: &Path) -> Outcome<(Mesh, Vec<String>)> {
    table.check(&["shape", "file", "tiling", "silhouettes", "shadows"])?;
    match (table.get("shape"), table.get("file")) {
        (Some(_), Some(file)) => Err(file.fault(RecipeFault::Both { of: "the mesh".to_owned(), first: "shape", second: "file" })),
        (None, Some(file)) => {
            let loaded = mesh::load(&folder.join(file.path()?)).map_err(|error| file.fault(RecipeFault::File(Box::new(error))))?;
            Ok((loaded.mesh, loaded.warnings.iter().map(ToString::to_string).collect()))
        }
        _ => Ok((choice(table, "shape", &Shape::ALL.map(|shape| (shape.name(), shape)))?.mesh(), Vec::new())),
    }
}

/// An environment by its name, `studio` or `sky`, or from a file, and what was mended of it.
///
/// # Errors
/// [`IoError`] if the file is no environment.
pub fn environment(name: &Path) -> Result<(Environment, Vec<String>), IoError> {
    match name.to_str() {
        Some("studio") => Ok((Environment::studio(), Vec::new())),
        Some("sky") => Ok((Environment::sky(), Vec::new())),
        _ => super::environment::load(name).map(|loaded| (loaded.environment, loaded.warnings)),
    }
}

fn surroundings(table: &Table<'_>, folder: &Path) -> Outcome<(Option<Surroundings>, Vec<String>)> {
    table.check(&["name", "file", "strength", "turn"])?;
    let (environment, warnings) = match (table.get("name"), table.get("file")) {
        (Some(_), Some(file)) => {
            return Err(file.fault(RecipeFault::Both { of: table.what().to_owned(), first: "name", second: "file" }));
        }
        (None, Some(file)) => environment(&folder.join(file.path()?)).map_err(|error| file.fault(RecipeFault::File(Box::new(error))))?,
        _ => (choice(table, "name", &[("studio", Environment::studio as fn() -> _), ("sky", Environment::sky)])?(), Vec::new()),
    };
    let strength = within(table, "strength", table.number("strength", 1.0)?, [1e-6, 1e6])?;
    let turn = within(table, "turn", table.number("turn", 0.0)?, [-36_000.0, 36_000.0])?.to_radians();
    Ok((Some(Surroundings { environment: Arc::new(environment), strength, turn }), warnings))
}

fn camera(table: &Table<'_>, mesh: &Mesh, size: [u32; 2], turning: bool) -> Outcome<Camera> {
    table.check(&["azimuth", "elevation", "eye", "target", "angle_of_view"])?;
    let angle = within(table, "angle_of_view", table.number("angle_of_view", MeshView::ANGLE_OF_VIEW)?, [0.0, 170.0])?;
    if angle > 0.0 {
        within(table, "angle_of_view", angle, [LEAST_ANGLE, 170.0])?;
    }
    let Some(eye) = table.get("eye") else {
        if let Some(target) = table.get("target") {
            return Err(target.fault(RecipeFault::Missing { key: "eye", of: table.what().to_owned(), example: "eye = [0, 1, 4]" }));
        }
        return Ok(Camera::showing(mesh, bearing(table, MeshView::BEARING)?, angle, size, turning));
    };
    if let Some(value) = table.get("azimuth").or(table.get("elevation")) {
        return Err(value.fault(RecipeFault::Both { of: table.what().to_owned(), first: "eye", second: "azimuth or elevation" }));
    }
    let (center, radius) = mesh.ball();
    let place = vector(eye)?;
    let target = table.get("target").map_or(Ok(center), vector)?;
    let distance = place.distance(target);
    if distance > FARTHEST * radius {
        let expected = format!("at most {FARTHEST} times the mesh's radius from the target");
        return Err(eye.fault(RecipeFault::Bounds { key: "eye".to_owned(), found: place.to_string(), expected }));
    }
    if distance < 1e-6 * radius {
        return Err(eye.fault(RecipeFault::Bounds {
            key: "eye".to_owned(),
            found: "the target itself".to_owned(),
            expected: "another place".to_owned(),
        }));
    }
    let forward = (target - place) / distance;
    // The ball's depths, as near as single precision serves.
    let along = (center - place).dot(forward);
    let farthest = (along + Camera::ROOM * radius).max(1e-3 * radius);
    let nearest = (along - Camera::ROOM * radius).max(1e-4 * farthest);
    let up = if forward.y.abs() > 1.0 - 1e-9 { DVec3::Z * forward.y.signum() } else { DVec3::Y };
    // By parallel rays the plane through the target is as high as through a lens of 30 degrees.
    let height = 2.0 * distance * (0.5 * MeshView::ANGLE_OF_VIEW.to_radians()).tan();
    Ok(Camera { eye: place, target, up, projection: Projection::by_angle(angle, height), depths: [nearest, farthest], size })
}

/// The same channels, each once.
#[must_use]
pub fn distinct(channels: Vec<Channel>) -> Vec<Channel> {
    let mut once = Vec::new();
    for channel in channels {
        if !once.contains(&channel) {
            once.push(channel);
        }
    }
    once
}

/// Radii of the mesh that an eye may be away: beyond it depths in single precision run together.
const FARTHEST: f64 = 1e4;
/// Degrees of the narrowest angle of view that is none of parallel rays, for the same reason.
pub const LEAST_ANGLE: f64 = 0.1;

fn light(value: Value<'_>) -> Outcome<Light> {
    let table = value.table("a light")?;
    table.check(&["azimuth", "elevation", "place", "irradiance"])?;
    let irradiance = match table.get("irradiance") {
        None => [1.0; 3],
        Some(value) if value.is_array() => numbers(value, "red, green and blue")?,
        Some(value) => [value.number()?; 3],
    };
    if irradiance.iter().any(|value| !(0.0..=1e6).contains(value)) {
        let fault =
            RecipeFault::Bounds { key: "irradiance".to_owned(), found: format!("{irradiance:?}"), expected: "from 0 to 1e6".to_owned() };
        return Err(table.fault_at("irradiance", fault));
    }
    match table.get("place") {
        Some(place) if table.get("azimuth").or(table.get("elevation")).is_some() => {
            Err(place.fault(RecipeFault::Both { of: table.what().to_owned(), first: "place", second: "azimuth or elevation" }))
        }
        Some(place) => Ok(Light::Point { place: vector(place)?, irradiance }),
        None => {
            table.need("elevation", "azimuth = -40, elevation = 50")?;
            Ok(Light::sun(bearing(&table, [0.0; 2])?, irradiance))
        }
    }
}

/// Azimuth and elevation, degrees.
fn bearing(table: &Table<'_>, [azimuth, elevation]: [f64; 2]) -> Outcome<[f64; 2]> {
    let azimuth = within(table, "azimuth", table.number("azimuth", azimuth)?, [-36_000.0, 36_000.0])?;
    Ok([azimuth, within(table, "elevation", table.number("elevation", elevation)?, [-90.0, 90.0])?])
}

fn size(value: Value<'_>) -> Outcome<[u32; 2]> {
    let [width, height] = value.array::<2>("columns and rows")?;
    let size = [width.whole()?, height.whole()?];
    let expected = format!("from 1 to {MAX_SIDE} each and {MAX_PIXELS} in all");
    let fits = size.iter().all(|side| (1..=MAX_SIDE).contains(side)) && u64::from(size[0]) * u64::from(size[1]) <= MAX_PIXELS;
    if fits { Ok(size) } else { Err(value.fault(RecipeFault::Bounds { key: "size".to_owned(), found: format!("{size:?}"), expected })) }
}

/// Columns or rows of a picture at most.
pub const MAX_SIDE: u32 = 32_768;
/// Pixels of a picture at most: 2 GiB as the host holds it, and as much again while a file is made of it.
pub const MAX_PIXELS: u64 = 1 << 27;

fn tiling(value: Value<'_>) -> Outcome<[f64; 2]> {
    let tiling = if value.is_array() { numbers(value, "across and up")? } else { [value.number()?; 2] };
    let fits = tiling.iter().all(|pieces| (1e-3..=1e4).contains(pieces));
    let expected = "from 0.001 to 10000".to_owned();
    if fits {
        Ok(tiling)
    } else {
        Err(value.fault(RecipeFault::Bounds { key: "tiling".to_owned(), found: format!("{tiling:?}"), expected }))
    }
}

fn texel_samples(value: Value<'_>) -> Outcome<TexelSamples> {
    let count = value.whole()?;
    let found = TexelSamples::ALL.into_iter().find(|samples| samples.count() as u64 == u64::from(count));
    let fault = RecipeFault::Bounds { key: "texel_samples".to_owned(), found: count.to_string(), expected: "1, 4, 5, 9 or 25".to_owned() };
    found.ok_or_else(|| value.fault(fault))
}

fn channel(value: Value<'_>) -> Outcome<Channel> {
    let name = value.text()?;
    Channel::ALL.into_iter().find(|channel| channel.name() == name).ok_or_else(|| {
        let known = Channel::ALL.map(Channel::name).join(", ");
        value.fault(RecipeFault::Choice { key: "channels".to_owned(), found: name.to_owned(), known })
    })
}

fn vector(value: Value<'_>) -> Outcome<DVec3> {
    let vector = DVec3::from_array(numbers(value, "x, y and z")?);
    let expected = "no farther than 1e6 from the origin".to_owned();
    if vector.length() <= 1e6 {
        Ok(vector)
    } else {
        Err(value.fault(RecipeFault::Bounds { key: value.key().to_owned(), found: vector.to_string(), expected }))
    }
}

fn numbers<const N: usize>(value: Value<'_>, what: &'static str) -> Outcome<[f64; N]> {
    let mut numbers = [0.0; N];
    for (number, element) in numbers.iter_mut().zip(value.array::<N>(what)?) {
        *number = element.number()?;
    }
    Ok(numbers)
}

fn within(table: &Table<'_>, key: &'static str, found: f64, [least, most]: [f64; 2]) -> Outcome<f64> {
    if (least..=most).contains(&found) {
        return Ok(found);
    }
    let fault = RecipeFault::Bounds { key: key.to_owned(), found: found.to_string(), expected: format!("from {least} to {most}") };
    Err(table.fault_at(key, fault))
}

fn whole(table: &Table<'_>, key: &'static str, default: u32, most: u32) -> Outcome<u32> {
    let found = table.whole(key, default)?;
    within(table, key, f64::from(found), [1.0, f64::from(most)])?;
    Ok(found)
}

/// One of several by name, the first if the key is not there.
fn choice<T: Copy>(table: &Table<'_>, key: &'static str, choices: &[(&str, T)]) -> Outcome<T> {
    let Some(value) = table.get(key) else { return Ok(choices[0].1) };
    let name = value.text()?;
    choices.iter().find(|(known, _)| *known == name).map(|(_, choice)| *choice).ok_or_else(|| {
        let known = choices.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
        value.fault(RecipeFault::Choice { key: key.to_owned(), found: name.to_owned(), known })
    })
}
