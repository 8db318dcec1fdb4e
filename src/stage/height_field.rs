//! A height field on the adapter, and how it is looked at (`kernels/common/height_field.wgsl`).

use super::scalar::single;
use crate::{
    data::Direction,
    gpu::{Bind, Buffer, Resource, bind},
    gpu_struct,
    model::{Boundary, Frame, PaintMethod, Relief},
};

gpu_struct! {
    /// Directions, switches and scalars of one picture.
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
        frame: u32,
        lobes: u32,
        ambient: f32,
        blended: u32,
    }
}

/// Heights and their normals in adapter memory, `[row][column]`.
#[derive(Debug)]
pub struct HeightField {
    /// Columns and rows.
    pub size: [u32; 2],
    /// Texel widths, positive outwards.
    pub heights: Buffer<f32>,
    /// Unit normals of `heights`, fourth component 0.
    pub normals: Buffer<[f32; 4]>,
    /// Lowest and highest of `heights`, or bounds of them: rays are followed between the two.
    pub range: [f32; 2],
    /// What stands beyond the edge.
    pub boundary: Boundary,
}

impl HeightField {
    /// What a pass that imports `height_field` declares.
    pub(crate) fn resources() -> [Resource; 3] {
        [Resource::uniform::<Scene>("scene"), Resource::read::<f32>("heights"), Resource::read::<[f32; 4]>("normals")]
    }

    /// What such a pass binds.
    pub(crate) fn binds<'a>(&'a self, scene: &'a Buffer<Scene>) -> [Bind<'a>; 3] {
        [bind("scene", scene), bind("heights", &self.heights), bind("normals", &self.normals)]
    }

    /// What rays against it need to know, without a view, a light, paint or lobes.
    pub(crate) fn scene(&self, relief: Relief) -> Scene {
        Scene {
            width: self.size[0],
            height: self.size[1],
            boundary: self.boundary.code(),
            displace: relief.displace.into(),
            shadow: relief.shadow.into(),
            lowest: self.range[0],
            highest: self.range[1],
            penumbra: single(relief.penumbra),
            ..Scene::default()
        }
    }
}

impl Scene {
    pub(super) fn lit(self, view: Direction, light: Direction) -> Self {
        let vector = |direction: Direction| direction.vector().as_vec3().extend(0.0).to_array();
        Self { view: vector(view), light: vector(light), ..self }
    }

    pub(super) fn painted(self, method: PaintMethod) -> Self {
        Self { blended: (method == PaintMethod::AlphaBlend).into(), ..self }
    }

    pub(super) fn in_frame(self, frame: Frame, lobes: u32) -> Self {
        Self { frame: frame.code(), lobes, ..self }
    }

    pub(super) fn with_ambient(self, ambient: f64) -> Self {
        Self { ambient: single(ambient), ..self }
    }
}
