//! Texels whose reflectance stands in the frames of normals that differ by view.

use glam::DVec3;
use half::f16;
use overpaint::{
    data::{Direction, FitStatus, OCTET, Samples},
    gpu::{Buffer, Gpu},
    model::{FitSettings, product_in_frame},
    reference::{FramedSample, LocalSample},
    stage::{self, SampleDirections, Tile, upload_directions},
};

use super::{random::Random, tile};

/// All but the radiance.
pub struct Local {
    pub texels: usize,
    pub samples: Samples,
    /// Of each sample, its row of normals.
    pub rows: Vec<u32>,
    /// `[row][texel]`
    pub normals: Vec<[f32; 4]>,
    /// `[sample][texel]`, halves
    pub shading: Vec<f64>,
    /// `[lobe][texel]`
    pub lobes: Vec<[f32; 4]>,
}

/// The same in adapter memory.
pub struct Uploaded {
    pub shading: Buffer<[f16; OCTET]>,
    pub directions: Buffer<SampleDirections>,
    pub normals: Buffer<[f32; 4]>,
    pub lobes: Buffer<[f32; 4]>,
}

/// What a fit in frames gives for a texel.
pub struct Fitted {
    /// (C_x, C_y, C_z, n)
    pub lobe: [f64; 4],
    /// Mean squared residuals without a lobe and with it, radiance².
    pub objectives: [f64; 2],
    pub status: FitStatus,
    pub steps: u32,
}

/// A lobe towards the mirrored light, the `index`th of a texel narrower than those before.
pub fn lobe(random: &mut Random, index: usize) -> [f32; 4] {
    let [x, y] = [0, 1].map(|_| -random.between(0.8, 1.0) as f32);
    let exponent = [random.between(1.5, 3.0), random.between(8.0, 12.0), random.between(30.0, 40.0)][index];
    [x, y, random.between(0.8, 1.0) as f32, exponent as f32]
}

impl Local {
    /// Random directions, normals up to 40 degrees from the base plane's, light of which a random share reaches three samples of four
    /// and none the others, and `lobes` lobes.
    pub fn new(random: &mut Random, texels: usize, samples: usize, rows: usize, lobes: usize) -> Self {
        let samples = tile::directions(random, samples);
        let row = (0..samples.len()).map(|_| random.below(rows) as u32).collect();
        let normal = |random: &mut Random| {
            Direction::from_degrees(random.between(0.0, 40.0), random.between(0.0, 360.0)).vector().as_vec3().extend(0.0).to_array()
        };
        let normals = (0..rows * texels).map(|_| normal(random)).collect();
        let lobes = (0..lobes * texels).map(|index| lobe(random, index / texels)).collect();
        let mut made = Self { texels, samples, rows: row, normals, shading: Vec::new(), lobes };
        for sample in 0..made.samples.len() {
            let light = made.samples.directions()[sample].1.vector();
            for texel in 0..texels {
                let share = if random.below(4) == 0 { 0.0 } else { random.between(0.2, 1.0) };
                made.shading.push(f16::from_f64(share * made.normal(sample, texel).dot(light).max(0.0)).to_f64());
            }
        }
        made
    }

    /// The samples of a row of normals under one view, as those of a source are; lights and shading stay.
    pub fn by_view(mut self, random: &mut Random) -> Self {
        let rows = self.rows.iter().max().map_or(0, |row| *row as usize + 1);
        let views: Vec<Direction> = tile::directions(random, rows).directions().iter().map(|(view, _)| *view).collect();
        let lights = self.samples.directions().iter().map(|(_, light)| *light);
        self.samples = Samples::new(self.rows.iter().map(|row| views[*row as usize]).zip(lights).collect());
        self
    }

    fn normal(&self, sample: usize, texel: usize) -> DVec3 {
        let [x, y, z, _] = self.normals[self.rows[sample] as usize * self.texels + texel].map(f64::from);
        DVec3::new(x, y, z).normalize()
    }

    /// Values `[sample][texel]` as `[octet][texel]`.
    fn octets(&self, values: &[f64]) -> Vec<[f16; OCTET]> {
        let mut octets = vec![[f16::ZERO; OCTET]; self.samples.octets() * self.texels];
        for (index, value) in values.iter().enumerate() {
            let (sample, texel) = (index / self.texels, index % self.texels);
            octets[sample / OCTET * self.texels + texel][sample % OCTET] = f16::from_f64(*value);
        }
        octets
    }

    pub fn upload(&self, gpu: &Gpu) -> Uploaded {
        Uploaded {
            shading: gpu.upload("shading", &self.octets(&self.shading)).expect("fits"),
            directions: upload_directions(gpu, &self.samples, &self.rows).expect("fits"),
            normals: gpu.upload("normals", &self.normals).expect("fits"),
            lobes: gpu.upload("lobes", &self.lobes).expect("fits"),
        }
    }

    /// The lobes of a texel.
    pub fn lobes_of(&self, texel: usize) -> Vec<[f64; 4]> {
        self.lobes.chunks_exact(self.texels).map(|lobe| lobe[texel].map(f64::from)).collect()
    }

