//! The two ways of a Fourier transform.

/// Forward: X_k = Σ_j x_j·exp(−2πi·jk/n) along each axis. Inverse: the opposite sign, and 1/n.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fourier {
    /// Values to spectrum, no factor.
    Forward,
    /// Spectrum to values, divided by the number of values.
    Inverse,
}
