//! What must hold without a twin.

mod lafortune_fit;
mod normals;
mod percentile;
mod specular_scale;

pub fn tests() -> Vec<libtest_mimic::Trial> {
    [lafortune_fit::tests(), normals::tests(), percentile::tests(), specular_scale::tests()].into_iter().flatten().collect()
}
