//! Photographs of a matte sphere (University of Washington, psmImages), whose normals are known: the mask is its outline.

use std::{fs, path::Path};

use glam::DVec3;
use overpaint::{
    data::Direction,
    gpu::Gpu,
    model::StereoMethod::{LeastSquares, Robust},
    stage::PhotometricStereo,
};

use crate::support::{hold, tile};

crate::suite! { gpu_data: normals_are_those_of_a_sphere; }

/// Numpy gets 6.17° by least squares, 4.60° within 80 % of the radius, and 4.74° and 3.95° by the robust method.
fn normals_are_those_of_a_sphere(gpu: &Gpu, data: &Path) {
    let folder = data.join("uw-gray");
    let lights = lights(&folder.join("lights.txt"));
    let photographs: Vec<image::RgbImage> = (0..lights.len()).map(|index| open(&folder.join(format!("gray.{index}.png")))).collect();
    let sphere = sphere(&open(&folder.join("gray.mask.png")));

    // Linear, at most 1.
    let tile = tile::upload(gpu, sphere.len(), lights.len(), |channel, sample, texel| {
        let [column, row] = sphere[texel].pixel;
        f64::from(photographs[sample].get_pixel(column, row)[channel]) / 255.0
    });
    let stage = PhotometricStereo::new(gpu).expect("builds");
    for (method, whole, inner) in [(LeastSquares, 6.18, 4.61), (Robust, 4.76, 3.97)] {
        let mut recorder = gpu.recorder();
        let normals = stage.record(&mut recorder, &tile, &lights, method).expect("records");
        gpu.submit(recorder).wait(gpu).expect("runs");
        let errors: Vec<(f64, f64)> = normals
            .read(gpu)
            .expect("reads")
            .iter()
            .zip(&sphere)
            .map(|(found, Point { normal, .. })| {
                let [x, y, z, _] = found.map(f64::from);
                (normal.truncate().length(), DVec3::new(x, y, z).dot(*normal).clamp(-1.0, 1.0).acos().to_degrees())
            })
            .collect();
        let mean = |within: f64| {
            let errors: Vec<f64> = errors.iter().filter(|(radius, _)| *radius < within).map(|(_, error)| *error).collect();
            errors.iter().sum::<f64>() / errors.len() as f64
        };
        hold(&format!("sphere, {method:?}: mean error of normals, degrees"), mean(f64::INFINITY), whole);
        hold(&format!("sphere, {method:?}: mean error within 80 % of the radius, degrees"), mean(0.8), inner);
    }
}

fn open(path: &Path) -> image::RgbImage {
    image::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display())).to_rgb8()
}

/// A count, then x y z of a light a line.
fn lights(path: &Path) -> Vec<Direction> {
    let text = fs::read_to_string(path).expect("is text");
    let numbers: Vec<f64> = text.split_whitespace().skip(1).map(|number| number.parse().expect("is a number")).collect();
    numbers.chunks_exact(3).map(|light| Direction { theta: light[2].acos(), phi: light[1].atan2(light[0]) }).collect()
}

/// A pixel of the sphere.
struct Point {
    /// Column and row.
    pixel: [u32; 2],
    normal: DVec3,
}

/// All pixels of the mask, seen without perspective.
fn sphere(mask: &image::RgbImage) -> Vec<Point> {
    let pixels: Vec<[u32; 2]> = mask.enumerate_pixels().filter(|(.., pixel)| pixel[0] > 127).map(|(column, row, _)| [column, row]).collect();
    let extent = |axis: usize| {
        let least = pixels.iter().map(|pixel| pixel[axis]).min().expect("the mask is not empty");
        let most = pixels.iter().map(|pixel| pixel[axis]).max().expect("the mask is not empty");
        (f64::from(least + most) / 2.0, f64::from(most - least + 1) / 2.0)
    };
    let ((x_center, x_radius), (y_center, y_radius)) = (extent(0), extent(1));
    let radius = (x_radius + y_radius) / 2.0;
    let normal = |[column, row]: [u32; 2]| {
        let (x, y) = ((f64::from(column) - x_center) / radius, (y_center - f64::from(row)) / radius);
        // A corner of a pixel on the outline may lie outside.
        DVec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt()).normalize()
    };
    pixels.into_iter().map(|pixel| Point { pixel, normal: normal(pixel) }).collect()
}
