//! The library of paints: Kubelka-Munk coefficients at three wavelengths, with where they come from.
//!
//! The two sets have units of their own: thickness 1 of one is not the film that thickness 1 of the other is. The oils are
//! *substitutes* for the coefficients of Baxter, Wendt and Lin 2004, which are not published: measured two-constant data
//! of artists' paints at the same wavelengths.

mod names;
mod table;

pub use names::plain;

use names::{nearest, shortened};
use table::{OILS, WATERCOLOURS};

/// A group of pigments with one unit of thickness.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PigmentSet {
    /// Twelve watercolours (Curtis et al. 1997).
    Watercolour,
    /// Eight substitutes for oil paints.
    Oil,
}

impl PigmentSet {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Watercolour, Self::Oil];

    /// Name, as it stands before the slash in a pigment's full name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Watercolour => "watercolour",
            Self::Oil => "oil",
        }
    }

    /// What thickness 1 means.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Watercolour => "thickness 1 is the swatch of Curtis et al. 1997",
            Self::Oil => "thickness 1 is the film in which titanium white scatters S = 1",
        }
    }

    /// The pigments of this set.
    #[must_use]
    pub fn pigments(self) -> &'static [Pigment] {
        match self {
            Self::Watercolour => WATERCOLOURS,
            Self::Oil => OILS,
        }
    }
}

/// How well a pigment's coefficients are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Grade {
    /// As printed by the authors of the set.
    Published,
    /// A: a substitute; the pigment itself, K and S measured, in another binder.
    Measured,
    /// B: a substitute; a measured stand-in or mixture whose opaque colour matches the paint of that name.
    StandIn,
    /// C: a substitute; derived, S to an order of magnitude.
    Derived,
}

impl Grade {
    /// All, the best known first.
    pub const ALL: [Self; 4] = [Self::Published, Self::Measured, Self::StandIn, Self::Derived];

    /// Name, as listings have it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Published => "published",
            Self::Measured => "A",
            Self::StandIn => "B",
            Self::Derived => "C",
        }
    }

    /// What it says of the coefficients.
    #[must_use]
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Published => "as printed by the authors of the set",
            Self::Measured => "a substitute: the pigment itself, K and S measured, in another binder",
            Self::StandIn => "a substitute: a measured stand-in or mixture whose opaque colour matches the paint of that name",
            Self::Derived => "a substitute: derived, S to an order of magnitude",
        }
    }

    /// Whether the coefficients stand for others that are not published.
    #[must_use]
    pub fn is_substitute(self) -> bool {
        self != Self::Published
    }
}

/// A pigment of the library.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pigment {
    /// Name within its set.
    pub name: &'static str,
    /// The set it belongs to, which fixes the unit.
    pub set: PigmentSet,
    /// Absorption K per unit thickness in R, G, B.
    pub k: [f64; 3],
    /// Scattering S per unit thickness in R, G, B.
    pub s: [f64; 3],
    /// How well the coefficients are known.
    pub grade: Grade,
    /// Where they come from.
    pub source: &'static str,
}

impl Pigment {
    /// Name that no other pigment has: `oil/cadmium yellow`.
    #[must_use]
    pub fn full_name(&self) -> String {
        format!("{}/{}", self.set.name(), self.name.to_lowercase())
    }
}

/// A name that stands for no pigment, or for several.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PigmentError {
    /// No pigment is called that.
    #[error("no paint is called \"{name}\". The nearest names are {near}")]
    Unknown {
        /// The name asked for.
        name: String,
        /// The nearest full names, quoted.
        near: String,
    },
    /// Both sets have a pigment of that name.
    #[error("\"{name}\" stands for several paints. Choose one of {choices}")]
    Ambiguous {
        /// The name asked for.
        name: String,
        /// The full names, quoted.
        choices: String,
    },
}

/// Every pigment: watercolours, then oils.
pub fn all() -> impl Iterator<Item = &'static Pigment> {
    PigmentSet::ALL.into_iter().flat_map(PigmentSet::pigments)
}

/// The pigment called `name`, with its set before a slash or without; case, spaces and punctuation do not matter.
///
/// # Errors
/// [`PigmentError`] if there is none or more than one.
pub fn find(name: &str) -> Result<&'static Pigment, PigmentError> {
    find_beside(name, &[])
}

/// As [`find`]; if there is none, the nearest names are looked for among `others`, too.
///
/// # Errors
/// As [`find`].
pub fn find_beside(name: &str, others: &[&str]) -> Result<&'static Pigment, PigmentError> {
    let wanted = plain(name);
    let matching: Vec<_> = match name.split_once('/') {
        Some(_) => all().filter(|pigment| plain(&pigment.full_name()) == wanted).collect(),
        None => all().filter(|pigment| plain(pigment.name) == wanted).collect(),
    };
    match matching[..] {
        [pigment] => Ok(pigment),
        [] => {
            let names = others.iter().map(|other| (*other).to_owned()).chain(all().map(Pigment::full_name)).collect();
            Err(PigmentError::Unknown { name: shortened(name), near: quoted(nearest(name, names)) })
        }
        _ => {
            let choices = quoted(matching.iter().map(|pigment| pigment.full_name()));
            Err(PigmentError::Ambiguous { name: shortened(name), choices })
        }
    }
}

fn quoted(names: impl IntoIterator<Item = String>) -> String {
    names.into_iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ")
}
