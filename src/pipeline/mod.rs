//! Chains stages: owns buffers, cuts a source into tiles, submits, and reports progress.

mod demo;
pub mod pending;
mod progress;
mod report;

pub use demo::{REPORT, demo};
pub use pending::{Coat, PipelineError, Studio, fit};
pub use progress::{Observer, Progress, StageGuard, StageTable, StageTime};
