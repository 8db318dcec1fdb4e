//! Lights that stand for an environment (Debevec 2005, A median cut algorithm for light probe sampling).

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;

use super::{Environment, Light};

/// A rectangle of an environment's texels.
#[derive(Debug, Clone, Copy)]
struct Region {
    corner: [usize; 2],
    size: [usize; 2],
    energy: f64,
}

impl Environment {
    /// At most `count` lights that stand for all directions: the map is cut, each time the part with the most light, across its longer side
    /// into two of as much light; a light is what comes from a part, from the middle of that. Together they give a surface that sees all of
    /// them what the environment does, but for their directions.
    #[must_use]
    pub fn lights(&self, count: usize) -> Vec<Light> {
        let whole = [self.map().width(), self.map().height()];
        let mut regions = vec![self.region([0, 0], whole)];
        while regions.len() < count {
            let most = |a: &&Region, b: &&Region| a.energy.total_cmp(&b.energy);
            let divisible = regions.iter().filter(|region| region.size != [1, 1] && region.energy > 0.0).max_by(most).copied();
            let Some(region) = divisible else { break };
            regions.retain(|other| other.corner != region.corner);
            regions.extend(self.halves(region));
        }
        regions.into_iter().filter(|region| region.energy > 0.0).map(|region| self.light(region)).collect()
    }

    /// Mean of red, green and blue, and the solid angle, of a texel.
    fn energy(&self, column: usize, row: usize) -> f64 {
        self.map()[(column, row)].iter().map(|&value| f64::from(value)).sum::<f64>() / 3.0 * self.solid_angle(row)
    }

    /// Of a texel of a row.
    fn solid_angle(&self, row: usize) -> f64 {
        let [width, height] = [self.map().width(), self.map().height()].map(|texels| texels as f64);
        let elevation = |row: usize| FRAC_PI_2 - PI * row as f64 / height;
        TAU / width * (elevation(row).sin() - elevation(row + 1).sin())
    }

    fn region(&self, corner: [usize; 2], size: [usize; 2]) -> Region {
        let columns = || corner[0]..corner[0] + size[0];
        let energy = (corner[1]..corner[1] + size[1]).flat_map(|row| columns().map(move |column| self.energy(column, row))).sum();
        Region { corner, size, energy }
    }

    /// Two parts of a region of which each has half of the light, as far as whole columns or rows go.
    fn halves(&self, region: Region) -> [Region; 2] {
        let Region { corner, size, energy } = region;
        // Rows are as high everywhere, columns narrower towards the poles.
        let middle = FRAC_PI_2 - PI * (corner[1] as f64 + 0.5 * size[1] as f64) / self.map().height() as f64;
        let [across, down] =
            [size[0] as f64 * TAU / self.map().width() as f64 * middle.cos(), size[1] as f64 * PI / self.map().height() as f64];
        let axis = usize::from(size[0] == 1 || (down > across && size[1] > 1));
        let mut sum = 0.0;
        let mut cut = 1;
        for line in 0..size[axis] - 1 {
            let of = |other: usize| match axis {
                0 => self.energy(corner[0] + line, corner[1] + other),
                _ => self.energy(corner[0] + other, corner[1] + line),
            };
            let added = (0..size[1 - axis]).map(of).sum::<f64>();
            // The line in the middle goes to the side that it leaves more even.
            if line > 0 && sum + 0.5 * added > 0.5 * energy {
                break;
            }
            sum += added;
            cut = line + 1;
        }
        let (mut first, mut second, mut at) = (size, size, corner);
        first[axis] = cut;
        second[axis] -= cut;
        at[axis] += cut;
        [self.region(corner, first), self.region(at, second)]
    }

    fn light(&self, region: Region) -> Light {
        let Region { corner, size, .. } = region;
        let (mut toward, mut irradiance) = (DVec3::ZERO, [0.0; 3]);
        for (row, column) in
            (corner[1]..corner[1] + size[1]).flat_map(|row| (corner[0]..corner[0] + size[0]).map(move |column| (row, column)))
        {
            toward += self.energy(column, row) * self.direction([column, row]);
            for (sum, value) in irradiance.iter_mut().zip(self.map()[(column, row)]) {
                // White that faces it reads the radiance times the solid angle over pi.
                *sum += f64::from(value) * self.solid_angle(row) / PI;
            }
        }
        Light::Directional { toward: toward.normalize_or(DVec3::Y), irradiance }
    }
}
