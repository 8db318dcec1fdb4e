//! A mesh that wears a material as glTF 2.0: metallic-roughness without metal, with `KHR_materials_specular`.
//!
//! | texture | what it holds |
//! |---|---|
//! | `baseColorTexture` | diffuse reflectance, painted over bare by coverage |
//! | `normalTexture` | normals of the painted surface: x to growing u, y up, z out, as here (OpenGL's convention) |
//! | `metallicRoughnessTexture` | √α of the coat and the lobes together |
//! | `specularColorTexture`, `specularTexture` | F₀ and F₉₀, in one image |
//!
//! A viewer without the extension shows F₀ = 0.04 and F₉₀ = 1. Texture coordinates hold the tiling; v runs down in glTF, so that 1 - v is
//! written. The tangents are for the image as it is seen, y up, in glTF as here, and stay. A `.gltf` holds its buffer and images itself, as
//! base64, so that one file is all there is.

use std::{collections::BTreeMap, path::Path};

use base64::{Engine, engine::general_purpose};
use gltf::{
    binary::{Glb, Header},
    json::{
        Asset, Index, Material as GltfMaterial, Mesh as GltfMesh, Node, Scene, extensions,
        extensions::material::{Specular, SpecularColorFactor},
        material::{NormalTexture, PbrMetallicRoughness, StrengthFactor},
        mesh::{Mode, Primitive, Semantic},
        validation::Checked::Valid,
    },
};
use serde_json::{json, value::to_raw_value};

use super::{document::Document, textures::Textures};
use crate::{
    data::{Material, Mesh},
    io::IoError,
    model::{Frame, PaintMethod},
};

/// The two forms of a glTF.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GltfFormat {
    /// `.glb`: one binary file.
    Binary,
    /// `.gltf`: one JSON file.
    Json,
}

impl GltfFormat {
    /// The form of a file by its extension.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_ascii_lowercase().to_str()? {
            "glb" => Some(Self::Binary),
            "gltf" => Some(Self::Json),
            _ => None,
        }
    }
}

const SPECULAR: &str = "KHR_materials_specular";

/// Writes `mesh` wearing `material`, `tiling` pieces of it per unit of texture coordinates. Returns what the file does not tell of the
/// material, a sentence each; the file says it, too, in its asset's extras.
///
/// # Errors
/// [`IoError::NotANumber`] if a texel of the material is none, [`IoError::TooLargeGlb`] if a `.glb` would be, and [`IoError::Write`].
pub fn write_gltf(path: &Path, format: GltfFormat, material: &Material, mesh: &Mesh, tiling: f64) -> Result<Vec<String>, IoError> {
    let textures = Textures::of(path, material)?;
    let lost = lost(material, &textures);
    let failed = |error: serde_json::Error| IoError::Write { path: path.to_owned(), source: error.into() };
    let extras = json!({"source": material.provenance.source, "lost": lost});

    let mut document = Document::default();
    document.root.asset = Asset {
        generator: Some(concat!("overpaint ", env!("CARGO_PKG_VERSION")).to_owned()),
        extras: Some(to_raw_value(&extras).map_err(failed)?),
        ..Asset::default()
    };
    document.root.extensions_used = vec![SPECULAR.to_owned()];
    let material = add_material(&mut document, &material.provenance.source, &textures);
    add_mesh(&mut document, mesh, material, tiling);

    let bytes = match format {
        GltfFormat::Json => {
            let uri = format!("data:application/octet-stream;base64,{}", general_purpose::STANDARD.encode(&document.bytes));
            document.finish(Some(uri)).map_err(failed)?.0
        }
        GltfFormat::Binary => {
            let (json, bin) = document.finish(None).map_err(failed)?;
            // Two chunks with their heads, and what fills them up to a multiple of 4.
            let length = json.len() + bin.len() + 12 + 2 * (8 + 3);
            if u32::try_from(length).is_err() {
                return Err(IoError::TooLargeGlb { path: path.to_owned(), bytes: length });
            }
            // The crate computes the length.
            let header = Header { magic: *b"glTF", version: 2, length: 0 };
            let glb = Glb { header, json: json.into(), bin: Some(bin.into()) };
            glb.to_vec().map_err(|error| IoError::Write { path: path.to_owned(), source: std::io::Error::other(error) })?
        }
    };
    crate::io::write(path, &bytes)?;
    Ok(lost)
}

fn add_material(document: &mut Document, name: &str, textures: &Textures) -> Index<GltfMaterial> {
    let base_color = document.texture("base color", &textures.base_color);
    let normal = document.texture("normal", &textures.normal);
    let metallic_roughness = document.texture("metallic roughness", &textures.metallic_roughness);
    let specular = document.texture("specular", &textures.specular);
    document.root.push(GltfMaterial {
        name: Some(name.to_owned()),
        // A sheet of cloth has two sides.
        double_sided: true,
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_texture: Some(base_color),
            metallic_factor: StrengthFactor(0.0),
            metallic_roughness_texture: Some(metallic_roughness),
            ..PbrMetallicRoughness::default()
        },
        normal_texture: Some(NormalTexture { index: normal.index, scale: 1.0, tex_coord: 0, extensions: None, extras: None }),
        extensions: Some(extensions::material::Material {
            specular: Some(Specular {
                specular_texture: Some(specular.clone()),
                specular_color_texture: Some(specular),
                specular_color_factor: SpecularColorFactor([textures.specular_color_factor; 3]),
                ..Specular::default()
            }),
        }),
        ..GltfMaterial::default()
    })
}

