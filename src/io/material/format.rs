//! The form of a material on disk: its arrays, their units and conventions.

use serde_json::{Map, Value, json};

use crate::data::{MAX_LOBES, Material};

/// Name of the form, in the group's attributes.
pub const MATERIAL_FORMAT: &str = "overpaint material";

/// Version of the form, in the group's attributes.
pub(super) const VERSION: u64 = 4;

/// Versions that can be read. The third has no paint and is the fourth otherwise.
pub(super) const READ_VERSIONS: [u64; 2] = [3, VERSION];

/// Rows and columns of a chunk, fewer where the plane has fewer.
const CHUNK: u64 = 256;

/// Values of a chunk of samples: 2 MiB of halves.
const CHUNK_VALUES: u64 = 1 << 20;

/// Lengths of the dimensions that differ from material to material.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lengths {
    pub(super) plane: [usize; 2],
    /// Of the local PCA, as are the next two; 0 without one.
    pub(super) samples: usize,
    pub(super) clusters: usize,
    pub(super) components: usize,
}

impl Lengths {
    pub(super) fn of(material: &Material) -> Self {
        let [samples, clusters, components] =
            material.lpca.as_ref().map_or([0; 3], |lpca| [lpca.pairs.len(), lpca.clusters, lpca.components]);
        Self { plane: material.size(), samples, clusters, components }
    }
}

