//! The main job does not depend on how it is cut into tiles and bands.

use half::f16;
use overpaint::{
    data::{Block, Btf, Direction, Encoding, Pair, Transfer},
    gpu::Gpu,
    io::{IoError, Source},
    model::FitSettings,
    pipeline::{Memory, Progress, fit_within},
};

use crate::support::random::Random;

crate::suite! { gpu: any_tiles_give_the_same_bits; }

const SIZE: [usize; 2] = [9, 7];

/// A source made of numbers.
#[derive(Debug)]
struct Speckle(Btf);

impl Speckle {
    fn new() -> Self {
        let ring = |theta: f64, count: usize| (0..count).map(move |k| Direction::from_degrees(theta, 360.0 * k as f64 / count as f64));
        let views: Vec<_> = ring(0.0, 1).chain(ring(40.0, 4)).collect();
        let lights: Vec<_> = ring(15.0, 3).chain(ring(55.0, 6)).collect();
        let pairs = (0..views.len()).flat_map(|view| (0..lights.len()).map(move |light| Pair { view, light })).collect();
        Self(Btf::new("speckle".to_owned(), SIZE, views, lights, pairs, Encoding::photograph(Transfer::Srgb)).expect("is a BTF"))
    }
}

impl Source for Speckle {
    fn btf(&self) -> &Btf {
        &self.0
    }

    fn read(&self, samples: &[usize], block: Block, radiance: &mut [f16], done: &(dyn Fn(usize) + Sync)) -> Result<(), IoError> {
        for (values, &sample) in radiance.chunks_exact_mut(3 * block.texels()).zip(samples) {
            let mut random = Random::new(sample as u64);
            let picture: Vec<f16> = (0..3 * self.0.texels()).map(|_| f16::from_f64(0.05 + 0.7 * random.unit())).collect();
            for (channel, values) in values.chunks_exact_mut(block.texels()).enumerate() {
                for (value, texel) in values.iter_mut().zip(block.rows().flat_map(|row| block.columns().map(move |column| row * SIZE[0] + column))) {
                    *value = picture[channel * self.0.texels() + texel];
                }
            }
            done(1);
        }
        Ok(())
    }

    fn fingerprint(&self) -> String {
        "speckle".to_owned()
    }
}

fn any_tiles_give_the_same_bits(gpu: &Gpu) {
    let source = Speckle::new();
    let texels = source.btf().texels();
    let samples = source.btf().pairs().len();
    // Bytes of one texel: its halves on the adapter, 45 samples in six octets of three channels; its codes on the host.
    let (halves, codes) = (3 * 6 * 16, samples * 6);
    let fitted = |memory| {
        let progress = Progress::new(gpu.adapter());
        let material = fit_within(gpu, &source, &FitSettings::default(), memory, &progress).expect("fits");
        let svbrdf = material.svbrdf;
        let mut bits: Vec<u32> = material.height.values().iter().map(|z| z.to_bits()).collect();
        for map in [&svbrdf.diffuse, &svbrdf.specular] {
            bits.extend(map.values().iter().flatten().map(|value| value.to_bits()));
        }
        bits.extend(svbrdf.lobe.values().iter().flatten().map(|value| value.to_bits()));
        bits.extend(material.fit.iterations.values());
        bits
    };
    let whole = fitted(Memory::default());
    assert_eq!(whole.len(), texels * (1 + 3 + 3 + 4 + 1));
    for (tile, band) in [(1, 1), (10, 10), (10, 20), (10, 25), (32, 63), (62, 1000), (63, 63)] {
        let memory = Memory { host: band * codes, adapter: (tile * halves) as u64 };
        assert!(whole == fitted(memory), "tiles of {tile} texels in bands of {band}");
    }
}
