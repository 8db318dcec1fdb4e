//! A part of a source: a block of its texels, some of its directions.
//!
//! Directions beyond `max_theta` are left out first, views and lights alike. Of those that remain, in the source's order (that of image trees
//! is by θ, then φ), every N-th view is kept, from the first, and likewise every N-th light; the view nearest to the zenith is kept in any
//! case, because the geometry is recovered from it. A sample stays if both its directions do, and a direction if it has a sample.

use half::f16;

use super::{IoError, ReadOptions, Source};
use crate::data::{Block, Btf, Direction, Pair};

/// Directions that differ by less than this, in degrees, are at the limit: names have six decimals at most.
const TOLERANCE: f64 = 1e-6;

/// What cannot be selected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SelectionFault {
    /// A region that reaches beyond the plane.
    #[error("the region of {region} is not within the {width} x {height} texels of {name}; name one that is")]
    Outside {
        /// The source.
        name: String,
        /// What was asked for.
        region: Block,
        /// Columns there are.
        width: usize,
        /// Rows there are.
        height: usize,
    },
    /// A step of no directions.
    #[error("every 0th direction was asked for; ask for every 1st or a later one")]
    Every,
    /// A limit that leaves nothing.
    #[error("no sample of {name} is left: {asked}; it has {samples} samples, views {views}, lights {lights}; ask for more of them")]
    Nothing {
        /// The source.
        name: String,
        /// What was asked for.
        asked: String,
        /// Samples there are.
        samples: usize,
        /// θ of the views there are.
        views: String,
        /// θ of the lights there are.
        lights: String,
    },
}

/// A source of which only a part is to be seen.
#[derive(Debug)]
struct Selection {
    whole: Box<dyn Source>,
    btf: Btf,
    /// The samples of `whole` that are left, ascending.
    samples: Vec<usize>,
    region: Block,
    /// What was selected, in words.
    asked: String,
}

/// The part of `whole` that the options ask for.
pub(super) fn select(whole: Box<dyn Source>, options: &ReadOptions) -> Result<Box<dyn Source>, IoError> {
    let &ReadOptions { region, every, max_theta, .. } = options;
    if region.is_none() && every.is_none() && max_theta.is_none() {
        return Ok(whole);
    }
    let btf = whole.btf();
    let [width, height] = btf.size();
    if every == Some(0) {
        return Err(SelectionFault::Every.into());
    }
    if let Some(region) = region.filter(|region| !region.is_within([width, height])) {
        return Err(SelectionFault::Outside { name: btf.name().to_owned(), region, width, height }.into());
    }
    let region = region.unwrap_or(Block::whole([width, height]));
    let asked = asked(region, options);

    let (every, max_theta) = (every.unwrap_or(1), max_theta.unwrap_or(90.0) + TOLERANCE);
    let kept = |directions: &[Direction]| {
        let mut kept = vec![false; directions.len()];
        let low = (0..directions.len()).filter(|&index| directions[index].theta.to_degrees() <= max_theta);
        low.step_by(every).for_each(|index| kept[index] = true);
        kept
    };
    let (mut views, lights) = (kept(btf.views()), kept(btf.lights()));
    let theta = |view: &usize| btf.views()[*view].theta;
    let zenith = (0..views.len()).min_by(|a, b| theta(a).total_cmp(&theta(b)));
    if let Some(zenith) = zenith.filter(|zenith| theta(zenith).to_degrees() <= max_theta) {
        views[zenith] = true;
    }
    let stays = |sample: &usize| views[btf.pairs()[*sample].view] && lights[btf.pairs()[*sample].light];
    let samples: Vec<usize> = (0..btf.pairs().len()).filter(stays).collect();
    if samples.is_empty() {
        let (samples, views, lights) = (btf.pairs().len(), range(btf.views()), range(btf.lights()));
        return Err(SelectionFault::Nothing { name: btf.name().to_owned(), asked, samples, views, lights }.into());
    }

    let (views, view_index) = used(btf.views(), samples.iter().map(|&sample| btf.pairs()[sample].view));
    let (lights, light_index) = used(btf.lights(), samples.iter().map(|&sample| btf.pairs()[sample].light));
    let pairs = samples.iter().map(|&sample| btf.pairs()[sample]);
    let pairs = pairs.map(|pair| Pair { view: view_index[pair.view], light: light_index[pair.light] }).collect();
    let size = [region.width, region.height];
    let btf = Btf::new(btf.name().to_owned(), size, views, lights, pairs, *btf.encoding())?;
    Ok(Box::new(Selection { whole, btf, samples, region, asked }))
}

/// The directions that are used, and the new index of each old one that is.
fn used(directions: &[Direction], indices: impl Iterator<Item = usize>) -> (Vec<Direction>, Vec<usize>) {
    let mut is_used = vec![false; directions.len()];
    indices.for_each(|index| is_used[index] = true);
    let mut index = vec![0; directions.len()];
    let mut left = Vec::new();
    for (old, direction) in directions.iter().enumerate().filter(|(old, _)| is_used[*old]) {
        index[old] = left.len();
        left.push(*direction);
    }
    (left, index)
}

fn asked(region: Block, options: &ReadOptions) -> String {
    let parts = [
        options.region.map(|_| region.to_string()),
        options.every.map(|every| format!("every {every}. direction")),
        options.max_theta.map(|limit| format!("θ up to {limit} degrees")),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// How many directions and their θ, for a message.
fn range(directions: &[Direction]) -> String {
    let thetas = || directions.iter().map(|direction| direction.theta.to_degrees());
    let (lowest, highest) = (thetas().fold(f64::INFINITY, f64::min), thetas().fold(0.0, f64::max));
    format!("{} of θ {lowest:.1} to {highest:.1}", directions.len())
}

impl Source for Selection {
    fn btf(&self) -> &Btf {
        &self.btf
    }

    fn chunk(&self) -> Option<[usize; 2]> {
        self.whole.chunk()
    }

    fn read(&self, samples: &[usize], block: Block, radiance: &mut [f16], done: &(dyn Fn(usize) + Sync)) -> Result<(), IoError> {
        assert!(block.is_within(self.btf.size()), "the block lies within the plane");
        let samples: Vec<usize> = samples.iter().map(|&sample| self.samples[sample]).collect();
        let block = Block { column: self.region.column + block.column, row: self.region.row + block.row, ..block };
        self.whole.read(&samples, block, radiance, done)
    }

    fn fingerprint(&self) -> String {
        format!("{}; {}", self.whole.fingerprint(), self.asked)
    }
}
