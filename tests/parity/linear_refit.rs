use overpaint::{
    gpu::Gpu,
    reference::{self, LocalSample},
};

use crate::support::{Worst, hold, local::Local, random::Random, tile};

crate::suite! { gpu: agrees_with_its_twin, lobes_that_all_but_agree; }

/// Sum of squared differences of two sets of coefficients' radiance in one channel, and that of the first from the measurement, over
/// the lit samples; both as parts of the radiance's own squares.
pub fn errors(samples: &[LocalSample], lobes: &[[f64; 4]], channel: usize, found: &[[f64; 3]], expected: &[[f64; 3]]) -> (f64, f64) {
    let (mut apart, mut off, mut all) = (0.0, 0.0, 0.0);
    for sample in samples.iter().filter(|sample| sample.shading > 0.0 && !sample.is_masked()) {
        let responses = sample.responses(lobes);
        let of = |rho: &[[f64; 3]]| responses.iter().zip(rho).map(|(response, rho)| response * rho[channel]).sum::<f64>();
        apart += (of(found) - of(expected)).powi(2);
        off += (of(found) - sample.radiance[channel]).powi(2);
        all += sample.radiance[channel].powi(2);
    }
    (apart / f64::max(all, 1e-12), off / f64::max(all, 1e-12))
}

/// For each texel and channel: root of the squares between the reconstructions of kernel and twin, and how much more than the
/// twin's the kernel's squared error is; both as parts of the radiance's.
fn compare(gpu: &Gpu, local: &Local, radiance: &overpaint::stage::Tile) -> Vec<(f64, f64)> {
    let found = local.refit(gpu, radiance);
    let given = tile::unpack(&radiance.values.read(gpu).expect("reads"), local.texels);
    let mut compared = Vec::new();
    for (texel, found) in found.iter().enumerate() {
        assert!(found.iter().flatten().all(|rho| *rho >= 0.0 && rho.is_finite()), "texel {texel}: {found:?}");
        let (samples, lobes) = (local.samples_of(texel, &given), local.lobes_of(texel));
        let expected = reference::linear_refit(&samples, &lobes);
        for channel in 0..3 {
            let (apart, off) = errors(&samples, &lobes, channel, found, &expected);
            let (_, least) = errors(&samples, &lobes, channel, &expected, &expected);
            compared.push((apart.sqrt(), off - least));
        }
    }
    compared
}

fn agrees_with_its_twin(gpu: &Gpu) {
    let ladder = [(1, 1, 1), (7, 63, 2), (8, 64, 3), (9, 65, 1), (500, 60, 3), (3, 64 * 1000 + 1, 1)];
    for (samples, texels, lobes) in ladder {
        let mut random = Random::new(23);
        let local = Local::new(&mut random, texels, samples, 3, lobes);
        // About half of the coefficients come out as 0: noise as large as the signal, that of each channel on its own.
        let radiance = local.tile(
            gpu,
            |_| vec![[0.2, 0.4, 0.0], [0.8, 0.0, 0.4], [0.0, 0.6, 0.3], [0.5, 0.2, 0.0]],
            |_, sample, texel, value| if tile::a_quarter(sample, texel) { -1.0 } else { value + random.between(-0.3, 0.3).max(-value) },
        );
        let compared = compare(gpu, &local, &radiance);
        // Few samples may not tell the columns apart, and what the kernel holds their angles to costs at most 1e-5 of the radiance's
        // squares, its root of the radiance. Each lobe's power is off by 1e-5 (log2 and exp2), and sums by 1e-6.
        let (bound, what) = if samples > 100 { (1e-4, "linear_refit") } else { (3.2e-3, "linear_refit: few samples") };
        hold(&format!("{what}: reconstruction"), compared.iter().map(|(apart, _)| *apart).worst(), bound);
        hold(&format!("{what}: squared error"), compared.iter().map(|(_, more)| *more).worst(), if samples > 100 { 1e-6 } else { 1e-5 });
    }
}

/// Two lobes whose exponents differ ever less: which has how much is lost in rounding, but not what they make together.
fn lobes_that_all_but_agree(gpu: &Gpu) {
    for apart in [0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4, 0.0] {
        let mut random = Random::new(29);
        let mut local = Local::new(&mut random, 70, 500, 2, 2);
        for texel in 0..70 {
            let [x, y, z, n] = local.lobes[texel];
            local.lobes[70 + texel] = [x, y, z, n * (1.0 + apart)];
        }
        let radiance = local.tile(gpu, |_| vec![[0.2, 0.4, 0.0], [0.8, 0.1, 0.4], [0.1, 0.6, 0.3]], |_, _, _, value| {
            value + random.between(-0.02, 0.02).max(-value)
        });
        let compared = compare(gpu, &local, &radiance);
        // What the least pivot costs at most.
        hold("linear_refit: nearly dependent, squared error", compared.iter().map(|(_, more)| *more).worst(), 1e-5);
    }
}
