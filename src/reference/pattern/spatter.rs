//! Drops: those of the 25 lattice cells around a place, though nine reach it.

use super::{
    Plane,
    marks::{Marks, lattice_bits, unit},
};
use crate::model::{Pattern, pattern::hash};

/// Two uniform numbers in [0, 1) from 32 random bits.
fn halves(bits: u32) -> [f64; 2] {
    [bits & 0xffff, bits >> 16].map(|half| f64::from(half) / 65536.0)
}

pub(super) fn spatter(plane: &Plane, marks: Marks, place: [f64; 2], cover: f64) -> f64 {
    let edges = plane.edges();
    let lattice = plane.placement.lattice(Pattern::SPATTER_LATTICE, plane.size);
    let covered = 1.0 - (1.0 - cover).powf(0.2);
    let mut bare = 1.0;
    for level in 0..5 {
        let period = lattice.map(|points| points << level);
        let spacing = [0, 1].map(|axis| edges[axis] / f64::from(period[axis]) / plane.placement.size);
        let at = [0, 1].map(|axis| (place[axis] / edges[axis] + 0.5) * f64::from(period[axis]));
        let [narrow, wide] = [spacing[0].min(spacing[1]), spacing[0].max(spacing[1])];
        let seen = (2.0 - 4.0 * marks.texel / narrow).clamp(0.0, 1.0);
        let chance = -(-covered).ln_1p() / (0.4795 * narrow / wide);
        let mut product = 1.0;
        for neighbour in 0..25 {
            let cell = [neighbour % 5 - 2, neighbour / 5 - 2].map(f64::from);
            let point = [0, 1].map(|axis| at[axis].floor() + cell[axis]);
            let bits = lattice_bits(point, period, marks.seed.wrapping_add(level));
            if unit(bits) < chance {
                let within = halves(hash(bits.wrapping_add(1)));
                let apart = [0, 1].map(|axis| (at[axis] - point[axis] - within[axis]) * spacing[axis]);
                product *= 1.0 - drop(marks, plane.placement.rotation, apart, narrow, hash(bits.wrapping_add(2)));
            }
        }
        bare *= seen * product + (1.0 - seen) * (1.0 - covered * 0.67);
    }
    1.0 - bare
}

fn drop(marks: Marks, rotation: f64, apart: [f64; 2], spacing: f64, bits: u32) -> f64 {
    let [size, slant] = halves(bits);
    let radius = (0.27 + 0.23 * size) * spacing;
    let stretch = 1.0 + 0.15 * (size * 256.0).fract();
    // Along and across the drop, by angles.
    let angle = apart[1].atan2(apart[0]) - rotation - (slant - 0.5).atan();
    let distance = apart[0].hypot(apart[1]) * (angle.cos() / stretch).hypot(angle.sin() * stretch);
    let least = radius.max(0.6 * marks.texel);
    let dome = 1.0 - 0.45 * (distance / least).powi(2).min(1.0);
    (radius / least).powi(2) * dome * marks.edge(0.0, 0.18 * least, least - distance)
}
