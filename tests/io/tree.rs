//! Folders of images: what is read, and what each wrong input is told.

use image::ImageFormat;
use overpaint::{
    data::{Direction, Pair, Transfer},
    io::{self, Kind},
};
use rayon::prelude::*;
use tempfile::TempDir;

use super::{PAIRS, assert_says, bonn_name, codes, encoded, small_tree, write_tree};

crate::suite! { plain:
    a_complete_tree_is_read_in_order,
    every_format_is_read,
    names_are_read_however_they_are_written,
    pairs_may_be_scattered,
    the_zenith_is_one_direction,
    directions_are_in_names,
    a_repeated_pair_names_both_files,
    images_of_different_sizes_are_refused,
    every_truncation_of_a_jpeg_is_an_error,
    truncated_rasters_are_errors_or_complete,
    damage_within_a_jpeg_is_an_error,
    a_file_that_is_no_image_is_named,
    no_images_is_an_error,
    images_without_directions_are_named,
    a_direction_below_the_horizon_is_refused,
    formats_that_are_not_read_are_named,
    an_absurd_size_is_refused_before_it_is_allocated,
    a_path_that_does_not_exist_is_an_error,
    a_lost_file_is_named_at_decoding;
}

fn folder(files: &[(String, Vec<u8>)]) -> TempDir {
    let folder = tempfile::tempdir().expect("is writable");
    write_tree(folder.path(), files);
    folder
}

fn a_complete_tree_is_read_in_order() {
    let mut files = small_tree();
    // Found in any order, with things that do not count between them.
    files.reverse();
    files.push(("readme.txt".to_owned(), b"a note".to_vec()));
    files.push(("tv000_pv000/._00000 tl015 pl000 tv000 pv000.jpg".to_owned(), b"resource fork".to_vec()));
    files.push(("preview.jpg".to_owned(), encoded(ImageFormat::Jpeg, [3, 3], 0)));
    let folder = folder(&files);
    let source = io::open(folder.path()).expect("opens");
    let btf = source.btf();
    assert_eq!(io::kind(folder.path()), Kind::Source);
    assert_eq!(btf.name(), folder.path().file_name().expect("has one").to_str().expect("is ASCII"));
    assert_eq!((btf.size(), btf.views().len(), btf.lights().len(), btf.encoding().transfer), ([12, 9], 2, 3, Transfer::Srgb));
    assert!(btf.is_product());
    for (sample, pair) in PAIRS.iter().enumerate() {
        let (view, light) = btf.directions(sample);
        let found = [view.degrees().0, view.degrees().1, light.degrees().0, light.degrees().1].map(|angle| angle.round() as u32);
        assert_eq!(&found, pair);
    }
    let decoded: Vec<_> = (0..6_usize).into_par_iter().map(|sample| codes(source.as_ref(), sample).expect("decodes")).collect();
    for (sample, texels) in decoded.iter().enumerate() {
        let expected = image::load_from_memory(&encoded(ImageFormat::Jpeg, [12, 9], sample)).expect("decodes").into_rgba8();
        assert_eq!(texels.as_flattened(), expected.as_raw().as_slice());
    }
}

fn every_format_is_read() {
    for (format, extension) in
        [(ImageFormat::Png, "png"), (ImageFormat::Bmp, "BMP"), (ImageFormat::Tiff, "tif"), (ImageFormat::Tiff, "TIFF")]
    {
        let folder = folder(&[(bonn_name(0, extension), encoded(format, [12, 9], 3))]);
        let texels = codes(io::open(folder.path()).expect("opens").as_ref(), 0).expect("decodes");
        // Row 0 is the top row, column 0 the left one.
        for (index, texel) in texels.iter().enumerate() {
            assert_eq!(*texel, [40 + 5 * (index % 12) as u8, 40 + 5 * (index / 12) as u8, 145, 255], "{extension}");
        }
    }
    let gray = image::GrayImage::from_fn(4, 4, |x, y| image::Luma([(60 * x + y) as u8]));
    for (format, extension) in [(ImageFormat::Png, "png"), (ImageFormat::Jpeg, "jpeg")] {
        let mut bytes = std::io::Cursor::new(Vec::new());
        gray.write_to(&mut bytes, format).expect("encodes");
        let folder = folder(&[(bonn_name(0, extension), bytes.into_inner())]);
        let texels = codes(io::open(folder.path()).expect("opens").as_ref(), 0).expect("decodes");
        assert!(texels.iter().all(|texel| texel[0] == texel[1] && texel[1] == texel[2] && texel[3] == 255), "{extension}");
    }
}

