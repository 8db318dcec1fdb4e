//! Local PCA of measured sets on the adapter, beside the textbook's by numpy and BLAS in the same run:
//! `cargo bench --bench lpca -- [SOURCE…]`, of the sample without a source. Needs python3 with numpy and scipy.
//!
//! Both start from radiance in memory, so that no time of decoding counts: the peer from single precision `[texel][value]`, overpaint from
//! halves as a source gives them. Errors are of all samples, the peer's in single precision, overpaint's of the halves that it stores.
//! The first run of a method has the driver compile the kernels.
//!
//! `cargo bench --bench lpca -- scaling`: time of the passes by texels, by clusters and by components, on made data, and which part they reach of the
//! adapter's own rates: of multiply-adds in registers, and of loads in order from a buffer larger than caches.

use std::{env, error::Error, fs, path::Path, process::Command, time::Instant};

use half::f16;
use overpaint::{
    data::{Block, Btf, Direction, Encoding, Grid, Lpca, Pair, Transfer},
    gpu::Gpu,
    io::{self, IoError, Source},
    model::{LpcaMethod, LpcaSettings},
    pipeline::{self, Memory, Progress, StageTable},
};
use rayon::prelude::*;

mod rates;
use rates::Rates;

const SAMPLE: &[u8] = include_bytes!("../src/sample/weave64_51x51.zip");

const ITERATIONS: u32 = 10;

/// The textbook's start is drawn at random, and so is where it ends: ours is compared with the fastest and the best of these.
const SEEDS: [u32; 3] = [1, 2, 3];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let gpu = Gpu::open(env::var("OVERPAINT_ADAPTER").ok().as_deref())?;
    let system = sysinfo::System::new_with_specifics(sysinfo::RefreshKind::nothing().with_cpu(sysinfo::CpuRefreshKind::nothing()));
    let cpu = system.cpus().first().map_or("unknown", |cpu| cpu.brand());
    println!("adapter: {}; CPU: {cpu}, {} cores", gpu.adapter().name, rayon::current_num_threads());
    if arguments.first().is_some_and(|argument| argument == "scaling") {
        return scaling(&gpu);
    }
    if arguments.is_empty() {
        return compare(&gpu, &Held::read(io::open_zip_bytes("weave64_51x51", SAMPLE)?.as_ref())?);
    }
    arguments.iter().try_for_each(|path| compare(&gpu, &Held::read(io::open(Path::new(path))?.as_ref())?))
}

/// A source in memory.
#[derive(Debug)]
struct Held {
    btf: Btf,
    /// `[sample][channel][texel]`
    radiance: Vec<f16>,
}

impl Held {
    fn read(source: &dyn Source) -> Result<Self, IoError> {
        let btf = source.btf().clone();
        let samples: Vec<usize> = (0..btf.pairs().len()).collect();
        let mut radiance = vec![f16::ZERO; 3 * samples.len() * btf.texels()];
        source.read(&samples, Block::whole(btf.size()), &mut radiance, &|_| {})?;
        Ok(Self { btf, radiance })
    }
}

impl Source for Held {
    fn btf(&self) -> &Btf {
        &self.btf
    }

    fn read(&self, samples: &[usize], block: Block, radiance: &mut [f16], done: &(dyn Fn(usize) + Sync)) -> Result<(), IoError> {
        let (texels, width) = (self.btf.texels(), self.btf.size()[0]);
        radiance.par_chunks_exact_mut(3 * block.texels()).zip(samples).for_each(|(values, &sample)| {
            for (channel, values) in values.chunks_exact_mut(block.texels()).enumerate() {
                for (values, row) in values.chunks_exact_mut(block.width).zip(block.rows()) {
                    let from = (3 * sample + channel) * texels + row * width + block.column;
                    values.copy_from_slice(&self.radiance[from..from + block.width]);
                }
            }
            done(1);
        });
        Ok(())
    }

    fn fingerprint(&self) -> String {
        "held".to_owned()
    }
}

/// Seconds and relative RMS error.
#[derive(Debug, Clone, Copy, serde::Deserialize)]
struct Outcome {
    seconds: f64,
    relative_rms: f64,
}

