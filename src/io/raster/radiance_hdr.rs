//! Radiance HDR in all eight orientations (Ward 1991, "Real pixels"; Radiance's `color.c` and `resolu.c`).
//!
//! The resolution line says which axis runs slowest and which way each runs: `-Y 480 +X 640` is the usual one, `+X 256 -Y 256` that of
//! ATRIUM: columns from the left, each from its top. Libraries refuse all but the first.
//!
//! A value is mantissa · 2^(exponent - 136), as in most libraries (Radiance itself adds half a step to the mantissa), divided by what the
//! lines `EXPOSURE=` and `COLORCORR=` say that it was multiplied by.

use crate::io::IoError;

/// How every file starts: `#?RADIANCE`, `#?RGBE`.
pub(super) const SIGNATURE: &[u8] = b"#?";

/// Scan lines of these lengths may be run-length encoded by component.
const ENCODED_LENGTHS: std::ops::RangeInclusive<usize> = 8..=0x7fff;

/// A header.
pub(super) struct RadianceHdr<'a> {
    /// Columns and rows.
    pub size: [usize; 2],
    /// Scan lines are columns.
    by_columns: bool,
    /// x descends; y descends, from the top row.
    x_descends: bool,
    y_descends: bool,
    /// What the file's R, G, B were multiplied by.
    exposure: [f64; 3],
    pixels: &'a [u8],
}

impl<'a> RadianceHdr<'a> {
    /// Reads the header.
    pub(super) fn open(file: &str, bytes: &'a [u8]) -> Result<Self, IoError> {
        let damaged = |message: String| IoError::Damaged { file: file.to_owned(), message };
        let mut rest = bytes;
        let mut next = || -> Result<String, IoError> {
            let end = rest.iter().position(|&byte| byte == b'\n').ok_or_else(|| truncated(file, bytes))?;
            let line = String::from_utf8_lossy(&rest[..end]).trim().to_owned();
            rest = &rest[end + 1..];
            Ok(line)
        };
        let mut exposure = [1.0; 3];
        loop {
            let line = next()?;
            if line.is_empty() {
                break;
            }
            let Some((key, value)) = line.split_once('=').filter(|_| !line.starts_with('#')) else { continue };
            let factors: Vec<f64> = value.split_whitespace().filter_map(|number| number.parse().ok()).collect();
            match (key.trim(), factors.as_slice()) {
                ("FORMAT", _) if value.trim() != "32-bit_rle_rgbe" => {
                    return Err(IoError::Unsupported { file: file.to_owned(), found: format!("Radiance HDR of format {}", value.trim()) });
                }
                ("EXPOSURE", &[factor]) if factor.is_finite() && factor > 0.0 => exposure = exposure.map(|before| before * factor),
                ("COLORCORR", &[r, g, b]) if [r, g, b].iter().all(|factor| factor.is_finite() && *factor > 0.0) => {
                    exposure = [exposure[0] * r, exposure[1] * g, exposure[2] * b];
                }
                ("EXPOSURE" | "COLORCORR", _) => {
                    return Err(damaged(format!("its header has the line \"{line}\", expected positive numbers")));
                }
                _ => {}
            }
        }
        let line = next()?;
        let resolution = || {
            let mut words = line.split_whitespace();
            let mut axis = || Some((words.next()?, words.next()?.parse::<u32>().ok().filter(|&count| count > 0)? as usize));
            let found = (axis()?, axis()?);
            words.next().is_none().then_some(found)
        };
        let (size, by_columns, x, y) = match resolution() {
            Some(((y @ ("+Y" | "-Y"), height), (x @ ("+X" | "-X"), width))) => ([width, height], false, x, y),
            Some(((x @ ("+X" | "-X"), width), (y @ ("+Y" | "-Y"), height))) => ([width, height], true, x, y),
            _ => return Err(damaged(format!("its resolution line is \"{line}\", expected such as \"-Y 256 +X 256\""))),
        };
        Ok(Self { size, by_columns, x_descends: x == "-X", y_descends: y == "-Y", exposure, pixels: rest })
    }

