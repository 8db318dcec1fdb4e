//! What is done with bytes that may be a `.btf` container, by its fuzz target and by the test of its corpus.

use half::f16;
use overpaint::{
    data::Block,
    io::{self, ReadOptions},
};

/// Samples and texels a side that are read.
const SAMPLES: usize = 40;
const SIDE: usize = 12;

/// Opens the container and, where that succeeds, reads from it, which must succeed: its header was checked.
pub fn exercise(bytes: &[u8]) {
    let source = match io::open_btf_bytes("container", bytes, &ReadOptions::default()) {
        Ok(source) => source,
        Err(error) => return assert!(error.to_string().contains("container")),
    };
    let (all, [width, height]) = (source.btf().pairs().len(), source.btf().size());
    let [columns, rows] = source.chunk().expect("containers have chunks");
    assert!((1..=width).contains(&columns) && (1..=height).contains(&rows));
    let (first, last) = ((0..all.min(SAMPLES)).collect::<Vec<_>>(), (all.saturating_sub(SAMPLES)..all).step_by(3).collect::<Vec<_>>());
    let (columns, rows) = (width.min(SIDE), height.min(SIDE));
    let corners = [[0, 0], [width - columns, height - rows]];
    for (samples, [column, row]) in [first, last].into_iter().zip(corners) {
        let block = Block { column, row, width: columns, height: rows };
        let mut radiance = vec![f16::ZERO; 3 * samples.len() * block.texels()];
        source.read(&samples, block, &mut radiance, &|_| {}).expect("what was checked is readable");
        assert!(radiance.iter().all(|value| !value.is_finite() || value.to_f32().abs() <= 65504.0));
    }
    assert!(!source.fingerprint().is_empty());
}
