//! Progress on stderr: a bar on a terminal, otherwise one plain line for each new stage.

use std::{
    io::{IsTerminal, Write},
    sync::{Mutex, PoisonError},
    time::Duration,
};

use indicatif::{ProgressBar, ProgressStyle};

use crate::pipeline::Observer;

/// The observer that suits stderr.
pub fn observer() -> Box<dyn Observer> {
    if std::io::stderr().is_terminal() { Box::new(Bar::new()) } else { Box::new(Lines::default()) }
}

/// A bar that disappears when the job ends.
#[derive(Debug)]
struct Bar(ProgressBar);

impl Bar {
    fn new() -> Self {
        let style =
            ProgressStyle::with_template("{elapsed:>4} [{bar:32}] {percent:>3} %  {msg}").unwrap_or_else(|_| ProgressStyle::default_bar());
        let bar = ProgressBar::new(0).with_style(style.progress_chars("=> "));
        bar.enable_steady_tick(Duration::from_millis(200));
        Self(bar)
    }
}

impl Observer for Bar {
    fn stage(&self, name: &'static str) {
        self.0.set_message(name);
    }
    fn expect(&self, units: usize) {
        self.0.inc_length(units as u64);
    }
    fn advance(&self, units: usize) {
        self.0.inc(units as u64);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// The names of the stages, each as it is first entered.
#[derive(Debug, Default)]
struct Lines(Mutex<Vec<&'static str>>);

impl Observer for Lines {
    fn stage(&self, name: &'static str) {
        let mut seen = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if !seen.contains(&name) {
            seen.push(name);
            // A closed stderr is no reason to stop the work.
            writeln!(std::io::stderr(), "{name} ...").ok();
        }
    }
}
