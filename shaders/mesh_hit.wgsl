// What each pixel sees of a mesh that wears a relief: every fragment follows its view ray through the relief, and of the points met the
// nearest is kept, by their depths. Costly shading is then for what is seen alone (Burns, Hunt 2013: the visibility buffer).
// Twin: reference::mesh.
#import relief
#import mesh_base

struct Pixel {
    @builtin(frag_depth) depth: f32,
    // place and height of the point met, in texels, and the triangle
    @location(0) met: vec4<f32>,
}

@fragment
fn fragment(in: Fragment, @builtin(front_facing) front: bool) -> Pixel {
    let ray = ray_of(in, base_frame(in, front));
    let hit = first_hit(in.place, ray.view);
    if camera.silhouette == 1u {
        let inside = hit.place + 0.5;
        if any(inside < vec2(0.0)) || any(inside >= camera.sheet) {
            discard;
        }
    }
    let clip = clip_of(met_at(in, ray, hit.height));
    // What lies beyond the far plane, in the deeps of the relief, is still seen: cleared pixels have 1.
    return Pixel(clamp(clip.z / clip.w, 0.0, 1.0 - 6e-8), vec4(hit.place, hit.height, f32(in.triangle)));
}
