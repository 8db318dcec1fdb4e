use super::{overpaint, refused};

crate::suite! { plain: nothing_typed_shows_the_help, values_out_of_range_are_usage_errors, what_belongs_together_is_asked_for_together; }

fn nothing_typed_shows_the_help() {
    let folder = tempfile::tempdir().expect("is made");
    let ran = overpaint(folder.path(), &[]);
    assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""));
    assert!(ran.stderr.contains("Usage: overpaint"), "{}", ran.stderr);
}

/// (arguments, what the error says).
const OUT_OF_RANGE: &[(&[&str], &str)] = &[
    (&["synth", "-o", "s", "--size", "0"], "expected a side or WxH"),
    (&["synth", "-o", "s", "--size", "64x"], "expected a side or WxH"),
    (&["synth", "-o", "s", "--size", "9000"], "expected a side or WxH"),
    (&["synth", "-o", "s", "--relief", "-1"], "expected texel widths from 0 to 256"),
    (&["synth", "-o", "s", "--relief", "NaN"], "expected texel widths from 0 to 256"),
    (&["synth", "-o", "s", "--views", "ubo"], "expected zenith, ubo81, ubo151"),
    (&["synth", "-o", "s", "--lights", "30:4,90:6"], "expected zenith, ubo81, ubo151"),
    (&["synth", "-o", "s", "--height-field", "hills"], "invalid value 'hills'"),
    (&["synth", "-o", "s", "--reflectance", "glass"], "invalid value 'glass'"),
    (&["synth", "-o", "s", "--tree", "bmp"], "invalid value 'bmp'"),
    (&["synth", "-o", "s", "--tree", "jpg", "--quality", "0"], "0 is not in 1..=100"),
    (&["compare", "s", "m", "-o", "c", "--texel", "5"], "expected X,Y"),
    (&["compare", "s", "m", "-o", "c", "--texel", "-1,0"], "expected X,Y"),
    (&["compare", "s", "m", "-o", "c", "--texel", "1,2", "--texel", "3,4"], "cannot be used multiple times"),
    (&["compare", "s", "m", "-o", "c", "--memory", "1KiB"], "expected an amount of memory"),
    (&["varnish"], "unrecognized subcommand 'varnish'"),
    (&["reconstruct", "m", "--view", "90,0", "--light", "0,0", "-o", "a.png"], "THETA must be from 0 to below 90"),
    (&["reconstruct", "m", "--view", "-1,0", "--light", "0,0", "-o", "a.png"], "THETA must be from 0 to below 90"),
    (&["reconstruct", "m", "--view", "NaN,0", "--light", "0,0", "-o", "a.png"], "expected THETA,PHI"),
    (&["reconstruct", "m", "--view", "0,0", "--light", "30,inf", "-o", "a.png"], "expected THETA,PHI"),
    (&["reconstruct", "m", "--view", "30", "--light", "0,0", "-o", "a.png"], "expected THETA,PHI"),
    (&["reconstruct", "m", "--view", "0,0", "--light", "0,0", "-o", "a.jpg"], "ends in .png"),
    (&["reconstruct", "m", "--view", "0,0", "--light", "0,0", "-o", "a"], "ends in .png"),
    (&["reconstruct", "m", "--view", "0,0", "--light", "0,0", "-o", "a.png", "--model", "phong"], "invalid value 'phong'"),
    (&["reconstruct", "m", "--view", "0,0", "--light", "0,0", "-o", "a.png", "--model", "lpca", "--texel-samples", "16"], "invalid value '16'"),
    (&["reconstruct", "m", "--view", "0,0", "--light", "0,0", "-o", "a.png", "--texel-samples", "9"], "is for --model lpca"),
    (&["reconstruct", "m", "--view", "0,0", "--light", "0,0", "-o", "a.png", "--sweep", "1"], "1 is not in 2..=256"),
    (&["reconstruct", "m", "--view", "0,0", "--light", "0,0", "-o", "a.png", "--sweep", "4", "--to-light", "90,0"], "THETA must be from 0"),
    (&["compare", "s", "m", "-o", "c", "--model", "btf"], "invalid value 'btf'"),
    (&["compare", "s", "m", "-o", "c", "--model", "lpca", "--no-relief"], "leave them out with --model lpca"),
    (&["compare", "s", "m", "-o", "c", "--model", "lpca", "--texel", "1,2"], "leave them out with --model lpca"),
    (&["render", "m", "--size", "0x0", "-o", "a.png"], "expected WxH"),
    (&["render", "m", "--size", "512", "-o", "a.png"], "expected WxH"),
    (&["render", "m", "--size", "32769x1", "-o", "a.png"], "expected WxH"),
    (&["render", "m", "--size", "-5x5", "-o", "a.png"], "expected WxH"),
    (&["render", "m", "--paint", "viridian", "--thickness", "-0.1", "-o", "a.png"], "expected a number of 0 or more"),
    (&["render", "m", "--paint", "viridian", "--thickness", "NaN", "-o", "a.png"], "expected a number of 0 or more"),
    (&["render", "m", "--paint", "viridian", "--thickness", "1", "--relief", "-1", "-o", "a.png"], "expected a number of 0 or more"),
    (
        &["render", "m", "--paint", "viridian", "--thickness", "1", "--refractive-index", "0.9", "-o", "a.png"],
        "expected a number of 1 or more",
    ),
    (&["render", "m", "--paint", "viridian", "--thickness", "1", "--roughness", "0", "-o", "a.png"], "above 0, up to 1"),
    (&["render", "m", "--paint", "viridian", "--thickness", "1", "--pattern", "brush", "--width", "0.9", "-o", "a.png"], "at least 0.01 and at most 0.5"),
    (&["render", "m", "--paint", "viridian", "--thickness", "1e30", "-o", "a.png"], "at most 1e6"),
    (&["render", "m", "--paint", "viridian", "--thickness", "1", "--pattern", "dots", "-o", "a.png"], "invalid value 'dots'"),
    (&["render", "m", "--paint", "no such paint", "--thickness", "1", "-o", "a.png"], "no paint is called \"no such paint\""),
    (&["fit", "s", "-o", "m", "--steps", "0"], "0 is not in 1..=10000"),
    (&["fit", "s", "-o", "m", "--iterations", "-1"], "-1 is not in 1..=1000"),
    (&["fit", "s", "-o", "m", "--boundary", "torus"], "invalid value 'torus'"),
    (&["fit", "s", "-o", "m", "--stereo", "median"], "invalid value 'median'"),
    (&["fit", "s", "-o", "m", "--specular-scale", "guess"], "invalid value 'guess'"),
    (&["fit", "s", "-o", "m", "--diffuse-quantile", "1.5"], "expected a number from 0 to 1"),
    (&["fit", "s", "-o", "m", "--max-slope", "inf"], "expected a number above 0"),
    (&["fit", "s", "-o", "m", "--transfer", "gamma:0"], "expected srgb, linear, or gamma and a number above 0"),
    (&["info", "s", "--transfer", "gamma"], "such as gamma:2.2"),
    (&["info", "s", "--cosine", "maybe"], "invalid value 'maybe'"),
    (&["info", "s", "--rows", "sideways"], "invalid value 'sideways'"),
    (&["info", "s", "--scale", "-1"], "expected a number above 0"),
    (&["info", "s", "--region", "0,0,0x5"], "expected X,Y,WxH"),
    (&["info", "s", "--region", "-1,0,5x5"], "expected X,Y,WxH"),
    (&["info", "s", "--region", "5x5"], "such as 64,0,128x128"),
    (&["info", "s", "--every", "0"], "expected an integer of 1 or more"),
    (&["info", "s", "--max-theta", "91"], "from 0 to 90 degrees"),
    (&["info", "s", "--max-theta", "NaN"], "from 0 to 90 degrees"),
];

