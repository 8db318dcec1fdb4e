//! A source in, a tree of images out.

use std::path::Path;

use half::f16;

use super::{Memory, PipelineError, Progress};
use crate::{
    data::Block,
    io::{Lost, Source, TreeFormat, TreeWriter},
};

/// Writes all samples of `source` as the tree of images `folder`, as many at once of one view as `memory.host` holds.
///
/// # Errors
/// [`PipelineError::Source`] if the source cannot be read, the tree cannot be written, or `folder` holds anything else.
pub fn export_tree(
    source: &dyn Source, folder: &Path, format: TreeFormat, memory: Memory, progress: &Progress,
) -> Result<Lost, PipelineError> {
    let btf = source.btf();
    let writer = TreeWriter::begin(folder, btf, format)?;
    let samples: Vec<usize> = (0..btf.pairs().len()).collect();
    progress.expect(samples.len());
    let halves = 3 * btf.texels();
    let at_once = (memory.host / (halves * size_of::<f16>())).max(1);
    let mut lost = Lost::default();
    for view in samples.chunk_by(|&a, &b| btf.pairs()[a].view == btf.pairs()[b].view) {
        for samples in view.chunks(at_once) {
            let mut radiance = vec![f16::ZERO; samples.len() * halves];
            let stage = progress.stage("read", btf.texels(), samples.len());
            source.read(samples, Block::whole(btf.size()), &mut radiance, &|_| {})?;
            drop(stage);
            let _stage = progress.stage("encode", btf.texels(), samples.len());
            lost = lost + writer.write(samples, &radiance, &|images| progress.advance(images))?;
        }
    }
    Ok(lost)
}
