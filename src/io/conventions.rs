//! What holds for every source and every material: as materials store it and `info` prints it.

/// A topic and what holds.
pub type Convention = (&'static str, &'static str);

const ROWS: Convention = ("rows", "row 0 is the top row, column 0 the left column");
const AXES: Convention = ("axes", "x right, y up, z out of the surface; directions point away from the surface");
const ANGLES: Convention = ("angles", "[theta, phi] in degrees; theta from the normal, phi counter-clockwise from +x");
const COLOR: Convention = ("color", "linear RGB, sRGB primaries");
const PIXEL: Convention =
    ("pixel", "pi L / E, E on a surface that faces the light: a white Lambertian surface that is lit from theta has cos theta");

const REDUCED: Convention = (
    "spectra",
    "CIE 1931 under D65, a constant reflectance is gray; XYZ has the white of D65; where a colour lies outside sRGB, negatives become 0",
);

/// Conventions of a source.
pub const SOURCE: &[Convention] = &[ROWS, AXES, ANGLES, COLOR, REDUCED, PIXEL];

/// Conventions of a dataset.
pub const DATASET: &[Convention] = &[ROWS, AXES, ANGLES, COLOR, PIXEL];

/// Conventions of a material.
pub const MATERIAL: &[Convention] = &[
    ROWS,
    AXES,
    ANGLES,
    COLOR,
    PIXEL,
    ("height", "texel widths over the plane that the pictures are rectified to, positive outwards"),
    ("reflectance", "pi f_r: a white Lambertian surface has 1"),
    ("model", "pi f_r = diffuse + specular * lobe"),
];
