//! Height and normals of a source: photometric stereo of the zenith view, then integration (thesis section 3.1).

use super::{
    PipelineError,
    tiles::{Job, run},
};
use crate::{
    data::{Direction, Map},
    gpu::Buffer,
    model::{Boundary, FitSettings},
    stage::{self, HeightField},
};

/// What photometric stereo and integration give.
pub(super) struct Geometry {
    /// Height in texel widths, its mean at the level that was given, else 0.
    pub height: Map<f32>,
    /// Normals of that height.
    pub normal: Map<[f32; 3]>,
    /// Photometric stereo's own normals.
    pub normal_measured: Map<[f32; 3]>,
    /// Photometric stereo's albedo.
    pub albedo: Map<f32>,
    /// Height and normals on the adapter.
    pub field: HeightField,
}

impl Geometry {
    fn new(
        job: &Job<'_>, heights: Buffer<f32>, boundary: Boundary, normal_measured: Map<[f32; 3]>, albedo: Map<f32>,
    ) -> Result<Self, PipelineError> {
        let Job { gpu, source, progress, .. } = *job;
        let [width, height] = source.btf().size();
        let size = [stage::count(width), stage::count(height)];
        let from_height = stage::Normals::new(gpu)?;
        let normals =
            run(gpu, progress, "normals", [width * height, 0], |recorder| from_height.record(recorder, &heights, size, boundary))?;
        let height_map = Map::new(width, height, heights.read(gpu)?)?;
        let range = height_map.values().iter().fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], &z| [low.min(z), high.max(z)]);
        Ok(Self {
            height: height_map,
            normal: Map::new(width, height, normals.read(gpu)?)?.map(|&[x, y, z, _]| [x, y, z]),
            normal_measured,
            albedo,
            field: HeightField { size, heights, normals, range, boundary },
        })
    }

    /// The same with the height times `scale` and raised by `level` texel widths.
    pub fn with_height(&self, job: &Job<'_>, scale: f64, level: f64) -> Result<Self, PipelineError> {
        let heights: Vec<f32> = self.height.values().iter().map(|&z| stage::single(f64::from(z) * scale + level)).collect();
        let heights = job.gpu.upload("heights", &heights)?;
        Self::new(job, heights, self.field.boundary, self.normal_measured.clone(), self.albedo.clone())
    }
}

pub(super) fn recover(job: &Job<'_>, settings: &FitSettings) -> Result<Geometry, PipelineError> {
    let Job { gpu, source, progress, .. } = *job;
    let btf = source.btf();
    let samples = btf.zenith_samples();
    let lights: Vec<Direction> = samples.iter().map(|&sample| btf.directions(sample).1).collect();
    let stereo = stage::PhotometricStereo::new(gpu)?;
    let measured: Vec<[f32; 4]> = job.for_each_tile("normals", 1, &samples, |gathered, _| {
        let tile = gathered.tile;
        let size = [tile.texels, tile.samples];
        let normals = run(gpu, progress, "photometric_stereo", size, |recorder| stereo.record(recorder, &tile, &lights, settings.stereo))?;
        Ok(normals.read(gpu)?)
    })?;

    let [width, height] = btf.size();
    let size = [stage::count(width), stage::count(height)];
    let normals = gpu.upload("measured normals", &measured)?;
    let integrate = stage::FrankotChellappa::new(gpu)?;
    let heights =
        run(gpu, progress, "frankot_chellappa", [btf.texels(), 1], |recorder| integrate.record(recorder, &normals, size, settings))?;
    let measured = Map::new(width, height, measured)?;
    let (normal_measured, albedo) = (measured.map(|&[x, y, z, _]| [x, y, z]), measured.map(|&[_, _, _, albedo]| albedo));
    Geometry::new(job, heights, settings.boundary, normal_measured, albedo)
}
