//! Each kernel against its twin.

mod normals;

pub fn tests() -> Vec<libtest_mimic::Trial> {
    [normals::tests()].into_iter().flatten().collect()
}
