// What each pixel sees of a mesh that wears a relief: where its view ray crosses a triangle it is followed through the relief, and of the
// points met the nearest is kept, by their depths. Costly shading is then for what is seen alone (Burns, Hunt 2013: the visibility buffer).
// Twin: reference::mesh.
#import relief
#import mesh_base

struct Fragment {
    @builtin(position) clip: vec4<f32>,
    // counted from 1
    @location(0) @interpolate(flat) triangle: u32,
}

struct Pixel {
    @builtin(frag_depth) depth: f32,
    // place and height of the point met, in texels, and the triangle
    @location(0) met: vec4<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Fragment {
    let triangle = index / 3u;
    let corners = triangle_corners(triangle);
    let a = vertex_position(corners.x);
    let b = vertex_position(corners.y);
    let c = vertex_position(corners.z);
    let own = select(select(c, b, index % 3u == 1u), a, index % 3u == 0u);
    // Of a triangle that is left out all corners are in one place.
    let outer = dot(cross(b - a, c - a), camera.eye.xyz - camera.eye.w * a) > 0.0;
    return Fragment(select(vec4(0.0, 0.0, 0.0, 1.0), clip_of(own), outer || camera.outer_only == 0u), triangle + 1u);
}

@fragment
fn fragment(in: Fragment) -> Pixel {
    let base = crossing_of(in.triangle, in.clip.xy);
    let hit = first_hit(base.place, base.view);
    if camera.silhouette == 1u {
        let inside = hit.place + 0.5;
        if any(inside < vec2(0.0)) || any(inside >= camera.sheet) {
            discard;
        }
    }
    let clip = clip_of(met_at(base, hit.height));
    // What lies beyond the far plane, in the deeps of the relief, is still seen: pixels that see nothing have 1.
    return Pixel(clamp(clip.z / clip.w, 0.0, 1.0 - 1e-7), vec4(hit.place, hit.height, f32(in.triangle)));
}
