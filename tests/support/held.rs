//! A source that is held in memory.

use half::f16;
use overpaint::{
    data::{Block, Btf, Direction, Encoding, Map, Pair, Transfer},
    io::{IoError, Source},
};

/// One picture a sample.
#[derive(Debug)]
pub struct Held {
    pub btf: Btf,
    pub pictures: Vec<Map<[f16; 3]>>,
}

impl Held {
    /// All pairs of some views and lights; `picture(view, light)` is what is seen.
    pub fn new(
        size: [usize; 2], views: &[Direction], lights: &[Direction], mut picture: impl FnMut(Direction, Direction) -> Map<[f16; 3]>,
    ) -> Self {
        let pairs: Vec<Pair> = (0..views.len()).flat_map(|view| (0..lights.len()).map(move |light| Pair { view, light })).collect();
        let pictures = pairs.iter().map(|pair| picture(views[pair.view], lights[pair.light])).collect();
        let encoding = Encoding::photograph(Transfer::Linear);
        let btf = Btf::new("held".to_owned(), size, views.to_vec(), lights.to_vec(), pairs, encoding).expect("is a BTF");
        Self { btf, pictures }
    }
}

impl Source for Held {
    fn btf(&self) -> &Btf {
        &self.btf
    }

    fn read(&self, samples: &[usize], block: Block, radiance: &mut [f16], done: &(dyn Fn(usize) + Sync)) -> Result<(), IoError> {
        for (values, &sample) in radiance.chunks_exact_mut(3 * block.texels()).zip(samples) {
            for (channel, values) in values.chunks_exact_mut(block.texels()).enumerate() {
                let texels = block.rows().flat_map(|row| block.columns().map(move |column| (column, row)));
                values.iter_mut().zip(texels).for_each(|(value, texel)| *value = self.pictures[sample][texel][channel]);
            }
            done(1);
        }
        Ok(())
    }

    fn fingerprint(&self) -> String {
        "held".to_owned()
    }
}
