// The Lafortune lobe (Lafortune et al. 1997; thesis eq. 3.3): (C . (w_i * w_o))^n, zero where the base is not positive.
// `lobe` is (C_x, C_y, C_z, n), `product` the directions' product by components.
fn lafortune(lobe: vec4<f32>, product: vec3<f32>) -> f32 {
    let base = dot(lobe.xyz, product);
    if base <= 0.0 {
        return 0.0;
    }
    return exp2(lobe.w * log2(base));
}
