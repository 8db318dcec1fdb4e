use overpaint::{
    gpu::Gpu,
    model::{Film, Layer, kubelka_munk::opaque_reflectance, pigments},
};

use crate::support::{
    Worst, hold,
    paint::{Texel, grey, lay},
    random::Random,
    worst_difference,
};

crate::suite! {
    plain: printed_values_hold_in_f64, films_obey_their_limits, a_divided_film_is_the_film, a_ground_above_white_adds_what_shows_through;
    gpu: printed_values_hold_on_the_gpu, no_coat_leaves_the_ground, an_opaque_coat_hides_the_ground, films_without_absorption_or_scattering,
        a_divided_layer_is_the_layer, more_paint_covers_more, a_white_coat_on_white_stays_white, coverage_is_the_product_of_bare_parts,
        batches_make_no_difference, layers_add_up_and_bare_texels_stay, the_topmost_surface_shows, a_breath_of_paint_has_its_own_surface;
}

/// (s, k, R, T), computed with 30 digits.
const PRINTED: [[f64; 4]; 4] = [
    [0.7, 0.3, 0.323402246879, 0.424950107228],
    [0.05, 0.22, 0.0386590785301, 0.764183535695],
    [1.28, 0.46, 0.404402516234, 0.253124582223],
    [10.0, 0.01, 0.902867130283, 0.0873444910622],
];
/// The second over the third: R, T.
const STACKED: [f64; 2] = [0.278571382790, 0.196505775840];

/// ρ_d and coverage of `grounds` under `layers`, the bottom one first, each with its thickness at every texel.
fn paint(gpu: &Gpu, grounds: &[[f32; 4]], layers: &[(&Layer, &[f32])]) -> Vec<[f32; 4]> {
    let grounds: Vec<_> = grounds.iter().map(|&painted| Texel { painted, ..Texel::bare([0.0; 3]) }).collect();
    lay(gpu, &grounds, layers, 4).into_iter().map(|texel| texel.painted).collect()
}

/// The larger error of a film's two values.
fn apart(film: Film, reflectance: f64, transmittance: f64) -> f64 {
    [film.reflectance - reflectance, film.transmittance - transmittance].map(f64::abs).into_iter().worst()
}

fn printed_values_hold_in_f64() {
    for [s, k, r, t] in PRINTED {
        let film = Film::new(s, k);
        // Twelve digits are printed.
        hold("Film: printed values", apart(film, r, t), 1e-12);
    }
    let [_, second, third, _] = PRINTED.map(|[s, k, ..]| Film::new(s, k));
    let both = second.over(third);
    hold("Film: printed stack", apart(both, STACKED[0], STACKED[1]), 1e-12);
}

fn printed_values_hold_on_the_gpu(gpu: &Gpu) {
    let grounds = [0.0_f32, 0.25, 0.5, 0.75, 1.0].map(|rho| [rho, rho, rho, 0.0]);
    let full = [1.0_f32; 5];
    // R and T from above, and R from below, which the ground sees.
    let check = |layers: &[Layer], [r, t, r_below]: [f64; 3]| {
        let layers: Vec<_> = layers.iter().map(|layer| (layer, &full[..])).collect();
        for (ground, found) in grounds.iter().zip(paint(gpu, &grounds, &layers)) {
            let rho = f64::from(ground[0]);
            let expected = r + t * t * rho / (1.0 - r_below * rho);
            let error = (0..3).map(|channel| (f64::from(found[channel]) - expected).abs()).worst();
            // A few roundings of values below 1, 6e-8 each; the stack has twice as many.
            hold("kubelka_munk: printed values", error, 4e-7);
        }
    };
    for [s, k, r, t] in PRINTED {
        check(&[grey(s, k)], [r, t, r]);
    }
    let [_, second, third, _] = PRINTED.map(|[s, k, ..]| grey(s, k));
    let [second_film, third_film] = [1, 2].map(|index| Film::new(PRINTED[index][0], PRINTED[index][1]));
    check(&[third, second], [STACKED[0], STACKED[1], third_film.over(second_film).reflectance]);
}

