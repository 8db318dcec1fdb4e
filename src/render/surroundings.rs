//! An environment as the mesh passes read it (`kernels/common/mesh_environment.wgsl`).

use crate::{
    gpu::{Bind, Buffer, GpuError, Layers, Recorder, Resource, bind_layers},
    model::{ALBEDO_SIZE, ENVIRONMENT_LEVELS, ENVIRONMENT_SIZE},
    stage::{count, single},
};

/// A prefiltered environment in adapter memory, or none.
#[derive(Debug)]
pub struct SurroundingsBuffers {
    levels: Layers,
    albedos: Layers,
    /// 0 if there is none.
    strength: f64,
    turn: f64,
}

impl SurroundingsBuffers {
    /// Of `levels` and `albedo` from [`stage::Environment`](crate::stage::Environment).
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    pub fn record(
        recorder: &mut Recorder<'_>, levels: &Buffer<[f32; 4]>, albedo: &[[f32; 2]], strength: f64, turn: f64,
    ) -> Result<Self, GpuError> {
        let albedo: Vec<_> = albedo.iter().map(|&[scale, bias]| [scale, bias, 0.0, 0.0]).collect();
        let albedo = recorder.gpu().upload("directional albedo", &albedo)?;
        let (side, entries) = (count(ENVIRONMENT_SIZE), count(ALBEDO_SIZE));
        let levels = Layers::record(recorder, "environment", levels, [side, side, count(ENVIRONMENT_LEVELS)])?;
        let albedos = Layers::record(recorder, "directional albedo", &albedo, [entries, entries, 1])?;
        Ok(Self { levels, albedos, strength, turn })
    }

    /// None, for passes that bind one.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    pub fn none(recorder: &mut Recorder<'_>) -> Result<Self, GpuError> {
        let black = recorder.gpu().zeros("no environment", Layers::COLUMNS as usize)?;
        let mut layers = || Layers::record(recorder, "no environment", &black, [Layers::COLUMNS, 1, 1]);
        Ok(Self { levels: layers()?, albedos: layers()?, strength: 0.0, turn: 0.0 })
    }

    /// The same, turned to `turn` radians.
    pub fn turn_to(&mut self, turn: f64) {
        self.turn = turn;
    }

    /// What a pass that imports `mesh_environment` declares.
    pub(super) fn resources() -> [Resource; 2] {
        [Resource::layers("surroundings"), Resource::layers("albedos")]
    }

    /// What it binds.
    pub(super) fn binds(&self) -> [Bind<'_>; 2] {
        [bind_layers("surroundings", &self.levels), bind_layers("albedos", &self.albedos)]
    }

    /// Strength, and cosine and sine of the turn.
    pub(super) fn params(&self) -> [f32; 4] {
        let (sine, cosine) = self.turn.sin_cos();
        [self.strength, cosine, sine, 0.0].map(single)
    }
}
