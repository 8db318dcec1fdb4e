//! Typed buffers in adapter memory.

use std::{marker::PhantomData, ops::Range, sync::mpsc};

use pollster::block_on;

use super::{Gpu, GpuError, GpuValue};

/// An array of `len` values of `T` in adapter memory.
#[derive(Debug)]
pub struct Buffer<T> {
    pub(super) raw: wgpu::Buffer,
    label: String,
    len: usize,
    values: PhantomData<T>,
}

impl<T: GpuValue> Buffer<T> {
    /// Number of values.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a GPU buffer always holds at least one value")]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Name shown in errors and graphics debuggers.
    #[must_use]
    pub fn label(&self) -> &str {
        &self.label
    }

    /// Copies the values back to the host; blocks until the work submitted so far is done.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device stopped, or [`GpuError::OutOfMemory`].
    pub fn read(&self, gpu: &Gpu) -> Result<Vec<T>, GpuError> {
        self.read_range(gpu, 0..self.len)
    }

    /// As [`Self::read`], of a part of the values; their bytes begin at a multiple of 4.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device stopped, or [`GpuError::OutOfMemory`].
    ///
    /// # Panics
    /// If the buffer does not hold all of them: the caller's bug.
    pub fn read_range(&self, gpu: &Gpu, range: Range<usize>) -> Result<Vec<T>, GpuError> {
        assert!(range.start <= range.end && range.end <= self.len, "{}: {range:?} of {} values", self.label, self.len);
        let (first, bytes) = ((range.start * size_of::<T>()) as u64, range.len() * size_of::<T>());
        // Whole words are copied; the buffer has no fewer.
        let words = (bytes as u64).next_multiple_of(4);
        let staging = gpu.allocate("read back", words, wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ, false)?;
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(&self.raw, first, &staging, 0, words);
        gpu.queue.submit([encoder.finish()]);
        let mapped = map(gpu, &staging)?;
        Ok(bytemuck::pod_collect_to_vec(&mapped[..bytes]))
    }

    /// Overwrites the first `values.len()` values.
    ///
    /// # Panics
    /// If there are more values than the buffer holds: the caller's bug.
    pub fn write(&self, gpu: &Gpu, values: &[T]) {
        assert!(values.len() <= self.len, "{}: {} values written into {}", self.label, values.len(), self.len);
        gpu.queue.write_buffer(&self.raw, 0, bytemuck::cast_slice(values));
    }
}

/// Maps a whole staging buffer for reading; blocks.
pub(super) fn map(gpu: &Gpu, staging: &wgpu::Buffer) -> Result<wgpu::BufferView, GpuError> {
    let lost = |reason: String| GpuError::Lost { doing: "reading results back", reason };
    let (sender, receiver) = mpsc::channel();
    staging.map_async(wgpu::MapMode::Read, .., move |result| {
        // The receiver lives until the end of this function; nobody is left to tell if it is gone.
        sender.send(result).ok();
    });
    gpu.wait()?;
    receiver.recv().map_err(|error| lost(error.to_string()))?.map_err(|error| lost(error.to_string()))?;
    staging.get_mapped_range(..).map_err(|error| lost(error.to_string()))
}

impl Gpu {
    /// A buffer with the given values; an empty slice gives one zero, since WebGPU has no empty binding.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] or [`GpuError::OutOfMemory`].
    pub fn upload<T: GpuValue>(&self, label: &str, values: &[T]) -> Result<Buffer<T>, GpuError> {
        let buffer = self.array(label, values.len(), false)?;
        buffer.write(self, values);
        Ok(buffer)
    }

    /// A buffer for a kernel to fill. With debug assertions it starts as NaN bits, so that a value that no thread
    /// wrote shows in a test.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] or [`GpuError::OutOfMemory`].
    pub fn fresh<T: GpuValue>(&self, label: &str, len: usize) -> Result<Buffer<T>, GpuError> {
        self.array(label, len, cfg!(debug_assertions))
    }

    /// A buffer of zeros.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] or [`GpuError::OutOfMemory`].
    pub fn zeros<T: GpuValue>(&self, label: &str, len: usize) -> Result<Buffer<T>, GpuError> {
        // WebGPU defines a new buffer's content as zero.
        self.array(label, len, false)
    }

    /// A uniform block with one parameter struct.
    ///
    /// # Errors
    /// [`GpuError::OutOfMemory`].
    pub fn uniform<T: GpuValue>(&self, label: &str, value: &T) -> Result<Buffer<T>, GpuError> {
        let bytes = size_of::<T>().next_multiple_of(16) as u64;
        let raw = self.allocate(label, bytes, wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST, false)?;
        self.queue.write_buffer(&raw, 0, bytemuck::bytes_of(value));
        Ok(Buffer { raw, label: label.to_owned(), len: 1, values: PhantomData })
    }

    /// A buffer for copies, held to the size of buffers alone; shaders bind it if it is no larger than a binding.
    pub(super) fn transfer<T: GpuValue>(&self, label: &str, len: usize) -> Result<Buffer<T>, GpuError> {
        let bytes = (len.max(1) * size_of::<T>()) as u64;
        let limit = self.adapter().max_buffer;
        if bytes > limit {
            let adapter = self.adapter().name.clone();
            return Err(GpuError::TooLarge { label: label.to_owned(), bytes, adapter, limit, limit_name: "maxBufferSize" });
        }
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
        let raw = self.allocate(label, bytes, usage, false)?;
        Ok(Buffer { raw, label: label.to_owned(), len: len.max(1), values: PhantomData })
    }

    fn array<T: GpuValue>(&self, label: &str, len: usize, poison: bool) -> Result<Buffer<T>, GpuError> {
        let bytes = (len.max(1) * size_of::<T>()) as u64;
        let limit = self.max_array_bytes();
        if bytes > limit {
            let limit_name = if limit == self.adapter().max_buffer { "maxBufferSize" } else { "maxStorageBufferBindingSize" };
            return Err(GpuError::TooLarge { label: label.to_owned(), bytes, adapter: self.adapter().name.clone(), limit, limit_name });
        }
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
        let raw = self.allocate(label, bytes, usage, poison)?;
        Ok(Buffer { raw, label: label.to_owned(), len: len.max(1), values: PhantomData })
    }

    pub(super) fn allocate(&self, label: &str, bytes: u64, usage: wgpu::BufferUsages, poison: bool) -> Result<wgpu::Buffer, GpuError> {
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let raw = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: bytes.next_multiple_of(4),
            usage,
            mapped_at_creation: false,
        });
        if block_on(scope.pop()).is_some() {
            return Err(GpuError::OutOfMemory { label: label.to_owned(), bytes });
        }
        if poison {
            // All bits set: NaN as a float of any width, and out of range as an index.
            const CHUNK: u64 = 1 << 20;
            let ones = vec![0xff_u8; usize::try_from(bytes.min(CHUNK)).unwrap_or_default()];
            for offset in (0..bytes).step_by(ones.len()) {
                let part = usize::try_from((bytes - offset).min(CHUNK)).unwrap_or_default();
                self.queue.write_buffer(&raw, offset, &ones[..part]);
            }
        }
        Ok(raw)
    }
}
