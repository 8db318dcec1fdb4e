use std::path::Path;

use super::overpaint;

crate::suite! { plain: every_subcommand_has_help_with_examples, help_lists_every_subcommand, the_version_is_the_package_s; }

const SUBCOMMANDS: [&str; 13] =
    ["compare", "demo", "export", "figures", "fit", "import", "info", "paint", "paints", "reconstruct", "render", "synth", "adapters"];

fn every_subcommand_has_help_with_examples() {
    for subcommand in SUBCOMMANDS {
        let ran = overpaint(Path::new("."), &[subcommand, "--help"]);
        assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""), "{subcommand}");
        let example = format!("\n  overpaint {subcommand}");
        assert!(ran.stdout.contains("Examples:") && ran.stdout.contains(&example), "{}", ran.stdout);
    }
}

fn help_lists_every_subcommand() {
    let ran = overpaint(Path::new("."), &["--help"]);
    assert_eq!(ran.code, Some(0));
    for subcommand in SUBCOMMANDS {
        assert!(ran.stdout.contains(&format!("\n  {subcommand} ")), "{subcommand} in {}", ran.stdout);
    }
}

fn the_version_is_the_package_s() {
    let ran = overpaint(Path::new("."), &["--version"]);
    assert_eq!((ran.code, ran.stdout.trim()), (Some(0), concat!("overpaint ", env!("CARGO_PKG_VERSION"))));
}
