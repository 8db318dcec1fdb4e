// Drawn thickness of clouds: octaves of noise, each twice as fine and half as strong as the one before, stretched over 0 to 1. One
// thread a texel.
// Twin: reference::pattern.
#import pattern_plane
#import pattern_marks

const OCTAVES: u32 = 6u;

@compute @workgroup_size(SIZE)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let texel = thread_index(group, groups, local, SIZE);
    if outside(texel) {
        return;
    }
    let place = place_of(texel) / params.edges + 0.5;
    var sum = 0.0;
    var whole = 0.0;
    for (var octave = 0u; octave < OCTAVES; octave++) {
        let share = 1.0 / f32(1u << octave);
        let period = params.lattice << vec2(octave);
        let cells = vec2<f32>(period) * params.scale / params.edges;
        sum += share * faded(0.5, noise(place * vec2<f32>(period), period, params.seed + octave), params.texel * max(cells.x, cells.y));
        whole += share;
    }
    drawn[params.first + texel] = smoothstep(0.2, 0.8, sum / whole);
}
