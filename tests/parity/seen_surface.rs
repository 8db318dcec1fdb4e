use half::f16;
use overpaint::{
    data::{Direction, Map},
    gpu::Gpu,
    model::{Boundary, Relief},
    reference::{self, SeenPoint},
    stage::{SeenSurface, Shaded, Shading, upload_directions},
};

use crate::support::{
    Worst, hold,
    random::Random,
    surface::{bumpy, upload},
    tile,
};

crate::suite! { gpu: points_and_shading_are_those_of_the_twins; }

/// Share of the base plane's light that reaches every point.
const AMBIENT: f64 = 0.25;

/// Seen points first, then how they are lit: the second stage takes what the first gives, and so do the twins.
fn points_and_shading_are_those_of_the_twins(gpu: &Gpu) {
    let mut random = Random::new(5);
    let (mut compared, mut astray, mut lit_astray) = (0, 0, 0);
    for (width, height, boundary, texels, samples) in
        [(1, 1, Boundary::Periodic, 1, 1), (63, 9, Boundary::Mirror, 63, 9), (40, 30, Boundary::Periodic, 64, 16), (50, 60, Boundary::Mirror, 65, 131)]
    {
        let surface = bumpy(width, height, boundary, 7);
        let field = upload(gpu, &surface).field;
        let directions = tile::directions(&mut random, samples);
        let places: Vec<[u32; 2]> = (0..texels).map(|_| [random.below(width) as u32, random.below(height) as u32]).collect();
        let views: Vec<Direction> = directions.directions().iter().map(|(view, _)| *view).collect();
        let rows: Vec<u32> = (0..samples as u32).collect();
        // A masked sample here and there.
        let is_masked = tile::a_quarter;
        let value = |channel: usize, sample: usize, texel: usize| ((channel + 3 * sample + 7 * texel) % 11) as f64 / 8.0;
        let radiance = tile::upload_masked(gpu, texels, samples, is_masked, value);
        for relief in [Relief::default(), Relief { displace: false, shadow: false, penumbra: 0.1 }] {
            let (seen_surface, shading) = (SeenSurface::new(gpu).expect("builds"), Shading::new(gpu).expect("builds"));
            let mut recorder = gpu.recorder();
            let seen = seen_surface.record(&mut recorder, &field, relief, &views, &places).expect("records");
            let uploaded = upload_directions(gpu, &directions, &rows).expect("fits");
            let shaded = shading.record(&mut recorder, &radiance, &uploaded, &field, &seen, relief, AMBIENT).expect("records");
            gpu.submit(recorder).wait(gpu).expect("runs");
            let (normals, points) = (seen.normals.read(gpu).expect("reads"), seen.points.read(gpu).expect("reads"));
            let Shaded { shading, means } = shaded;
            let [shading, means] = [shading, means].map(|buffer| tile::unpack(&buffer.read(gpu).expect("reads"), texels));
            assert!(shading[samples * texels..].iter().chain(&means[samples * texels..]).all(|&value| value == 0.0));

            for (sample, &(view, light)) in directions.directions().iter().enumerate() {
                for (texel, place) in places.iter().enumerate() {
                    let at = sample * texels + texel;
                    let base = place.map(f64::from);
                    let of_twin = |heights: &Map<f64>| {
                        reference::seen_surface(heights, &surface.normals, boundary, base, relief.displace.then_some(view))
                    };
                    let expected = of_twin(&surface.heights);
                    let found: [f64; 2] = [0, 1].map(|axis| f64::from(points[at][axis]));
                    let off = (0..2).map(|axis| (found[axis] - expected.place[axis]).abs()).worst();
                    compared += 1;
                    // The search steps half a texel: a ray that grazes a summit may be taken for one that misses it.
                    if off > 0.01 {
                        astray += 1;
                        continue;
                    }
                    // A secant step after eight halvings of half a texel, along a ray that runs up to four texels a texel width.
                    hold("seen_surface: places, texels", off, 2e-4);
                    hold("seen_surface: heights", (f64::from(points[at][2]) - expected.height).abs(), 1e-4);
                    let turned = (0..3).map(|axis| (f64::from(normals[at][axis]) - expected.normal[axis]).abs()).worst();
                    hold("seen_surface: normals", turned, 2e-4);

                    // From the kernel's own point, so that only the shading is compared.
                    let point = SeenPoint { place: found, height: f64::from(points[at][2]), normal: [0, 1, 2].map(|axis| f64::from(normals[at][axis])) };
                    let expected = reference::shading(&surface.heights, boundary, point, light, relief, AMBIENT);
                    if is_masked(sample, texel) {
                        assert_eq!((shading[at], means[at]), (0.0, 0.0));
                        continue;
                    }
                    // Half's rounding, 2^-11 below 1; the cover is looked up at grid lines, beside which it is largest.
                    if (shading[at] - expected).abs() > 0.01 {
                        lit_astray += 1;
                    } else {
                        hold("shading: cosine and share of the light", (shading[at] - expected).abs(), 0.01);
                        if !relief.shadow {
                            hold("shading: cosine", (shading[at] - expected).abs(), 3e-4);
                        }
                    }
                    let mean = (0..3).map(|channel| f16::from_f64(value(channel, sample, texel)).to_f64()).sum::<f64>() / 3.0;
                    // Half's rounding of values below 1.25.
                    hold("shading: mean radiance", if shading[at] == 0.0 { means[at] } else { (means[at] - mean).abs() }, 5e-4);
                }
            }
        }
    }
    hold("seen_surface: share of rays that meet another point", f64::from(astray) / f64::from(compared), 2e-3);
    hold("shading: share of points in another shadow", f64::from(lit_astray) / f64::from(compared), 5e-3);
}
