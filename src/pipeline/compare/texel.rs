//! One texel's measurement, views × lights, through the steps of the fit (thesis fig. 3.4).

use glam::DVec3;
use half::f16;

use crate::{
    data::{Btf, Direction, Map, OCTET, Samples, Svbrdf},
    gpu::Gpu,
    model::{Frame, Relief, lafortune, product_in_frame},
    pipeline::{PipelineError, Progress, tiles::run},
    stage::{self, SeenSurface, Shading, Surface, Tile, upload_directions},
};

/// The frame that a texel's reflectance is in under one pair, and its light there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Framed {
    /// Unit normal.
    normal: DVec3,
    /// cos θ_i against it times the share of the light that reaches the point.
    shading: f64,
}

/// The frames of texel (column, row) of `surface` under each pair of `btf`.
pub fn framed(
    gpu: &Gpu, surface: &Surface, btf: &Btf, [column, row]: [usize; 2], relief: Relief, progress: &Progress,
) -> Result<Vec<Framed>, PipelineError> {
    let samples = Samples::new((0..btf.pairs().len()).map(|sample| btf.directions(sample)).collect());
    if surface.frame == Frame::Plane {
        return Ok(samples.light_cosines().map(|shading| Framed { normal: DVec3::Z, shading }).collect());
    }
    let is_seen = surface.frame == Frame::Seen;
    let relief = Relief { displace: relief.displace && is_seen, shadow: relief.shadow && is_seen, ..relief };
    let rows: Vec<u32> = btf.pairs().iter().map(|pair| stage::count(pair.view)).collect();
    let (seen_surface, shading) = (SeenSurface::new(gpu)?, Shading::new(gpu)?);
    // Of any radiance that is not masked.
    let white = vec![[f16::ONE; OCTET]; 3 * samples.octets()];
    let (seen, shaded) = run(gpu, progress, "shading", [1, samples.len()], |recorder| {
        let places = [[stage::count(column), stage::count(row)]];
        let seen = seen_surface.record(recorder, &surface.field, relief, btf.views(), &places)?;
        let radiance = Tile { values: gpu.upload("white", &white)?, texels: 1, samples: samples.len() };
        let directions = upload_directions(gpu, &samples, &rows)?;
        let shaded = shading.record(recorder, &radiance, &directions, &surface.field, &seen, relief, surface.ambient)?;
        Ok::<_, PipelineError>((seen, shaded))
    })?;
    let (normals, shading) = (seen.normals.read(gpu)?, shaded.shading.read(gpu)?);
    let of_pair = |(&row, shading): (&u32, &f16)| {
        let [x, y, z, _] = normals[row as usize].map(f64::from);
        Framed { normal: DVec3::new(x, y, z), shading: shading.to_f64() }
    };
    Ok(rows.iter().zip(shading.as_flattened()).map(of_pair).collect())
}

/// What a material holds of a texel under one pair of directions, linear.
#[derive(Debug, Clone, Copy)]
pub struct Reflected {
    /// ρ_d.
    pub diffuse: [f64; 3],
    /// (C·(ω_i ω_o))^n of the first lobe.
    pub lobe: f64,
    /// Sum over the lobes of ρ_s times the lobe.
    pub specular: [f64; 3],
}

/// Evaluates the fitted reflectance of texel (column, row) in the frame of `normal`.
pub fn reflected(svbrdf: &Svbrdf, at: (usize, usize), normal: DVec3, view: Direction, light: Direction) -> Reflected {
    let product = product_in_frame(normal, view.vector(), light.vector());
    let lobes: Vec<f64> = svbrdf.lobes.iter().map(|lobe| lafortune(lobe.parameters[at].map(f64::from), product)).collect();
    let specular =
        |channel: usize| svbrdf.lobes.iter().zip(&lobes).map(|(lobe, value)| f64::from(lobe.specular[at][channel]) * value).sum();
    Reflected {
        diffuse: svbrdf.diffuse[at].map(f64::from),
        lobe: lobes.first().copied().unwrap_or_default(),
        specular: std::array::from_fn(specular),
    }
}

/// An image of views (rows) by lights (columns); none where there is no such pair, or it is masked.
pub type Measurement = Map<Option<[f64; 3]>>;

/// Each step of the fit, and below it what the material has in its place.
pub struct Steps {
    /// L; and (ρ_d + ρ_s lobe) times the shading, which is cos θ on a flat surface.
    pub radiance: [Measurement; 2],
    /// f = L/shading; and ρ_d + ρ_s lobe.
    pub reflectance: [Measurement; 2],
    /// s = max(f − ρ_d, 0); and ρ_s lobe.
    pub specular: [Measurement; 2],
    /// Mean of s over the channels; and the lobe.
    pub mean: [Measurement; 2],
}

/// The steps of texel `at` with the radiance `measured` in each pair.
pub fn steps(btf: &Btf, svbrdf: &Svbrdf, at: [usize; 2], measured: &[Option<[f32; 3]>], framed: &[Framed]) -> Steps {
    let mut radiance: Measurement = Map::from_fn(btf.lights().len(), btf.views().len(), |_, _| None);
    let mut frames = radiance.map(|_| Framed { normal: DVec3::Z, shading: 0.0 });
    for ((pair, channels), framed) in btf.pairs().iter().zip(measured).zip(framed) {
        radiance[(pair.light, pair.view)] = channels.map(|channels| channels.map(f64::from));
        frames[(pair.light, pair.view)] = *framed;
    }
    // What `of` makes of each measured value, what the material reflects there, and its shading.
    let step = |of: &dyn Fn([f64; 3], Reflected, f64) -> [f64; 3]| {
        Map::from_fn(radiance.width(), radiance.height(), |light, view| {
            let (view_direction, light_direction) = (btf.views()[view], btf.lights()[light]);
            let Framed { normal, shading } = frames[(light, view)];
            let found = reflected(svbrdf, (at[0], at[1]), normal, view_direction, light_direction);
            radiance[(light, view)].map(|channels| of(channels, found, shading))
        })
    };
    let sum = |a: [f64; 3], b: [f64; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    // A place without light has no reflectance.
    let over = |radiance: f64, shading: f64| if shading > 0.0 { radiance / shading } else { 0.0 };
    let above =
        |radiance: [f64; 3], found: Reflected, shading: f64| [0, 1, 2].map(|c| (over(radiance[c], shading) - found.diffuse[c]).max(0.0));
    Steps {
        radiance: [
            step(&|radiance, _, _| radiance),
            step(&|_, found, shading| sum(found.diffuse, found.specular).map(|value| value * shading)),
        ],
        reflectance: [
            step(&|radiance, _, shading| radiance.map(|value| over(value, shading))),
            step(&|_, found, _| sum(found.diffuse, found.specular)),
        ],
        specular: [step(&above), step(&|_, found, _| found.specular)],
        mean: [
            step(&|radiance, found, shading| [above(radiance, found, shading).iter().sum::<f64>() / 3.0; 3]),
            step(&|_, found, _| [found.lobe; 3]),
        ],
    }
}
