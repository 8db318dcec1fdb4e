//! Materials for other tools: maps as a folder of OpenEXR files, which keep every bit, and a mesh that wears the material as glTF 2.0,
//! which common viewers open and which keeps less.

mod document;
mod gltf;
mod maps;
mod textures;

pub use gltf::{GltfFormat, write_gltf};
pub use maps::{check_maps, write_maps};
