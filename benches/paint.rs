//! Time to paint a plane of 1024 x 1024 texels with four layers, pass by pass, and the part of the adapter's load rate that stacking the
//! layers reaches: `cargo bench --bench paint`. The best of five runs, of which the first has the driver compile the kernels.

use std::{env, error::Error, time::Instant};

use overpaint::{
    data::Map,
    gpu::{Gpu, GpuError, Recorder},
    model::{Boundary, Layer, Paint, Pattern, Placement, pigments},
    stage::{self, KubelkaMunk, Normals, PaintStack, PatternImage},
};

mod layers;
mod rates;
use layers::LAYERS;
use rates::Rates;

const SIDE: u32 = 1024;
const TEXELS: usize = (SIDE * SIDE) as usize;

fn main() -> Result<(), Box<dyn Error>> {
    let gpu = Gpu::open(env::var("OVERPAINT_ADAPTER").ok().as_deref())?;
    let rates = Rates::of(&gpu)?;
    println!("painting {SIDE} x {SIDE} texels on {}", gpu.adapter().name);
    println!("{:.1} GFLOP/s of multiply-adds, {:.2} GB/s of loads in order", rates.arithmetic / 1e9, rates.loads / 1e9);

    let (pattern, kubelka_munk, normals) = (stage::Pattern::new(&gpu)?, KubelkaMunk::new(&gpu)?, Normals::new(&gpu)?);
    let images = PatternImage::new(&gpu)?;
    let drawn = gpu.fresh("drawn", LAYERS.len() * TEXELS)?;
    let image = Map::from_fn(2048, 2048, |column, row| ((column ^ row) % 256) as f32 / 255.0);

    println!("{:<28}{:>10}", "pass", "ms");
    let others = [Pattern::Uniform { drawn: 1.0 }, Pattern::Stripes { count: 8, width: 0.5 }, Pattern::Noise { seed: 1, count: 8 }];
    for drawing in others.into_iter().chain(LAYERS.map(|(_, pattern)| pattern)) {
        let seconds = best(&gpu, |recorder| pattern.record(recorder, drawing, Placement::default(), [SIDE; 2], &drawn, 0))?;
        println!("{:<28}{:>10.2}", format!("{drawing:?}").split(' ').next().unwrap_or_default().to_lowercase(), 1e3 * seconds);
    }
    let seconds = best(&gpu, |recorder| images.record(recorder, &image, Placement::default(), [SIDE; 2], &drawn, 0))?;
    println!("{:<28}{:>10.2}", "image of 2048 x 2048", 1e3 * seconds);

    let mut recorder = gpu.recorder();
    for (index, (_, drawing)) in LAYERS.into_iter().enumerate() {
        pattern.record(&mut recorder, drawing, Placement::default(), [SIDE; 2], &drawn, index)?;
    }
    gpu.submit(recorder).wait(&gpu)?;
    let layers: Vec<Layer> = LAYERS
        .into_iter()
        .map(|(name, _)| Ok(Layer::new(Paint::from(pigments::find(name)?), 2.0, 1.0)))
        .collect::<Result<_, Box<dyn Error>>>()?;
    for count in 1..=LAYERS.len() {
        let seconds = best(&gpu, |recorder| {
            let ground = gpu.upload("ground", &vec![[0.4, 0.4, 0.4, 0.0]; TEXELS])?;
            let mut stack = PaintStack::new(&gpu, ground, gpu.zeros("coats", TEXELS)?, gpu.zeros("heights", TEXELS)?, count, count)?;
            kubelka_munk.record(recorder, &mut stack, &drawn, &layers[..count])
        })?;
        // Paint, coat and height are read and written, a drawn thickness is read for each layer.
        let bytes = 2 * (size_of::<[f32; 4]>() + size_of::<[f32; 2]>() + size_of::<f32>()) + count * size_of::<f32>();
        let share = 100.0 * (bytes * TEXELS) as f64 / seconds / rates.loads;
        println!(
            "{:<28}{:>10.2}{:>8.2} ms a layer, {share:.0} % of the load rate",
            format!("kubelka_munk, {count} layers"),
            1e3 * seconds,
            1e3 * seconds / count as f64
        );
    }
    let heights = gpu.zeros("heights", TEXELS)?;
    let seconds = best(&gpu, |recorder| normals.record(recorder, &heights, [SIDE; 2], Boundary::Periodic).map(|_| ()))?;
    println!("{:<28}{:>10.2}", "normals", 1e3 * seconds);
    Ok(())
}

/// Seconds that the passes which `record` records take on the adapter, or from submission to the end if it cannot tell.
fn best(gpu: &Gpu, mut record: impl FnMut(&mut Recorder<'_>) -> Result<(), GpuError>) -> Result<f64, GpuError> {
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let mut recorder = gpu.recorder();
        record(&mut recorder)?;
        let start = Instant::now();
        let times = gpu.submit(recorder).wait(gpu)?;
        let wall = start.elapsed().as_secs_f64();
        best = best.min(if times.is_empty() { wall } else { times.iter().map(|pass| pass.gpu.as_secs_f64()).sum() });
    }
    Ok(best)
}
