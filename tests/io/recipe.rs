//! Recipes and files of paints.

use overpaint::{
    data::Recipe,
    io::{
        IoError,
        paints::{self, Found},
        recipe,
    },
    model::{Layer, Paint, Pattern, Placement, color::linear_from_srgb, pigments},
};
use tempfile::TempDir;

use super::corpus::recipe::exercise;
use crate::support::{hold, worst_difference};

crate::suite! { plain:
    a_full_recipe_is_read,
    what_is_left_out_has_its_default,
    kinds_without_settings_are_texts,
    files_of_paints_are_found_beside_the_recipe,
    colours_in_every_notation_are_the_same,
    mixtures_have_the_unit_of_their_parts,
    examples_in_the_documentation_are_right,
    no_prefix_and_no_other_byte_panics;
}

const FULL: &str = include_str!("../fuzz/corpus/recipe/full.toml");

/// A folder with files.
pub fn folder(files: &[(&str, &[u8])]) -> TempDir {
    let folder = tempfile::tempdir().expect("is writable");
    for (name, bytes) in files {
        std::fs::write(folder.path().join(name), bytes).expect("is writable");
    }
    folder
}

/// The recipe r.toml of a folder.
pub fn load(folder: &TempDir) -> Result<Recipe, IoError> {
    recipe::load(&folder.path().join("r.toml"))
}

fn library(name: &str) -> Paint {
    pigments::find(name).expect("is in the library").into()
}

/// Linear reflectances of sRGB codes.
fn linear(codes: [u8; 3]) -> [f64; 3] {
    codes.map(|code| linear_from_srgb(f64::from(code) / 255.0))
}

fn a_full_recipe_is_read() {
    let read = load(&folder(&[("r.toml", FULL.as_bytes())])).expect("is a recipe");
    let least = Paint::LEAST_DIFFERENCE;
    let teal = Paint::from_reflectances("teal", linear([0x1d, 0x8f, 0x8a]), linear([10, 60, 58]), 2.0, least).expect("is a film");
    let wash = Paint::from_reflectances("wash", [0.002, 0.5, 0.6], [0.001, 0.2, 0.1], 1.0, 0.0).expect("is a film");
    let ink = Paint { name: "ink".to_owned(), k: [2.0, 1.5, 0.1], s: [0.0, 0.0, 1.0] };
    let pale = Paint::mixture("pale teal", &[(1.0, teal.clone()), (3.0, library("oil/titanium white"))]).expect("is possible");
    let with = |paint: &Paint, thickness, pattern| Layer { pattern, ..Layer::new(paint.clone(), thickness, 0.0) };
    let splash = Layer {
        paint: library("oil/cobalt blue"),
        pattern: Pattern::Splash { seed: 3 },
        placement: Placement { tiling: [1, 2], offset: [0.1, -2.0], rotation: 30.0_f64.to_radians(), size: 0.8 },
        thickness: 4.0,
        relief: 1.5,
        refractive_index: 1.4,
        roughness: 0.25,
    };
    let mut expected = Recipe {
        repeat: [2, 3],
        layers: vec![
            Layer::new(pale, 2.0, 0.0),
            splash,
            with(&ink, 0.5, Pattern::Flower { seed: 4, petals: 7 }),
            with(&wash, 1.0, Pattern::Brush { seed: 5, width: 0.2 }),
            with(&library("oil/cadmium yellow"), 1.0, Pattern::Spatter { seed: 6, cover: 0.5 }),
            with(&library("watercolour/cadmium yellow"), 1.0, Pattern::Stripes { count: 12, width: 0.25 }),
            with(&teal, 1.0, Pattern::Noise { seed: u32::MAX, count: 3 }),
            with(&teal, 1.0, Pattern::Uniform { drawn: 0.5 }),
        ],
        images: Vec::new(),
    };
    // Colours pass through f32, whose last place is 6e-8; K and S of these films multiply it by 2 to 5.
    for (read, expected) in read.layers.iter().zip(&mut expected.layers) {
        let coefficients = |paint: &Paint| [paint.k, paint.s].concat();
        hold("recipe: colours", worst_difference(coefficients(&read.paint), coefficients(&expected.paint)), 1e-6);
        if ["teal", "pale teal"].contains(&expected.paint.name.as_str()) {
            (expected.paint.k, expected.paint.s) = (read.paint.k, read.paint.s);
        }
    }
    assert_eq!(read, expected);
}

