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
    /// ρ_d of the paint on what lies below it, R, G, B; the fourth component is how much of the texel is painted, 0 to 1.
    pub painted: Buffer<[f32; 4]>,
    /// F₀ and α of the topmost paint's surface.
    pub coats: Buffer<[f32; 2]>,
    /// What it does to what lies below it.
    pub method: PaintMethod,
}

impl Surface {
    /// What a pass that imports `surface` declares.
    pub(crate) fn resources() -> Vec<Resource> {
        let mut resources = HeightField::resources().to_vec();
        resources.extend(["diffuse", "specular", "lobes", "painted"].map(Resource::read::<[f32; 4]>));
        resources.push(Resource::read::<[f32; 2]>("coats"));
        resources
    }

    /// What such a pass binds, `scene` from [`Surface::scene`].
    pub(crate) fn binds<'a>(&'a self, scene: &'a Buffer<Scene>) -> Vec<Bind<'a>> {
        let mut binds = self.field.binds(scene).to_vec();
        binds.extend([
            bind("diffuse", &self.diffuse),
            bind("specular", &self.specular),
            bind("lobes", &self.lobes),
            bind("painted", &self.painted),
            bind("coats", &self.coats),
        ]);
        binds
    }

    /// The uniform block of one picture.
    pub(crate) fn scene(&self, gpu: &Gpu, view: Direction, light: Direction, relief: Relief) -> Result<Buffer<Scene>, GpuError> {
        let texels = self.diffuse.len().max(1);
        let lobes = count((self.lobes.len() / texels).min(MAX_LOBES));
        gpu.uniform(
            "scene",
            &self.field.scene(relief).lit(view, light).painted(self.method).in_frame(self.frame, lobes).with_ambient(self.ambient),
        )
    }
}
