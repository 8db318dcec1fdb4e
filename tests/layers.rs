//! Who may name whom: Rust allows cycles between the modules of a crate, so this table forbids them.

use std::{collections::BTreeSet, path::Path};

crate::suite! { plain: modules_name_only_what_they_may, names_are_found_however_they_are_reached; }

/// A module and the modules of the crate that its files may name.
const MAY_NAME: &[(&str, &[&str])] = &[
    ("model", &[]),
    ("data", &["model"]),
    ("gpu", &[]),
    ("wgsl", &["gpu"]),
    ("io", &["model", "data"]),
    ("reference", &["model", "data"]),
    ("stage", &["model", "data", "gpu", "wgsl"]),
    ("render", &["model", "data", "gpu", "stage", "wgsl"]),
    ("pipeline", &["model", "data", "gpu", "io", "stage", "render"]),
    ("view", &["model", "data", "gpu", "io", "stage", "render"]),
    ("cli", &["model", "data", "gpu", "io", "pipeline", "view"]),
];

fn modules_name_only_what_they_may() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut modules = BTreeSet::new();
    let mut wrong = Vec::new();
    visit(&root, &mut |file| {
        let below = file.strip_prefix(&root).expect("is below src");
        let module = below.iter().next().and_then(|part| part.to_str()).expect("is ASCII").trim_end_matches(".rs").to_owned();
        if ["lib", "main"].contains(&module.as_str()) {
            return;
        }
        let Some((_, allowed)) = MAY_NAME.iter().find(|(name, _)| *name == module) else {
            wrong.push(format!("{}: module \"{module}\" is not in the table", below.display()));
            return;
        };
        let depth = below.with_extension("").iter().filter(|part| *part != "mod").count();
        for named in named_modules(&std::fs::read_to_string(file).expect("is readable"), depth) {
            if named != module && !allowed.contains(&named.as_str()) && MAY_NAME.iter().any(|(name, _)| *name == named) {
                wrong.push(format!("{}: {module} may not name {named}", below.display()));
            }
        }
        modules.insert(module);
    });
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(modules.len() > 4, "only {modules:?} were found");
}

fn visit(folder: &Path, found: &mut dyn FnMut(&Path)) {
    for entry in std::fs::read_dir(folder).expect("is there") {
        let path = entry.expect("is readable").path();
        if path.is_dir() {
            visit(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found(&path);
        }
    }
}

/// First path segments below the crate's root, after `crate::` or a chain of `super::` that climbs there from a file `depth` modules
/// deep (also inside `{…}`), comments left out.
fn named_modules(text: &str, depth: usize) -> BTreeSet<String> {
    let code: String = text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n");
    let mut names = BTreeSet::new();
    for (start, root) in code.match_indices("crate::") {
        add_names(&code[start + root.len()..], &mut names);
    }
    for (start, _) in code.match_indices("super::").filter(|(start, _)| !code[..*start].ends_with("super::")) {
        let rest = code[start..].trim_start_matches("super::");
        let climbed = (code.len() - start - rest.len()) / "super::".len();
        if climbed >= depth + inline_modules(&code[..start]) {
            add_names(rest, &mut names);
        }
    }
    names
}

/// How many modules with a body of their own are open at the end of `code`.
fn inline_modules(code: &str) -> usize {
    let mut open = Vec::new();
    for (at, brace) in code.match_indices(['{', '}']) {
        if brace == "{" {
            open.push(code[..at].split_whitespace().rev().nth(1) == Some("mod"));
        } else {
            open.pop();
        }
    }
    open.into_iter().filter(|is_module| *is_module).count()
}

/// Adds the first segment of a path, or of each path of a list.
fn add_names(path: &str, names: &mut BTreeSet<String>) {
    let Some(list) = path.strip_prefix('{') else {
        names.insert(first_segment(path));
        return;
    };
    let mut depth = 0;
    let mut name = String::new();
    for character in list.chars() {
        match character {
            '}' if depth == 0 => break,
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                names.insert(first_segment(&name));
                name.clear();
                continue;
            }
            _ => {}
        }
        name.push(character);
    }
    names.insert(first_segment(&name));
}

fn first_segment(path: &str) -> String {
    path.trim_start().chars().take_while(|character| character.is_alphanumeric() || *character == '_').collect()
}

fn names_are_found_however_they_are_reached() {
    let found = |text, depth| named_modules(text, depth).into_iter().filter(|name| !name.is_empty()).collect::<Vec<_>>();
    assert_eq!(found("use crate::gpu::Gpu; // crate::io", 2), ["gpu"]);
    assert_eq!(found("use crate::{data::{Map, OCTET}, model};", 2), ["data", "model"]);
    assert_eq!(found("use super::super::stage;", 2), ["stage"]);
    assert_eq!(found("use super::super::{stage::Tile, io};", 2), ["io", "stage"]);
    assert_eq!(found("use super::stage;", 1), ["stage"]);
    assert_eq!(found("use super::super::stage;", 3), [""; 0]);
    assert_eq!(found("fn f() {} mod tests { use super::super::stage; }", 2), [""; 0]);
    assert_eq!(found("mod tests { use super::super::super::stage; }", 2), ["stage"]);
    assert_eq!(found("mod tests { fn f() {} } fn g() { super::super::io::f() }", 2), ["io"]);
}
