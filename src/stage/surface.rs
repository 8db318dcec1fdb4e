//! A material on the adapter, ready to be looked at: what `reconstruct` and the render passes read.

use super::scalar::single;
use crate::{
    data::Direction,
    gpu::{Bind, Buffer, Gpu, GpuError, Resource, bind},
    gpu_struct,
    model::{Boundary, Coat, Relief},
};

gpu_struct! {
    /// Directions, switches and scalars of one picture (`kernels/common/surface.wgsl`).
    pub struct Scene {
        view: [f32; 4],
        light: [f32; 4],
        width: u32,
        height: u32,
        boundary: u32,
        displace: u32,
        shadow: u32,
        lowest: f32,
        highest: f32,
        penumbra: f32,
        f0: f32,
        roughness: f32,
        _pad0: u32,
        _pad1: u32,
    }
}

/// A material's maps in adapter memory, all `[row][column]`.
#[derive(Debug)]
pub struct Surface {
    /// Columns and rows.
    pub size: [u32; 2],
    /// Texel widths, positive outwards, the paint's thickness included.
    pub heights: Buffer<f32>,
    /// Unit normals of `heights`, fourth component 0.
    pub normals: Buffer<[f32; 4]>,
    /// ρ_d of the unpainted material per channel.
    pub diffuse: Buffer<[f32; 4]>,
    /// ρ_s of the unpainted material per channel.
    pub specular: Buffer<[f32; 4]>,
    /// (C_x, C_y, C_z, n) of the unpainted material's lobe, in the base plane's frame.
    pub lobe: Buffer<[f32; 4]>,
    /// Kubelka-Munk reflectance per channel; w is how much of the texel is painted, 0 to 1.
    pub painted: Buffer<[f32; 4]>,
    /// Lowest and highest of `heights`, or bounds of them: rays are followed between the two.
    pub height_range: [f32; 2],
    /// What stands beyond the edge.
    pub boundary: Boundary,
    /// Surface of the paint.
    pub coat: Coat,
}

impl Surface {
    /// What a pass that imports `surface` declares.
    pub(crate) fn resources() -> [Resource; 7] {
        [
            Resource::uniform::<Scene>("scene"),
            Resource::read::<f32>("heights"),
            Resource::read::<[f32; 4]>("normals"),
            Resource::read::<[f32; 4]>("diffuse"),
            Resource::read::<[f32; 4]>("specular"),
            Resource::read::<[f32; 4]>("lobes"),
            Resource::read::<[f32; 4]>("painted"),
        ]
    }

    /// What such a pass binds, `scene` from [`Surface::scene`].
    pub(crate) fn binds<'a>(&'a self, scene: &'a Buffer<Scene>) -> [Bind<'a>; 7] {
        [
            bind("scene", scene),
            bind("heights", &self.heights),
            bind("normals", &self.normals),
            bind("diffuse", &self.diffuse),
            bind("specular", &self.specular),
            bind("lobes", &self.lobe),
            bind("painted", &self.painted),
        ]
    }

    /// The uniform block of one picture.
    pub(crate) fn scene(&self, gpu: &Gpu, view: Direction, light: Direction, relief: Relief) -> Result<Buffer<Scene>, GpuError> {
        let vector = |direction: Direction| direction.vector().as_vec3().extend(0.0).to_array();
        gpu.uniform(
            "scene",
            &Scene {
                view: vector(view),
                light: vector(light),
                width: self.size[0],
                height: self.size[1],
                boundary: self.boundary.code(),
                displace: relief.displace.into(),
                shadow: relief.shadow.into(),
                lowest: self.height_range[0],
                highest: self.height_range[1],
                penumbra: single(relief.penumbra),
                f0: single(self.coat.f0()),
                roughness: single(self.coat.alpha()),
                ..Default::default()
            },
        )
    }
}
