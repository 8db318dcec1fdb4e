//! An environment made ready for reflections ([`model::environment`](crate::model::environment_roughness)): reduced, then averaged over the
//! lobes of rough surfaces; and the directional albedo that goes with it. Kernels `environment_reduce`, `environment_prefilter` and
//! `environment_albedo`, twin [`reference::environment`](mod@crate::reference).

use std::{
    f64::consts::{FRAC_PI_2, PI, TAU},
    ops::Range,
};

use super::{count, single};
use crate::{
    data,
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::{ALBEDO_SIZE, ENVIRONMENT_LEVELS, ENVIRONMENT_SOURCE, environment_roughness},
    wgsl,
};

gpu_struct! {
    struct ReduceParams {
        size: [u32; 2], reduced_size: [u32; 2], first_row: u32, first_reduced: u32, reduced_rows: u32, _pad: u32,
    }
}

gpu_struct! {
    struct PrefilterParams {
        alpha2: [f32; 4], source_size: [u32; 2], size: u32, first_level: u32, first_row: u32, rows: u32, _pad0: u32, _pad1: u32,
    }
}

gpu_struct! {
    struct AlbedoParams { size: u32, _pad0: u32, _pad1: u32, _pad2: u32 }
}

/// Values of the map that are uploaded at once.
const BAND_VALUES: usize = 1 << 23;

/// Texels of four levels in one dispatch: 2^27 weighted texels of the source, some hundredths of a second on an adapter of 1 TFLOP/s.
const DISPATCH_TEXELS: usize = 1 << 12;

/// Texels of one thread.
const THREAD_TEXELS: usize = 4;

/// Levels in one dispatch.
const DISPATCH_LEVELS: usize = 4;

/// The stage's kernels on one device.
#[derive(Debug)]
pub struct Environment {
    reduce: Kernel,
    prefilter: Kernel,
    albedo: Kernel,
}

