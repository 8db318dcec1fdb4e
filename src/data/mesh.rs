//! Triangles with everything that a material needs at a vertex.
//!
//! Texture coordinates (u, v) are in units of one piece of the material, u to its right, v **up**: row 0 of a map is at v = 1. A vertex's
//! tangent points to where u grows, its bitangent w cross(normal, tangent) to where v grows, its normal out: they are the material's x, y and
//! z. Where w = -1 the material lies mirrored. Seen from outside, the corners of a triangle run counter-clockwise.

use std::collections::HashMap;

use glam::DVec3;

/// The most vertices of a mesh, and the most triangles: single precision counts them.
pub const MAX_VERTICES: usize = 1 << 24;

/// The largest magnitude of a coordinate of a position, whose square single precision still holds.
pub const MAX_POSITION: f32 = 1e12;

/// The largest magnitude of a texture coordinate: beyond it, single precision tells fewer than 16 places in a piece apart.
pub const MAX_TEXTURE_COORDINATE: f32 = 1e6;

/// How far a vector's length may be from 1, and a tangent's cosine to the normal from 0.
const TOLERANCE: f32 = 1e-3;

/// What keeps arrays from being a mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// No triangles.
    #[error("a mesh needs at least one triangle")]
    Empty,
    /// More of something than a mesh may have.
    #[error("{found} {what} are more than the {most} of a mesh; simplify it")]
    TooMany {
        /// "vertices" or "triangles".
        what: &'static str,
        /// Number of them.
        found: usize,
        /// The largest number.
        most: usize,
    },
    /// Arrays of different lengths.
    #[error("{found} {what} do not go with {vertices} positions; give each vertex one")]
    Length {
        /// Which array.
        what: &'static str,
        /// Its length.
        found: usize,
        /// Number of positions.
        vertices: usize,
    },
    /// A triangle of vertices that are not there.
    #[error("triangle {triangle} names vertex {index}, but the {vertices} vertices are numbered from 0; correct its indices")]
    Index {
        /// The triangle.
        triangle: usize,
        /// The vertex it names.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A value that is no number, or too large.
    #[error("the {what} of vertex {vertex} has the component {value}; expected a number of magnitude {most:e} at most")]
    Number {
        /// Which array.
        what: &'static str,
        /// The vertex.
        vertex: usize,
        /// The component.
        value: f32,
        /// The largest magnitude.
        most: f32,
    },
    /// A direction that is not of length 1.
    #[error("the {what} of vertex {vertex} has length {length}; expected 1")]
    NotUnit {
        /// "normal" or "tangent".
        what: &'static str,
        /// The vertex.
        vertex: usize,
        /// Its length.
        length: f32,
    },
    /// A tangent that is not across its normal, or a fourth component that is not a sign.
    #[error("the tangent of vertex {vertex} has the cosine {cosine} to the normal and w = {w}; expected 0, and -1 or 1")]
    Frame {
        /// The vertex.
        vertex: usize,
        /// Cosine of tangent and normal.
        cosine: f32,
        /// The tangent's fourth component.
        w: f32,
    },
    /// A vertex of so many triangles that its tangent would take too long.
    #[error(
        "{triangles} triangles meet at {place:?}, more than the {most} that tangents are made for; give the fan a ring of vertices around its middle"
    )]
    Crowded {
        /// Where they meet.
        place: [f32; 3],
        /// Number of them.
        triangles: u32,
        /// The largest number.
        most: u32,
    },
}

/// A checked triangle mesh: each vertex has a position, a unit normal, a unit tangent across it with a sign, and texture coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    tangents: Vec<[f32; 4]>,
    texture_coordinates: Vec<[f32; 2]>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// A mesh of these arrays; for what they mean see the module.
    ///
    /// # Errors
    /// [`MeshError`] if their lengths differ, there are too many, an index is out of range, a value is not finite or too large, or a normal
    /// and tangent are not of length 1 and across each other.
    pub fn new(
        positions: Vec<[f32; 3]>, normals: Vec<[f32; 3]>, tangents: Vec<[f32; 4]>, texture_coordinates: Vec<[f32; 2]>,
        triangles: Vec<[u32; 3]>,
    ) -> Result<Self, MeshError> {
        check(&positions, &normals, &texture_coordinates, &triangles)?;
        has_length("tangents", tangents.len(), positions.len())?;
        has_numbers("tangent", &tangents, 1.0 + TOLERANCE)?;
        for (vertex, (&[x, y, z, w], normal)) in tangents.iter().zip(&normals).enumerate() {
            is_unit("tangent", vertex, [x, y, z])?;
            let cosine = x * normal[0] + y * normal[1] + z * normal[2];
            if cosine.abs() > TOLERANCE || w.abs() != 1.0 {
                return Err(MeshError::Frame { vertex, cosine, w });
            }
        }
        Ok(Self { positions, normals, tangents, texture_coordinates, triangles })
    }

    /// Positions, `[vertex]`.
    #[must_use]
    pub fn positions(&self) -> &[[f32; 3]] {
        &self.positions
    }

    /// Unit normals, `[vertex]`, pointing out.
    #[must_use]
    pub fn normals(&self) -> &[[f32; 3]] {
        &self.normals
    }

    /// Unit tangents along u and the sign w of the bitangent w cross(normal, tangent) along v, `[vertex]`.
    #[must_use]
    pub fn tangents(&self) -> &[[f32; 4]] {
        &self.tangents
    }

    /// (u, v) in pieces of the material, u right, v up, `[vertex]`.
    #[must_use]
    pub fn texture_coordinates(&self) -> &[[f32; 2]] {
        &self.texture_coordinates
    }

    /// Vertices of each triangle, counter-clockwise from outside.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Smallest and largest x, y and z.
    #[must_use]
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        bounds(&self.positions)
    }

    /// Center and radius of a ball around the mesh, centred in its bounds.
    #[must_use]
    pub fn ball(&self) -> (DVec3, f64) {
        let vector = |place: [f32; 3]| DVec3::from_array(place.map(f64::from));
        let [low, high] = self.bounds().map(vector);
        let center = 0.5 * (low + high);
        (center, self.positions.iter().map(|&place| vector(place).distance(center)).fold(0.0, f64::max))
    }

    /// Whether each connected part of it encloses a volume, its outer side out: along each edge, between places, triangles run as often one way
    /// as the other. Seen from outside, only outer sides are seen.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let (places, count) = places(&self.positions);
        let mut parts = Parts((0..count).collect());
        let mut runs: HashMap<_, i32> = HashMap::new();
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|vertex| places[vertex as usize]);
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *runs.entry((from.min(to), from.max(to))).or_default() += from.cmp(&to) as i32;
                parts.join(from, to);
            }
        }
        let mut volumes: HashMap<_, f64> = HashMap::new();
        for &triangle in &self.triangles {
            let corner = DVec3::from_array(self.positions[triangle[0] as usize].map(f64::from));
            *volumes.entry(parts.of(places[triangle[0] as usize])).or_default() += corner.dot(doubled_area(&self.positions, triangle));
        }
        runs.values().all(|&runs| runs == 0) && volumes.values().all(|&volume| volume > 0.0)
    }

    /// Sum of the areas of all triangles.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.triangles.iter().map(|&triangle| 0.5 * doubled_area(&self.positions, triangle).length()).sum()
    }
}

