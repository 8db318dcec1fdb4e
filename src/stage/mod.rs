//! Host side of the compute stages, one file each.

mod kubelka_munk;
mod normals;
mod paint_relief;
mod pattern;

pub use kubelka_munk::KubelkaMunk;
pub use normals::Normals;
pub use paint_relief::PaintRelief;
pub use pattern::Pattern;

/// Rounds a setting to the precision that kernels work in.
fn single(value: f64) -> f32 {
    #[expect(clippy::cast_possible_truncation, reason = "rounding is the purpose; settings are far inside f32's range")]
    let value = value as f32;
    value
}

/// The length of a buffer as kernels count; a buffer of 2³² values fits no adapter.
fn count(len: usize) -> u32 {
    u32::try_from(len).unwrap_or(u32::MAX)
}
