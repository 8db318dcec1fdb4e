//! A texel in the terms of glTF.

use std::f64::consts::TAU;

use overpaint::model::{
    MetallicRoughness, PaintMethod, lafortune, lafortune_albedo,
    metallic_roughness::{DIELECTRIC, Part},
    microfacet::schlick,
};

use crate::support::hold;

crate::suite! { plain: a_lobe_reflects_its_share, brightness_is_kept, paint_stays_as_it_is, coverage_mixes; }

/// Share of light from everywhere that a surface reflects: the mean of Schlick's term over cos² from 0 to 1, by the midpoint rule.
fn mean_fresnel(f0: f64, f90: f64) -> f64 {
    let steps = 20_000;
    let at = |step: i32| ((f64::from(step) + 0.5) / f64::from(steps)).sqrt();
    // F0 + (F90 - F0) x from Schlick's F = x where F0 is 0.
    (0..steps).map(|step| f0 + (f90 - f0) * schlick(0.0, at(step))).sum::<f64>() / f64::from(steps)
}

fn a_lobe_reflects_its_share() {
    // Mirroring, growing toward the horizon as that of a weave, flat, retro-reflecting, stretched, and with nothing along the normal.
    for lobe in [
        [-1.0, -1.0, 1.0, 0.0],
        [-1.0, -1.0, 1.0, 1.0],
        [-1.0, -1.0, 1.0, 10.0],
        [-1.05, -1.05, 0.74, 11.0],
        [-0.6, -0.6, 1.0, 5.0],
        [0.5, 0.5, 0.9, 4.0],
        [-1.0, -0.2, 0.8, 20.0],
        [-1.0, -1.0, 0.0, 3.0],
        [-1.0, -1.0, -0.3, 6.0],
    ] {
        // Light and view over rings of equal cos θ dω, turned by half a step against each other.
        let (rings, spokes) = (40, 40);
        let direction = |ring: i32, spoke: f64| {
            let sin2 = (f64::from(ring) + 0.5) / f64::from(rings);
            let phi = TAU * spoke / f64::from(spokes);
            [sin2.sqrt() * phi.cos(), sin2.sqrt() * phi.sin(), (1.0 - sin2).sqrt()]
        };
        let mut sum = 0.0;
        for (ring, spoke) in (0..rings).flat_map(|ring| (0..spokes).map(move |spoke| (ring, spoke))) {
            let light = direction(ring, f64::from(spoke));
            for (ring, spoke) in (0..rings).flat_map(|ring| (0..spokes).map(move |spoke| (ring, spoke))) {
                let view = direction(ring, f64::from(spoke) + 0.5);
                sum += lafortune(lobe, std::array::from_fn(|axis| light[axis] * view[axis]));
            }
        }
        let expected = sum / f64::from(rings * spokes).powi(2);
        // What the form for the horizon is good for, where the lobe lies lowest.
        hold("metallic roughness: albedo of a lobe, relative", (lafortune_albedo(lobe) / expected - 1.0).abs(), 0.05);
    }
    // C scales by C^n; nothing comes of a lobe that is nowhere positive.
    let ratio = lafortune_albedo([-0.5, -0.5, 0.5, 3.0]) / lafortune_albedo([-1.0, -1.0, 1.0, 3.0]);
    hold("metallic roughness: albedo of a smaller lobe", (ratio - 0.125).abs(), 1e-12);
    assert_eq!(lafortune_albedo([0.0; 4]), 0.0);
}

