//! Ways of taking a surface, fitted from end to end.

use half::f16;
use overpaint::{
    data::{Direction, FitStatus, Grid, Map, Material},
    gpu::Gpu,
    io::Source,
    model::{FitSettings, Frame, HeightField, SurfaceMode, Synth, SynthReflectance},
    pipeline::{CompareSettings, Memory, PipelineError, Progress, Synthetic, compare, fit},
};

use crate::support::{held::Held, hold};

crate::suite! {
    gpu: a_relief_is_taken_best_by_its_own_frames, a_flat_plane_is_taken_to_rounding, another_lobe_leaves_no_more, a_rough_surface_shares_a_lobe,
        a_constant_plane_is_taken_well_any_way, what_cannot_be_is_refused;
}

const SIZE: [usize; 2] = [16, 16];

fn directions(grid: &str) -> Vec<Direction> {
    grid.parse::<Grid>().expect("is a grid").directions()
}

/// Coloured below a clear gloss, under 19 lights.
fn synthetic<'g>(gpu: &'g Gpu, height_field: HeightField, views: &str) -> Synthetic<'g> {
    let recipe = Synth { height_field, relief: 2.0, reflectance: SynthReflectance::Plastic, seed: 3 };
    let (views, lights) = (directions(views), directions("0:1,25:6,45:6,65:6"));
    Synthetic::new(gpu, "relief", recipe, SIZE, views, lights, &Progress::new(gpu.adapter())).expect("is made")
}

/// Radiance ρ cos θ_i.
fn constant(reflectance: [f64; 3]) -> Held {
    Held::new(SIZE, &directions("0:1,45:6"), &directions("0:1,30:6,60:6"), |_, light| {
        Map::from_fn(SIZE[0], SIZE[1], |_, _| reflectance.map(|rho| f16::from_f64(rho * light.theta.cos())))
    })
}

fn with(surface: SurfaceMode, lobes: u32) -> FitSettings {
    FitSettings { surface, lobes, ..FitSettings::default() }
}

fn fitted(gpu: &Gpu, source: &dyn Source, settings: &FitSettings) -> Material {
    fit(gpu, source, settings, &Progress::new(gpu.adapter())).expect("fits")
}

/// What a material leaves of all radiance, relative RMS.
fn left(gpu: &Gpu, source: &dyn Source, material: &Material) -> f64 {
    let progress = Progress::new(gpu.adapter());
    let compared = compare(gpu, source, material, &CompareSettings::default(), Memory::default(), &progress).expect("compares");
    compared.overall.relative_rms.expect("is lit")
}

/// The truth's lobes stand in each texel's own frame, by which flat texels cannot go; of four candidates and a height that the views
/// tell, the one that leaves the least of some texels is taken, and leaves the least of all.
fn a_relief_is_taken_best_by_its_own_frames(gpu: &Gpu) {
    let source = synthetic(gpu, HeightField::Waves, "0:1,30:6,60:6");
    let modes = [SurfaceMode::Flat, SurfaceMode::Rough, SurfaceMode::Local, SurfaceMode::Auto];
    let [flat, rough, local, auto] = modes.map(|surface| {
        let material = fitted(gpu, &source, &with(surface, 1));
        if surface == SurfaceMode::Auto {
            assert_is_best(&material);
        } else {
            assert_eq!(material.choice.chosen().surface, surface);
        }
        assert_eq!(material.svbrdf.frame, material.choice.chosen().frame);
        assert_eq!(material.svbrdf.frame == Frame::Plane, matches!(surface, SurfaceMode::Flat | SurfaceMode::Rough));
        left(gpu, &source, &material)
    });
    hold("surface modes: local over the better of flat and rough", local / flat.min(rough), 0.5);
    // They are chosen by a half of the texels.
    hold("surface modes: the chosen over the best", auto / flat.min(rough).min(local), 1.05);
}

/// A flat plane's texels see all of their lights, each in the one frame there is: any candidate will do.
fn a_flat_plane_is_taken_to_rounding(gpu: &Gpu) {
    let source = synthetic(gpu, HeightField::Flat, "0:1,45:6");
    let auto = fitted(gpu, &source, &with(SurfaceMode::Auto, 1));
    assert_is_best(&auto);
    // Half's rounding, 2^-11 at most.
    hold("surface modes: a flat plane", left(gpu, &source, &auto), 4.9e-4);
}

/// The candidates stand in the order of what they leave.
fn assert_is_best(material: &Material) {
    let choice = &material.choice;
    let errors: Vec<f64> = choice.candidates.iter().map(|candidate| candidate.left.expect("was measured").cost()).collect();
    assert!(errors.is_sorted() && (4..=5).contains(&errors.len()), "{errors:?}");
    assert_eq!((choice.chosen(), choice.texels), (choice.candidates[0], 144));
    for surface in [SurfaceMode::Flat, SurfaceMode::Rough, SurfaceMode::Local] {
        assert!(choice.candidates.iter().any(|candidate| candidate.surface == surface), "{surface:?}");
    }
}