/// Connected parts of a mesh, each by one of its places (Tarjan 1975: disjoint sets).
struct Parts(Vec<u32>);

impl Parts {
    /// The place that stands for the part of `place`.
    fn of(&mut self, mut place: u32) -> u32 {
        while self.0[place as usize] != place {
            self.0[place as usize] = self.0[self.0[place as usize] as usize];
            place = self.0[place as usize];
        }
        place
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.of(a), self.of(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

/// Smallest and largest x, y and z of some positions.
#[must_use]
pub fn bounds(positions: &[[f32; 3]]) -> [[f32; 3]; 2] {
    let start = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    positions.iter().fold(start, |[low, high], position| {
        [std::array::from_fn(|axis| low[axis].min(position[axis])), std::array::from_fn(|axis| high[axis].max(position[axis]))]
    })
}

/// The normal of a triangle, as long as twice its area.
#[must_use]
pub fn doubled_area(positions: &[[f32; 3]], triangle: [u32; 3]) -> DVec3 {
    let [a, b, c] = triangle.map(|vertex| DVec3::from_array(positions[vertex as usize].map(f64::from)));
    (b - a).cross(c - a)
}

/// A number for each vertex, from 0, the same for vertices at the same place, and how many there are.
#[must_use]
pub fn places(positions: &[[f32; 3]]) -> (Vec<u32>, u32) {
    let mut numbers = HashMap::new();
    let mut count = 0;
    let places = positions.iter().map(|position| {
        // Adding 0 makes -0 the same as 0.
        *numbers.entry(position.map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
            count += 1;
            count - 1
        })
    });
    (places.collect(), count)
}

/// Checks all but the tangents.
pub(super) fn check(
    positions: &[[f32; 3]], normals: &[[f32; 3]], texture_coordinates: &[[f32; 2]], triangles: &[[u32; 3]],
) -> Result<(), MeshError> {
    let vertices = positions.len();
    if triangles.is_empty() {
        return Err(MeshError::Empty);
    }
    for (what, found) in [("vertices", vertices), ("triangles", triangles.len())] {
        if found > MAX_VERTICES {
            return Err(MeshError::TooMany { what, found, most: MAX_VERTICES });
        }
    }
    has_length("normals", normals.len(), vertices)?;
    has_length("texture coordinates", texture_coordinates.len(), vertices)?;
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&index) = corners.iter().find(|&&index| index as usize >= vertices) {
            return Err(MeshError::Index { triangle, index, vertices });
        }
    }
    has_numbers("position", positions, MAX_POSITION)?;
    has_numbers("normal", normals, 1.0 + TOLERANCE)?;
    has_numbers("texture coordinate", texture_coordinates, MAX_TEXTURE_COORDINATE)?;
    normals.iter().enumerate().try_for_each(|(vertex, normal)| is_unit("normal", vertex, *normal))
}

fn has_length(what: &'static str, found: usize, vertices: usize) -> Result<(), MeshError> {
    if found == vertices { Ok(()) } else { Err(MeshError::Length { what, found, vertices }) }
}

/// Checks that all components of the array `what` are numbers.
///
/// # Errors
/// [`MeshError::Number`] for the first that is not, or is of a larger magnitude than `most`.
pub fn has_numbers<const N: usize>(what: &'static str, values: &[[f32; N]], most: f32) -> Result<(), MeshError> {
    for (vertex, value) in values.iter().enumerate() {
        if let Some(&value) = value.iter().find(|value| value.is_nan() || value.abs() > most) {
            return Err(MeshError::Number { what, vertex, value, most });
        }
    }
    Ok(())
}

fn is_unit(what: &'static str, vertex: usize, [x, y, z]: [f32; 3]) -> Result<(), MeshError> {
    let length = (x * x + y * y + z * z).sqrt();
    if (length - 1.0).abs() <= TOLERANCE { Ok(()) } else { Err(MeshError::NotUnit { what, vertex, length }) }
}
