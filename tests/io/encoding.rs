//! What a user knows better than a reader.

use image::{ImageFormat, Rgb32FImage};
use overpaint::{
    data::{RowOrder, Transfer},
    io::{self, ReadOptions},
};

use super::{PAIRS, assert_says, bonn_name, encoded, small_tree, write_tree};

crate::suite! { plain: each_option_counts, images_of_a_tree_have_one_transfer; }

fn each_option_counts() {
    let folder = tempfile::tempdir().expect("is writable");
    write_tree(folder.path(), &small_tree());
    let stored = |sample: usize| image::load_from_memory(&encoded(ImageFormat::Jpeg, [12, 9], sample)).expect("decodes").into_rgb8();
    for (transfer, linear) in [
        (Transfer::Linear, (|value: f64| value) as fn(f64) -> f64),
        (Transfer::Gamma(2.2), |value: f64| value.powf(2.2)),
        (Transfer::Srgb, overpaint::model::color::linear_from_srgb),
    ] {
        for includes_cosine in [true, false] {
            for rows in [RowOrder::TopDown, RowOrder::BottomUp] {
                let options = ReadOptions {
                    transfer: Some(transfer),
                    includes_cosine: Some(includes_cosine),
                    rows: Some(rows),
                    scale: Some(2.5),
                    ..ReadOptions::default()
                };
                let source = io::open_with(folder.path(), &options).expect("opens");
                for (sample, pair) in PAIRS.iter().enumerate() {
                    let factor = if includes_cosine { 2.5 } else { 2.5 * f64::from(pair[2]).to_radians().cos() };
                    let (picture, stored) = (source.picture(sample).expect("decodes"), stored(sample));
                    for (index, texel) in picture.values().iter().enumerate() {
                        let (column, row) = (index % 12, index / 12);
                        let row = if rows == RowOrder::TopDown { row } else { 8 - row };
                        for (channel, &found) in texel.iter().enumerate() {
                            let code = stored.get_pixel(column as u32, row as u32).0[channel];
                            let expected = half::f16::from_f64(factor * linear(f64::from(code) / 255.0)).to_f32();
                            assert!((found - expected).abs() <= expected * 1e-3, "{options:?}: {found}, not {expected}");
                        }
                    }
                }
            }
        }
    }
}

fn images_of_a_tree_have_one_transfer() {
    let folder = tempfile::tempdir().expect("is writable");
    let mut files = small_tree();
    let mut hdr = std::io::Cursor::new(Vec::new());
    Rgb32FImage::from_pixel(12, 9, image::Rgb([0.5; 3])).write_to(&mut hdr, ImageFormat::Hdr).expect("encodes");
    files[2] = (bonn_name(2, "hdr"), hdr.into_inner());
    write_tree(folder.path(), &files);
    let source = io::open(folder.path()).expect("opens");
    source.picture(1).expect("is as the first one");
    assert_says(source.picture(2), &[&bonn_name(2, "hdr"), "holds linear values", "first image sRGB", "--transfer"]);
    let options = ReadOptions { transfer: Some(Transfer::Gamma(2.0)), ..ReadOptions::default() };
    let picture = io::open_with(folder.path(), &options).expect("opens").picture(2).expect("the user knows better");
    assert_eq!(picture[(0, 0)], [0.25; 3]);
}
