//! glTF 2.0, by the crate `gltf`.
//!
//! All meshes of the default scene (else of the first, else all nodes that have no parent) are taken where their nodes place them. Triangles,
//! strips and fans are read, points and lines left out with a warning. The crate checks the document; what it takes on trust when it reads
//! an array, its type and that all of it lies inside its buffer, is checked here first.

use std::{collections::HashSet, path::Path};

use base64::{Engine, engine::general_purpose};
use glam::{DMat4, DVec3};
use gltf::{
    Accessor, Document, Gltf, Node, Primitive, Semantic,
    accessor::{DataType, Dimensions},
    buffer::{Source, View},
    mesh::Mode,
};

use super::{MAX_BYTES, MeshFault, complete::Part};
use crate::{data::mesh::MAX_VERTICES, io::recipe::shortened};

/// Extensions without which positions or triangles mean something else.
const UNREAD: [&str; 4] = ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression", "KHR_mesh_quantization"];

/// The parts of a file, one a primitive of each node.
pub(super) fn parts(bytes: &[u8], folder: &Path, warnings: &mut Vec<String>) -> Result<Vec<Part>, MeshFault> {
    let (document, blob) = document(bytes)?;
    let buffers = Buffers::new(&document, blob, folder)?;
    let mut parts = Vec::new();
    let (mut vertices, mut triangles, mut others) = (0, 0, 0);
    for (node, world) in placed(&document)? {
        let Some(mesh) = node.mesh() else { continue };
        let name = mesh.name().map_or_else(|| mesh.index().to_string(), |name| format!("\"{}\"", shortened(name)));
        for primitive in mesh.primitives() {
            if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
                others += 1;
                continue;
            }
            let reader = Reader { mesh: &name, primitive: &primitive, buffers: &buffers };
            let part = reader.part(MAX_VERTICES - vertices, MAX_VERTICES - triangles)?;
            vertices += part.positions.len();
            triangles += part.triangles.len();
            parts.push(transformed(part, world));
        }
    }
    if others > 0 {
        warnings.push(format!("{others} primitives are points or lines and were left out"));
    }
    Ok(parts)
}

/// The checked document and the binary chunk.
fn document(bytes: &[u8]) -> Result<(Document, Option<Vec<u8>>), MeshFault> {
    let damaged = |error: gltf::Error| MeshFault::Damaged { message: shortened(&error.to_string()) };
    // The crate subtracts the header's 12 bytes from the length it declares.
    if bytes.starts_with(b"glTF") && bytes.get(8..).and_then(<[u8]>::first_chunk).is_none_or(|length| u32::from_le_bytes(*length) < 12) {
        return Err(MeshFault::Damaged { message: "the header of a .glb is cut off".to_owned() });
    }
    let Gltf { document, blob } = Gltf::from_slice_without_validation(bytes).map_err(damaged)?;
    let mut root = document.into_json();
    if let Some(found) = root.extensions_required.iter().find(|extension| UNREAD.contains(&extension.as_str())) {
        return Err(MeshFault::Unsupported { found: format!("the extension {found}") });
    }
    // The others are of materials, lights and the like.
    root.extensions_required.clear();
    Ok((Document::from_json(root).map_err(damaged)?, blob))
}

/// Nodes of the scene and their transforms to the world.
fn placed(document: &Document) -> Result<Vec<(Node<'_>, DMat4)>, MeshFault> {
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let roots: Vec<_> = match scene {
        Some(scene) => scene.nodes().collect(),
        None => {
            let children: HashSet<_> = document.nodes().flat_map(|node| node.children().map(|child| child.index())).collect();
            document.nodes().filter(|node| !children.contains(&node.index())).collect()
        }
    };
    let mut placed = Vec::new();
    let mut reached = HashSet::new();
    let mut waiting: Vec<_> = roots.into_iter().rev().map(|node| (node, DMat4::IDENTITY)).collect();
    while let Some((node, parent)) = waiting.pop() {
        if !reached.insert(node.index()) {
            return Err(MeshFault::NotATree { node: node.index() });
        }
        let world = parent * DMat4::from_cols_array_2d(&node.transform().matrix().map(|column| column.map(f64::from)));
        waiting.extend(node.children().map(|child| (child, world)));
        placed.push((node, world));
    }
    Ok(placed)
}

/// The bytes of all buffers, of each at least those it declares.
struct Buffers(Vec<Vec<u8>>);

