//! Values as typed on the command line, turned into what a job needs or refused with what was expected.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};

use crate::{
    data::{Block, Direction, RowOrder, Transfer},
    io::{
        export::GltfFormat,
        job::{LEAST_ANGLE, MAX_PIXELS, MAX_SIDE},
    },
    model::{Boundary, SpecularScale, StereoMethod, SurfaceMode, TexelSamples},
};

/// Largest side of a texture that WebGPU guarantees.
pub const MAX_TEXTURE_SIDE: u32 = 8192;

/// `THETA,PHI` in degrees; θ from 0 to below 90.
pub fn direction(text: &str) -> Result<Direction, String> {
    let expected = "expected THETA,PHI in degrees, such as 30,270";
    let (theta, phi) = text.split_once(',').ok_or(expected)?;
    let angle = |text: &str| number(text.trim()).map_err(|_| expected.to_owned());
    let (theta, phi) = (angle(theta)?, angle(phi)?);
    if !(0.0..90.0).contains(&theta) {
        return Err("THETA must be from 0 to below 90 degrees: the direction must be above the surface".to_owned());
    }
    Ok(Direction::from_degrees(theta, phi))
}

/// `AZIMUTH,ELEVATION` in degrees.
pub fn bearing(text: &str) -> Result<[f64; 2], String> {
    let angles = text.split_once(',').and_then(|(azimuth, elevation)| Some([number(azimuth.trim()).ok()?, number(elevation.trim()).ok()?]));
    angles
        .filter(|[_, elevation]| (-90.0..=90.0).contains(elevation))
        .ok_or_else(|| "expected AZIMUTH,ELEVATION in degrees, such as 30,20; ELEVATION from -90 to 90".to_owned())
}

/// A number from `least` to `most`.
pub fn within(least: f64, most: f64) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| {
        let fits = |value: &f64| (least..=most).contains(value);
        number(text).ok().filter(fits).ok_or_else(|| format!("expected a number from {least} to {most}"))
    }
}

/// `X,Y,Z`.
pub fn place(text: &str) -> Result<[f64; 3], String> {
    let place = || {
        let mut parts = text.split(',').map(|part| number(part.trim()).ok());
        let place = [parts.next()??, parts.next()??, parts.next()??];
        (parts.next().is_none() && place.iter().all(|x: &f64| x.abs() <= 1e6)).then_some(place)
    };
    place().ok_or_else(|| "expected X,Y,Z, such as 1,2,3, each at most 1e6".to_owned())
}

/// 0, or degrees up to 170.
pub fn angle_of_view(text: &str) -> Result<f64, String> {
    let fits = |angle: &f64| *angle == 0.0 || (LEAST_ANGLE..=170.0).contains(angle);
    number(text).ok().filter(fits).ok_or_else(|| format!("expected 0, or an angle from {LEAST_ANGLE} to 170 degrees"))
}

/// `WxH` in pixels of one texture.
pub fn size(text: &str) -> Result<[u32; 2], String> {
    sides(text, MAX_TEXTURE_SIDE).ok_or_else(|| format!("expected WxH in pixels, such as 512x512, each side from 1 to {MAX_TEXTURE_SIDE}"))
}

/// `WxH` in pixels of a picture that is drawn in tiles.
pub fn picture_size(text: &str) -> Result<[u32; 2], String> {
    sides(text, MAX_SIDE)
        .filter(|[width, height]| u64::from(*width) * u64::from(*height) <= MAX_PIXELS)
        .ok_or_else(|| format!("expected WxH in pixels, such as 512x512, each side from 1 to {MAX_SIDE} and {MAX_PIXELS} pixels in all"))
}

fn sides(text: &str, most: u32) -> Option<[u32; 2]> {
    let side = |text: &str| text.parse().ok().filter(|side| (1..=most).contains(side));
    text.split_once('x').and_then(|(width, height)| Some([side(width)?, side(height)?]))
}

/// The path of a picture: `.png` or `.exr`.
pub fn image(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let extension = path.extension().and_then(|extension| extension.to_str()).map(str::to_lowercase);
    match extension.as_deref() {
        Some("png" | "exr") => Ok(path),
        _ => Err("expected a name that ends in .png (sRGB) or .exr (linear, 32-bit float)".to_owned()),
    }
}

/// The path of a glTF, and its form by its extension.
pub fn gltf(text: &str) -> Result<(PathBuf, GltfFormat), String> {
    let path = PathBuf::from(text);
    let format = GltfFormat::of(&path).ok_or("expected a name that ends in .glb (one binary file) or .gltf (one JSON file)")?;
    Ok((path, format))
}

/// A finite number.
pub fn number(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(|| "expected a finite number".to_owned())
}

/// A finite number of 0 or more.
pub fn not_negative(text: &str) -> Result<f64, String> {
    number(text).ok().filter(|value| *value >= 0.0).ok_or_else(|| "expected a number of 0 or more".to_owned())
}

/// A finite number above 0.
pub fn positive(text: &str) -> Result<f64, String> {
    number(text).ok().filter(|value| *value > 0.0).ok_or_else(|| "expected a number above 0".to_owned())
}

/// A number above 0 and below 1.
pub fn part(text: &str) -> Result<f64, String> {
    number(text).ok().filter(|value| *value > 0.0 && *value < 1.0).ok_or_else(|| "expected a number above 0 and below 1".to_owned())
}

