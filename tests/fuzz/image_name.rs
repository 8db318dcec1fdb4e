//! What is done with bytes that may be an image's name, by its fuzz target and by the test of its corpus.

use overpaint::io;

/// Looks for directions in a name. Those that are found are numbers, in any spelling of the same name.
pub fn exercise(bytes: &[u8]) {
    let name = String::from_utf8_lossy(bytes);
    let found = io::directions_in_name(&name);
    let (lower, nested) = (name.to_ascii_lowercase(), format!("folder/tl1 pl2 tv3 pv4/{name}"));
    assert!(found == io::directions_in_name(&lower) && found == io::directions_in_name(&nested), "{name}");
    if let Some((view, light)) = found {
        for direction in [view, light] {
            assert!(direction.theta.is_finite() && (0.0..std::f64::consts::TAU).contains(&direction.phi), "{direction:?}");
        }
    }
}
