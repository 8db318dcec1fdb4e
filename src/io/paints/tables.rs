//! Tables `[paints.NAME]`.

use std::collections::{BTreeMap, BTreeSet};

use super::{Found, OwnPaint, Paints};
use crate::{
    io::{
        RecipeFault,
        recipe::{Outcome, Placed, Table, Value, reflectances, shortened},
    },
    model::{
        Paint, PaintError,
        pigments::{self, PigmentError},
    },
};

/// The most own paints of a file.
const MAX_PAINTS: usize = 256;

/// The most paints in a mixture.
const MAX_PARTS: usize = 32;

/// The longest name of an own paint, in characters.
const MAX_NAME: usize = 64;

/// Largest amount in a mixture and largest thickness of a film.
const MOST: f64 = 1e6;

/// A mixture that is not made yet.
struct Mixture<'a> {
    name: &'a str,
    table: Table<'a>,
    parts: Vec<(&'a str, f64)>,
}

impl Paints {
    /// Adds the paints of the tables `[paints.NAME]`.
    pub(in crate::io) fn add_tables(&mut self, tables: Value<'_>) -> Outcome<()> {
        let tables = tables.table("paints")?.entries();
        if let Some((.., value)) = tables.get(MAX_PAINTS) {
            return Err(value.fault(RecipeFault::TooMany { found: tables.len(), what: "paints", most: MAX_PAINTS }));
        }
        let mut names = BTreeMap::new();
        for (name, span, _) in &tables {
            let twin = names.insert(pigments::plain(name), *name).map(|first| format!("it is \"{first}\" in other letters"));
            if let Some(reason) = self.objection(name).or(twin) {
                return Err(Placed::new(span.clone(), RecipeFault::OwnName { name: shortened(name), reason }));
            }
        }
        let mut mixtures = Vec::new();
        for (name, _, value) in tables {
            let table = value.table(format!("the paint \"{name}\""))?;
            match way(&table)? {
                Way::Coefficients => self.insert(by_coefficients(name, table)?),
                Way::Colours => self.insert(by_colours(name, table)?),
                Way::Mixture => mixtures.push((name, table)),
            }
        }
        let mut waiting = Vec::new();
        for (name, table) in mixtures {
            let table = table.which("a mixture").only(&["mix", "source"])?;
            let parts = self.parts(&table, &names)?;
            waiting.push(Mixture { name, table, parts });
        }
        self.mix(waiting)
    }

    /// Why an own paint cannot be called `name`, if so.
    fn objection(&self, name: &str) -> Option<String> {
        if name.chars().count() > MAX_NAME {
            return Some(format!("it has more than {MAX_NAME} characters"));
        }
        if pigments::plain(name).is_empty() {
            return Some("it has neither letters nor digits".to_owned());
        }
        if name.contains('/') {
            return Some("a slash stands behind the sets of the library".to_owned());
        }
        if let Some(own) = self.own.get(&pigments::plain(name)) {
            return Some(format!("a file of paints has \"{}\" already", own.paint.name));
        }
        match pigments::find(name) {
            Ok(pigment) => Some(format!("that is \"{}\" of the library", pigment.full_name())),
            Err(PigmentError::Ambiguous { choices, .. }) => Some(format!("that may be {choices} of the library")),
            Err(PigmentError::Unknown { .. }) => None,
        }
    }

    /// Names and amounts of a mixture of paints that are there or, by the forms of their names that are compared, in `names`.
    fn parts<'a>(&self, table: &Table<'a>, names: &BTreeMap<String, &str>) -> Outcome<Vec<(&'a str, f64)>> {
        let mix = table.need("mix", "mix = { \"oil/viridian\" = 1, \"oil/titanium white\" = 3 }")?;
        let entries = mix.table("a mixture")?.entries();
        if entries.is_empty() || entries.len() > MAX_PARTS {
            return Err(mix.fault(RecipeFault::Parts { found: entries.len(), most: MAX_PARTS }));
        }
        let others: Vec<&str> = self.own().map(|own| own.paint.name.as_str()).chain(names.values().copied()).collect();
        let is_known = |name: &str| names.contains_key(&pigments::plain(name)) || self.own.contains_key(&pigments::plain(name));
        entries
            .into_iter()
            .map(|(name, span, amount)| {
                if !is_known(name) {
                    pigments::find_beside(name, &others).map_err(|error| Placed::new(span, error))?;
                }
                Ok((name, positive(amount)?))
            })
            .collect()
    }

    /// Makes mixtures, those first whose parts are there.
    fn mix(&mut self, mut waiting: Vec<Mixture<'_>>) -> Outcome<()> {
        let mut names: BTreeSet<String> = waiting.iter().map(|mixture| pigments::plain(mixture.name)).collect();
        while !waiting.is_empty() {
            let is_ready = |mixture: &Mixture<'_>| mixture.parts.iter().all(|(name, _)| !names.contains(&pigments::plain(name)));
            let (ready, rest): (Vec<_>, Vec<_>) = waiting.into_iter().partition(is_ready);
            if ready.is_empty() {
                return Err(circle(&rest));
            }
            for mixture in ready {
                names.remove(&pigments::plain(mixture.name));
                let own = self.mixed(&mixture)?;
                self.insert(own);
            }
            waiting = rest;
        }
        Ok(())
    }

    /// One mixture of paints that are all there.
    fn mixed(&self, Mixture { name, table, parts }: &Mixture<'_>) -> Outcome<OwnPaint> {
        let found: Vec<(Found<'_>, f64)> = parts.iter().filter_map(|(name, amount)| Some((self.find(name).ok()?, *amount))).collect();
        let mut units = found.iter().filter_map(|(found, _)| Some((found.paint().name, found.unit()?)));
        let first = units.next();
        let other = first.as_ref().and_then(|(_, first_unit)| units.find(|(_, unit)| unit != first_unit));
        if let (Some((first, first_unit)), Some((second, second_unit))) = (&first, other) {
            let (first, first_unit, second_unit) = (first.clone(), (*first_unit).to_owned(), second_unit.to_owned());
            let fault = RecipeFault::Units { of: table.what().to_owned(), first, first_unit, second, second_unit };
            return Err(table.fault_at("mix", fault));
        }
        let unit = first.map(|(_, unit)| unit.to_owned());
        let source = match table.get("source") {
            Some(source) => source.text()?.to_owned(),
            None => {
                let parts: Vec<_> = found.iter().map(|(found, amount)| format!("{amount} {}", found.paint().name)).collect();
                format!("mixed of {}", parts.join(", "))
            }
        };
        let parts: Vec<_> = found.into_iter().map(|(found, amount)| (amount, found.paint())).collect();
        let paint = Paint::mixture(name, &parts).map_err(|error| table.fault_at("mix", error))?;
        Ok(OwnPaint { paint, unit, source: Some(source) })
    }
}

