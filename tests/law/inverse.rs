//! K and S from what a film reflects over white and over black.

use overpaint::model::{Film, Paint, PaintError, kubelka_munk::film_of, pigments};

use crate::support::{Worst, hold, random::Random};

crate::suite! { plain:
    known_films_are_found,
    the_library_comes_back,
    the_printed_form_agrees,
    random_pairs_come_back,
    limits_are_met,
    what_no_film_reflects_is_refused,
    thicker_films_are_measured_as_well,
    films_that_are_all_but_opaque_are_refused_unless_exact;
}

/// (s, k, R_w, R_b), computed with 40 digits by sinh and cosh.
const KNOWN: [[f64; 4]; 6] = [
    [0.7, 0.3, 0.590_300_256_515_426, 0.323_402_246_878_705_67],
    [0.003, 1.64, 0.038_315_024_580_666_324, 0.000_878_816_918_042_476_7],
    [8.0, 0.5, 0.705_077_710_444_839_5, 0.702_325_875_265_118_2],
    [1.0, 0.000_55, 0.998_901_007_491_051_2, 0.499_770_919_853_750_5],
    [1e-6, 1e-3, 0.998_001_998_668_663_8, 9.989_996_676_667_988e-7],
    [40.0, 0.01, 0.984_170_677_821_544_1, 0.969_380_235_472_377_7],
];

/// What the film of (s, k) reflects over white and over black.
fn reflected(s: f64, k: f64) -> (f64, f64) {
    let film = Film::new(s, k);
    (film.over_substrate(1.0), film.reflectance)
}

/// The larger of the relative errors of s and k.
fn apart((s, k): (f64, f64), expected: (f64, f64)) -> f64 {
    [(s - expected.0) / expected.0, (k - expected.1) / expected.1].map(f64::abs).into_iter().worst()
}

fn known_films_are_found() {
    for [s, k, over_white, over_black] in KNOWN {
        let found = film_of(over_white, over_black).expect("is a film");
        // Half a last place of R_w, 6e-17, is 6e-14 of 1 - R_w where that is 1e-3.
        hold("film_of: known films", apart(found, (s, k)), 1e-13);
    }
}

fn the_library_comes_back() {
    for pigment in pigments::all() {
        for (&s, &k) in pigment.s.iter().zip(&pigment.k) {
            let (over_white, over_black) = reflected(s, k);
            let (found_s, found_k) = film_of(over_white, over_black).expect("is a film");
            // Twelve digits of coefficients of about 1.
            hold("film_of: library", [found_s - s, found_k - k].map(f64::abs).into_iter().worst(), 1e-12);
            // The weakest absorption of the library is 5e-4, and so is 1 - R_w; the darkest R_w - R_b is 1e-3.
            hold("film_of: library, relative", apart((found_s, found_k), (s, k)), 2e-12);
        }
    }
}

/// S = acoth((b² - (a - R_w)(a - 1))/(b(1 - R_w)))/b, K = S(a - 1), a = (R_w + (R_b - R_w + 1)/R_b)/2, b = √(a² - 1).
fn the_printed_form_agrees() {
    let mut random = Random::new(4);
    for _ in 0..10_000 {
        let over_black = random.between(0.01, 0.8);
        let over_white = random.between(over_black + 0.01, 0.95);
        let a = 0.5 * (over_white + (over_black - over_white + 1.0) / over_black);
        let b = (a * a - 1.0).sqrt();
        let x = (b * b - (a - over_white) * (a - 1.0)) / (b * (1.0 - over_white));
        let s = 0.5 * ((x + 1.0) / (x - 1.0)).ln() / b;
        let found = film_of(over_white, over_black).expect("is a film");
        // The printed form loses digits in a - 1, which is 2e-3 at least, and in x - 1, which is as small as R_w - R_b.
        hold("film_of: printed form", apart(found, (s, s * (a - 1.0))), 1e-12);
    }
}

fn random_pairs_come_back() {
    let mut random = Random::new(5);
    for _ in 0..100_000 {
        // Near 0, near 1 and near each other as well.
        let [mut low, mut high] = [(); 2].map(|()| {
            let small = 10_f64.powf(random.between(-9.0, 0.0));
            if random.below(2) == 0 { small } else { 1.0 - small }
        });
        if random.below(4) == 0 {
            low = high * (1.0 - 10_f64.powf(random.between(-9.0, -1.0)));
        }
        (low, high) = (low.min(high), low.max(high));
        let Some((s, k)) = film_of(high, low) else {
            assert!(!(0.0 < low && low < high && high < 1.0), "{low} {high}");
            continue;
        };
        assert!(s > 0.0 && k > 0.0 && s.is_finite() && k.is_finite(), "{low} {high}: {s} {k}");
        let (over_white, over_black) = reflected(s, k);
        // The film's own roundings, of some 2e-16 each, and of T in T²/(1 - R).
        hold("film_of: random pairs", [over_white - high, over_black - low].map(f64::abs).into_iter().worst(), 4e-15);
    }
}

