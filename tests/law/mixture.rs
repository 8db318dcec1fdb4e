//! Paints stirred together.

use overpaint::model::{Paint, PaintError, kubelka_munk::opaque_reflectance, pigments};

use crate::support::{hold, worst_difference};

crate::suite! { plain:
    amounts_count_by_their_ratios,
    a_mixture_of_one_is_that_paint,
    mixtures_of_mixtures_are_mixtures,
    a_tint_gets_lighter,
    impossible_amounts_are_refused;
}

fn paint(name: &str) -> Paint {
    pigments::find(name).expect("is in the library").into()
}

fn coefficients(paint: &Paint) -> Vec<f64> {
    [paint.k, paint.s].concat()
}

fn amounts_count_by_their_ratios() {
    let parts = |scale: f64| [(scale, paint("viridian")), (3.0 * scale, paint("titanium white"))];
    let mixture = Paint::mixture("mint", &parts(1.0)).expect("is possible");
    let expected: Vec<f64> = coefficients(&paint("viridian"))
        .into_iter()
        .zip(coefficients(&paint("titanium white")))
        .map(|(green, white)| 0.25 * green + 0.75 * white)
        .collect();
    assert_eq!(mixture.name, "mint");
    // Roundings of sums below 3.
    hold("mixture: quarters", worst_difference(coefficients(&mixture), expected), 5e-16);
    let scaled = Paint::mixture("mint", &parts(1e-3)).expect("is possible");
    hold("mixture: other amounts", worst_difference(coefficients(&scaled), coefficients(&mixture)), 1e-15);
}

fn a_mixture_of_one_is_that_paint() {
    for pigment in pigments::all() {
        let paint = Paint::from(pigment);
        let alone = Paint::mixture(&paint.name, &[(4.0, paint.clone())]).expect("is possible");
        assert_eq!(alone, paint);
    }
}

fn mixtures_of_mixtures_are_mixtures() {
    let [a, b, c] = ["oil/cobalt blue", "oil/burnt sienna", "oil/titanium white"].map(paint);
    let gray = Paint::mixture("gray", &[(1.0, a.clone()), (1.0, b.clone())]).expect("is possible");
    let twice = Paint::mixture("light", &[(1.0, gray), (3.0, c.clone())]).expect("is possible");
    let once = Paint::mixture("light", &[(0.5, a), (0.5, b), (3.0, c)]).expect("is possible");
    hold("mixture: of mixtures", worst_difference(coefficients(&twice), coefficients(&once)), 5e-16);
}

/// The opaque colour goes from that of the pigment to that of white, and never back.
fn a_tint_gets_lighter() {
    for pigment in pigments::PigmentSet::Oil.pigments() {
        let mut darker = [0.0; 3];
        for white in [1e-3, 0.1, 0.5, 1.0, 2.0, 10.0, 1e3] {
            let tint = Paint::mixture("tint", &[(1.0, pigment.into()), (white, paint("titanium white"))]).expect("is possible");
            for channel in 0..3 {
                let reflectance = opaque_reflectance(tint.s[channel], tint.k[channel]);
                assert!(reflectance >= darker[channel] - 1e-12, "{}", pigment.name);
                darker[channel] = reflectance;
            }
        }
    }
}

fn impossible_amounts_are_refused() {
    let refused = |parts: &[(f64, Paint)]| matches!(Paint::mixture("mud", parts), Err(PaintError::Coefficient { .. }));
    assert!(refused(&[]));
    assert!(refused(&[(0.0, paint("viridian"))]));
    assert!(refused(&[(f64::NAN, paint("viridian"))]));
    assert!(refused(&[(1.0, paint("viridian")), (-1.0, paint("titanium white"))]));
    assert!(refused(&[(f64::INFINITY, paint("viridian"))]));
}
