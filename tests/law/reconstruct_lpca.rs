use std::f64::consts::FRAC_PI_2;

use half::f16;
use overpaint::{
    data::{BtfError, Direction, Grid, Lpca, Map, Pair, nearest_samples},
    gpu::Gpu,
    model::{Boundary, TexelSamples},
    stage::{CompressedBtf, StageError},
};

use crate::support::{
    Worst, directions, hold,
    lpca::{self, Asked, made, product, radiance, reconstruct, upload},
    random::Random,
    worst_difference,
};

crate::suite! {
    plain: a_missing_pair_has_the_nearest_light_of_its_view, pairs_without_directions_are_refused;
    gpu: a_measured_pair_is_its_mean_and_eigenvectors, a_constant_is_a_constant, below_the_measured_lights_radiance_falls_with_the_irradiance, what_is_linear_in_the_mesh_comes_back,
        a_ramp_of_texels_comes_back, nothing_jumps_between_directions, nothing_jumps_between_texels, the_plane_goes_on_as_its_boundary_says,
        radiance_is_not_negative, what_does_not_fit_is_refused;
}

/// What interpolates without a jump, and reproduces what is linear.
const SMOOTH: [TexelSamples; 3] = [TexelSamples::Four, TexelSamples::Nine, TexelSamples::TwentyFive];

fn grid(name: &str) -> Vec<Direction> {
    name.parse::<Grid>().expect("is a grid").directions()
}

fn a_measured_pair_is_its_mean_and_eigenvectors(gpu: &Gpu) {
    let mut random = Random::new(1);
    let (views, lights) = (grid("ubo151"), grid("thesis51"));
    let size = [7, 5];
    let lpca = lpca::random(&mut random, size, product(views.len(), lights.len()), [4, 5]);
    let btf = upload(gpu, &lpca, &views, &lights, Boundary::Periodic);
    for _ in 0..40 {
        let sample = random.below(lpca.pairs.len());
        let Pair { view, light } = lpca.pairs[sample];
        let Lpca { clusters, components, cluster, weights, terms, .. } = &lpca;
        let expected = (0..35).flat_map(|texel| {
            let first = (sample * clusters + cluster.values()[texel] as usize) * (1 + components);
            [0, 1, 2].map(|channel| {
                let term = |index: usize| terms[3 * (first + index) + channel].to_f64();
                let sum: f64 = (0..*components).map(|c| weights[texel * components + c].to_f64() * term(1 + c)).sum();
                (term(0) + sum).max(0.0)
            })
        });
        // At whole places four texels are one.
        for texel_samples in [TexelSamples::One, TexelSamples::Four] {
            let found = reconstruct(gpu, &btf, texel_samples, views[view], lights[light]);
            let found = found.values().iter().flat_map(|&[r, g, b, _]| [r, g, b].map(f64::from));
            // Five products added up, each below 2.
            hold("reconstruct_lpca: a measured pair", worst_difference(found, expected.clone()), 6e-7);
        }
    }
}

fn a_constant_is_a_constant(gpu: &Gpu) {
    let mut random = Random::new(2);
    let color = [0.25, 0.5, 0.125];
    for (_, directions) in directions::sets().into_iter().filter(|(name, _)| *name != "dense") {
        let mean = |_, _, term| if term == 0 { color } else { [0.0; 3] };
        let lpca = made([6, 4], product(directions.len(), 1), [2, 1], |column, _| column % 2, |_, _| 1.0, mean);
        let btf = upload(gpu, &lpca, &directions, &[Direction::from_degrees(30.0, 0.0)], Boundary::Periodic);
        for texel_samples in TexelSamples::ALL {
            let asked: Vec<Asked> = (0..200)
                .map(|_| ([0, 1].map(|_| random.between(-9.0, 9.0)), directions::anywhere(&mut random), directions::anywhere(&mut random)))
                .collect();
            for ((_, view, light), found) in asked.iter().zip(radiance(gpu, &btf, texel_samples, &asked)) {
                // Below the one measured light it falls with the irradiance.
                let left = (light.vector().z / 30.0_f64.to_radians().cos()).min(1.0);
                let expected = if view.theta <= FRAC_PI_2 && light.theta <= FRAC_PI_2 { color.map(|c| left * c) } else { [0.0; 3] };
                // Up to 25 weights of texels and 9 of pairs, whose sums are each rounded.
                hold("reconstruct_lpca: a constant", worst_difference(found, expected), 1e-6);
            }
        }
    }
}

