//! `overpaint fit`.

use std::path::PathBuf;

use clap::Args;

use super::{
    CliError, arguments,
    lpca::LpcaArguments,
    memory::{AdapterMemoryArguments, MemoryArguments},
    output,
    reading::ReadingArguments,
    say,
    session::SessionArguments,
};
use crate::{
    io::{self, Unfinished},
    model::{Boundary, FitSettings, SpecularScale, StereoMethod, SurfaceMode},
    pipeline,
};

/// Recover a material from a BTF: height, normals and per-texel reflectance, and a local PCA of the original.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  overpaint fit cloth.zip -o cloth.zarr
  overpaint fit photographs/ -o wall.zarr --boundary mirror --timings wall.json
  overpaint fit cloth.zip -o corner.zarr --region 0,0,64x64 --max-theta 60

SOURCE is a folder or a .zip of images: named by their directions (such as `tl030 pl090 tv000 pv000.jpg`), or of one view with a file of
light directions (lights.txt, light_directions.txt, .lp).")]
pub struct Fit {
    /// The BTF: a folder or a .zip of images, or an .lp file
    source: PathBuf,
    /// The material to write, a Zarr group
    #[arg(short, long, value_name = "MATERIAL")]
    output: PathBuf,
    /// How the surface is taken: each texel flat, rough with one texel's lobe for all, local with each texel in its own shading frame, or the one of them that leaves the least of some texels' radiance
    #[arg(long, value_name = "HOW", default_value = "auto", value_parser = arguments::surface())]
    surface: SurfaceMode,
    /// Lobes of a texel, with --surface local or auto
    #[arg(long, value_name = "N", default_value_t = FitSettings::default().lobes, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=3))]
    lobes: u32,
    /// The texel whose lobe serves all of a rough surface: column and row; else the one with the flattest surroundings
    #[arg(long, value_name = "X,Y", value_parser = arguments::texel)]
    representative: Option<[usize; 2]>,
    /// Samples of a rough surface below this part of the texel's median are taken to lie in shadow
    #[arg(long, value_name = "PART", default_value_t = FitSettings::default().dark_fraction, allow_negative_numbers = true, value_parser = arguments::fraction)]
    dark_fraction: f64,
    /// What lies beyond the sample's edge: periodic if it tiles, mirror if it is a cut-out
    #[arg(long, default_value = "periodic", value_parser = arguments::boundary())]
    boundary: Boundary,
    /// How normals follow from the images: robust gives little weight to shadows and highlights
    #[arg(long, value_name = "METHOD", default_value = "robust", value_parser = arguments::stereo_method())]
    stereo: StereoMethod,
    /// With mirror: keep the height's mean tilt
    #[arg(long)]
    keep_tilt: bool,
    /// Steepest slope of photometric stereo, as a tangent
    #[arg(long, value_name = "TAN", default_value_t = FitSettings::default().max_slope, allow_negative_numbers = true, value_parser = arguments::positive)]
    max_slope: f64,
    /// Leave out lights whose cosine to the normal is below this
    #[arg(long, value_name = "COS", default_value_t = FitSettings::default().min_cos_light, allow_negative_numbers = true, value_parser = arguments::fraction)]
    min_cos_light: f64,
    /// Quantile of the reflectance that is taken as diffuse
    #[arg(long, value_name = "Q", default_value_t = FitSettings::default().diffuse_quantile, allow_negative_numbers = true, value_parser = arguments::fraction)]
    diffuse_quantile: f64,
    /// Levenberg-Marquardt steps at most
    #[arg(long, value_name = "N", default_value_t = FitSettings::default().max_iterations, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    steps: u32,
    /// Bounds of the lobe's exponent
    #[arg(long, value_name = "MIN,MAX", default_value = "0.5,1000", allow_hyphen_values = true, value_parser = arguments::exponents)]
    exponents: [f64; 2],
    /// How the specular albedo follows from the lobe
    #[arg(long, value_name = "RULE", default_value = "least-squares", value_parser = arguments::specular_scale())]
    specular_scale: SpecularScale,
    /// Least lobe that ρ_s is taken from: with mean-ratio of a sample, with least-squares the root of a texel's sum of squares
    #[arg(long, value_name = "VALUE", default_value_t = FitSettings::default().min_lobe, allow_negative_numbers = true, value_parser = arguments::positive)]
    min_lobe: f64,
    #[command(flatten)]
    lpca: LpcaArguments,
    #[command(flatten, next_help_heading = "Options")]
    memory: MemoryArguments,
    #[command(flatten)]
    adapter_memory: AdapterMemoryArguments,
    #[command(flatten)]
    reading: ReadingArguments,
}

impl Fit {
    pub fn run(self, session: &SessionArguments) -> Result<(), CliError> {
        let settings = FitSettings {
            surface: self.surface,
            lobes: self.lobes,
            representative: self.representative,
            dark_fraction: self.dark_fraction,
            boundary: self.boundary,
            stereo: self.stereo,
            max_slope: self.max_slope,
            min_cos_light: self.min_cos_light,
            diffuse_quantile: self.diffuse_quantile,
            max_iterations: self.steps,
            lpca: self.lpca.settings(),
            specular_scale: self.specular_scale,
            min_lobe: self.min_lobe,
            detilt: !self.keep_tilt,
            exponents: self.exponents,
            ..FitSettings::default()
        };
        output::check_material(&self.output)?;
        let source = io::open_with(&self.source, &self.reading.options())?;
        let session = session.open()?;
        pipeline::check_fit(&session.gpu, source.as_ref(), &settings)?;
        let unfinished = Unfinished::begin(&self.output, &pipeline::fit_job(&session.gpu, source.as_ref(), &settings))?;
        let mut found = String::new();
        if !unfinished.is_complete() {
            let memory = self.memory.memory(Some(self.adapter_memory));
            let material = pipeline::fit_within(&session.gpu, source.as_ref(), &settings, memory, Some(&unfinished), &session.progress)?;
            io::material::save(&self.output, &material)?;
            found = format!("\nsurface: {}", material.choice);
            if let Some(lpca) = &material.lpca {
                found += &format!("\nlocal PCA: {lpca}");
            }
        }
        let resumed = if unfinished.is_resumed() { " (an earlier run had begun it)" } else { "" };
        unfinished.commit()?;
        let times = session.finish()?;
        say(&format!("{times}{found}\nwrote {}{resumed}", self.output.display()))
    }
}