impl Environment {
    /// Builds the kernels.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses one.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let reduce = [
            Resource::uniform::<ReduceParams>("params"),
            Resource::read::<f32>("radiance"),
            Resource::read::<f32>("row_weights"),
            Resource::read_write::<[f32; 4]>("reduced"),
        ];
        let prefilter = [
            Resource::uniform::<PrefilterParams>("params"),
            Resource::read::<[f32; 4]>("source"),
            Resource::read::<[f32; 4]>("source_rows"),
            Resource::read::<[f32; 2]>("source_columns"),
            Resource::read_write::<[f32; 4]>("levels"),
        ];
        let albedo = [Resource::uniform::<AlbedoParams>("params"), Resource::read_write::<[f32; 2]>("albedo")];
        Ok(Self {
            reduce: Kernel::new(gpu, &wgsl::ENVIRONMENT_REDUCE, wgsl::ALL, &reduce)?,
            prefilter: Kernel::new(gpu, &wgsl::ENVIRONMENT_PREFILTER, wgsl::ALL, &prefilter)?,
            albedo: Kernel::new(gpu, &wgsl::ENVIRONMENT_ALBEDO, wgsl::ALL, &albedo)?,
        })
    }

    /// The prefiltered levels `[level][row][column]` of an environment, linear RGB with a fourth component 0:
    /// [`ENVIRONMENT_LEVELS`] octahedral maps of `size` x `size` texels, [`ENVIRONMENT_SIZE`](crate::model::ENVIRONMENT_SIZE) by rule.
    /// `common/environment` looks directions up in them.
    ///
    /// # Errors
    /// [`GpuError`] if they do not fit the adapter.
    pub fn record(&self, recorder: &mut Recorder<'_>, environment: &data::Environment, size: usize) -> Result<Buffer<[f32; 4]>, GpuError> {
        let source = self.record_source(recorder, environment)?;
        let gpu = recorder.gpu();
        let [width, height] = ENVIRONMENT_SOURCE;
        let rows: Vec<[f32; 4]> = (0..height)
            .map(|row| {
                let elevation = FRAC_PI_2 - PI * (row as f64 + 0.5) / height as f64;
                let solid_angle = TAU / width as f64 * 2.0 * elevation.cos() * (0.5 * PI / height as f64).sin();
                [elevation.sin(), elevation.cos(), solid_angle, 0.0].map(single)
            })
            .collect();
        let columns: Vec<[f32; 2]> = (0..width)
            .map(|column| {
                let azimuth = PI - TAU * (column as f64 + 0.5) / width as f64;
                [azimuth.sin(), azimuth.cos()].map(single)
            })
            .collect();
        let (rows, columns) = (gpu.upload("environment rows", &rows)?, gpu.upload("environment columns", &columns)?);
        let levels = gpu.fresh("environment levels", ENVIRONMENT_LEVELS * size * size)?;
        let band = (DISPATCH_TEXELS / size).max(1);
        for first_level in (0..ENVIRONMENT_LEVELS).step_by(DISPATCH_LEVELS) {
            for first_row in (0..size).step_by(band) {
                let band = band.min(size - first_row);
                let params = PrefilterParams {
                    alpha2: std::array::from_fn(|level| single(environment_roughness(first_level + level).powi(2))),
                    source_size: ENVIRONMENT_SOURCE.map(count),
                    size: count(size),
                    first_level: count(first_level),
                    first_row: count(first_row),
                    rows: count(band),
                    ..Default::default()
                };
                let params = gpu.uniform("environment_prefilter params", &params)?;
                let binds = [
                    bind("params", &params),
                    bind("source", &source),
                    bind("source_rows", &rows),
                    bind("source_columns", &columns),
                    bind("levels", &levels),
                ];
                recorder.dispatch(&self.prefilter, &binds, Grid::threads((band * size).div_ceil(THREAD_TEXELS)))?;
            }
        }
        Ok(levels)
    }

    /// The map that the levels are summed from: [`ENVIRONMENT_SOURCE`] texels `[row][column]`, equirectangular, linear RGB with a fourth
    /// component 0, each the mean of `environment` over its solid angle.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    pub fn record_source(&self, recorder: &mut Recorder<'_>, environment: &data::Environment) -> Result<Buffer<[f32; 4]>, GpuError> {
        let gpu = recorder.gpu();
        let map = environment.map();
        let (size, reduced_size) = ([map.width(), map.height()], ENVIRONMENT_SOURCE);
        let reduced = gpu.fresh("environment source", reduced_size[0] * reduced_size[1])?;
        let row_weights = gpu.upload("environment row weights", &row_weights(size[1], reduced_size[1]))?;
        let band = (BAND_VALUES / (3 * size[0]) * reduced_size[1] / size[1]).clamp(1, reduced_size[1]);
        for first_reduced in (0..reduced_size[1]).step_by(band) {
            let reduced_rows = band.min(reduced_size[1] - first_reduced);
            let rows = covered(first_reduced, reduced_rows, size[1], reduced_size[1]);
            let values = &map.values()[rows.start * size[0]..rows.end * size[0]];
            let radiance = gpu.upload("environment", values.as_flattened())?;
            let params = ReduceParams {
                size: size.map(count),
                reduced_size: reduced_size.map(count),
                first_row: count(rows.start),
                first_reduced: count(first_reduced),
                reduced_rows: count(reduced_rows),
                _pad: 0,
            };
            let params = gpu.uniform("environment_reduce params", &params)?;
            let binds =
                [bind("params", &params), bind("radiance", &radiance), bind("row_weights", &row_weights), bind("reduced", &reduced)];
            recorder.dispatch(&self.reduce, &binds, Grid::threads(reduced_rows * reduced_size[0]))?;
        }
        Ok(reduced)
    }

    /// (scale, bias) of the directional albedo F₀·scale + bias, `[roughness][cosine]`, [`ALBEDO_SIZE`] of each at the values of
    /// [`albedo_node`](crate::model::albedo_node); the same for every environment.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    pub fn record_albedo(&self, recorder: &mut Recorder<'_>) -> Result<Buffer<[f32; 2]>, GpuError> {
        let gpu = recorder.gpu();
        let params = gpu.uniform("environment_albedo params", &AlbedoParams { size: count(ALBEDO_SIZE), ..Default::default() })?;
        let albedo = gpu.fresh("directional albedo", ALBEDO_SIZE * ALBEDO_SIZE)?;
        recorder.dispatch(&self.albedo, &[bind("params", &params), bind("albedo", &albedo)], Grid::threads(albedo.len()))?;
        Ok(albedo)
    }
}

/// Rows of a map of `height` rows that `rows` rows of one of `reduced_height` cover.
fn covered(first: usize, rows: usize, height: usize, reduced_height: usize) -> Range<usize> {
    first * height / reduced_height..((first + rows) * height).div_ceil(reduced_height)
}

/// For each row of a map and each of the reduced one that overlap, under the sum of their numbers, which no other two have: the part of
/// the reduced row's solid angle. In double precision, since rows at the poles are differences of nearly equal sines.
fn row_weights(height: usize, reduced_height: usize) -> Vec<f32> {
    let parts = height * reduced_height;
    // Of the solid angle between two polar angles.
    let band = |top: usize, bottom: usize| {
        let angle = |count: usize| FRAC_PI_2 * count as f64 / parts as f64;
        angle(top + bottom).sin() * angle(bottom - top).sin()
    };
    let mut weights = vec![0.0; height + reduced_height - 1];
    for reduced in 0..reduced_height {
        let (low, high) = (reduced * height, (reduced + 1) * height);
        for row in covered(reduced, 1, height, reduced_height) {
            let (top, bottom) = ((row * reduced_height).max(low), ((row + 1) * reduced_height).min(high));
            weights[row + reduced] = single(band(top, bottom) / band(low, high));
        }
    }
    weights
}
