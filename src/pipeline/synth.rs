//! A source without a measurement: every sample is rendered when it is read.

use half::f16;
use rayon::prelude::*;

use super::{PipelineError, Progress, tiles::run};
use crate::{
    data::{Block, Btf, Choice, Direction, Encoding, Fit, FitStatus, Lobe, Map, Material, Pair, Provenance, Svbrdf, Transfer},
    gpu::Gpu,
    io::{IoError, Source},
    model::{Boundary, FitSettings, Frame, SurfaceMode, Synth, SynthPlace, SynthTexel},
    stage::{self, SynthSurface},
};

/// Bytes of a batch of rendered samples on the adapter.
const BATCH_BYTES: u64 = 64 << 20;

/// Cells of the height field that the rays of a batch pass over: a quarter of a second at a billion a second, as no driver's watchdog
/// minds.
const BATCH_CELLS: f64 = (1_u64 << 28) as f64;

/// A material of [`Synth`] under all pairs of some views and lights. Its samples are rendered on the adapter whenever they are read, and
/// are the same whatever block or batch they are read in.
#[derive(Debug)]
pub struct Synthetic<'g> {
    gpu: &'g Gpu,
    recipe: Synth,
    btf: Btf,
    heights: Map<f32>,
    normals: Map<[f32; 3]>,
    svbrdf: Svbrdf,
    surface: SynthSurface,
    stage: stage::Synth,
}

impl<'g> Synthetic<'g> {
    /// Prepares the maps of a plane of `size` columns and rows.
    ///
    /// # Errors
    /// [`PipelineError`] if the relief is out of range, a list of directions is empty or reaches the horizon, there are no texels, or the
    /// maps do not fit the adapter.
    pub fn new(
        gpu: &'g Gpu, name: &str, recipe: Synth, size: [usize; 2], views: Vec<Direction>, lights: Vec<Direction>, progress: &Progress,
    ) -> Result<Self, PipelineError> {
        let recipe = recipe.checked()?;
        let pairs = (0..views.len()).flat_map(|view| (0..lights.len()).map(move |light| Pair { view, light })).collect();
        let btf = Btf::new(name.to_owned(), size, views, lights, pairs, Encoding::photograph(Transfer::Linear)).map_err(IoError::from)?;
        let [width, height] = size;
        let stage = progress.stage("pattern", btf.texels(), 0);
        let places = || (0..width * height).into_par_iter().map(|texel| SynthPlace::texel(size, texel % width, texel / width));
        let heights: Vec<f64> = places().map(|place| recipe.height(place)).collect();
        // The base plane is the mean height.
        #[expect(clippy::cast_precision_loss, reason = "texels of a plane")]
        let mean = heights.iter().sum::<f64>() / btf.texels() as f64;
        let heights: Vec<f32> = heights.into_iter().map(|height| stage::single(height - mean)).collect();
        let texels: Vec<SynthTexel> = places().map(|place| recipe.texel(place)).collect();
        drop(stage);

        let rgb = |channels: fn(&SynthTexel) -> [f64; 3]| texels.iter().map(|texel| channels(texel).map(stage::single)).collect();
        let svbrdf = Svbrdf {
            frame: Frame::Seen,
            ambient: 0.0,
            diffuse: Map::new(width, height, rgb(|texel| texel.diffuse))?,
            lobes: vec![Lobe {
                specular: Map::new(width, height, rgb(|texel| texel.specular))?,
                parameters: Map::new(width, height, texels.iter().map(|texel| texel.lobe.map(stage::single)).collect())?,
            }],
        };
        let lobe = &svbrdf.lobes[0];
        let upload = |label: &str, map: &Map<[f32; 3]>| {
            let values: Vec<[f32; 4]> = map.values().iter().map(|&[r, g, b]| [r, g, b, 0.0]).collect();
            gpu.upload(label, &values)
        };
        let plane = size.map(stage::count);
        let on_adapter = gpu.upload("heights", &heights)?;
        let of_heights = stage::Normals::new(gpu)?;
        let normals = run(gpu, progress, "normals", [btf.texels(), 0], |recorder| {
            of_heights.record(recorder, &on_adapter, plane, Boundary::Periodic)
        })?;
        let range = heights.iter().fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], &z| [low.min(z), high.max(z)]);
        let surface = SynthSurface {
            size: plane,
            heights: on_adapter,
            diffuse: upload("diffuse", &svbrdf.diffuse)?,
            specular: upload("specular", &lobe.specular)?,
            lobe: gpu.upload("lobe", lobe.parameters.values())?,
            height_range: range,
            normals,
        };
        Ok(Self {
            gpu,
            recipe,
            heights: Map::new(width, height, heights)?,
            normals: Map::new(width, height, surface.normals.read(gpu)?)?.map(|&[x, y, z, _]| [x, y, z]),
            svbrdf,
            surface,
            stage: stage::Synth::new(gpu)?,
            btf,
        })
    }

    /// What is known of it, in the form in which a material is recovered: heights and normals as they were rendered, reflectance with the
    /// lobes in the frame of each texel's own normal (in the base plane's where the plane is flat), and a fit that had nothing to do.
    #[must_use]
    pub fn truth(&self) -> Material {
        let of_lobe = |[r, g, b]: &[f32; 3]| *r > 0.0 || *g > 0.0 || *b > 0.0;
        let status = |specular: &[f32; 3]| if of_lobe(specular) { FitStatus::Converged } else { FitStatus::NoSpecular };
        Material {
            height: self.heights.clone(),
            normal: self.normals.clone(),
            normal_measured: self.normals.clone(),
            albedo: self.svbrdf.diffuse.map(|[r, g, b]| (r + g + b) / 3.0),
            svbrdf: self.svbrdf.clone(),
            lpca: None,
            painted: None,
            fit: Fit {
                objective_without_lobe: self.heights.map(|_| 0.0),
                objective: self.heights.map(|_| 0.0),
                masked: self.heights.map(|_| 0),
                iterations: self.heights.map(|_| 0),
                status: self.svbrdf.lobes[0].specular.map(|specular| status(specular) as u32),
            },
            choice: Choice::only(SurfaceMode::Local, Frame::Seen),
            provenance: Provenance {
                source: format!("{}: synthetic truth of {}, lobes in each texel's own frame", self.btf.name(), self.recipe),
                views: self.btf.views().to_vec(),
                lights: self.btf.lights().to_vec(),
                samples: self.btf.pairs().len(),
                grid: self.btf.grid().map(str::to_owned),
                encoding: *self.btf.encoding(),
                adapter: self.gpu.adapter().name.clone(),
                version: env!("CARGO_PKG_VERSION").to_owned(),
                settings: FitSettings::default(),
            },
        }
    }

    /// Renders samples into `radiance`, all in one batch.
    fn render(&self, samples: &[(Direction, Direction)], block: Block, radiance: &mut [f16]) -> Result<(), PipelineError> {
        let mut recorder = self.gpu.recorder();
        let rendered = self.stage.record(&mut recorder, &self.surface, block, samples)?;
        self.gpu.submit(recorder).wait(self.gpu)?;
        Ok(rendered.read(self.gpu, radiance)?)
    }

    /// How many of the first `samples` make a batch, at least one.
    #[expect(clippy::cast_precision_loss, reason = "texels of a block")]
    fn batch(&self, samples: &[(Direction, Direction)], block: Block) -> usize {
        let bytes = (6 * block.texels().next_multiple_of(2)) as u64;
        let fitting = usize::try_from(self.gpu.max_array_bytes().min(BATCH_BYTES) / bytes).unwrap_or(usize::MAX).max(1);
        // A ray of θ passes over at most √2 tan θ cells for each texel width that it gains.
        let [low, high] = self.surface.height_range;
        let relief = 1.5 * f64::from(high - low);
        let cells = samples.iter().scan(0.0, |sum, (view, light)| {
            *sum += block.texels() as f64 * (2.0 + relief * (view.theta.tan() + light.theta.tan()));
            Some(*sum)
        });
        cells.take(fitting).take_while(|sum| *sum <= BATCH_CELLS).count().max(1)
    }
}

