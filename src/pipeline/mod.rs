//! Chains stages: owns buffers, cuts a source into tiles, submits, and reports progress.

mod progress;

pub use progress::{Observer, Progress, StageGuard, StageTable, StageTime};
