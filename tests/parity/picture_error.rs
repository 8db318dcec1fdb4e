use half::f16;
use overpaint::{
    gpu::Gpu,
    reference,
    stage::{self, Originals, PictureSums},
};

use crate::support::{Worst, hold, random::Random};

crate::suite! { gpu: agrees_with_its_twin, a_picture_s_sums_do_not_depend_on_its_batch; }

/// A picture and its original.
pub struct Pair {
    pub picture: Vec<[f32; 3]>,
    pub original: Vec<[f16; 3]>,
}

/// A tenth of the channels of the originals is any pattern of bits, so that nearly every fourth texel is masked; the pictures are as far off
/// as another material's, and beyond what is shown at either end.
pub fn noise(texels: usize, seed: u64) -> Pair {
    let mut random = Random::new(seed);
    let mut original = || {
        [(); 3].map(|()| match random.below(20) {
            // Bounded, so that no single value makes up all of a sum.
            0 => [f16::NAN, f16::INFINITY, f16::NEG_INFINITY, f16::from_f64(-0.25)][random.below(4)],
            1 => [f16::ZERO, f16::NEG_ZERO, f16::from_bits(1), f16::from_f64(1.5)][random.below(4)],
            _ => f16::from_f64(random.between(0.0, 1.2)),
        })
    };
    let original = (0..texels).map(|_| original()).collect();
    let picture = (0..texels).map(|_| [(); 3].map(|()| random.between(-0.1, 1.3) as f32)).collect();
    Pair { picture, original }
}

/// Sums of each pair, and of each texel over all pairs, in one recording.
pub fn errors(gpu: &Gpu, pairs: &[Pair]) -> (Vec<PictureSums>, Vec<[f32; 2]>) {
    let texels = pairs[0].picture.len();
    let halves: Vec<f16> =
        pairs.iter().flat_map(|pair| (0..3).flat_map(|channel| pair.original.iter().map(move |texel| texel[channel]))).collect();
    let stage = stage::PictureError::new(gpu).expect("builds");
    let originals = Originals::upload(gpu, &halves, texels).expect("fits");
    let texel_sums = gpu.zeros("texel sums", texels).expect("fits");
    let mut recorder = gpu.recorder();
    let mut pictures = Vec::new();
    for (index, pair) in pairs.iter().enumerate() {
        let picture: Vec<[f32; 4]> = pair.picture.iter().map(|&[r, g, b]| [r, g, b, f32::NAN]).collect();
        pictures.push(gpu.upload("picture", &picture).expect("fits"));
        stage.record(&mut recorder, &originals, index, &pictures[index], &texel_sums).expect("records");
    }
    let sums = stage.record_sums(&mut recorder, &originals).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    (sums.read(gpu).expect("reads"), texel_sums.read(gpu).expect("reads"))
}

/// The twin's.
fn expected(pair: &Pair) -> reference::PictureError {
    let picture: Vec<[f64; 3]> = pair.picture.iter().map(|rgb| rgb.map(f64::from)).collect();
    reference::picture_error(&picture, &pair.original)
}

fn agrees_with_its_twin(gpu: &Gpu) {
    // Odd numbers of halves too, so that an original begins in the middle of a word; one past 65,535 workgroups.
    for (texels, count) in [(1, 3), (63, 2), (64, 1), (65, 3), (5000, 2), (64 * 64 * 64 + 1, 1), (64 * 65_535 + 1, 1)] {
        let pairs: Vec<Pair> = (0..count).map(|seed| noise(texels, seed)).collect();
        let (found, of_texels) = errors(gpu, &pairs);
        assert_eq!((found.len(), of_texels.len()), (pairs.len(), texels));
        let expected: Vec<_> = pairs.iter().map(expected).collect();
        for (found, expected) in found.iter().zip(&expected) {
            assert_eq!(f64::from(found.texels), expected.texels, "{texels} texels");
            if expected.texels == 0.0 {
                assert_eq!([found.squared_error, found.error, found.squared_original, found.original, found.squared_shown_error], [0.0; 5]);
                continue;
            }
            let relative = |found: f32, expected: f64| (f64::from(found) - expected).abs() / expected;
            // A dot product has an error of three half units in the last place (6e-8), folding adds six for the workgroup, six for the
            // workgroups, and one for each of the 1024 sums that a thread of the largest picture adds up, of random signs: 32 of them.
            let sums = [
                relative(found.squared_error, expected.squared_error),
                relative(found.squared_original, expected.squared_original),
                relative(found.original, expected.original),
            ];
            hold("picture_error: sums, relative", sums.into_iter().worst(), 3e-6);
            // A power in single precision is that of a logarithm rounded to 1e-7, and differences of shown values are as large as they are.
            hold("picture_error: shown error, relative", relative(found.squared_shown_error, expected.squared_shown_error), 5e-6);
            // Signs cancel: against the sum of magnitudes, which by Cauchy is at most √(Σe²·3 texels).
            let magnitude = (expected.squared_error * 3.0 * expected.texels).sqrt();
            hold("picture_error: signed error over √(Σe² n)", (f64::from(found.error) - expected.error).abs() / magnitude, 3e-6);
        }
        let texel = |texel: usize| {
            let sums = expected.iter().fold([0.0; 2], |sum, pair| [0, 1].map(|term| sum[term] + pair.of_texels[texel][term]));
            // Seven roundings for each picture.
            [0, 1].map(|term| (f64::from(of_texels[texel][term]) - sums[term]).abs() / sums[term].max(1e-6)).into_iter().worst()
        };
        hold("picture_error: sums of texels, relative", (0..texels).map(texel).worst(), 1e-6);
    }
}

fn a_picture_s_sums_do_not_depend_on_its_batch(gpu: &Gpu) {
    let texels = 777;
    let pairs: Vec<Pair> = (0..5).map(|seed| noise(texels, seed)).collect();
    let (together, _) = errors(gpu, &pairs);
    for (pair, together) in pairs.into_iter().zip(&together) {
        let (alone, _) = errors(gpu, &[pair]);
        assert_eq!(bytemuck::bytes_of(&alone[0]), bytemuck::bytes_of(together));
    }
}