/// Gray light from everywhere comes back as it does from diffuse part and lobes, whatever F₀ and F₉₀ become.
fn brightness_is_kept() {
    let lobe = [-1.0, -1.0, 1.0, 12.0];
    let of_one = lafortune_albedo(lobe);
    for albedo in [0.0, 0.001, 0.05, 0.085, 0.086, 0.2, 0.6] {
        for diffuse in [0.0, 0.3] {
            let found = MetallicRoughness::from(Part::bare([diffuse; 3], [([albedo / of_one; 3], lobe)]));
            let reflected = mean_fresnel(found.f0[0], found.f90);
            // The midpoint rule, and the mean of Schlick's term, which is exact.
            hold("metallic roughness: albedo of the surface", (reflected - albedo).abs(), 1e-6);
            hold("metallic roughness: albedo of the base", ((1.0 - reflected) * found.base_color[0] - diffuse).abs(), 1e-6);
            // A share of a dielectric as long as there is enough of it.
            let is_dielectric = albedo < mean_fresnel(DIELECTRIC, 1.0);
            assert!(found.f90 <= 1.0 && (found.f90 < 1.0) == is_dielectric, "{found:?}");
            if is_dielectric {
                hold("metallic roughness: F0 over F90", (found.f0[0] - DIELECTRIC * found.f90).abs(), 1e-12);
            }
            let alpha = if albedo > 0.0 { (2.0_f64 / 14.0).sqrt() } else { 1.0 };
            hold("metallic roughness: α of a lobe", (found.alpha - alpha).abs(), 1e-12);
        }
    }
    // Two halves of a lobe are that lobe, and of two lobes the stronger one counts more.
    let whole = MetallicRoughness::from(Part::bare([0.2; 3], [([0.5, 0.4, 0.3], lobe)]));
    let halves = MetallicRoughness::from(Part::bare([0.2; 3], [([0.25, 0.2, 0.15], lobe); 2]));
    hold("metallic roughness: two halves of a lobe", (whole.alpha - halves.alpha).abs().max((whole.f0[2] - halves.f0[2]).abs()), 1e-12);
    let two = MetallicRoughness::from(Part::bare([0.2; 3], [([3.0; 3], lobe), ([0.001; 3], [-1.0, -1.0, 1.0, 1.0])]));
    assert!(two.alpha > whole.alpha && two.alpha < whole.alpha + 0.01, "{two:?}");
}

fn paint_stays_as_it_is() {
    let painted = Part::painted(PaintMethod::KubelkaMunk, [0.2, 0.4, 0.6], [0.0625, 0.3]);
    let found = MetallicRoughness::from(painted);
    let worst = [(found.base_color[0], 0.2), (found.base_color[2], 0.6), (found.f0[1], 0.0625), (found.f90, 1.0), (found.alpha, 0.3)];
    let worst = worst.iter().map(|(found, expected)| (found - expected).abs()).fold(0.0, f64::max);
    hold("metallic roughness: paint", worst, 1e-12);
    // A colour that is blended in has no surface.
    let found = MetallicRoughness::from(Part::painted(PaintMethod::AlphaBlend, [0.2, 0.4, 0.6], [0.0625, 0.3]));
    assert_eq!(found, MetallicRoughness { base_color: [0.2, 0.4, 0.6], f0: [0.0; 3], f90: 0.0, alpha: 1.0 });
}

fn coverage_mixes() {
    let bare = Part::bare([0.5, 0.2, 0.1], [([0.3; 3], [-1.0, -1.0, 1.0, 8.0])]);
    let paint = Part::painted(PaintMethod::KubelkaMunk, [0.1, 0.2, 0.9], [0.04, 0.2]);
    assert_eq!(MetallicRoughness::from(bare.mixed(paint, 0.0)), bare.into());
    let none = Part::painted(PaintMethod::AlphaBlend, [0.0; 3], [0.0; 2]);
    let (all, half) = (MetallicRoughness::from(paint), MetallicRoughness::from(paint.mixed(none, 0.5)));
    // Half as much of everything, and facets as they are.
    let [fresnel, of_half] = [all, half].map(|found| mean_fresnel(found.f0[0], found.f90));
    hold("metallic roughness: half a coat", (of_half - 0.5 * fresnel).abs(), 1e-6);
    hold("metallic roughness: α of half a coat", (half.alpha - 0.2).abs(), 1e-12);
    let blue = |texel: MetallicRoughness, reflected: f64| (1.0 - reflected) * texel.base_color[2];
    hold("metallic roughness: half the paint", (blue(half, of_half) - 0.5 * blue(all, fresnel)).abs(), 1e-6);
    let between = MetallicRoughness::from(bare.mixed(paint, 0.5)).alpha;
    assert!(between > 0.2 && between < MetallicRoughness::from(bare).alpha, "{between}");
}
