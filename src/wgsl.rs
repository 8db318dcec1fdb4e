//! Every WGSL file, embedded. A file is a source by its stem; `#import STEM` joins it.

use crate::gpu::Source;

macro_rules! sources {
    ($($(#[$meta:meta])* $name:ident = $folder:literal $stem:literal;)*) => {
        $($(#[$meta])* pub const $name: Source = Source {
            name: $stem,
            path: concat!($folder, "/", $stem, ".wgsl"),
            text: include_str!(concat!("../", $folder, "/", $stem, ".wgsl")),
        };)*
        /// All sources: the library that imports are looked up in.
        pub const ALL: &[Source] = &[$($name),*];
    };
}

sources! {
    /// Neighbours of a texel under a boundary rule.
    BOUNDARY = "kernels/common" "boundary";
    /// Reflectance from radiance.
    BRDF_VALUES = "kernels" "brdf_values";
    /// The Lafortune lobe.
    LAFORTUNE = "kernels/common" "lafortune";
    /// One step of the Lafortune fit.
    LAFORTUNE_FIT = "kernels" "lafortune_fit";
    /// End of the Lafortune fit.
    LAFORTUNE_RESULT = "kernels" "lafortune_result";
    /// Begin of a descent of the Lafortune fit.
    LAFORTUNE_START = "kernels" "lafortune_start";
    /// State of the Lafortune fit between passes.
    LAFORTUNE_STATE = "kernels/common" "lafortune_state";
    /// Normals of a height field.
    NORMALS = "kernels" "normals";
    /// Eight samples as halves.
    OCTET = "kernels/common" "octet";
    /// Exact quantile per texel and channel.
    PERCENTILE = "kernels" "percentile";
    /// The mean specular residual.
    SPECULAR_RESIDUAL = "kernels" "specular_residual";
    /// Specular reflectance per channel.
    SPECULAR_SCALE = "kernels" "specular_scale";
    /// Tile of sRGB images to linear halves.
    SRGB_DECODE = "kernels" "srgb_decode";
    /// Index of a thread in a folded grid.
    THREAD = "kernels/common" "thread";
}
