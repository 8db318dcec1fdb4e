use overpaint::model::{Layer, Paint, PaintError, Pattern, pigments, pigments::PigmentError};

crate::suite! { plain: names_are_found_however_written, a_name_in_both_sets_is_refused, an_unknown_name_lists_near_ones, the_library_is_sound, impossible_layers_are_refused, impossible_strokes_are_refused; }

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

fn impossible_strokes_are_refused() {
    let stroke = |angle, width| Pattern::Brush { seed: 1, angle, width }.checked();
    assert!(stroke(1.0, 0.2).is_ok());
    assert!(stroke(f64::NAN, 0.2).is_err());
    let error = stroke(0.0, 0.8).expect_err("is too wide").to_string();
    assert!(error.starts_with("the width of a brush stroke is 0.8; it must be"), "{error}");
}
