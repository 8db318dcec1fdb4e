//! What must hold without a twin.

mod normals;

pub fn tests() -> Vec<libtest_mimic::Trial> {
    [normals::tests()].into_iter().flatten().collect()
}
