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
    /// Kubelka-Munk films.
    FILM = "kernels/common" "film";
    /// Reflection at a paint's surface.
    MICROFACET = "kernels/common" "microfacet";
    /// Value noise.
    NOISE = "kernels/common" "noise";
    /// One layer of paint over diffuse reflectance.
    KUBELKA_MUNK = "kernels" "kubelka_munk";
    /// Normals of a height field.
    NORMALS = "kernels" "normals";
    /// One layer of paint over a height field.
    PAINT_RELIEF = "kernels" "paint_relief";
    /// Drawn thickness of a procedural pattern.
    PATTERN = "kernels" "pattern";
}
