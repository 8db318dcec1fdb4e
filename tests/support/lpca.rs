//! Local PCAs that are made up.

use half::f16;
use overpaint::{
    data::{Direction, Learned, Lpca, Map, Pair},
    gpu::Gpu,
    model::{Boundary, TexelSamples},
    stage,
};

use super::random::Random;

/// All pairs of some views and lights, view-major.
pub fn product(views: usize, lights: usize) -> Vec<Pair> {
    (0..views).flat_map(|view| (0..lights).map(move |light| Pair { view, light })).collect()
}

/// One with the given values: `cluster(column, row)`, `weight(texel, component)` and `term(pair, cluster, term)`.
pub fn made(
    [width, height]: [usize; 2], pairs: Vec<Pair>, [clusters, components]: [usize; 2], mut cluster: impl FnMut(usize, usize) -> usize,
    mut weight: impl FnMut(usize, usize) -> f64, mut term: impl FnMut(Pair, usize, usize) -> [f64; 3],
) -> Lpca {
    let weights = (0..width * height * components).map(|index| f16::from_f64(weight(index / components, index % components)));
    let terms = pairs.iter().flat_map(|&pair| (0..clusters * (1 + components)).map(move |index| (pair, index)));
    let terms = terms.flat_map(|(pair, index)| term(pair, index / (1 + components), index % (1 + components)).map(f16::from_f64)).collect();
    let lpca = Lpca {
        weights: weights.collect(),
        terms,
        pairs,
        clusters,
        components,
        cluster: Map::from_fn(width, height, |column, row| cluster(column, row) as u32),
        error: Map::from_fn(width, height, |_, _| 0.0),
        learned: Learned { relative_rms: 0.0, rank: 1, left_out: 0.0, errors: Vec::new(), candidates: Vec::new() },
    };
    lpca.check([width, height]).expect("fits together");
    lpca
}

/// A random one; a cluster's mean outweighs its eigenvectors, but not everywhere.
pub fn random(random: &mut Random, size: [usize; 2], pairs: Vec<Pair>, [clusters, components]: [usize; 2]) -> Lpca {
    let mut values = [0, 1, 2].map(|_| Random::new(random.bits()));
    let [cluster, weight, term] = &mut values;
    made(
        size,
        pairs,
        [clusters, components],
        |_, _| cluster.below(clusters),
        |_, _| weight.between(-1.5, 1.5),
        |_, _, index| [(); 3].map(|()| if index == 0 { term.between(0.2, 1.0) } else { term.between(-0.2, 0.2) }),
    )
}

/// The picture, from the adapter.
pub fn reconstruct(gpu: &Gpu, btf: &stage::CompressedBtf, texel_samples: TexelSamples, view: Direction, light: Direction) -> Map<[f32; 4]> {
    let stage = stage::ReconstructLpca::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let picture = stage.record(&mut recorder, btf, texel_samples, view, light).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    let [width, height] = btf.size().map(|texels| texels as usize);
    Map::new(width, height, picture.read(gpu).expect("reads")).expect("one pixel a texel")
}

const RADIANCE: &str = crate::probe!(
    "lpca",
    "fn probe(index: u32) -> vec4<f32> {
        let place = inputs[3u * index].xy;
        return vec4(compressed_radiance(place, inputs[3u * index + 1u].xyz, inputs[3u * index + 2u].xyz), 1.0);
    }"
);

/// A place (column, row), a view and a light.
pub type Asked = ([f64; 2], Direction, Direction);

/// What a renderer evaluates at each pixel, from the adapter.
pub fn radiance(gpu: &Gpu, btf: &stage::CompressedBtf, texel_samples: TexelSamples, asked: &[Asked]) -> Vec<[f64; 3]> {
    let vector = |direction: &Direction| direction.vector().as_vec3().extend(0.0).to_array();
    let inputs: Vec<_> =
        asked.iter().flat_map(|([x, y], view, light)| [[*x as f32, *y as f32, 0.0, 0.0], vector(view), vector(light)]).collect();
    let params = btf.params(gpu, texel_samples).expect("fits");
    let resources = stage::CompressedBtf::resources();
    let found = super::probe::probe_with(gpu, RADIANCE, &inputs, asked.len(), &resources, &btf.binds(&params));
    found.iter().map(|&[r, g, b, _]| [r, g, b].map(f64::from)).collect()
}

/// On the adapter.
pub fn upload(gpu: &Gpu, lpca: &Lpca, views: &[Direction], lights: &[Direction], boundary: Boundary) -> stage::CompressedBtf {
    stage::CompressedBtf::upload(gpu, lpca, views, lights, boundary).expect("fits")
}
