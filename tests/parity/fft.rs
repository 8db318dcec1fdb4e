use overpaint::{data::Map, gpu::Gpu, model::Fourier, reference, stage};

use crate::support::{fft_bound as bound, hold, random::Random, worst_difference};

crate::suite! { gpu: agrees_with_its_twin; }

fn agrees_with_its_twin(gpu: &Gpu) {
    let stage = stage::Fft::new(gpu).expect("builds");
    let lengths = [1, 2, 3, 5, 7, 63, 64, 65, 97, 127, 128, 243, 256, 400];
    // Each length along either axis, mixed planes, and a prime whose pass is split over two dispatches.
    let rows = lengths.map(|length| (length, 1));
    let columns = lengths.map(|length| (1, length));
    let planes = [(1000, 3), (3, 1000), (61, 67), (96, 100), (5801, 1)];
    for (width, height) in rows.into_iter().chain(columns).chain(planes) {
        for fourier in [Fourier::Forward, Fourier::Inverse] {
            let mut random = Random::new(width as u64);
            let field = Map::from_fn(width, height, |_, _| [0; 2].map(|_| random.between(-1.0, 1.0) as f32));
            let buffer = gpu.upload("field", field.values()).expect("fits");
            let mut recorder = gpu.recorder();
            let result = stage.record(&mut recorder, &buffer, [width as u32, height as u32], fourier).expect("records");
            gpu.submit(recorder).wait(gpu).expect("runs");
            let found = result.read(gpu).expect("reads");
            let expected = reference::fft(&field.map(|value| value.map(f64::from)), fourier);
            let worst = worst_difference(found.iter().flatten().map(|&part| f64::from(part)), expected.values().iter().flatten().copied());
            let square: f64 = expected.values().iter().flatten().map(|part| part * part).sum();
            let rms = (square / (width * height) as f64).sqrt();
            hold("fft: worst error over the rms of the result", worst / rms, bound(width) + bound(height));
        }
    }
}
