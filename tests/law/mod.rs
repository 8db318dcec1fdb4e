//! What must hold without a twin.

mod normals;
mod plane;
mod reconstruct;

pub fn tests() -> Vec<libtest_mimic::Trial> {
    [normals::tests(), plane::tests(), reconstruct::tests()].into_iter().flatten().collect()
}
