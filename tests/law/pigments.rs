use overpaint::model::{Layer, Paint, PaintError, Pattern, Placement, pigments, pigments::PigmentError};

crate::suite! { plain: names_are_found_however_written, a_name_in_both_sets_is_refused, an_unknown_name_lists_near_ones, the_library_is_sound, impossible_layers_are_refused, impossible_patterns_are_refused, impossible_placements_are_refused; }

fn names_are_found_however_written() {
    for name in ["Hooker's Green", "hookers green", "HOOKERS-GREEN", "watercolour/hookers green", "Watercolour / Hookers Green"] {
        assert_eq!(pigments::find(name).map(pigments::Pigment::full_name), Ok("watercolour/hookers green".to_owned()), "{name}");
    }
    assert_eq!(pigments::find("oil/cadmium yellow").map(|pigment| pigment.k[2]), Ok(2.58699));
    assert_eq!(pigments::find("watercolour/cadmium yellow").map(|pigment| pigment.k[2]), Ok(3.45));
}

fn a_name_in_both_sets_is_refused() {
    let error = pigments::find("cadmium yellow").expect_err("is in both sets").to_string();
    assert_eq!(error, "\"cadmium yellow\" stands for several paints. Choose one of \"watercolour/cadmium yellow\", \"oil/cadmium yellow\"");
}

fn an_unknown_name_lists_near_ones() {
    for (name, near) in [("prusian blu", "oil/prussian blue"), ("oil/veridian", "oil/viridian"), ("indian red.", "watercolour/indian red")]
    {
        match pigments::find(name) {
            Err(PigmentError::Unknown { near: listed, .. }) => assert!(listed.starts_with(&format!("\"{near}\"")), "{name}: {listed}"),
            found => assert_eq!(found.map(pigments::Pigment::full_name), Ok(near.to_owned())),
        }
    }
    assert!(matches!(pigments::find(""), Err(PigmentError::Unknown { .. })));
}

fn the_library_is_sound() {
    let [watercolours, oils] = pigments::PigmentSet::ALL.map(|set| set.pigments().len());
    assert_eq!((watercolours, oils), (12, 8));
    for pigment in pigments::all() {
        assert_eq!(pigments::find(&pigment.full_name()), Ok(pigment));
        assert!(pigment.k.iter().chain(&pigment.s).all(|value| *value > 0.0), "{}", pigment.name);
        Layer::new(pigment.into(), 1.0, 1.0).checked().expect("is possible");
    }
    assert_eq!(pigments::find("titanium white").map(|pigment| pigment.s), Ok([1.0; 3]), "the unit of the oils");
}

fn impossible_layers_are_refused() {
    let layer = || Layer::new(Paint { name: "mud".to_owned(), k: [0.1; 3], s: [0.2; 3] }, 1.0, 1.0);
    assert!(layer().checked().is_ok());
    let with = |change: fn(&mut Layer)| {
        let mut layer = layer();
        change(&mut layer);
        layer.checked().map_or_else(|error: PaintError| error.to_string(), |_| "accepted".to_owned())
    };
    assert_eq!(with(|layer| layer.paint.s[1] = -1.0), "S of paint \"mud\" in green is -1; it must be at least 0 and at most 1e6");
    assert_eq!(with(|layer| layer.paint.k[2] = f64::NAN), "K of paint \"mud\" in blue is NaN; it must be at least 0 and at most 1e6");
    assert_eq!(
        with(|layer| layer.thickness = f64::INFINITY),
        "thickness of the layer of \"mud\" is inf; it must be at least 0 and at most 1e6"
    );
    assert!(with(|layer| layer.relief = -0.5).starts_with("relief"));
    assert!(with(|layer| layer.refractive_index = 0.9).starts_with("refractive index"));
    assert!(with(|layer| layer.roughness = 0.0).starts_with("roughness"));
}

