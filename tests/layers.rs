//! Who may name whom: Rust allows cycles between the modules of a crate, so this table forbids them.

use std::{collections::BTreeSet, path::Path};

crate::suite! { plain: modules_name_only_what_they_may; }

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
        for named in named_modules(&std::fs::read_to_string(file).expect("is readable")) {
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

/// First path segments after `crate::` (also inside `use crate::{…}`), comments left out.
fn named_modules(text: &str) -> BTreeSet<String> {
    let code: String = text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n");
    let mut names = BTreeSet::new();
    for (start, _) in code.match_indices("crate::") {
        let rest = &code[start + "crate::".len()..];
        if let Some(list) = rest.strip_prefix('{') {
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
        } else {
            names.insert(first_segment(rest));
        }
    }
    names
}

fn first_segment(path: &str) -> String {
    path.trim_start().chars().take_while(|character| character.is_alphanumeric() || *character == '_').collect()
}
