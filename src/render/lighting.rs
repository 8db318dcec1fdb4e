//! Lights on a mesh, with the shadows that it throws on itself (`kernels/common/mesh_shadow.wgsl`). Shader `shadow`; twin
//! [`reference::mesh`](crate::reference::mesh), whose shadows are rays against the triangles.
//!
//! A light's map shows the ball around the mesh; a light inside of it has six, one for each side of a cube. Maps do not depend on the camera:
//! they are drawn once for all pictures under the same lights.

use super::mesh::{MeshBuffers, clip_rows};
use crate::{
    data::{Light, ShadowView},
    gpu::{Bind, Buffer, DepthLayers, Gpu, GpuError, Raster, Recorder, Resource, bind, bind_depth_layers},
    gpu_struct,
    stage::{count, single},
    wgsl,
};

gpu_struct! {
    struct Shadow { clip_x: [f32; 4], clip_y: [f32; 4], clip_z: [f32; 4], clip_w: [f32; 4] }
}
gpu_struct! {
    /// A light and one of its maps, as the shader has it.
    pub struct LightParams {
        place: [f32; 4],
        irradiance: [f32; 4],
        clip_x: [f32; 4],
        clip_y: [f32; 4],
        clip_z: [f32; 4],
        clip_w: [f32; 4],
        layer: u32,
        side: u32,
        shadow_texel: f32,
        bare_only: u32,
    }
}

/// Texels along a side of a shadow map, at most.
const SIDE: u32 = 2048;
/// Bytes that all maps take together, at most; they get coarser where there are many.
const BYTES: u64 = 1 << 27;
/// Lights without a map have this layer, and those that shine all around this side (`mesh_shadow.wgsl`).
const NO_SHADOW: u32 = u32::MAX;
const ALL_AROUND: u32 = 6;

/// Which lights shine on a mesh.
#[derive(Debug, Clone, Copy)]
pub struct Lights<'a> {
    /// Those that shine on all of it.
    pub lights: &'a [Light],
    /// Those that stand for the environment, for the bare part alone: paint mirrors the environment itself.
    pub around: &'a [Light],
    /// Whether the mesh throws shadows.
    pub shadows: bool,
}

/// Lights in adapter memory.
#[derive(Debug)]
pub struct Lighting {
    lights: Buffer<LightParams>,
    count: u32,
    shadows: DepthLayers,
}

/// The pass that draws shadow maps, on one device.
#[derive(Debug)]
pub struct ShadowPass {
    raster: Raster,
}

impl ShadowPass {
    /// Builds the pass.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses it.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let [vertices, corners] = MeshBuffers::resources();
        let resources = [Resource::uniform::<Shadow>("shadow"), vertices, corners];
        Ok(Self { raster: Raster::depth(gpu, &wgsl::SHADOW, wgsl::ALL, &resources)? })
    }

    /// Draws the maps of `lights` on `mesh`.
    ///
    /// # Errors
    /// [`GpuError`] if the maps do not fit the adapter.
    pub fn record(&self, recorder: &mut Recorder<'_>, mesh: &MeshBuffers, lights: Lights<'_>) -> Result<Lighting, GpuError> {
        let gpu = recorder.gpu();
        let all = || lights.lights.iter().zip(std::iter::repeat(false)).chain(lights.around.iter().zip(std::iter::repeat(true)));
        let (center, radius) = mesh.ball();
        let maps: usize = if lights.shadows { all().map(|(light, _)| light.shadow_views(center, radius, 1).len()).sum() } else { 0 };
        let side = side(maps);
        let shadows = DepthLayers::new(gpu, "shadow maps", side, count(maps))?;
        let mut params = Vec::new();
        let mut layer = 0;
        for (light, bare_only) in all() {
            let own = LightParams { bare_only: bare_only.into(), ..LightParams::from(light) };
            if !lights.shadows {
                params.push(own);
                continue;
            }
            for view in light.shadow_views(center, radius, side) {
                let [clip_x, clip_y, clip_z, clip_w] = clip_rows(view.camera.clip_from_world(view.camera.whole()));
                let shadow = gpu.uniform("shadow", &Shadow { clip_x, clip_y, clip_z, clip_w })?;
                let [vertices, corners] = mesh.binds();
                recorder.draw_depth(&self.raster, &[bind("shadow", &shadow), vertices, corners], mesh.drawn(), &shadows, layer);
                let ShadowView { side: through, width, .. } = view;
                let shadow_texel = single(width / f64::from(side));
                let side = through.unwrap_or(ALL_AROUND);
                params.push(LightParams { clip_x, clip_y, clip_z, clip_w, layer: count(layer), side, shadow_texel, ..own });
                layer += 1;
            }
        }
        Ok(Lighting { count: count(params.len()), lights: gpu.upload("lights", &params)?, shadows })
    }
}

/// Texels along a side of each of `maps`: a power of two.
fn side(maps: usize) -> u32 {
    let fits = |side: u32| u64::from(side) * u64::from(side) * 4 * maps as u64 <= BYTES;
    std::iter::successors(Some(SIDE), |side| Some(side / 2)).find(|&side| side <= 64 || fits(side)).unwrap_or(64)
}

impl Lighting {
    /// What a pass that imports `mesh_shadow` declares.
    pub(super) fn resources() -> [Resource; 2] {
        [Resource::read::<LightParams>("lights"), Resource::depth_layers("shadows")]
    }

    /// What it binds.
    pub(super) fn binds(&self) -> [Bind<'_>; 2] {
        [bind("lights", &self.lights), bind_depth_layers("shadows", &self.shadows)]
    }

    /// How many there are, a light with six maps counted as six.
    pub(super) fn count(&self) -> u32 {
        self.count
    }
}

impl From<&Light> for LightParams {
    /// Without a map.
    fn from(light: &Light) -> Self {
        let (place, irradiance) = match *light {
            Light::Directional { toward, irradiance } => (toward.extend(0.0), irradiance),
            Light::Point { place, irradiance } => (place.extend(1.0), irradiance),
        };
        let [r, g, b] = irradiance.map(single);
        let place = place.as_vec4().to_array();
        Self { place, irradiance: [r, g, b, 0.0], layer: NO_SHADOW, side: ALL_AROUND, ..Self::default() }
    }
}
