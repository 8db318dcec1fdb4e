//! overpaint paints measured materials: a BTF in, a painted material out, on any GPU that wgpu reaches.

pub mod cli;
pub mod data;
pub mod gpu;
pub mod model;
pub mod pipeline;
pub mod reference;
pub mod stage;
pub mod wgsl;

pub use pipeline::pending::io;
