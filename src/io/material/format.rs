//! The form of a material on disk: its arrays, their units and conventions.

use serde_json::{Map, Value, json};

use crate::data::MAX_LOBES;

/// Name of the form, in the group's attributes.
pub const MATERIAL_FORMAT: &str = "overpaint material";

/// Version of the form, in the group's attributes.
pub(super) const VERSION: u64 = 2;

/// Rows and columns of a chunk, fewer where the plane has fewer.
pub(super) const CHUNK: usize = 256;

/// One array of the group: `[row][column]` or `[row][column][component]`.
pub(super) struct Layout {
    pub(super) name: &'static str,
    /// Name of the third dimension and names of its components, if there is one.
    pub(super) components: Option<(&'static str, &'static [&'static str])>,
    unit: &'static str,
    about: &'static str,
}

const XYZ: Option<(&str, &[&str])> = Some(("axis", &["x", "y", "z"]));
const RGB: Option<(&str, &[&str])> = Some(("channel", &["R", "G", "B"]));

const fn layout(
    name: &'static str, components: Option<(&'static str, &'static [&'static str])>, unit: &'static str, about: &'static str,
) -> Layout {
    Layout { name, components, unit, about }
}

const fn specular(name: &'static str) -> Layout {
    layout(name, RGB, "reflectance", "rho_s")
}

const fn lobe(name: &'static str) -> Layout {
    let parameters = Some(("parameter", &["C_x", "C_y", "C_z", "n"] as &[&str]));
    layout(name, parameters, "1", "lobe (C_x l_x v_x + C_y l_y v_y + C_z l_z v_z)^n, Lafortune et al. 1997")
}

pub(super) const HEIGHT: Layout =
    layout("height", None, "texel widths", "height over the plane that the pictures are rectified to, positive outwards");
pub(super) const NORMAL: Layout = layout("normal", XYZ, "1", "unit normals of the height field");
pub(super) const NORMAL_MEASURED: Layout = layout("normal_measured", XYZ, "1", "unit normals of photometric stereo, before integration");
pub(super) const ALBEDO: Layout = layout("albedo", None, "reflectance", "albedo of photometric stereo");
pub(super) const DIFFUSE: Layout = layout("diffuse", RGB, "reflectance", "rho_d");
/// Of the first lobe, the second and the third.
pub(super) const SPECULAR: [Layout; MAX_LOBES] = [specular("specular"), specular("specular_2"), specular("specular_3")];
pub(super) const LOBE: [Layout; MAX_LOBES] = [lobe("lobe"), lobe("lobe_2"), lobe("lobe_3")];
pub(super) const OBJECTIVE_WITHOUT_LOBE: Layout =
    layout("fit_objective_without_lobe", None, "reflectance^2", "mean squared residual without any lobe");
pub(super) const OBJECTIVE: Layout = layout("fit_objective", None, "reflectance^2", "mean squared residual at the end of the fit");
pub(super) const ITERATIONS: Layout = layout("fit_iterations", None, "1", "steps of Levenberg-Marquardt that were tried");
pub(super) const STATUS: Layout = layout(
    "fit_status",
    None,
    "code",
    "0 out of iterations, 1 converged, 2 no specular part, 3 settled to rounding: no step lowers the objective in single precision, \
     4 too few valid samples: no lobe, 5 not fitted: the lobe is that of the representative texel",
);

pub(super) const MASKED: Layout =
    layout("fit_masked", None, "1", "number of masked samples: measurements that were NaN, infinite or negative, which take no part");

/// Names of all arrays.
pub(super) const NAMES: [&str; 16] = [
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
];

impl Layout {
    /// `[rows, columns]` or `[rows, columns, components]`.
    pub(super) fn shape(&self, [width, height]: [usize; 2]) -> Vec<u64> {
        let components = self.components.map(|(_, names)| names.len());
        [Some(height), Some(width), components].into_iter().flatten().map(|side| side as u64).collect()
    }

    /// Shape of one chunk.
    pub(super) fn chunk(&self, [width, height]: [usize; 2]) -> Vec<u64> {
        self.shape([width.min(CHUNK), height.min(CHUNK)])
    }

    pub(super) fn dimensions(&self) -> Vec<&'static str> {
        [Some("row"), Some("column"), self.components.map(|(dimension, _)| dimension)].into_iter().flatten().collect()
    }

    pub(super) fn attributes(&self) -> Map<String, Value> {
        let mut attributes = Map::from_iter([("unit".to_owned(), json!(self.unit)), ("description".to_owned(), json!(self.about))]);
        if let Some((_, names)) = self.components {
            attributes.insert("components".to_owned(), json!(names));
        }
        attributes
    }
}
