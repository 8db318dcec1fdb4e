use overpaint::{
    gpu::Gpu,
    model::{Layer, Paint},
    stage,
};

crate::suite! { gpu: layers_add_up_and_bare_texels_stay; }

/// Two layers rise by the sum of their reliefs, exactly in binary fractions; where nothing is drawn no bit changes.
fn layers_add_up_and_bare_texels_stay(gpu: &Gpu) {
    let stage = stage::PaintRelief::new(gpu).expect("builds");
    let layer = |relief| Layer::new(Paint { name: "any".to_owned(), k: [0.0; 3], s: [1.0; 3] }, 1.0, relief);
    let ground = [-1.5_f32, 0.1, 3.0, 0.7];
    let mut recorder = gpu.recorder();
    let below = gpu.upload("ground", &ground).expect("fits");
    let drawn = gpu.upload("drawn", &[1.0_f32, 0.0, 0.5, 0.0]).expect("fits");
    let first = stage.record(&mut recorder, &below, &drawn, &layer(0.5)).expect("records");
    let second = stage.record(&mut recorder, &first, &drawn, &layer(2.0)).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    assert_eq!(second.read(gpu).expect("reads"), [1.0, ground[1], 4.25, ground[3]]);
}
