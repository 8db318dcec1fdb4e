//! A tube around the (2, 3) torus knot, parametrised by arc length and with a frame that turns as little as may be.
//!
//! Around the knot C(t) = ((R + r cos 3t) cos 2t, (R + r cos 3t) sin 2t, r sin 3t) the frame is carried without rotation (Wang, Jüttler, Zheng
//! and Liu 2008, double reflection). After one round it is turned by an angle; that is taken back evenly along the whole length.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::{Vertex, grid_triangles};

/// Radii of the torus and of the tube.
const MAJOR: f64 = 4.0 / 7.0;
const MINOR: f64 = 2.0 / 7.0;
const TUBE: f64 = 1.0 / 7.0;

/// Cells along the knot and around the tube.
const ALONG: u32 = 320;
const AROUND: u32 = 32;

/// Pieces of the material along the knot: its length over the tube's girth is 10.15.
const PIECES: f64 = 10.0;

/// Steps of the integration from one ring of vertices to the next.
const STEPS: u32 = 8;

/// A place of the knot by t: position, first and second derivative.
fn knot(t: f64) -> [DVec3; 3] {
    let ((s2, c2), (s3, c3)) = ((2.0 * t).sin_cos(), (3.0 * t).sin_cos());
    // Distance from the axis, and the unit vectors away from the axis and around it.
    let [radius, slope, bend] = [MAJOR + MINOR * c3, -3.0 * MINOR * s3, -9.0 * MINOR * c3];
    let (out, round) = (DVec3::new(c2, s2, 0.0), DVec3::new(-s2, c2, 0.0));
    [
        radius * out + DVec3::Z * (MINOR * s3),
        slope * out + 2.0 * radius * round + DVec3::Z * (3.0 * MINOR * c3),
        (bend - 4.0 * radius) * out + 4.0 * slope * round - DVec3::Z * (9.0 * MINOR * s3),
    ]
}

/// A place of the knot: position, unit tangent, and a unit vector across it.
#[derive(Clone, Copy)]
struct Station {
    t: f64,
    position: DVec3,
    along: DVec3,
    across: DVec3,
}

impl Station {
    fn new(t: f64, across: DVec3) -> Self {
        let [position, velocity, _] = knot(t);
        Self { t, position, along: velocity.normalize(), across }
    }

    /// The station at another t, its vector carried there without turning about the knot.
    fn carried(self, t: f64) -> Self {
        let next = Self::new(t, self.across);
        let reflected = |vector: DVec3, mirror: DVec3| vector - mirror * (2.0 * mirror.dot(vector) / mirror.length_squared());
        let chord = next.position - self.position;
        let (across, along) = (reflected(self.across, chord), reflected(self.along, chord));
        Self { across: reflected(across, next.along - along), ..next }
    }

    /// dT/ds.
    fn curvature(self) -> DVec3 {
        let [_, velocity, acceleration] = knot(self.t);
        (acceleration - acceleration.dot(self.along) * self.along) / velocity.length_squared()
    }
}

/// t after a step of arc length (Runge and Kutta, fourth order).
fn stepped(t: f64, length: f64) -> f64 {
    let rate = |t: f64| 1.0 / knot(t)[1].length();
    let a = rate(t);
    let b = rate(t + 0.5 * length * a);
    let c = rate(t + 0.5 * length * b);
    let d = rate(t + length * c);
    t + length * (a + 2.0 * b + 2.0 * c + d) / 6.0
}

pub(super) fn torus_knot() -> (Vec<Vertex>, Vec<[u32; 3]>) {
    // Sums of equal steps converge fast for what is periodic.
    let length = (0..ALONG).map(|step| knot(TAU * f64::from(step) / f64::from(ALONG))[1].length()).sum::<f64>() * TAU / f64::from(ALONG);
    let step = length / f64::from(ALONG * STEPS);
    // Away from the axis of the torus is across the knot where t = 0, at the outermost place.
    let mut station = Station::new(0.0, DVec3::X);
    let mut stations = vec![station];
    for number in 1..=ALONG * STEPS {
        station = station.carried(stepped(station.t, step));
        if number.is_multiple_of(STEPS) {
            stations.push(station);
        }
    }
    let (first, last) = (stations[0], station);
    let turned = last.across.dot(first.along.cross(first.across)).atan2(last.across.dot(first.across));
    let rate = -turned / length;
    let vertex = |column: u32, row: u32| {
        // The last column and row have the positions of the first.
        let (ring, place) = (column % ALONG, f64::from(row % AROUND) / f64::from(AROUND));
        let Station { position, along, across, .. } = stations[ring as usize];
        let (sine, cosine) = (place * TAU + turned * f64::from(ring) / f64::from(ALONG)).sin_cos();
        let normal = cosine * across - sine * along.cross(across);
        // ∂/∂s of position + TUBE normal.
        let bent = 1.0 - TUBE * stations[ring as usize].curvature().dot(normal);
        let tangent = bent * along + TUBE * rate * along.cross(normal);
        let [u, v] = [column, row].map(f64::from);
        Vertex {
            position: position + TUBE * normal,
            normal,
            tangent: tangent.normalize(),
            texture: DVec2::new(PIECES * u / f64::from(ALONG), v / f64::from(AROUND)),
        }
    };
    let vertices = (0..=AROUND).flat_map(|row| (0..=ALONG).map(move |column| vertex(column, row)));
    (vertices.collect(), grid_triangles(ALONG + 1, AROUND + 1))
}
