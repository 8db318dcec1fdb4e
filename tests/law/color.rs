use overpaint::model::color::{linear_from_srgb, srgb_from_linear};

use crate::support::hold;

crate::suite! { plain: each_curve_undoes_the_other, the_curve_has_its_tabled_values; }

fn each_curve_undoes_the_other() {
    for step in 0..=100_000 {
        let value = f64::from(step) / 100_000.0;
        // The standard rounds its constants: at the joint the two pieces differ by 3e-8, so inverses do by as much.
        hold("sRGB: inverse", (linear_from_srgb(srgb_from_linear(value)) - value).abs(), 5e-8);
        hold("sRGB: inverse", (srgb_from_linear(linear_from_srgb(value)) - value).abs(), 5e-8);
    }
}

fn the_curve_has_its_tabled_values() {
    for (linear, srgb) in [(0.0, 0.0), (0.001, 0.01292), (0.18, 0.461_356_129_5), (0.5, 0.735_356_983_1), (1.0, 1.0)] {
        hold("sRGB: values", (srgb_from_linear(linear) - srgb).abs(), 1e-10);
    }
}
