//! A source made of numbers.

use half::f16;
use overpaint::{
    data::{Block, Btf, Direction, Encoding, Pair, Transfer},
    io::{IoError, Source},
};

use super::random::Random;

/// Every sample is a picture of random radiance, the same however much of it is read.
#[derive(Debug)]
pub struct Speckle {
    pub btf: Btf,
    /// Whether it is stored in blocks.
    pub chunk: Option<[usize; 2]>,
    /// One value in so many is no radiance; 0: none.
    pub invalid: usize,
}

impl Speckle {
    /// Five views, nine lights; every `skip`-th pair is left out, none for 0.
    pub fn new(size: [usize; 2], skip: usize) -> Self {
        let ring = |theta: f64, count: usize| (0..count).map(move |k| Direction::from_degrees(theta, 360.0 * k as f64 / count as f64));
        let views: Vec<_> = ring(0.0, 1).chain(ring(40.0, 4)).collect();
        let lights: Vec<_> = ring(15.0, 3).chain(ring(55.0, 6)).collect();
        let pairs = (0..views.len()).flat_map(|view| (0..lights.len()).map(move |light| Pair { view, light }));
        let pairs = pairs.enumerate().filter(|(index, _)| skip == 0 || index % skip != skip - 1).map(|(_, pair)| pair).collect();
        let btf = Btf::new("speckle".to_owned(), size, views, lights, pairs, Encoding::photograph(Transfer::Srgb)).expect("is a BTF");
        Self { btf, chunk: None, invalid: 0 }
    }
}

impl Source for Speckle {
    fn btf(&self) -> &Btf {
        &self.btf
    }

    fn chunk(&self) -> Option<[usize; 2]> {
        self.chunk
    }

    fn read(&self, samples: &[usize], block: Block, radiance: &mut [f16], done: &(dyn Fn(usize) + Sync)) -> Result<(), IoError> {
        let (texels, width) = (self.btf.texels(), self.btf.size()[0]);
        for (values, &sample) in radiance.chunks_exact_mut(3 * block.texels()).zip(samples) {
            let mut random = Random::new(sample as u64);
            let picture: Vec<f16> = (0..3 * texels)
                .map(|_| {
                    let value = f16::from_f64(random.between(0.05, 0.75));
                    let is_invalid = self.invalid > 0 && random.below(self.invalid) == 0;
                    if is_invalid { [f16::NAN, f16::INFINITY, -value][random.below(3)] } else { value }
                })
                .collect();
            for (channel, values) in values.chunks_exact_mut(block.texels()).enumerate() {
                let inside = block.rows().flat_map(|row| block.columns().map(move |column| row * width + column));
                values.iter_mut().zip(inside).for_each(|(value, texel)| *value = picture[channel * texels + texel]);
            }
            done(1);
        }
        Ok(())
    }

    fn fingerprint(&self) -> String {
        format!("speckle {}", self.invalid)
    }
}

/// The bits of all samples of a block.
pub fn bits(source: &dyn Source, samples: &[usize], block: Block) -> Vec<u16> {
    let mut radiance = vec![f16::ZERO; samples.len() * 3 * block.texels()];
    source.read(samples, block, &mut radiance, &|_| {}).expect("reads");
    radiance.into_iter().map(f16::to_bits).collect()
}
