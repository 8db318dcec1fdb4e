// The material as a plane, seen orthographically under a directional light. The vertex stage covers the plane's outline, the
// fragment stage finds its place on the base plane and marches from there. Twin: reference::plane.
#import shade
#import unpainted_svbrdf

struct Camera {
    // pixels, columns and rows of the picture
    size: vec2<f32>,
    // place on the base plane, texels, of the picture's upper left corner, and its change a pixel to the right and down
    origin: vec2<f32>,
    per_column: vec2<f32>,
    per_row: vec2<f32>,
    // rays a pixel along each axis
    samples: u32,
    _pad0: u32,
    _pad1: u32,
    _pad2: u32,
}

@group(0) @binding(12) var<uniform> camera: Camera;

// Corners of the plane, two triangles.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let corner = vec2(select(0.0, 1.0, index == 1u || index >= 4u), select(0.0, 1.0, index == 2u || index == 3u || index == 5u));
    // One pixel larger than the plane: whether a ray meets it is decided ray by ray.
    let grown = abs(camera.per_column) + abs(camera.per_row);
    let texels = vec2(f32(scene.width), f32(scene.height));
    let place = mix(vec2(-0.5) - grown, texels - 0.5 + grown, corner) - camera.origin;
    let determinant = camera.per_column.x * camera.per_row.y - camera.per_column.y * camera.per_row.x;
    let column = (place.x * camera.per_row.y - place.y * camera.per_row.x) / determinant;
    let row = (camera.per_column.x * place.y - camera.per_column.y * place.x) / determinant;
    return vec4(2.0 * column / camera.size.x - 1.0, 1.0 - 2.0 * row / camera.size.y, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let last = vec2(f32(scene.width), f32(scene.height)) - 0.5;
    let samples = f32(camera.samples);
    var sum = vec4(0.0);
    for (var row = 0.5; row < samples; row += 1.0) {
        for (var column = 0.5; column < samples; column += 1.0) {
            let pixel = position.xy - 0.5 + vec2(column, row) / samples;
            let place = camera.origin + camera.per_column * pixel.x + camera.per_row * pixel.y;
            if all(place >= vec2(-0.5)) && all(place < last) {
                let hit = first_hit(place, scene.view.xyz);
                sum += vec4(radiance_of(sight_of(place, hit, 0u), scene.view.xyz, scene.light.xyz), 1.0);
            }
        }
    }
    return sum / (samples * samples);
}