fn names_are_read_however_they_are_written() {
    let names = [
        "00008 tl015 pl060 tv030 pv090.png",
        "tv030_pv090_tl015_pl060.png",
        "TL015-PL060-TV030-PV090.PNG",
        "pv090.0tv30.0pl60.00tl15.png",
        "sample of petal012 tl15 pl420 tv30 pv-270.png",
    ];
    for name in names {
        let folder = folder(&[(name.to_owned(), encoded(ImageFormat::Png, [2, 2], 0))]);
        let source = io::open(folder.path()).expect(name);
        let (view, light) = source.btf().directions(0);
        assert_eq!((view.to_string(), light.to_string()), ("θ 30 φ 90".to_owned(), "θ 15 φ 60".to_owned()), "{name}");
    }
    let folder = folder(&[("tv007.5_pv022.25_tl052.50_pl359.9.png".to_owned(), encoded(ImageFormat::Png, [2, 2], 0))]);
    let source = io::open(folder.path()).expect("opens");
    let (view, light) = source.btf().directions(0);
    assert_eq!((view.to_string(), light.to_string()), ("θ 7.5 φ 22.25".to_owned(), "θ 52.5 φ 359.9".to_owned()));
}

fn pairs_may_be_scattered() {
    let mut files = small_tree();
    files.remove(4);
    let tree = folder(&files);
    let source = io::open(tree.path()).expect("opens");
    let btf = source.btf();
    assert_eq!((btf.views().len(), btf.lights().len(), btf.pairs().len(), btf.missing()), (2, 3, 5, 1));
    assert_eq!(btf.missing_pairs().collect::<Vec<_>>(), [Pair { view: 1, light: 1 }]);
    assert!(!btf.is_product());
    for (sample, stored) in [0, 1, 2, 3, 5].into_iter().enumerate() {
        let (view, light) = btf.directions(sample);
        let found = [view.degrees().0, view.degrees().1, light.degrees().0, light.degrees().1].map(|angle| angle.round() as u32);
        assert_eq!(found, PAIRS[stored]);
        let expected = image::load_from_memory(&encoded(ImageFormat::Jpeg, [12, 9], stored)).expect("decodes").into_rgba8();
        assert_eq!(codes(source.as_ref(), sample).expect("decodes").as_flattened(), expected.as_raw().as_slice());
    }

    // As CUReT: hardly any two samples share a view or a light.
    let names = (0..30).map(|index| format!("tl{index:03} pl000 tv{:03} pv000.png", 29 - index));
    let tree = folder(&names.map(|name| (name, encoded(ImageFormat::Png, [2, 2], 0))).collect::<Vec<_>>());
    let source = io::open(tree.path()).expect("opens");
    let btf = source.btf();
    assert_eq!((btf.views().len(), btf.lights().len(), btf.pairs().len(), btf.missing()), (30, 30, 30, 870));
    assert!(btf.pairs().windows(2).all(|pair| pair[0] < pair[1]), "view-major");
    assert_eq!(btf.missing_pairs().count(), 870);
    assert!(btf.missing_pairs().all(|pair| !btf.pairs().contains(&pair)));
}

fn the_zenith_is_one_direction() {
    let names =
        ["tl000 pl030 tv000 pv090.png", "tl015 pl030 tv000 pv000.png", "tl000 pl000 tv015 pv000.png", "tl015 pl030 tv015 pv360.png"];
    let tree = folder(&names.map(|name| (name.to_owned(), encoded(ImageFormat::Png, [2, 2], 0))));
    let source = io::open(tree.path()).expect("opens");
    let texts = |directions: &[Direction]| directions.iter().map(ToString::to_string).collect::<Vec<_>>();
    assert_eq!(texts(source.btf().views()), ["θ 0 φ 0", "θ 15 φ 0"]);
    assert_eq!(texts(source.btf().lights()), ["θ 0 φ 0", "θ 15 φ 30"]);
    assert!(source.btf().is_product());
    write_tree(tree.path(), &[("tl000 pl090 tv000 pv270.png".to_owned(), Vec::new())]);
    assert_says(io::open(tree.path()), &["view θ 0 φ 0, light θ 0 φ 0 is there twice", names[0], "tl000 pl090 tv000 pv270.png"]);
}

