//! Scalars of 2, 4 or 8 bytes, and tables of them.

use half::{f16, slice::HalfFloatSliceExt};

use super::{
    BtfFileError,
    bytes::{Container, Header},
};

/// Bytes that are read and decoded at once, if a row has not more.
const PIECE: usize = 1 << 20;

/// How a scalar is stored, little-endian.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scalar {
    Half,
    Single,
    Double,
}

impl Scalar {
    pub(super) fn of_bytes(bytes: u8) -> Option<Self> {
        match bytes {
            2 => Some(Self::Half),
            4 => Some(Self::Single),
            8 => Some(Self::Double),
            _ => None,
        }
    }

    pub(super) fn bytes(self) -> usize {
        match self {
            Self::Half => 2,
            Self::Single => 4,
            Self::Double => 8,
        }
    }

    /// Appends the stored values to `values`; doubles are rounded.
    fn decode(self, bytes: &[u8], values: &mut Vec<f32>) {
        match self {
            Self::Half => {
                let halves: Vec<f16> = bytes.as_chunks().0.iter().map(|&value| f16::from_le_bytes(value)).collect();
                values.extend(halves.to_f32_vec());
            }
            Self::Single => values.extend(bytes.as_chunks().0.iter().map(|&value| f32::from_le_bytes(value))),
            #[expect(clippy::cast_possible_truncation, reason = "24 bits are more than a half keeps")]
            Self::Double => values.extend(bytes.as_chunks().0.iter().map(|&value| f64::from_le_bytes(value) as f32)),
        }
    }
}

/// A matrix in the file, `[row][column]`, known to be within it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Table {
    offset: u64,
    rows: usize,
    columns: usize,
    scalar: Scalar,
}

impl Table {
    /// Passes the matrix that comes next.
    pub(super) fn pass(
        header: &mut Header<'_>, what: &'static str, [rows, columns]: [u32; 2], scalar: Scalar,
    ) -> Result<Self, BtfFileError> {
        let (rows, columns) = (u64::from(rows), u64::from(columns));
        let offset = header.pass(what, &[rows, columns, scalar.bytes() as u64])?;
        let count = |count| header.count(offset, what, &[count]);
        Ok(Self { offset, rows: count(rows)?, columns: count(columns)?, scalar })
    }

    /// Columns of the matrix.
    pub(super) fn columns(&self) -> usize {
        self.columns
    }

    /// Bytes of a row.
    pub(super) fn row_bytes(&self) -> usize {
        self.columns * self.scalar.bytes()
    }

    /// Calls `each(row, values)` for rows `first..first + rows`, in order; rows are counted from 0.
    pub(super) fn read(
        &self, container: &Container, first: usize, rows: usize, mut each: impl FnMut(usize, &[f32]),
    ) -> Result<(), BtfFileError> {
        let at_once = (PIECE / self.row_bytes()).clamp(1, rows.max(1));
        let (mut bytes, mut values) = (vec![0; at_once * self.row_bytes()], Vec::new());
        for start in (0..rows).step_by(at_once) {
            let piece = &mut bytes[..at_once.min(rows - start) * self.row_bytes()];
            container.read(piece, self.offset + (first + start) as u64 * self.row_bytes() as u64)?;
            values.clear();
            self.scalar.decode(piece, &mut values);
            values.chunks_exact(self.columns).enumerate().for_each(|(row, values)| each(start + row, values));
        }
        Ok(())
    }

    /// All values, each row followed by what `last` gives for it.
    pub(super) fn load(&self, container: &Container, last: impl Fn(usize) -> Option<f32>) -> Result<Vec<f32>, BtfFileError> {
        let mut values = Vec::with_capacity(self.rows * (self.columns + usize::from(last(0).is_some())));
        self.read(container, 0, self.rows, |row, stored| {
            values.extend_from_slice(stored);
            values.extend(last(row));
        })?;
        Ok(values)
    }
}