    /// A sample of a texel as the twins see it.
    pub fn sample(&self, sample: usize, texel: usize, radiance: [f64; 3]) -> LocalSample {
        let (view, light) = self.samples.directions()[sample];
        LocalSample {
            view: view.vector(),
            light: light.vector(),
            normal: self.normal(sample, texel),
            shading: self.shading[sample * self.texels + texel],
            radiance,
        }
    }

    /// The samples of a texel with the residual radiance `[sample][texel]`, as the twin of the fit sees them.
    pub fn framed(&self, texel: usize, residual: &[f64]) -> Vec<FramedSample> {
        let framed = |sample: usize| {
            let LocalSample { view, light, normal, shading, .. } = self.sample(sample, texel, [0.0; 3]);
            let residual = residual[sample * self.texels + texel];
            FramedSample { product: product_in_frame(normal, view, light), shading, residual }
        };
        (0..self.samples.len()).map(framed).collect()
    }

    /// Fits a lobe a texel to residual radiance `[sample][texel]` of halves.
    pub fn fit(&self, gpu: &Gpu, residual: &[f64], settings: &FitSettings) -> Vec<Fitted> {
        let stage = stage::LafortuneFit::new(gpu).expect("builds");
        let Uploaded { shading, directions, normals, .. } = self.upload(gpu);
        let residual = gpu.upload("residual", &self.octets(residual)).expect("fits");
        let mut recorder = gpu.recorder();
        let fitted =
            stage.record_framed(&mut recorder, &residual, &shading, &directions, &normals, self.texels, settings).expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");
        let (lobes, objectives) = (fitted.lobes.read(gpu).expect("reads"), fitted.objectives.read(gpu).expect("reads"));
        let outcomes = fitted.outcomes.read(gpu).expect("reads");
        assert_eq!([lobes.len(), objectives.len(), outcomes.len()], [self.texels; 3]);
        let of = |texel: usize| Fitted {
            lobe: lobes[texel].map(f64::from),
            objectives: objectives[texel].map(f64::from),
            status: FitStatus::from_code(outcomes[texel][0]).expect("is a status"),
            steps: outcomes[texel][1],
        };
        (0..self.texels).map(of).collect()
    }

    /// The samples of a texel with the radiance of a tile `[channel][sample, filled up][texel]` ([`tile::unpack`]).
    pub fn samples_of(&self, texel: usize, radiance: &[f64]) -> Vec<LocalSample> {
        let plane = radiance.len() / 3;
        let of = |sample: usize| [0, 1, 2].map(|channel| radiance[channel * plane + sample * self.texels + texel]);
        (0..self.samples.len()).map(|sample| self.sample(sample, texel, of(sample))).collect()
    }

    /// A tile of the radiance that `coefficients(texel)`, ρ_d and then each ρ_s, have, rounded to halves; `changed(channel, sample,
    /// texel, radiance)` is what becomes of it before.
    pub fn tile(
        &self, gpu: &Gpu, coefficients: impl Fn(usize) -> Vec<[f64; 3]>, mut changed: impl FnMut(usize, usize, usize, f64) -> f64,
    ) -> Tile {
        let mut radiance = vec![0.0; 3 * self.samples.len() * self.texels];
        for texel in 0..self.texels {
            let (lobes, coefficients) = (self.lobes_of(texel), coefficients(texel));
            for sample in 0..self.samples.len() {
                let responses = self.sample(sample, texel, [0.0; 3]).responses(&lobes);
                for channel in 0..3 {
                    radiance[(channel * self.samples.len() + sample) * self.texels + texel] =
                        responses.iter().zip(&coefficients).map(|(response, rho)| response * rho[channel]).sum();
                }
            }
        }
        tile::upload(gpu, self.texels, self.samples.len(), |channel, sample, texel| {
            changed(channel, sample, texel, radiance[(channel * self.samples.len() + sample) * self.texels + texel])
        })
    }

    /// What the refit makes of a tile: per texel ρ_d, then each ρ_s.
    pub fn refit(&self, gpu: &Gpu, radiance: &Tile) -> Vec<Vec<[f64; 3]>> {
        let stage = stage::LinearRefit::new(gpu).expect("builds");
        let Uploaded { shading, directions, normals, lobes } = self.upload(gpu);
        let mut recorder = gpu.recorder();
        let refitted = stage.record(&mut recorder, radiance, &shading, &directions, &normals, &lobes).expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");
        let mut planes = refitted.diffuse.read(gpu).expect("reads");
        planes.extend(refitted.specular.read(gpu).expect("reads"));
        assert_eq!(planes.len(), self.texels + self.lobes.len());
        assert!(planes.iter().all(|rho| rho[3].to_bits() == 0));
        (0..self.texels)
            .map(|texel| {
                let of_texel = planes.chunks_exact(self.texels).map(|plane| plane[texel]);
                of_texel.map(|rho| [0, 1, 2].map(|channel| f64::from(rho[channel]))).collect()
            })
            .collect()
    }
}
