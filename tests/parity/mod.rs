//! Each kernel against its twin.

mod brdf_values;
pub mod lafortune_fit;
mod normals;
mod percentile;
mod specular_residual;
mod specular_scale;
mod srgb_decode;

pub fn tests() -> Vec<libtest_mimic::Trial> {
    [
        brdf_values::tests(),
        lafortune_fit::tests(),
        normals::tests(),
        percentile::tests(),
        specular_residual::tests(),
        specular_scale::tests(),
        srgb_decode::tests(),
    ]
    .into_iter()
    .flatten()
    .collect()
}
