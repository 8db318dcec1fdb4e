//! A mesh that wears a material. Shader `mesh_hit` finds the point that each pixel sees, and `mesh_svbrdf` or `mesh_lpca`, by what the bare
//! part is made from, shades it; twin [`reference::mesh`](crate::reference::mesh).
//!
//! The mesh is the base plane: rays are followed through the relief from where they cross it, in the frame of tangent, bitangent and normal
//! there. A texel is as wide in the world as the triangle's texture coordinates make it, on the mean of both directions.

use glam::{DMat4, DVec3};

use super::{Lighting, SurroundingsBuffers};
use crate::{
    data::{Camera, Mesh, Sampling, Window},
    gpu::{Bind, Buffer, Gpu, GpuError, Raster, Recorder, Resource, Target, bind, bind_target},
    gpu_struct,
    model::{Relief, TexelSamples},
    stage::{CompressedBtf, HeightField, Scene, Surface, count, single},
    wgsl,
};

gpu_struct! {
    struct CameraParams {
        clip_x: [f32; 4],
        clip_y: [f32; 4],
        clip_z: [f32; 4],
        clip_w: [f32; 4],
        eye: [f32; 4],
        lights: u32,
        output: u32,
        silhouette: u32,
        levels: u32,
        rays: u32,
        footprint: f32,
        sheet: [f32; 2],
        environment: [f32; 4],
    }
}
gpu_struct! {
    /// A vertex, as the shaders have it.
    pub struct Vertex { position: [f32; 3], u: f32, normal: [f32; 3], v: f32, tangent: [f32; 3], handedness: f32 }
}

/// What a picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Output {
    /// R, G, B in reflectance units times coverage, and coverage.
    Radiance,
    /// Unit normal of the surface met, in the world, and distance from the eye's plane (of parallel rays: from that through the origin).
    Geometry,
    /// Coverage of paint, height met in texel widths over the base plane, column and row of the texel met.
    Paint,
}

/// What is shown: a mesh, what it wears, and what shines on it.
#[derive(Debug, Clone, Copy)]
pub struct Shown<'a> {
    /// The mesh.
    pub mesh: &'a MeshBuffers,
    /// The material's maps.
    pub surface: &'a Surface,
    /// What its bare part is made from, if it is the local PCA.
    pub compressed: Option<(&'a CompressedBtf, TexelSamples)>,
    /// Which effects of the height field the picture has.
    pub relief: Relief,
    /// Whether rays that leave the sheet of texture coordinates 0 to 1 see through it.
    pub silhouette: bool,
    /// Lights on this mesh.
    pub lighting: &'a Lighting,
    /// What is around it.
    pub surroundings: &'a SurroundingsBuffers,
    /// How densely the picture samples the material.
    pub sampling: Sampling,
}

/// A mesh in adapter memory.
#[derive(Debug)]
pub struct MeshBuffers {
    pub(super) vertices: Buffer<Vertex>,
    pub(super) corners: Buffer<u32>,
    ball: (DVec3, f64),
    tiling: [f32; 2],
}

impl MeshBuffers {
    /// Uploads `mesh`, whose texture coordinates count `tiling` times.
    ///
    /// # Errors
    /// [`GpuError`] if it does not fit the adapter.
    pub fn upload(gpu: &Gpu, mesh: &Mesh, tiling: [f64; 2]) -> Result<Self, GpuError> {
        let [across, up] = tiling.map(single);
        let vertices: Vec<_> = (0..mesh.positions().len())
            .map(|vertex| {
                let [x, y, z, handedness] = mesh.tangents()[vertex];
                let [u, v] = mesh.texture_coordinates()[vertex];
                Vertex {
                    position: mesh.positions()[vertex],
                    u: u * across,
                    normal: mesh.normals()[vertex],
                    v: v * up,
                    tangent: [x, y, z],
                    handedness,
                }
            })
            .collect();
        let corners = gpu.upload("corners", mesh.triangles().as_flattened())?;
        Ok(Self { vertices: gpu.upload("vertices", &vertices)?, corners, ball: mesh.ball(), tiling: [across, up] })
    }

    /// Center and radius of a ball around the mesh.
    pub(super) fn ball(&self) -> (DVec3, f64) {
        self.ball
    }
}

/// The render passes on one device.
#[derive(Debug)]
pub struct MeshPass {
    hit: Raster,
    svbrdf: Raster,
    lpca: Raster,
}

