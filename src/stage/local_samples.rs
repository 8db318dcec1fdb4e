//! What the stages read that know each texel's reflectance in the frames of normals (`kernels/common/local_samples.wgsl`).

use half::f16;

use super::tile::{SampleDirections, Tile};
use crate::{
    data::{MAX_LOBES, OCTET},
    gpu::{Bind, Buffer, Resource, bind},
};

/// A tile's samples with all that their reflectance depends on.
#[derive(Debug, Clone, Copy)]
pub(super) struct LocalSamples<'a> {
    pub radiance: &'a Tile,
    pub shading: &'a Buffer<[f16; OCTET]>,
    pub directions: &'a Buffer<SampleDirections>,
    pub normals: &'a Buffer<[f32; 4]>,
    pub lobes: &'a Buffer<[f32; 4]>,
}

impl<'a> LocalSamples<'a> {
    /// What a pass that imports `local_samples` declares.
    pub fn resources() -> [Resource; 5] {
        [
            Resource::read::<[f16; OCTET]>("radiance"),
            Resource::read::<[f16; OCTET]>("shading"),
            Resource::read::<SampleDirections>("directions"),
            Resource::read::<[f32; 4]>("normals"),
            Resource::read::<[f32; 4]>("lobes"),
        ]
    }

    /// What such a pass binds.
    pub fn binds(&self) -> [Bind<'a>; 5] {
        [
            bind("radiance", &self.radiance.values),
            bind("shading", self.shading),
            bind("directions", self.directions),
            bind("normals", self.normals),
            bind("lobes", self.lobes),
        ]
    }

    /// Number of lobes of a texel.
    pub fn lobe_count(&self) -> usize {
        (self.lobes.len() / self.radiance.texels.max(1)).min(MAX_LOBES)
    }
}
