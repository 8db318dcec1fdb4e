//! Interpolation between measured directions, continuous, down to the horizon.
//!
//! Directions are triangulated (Delaunay) in stereographic coordinates p = (x, y)/(1 + z), where the horizon is the unit circle. Below the
//! lowest measured directions stands a ring of further vertices outside that circle, each with the value of the measured direction that is
//! nearest to the horizon there; they stand at the azimuths of the outermost measured directions, so that between those and the horizon a
//! value changes with the azimuth alone. Grids of measuring setups are full of points on a common circle or line: the triangulation takes
//! exact predicates (Shewchuk 1997, crate `spade`), and its points are rounded to [`STEP`] first, so that single precision holds them.

use std::f64::consts::{FRAC_PI_4, TAU};

use glam::{DVec2, DVec3};
use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation};

use super::Direction;

/// A vertex of a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Stereographic coordinates (x, y)/(1 + z).
    pub place: [f32; 2],
    /// Index of the measured direction whose value it has.
    pub direction: usize,
    /// The triangle on the other side of the opposite edge; none at the rim.
    pub across: Option<usize>,
}

/// Triangles between measured directions; together they cover the hemisphere.
#[derive(Debug, Clone, PartialEq)]
pub struct DirectionMesh {
    triangles: Vec<[Corner; 3]>,
}

/// Coordinates are rounded to this: 24 bits hold them up to 2, and it is half a millionth of a degree.
const STEP: f64 = 1.0 / (1 << 22) as f64;

/// Azimuth between vertices of the ring at most.
const GAP: f64 = FRAC_PI_4;

/// Azimuth between vertices of the ring at least.
const MERGED: f64 = 1e-3;

/// A measured direction or a vertex of the ring.
struct Vertex {
    place: Point2<f64>,
    direction: usize,
}

impl HasPosition for Vertex {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.place
    }
}

impl DirectionMesh {
    /// What is taken from each weight before they are made to sum to 1 again: half a last place of the values, which are halves. Next to a
    /// measured direction its weight is 1, whatever the rounding, and so is what is seen there.
    pub const NEGLIGIBLE: f64 = 1.0 / 16384.0;

    /// The mesh of at least one direction; of directions that are equal the first counts.
    ///
    /// # Panics
    /// If there is none: the caller's bug.
    #[must_use]
    pub fn new(directions: &[Direction]) -> Self {
        assert!(!directions.is_empty(), "a mesh of no directions");
        let mut mesh = DelaunayTriangulation::<Vertex>::new();
        let insert = |mesh: &mut DelaunayTriangulation<Vertex>, place: DVec2, direction: usize| {
            let [x, y] = (place / STEP).round().to_array().map(|steps| steps * STEP);
            // Only coordinates that are no number are refused: a direction without a place has no share.
            mesh.insert(Vertex { place: Point2::new(x, y), direction }).ok();
        };
        // A vertex replaces one that stands in its place.
        for (index, direction) in directions.iter().enumerate().rev() {
            insert(&mut mesh, stereographic(*direction), index);
        }
        let hull = mesh.convex_hull().map(|edge| edge.from().position());
        let ring = ring(hull.filter(|place| place.x != 0.0 || place.y != 0.0).map(|place| place.y.atan2(place.x)).collect());
        let vectors: Vec<DVec3> = directions.iter().map(|direction| direction.vector()).collect();
        for azimuth in ring {
            let horizon = DVec2::from_angle(azimuth);
            let toward = |index: usize| vectors[index].dot(horizon.extend(0.0));
            let nearest = (0..vectors.len()).rev().max_by(|&a, &b| toward(a).total_cmp(&toward(b))).unwrap_or(0);
            // Chords of the ring stay outside the unit circle, and rounding does not change that.
            insert(&mut mesh, horizon * (1.001 / (0.5 * GAP).cos()), nearest);
        }
        Self { triangles: triangles(&mesh) }
    }

    /// All triangles, their corners counter-clockwise.
    #[must_use]
    pub fn triangles(&self) -> &[[Corner; 3]] {
        &self.triangles
    }

