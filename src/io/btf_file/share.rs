//! Progress of samples that are all read bit by bit.

/// Tells of whole samples in the measure in which parts of all of them are read.
pub(super) struct Share<'a> {
    samples: usize,
    steps: usize,
    step: usize,
    done: &'a (dyn Fn(usize) + Sync),
}

impl<'a> Share<'a> {
    /// `samples` that take `steps`.
    pub(super) fn new(samples: usize, steps: usize, done: &'a (dyn Fn(usize) + Sync)) -> Self {
        Self { samples, steps, step: 0, done }
    }

    /// One more step.
    pub(super) fn step(&mut self) {
        let told = |step: usize| (self.samples as u128 * step as u128 / self.steps as u128) as usize;
        let more = told(self.step + 1) - told(self.step);
        self.step += 1;
        if more > 0 {
            (self.done)(more);
        }
    }
}
