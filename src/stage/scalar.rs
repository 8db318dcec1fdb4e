//! Host numbers as kernels take them.

/// Rounds to the precision that kernels work in.
#[expect(clippy::cast_possible_truncation, reason = "rounding is the purpose; settings are far inside f32's range")]
pub(crate) fn single(value: f64) -> f32 {
    value as f32
}

/// The length of a buffer as kernels count; a buffer of 2³² values fits no adapter, which the allocation says.
pub(crate) fn count(len: usize) -> u32 {
    u32::try_from(len).unwrap_or(u32::MAX)
}
