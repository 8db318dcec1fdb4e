//! The command line: arguments as typed become a validated job, one file a subcommand.
//!
//! A value out of range is a usage error, found while the arguments are parsed. Whether a result can be written is found
//! before the work that leads to it.

mod adapters;
mod arguments;
mod bar;
mod compare;
mod demo;
mod error;
mod export;
mod figures;
mod fit;
mod import;
mod info;
mod lpca;
mod memory;
mod mesh;
mod model;
mod output;
mod paint;
mod painting;
mod paints;
mod reading;
mod reconstruct;
mod render;
mod session;
mod synth;

use std::{
    ffi::OsString,
    io::{ErrorKind, Write},
};

use clap::{CommandFactory, Parser, Subcommand};

pub use error::CliError;
use session::SessionArguments;

/// Paints measured materials: a BTF in, a painted material out, on any GPU.
#[derive(Debug, Parser)]
#[command(name = "overpaint", version, after_help = EXAMPLES, max_term_width = 100)]
struct Cli {
    #[command(flatten)]
    session: SessionArguments,
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "\
Examples:
  overpaint demo
  overpaint fit cloth.zip -o cloth.zarr
  overpaint info cloth.zarr
  overpaint render cloth.zarr --paint \"oil/cobalt blue\" --thickness 4 -o cloth.png

Directions are THETA,PHI in degrees: THETA from the normal, PHI counter-clockwise from the right.
Exit codes: 0 done, 1 failed, 2 wrong usage.";

#[derive(Debug, Subcommand)]
enum Command {
    Compare(compare::Compare),
    Demo(demo::Demo),
    Export(export::Export),
    Figures(figures::Figures),
    Fit(fit::Fit),
    Import(import::Import),
    Info(info::Info),
    Paint(paint::Paint),
    Paints(paints::Paints),
    Reconstruct(reconstruct::Reconstruct),
    Render(render::Render),
    Synth(synth::Synth),
    Adapters(adapters::Adapters),
}

/// Parses the arguments, the program's name first, and runs the job they describe.
///
/// # Errors
/// [`CliError`]; a request for help or the version is one too, as clap has it, with exit code 0.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> Result<(), CliError> {
    let Cli { session, command } = Cli::try_parse_from(arguments)?;
    match command {
        Command::Compare(compare) => compare.run(&session),
        Command::Demo(demo) => demo.run(&session),
        Command::Figures(figures) => figures.run(&session),
        Command::Fit(fit) => fit.run(&session),
        Command::Import(import) => import.run(&session),
        Command::Paint(paint) => paint.run(&session),
        Command::Reconstruct(reconstruct) => reconstruct.run(&session),
        Command::Render(render) => render.run(&session),
        Command::Synth(synth) => synth.run(&session),
        Command::Paints(paints) if paints.draws() => paints.run(&session),
        Command::Export(_) | Command::Info(_) | Command::Paints(_) | Command::Adapters(_) if session.is_given() => Err(Cli::command()
            .error(clap::error::ErrorKind::ArgumentConflict, "--adapter and --timings are for commands that compute; leave them out here")
            .into()),
        Command::Paints(paints) => paints.run(&session),
        Command::Export(export) => export.run(),
        Command::Info(info) => info.run(),
        Command::Adapters(adapters) => adapters.run(),
    }
}

/// Prints to stdout. A reader that has gone away, as in `overpaint info … | head`, is no error.
fn say(text: &str) -> Result<(), CliError> {
    let mut out = std::io::stdout().lock();
    match writeln!(out, "{text}").and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(CliError::Stdout { source: error }),
        _ => Ok(()),
    }
}