    /// RGB of all texels.
    pub(super) fn decode(&self, file: &str, bytes: &[u8]) -> Result<Vec<f32>, IoError> {
        let [width, height] = self.size;
        let (lines, length) = if self.by_columns { (width, height) } else { (height, width) };
        // Each scan line starts with four bytes.
        if self.pixels.len() < lines.saturating_mul(4) {
            return Err(truncated(file, bytes));
        }
        let mut values = vec![0.0; 3 * width * height];
        let mut line = vec![[0; 4]; length];
        let mut rest = self.pixels;
        for index in 0..lines {
            scan_line(&mut rest, &mut line).map_err(|fault| match fault {
                Fault::Ends => truncated(file, bytes),
                Fault::Wrong(message) => IoError::Damaged { file: file.to_owned(), message: format!("scan line {index} {message}") },
            })?;
            for (along, &[r, g, b, exponent]) in line.iter().enumerate() {
                let (x, y) = if self.by_columns { (index, along) } else { (along, index) };
                let column = if self.x_descends { width - 1 - x } else { x };
                // The axis y points up, the first row is the top one.
                let row = if self.y_descends { y } else { height - 1 - y };
                let unit = if exponent == 0 { 0.0 } else { 2.0_f64.powi(i32::from(exponent) - 136) };
                for (channel, mantissa) in [r, g, b].into_iter().enumerate() {
                    // At most 2^127, and with a small exposure more: what is finite stays finite.
                    let value = f64::from(mantissa) * unit / self.exposure[channel];
                    #[expect(clippy::cast_possible_truncation, reason = "to the nearest f32")]
                    let value = value.min(f64::from(f32::MAX)) as f32;
                    values[3 * (row * width + column) + channel] = value;
                }
            }
        }
        Ok(values)
    }
}

fn truncated(file: &str, bytes: &[u8]) -> IoError {
    IoError::Truncated { file: file.to_owned(), bytes: bytes.len() }
}

/// What is wrong with a scan line.
enum Fault {
    Ends,
    Wrong(&'static str),
}

/// Takes a scan line off the front of `rest`: run-length encoded by component, or texel by texel with the older runs.
fn scan_line(rest: &mut &[u8], line: &mut [[u8; 4]]) -> Result<(), Fault> {
    match *rest.first_chunk().ok_or(Fault::Ends)? {
        [2, 2, high, low] if high < 128 && ENCODED_LENGTHS.contains(&line.len()) => {
            if usize::from(high) << 8 | usize::from(low) != line.len() {
                return Err(Fault::Wrong("has another length than the image"));
            }
            *rest = &rest[4..];
            (0..4).try_for_each(|component| component_runs(rest, line, component))
        }
        _ => texel_runs(rest, line),
    }
}

fn component_runs(rest: &mut &[u8], line: &mut [[u8; 4]], component: usize) -> Result<(), Fault> {
    let mut done = 0;
    while done < line.len() {
        let (&code, after) = rest.split_first().ok_or(Fault::Ends)?;
        // Above 128: one value so many times; else so many values.
        let (count, taken) = if code > 128 { (usize::from(code - 128), 1) } else { (usize::from(code), usize::from(code)) };
        if count == 0 || count > line.len() - done {
            return Err(Fault::Wrong("has a run that does not fit"));
        }
        let (values, after) = after.split_at_checked(taken).ok_or(Fault::Ends)?;
        for (index, texel) in line[done..done + count].iter_mut().enumerate() {
            texel[component] = values[index.min(taken - 1)];
        }
        (*rest, done) = (after, done + count);
    }
    Ok(())
}

fn texel_runs(rest: &mut &[u8], line: &mut [[u8; 4]]) -> Result<(), Fault> {
    let (mut done, mut shift) = (0, 0);
    while done < line.len() {
        let (&texel, after) = rest.split_first_chunk().ok_or(Fault::Ends)?;
        *rest = after;
        if let [1, 1, 1, count] = texel {
            // Runs in a row are the digits of one count, the lowest first.
            let count = usize::from(count).checked_shl(shift).unwrap_or(usize::MAX);
            if done == 0 || shift >= 32 || count > line.len() - done {
                return Err(Fault::Wrong("has a run that does not fit"));
            }
            let repeated = line[done - 1];
            line[done..done + count].fill(repeated);
            (done, shift) = (done + count, shift + 8);
        } else {
            line[done] = texel;
            (done, shift) = (done + 1, 0);
        }
    }
    Ok(())
}
