//! TOML files as tables whose values know their places.

use std::{fs::File, io::Read, ops::Range, path::Path};

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use super::{RecipeError, RecipeFault, error::shortened};
use crate::io::IoError;

/// The longest file that is read.
const MAX_BYTES: u64 = 1 << 20;

/// The longest name of a file, in bytes.
const MAX_PATH: usize = 1024;

/// Characters of a line that an error shows.
const SHOWN: usize = 120;

/// A fault and the bytes of the text that it is about.
#[derive(Debug)]
pub struct Placed {
    pub span: Range<usize>,
    pub fault: Box<RecipeFault>,
}

impl Placed {
    pub fn new(span: Range<usize>, fault: impl Into<RecipeFault>) -> Self {
        Self { span, fault: Box::new(fault.into()) }
    }
}

/// What is read of a text, or what is wrong with it and where.
pub type Outcome<T> = Result<T, Placed>;

/// A text by the name of its file.
pub struct Document<'a> {
    file: &'a str,
    text: &'a str,
}

/// The bytes of a file that has no more than a recipe may have.
pub fn read(path: &Path) -> Result<Vec<u8>, IoError> {
    let unreadable = |source| IoError::Read { file: path.display().to_string(), source };
    let mut bytes = Vec::new();
    File::open(path).map_err(unreadable)?.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > MAX_BYTES { Err(IoError::TooLongText { path: path.to_owned(), limit: MAX_BYTES }) } else { Ok(bytes) }
}

impl<'a> Document<'a> {
    /// The text of a file.
    pub fn new(file: &'a str, bytes: &'a [u8]) -> Result<Self, RecipeError> {
        match std::str::from_utf8(bytes) {
            Ok(text) => Ok(Self { file, text }),
            Err(error) => {
                let end = error.valid_up_to();
                let valid = String::from_utf8_lossy(&bytes[..end]);
                Err(Document { file, text: &valid }.error(Placed::new(end..end, RecipeFault::NotText)))
            }
        }
    }

    /// Its tables.
    pub fn parse(&self) -> Result<DeTable<'a>, RecipeError> {
        DeTable::parse(self.text).map(Spanned::into_inner).map_err(|error| {
            let span = error.span().unwrap_or(self.text.len()..self.text.len());
            self.error(Placed::new(span, RecipeFault::Syntax { message: error.message().to_owned() }))
        })
    }

    /// The error that a fault is in this file, with line and column.
    pub fn error(&self, Placed { span, fault }: Placed) -> RecipeError {
        let start = self.text.floor_char_boundary(span.start);
        let (before, after) = self.text.split_at(start);
        let line_start = before.rfind('\n').map_or(0, |end| end + 1);
        let line_end = after.find('\n').map_or(self.text.len(), |length| start + length);
        let (line, column) = (before.matches('\n').count() + 1, self.text[line_start..start].chars().count() + 1);
        let line_text = self.text[line_start..line_end].trim_end();
        // Of a long line, a window with what is meant in its middle.
        let skipped = if line_text.chars().count() > SHOWN { column.saturating_sub(SHOWN / 2) } else { 0 };
        let plain = |character: char| if character.is_control() { ' ' } else { character };
        let shown: String = line_text.chars().skip(skipped).take(SHOWN).map(plain).collect();
        let marked = self.text[start..self.text.floor_char_boundary(span.end.clamp(start, line_end))].chars().count();
        let margin = " ".repeat(line.to_string().len());
        let indent = " ".repeat(column - 1 - skipped);
        let marks = "^".repeat(marked.clamp(1, SHOWN / 2));
        let excerpt = format!(" {margin} |\n {line} | {shown}\n {margin} | {indent}{marks}");
        RecipeError { file: self.file.to_owned(), line, column, excerpt, fault }
    }
}

/// A table of which every key is known.
#[derive(Debug)]
pub struct Table<'a> {
    /// What it is, as in "unknown key in WHAT".
    what: String,
    span: Range<usize>,
    entries: &'a DeTable<'a>,
}

impl<'a> Table<'a> {
    /// The table `entries`, which stands at `span`.
    pub fn new(what: impl Into<String>, span: Range<usize>, entries: &'a DeTable<'a>) -> Self {
        Self { what: what.into(), span, entries }
    }

    /// The same table as something else.
    pub fn named(self, what: impl Into<String>) -> Self {
        Self { what: what.into(), ..self }
    }

    /// The same table, of which something is known.
    pub fn which(self, known: &str) -> Self {
        let what = format!("{} ({known})", self.what);
        self.named(what)
    }

    /// The table itself, if it has no keys but these. The first that is another is the fault.
    pub fn only(self, keys: &[&str]) -> Outcome<Self> {
        self.check(keys)?;
        Ok(self)
    }

    /// Whether it has no keys but these.
    pub fn check(&self, keys: &[&str]) -> Outcome<()> {
        let unknown = self.entries.keys().filter(|key| !keys.contains(&&**key.get_ref())).min_by_key(|key| key.span().start);
        match unknown {
            None => Ok(()),
            Some(key) => {
                let fault = RecipeFault::UnknownKey { key: shortened(key.get_ref()), of: self.what.clone(), known: keys.join(", ") };
                Err(Placed::new(key.span(), fault))
            }
        }
    }

    /// The value of a key, if it is there.
    pub fn get(&self, key: &'static str) -> Option<Value<'a>> {
        self.entries.get(key).map(|value| Value { key, value })
    }

    /// The value of a key.
    pub fn need(&self, key: &'static str, example: &'static str) -> Outcome<Value<'a>> {
        self.get(key).ok_or_else(|| self.fault(RecipeFault::Missing { key, of: self.what.clone(), example }))
    }

