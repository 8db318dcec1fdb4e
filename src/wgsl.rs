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
    /// Paint taken for a colour.
    ALPHA_BLEND = "kernels" "alpha_blend";
    /// One more picture of a mean.
    AVERAGE = "kernels" "average";
    /// Neighbours of a texel under a boundary rule.
    BOUNDARY = "kernels/common" "boundary";
    /// Reflectance from radiance.
    BRDF_VALUES = "kernels" "brdf_values";
    /// Real part of a corner of a complex field.
    CROP_REAL = "kernels" "crop_real";
    /// Samples in shadow masked.
    DARK_SAMPLES = "kernels" "dark_samples";
    /// Samples about a centre.
    DEVIATION = "kernels/common" "deviation";
    /// Interpolation between measured directions.
    DIRECTION_MESH = "kernels/common" "direction_mesh";
    /// Look-ups in a prefiltered environment.
    ENVIRONMENT = "kernels/common" "environment";
    /// Directional albedos of a paint's surface.
    ENVIRONMENT_ALBEDO = "kernels" "environment_albedo";
    /// Means of an environment over the lobes of rough surfaces.
    ENVIRONMENT_PREFILTER = "kernels" "environment_prefilter";
    /// An environment at another size.
    ENVIRONMENT_REDUCE = "kernels" "environment_reduce";
    /// One pass of a Fourier transform.
    FFT = "kernels" "fft";
    /// Kubelka-Munk films.
    FILM = "kernels/common" "film";
    /// How far from flat a neighbourhood is.
    FLATNESS = "kernels" "flatness";
    /// Spectrum of a height field from that of its slopes.
    FRANKOT_CHELLAPPA = "kernels" "frankot_chellappa";
    /// Samples into a tile, masked where they are no radiance.
    GATHER = "kernels" "gather";
    /// Layers of paint over a ground.
    KUBELKA_MUNK = "kernels" "kubelka_munk";
    /// A height field and how it is looked at.
    HEIGHT_FIELD = "kernels/common" "height_field";
    /// Rays against a periodic height field, exactly.
    HEIGHT_MARCH = "kernels/common" "height_march";
    /// The Lafortune lobe.
    LAFORTUNE = "kernels/common" "lafortune";
    /// Lafortune fits that still run.
    LAFORTUNE_ACTIVE = "kernels" "lafortune_active";
    /// Best of each texel's Lafortune fits.
    LAFORTUNE_CHAMPION = "kernels" "lafortune_champion";
    /// Valid samples and energy of each texel's Lafortune fit.
    LAFORTUNE_ENERGY = "kernels" "lafortune_energy";
    /// One step of the Lafortune fit.
    LAFORTUNE_FIT = "kernels" "lafortune_fit";
    /// Lit samples and energy of each texel's Lafortune fit in frames.
    LAFORTUNE_FRAMED_ENERGY = "kernels" "lafortune_framed_energy";
    /// Sums over samples at the candidates of the Lafortune fits in frames.
    LAFORTUNE_FRAMED_SUMS = "kernels" "lafortune_framed_sums";
    /// Sums over samples that the Lafortune fit goes by.
    LAFORTUNE_GRAM = "kernels/common" "lafortune_gram";
    /// End of the Lafortune fit.
    LAFORTUNE_RESULT = "kernels" "lafortune_result";
    /// Begin of the Lafortune fits.
    LAFORTUNE_START = "kernels" "lafortune_start";
    /// State of the Lafortune fit between passes.
    LAFORTUNE_STATE = "kernels/common" "lafortune_state";
    /// Sums over samples at the candidates of the Lafortune fits.
    LAFORTUNE_SUMS = "kernels" "lafortune_sums";
    /// Reflectance once the lobes are known.
    LINEAR_REFIT = "kernels" "linear_refit";
    /// Samples whose reflectance stands in the frames of normals.
    LOCAL_SAMPLES = "kernels/common" "local_samples";
    /// A BTF compressed by local PCA.
    LPCA = "kernels/common" "lpca";
    /// Texels to the nearest cluster of a local PCA.
    LPCA_ASSIGN = "kernels" "lpca_assign";
    /// Terms of a local PCA under one view and light.
    LPCA_BLEND = "kernels" "lpca_blend";
    /// Sums that tell mean and covariance of a local PCA's clusters.
    LPCA_COVARIANCE = "kernels" "lpca_covariance";
    /// Sums of samples by the weights of a local PCA.
    LPCA_LIFT = "kernels" "lpca_lift";
    /// Coordinates of texels in a basis.
    LPCA_PROJECT = "kernels" "lpca_project";
    /// Final weights of a local PCA.
    LPCA_WEIGHTS = "kernels" "lpca_weights";
    /// What is left for the next lobe.
    LOBE_RESIDUAL = "kernels" "lobe_residual";
    /// Whether a sample is no radiance.
    MASKED = "kernels/common" "masked";
    /// A mesh that wears a material, where it is seen.
    MESH = "kernels/common" "mesh";
    /// A mesh as the base plane of a relief.
    MESH_BASE = "kernels/common" "mesh_base";
    /// Light of an environment on the paint of a mesh.
    MESH_ENVIRONMENT = "kernels/common" "mesh_environment";
    /// Shadow of a mesh on itself.
    MESH_SHADOW = "kernels/common" "mesh_shadow";
    /// Vertices of a mesh.
    MESH_VERTICES = "kernels/common" "mesh_vertices";
    /// What each pixel sees of a mesh that wears a material.
    MESH_HIT = "shaders" "mesh_hit";
    /// A mesh that wears a material, its bare part by local PCA.
    MESH_LPCA = "shaders" "mesh_lpca";
    /// A mesh that wears a material, its bare part by reflectance.
    MESH_SVBRDF = "shaders" "mesh_svbrdf";
    /// Reflection at a paint's surface.
    MICROFACET = "kernels/common" "microfacet";
    /// Slopes of a surface that goes on mirrored.
    MIRROR_SLOPES = "kernels" "mirror_slopes";
    /// The next coarser level of paint.
    MINIFY = "kernels" "minify";
    /// Value noise.
    NOISE = "kernels/common" "noise";
    /// Normals of a height field.
    NORMALS = "kernels" "normals";
    /// Eight samples as halves.
    OCTET = "kernels/common" "octet";
    /// Drawn thickness of a stroke of a brush.
    PATTERN_BRUSH = "kernels" "pattern_brush";
    /// Drawn thickness of a flower.
    PATTERN_FLOWER = "kernels" "pattern_flower";
    /// Drawn thickness of an image.
    PATTERN_IMAGE = "kernels" "pattern_image";
    /// The image reduced.
    PATTERN_IMAGE_REDUCE = "kernels" "pattern_image_reduce";
    /// Edges, ridges and grain of patterns.
    PATTERN_MARKS = "kernels/common" "pattern_marks";
    /// Drawn thickness of clouds.
    PATTERN_NOISE = "kernels" "pattern_noise";
    /// Where patterns are drawn.
    PATTERN_PLANE = "kernels/common" "pattern_plane";
    /// Drawn thickness of drops of all sizes.
    PATTERN_SPATTER = "kernels" "pattern_spatter";
    /// Drawn thickness of a splash.
    PATTERN_SPLASH = "kernels" "pattern_splash";
    /// Drawn thickness of stripes.
    PATTERN_STRIPES = "kernels" "pattern_stripes";
    /// The same drawn thickness everywhere.
    PATTERN_UNIFORM = "kernels" "pattern_uniform";
    /// Exact quantile per texel and channel.
    PERCENTILE = "kernels" "percentile";
    /// Normals and albedo from radiance under known lights.
    PHOTOMETRIC_STEREO = "kernels" "photometric_stereo";
    /// Errors of a picture against its original.
    PICTURE_ERROR = "kernels" "picture_error";
    /// Joins the errors of each picture's workgroups.
    PICTURE_ERROR_SUM = "kernels" "picture_error_sum";
    /// Sums over the texels of a picture.
    PICTURE_SUMS = "kernels/common" "picture_sums";
    /// The material as a plane.
    PLANE = "shaders" "plane";
    /// How far the model's radiance is from the measured one.
    RADIANCE_ERROR = "kernels" "radiance_error";
    /// What the source's camera would have recorded.
    RECONSTRUCT = "kernels" "reconstruct";
    /// The same from a compressed BTF.
    RECONSTRUCT_LPCA = "kernels" "reconstruct_lpca";
    /// Rays against a height field.
    RELIEF = "kernels/common" "relief";
    /// Radiance that leaves a place of the base plane.
    SHADE = "kernels/common" "shade";
    /// What views see of a height field.
    SEEN_SURFACE = "kernels" "seen_surface";
    /// How seen points are lit.
    SHADING = "kernels" "shading";
    /// The frame of a normal.
    SHADING_FRAME = "kernels/common" "shading_frame";
    /// Depth of a mesh as a light sees it.
    SHADOW = "shaders" "shadow";
    /// Slopes of normals.
    SLOPES = "kernels" "slopes";
    /// Sums of rows of slopes.
    SLOPE_SUM = "kernels" "slope_sum";
    /// The mean specular residual.
    SPECULAR_RESIDUAL = "kernels" "specular_residual";
    /// Specular reflectance per channel.
    SPECULAR_SCALE = "kernels" "specular_scale";
    /// Radiance of a material that is fully known.
    SYNTH = "kernels" "synth";
    /// Interpolation between texels.
    TEXEL_FILTER = "kernels/common" "texel_filter";
    /// Index of a thread in a folded grid.
    THREAD = "kernels/common" "thread";
    /// The bare part by local PCA.
    UNPAINTED_LPCA = "kernels/common" "unpainted_lpca";
    /// The bare part by reflectance.
    UNPAINTED_SVBRDF = "kernels/common" "unpainted_svbrdf";
}
