//! Recipes and files of paints that are wrong, and what is said of them.

use overpaint::io::recipe;

use super::recipe::folder;

crate::suite! { plain:
    wrong_recipes_say_where_and_what,
    columns_are_characters,
    of_long_lines_a_part_is_shown,
    what_is_no_text_is_refused,
    too_many_of_anything_are_refused;
}

/// Recipes, each followed by `----` and its whole error, then `====`.
const WRONG: &str = include_str!("wrong_recipes.txt");

fn refused(text: &[u8]) -> String {
    let ochre = b"[paints.ochre]\nk = [0.06, 0.43, 0.9]\ns = [0.2, 0.2, 0.1]\n";
    let folder = folder(&[("ochre.toml", ochre), ("ochre2.toml", ochre), ("broken.toml", b"[paints.mud]\nk = 1\n")]);
    let error = recipe::parse("r.toml", text, folder.path()).expect_err("is wrong").to_string();
    error.replace(&format!("{}{}", folder.path().display(), std::path::MAIN_SEPARATOR), "")
}

fn wrong_recipes_say_where_and_what() {
    let cases: Vec<_> = WRONG.split("====\n").collect();
    assert!(cases.len() >= 50);
    for case in cases {
        let (text, expected) = case.split_once("----\n").expect("has an error");
        // The system's own words for a file that is not there are left out.
        let error = refused(text.as_bytes()).lines().map(|line| line.split(": No such").next().unwrap_or(line).trim_end()).collect::<Vec<_>>().join("\n");
        assert_eq!(error, expected.trim_end(), "{text}");
    }
}

fn columns_are_characters() {
    let error = refused("[canvas]\r\n\t\"repeat\" = [\"äöü\", true] # größer\r\n".as_bytes());
    let expected = "r.toml:2:14: \"repeat\" must be a number, found the string \"äöü\"\n   |\n 2 |  \"repeat\" = [\"äöü\", true] # größer\n   |              ^^^^^";
    assert_eq!(error, expected);
    let error = refused("paints.\"größe\" = { k = 1 }".as_bytes());
    assert!(error.ends_with("\n 1 | paints.\"größe\" = { k = 1 }\n   |                        ^"), "{error}");
}

fn of_long_lines_a_part_is_shown() {
    let error = refused(format!("[canvas] # {}\nrepeat = [{}1, 2, 3]\n", "x".repeat(500), " ".repeat(500)).as_bytes());
    assert!(error.starts_with("r.toml:2:10: \"repeat\" must be two whole numbers, of columns and rows, found an array of 3\n"), "{error}");
    let error = refused(format!("layer = [{}true]", "1,".repeat(300)).as_bytes());
    let expected = format!("r.toml:1:522: 301 layers are more than the 256 that are read; take fewer\n   |\n 1 | {}1\n   | {}^", ",1".repeat(59) + ",", " ".repeat(59));
    assert_eq!(error, expected);
    let long = "p".repeat(500_000);
    for text in [
        format!("{long} = 1"),
        format!("[[layer]]\nthickness = 1\npaint = \"{long}\""),
        format!("[[layer]]\nthickness = 1\npaint = \"viridian\"\npattern = \"{long}\""),
        format!("[paints.{long}]\nk = 1"),
        format!("[paints.a]\nover_white = \"{long}\"\nover_black = \"black\""),
        format!("library = \"{long}\""),
    ] {
        let length = refused(text.as_bytes()).len();
        assert!(length < 700, "{}… has an error of {length} bytes", &text[..20]);
    }
}

fn what_is_no_text_is_refused() {
    let error = refused(b"[canvas]\nrepeat = \"\xff\"\n");
    assert_eq!(error, "r.toml:2:11: this is not UTF-8; save the file as UTF-8\n   |\n 2 | repeat = \"\n   |           ^");
    assert!(refused(b"\xef\xbb\xbf[canvas]\n").starts_with("r.toml:1:1: the recipe has no layers"));
    let error = refused(&[0; 100]);
    assert!(error.starts_with("r.toml:1:101: this is not TOML: key with no value"), "{error}");
}

fn too_many_of_anything_are_refused() {
    let layers = "[[layer]]\npaint = \"viridian\"\nthickness = 1\n";
    assert!(recipe::parse("r.toml", layers.repeat(256).as_bytes(), "nowhere".as_ref()).is_ok());
    let error = refused(layers.repeat(257).as_bytes());
    assert!(error.starts_with("r.toml:769:1: 257 layers are more than the 256 that are read; take fewer\n"), "{error}");

    // A chain of mixtures, the last one first.
    let chain = |length: usize| -> String { (0..length).map(|paint| format!("[paints.p{paint}]\nmix = {{ p{} = 1 }}\n", paint + 1)).collect() };
    let end = "[paints.p255]\nmix = { viridian = 1 }\n[[layer]]\npaint = \"p0\"\nthickness = 1\n";
    let read = recipe::parse("r.toml", (chain(255) + end).as_bytes(), "nowhere".as_ref()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(read.layers[0].paint.k, [2.16451, 0.0307374, 0.305753]);
    let error = refused(chain(300).as_bytes());
    assert!(error.starts_with("r.toml:513:1: 300 paints are more than the 256"), "{error}");
    let error = refused(format!("{}[paints.p255]\nmix = {{ p0 = 1 }}\n", chain(255)).as_bytes());
    assert!(error.contains("in a circle"), "{error}");

    let parts: String = (0..33).map(|part| format!("p{part} = 1,")).collect();
    let error = refused(format!("[paints.all]\nmix = {{ {parts} }}\n").as_bytes());
    assert!(error.starts_with("r.toml:2:7: a mixture has from 1 to 32 parts, found 33"), "{error}");
    let error = refused(format!("library = [{}]", "\"ochre.toml\",".repeat(17)).as_bytes());
    assert!(error.starts_with("r.toml:1:220: 17 files of paints are more than the 16"), "{error}");
}
