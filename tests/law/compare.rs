use half::f16;
use overpaint::{
    data::{Direction, Grid, LpcaCandidate, Map, Material},
    gpu::Gpu,
    model::{Appearance, Boundary, HeightField, Relief, Synth, SynthReflectance, TexelSamples},
    pipeline::{CompareSettings, Comparison, Memory, PipelineError, Progress, Studio, Synthetic, compare, compare_into},
    reference,
};

use crate::support::{Worst, held::Held, hold, lpca, random::Random};

crate::suite! {
    gpu: a_material_reconstructs_its_own_pictures, figures_are_those_of_all_values_in_f64, figures_do_not_depend_on_memory, a_darker_source_finds_the_material_too_bright,
        relief_can_be_left_out, a_local_pca_reconstructs_what_it_was_made_from, a_strip_is_its_pictures, scattered_lights_are_grouped, there_may_be_nothing_to_compare, what_does_not_go_together_is_refused;
}

const SIZE: [usize; 2] = [23, 17];

fn directions(grid: &str) -> Vec<Direction> {
    grid.parse::<Grid>().expect("is a grid").directions()
}

/// A glossy relief; its lobes are taken as those of the base plane's frame.
fn material(gpu: &Gpu) -> Material {
    material_of(gpu, SIZE)
}

fn material_of(gpu: &Gpu, size: [usize; 2]) -> Material {
    let recipe = Synth { height_field: HeightField::Bumps, relief: 3.0, reflectance: SynthReflectance::Plastic, seed: 4 };
    let zenith = directions("zenith");
    let synthetic = Synthetic::new(gpu, "known", recipe, size, zenith.clone(), zenith, &Progress::new(gpu.adapter())).expect("is made");
    synthetic.truth()
}

/// Nine views and thirteen lights: more pairs than a texel adds up on the adapter.
fn source(picture: impl FnMut(Direction, Direction) -> Map<[f16; 3]>) -> Held {
    Held::new(SIZE, &directions("0:1,30:4,60:4"), &directions("0:1,40:6,70:6"), picture)
}

/// What `reconstruct` makes of the material, times `factor`.
fn reconstructed(gpu: &Gpu, material: &Material, factor: f32) -> Held {
    let (studio, progress) = (Studio::new(gpu).expect("builds"), Progress::new(gpu.adapter()));
    let surface = studio.surface(material, &progress).expect("fits");
    source(|view, light| {
        let picture = studio.reconstruct(&surface, view, light, Relief::measured(), &progress).expect("reconstructs");
        picture.map(|&[r, g, b, _]| [r, g, b].map(|value| f16::from_f32(factor * value)))
    })
}

/// Random radiance, one texel in about eight masked.
fn speckled() -> Held {
    let mut random = Random::new(17);
    let mut value = move || if random.below(25) == 0 { [f16::NAN, f16::NEG_INFINITY, f16::NEG_ONE][random.below(3)] } else { f16::from_f64(random.unit()) };
    source(|_, _| Map::from_fn(SIZE[0], SIZE[1], |_, _| [(); 3].map(|()| value())))
}

fn compared(gpu: &Gpu, source: &Held, material: &Material, memory: Memory) -> Comparison {
    compare(gpu, source, material, &CompareSettings::default(), memory, &Progress::new(gpu.adapter())).expect("compares")
}

fn a_material_reconstructs_its_own_pictures(gpu: &Gpu) {
    let material = material(gpu);
    let found = compared(gpu, &reconstructed(gpu, &material, 1.0), &material, Memory::default());
    assert_eq!((found.overall.pairs, found.masked), (117, 0));
    // A half is rounded by 2^-11 of its value at most, either way; evenly spread remainders have a root mean square of that over √3.
    hold("compare: a material's own pictures, relative RMS", found.overall.relative_rms.expect("is lit"), 2.8e-4);
    hold("compare: a material's own pictures, bias", found.overall.bias.expect("is lit").abs(), 2.5e-5);
    hold("compare: a material's own pictures, worst texel", found.worst_texels[0].relative_rms, 4.9e-4);
    assert!(found.overall.psnr_db.is_some_and(|psnr| psnr > 70.0), "{found:?}");
}