    /// Measured directions and their weights, which are at least 0 and sum to 1; a direction may be there more than once. What is below the
    /// horizon has those of the horizon.
    #[must_use]
    pub fn weights(&self, direction: Direction) -> [(usize, f64); 3] {
        let (triangle, weights) = self.containing(stereographic(direction));
        let kept = weights.map(|weight| (weight - Self::NEGLIGIBLE).max(0.0));
        let sum: f64 = kept.iter().sum();
        std::array::from_fn(|corner| (self.triangles[triangle][corner].direction, kept[corner] / sum))
    }

    /// Whether a direction lies nearer to the horizon than those measured: in a triangle that has a corner of the ring.
    #[must_use]
    pub fn is_below(&self, direction: Direction) -> bool {
        let (triangle, _) = self.containing(stereographic(direction));
        self.triangles[triangle].iter().any(|corner| DVec2::from_array(corner.place.map(f64::from)).length_squared() > 1.0)
    }

    /// A triangle near the middle of each cell of a grid `[row][column]` of `side` by `side` over the square of ±1 around the zenith: where to
    /// begin the search for the one that holds a place.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a few cells")]
    pub fn cells(&self, side: usize) -> Vec<usize> {
        let middle = |index: usize| (2 * index + 1) as f64 / side as f64 - 1.0;
        (0..side * side).map(|cell| self.containing(DVec2::new(middle(cell % side), middle(cell / side))).0).collect()
    }

    /// The triangle that holds a place, or is nearest to it, and barycentric coordinates there, held to 0 and above.
    fn containing(&self, place: DVec2) -> (usize, [f64; 3]) {
        let barycentric = |corners: &[Corner; 3]| {
            let [a, b, c] = corners.map(|corner| DVec2::from_array(corner.place.map(f64::from)) - place);
            let areas = [b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)];
            areas.map(|area| area / areas.iter().sum::<f64>())
        };
        let least = |weights: &[f64; 3]| weights.iter().copied().fold(f64::INFINITY, f64::min);
        let all = self.triangles.iter().map(barycentric).enumerate();
        let (triangle, weights) = all.max_by(|(_, a), (_, b)| least(a).total_cmp(&least(b))).unwrap_or((0, [1.0, 0.0, 0.0]));
        (triangle, weights.map(|weight| weight.max(0.0)))
    }
}

/// (x, y)/(1 + z); of a direction below the horizon the place of the horizon at its azimuth.
fn stereographic(direction: Direction) -> DVec2 {
    let DVec3 { x, y, z } = direction.vector();
    if z < 0.0 { DVec2::new(x, y).normalize_or_zero() } else { DVec2::new(x, y) / (1.0 + z) }
}

/// Azimuths of the ring: those given, no two of them too near, and others where they are too far apart.
fn ring(mut azimuths: Vec<f64>) -> Vec<f64> {
    azimuths.sort_unstable_by(f64::total_cmp);
    azimuths.dedup_by(|later, earlier| *later - *earlier < MERGED);
    if azimuths.is_empty() {
        azimuths.push(0.0);
    }
    if azimuths.len() > 1 && azimuths[0] + TAU - azimuths[azimuths.len() - 1] < MERGED {
        azimuths.pop();
    }
    let next = azimuths.iter().skip(1).copied().chain([azimuths[0] + TAU]);
    let filled = azimuths.iter().zip(next).flat_map(|(&start, end)| {
        let parts = ((end - start) / GAP - 1e-9).ceil().max(1.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 8")]
        let count = parts as usize;
        #[expect(clippy::cast_precision_loss, reason = "1 to 8")]
        let at = move |part: usize| start + (end - start) * part as f64 / parts;
        (0..count).map(at)
    });
    filled.collect()
}

fn triangles(mesh: &DelaunayTriangulation<Vertex>) -> Vec<[Corner; 3]> {
    let triangle = |face: spade::handles::FaceHandle<'_, spade::handles::InnerTag, Vertex, (), (), ()>| {
        face.adjacent_edges().map(|edge| {
            let vertex = edge.next().to();
            let Point2 { x, y } = vertex.position();
            #[expect(clippy::cast_possible_truncation, reason = "coordinates are rounded so that this is exact")]
            let place = [x as f32, y as f32];
            // The face without a number among the inner ones is that outside.
            let across = edge.rev().face().as_inner().map(|face| face.index() - 1);
            Corner { place, direction: vertex.data().direction, across }
        })
    };
    mesh.inner_faces().map(triangle).collect()
}
