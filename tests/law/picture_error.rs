use half::f16;
use overpaint::gpu::Gpu;

use crate::{
    parity::picture_error::{Pair, errors, noise},
    support::{Worst, hold},
};

crate::suite! { gpu: a_picture_is_its_own, a_brighter_picture_errs_by_as_much_as_it_is_brighter, a_masked_texel_takes_no_part, texels_and_pictures_sum_to_the_same; }

/// The original of `noise` in halves that are all radiance.
fn radiance(texels: usize, seed: u64) -> Vec<[f16; 3]> {
    noise(texels, seed).picture.iter().map(|rgb| rgb.map(|value| f16::from_f32(value.abs()))).collect()
}

fn a_picture_is_its_own(gpu: &Gpu) {
    let original = radiance(1000, 1);
    let picture = original.iter().map(|rgb| rgb.map(f16::to_f32)).collect();
    let (sums, of_texels) = errors(gpu, &[Pair { picture, original }]);
    assert_eq!([sums[0].squared_error, sums[0].error, sums[0].squared_shown_error], [0.0; 3]);
    assert!(sums[0].squared_original > 0.0 && sums[0].texels == 1000.0 && of_texels.iter().all(|sums| sums[0] == 0.0));
}

fn a_brighter_picture_errs_by_as_much_as_it_is_brighter(gpu: &Gpu) {
    for factor in [0.0_f32, 0.75, 1.5] {
        let original = radiance(1000, 2);
        let picture = original.iter().map(|rgb| rgb.map(|value| factor * value.to_f32())).collect();
        let (sums, _) = errors(gpu, &[Pair { picture, original }]);
        let more = f64::from(factor) - 1.0;
        let off = [
            f64::from(sums[0].squared_error) / f64::from(sums[0].squared_original) - more * more,
            f64::from(sums[0].error) / f64::from(sums[0].original) - more,
        ];
        // Products of halves and such factors are exact; some twenty roundings of sums.
        hold("picture_error: a brighter picture", off.map(f64::abs).into_iter().worst(), 1e-6);
    }
}

fn a_masked_texel_takes_no_part(gpu: &Gpu) {
    let Pair { mut picture, original } = noise(1000, 3);
    let (before, of_texels) = errors(gpu, &[Pair { picture: picture.clone(), original: original.clone() }]);
    for (texel, (picture, original)) in picture.iter_mut().zip(&original).enumerate() {
        if original.iter().any(|value| !value.is_finite() || *value < f16::ZERO) {
            *picture = [1e30; 3];
            assert_eq!(of_texels[texel], [0.0; 2]);
        }
    }
    let (after, _) = errors(gpu, &[Pair { picture, original }]);
    assert_eq!(bytemuck::bytes_of(&before[0]), bytemuck::bytes_of(&after[0]));
    assert!(before[0].texels > 500.0 && before[0].texels < 1000.0);
}

fn texels_and_pictures_sum_to_the_same(gpu: &Gpu) {
    let pairs: Vec<Pair> = (0..7).map(|seed| noise(321, seed)).collect();
    let (pictures, texels) = errors(gpu, &pairs);
    let of_pictures = pictures.iter().fold([0.0; 2], |sum, p| [sum[0] + f64::from(p.squared_error), sum[1] + f64::from(p.squared_original)]);
    let of_texels = texels.iter().fold([0.0; 2], |sum, t| [sum[0] + f64::from(t[0]), sum[1] + f64::from(t[1])]);
    let off = [0, 1].map(|term| (of_pictures[term] - of_texels[term]).abs() / of_texels[term]);
    hold("picture_error: texels and pictures", off.into_iter().worst(), 1e-6);
}
