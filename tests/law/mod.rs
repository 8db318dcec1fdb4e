//! What must hold without a twin.

mod kubelka_munk;
mod microfacet;
mod normals;
mod paint_relief;
mod pattern;
mod pigments;

pub fn tests() -> Vec<libtest_mimic::Trial> {
    [kubelka_munk::tests(), microfacet::tests(), normals::tests(), paint_relief::tests(), pattern::tests(), pigments::tests()]
        .into_iter()
        .flatten()
        .collect()
}
