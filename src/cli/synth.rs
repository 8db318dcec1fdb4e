//! `overpaint synth`.

use std::path::PathBuf;

use clap::{
    Args, ValueEnum,
    builder::{PossibleValuesParser, TypedValueParser},
};

use super::{CliError, arguments, memory::MemoryArguments, output, say, session::SessionArguments};
use crate::{
    data::Grid,
    io::{self, TreeFormat},
    model::{HeightField, Synth as Recipe, SynthReflectance},
    pipeline::{self, Synthetic},
};

/// Render a BTF of a material that is fully known, with its truth beside it: for benchmarks of any size, or without any data.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  overpaint synth -o cloth.zarr
  overpaint synth -o cloth/ --tree jpg --size 128 --views zenith --lights thesis51
  overpaint synth -o wall.zarr --height-field bricks --reflectance matte --relief 12 --size 400x300 --views ubo151 --lights ubo151
  overpaint synth -o coins.zarr --height-field bumps --reflectance metal --views 0:1,30:8,60:12 --lights rings:6 --seed 3

OUT is a dataset (a Zarr group) or, with --tree, a folder of images; its truth, a material, is OUT-truth.zarr beside it. The truth's lobes
are in the frame of each texel's own normal. Shadows and occlusion are rendered, interreflection is not.

GRID is zenith, ubo81, ubo151, thesis51, rings:N (N rings of 6, 12, 18, … directions up to 75 degrees) or THETA:COUNT,… in degrees.")]
pub struct Synth {
    /// The dataset or folder to write
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Shape of the surface
    #[arg(long, value_name = "NAME", default_value = "weave", value_parser = height_field())]
    height_field: HeightField,
    /// Height of the highest place over the lowest, in texel widths, up to 256 [default: 1/32 of the shorter side]
    #[arg(long, value_name = "TEXELS", allow_negative_numbers = true, value_parser = relief)]
    relief: Option<f64>,
    /// What the surface is made of
    #[arg(long, value_name = "NAME", default_value = "silk", value_parser = reflectance())]
    reflectance: SynthReflectance,
    /// Texels: N for a square, or WxH
    #[arg(long, value_name = "SIZE", default_value = "256", allow_hyphen_values = true, value_parser = size)]
    size: [u32; 2],
    /// Directions of the views
    #[arg(long, value_name = "GRID", default_value = "ubo81", allow_hyphen_values = true, value_parser = grid)]
    views: Grid,
    /// Directions of the lights
    #[arg(long, value_name = "GRID", default_value = "ubo81", allow_hyphen_values = true, value_parser = grid)]
    lights: Grid,
    /// Another number, another material of the kind
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u32,
    /// Write a tree of images instead: jpg and png are sRGB of 8 bits, exr linear halves
    #[arg(long, value_name = "FORMAT")]
    tree: Option<Tree>,
    /// Quality of jpg
    #[arg(long, value_name = "1..100", default_value_t = 95, requires = "tree", allow_negative_numbers = true, value_parser = clap::value_parser!(u8).range(1..=100))]
    quality: u8,
    #[command(flatten)]
    memory: MemoryArguments,
}

/// Images of a tree.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Tree {
    Jpg,
    Png,
    Exr,
}

impl Synth {
    pub fn run(self, session: &SessionArguments) -> Result<(), CliError> {
        let shorter = self.size[0].min(self.size[1]);
        let recipe = Recipe {
            height_field: self.height_field,
            relief: self.relief.unwrap_or(f64::from(shorter) / 32.0).min(Recipe::MAX_RELIEF),
            reflectance: self.reflectance,
            seed: self.seed,
        };
        let name = self.output.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let stem = name.strip_suffix(".zarr").unwrap_or(&name).to_owned();
        let truth = self.output.with_file_name(format!("{stem}-truth.zarr"));
        if self.tree.is_none() {
            output::check_dataset(&self.output)?;
        }
        output::check_material(&truth)?;

        let session = session.open()?;
        let size = self.size.map(|side| side as usize);
        let memory = self.memory.memory(None);
        let (views, lights) = (self.views.directions(), self.lights.directions());
        let source = Synthetic::new(&session.gpu, &stem, recipe, size, views, lights, &session.progress)?;
        io::material::save(&truth, &source.truth())?;
        let format = match self.tree {
            None => None,
            Some(Tree::Jpg) => Some(TreeFormat::Jpeg(self.quality)),
            Some(Tree::Png) => Some(TreeFormat::Png),
            Some(Tree::Exr) => Some(TreeFormat::Exr),
        };
        let mut notes = format!("wrote {} and its truth, {}", self.output.display(), truth.display());
        match format {
            None => {
                pipeline::import(&source, &self.output, memory, &session.progress)?;
            }
            Some(format) => {
                let lost = pipeline::export_tree(&source, &self.output, format, memory, &session.progress)?;
                if lost.clipped > 0 {
                    notes += &format!("\n{} values above 1 are stored as 1; --tree exr or a dataset keeps them", lost.clipped);
                }
            }
        }
        drop(source);
        let times = session.finish()?;
        say(&format!("{times}\n{notes}"))
    }
}

/// `N` or `WxH` in texels.
fn size(text: &str) -> Result<[u32; 2], String> {
    let square = format!("{text}x{text}");
    arguments::size(if text.contains('x') { text } else { &square })
        .map_err(|_| "expected a side or WxH in texels, such as 256 or 400x300, each side from 1 to 8192".to_owned())
}

fn relief(text: &str) -> Result<f64, String> {
    let in_range = |value: &f64| (0.0..=Recipe::MAX_RELIEF).contains(value);
    arguments::number(text).ok().filter(in_range).ok_or_else(|| "expected texel widths from 0 to 256".to_owned())
}

fn grid(text: &str) -> Result<Grid, String> {
    text.parse::<Grid>().map_err(|error| error.to_string())
}

fn height_field() -> impl TypedValueParser<Value = HeightField> {
    let of_name = |name: String| HeightField::ALL.into_iter().find(|field| field.name() == name).unwrap_or(HeightField::Flat);
    PossibleValuesParser::new(HeightField::ALL.map(HeightField::name)).map(of_name)
}

fn reflectance() -> impl TypedValueParser<Value = SynthReflectance> {
    let of_name = |name: String| SynthReflectance::ALL.into_iter().find(|kind| kind.name() == name).unwrap_or(SynthReflectance::Matte);
    PossibleValuesParser::new(SynthReflectance::ALL.map(SynthReflectance::name)).map(of_name)
}
