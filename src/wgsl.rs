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
    /// The Lafortune lobe.
    LAFORTUNE = "kernels/common" "lafortune";
    /// Reflection of a rough dielectric coat.
    MICROFACET = "kernels/common" "microfacet";
    /// Rays against a height field.
    RELIEF = "kernels/common" "relief";
    /// Radiance that leaves a place of the base plane.
    SHADE = "kernels/common" "shade";
    /// The maps and directions that shading reads.
    SURFACE = "kernels/common" "surface";
    /// Normals of a height field.
    NORMALS = "kernels" "normals";
    /// What the source's camera would have recorded.
    RECONSTRUCT = "kernels" "reconstruct";
    /// The material as a plane.
    PLANE = "shaders" "plane";
}
