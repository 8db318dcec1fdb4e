// Light of an environment on paint: diffuse by the irradiance, mirrored by the levels averaged over lobes and the directional albedo
// (Karis 2013: the split sum). Neither mesh nor relief shadows it. Twin: reference::mesh.
#import environment
#import shade

// [level][row][column], octahedral maps of linear RGB, the last the irradiance over pi (stage::Environment)
@group(0) @binding(17) var surroundings: texture_2d_array<f32>;
// [0][roughness][cosine], (scale, bias) of F0
@group(0) @binding(18) var albedos: texture_2d_array<f32>;

// From a direction of the environment's own frame, one level.
fn surroundings_level(at: Bilinear, level: u32) -> vec3<f32> {
    var sum = vec3(0.0);
    for (var corner = 0u; corner < 4u; corner++) {
        sum += at.weights[corner] * textureLoad(surroundings, at.texels[corner], level, 0).rgb;
    }
    return sum;
}

// What a surface of this roughness mirrors around a direction, in units in which a white surface under 1 from everywhere reads 1.
fn mirrored(direction: vec3<f32>, roughness: f32) -> vec3<f32> {
    let at = octahedral_bilinear(direction, textureDimensions(surroundings).x);
    let levels = environment_levels(roughness, textureNumLayers(surroundings));
    return mix(surroundings_level(at, levels.lower), surroundings_level(at, levels.upper), levels.part);
}

// The share of that which comes back: F0 scale + bias.
fn directional_albedo(f0: f32, roughness: f32, cosine: f32) -> f32 {
    let at = albedo_bilinear(roughness, cosine, textureDimensions(albedos).x);
    var entry = vec2(0.0);
    for (var corner = 0u; corner < 4u; corner++) {
        entry += at.weights[corner] * textureLoad(albedos, at.texels[corner], 0, 0).rg;
    }
    return f0 * entry.x + entry.y;
}

// Radiance of a painted texel towards `view`, both by the base plane's frame; `to_environment` has the base plane's axes in the
// environment's frame. What is mirrored of below the base plane is the surface itself and counts as dark.
fn painted_surroundings(texel: u32, view: vec3<f32>, to_environment: mat3x3<f32>) -> vec3<f32> {
    let normal = normals[texel].xyz;
    let f0 = coats[texel].x;
    let alpha = coat_alpha(texel);
    let cosine = max(dot(normal, view), 0.0);
    let diffuse = leaving(texel, view) * painted[texel].rgb * mirrored(to_environment * normal, 1.0);
    let reflection = reflect(-view, normal);
    let horizon = saturate(1.0 + reflection.z);
    return diffuse + horizon * directional_albedo(f0, alpha, cosine) * mirrored(to_environment * reflection, alpha);
}

// Of what is painted of a sight, times its share.
fn painted_surroundings_part(sight: Sight, view: vec3<f32>, to_environment: mat3x3<f32>) -> vec3<f32> {
    var radiance = vec3(0.0);
    for (var corner = 0u; corner < 4u; corner++) {
        let texel = sight.cell.texels[corner];
        if sight.covered[corner] > 0.0 {
            if scene.blended == 1u {
                radiance += sight.covered[corner] * painted[texel].rgb * mirrored(to_environment[2], 1.0);
            } else {
                radiance += sight.covered[corner] * painted_surroundings(texel, view, to_environment);
            }
        }
    }
    return radiance;
}
