//! Plain containers: directions, the description of a BTF, texel maps, the material. Shapes are checked once, at
//! construction.

mod block;
mod btf;
mod camera;
mod direction;
mod direction_mesh;
mod encoding;
mod environment;
mod environment_lights;
mod grid;
mod lpca;
mod map;
mod material;
pub mod mesh;
mod mesh_tangents;
mod mesh_view;
mod nearest_samples;
mod painted;
mod plane_view;
mod recipe;
mod samples;
mod shape;

pub use block::Block;
pub use btf::{Btf, BtfError, Pair};
pub use camera::{Camera, Light, Projection, ShadowView, Window};
pub use direction::Direction;
pub use direction_mesh::{Corner, DirectionMesh};
pub use encoding::{Encoding, RowOrder, Transfer, radiance_half};
pub use environment::{Environment, EnvironmentError};
pub use grid::{Grid, GridError};
pub use lpca::{Learned, Lpca, LpcaCandidate};
pub use map::{Map, ShapeError};
pub use material::{Candidate, Choice, Fit, FitStatus, Left, Lobe, Material, Provenance, Svbrdf};
pub use mesh::{Mesh, MeshError};
pub use mesh_tangents::across;
pub use mesh_view::{Channel, MeshView, Sampling, Surroundings};
pub use nearest_samples::nearest_samples;
pub use painted::Painted;
pub use plane_view::PlaneView;
pub use recipe::{PatternImage, Recipe};
pub use samples::{OCTET, Samples};
pub use shape::Shape;

pub use crate::model::MAX_LOBES;
