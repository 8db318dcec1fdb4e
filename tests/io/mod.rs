//! Readers and writers.

pub fn tests() -> Vec<libtest_mimic::Trial> {
    [].into_iter().flatten().collect::<Vec<_>>()
}