/// R∞ and T = 0 without end, the closed forms for K = 0 and S = 0, R = 0 and T = 1 at no thickness; R + T ≤ 1.
fn films_obey_their_limits() {
    assert_eq!(Film::new(0.0, 0.0), Film::NONE);
    let mut random = Random::new(2);
    for _ in 0..10_000 {
        let [s, k] = [(); 2].map(|()| 10_f64.powf(random.between(-6.0, 3.0)));
        let film = Film::new(s, k);
        hold("Film: R + T - 1", film.reflectance + film.transmittance - 1.0, 4e-16);
        let opaque = Film::new(1e9 * s, 1e9 * k);
        // tanh has reached 1, or stands 1/q from it: q is at least 1e3 here.
        hold("Film: opaque", (opaque.reflectance - opaque_reflectance(s, k)).abs(), 1e-6);
        let (clear, black) = (Film::new(s, 0.0), Film::new(0.0, k));
        hold("Film: K = 0", apart(clear, s / (1.0 + s), 1.0 / (1.0 + s)), 4e-16);
        hold("Film: S = 0", apart(black, 0.0, (-k).exp()), 4e-16);
    }
}

/// Films of d/n stacked n times are the film of d (eq. 3.8).
fn a_divided_film_is_the_film() {
    for pigment in pigments::all() {
        for parts in [2, 5, 16] {
            for channel in 0..3 {
                let (s, k) = (2.0 * pigment.s[channel], 2.0 * pigment.k[channel]);
                let whole = Film::new(s, k);
                let part = Film::new(s / f64::from(parts), k / f64::from(parts));
                let stack = (0..parts).fold(Film::NONE, |below, _| part.over(below));
                hold("Film: divided", apart(stack, whole.reflectance, whole.transmittance), 1e-14);
            }
        }
    }
}

fn a_ground_above_white_adds_what_shows_through() {
    let film = Film::new(0.7, 0.3);
    let white = film.over_substrate(1.0);
    hold("Film: ground of 1.5", (film.over_substrate(1.5) - white - 0.5 * film.transmittance.powi(2)).abs(), 1e-14);
    assert_eq!(Film::NONE.over_substrate(1.5), 1.5);
}

fn random_grounds(count: usize) -> Vec<[f32; 4]> {
    let mut random = Random::new(8);
    (0..count).map(|_| [1.5 * random.unit(), random.unit(), 0.1 * random.unit(), 0.0].map(|value| value as f32)).collect()
}

/// Thickness 0 gives the ground's bits back, above white to a rounding.
fn no_coat_leaves_the_ground(gpu: &Gpu) {
    let grounds = random_grounds(1000);
    for pigment in pigments::all() {
        let layer = Layer::new(pigment.into(), 3.0, 0.0);
        for (ground, found) in grounds.iter().zip(paint(gpu, &grounds, &[(&layer, &[0.0; 1000])])) {
            let error = ground.iter().zip(found).map(|(ground, found)| (ground - found).abs()).worst();
            // Nothing is computed below 1; above, a subtraction and a sum.
            hold("kubelka_munk: no coat", error, 1.2e-7);
        }
    }
}

/// Every pigment ten thousand thick is R∞ over any ground.
fn an_opaque_coat_hides_the_ground(gpu: &Gpu) {
    let grounds = random_grounds(100);
    for pigment in pigments::all() {
        let layer = Layer::new(pigment.into(), 1e4, 0.0);
        for found in paint(gpu, &grounds, &[(&layer, &[1.0; 100])]) {
            for ((found, s), k) in found.into_iter().zip(pigment.s).zip(pigment.k) {
                // The film's own parity bound.
                hold("kubelka_munk: opaque", (f64::from(found) - opaque_reflectance(s, k)).abs(), 3e-7);
            }
        }
    }
}

/// K = 0: R = s/(1 + s), T = 1/(1 + s). S = 0: R = 0, T = e^-k. Over black and over grey.
fn films_without_absorption_or_scattering(gpu: &Gpu) {
    let grounds = [[0.0_f32, 0.0, 0.0, 0.0], [0.5, 0.5, 0.5, 0.0]];
    for amount in [1e-6, 1e-3, 0.1, 1.0, 10.0, 80.0, 1e3, 1e6] {
        let (clear, black) = (grey(amount, 0.0), grey(0.0, amount));
        let cases = [(&clear, amount / (1.0 + amount), 1.0 / (1.0 + amount)), (&black, 0.0, (-amount).exp())];
        for (layer, r, t) in cases {
            let found = paint(gpu, &grounds, &[(layer, &[1.0; 2])]);
            for (ground, found) in grounds.iter().zip(found) {
                let rho = f64::from(ground[0]);
                let expected = r + t * t * rho / (1.0 - r * rho);
                // A handful of roundings of values up to 1, and exp.
                hold("kubelka_munk: K = 0 and S = 0", (f64::from(found[1]) - expected).abs(), 3e-7);
            }
        }
    }
}

