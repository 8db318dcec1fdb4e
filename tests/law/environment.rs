use std::f64::consts::{LN_2, PI, TAU};

use glam::{DVec3, dvec2, dvec3};
use overpaint::{
    data::{Environment, EnvironmentError, Map},
    gpu::Gpu,
    model::{
        ALBEDO_SIZE, ENVIRONMENT_LEVELS, ENVIRONMENT_SOURCE, albedo_node, environment_level, environment_roughness, microfacet::ggx_specular,
    },
    reference,
};

use crate::{
    parity::environment::{directions, run, source, speckled},
    support::{Worst, hold, probe::probe_with, random::Random, worst_difference},
};

crate::suite! {
    plain: the_picture_lies_as_stated, looking_up_is_bilinear, what_is_no_environment_is_refused, built_in_ones_are_what_they_say,
        levels_are_inverses;
    gpu: a_uniform_environment_stays, all_light_stays, the_roughest_level_is_irradiance, a_turned_environment_turns,
        look_ups_are_continuous, a_level_is_what_a_surface_reflects, the_albedo_has_its_closed_forms, the_table_is_fine_enough;
}

/// The middle column is at +z; facing it with y up, +x is to the left and -x to the right; -z is where the edges meet.
fn the_picture_lies_as_stated() {
    let environment = Environment::new(Map::from_fn(8, 4, |column, row| [column as f32, row as f32, 0.0])).expect("is one");
    let seen = |direction: DVec3| environment.radiance(direction)[..2].to_vec();
    // Each is where four texels meet; of -z the first and the last column, 0 and 7.
    for (direction, expected) in [(DVec3::Z, [3.5, 1.5]), (DVec3::X, [1.5, 1.5]), (DVec3::NEG_X, [5.5, 1.5]), (DVec3::NEG_Z, [3.5, 1.5])] {
        hold("environment: where the picture lies", worst_difference(seen(direction), expected), 1e-12);
    }
    let behind = seen(dvec3(0.1, 0.0, -2.0));
    assert!(behind[0] < 3.5, "+x of -z is at the left edge: {behind:?}");
    assert!(seen(dvec3(0.1, 3.0, 0.2))[1] == 0.0 && seen(dvec3(0.1, -3.0, 0.2))[1] == 3.0);
    for (column, row) in [(0, 0), (7, 3), (4, 1)] {
        let found = environment.radiance(environment.direction([column, row]));
        hold("environment: middles of texels", worst_difference(found, [column as f64, row as f64, 0.0]), 1e-12);
    }
    // The azimuth is that of cameras: from +z to +x.
    let first = environment.direction([3, 1]);
    assert!(first.x > 0.0 && first.z > 0.0 && first.y > 0.0, "{first}");
}

fn looking_up_is_bilinear() {
    let environment = speckled(16, 8, 3);
    let mut random = Random::new(4);
    for _ in 0..1000 {
        // Between four middles, also across the picture's left and right edge.
        let (column, row) = (random.below(16), random.below(7));
        let (across, down) = (random.unit(), random.unit());
        let azimuth = PI - TAU * (column as f64 + across + 0.5) / 16.0;
        let elevation = 0.5 * PI - PI * (row as f64 + down + 0.5) / 8.0;
        let direction = 3.0 * dvec3(azimuth.sin() * elevation.cos(), elevation.sin(), azimuth.cos() * elevation.cos());
        let at = |column: usize, row: usize| f64::from(environment.map()[(column % 16, row)][1]);
        let upper = at(column, row) + across * (at(column + 1, row) - at(column, row));
        let lower = at(column, row + 1) + across * (at(column + 1, row + 1) - at(column, row + 1));
        hold("environment: bilinear", (environment.radiance(direction)[1] - (upper + down * (lower - upper))).abs() / 5000.0, 1e-12);
    }
    // Straight up and down there is no azimuth.
    assert!([DVec3::Y, DVec3::NEG_Y].iter().all(|&pole| environment.radiance(pole).iter().all(|value| value.is_finite())));
}

