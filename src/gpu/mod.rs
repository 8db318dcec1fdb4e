//! All of wgpu: adapters, buffers, kernels checked by reflection, recording and timing. No stage and no domain word.

mod buffer;
mod device;
mod error;
mod interface;
mod kernel;
mod layout;
mod raster;
mod recorder;
mod source;
mod texture;

pub use buffer::Buffer;
pub use device::{AdapterSummary, Gpu, adapters};
pub use error::{GpuError, LinkError};
pub use interface::{Access, Resource, reflect};
pub use kernel::{Bind, Grid, Kernel, bind, bind_depth_layers, bind_layers, bind_target};
pub use layout::{Field, GpuValue, Scalar};
pub use raster::{Raster, Target};
pub use recorder::{PassTime, Recorder, Submission};
pub use source::Source;
pub use texture::{DepthLayers, Layers};
