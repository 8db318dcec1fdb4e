//! Rectangles of texels.

use std::ops::Range;

/// A rectangle of a texel plane. Its texels are numbered row by row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub struct Block {
    /// Leftmost column.
    pub column: usize,
    /// Topmost row.
    pub row: usize,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

impl Block {
    /// All of a plane of `width` x `height` texels.
    #[must_use]
    pub fn whole([width, height]: [usize; 2]) -> Self {
        Self { column: 0, row: 0, width, height }
    }

    /// Number of texels.
    #[must_use]
    pub fn texels(&self) -> usize {
        self.width * self.height
    }

    /// Columns.
    #[must_use]
    pub fn columns(&self) -> Range<usize> {
        self.column..self.column + self.width
    }

    /// Rows.
    #[must_use]
    pub fn rows(&self) -> Range<usize> {
        self.row..self.row + self.height
    }

    /// Whether it lies within a plane of `width` x `height` texels and has any texel.
    #[must_use]
    pub fn is_within(&self, [width, height]: [usize; 2]) -> bool {
        let ends = |first: usize, side: usize, limit: usize| side > 0 && first.checked_add(side).is_some_and(|end| end <= limit);
        ends(self.column, self.width, width) && ends(self.row, self.height, height)
    }

    /// What it has in common with `other`, if anything.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        let common = |a: Range<usize>, b: Range<usize>| (a.start.max(b.start), a.end.min(b.end));
        let ((left, right), (top, bottom)) = (common(self.columns(), other.columns()), common(self.rows(), other.rows()));
        (left < right && top < bottom).then(|| Self { column: left, row: top, width: right - left, height: bottom - top })
    }

    /// The smallest block that holds both.
    #[must_use]
    pub fn hull(&self, other: &Self) -> Self {
        let (column, row) = (self.column.min(other.column), self.row.min(other.row));
        let right = (self.column + self.width).max(other.column + other.width);
        let bottom = (self.row + self.height).max(other.row + other.height);
        Self { column, row, width: right - column, height: bottom - row }
    }

    /// The plane of `size` cut into blocks of at most `side` columns and rows, row by row; those at the right and at the bottom are as
    /// small as they must be.
    pub fn tiles([width, height]: [usize; 2], [columns, rows]: [usize; 2]) -> impl Iterator<Item = Self> {
        (0..height).step_by(rows).flat_map(move |row| {
            (0..width).step_by(columns).map(move |column| Self {
                column,
                row,
                width: columns.min(width - column),
                height: rows.min(height - row),
            })
        })
    }
}

impl std::fmt::Display for Block {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "{} x {} texels from column {}, row {}", self.width, self.height, self.column, self.row)
    }
}