impl Buffers {
    fn new(document: &Document, mut blob: Option<Vec<u8>>, folder: &Path) -> Result<Self, MeshFault> {
        let mut left = MAX_BYTES;
        let mut buffers = Vec::new();
        for buffer in document.buffers() {
            let number = buffer.index();
            let fault = |expected: &str, found: String| MeshFault::Buffer { buffer: number, expected: expected.to_owned(), found };
            left = left.checked_sub(buffer.length() as u64).ok_or(MeshFault::TooManyBytes { limit: MAX_BYTES })?;
            let bytes = match buffer.source() {
                Source::Bin => blob.take().ok_or_else(|| fault("the binary chunk of a .glb", "none".to_owned()))?,
                Source::Uri(uri) => match uri.split_once(':') {
                    Some(("data", data)) => decoded(data).map_err(|found| fault("a data URI in base64", found))?,
                    Some(_) => return Err(fault("a data URI or a path from the file's folder", shortened(uri))),
                    None => {
                        let path = folder.join(unescaped(uri));
                        let unread = |error| fault("a readable file", format!("{} ({error})", path.display()));
                        super::read(&path, buffer.length() as u64).map_err(unread)?
                    }
                },
            };
            if bytes.len() < buffer.length() {
                return Err(fault(&format!("{} bytes", buffer.length()), bytes.len().to_string()));
            }
            buffers.push(bytes);
        }
        Ok(Self(buffers))
    }

    /// Whether `count` items of `size` bytes that start at `offset` are inside a view, and that inside its buffer.
    fn hold(&self, view: &View<'_>, offset: usize, count: usize, size: usize) -> bool {
        let stride = view.stride().unwrap_or(size);
        let end = (count - 1).checked_mul(stride).and_then(|bytes| bytes.checked_add(offset)?.checked_add(size));
        let bytes = self.0[view.buffer().index()].len();
        stride >= size
            && end.is_some_and(|end| end <= view.length())
            && view.offset().checked_add(view.length()).is_some_and(|end| end <= bytes)
    }
}

/// What a data URI holds.
fn decoded(data: &str) -> Result<Vec<u8>, String> {
    let Some((_, base64)) = data.split_once(";base64,") else { return Err(shortened(data)) };
    general_purpose::STANDARD.decode(base64).map_err(|error| error.to_string())
}

/// A path as a URI writes it, with `%20` for a space and the like.
fn unescaped(uri: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let code =
            after.get(..2).filter(|_| first == b'%').and_then(|digits| u8::from_str_radix(std::str::from_utf8(digits).ok()?, 16).ok());
        bytes.push(code.unwrap_or(first));
        rest = if code.is_some() { &after[2..] } else { after };
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Reads one primitive.
struct Reader<'a> {
    mesh: &'a str,
    primitive: &'a Primitive<'a>,
    buffers: &'a Buffers,
}

impl Reader<'_> {
    /// The primitive, of so many vertices and triangles at most.
    fn part(&self, vertices: usize, triangles: usize) -> Result<Part, MeshFault> {
        use DataType::{F32, U8, U16, U32};
        let reader = self.primitive.reader(|buffer| self.buffers.0.get(buffer.index()).map(Vec::as_slice));
        let positions = self.array("POSITION", &Semantic::Positions, (Dimensions::Vec3, &[F32]))?;
        let Some(positions) = positions else {
            return Err(self.fault("POSITION", "positions of vertices".to_owned(), "none".to_owned()));
        };
        let count = positions.count();
        if count > vertices {
            return Err(MeshFault::TooMany { what: "vertices", found: MAX_VERTICES - vertices + count, most: MAX_VERTICES });
        }
        let attributes = [
            ("NORMAL", Semantic::Normals, (Dimensions::Vec3, &[F32] as &[_])),
            ("TANGENT", Semantic::Tangents, (Dimensions::Vec4, &[F32])),
            ("TEXCOORD_0", Semantic::TexCoords(0), (Dimensions::Vec2, &[F32, U8, U16])),
        ];
        for (what, semantic, kind) in attributes {
            if let Some(found) = self.array(what, &semantic, kind)?.map(|accessor| accessor.count()).filter(|found| *found != count) {
                return Err(self.fault(what, format!("one for each of {count} positions"), found.to_string()));
            }
        }
        let indices = self.primitive.indices();
        if let Some(indices) = &indices {
            self.check("indices", indices, (Dimensions::Scalar, &[U8, U16, U32]))?;
        }
        let corners = indices.as_ref().map_or(count, Accessor::count);
        let found = if self.primitive.mode() == Mode::Triangles { corners / 3 } else { corners.saturating_sub(2) };
        if found > triangles {
            return Err(MeshFault::TooMany { what: "triangles", found: MAX_VERTICES - triangles + found, most: MAX_VERTICES });
        }
        let corners: Vec<u32> = match reader.read_indices() {
            Some(indices) => indices.into_u32().collect(),
            None => (0..u32::try_from(count).unwrap_or(u32::MAX)).collect(),
        };
        Ok(Part {
            positions: reader.read_positions().into_iter().flatten().collect(),
            normals: reader.read_normals().map(Iterator::collect),
            texture_coordinates: reader.read_tex_coords(0).map(|uv| uv.into_f32().map(|[u, v]| [u, 1.0 - v]).collect()),
            tangents: reader.read_tangents().map(Iterator::collect),
            triangles: triangulated(&corners, self.primitive.mode()),
        })
    }

    /// An attribute, checked.
    fn array(&self, what: &'static str, semantic: &Semantic, kind: (Dimensions, &[DataType])) -> Result<Option<Accessor<'_>>, MeshFault> {
        let accessor = self.primitive.get(semantic);
        accessor.map(|accessor| self.check(what, &accessor, kind).map(|()| accessor)).transpose()
    }

    /// Checks an array's type, and that all of it is there.
    fn check(&self, what: &'static str, accessor: &Accessor<'_>, (dimensions, types): (Dimensions, &[DataType])) -> Result<(), MeshFault> {
        let found = (accessor.dimensions(), accessor.data_type());
        if found.0 != dimensions || !types.contains(&found.1) {
            return Err(self.fault(what, format!("{dimensions:?} of {types:?}"), format!("{:?} of {:?}", found.0, found.1)));
        }
        let (count, size) = (accessor.count(), accessor.size());
        let is_whole =
            |view: &View<'_>, offset: usize, count: usize, size: usize| count > 0 && self.buffers.hold(view, offset, count, size);
        let has_base = accessor.view().is_none_or(|view| is_whole(&view, accessor.offset(), count, size));
        let has_sparse = accessor.sparse().is_none_or(|sparse| {
            let (changed, indices, values) = (sparse.count(), sparse.indices(), sparse.values());
            changed <= count
                && is_whole(&indices.view(), indices.offset(), changed, indices.index_type().size())
                && is_whole(&values.view(), values.offset(), changed, size)
        });
        // Of a sparse array without a base, those that are not listed are 0 and take no bytes.
        let bytes: usize = self.buffers.0.iter().map(Vec::len).sum();
        if (1..=bytes).contains(&count) && has_base && has_sparse {
            return Ok(());
        }
        Err(self.fault(what, "1 item or more, all inside the buffers".to_owned(), format!("{count} of {size} bytes each, not all inside")))
    }

    fn fault(&self, what: &'static str, expected: String, found: String) -> MeshFault {
        MeshFault::Array { what, mesh: self.mesh.to_owned(), expected, found }
    }
}