fn impossible_patterns_are_refused() {
    let found = |pattern: Pattern| pattern.checked().map_or_else(|error| error.to_string(), |_| "accepted".to_owned());
    for drawn in [0.0, 0.5, 1.0] {
        assert_eq!(found(Pattern::Uniform { drawn }), "accepted");
    }
    for pattern in [
        Pattern::Image { image: usize::MAX },
        Pattern::Splash { seed: 0 },
        Pattern::Flower { seed: 1, petals: 3 },
        Pattern::Flower { seed: 1, petals: 16 },
        Pattern::Brush { seed: 1, width: 0.01 },
        Pattern::Brush { seed: 1, width: 0.5 },
        Pattern::Spatter { seed: 1, cover: 0.9 },
        Pattern::Stripes { count: 1, width: 0.01 },
        Pattern::Stripes { count: 1000, width: 0.99 },
        Pattern::Noise { seed: 1, count: 1000 },
    ] {
        assert_eq!(found(pattern), "accepted", "{pattern:?}");
    }
    assert_eq!(found(Pattern::Uniform { drawn: 1.5 }), "the setting \"drawn\" of a uniform pattern is 1.5; it must be at least 0 and at most 1");
    assert_eq!(found(Pattern::Flower { seed: 1, petals: 2 }), "the setting \"petals\" of a flower is 2; it must be at least 3 and at most 16");
    let error = "the setting \"width\" of a brush stroke is 0.8; it must be at least 0.01 and at most 0.5 of the cell's shorter edge";
    assert_eq!(found(Pattern::Brush { seed: 1, width: 0.8 }), error);
    assert_eq!(found(Pattern::Spatter { seed: 1, cover: 0.0 }), "the setting \"cover\" of a spatter is 0; it must be above 0 and at most 0.9");
    assert_eq!(found(Pattern::Stripes { count: 0, width: 0.5 }), "the setting \"count\" of stripes is 0; it must be at least 1 and at most 1000");
    assert_eq!(found(Pattern::Stripes { count: 3, width: 1.0 }), "the setting \"width\" of stripes is 1; it must be above 0 and below 1");
    assert!(found(Pattern::Noise { seed: 1, count: 1001 }).starts_with("the setting \"count\" of noise is 1001"));
    for pattern in [
        Pattern::Uniform { drawn: f64::NAN },
        Pattern::Flower { seed: 1, petals: 17 },
        Pattern::Brush { seed: 1, width: f64::NAN },
        Pattern::Spatter { seed: 1, cover: f64::NAN },
        Pattern::Stripes { count: 1001, width: 0.5 },
        Pattern::Stripes { count: 3, width: f64::NAN },
        Pattern::Noise { seed: 1, count: 0 },
    ] {
        assert!(pattern.checked().is_err(), "{pattern:?}");
    }
}

fn impossible_placements_are_refused() {
    let default = Placement::default();
    for placement in [
        default,
        Placement { tiling: [1000, 1], offset: [-1e9, 1e9], rotation: -100.0, size: 4.0 },
        Placement { tiling: [1, 1000], size: 0.001, ..default },
    ] {
        assert_eq!(placement.checked(), Ok(placement));
    }
    let error = Placement { size: 5.0, ..default }.checked().expect_err("is too large").to_string();
    assert_eq!(error, "the setting \"size\" of a placement is 5; it must be at least 0.001 and at most 4");
    let error = Placement { tiling: [3, 0], ..default }.checked().expect_err("has no rows").to_string();
    assert_eq!(error, "the setting \"tiling\" of a placement is 0; it must be at least 1 and at most 1000 cells either way");
    for placement in [
        Placement { tiling: [0, 1], ..default },
        Placement { tiling: [1, 1001], ..default },
        Placement { offset: [f64::NAN, 0.0], ..default },
        Placement { offset: [0.0, f64::INFINITY], ..default },
        Placement { rotation: f64::NAN, ..default },
        Placement { size: 0.0, ..default },
        Placement { size: f64::NAN, ..default },
    ] {
        assert!(placement.checked().is_err(), "{placement:?}");
    }
}
