use std::f64::consts::{FRAC_PI_2, TAU};

use overpaint::{
    data::{Direction, DirectionMesh},
    gpu::{Gpu, Resource, bind},
    stage::pack_directions,
};

use crate::support::{Worst, directions, hold, probe::probe_with, random::Random};

crate::suite! { gpu: weights_agree, two_meshes_share_a_buffer, any_vector_has_weights; }

/// Two values a direction: the measured directions (and mesh, in `inputs[0].w`), then the weights.
const WEIGHTS: &str = crate::probe!(
    "direction_mesh",
    "fn probe(index: u32) -> vec4<f32> {
        let at = inputs[index / 2u + 1u];
        let mesh = DirectionMesh(bitcast<u32>(inputs[0].x), bitcast<u32>(inputs[0].y));
        let found = direction_weights(mesh, at.xyz);
        if index % 2u == 0u {
            return vec4(vec3<f32>(found.directions), 0.0);
        }
        return vec4(found.weights, 0.0);
    }"
);

fn weights(gpu: &Gpu, packed: &[[u32; 4]], [first, side]: [u32; 2], vectors: &[[f32; 3]]) -> Vec<[(usize, f64); 3]> {
    let inputs: Vec<[f32; 4]> = [[f32::from_bits(first), f32::from_bits(side), 0.0, 0.0]]
        .into_iter()
        .chain(vectors.iter().map(|&[x, y, z]| [x, y, z, 0.0]))
        .collect();
    let packed = gpu.upload("directions", packed).expect("fits");
    let resources = [Resource::read::<[u32; 4]>("directions")];
    let found = probe_with(gpu, WEIGHTS, &inputs, 2 * vectors.len(), &resources, &[bind("directions", &packed)]);
    found.as_chunks::<2>().0.iter().map(|[of, weights]| [0, 1, 2].map(|i| (of[i] as usize, f64::from(weights[i])))).collect()
}

/// Weights by measured direction, those of the same one together.
fn by_direction(count: usize, weights: &[(usize, f64); 3]) -> Vec<f64> {
    let mut all = vec![0.0; count];
    weights.iter().for_each(|&(of, weight)| all[of] += weight);
    all
}

fn vector(direction: Direction) -> [f32; 3] {
    direction.vector().as_vec3().to_array()
}

fn weights_agree(gpu: &Gpu) {
    let mut random = Random::new(7);
    for (name, directions) in directions::sets() {
        let mesh = DirectionMesh::new(&directions);
        let mut packed = Vec::new();
        let at = pack_directions(&mesh, &mut packed);
        // Anywhere, each measured direction itself, and on edges: midway between two.
        let middle = |(a, b): (&Direction, &Direction)| Direction::from_vector(a.vector() + b.vector());
        let edges = directions.iter().zip(directions.iter().skip(1)).map(middle);
        let asked: Vec<Direction> =
            (0..5000).map(|_| directions::anywhere(&mut random)).chain(directions.iter().copied()).chain(edges).collect();
        let found = weights(gpu, &packed, at, &asked.iter().map(|direction| vector(*direction)).collect::<Vec<_>>());
        // Places are good to two roundings of numbers up to 1, weights to that over the height of a triangle.
        let height = |corners: &[overpaint::data::Corner; 3]| {
            let [a, b, c] = corners.map(|corner| glam::Vec2::from_array(corner.place).as_dvec2());
            (b - a).perp_dot(c - a) / a.distance(b).max(b.distance(c)).max(c.distance(a))
        };
        let thinnest = mesh.triangles().iter().map(height).fold(f64::INFINITY, f64::min);
        let mut errors = Vec::new();
        for (direction, found) in asked.iter().zip(&found) {
            assert!(found.iter().all(|(of, weight)| *of < directions.len() && *weight >= 0.0), "{name}: {found:?}");
            hold("direction mesh: sum of weights in single precision less 1", (found.iter().map(|(_, w)| w).sum::<f64>() - 1.0).abs(), 3e-7);
            let expected = by_direction(directions.len(), &mesh.weights(*direction));
            let found = by_direction(directions.len(), found);
            errors.push(found.iter().zip(expected).map(|(f, e)| (f - e).abs()).worst());
        }
        hold("direction mesh: weights times the thinnest triangle's height", errors.into_iter().worst() * thinnest.min(1.0), 4e-7);
        // Where it was measured a direction is all there is, unless triangles are thinner than directions can be told apart.
        if thinnest > 0.01 {
            for (found, direction) in found[5000..].iter().zip(&directions) {
                let first = directions.iter().position(|other| other == direction).expect("is there");
                let own: f64 = found.iter().filter(|(of, _)| *of == first).map(|(_, weight)| weight).sum();
                assert_eq!(own, 1.0, "{name}: {direction}");
            }
        }
    }
}

fn two_meshes_share_a_buffer(gpu: &Gpu) {
    let sets = directions::sets();
    let of = |name: &str| &sets.iter().find(|(set, _)| *set == name).expect("is there").1;
    let meshes = ["UBO151", "thesis51"].map(|name| DirectionMesh::new(of(name)));
    let mut packed = Vec::new();
    let at = meshes.each_ref().map(|mesh| pack_directions(mesh, &mut packed));
    let mut random = Random::new(8);
    let asked: Vec<_> = (0..500).map(|_| vector(directions::anywhere(&mut random))).collect();
    for (mesh, at) in meshes.iter().zip(at) {
        let mut alone = Vec::new();
        let at_alone = pack_directions(mesh, &mut alone);
        assert_eq!(weights(gpu, &packed, at, &asked), weights(gpu, &alone, at_alone, &asked));
    }
}

/// Vectors of other lengths, at and below the horizon, straight down; also from any cell at the rim.
fn any_vector_has_weights(gpu: &Gpu) {
    let mut asked: Vec<[f32; 3]> = vec![[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [-0.0, -1.0, -0.0]];
    asked.extend((0..2000).map(|index| vector(Direction { theta: FRAC_PI_2, phi: TAU * f64::from(index) / 2000.0 })));
    asked.extend((0..2000).map(|index| vector(Direction { theta: 2.5, phi: TAU * f64::from(index) / 2000.0 }).map(|x| 1.001 * x)));
    for (name, directions) in directions::sets() {
        let mut packed = Vec::new();
        let at = pack_directions(&DirectionMesh::new(&directions), &mut packed);
        for (found, asked) in weights(gpu, &packed, at, &asked).iter().zip(&asked) {
            let sum: f64 = found.iter().map(|(_, weight)| weight).sum();
            assert!(found.iter().all(|(of, weight)| *of < directions.len() && *weight >= 0.0) && (sum - 1.0).abs() < 1e-6, "{name}: {asked:?}");
        }
    }
}