/// Every sum again, from the pictures that `reconstruct` gives.
fn figures_are_those_of_all_values_in_f64(gpu: &Gpu) {
    let (material, source) = (material(gpu), speckled());
    let found = compared(gpu, &source, &material, Memory::default());
    let (studio, progress) = (Studio::new(gpu).expect("builds"), Progress::new(gpu.adapter()));
    let surface = studio.surface(&material, &progress).expect("fits");
    let errors: Vec<reference::PictureError> = source.btf.pairs().iter().zip(&source.pictures).map(|(pair, original)| {
        let (view, light) = (source.btf.views()[pair.view], source.btf.lights()[pair.light]);
        let picture = studio.reconstruct(&surface, view, light, Relief::measured(), &progress).expect("reconstructs");
        let picture: Vec<[f64; 3]> = picture.values().iter().map(|&[r, g, b, _]| [r, g, b].map(f64::from)).collect();
        reference::picture_error(&picture, original.values())
    }).collect();
    let of = |chosen: &dyn Fn(usize) -> bool| {
        let sum = |term: fn(&reference::PictureError) -> f64| -> f64 { errors.iter().enumerate().filter(|(pair, _)| chosen(*pair)).map(|(_, errors)| term(errors)).sum() };
        let (error, shown) = (sum(|e| e.squared_error) / sum(|e| e.squared_original), sum(|e| e.squared_shown_error) / (3.0 * sum(|e| e.texels)));
        [error.sqrt(), -10.0 * shown.log10(), sum(|e| e.error) / sum(|e| e.original)]
    };
    let check = |quality: overpaint::pipeline::Quality, expected: [f64; 3]| {
        let found = [quality.relative_rms, quality.psnr_db, quality.bias].map(|figure| figure.expect("is lit"));
        // What picture_error is held to; a PSNR is 4.3 times the relative error of its sum.
        hold("compare: figures against f64", (0..3).map(|figure| (found[figure] - expected[figure]).abs()).worst(), 2e-5);
    };
    check(found.overall, of(&|_| true));
    // Thirteen lights a view: one of the zenith, six of each ring.
    for (at, views) in found.by_view_elevation.iter().zip([0..1, 1..5, 5..9]) {
        check(at.quality, of(&|pair| views.contains(&(pair / 13))));
    }
    for (at, lights) in found.by_light_elevation.iter().zip([0..1, 1..7, 7..13]) {
        check(at.quality, of(&|pair| lights.contains(&(pair % 13))));
        let both = found.by_view_and_light_elevation.iter().filter(|both| both.light_theta_degrees == at.theta_degrees);
        assert_eq!(both.map(|both| both.quality.pairs).sum::<usize>(), at.quality.pairs);
    }
    let worst = found.worst_pairs[0].sample;
    check(found.worst_pairs[0].quality, of(&|pair| pair == worst));
    assert!((0..117).all(|sample| of(&|pair| pair == sample)[0] <= of(&|pair| pair == worst)[0]));
    let texels = found.texels.values().iter().enumerate().map(|(texel, found)| {
        let sum = |term: usize| errors.iter().map(|errors| errors.of_texels[texel][term]).sum::<f64>();
        (found.expect("is lit") - (sum(0) / sum(1)).sqrt()).abs()
    });
    hold("compare: texels against f64", texels.worst(), 2e-6);
    let masked: f64 = errors.iter().map(|errors| (SIZE[0] * SIZE[1]) as f64 - errors.texels).sum();
    assert_eq!(found.masked as f64, masked);
    assert!(masked > 1000.0);
}

fn figures_do_not_depend_on_memory(gpu: &Gpu) {
    let (material, source) = (material(gpu), speckled());
    let whole = compared(gpu, &source, &material, Memory::default());
    let picture = 6 * SIZE[0] * SIZE[1];
    // One picture, less than a view, a view and a bit; the adapter 1, 7 and 50 of them.
    for (host, adapter) in [(1, 1), (1 << 30, 1), (2 * 5 * picture, 15 * picture as u64), (2 * 15 * picture, 110 * picture as u64)] {
        let parts = compared(gpu, &source, &material, Memory { host, adapter });
        assert_eq!(Comparison { seconds: whole.seconds, ..parts }, whole, "host {host}, adapter {adapter}");
    }
}

fn a_darker_source_finds_the_material_too_bright(gpu: &Gpu) {
    let material = material(gpu);
    let found = compared(gpu, &reconstructed(gpu, &material, 0.5), &material, Memory::default());
    let figures = [found.overall.relative_rms, found.overall.bias].map(|figure| figure.expect("is lit"));
    // R = 2 L, but for the rounding of L.
    hold("compare: half as bright", figures.into_iter().map(|figure| (figure - 1.0).abs()).worst(), 2.5e-4);
    assert!(found.by_view_elevation.iter().all(|at| at.quality.bias.is_some_and(|bias| bias > 0.99)));
}