/// A number from 0 to 1.
pub fn fraction(text: &str) -> Result<f64, String> {
    number(text).ok().filter(|value| (0.0..=1.0).contains(value)).ok_or_else(|| "expected a number from 0 to 1".to_owned())
}

/// "LEAST,GREATEST" of an exponent, 0 < least <= greatest.
pub fn exponents(text: &str) -> Result<[f64; 2], String> {
    let bounds = text.split_once(',').and_then(|(least, greatest)| Some([number(least).ok()?, number(greatest).ok()?]));
    bounds
        .filter(|[least, greatest]| 0.0 < *least && least <= greatest)
        .ok_or_else(|| "expected two numbers above 0, the smaller first, such as 1,1000".to_owned())
}

/// A number above 0 and up to 1.
pub fn roughness(text: &str) -> Result<f64, String> {
    fraction(text).ok().filter(|value| *value > 0.0).ok_or_else(|| "expected a number above 0, up to 1".to_owned())
}

/// A number of 1 or more: a refractive index against air.
pub fn refractive_index(text: &str) -> Result<f64, String> {
    number(text).ok().filter(|value| *value >= 1.0).ok_or_else(|| "expected a number of 1 or more".to_owned())
}

/// `srgb`, `linear` or `gamma:G`.
pub fn transfer(text: &str) -> Result<Transfer, String> {
    match (text, text.strip_prefix("gamma:").map(positive)) {
        ("srgb", _) => Ok(Transfer::Srgb),
        ("linear", _) => Ok(Transfer::Linear),
        (_, Some(Ok(gamma))) => Ok(Transfer::Gamma(gamma)),
        _ => Err("expected srgb, linear, or gamma and a number above 0, such as gamma:2.2".to_owned()),
    }
}

/// Whether the cosine is in the stored values.
pub fn cosine() -> impl TypedValueParser<Value = bool> {
    PossibleValuesParser::new(["included", "excluded"]).map(|name| name == "included")
}

/// [`RowOrder`] by its name.
pub fn rows() -> impl TypedValueParser<Value = RowOrder> {
    PossibleValuesParser::new(["top-down", "bottom-up"]).map(|name| match name.as_str() {
        "bottom-up" => RowOrder::BottomUp,
        _ => RowOrder::TopDown,
    })
}

/// `X,Y,WxH` in texels.
pub fn region(text: &str) -> Result<Block, String> {
    let parse = || {
        let (corner, size) = text.rsplit_once(',')?;
        let ((column, row), (width, height)) = (corner.split_once(',')?, size.split_once('x')?);
        let [column, row, width, height] = [column, row, width, height].map(|number| number.trim().parse().ok());
        Some(Block { column: column?, row: row?, width: width?, height: height? }).filter(|block| block.width > 0 && block.height > 0)
    };
    parse().ok_or_else(|| "expected X,Y,WxH in texels, such as 64,0,128x128, W and H of 1 or more".to_owned())
}

/// `X,Y`: column and row of a texel.
pub fn texel(text: &str) -> Result<[usize; 2], String> {
    let parse = || text.split_once(',').and_then(|(column, row)| Some([column.trim().parse().ok()?, row.trim().parse().ok()?]));
    parse().ok_or_else(|| "expected X,Y: column and row from the upper left, such as 20,31".to_owned())
}

/// An integer of 1 or more.
pub fn step(text: &str) -> Result<usize, String> {
    text.parse().ok().filter(|step| *step > 0).ok_or_else(|| "expected an integer of 1 or more".to_owned())
}

/// An angle from the normal in degrees, from 0 to 90.
pub fn angle_from_normal(text: &str) -> Result<f64, String> {
    number(text).ok().filter(|angle| (0.0..=90.0).contains(angle)).ok_or_else(|| "expected an angle from 0 to 90 degrees".to_owned())
}

/// [`Boundary`] by its name.
pub fn boundary() -> impl TypedValueParser<Value = Boundary> {
    PossibleValuesParser::new(["periodic", "mirror"]).map(|name| match name.as_str() {
        "mirror" => Boundary::Mirror,
        _ => Boundary::Periodic,
    })
}

/// [`TexelSamples`] by their number.
pub fn texel_samples() -> impl TypedValueParser<Value = TexelSamples> {
    PossibleValuesParser::new(["1", "4", "5", "9", "25"])
        .map(|count| TexelSamples::ALL.into_iter().find(|samples| samples.count().to_string() == count).unwrap_or_default())
}

/// [`SpecularScale`] by its name.
pub fn specular_scale() -> impl TypedValueParser<Value = SpecularScale> {
    PossibleValuesParser::new(["least-squares", "mean-ratio"]).map(|name| match name.as_str() {
        "mean-ratio" => SpecularScale::MeanRatio,
        _ => SpecularScale::LeastSquares,
    })
}

/// [`StereoMethod`] by its name.
pub fn stereo_method() -> impl TypedValueParser<Value = StereoMethod> {
    PossibleValuesParser::new(["robust", "least-squares"]).map(|name| match name.as_str() {
        "least-squares" => StereoMethod::LeastSquares,
        _ => StereoMethod::Robust,
    })
}

/// [`SurfaceMode`] by its name.
pub fn surface() -> impl TypedValueParser<Value = SurfaceMode> {
    PossibleValuesParser::new(["auto", "flat", "rough", "local"]).map(|name| match name.as_str() {
        "flat" => SurfaceMode::Flat,
        "rough" => SurfaceMode::Rough,
        "local" => SurfaceMode::Local,
        _ => SurfaceMode::Auto,
    })
}