/// As a light sinks from the lowest measured ones to the horizon, radiance falls with its cosine to 0.
fn below_the_measured_lights_radiance_falls_with_the_irradiance(gpu: &Gpu) {
    let directions: Vec<Direction> = "0:1,30:6,60:12".parse::<Grid>().expect("is a grid").directions();
    let lpca = lpca::random(&mut Random::new(8), [6, 4], product(directions.len(), directions.len()), [3, 2]);
    let btf = upload(gpu, &lpca, &directions, &directions, Boundary::Periodic);
    let picture = |theta: f64| reconstruct(gpu, &btf, TexelSamples::One, directions[2], Direction::from_degrees(theta, 30.0));
    let lowest = picture(60.0);
    for theta in [60.0_f64, 65.0, 75.0, 85.0, 90.0] {
        let left = theta.to_radians().cos() / 0.5;
        let expected = lowest.values().iter().flat_map(|pixel| pixel.map(|value| left * f64::from(value))).collect::<Vec<_>>();
        let found = picture(theta).values().iter().flat_map(|pixel| pixel.map(f64::from)).collect::<Vec<_>>();
        // Only red, green and blue: the fourth component is no radiance.
        let rgb = |values: Vec<f64>| values.into_iter().enumerate().filter(|(index, _)| index % 4 < 3).map(|(_, value)| value).collect::<Vec<_>>();
        hold("reconstruct_lpca: a light below the measured ones", worst_difference(rgb(found), rgb(expected)), 2e-6);
    }
}

fn stereographic(direction: Direction) -> glam::DVec2 {
    let v = direction.vector();
    glam::DVec2::new(v.x, v.y) / (1.0 + v.z)
}

/// A radiance that is linear in the stereographic coordinates of view and of light, in mean and eigenvector, at directions between
/// measured ones.
fn what_is_linear_in_the_mesh_comes_back(gpu: &Gpu) {
    let mut random = Random::new(3);
    let directions = grid("ubo81");
    let field = |view: Direction, light: Direction| {
        let (view, light) = (stereographic(view), stereographic(light));
        0.5 + 0.2 * view.x + (0.1 - 0.2 * view.y) * light.x + 0.1 * light.y
    };
    let term = |pair: Pair, _, term| [field(directions[pair.view], directions[pair.light]) * [1.0, 0.25][term]; 3];
    let lpca = made([2, 2], product(81, 81), [1, 1], |_, _| 0, |texel, _| [1.0, -1.0, 0.5, 0.0][texel], term);
    let btf = upload(gpu, &lpca, &directions, &directions, Boundary::Periodic);
    for _ in 0..30 {
        let [view, light] = [0, 1].map(|_| Direction::from_degrees(random.between(0.0, 73.0), random.between(0.0, 360.0)));
        let found = reconstruct(gpu, &btf, TexelSamples::One, view, light);
        let expected = [1.25, 0.75, 1.125, 1.0].map(|factor| factor * field(view, light));
        let found = found.values().iter().map(|pixel| f64::from(pixel[0]));
        // Terms are rounded to halves: 2^-12 of values up to 1; the negligible weights do less.
        hold("reconstruct_lpca: a linear field", worst_difference(found, expected), 5e-4);
    }
}

/// B-splines reproduce what is linear: texels that read their column.
fn a_ramp_of_texels_comes_back(gpu: &Gpu) {
    let mean = |_, cluster, term| if term == 0 { [cluster as f64 / 16.0; 3] } else { [0.0; 3] };
    let zenith = [Direction::from_degrees(0.0, 0.0)];
    let [columns, rows] = [true, false].map(|along| {
        let lpca = made([16, 16], product(1, 1), [16, 0], |column, row| if along { column } else { row }, |_, _| 0.0, mean);
        upload(gpu, &lpca, &zenith, &zenith, Boundary::Periodic)
    });
    let mut random = Random::new(4);
    let asked: Vec<Asked> = (0..500).map(|_| ([0, 1].map(|_| random.between(2.5, 12.5)), zenith[0], zenith[0])).collect();
    for texel_samples in SMOOTH {
        for (axis, btf) in [&columns, &rows].into_iter().enumerate() {
            let found = radiance(gpu, btf, texel_samples, &asked);
            let expected = asked.iter().map(|(place, ..)| f64::from(place[axis] as f32) / 16.0);
            hold("reconstruct_lpca: a ramp of texels", worst_difference(found.iter().map(|rgb| rgb[0]), expected), 1e-6);
        }
    }
}

/// The largest change between neighbours of a way of `steps` steps. That of something continuous shrinks with the steps.
fn largest_step(gpu: &Gpu, btf: &CompressedBtf, texel_samples: TexelSamples, steps: usize, way: &dyn Fn(f64) -> Asked) -> f64 {
    let asked: Vec<Asked> = (0..=steps).map(|step| way(step as f64 / steps as f64)).collect();
    let found = radiance(gpu, btf, texel_samples, &asked);
    found.windows(2).map(|pair| worst_difference(pair[0], pair[1])).worst()
}