fn what_is_no_environment_is_refused() {
    for (width, height) in [(1, 1), (0, 0), (2, 0), (Environment::MAX_SIDE + 1, 1), (2, Environment::MAX_SIDE + 1)] {
        let found = Environment::new(Map::from_fn(width, height, |_, _| [1.0; 3]));
        assert!(matches!(found, Err(EnvironmentError::Size { .. })), "{width} x {height}");
    }
    assert!(Environment::check_size([Environment::MAX_SIDE, Environment::MAX_SIDE]).is_err());
    assert!(Environment::check_size([Environment::MAX_SIDE, Environment::MAX_TEXELS / Environment::MAX_SIDE]).is_ok());
    for wrong in [-1e-3, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e21] {
        let radiance = Map::from_fn(4, 2, |column, row| [0.0, if (column, row) == (3, 1) { wrong } else { 1.0 }, 0.0]);
        let error = Environment::new(radiance).expect_err("is none").to_string();
        assert!(error.contains("column 3, row 1") && error.contains("from 0 to 1e20"), "{error}");
        assert!(Environment::uniform([0.0, wrong, 0.0]).is_err());
    }
}

fn built_in_ones_are_what_they_say() {
    let reads = |environment: &Environment, normal: DVec3| {
        let source = reference::environment_source(environment, ENVIRONMENT_SOURCE);
        reference::environment_prefiltered(&source, 1.0, normal)
    };
    for environment in [Environment::studio(), Environment::sky()] {
        Environment::new(environment.map().clone()).expect("is an environment");
    }
    hold("environment: a white surface in the studio", (reads(&Environment::studio(), DVec3::Z)[1] - 0.9).abs(), 0.05);
    let (sky, mut shaded) = (Environment::sky(), Environment::sky().map().clone());
    for texel in 0..shaded.values().len() {
        let place = (texel % shaded.width(), texel / shaded.width());
        shaded[place] = shaded[place].map(|value| value.min(1.0));
    }
    let [all, shaded] = [sky, Environment::new(shaded).expect("is one")].map(|environment| reads(&environment, DVec3::Y)[1]);
    hold("environment: sun over sky, less 3", ((all - shaded) / shaded - 3.0).abs(), 0.3);
}

fn levels_are_inverses() {
    assert_eq!(environment_roughness(ENVIRONMENT_LEVELS - 1), 1.0);
    for level in 0..ENVIRONMENT_LEVELS {
        hold("environment: level of its roughness", (environment_level(environment_roughness(level)) - level as f64).abs(), 1e-12);
    }
    assert_eq!([0.0, 0.01, 1.0, 2.0].map(environment_level), [0.0, 0.0, 7.0, 7.0]);
}

fn levels(gpu: &Gpu, environment: &Environment, size: usize) -> Vec<[f32; 4]> {
    run(gpu, |stage, recorder| stage.record(recorder, environment, size).expect("records"))
}

fn a_uniform_environment_stays(gpu: &Gpu) {
    for radiance in [[1.0, 0.25, 3.0], [0.0; 3], [1e20, 1e-20, 1.0]] {
        let environment = Environment::uniform(radiance).expect("is one");
        for found in source(gpu, &environment).iter().chain(&levels(gpu, &environment, 16)) {
            // Numerator and denominator are sums of the same weights, a last place apart in each of some sums.
            let relative = (0..3).map(|channel| (found[channel] - radiance[channel]).abs() / radiance[channel].max(1e-30));
            hold("environment: uniform", relative.worst(), 2e-6);
        }
    }
}

/// Light, and its first moments, which tell from where it comes.
fn all_light_stays(gpu: &Gpu) {
    let moments = |width: usize, height: usize, value: &dyn Fn(usize, usize) -> f64| {
        let mut sums = [0.0; 4];
        for texel in 0..width * height {
            let (column, row) = (texel % width, texel / width);
            // Integrals of 1, x, y, z over a texel in closed form.
            let [top, bottom] = [row, row + 1].map(|row| 0.5 * PI - PI * row as f64 / height as f64);
            let [left, right] = [column, column + 1].map(|column| PI - TAU * column as f64 / width as f64);
            let squares = |e: f64| 0.5 * (e + 0.5 * (2.0 * e).sin());
            let (cosines, sines) = (squares(top) - squares(bottom), 0.5 * (top.sin().powi(2) - bottom.sin().powi(2)));
            let integrals = [
                (left - right) * (top.sin() - bottom.sin()),
                (right.cos() - left.cos()) * cosines,
                (left - right) * sines,
                (left.sin() - right.sin()) * cosines,
            ];
            for (sum, integral) in sums.iter_mut().zip(integrals) {
                *sum += integral * value(column, row);
            }
        }
        sums
    };
    for (width, height) in [(2, 1), (37, 11), (256, 128), (601, 333)] {
        let environment = speckled(width, height, 9);
        let found = source(gpu, &environment);
        let [columns, rows] = ENVIRONMENT_SOURCE;
        let before = moments(width, height, &|column, row| f64::from(environment.map()[(column, row)][0]));
        let after = moments(columns, rows, &|column, row| f64::from(found[row * columns + column][0]));
        hold("environment: light of the reduced map", (after[0] / before[0] - 1.0).abs(), 1e-6);
        // Light moves within a texel of 1.4 degrees only: by less than half of that, to all sides.
        let moved = dvec3(after[1] - before[1], after[2] - before[2], after[3] - before[3]).length() / before[0];
        hold("environment: place of the light of the reduced map", moved, 0.5 * PI / rows as f64);
    }
}