fn relief_can_be_left_out(gpu: &Gpu) {
    let material = material(gpu);
    let source = reconstructed(gpu, &material, 1.0);
    let relief = Relief { displace: false, shadow: false, ..Relief::measured() };
    let settings = CompareSettings { appearance: Appearance::Svbrdf { relief }, texel: Some([22, 16]) };
    let found = compare(gpu, &source, &material, &settings, Memory::default(), &Progress::new(gpu.adapter())).expect("compares");
    assert!(found.overall.relative_rms.is_some_and(|error| error > 0.05), "{found:?}");
    let expected: Vec<_> = source.pictures.iter().map(|picture| Some(picture[(22, 16)].map(f16::to_f32))).collect();
    assert_eq!(found.texel, expected);
}

/// The material with a local PCA of random terms for all pairs of [`source`]: what the pairs look like has nothing to do with its reflectance.
fn compressed(gpu: &Gpu) -> Material {
    let mut material = material(gpu);
    let (views, lights) = (directions("0:1,30:4,60:4"), directions("0:1,40:6,70:6"));
    let mut lpca = lpca::random(&mut Random::new(3), SIZE, lpca::product(views.len(), lights.len()), [5, 3]);
    lpca.learned.errors = vec![0.2, 0.1, 0.09];
    lpca.learned.candidates = vec![LpcaCandidate { clusters: 5, components: 3, bytes: lpca.bytes(), error: 0.0909 }];
    (material.provenance.views, material.provenance.lights, material.lpca) = (views, lights, Some(lpca));
    material
}

const NEAREST: Appearance = Appearance::Lpca { texel_samples: TexelSamples::One };

fn a_local_pca_reconstructs_what_it_was_made_from(gpu: &Gpu) {
    let material = compressed(gpu);
    let lpca = material.lpca.as_ref().expect("is there");
    let twin = reference::CompressedBtf::new(lpca, &material.provenance.views, &material.provenance.lights, Boundary::Periodic).expect("fits");
    let source = source(|view, light| {
        reference::reconstruct_lpca(&twin, TexelSamples::One, view, light).map(|rgb| rgb.map(f16::from_f64))
    });
    let settings = CompareSettings { appearance: NEAREST, texel: None };
    let (folder, progress) = (tempfile::tempdir().expect("is made"), Progress::new(gpu.adapter()));
    let found = compare_into(gpu, &source, &material, &settings, Memory::default(), folder.path(), &progress).expect("compares");
    // As that of a material's own pictures.
    hold("compare: a local PCA's own pictures, relative RMS", found.overall.relative_rms.expect("is lit"), 2.8e-4);
    let said = |file: &str| std::fs::read_to_string(folder.path().join(file)).expect("is there");
    let figures: serde_json::Value = serde_json::from_str(&said("compare.json")).expect("is JSON");
    assert_eq!((&figures["model"], &figures["texel_samples"]), (&"lpca".into(), &1.into()));
    assert_eq!(figures["material"]["lpca"]["learned"]["errors"], serde_json::json!([0.2, 0.1, 0.09]));
    let html = said("compare.html");
    for part in ["iterations.svg", "Between measured directions", "between.png", "What it was chosen from", "0.0909", "5 clusters"] {
        assert!(html.contains(part), "{part}");
    }
    assert!(said("iterations.svg").contains("iteration") && folder.path().join("between.png").is_file());

    let bare = Material { lpca: None, ..material };
    let refused = compare(gpu, &source, &bare, &settings, Memory::default(), &progress).expect_err("has none");
    assert!(matches!(refused, PipelineError::NoLpca { .. }), "{refused}");
}

