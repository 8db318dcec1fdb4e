//! Radiance of a material that is fully known, under many (view, light) pairs. Kernel `synth`, twin
//! [`reference::synth`](crate::reference::synth).
//!
//! The surface goes through the heights at texel centres, bilinear between them, and repeats. A texel's image is what the ray meets that
//! crosses the base plane z = 0 at its centre, as BTF images are rectified. Normals are joined bilinearly, reflectance is that of the
//! nearest texel, so that every texel has its own and no lobes are mixed. A value depends neither on the block nor on the samples that are
//! asked for with it.

use half::f16;

use super::scalar::count;
use crate::{
    data::{Block, Direction},
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct, wgsl,
};

gpu_struct! {
    struct Params {
        view: [f32; 4],
        width: u32,
        height: u32,
        column: u32,
        row: u32,
        block_width: u32,
        block_texels: u32,
        first: u32,
        samples: u32,
        lowest: f32,
        highest: f32,
        _pad0: u32,
        _pad1: u32,
    }
}

/// Lights that share a view ray in the kernel.
const LIGHTS: usize = 16;

/// A known material in adapter memory, all maps `[row][column]`.
#[derive(Debug)]
pub struct SynthSurface {
    /// Columns and rows.
    pub size: [u32; 2],
    /// Texel widths, positive outwards.
    pub heights: Buffer<f32>,
    /// Unit normals of `heights`, fourth component 0.
    pub normals: Buffer<[f32; 4]>,
    /// ρ_d per channel.
    pub diffuse: Buffer<[f32; 4]>,
    /// ρ_s per channel.
    pub specular: Buffer<[f32; 4]>,
    /// (C_x, C_y, C_z, n) in the frame of the normal, whose first axis is the plane's x.
    pub lobe: Buffer<[f32; 4]>,
    /// Lowest and highest of `heights`, or bounds of them: rays are followed between the two.
    pub height_range: [f32; 2],
}

/// Radiance of some samples of a block, on the adapter.
#[derive(Debug)]
pub struct Rendered {
    /// `[sample][channel][pair of texels]`, reflectance units, two halves a word; an odd last texel is there twice.
    pub words: Buffer<u32>,
    /// Texels of the block.
    pub texels: usize,
}

impl Rendered {
    /// Copies it to `[sample][channel][texel]`; blocks until it is there.
    ///
    /// # Errors
    /// [`GpuError`] if the device stopped or is out of memory.
    ///
    /// # Panics
    /// If `radiance` has another length.
    pub fn read(&self, gpu: &Gpu, radiance: &mut [f16]) -> Result<(), GpuError> {
        let words = self.words.read(gpu)?;
        let rows = words.chunks_exact(self.texels.div_ceil(2));
        assert_eq!(radiance.len(), rows.len() * self.texels, "halves of all samples");
        for (halves, words) in radiance.chunks_exact_mut(self.texels).zip(rows) {
            for (pair, word) in halves.chunks_mut(2).zip(words) {
                let bits = word.to_le_bytes();
                let both = [f16::from_le_bytes([bits[0], bits[1]]), f16::from_le_bytes([bits[2], bits[3]])];
                pair.copy_from_slice(&both[..pair.len()]);
            }
        }
        Ok(())
    }
}

/// The stage's kernel on one device.
#[derive(Debug)]
pub struct Synth {
    kernel: Kernel,
}

impl Synth {
    /// Builds the kernel.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let resources = [
            Resource::uniform::<Params>("params"),
            Resource::read::<f32>("heights"),
            Resource::read::<[f32; 4]>("normals"),
            Resource::read::<[f32; 4]>("diffuse"),
            Resource::read::<[f32; 4]>("specular"),
            Resource::read::<[f32; 4]>("lobes"),
            Resource::read::<[f32; 4]>("lights"),
            Resource::read_write::<u32>("radiance"),
        ];
        Ok(Self { kernel: Kernel::new(gpu, &wgsl::SYNTH, wgsl::ALL, &resources)? })
    }

    /// Radiance of `block` in each of `samples` (view, light); one dispatch for each stretch of samples of one view. A view or light at the
    /// horizon or below it gives black.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    ///
    /// # Panics
    /// If the block is not within the plane or there are no samples: the host's bug.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, surface: &SynthSurface, block: Block, samples: &[(Direction, Direction)],
    ) -> Result<Rendered, GpuError> {
        assert!(block.is_within(surface.size.map(|side| side as usize)) && !samples.is_empty(), "a block of the plane, and samples");
        let gpu = recorder.gpu();
        let vector = |direction: Direction| direction.vector().as_vec3().extend(0.0).to_array();
        let lights: Vec<_> = samples.iter().map(|(_, light)| vector(*light)).collect();
        let lights = gpu.upload("lights", &lights)?;
        let pairs = block.texels().div_ceil(2);
        let words = gpu.fresh("synthetic radiance", 3 * samples.len() * pairs)?;
        let mut first = 0;
        for run in samples.chunk_by(|(before, _), (view, _)| before == view) {
            let params = Params {
                view: vector(run[0].0),
                width: surface.size[0],
                height: surface.size[1],
                column: count(block.column),
                row: count(block.row),
                block_width: count(block.width),
                block_texels: count(block.texels()),
                first: count(first),
                samples: count(run.len()),
                lowest: surface.height_range[0],
                highest: surface.height_range[1],
                ..Default::default()
            };
            let params = gpu.uniform("synth params", &params)?;
            let binds = [
                bind("params", &params),
                bind("heights", &surface.heights),
                bind("normals", &surface.normals),
                bind("diffuse", &surface.diffuse),
                bind("specular", &surface.specular),
                bind("lobes", &surface.lobe),
                bind("lights", &lights),
                bind("radiance", &words),
            ];
            recorder.dispatch(&self.kernel, &binds, Grid::layers(pairs, count(run.len().div_ceil(LIGHTS))))?;
            first += run.len();
        }
        Ok(Rendered { words, texels: block.texels() })
    }
}