fn limits_are_met() {
    for rho in [1e-6, 0.01, 0.3, 0.7, 0.99] {
        // R_w → 1: K → 0, S → R_b/(1 - R_b), by an error of the order of 1 - R_w.
        let (s, k) = film_of(1.0 - 1e-12, rho).expect("is a film");
        hold("film_of: R_w to 1", ((s * (1.0 - rho) / rho) - 1.0).abs(), 1e-9);
        assert!((0.0..1e-9).contains(&k));
        // R_b → 0: S → 0, K → -ln(R_w)/2.
        let (s, k) = film_of(rho, rho * 1e-15).expect("is a film");
        hold("film_of: R_b to 0", (k / (-0.5 * rho.ln()) - 1.0).abs(), 1e-12);
        assert!((0.0..1e-12).contains(&s));
        // R_w → R_b: S → ∞, as a logarithm, and K/S → that of an opaque coat, (1 - R)²/2R.
        let (s, k) = film_of(rho * (1.0 + 1e-9), rho).expect("is a film");
        let (thinner, _) = film_of(rho * (1.0 + 1e-6), rho).expect("is a film");
        assert!(s > thinner);
        hold("film_of: K/S of opaque films", (k / s * 2.0 * rho / (1.0 - rho).powi(2) - 1.0).abs(), 1e-6);
    }
}

fn what_no_film_reflects_is_refused() {
    let inside = 0.5;
    for (over_white, over_black) in
        [(1.0, 0.5), (0.5, 0.0), (0.5, 0.5), (0.4, 0.5), (1.1, 0.5), (0.5, -0.1), (f64::NAN, 0.5), (0.5, f64::NAN), (f64::INFINITY, 0.5)]
    {
        assert_eq!(film_of(over_white, over_black), None, "{over_white} {over_black}");
        let refused = Paint::from_reflectances("mud", [0.6, 0.6, over_white], [inside, inside, over_black], 1.0, 0.0);
        assert!(matches!(refused, Err(PaintError::Reflectances { channel: "blue", .. })), "{over_white} {over_black}: {refused:?}");
    }
    let refused = Paint::from_reflectances("mud", [0.6, 0.2, 0.6], [0.5, 0.25, 0.5], 1.0, 0.0).expect_err("is no film").to_string();
    assert_eq!(
        refused,
        "paint \"mud\" in green reflects 0.2 over white and 0.25 over black; in linear light 0 < over black < over white < 1 must hold in \
         each channel: no film reflects nothing or everything, nor more over black than over white; measure again, or give K and S"
    );
}

/// A film of thickness d tells the same paint as a film of thickness 1.
fn thicker_films_are_measured_as_well() {
    for pigment in pigments::all() {
        let paint = Paint::from(pigment);
        for thickness in [0.1, 1.0, 2.5] {
            let films = paint.films(thickness);
            let found = Paint::from_reflectances(
                &paint.name,
                films.map(|film| film.over_substrate(1.0)),
                films.map(|film| film.reflectance),
                thickness,
                0.0,
            )
            .expect("is a film");
            let pairs = found.k.iter().zip(&paint.k).chain(found.s.iter().zip(&paint.s));
            // A tenth of the thickness leaves a tenth of 1 - R_w, and 2.5 of it e⁻¹⁷ of R_w - R_b in the darkest channel.
            hold("from_reflectances: thickness", pairs.map(|(found, expected)| (found / expected - 1.0).abs()).worst(), 1e-10);
        }
    }
    let nothing = Paint::from_reflectances("mud", [0.6; 3], [0.5; 3], 0.0, 0.0);
    assert!(matches!(nothing, Err(PaintError::Coefficient { coefficient: "K", channel: "red", .. })), "{nothing:?}");
}

fn films_that_are_all_but_opaque_are_refused_unless_exact() {
    let of = |difference: f64, least| Paint::from_reflectances("mud", [0.5, 0.5, 0.3 + difference], [0.3; 3], 1.0, least);
    assert!(of(1.001 / 255.0, Paint::LEAST_DIFFERENCE).is_ok());
    let refused = of(0.999 / 255.0, Paint::LEAST_DIFFERENCE).expect_err("is too near").to_string();
    assert_eq!(
        refused,
        "paint \"mud\" in blue reflects 0.303918 over white and 0.3 over black, a difference of less than 0.0039: the film is all but \
         opaque and does not tell its scattering; measure a thinner one"
    );
    let exact = of(1e-9, 0.0).expect("is a film");
    let film = exact.films(1.0)[2];
    hold("from_reflectances: exact", (film.over_substrate(1.0) - film.reflectance - 1e-9).abs(), 1e-15);
}
