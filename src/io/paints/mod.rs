//! Paints by name: those of the library, and own ones from tables `[paints.NAME]` of a TOML file.
//!
//! Such tables stand in a recipe ([`recipe`](super::recipe)), or in a file that holds nothing else, which recipes name by `library`. A
//! paint is given in one of three ways:
//!
//! | key | what it is |
//! |---|---|
//! | `k`, `s` | Kubelka-Munk absorption and scattering per unit of thickness in R, G, B, 0 to 1e6 |
//! | `over_white`, `over_black` | colours of a film of it on a white and on a black ground |
//! | `thickness` | of that film, above 0 up to 1e6; default 1 |
//! | `exact` | `true`: take the colours as exact, also where they differ by less than 1/255; default `false` |
//! | `mix` | a table of names of paints and their amounts, above 0 up to 1e6; only their ratios count |
//! | `unit` | what thickness 1 means, a text; not for mixtures, which have that of their parts; default: nothing is said |
//! | `source` | where the numbers come from, a text |
//!
//! A colour is a string in any notation of CSS Color 4 (`"#1d8f8a"`, `"teal"`, `"rgb(10 60 58)"`, `"hsl(…)"`, `"hwb(…)"`, `"lab(…)"`,
//! `"lch(…)"`, `"oklab(…)"`, `"oklch(…)"`, `"color(display-p3 …)"`) inside sRGB and opaque, which is converted to linear light; or an
//! array of three linear reflectances. 0 < over black < over white < 1 must hold in each channel, or no film has these colours. Nothing
//! is clamped or moved to make it hold. Where the two differ by less than 1/255, as much as colours of 8 bits tell, scattering would be
//! made of their rounding: that is refused, too, unless `exact` says that the values mean what they say.
//!
//! Names are compared without case, spaces and punctuation. An own paint may not take a name of the library's, with or without its set
//! (`oil/cadmium yellow`, `cadmium yellow`), so that a name means the same in every file.
//!
//! Mixtures add K and S by their amounts, divided by their sum (Duncan 1940). They may have mixtures in them, and paints of the
//! library, but not of two units of thickness: the watercolours and the oils do not mix. A paint without a unit takes that of the others.
//!
//! ```toml
//! [paints.teal]
//! over_white = "#1d8f8a"
//! over_black = "rgb(10 60 58)"
//! unit = "oil"
//! source = "drawdown card, read with a scanner"
//!
//! [paints.ochre]
//! k = [0.06, 0.43, 0.9]
//! s = [0.2, 0.2, 0.1]
//!
//! [paints."pale teal"]
//! mix = { teal = 1, "oil/titanium white" = 4 }
//! ```

mod tables;

use std::{collections::BTreeMap, path::Path};

use super::{
    IoError, RecipeError, RecipeFault,
    recipe::{Document, Outcome, Table, Value, read},
};
use crate::model::{
    Paint,
    pigments::{self, Pigment, PigmentError},
};

/// A paint of one's own.
#[derive(Debug, Clone, PartialEq)]
pub struct OwnPaint {
    /// Name, K and S.
    pub paint: Paint,
    /// What thickness 1 means, if that is said.
    pub unit: Option<String>,
    /// Where it comes from, if that is said; of a mixture, its parts.
    pub source: Option<String>,
}

/// Own paints, and through them those of the library.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Paints {
    /// By the form of the name that is compared.
    own: BTreeMap<String, OwnPaint>,
}

/// A paint that a name stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Found<'a> {
    /// A paint of one's own.
    Own(&'a OwnPaint),
    /// A paint of the library.
    Library(&'static Pigment),
}

impl Found<'_> {
    /// Name, K and S.
    #[must_use]
    pub fn paint(self) -> Paint {
        match self {
            Self::Own(own) => own.paint.clone(),
            Self::Library(pigment) => pigment.into(),
        }
    }

    /// What thickness 1 means, if that is said: of the library, the name of its set.
    #[must_use]
    pub fn unit(&self) -> Option<&str> {
        match self {
            Self::Own(own) => own.unit.as_deref(),
            Self::Library(pigment) => Some(pigment.set.name()),
        }
    }
}

impl Paints {
    /// The own paints, by name.
    pub fn own(&self) -> impl Iterator<Item = &OwnPaint> {
        self.own.values()
    }

    /// The paint called `name`, own or of the library; case, spaces and punctuation do not matter.
    ///
    /// # Errors
    /// [`PigmentError`] if there is none or more than one.
    pub fn find(&self, name: &str) -> Result<Found<'_>, PigmentError> {
        if let Some(own) = self.own.get(&pigments::plain(name)) {
            return Ok(Found::Own(own));
        }
        let others: Vec<&str> = self.own().map(|own| own.paint.name.as_str()).collect();
        pigments::find_beside(name, &others).map(Found::Library)
    }

    fn insert(&mut self, own: OwnPaint) {
        self.own.insert(pigments::plain(&own.paint.name), own);
    }

    /// Adds the paints of another file, which is named at `file`.
    pub(super) fn add(&mut self, others: Self, file: Value<'_>) -> Outcome<()> {
        for (name, own) in others.own {
            if self.own.contains_key(&name) {
                let reason = "another file of paints has it already".to_owned();
                return Err(file.fault(RecipeFault::OwnName { name: own.paint.name, reason }));
            }
            self.own.insert(name, own);
        }
        Ok(())
    }
}

/// Reads a file of paints: tables `[paints.NAME]` and nothing else.
///
/// # Errors
/// [`IoError::Recipe`] with file, line and column of what is wrong; others if the file cannot be read.
pub fn load(path: &Path) -> Result<Paints, IoError> {
    Ok(parse(&path.display().to_string(), &read(path)?)?)
}

/// Reads the bytes of a file of paints.
///
/// # Errors
/// [`RecipeError`] with line and column of what is wrong.
pub fn parse(file: &str, bytes: &[u8]) -> Result<Paints, RecipeError> {
    let document = Document::new(file, bytes)?;
    let entries = document.parse()?;
    let read = || {
        let table = Table::new("a file of paints", 0..0, &entries).only(&["paints"])?;
        let mut paints = Paints::default();
        paints.add_tables(table.need("paints", "a table [paints.teal]")?)?;
        Ok(paints)
    };
    read().map_err(|placed| document.error(placed))
}
