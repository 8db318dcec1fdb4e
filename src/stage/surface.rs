//! A material on the adapter, ready to be looked at: what `reconstruct` and the render passes read.

use super::{HeightField, Scene, scalar::count};
use crate::{
    data::{Direction, MAX_LOBES},
    gpu::{Bind, Buffer, Gpu, GpuError, Resource, bind},
    model::{Frame, PaintMethod, Relief},
};

/// A material's maps in adapter memory, all `[row][column]` where nothing else is said.
#[derive(Debug)]
pub struct Surface {
    /// Its relief, the paint's thickness included.
    pub field: HeightField,
    /// The frame that the unpainted material's reflectance is in.
    pub frame: Frame,
    /// Share of the base plane's light that reaches every point of the unpainted material by way of others, 0 to 1.
    pub ambient: f64,
    /// ρ_d of the unpainted material per channel.
    pub diffuse: Buffer<[f32; 4]>,
    /// `[lobe][row][column]` ρ_s of the unpainted material per channel.
    pub specular: Buffer<[f32; 4]>,
    /// `[lobe][row][column]` (C_x, C_y, C_z, n) of the unpainted material's lobes.
    pub lobes: Buffer<[f32; 4]>,
    /// Levels of `painted`, `coats` and the field's normals, the finest first ([`Minify`](super::Minify)): 1, or all.
    pub levels: u32,
    /// ρ_d of the paint on what lies below it, R, G, B; the fourth component is how much of the texel is painted, 0 to 1.
    pub painted: Buffer<[f32; 4]>,
    /// F₀ and α of the topmost paint's surface.
    pub coats: Buffer<[f32; 2]>,
    /// What it does to what lies below it.
    pub method: PaintMethod,
}

impl Surface {
    /// What a pass that imports `shade` declares, but for the bare part.
    pub(crate) fn painted_resources() -> Vec<Resource> {
        let mut resources = HeightField::resources().to_vec();
        resources.extend([Resource::read::<[f32; 4]>("painted"), Resource::read::<[f32; 2]>("coats")]);
        resources
    }

    /// What a pass that imports `unpainted_svbrdf` declares beside.
    pub(crate) fn bare_resources() -> Vec<Resource> {
        ["diffuse", "specular", "lobes"].map(Resource::read::<[f32; 4]>).to_vec()
    }

    /// What a pass that imports both declares.
    pub(crate) fn resources() -> Vec<Resource> {
        [Self::painted_resources(), Self::bare_resources()].concat()
    }

    /// What a pass with [`Self::painted_resources`] binds, `scene` from [`Surface::scene`].
    pub(crate) fn painted_binds<'a>(&'a self, scene: &'a Buffer<Scene>) -> Vec<Bind<'a>> {
        let mut binds = self.field.binds(scene).to_vec();
        binds.extend([bind("painted", &self.painted), bind("coats", &self.coats)]);
        binds
    }

    /// What one with [`Self::bare_resources`] binds.
    pub(crate) fn bare_binds(&self) -> Vec<Bind<'_>> {
        vec![bind("diffuse", &self.diffuse), bind("specular", &self.specular), bind("lobes", &self.lobes)]
    }

    /// What one with [`Self::resources`] binds.
    pub(crate) fn binds<'a>(&'a self, scene: &'a Buffer<Scene>) -> Vec<Bind<'a>> {
        [self.painted_binds(scene), self.bare_binds()].concat()
    }

    /// The uniform block of a picture under one view and one light.
    pub(crate) fn scene(&self, gpu: &Gpu, view: Direction, light: Direction, relief: Relief) -> Result<Buffer<Scene>, GpuError> {
        gpu.uniform("scene", &self.params(relief).lit(view, light))
    }

    /// The uniform block of a picture whose views and lights differ from place to place.
    pub(crate) fn unlit_scene(&self, gpu: &Gpu, relief: Relief) -> Result<Buffer<Scene>, GpuError> {
        gpu.uniform("scene", &self.params(relief))
    }

    fn params(&self, relief: Relief) -> Scene {
        let texels = self.diffuse.len().max(1);
        let lobes = count((self.lobes.len() / texels).min(MAX_LOBES));
        self.field.scene(relief).painted(self.method).in_frame(self.frame, lobes).with_ambient(self.ambient)
    }
}