fn compare(gpu: &Gpu, source: &Held) -> Result<(), Box<dyn Error>> {
    let settings = LpcaSettings { iterations: ITERATIONS, ..LpcaSettings::default() };
    let LpcaSettings { clusters, components, .. } = settings;
    let (texels, samples) = (source.btf.texels(), source.btf.pairs().len());
    println!(
        "{}: {texels} texels x {samples} samples, {clusters} clusters of {components} components, {ITERATIONS} iterations",
        source.btf.name()
    );
    println!("  {:<34}{:>9}{:>14}{:>10}{:>10}", "", "seconds", "relative RMS", "x time", "x error");
    let theirs = SEEDS.iter().map(|&seed| textbook(source, &LpcaSettings { seed, ..settings })).collect::<Result<Vec<_>, _>>()?;
    let [fastest, best] = [|one: &Outcome| one.seconds, |one: &Outcome| one.relative_rms]
        .map(|figure| theirs.iter().map(figure).fold(f64::INFINITY, f64::min));
    let row = |what: &str, ours: Outcome| {
        let Outcome { seconds, relative_rms } = ours;
        let (time, error) = (seconds / fastest, relative_rms / best);
        println!("  {what:<34}{seconds:>9.2}{relative_rms:>14.5}{time:>10.3}{error:>10.4}");
    };
    for (seed, outcome) in SEEDS.iter().zip(theirs) {
        row(&format!("numpy and BLAS f32, seed {seed}"), outcome);
    }
    for (method, name) in [(LpcaMethod::Basis, "basis"), (LpcaMethod::Direct, "direct")] {
        let settings = LpcaSettings { method, ..settings };
        let (first, ..) = ours(gpu, source, &settings)?;
        let (second, lpca, table) = ours(gpu, source, &settings)?;
        row(&format!("overpaint, {name}, first run"), first);
        row(&format!("overpaint, {name}, second run"), second);
        println!(
            "    rank {}, {:.4} of the variance left out, {} iterations, {:.1} MB for the adapter, 1/{:.1} of the source",
            lpca.learned.rank,
            lpca.learned.left_out,
            lpca.learned.errors.len(),
            lpca.bytes() as f64 / 1e6,
            lpca.source_bytes() as f64 / lpca.bytes() as f64,
        );
        table.to_string().lines().for_each(|line| println!("    {line}"));
    }
    Ok(())
}

/// One run of overpaint.
fn ours(gpu: &Gpu, source: &dyn Source, settings: &LpcaSettings) -> Result<(Outcome, Lpca, StageTable), Box<dyn Error>> {
    let progress = Progress::new(gpu.adapter());
    let start = Instant::now();
    let lpca = pipeline::lpca(gpu, source, settings, Memory::default(), None, &progress)?;
    let seconds = start.elapsed().as_secs_f64();
    Ok((Outcome { seconds, relative_rms: lpca.learned.relative_rms }, lpca, progress.report()))
}

/// The textbook's method, by way of a file.
fn textbook(source: &Held, settings: &LpcaSettings) -> Result<Outcome, Box<dyn Error>> {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("lpca.f16");
    fs::write(&file, bytemuck::cast_slice(&source.radiance))?;
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers/lpca.py");
    let texels = u32::try_from(source.btf.texels())?;
    let numbers = [texels, settings.clusters, settings.components, settings.iterations, settings.seed].map(|number| number.to_string());
    let output = Command::new("python3").arg(script).arg(&file).args(numbers).output()?;
    fs::remove_file(&file)?;
    if !output.status.success() {
        return Err(format!("the peer failed; it needs python3 with numpy and scipy: {}", String::from_utf8_lossy(&output.stderr)).into());
    }
    Ok(serde_json::from_slice(&output.stdout)?)
}

/// Vectors that made data are spanned by, and clusters that they are drawn from.
const RANK: usize = 24;
const MATERIALS: usize = 40;

/// Texels that are mixtures of [`RANK`] vectors, by weights that gather around those of [`MATERIALS`] materials. Nothing is held.
#[derive(Debug)]
struct Made {
    btf: Btf,
    /// Of each texel.
    weights: Vec<[f32; RANK]>,
}

impl Made {
    /// Every view of a grid's first 27 under as many lights, for a square plane.
    fn new(side: usize) -> Result<Self, Box<dyn Error>> {
        let directions: Vec<Direction> = "thesis51".parse::<Grid>()?.directions().into_iter().take(27).collect();
        let pairs = (0..27).flat_map(|view| (0..27).map(move |light| Pair { view, light })).collect();
        let encoding = Encoding::photograph(Transfer::Linear);
        let btf = Btf::new("made".to_owned(), [side; 2], directions.clone(), directions, pairs, encoding)?;
        let weight = |texel: usize, index: usize| {
            let material = texel * 7919 % MATERIALS;
            // Of falling variance, as measured materials have it.
            (noise(material * RANK + index) + 0.5 * noise((1 << 20) + texel * RANK + index)) / (1.0 + index as f32)
        };
        let weights = (0..side * side).map(|texel| std::array::from_fn(|index| weight(texel, index))).collect();
        Ok(Self { btf, weights })
    }
}

impl Source for Made {
    fn btf(&self) -> &Btf {
        &self.btf
    }

    fn read(&self, samples: &[usize], block: Block, radiance: &mut [f16], done: &(dyn Fn(usize) + Sync)) -> Result<(), IoError> {
        let width = self.btf.size()[0];
        radiance.par_chunks_exact_mut(3 * block.texels()).zip(samples).for_each(|(values, &sample)| {
            for (channel, values) in values.chunks_exact_mut(block.texels()).enumerate() {
                let vector: [f32; RANK] = std::array::from_fn(|index| noise((1 << 40) + (3 * sample + channel) * RANK + index));
                let texels = block.rows().flat_map(|row| block.columns().map(move |column| row * width + column));
                for (value, texel) in values.iter_mut().zip(texels) {
                    let mixed: f32 = self.weights[texel].iter().zip(vector).map(|(weight, vector)| weight * vector).sum();
                    *value = f16::from_f32((0.5 + 0.1 * mixed).max(0.0));
                }
            }
            done(1);
        });
        Ok(())
    }