fn a_strip_is_its_pictures(gpu: &Gpu) {
    let (studio, progress) = (Studio::new(gpu).expect("builds"), Progress::new(gpu.adapter()));
    let material = compressed(gpu);
    let degrees = Direction::from_degrees;
    for appearance in [NEAREST, Appearance::svbrdf()] {
        let subject = studio.subject(&material, appearance, &progress).expect("fits");
        let strip = studio.strip(&subject, [degrees(0.0, 40.0), degrees(10.0, 0.0)], [degrees(60.0, 40.0), degrees(10.0, 360.0)], 4, &progress);
        let strip = strip.expect("fits");
        assert_eq!([strip.width(), strip.height()], [4 * SIZE[0], SIZE[1]]);
        for index in 0..4 {
            let (view, light) = (degrees(20.0 * index as f64, 40.0), degrees(10.0, 120.0 * index as f64));
            let alone = studio.picture(&subject, view, light, &progress).expect("fits");
            let part = Map::from_fn(SIZE[0], SIZE[1], |column, row| strip[(index * SIZE[0] + column, row)]);
            // Angles are rounded differently on the way.
            let values = |picture: &Map<[f32; 4]>| picture.values().iter().flatten().map(|value| f64::from(*value)).collect::<Vec<_>>();
            let differing = values(&part).into_iter().zip(values(&alone)).filter(|(a, b)| (a - b).abs() > 1e-4).count();
            hold("compare: share of a strip that differs from its pictures", differing as f64 / strip.values().len() as f64, 2e-3);
        }
    }
}

/// More angles than a grid has rings.
fn scattered_lights_are_grouped(gpu: &Gpu) {
    let lights: Vec<_> = (0..30).map(|index| Direction::from_degrees(2.0 * f64::from(index), 12.0 * f64::from(index))).collect();
    let source = Held::new(SIZE, &directions("zenith"), &lights, |_, _| Map::from_fn(SIZE[0], SIZE[1], |_, _| [f16::ONE; 3]));
    let found = compared(gpu, &source, &material(gpu), Memory::default());
    let groups: Vec<_> = found.by_light_elevation.iter().map(|at| (at.theta_degrees, at.quality.pairs)).collect();
    // 0, 2, 4; 6, 8; 10, 12, 14; …; 56, 58.
    let expected: Vec<_> = (0..12).map(|group| (2.5 + 5.0 * f64::from(group), if group % 2 == 0 { 3 } else { 2 })).collect();
    assert_eq!(groups, expected);
}

/// Black originals, none at all, and a single texel: figures that mean nothing are left out, and the report is written all the same.
fn there_may_be_nothing_to_compare(gpu: &Gpu) {
    let zenith = directions("zenith");
    for (size, value) in [(SIZE, f16::ZERO), (SIZE, f16::NAN), ([1, 1], f16::ZERO), ([1, 1], f16::from_f32_const(0.25))] {
        let source = Held::new(size, &zenith, &zenith, |_, _| Map::from_fn(size[0], size[1], |_, _| [value; 3]));
        let (folder, settings) = (tempfile::tempdir().expect("is made"), CompareSettings { texel: Some([0, 0]), ..CompareSettings::default() });
        let (material, progress) = (material_of(gpu, size), Progress::new(gpu.adapter()));
        let found = compare_into(gpu, &source, &material, &settings, Memory::default(), folder.path(), &progress).expect("compares");
        let is_lit = value > f16::ZERO;
        assert_eq!((found.overall.relative_rms.is_some(), found.overall.bias.is_some()), (is_lit, is_lit), "{found:?}");
        assert_eq!((found.overall.psnr_db.is_some(), found.masked > 0), (!value.is_nan(), value.is_nan()), "{found:?}");
        assert_eq!((found.worst_pairs.len(), found.worst_texels.len()), if is_lit { (1, 1) } else { (0, 0) });
        assert!(folder.path().join("compare.html").is_file() && folder.path().join("errors.svg").is_file());
    }
}

fn what_does_not_go_together_is_refused(gpu: &Gpu) {
    let material = material(gpu);
    let source = Held::new([17, 23], &directions("zenith"), &directions("zenith"), |_, _| Map::from_fn(17, 23, |_, _| [f16::ONE; 3]));
    let refused = |source: &Held, texel| {
        let settings = CompareSettings { texel, ..CompareSettings::default() };
        compare(gpu, source, &material, &settings, Memory::default(), &Progress::new(gpu.adapter())).expect_err("is refused")
    };
    assert!(matches!(refused(&source, None), PipelineError::SizesDiffer { source_size: [17, 23], material_size: [23, 17], .. }));
    let source = speckled();
    for texel in [[23, 0], [0, 17]] {
        assert!(matches!(refused(&source, Some(texel)), PipelineError::NoSuchTexel { width: 23, height: 17, .. }));
    }
}
