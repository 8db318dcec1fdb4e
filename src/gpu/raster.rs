//! Render passes: a vertex and a fragment stage over the same named buffers that kernels use.

use pollster::block_on;

use super::{
    Buffer, Gpu, GpuError, Recorder, Resource, Source, kernel,
    texture::{self, DEPTH},
};

/// Format of every target: linear light, 32-bit float, premultiplied coverage in alpha.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// Pixels drawn at once: with four rays a pixel and a thousand steps a ray, each of some tens of operations, a twentieth of a second
/// at 1 TFLOP/s.
const BAND_PIXELS: u32 = 1 << 18;

/// What a pass draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Draws {
    /// Triangles, the nearest of them.
    Nearest,
    /// Their depth alone.
    Depth,
    /// Every pixel once in which another pass has drawn.
    Drawn,
}

/// A render pass, ready to draw.
#[derive(Debug, Clone)]
pub struct Raster {
    pub(super) bindings: kernel::Bindings,
    pub(super) pipeline: wgpu::RenderPipeline,
}

impl Raster {
    /// Builds `source` (entry points `vertex` and `fragment`), joined with what it imports from `library`, after
    /// checking `resources` against it. Vertices come from their index alone. It draws into a [`Target`].
    ///
    /// # Errors
    /// [`GpuError::Link`], [`GpuError::Shader`] or [`GpuError::Interface`].
    pub fn new(gpu: &Gpu, source: &Source, library: &[Source], resources: &[Resource]) -> Result<Self, GpuError> {
        Self::of(gpu, source, library, resources, Draws::Nearest)
    }

    /// As [`Self::new`], for each pixel in which another pass has drawn: the vertex stage covers the target by one triangle at the far plane.
    /// A test against the other pass's depths spares the adapter the rest.
    ///
    /// # Errors
    /// [`GpuError::Link`], [`GpuError::Shader`] or [`GpuError::Interface`].
    pub fn over_drawn(gpu: &Gpu, source: &Source, library: &[Source], resources: &[Resource]) -> Result<Self, GpuError> {
        Self::of(gpu, source, library, resources, Draws::Drawn)
    }

    /// As [`Self::new`], without a fragment stage: it draws the depth alone, into a layer of [`DepthLayers`](super::DepthLayers).
    ///
    /// # Errors
    /// [`GpuError::Link`], [`GpuError::Shader`] or [`GpuError::Interface`].
    pub fn depth(gpu: &Gpu, source: &Source, library: &[Source], resources: &[Resource]) -> Result<Self, GpuError> {
        Self::of(gpu, source, library, resources, Draws::Depth)
    }

    fn of(gpu: &Gpu, source: &Source, library: &[Source], resources: &[Resource], draws: Draws) -> Result<Self, GpuError> {
        let raster = gpu.rasters.get_or_build((draws, source.link(library)?), |(_, text)| Self::build(gpu, source, text, draws))?;
        raster.bindings.check(resources)?;
        Ok(raster)
    }

    fn build(gpu: &Gpu, source: &Source, text: &str, draws: Draws) -> Result<Self, GpuError> {
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let (bindings, _, module, layout) = kernel::build(gpu, source, text)?;
        let targets = [Some(FORMAT.into())];
        let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(source.name),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(draws != Draws::Drawn),
                depth_compare: Some(if draws == Draws::Drawn { wgpu::CompareFunction::Greater } else { wgpu::CompareFunction::Less }),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: (draws != Draws::Depth).then(|| wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        });
        if let Some(error) = block_on(scope.pop()) {
            return Err(GpuError::Shader { name: source.name.to_owned(), message: error.to_string() });
        }
        Ok(Self { bindings, pipeline })
    }

    /// Stem of the pass's file, by which it is timed.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.bindings.name
    }
}

/// A picture to draw into: `[height][width]` RGBA, linear, 32-bit float. Later passes read it as a `texture_2d_array<f32>` of one layer.
#[derive(Debug)]
pub struct Target {
    texture: wgpu::Texture,
    pub(super) view: wgpu::TextureView,
    pub(super) layers: wgpu::TextureView,
    pub(super) depth: wgpu::TextureView,
    width: u32,
    height: u32,
}

impl Target {
    /// A target of `width` x `height` pixels.
    ///
    /// # Errors
    /// [`GpuError::PictureSize`] if it is empty or past the adapter's texture size, or [`GpuError::OutOfMemory`].
    pub fn new(gpu: &Gpu, width: u32, height: u32) -> Result<Self, GpuError> {
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let depth = texture::allocate(gpu, "depth", [width, height, 1], DEPTH, attachment)?;
        let usage = attachment | wgpu::TextureUsages::COPY_SRC | wgpu::TextureUsages::TEXTURE_BINDING;
        let texture = texture::allocate(gpu, "picture", [width, height, 1], FORMAT, usage)?;
        let [view, depth] = [&texture, &depth].map(|texture| texture.create_view(&wgpu::TextureViewDescriptor::default()));
        Ok(Self { layers: texture::all_layers(&texture), texture, view, depth, width, height })
    }

    /// Records a copy of the picture into a buffer `[height][row_pixels]`, rows padded as WebGPU asks; see [`Target::unpad`].
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] or [`GpuError::OutOfMemory`].
    pub fn record_copy(&self, recorder: &mut Recorder<'_>) -> Result<Buffer<[f32; 4]>, GpuError> {
        let pixels = recorder.gpu().transfer::<[f32; 4]>("picture read back", self.row_pixels() * self.height as usize)?;
        recorder.encoder().copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &pixels.raw,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: u32::try_from(self.row_pixels() * 16).ok(),
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d { width: self.width, height: self.height, depth_or_array_layers: 1 },
        );
        Ok(pixels)
    }

    /// Drops the padding of the rows: `[height][width]`.
    #[must_use]
    pub fn unpad(&self, padded: &[[f32; 4]]) -> Vec<[f32; 4]> {
        padded.chunks_exact(self.row_pixels()).flat_map(|row| &row[..self.width as usize]).copied().collect()
    }

    pub(super) fn width(&self) -> u32 {
        self.width
    }

    /// [first row, rows] of the bands that are drawn one by one, of a pass `cost` times as dear as one with four rays a pixel.
    pub(super) fn bands(&self, cost: u32) -> impl Iterator<Item = [u32; 2]> + use<> {
        let (height, rows) = (self.height, (BAND_PIXELS / cost.max(1) / self.width).max(1));
        (0..height).step_by(rows as usize).map(move |top| [top, rows.min(height - top)])
    }

    /// Pixels of a padded row of the copy.
    #[must_use]
    pub fn row_pixels(&self) -> usize {
        (self.width as usize).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT as usize / 16)
    }
}
