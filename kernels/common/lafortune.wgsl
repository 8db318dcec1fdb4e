// The lobe (C_x w_ix w_ox + C_y w_iy w_oy + C_z w_iz w_oz)^n: Lafortune et al. 1997; thesis eq. 3.3.
// `lobe` is (C_x, C_y, C_z, n); view and light are unit vectors in the frame that the lobe was fitted in.

// Base of the power; may be negative.
fn lafortune_base(lobe: vec4<f32>, view: vec3<f32>, light: vec3<f32>) -> f32 {
    return dot(lobe.xyz, view * light);
}

// The lobe; zero where its base is not positive.
fn lafortune(lobe: vec4<f32>, view: vec3<f32>, light: vec3<f32>) -> f32 {
    let base = lafortune_base(lobe, view, light);
    if base <= 0.0 {
        return 0.0;
    }
    return pow(base, lobe.w);
}
