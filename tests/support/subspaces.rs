//! Sources whose local PCA is known, and what a local PCA leaves of a source.

use half::f16;
use overpaint::{
    data::{Direction, Lpca, Map},
    io::Source,
};

use super::{held::Held, random::Random};

/// Texels that lie in affine subspaces, up to noise.
pub struct Subspaces {
    pub source: Held,
    /// The subspace of each texel.
    pub cluster: Map<u32>,
}

impl Subspaces {
    /// So many clusters, far from each other, of so many dimensions, under 5 views and 9 lights; `noise` is uniform and of this much
    /// at most.
    pub fn new(size: [usize; 2], [clusters, components]: [usize; 2], noise: f64) -> Self {
        let mut random = Random::new(29);
        let cluster = Map::from_fn(size[0], size[1], |_, _| random.below(clusters) as u32);
        let weights = cluster.map(|_| (0..components).map(|_| random.between(-1.0, 1.0)).collect::<Vec<_>>());
        let source = source(size, |_| {
            // Of each cluster, channel and term.
            let mut term = |low, high| [0; 3].map(|_: u8| random.between(low, high));
            let terms: Vec<Vec<[f64; 3]>> = (0..clusters)
                .map(|_| (0..=components).map(|c| if c == 0 { term(0.3, 0.9) } else { term(-0.05, 0.05) }).collect())
                .collect();
            Map::from_fn(size[0], size[1], |column, row| {
                let (terms, weights) = (&terms[cluster[(column, row)] as usize], &weights[(column, row)]);
                [0, 1, 2].map(|channel| {
                    let sum: f64 = terms[1..].iter().zip(weights).map(|(term, weight)| weight * term[channel]).sum();
                    (terms[0][channel] + sum + random.between(-noise, noise)).max(0.0)
                })
            })
        });
        Self { source, cluster }
    }
}

/// A source of 5 views and 9 lights; `picture(sample)` is what is seen.
pub fn source(size: [usize; 2], mut picture: impl FnMut(usize) -> Map<[f64; 3]>) -> Held {
    let ring = |theta: f64, count: usize| (0..count).map(move |k| Direction::from_degrees(theta, 360.0 * k as f64 / count as f64));
    let views: Vec<_> = ring(0.0, 1).chain(ring(40.0, 4)).collect();
    let lights: Vec<_> = ring(15.0, 3).chain(ring(55.0, 6)).collect();
    let mut sample = 0;
    Held::new(size, &views, &lights, |_, _| {
        sample += 1;
        picture(sample - 1).map(|rgb| rgb.map(f16::from_f64))
    })
}

/// Makes one value in `every` no radiance, another channel from texel to texel.
pub fn mask(source: &mut Held, every: usize, invalid: f16) {
    let mut random = Random::new(31);
    let [width, height] = source.btf.size();
    for picture in &mut source.pictures {
        for texel in (0..width * height).map(|texel| (texel % width, texel / width)) {
            let channel = random.below(3);
            if random.below(every) == 0 {
                picture[texel][channel] = invalid;
            }
        }
    }
}

/// The values of a picture, one channel after the other.
pub fn channels(picture: &Map<[f16; 3]>) -> Vec<f64> {
    (0..3).flat_map(|channel| picture.values().iter().map(move |rgb| rgb[channel].to_f64())).collect()
}

/// Whether a sample of a texel is a measurement.
fn is_valid(rgb: &[f16; 3]) -> bool {
    rgb.iter().all(|value| value.is_finite() && *value >= f16::ZERO)
}

/// The radiance that is stored of a texel (by its number) in a sample.
pub fn reconstructed(lpca: &Lpca, sample: usize, texel: usize) -> [f64; 3] {
    let terms = 1 + lpca.components;
    let of_cluster = sample * lpca.clusters + lpca.cluster.values()[texel] as usize;
    let weights = &lpca.weights[texel * lpca.components..][..lpca.components];
    [0, 1, 2].map(|channel| {
        let term = |term: usize| lpca.terms[(of_cluster * terms + term) * 3 + channel].to_f64();
        term(0) + weights.iter().enumerate().map(|(c, weight)| weight.to_f64() * term(1 + c)).sum::<f64>()
    })
}

/// Relative RMS error of what is stored, of all valid samples and of each texel's.
pub fn left(lpca: &Lpca, source: &Held) -> (f64, Map<f64>) {
    let [width, height] = source.btf.size();
    // Of each texel, squared residuals and squares.
    let sums = Map::from_fn(width, height, |column, row| {
        let mut sums = [0.0; 2];
        for (sample, picture) in source.pictures.iter().enumerate() {
            let rgb = &picture[(column, row)];
            if is_valid(rgb) {
                for (value, stored) in rgb.iter().zip(reconstructed(lpca, sample, row * width + column)) {
                    sums[0] += (stored - value.to_f64()).powi(2);
                    sums[1] += value.to_f64().powi(2);
                }
            }
        }
        sums
    });
    let ratio = |[residual, energy]: [f64; 2]| if energy > 0.0 { (residual / energy).sqrt() } else { 0.0 };
    let all = sums.values().iter().fold([0.0; 2], |sum, of_texel| [sum[0] + of_texel[0], sum[1] + of_texel[1]]);
    (ratio(all), sums.map(|&sums| ratio(sums)))
}

/// Shapes and numbers are those that every local PCA has.
#[track_caller]
pub fn check(lpca: &Lpca, source: &dyn Source) {
    lpca.check(source.btf().size()).expect("fits itself");
    assert_eq!([lpca.cluster.width(), lpca.cluster.height()], source.btf().size());
    assert_eq!([lpca.error.width(), lpca.error.height()], source.btf().size());
    assert_eq!(lpca.pairs, source.btf().pairs());
    assert!(lpca.weights.iter().chain(&lpca.terms).all(|half| half.is_finite()), "halves are finite");
    assert!(lpca.error.values().iter().all(|error| error.is_finite() && *error >= 0.0), "errors are finite");
    let learned = &lpca.learned;
    assert!(learned.errors.iter().chain([&learned.relative_rms, &learned.left_out]).all(|error| error.is_finite() && *error >= 0.0));
    assert!((-1e-6..=1.0).contains(&learned.left_out), "{}", learned.left_out);
}
