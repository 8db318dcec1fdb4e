//! What must hold without a twin.

mod color;
mod normals;

pub fn tests() -> Vec<libtest_mimic::Trial> {
    [color::tests(), normals::tests()].into_iter().flatten().collect()
}
