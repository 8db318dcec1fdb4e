//! The source's tiles, gone through several times: kept on the adapter if they fit, else read anew each time.

use bytemuck::Pod;

use super::super::tiles::Job;
use crate::{pipeline::PipelineError, stage::Gathered};

pub struct Tiles<'a> {
    job: Job<'a>,
    samples: Vec<usize>,
    /// Tiles and the texels of the plane that they hold.
    kept: Vec<(Gathered, Vec<usize>)>,
    is_complete: bool,
}

impl<'a> Tiles<'a> {
    /// None is kept yet. `reserved` bytes of the adapter's memory are left to others.
    pub fn new(job: &Job<'a>, reserved: u64) -> Self {
        let mut job = *job;
        // What is left, and something to work with however little that is.
        job.memory.adapter = job.memory.adapter.saturating_sub(reserved).max(job.memory.adapter / 4);
        Self { job, samples: (0..job.source.btf().pairs().len()).collect(), kept: Vec::new(), is_complete: false }
    }

    pub fn job(&self) -> &Job<'a> {
        &self.job
    }

    pub fn texels(&self) -> usize {
        self.job.source.btf().texels()
    }

    pub fn samples(&self) -> usize {
        self.samples.len()
    }

    /// What `work` finds for each texel, `[texel of the plane][value]` with `width` values each. `work` is given a tile and its texels' indices in the
    /// plane. Finished tiles are kept for a later run under the name `what`.
    pub fn map<T: Pod>(
        &mut self, what: &str, width: usize, work: impl FnMut(&Gathered, &[usize]) -> Result<Vec<T>, PipelineError>,
    ) -> Result<Vec<T>, PipelineError> {
        self.run(true, what, width, work)
    }

    /// Gives `work` each tile and its texels' indices in the plane, in a fixed order.
    pub fn for_each(&mut self, mut work: impl FnMut(&Gathered, &[usize]) -> Result<(), PipelineError>) -> Result<(), PipelineError> {
        self.run(false, "", 0, |gathered, texels| work(gathered, texels).map(|()| Vec::<u8>::new()))?;
        Ok(())
    }

    fn run<T: Pod, F>(&mut self, is_kept: bool, what: &str, width: usize, mut work: F) -> Result<Vec<T>, PipelineError>
    where
        F: FnMut(&Gathered, &[usize]) -> Result<Vec<T>, PipelineError>,
    {
        let columns = self.job.source.btf().size()[0];
        if self.is_complete {
            let mut all = vec![T::zeroed(); self.texels() * width];
            for (tile, texels) in &self.kept {
                let found = work(tile, texels)?;
                for (index, texel) in texels.iter().enumerate() {
                    all[texel * width..][..width].copy_from_slice(&found[index * width..][..width]);
                }
            }
            return Ok(all);
        }
        let keeps = self.job.keeps(&self.samples);
        let Self { job, samples, kept, .. } = self;
        kept.clear();
        let job = if is_kept { *job } else { Job { unfinished: None, ..*job } };
        let all = job.for_each_tile(what, width, samples, |gathered, places| {
            let texels: Vec<usize> = places.iter().map(|[column, row]| *row as usize * columns + *column as usize).collect();
            let found = work(&gathered, &texels)?;
            if keeps {
                kept.push((gathered, texels));
            }
            Ok(found)
        })?;
        // A run that took tiles up has not seen them all.
        self.is_complete = self.kept.iter().map(|(_, texels)| texels.len()).sum::<usize>() == self.texels();
        if !self.is_complete {
            self.kept.clear();
        }
        Ok(all)
    }
}
