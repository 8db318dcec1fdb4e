//! Recording of passes, with the adapter's own time for each where it has timestamp queries.

use std::time::Duration;

use super::{Bind, Buffer, DepthLayers, Gpu, GpuError, GpuValue, Grid, Kernel, Raster, Target, buffer};

/// Passes in one command buffer. A longer recording goes to the adapter in pieces, so that no single piece looks to a driver's
/// watchdog like an adapter that hangs.
const PASSES_A_PIECE: u32 = 32;

/// Time that one pass took on the adapter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PassTime {
    /// Stem of the kernel's or render pass's file.
    pub pass: &'static str,
    /// Time between the pass's first and last command.
    pub gpu: Duration,
}

/// Commands being recorded. They run, at the latest, when it is submitted.
#[derive(Debug)]
pub struct Recorder<'g> {
    gpu: &'g Gpu,
    encoder: wgpu::CommandEncoder,
    queries: Option<wgpu::QuerySet>,
    passes: Vec<&'static str>,
    pieces: Vec<Piece>,
}

/// A submitted command buffer: its passes and, if they are timed, the buffer that their two time stamps each end up in.
#[derive(Debug)]
struct Piece {
    passes: Vec<&'static str>,
    stamps: Option<wgpu::Buffer>,
}

impl<'g> Recorder<'g> {
    pub(super) fn new(gpu: &'g Gpu) -> Self {
        let encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        Self { gpu, encoder, queries: query_set(gpu), passes: Vec::new(), pieces: Vec::new() }
    }

    /// The device that the commands are for.
    #[must_use]
    pub fn gpu(&self) -> &'g Gpu {
        self.gpu
    }

    /// Makes room for a pass; returns the query set and the index of its first time stamp.
    fn next_pass(&mut self, pass: &'static str) -> Option<(wgpu::QuerySet, u32)> {
        if self.passes.len() >= PASSES_A_PIECE as usize {
            self.submit_piece();
        }
        let first = 2 * u32::try_from(self.passes.len()).unwrap_or(u32::MAX);
        self.passes.push(pass);
        self.queries.clone().map(|set| (set, first))
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
        let query = self.next_pass(kernel.name());
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

    /// Records a draw of `vertices` vertices into a cleared target; a pixel costs `cost` times what four rays do.
    ///
    /// # Panics
    /// If the bindings do not fit the render pass: the host's bug.
    pub fn draw(&mut self, raster: &Raster, binds: &[Bind<'_>], vertices: u32, cost: u32, target: &Target) {
        self.draw_bands(raster, binds, vertices, cost, target, |is_first| {
            let load = if is_first { wgpu::LoadOp::Clear(1.0) } else { wgpu::LoadOp::Load };
            depth_attachment(&target.depth, Some(load))
        });
    }

    /// As [`Self::draw`], in the pixels in which a pass has drawn into `drawn`, a target of the same size; by a pass from
    /// [`Raster::over_drawn`].
    ///
    /// # Panics
    /// If the bindings do not fit the render pass: the host's bug.
    pub fn draw_over(&mut self, raster: &Raster, binds: &[Bind<'_>], cost: u32, drawn: &Target, target: &Target) {
        self.draw_bands(raster, binds, 3, cost, target, |_| depth_attachment(&drawn.depth, None));
    }

    fn draw_bands<'t>(
        &mut self, raster: &Raster, binds: &[Bind<'_>], vertices: u32, cost: u32, target: &'t Target,
        depth: impl Fn(bool) -> wgpu::RenderPassDepthStencilAttachment<'t>,
    ) {
        let group = raster.bindings.group(self.gpu, binds);
        for (index, [top, rows]) in target.bands(cost).enumerate() {
            let query = self.next_pass(raster.name());
            let load = if index == 0 { wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT) } else { wgpu::LoadOp::Load };
            let mut pass = self.encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some(raster.name()),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &target.view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
                })],
                depth_stencil_attachment: Some(depth(index == 0)),
                timestamp_writes: render_stamps(query.as_ref()),
                ..Default::default()
            });
            pass.set_pipeline(&raster.pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.set_scissor_rect(0, top, target.width(), rows);
            pass.draw(0..vertices, 0..1);
            drop(pass);
            // Each band is a piece of its own: one may keep a slow adapter busy for long.
            self.submit_piece();
        }
    }

    /// Records a draw of `vertices` vertices into a cleared layer of depths, by a pass from [`Raster::depth`].
    ///
    /// # Panics
    /// If the bindings do not fit the render pass, or there is no such layer: the host's bug.
    pub fn draw_depth(&mut self, raster: &Raster, binds: &[Bind<'_>], vertices: u32, target: &DepthLayers, layer: usize) {
        let group = raster.bindings.group(self.gpu, binds);
        let query = self.next_pass(raster.name());
        let mut pass = self.encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(raster.name()),
            color_attachments: &[],
            depth_stencil_attachment: Some(depth_attachment(&target.layers[layer], Some(wgpu::LoadOp::Clear(1.0)))),
            timestamp_writes: render_stamps(query.as_ref()),
            ..Default::default()
        });
        pass.set_pipeline(&raster.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..vertices, 0..1);
    }

    /// Records a copy of all values of `from` to the beginning of `to`.
    ///
    /// # Panics
    /// If `to` holds fewer: the caller's bug.
    pub fn copy<T: GpuValue>(&mut self, from: &Buffer<T>, to: &Buffer<T>) {
        assert!(from.len() <= to.len(), "{}: {} values copied into {}", to.label(), from.len(), to.len());
        self.encoder.copy_buffer_to_buffer(&from.raw, 0, &to.raw, 0, (from.len() * size_of::<T>()) as u64);
    }

    pub(super) fn encoder(&mut self) -> &mut wgpu::CommandEncoder {
        &mut self.encoder
    }

    /// Submits what has been recorded since the last piece.
    fn submit_piece(&mut self) {
        let passes = std::mem::take(&mut self.passes);
        let fresh = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut encoder = std::mem::replace(&mut self.encoder, fresh);
        let queries = if passes.is_empty() { None } else { std::mem::replace(&mut self.queries, query_set(self.gpu)) };
        let stamps = queries.and_then(|queries| {
            let count = 2 * u32::try_from(passes.len()).ok()?;
            let bytes = u64::from(count) * u64::from(wgpu::QUERY_SIZE);
            let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
            let resolve = self.gpu.allocate("time stamps", bytes, usage, false).ok()?;
            let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
            let stamps = self.gpu.allocate("time stamps read back", bytes, usage, false).ok()?;
            encoder.resolve_query_set(&queries, 0..count, &resolve, 0);
            encoder.copy_buffer_to_buffer(&resolve, 0, &stamps, 0, bytes);
            Some(stamps)
        });
        self.gpu.queue.submit([encoder.finish()]);
        self.pieces.push(Piece { passes, stamps });
    }

    pub(super) fn submit(mut self) -> Submission {
        self.submit_piece();
        Submission { pieces: self.pieces }
    }
}

