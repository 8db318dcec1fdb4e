//! Recording of passes, with the adapter's own time for each where it has timestamp queries.

use std::time::Duration;

use super::{Bind, Gpu, GpuError, Grid, Kernel, Raster, Target, buffer};

/// Queries in a set; WebGPU guarantees 4096, two a pass.
const MAX_QUERIES: u32 = 4096;

/// Time that one pass took on the adapter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PassTime {
    /// Stem of the kernel's or render pass's file.
    pub pass: &'static str,
    /// Time between the pass's first and last command.
    pub gpu: Duration,
}

/// Commands being recorded. Nothing runs before it is submitted.
#[derive(Debug)]
pub struct Recorder<'g> {
    gpu: &'g Gpu,
    encoder: wgpu::CommandEncoder,
    queries: Option<wgpu::QuerySet>,
    passes: Vec<&'static str>,
}

impl<'g> Recorder<'g> {
    pub(super) fn new(gpu: &'g Gpu) -> Self {
        let queries = gpu.adapter().timestamps.then(|| {
            gpu.device.create_query_set(&wgpu::QuerySetDescriptor { label: None, ty: wgpu::QueryType::Timestamp, count: MAX_QUERIES })
        });
        let encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        Self { gpu, encoder, queries, passes: Vec::new() }
    }

    /// The device that the commands are for.
    #[must_use]
    pub fn gpu(&self) -> &'g Gpu {
        self.gpu
    }

    /// The query set and first index for the next pass; none once the set is full.
    fn next_query(&mut self, pass: &'static str) -> Option<(&wgpu::QuerySet, u32)> {
        let first = u32::try_from(self.passes.len()).unwrap_or(u32::MAX).saturating_mul(2);
        let set = self.queries.as_ref().filter(|_| first < MAX_QUERIES)?;
        self.passes.push(pass);
        Some((set, first))
    }

    /// Records one dispatch.
    ///
    /// # Errors
    /// [`GpuError::GridTooLarge`].
    ///
    /// # Panics
    /// If the bindings do not fit the kernel: the host's bug.
    pub fn dispatch(&mut self, kernel: &Kernel, binds: &[Bind<'_>], grid: Grid) -> Result<(), GpuError> {
        let [x, y, z] = kernel.groups(grid)?;
        let group = kernel.bindings.group(self.gpu, binds);
        let query = self.next_query(kernel.name()).map(|(set, first)| (set.clone(), first));
        let mut pass = self.encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(kernel.name()),
            timestamp_writes: query.as_ref().map(|(query_set, first)| wgpu::ComputePassTimestampWrites {
                query_set,
                beginning_of_pass_write_index: Some(*first),
                end_of_pass_write_index: Some(first + 1),
            }),
        });
        pass.set_pipeline(&kernel.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(x, y, z);
        Ok(())
    }

    /// Records a draw of `vertices` vertices into a cleared target.
    ///
    /// # Panics
    /// If the bindings do not fit the render pass: the host's bug.
    pub fn draw(&mut self, raster: &Raster, binds: &[Bind<'_>], vertices: u32, target: &Target) {
        let group = raster.bindings.group(self.gpu, binds);
        let query = self.next_query(raster.name()).map(|(set, first)| (set.clone(), first));
        let mut pass = self.encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(raster.name()),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target.view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
            })],
            timestamp_writes: query.as_ref().map(|(query_set, first)| wgpu::RenderPassTimestampWrites {
                query_set,
                beginning_of_pass_write_index: Some(*first),
                end_of_pass_write_index: Some(first + 1),
            }),
            ..Default::default()
        });
        pass.set_pipeline(&raster.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..vertices, 0..1);
    }

    pub(super) fn encoder(&mut self) -> &mut wgpu::CommandEncoder {
        &mut self.encoder
    }

    pub(super) fn submit(mut self) -> Submission {
        let count = u32::try_from(self.passes.len()).unwrap_or(u32::MAX).saturating_mul(2);
        let resolved = self.queries.as_ref().filter(|_| count > 0).and_then(|queries| {
            let bytes = u64::from(count) * u64::from(wgpu::QUERY_SIZE);
            let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
            let resolve = self.gpu.allocate("timestamps", bytes, usage, false).ok()?;
            let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
            let staging = self.gpu.allocate("timestamps read back", bytes, usage, false).ok()?;
            self.encoder.resolve_query_set(queries, 0..count, &resolve, 0);
            self.encoder.copy_buffer_to_buffer(&resolve, 0, &staging, 0, bytes);
            Some(staging)
        });
        self.gpu.queue.submit([self.encoder.finish()]);
        Submission { resolved, passes: self.passes }
    }
}

/// Submitted commands.
#[derive(Debug)]
#[must_use = "wait for it, or drop it by name, so that a lost device is noticed"]
pub struct Submission {
    resolved: Option<wgpu::Buffer>,
    passes: Vec<&'static str>,
}

impl Submission {
    /// Blocks until the commands have run; returns each pass's time, or none if the adapter cannot tell.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device stopped.
    pub fn wait(self, gpu: &Gpu) -> Result<Vec<PassTime>, GpuError> {
        let Some(staging) = self.resolved else {
            gpu.wait()?;
            return Ok(Vec::new());
        };
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&buffer::map(gpu, &staging)?);
        let period = f64::from(gpu.queue.get_timestamp_period());
        let times = self.passes.into_iter().zip(ticks.chunks_exact(2)).map(|(pass, ends)| PassTime {
            pass,
            // Drivers may let the counter wrap or step back between passes; such a pass counts as zero.
            #[expect(clippy::cast_precision_loss, reason = "a pass shorter than 2^53 ticks")]
            gpu: Duration::from_secs_f64(ends[1].saturating_sub(ends[0]) as f64 * period * 1e-9),
        });
        Ok(times.collect())
    }
}
