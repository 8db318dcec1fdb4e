#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! Dependencies point down:
//!
//! - [`cli`]: the command line.
//! - [`pipeline`]: chains stages, owns buffers, submits, reports progress.
//! - [`stage`]: host side of the compute stages; [`render`]: of the render passes.
//! - [`gpu`]: all of wgpu; [`wgsl`]: the embedded kernels.
//! - [`mod@reference`]: a CPU twin of each stage, in f64, for its tests.
//! - [`io`]: readers and writers.
//! - [`model`]: physics and settings; [`data`]: plain containers.

pub mod cli;
pub mod data;
pub mod gpu;
pub mod io;
pub mod model;
pub mod pipeline;
pub mod reference;
pub mod render;
pub mod stage;
pub mod wgsl;
