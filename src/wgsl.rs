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
    /// Index of a thread in a folded grid.
    THREAD = "kernels/common" "thread";
    /// Neighbours of a texel under a boundary rule.
    BOUNDARY = "kernels/common" "boundary";
    /// Eight samples as halves.
    OCTET = "kernels/common" "octet";
    /// Real part of a corner of a complex field.
    CROP_REAL = "kernels" "crop_real";
    /// One pass of a Fourier transform.
    FFT = "kernels" "fft";
    /// Spectrum of a height field from that of its slopes.
    FRANKOT_CHELLAPPA = "kernels" "frankot_chellappa";
    /// Slopes of a surface that goes on mirrored.
    MIRROR_SLOPES = "kernels" "mirror_slopes";
    /// Normals of a height field.
    NORMALS = "kernels" "normals";
    /// Normals and albedo from radiance under known lights.
    PHOTOMETRIC_STEREO = "kernels" "photometric_stereo";
    /// Sums of rows of slopes.
    SLOPE_SUM = "kernels" "slope_sum";
    /// Slopes of normals.
    SLOPES = "kernels" "slopes";
}
