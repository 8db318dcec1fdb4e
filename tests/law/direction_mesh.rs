use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec2;
use overpaint::data::{Corner, Direction, DirectionMesh};

use crate::support::{Worst, directions, hold, random::Random};

crate::suite! {
    plain: triangles_fill_the_disc_and_know_each_other, weights_sum_to_one_and_reproduce_the_place, a_measured_direction_is_its_own,
        a_sweep_has_no_jumps, the_horizon_is_that_of_the_nearest, cells_are_near;
}

fn places(triangle: &[Corner; 3]) -> [DVec2; 3] {
    triangle.map(|corner| DVec2::from_array(corner.place.map(f64::from)))
}

fn area([a, b, c]: [DVec2; 3]) -> f64 {
    0.5 * (b - a).perp_dot(c - a)
}

/// Triangles are counter-clockwise, each edge is shared with the triangle that is said to be across, and together they have the area of the
/// polygon that those without one enclose: then none overlap. That polygon contains the unit circle.
fn triangles_fill_the_disc_and_know_each_other() {
    for (name, directions) in directions::sets() {
        let mesh = DirectionMesh::new(&directions);
        let triangles = mesh.triangles();
        let (mut sum, mut rim) = (0.0, 0.0);
        for (index, triangle) in triangles.iter().enumerate() {
            let at = places(triangle);
            assert!(area(at) > 0.0, "{name}: {triangle:?}");
            sum += area(at);
            for corner in 0..3 {
                let (start, end) = ((corner + 1) % 3, (corner + 2) % 3);
                assert!(triangle[corner].direction < directions.len());
                match triangle[corner].across {
                    None => {
                        rim += 0.5 * at[start].perp_dot(at[end]);
                        let along = (at[end] - at[start]).normalize();
                        assert!(along.perp_dot(-at[start]) > 1.0, "{name}: the disc is cut off");
                    }
                    Some(across) => {
                        let other = &triangles[across];
                        let back = other.iter().position(|corner| corner.across == Some(index)).expect("knows it too");
                        let edge = [(back + 2) % 3, (back + 1) % 3].map(|corner| (other[corner].place, other[corner].direction));
                        assert_eq!(edge, [start, end].map(|corner| (triangle[corner].place, triangle[corner].direction)), "{name}");
                    }
                }
            }
        }
        hold("direction mesh: area of the triangles less that of their rim", (sum - rim).abs(), 1e-12);
    }
}