    /// The number of a key that need not be there.
    pub fn number(&self, key: &'static str, default: f64) -> Outcome<f64> {
        self.get(key).map_or(Ok(default), Value::number)
    }

    /// The whole number of a key that need not be there.
    pub fn whole(&self, key: &'static str, default: u32) -> Outcome<u32> {
        self.get(key).map_or(Ok(default), Value::whole)
    }

    /// The truth of a key that need not be there.
    pub fn flag(&self, key: &'static str) -> Outcome<bool> {
        self.get(key).map_or(Ok(false), Value::flag)
    }

    /// A fault of the value of a key; of the table if the key is not there.
    pub fn fault_at(&self, key: &str, fault: impl Into<RecipeFault>) -> Placed {
        let span = self.entries.get(key).map_or_else(|| self.span.clone(), Spanned::span);
        Placed::new(span, fault)
    }

    /// A fault of the table.
    pub fn fault(&self, fault: impl Into<RecipeFault>) -> Placed {
        Placed::new(self.span.clone(), fault)
    }

    /// What it is.
    pub fn what(&self) -> &str {
        &self.what
    }

    /// Its entries in the order of the text: name, its place, value.
    pub fn entries(&self) -> Vec<(&'a str, Range<usize>, Value<'a>)> {
        let mut entries: Vec<_> =
            self.entries.iter().map(|(key, value)| (&**key.get_ref(), key.span(), Value { key: key.get_ref(), value })).collect();
        entries.sort_by_key(|(_, span, _)| span.start);
        entries
    }
}

/// A value and the key it belongs to.
#[derive(Debug, Clone, Copy)]
pub struct Value<'a> {
    key: &'a str,
    value: &'a Spanned<DeValue<'a>>,
}

impl<'a> Value<'a> {
    /// The key.
    pub fn key(self) -> &'a str {
        self.key
    }

    /// Where it stands.
    pub fn span(self) -> Range<usize> {
        self.value.span()
    }

    /// A fault of this value.
    pub fn fault(self, fault: impl Into<RecipeFault>) -> Placed {
        Placed::new(self.value.span(), fault)
    }

    fn is_no(self, expected: &'static str) -> Placed {
        let found = match self.value.get_ref() {
            DeValue::String(text) => format!("the string \"{}\"", shortened(text)),
            DeValue::Integer(number) => format!("the number {}", shortened(number.as_str())),
            DeValue::Float(number) => format!("the number {}", shortened(number.as_str())),
            DeValue::Boolean(truth) => truth.to_string(),
            DeValue::Datetime(_) => "a date or time".to_owned(),
            DeValue::Array(values) => format!("an array of {}", values.len()),
            DeValue::Table(_) => "a table".to_owned(),
        };
        self.fault(RecipeFault::Type { key: shortened(self.key), expected, found })
    }

    /// Whether it is an array.
    pub fn is_array(self) -> bool {
        self.value.get_ref().is_array()
    }

    /// Whether it is a string.
    pub fn is_text(self) -> bool {
        self.value.get_ref().is_str()
    }

    /// A string.
    pub fn text(self) -> Outcome<&'a str> {
        self.value.get_ref().as_str().ok_or_else(|| self.is_no("a string"))
    }

    /// The name of a file.
    pub fn path(self) -> Outcome<&'a str> {
        let name = self.text()?;
        if name.len() <= MAX_PATH { Ok(name) } else { Err(self.is_no("the name of a file, at most 1024 bytes long")) }
    }

    /// True or false.
    pub fn flag(self) -> Outcome<bool> {
        self.value.get_ref().as_bool().ok_or_else(|| self.is_no("true or false"))
    }

    /// A finite number.
    pub fn number(self) -> Outcome<f64> {
        let number = match self.value.get_ref() {
            DeValue::Float(number) => number.as_str().parse().ok(),
            DeValue::Integer(number) if number.radix() == 10 => number.as_str().parse().ok(),
            DeValue::Integer(number) => i128::from_str_radix(number.as_str(), number.radix()).ok().map(|number| number as f64),
            _ => return Err(self.is_no("a number")),
        };
        number.filter(|number: &f64| number.is_finite()).ok_or_else(|| self.is_no("a finite number"))
    }

    /// A whole number of 0 or more that 32 bits hold.
    pub fn whole(self) -> Outcome<u32> {
        let number = self.number()?;
        if number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number) {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is whole and in range")]
            return Ok(number as u32);
        }
        Err(self.is_no("a whole number from 0 to 4294967295"))
    }

    /// Its elements, each under the key of all.
    pub fn elements(self, expected: &'static str) -> Outcome<Vec<Self>> {
        let elements = self.value.get_ref().as_array().ok_or_else(|| self.is_no(expected))?;
        Ok(elements.iter().map(|value| Self { key: self.key, value }).collect())
    }

    /// Its N elements.
    pub fn array<const N: usize>(self, expected: &'static str) -> Outcome<[Self; N]> {
        self.elements(expected)?.try_into().map_err(|_| self.is_no(expected))
    }

    /// A table.
    pub fn table(self, what: impl Into<String>) -> Outcome<Table<'a>> {
        let entries = self.value.get_ref().as_table().ok_or_else(|| self.is_no("a table"))?;
        Ok(Table::new(what, self.value.span(), entries))
    }
}
