//! A sheet draped over a ball by position-based dynamics (Müller, Heidelberger, Hennix and Ratcliff 2007).
//!
//! Particles fall, and are moved back and forth between the lengths of threads, diagonals and bends and the surface of the ball. A coarse
//! sheet falls first, one of half its spacing settles after it. The number of steps is fixed, and only sums, products, quotients and roots
//! are taken, so that every machine makes the same cloth. What is drawn is the uniform cubic B-spline of the particles.

use glam::{DVec2, DVec3};

use super::{Vertex, grid_triangles};

/// Radius of the ball around the origin.
const BALL: f64 = 0.65;

/// Cells a side of the coarse sheet.
const COARSE: usize = 24;

/// Steps of the coarse and of the fine sheet, and rounds of corrections in each.
const STEPS: [usize; 2] = [200, 50];
const ROUNDS: usize = 8;

/// How far gravity moves a particle from rest in a step.
const FALL: f64 = 4e-4;

/// What is left of a velocity after a step.
const DAMPING: f64 = 0.97;

/// Shares of an error that are corrected at once: woven cloth shears and bends easily, but its threads hold.
const SHEAR: f64 = 0.3;
const BEND: f64 = 0.3;

/// The share of its way along the ball that friction takes from a particle.
const FRICTION: f64 = 0.3;

/// Cells a side of the mesh, two for each of the fine sheet.
const CELLS: usize = 96;

/// Two particles and the distance they should have; the share of an error that is corrected.
struct Link {
    ends: [usize; 2],
    length: f64,
    share: f64,
}

struct Sheet {
    /// Particles a side.
    side: usize,
    /// `[row][column]`
    particles: Vec<DVec3>,
    /// Where they were a step before.
    before: Vec<DVec3>,
}

impl Sheet {
    fn new(side: usize, particle: impl Fn(usize, usize) -> DVec3) -> Self {
        let particles: Vec<_> = (0..side * side).map(|index| particle(index % side, index / side)).collect();
        Self { side, before: particles.clone(), particles }
    }

    /// The flat sheet on top of the ball: columns to +x, rows to -z.
    #[expect(clippy::cast_precision_loss, reason = "a few cells")]
    fn flat() -> Self {
        let at = |index: usize| 2.0 * index as f64 / COARSE as f64 - 1.0;
        Self::new(COARSE + 1, |column, row| DVec3::new(at(column), BALL, -at(row)))
    }

    /// The same sheet with half the spacing, at rest.
    fn finer(&self) -> Self {
        Self::new(2 * self.side - 1, |column, row| {
            let mean = |row: usize| 0.5 * (self.at(column / 2, row) + self.at(column.div_ceil(2), row));
            0.5 * (mean(row / 2) + mean(row.div_ceil(2)))
        })
    }

    fn at(&self, column: usize, row: usize) -> DVec3 {
        self.particles[row * self.side + column]
    }

    #[expect(clippy::cast_precision_loss, reason = "a few cells")]
    fn links(&self) -> Vec<Link> {
        let (side, cell) = (self.side, 2.0 / (self.side - 1) as f64);
        let mut links = Vec::new();
        for row in 0..side {
            for column in 0..side {
                let mut link = |columns: usize, rows: usize, share: f64| {
                    if column + columns < side && row + rows < side {
                        let (near, far) = (row * side + column, (row + rows) * side + column + columns);
                        // A diagonal cell has two links, crosswise.
                        let crossed = [[near + columns, far - columns], [near, far]];
                        let length = cell * ((columns * columns + rows * rows) as f64).sqrt();
                        links.extend(crossed.into_iter().skip(usize::from(columns * rows == 0)).map(|ends| Link { ends, length, share }));
                    }
                };
                link(1, 0, 1.0);
                link(0, 1, 1.0);
                link(1, 1, SHEAR);
                link(2, 0, BEND);
                link(0, 2, BEND);
            }
        }
        links
    }