/// A sixteenth of the steps' length leaves a sixteenth of the change, but for rounding.
fn shrinks(what: &str, gpu: &Gpu, btf: &CompressedBtf, texel_samples: TexelSamples, way: &dyn Fn(f64) -> Asked) {
    let [long, short] = [1000, 16_000].map(|steps| largest_step(gpu, btf, texel_samples, steps, way));
    assert!(long > 2e-4, "nothing changes on the way");
    hold(what, short / long, 0.08);
}

fn nothing_jumps_between_directions(gpu: &Gpu) {
    let mut random = Random::new(5);
    for (views, lights) in [("ubo81", "thesis51"), ("thesis51", "0:1,40:7"), ("0:1,40:7", "ubo151")] {
        let (views, lights) = (grid(views), grid(lights));
        let mut pairs = product(views.len(), lights.len());
        pairs.retain(|_| random.below(8) > 0);
        let lpca = lpca::random(&mut random, [4, 3], pairs, [3, 2]);
        let btf = upload(gpu, &lpca, &views, &lights, Boundary::Periodic);
        let still = Direction::from_degrees(33.0, 100.0);
        let fall = |part: f64| Direction { theta: FRAC_PI_2 * part, phi: 0.3 };
        let turn = |part: f64| Direction::from_degrees(80.0, 360.0 * part);
        let ways: [&dyn Fn(f64) -> Asked; 4] = [
            &|part| ([1.2, 0.7], fall(part), still),
            &|part| ([1.2, 0.7], turn(part), still),
            &|part| ([1.2, 0.7], still, fall(part)),
            &|part| ([1.2, 0.7], turn(part), fall(1.0 - part)),
        ];
        for way in ways {
            shrinks("reconstruct_lpca: change of a sixteenth of a step of directions", gpu, &btf, TexelSamples::Four, way);
        }
    }
}

fn nothing_jumps_between_texels(gpu: &Gpu) {
    let mut random = Random::new(6);
    let zenith = [Direction::from_degrees(0.0, 0.0)];
    for boundary in [Boundary::Periodic, Boundary::Mirror] {
        let lpca = lpca::random(&mut random, [8, 6], product(1, 1), [5, 3]);
        let btf = upload(gpu, &lpca, &zenith, &zenith, boundary);
        // Across the edges too, through texels' corners and along their borders.
        let ways: [&dyn Fn(f64) -> Asked; 3] = [
            &|part| ([-10.0 + 25.0 * part, 2.3], zenith[0], zenith[0]),
            &|part| ([-10.5 + 25.0 * part, -8.5 + 25.0 * part], zenith[0], zenith[0]),
            &|part| ([1.5, 20.0 * part], zenith[0], zenith[0]),
        ];
        for (way, texel_samples) in ways.into_iter().flat_map(|way| SMOOTH.map(|samples| (way, samples))) {
            shrinks("reconstruct_lpca: change of a sixteenth of a step of places", gpu, &btf, texel_samples, way);
        }
    }
}

fn the_plane_goes_on_as_its_boundary_says(gpu: &Gpu) {
    let mut random = Random::new(7);
    let zenith = [Direction::from_degrees(0.0, 0.0)];
    let lpca = lpca::random(&mut random, [8, 5], product(1, 1), [5, 3]);
    // Places that single precision has, on either side of the edge.
    let places: Vec<[f64; 2]> = (0..400).map(|_| [8, 5].map(|side| random.below(side * 64) as f64 / 64.0 - 0.5)).collect();
    let at = |btf: &CompressedBtf, texel_samples, moved: &dyn Fn([f64; 2]) -> [f64; 2]| {
        let asked: Vec<Asked> = places.iter().map(|&place| (moved(place), zenith[0], zenith[0])).collect();
        radiance(gpu, btf, texel_samples, &asked)
    };
    for texel_samples in SMOOTH {
        let periodic = upload(gpu, &lpca, &zenith, &zenith, Boundary::Periodic);
        let here = at(&periodic, texel_samples, &|place| place);
        assert!(here == at(&periodic, texel_samples, &|[x, y]| [x + 8.0, y - 10.0]));
        let mirror = upload(gpu, &lpca, &zenith, &zenith, Boundary::Mirror);
        let here = at(&mirror, texel_samples, &|place| place);
        assert!(here == at(&mirror, texel_samples, &|[x, y]| [x + 16.0, y - 10.0]));
        // Sums in the other order.
        let across = at(&mirror, texel_samples, &|[x, y]| [-1.0 - x, 9.0 - y]);
        hold("reconstruct_lpca: mirrored", worst_difference(here.into_iter().flatten(), across.into_iter().flatten()), 1e-6);
    }
}

