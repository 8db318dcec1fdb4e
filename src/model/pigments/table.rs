//! The coefficients themselves.

use super::{Grade, Pigment, PigmentSet};

const fn watercolour(name: &'static str, k: [f64; 3], s: [f64; 3]) -> Pigment {
    Pigment { name, set: PigmentSet::Watercolour, k, s, grade: Grade::Published, source: "Curtis et al. 1997" }
}

const fn oil(name: &'static str, grade: Grade, k: [f64; 3], s: [f64; 3], source: &'static str) -> Pigment {
    Pigment { name, set: PigmentSet::Oil, k, s, grade, source }
}

/// Curtis, Anderson, Seims, Fleischer, Salesin 1997.
pub(super) const WATERCOLOURS: &[Pigment] = &[
    watercolour("Quinacridone Rose", [0.22, 1.47, 0.57], [0.05, 0.003, 0.03]),
    watercolour("Indian Red", [0.46, 1.07, 1.50], [1.28, 0.38, 0.21]),
    watercolour("Cadmium Yellow", [0.10, 0.36, 3.45], [0.97, 0.65, 0.007]),
    watercolour("Hookers Green", [1.62, 0.61, 1.64], [0.01, 0.012, 0.003]),
    watercolour("Cerulean Blue", [1.52, 0.32, 0.25], [0.06, 0.26, 0.40]),
    watercolour("Burnt Umber", [0.74, 1.54, 2.10], [0.09, 0.09, 0.004]),
    watercolour("Cadmium Red", [0.14, 1.08, 1.68], [0.77, 0.015, 0.018]),
    watercolour("Brilliant Orange", [0.13, 0.81, 3.45], [0.005, 0.009, 0.007]),
    watercolour("Hansa Yellow", [0.06, 0.21, 1.78], [0.50, 0.88, 0.009]),
    watercolour("Phthalo Green", [1.55, 0.47, 0.63], [0.01, 0.05, 0.035]),
    watercolour("French Ultramarine", [0.86, 0.86, 0.06], [0.005, 0.005, 0.09]),
    watercolour("Interference Lilac", [0.08, 0.11, 0.07], [1.25, 0.42, 1.43]),
];

/// Substitutes at 652, 532 and 460 nm, S of titanium white = 1.
pub(super) const OILS: &[Pigment] = &[
    oil(
        "Titanium White",
        Grade::Measured,
        [0.0005456, 0.000531, 0.000613],
        [1.0, 1.0, 1.0],
        "PW6 itself in acrylic, K and S measured (Okumura 2005)",
    ),
    oil(
        "Cobalt Blue",
        Grade::Measured,
        [0.170719, 0.126703, 0.007906],
        [0.0329188, 0.019377, 0.038321],
        "PB28 itself in acrylic, K and S measured (Okumura 2005)",
    ),
    oil(
        "Burnt Sienna",
        Grade::Measured,
        [0.0572222, 0.433984, 0.505713],
        [0.0802576, 0.042536, 0.033698],
        "PBr7 itself in acrylic, K and S measured (Okumura 2005)",
    ),
    oil(
        "Cadmium Yellow",
        Grade::StandIn,
        [0.001, 0.245411, 2.58699],
        [0.283544, 0.509616, 0.238091],
        "PY83 diarylide yellow in acrylic, K and S measured (Okumura 2005); opaque colour of an oil cadmium yellow medium to dE76 1.3; cadmium sulphide has lower K and S",
    ),
    oil(
        "Viridian",
        Grade::StandIn,
        [2.16451, 0.0307374, 0.305753],
        [0.117469, 0.0097817, 0.0435433],
        "97 % PG36, 1.2 % PY74, 1.5 % PR254 (Berns 2016); opaque colour of an oil viridian (PG18) to dE76 0.7",
    ),
    oil(
        "Sap Green",
        Grade::StandIn,
        [1.5254, 0.193806, 0.581039],
        [0.107566, 0.0458974, 0.0488267],
        "65.6 % PG36 (Berns 2016), 27.8 % burnt umber, 6.6 % PY83 (Okumura 2005); opaque colour of an oil sap green to dE76 2.5",
    ),
    oil(
        "Alizarin Crimson",
        Grade::StandIn,
        [0.02399, 1.51265, 0.716383],
        [0.023339, 0.0815344, 0.052064],
        "quinacridone crimson in acrylic, K and S measured (Okumura 2005); opaque colour of an oil PR83 to dE76 7.0, the oil is darker",
    ),
    oil(
        "Prussian Blue",
        Grade::Derived,
        [0.783238, 0.195953, 0.0730679],
        [0.0275848, 0.00398375, 0.00182463],
        "K from a tint of PB27 with half TiO2, scaled as PB28 is by the same procedure; S from the opaque colour of an oil Prussian blue",
    ),
];
