//! Arrays that shaders read as textures, texel by texel: they do not count among the eight storage buffers of a stage, and what is read is
//! what was written, without a sampler's arithmetic.

use pollster::block_on;

use super::{Buffer, Gpu, GpuError, Recorder};

/// Format of a depth, 0 at the near plane and 1 at the far one.
pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Pictures of one size, `[layer][row][column]` RGBA in 32-bit floats: `texture_2d_array<f32>` in a shader.
#[derive(Debug)]
pub struct Layers {
    pub(super) view: wgpu::TextureView,
}

impl Layers {
    /// Columns of arrays longer than that; with WebGPU's 8192 rows they hold 2^25 values.
    const LONG: usize = 4096;

    /// Uploads arrays of one length, a layer each: value `i` is in column `i % width` of row `i / width`.
    ///
    /// # Errors
    /// [`GpuError::PictureSize`] if they are longer than the adapter's textures are large, or [`GpuError::OutOfMemory`].
    ///
    /// # Panics
    /// If their lengths differ: the caller's bug.
    pub fn upload<const N: usize>(gpu: &Gpu, label: &str, layers: [Vec<[f32; 4]>; N]) -> Result<Self, GpuError> {
        let values = layers.first().map_or(0, Vec::len);
        let width = values.clamp(1, Self::LONG);
        let height = values.div_ceil(width).max(1);
        let to_u32 = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
        let [columns, rows, count] = [width, height, layers.len()].map(to_u32);
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
        let texture = allocate(gpu, label, [columns, rows, count], wgpu::TextureFormat::Rgba32Float, usage)?;
        for (layer, mut padded) in (0..count).zip(layers) {
            assert_eq!(padded.len(), values, "{label}: values of layer {layer}");
            padded.resize(width * height, [0.0; 4]);
            gpu.queue.write_texture(
                wgpu::TexelCopyTextureInfo { origin: wgpu::Origin3d { x: 0, y: 0, z: layer }, ..texture.as_image_copy() },
                bytemuck::cast_slice(&padded),
                wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(columns * 16), rows_per_image: Some(rows) },
                wgpu::Extent3d { width: columns, height: rows, depth_or_array_layers: 1 },
            );
        }
        Ok(Self { view: all_layers(&texture) })
    }

    /// Columns are a multiple of this, since rows are copied whole.
    pub const COLUMNS: u32 = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT / 16;

    /// Records a copy of `values`, `layers` pictures of `width` x `height`.
    ///
    /// # Errors
    /// [`GpuError::PictureSize`] if a side is past the adapter's, or [`GpuError::OutOfMemory`].
    ///
    /// # Panics
    /// If there are fewer values, or `width` is no multiple of [`Self::COLUMNS`]: the caller's bug.
    pub fn record(
        recorder: &mut Recorder<'_>, label: &str, values: &Buffer<[f32; 4]>, [width, height, layers]: [u32; 3],
    ) -> Result<Self, GpuError> {
        assert!(width.is_multiple_of(Self::COLUMNS), "{label}: {width} columns");
        assert!(values.len() as u64 >= u64::from(width) * u64::from(height) * u64::from(layers), "{label}: {} values", values.len());
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
        let texture = allocate(recorder.gpu(), label, [width, height, layers], wgpu::TextureFormat::Rgba32Float, usage)?;
        recorder.encoder().copy_buffer_to_texture(
            wgpu::TexelCopyBufferInfo {
                buffer: &values.raw,
                layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(width * 16), rows_per_image: Some(height) },
            },
            texture.as_image_copy(),
            texture.size(),
        );
        Ok(Self { view: all_layers(&texture) })
    }
}

/// Depths of one size, `[layer][row][column]`, drawn by passes: `texture_depth_2d_array` in a shader.
#[derive(Debug)]
pub struct DepthLayers {
    pub(super) view: wgpu::TextureView,
    /// Of each layer, to draw into.
    pub(super) layers: Vec<wgpu::TextureView>,
    side: u32,
}

impl DepthLayers {
    /// `layers` squares of `side`, at least one.
    ///
    /// # Errors
    /// [`GpuError::PictureSize`] if they are larger, or more, than the adapter has them, or [`GpuError::OutOfMemory`].
    pub fn new(gpu: &Gpu, label: &str, side: u32, layers: u32) -> Result<Self, GpuError> {
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::RENDER_ATTACHMENT;
        let texture = allocate(gpu, label, [side, side, layers.max(1)], DEPTH, usage)?;
        let layer = |index| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2),
                base_array_layer: index,
                array_layer_count: Some(1),
                ..Default::default()
            })
        };
        Ok(Self { view: all_layers(&texture), layers: (0..layers.max(1)).map(layer).collect(), side })
    }

    /// Columns and rows of a layer.
    #[must_use]
    pub fn side(&self) -> u32 {
        self.side
    }
}

pub(super) fn all_layers(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor { dimension: Some(wgpu::TextureViewDimension::D2Array), ..Default::default() })
}

/// A texture of one level and one sample, within the adapter's limits.
pub(super) fn allocate(
    gpu: &Gpu, label: &str, [width, height, layers]: [u32; 3], format: wgpu::TextureFormat, usage: wgpu::TextureUsages,
) -> Result<wgpu::Texture, GpuError> {
    let limits = gpu.device.limits();
    let limit = limits.max_texture_dimension_2d;
    if !(1..=limit).contains(&width) || !(1..=limit).contains(&height) || layers > limits.max_texture_array_layers {
        return Err(GpuError::PictureSize { width, height, adapter: gpu.adapter().name.clone(), limit });
    }
    let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: layers },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    });
    if block_on(scope.pop()).is_some() {
        let bytes = u64::from(width) * u64::from(height) * u64::from(layers) * u64::from(format.block_copy_size(None).unwrap_or(4));
        return Err(GpuError::OutOfMemory { label: label.to_owned(), bytes });
    }
    Ok(texture)
}
