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
    /// Real part of a corner of a complex field.
    CROP_REAL = "kernels" "crop_real";
    /// Samples in shadow masked.
    DARK_SAMPLES = "kernels" "dark_samples";
    /// One pass of a Fourier transform.
    FFT = "kernels" "fft";
    /// Kubelka-Munk films.
    FILM = "kernels/common" "film";
    /// Spectrum of a height field from that of its slopes.
    FRANKOT_CHELLAPPA = "kernels" "frankot_chellappa";
    /// Samples into a tile, masked where they are no radiance.
    GATHER = "kernels" "gather";
    /// One layer of paint over diffuse reflectance.
    KUBELKA_MUNK = "kernels" "kubelka_munk";
    /// A height field and how it is looked at.
    HEIGHT_FIELD = "kernels/common" "height_field";
    /// Rays against a periodic height field, exactly.
    HEIGHT_MARCH = "kernels/common" "height_march";
    /// The Lafortune lobe.
    LAFORTUNE = "kernels/common" "lafortune";
    /// Texels whose Lafortune fit still runs.
    LAFORTUNE_ACTIVE = "kernels" "lafortune_active";
    /// Valid samples and energy of each texel's Lafortune fit.
    LAFORTUNE_ENERGY = "kernels" "lafortune_energy";
    /// One step of the Lafortune fit.
    LAFORTUNE_FIT = "kernels" "lafortune_fit";
    /// End of the Lafortune fit.
    LAFORTUNE_RESULT = "kernels" "lafortune_result";
    /// Begin of a descent of the Lafortune fit.
    LAFORTUNE_START = "kernels" "lafortune_start";
    /// State of the Lafortune fit between passes.
    LAFORTUNE_STATE = "kernels/common" "lafortune_state";
    /// Reflectance once the lobes are known.
    LINEAR_REFIT = "kernels" "linear_refit";
    /// Samples whose reflectance stands in the frames of normals.
    LOCAL_SAMPLES = "kernels/common" "local_samples";
    /// Reflection at a paint's surface.
    MICROFACET = "kernels/common" "microfacet";
    /// Slopes of a surface that goes on mirrored.
    MIRROR_SLOPES = "kernels" "mirror_slopes";
    /// Value noise.
    NOISE = "kernels/common" "noise";
    /// Normals of a height field.
    NORMALS = "kernels" "normals";
    /// Eight samples as halves.
    OCTET = "kernels/common" "octet";
    /// One layer of paint over a height field.
    PAINT_RELIEF = "kernels" "paint_relief";
    /// Drawn thickness of a procedural pattern.
    PATTERN = "kernels" "pattern";
    /// Exact quantile per texel and channel.
    PERCENTILE = "kernels" "percentile";
    /// Normals and albedo from radiance under known lights.
    PHOTOMETRIC_STEREO = "kernels" "photometric_stereo";
    /// The material as a plane.
    PLANE = "shaders" "plane";
    /// How far the model's radiance is from the measured one.
    RADIANCE_ERROR = "kernels" "radiance_error";
    /// What the source's camera would have recorded.
    RECONSTRUCT = "kernels" "reconstruct";
    /// Rays against a height field.
    RELIEF = "kernels/common" "relief";
    /// Radiance that leaves a place of the base plane.
    SHADE = "kernels/common" "shade";
    /// The frame of a normal.
    SHADING_FRAME = "kernels/common" "shading_frame";
    /// Slopes of normals.
    SLOPES = "kernels" "slopes";
    /// Sums of rows of slopes.
    SLOPE_SUM = "kernels" "slope_sum";
    /// The mean specular residual.
    SPECULAR_RESIDUAL = "kernels" "specular_residual";
    /// Specular reflectance per channel.
    SPECULAR_SCALE = "kernels" "specular_scale";
    /// The maps and directions that shading reads.
    SURFACE = "kernels/common" "surface";
    /// Radiance of a material that is fully known.
    SYNTH = "kernels" "synth";
    /// Index of a thread in a folded grid.
    THREAD = "kernels/common" "thread";
}
