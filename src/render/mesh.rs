//! A mesh that wears a material. Shader `mesh_hit` finds the point that each pixel sees, and `mesh_svbrdf` or `mesh_lpca`, by what the bare
//! part is made from, shades it; twin [`reference::mesh`](crate::reference::mesh).
//!
//! The mesh is the base plane: rays are followed through the relief from where they cross it, in the frame of tangent, bitangent and normal
//! there. A texel is as wide in the world as the triangle's texture coordinates make it, on the mean of both directions. Of a closed mesh
//! seen from outside, outer sides alone are drawn: at grazing angles inner ones could stand before the depths of the relief.
//!
//! Shading takes most of the time and so is done last, once a pixel: as triangles are drawn it would also be done for what turns out hidden,
//! since depths come from the relief, and for the neighbours of the pixels at their edges.

use glam::{DMat4, DVec3};

use super::{Lighting, SurroundingsBuffers};
use crate::{
    data::{Camera, Mesh, Sampling, Window},
    gpu::{Bind, Buffer, Gpu, GpuError, Layers, Raster, Recorder, Resource, Target, bind, bind_layers, bind_target},
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
        size: [f32; 2],
        outer_only: u32,
        _pad: u32,
        environment: [f32; 4],
    }
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
    /// Positions and u, normals and v, tangents and handedness.
    vertices: Layers,
    corners: Layers,
    triangles: u32,
    ball: (DVec3, f64),
    is_closed: bool,
    tiling: [f32; 2],
}

impl MeshBuffers {
    /// Uploads `mesh`, whose texture coordinates count `tiling` times.
    ///
    /// # Errors
    /// [`GpuError`] if it does not fit the adapter.
    pub fn upload(gpu: &Gpu, mesh: &Mesh, tiling: [f64; 2]) -> Result<Self, GpuError> {
        let [across, up] = tiling.map(single);
        let with = |[x, y, z]: [f32; 3], w: f32| [x, y, z, w];
        let coordinates = mesh.texture_coordinates();
        let positions = mesh.positions().iter().zip(coordinates).map(|(&position, [u, _])| with(position, u * across));
        let normals = mesh.normals().iter().zip(coordinates).map(|(&normal, [_, v])| with(normal, v * up));
        let vertices = [positions.collect(), normals.collect(), mesh.tangents().to_vec()];
        #[expect(clippy::cast_precision_loss, reason = "fewer than 2^24")]
        let corners = mesh.triangles().iter().map(|&corners| with(corners.map(|corner| corner as f32), 0.0)).collect();
        Ok(Self {
            vertices: Layers::upload(gpu, "vertices", vertices)?,
            corners: Layers::upload(gpu, "corners", [corners])?,
            triangles: count(mesh.triangles().len()),
            ball: mesh.ball(),
            is_closed: mesh.is_closed(),
            tiling: [across, up],
        })
    }

    /// What a pass that imports `mesh_vertices` declares.
    pub(super) fn resources() -> [Resource; 2] {
        [Resource::layers("vertices"), Resource::layers("corners")]
    }

    /// What it binds.
    pub(super) fn binds(&self) -> [Bind<'_>; 2] {
        [bind_layers("vertices", &self.vertices), bind_layers("corners", &self.corners)]
    }

    /// Vertices that draw it.
    pub(super) fn drawn(&self) -> u32 {
        3 * self.triangles
    }

    /// Center and radius of a ball around the mesh.
    pub(super) fn ball(&self) -> (DVec3, f64) {
        self.ball
    }
}

/// What is drawn into: all of a picture, or a part.
#[derive(Debug)]
pub struct MeshTarget {
    /// Of each pixel the place and height of the point it sees, in texels, and the triangle, counted from 1.
    met: Target,
    /// What it shows.
    pub picture: Target,
}