fn radiance_is_not_negative(gpu: &Gpu) {
    let zenith = [Direction::from_degrees(0.0, 0.0)];
    let lpca = made([2, 1], product(1, 1), [1, 1], |_, _| 0, |texel, _| [1.0, -1.0][texel], |_, _, term| [[0.25; 3], [0.5; 3]][term]);
    let btf = upload(gpu, &lpca, &zenith, &zenith, Boundary::Periodic);
    assert_eq!(reconstruct(gpu, &btf, TexelSamples::One, zenith[0], zenith[0]).values(), [[0.75, 0.75, 0.75, 1.0], [0.0, 0.0, 0.0, 1.0]]);
    // After texels are interpolated: midway the mean.
    assert_eq!(radiance(gpu, &btf, TexelSamples::Four, &[([0.5, 0.0], zenith[0], zenith[0])]), [[0.25; 3]]);
}

fn a_missing_pair_has_the_nearest_light_of_its_view() {
    let (views, lights) = (grid("0:1,40:4"), grid("0:1,20:4,60:6"));
    let all = product(5, 11);
    let table = nearest_samples(&all, &views, &lights).expect("is a table");
    assert!(table == Map::from_fn(11, 5, |light, view| 11 * view + light));
    // In any order, the first of equal ones.
    let reversed: Vec<_> = all.iter().rev().chain(&all).copied().collect();
    let table = nearest_samples(&reversed, &views, &lights).expect("is a table");
    assert!(table == Map::from_fn(11, 5, |light, view| 54 - (11 * view + light)));
    // View 2 without the light at 60°, 60°: those at 60°, 0° and 120° are as far, the one at 20°, 90° is nearer than both.
    let pairs: Vec<_> = all.iter().copied().filter(|pair| *pair != Pair { view: 2, light: 6 } && pair.view != 3).collect();
    let table = nearest_samples(&pairs, &views, &lights).expect("is a table");
    let nearest = |wanted: usize| {
        let far = |light: &usize| lights[*light].vector().distance(lights[wanted].vector());
        (0..11).filter(|light| *light != wanted).min_by(|a, b| far(a).total_cmp(&far(b))).expect("there are others")
    };
    assert_eq!(pairs[table[(6, 2)]], Pair { view: 2, light: nearest(6) });
    // View 3 without any: the zenith is nearer than its neighbours at 40° and 90° of azimuth.
    assert!((0..11).all(|light| pairs[table[(light, 3)]] == Pair { view: 0, light }));
    // All others are their own.
    let own = |pair: &&Pair| pair.view != 3 && **pair != Pair { view: 2, light: 6 };
    assert!(all.iter().filter(own).all(|pair| pairs[table[(pair.light, pair.view)]] == *pair));
}

fn pairs_without_directions_are_refused() {
    let (views, lights) = (grid("0:1,40:4"), grid("zenith"));
    assert_eq!(nearest_samples(&[], &views, &lights), Err(BtfError::Empty));
    let pair = Pair { view: 1, light: 1 };
    assert_eq!(nearest_samples(&[pair], &views, &lights), Err(BtfError::PairOutOfRange { pair, views: 5, lights: 1 }));
}

fn what_does_not_fit_is_refused(gpu: &Gpu) {
    let zenith = [Direction::from_degrees(0.0, 0.0)];
    let lpca = made([1, 1], product(1, 1), [1, 0], |_, _| 0, |_, _| 0.0, |_, _, _| [0.5; 3]);
    let many = vec![zenith[0]; (gpu.max_array_bytes() / 4).isqrt() as usize + 1];
    let refused = CompressedBtf::upload(gpu, &lpca, &many, &many, Boundary::Periodic);
    assert!(matches!(refused, Err(StageError::TooManyDirections { views, bytes, limit, .. }) if views == many.len() && bytes > limit));
    // Only where the limit is low enough to have as much in memory.
    if gpu.max_array_bytes() <= 1 << 28 {
        let terms = gpu.max_array_bytes() as usize / 8 + 1;
        let large = Lpca { terms: vec![f16::ONE; 3 * terms], clusters: terms, ..lpca };
        large.check([1, 1]).expect("fits together");
        let refused = CompressedBtf::upload(gpu, &large, &zenith, &zenith, Boundary::Periodic).expect_err("is too large").to_string();
        assert!(refused.contains("--clusters") && refused.contains(&format!("{} bytes", 8 * terms)), "{refused}");
    }
}
