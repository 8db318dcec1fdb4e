//! What is listed of paints.

use std::{fs, path::Path};

use overpaint::model::pigments;
use serde_json::{Value, json};

use super::{overpaint, refused};

crate::suite! { plain: the_library_is_listed, own_paints_are_listed_after_it, json_has_every_digit, wrong_files_are_refused_by_their_line; }

const OWN: &str = "\
[paints.ochre]
k = [0.0612345, 0.4, 0.9]
s = [0.2, 0.2, 0]
unit = \"oil\"
source = \"a card\"

[paints.tint]
mix = { ochre = 1, \"oil/titanium white\" = 3 }
";

fn the_library_is_listed() {
    let ran = overpaint(Path::new("."), &["paints"]);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    for pigment in pigments::all() {
        assert_eq!(ran.stdout.matches(&format!("\n  {} ", pigment.full_name())).count(), 1, "{}", ran.stdout);
    }
    assert!(ran.stdout.starts_with("watercolour: thickness 1 is the swatch of Curtis et al. 1997\n"), "{}", ran.stdout);
    assert!(ran.stdout.contains("\noil (substitutes): thickness 1 is "), "{}", ran.stdout);
    let line = ran.stdout.lines().find(|line| line.contains("oil/cobalt blue")).expect("is listed");
    let words: Vec<_> = line.split_whitespace().collect();
    let expected = ["oil/cobalt", "blue", "0.1707", "0.1267", "0.007906", "0.03292", "0.01938", "0.03832", "#5149c1", "#dbe4fd", "A", "PB28"];
    assert_eq!(words[..12], expected);
}

fn own_paints_are_listed_after_it() {
    let folder = tempfile::tempdir().expect("is made");
    fs::write(folder.path().join("mine.toml"), OWN).expect("is written");
    let ran = overpaint(folder.path(), &["paints", "--library", "mine.toml"]);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    let (library, own) = ran.stdout.split_once("\nmine.toml\n").expect("is headed by the file");
    assert!(library.contains("oil/viridian"));
    let lines: Vec<_> = own.lines().skip(1).take(2).map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
    let [ochre, tint] = lines.as_slice() else { panic!("{own}") };
    assert!(ochre.starts_with("ochre 0.06123 0.4 0.9 0.2 0.2 0 #") && ochre.ends_with(" own a card; unit: oil"), "{ochre}");
    assert!(tint.ends_with(" own mixed of 1 ochre, 3 oil/titanium white; unit: oil"), "{tint}");
}

fn json_has_every_digit() {
    let folder = tempfile::tempdir().expect("is made");
    fs::write(folder.path().join("mine.toml"), OWN).expect("is written");
    let ran = overpaint(folder.path(), &["paints", "--library", "mine.toml", "--json"]);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    let told: Value = serde_json::from_str(&ran.stdout).expect("is JSON");
    let paints = told["paints"].as_array().expect("is a list");
    assert_eq!(paints.len(), 22);
    let find = |name: &str| paints.iter().find(|paint| paint["name"] == name).expect("is listed");
    let viridian = find("oil/viridian");
    assert_eq!(viridian["k"], json!([2.16451, 0.0307374, 0.305753]));
    assert_eq!([&viridian["grade"], &viridian["substitute"], &viridian["file"]], [&json!("B"), &json!(true), &Value::Null]);
    let ochre = find("ochre");
    assert_eq!([&ochre["k"][0], &ochre["file"], &ochre["unit"]], [&json!(0.0612345), &json!("mine.toml"), &json!("oil")]);
    assert_eq!(ochre["opaque"][2], 0.0, "nothing scatters blue");
    assert_eq!(find("watercolour/indian red")["substitute"], false);
}

fn wrong_files_are_refused_by_their_line() {
    let folder = tempfile::tempdir().expect("is made");
    fs::write(folder.path().join("mine.toml"), "[paints.mud]\nk = [1, 2]\ns = [1, 2, 3]\n").expect("is written");
    let ran = overpaint(folder.path(), &["paints", "--library", "mine.toml"]);
    assert_eq!(ran.code, Some(1));
    let expected = "error: mine.toml:2:5: \"k\" must be three numbers, of red, green and blue, found an array of 2
   |
 2 | k = [1, 2]
   |     ^^^^^^
";
    assert_eq!((ran.stdout.as_str(), ran.stderr.as_str()), ("", expected));
    refused(&overpaint(folder.path(), &["paints", "--library", "nowhere.toml"]), 1, "cannot read nowhere.toml");
    refused(&overpaint(folder.path(), &["paints", "--library", "."]), 1, "cannot read .");
    fs::write(folder.path().join("long.toml"), vec![b'#'; (1 << 20) + 1]).expect("is written");
    refused(&overpaint(folder.path(), &["paints", "--library", "long.toml"]), 1, "long.toml holds more than 1048576 bytes");
}