/// The refit over more columns cannot leave more.
fn another_lobe_leaves_no_more(gpu: &Gpu) {
    let source = synthetic(gpu, HeightField::Waves, "0:1,45:6");
    let errors = [1, 2].map(|lobes| {
        let material = fitted(gpu, &source, &with(SurfaceMode::Local, lobes));
        assert_eq!(material.svbrdf.lobes.len(), lobes as usize);
        assert!(material.svbrdf.lobes.iter().all(|lobe| lobe.parameters.values().iter().flatten().all(|value| value.is_finite())));
        left(gpu, &source, &material)
    });
    // The regularisation of nearly dependent lobes.
    hold("surface modes: another lobe", errors[1] / errors[0], 1.001);
}

/// C's direction and n are those of the texel that was named; its amplitude is each texel's own.
fn a_rough_surface_shares_a_lobe(gpu: &Gpu) {
    let source = synthetic(gpu, HeightField::Waves, "0:1,45:6");
    let named = [5, 9];
    let flat = fitted(gpu, &source, &with(SurfaceMode::Flat, 1));
    let material = fitted(gpu, &source, &FitSettings { representative: Some(named), ..with(SurfaceMode::Rough, 1) });
    assert_eq!(material.choice.representative, Some(named));
    let unit = |[x, y, z, n]: [f32; 4]| [x, y, z, n].map(f64::from).map(|c| c / f64::from((x * x + y * y + z * z).sqrt()));
    let parameters = &material.svbrdf.lobes[0].parameters;
    let shared = parameters[(named[0], named[1])];
    for (texel, lobe) in parameters.values().iter().enumerate() {
        assert_eq!(FitStatus::from_code(material.fit.status.values()[texel]), Some(FitStatus::Shared));
        assert_eq!(lobe[3].to_bits(), shared[3].to_bits());
        let apart = (0..3).map(|axis| (unit(*lobe)[axis] - unit(shared)[axis]).abs()).fold(0.0, f64::max);
        // Single precision's root of the amplitude.
        hold("surface modes: a shared lobe's direction", apart, 1e-6);
    }
    let amplitudes = parameters.values().iter().map(|[x, y, z, _]| x * x + y * y + z * z);
    let (least, greatest) = amplitudes.fold((f32::INFINITY, 0.0_f32), |(least, greatest), size| (least.min(size), greatest.max(size)));
    assert!(greatest > 1.01 * least, "{least} {greatest}");
    // A flat surface's texels have lobes of their own.
    let exponents: std::collections::BTreeSet<u32> = flat.svbrdf.lobes[0].parameters.values().iter().map(|lobe| lobe[3].to_bits()).collect();
    assert!(exponents.len() > 50, "{}", exponents.len());
    let found = fitted(gpu, &source, &with(SurfaceMode::Rough, 1)).choice.representative;
    assert!(found.is_some_and(|[column, row]| column < SIZE[0] && row < SIZE[1]), "{found:?}");
}

fn a_constant_plane_is_taken_well_any_way(gpu: &Gpu) {
    let source = constant([0.5, 0.25, 0.8]);
    for surface in [SurfaceMode::Flat, SurfaceMode::Rough, SurfaceMode::Local, SurfaceMode::Auto] {
        let material = fitted(gpu, &source, &with(surface, 1));
        // Half's rounding, 2^-11 at most of the radiance, and once more of the reflectance of plane frames.
        hold("surface modes: a constant plane", left(gpu, &source, &material), if surface == SurfaceMode::Auto { 4.9e-4 } else { 9.8e-4 });
        assert!(material.height.values().iter().all(|height| height.abs() < 0.05));
    }
    // Nothing above the diffuse part stays so, shared or not.
    let black = constant([0.0; 3]);
    for surface in [SurfaceMode::Flat, SurfaceMode::Rough, SurfaceMode::Local, SurfaceMode::Auto] {
        let material = fitted(gpu, &black, &with(surface, 1));
        let status: Vec<_> = material.fit.status.values().iter().map(|code| FitStatus::from_code(*code)).collect();
        assert!(status.iter().all(|status| *status == Some(FitStatus::NoSpecular)), "{surface:?} {:?}", status[0]);
        assert!(material.svbrdf.diffuse.values().iter().chain(material.svbrdf.lobes[0].specular.values()).all(|rho| *rho == [0.0; 3]));
    }
}

fn what_cannot_be_is_refused(gpu: &Gpu) {
    let source = constant([0.5; 3]);
    let refused = |settings: &FitSettings| fit(gpu, &source, settings, &Progress::new(gpu.adapter())).expect_err("is refused");
    for texel in [[16, 0], [0, 16], [usize::MAX, 3]] {
        let error = refused(&FitSettings { representative: Some(texel), ..with(SurfaceMode::Rough, 1) });
        assert!(matches!(error, PipelineError::NoSuchTexel { column, row, width: 16, height: 16 } if [column, row] == texel), "{error}");
    }
    for settings in [with(SurfaceMode::Flat, 2), with(SurfaceMode::Rough, 3), with(SurfaceMode::Local, 0), with(SurfaceMode::Auto, 4)] {
        let error = refused(&settings);
        assert!(matches!(&error, PipelineError::Settings(error) if error.setting == "lobes"), "{error}");
    }
}
