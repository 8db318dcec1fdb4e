//! The measured and path-traced samples of the shared data.

use std::path::Path;

use overpaint::io::{self, Source};
use rayon::prelude::*;

use super::codes;

crate::suite! { data:
    blocks_are_on_the_bonn_grid,
    weave_has_51_views_and_lights,
    coincloth_has_one_view,
    the_gray_sphere_has_12_lights,
    the_lizard_has_20_lights;
}

fn blocks_are_on_the_bonn_grid(data: &Path) {
    let source = io::open(&data.join("blocks64_ubo81x81.zip")).expect("opens");
    let btf = source.btf();
    assert_eq!((btf.name(), btf.size(), btf.pairs().len(), btf.grid()), ("blocks64_ubo81x81", [64, 64], 6561, Some("UBO81")));
    assert!(btf.is_product());
    (0..6561_usize).into_par_iter().for_each(|sample| assert_eq!(codes(source.as_ref(), sample).expect("decodes").len(), 64 * 64));
}

fn weave_has_51_views_and_lights(data: &Path) {
    let source = io::open(&data.join("weave64_51x51.zip")).expect("opens");
    let btf = source.btf();
    assert_eq!((btf.size(), btf.views().len(), btf.lights().len(), btf.pairs().len()), ([64, 64], 51, 51, 2601));
    assert_eq!(btf.zenith_samples(), (0..51).collect::<Vec<_>>());
}

fn coincloth_has_one_view(data: &Path) {
    let source = io::open(&data.join("coincloth256_1x.zip")).expect("opens");
    let btf = source.btf();
    assert_eq!((btf.size(), btf.views().len(), btf.lights().len()), ([256, 256], 1, 88));
    let texels = codes(source.as_ref(), 87).expect("decodes");
    let mean = texels.iter().map(|texel| f64::from(texel[1])).sum::<f64>() / texels.len() as f64;
    assert!((20.0..235.0).contains(&mean), "a photograph's mean code is {mean}");
}

/// A source of photographs is what its files hold: linear, NaN outside the mask.
fn assert_is(source: &dyn Source, sample: usize, file: &Path, mask: Option<&Path>) {
    let stored = image::open(file).expect("decodes").into_rgb8();
    let mask = mask.map(|mask| image::open(mask).expect("decodes").into_luma8());
    let picture = source.picture(sample).expect("decodes");
    for (column, row, pixel) in stored.enumerate_pixels() {
        let found = picture[(column as usize, row as usize)];
        if mask.as_ref().is_some_and(|mask| mask.get_pixel(column, row).0[0] < 128) {
            assert!(found.iter().all(|value| value.is_nan()), "column {column}, row {row}");
        } else {
            assert_eq!(found, pixel.0.map(|code| half::f16::from_f64(f64::from(code) / 255.0).to_f32()), "column {column}, row {row}");
        }
    }
}

fn the_gray_sphere_has_12_lights(data: &Path) {
    let folder = data.join("uw-gray");
    let source = io::open(&folder).expect("opens");
    let btf = source.btf();
    assert_eq!((btf.name(), btf.size(), btf.views().len(), btf.lights().len()), ("uw-gray", [512, 340], 1, 12));
    let first = btf.lights()[0].vector();
    assert!((first - glam::DVec3::new(0.403_259, 0.480_808, 0.778_592)).length() < 1e-6, "{first}");
    for sample in [0, 2, 11] {
        assert_is(source.as_ref(), sample, &folder.join(format!("gray.{sample}.png")), Some(&folder.join("gray.mask.png")));
    }
    // A sphere is brightest towards the light: y points up, x right.
    for (sample, light) in btf.lights().iter().enumerate() {
        let picture = source.picture(sample).expect("decodes");
        let (mut weight, mut center, mut bright) = (0.0, glam::DVec2::ZERO, glam::DVec2::ZERO);
        for row in 0..340 {
            for column in 0..512 {
                let value = f64::from(picture[(column, row)][1]);
                if value >= 0.0 {
                    let place = glam::DVec2::new(column as f64, -(row as f64));
                    (weight, center, bright) = (weight + value, center + place * 1.0, bright + place * value);
                }
            }
        }
        let inside = picture.values().iter().filter(|texel| !texel[1].is_nan()).count() as f64;
        let towards = bright / weight - center / inside;
        let light = light.vector().truncate();
        assert!(towards.angle_to(light).abs() < 0.5, "light {sample}: {towards} for {light}");
    }
}

fn the_lizard_has_20_lights(data: &Path) {
    let folder = data.join("harvard-lizard");
    let source = io::open(&folder).expect("opens");
    let btf = source.btf();
    assert_eq!((btf.size(), btf.views().len(), btf.lights().len()), ([660, 720], 1, 20));
    let last = btf.lights()[19].vector();
    assert!((last - glam::DVec3::new(0.437_919_245_8, -0.050_697_539_7, 0.897_583_697_3)).length() < 1e-6, "{last}");
    for sample in [0, 9, 19] {
        assert_is(source.as_ref(), sample, &folder.join(format!("Image_{:02}.png", sample + 1)), None);
    }
}