impl Source for Synthetic<'_> {
    fn btf(&self) -> &Btf {
        &self.btf
    }

    fn read(&self, samples: &[usize], block: Block, radiance: &mut [f16], done: &(dyn Fn(usize) + Sync)) -> Result<(), IoError> {
        let halves = 3 * block.texels();
        assert!(block.is_within(self.btf.size()) && radiance.len() == samples.len() * halves, "the block and what it is read into");
        let directions: Vec<_> = samples.iter().map(|&sample| self.btf.directions(sample)).collect();
        let (mut rest, mut into) = (directions.as_slice(), radiance);
        while !rest.is_empty() {
            let (batch, after) = rest.split_at(self.batch(rest, block));
            let (of_batch, of_rest) = into.split_at_mut(batch.len() * halves);
            let failed = |error: PipelineError| IoError::NotRendered { name: self.btf.name().to_owned(), source: error.into() };
            self.render(batch, block, of_batch).map_err(failed)?;
            done(batch.len());
            (rest, into) = (after, of_rest);
        }
        Ok(())
    }

    fn fingerprint(&self) -> String {
        let directions = |list: &[Direction]| list.iter().map(|direction| format!("{direction:?}")).collect::<Vec<_>>().join(" ");
        let [width, height] = self.btf.size();
        let (views, lights) = (directions(self.btf.views()), directions(self.btf.lights()));
        format!(
            "synthetic {:?} {width} x {height}, views {views}, lights {lights}, overpaint {}, {}",
            self.recipe,
            env!("CARGO_PKG_VERSION"),
            self.gpu.adapter().name
        )
    }
}
