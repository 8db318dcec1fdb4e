//! The command line, run as a user runs it.

crate::suites! { compare, errors, export, help, info, killed, main_job, paints, progress, python, reading, render, synth, usage }

use std::{
    path::Path,
    process::{Command, Stdio},
};

/// What a command printed and how it ended.
#[derive(Debug)]
struct Ran {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

/// The command line in `folder`, nothing connected yet.
fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_overpaint"));
    command.args(arguments).current_dir(folder).stdin(Stdio::null());
    // Mesa's device-selection layer complains on stderr where there is no desktop.
    command.env("NODEVICE_SELECT", "1");
    command
}

/// Runs the command line in `folder`.
fn overpaint(folder: &Path, arguments: &[&str]) -> Ran {
    run(command(folder, arguments))
}

fn run(mut command: Command) -> Ran {
    let output = command.output().expect("starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("is UTF-8");
    Ran { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
}

/// The command ended with `code`, said nothing on stdout, and `needle` once, in one error on stderr.
#[track_caller]
fn refused(ran: &Ran, code: i32, needle: &str) {
    assert_eq!(ran.code, Some(code), "{ran:?}");
    assert_eq!(ran.stdout, "", "{ran:?}");
    assert_eq!(ran.stderr.matches("error:").count(), 1, "{ran:?}");
    assert_eq!(ran.stderr.matches(needle).count(), 1, "\"{needle}\" once in {ran:?}");
}
