//! What tests share: registration, the adapter, the data folder, comparison with a bound.

pub mod directions;
pub mod files;
pub mod held;
pub mod known;
pub mod lines;
pub mod local;
pub mod lpca;
pub mod material;
pub mod npy;
pub mod paint;
pub mod probe;
pub mod random;
pub mod speckle;
pub mod subspaces;
pub mod surface;
pub mod tile;

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    sync::{Mutex, OnceLock},
};

use libtest_mimic::Trial;
use overpaint::gpu::Gpu;

/// Lists a file's tests by what they need: `plain` nothing, `gpu` an adapter, `data` the shared data, `gpu_data` both.
#[macro_export]
macro_rules! suite {
    ($($need:ident: $($test:ident),+ $(,)?;)+) => {
        pub fn tests() -> Vec<libtest_mimic::Trial> {
            vec![$($($crate::support::$need(concat!(module_path!(), "::", stringify!($test)), $test)),+),+]
        }
    };
}

/// Declares the modules of a folder and gathers their tests.
#[macro_export]
macro_rules! suites {
    ($($module:ident),+ $(,)?) => {
        $(pub mod $module;)+
        pub fn tests() -> Vec<libtest_mimic::Trial> {
            [$($module::tests()),+].into_iter().flatten().collect()
        }
    };
}

fn name(path: &str) -> String {
    path.split_once("::").map_or(path, |(_, rest)| rest).to_owned()
}

/// A test that needs nothing.
pub fn plain(path: &str, test: fn()) -> Trial {
    Trial::test(name(path), move || {
        test();
        Ok(())
    })
}

/// A test that needs an adapter.
pub fn gpu(path: &str, test: fn(&Gpu)) -> Trial {
    Trial::test(name(path), move || {
        test(adapter());
        Ok(())
    })
    .with_ignored_flag(gpu_is_declined())
}

/// A test that needs the shared data.
pub fn data(path: &str, test: fn(&Path)) -> Trial {
    Trial::test(name(path), move || {
        test(&data_folder().expect("looked up before the test was listed"));
        Ok(())
    })
    .with_ignored_flag(data_folder().is_none())
}

/// A test that needs an adapter and the shared data.
pub fn gpu_data(path: &str, test: fn(&Gpu, &Path)) -> Trial {
    Trial::test(name(path), move || {
        test(adapter(), &data_folder().expect("looked up before the test was listed"));
        Ok(())
    })
    .with_ignored_flag(gpu_is_declined() || data_folder().is_none())
}

fn gpu_is_declined() -> bool {
    std::env::var("OVERPAINT_GPU").is_ok_and(|value| value == "none")
}

fn adapter() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(|| {
        let name = std::env::var("OVERPAINT_ADAPTER").ok();
        Gpu::open(name.as_deref()).unwrap_or_else(|error| panic!("{error}\n(OVERPAINT_GPU=none leaves out the tests that need an adapter)"))
    })
}

/// The shared data set, if it is there.
pub fn data_folder() -> Option<PathBuf> {
    let named = std::env::var_os("OVERPAINT_DATA").map(PathBuf::from);
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    [named, Some(beside)].into_iter().flatten().find(|folder| folder.is_dir())
}

/// The worst figure of each name and its bound.
static FIGURES: Mutex<BTreeMap<String, (f64, f64)>> = Mutex::new(BTreeMap::new());

/// Holds `worst` to `bound` and keeps both for the table printed at the end. NaN fails.
#[track_caller]
pub fn hold(what: &str, worst: f64, bound: f64) {
    let mut figures = FIGURES.lock().expect("no test panics while it holds the lock");
    match figures.get_mut(what) {
        Some(kept) if worst.is_nan() || worst > kept.0 => *kept = (worst, bound),
        Some(_) => {}
        None => drop(figures.insert(what.to_owned(), (worst, bound))),
    }
    drop(figures);
    assert!(worst <= bound, "{what}: {worst:.3e} exceeds its bound {bound:.3e}");
}

pub trait Worst {
    /// The largest item; NaN if any item is not finite, or there is none.
    fn worst(self) -> f64;
}

impl<I: Iterator<Item: Into<f64>>> Worst for I {
    fn worst(self) -> f64 {
        let larger = |a: f64, b: f64| if a.is_finite() && b.is_finite() { a.max(b) } else { f64::NAN };
        self.map(Into::into).reduce(larger).filter(|worst| worst.is_finite()).unwrap_or(f64::NAN)
    }
}

/// Largest absolute difference of two equally long lists; NaN if any value is not finite, or the lengths differ.
pub fn worst_difference(found: impl IntoIterator<Item = f64>, expected: impl IntoIterator<Item = f64>) -> f64 {
    let (mut found, mut expected) = (found.into_iter(), expected.into_iter());
    let mut worst = 0.0_f64;
    loop {
        match (found.next(), expected.next()) {
            (None, None) => return worst,
            (Some(found), Some(expected)) if found.is_finite() && expected.is_finite() => worst = worst.max((found - expected).abs()),
            _ => return f64::NAN,
        }
    }
}

/// Bound on a Fourier transform's worst error along an axis, over the rms of its result.
///
/// Errors of a pass of radix r are those of a sum of r rounded terms, about sqrt(r) half units in the last place (6e-8), and
/// those of passes add up; the worst of many values is a few times the typical one.
pub fn fft_bound(length: usize) -> f64 {
    let mut rest = length;
    let mut typical = 1.0;
    for factor in 2..=length {
        while rest.is_multiple_of(factor) {
            typical += (factor as f64).sqrt();
            rest /= factor;
        }
    }
    4.0 * 6e-8 * typical
}

/// The worst figure of every comparison that ran, beside its bound.
pub fn print_figures() {
    let figures = FIGURES.lock().expect("no test panics while it holds the lock");
    if !figures.is_empty() {
        println!("\nworst figure and bound of each comparison:");
        for (what, (worst, bound)) in figures.iter() {
            println!("  {worst:10.3e} <= {bound:9.3e}  {what}");
        }
    }
}