/// A dimension of an array.
#[derive(Debug, Clone, Copy)]
enum Dimension {
    Row,
    Column,
    Sample,
    Cluster,
    /// The mean and the eigenvectors of a cluster.
    Term,
    /// The weights of a cluster's eigenvectors.
    Component,
    /// One that every material has alike: its name and the names along it.
    Of(&'static str, &'static [&'static str]),
}

impl Dimension {
    fn name(self) -> &'static str {
        match self {
            Self::Row => "row",
            Self::Column => "column",
            Self::Sample => "sample",
            Self::Cluster => "cluster",
            Self::Term => "term",
            Self::Component => "component",
            Self::Of(name, _) => name,
        }
    }

    fn length(self, lengths: &Lengths) -> u64 {
        let length = match self {
            Self::Row => lengths.plane[1],
            Self::Column => lengths.plane[0],
            Self::Sample => lengths.samples,
            Self::Cluster => lengths.clusters,
            Self::Term => 1 + lengths.components,
            Self::Component => lengths.components,
            Self::Of(_, names) => names.len(),
        };
        length as u64
    }
}

use Dimension::{Cluster, Column, Component, Of, Row, Sample, Term};

/// One array of the group.
pub(in crate::io) struct Layout {
    pub(in crate::io) name: &'static str,
    /// Outermost first.
    dimensions: &'static [Dimension],
    pub(in crate::io) unit: &'static str,
    pub(in crate::io) about: &'static str,
}

const SCALAR: &[Dimension] = &[Row, Column];
const XYZ: &[Dimension] = &[Row, Column, Of("axis", &["x", "y", "z"])];
const CHANNEL: Dimension = Of("channel", &["R", "G", "B"]);
const RGB: &[Dimension] = &[Row, Column, CHANNEL];

const fn layout(name: &'static str, dimensions: &'static [Dimension], unit: &'static str, about: &'static str) -> Layout {
    Layout { name, dimensions, unit, about }
}

const fn specular(name: &'static str) -> Layout {
    layout(name, RGB, "reflectance", "rho_s")
}

const fn lobe(name: &'static str) -> Layout {
    layout(
        name,
        &[Row, Column, Of("parameter", &["C_x", "C_y", "C_z", "n"])],
        "1",
        "lobe (C_x l_x v_x + C_y l_y v_y + C_z l_z v_z)^n, Lafortune et al. 1997",
    )
}

pub(in crate::io) const HEIGHT: Layout =
    layout("height", SCALAR, "texel widths", "height over the plane that the pictures are rectified to, positive outwards");
pub(in crate::io) const NORMAL: Layout = layout("normal", XYZ, "1", "unit normals of the height field");
pub(super) const NORMAL_MEASURED: Layout = layout("normal_measured", XYZ, "1", "unit normals of photometric stereo, before integration");
pub(super) const ALBEDO: Layout = layout("albedo", SCALAR, "reflectance", "albedo of photometric stereo");
pub(in crate::io) const DIFFUSE: Layout = layout("diffuse", RGB, "reflectance", "rho_d");
/// Of the first lobe, the second and the third.
pub(in crate::io) const SPECULAR: [Layout; MAX_LOBES] = [specular("specular"), specular("specular_2"), specular("specular_3")];
pub(in crate::io) const LOBE: [Layout; MAX_LOBES] = [lobe("lobe"), lobe("lobe_2"), lobe("lobe_3")];
pub(super) const OBJECTIVE_WITHOUT_LOBE: Layout =
    layout("fit_objective_without_lobe", SCALAR, "reflectance^2", "mean squared residual without any lobe");
pub(super) const OBJECTIVE: Layout = layout("fit_objective", SCALAR, "reflectance^2", "mean squared residual at the end of the fit");
pub(super) const ITERATIONS: Layout = layout("fit_iterations", SCALAR, "1", "steps of Levenberg-Marquardt that were tried");
pub(super) const STATUS: Layout = layout(
    "fit_status",
    SCALAR,
    "code",
    "0 out of iterations, 1 converged, 2 no specular part, 3 settled to rounding: no step lowers the objective in single precision, \
     4 too few valid samples: no lobe, 5 not fitted: the lobe is that of the representative texel",
);

pub(super) const MASKED: Layout =
    layout("fit_masked", SCALAR, "1", "number of masked samples: measurements that were NaN, infinite or negative, which take no part");

pub(super) const LPCA_CLUSTER: Layout =
    layout("lpca_cluster", SCALAR, "1", "local PCA (Mueller, Meseth, Klein 2003): cluster of the texel");
pub(super) const LPCA_WEIGHTS: Layout = layout(
    "lpca_weights",
    &[Row, Column, Component],
    "1",
    "local PCA: weights of terms 1, 2 and so on of the texel's cluster, of unit variance in it",
);
pub(super) const LPCA_TERMS: Layout = layout(
    "lpca_terms",
    &[Sample, Cluster, Term, CHANNEL],
    "pi L / E",
    "local PCA: term 0 is the cluster's mean, the others its eigenvectors times the standard deviations of their weights; the radiance of a \
     texel in a sample is lpca_terms[sample, k, 0] + the sum over c of lpca_weights[row, column, c] lpca_terms[sample, k, 1 + c], \
     k = lpca_cluster[row, column]",
);
pub(super) const LPCA_ERROR: Layout =
    layout("lpca_error", SCALAR, "1", "local PCA: root of the sum of squared errors of the texel over that of its radiance's squares");
pub(super) const LPCA_PAIRS: Layout = layout(
    "lpca_pairs",
    &[Sample, Of("direction", &["view", "light"])],
    "index",
    "local PCA: view and light of the sample, in the provenance's lists of views and lights",
);

pub(in crate::io) const PAINT_HEIGHT: Layout =
    layout("paint_height", SCALAR, "texel widths", "height of the painted surface, over the same plane as the material's own");
pub(in crate::io) const PAINT_NORMAL: Layout = layout("paint_normal", XYZ, "1", "unit normals of the painted surface");
pub(in crate::io) const PAINT_REFLECTANCE: Layout =
    layout("paint_reflectance", RGB, "reflectance", "diffuse reflectance of the paint on the material's (Kubelka, Munk 1931)");
pub(in crate::io) const PAINT_COVERAGE: Layout = layout("paint_coverage", SCALAR, "1", "how much of the texel is painted, 0 to 1");
pub(in crate::io) const PAINT_COAT: Layout = layout(
    "paint_coat",
    &[Row, Column, Of("parameter", &["F0", "alpha"])],
    "1",
    "surface of the topmost paint: reflectance at normal incidence, and width of its GGX lobe",
);

/// Names of the arrays of the local PCA.
pub(super) const LPCA_NAMES: [&str; 5] = [LPCA_CLUSTER.name, LPCA_WEIGHTS.name, LPCA_TERMS.name, LPCA_ERROR.name, LPCA_PAIRS.name];

/// Names of all arrays.
pub(super) const NAMES: [&str; 26] = [
    HEIGHT.name,
    NORMAL.name,
    NORMAL_MEASURED.name,
    ALBEDO.name,
    DIFFUSE.name,
    SPECULAR[0].name,
    SPECULAR[1].name,
    SPECULAR[2].name,
    LOBE[0].name,
    LOBE[1].name,
    LOBE[2].name,
    OBJECTIVE_WITHOUT_LOBE.name,
    OBJECTIVE.name,
    ITERATIONS.name,
    STATUS.name,
    MASKED.name,
    LPCA_CLUSTER.name,
    LPCA_WEIGHTS.name,
    LPCA_TERMS.name,
    LPCA_ERROR.name,
    LPCA_PAIRS.name,
    PAINT_HEIGHT.name,
    PAINT_NORMAL.name,
    PAINT_REFLECTANCE.name,
    PAINT_COVERAGE.name,
    PAINT_COAT.name,
];

impl Layout {
    /// Lengths of the dimensions, outermost first.
    pub(super) fn shape(&self, lengths: &Lengths) -> Vec<u64> {
        self.dimensions.iter().map(|dimension| dimension.length(lengths)).collect()
    }

    /// Shape of one chunk.
    pub(super) fn chunk(&self, lengths: &Lengths) -> Vec<u64> {
        let inner = |depth: usize| self.dimensions[depth + 1..].iter().map(|dimension| dimension.length(lengths)).product::<u64>();
        let side = |(depth, dimension): (usize, &Dimension)| {
            let most = match dimension {
                Row | Column => CHUNK,
                Sample => (CHUNK_VALUES / inner(depth).max(1)).max(1),
                Cluster | Term | Component | Of(..) => u64::MAX,
            };
            dimension.length(lengths).min(most)
        };
        self.dimensions.iter().enumerate().map(side).collect()
    }

    pub(super) fn dimensions(&self) -> Vec<&'static str> {
        self.dimensions.iter().map(|dimension| dimension.name()).collect()
    }

    pub(super) fn attributes(&self) -> Map<String, Value> {
        let mut attributes = Map::from_iter([("unit".to_owned(), json!(self.unit)), ("description".to_owned(), json!(self.about))]);
        if let Some(Of(_, names)) = self.dimensions.last() {
            attributes.insert("components".to_owned(), json!(names));
        }
        attributes
    }
}
