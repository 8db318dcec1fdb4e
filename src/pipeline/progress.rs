//! What a job tells while it runs and how long each stage took.
//!
//! A stage is timed on the wall by a guard that lives as long as the stage, and on the adapter by the pass times handed
//! to that guard. A stage that is entered again, for the next tile, adds to the same row. Stages may overlap, so the rows may
//! sum to more than the job took.

use std::{
    fmt,
    sync::{Mutex, MutexGuard, PoisonError},
    time::{Duration, Instant},
};

use serde::Serialize;

use crate::gpu::{AdapterSummary, PassTime};

/// Is told how a job goes. Every method does nothing unless it is overridden; calls come from any thread.
pub trait Observer: Send + Sync + fmt::Debug {
    /// A stage began, perhaps again.
    fn stage(&self, _name: &'static str) {}
    /// That many units of work more are to come.
    fn expect(&self, _units: usize) {}
    /// That many units of work are done.
    fn advance(&self, _units: usize) {}
}

/// An observer that says nothing.
#[derive(Debug)]
struct Silent;

impl Observer for Silent {}

/// A job's progress and the times of its stages.
#[derive(Debug)]
pub struct Progress {
    adapter: Option<AdapterSummary>,
    start: Instant,
    observer: Box<dyn Observer>,
    rows: Mutex<Vec<Row>>,
}

#[derive(Debug)]
struct Row {
    name: &'static str,
    wall: Duration,
    /// Time of the passes; none until the first time that the adapter gave one.
    gpu: Option<Duration>,
    /// Whether any of the stage ran on the adapter.
    on_adapter: bool,
    texels: usize,
    samples: usize,
}

impl Progress {
    /// Times the stages of a job on `adapter` and tells nobody.
    #[must_use]
    pub fn new(adapter: &AdapterSummary) -> Self {
        Self::observed(adapter, Box::new(Silent))
    }

    /// Times the stages of a job on `adapter` and keeps `observer` informed.
    #[must_use]
    pub fn observed(adapter: &AdapterSummary, observer: Box<dyn Observer>) -> Self {
        Self { adapter: Some(adapter.clone()), ..Self::on_host(observer) }
    }

    /// Times the stages of a job that needs no adapter and keeps `observer` informed.
    #[must_use]
    pub fn on_host(observer: Box<dyn Observer>) -> Self {
        Self { adapter: None, start: Instant::now(), observer, rows: Mutex::new(Vec::new()) }
    }

    /// Enters stage `name` for `texels` texels with `samples` samples each (0 where it reads no samples); the stage
    /// lasts until the guard is dropped.
    #[must_use = "the stage ends when the guard is dropped"]
    pub fn stage(&self, name: &'static str, texels: usize, samples: usize) -> StageGuard<'_> {
        self.observer.stage(name);
        let mut rows = self.rows();
        let row = rows.iter().position(|row| row.name == name).unwrap_or_else(|| {
            rows.push(Row { name, wall: Duration::ZERO, gpu: None, on_adapter: false, texels: 0, samples: 0 });
            rows.len() - 1
        });
        rows[row].texels += texels;
        rows[row].samples = rows[row].samples.max(samples);
        StageGuard { progress: self, row, start: Instant::now() }
    }

    /// Announces `units` more units of work; what a unit is, is the job's choice.
    pub fn expect(&self, units: usize) {
        self.observer.expect(units);
    }

    /// Reports `units` of the announced work as done.
    pub fn advance(&self, units: usize) {
        self.observer.advance(units);
    }

    /// The stages so far, in the order in which they were first entered. A stage that is still running counts with
    /// what it had when it was last left.
    #[must_use]
    pub fn report(&self) -> StageTable {
        let stage = |row: &Row| StageTime {
            name: row.name.to_owned(),
            wall_seconds: row.wall.as_secs_f64(),
            gpu_seconds: row.gpu.map(|gpu| gpu.as_secs_f64()),
            on_adapter: row.on_adapter,
            texels: row.texels,
            samples: row.samples,
        };
        let stages = self.rows().iter().map(stage).collect();
        StageTable { adapter: self.adapter.clone(), wall_seconds: self.start.elapsed().as_secs_f64(), stages }
    }

    /// The rows; a thread that panicked elsewhere leaves them valid, since each change to them is complete in itself.
    fn rows(&self) -> MutexGuard<'_, Vec<Row>> {
        self.rows.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A stage being timed; dropping it adds the wall time to the stage's row.
#[derive(Debug)]
pub struct StageGuard<'p> {
    progress: &'p Progress,
    row: usize,
    start: Instant,
}

impl StageGuard<'_> {
    /// Adds the times of passes that ran for this stage, as [`Submission::wait`](crate::gpu::Submission::wait) gives
    /// them: none where the adapter has no timestamps.
    pub fn gpu(&self, passes: &[PassTime]) {
        let mut rows = self.progress.rows();
        let row = &mut rows[self.row];
        row.on_adapter = true;
        if !passes.is_empty() {
            *row.gpu.get_or_insert_default() += passes.iter().map(|pass| pass.gpu).sum::<Duration>();
        }
    }
}

impl Drop for StageGuard<'_> {
    fn drop(&mut self) {
        self.progress.rows()[self.row].wall += self.start.elapsed();
    }
}

/// Time of one stage, summed over its tiles.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StageTime {
    /// Name of the stage: the stem of its kernel, or what the host does.
    pub name: String,
    /// Seconds on the wall, transfers and waiting included.
    pub wall_seconds: f64,
    /// Seconds that its passes took on the adapter; none if the adapter has no timestamps, or nothing ran there.
    pub gpu_seconds: Option<f64>,
    /// Whether any of it ran on the adapter; the rest, such as decoding, runs on the host.
    pub on_adapter: bool,
    /// Texels, summed over tiles.
    pub texels: usize,
    /// Samples of each texel; 0 for a stage that reads none.
    pub samples: usize,
}

/// The stages of a job with their times.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StageTable {
    /// The adapter of the job, if it has one: a time means nothing without it.
    pub adapter: Option<AdapterSummary>,
    /// Seconds since the job began.
    pub wall_seconds: f64,
    /// The stages, in the order in which they were first entered.
    pub stages: Vec<StageTime>,
}

impl StageTable {
    /// Part of the stages' summed wall time that `stage` has, from 0 to 1.
    #[must_use]
    pub fn share(&self, stage: &StageTime) -> f64 {
        let sum: f64 = self.stages.iter().map(|stage| stage.wall_seconds).sum();
        if sum > 0.0 { stage.wall_seconds / sum } else { 0.0 }
    }

    /// Where `stage` ran: the adapter's name, or "host".
    #[must_use]
    pub fn place(&self, stage: &StageTime) -> &str {
        self.adapter.as_ref().filter(|_| stage.on_adapter).map_or("host", |adapter| &adapter.name)
    }
}

/// One line a stage: name, wall time, share, adapter.
impl fmt::Display for StageTable {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let width = self.stages.iter().map(|stage| stage.name.len()).max().unwrap_or(0);
        for (index, stage) in self.stages.iter().enumerate() {
            let (name, seconds, percent) = (&stage.name, stage.wall_seconds, 100.0 * self.share(stage));
            let end = if index + 1 < self.stages.len() { "\n" } else { "" };
            write!(out, "{name:width$}  {seconds:8.3} s  {percent:5.1} %  {}{end}", self.place(stage))?;
        }
        Ok(())
    }
}
