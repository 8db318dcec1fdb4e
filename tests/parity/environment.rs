use glam::{DVec3, dvec2, dvec3};
use overpaint::{
    data::{Environment, Map},
    gpu::{Buffer, Gpu, Recorder},
    model::{ALBEDO_SIZE, ENVIRONMENT_LEVELS, ENVIRONMENT_SOURCE, albedo_node, environment_level, environment_roughness},
    reference, stage,
};

use crate::support::{Worst, hold, probe::probe, random::Random, worst_difference};

crate::suite! { gpu: the_reduced_map_agrees, levels_agree, the_albedo_agrees, places_and_directions_agree, texels_and_weights_agree, levels_of_roughnesses_agree; }

/// Records with `record`, runs it and reads the result.
pub fn run<T: overpaint::gpu::GpuValue>(gpu: &Gpu, record: impl FnOnce(&stage::Environment, &mut Recorder<'_>) -> Buffer<T>) -> Vec<T> {
    let stage = stage::Environment::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let buffer = record(&stage, &mut recorder);
    gpu.submit(recorder).wait(gpu).expect("runs");
    buffer.read(gpu).expect("reads")
}

/// The map that levels are summed from.
pub fn source(gpu: &Gpu, environment: &Environment) -> Vec<[f32; 4]> {
    run(gpu, |stage, recorder| stage.record_source(recorder, environment).expect("records"))
}

/// Texels between 0 and 1, and now and then one of thousands.
pub fn speckled(width: usize, height: usize, seed: u64) -> Environment {
    let mut random = Random::new(seed);
    let radiance = Map::from_fn(width, height, |_, _| {
        let bright = if random.below(200) == 0 { 5000.0 } else { 1.0 };
        [0; 3].map(|_: u8| (bright * random.unit()) as f32)
    });
    Environment::new(radiance).expect("is an environment")
}

fn rgb(values: &[[f32; 4]]) -> impl Iterator<Item = [f64; 3]> {
    values.iter().map(|&[r, g, b, w]| {
        assert_eq!(w, 0.0, "the fourth component");
        [r, g, b].map(f64::from)
    })
}

/// Worst difference over the larger of the value and `floor`.
fn relative(found: impl Iterator<Item = [f64; 3]>, expected: impl Iterator<Item = [f64; 3]>, floor: f64) -> f64 {
    let scaled = found.zip(expected).flat_map(|(found, expected)| {
        [0, 1, 2].map(|channel| (found[channel] - expected[channel]).abs() / expected[channel].max(floor))
    });
    scaled.worst()
}

fn the_reduced_map_agrees(gpu: &Gpu) {
    // Smaller and larger than the result by whole and by broken factors, of odd shapes, and one in more than one band.
    for (width, height) in [(2, 1), (63, 31), (65, 33), (100, 300), (256, 128), (257, 129), (1024, 512), (32768, 3), (3, 5000), (3001, 1100)] {
        let environment = speckled(width, height, 5);
        let found = source(gpu, &environment);
        let expected = reference::environment_source(&environment, ENVIRONMENT_SOURCE);
        // Sums of numbers of one sign: a few last places of 6e-8 for the weights, and a root of the terms of a row.
        let bound = 1e-6 * (1.0 + (width as f64 / 256.0).sqrt());
        hold("environment: reduced, relative", relative(rgb(&found), expected.values().iter().copied(), 1e-3), bound);
    }
}

fn levels_agree(gpu: &Gpu) {
    let environment = speckled(500, 250, 6);
    let source = reference::environment_source(&environment, ENVIRONMENT_SOURCE);
    let mut random = Random::new(7);
    // One texel, both sides of a workgroup, and more than one band of rows.
    for (size, looked_at) in [(1, 1), (7, 6), (8, 6), (65, 40)] {
        let found = run(gpu, |stage, recorder| stage.record(recorder, &environment, size).expect("records"));
        assert_eq!(found.len(), ENVIRONMENT_LEVELS * size * size);
        assert!(rgb(&found).flatten().all(f64::is_finite));
        for level in 0..ENVIRONMENT_LEVELS {
            for _ in 0..looked_at {
                let (column, row) = (random.below(size), random.below(size));
                let place = (dvec2(column as f64, row as f64) + 0.5) / size as f64;
                let expected = reference::environment_prefiltered(
                    &source,
                    environment_roughness(level),
                    reference::octahedral_direction(place),
                );
                let texel = found[(level * size + row) * size + column];
                // In the narrowest lobe, 0.026 wide, a direction's rounding of 6e-8 moves the weight by 1e-5 of itself at the steepest;
                // sums of 256 and of 128 terms add a few last places.
                hold("environment: levels, relative", relative(rgb(&[texel]), [expected].into_iter(), 1e-3), 2e-5);
            }
        }
    }
}

fn the_albedo_agrees(gpu: &Gpu) {
    let found = run(gpu, |stage, recorder| stage.record_albedo(recorder).expect("records"));
    assert_eq!(found.len(), ALBEDO_SIZE * ALBEDO_SIZE);
    // At roughness 0 and cosine 0 the twin's lobe is a point; its limits are a law.
    for roughness in 1..ALBEDO_SIZE {
        for cosine in 1..ALBEDO_SIZE {
            let expected = reference::directional_albedo(albedo_node(roughness), albedo_node(cosine), [200, 64]);
            // Both quadratures: the kernel's 64 x 32 facets have 3e-4 where the horizon cuts a lobe, the twin's 200 x 64 fewer.
            let difference = worst_difference(found[roughness * ALBEDO_SIZE + cosine].map(f64::from), expected);
            hold("environment: directional albedo", difference, 1e-3);
        }
    }
}

const PLACES: &str = crate::probe!(
    "environment",
    "fn probe(index: u32) -> vec4<f32> {
        let given = inputs[index / 2u];
        if index % 2u == 0u {
            return vec4(octahedral_place(given.xyz), 0.0, 0.0);
        }
        return vec4(octahedral_direction(octahedral_place(given.xyz)), 0.0);
    }"
);