fn a_divided_layer_is_the_layer(gpu: &Gpu) {
    // Grounds above 1 too: what they have more is seen through the whole stack.
    let grounds = random_grounds(500);
    let drawn = [1.0_f32; 500];
    for pigment in pigments::all() {
        let whole = Layer::new(pigment.into(), 1.5, 0.0);
        let once = paint(gpu, &grounds, &[(&whole, &drawn)]);
        for parts in [2_u32, 5, 16] {
            let part = Layer { thickness: whole.thickness / f64::from(parts), ..whole.clone() };
            let layers = vec![(&part, &drawn[..]); parts as usize];
            for (once, often) in once.iter().zip(paint(gpu, &grounds, &layers)) {
                let error = (0..3).map(|channel| (once[channel] - often[channel]).abs()).worst();
                // Each of sixteen layers is good to 2.5e-7 (parity of the film), and their errors add up.
                hold("kubelka_munk: divided layer", error, 4e-6);
            }
        }
    }
}

/// Towards R∞ and never back, the nearer the thicker.
fn more_paint_covers_more(gpu: &Gpu) {
    const STEPS: usize = 257;
    let drawn: Vec<_> = (0..STEPS).map(|step| step as f32 / 256.0).collect();
    for pigment in pigments::all() {
        let layer = Layer::new(pigment.into(), 20.0, 0.0);
        for rho in [0.0_f32, 0.3, 1.0] {
            let found = paint(gpu, &[[rho, rho, rho, 0.0]; STEPS], &[(&layer, &drawn)]);
            for channel in 0..3 {
                let towards = (opaque_reflectance(pigment.s[channel], pigment.k[channel]) - f64::from(rho)).signum();
                for pair in found.windows(2) {
                    let gain = towards * f64::from(pair[1][channel] - pair[0][channel]);
                    // Roundings of values that no longer change.
                    hold("kubelka_munk: steps away from R∞", -gain, 3e-7);
                }
            }
        }
    }
}

/// Without absorption nothing is lost between film and ground, at any thickness, also where R rounds to 1: the reason why 1 - R
/// is carried by itself.
fn a_white_coat_on_white_stays_white(gpu: &Gpu) {
    for s in [1e-3, 1.0, 1e2, 1e4, 1e6, 1e8, 1e12] {
        let found = paint(gpu, &[[1.0, 1.0, 1.0, 0.0]; 64], &[(&grey(s, 0.0), &[1.0; 64])]);
        // R and T are each good to a rounding or two.
        hold("kubelka_munk: white on white", found.iter().map(|texel| (texel[0] - 1.0).abs()).worst(), 3e-7);
    }
}

fn coverage_is_the_product_of_bare_parts(gpu: &Gpu) {
    let drawn = [0.0_f32, 0.01, 0.025, 0.04, 0.05, 0.5, 1.0];
    let layer = grey(1.0, 1.0);
    let once = paint(gpu, &[[0.5, 0.5, 0.5, 0.0]; 7], &[(&layer, &drawn)]);
    let twice = paint(gpu, &[[0.5, 0.5, 0.5, 0.0]; 7], &[(&layer, &drawn), (&layer, &drawn)]);
    assert_eq!([once[0][3], once[4][3], once[6][3], twice[0][3], twice[5][3]], [0.0, 1.0, 1.0, 0.0, 1.0]);
    // A cubic of values up to 1 in f32.
    hold("kubelka_munk: coverage at half of closed", f64::from((once[2][3] - 0.5).abs()), 2e-7);
    for (once, twice) in once.iter().zip(&twice) {
        let bare = 1.0 - f64::from(once[3]);
        hold("kubelka_munk: coverage of two layers", (f64::from(twice[3]) - (1.0 - bare * bare)).abs(), 2e-7);
    }
}