/// What a white Lambertian surface reads under one bright texel: its cosine times the solid angle over π, of a texel in closed form where
/// all of it is above the horizon.
fn the_roughest_level_is_irradiance(gpu: &Gpu) {
    let (width, height, size) = (16, 8, 32);
    let last = (ENVIRONMENT_LEVELS - 1) * size * size;
    for lit in [(0, 0), (5, 3), (15, 4), (8, 7)] {
        let radiance = Map::from_fn(width, height, |column, row| if (column, row) == lit { [1000.0; 3] } else { [0.0; 3] });
        let environment = Environment::new(radiance).expect("is one");
        let levels = levels(gpu, &environment, size);
        let [top, bottom] = [lit.1, lit.1 + 1].map(|row| 0.5 * PI - PI * row as f64 / height as f64);
        let [left, right] = [lit.0, lit.0 + 1].map(|column| PI - TAU * column as f64 / width as f64);
        let squares = |e: f64| 0.5 * (e + 0.5 * (2.0 * e).sin());
        let flux = dvec3(
            (right.cos() - left.cos()) * (squares(top) - squares(bottom)),
            (left - right) * 0.5 * (top.sin().powi(2) - bottom.sin().powi(2)),
            (left.sin() - right.sin()) * (squares(top) - squares(bottom)),
        );
        let mut compared = 0;
        for texel in 0..size * size {
            let place = dvec2((texel % size) as f64 + 0.5, (texel / size) as f64 + 0.5) / size as f64;
            let normal = reference::octahedral_direction(place);
            let corners = [[left, top], [right, top], [left, bottom], [right, bottom]]
                .map(|[a, e]| normal.dot(dvec3(a.sin() * e.cos(), e.sin(), a.cos() * e.cos())));
            // Corners are its extremes, but for the bulge of its upper and lower edges.
            let found = f64::from(levels[last + texel][0]);
            if corners.iter().all(|&cosine| cosine > 0.15) {
                let expected = 1000.0 * normal.dot(flux) / PI;
                // Light of a texel of the source counts as from its middle: next to a pole, where this texel is 16 rows high, that is off
                // by 1/16 squared of a few tenths.
                hold("environment: irradiance of one texel", (found / expected - 1.0).abs(), 1e-3);
                compared += 1;
            } else if corners.iter().all(|&cosine| cosine < -0.15) {
                assert_eq!(found, 0.0);
            }
        }
        assert!(compared > size * size / 5, "{compared}");
    }
}

/// A quarter turn around y moves columns of the picture by a quarter, and quadrants of the octahedral map.
fn a_turned_environment_turns(gpu: &Gpu) {
    let (width, height, size) = (64, 32, 16);
    let environment = speckled(width, height, 11);
    // What was at azimuth a is at a + 90°: 16 columns further to the left.
    let turned = Map::from_fn(width, height, |column, row| environment.map()[((column + width / 4) % width, row)]);
    let turned = Environment::new(turned).expect("is one");
    let [before, after] = [environment, turned].map(|environment| levels(gpu, &environment, size));
    for level in 0..ENVIRONMENT_LEVELS {
        for (column, row) in (0..size * size).map(|texel| (texel % size, texel / size)) {
            // (x, z) becomes (z, -x), on the plane of the map as on the sphere.
            let (to_column, to_row) = (row, size - 1 - column);
            let here = before[(level * size + row) * size + column];
            let there = after[(level * size + to_row) * size + to_column];
            let relative = (0..3).map(|channel| (there[channel] - here[channel]).abs() / here[channel].max(1e-3));
            // As the parity of levels: rounding of directions in the narrowest lobe.
            hold("environment: a quarter turn, relative", relative.worst(), 4e-5);
        }
    }
}

