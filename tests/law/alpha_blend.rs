use overpaint::{
    gpu::Gpu,
    model::{Layer, pigments},
};

use crate::support::{
    hold,
    paint::blend,
    worst_difference,
};

crate::suite! { gpu: a_full_layer_hides_all, a_part_mixes_by_its_part, nothing_drawn_changes_nothing; }

fn layer(name: &str) -> Layer {
    Layer::new(pigments::find(name).expect("is in the library").into(), 0.4, 1.0)
}

fn a_full_layer_hides_all(gpu: &Gpu) {
    let (below, above) = (layer("oil/viridian"), layer("watercolour/quinacridone rose"));
    let found = blend(gpu, &[[0.3, 0.3, 0.3, 0.0]], &[(&below, &[1.0]), (&above, &[1.0])]);
    let [r, g, b] = above.colour();
    // The colour in f32.
    hold("alpha_blend: a full layer", worst_difference(found[0].map(f64::from), [r, g, b, 1.0]), 1e-7);
}

/// In a picture of radiance L under paint of colour C: α C + (1 − α) L, twice for two layers.
fn a_part_mixes_by_its_part(gpu: &Gpu) {
    let (below, above) = (layer("oil/viridian"), layer("watercolour/quinacridone rose"));
    let found = blend(gpu, &[[0.3, 0.3, 0.3, 0.0]], &[(&below, &[0.5]), (&above, &[0.25])]);
    let coverage = f64::from(found[0][3]);
    let shown = (0..3).map(|channel| coverage * f64::from(found[0][channel]) + (1.0 - coverage) * 0.7);
    let expected = (0..3).map(|channel| 0.25 * above.colour()[channel] + 0.75 * (0.5 * below.colour()[channel] + 0.5 * 0.7));
    hold("alpha_blend: two parts", worst_difference(shown, expected), 2e-7);
}

fn nothing_drawn_changes_nothing(gpu: &Gpu) {
    let ground = [0.3, 1.2, 0.0, 0.4];
    let found = blend(gpu, &[ground], &[(&layer("oil/viridian"), &[0.0])]);
    assert_eq!(found[0], ground);
}