/// The fault that mixtures wait for each other: each has a part among them.
fn circle(waiting: &[Mixture<'_>]) -> Placed {
    let is_called = |mixture: &Mixture<'_>, name: &str| pigments::plain(mixture.name) == pigments::plain(name);
    let next = |mixture: &Mixture<'_>| mixture.parts.iter().find_map(|(name, _)| waiting.iter().position(|other| is_called(other, name)));
    let mut path = vec![0];
    while let Some(part) = next(&waiting[path[path.len() - 1]]) {
        let seen = path.iter().position(|&mixture| mixture == part);
        path.push(part);
        if let Some(start) = seen {
            path.drain(..start);
            break;
        }
    }
    let names: Vec<_> = path.iter().map(|&mixture| format!("\"{}\"", waiting[mixture].name)).collect();
    waiting[path[0]].table.fault_at("mix", RecipeFault::Circle { names: names.join(" of ") })
}

/// How a paint is given.
enum Way {
    Coefficients,
    Colours,
    Mixture,
}

/// The one way in which a table gives its paint.
fn way(table: &Table<'_>) -> Outcome<Way> {
    let ways = [("k", Way::Coefficients), ("s", Way::Coefficients), ("over_white", Way::Colours), ("over_black", Way::Colours)];
    let mut given = ways.into_iter().chain([("mix", Way::Mixture)]).filter(|(key, _)| table.get(key).is_some());
    let Some((first, way)) = given.next() else {
        return Err(table.fault(RecipeFault::NoPaint { of: table.what().to_owned() }));
    };
    match given.find(|(_, other)| std::mem::discriminant(other) != std::mem::discriminant(&way)) {
        None => Ok(way),
        Some((second, _)) => Err(table.fault_at(second, RecipeFault::Twice { of: table.what().to_owned(), first, second })),
    }
}

fn by_coefficients(name: &str, table: Table<'_>) -> Outcome<OwnPaint> {
    let table = table.which("by k and s").only(&["k", "s", "unit", "source"])?;
    let [k, s] = [("k", "k = [0.17, 0.13, 0.01]"), ("s", "s = [0.03, 0.02, 0.04]")].map(|(key, example)| {
        let channels: [Value<'_>; 3] = table.need(key, example)?.array("three numbers, of red, green and blue")?;
        let [r, g, b] = channels.map(Value::number);
        Ok(([r?, g?, b?], channels))
    });
    let ((k, k_values), (s, s_values)) = (k?, s?);
    let paint = Paint { name: name.to_owned(), k, s }.checked().map_err(|error| match error {
        PaintError::Coefficient { coefficient, channel, .. } => {
            let values = if coefficient == "K" { k_values } else { s_values };
            let index = ["red", "green", "blue"].iter().position(|name| *name == channel).unwrap_or_default();
            values[index].fault(error)
        }
        error => table.fault(error),
    })?;
    described(paint, &table)
}

fn by_colours(name: &str, table: Table<'_>) -> Outcome<OwnPaint> {
    let table = table.which("by its colours").only(&["over_white", "over_black", "thickness", "exact", "unit", "source"])?;
    let over_white = reflectances(table.need("over_white", "over_white = \"#1d8f8a\"")?)?;
    let over_black = reflectances(table.need("over_black", "over_black = \"#0a3c3a\"")?)?;
    let thickness = table.get("thickness").map_or(Ok(1.0), positive)?;
    let least = if table.flag("exact")? { 0.0 } else { Paint::LEAST_DIFFERENCE };
    let paint = Paint::from_reflectances(name, over_white, over_black, thickness, least).map_err(|error| match error {
        PaintError::Reflectances { over_white, .. } if over_white >= 1.0 => table.fault_at("over_white", error),
        PaintError::Opaque { .. } => table.fault_at("over_black", RecipeFault::Opaque(error)),
        error => table.fault_at("over_black", error),
    })?;
    described(paint, &table)
}

/// The paint with what its table says of it.
fn described(paint: Paint, table: &Table<'_>) -> Outcome<OwnPaint> {
    let text = |key| table.get(key).map(|value| value.text().map(str::to_owned)).transpose();
    Ok(OwnPaint { paint, unit: text("unit")?, source: text("source")? })
}

/// A number above 0.
fn positive(value: Value<'_>) -> Outcome<f64> {
    let found = value.number()?;
    if found > 0.0 && found <= MOST {
        Ok(found)
    } else {
        Err(value.fault(RecipeFault::NotPositive { key: shortened(value.key()), found, most: MOST }))
    }
}