impl MeshTarget {
    /// One of these columns and rows.
    ///
    /// # Errors
    /// [`GpuError::PictureSize`] if it is empty or past the adapter's texture size, or [`GpuError::OutOfMemory`].
    pub fn new(gpu: &Gpu, [width, height]: [u32; 2]) -> Result<Self, GpuError> {
        Ok(Self { met: Target::new(gpu, width, height)?, picture: Target::new(gpu, width, height)? })
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
        let [vertices, corners] = MeshBuffers::resources();
        let base = [Resource::uniform::<CameraParams>("camera"), vertices, corners];
        let with = |bare: Vec<Resource>| {
            let mut resources = [Surface::painted_resources(), bare, base.to_vec()].concat();
            resources.extend(Lighting::resources());
            resources.extend(SurroundingsBuffers::resources());
            resources.push(Resource::layers("met"));
            resources
        };
        Ok(Self {
            hit: Raster::new(gpu, &wgsl::MESH_HIT, wgsl::ALL, &[&HeightField::resources()[..], &base].concat())?,
            svbrdf: Raster::over_drawn(gpu, &wgsl::MESH_SVBRDF, wgsl::ALL, &with(Surface::bare_resources()))?,
            lpca: Raster::over_drawn(gpu, &wgsl::MESH_LPCA, wgsl::ALL, &with(CompressedBtf::resources()))?,
        })
    }

    /// Finds what each pixel of `target`, the part `window` of the camera's picture, sees of `shown`.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    pub fn hit(
        &self, recorder: &mut Recorder<'_>, shown: Shown<'_>, camera: &Camera, window: Window, target: &MeshTarget,
    ) -> Result<(), GpuError> {
        let uniforms = Uniforms::new(recorder.gpu(), shown, camera, window, Output::Radiance)?;
        let binds = [&shown.surface.field.binds(&uniforms.scene)[..], &uniforms.binds(shown.mesh)].concat();
        recorder.draw(&self.hit, &binds, shown.mesh.drawn(), 1, &target.met);
        Ok(())
    }

    /// Draws what `output` says of the points that [`Self::hit`] has found, given the same `shown`, `camera`, `window` and `target`.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    pub fn shade(
        &self, recorder: &mut Recorder<'_>, shown: Shown<'_>, camera: &Camera, window: Window, output: Output, target: &MeshTarget,
    ) -> Result<(), GpuError> {
        let MeshTarget { met, picture } = target;
        let gpu = recorder.gpu();
        let uniforms = Uniforms::new(gpu, shown, camera, window, output)?;
        let mut binds = shown.surface.painted_binds(&uniforms.scene);
        binds.extend(uniforms.binds(shown.mesh));
        binds.extend(shown.lighting.binds());
        binds.extend(shown.surroundings.binds());
        binds.push(bind_target("met", met));
        // The most rays of a pixel, each under all lights.
        let rays = shown.sampling.rays.max(1);
        let cost = (rays * rays * shown.lighting.count().max(1)).div_ceil(4);
        match shown.compressed {
            None => {
                binds.extend(shown.surface.bare_binds());
                recorder.draw_over(&self.svbrdf, &binds, cost, met, picture);
            }
            Some((btf, texel_samples)) => {
                let params = btf.params(gpu, texel_samples)?;
                binds.extend::<Vec<Bind<'_>>>(btf.binds(&params));
                recorder.draw_over(&self.lpca, &binds, cost, met, picture);
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
            size: window.size.map(single),
            // What is seen through a relief has inner sides.
            outer_only: (!shown.silhouette && mesh.is_closed && camera.is_before(mesh.ball)).into(),
            ..Default::default()
        };
        Ok(Self { scene: surface.unlit_scene(gpu, shown.relief)?, camera: gpu.uniform("camera", &params)? })
    }

    fn binds<'a>(&'a self, mesh: &'a MeshBuffers) -> [Bind<'a>; 3] {
        let [vertices, corners] = mesh.binds();
        [bind("camera", &self.camera), vertices, corners]
    }
}

/// Rows of a matrix.
pub(super) fn clip_rows(clip_from_world: DMat4) -> [[f32; 4]; 4] {
    [0, 1, 2, 3].map(|row| clip_from_world.row(row).as_vec4().to_array())
}