const LOOK_UP: &str = crate::probe!(
    "environment",
    "@group(0) @binding(2) var<storage, read> map: array<vec4<f32>>;
    fn probe(index: u32) -> vec4<f32> {
        let given = inputs[index];
        let size = u32(given.w);
        let found = octahedral_bilinear(given.xyz, size);
        var sum = vec4(0.0);
        for (var corner = 0u; corner < 4u; corner++) {
            sum += found.weights[corner] * map[found.texels[corner].y * size + found.texels[corner].x];
        }
        return sum;
    }"
);

/// A map looked up at `directions`.
fn look_up(gpu: &Gpu, map: &[[f32; 4]], size: usize, directions: &[DVec3]) -> Vec<[f32; 4]> {
    let inputs: Vec<[f32; 4]> = directions.iter().map(|d| d.extend(size as f64).as_vec4().to_array()).collect();
    let map = gpu.upload("map", map).expect("fits");
    let resources = [overpaint::gpu::Resource::read::<[f32; 4]>("map")];
    probe_with(gpu, LOOK_UP, &inputs, inputs.len(), &resources, &[overpaint::gpu::bind("map", &map)])
}

/// Over the whole sphere, edges and corners of the square included: a small step changes a look-up by little, and a map of a smooth
/// function is that function.
fn look_ups_are_continuous(gpu: &Gpu) {
    let mut random = Random::new(12);
    let size = 8;
    let noise: Vec<[f32; 4]> = (0..size * size).map(|_| [random.unit() as f32, 0.0, 0.0, 0.0]).collect();
    let mut steps = Vec::new();
    for direction in directions(4000).into_iter().filter(|d| d.x.hypot(d.y) > 0.5) {
        // Anywhere, and on the edges of the square.
        let edge = dvec3(direction.x, -direction.y.abs(), 0.0);
        for base in [direction, edge] {
            steps.push(base);
            steps.push(base + 1e-4 * dvec3(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)));
        }
    }
    for pair in look_up(gpu, &noise, size, &steps).chunks_exact(2) {
        // Steps are up to 1.7e-4, up to twice that for a direction shorter than 1, and up to 3 times that on a plane that is 2 wide; the noise
        // changes by up to 2 a texel.
        hold("environment: continuity", f64::from((pair[0][0] - pair[1][0]).abs()), 1.7e-4 * 2.0 * 3.0 * 0.5 * 8.0 * 2.0);
    }
    let size = 128;
    let smooth = |d: DVec3| 2.0 + d.x - 0.5 * d.y + 0.7 * d.z * d.x;
    let map: Vec<[f32; 4]> = (0..size * size)
        .map(|texel| {
            let place = dvec2((texel % size) as f64 + 0.5, (texel / size) as f64 + 0.5) / size as f64;
            [smooth(reference::octahedral_direction(place)) as f32, 0.0, 0.0, 0.0]
        })
        .collect();
    let directions = directions(20_000);
    let found = look_up(gpu, &map, size, &directions);
    for (direction, found) in directions.iter().zip(found) {
        // A texel is up to 0.036 wide; where faces meet in an edge, up to a quarter of that is rounded off.
        hold("environment: interpolation", (f64::from(found[0]) - smooth(*direction)).abs(), 0.01);
    }
}

/// Seen straight down, a level is the mean over what the surface's facets reflect, but for the factor that stands for their masking.
fn a_level_is_what_a_surface_reflects(gpu: &Gpu) {
    let [columns, rows] = ENVIRONMENT_SOURCE;
    let light = |column: usize, row: usize| {
        let (azimuth, polar) = (PI - TAU * (column as f64 + 0.5) / columns as f64, PI * (row as f64 + 0.5) / rows as f64);
        dvec3(azimuth.sin() * polar.sin(), polar.cos(), azimuth.cos() * polar.sin())
    };
    let slope = dvec3(0.3, 0.2, 0.4);
    let value = |column: usize, row: usize| 1.0 + slope.dot(light(column, row));
    let environment = Environment::new(Map::from_fn(columns, rows, |column, row| [value(column, row) as f32; 3])).expect("is one");
    let size = 8;
    let levels = levels(gpu, &environment, size);
    for level in 0..ENVIRONMENT_LEVELS {
        for texel in [0, 13, 35, 63] {
            let place = dvec2((texel % size) as f64 + 0.5, (texel / size) as f64 + 0.5) / size as f64;
            let normal = reference::octahedral_direction(place);
            let (mut reflected, mut albedo) = (0.0, 0.0);
            for (column, row) in (0..columns * rows).map(|texel| (texel % columns, texel / columns)) {
                let light = light(column, row);
                let weight = ggx_specular(normal, normal, light, environment_roughness(level), 1.0) * light.x.hypot(light.z);
                reflected += weight * value(column, row);
                albedo += weight;
            }
            let found = f64::from(levels[level * size * size + texel][0]);
            // n·l in place of 2 n·l / (n·l + sqrt(α² + (1 - α²) (n·l)²)): the mean cosines differ by 0.056 at most, here times 0.54.
            hold("environment: reflection straight back", (found - reflected / albedo).abs(), 0.031);
        }
    }
}

