use overpaint::{data::OCTET, gpu::Gpu, reference, stage};

use crate::support::{Worst, hold, lines, random::Random, tile};

crate::suite! { gpu: agrees_with_its_twin; }

fn agrees_with_its_twin(gpu: &Gpu) {
    let stage = stage::LpcaLift::new(gpu).expect("builds");
    // Threads take lines, layers clusters; members are summed by 64.
    for (samples, texels, clusters, quads) in [(1, 1, 1, 1), (7, 63, 3, 2), (8, 64, 1, 1), (9, 65, 2, 3), (170, 130, 1, 2), (180, 700, 40, 1)] {
        let mut random = Random::new(52);
        let radiance = tile::upload_masked(gpu, texels, samples, tile::a_quarter, |_, _, _| random.unit());
        let given = tile::unpack(&radiance.values.read(gpu).expect("reads"), texels);
        let line_count = 3 * radiance.octets();
        let centre = lines::vector(samples, radiance.octets(), |_, _| random.unit());
        // The last cluster has no members, if there are several.
        let cluster_of: Vec<u32> = (0..texels).map(|_| random.below(clusters.max(2) - 1) as u32).collect();
        let members = stage::Members::new(&cluster_of, clusters);
        let weights: Vec<[f32; 4]> = (0..members.texels.len() * quads).map(|_| [0; 4].map(|_| random.between(-1.0, 1.0) as f32)).collect();
        let lifted = stage::Lifted::new(gpu, clusters, quads, line_count).expect("fits");
        let centre_lines = gpu.upload("centre", &stage::Line::of(&centre)).expect("fits");
        let on_gpu = weights_on(gpu, &weights);
        // Twice: sums are added to.
        for _ in 0..2 {
            let mut recorder = gpu.recorder();
            stage.record(&mut recorder, &radiance, &centre_lines, &members.upload(gpu).expect("fits"), &on_gpu, &lifted).expect("records");
            gpu.submit(recorder).wait(gpu).expect("runs");
        }
        let (sums, counts) = (lifted.sums(gpu).expect("reads"), lifted.counts(gpu).expect("reads"));
        let texel_values: Vec<_> = (0..texels).map(|texel| lines::texel(&given, texels, texel)).collect();
        let mut errors = Vec::new();
        for (cluster, [start, end]) in members.ranges.iter().enumerate() {
            let own: Vec<(usize, Vec<f64>)> = (*start as usize..*end as usize)
                .map(|member| {
                    let weights = weights[member * quads..][..quads].as_flattened().iter().map(|&weight| f64::from(weight)).collect();
                    (members.texels[member] as usize, weights)
                })
                .collect();
            let own: Vec<_> = own.iter().map(|(texel, weights)| (texel_values[*texel].as_slice(), weights.as_slice())).collect();
            let (expected, numbers) = reference::lpca_lift(&own, &centre, 4 * quads);
            for (weight, expected) in expected.iter().enumerate() {
                let found = sums[weight / 4][(cluster * 4 + weight % 4) * line_count..][..line_count].iter().flat_map(stage::Line::values);
                errors.extend(found.zip(expected).map(|(found, expected)| (f64::from(found) / 2.0 - expected).abs() / (own.len().max(1) as f64).sqrt()));
            }
            let found = counts[cluster * line_count..][..line_count].iter().flat_map(stage::Line::values);
            for (value, (found, expected)) in found.zip(numbers).enumerate() {
                // Fillings past the last sample are zeros, not masked.
                assert_eq!(f64::from(found), 2.0 * expected, "members with value {value} of {}", line_count * OCTET);
            }
        }
        // Sums of up to 64 and then of such sums, each rounded to 6e-8 of itself; over the root of their number.
        hold("lpca_lift: sums over the root of the number of members", errors.into_iter().worst(), 2e-6);
    }
}

fn weights_on(gpu: &Gpu, weights: &[[f32; 4]]) -> overpaint::gpu::Buffer<[f32; 4]> {
    gpu.upload("weights", weights).expect("fits")
}