    fn relax(&mut self, steps: usize) {
        let links = self.links();
        for _ in 0..steps {
            for (particle, before) in self.particles.iter_mut().zip(&mut self.before) {
                let velocity = *particle - *before;
                *before = *particle;
                *particle += DAMPING * velocity - DVec3::Y * FALL;
            }
            for round in 0..ROUNDS {
                // To and fro, so that no side of the sheet comes first.
                if round % 2 == 0 {
                    links.iter().for_each(|link| self.correct(link));
                } else {
                    links.iter().rev().for_each(|link| self.correct(link));
                }
                for (particle, before) in self.particles.iter_mut().zip(&self.before) {
                    if particle.length_squared() < BALL * BALL {
                        let touching = *particle * (BALL / particle.length());
                        let held = touching + FRICTION * (*before - touching);
                        *particle = held * (BALL / held.length());
                    }
                }
            }
        }
    }

    fn correct(&mut self, link: &Link) {
        let [a, b] = link.ends;
        let between = self.particles[b] - self.particles[a];
        let length = between.length();
        let half = between * (0.5 * link.share * (length - link.length) / length);
        self.particles[a] += half;
        self.particles[b] -= half;
    }

    /// The B-spline's position and derivatives by column and row, at a place in cells.
    fn spline(&self, place: DVec2) -> [DVec3; 3] {
        let last = self.side - 1;
        // Beyond its rim the sheet goes on straight.
        let line = |row: usize, column: isize| match usize::try_from(column) {
            Err(_) => 2.0 * self.at(0, row) - self.at(1, row),
            Ok(column) if column > last => 2.0 * self.at(last, row) - self.at(last - 1, row),
            Ok(column) => self.at(column, row),
        };
        let control = |column: isize, row: isize| match usize::try_from(row) {
            Err(_) => 2.0 * line(0, column) - line(1, column),
            Ok(row) if row > last => 2.0 * line(last, column) - line(last - 1, column),
            Ok(row) => line(row, column),
        };
        let [(column, x), (row, y)] = [place.x, place.y].map(|place| cell(place, last));
        let ([along, along_slope], [up, up_slope]) = (weights(x), weights(y));
        let sum = |along: [f64; 4], up: [f64; 4]| -> DVec3 {
            (0..16).map(|k| control(column + k % 4 - 1, row + k / 4 - 1) * along[k as usize % 4] * up[k as usize / 4]).sum()
        };
        [sum(along, up), sum(along_slope, up), sum(along, up_slope)]
    }
}

/// The cell of a place from 0 to `last`, and where in it.
#[expect(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "a few cells")]
fn cell(place: f64, last: usize) -> (isize, f64) {
    let cell = place.floor().min(last as f64 - 1.0);
    (cell as isize, place - cell)
}

/// Weights of the four control points of a uniform cubic B-spline, and their derivatives.
fn weights(x: f64) -> [[f64; 4]; 2] {
    let y = 1.0 - x;
    [
        [y * y * y / 6.0, (3.0 * x * x * (x - 2.0) + 4.0) / 6.0, (3.0 * y * y * (y - 2.0) + 4.0) / 6.0, x * x * x / 6.0],
        [-0.5 * y * y, 0.5 * x * (3.0 * x - 4.0), -0.5 * y * (3.0 * y - 4.0), 0.5 * x * x],
    ]
}

#[expect(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "a few cells")]
pub(super) fn cloth() -> (Vec<Vertex>, Vec<[u32; 3]>) {
    let mut sheet = Sheet::flat();
    sheet.relax(STEPS[0]);
    let mut sheet = sheet.finer();
    sheet.relax(STEPS[1]);
    let vertex = |index: usize| {
        let texture = DVec2::new((index % (CELLS + 1)) as f64, (index / (CELLS + 1)) as f64) / CELLS as f64;
        let [position, along, up] = sheet.spline(texture * (sheet.side - 1) as f64);
        let (tangent, normal) = (along.normalize(), along.cross(up).normalize());
        Vertex { position, normal, tangent, texture }
    };
    let side = CELLS as u32 + 1;
    ((0..(CELLS + 1) * (CELLS + 1)).map(vertex).collect(), grid_triangles(side, side))
}