/// The same layers one by one, in threes and all at once: the same bits, over grounds above 1 too.
fn batches_make_no_difference(gpu: &Gpu) {
    let grounds: Vec<_> = random_grounds(300).into_iter().map(|[r, g, b, _]| Texel::bare([r, g, b])).collect();
    let mut random = Random::new(9);
    let layers: Vec<_> = pigments::all().map(|pigment| Layer::new(pigment.into(), 0.2, 0.3)).collect();
    let drawn: Vec<Vec<f32>> = layers.iter().map(|_| (0..300).map(|_| random.unit() as f32).collect()).collect();
    let layers: Vec<_> = layers.iter().zip(&drawn).map(|(layer, drawn)| (layer, &drawn[..])).collect();
    let [at_once, in_threes, one_by_one] = [layers.len(), 3, 1].map(|batch| lay(gpu, &grounds, &layers, batch));
    assert!(at_once == in_threes && at_once == one_by_one);
}

/// Two layers rise by the sum of their reliefs, exactly in binary fractions; where nothing is drawn no bit changes.
fn layers_add_up_and_bare_texels_stay(gpu: &Gpu) {
    let layers = [0.5, 2.0].map(|relief| Layer { relief, ..grey(1.0, 0.3) });
    let heights = [-1.5_f32, 0.1, 3.0, 0.7];
    let mut grounds = [[0.3, 0.2, 1.4], [0.7, 0.1, 1.1], [0.2; 3], [0.9, 1.5, 0.0]].map(Texel::bare);
    grounds.iter_mut().zip(heights).for_each(|(ground, height)| ground.height = height);
    let drawn = [1.0_f32, 0.0, 0.5, 0.0];
    let painted = lay(gpu, &grounds, &[(&layers[0], &drawn), (&layers[1], &drawn)], 2);
    assert_eq!(painted.iter().map(|texel| texel.height).collect::<Vec<_>>(), [1.0, heights[1], 4.25, heights[3]]);
    for bare in [1, 3] {
        assert_eq!(painted[bare].values()[3..], grounds[bare].values()[3..]);
        // Above 1 the ground is taken apart and put together again.
        hold("kubelka_munk: no layer", worst_difference(painted[bare].values(), grounds[bare].values()), 1.2e-7);
    }
}

/// Of closed layers the last one's surface, whatever is below; of a layer that is half closed over a closed one half of each.
fn the_topmost_surface_shows(gpu: &Gpu) {
    let below = Layer { refractive_index: 1.4, roughness: 0.6, ..grey(1.0, 1.0) };
    let above = Layer { refractive_index: 2.0, roughness: 0.2, ..grey(1.0, 1.0) };
    let drawn = [0.0_f32, 0.025, 1.0];
    let painted = lay(gpu, &[Texel::bare([0.5; 3]); 3], &[(&below, &[1.0; 3]), (&above, &drawn)], 2);
    for (texel, share) in painted.iter().zip([0.0, 0.5, 1.0]) {
        let mixed = |below: f64, above: f64| below + share * (above - below);
        let expected = [mixed(below.coat().f0(), above.coat().f0()), mixed(0.6, 0.2)];
        // One mix of two values below 1.
        hold("kubelka_munk: the topmost surface", worst_difference(texel.values()[4..].iter().copied(), expected), 1e-7);
    }
}

/// However little is drawn, the surface is that of the layer, not what is left of its rounding.
fn a_breath_of_paint_has_its_own_surface(gpu: &Gpu) {
    let layer = Layer { refractive_index: 2.0, roughness: 0.2, ..grey(1.0, 1.0) };
    let drawn: Vec<_> = (0..40).map(|power| 0.5_f32.powi(power)).collect();
    for texel in lay(gpu, &vec![Texel::bare([0.5; 3]); drawn.len()], &[(&layer, &drawn)], 1) {
        assert!(texel.painted[3] >= 0.0 && texel.painted[3] <= 1.0);
        if texel.painted[3] > 1e-19 {
            let expected = [layer.coat().f0(), layer.coat().alpha()];
            // The ratio of covering to coverage is 1, to a rounding.
            hold("kubelka_munk: surface of a breath", worst_difference(texel.values()[4..].iter().copied(), expected), 1e-7);
        }
    }
}
