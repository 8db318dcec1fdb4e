//! What an adapter can do, to compare passes with.

use std::{error::Error, time::Instant};

use overpaint::gpu::{Bind, Gpu, GpuError, Grid, Kernel, Resource, Source, bind};

/// Rates of an adapter, a second.
pub struct Rates {
    /// Operations, two a multiply-add.
    pub arithmetic: f64,
    /// Bytes.
    pub loads: f64,
}

const ARITHMETIC: Source = wgsl(
    "arithmetic",
    "@group(0) @binding(0) var<storage, read_write> values: array<vec4<f32>>;
    @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
        var a = values[id.x];
        var b = a + 1.0;
        var c = a + 2.0;
        var d = a + 3.0;
        let x = a * 0.5;
        for (var i = 0u; i < 4096u; i++) {
            a = fma(a, x, x);
            b = fma(b, x, x);
            c = fma(c, x, x);
            d = fma(d, x, x);
        }
        values[id.x] = a + b + c + d;
    }",
);

const LOADS: Source = wgsl(
    "loads",
    "@group(0) @binding(0) var<storage, read> values: array<vec4<u32>>;
    @group(0) @binding(1) var<storage, read_write> sums: array<vec4<u32>>;
    @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
        var sum = vec4(0u);
        for (var i = 0u; i < 64u; i++) {
            sum += values[i * 65536u + id.x];
        }
        sums[id.x] = sum;
    }",
);

const fn wgsl(name: &'static str, text: &'static str) -> Source {
    Source { name, path: name, text }
}

impl Rates {
    const THREADS: usize = 1 << 16;

    /// Those of `gpu`, measured: multiply-adds in registers, loads in order from a buffer larger than caches.
    pub fn of(gpu: &Gpu) -> Result<Self, Box<dyn Error>> {
        let arithmetic = Kernel::new(gpu, &ARITHMETIC, &[], &[Resource::read_write::<[f32; 4]>("values")])?;
        let loads = Kernel::new(gpu, &LOADS, &[], &[Resource::read::<[u32; 4]>("values"), Resource::read_write::<[u32; 4]>("sums")])?;
        let values = gpu.upload("values", &vec![[0.5_f32; 4]; Self::THREADS])?;
        let (many, sums) = (gpu.zeros::<[u32; 4]>("many values", 64 * Self::THREADS)?, gpu.fresh::<[u32; 4]>("sums", Self::THREADS)?);
        // The best of three: the first has the driver compile.
        let best = |kernel: &Kernel, binds: &[Bind<'_>]| {
            let runs = (0..3).map(|_| {
                let start = Instant::now();
                let mut recorder = gpu.recorder();
                recorder.dispatch(kernel, binds, Grid::threads(Self::THREADS))?;
                gpu.submit(recorder).wait(gpu)?;
                Ok::<_, GpuError>(start.elapsed().as_secs_f64())
            });
            runs.collect::<Result<Vec<_>, _>>().map(|seconds| seconds.into_iter().fold(f64::INFINITY, f64::min))
        };
        let threads = Self::THREADS as f64;
        Ok(Self {
            arithmetic: threads * 4096.0 * 4.0 * 4.0 * 2.0 / best(&arithmetic, &[bind("values", &values)])?,
            loads: threads * 64.0 * 16.0 / best(&loads, &[bind("values", &many), bind("sums", &sums)])?,
        })
    }
}
