//! From the channels that are stored to RGB.

/// What keeps the logarithm of a stored value finite: e^v - this.
const FLOOR: f32 = 1e-5;

/// RGB from YUV, rows R, G, B.
const RGB_FROM_YUV: [[f32; 3]; 3] = [[1.0, 0.0, 1.13983], [1.0, -0.39465, -0.5806], [1.0, 2.03211, 0.0]];

/// What was done to RGB before it was factorised. Nothing is clamped: highlights are above 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Color {
    /// Nothing.
    Rgb,
    /// The logarithm was taken: value = e^v - 1e-5.
    Logarithm,
    /// YUV.
    Yuv,
    /// Principal components: v M + mean, v a row.
    Principal {
        /// M.
        transform: [[f32; 3]; 3],
        /// The mean.
        mean: [f32; 3],
    },
    /// R = Y + Co - Cg, G = Y + Cg, B = Y - Co - Cg.
    YCoCg,
    /// ln(Y + 1e-5), U / (Y + 1e-5), V / (Y + 1e-5) of YUV.
    LogarithmOfY,
}

impl Color {
    /// RGB of `[channel][texel]`, in place.
    pub(super) fn to_rgb(self, values: &mut [f32]) {
        match self {
            Self::Rgb => {}
            Self::Logarithm => values.iter_mut().for_each(|value| *value = value.exp() - FLOOR),
            Self::Yuv => each(values, rgb_from_yuv),
            Self::Principal { transform, mean } => {
                each(values, |v| [0, 1, 2].map(|c| v[0] * transform[0][c] + v[1] * transform[1][c] + v[2] * transform[2][c] + mean[c]));
            }
            Self::YCoCg => each(values, |[y, co, cg]| [y + co - cg, y + cg, y - co - cg]),
            Self::LogarithmOfY => each(values, |[y, u, v]| {
                let exp = y.exp();
                rgb_from_yuv([exp - FLOOR, u * exp, v * exp])
            }),
        }
    }
}

fn rgb_from_yuv([y, u, v]: [f32; 3]) -> [f32; 3] {
    RGB_FROM_YUV.map(|[a, b, c]| a * y + b * u + c * v)
}

fn each(values: &mut [f32], rgb: impl Fn([f32; 3]) -> [f32; 3]) {
    let texels = values.len() / 3;
    let (first, rest) = values.split_at_mut(texels);
    let (second, third) = rest.split_at_mut(texels);
    for ((a, b), c) in first.iter_mut().zip(second).zip(third) {
        [*a, *b, *c] = rgb([*a, *b, *c]);
    }
}
