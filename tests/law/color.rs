use overpaint::model::color::{linear_from_srgb, linear_from_xyz, srgb_from_linear};

use crate::support::hold;

crate::suite! { plain: each_curve_undoes_the_other, the_curve_has_its_tabled_values, xyz_of_white_and_primaries; }

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

fn xyz_of_white_and_primaries() {
    // D65 and the primaries of BT.709 as IEC 61966-2-1 has them, to four decimals: 1.1e-4 at most times the matrix' largest row sum.
    let colors = [
        ([0.9505, 1.0, 1.089], [1.0, 1.0, 1.0]),
        ([0.4124, 0.2126, 0.0193], [1.0, 0.0, 0.0]),
        ([0.3576, 0.7152, 0.1192], [0.0, 1.0, 0.0]),
        ([0.1805, 0.0722, 0.9505], [0.0, 0.0, 1.0]),
    ];
    for (xyz, rgb) in colors {
        let worst = linear_from_xyz(xyz).into_iter().zip(rgb).map(|(found, expected): (f64, f64)| (found - expected).abs());
        hold("XYZ to sRGB", worst.fold(0.0, f64::max), 5e-5 * (3.241 + 1.537 + 0.499));
    }
}
