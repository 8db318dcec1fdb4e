use overpaint::{gpu::Gpu, model::Boundary, stage};

use crate::support::{Worst, hold};

crate::suite! { gpu: a_plane_has_its_closed_form_normal, a_flat_field_points_out; }

fn normals(gpu: &Gpu, heights: &[f32], size: [u32; 2], boundary: Boundary) -> Vec<[f32; 4]> {
    let stage = stage::Normals::new(gpu).expect("builds");
    let mut recorder = gpu.recorder();
    let heights = gpu.upload("heights", heights).expect("fits");
    let normals = stage.record(&mut recorder, &heights, size, boundary).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    normals.read(gpu).expect("reads")
}

/// z = a·x + b·y with y upwards has the normal (-a, -b, 1) wherever both neighbours are inside.
fn a_plane_has_its_closed_form_normal(gpu: &Gpu) {
    let (width, height, a, b) = (32, 24, 0.75_f32, -0.5_f32);
    let heights: Vec<f32> = (0..width * height).map(|t| a * (t % width) as f32 - b * (t / width) as f32).collect();
    let length = (a * a + b * b + 1.0).sqrt();
    let expected = [-a / length, -b / length, 1.0 / length];
    let normals = normals(gpu, &heights, [width as u32, height as u32], Boundary::Mirror);
    for row in 1..height - 1 {
        for column in 1..width - 1 {
            let normal = normals[row * width + column];
            hold("normals: plane", (0..3).map(|axis| (normal[axis] - expected[axis]).abs()).worst(), 3e-7);
        }
    }
}

fn a_flat_field_points_out(gpu: &Gpu) {
    for boundary in [Boundary::Periodic, Boundary::Mirror] {
        assert!(normals(gpu, &[2.5; 100], [10, 10], boundary).iter().all(|normal| *normal == [0.0, 0.0, 1.0, 0.0]));
    }
}
