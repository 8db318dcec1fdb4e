// Interpolation between measured directions: the triangle of a mesh that holds a direction in stereographic coordinates
// (x, y)/(1 + z), found by a walk from the triangle at its cell of a coarse grid (Devillers, Pion, Teillaud 2002), and barycentric
// coordinates there. Twin: data::DirectionMesh.

// Meshes as stage::pack_directions lays them out: the grid of cells [row][column], four cells an element, with the triangle near each
// cell's middle; then [triangle][corner] (x, y, measured direction, triangle across the opposite edge), the coordinates as bits of f32.
@group(0) @binding(8) var<storage, read> directions: array<vec4<u32>>;

// Where a mesh begins in `directions`, and cells a side of its grid (an even number).
struct DirectionMesh {
    first: u32,
    side: u32,
}

// Measured directions and their weights, which are at least 0 and sum to 1; a direction may be there more than once.
struct DirectionWeights {
    directions: vec3<u32>,
    weights: vec3<f32>,
    // whether it lies nearer to the horizon than what is measured: in a triangle with corners outside of the unit circle
    is_below: bool,
}

// No triangle.
const OUTSIDE: u32 = 0xffffffffu;
// The grid leaves a handful of steps; only a mesh with all its directions in one place takes more, and then any end will do.
const MAX_WALK: u32 = 256u;
// data::DirectionMesh::NEGLIGIBLE
const NEGLIGIBLE: f32 = 1.0 / 16384.0;

// Below the horizon the place of the horizon at that azimuth.
fn stereographic(direction: vec3<f32>) -> vec2<f32> {
    if direction.z < 0.0 {
        return direction.xy / max(length(direction.xy), 1e-20);
    }
    return direction.xy / (1.0 + direction.z);
}

// Twice the signed area of the triangle of the origin and two points.
fn cross_area(a: vec2<f32>, b: vec2<f32>) -> f32 {
    return a.x * b.y - a.y * b.x;
}

fn direction_weights(mesh: DirectionMesh, direction: vec3<f32>) -> DirectionWeights {
    let place = stereographic(direction);
    let row_column = vec2<u32>(clamp((0.5 + 0.5 * place) * f32(mesh.side), vec2(0.0), vec2(f32(mesh.side - 1u))));
    let cell = row_column.y * mesh.side + row_column.x;
    let triangles = mesh.first + mesh.side * mesh.side / 4u;
    let packed = directions[mesh.first + cell / 4u];

    var triangle = packed[cell % 4u];
    var behind = OUTSIDE;
    var corners: array<vec4<u32>, 3>;
    var areas: vec3<f32>;
    for (var step = 0u; step < MAX_WALK; step++) {
        for (var corner = 0u; corner < 3u; corner++) {
            corners[corner] = directions[triangles + 3u * triangle + corner];
        }
        let a = bitcast<vec2<f32>>(corners[0].xy) - place;
        let b = bitcast<vec2<f32>>(corners[1].xy) - place;
        let c = bitcast<vec2<f32>>(corners[2].xy) - place;
        areas = vec3(cross_area(b, c), cross_area(c, a), cross_area(a, b));
        // Over the edge that the place is farthest behind, never back: a place on an edge may be outside of both its triangles by rounding.
        var next = OUTSIDE;
        var lowest = 0.0;
        for (var corner = 0u; corner < 3u; corner++) {
            let across = corners[corner].w;
            if areas[corner] < lowest && across != behind && across != OUTSIDE {
                lowest = areas[corner];
                next = across;
            }
        }
        if next == OUTSIDE {
            break;
        }
        behind = triangle;
        triangle = next;
    }

    let inside = max(areas, vec3(0.0));
    let total = inside.x + inside.y + inside.z;
    var weights = vec3(1.0, 0.0, 0.0);
    if total > 0.0 {
        let kept = max(inside / total - NEGLIGIBLE, vec3(0.0));
        weights = kept / (kept.x + kept.y + kept.z);
    }
    var is_below = false;
    for (var corner = 0u; corner < 3u; corner++) {
        let at = bitcast<vec2<f32>>(corners[corner].xy);
        is_below = is_below || dot(at, at) > 1.0;
    }
    return DirectionWeights(vec3(corners[0].z, corners[1].z, corners[2].z), weights, is_below);
}
