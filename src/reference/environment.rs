//! Twin of `environment_reduce`, `environment_prefilter`, `environment_albedo` and the look-ups of `common/environment`, in f64: light is
//! handed out from texels instead of gathered, lobes come from half vectors, the albedo is integrated over facets without regard to what is
//! seen of them.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3, dvec2, dvec3};

use crate::{
    data::{Environment, Map},
    model::microfacet::{ggx, ggx_specular, schlick},
};

/// An environment at another size, each texel the mean over its solid angle: each texel of the environment gives its light to those it
/// overlaps, whose light is then divided by their solid angles.
#[must_use]
pub fn environment_source(environment: &Environment, [width, height]: [usize; 2]) -> Map<[f64; 3]> {
    let map = environment.map();
    let mut light = Map::from_fn(width, height, |_, _| [0.0; 3]);
    let rows = overlaps(map.height(), height, |part| (FRAC_PI_2 - PI * part).sin());
    let columns = overlaps(map.width(), width, |part| -TAU * part);
    for &(row, target_row, sines) in &rows {
        for &(column, target_column, angle) in &columns {
            for (sum, &value) in light[(target_column, target_row)].iter_mut().zip(&map[(column, row)]) {
                *sum += sines * angle * f64::from(value);
            }
        }
    }
    Map::from_fn(width, height, |column, row| {
        let sine = |row: usize| (FRAC_PI_2 - PI * row as f64 / height as f64).sin();
        light[(column, row)].map(|sum| sum / (TAU / width as f64 * (sine(row) - sine(row + 1))))
    })
}

/// Which of `from` and `to` equal parts of 0..1 overlap, and by how much of `measure`, which falls from 0 to 1.
fn overlaps(from: usize, to: usize, measure: impl Fn(f64) -> f64) -> Vec<(usize, usize, f64)> {
    let mut found = Vec::new();
    for source in 0..from {
        for target in source * to / from..((source + 1) * to).div_ceil(from) {
            let low = (source as f64 / from as f64).max(target as f64 / to as f64);
            let high = ((source + 1) as f64 / from as f64).min((target + 1) as f64 / to as f64);
            found.push((source, target, measure(low) - measure(high)));
        }
    }
    found
}

/// The mean of an equirectangular map over the GGX lobe of roughness α about the unit vector `normal`, seen from there: light from each
/// texel by D(n·h) n·l and the texel's solid angle (Karis 2013).
#[must_use]
pub fn environment_prefiltered(source: &Map<[f64; 3]>, roughness: f64, normal: DVec3) -> [f64; 3] {
    let (width, height) = (source.width() as f64, source.height() as f64);
    let (mut sum, mut weights) = ([0.0; 3], 0.0);
    for row in 0..source.height() {
        let polar = PI * (row as f64 + 0.5) / height;
        let solid_angle = TAU / width * ((PI * row as f64 / height).cos() - (PI * (row + 1) as f64 / height).cos());
        for column in 0..source.width() {
            let azimuth = PI - TAU * (column as f64 + 0.5) / width;
            let light = dvec3(azimuth.sin() * polar.sin(), polar.cos(), azimuth.cos() * polar.sin());
            if normal.dot(light) > 0.0 {
                let half = (normal + light).normalize();
                let weight = ggx(roughness, normal.dot(half)) * normal.dot(light) * solid_angle;
                weights += weight;
                for (sum, value) in sum.iter_mut().zip(source[(column, row)]) {
                    *sum += weight * value;
                }
            }
        }
    }
    sum.map(|sum| sum / weights)
}

/// (scale, bias) of the directional albedo F₀·scale + bias under Schlick's Fresnel term, of a surface of roughness α whose normal and view
/// have `cosine`: the lobe integrated over its half vectors, dω_l = 4 (v·h) dω_h, in rings and spokes.
#[must_use]
pub fn directional_albedo(roughness: f64, cosine: f64, [rings, spokes]: [usize; 2]) -> [f64; 2] {
    let view = dvec3((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
    let (mut albedo, mut bias) = (0.0, 0.0);
    for ring in 0..rings {
        // Rings close where the facets are, tan θ = α u/(1 - u), and closer at both ends of u = t²(3 - 2t).
        let t = (ring as f64 + 0.5) / rings as f64;
        let u = t * t * (3.0 - 2.0 * t);
        let rest = (1.0 - t) * (1.0 - t) * (1.0 + 2.0 * t);
        let tangent = roughness * u / rest;
        let theta = tangent.atan();
        let d_theta = roughness / (rest * rest) / (1.0 + tangent * tangent) * 6.0 * t * (1.0 - t) / rings as f64;
        for spoke in 0..spokes {
            let phi = TAU * (spoke as f64 + 0.5) / spokes as f64;
            let half = dvec3(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
            let across = view.dot(half);
            if across > 0.0 {
                let light = 2.0 * across * half - view;
                let value = ggx_specular(DVec3::Z, view, light, roughness, 1.0) / PI;
                let weight = value * 4.0 * across * theta.sin() * d_theta * TAU / spokes as f64;
                albedo += weight;
                bias += weight * schlick(0.0, across);
            }
        }
    }
    [albedo - bias, bias]
}

/// Place on the unit square of a direction: where it meets the octahedron |x| + |y| + |z| = 1, seen along y, and what is below mirrored at
/// the edge of its face (Engelhardt, Dachsbacher 2008).
#[must_use]
pub fn octahedral_place(direction: DVec3) -> DVec2 {
    let side = |value: f64| if value < 0.0 { -1.0 } else { 1.0 };
    let face = dvec2(side(direction.x), side(direction.z));
    let met = direction / direction.abs().element_sum();
    let seen = dvec2(met.x, met.z);
    let place = if met.y < 0.0 { seen - (seen.dot(face) - 1.0) * face } else { seen };
    0.5 * (place + 1.0)
}

/// The unit vector of a place on the unit square, the inverse of [`octahedral_place`].
#[must_use]
pub fn octahedral_direction(place: DVec2) -> DVec3 {
    let p = 2.0 * place - 1.0;
    let beyond = p.abs().element_sum() - 1.0;
    let inside = if beyond > 0.0 { p - beyond * p.signum() } else { p };
    dvec3(inside.x, -beyond, inside.y).normalize()
}
