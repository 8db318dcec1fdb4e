//! Shapes of surfaces.

use std::f64::consts::{PI, TAU};

use super::{
    SynthPlace,
    noise::{fractal, noise, random, smooth},
};

/// Threads along the shorter edge of woven cloth.
const THREADS: f64 = 16.0;

/// A surface that repeats.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HeightField {
    /// No relief.
    Flat,
    /// A few long waves.
    Waves,
    /// Hemispheres of several sizes on a plane.
    Bumps,
    /// Square blocks of several heights with gaps between them: vertical walls.
    Blocks,
    /// Round threads, over and under each other by turns.
    Weave,
    /// Bricks in running bond with rounded edges and mortar between them.
    Bricks,
    /// Fractal noise, as of plaster or stone.
    Noise,
}

impl HeightField {
    /// All, in the order in which they are offered.
    pub const ALL: [Self; 7] = [Self::Flat, Self::Waves, Self::Bumps, Self::Blocks, Self::Weave, Self::Bricks, Self::Noise];

    /// Its name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Flat => "flat",
            Self::Waves => "waves",
            Self::Bumps => "bumps",
            Self::Blocks => "blocks",
            Self::Weave => "weave",
            Self::Bricks => "bricks",
            Self::Noise => "noise",
        }
    }

    /// Height at a place, 0 to 1.
    #[must_use]
    pub fn height(self, place: SynthPlace, seed: u32) -> f64 {
        match self {
            Self::Flat => 0.0,
            Self::Waves => waves(place, seed),
            Self::Bumps => bumps(place, seed),
            Self::Blocks => blocks(place, seed),
            Self::Weave => weave(place).0,
            Self::Bricks => bricks(place, seed),
            Self::Noise => fractal(place, 4.0, seed, 0),
        }
    }
}

impl std::fmt::Display for HeightField {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(self.name())
    }
}

fn waves(place: SynthPlace, seed: u32) -> f64 {
    // Whole numbers of waves along each edge of the shorter edge's length.
    const WAVES: [([f64; 2], f64); 4] = [([1.0, 0.0], 0.3), ([1.0, 2.0], 0.3), ([-2.0, 3.0], 0.25), ([4.0, 1.0], 0.15)];
    let sum: f64 = WAVES
        .iter()
        .zip(0..)
        .map(|((waves, amplitude), layer)| {
            let turns: f64 = (0..2).map(|axis| waves[axis] * place.edges[axis].round() * place.at[axis]).sum();
            amplitude * (TAU * (turns + random([0.0; 2], [1.0; 2], seed, layer))).cos()
        })
        .sum();
    0.5 + 0.5 * sum
}

fn bumps(place: SynthPlace, seed: u32) -> f64 {
    let (at, count) = place.cells(8.0, 1.0);
    let cell = at.map(f64::floor);
    let between = |low: f64, high: f64, layer: u32| low + (high - low) * random(cell, count, seed, layer);
    let radius = between(0.25, 0.48, 0);
    // Anywhere in its cell.
    let room = 0.5 - radius;
    let centre = [between(-room, room, 1), between(-room, room, 2)];
    let distance2: f64 = (0..2).map(|axis| (at[axis] - cell[axis] - 0.5 - centre[axis]).powi(2)).sum();
    (radius * radius - distance2).max(0.0).sqrt() / 0.5
}

fn blocks(place: SynthPlace, seed: u32) -> f64 {
    const GAP: f64 = 0.1;
    let (at, count) = place.cells(8.0, 1.0);
    let cell = at.map(f64::floor);
    let inside = (0..2).all(|axis| (GAP..1.0 - GAP).contains(&(at[axis] - cell[axis])));
    if inside { 0.25 + 0.75 * random(cell, count, seed, 0) } else { 0.0 }
}

/// Height of plain-woven cloth, and whether the thread on top runs along y.
pub(super) fn weave(place: SynthPlace) -> (f64, bool) {
    const RADIUS: f64 = 0.46;
    let (at, _) = place.cells(THREADS, 2.0);
    // A thread runs along one axis in the middle of its cell of the other, up in every second cell.
    let thread = |across: f64, along: f64, phase: f64| {
        let cell = across.floor();
        let section = 1.0 - ((across - cell - 0.5) / RADIUS).powi(2);
        let lift = 0.5 + 0.5 * (PI * (along - 0.5 + cell + phase)).cos();
        if section > 0.0 { 0.5 * lift + 0.5 * section.sqrt() } else { 0.0 }
    };
    let (along_y, along_x) = (thread(at[0], at[1], 0.0), thread(at[1], at[0], 1.0));
    (along_y.max(along_x), along_y >= along_x)
}

fn bricks(place: SynthPlace, seed: u32) -> f64 {
    // A brick is twice as wide as high; courses come in pairs, the second half a brick further.
    const MORTAR: f64 = 0.05;
    const ROUND: f64 = 0.14;
    let (at, count) = place.cells(8.0, 2.0);
    let course = at[1].floor();
    let along = 0.5 * at[0] + 0.5 * course.rem_euclid(2.0);
    let brick = [along.floor(), course];
    let edge = |part: f64, length: f64| (part.min(1.0 - part)) * length;
    let depth = edge(along - brick[0], 2.0).min(edge(at[1] - course, 1.0));
    let face = 0.72 + 0.14 * random(brick, [0.5 * count[0], count[1]], seed, 0) + 0.14 * fractal(place, 16.0, seed, 1);
    let mortar = 0.12 * noise(place, 64.0, seed, 2);
    mortar + (face - mortar) * smooth((depth - MORTAR) / ROUND)
}