/// The place that weights stand for, each corner counted where it stands.
fn weights_sum_to_one_and_reproduce_the_place() {
    let mut random = Random::new(1);
    for (_, directions) in directions::sets() {
        let mesh = DirectionMesh::new(&directions);
        for _ in 0..300 {
            let direction = directions::anywhere(&mut random);
            let weights = mesh.weights(direction);
            assert!(weights.iter().all(|&(index, weight)| weight >= 0.0 && index < directions.len()), "{weights:?}");
            hold("direction mesh: sum of weights less 1", (weights.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs(), 1e-15);
            if direction.theta >= FRAC_PI_2 {
                continue;
            }
            let v = direction.vector();
            let place = DVec2::new(v.x, v.y) / (1.0 + v.z);
            let found = mesh.triangles().iter().filter(|triangle| (0..3).all(|corner| triangle[corner].direction == weights[corner].0));
            let stands = |triangle: &[Corner; 3]| {
                let at = places(triangle);
                (0..3).map(|corner| weights[corner].1 * at[corner]).sum::<DVec2>().distance(place)
            };
            let error = found.map(stands).fold(f64::INFINITY, f64::min);
            // Two weights of at most NEGLIGIBLE each are given to the others, at most 2.2 away.
            hold("direction mesh: distance of the weighted corners", error, 4.4 * DirectionMesh::NEGLIGIBLE);
        }
    }
}

fn a_measured_direction_is_its_own() {
    for (name, directions) in directions::sets() {
        let mesh = DirectionMesh::new(&directions);
        for (index, direction) in directions.iter().enumerate() {
            let first = directions.iter().position(|other| other == direction).expect("is there");
            let own: f64 = mesh.weights(*direction).iter().filter(|(of, _)| *of == first).map(|(_, weight)| weight).sum();
            assert_eq!(own, 1.0, "{name}: direction {index}");
        }
    }
}

/// A random value of each direction, interpolated along ways over the hemisphere, across all edges that they meet.
fn a_sweep_has_no_jumps() {
    const STEPS: usize = 4000;
    let mut random = Random::new(2);
    for (name, directions) in directions::sets() {
        // The largest slope of the interpolated value is that of the thinnest triangle.
        let mesh = DirectionMesh::new(&directions);
        let values: Vec<f64> = directions.iter().map(|_| random.unit()).collect();
        let value = |direction| mesh.weights(direction).iter().map(|&(index, weight)| weight * values[index]).sum::<f64>();
        let slope = |triangle: &[Corner; 3]| {
            let [a, b, c] = places(triangle);
            let [va, vb, vc] = triangle.map(|corner| values[corner.direction]);
            let (u, v) = (b - a, c - a);
            DVec2::new((vb - va) * v.y - (vc - va) * u.y, (vc - va) * u.x - (vb - va) * v.x).length() / u.perp_dot(v)
        };
        let steepest = mesh.triangles().iter().map(slope).worst();
        let at = |way: usize, step: usize| {
            let part = step as f64 / STEPS as f64;
            match way {
                0 => Direction { theta: FRAC_PI_2 * part, phi: 0.1 },
                1 => Direction { theta: 1.3, phi: TAU * part },
                _ => Direction { theta: FRAC_PI_2 * part, phi: 3.0 * TAU * part },
            }
        };
        for way in 0..3 {
            for step in 0..STEPS {
                let (a, b) = (at(way, step), at(way, step + 1));
                // Stereographic coordinates move by at most the angle between the directions; the band of negligible weights steepens by 3 of it.
                let moved = a.vector().distance(b.vector()) * 1.0001;
                let jump = (value(a) - value(b)).abs();
                let allowed = steepest * moved * (1.0 + 4.0 * DirectionMesh::NEGLIGIBLE) + 1e-12;
                assert!(jump <= allowed, "{name}: {jump} on {moved} at {a}, where {allowed} is allowed");
            }
        }
    }
}

/// Down to θ = 90° and below it, and below the outermost directions of a grid at their azimuths nothing changes.
fn the_horizon_is_that_of_the_nearest() {
    let grid = "ubo81".parse::<overpaint::data::Grid>().expect("is a grid").directions();
    let mesh = DirectionMesh::new(&grid);
    for phi in 0..24 {
        for theta in [75.0, 80.0, 89.0, 90.0, 91.0, 130.0] {
            let weights = mesh.weights(Direction::from_degrees(theta, 15.0 * f64::from(phi)));
            let own: f64 = weights.iter().filter(|(of, _)| grid[*of] == Direction::from_degrees(75.0, 15.0 * f64::from(phi))).map(|(_, w)| w).sum();
            // The azimuth is rounded in the grid and here.
            hold("direction mesh: share of others below a direction", 1.0 - own, 1e-12);
        }
    }
    let mesh = DirectionMesh::new(&[Direction::from_degrees(40.0, 10.0)]);
    for phi in 0..36 {
        let weights = mesh.weights(Direction::from_degrees(90.0, 10.0 * f64::from(phi)));
        assert!(weights.iter().all(|(of, _)| *of == 0));
    }
    // Straight down there is no azimuth.
    assert!(mesh.weights(Direction::from_degrees(180.0, 0.0)).iter().all(|(_, weight)| weight.is_finite()));
}

/// The triangle that a cell names holds its middle, or is the one nearest to it.
fn cells_are_near() {
    for (name, directions) in directions::sets() {
        let mesh = DirectionMesh::new(&directions);
        for (cell, &triangle) in mesh.cells(16).iter().enumerate() {
            let middle = DVec2::new((cell % 16) as f64 / 8.0 - 0.9375, (cell / 16) as f64 / 8.0 - 0.9375);
            if middle.length() < 1.0 {
                let [a, b, c] = places(&mesh.triangles()[triangle]).map(|place| place - middle);
                assert!([b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)].iter().all(|area| *area >= -1e-15), "{name}: cell {cell}");
            }
        }
    }
}
