//! Local PCA of what is masked, very bright, very little or nothing.

use half::f16;
use overpaint::{
    data::{Btf, Lpca, Map, Pair},
    gpu::Gpu,
    model::{LpcaMethod, LpcaSettings, Weighting},
    pipeline::{self, Memory, PipelineError, Progress},
};

use crate::support::{
    held::Held,
    hold,
    random::Random,
    subspaces::{self, Subspaces, left},
};

crate::suite! {
    gpu: what_is_masked_does_not_matter, a_sample_that_is_masked_everywhere_is_left_out, texels_that_are_masked_altogether_are_defined,
        high_dynamic_range_is_held, little_and_nothing_are_defined, settings_out_of_range_are_refused;
}

const METHODS: [LpcaMethod; 2] = [LpcaMethod::Basis, LpcaMethod::Direct];

fn settings(clusters: u32, components: u32) -> LpcaSettings {
    LpcaSettings { clusters, components, ..LpcaSettings::default() }
}

fn learn(gpu: &Gpu, source: &Held, settings: &LpcaSettings) -> Result<Lpca, PipelineError> {
    pipeline::lpca(gpu, source, settings, Memory::default(), None, &Progress::new(gpu.adapter()))
}

#[track_caller]
fn learned(gpu: &Gpu, source: &Held, settings: &LpcaSettings) -> Lpca {
    let found = learn(gpu, source, settings).expect("learns");
    subspaces::check(&found, source);
    found
}

/// Only that it is no measurement counts.
fn what_is_masked_does_not_matter(gpu: &Gpu) {
    let masked = |invalid: f16| {
        let mut source = Subspaces::new([23, 17], [4, 3], 0.02).source;
        subspaces::mask(&mut source, 200, invalid);
        source
    };
    for method in METHODS {
        let settings = LpcaSettings { method, ..settings(4, 3) };
        let expected = learned(gpu, &masked(f16::NAN), &settings);
        for invalid in [f16::INFINITY, f16::NEG_INFINITY, f16::NEG_ONE, f16::MIN, f16::from_f64_const(-1e-7)] {
            assert!(learned(gpu, &masked(invalid), &settings) == expected, "{method:?}, {invalid}");
        }
        let whole = learned(gpu, &Subspaces::new([23, 17], [4, 3], 0.02).source, &settings);
        // One sample in two hundred is not known; the others are hardly held less well.
        hold("local PCA, masked: error over that of all samples", expected.learned.relative_rms / whole.learned.relative_rms, 1.2);
    }
}

fn a_sample_that_is_masked_everywhere_is_left_out(gpu: &Gpu) {
    let Subspaces { mut source, cluster } = Subspaces::new([23, 17], [4, 3], 0.02);
    let mut without = Subspaces::new([23, 17], [4, 3], 0.02).source;
    let masked = 7;
    source.pictures[masked] = source.pictures[masked].map(|_| [f16::NAN; 3]);
    without.pictures.remove(masked);
    let btf = &without.btf;
    let pairs: Vec<Pair> = btf.pairs().iter().enumerate().filter(|(sample, _)| *sample != masked).map(|(_, pair)| *pair).collect();
    without.btf = Btf::new("held".to_owned(), btf.size(), btf.views().to_vec(), btf.lights().to_vec(), pairs, *btf.encoding())
        .expect("is a BTF");
    for method in METHODS {
        let settings = LpcaSettings { method, ..settings(4, 3) };
        let (found, expected) = (learned(gpu, &source, &settings), learned(gpu, &without, &settings));
        for lpca in [&found, &expected] {
            let mut names: Vec<_> = cluster.values().iter().zip(lpca.cluster.values()).collect();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), 4, "{method:?}: {names:?}");
        }
        // Other rounding.
        let change = (found.learned.relative_rms / expected.learned.relative_rms - 1.0).abs();
        hold("local PCA, a masked picture: change of the error, relative", change, 1e-3);
    }
}

fn texels_that_are_masked_altogether_are_defined(gpu: &Gpu) {
    for method in METHODS {
        for masked in [1, 5, 23 * 17 - 1, 23 * 17] {
            let mut source = Subspaces::new([23, 17], [4, 3], 0.02).source;
            for picture in &mut source.pictures {
                let mut texel = 0;
                *picture = picture.map(|&rgb| {
                    texel += 1;
                    if texel <= masked { [f16::NEG_ONE; 3] } else { rgb }
                });
            }
            let found = learned(gpu, &source, &LpcaSettings { method, ..settings(4, 3) });
            assert!(found.error.values()[..masked].iter().all(|error| *error == 0.0), "nothing is left of nothing");
            let (relative_rms, _) = left(&found, &source);
            hold("local PCA, masked texels: change of the error", (found.learned.relative_rms - relative_rms).abs(), 1e-6);
        }
    }
}