fn directions_are_in_names() {
    let found = io::directions_in_name("somewhere/00008 tl015 pl420 tv000.0 pv090.jpg").expect("are there");
    assert_eq!((found.0.to_string(), found.1.to_string()), ("θ 0 φ 0".to_owned(), "θ 15 φ 60".to_owned()));
    for name in ["", "tl0pl0tv0pv0", "tl0pl0tv0.jpg", "tl0pl0tv0pv0pv0.jpg", "tl0pl0tv0pv0/a.jpg", "xtl0pl0tv0pv0.jpg"] {
        assert_eq!(io::directions_in_name(name), None, "{name}");
    }
    assert!(io::directions_in_name("tl-99999999999999999999999999 pl-9e99 tv0 pv999999999999999999999999.é").is_some());
}

fn a_repeated_pair_names_both_files() {
    let mut files = small_tree();
    files.push(("again/tl15.0_pl120_tv0_pv360.png".to_owned(), Vec::new()));
    let folder = folder(&files);
    assert_says(io::open(folder.path()), &["twice", &bonn_name(1, "jpg"), "again/tl15.0_pl120_tv0_pv360.png", "keep one"]);
}

fn images_of_different_sizes_are_refused() {
    for (format, extension) in [(ImageFormat::Jpeg, "jpg"), (ImageFormat::Png, "png")] {
        let mut files = small_tree();
        files[3] = (bonn_name(3, extension), encoded(format, [9, 12], 3));
        let folder = folder(&files);
        let source = io::open(folder.path()).expect("opens");
        assert_says(codes(source.as_ref(), 3), &[&bonn_name(3, extension), "9 x 12", "12 x 9", "crop"]);
        codes(source.as_ref(), 2).expect("the others stay readable");
    }
}

/// The decoder's default is to fill up with gray and report success.
fn every_truncation_of_a_jpeg_is_an_error() {
    let whole = encoded(ImageFormat::Jpeg, [40, 24], 1);
    let folder = folder(&[(bonn_name(0, "jpg"), whole.clone())]);
    let source = io::open(folder.path()).expect("opens");
    for length in 0..whole.len() {
        write_tree(folder.path(), &[(bonn_name(0, "jpg"), whole[..length].to_vec())]);
        let expected = if length < 3 { "is no image" } else { "is truncated" };
        assert_says(codes(source.as_ref(), 0), &[expected, &bonn_name(0, "jpg")]);
    }
    write_tree(folder.path(), &[(bonn_name(0, "jpg"), [whole, vec![0; 100]].concat())]);
    codes(source.as_ref(), 0).expect("what follows the end does not count");
}

fn truncated_rasters_are_errors_or_complete() {
    for (format, extension) in [(ImageFormat::Png, "png"), (ImageFormat::Bmp, "bmp"), (ImageFormat::Tiff, "tif")] {
        let whole = encoded(format, [12, 9], 1);
        let folder = folder(&[(bonn_name(0, extension), whole.clone())]);
        let source = io::open(folder.path()).expect("opens");
        let texels = codes(source.as_ref(), 0).expect("decodes");
        for length in 0..whole.len() {
            write_tree(folder.path(), &[(bonn_name(0, extension), whole[..length].to_vec())]);
            match codes(source.as_ref(), 0) {
                Ok(found) => assert_eq!(found, texels, "{extension} cut to {length} of {} bytes", whole.len()),
                Err(error) => assert!(error.to_string().contains(&bonn_name(0, extension)), "{error}"),
            }
        }
    }
}

/// No Huffman code is all ones.
fn damage_within_a_jpeg_is_an_error() {
    let whole = encoded(ImageFormat::Jpeg, [40, 24], 1);
    let folder = folder(&[(bonn_name(0, "jpg"), whole.clone())]);
    let source = io::open(folder.path()).expect("opens");
    let start = whole.windows(2).position(|pair| pair == [0xff, 0xda]).expect("has a scan") + 14;
    let damaged = [&whole[..start + 20], &[0xff, 0x00].repeat(8), &whole[start + 20..]].concat();
    write_tree(folder.path(), &[(bonn_name(0, "jpg"), damaged)]);
    assert_says(codes(source.as_ref(), 0), &["is damaged", &bonn_name(0, "jpg")]);
}

