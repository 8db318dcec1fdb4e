use overpaint::{
    data::{Block, Direction},
    gpu::Gpu,
    reference,
};

use crate::support::{
    Worst, hold,
    known::{render, render_block, upload, wavy},
};

crate::suite! { gpu: agrees_with_its_twin, any_number_of_lights_and_views_share_a_recording, a_block_is_cut_from_the_plane; }

fn degrees(theta: f64, phi: f64) -> Direction {
    Direction::from_degrees(theta, phi)
}

/// Largest difference of a texel's channels over what a half resolves there.
fn off(found: &[f64; 3], expected: &[f64; 3]) -> f64 {
    // A half's last place, rounded either way; below 1e-3 the rounding of f32 places counts.
    (0..3).map(|channel| (found[channel] - expected[channel]).abs() / (expected[channel] / 1024.0 + 1e-4)).worst()
}

fn agrees_with_its_twin(gpu: &Gpu) {
    let (mut differing, mut texels) = (0, 0);
    // Pairs of texels: both sides of a workgroup of 64 threads, a single one, odd and even.
    for (width, height) in [(1, 1), (2, 1), (63, 1), (64, 1), (65, 1), (127, 1), (128, 1), (129, 1), (1, 65), (50, 100)] {
        let surface = wavy(width, height, 11);
        let uploaded = upload(gpu, &surface);
        for (view, light) in
            [((0.0, 0.0), (35.0, 20.0)), ((40.0, 130.0), (60.0, 250.0)), ((75.0, 300.0), (75.0, 45.0)), ((60.0, 0.0), (60.0, 90.0))]
        {
            let (view, light) = (degrees(view.0, view.1), degrees(light.0, light.1));
            let found = render(gpu, &uploaded, &[(view, light)]);
            let expected = reference::synth(&surface, view, light);
            let errors: Vec<f64> = found[0].values().iter().zip(expected.values()).map(|(a, b)| off(a, b)).collect();
            assert!(errors.iter().all(|error| error.is_finite()));
            differing += errors.iter().filter(|&&error| error > 1.0).count();
            texels += errors.len();
        }
    }
    // The kernel's crossings are as exact as the twin's, in f32: only a texel whose ray touches the surface or ends within 1e-5 of the
    // middle between two texels, or whose light ray passes a blocker within the bias of 0.0002 texel, may see another thing.
    hold("synth: share of texels off by more than a half's last place", differing as f64 / texels as f64, 5e-4);
}

/// Lights to a thread: 15, 16, 17 and 33 of one view, then other views, in one recording and one by one.
fn any_number_of_lights_and_views_share_a_recording(gpu: &Gpu) {
    let uploaded = upload(gpu, &wavy(31, 17, 5));
    let light = |index: usize| degrees(5.0 + 2.0 * index as f64, 40.0 * index as f64);
    let mut samples = Vec::new();
    for (view, lights) in [(degrees(0.0, 0.0), 15), (degrees(30.0, 10.0), 16), (degrees(60.0, 70.0), 17), (degrees(30.0, 100.0), 33), (degrees(75.0, 10.0), 1)] {
        samples.extend((0..lights).map(|index| (view, light(index))));
    }
    let together = render(gpu, &uploaded, &samples);
    assert!(samples.iter().zip(&together).all(|(&sample, picture)| render(gpu, &uploaded, &[sample])[0] == *picture));
}

fn a_block_is_cut_from_the_plane(gpu: &Gpu) {
    let uploaded = upload(gpu, &wavy(37, 29, 8));
    let samples = [(degrees(50.0, 200.0), degrees(70.0, 30.0)), (degrees(50.0, 200.0), degrees(20.0, 300.0))];
    let whole = render(gpu, &uploaded, &samples);
    for block in Block::tiles([37, 29], [10, 7]) {
        for (whole, part) in whole.iter().zip(render_block(gpu, &uploaded, block, &samples)) {
            for row in block.rows() {
                for column in block.columns() {
                    assert_eq!(whole[(column, row)], part[(column - block.column, row - block.row)]);
                }
            }
        }
    }
}
