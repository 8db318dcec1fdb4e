//! Each kernel against its twin.

mod fft;
mod frankot_chellappa;
mod normals;
mod photometric_stereo;

pub fn tests() -> Vec<libtest_mimic::Trial> {
    [fft::tests(), frankot_chellappa::tests(), normals::tests(), photometric_stereo::tests()].into_iter().flatten().collect()
}
