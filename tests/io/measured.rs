//! The measured and path-traced samples of the shared data.

use std::path::Path;

use overpaint::io;
use rayon::prelude::*;

use super::codes;

crate::suite! { data: blocks_are_on_the_bonn_grid, weave_has_51_views_and_lights, coincloth_has_one_view; }

fn blocks_are_on_the_bonn_grid(data: &Path) {
    let source = io::open(&data.join("blocks64_ubo81x81.zip")).expect("opens");
    let btf = source.btf();
    assert_eq!((btf.name(), btf.size(), btf.pairs().len(), btf.grid()), ("blocks64_ubo81x81", [64, 64], 6561, Some("UBO81")));
    assert!(btf.is_product());
    (0..6561_usize).into_par_iter().for_each(|sample| assert_eq!(codes(source.as_ref(), sample).expect("decodes").len(), 64 * 64));
}

fn weave_has_51_views_and_lights(data: &Path) {
    let source = io::open(&data.join("weave64_51x51.zip")).expect("opens");
    let btf = source.btf();
    assert_eq!((btf.size(), btf.views().len(), btf.lights().len(), btf.pairs().len()), ([64, 64], 51, 51, 2601));
    assert_eq!(btf.zenith_samples(), (0..51).collect::<Vec<_>>());
}

fn coincloth_has_one_view(data: &Path) {
    let source = io::open(&data.join("coincloth256_1x.zip")).expect("opens");
    let btf = source.btf();
    assert_eq!((btf.size(), btf.views().len(), btf.lights().len()), ([256, 256], 1, 88));
    let texels = codes(source.as_ref(), 87).expect("decodes");
    let mean = texels.iter().map(|texel| f64::from(texel[1])).sum::<f64>() / texels.len() as f64;
    assert!((20.0..235.0).contains(&mean), "a photograph's mean code is {mean}");
}
