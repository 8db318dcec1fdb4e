//! Layers of paint over a ground: reflectance, coverage, surface and height (thesis eqs. 3.7 to 3.9). Kernel `kubelka_munk`, twin
//! [`reference::kubelka_munk`](crate::reference::kubelka_munk).
//!
//! The drawn thickness t of a layer means two things and no more: the film's thickness d = thickness·t, and the surface's rise,
//! relief·t. A stack is laid from the bottom up, since from below it reflects otherwise than from above.

use super::scalar::{count, single};
use crate::{
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, model, wgsl,
};

gpu_struct! {
    struct Params { texels: u32, layers: u32, continues: u32, continued: u32, closed: f32, _pad0: u32, _pad1: u32, _pad2: u32 }
}
gpu_struct! {
    struct Layer {
        absorption: [f32; 3], relief: f32, scattering: [f32; 3], _pad0: f32, coat: [f32; 2], _pad1: [f32; 2]
    }
}
/// The stage's kernel on one device.
#[derive(Debug)]
pub struct KubelkaMunk {
    kernel: Kernel,
}

/// A surface on which layers are laid.
#[derive(Debug)]
pub struct PaintStack {
    /// `[texel]` ρ_d of the ground and, once all layers are laid, of the paint on it; the fourth component is coverage, how much of the
    /// texel is painted, 0 to 1.
    pub painted: Buffer<[f32; 4]>,
    /// `[texel]` F₀ and α of the topmost paint's surface.
    pub coats: Buffer<[f32; 2]>,
    /// `[texel]` height in texel widths, positive outwards, the paint's included.
    pub heights: Buffer<f32>,
    /// `[texel]` what one batch leaves to the next: reflectance over the ground and over black, and transmittance.
    between: [Buffer<[f32; 4]>; 3],
    /// Layers that are laid, and that will be.
    laid: usize,
    layers: usize,
}

impl PaintStack {
    /// A ground of reflectance and coverage `painted` `[texel]`, surfaces `coats` `[texel]` and `heights` `[texel]`, on which `layers`
    /// layers will be laid in batches of at most `batch`.
    ///
    /// # Errors
    /// [`GpuError`] if what batches leave to each other does not fit the adapter.
    ///
    /// # Panics
    /// If the three differ in length: the caller's bug.
    pub fn new(
        gpu: &Gpu, painted: Buffer<[f32; 4]>, coats: Buffer<[f32; 2]>, heights: Buffer<f32>, layers: usize, batch: usize,
    ) -> Result<Self, GpuError> {
        let texels = painted.len();
        assert_eq!([coats.len(), heights.len()], [texels; 2], "texels of \"{}\" and \"{}\"", coats.label(), heights.label());
        // A single batch leaves nothing.
        let left = if layers > batch { texels } else { 1 };
        let between = [gpu.fresh("over ground", left)?, gpu.fresh("over black", left)?, gpu.fresh("transmittance", left)?];
        Ok(Self { painted, coats, heights, between, laid: 0, layers })
    }
}

impl KubelkaMunk {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<Layer>("layers"),
            Resource::read::<f32>("drawn"),
            Resource::read_write::<[f32; 4]>("painted"),
            Resource::read_write::<[f32; 2]>("coats"),
            Resource::read_write::<f32>("heights"),
            Resource::read_write::<[f32; 4]>("over_ground"),
            Resource::read_write::<[f32; 4]>("over_black"),
            Resource::read_write::<[f32; 4]>("transmittance"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::KUBELKA_MUNK, wgsl::ALL, &resources)? })
    }

    /// Lays `layers`, the next ones from the bottom up, on `stack`, as thick as `drawn` `[layer][texel]` (0 to 1) has them. Coverage
    /// becomes 1 − Π(1 − smoothstep(0, [`Layer::CLOSED`](model::Layer::CLOSED), drawn)) over the layers; F₀ and α are those of the
    /// layers' surfaces, each by the share of the covered part in which it is the topmost.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    ///
    /// # Panics
    /// If `drawn` has too few layers, or more layers are laid than the stack was made for: the caller's bug.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, stack: &mut PaintStack, drawn: &Buffer<f32>, layers: &[model::Layer],
    ) -> Result<(), GpuError> {
        let gpu = recorder.gpu();
        let texels = stack.painted.len();
        assert!(drawn.len() >= layers.len() * texels, "layers of \"{}\"", drawn.label());
        let laid = stack.laid + layers.len();
        assert!(laid <= stack.layers, "{laid} layers on a stack of {}", stack.layers);
        let params = Params {
            texels: count(texels),
            layers: count(layers.len()),
            continues: (stack.laid > 0).into(),
            continued: (laid < stack.layers).into(),
            closed: single(model::Layer::CLOSED),
            ..Default::default()
        };
        let layers: Vec<_> = layers.iter().map(Layer::from).collect();
        let params = gpu.uniform("kubelka_munk params", &params)?;
        let layers = gpu.upload("layers", &layers)?;
        let [over_ground, over_black, transmittance] = &stack.between;
        let binds = [
            bind("params", &params),
            bind("layers", &layers),
            bind("drawn", drawn),
            bind("painted", &stack.painted),
            bind("coats", &stack.coats),
            bind("heights", &stack.heights),
            bind("over_ground", over_ground),
            bind("over_black", over_black),
            bind("transmittance", transmittance),
        ];
        recorder.dispatch(&self.kernel, &binds, Grid::threads(texels))?;
        stack.laid = laid;
        Ok(())
    }
}

impl From<&model::Layer> for Layer {
    fn from(layer: &model::Layer) -> Self {
        let at_full = |coefficients: [f64; 3]| coefficients.map(|coefficient| single(coefficient * layer.thickness));
        let coat = layer.coat();
        Self {
            absorption: at_full(layer.paint.k),
            relief: single(layer.relief),
            scattering: at_full(layer.paint.s),
            coat: [coat.f0(), coat.alpha()].map(single),
            ..Default::default()
        }
    }
}