fn values_out_of_range_are_usage_errors() {
    let folder = tempfile::tempdir().expect("is made");
    for (arguments, says) in OUT_OF_RANGE {
        refused(&overpaint(folder.path(), arguments), 2, says);
    }
    assert_eq!(std::fs::read_dir(folder.path()).expect("is there").count(), 0, "a usage error leaves nothing behind");
}

fn what_belongs_together_is_asked_for_together() {
    let folder = tempfile::tempdir().expect("is made");
    let refuse = |arguments: &[&str], says: &str| refused(&overpaint(folder.path(), arguments), 2, says);
    refuse(&["synth", "--tree", "jpg"], "  --output <OUT>\n");
    refuse(&["synth", "-o", "s", "--quality", "90"], "  --tree <FORMAT>\n");
    refuse(&["render", "m"], "nothing says where the picture goes");
    refuse(&["render", "m", "--paint", "viridian", "-o", "a.png"], "  --thickness <D>\n");
    refuse(&["render", "m", "--pattern", "splash", "-o", "a.png"], "  --paint <NAME>\n");
    refuse(&["reconstruct", "m", "--view", "0,0", "--light", "0,0", "-o", "a.png", "--to-light", "30,0"], "  --sweep <N>\n");
    refuse(&["info", "m", "--timings", "t.json"], "leave them out here");
    refuse(&["adapters", "--adapter", "x"], "leave them out here");
    refuse(&["paints", "--adapter", "x"], "leave them out here");
}
