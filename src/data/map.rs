//! Values over a texel plane.

use std::ops::{Index, IndexMut};

/// A number of values that does not fit the plane they are for.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{found} values cannot cover {width} x {height} texels: {expected} are needed")]
pub struct ShapeError {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Values needed.
    pub expected: usize,
    /// Values given.
    pub found: usize,
}

/// One value a texel, `[row][column]`, row 0 at the top.
#[derive(Debug, Clone, PartialEq)]
pub struct Map<T> {
    width: usize,
    height: usize,
    values: Vec<T>,
}

impl<T> Map<T> {
    /// A map of `values` in row order.
    ///
    /// # Errors
    /// [`ShapeError`] if there are not width x height of them.
    pub fn new(width: usize, height: usize, values: Vec<T>) -> Result<Self, ShapeError> {
        let expected = width * height;
        if values.len() == expected {
            Ok(Self { width, height, values })
        } else {
            Err(ShapeError { width, height, expected, found: values.len() })
        }
    }

    /// A map with the value that `value(column, row)` gives for each texel.
    pub fn from_fn(width: usize, height: usize, mut value: impl FnMut(usize, usize) -> T) -> Self {
        let values = (0..width * height).map(|texel| value(texel % width, texel / width)).collect();
        Self { width, height, values }
    }

    /// The map of the same shape with `f` of each value.
    pub fn map<U>(&self, f: impl FnMut(&T) -> U) -> Map<U> {
        Map { width: self.width, height: self.height, values: self.values.iter().map(f).collect() }
    }

    /// The map laid side by side with itself, `columns` times to the right and `rows` times downwards.
    #[must_use]
    pub fn repeated(&self, columns: usize, rows: usize) -> Self
    where
        T: Clone,
    {
        Self::from_fn(self.width * columns, self.height * rows, |column, row| self[(column % self.width, row % self.height)].clone())
    }

    /// Columns.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// All values in row order.
    #[must_use]
    pub fn values(&self) -> &[T] {
        &self.values
    }
}

/// The value at (column, row).
impl<T> Index<(usize, usize)> for Map<T> {
    type Output = T;
    fn index(&self, (column, row): (usize, usize)) -> &T {
        &self.values[row * self.width + column]
    }
}

impl<T> IndexMut<(usize, usize)> for Map<T> {
    fn index_mut(&mut self, (column, row): (usize, usize)) -> &mut T {
        &mut self.values[row * self.width + column]
    }
}