/// A highlight of tens of thousands beside ten-thousandths.
fn high_dynamic_range_is_held(gpu: &Gpu) {
    let mut random = Random::new(37);
    let size = [23, 17];
    let gains = [0, 1].map(|_: u8| Map::from_fn(size[0], size[1], |_, _| random.between(0.0, 1.0)));
    let material = Map::from_fn(size[0], size[1], |_, _| random.below(2));
    let source = subspaces::source(size, |sample| {
        let mut picture = || 10_f64.powf(random.between(-3.5, 4.4));
        let bright = [[picture(), picture(), picture()], [picture(), picture(), picture()]];
        let bright = if sample == 13 { [[3e4; 3], [1e-4, 1.0, 3e4]] } else { bright };
        Map::from_fn(size[0], size[1], |column, row| {
            let texel = (column, row);
            bright[material[texel]].map(|radiance| radiance * (0.2 + gains[material[texel]][texel]))
        })
    });
    let most = source.pictures.iter().flat_map(subspaces::channels).fold(0.0, f64::max);
    assert!((3e4..=6e4).contains(&most), "{most}");
    for method in METHODS {
        for weighting in [Weighting::Even, Weighting::Cosine, Weighting::Log] {
            let found = learned(gpu, &source, &LpcaSettings { method, weighting, ..settings(2, 2) });
            let (relative_rms, _) = left(&found, &source);
            // Each texel is a picture of its material times a gain: rounding to halves is left, of samples, terms and weights.
            hold("local PCA, high dynamic range: relative RMS", relative_rms, 1.0 / 1024.0);
        }
    }
}

/// Less than there are clusters or components for.
fn little_and_nothing_are_defined(gpu: &Gpu) {
    let constant = |size: [usize; 2], value: f64| subspaces::source(size, |_| Map::from_fn(size[0], size[1], |_, _| [value; 3]));
    let one_sample = |size: [usize; 2]| {
        let Held { btf, pictures } = Subspaces::new(size, [2, 2], 0.02).source;
        let directions = (btf.views()[1..2].to_vec(), btf.lights()[2..3].to_vec());
        let pairs = vec![Pair { view: 0, light: 0 }];
        let btf = Btf::new("one".to_owned(), size, directions.0, directions.1, pairs, *btf.encoding()).expect("is a BTF");
        Held { btf, pictures: pictures[..1].to_vec() }
    };
    // What is left at most: of what the components span, rounding to halves alone.
    let cases: [(&str, Held, u32, u32, f64); 9] = [
        ("more clusters than texels", Subspaces::new([3, 2], [2, 2], 0.02).source, 256, 2, 1e-3),
        ("as many clusters as texels", Subspaces::new([3, 2], [2, 2], 0.02).source, 6, 1, 1e-3),
        ("one texel", Subspaces::new([1, 1], [1, 1], 0.0).source, 16, 8, 1e-3),
        ("constant", constant([9, 7], 0.5), 16, 8, 1e-3),
        ("black", constant([9, 7], 0.0), 16, 8, 0.0),
        ("the largest half", constant([9, 7], 65504.0), 16, 8, 1e-3),
        ("the smallest normal half", constant([9, 7], 6.2e-5), 16, 8, 1e-3),
        ("one sample", one_sample([9, 7]), 4, 3, 1e-3),
        ("more components than samples", one_sample([9, 7]), 2, 32, 1e-3),
    ];
    for (what, source, clusters, components, most) in &cases {
        for method in METHODS {
            for weighting in [Weighting::Even, Weighting::Cosine, Weighting::Log] {
                let found = learned(gpu, source, &LpcaSettings { method, weighting, ..settings(*clusters, *components) });
                let (relative_rms, _) = left(&found, source);
                assert!(relative_rms <= *most, "{what}, {method:?}, {weighting:?}: {relative_rms} is left");
                let told = found.learned.relative_rms;
                assert!((told - relative_rms).abs() <= 1e-6, "{what}, {method:?}, {weighting:?}: {told} is told, {relative_rms} is left");
            }
        }
    }
}

fn settings_out_of_range_are_refused(gpu: &Gpu) {
    let source = Subspaces::new([3, 2], [2, 2], 0.02).source;
    for (settings, says) in [
        (settings(0, 1), "clusters"),
        (settings(257, 1), "clusters"),
        (settings(1, 0), "components"),
        (settings(1, 33), "components"),
        (LpcaSettings { rank: Some(0), ..settings(1, 1) }, "rank"),
        (LpcaSettings { rank: Some(257), ..settings(1, 1) }, "rank"),
        (LpcaSettings { iterations: 0, ..settings(1, 1) }, "iterations"),
    ] {
        let error = learn(gpu, &source, &settings).expect_err("must be refused").to_string();
        assert!(error.contains(says), "{error}");
    }
}