/// Triangles of a list, a strip or a fan.
fn triangulated(corners: &[u32], mode: Mode) -> Vec<[u32; 3]> {
    match mode {
        Mode::TriangleStrip => {
            let turned =
                |(index, next): (usize, &[u32])| if index % 2 == 0 { [next[0], next[1], next[2]] } else { [next[1], next[0], next[2]] };
            corners.windows(3).enumerate().map(turned).collect()
        }
        Mode::TriangleFan => corners.iter().skip(1).zip(corners.iter().skip(2)).map(|(&b, &c)| [corners[0], b, c]).collect(),
        _ => corners.as_chunks().0.to_vec(),
    }
}

/// The part in the world. A transform that mirrors turns triangles around, and with them the sign of tangents.
fn transformed(part: Part, world: DMat4) -> Part {
    let [x, y, z] = [world.x_axis, world.y_axis, world.z_axis].map(|axis| axis.truncate());
    let mirrors = x.dot(y.cross(z)) < 0.0;
    let sign = if mirrors { -1.0 } else { 1.0 };
    // Normals go by the cofactors, which are the inverse transposed but for a factor, and exist without an inverse.
    let cofactors = [y.cross(z), z.cross(x), x.cross(y)].map(|column| sign * column);
    // What is no number stays what it is, and is found later.
    let unit = |direction: DVec3| if direction.is_finite() { direction.normalize_or_zero() } else { direction }.as_vec3().to_array();
    let along =
        |columns: [DVec3; 3], [a, b, c]: [f32; 3]| columns[0] * f64::from(a) + columns[1] * f64::from(b) + columns[2] * f64::from(c);
    let mirrored = |[a, b, c]: [u32; 3]| if mirrors { [a, c, b] } else { [a, b, c] };
    Part {
        positions: part
            .positions
            .into_iter()
            .map(|place| (along([x, y, z], place) + world.w_axis.truncate()).as_vec3().to_array())
            .collect(),
        normals: part.normals.map(|normals| normals.into_iter().map(|normal| unit(along(cofactors, normal))).collect()),
        tangents: part.tangents.map(|tangents| {
            let tangent = |[a, b, c, w]: [f32; 4]| {
                let [a, b, c] = unit(along([x, y, z], [a, b, c]));
                [a, b, c, if mirrors { -w } else { w }]
            };
            tangents.into_iter().map(tangent).collect()
        }),
        triangles: part.triangles.into_iter().map(mirrored).collect(),
        ..part
    }
}
