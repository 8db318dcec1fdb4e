//! `overpaint compare`.

use std::{fmt::Write, path::PathBuf};

use clap::Args;

use super::{
    CliError, arguments,
    memory::{AdapterMemoryArguments, MemoryArguments},
    model::{Model, misplaced},
    output,
    reading::ReadingArguments,
    say,
    session::SessionArguments,
};
use crate::{
    io,
    model::{Appearance, Relief, TexelSamples},
    pipeline::{self, AtElevation, CompareSettings, Comparison},
};

/// Show how well a material reconstructs the source it was recovered from, over all pairs of a view and a light.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  overpaint compare cloth.zip cloth.zarr -o cloth-compared
  overpaint compare cloth.zip cloth.zarr --model lpca -o cloth-compressed
  overpaint compare cloth.zip corner.zarr -o corner-compared --region 0,0,64x64 --texel 20,31

DIR gets compare.html, its plot and pictures, and all figures as compare.json.")]
pub struct Compare {
    /// The BTF: what `fit` takes
    source: PathBuf,
    /// The material that `fit` made of it
    material: PathBuf,
    /// Folder for compare.html, compare.json and the pictures
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// What the reconstructions are made from
    #[arg(long, value_name = "MODEL", value_enum, default_value_t = Model::Svbrdf)]
    model: Model,
    /// Reconstruct as if the material were flat: no displacement, no shadows
    #[arg(long)]
    no_relief: bool,
    /// Show the measurement of this texel, column and row from the upper left, and each step of its fit
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, value_parser = arguments::texel)]
    texel: Option<[usize; 2]>,
    #[command(flatten)]
    memory: MemoryArguments,
    #[command(flatten)]
    adapter_memory: AdapterMemoryArguments,
    #[command(flatten)]
    reading: ReadingArguments,
}

impl Compare {
    pub fn run(self, session: &SessionArguments) -> Result<(), CliError> {
        let appearance = match self.model {
            Model::Svbrdf if self.no_relief => {
                Appearance::Svbrdf { relief: Relief { displace: false, shadow: false, ..Relief::measured() } }
            }
            Model::Svbrdf => Appearance::svbrdf(),
            Model::Lpca if self.no_relief || self.texel.is_some() => {
                return Err(misplaced("--no-relief and --texel tell of the reflectance; leave them out with --model lpca"));
            }
            Model::Lpca => Appearance::Lpca { texel_samples: TexelSamples::One },
        };
        let settings = CompareSettings { appearance, texel: self.texel };
        output::check_comparison(&self.output)?;
        let material = io::material::load(&self.material)?;
        let source = io::open_with(&self.source, &self.reading.options())?;
        let session = session.open()?;
        let memory = self.memory.memory(Some(self.adapter_memory));
        let comparison =
            pipeline::compare_into(&session.gpu, source.as_ref(), &material, &settings, memory, &self.output, &session.progress)?;
        let times = session.finish()?;
        say(&format!("{times}\n{}\nwrote {}", summary(&comparison), self.output.join("compare.html").display()))
    }
}

/// The figures over all pairs, and bias and PSNR at each θ of the views.
fn summary(comparison: &Comparison) -> String {
    let or = |value: Option<f64>, text: &dyn Fn(f64) -> String| value.map_or_else(|| "–".to_owned(), text);
    let percent = |value: Option<f64>| or(value, &|value| format!("{:+.2} %", 100.0 * value));
    let overall = &comparison.overall;
    let mut text = format!(
        "relative RMS {}  PSNR {}  bias {}  over {} pairs\nbias and PSNR by view elevation",
        or(overall.relative_rms, &|value| format!("{value:.4}")),
        or(overall.psnr_db, &|value| format!("{value:.2} dB")),
        percent(overall.bias),
        overall.pairs
    );
    for AtElevation { theta_degrees, quality } in &comparison.by_view_elevation {
        // Writing into a string cannot fail.
        let psnr = or(quality.psnr_db, &|value| format!("{value:.2} dB"));
        write!(text, "\n  θ {theta_degrees:>4}  {:>9}  {psnr:>9}", percent(quality.bias)).ok();
    }
    text
}