fn what_is_left_out_has_its_default() {
    let parse = |text: &str| recipe::parse("r.toml", text.as_bytes(), "nowhere".as_ref()).expect("is a recipe");
    let layer = Layer::new(library("oil/viridian"), 4.0, 0.0);
    assert_eq!(parse("[[layer]]\npaint = \"viridian\"\nthickness = 4"), Recipe::of(layer.clone()));
    let tables = "[canvas]\n[paints]\n[[layer]]\npaint = \"viridian\"\nthickness = 4\n[layer.pattern]\nkind = \"uniform\"\n[layer.placement]\n";
    assert_eq!(parse(tables), Recipe::of(layer));
}

fn kinds_without_settings_are_texts() {
    let kinds = [
        ("uniform", Pattern::Uniform { drawn: 1.0 }),
        ("splash", Pattern::Splash { seed: 1 }),
        ("flower", Pattern::Flower { seed: 1, petals: 6 }),
        ("brush", Pattern::Brush { seed: 1, width: 0.3 }),
        ("spatter", Pattern::Spatter { seed: 1, cover: 0.3 }),
        ("stripes", Pattern::Stripes { count: 8, width: 0.5 }),
        ("noise", Pattern::Noise { seed: 1, count: 8 }),
    ];
    for (kind, expected) in kinds {
        for pattern in [format!("\"{kind}\""), format!("{{ kind = \"{kind}\" }}")] {
            let text = format!("[[layer]]\npaint = \"viridian\"\nthickness = 4\npattern = {pattern}");
            let read = recipe::parse("r.toml", text.as_bytes(), "nowhere".as_ref()).expect("is a recipe");
            assert_eq!(read.layers[0].pattern, expected);
        }
    }
}

fn files_of_paints_are_found_beside_the_recipe() {
    let ochre = "[paints.ochre]\nk = [0.06, 0.43, 0.9]\ns = [0.2, 0.2, 0.1]\nunit = \"oil\"\n";
    let light = "[paints.light]\nmix = { \"oil/titanium white\" = 1 }\n";
    let text = "library = [\"a.toml\", \"b.toml\"]\n[paints.sand]\nmix = { ochre = 1, Light = 2 }\n[[layer]]\npaint = \"sand\"\nthickness = 1\n";
    let folder = folder(&[("r.toml", text.as_bytes()), ("a.toml", ochre.as_bytes()), ("b.toml", light.as_bytes())]);
    let read = load(&folder).expect("is a recipe");
    let ochre = Paint { name: "ochre".to_owned(), k: [0.06, 0.43, 0.9], s: [0.2, 0.2, 0.1] };
    let sand = Paint::mixture("sand", &[(1.0, ochre.clone()), (2.0, library("oil/titanium white"))]).expect("is possible");
    let found = &read.layers[0].paint;
    hold("recipe: mixture", worst_difference([found.k, found.s].concat(), [sand.k, sand.s].concat()), 1e-15);

    let paints = paints::load(&folder.path().join("a.toml")).expect("is a file of paints");
    let own: Vec<_> = paints.own().map(|own| (&own.paint, own.unit.as_deref(), own.source.as_deref())).collect();
    assert_eq!(own, [(&ochre, Some("oil"), None)]);
    assert!(matches!(paints.find("OCHRE"), Ok(Found::Own(own)) if own.paint == ochre));
    assert!(matches!(paints.find("oil/viridian"), Ok(Found::Library(pigment)) if pigment.name == "Viridian"));
}

