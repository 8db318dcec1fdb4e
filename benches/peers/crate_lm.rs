//! The fit by the crate `levenberg-marquardt` (MINPACK's algorithm in Rust, f64, nalgebra): (C_x, C_y, C_z, n) with a stored Jacobian.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{Dyn, Matrix, OVector, Owned, U4, VecStorage, Vector4};
use rayon::prelude::*;

struct Lobe<'a> {
    products: &'a [[f64; 3]],
    residual: &'a [f64],
    exponents: [f64; 2],
    lobe: Vector4<f64>,
}

impl Lobe<'_> {
    fn base(&self, product: &[f64; 3]) -> f64 {
        self.lobe[0] * product[0] + self.lobe[1] * product[1] + self.lobe[2] * product[2]
    }

    fn exponent(&self) -> f64 {
        self.lobe[3].clamp(self.exponents[0], self.exponents[1])
    }
}

impl LeastSquaresProblem<f64, Dyn, U4> for Lobe<'_> {
    type ResidualStorage = VecStorage<f64, Dyn, nalgebra::U1>;
    type JacobianStorage = Owned<f64, Dyn, U4>;
    type ParameterStorage = Owned<f64, U4>;

    fn set_params(&mut self, lobe: &Vector4<f64>) {
        self.lobe = *lobe;
    }

    fn params(&self) -> Vector4<f64> {
        self.lobe
    }

    fn residuals(&self) -> Option<OVector<f64, Dyn>> {
        let exponent = self.exponent();
        Some(OVector::<f64, Dyn>::from_iterator(
            self.products.len(),
            self.products.iter().zip(self.residual).map(|(product, s)| {
                let base = self.base(product);
                if base > 0.0 { base.powf(exponent) - s } else { -s }
            }),
        ))
    }

    fn jacobian(&self) -> Option<Matrix<f64, Dyn, U4, Self::JacobianStorage>> {
        let exponent = self.exponent();
        let inside = exponent == self.lobe[3];
        let mut jacobian = Matrix::<f64, Dyn, U4, Self::JacobianStorage>::zeros(self.products.len());
        for (row, product) in self.products.iter().enumerate() {
            let base = self.base(product);
            if base > 0.0 {
                let value = base.powf(exponent);
                let slope = exponent * value / base;
                for axis in 0..3 {
                    jacobian[(row, axis)] = slope * product[axis];
                }
                jacobian[(row, 3)] = if inside { value * base.ln() } else { 0.0 };
            }
        }
        Some(jacobian)
    }
}

fn one(products: &[[f64; 3]], residual: &[f64], exponents: [f64; 2]) -> [f64; 4] {
    let problem = Lobe { products, residual, exponents, lobe: Vector4::new(-1.0, -1.0, 1.0, 1.0) };
    let lobe = LevenbergMarquardt::new().minimize(problem).0.lobe;
    [lobe[0], lobe[1], lobe[2], lobe[3].clamp(exponents[0], exponents[1])]
}

/// (C_x, C_y, C_z, n) of each texel, of residuals `[texel][sample]`, on one thread.
pub fn fit(products: &[[f64; 3]], residuals: &[f64], exponents: [f64; 2]) -> Vec<[f64; 4]> {
    residuals.chunks(products.len()).map(|residual| one(products, residual, exponents)).collect()
}

/// The same on all cores.
pub fn fit_on_all_cores(products: &[[f64; 3]], residuals: &[f64], exponents: [f64; 2]) -> Vec<[f64; 4]> {
    residuals.par_chunks(products.len()).map(|residual| one(products, residual, exponents)).collect()
}
