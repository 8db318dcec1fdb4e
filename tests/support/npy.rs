//! numpy's array files, as far as the shared data needs them.

use std::{fs, path::Path};

/// The values of a C-ordered array of doubles or floats.
pub fn read(path: &Path) -> Vec<f64> {
    let bytes = fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    assert!(bytes.starts_with(b"\x93NUMPY\x01"), "{}: not version 1 of numpy's format", path.display());
    let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let header = std::str::from_utf8(&bytes[10..start]).expect("is ASCII");
    assert!(header.contains("'fortran_order': False"), "{header}");
    if header.contains("'<f8'") {
        bytes[start..].chunks_exact(8).map(|value| f64::from_le_bytes(value.try_into().expect("has 8 bytes"))).collect()
    } else {
        assert!(header.contains("'<f4'"), "{header}");
        bytes[start..].chunks_exact(4).map(|value| f64::from(f32::from_le_bytes(value.try_into().expect("has 4 bytes")))).collect()
    }
}
