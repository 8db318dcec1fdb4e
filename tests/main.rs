//! All integration tests in one binary: laws, parity of kernels with their twins, readers, the command line.
//!
//! Tests that need an adapter fail without one unless `OVERPAINT_GPU=none` is set; tests that need the shared data set
//! look at `OVERPAINT_DATA`, then `../shared/data`. Those that cannot run are listed as ignored and counted.

#![expect(clippy::cast_possible_truncation, reason = "tests count and round small numbers")]

mod cli;
mod interface;
mod io;
mod law;
mod layers;
mod parity;
mod shaders;
mod support;

use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = libtest_mimic::Arguments::from_args();
    let trials = [cli::tests(), interface::tests(), io::tests(), law::tests(), layers::tests(), parity::tests(), shaders::tests()]
        .into_iter()
        .flatten()
        .collect();
    let conclusion = libtest_mimic::run(&arguments, trials);
    support::print_figures();
    conclusion.exit_code()
}
