//! Twin of `picture_error`.

use half::f16;

use super::gather;
use crate::model::color::srgb_from_linear;

/// Errors of a picture against its original: the sums of [`stage::PictureSums`](crate::stage::PictureSums) in f64.
#[derive(Debug, Clone, PartialEq)]
pub struct PictureError {
    /// Σ (R − L)².
    pub squared_error: f64,
    /// Σ (R − L).
    pub error: f64,
    /// Σ L².
    pub squared_original: f64,
    /// Σ L.
    pub original: f64,
    /// Σ (R − L)² of the sRGB values, held to 0 … 1.
    pub squared_shown_error: f64,
    /// Texels that take part.
    pub texels: f64,
    /// `[texel]` (Σ (R − L)², Σ L²) over the channels; 0 for texels that take no part.
    pub of_texels: Vec<[f64; 2]>,
}

/// Compares the texels of a picture with those of its original; texels that `gather` masks are left out.
#[must_use]
pub fn picture_error(picture: &[[f64; 3]], original: &[[f16; 3]]) -> PictureError {
    let originals: Vec<[f64; 3]> = original.iter().map(|&channels| gather(channels)).collect();
    // (R, L) of every value that takes part.
    let values: Vec<(f64, f64)> =
        picture.iter().zip(&originals).filter(|(_, original)| original[0] >= 0.0).flat_map(|(r, l)| (0..3).map(|c| (r[c], l[c]))).collect();
    let sum = |term: fn(f64, f64) -> f64| values.iter().map(|&(r, l)| term(r, l)).sum::<f64>();
    let shown = |value: f64| srgb_from_linear(value.clamp(0.0, 1.0));
    #[expect(clippy::cast_precision_loss, reason = "texels of a picture")]
    let texels = (values.len() / 3) as f64;
    let of_texel = |(picture, original): (&[f64; 3], &[f64; 3])| {
        let takes_part = if original[0] >= 0.0 { 1.0 } else { 0.0 };
        [0, 1, 2]
            .map(|c| [(picture[c] - original[c]).powi(2), original[c].powi(2)])
            .iter()
            .fold([0.0; 2], |sum, term| [sum[0] + takes_part * term[0], sum[1] + takes_part * term[1]])
    };
    PictureError {
        squared_error: sum(|r, l| (r - l).powi(2)),
        error: sum(|r, l| r - l),
        squared_original: sum(|_, l| l * l),
        original: sum(|_, l| l),
        squared_shown_error: values.iter().map(|&(r, l)| (shown(r) - shown(l)).powi(2)).sum(),
        texels,
        of_texels: picture.iter().zip(&originals).map(of_texel).collect(),
    }
}