impl MeshPass {
    /// Builds the passes.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses one.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let base = [Resource::uniform::<CameraParams>("camera"), Resource::read::<Vertex>("vertices"), Resource::read::<u32>("corners")];
        let with = |bare: Vec<Resource>| {
            let mut resources = [Surface::painted_resources(), bare, base.to_vec()].concat();
            resources.extend(Lighting::resources());
            resources.extend(SurroundingsBuffers::resources());
            resources.push(Resource::layers("met"));
            resources
        };
        Ok(Self {
            hit: Raster::new(gpu, &wgsl::MESH_HIT, wgsl::ALL, &[&HeightField::resources()[..], &base].concat())?,
            svbrdf: Raster::new(gpu, &wgsl::MESH_SVBRDF, wgsl::ALL, &with(Surface::bare_resources()))?,
            lpca: Raster::new(gpu, &wgsl::MESH_LPCA, wgsl::ALL, &with(CompressedBtf::resources()))?,
        })
    }

    /// Finds what each pixel of `met`, the part `window` of the camera's picture, sees of `shown`: place and height of the point, in texels,
    /// and its triangle, counted from 1.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    pub fn hit(
        &self, recorder: &mut Recorder<'_>, shown: Shown<'_>, camera: &Camera, window: Window, met: &Target,
    ) -> Result<(), GpuError> {
        let uniforms = Uniforms::new(recorder.gpu(), shown, camera, window, Output::Radiance)?;
        let binds = [&shown.surface.field.binds(&uniforms.scene)[..], &uniforms.binds(shown.mesh)].concat();
        recorder.draw(&self.hit, &binds, count(shown.mesh.corners.len()), 1, met);
        Ok(())
    }

    /// Draws what `output` says of the points `met` into `target`, of the same size; all else as [`Self::hit`] had it.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    pub fn shade(
        &self, recorder: &mut Recorder<'_>, shown: Shown<'_>, camera: &Camera, window: Window, met: &Target, output: Output,
        target: &Target,
    ) -> Result<(), GpuError> {
        let gpu = recorder.gpu();
        let uniforms = Uniforms::new(gpu, shown, camera, window, output)?;
        let mut binds = shown.surface.painted_binds(&uniforms.scene);
        binds.extend(uniforms.binds(shown.mesh));
        binds.extend(shown.lighting.binds());
        binds.extend(shown.surroundings.binds());
        binds.push(bind_target("met", met));
        let vertices = count(shown.mesh.corners.len());
        // The most rays of a pixel, each under all lights.
        let rays = shown.sampling.rays.max(1);
        let cost = (rays * rays * shown.lighting.count().max(1)).div_ceil(4);
        match shown.compressed {
            None => {
                binds.extend(shown.surface.bare_binds());
                recorder.draw(&self.svbrdf, &binds, vertices, cost, target);
            }
            Some((btf, texel_samples)) => {
                let params = btf.params(gpu, texel_samples)?;
                binds.extend::<Vec<Bind<'_>>>(btf.binds(&params));
                recorder.draw(&self.lpca, &binds, vertices, cost, target);
            }
        }
        Ok(())
    }
}

/// What both passes have of a picture.
struct Uniforms {
    scene: Buffer<Scene>,
    camera: Buffer<CameraParams>,
}

impl Uniforms {
    fn new(gpu: &Gpu, shown: Shown<'_>, camera: &Camera, window: Window, output: Output) -> Result<Self, GpuError> {
        let Shown { mesh, surface, sampling, .. } = shown;
        #[expect(clippy::cast_precision_loss, reason = "columns and rows")]
        let texels = surface.field.size.map(|side| side as f32);
        let [clip_x, clip_y, clip_z, clip_w] = clip_rows(camera.clip_from_world(window));
        let params = CameraParams {
            lights: shown.lighting.count(),
            output: output as u32,
            silhouette: shown.silhouette.into(),
            levels: surface.levels,
            rays: sampling.rays.max(1),
            footprint: single(1.0 / f64::from(sampling.pictures.max(1)).sqrt()),
            eye: camera.homogeneous_eye().as_vec4().to_array(),
            clip_x,
            clip_y,
            clip_z,
            clip_w,
            environment: shown.surroundings.params(),
            sheet: [0, 1].map(|axis| mesh.tiling[axis] * texels[axis]),
        };
        Ok(Self { scene: surface.unlit_scene(gpu, shown.relief)?, camera: gpu.uniform("camera", &params)? })
    }

    fn binds<'a>(&'a self, mesh: &'a MeshBuffers) -> [Bind<'a>; 3] {
        [bind("camera", &self.camera), bind("vertices", &mesh.vertices), bind("corners", &mesh.corners)]
    }
}

/// Rows of a matrix.
pub(super) fn clip_rows(clip_from_world: DMat4) -> [[f32; 4]; 4] {
    [0, 1, 2, 3].map(|row| clip_from_world.row(row).as_vec4().to_array())
}