fn the_albedo_has_its_closed_forms(gpu: &Gpu) {
    let found = run(gpu, |stage, recorder| stage.record_albedo(recorder).expect("records"));
    let at = |roughness: usize, cosine: usize| found[roughness * ALBEDO_SIZE + cosine].map(f64::from);
    for cosine in 0..ALBEDO_SIZE {
        let c = albedo_node(cosine);
        // A mirror reflects as Schlick says: F0 (1 - (1 - c)^5) + (1 - c)^5.
        let schlick = (1.0 - c).powi(5);
        hold("environment: albedo of a mirror", worst_difference(at(0, cosine), [1.0 - schlick, schlick]), 1e-3);
        // At roughness 1 facets are a hemisphere, D G2/(4 cos cos) = 1/(2π (n·l + n·v)), and the integral of x/(x + c) is 1 - c ln((1 + c)/c).
        let rough = if c > 0.0 { 1.0 - c * ((1.0 + c) / c).ln() } else { 1.0 };
        let [scale, bias] = at(ALBEDO_SIZE - 1, cosine);
        hold("environment: albedo at roughness 1", (scale + bias - rough).abs(), 1e-3);
        for roughness in 0..ALBEDO_SIZE {
            let [scale, bias] = at(roughness, cosine);
            assert!(scale >= 0.0 && bias >= 0.0, "{roughness} {cosine}: {scale} {bias}");
            hold("environment: furnace, albedo - 1", scale + bias - 1.0, 1e-6);
        }
    }
    let [scale, bias] = at(ALBEDO_SIZE - 1, ALBEDO_SIZE - 1);
    hold("environment: albedo at roughness 1 from above", (scale + bias - (1.0 - LN_2)).abs(), 1e-4);
}

const ALBEDO: &str = crate::probe!(
    "environment",
    "@group(0) @binding(2) var<storage, read> albedo: array<vec2<f32>>;
    fn probe(index: u32) -> vec4<f32> {
        let found = albedo_bilinear(inputs[index].x, inputs[index].y, 32u);
        var sum = vec2(0.0);
        for (var corner = 0u; corner < 4u; corner++) {
            sum += found.weights[corner] * albedo[found.texels[corner].y * 32u + found.texels[corner].x];
        }
        return vec4(sum, 0.0, 0.0);
    }"
);

/// Between the table's entries, for the roughnesses of paint.
fn the_table_is_fine_enough(gpu: &Gpu) {
    let table = run(gpu, |stage, recorder| stage.record_albedo(recorder).expect("records"));
    let table = gpu.upload("albedo", &table).expect("fits");
    let mut random = Random::new(14);
    let mut inputs: Vec<[f32; 4]> =
        (0..400).map(|_| [random.between(0.01, 1.0) as f32, random.between(0.01, 1.0) as f32, 0.0, 0.0]).collect();
    inputs.extend([[0.01, 0.02, 0.0, 0.0], [1.0, 1.0, 0.0, 0.0], [0.3, 1.0, 0.0, 0.0]]);
    let resources = [overpaint::gpu::Resource::read::<[f32; 2]>("albedo")];
    let found = probe_with(gpu, ALBEDO, &inputs, inputs.len(), &resources, &[overpaint::gpu::bind("albedo", &table)]);
    for (input, found) in inputs.iter().zip(found) {
        let expected = reference::directional_albedo(f64::from(input[0]), f64::from(input[1]), [200, 64]);
        // Linear over steps of 1/31 in the roots: an eighth of their squares times second derivatives of up to 60.
        hold("environment: albedo between entries", worst_difference(found[..2].iter().map(|&value| f64::from(value)), expected), 8e-3);
    }
}
