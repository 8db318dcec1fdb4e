//! What is done with bytes that may be a light file, by its fuzz target and by the test of its corpus.

use overpaint::{data::Direction, io::lights};

/// Reads a file as each of the three kinds. Lights that are found are above the horizon, and no more of them than bytes.
pub fn exercise(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let check = |lights: Vec<Direction>| {
        assert!(lights.len() <= bytes.len());
        for light in lights {
            assert!((0.0..std::f64::consts::FRAC_PI_2).contains(&light.theta), "{light:?}");
            assert!((0.0..std::f64::consts::TAU).contains(&light.phi), "{light:?}");
        }
    };
    for read in [lights::parse_uw, lights::parse_harvard] {
        match read(&text) {
            Ok(lights) => check(lights),
            Err(fault) => assert!(!fault.to_string().is_empty()),
        }
    }
    match lights::parse_lp(&text) {
        Ok(lights) => check(lights.into_iter().map(|(_, light)| light).collect()),
        Err(fault) => assert!(!fault.to_string().is_empty()),
    }
}