    fn fingerprint(&self) -> String {
        "made".to_owned()
    }
}

/// A number from -1 to 1 that looks random (Steele, Lea, Flood 2014).
#[expect(clippy::cast_possible_truncation, reason = "single precision is enough for noise")]
fn noise(seed: usize) -> f32 {
    let mut z = (seed as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z >> 11) as f64 / (1_u64 << 52) as f64 - 1.0) as f32
}

/// Where every series starts from.
const SIDE: usize = 128;

fn scaling(gpu: &Gpu) -> Result<(), Box<dyn Error>> {
    let settings = LpcaSettings { iterations: ITERATIONS, ..LpcaSettings::default() };
    let made = Made::new(SIDE)?;
    let rates = Rates::of(gpu)?;
    println!("{:.1} GFLOP/s of multiply-adds, {:.2} GB/s of loads in order", rates.arithmetic / 1e9, rates.loads / 1e9);
    // The first run has the driver compile the kernels.
    ours(gpu, &made, &settings)?;
    for side in [64, 128, 256] {
        measure(gpu, &Made::new(side)?, &settings, &rates)?;
    }
    for clusters in [4, 8, 32, 64] {
        measure(gpu, &made, &LpcaSettings { clusters, ..settings }, &rates)?;
    }
    for components in [2, 4, 16, 32] {
        measure(gpu, &made, &LpcaSettings { components, ..settings }, &rates)?;
    }
    Ok(())
}

/// Operations and bytes of samples and coordinates that one pass of a stage takes for a texel.
fn work(stage: &str, samples: usize, lpca: &Lpca) -> Option<(f64, f64)> {
    let values = (3 * samples.next_multiple_of(8)) as f64;
    let (clusters, rank) = (lpca.clusters as f64, lpca.learned.rank.next_multiple_of(16) as f64);
    let fours = |number: usize| number.next_multiple_of(4) as f64;
    let components = fours(lpca.components);
    match stage {
        "lpca_sketch" => Some((8.0 * values, 2.0 * values)),
        "lpca_project" => Some((2.0 * values * rank, 2.0 * values)),
        "lpca_assign" => Some((2.0 * rank * clusters * (1.0 + components), 4.0 * rank)),
        "lpca_covariance" => Some((rank * rank, 4.0 * rank)),
        "lpca_lift" => Some((2.0 * values * fours(1 + lpca.components), 2.0 * values)),
        "lpca_weights" => Some((4.0 * values * components, 4.0 * values)),
        _ => None,
    }
}

/// Prints the job's time and each stage's: seconds on the wall and on the adapter, how often it went over the plane, the adapter's time for a
/// texel each time, and the part of the adapter's rates that it reaches.
fn measure(gpu: &Gpu, source: &Made, settings: &LpcaSettings, rates: &Rates) -> Result<(), Box<dyn Error>> {
    let (outcome, lpca, table) = ours(gpu, source, settings)?;
    let (texels, samples) = (source.btf.texels(), source.btf.pairs().len());
    println!(
        "\n{texels} texels x {samples} samples, {} clusters of {} components, rank {}, {} iterations: {:.3} s, relative RMS {:.5}",
        settings.clusters,
        settings.components,
        lpca.learned.rank,
        lpca.learned.errors.len(),
        outcome.seconds,
        outcome.relative_rms,
    );
    println!(
        "  {:<24}{:>10}{:>9}{:>12}{:>8}{:>14}{:>12}{:>8}",
        "", "wall s", "share", "adapter s", "passes", "ns a texel", "arithmetic", "loads"
    );
    for stage in &table.stages {
        let passes = stage.texels as f64 / texels as f64;
        let (seconds, each) = stage.gpu_seconds.map_or_else(Default::default, |seconds| {
            (format!("{seconds:.4}"), if stage.texels > 0 { format!("{:.1}", 1e9 * seconds / stage.texels as f64) } else { String::new() })
        });
        let share = 100.0 * table.share(stage);
        let reached =
            work(&stage.name, samples, &lpca).zip(stage.gpu_seconds).map_or_else(Default::default, |((operations, bytes), seconds)| {
                let part = |amount: f64, rate: f64| 100.0 * amount * stage.texels as f64 / seconds / rate;
                format!("{:>10.1} %{:>6.1} %", part(operations, rates.arithmetic), part(bytes, rates.loads))
            });
        println!("  {:<24}{:>10.4}{share:>7.1} %{seconds:>12}{passes:>8.1}{each:>14}{reached}", stage.name, stage.wall_seconds);
    }
    Ok(())
}
