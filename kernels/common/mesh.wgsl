// A mesh that wears a material: shades what `mesh_hit` has found each pixel to see. The pass that imports this imports one of
// `unpainted_svbrdf` and `unpainted_lpca` too, for the bare part. Twin: reference::mesh.
#import shade
#import mesh_base
#import mesh_environment
#import mesh_shadow

// [0][row][column] of the picture, from `mesh_hit`
@group(0) @binding(19) var met: texture_2d_array<f32>;

// A triangle that covers the picture, at the far plane: pixels that see nothing are as far, and fail the test of depth.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(select(-1.0, 3.0, index == 1u), select(-1.0, 3.0, index == 2u), 1.0, 1.0);
}

// Signs of a direction's components in the material's own axes at a place: -1 along x, y where the piece is mirrored.
fn signs_at(place: vec2<f32>) -> vec3<f32> {
    if scene.boundary != MIRROR {
        return vec3(1.0);
    }
    let piece = floor((place + 0.5) / vec2(f32(scene.width), f32(scene.height)));
    return vec3(select(vec2(1.0), vec2(-1.0), abs(piece) % 2.0 == vec2(1.0)), 1.0);
}

// Radiance towards the camera of the ray through a place of the base plane.
fn seen_radiance(base: Crossing, place: vec2<f32>, hit: Hit, level: u32) -> vec3<f32> {
    let sight = sight_of(place, hit, level);
    // A mirrored piece looks as the material does under mirrored directions.
    let at_base = signs_at(place);
    let at_hit = signs_at(hit.place);
    var radiance = vec3(0.0);
    for (var index = 0u; index < camera.lights; index++) {
        let light = lights[index];
        let way = light.place.xyz - light.place.w * base.position;
        let distance2 = dot(way, way);
        if distance2 == 0.0 || !shines(light, -way) {
            continue;
        }
        let toward = in_base(base, way * inverseSqrt(distance2));
        if toward.z < MIN_COSINE {
            continue;
        }
        let irradiance = light.irradiance.rgb / select(1.0, distance2, light.place.w == 1.0);
        let reached = mesh_visibility(light, base.position, base.normal);
        if reached > 0.0 {
            let visible = visibility(hit, toward);
            var seen = bare_part(sight, visible, at_base * base.view, at_base * toward);
            if light.bare_only == 0u {
                seen += painted_part(sight, visible, at_hit * base.view, at_hit * toward);
            }
            radiance += reached * irradiance * seen;
        }
    }
    if camera.environment.x > 0.0 {
        let axes = mat3x3(
            at_hit.x * in_environment(base.tangent),
            at_hit.y * in_environment(base.bitangent),
            in_environment(base.normal),
        );
        radiance += camera.environment.x * painted_surroundings_part(sight, at_hit * base.view, axes);
    }
    return radiance;
}

// A direction of the world in the environment's own frame.
fn in_environment(direction: vec3<f32>) -> vec3<f32> {
    let turn = camera.environment.yz;
    return vec3(turn.x * direction.x - turn.y * direction.z, direction.y, turn.y * direction.x + turn.x * direction.z);
}

@fragment
fn fragment(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let seen = textureLoad(met, vec2<u32>(pixel.xy), 0, 0);
    let hit = Hit(seen.xy, seen.z);
    let base = crossing_of(u32(seen.w), pixel.xy);
    switch camera.output {
        case OUTPUT_GEOMETRY: {
            let at = met_at(base, hit.height);
            // Of parallel rays the plane through the origin.
            let distance = select(-dot(camera.eye.xyz, at), clip_of(at).w, camera.eye.w == 1.0);
            return vec4(normalize(world_of(base, signs_at(hit.place) * normal_at(hit.place))), distance);
        }
        case OUTPUT_PAINT: {
            let coverage = dot(sight_of(base.place, hit, 0u).covered, vec4(1.0));
            let texel = vec2<i32>(round(hit.place));
            let column = wrap(texel.x, scene.width, scene.boundary);
            let row = wrap(texel.y, scene.height, scene.boundary);
            return vec4(coverage, hit.height, f32(column), f32(row));
        }
        default: {
            // Texels that the pixel covers where it covers most, spread over its rays; what a ray still covers is for the level.
            let texels = camera.footprint * max(length(base.across), length(base.down));
            let rays = clamp(ceil(texels), 1.0, f32(camera.rays));
            let level = u32(clamp(round(log2(texels / rays)), 0.0, f32(camera.levels - 1u)));
            var sum = vec3(0.0);
            for (var row = 0.5; row < rays; row += 1.0) {
                for (var column = 0.5; column < rays; column += 1.0) {
                    let aside = camera.footprint * (vec2(column, row) / rays - 0.5);
                    let place = base.place + aside.x * base.across + aside.y * base.down;
                    // A lone ray is the one that has been followed.
                    var own = hit;
                    if rays > 1.0 {
                        own = first_hit(place, base.view);
                    }
                    sum += seen_radiance(base, place, own, level);
                }
            }
            return vec4(sum / (rays * rays), 1.0);
        }
    }
}
