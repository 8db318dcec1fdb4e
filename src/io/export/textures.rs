//! A material as the textures of glTF's metallic-roughness model, 8 bits a channel. The physics is `model::metallic_roughness`.

use std::path::Path;

use image::ExtendedColorType::{self, Rgb8, Rgba8};

use crate::{
    data::{Material, Painted},
    io::{IoError, picture::encoded_png},
    model::{
        MetallicRoughness,
        color::srgb_from_linear,
        metallic_roughness::{DIELECTRIC, Part},
    },
};

/// PNG files, row 0 at the top.
pub(super) struct Textures {
    /// Base colour, sRGB.
    pub base_color: Vec<u8>,
    /// Normals, (1 + x)/2, (1 + y)/2, (1 + z)/2.
    pub normal: Vec<u8>,
    /// √α in G; metal, of which there is none, in B.
    pub metallic_roughness: Vec<u8>,
    /// F₀ in units of F₉₀, of the refractive index 1.5 and of the factor, sRGB; F₉₀ in A.
    pub specular: Vec<u8>,
    /// By which F₀ is multiplied.
    pub specular_color_factor: f32,
    /// Share of texels whose base colour is above 1 in a channel, and held to it.
    pub clipped_base_color: f64,
    /// Share of texels whose F₀ is above 1 in a channel, and held to it.
    pub clipped_f0: f64,
}

impl Textures {
    /// The textures of `material`, for the file `path`.
    pub(super) fn of(path: &Path, material: &Material) -> Result<Self, IoError> {
        let size @ [width, height] = material.size();
        let normals = material.painted.as_ref().map_or(&material.normal, |painted| &painted.normal);
        let mut texels = Vec::with_capacity(width * height);
        for (column, row) in (0..height).flat_map(|row| (0..width).map(move |column| (column, row))) {
            let texel = texel(material, (column, row)).filter(|_| normals[(column, row)].iter().all(|value| value.is_finite()));
            texels.push(texel.ok_or_else(|| IoError::NotANumber { path: path.to_owned(), column, row })?);
        }
        let clipped = |value: fn(&MetallicRoughness) -> [f64; 3]| {
            let above = texels.iter().filter(|texel| value(texel).iter().any(|value| *value > 1.0)).count();
            above as f64 / texels.len() as f64
        };
        let most = texels.iter().flat_map(specular_color).fold(0.0, f64::max);
        // A texture of nothing but zeros may have any factor.
        let factor = if most > 0.0 { most } else { 1.0 };
        let png = |codes: Vec<u8>, color: ExtendedColorType| encoded_png(path, &codes, size, color);
        #[expect(clippy::cast_possible_truncation, reason = "to the nearest f32")]
        let specular_color_factor = factor as f32;
        Ok(Self {
            base_color: png(texels.iter().flat_map(|texel| texel.base_color.map(srgb_code)).collect(), Rgb8)?,
            normal: png(normals.values().iter().flat_map(|normal| normal_codes(*normal)).collect(), Rgb8)?,
            metallic_roughness: png(texels.iter().flat_map(|texel| [0, code(texel.alpha.sqrt()), 0]).collect(), Rgb8)?,
            specular: png(texels.iter().flat_map(|texel| specular_codes(texel, factor)).collect(), Rgba8)?,
            specular_color_factor,
            clipped_base_color: clipped(|texel| texel.base_color),
            clipped_f0: clipped(|texel| texel.f0),
        })
    }
}

/// The texel at (column, row), if all that it is made of are finite numbers.
fn texel(material: &Material, at: (usize, usize)) -> Option<MetallicRoughness> {
    let svbrdf = &material.svbrdf;
    let lobes = svbrdf.lobes.iter().map(|lobe| Some((finite(lobe.specular[at])?, finite(lobe.parameters[at])?)));
    let bare = Part::bare(finite(svbrdf.diffuse[at])?, lobes.collect::<Option<Vec<_>>>()?);
    let Some(Painted { method, reflectance, coverage, coat, .. }) = &material.painted else { return Some(bare.into()) };
    let paint = Part::painted(*method, finite(reflectance[at])?, finite(coat[at])?);
    let [coverage] = finite([coverage[at]])?;
    Some(bare.mixed(paint, coverage).into())
}

fn finite<const N: usize>(values: [f32; N]) -> Option<[f64; N]> {
    values.iter().all(|value| value.is_finite()).then(|| values.map(f64::from))
}

/// What the extension multiplies F₀ of refractive index 1.5 by, before it multiplies all by F₉₀.
fn specular_color(texel: &MetallicRoughness) -> [f64; 3] {
    if texel.f90 > 0.0 { texel.f0.map(|f0| f0.min(1.0) / (texel.f90 * DIELECTRIC)) } else { [1.0; 3] }
}

fn specular_codes(texel: &MetallicRoughness, factor: f64) -> [u8; 4] {
    let [r, g, b] = specular_color(texel).map(|value| srgb_code(value / factor));
    [r, g, b, code(texel.f90)]
}

/// Codes of a normal; 0 becomes 128, and what points down lies flat.
fn normal_codes([x, y, z]: [f32; 3]) -> [u8; 3] {
    [x, y, z.max(0.0)].map(|value| code(0.5 * (f64::from(value) + 1.0)))
}

fn srgb_code(value: f64) -> u8 {
    code(srgb_from_linear(value.clamp(0.0, 1.0)))
}

/// The nearest of 256 codes from 0 to 1.
fn code(value: f64) -> u8 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "held to 0..=1 before")]
    let code = (255.0 * value.clamp(0.0, 1.0)).round() as u8;
    code
}