fn a_file_that_is_no_image_is_named() {
    let mut files = small_tree();
    files[2].1 = b"<html>not found</html>".to_vec();
    let tree = folder(&files);
    let source = io::open(tree.path()).expect("opens");
    assert_says(codes(source.as_ref(), 2), &[&bonn_name(2, "jpg"), "is no image", "\"<html>no\""]);
    files[0].1 = Vec::new();
    assert_says(io::open(folder(&files).path()), &[&bonn_name(0, "jpg"), "it is empty"]);
}

fn no_images_is_an_error() {
    let folder = folder(&[("notes/readme.txt".to_owned(), Vec::new())]);
    assert_says(io::open(folder.path()), &["no images in", folder.path().to_str().expect("is ASCII"), ".jpg"]);
    assert_eq!(io::kind(folder.path()), Kind::Neither);
}

fn images_without_directions_are_named() {
    // An angle short, and one angle twice.
    let files =
        ["a/holiday.jpg", "b/tl000 pl000 tv000.jpg", "c/tl000 tl015 pl000 tv000 pv000.jpg"].map(|name| (name.to_owned(), Vec::new()));
    let folder = folder(&files);
    assert_says(io::open(folder.path()), &["none of the 3 images", "tl015 pl060 tv030 pv090.jpg", "\"a/holiday.jpg\"", "rename"]);
    assert_eq!(io::kind(folder.path()), Kind::Neither);
}

fn a_direction_below_the_horizon_is_refused() {
    for name in ["tl090 pl000 tv000 pv000.jpg", "tl000 pl000 tv-15 pv000.jpg", "tl99999999999999999999 pl0 tv0 pv0.jpg"] {
        let folder = folder(&[(name.to_owned(), Vec::new())]);
        assert_says(io::open(folder.path()), &[name, "below 90 degrees"]);
    }
}

fn formats_that_are_not_read_are_named() {
    let tree = folder(&[(bonn_name(0, "jpg"), b"GIF89a and so on".to_vec())]);
    assert_says(
        io::open(tree.path()),
        &[&bonn_name(0, "jpg"), "Gif", "JPEG, PNG, BMP and TIFF of 8 or 16 bits", "Radiance HDR and OpenEXR"],
    );
}

fn an_absurd_size_is_refused_before_it_is_allocated() {
    // The frame header of a JPEG holds rows and columns 5 bytes after its marker.
    let mut jpeg = encoded(ImageFormat::Jpeg, [12, 9], 0);
    let frame = jpeg.windows(2).position(|pair| pair == [0xff, 0xc0]).expect("is a baseline JPEG");
    jpeg[frame + 5..frame + 9].fill(0xf0);
    let tree = folder(&[(bonn_name(0, "jpg"), jpeg.clone())]);
    assert_says(io::open(tree.path()), &[&bonn_name(0, "jpg"), "61680 x 61680"]);
    let mut files = small_tree();
    files[5].1 = jpeg;
    let tree = folder(&files);
    assert_says(codes(io::open(tree.path()).expect("opens").as_ref(), 5), &["61680 x 61680", "12 x 9"]);
    // A BMP's header holds columns and rows from byte 18.
    let mut bmp = encoded(ImageFormat::Bmp, [12, 9], 0);
    bmp[18..26].copy_from_slice(&[0, 0, 1, 0, 0, 0, 1, 0]);
    let tree = folder(&[(bonn_name(0, "bmp"), bmp)]);
    assert_says(io::open(tree.path()), &[&bonn_name(0, "bmp")]);
}

fn a_path_that_does_not_exist_is_an_error() {
    let folder = folder(&[]);
    let path = folder.path().join("nothing here");
    assert_says(io::open(&path), &["nothing here does not exist"]);
    assert_eq!(io::kind(&path), Kind::Neither);
}

fn a_lost_file_is_named_at_decoding() {
    let folder = folder(&small_tree());
    let source = io::open(folder.path()).expect("opens");
    std::fs::remove_file(folder.path().join(bonn_name(4, "jpg"))).expect("was there");
    assert_says(codes(source.as_ref(), 4), &["cannot read", &bonn_name(4, "jpg")]);
}