/// Depths that are drawn, or, with nothing to load, only compared with.
fn depth_attachment(view: &wgpu::TextureView, load: Option<wgpu::LoadOp<f32>>) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    let depth_ops = load.map(|load| wgpu::Operations { load, store: wgpu::StoreOp::Store });
    wgpu::RenderPassDepthStencilAttachment { view, depth_ops, stencil_ops: None }
}

/// Where a render pass leaves its time stamps, given the first one's index.
fn render_stamps(query: Option<&(wgpu::QuerySet, u32)>) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
    query.map(|(query_set, first)| wgpu::RenderPassTimestampWrites {
        query_set,
        beginning_of_pass_write_index: Some(*first),
        end_of_pass_write_index: Some(first + 1),
    })
}

/// Two time stamps for each pass of a piece, where the adapter has them.
fn query_set(gpu: &Gpu) -> Option<wgpu::QuerySet> {
    gpu.adapter().timestamps.then(|| {
        let count = 2 * PASSES_A_PIECE;
        gpu.device.create_query_set(&wgpu::QuerySetDescriptor { label: None, ty: wgpu::QueryType::Timestamp, count })
    })
}

/// Submitted commands.
#[derive(Debug)]
#[must_use = "wait for it, or drop it by name, so that a lost device is noticed"]
pub struct Submission {
    pieces: Vec<Piece>,
}

impl Submission {
    /// Blocks until the commands have run; returns each pass's time, or none at all if the adapter cannot tell.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device stopped.
    pub fn wait(self, gpu: &Gpu) -> Result<Vec<PassTime>, GpuError> {
        gpu.wait()?;
        let period = f64::from(gpu.queue.get_timestamp_period());
        let mut times = Vec::new();
        for Piece { passes, stamps } in self.pieces.into_iter().filter(|piece| !piece.passes.is_empty()) {
            let Some(stamps) = stamps else { return Ok(Vec::new()) };
            let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&buffer::map(gpu, &stamps)?);
            times.extend(passes.into_iter().zip(ticks.chunks_exact(2)).map(|(pass, ends)| PassTime {
                pass,
                // Drivers may let the counter wrap or step back between passes; such a pass counts as zero.
                #[expect(clippy::cast_precision_loss, reason = "a pass shorter than 2^53 ticks")]
                gpu: Duration::from_secs_f64(ends[1].saturating_sub(ends[0]) as f64 * period * 1e-9),
            }));
        }
        Ok(times)
    }
}