/// The same colour in all notations, to the digits that are written.
fn colours_in_every_notation_are_the_same() {
    let notations = [
        "\"#336699\"",
        "\"#369\"",
        "\"#336699ff\"",
        "\" RGB(51, 102, 153) \"",
        "\"rgb(20% 40% 60%)\"",
        "\"rgba(51 102 153 / 100%)\"",
        "\"hsl(210 50% 40%)\"",
        "\"hwb(210 20% 40%)\"",
        "\"lab(41.5208% -4.5731 -33.4942)\"",
        "\"lch(41.5208% 33.8049 262.2253)\"",
        "\"oklab(49.93145% -0.033043 -0.092967)\"",
        "\"oklch(49.93145% 0.098664 250.43306)\"",
        "\"color(srgb 0.2 0.4 0.6)\"",
        "[0.033104766570885055, 0.13286832155381795, 0.31854677812509186]",
    ];
    let expected = Paint::from_reflectances("p", linear([0x33, 0x66, 0x99]), [0.01; 3], 1.0, 0.0).expect("is a film");
    for notation in notations {
        let text = format!("[paints.p]\nover_white = {notation}\nover_black = [0.01, 0.01, 0.01]\n");
        let paints = paints::parse("p.toml", text.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
        let found = paints.find("p").expect("is there").paint();
        // Lab and LCh are written to four decimals of 100, OKLab to six of 1.
        hold("recipe: notations", worst_difference([found.k, found.s].concat(), [expected.k, expected.s].concat()), 5e-5);
    }
}

fn mixtures_have_the_unit_of_their_parts() {
    let text = "[paints.a]\nk = [1, 1, 1]\ns = [1, 1, 1]\n[paints.b]\nmix = { a = 1, viridian = 3 }\n[paints.c]\nmix = { a = 1, a2 = 1 }\n\
                [paints.\"a 2\"]\nmix = { A = 0.5 }\nsource = \"none\"\n";
    let paints = paints::parse("p.toml", text.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
    let told: Vec<_> = paints.own().map(|own| (own.paint.name.as_str(), own.unit.as_deref(), own.source.as_deref())).collect();
    assert_eq!(
        told,
        [
            ("a", None, None),
            ("a 2", None, Some("none")),
            ("b", Some("oil"), Some("mixed of 1 a, 3 oil/viridian")),
            ("c", None, Some("mixed of 1 a, 1 a 2")),
        ]
    );
}

fn examples_in_the_documentation_are_right() {
    let block = |text: &str| {
        let plain = text.replace("//! ", "").replace("//!", "");
        let (_, rest) = plain.split_once("```toml\n").expect("has an example");
        rest.split("```").next().unwrap_or_default().to_owned()
    };
    let [readme, recipes, own] =
        [include_str!("../../README.md"), include_str!("../../src/io/recipe/mod.rs"), include_str!("../../src/io/paints/mod.rs")].map(block);
    let paints = paints::parse("p.toml", own.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(paints.own().count(), 3);
    let mut leaf = std::io::Cursor::new(Vec::new());
    image::GrayImage::new(3, 2).write_to(&mut leaf, image::ImageFormat::Png).expect("encodes");
    for (text, layers) in [(readme, 2), (recipes, 3)] {
        let ochre = b"[paints.ochre]\nk = [1, 1, 1]\ns = [1, 1, 1]\n";
        let read = load(&folder(&[("r.toml", text.as_bytes()), ("my_paints.toml", ochre), ("leaf.png", leaf.get_ref())]));
        assert_eq!(read.unwrap_or_else(|error| panic!("{error}")).layers.len(), layers);
    }
}

fn no_prefix_and_no_other_byte_panics() {
    let bytes = FULL.as_bytes();
    for end in 0..=bytes.len() {
        exercise(&bytes[..end]);
    }
    let mut changed = bytes.to_vec();
    for at in 0..bytes.len() {
        for byte in [b'"', b'\n', b']', b'9', 0xff, bytes[at] ^ 1] {
            changed[at] = byte;
            exercise(&changed);
        }
        changed[at] = bytes[at];
    }
}
