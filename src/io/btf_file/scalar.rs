//! Scalars of 2, 4 or 8 bytes, and tables of them.

use half::f16;

use super::{
    BtfFileError,
    bytes::{Container, Header},
};

/// Bytes that are read and decoded at once.
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

    /// Calls `each(index, value)` for the stored values; doubles are rounded.
    fn decode(self, bytes: &[u8], mut each: impl FnMut(usize, f32)) {
        match self {
            Self::Half => {
                bytes.as_chunks().0.iter().enumerate().for_each(|(index, &value)| each(index, f16::from_le_bytes(value).to_f32()));
            }
            Self::Single => bytes.as_chunks().0.iter().enumerate().for_each(|(index, &value)| each(index, f32::from_le_bytes(value))),
            #[expect(clippy::cast_possible_truncation, reason = "24 bits are more than a half keeps")]
            Self::Double => {
                bytes.as_chunks().0.iter().enumerate().for_each(|(index, &value)| each(index, f64::from_le_bytes(value) as f32))
            }
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

    /// Calls `each(index, value)` for the values of rows `first..first + rows`, in order; indices start at 0.
    pub(super) fn read(
        &self, container: &Container, first: usize, rows: usize, mut each: impl FnMut(usize, f32),
    ) -> Result<(), BtfFileError> {
        let size = self.scalar.bytes();
        let mut bytes = vec![0; (rows * self.row_bytes()).min(PIECE)];
        for start in (0..rows * self.row_bytes()).step_by(PIECE) {
            let piece = &mut bytes[..(rows * self.row_bytes() - start).min(PIECE)];
            container.read(piece, self.offset + first as u64 * self.row_bytes() as u64 + start as u64)?;
            self.scalar.decode(piece, |index, value| each(start / size + index, value));
        }
        Ok(())
    }

    /// All values, each row followed by one of `last`, or by nothing where that is empty.
    pub(super) fn load(&self, container: &Container, last: impl Fn(usize) -> Option<f32>) -> Result<Vec<f32>, BtfFileError> {
        let mut values = Vec::with_capacity(self.rows * (self.columns + usize::from(last(0).is_some())));
        self.read(container, 0, self.rows, |index, value| {
            values.push(value);
            if (index + 1).is_multiple_of(self.columns) {
                values.extend(last(index / self.columns));
            }
        })?;
        Ok(values)
    }
}
