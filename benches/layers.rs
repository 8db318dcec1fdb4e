//! Paint that benches lay on.

use overpaint::model::Pattern;

/// The thesis' four layers (fig. 4.15), each with a pattern.
pub const LAYERS: [(&str, Pattern); 4] = [
    ("oil/cobalt blue", Pattern::Splash { seed: 1 }),
    ("oil/alizarin crimson", Pattern::Brush { seed: 2, width: 0.3 }),
    ("oil/burnt sienna", Pattern::Spatter { seed: 3, cover: 0.3 }),
    ("oil/viridian", Pattern::Flower { seed: 4, petals: 6 }),
];
