//! `overpaint export`.

use std::path::PathBuf;

use clap::{ArgGroup, Args};

use super::{CliError, arguments, mesh, output, say};
use crate::io::{self, export};

/// Write a material for other tools: maps as OpenEXR, or a mesh that wears it as glTF.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("written").required(true).multiple(true).args(["exr", "gltf"]))]
#[command(after_help = "\
Examples:
  overpaint export cloth.zarr --exr maps/
  overpaint export painted.zarr --gltf painted.glb
  overpaint export painted.zarr --gltf ball.gltf --mesh sphere --tiling 2
  overpaint export painted.zarr --exr maps/ --gltf spot.glb --mesh spot.obj

Maps are linear 32-bit floats, exactly as the material has them: height in texel widths, normals x right, y up, z out in R, G, B from -1 to 1,
diffuse, specular and lobe as fitted, and those of the paint. maps.json tells what each file holds.

A glTF has base color, normals, roughness and specular reflectance, 8 bits a channel, in one file; what it cannot tell is listed.")]
pub struct Export {
    /// The material, as `fit` or `paint` wrote it
    material: PathBuf,
    /// Folder for maps (.exr) and maps.json; maps of an earlier export are replaced
    #[arg(long, value_name = "DIR")]
    exr: Option<PathBuf>,
    /// The glTF to write: .glb (one binary file) or .gltf (one JSON file)
    #[arg(long, value_name = "FILE", value_parser = arguments::gltf)]
    gltf: Option<(PathBuf, export::GltfFormat)>,
    /// What wears the material: plane, sphere, torus-knot or cloth, or a file (.obj, .gltf, .glb)
    #[arg(long, value_name = "MESH", requires = "gltf", default_value = "plane")]
    mesh: PathBuf,
    /// Pieces of the material per unit of texture coordinates
    #[arg(long, value_name = "N", requires = "gltf", default_value_t = 1.0, allow_negative_numbers = true, value_parser = arguments::positive)]
    tiling: f64,
}

impl Export {
    pub fn run(self) -> Result<(), CliError> {
        if let Some(folder) = &self.exr {
            output::check_maps(folder)?;
        }
        let gltf = match &self.gltf {
            Some((path, format)) => {
                output::check_file(path)?;
                let (mesh, warnings) = mesh::named(&self.mesh)?;
                for warning in &warnings {
                    eprintln!("warning: {warning}");
                }
                Some((path, *format, mesh))
            }
            None => None,
        };
        let material = io::material::load(&self.material)?;
        if let Some(folder) = &self.exr {
            export::write_maps(folder, &material)?;
            say(&format!("wrote {}", folder.display()))?;
        }
        if let Some((path, format, mesh)) = gltf {
            let lost = export::write_gltf(path, format, &material, &mesh, self.tiling)?;
            say(&format!("wrote {}, which does not hold all of the material:\n  {}", path.display(), lost.join("\n  ")))?;
        }
        Ok(())
    }
}
