//! Names of paints: which are the same, and which are near.

/// Letters of a name that count when it is looked for: a name of any length is refused in a short time.
const COMPARED: usize = 64;

/// The form in which names are compared: letters and digits in lower case.
#[must_use]
pub fn plain(name: &str) -> String {
    name.chars().filter(|character| character.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// A name for a message: its start, if it is longer than names are.
pub(super) fn shortened(name: &str) -> String {
    let start: String = name.chars().take(COMPARED).collect();
    if start.len() < name.len() { start + "…" } else { start }
}

/// The four of `names` that take the fewest edits to become `wanted`, with or without what stands before their slash.
pub(super) fn nearest(wanted: &str, mut names: Vec<String>) -> Vec<String> {
    let wanted: String = plain(wanted).chars().take(COMPARED).collect();
    names.sort_by_cached_key(|name| {
        let short = name.split_once('/').map_or(name.as_str(), |(_, short)| short);
        edits(&wanted, &plain(short)).min(edits(&wanted, &plain(name)))
    });
    names.truncate(4);
    names
}

/// Letters to insert, delete or replace to turn one word into the other (Levenshtein 1966).
fn edits(from: &str, to: &str) -> usize {
    let to: Vec<_> = to.chars().take(COMPARED).collect();
    let mut row: Vec<_> = (0..=to.len()).collect();
    for letter in from.chars() {
        let mut diagonal = row[0];
        row[0] += 1;
        for column in 1..row.len() {
            let replaced = diagonal + usize::from(to[column - 1] != letter);
            diagonal = row[column];
            row[column] = replaced.min(diagonal + 1).min(row[column - 1] + 1);
        }
    }
    row[to.len()]
}