/// Axes, edges and faces of the octahedron and directions between them.
pub fn directions(count: usize) -> Vec<DVec3> {
    let mut random = Random::new(8);
    let corners = (0..27).map(|index| dvec3(f64::from(index % 3) - 1.0, f64::from(index / 3 % 3) - 1.0, f64::from(index / 9) - 1.0));
    let mut directions: Vec<DVec3> = corners.filter(|corner| *corner != DVec3::ZERO).map(DVec3::normalize).collect();
    while directions.len() < count {
        let direction = dvec3(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        directions.push(direction.normalize());
    }
    directions
}

fn places_and_directions_agree(gpu: &Gpu) {
    let inputs: Vec<[f32; 4]> = directions(20_000).iter().map(|d| d.extend(0.0).as_vec4().to_array()).collect();
    for (input, found) in inputs.iter().zip(probe(gpu, PLACES, &inputs, 2 * inputs.len()).chunks_exact(2)) {
        let direction = dvec3(f64::from(input[0]), f64::from(input[1]), f64::from(input[2]));
        let [place, back] = [found[0], found[1]].map(|value| value.map(f64::from));
        let expected = reference::octahedral_place(direction);
        // A sum, a quotient and a product near 1: three roundings of 6e-8.
        hold("environment: octahedral place", worst_difference(place[..2].iter().copied(), expected.to_array()), 2.5e-7);
        // There and back: the place's error, up to 2 sqrt(3) times as large on the sphere.
        hold("environment: octahedral direction", worst_difference(back[..3].iter().copied(), direction.to_array()), 8e-7);
        let there = reference::octahedral_direction(expected);
        hold("environment: octahedral round trip of the twin", worst_difference(there.to_array(), direction.normalize().to_array()), 1e-15);
    }
}

const TEXELS: &str = crate::probe!(
    "environment",
    "fn probe(index: u32) -> vec4<f32> {
        let given = inputs[index / 5u];
        let found = octahedral_bilinear(given.xyz, u32(given.w));
        if index % 5u == 4u {
            return found.weights;
        }
        return vec4(vec2<f32>(found.texels[index % 5u]), 0.0, 0.0);
    }"
);

/// The four texels are those whose middles are around the place, weighted so that it is their mean; all are on the map.
fn texels_and_weights_agree(gpu: &Gpu) {
    for size in [1_u32, 2, 5, 128] {
        let inputs: Vec<[f32; 4]> = directions(5000).iter().map(|d| d.extend(f64::from(size)).as_vec4().to_array()).collect();
        for (input, found) in inputs.iter().zip(probe(gpu, TEXELS, &inputs, 5 * inputs.len()).chunks_exact(5)) {
            let direction = dvec3(f64::from(input[0]), f64::from(input[1]), f64::from(input[2]));
            let place = reference::octahedral_place(direction) * f64::from(size) - 0.5;
            let weights = found[4].map(f64::from);
            hold("environment: weights sum to 1", (weights.iter().sum::<f64>() - 1.0).abs(), 2.5e-7);
            for (corner, weight) in weights.into_iter().enumerate() {
                let [column, row, ..] = found[corner];
                assert!(column >= 0.0 && row >= 0.0 && column < size as f32 && row < size as f32, "{found:?} of {size}");
                // Inside the square; over its edges a law tells.
                let [part_x, part_y] = [(place.x - place.x.floor()), (place.y - place.y.floor())];
                let [right, below] = [corner % 2 == 1, corner / 2 == 1];
                let expected = (if right { part_x } else { 1.0 - part_x }) * (if below { part_y } else { 1.0 - part_y });
                let on_plane = place.floor() + dvec2(f64::from(u8::from(right)), f64::from(u8::from(below)));
                if size == 128 && on_plane.cmpge(dvec2(0.0, 0.0)).all() && on_plane.cmplt(dvec2(128.0, 128.0)).all() {
                    // A place is known to 2.5e-7 of the square, 3.2e-5 texels: where it is that near a whole number, the cell may be the next.
                    if (0.001..0.999).contains(&part_x) && (0.001..0.999).contains(&part_y) {
                        assert_eq!([f64::from(column), f64::from(row)], on_plane.to_array());
                        hold("environment: weights", (weight - expected).abs(), 1e-4);
                    }
                }
            }
        }
    }
}

const LEVELS: &str = crate::probe!(
    "environment",
    "fn probe(index: u32) -> vec4<f32> {
        let levels = environment_levels(inputs[index].x, u32(inputs[index].y));
        return vec4(f32(levels.lower), f32(levels.upper), levels.part, 0.0);
    }"
);

fn levels_of_roughnesses_agree(gpu: &Gpu) {
    let inputs: Vec<[f32; 4]> = (1..=1000).map(|step| [step as f32 / 1000.0, ENVIRONMENT_LEVELS as f32, 0.0, 0.0]).collect();
    for (input, found) in inputs.iter().zip(probe(gpu, LEVELS, &inputs, inputs.len())) {
        let [lower, upper, part, _] = found.map(f64::from);
        assert!(upper - lower <= 1.0 && (0.0..=1.0).contains(&part) && upper < ENVIRONMENT_LEVELS as f64, "{found:?}");
        // WGSL's log2 is good to 3 last places, or 2^-21 near 1.
        hold("environment: level", (lower + part - environment_level(f64::from(input[0]))).abs(), 4e-6);
    }
}
