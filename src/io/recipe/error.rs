//! What is wrong with a recipe or a library of paints, and where.

use crate::{
    io::IoError,
    model::{PaintError, PatternError, pigments::PigmentError},
};

/// A fault of a recipe or a library of paints with its place.
#[derive(Debug, thiserror::Error)]
#[error("{file}:{line}:{column}: {fault}\n{excerpt}")]
pub struct RecipeError {
    /// The file.
    pub file: String,
    /// Its line, from 1.
    pub line: usize,
    /// The character in the line, from 1.
    pub column: usize,
    /// The line with marks below what is meant.
    pub excerpt: String,
    /// What is wrong.
    pub fault: Box<RecipeFault>,
}

/// What is wrong.
#[derive(Debug, thiserror::Error)]
pub enum RecipeFault {
    /// A byte that is no text.
    #[error("this is not UTF-8; save the file as UTF-8")]
    NotText,
    /// Not TOML.
    #[error("this is not TOML: {message}")]
    Syntax {
        /// What the parser found.
        message: String,
    },
    /// A key that nothing has.
    #[error("unknown key \"{key}\" in {of}; its keys are {known}")]
    UnknownKey {
        /// The key.
        key: String,
        /// What has it.
        of: String,
        /// The keys that it may have.
        known: String,
    },
    /// A key that must be there.
    #[error("{of} has no \"{key}\"; add it, such as {example}")]
    Missing {
        /// The key.
        key: &'static str,
        /// What does not have it.
        of: String,
        /// How it may look.
        example: &'static str,
    },
    /// Another kind of value, or a number out of its range.
    #[error("\"{key}\" must be {expected}, found {found}")]
    Type {
        /// The key.
        key: String,
        /// What it must be.
        expected: &'static str,
        /// What it is.
        found: String,
    },
    /// Two keys that exclude each other.
    #[error("{of} has \"{first}\" and \"{second}\"; keep one")]
    Both {
        /// What has them.
        of: String,
        /// One key.
        first: &'static str,
        /// The other.
        second: &'static str,
    },
    /// A number out of its range, or several of which one is.
    #[error("\"{key}\" must be {expected}, found {found}")]
    Bounds {
        /// The key.
        key: String,
        /// What it is.
        found: String,
        /// What it must be.
        expected: String,
    },
    /// A name that is none of those known.
    #[error("\"{key}\" has no \"{found}\"; there are {known}")]
    Choice {
        /// The key.
        key: String,
        /// The name.
        found: String,
        /// The names there are.
        known: String,
    },
    /// A file that the recipe names and that cannot be read.
    #[error("{0}")]
    File(Box<IoError>),
    /// No layers at all.
    #[error("the recipe has no layers, and nothing would be painted; add a table [[layer]]")]
    NoLayers,
    /// A canvas of nothing, or of too much.
    #[error("{columns} x {rows} pieces of the material are asked for; there must be from 1 to {most} in all")]
    Pieces {
        /// Columns.
        columns: u32,
        /// Rows.
        rows: u32,
        /// The largest number of pieces.
        most: u32,
    },
    /// More of something than is read.
    #[error("{found} {what} are more than the {most} that are read; take fewer")]
    TooMany {
        /// Number of them.
        found: usize,
        /// Of what.
        what: &'static str,
        /// The largest number.
        most: usize,
    },
    /// A mixture of nothing, or of too much.
    #[error("a mixture has from 1 to {most} parts, found {found}; name paints and their amounts, such as mix = {{ \"oil/viridian\" = 1 }}")]
    Parts {
        /// Number of parts.
        found: usize,
        /// The largest number.
        most: usize,
    },
    /// A name that is no paint's.
    #[error(transparent)]
    Name(#[from] PigmentError),
    /// A kind of pattern that is not known.
    #[error("there is no pattern \"{found}\"; its kinds are {known}")]
    Kind {
        /// The kind asked for.
        found: String,
        /// The kinds there are.
        known: String,
    },
    /// A pattern or placement with a setting out of range.
    #[error(transparent)]
    Pattern(#[from] PatternError),
    /// A paint or layer with a number out of range.
    #[error(transparent)]
    Paint(#[from] PaintError),
    /// A film that is all but opaque, with what the recipe can say of it.
    #[error("{0} and give its thickness, or give k and s, or say exact = true if the values are exact")]
    Opaque(PaintError),

    /// A text that is no colour.
    #[error(
        "\"{found}\" is no colour: {message}; write it as CSS does, such as \"#1d8f8a\" or \"oklch(60% 0.1 190)\", or as linear \
         reflectances such as [0.02, 0.27, 0.25]"
    )]
    NoColor {
        /// The text.
        found: String,
        /// What the parser found.
        message: String,
    },
    /// A colour that shows what is behind it.
    #[error("\"{found}\" has the opacity {opacity:.2}, but a film's colours are those of film and ground together; leave the opacity out")]
    Translucent {
        /// The text.
        found: String,
        /// Its alpha.
        opacity: f32,
    },
    /// A colour outside sRGB.
    #[error("\"{found}\" lies outside sRGB: it has {value:.4} in {channel}, which must be from 0 to 1; take a colour of less chroma")]
    Gamut {
        /// The text.
        found: String,
        /// "red", "green" or "blue".
        channel: &'static str,
        /// Its value, encoded as sRGB is.
        value: f32,
    },

    /// A name that an own paint cannot have.
    #[error("a paint of one's own cannot be called \"{name}\": {reason}; choose another name")]
    OwnName {
        /// The name.
        name: String,
        /// Why.
        reason: String,
    },
    /// Nothing of what makes a paint.
    #[error("{of} says nothing of its colour; give k and s, or over_white and over_black, or mix")]
    NoPaint {
        /// The paint.
        of: String,
    },
    /// A paint that is given twice.
    #[error("{of} has \"{first}\" and \"{second}\"; keep one: k and s, or over_white and over_black, or mix")]
    Twice {
        /// The paint.
        of: String,
        /// One key.
        first: &'static str,
        /// A key of another way.
        second: &'static str,
    },
    /// A thickness or an amount that is not above 0.
    #[error("\"{key}\" is {found}; it must be above 0 and at most {most:e}")]
    NotPositive {
        /// The key.
        key: String,
        /// The value.
        found: f64,
        /// The largest value.
        most: f64,
    },
    /// Paints of different units in one mixture.
    #[error(
        "{of} mixes \"{first}\", whose unit of thickness is \"{first_unit}\", with \"{second}\", whose unit is \"{second_unit}\": their \
         coefficients cannot be added; mix paints of one unit"
    )]
    Units {
        /// The mixture.
        of: String,
        /// A part.
        first: String,
        /// Its unit.
        first_unit: String,
        /// Another part.
        second: String,
        /// Its unit.
        second_unit: String,
    },
    /// Mixtures that lead back to themselves.
    #[error("these paints are mixed of each other in a circle: {names}; give one of them by k and s, or by its colours")]
    Circle {
        /// Their names, each mixed of the next.
        names: String,
    },
}

/// The start of a text, for a message.
pub fn shortened(text: &str) -> String {
    const SHOWN: usize = 60;
    let mut start: String = text.chars().take(SHOWN).flat_map(char::escape_debug).collect();
    if text.chars().nth(SHOWN).is_some() {
        start.push('…');
    }
    start
}