fn add_mesh(document: &mut Document, mesh: &Mesh, material: Index<GltfMaterial>, tiling: f64) {
    #[expect(clippy::cast_possible_truncation, reason = "to the nearest f32")]
    let tiled = |[u, v]: &[f32; 2]| [(tiling * f64::from(*u)) as f32, (1.0 - tiling * f64::from(*v)) as f32];
    let texture_coordinates: Vec<_> = mesh.texture_coordinates().iter().map(tiled).collect();
    let attributes = BTreeMap::from([
        (Valid(Semantic::Positions), document.vertices(mesh.positions(), Some(mesh.bounds()))),
        (Valid(Semantic::Normals), document.vertices(mesh.normals(), None)),
        (Valid(Semantic::Tangents), document.vertices(mesh.tangents(), None)),
        (Valid(Semantic::TexCoords(0)), document.vertices(&texture_coordinates, None)),
    ]);
    let indices = document.triangles(mesh.triangles());
    let primitive = Primitive {
        attributes,
        indices: Some(indices),
        material: Some(material),
        mode: Valid(Mode::Triangles),
        targets: None,
        extensions: None,
        extras: None,
    };
    let mesh = document.root.push(GltfMesh { primitives: vec![primitive], name: None, weights: None, extensions: None, extras: None });
    let node = document.root.push(Node { mesh: Some(mesh), ..Node::default() });
    document.root.scene = Some(document.root.push(Scene { nodes: vec![node], name: None, extensions: None, extras: None }));
}

/// What the file does not tell of the material.
fn lost(material: &Material, textures: &Textures) -> Vec<String> {
    let mut lost = vec!["relief is in the normals alone: no parallax, no silhouettes, no shadows on itself".to_owned()];
    let coverage = |texel: usize| material.painted.as_ref().map_or(0.0, |painted| painted.coverage.values()[texel]);
    let texels = material.height.values().len();
    let bare = (0..texels).filter(|&texel| coverage(texel) < 1.0).count();
    if bare > 0 {
        let lobes = &material.svbrdf.lobes;
        let is_retro = |texel: usize| {
            let of_lobe = lobes.iter().map(|lobe| (lobe.specular.values()[texel], lobe.parameters.values()[texel]));
            let reflects = |specular: [f32; 3]| specular.iter().any(|value| *value > 0.0);
            of_lobe.into_iter().any(|(specular, [x, y, ..])| reflects(specular) && (x > 0.0 || y > 0.0))
        };
        let retro = (0..texels).filter(|&texel| coverage(texel) < 1.0 && is_retro(texel)).count();
        lost.push(format!(
            "the bare part ({} % of texels) is a diffuse color under one round GGX lobe of the same albedo in place of {}{}{}",
            percent(bare as f64 / texels as f64),
            if lobes.len() == 1 { "a Lafortune lobe".to_owned() } else { format!("{} Lafortune lobes", lobes.len()) },
            if material.lpca.is_some() { " and the local PCA of the original" } else { "" },
            if retro > 0 {
                format!("; in {} % of them light was sent back to where it came from", percent(retro as f64 / bare as f64))
            } else {
                String::new()
            },
        ));
        if material.svbrdf.frame == Frame::Plane {
            lost.push("the bare part's reflectance is that of a plane; it is shaded by normals that it was not fitted with".to_owned());
        }
    }
    if material.svbrdf.ambient > 0.0 {
        let ambient = percent(material.svbrdf.ambient);
        lost.push(format!("light that the relief throws into its own shadows, {ambient} % of what falls on the plane, is left out"));
    }
    if material.painted.as_ref().is_some_and(|painted| painted.method == PaintMethod::AlphaBlend) {
        lost.push("paint that is blended in as a flat color is shaded by the normals".to_owned());
    }
    for (what, share) in [("a base color", textures.clipped_base_color), ("a reflectance at normal incidence", textures.clipped_f0)] {
        if share > 0.0 {
            lost.push(format!("{} % of texels have {what} above 1, held to 1", percent(share)));
        }
    }
    lost.push("maps have 8 bits a channel: normals to 0.4 degrees, colors to a code of sRGB".to_owned());
    lost.push(format!("a viewer without {SPECULAR} shows a refractive index of 1.5 everywhere"));
    lost
}

/// A share in percent, to a tenth; never 0 for what there is.
fn percent(share: f64) -> String {
    format!("{:.1}", (100.0 * share).max(0.1))
}
