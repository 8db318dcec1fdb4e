//! A part of a source is that part of the whole.

use image::ImageFormat;
use overpaint::{
    data::{Block, Direction},
    io::{self, IoError, ReadOptions, Source},
};
use tempfile::TempDir;

use super::{assert_says, encoded, read, small_tree, write_tree};

crate::suite! { plain:
    any_block_is_that_part_of_the_picture,
    a_region_is_that_part_of_the_source,
    every_nth_direction_is_kept,
    scattered_pairs_are_selected,
    theta_is_limited,
    options_work_together,
    what_is_not_there_is_refused,
    a_selection_has_a_fingerprint_of_its_own;
}

fn small() -> TempDir {
    let folder = tempfile::tempdir().expect("is writable");
    write_tree(folder.path(), &small_tree());
    folder
}

fn select(folder: &TempDir, options: ReadOptions) -> Result<Box<dyn Source>, IoError> {
    io::open_with(folder.path(), &options)
}

fn every_block([width, height]: [usize; 2]) -> impl Iterator<Item = Block> {
    let spans = |side: usize| (0..side).flat_map(move |first| (first + 1..=side).map(move |end| (first, end - first)));
    let block = |((column, width), (row, height))| Block { column, row, width, height };
    spans(width).step_by(3).flat_map(move |columns| spans(height).step_by(2).map(move |rows| block((columns, rows))))
}

fn any_block_is_that_part_of_the_picture() {
    let folder = small();
    let source = select(&folder, ReadOptions::default()).expect("opens");
    let samples = [1, 4];
    let whole = samples.map(|sample| source.picture(sample).expect("decodes"));
    for block in every_block([12, 9]) {
        let radiance = read(source.as_ref(), &samples, block).expect("reads");
        let expected = whole.iter().flat_map(|picture| {
            (0..3).flat_map(move |channel| {
                block.rows().flat_map(move |row| block.columns().map(move |column| picture[(column, row)][channel]))
            })
        });
        assert!(radiance.iter().map(|half| half.to_f32()).eq(expected), "{block}");
    }
}

fn a_region_is_that_part_of_the_source() {
    let folder = small();
    let whole = select(&folder, ReadOptions::default()).expect("opens");
    for region in every_block([12, 9]).step_by(7) {
        let part = select(&folder, ReadOptions { region: Some(region), ..ReadOptions::default() }).expect("opens");
        assert_eq!(part.btf().size(), [region.width, region.height]);
        assert_eq!((part.btf().pairs(), part.btf().views()), (whole.btf().pairs(), whole.btf().views()));
        let all = Block::whole(part.btf().size());
        let expected = read(whole.as_ref(), &[0, 5], region).expect("reads");
        assert_eq!(read(part.as_ref(), &[0, 5], all).expect("reads"), expected, "{region}");
        let last = Block { column: region.width - 1, row: region.height - 1, width: 1, height: 1 };
        let corner = Block { column: region.column + region.width - 1, row: region.row + region.height - 1, ..last };
        assert_eq!(read(part.as_ref(), &[3], last).expect("reads"), read(whole.as_ref(), &[3], corner).expect("reads"));
    }
}

/// A tree of 1 x 1 images under the given (view, light) angles of θ.
fn tree(pairs: impl IntoIterator<Item = [u32; 2]>) -> TempDir {
    let folder = tempfile::tempdir().expect("is writable");
    let name = |[view, light]: [u32; 2]| format!("tv{view:03}_pv000_tl{light:03}_pl000.png");
    let files: Vec<_> =
        pairs.into_iter().map(|pair| (name(pair), encoded(ImageFormat::Png, [1, 1], (pair[0] + pair[1]) as usize))).collect();
    write_tree(folder.path(), &files);
    folder
}

fn thetas(directions: &[Direction]) -> Vec<u32> {
    directions.iter().map(|direction| direction.theta.to_degrees().round() as u32).collect()
}

/// Each sample of the part is the sample of the whole with its directions.
fn assert_is_part(part: &dyn Source, whole: &dyn Source) {
    let one = Block::whole([1, 1]);
    for sample in 0..part.btf().pairs().len() {
        let same = |other: &usize| whole.btf().directions(*other) == part.btf().directions(sample);
        let other = (0..whole.btf().pairs().len()).find(same).expect("is there");
        assert_eq!(read(part, &[sample], one).expect("reads"), read(whole, &[other], one).expect("reads"));
    }
    assert!(part.btf().pairs().windows(2).all(|pair| pair[0] < pair[1]), "view-major");
}

fn every_nth_direction_is_kept() {
    let folder = tree((0..7).flat_map(|view| (1..9).map(move |light| [view * 10, light * 10])));
    let whole = select(&folder, ReadOptions::default()).expect("opens");
    for every in 1..=9 {
        let part = select(&folder, ReadOptions { every: Some(every), ..ReadOptions::default() }).expect("opens");
        assert_eq!(thetas(part.btf().views()), (0..7).step_by(every).map(|view| view * 10).collect::<Vec<_>>());
        assert_eq!(thetas(part.btf().lights()), (1..9).step_by(every).map(|light| light * 10).collect::<Vec<_>>());
        assert!(part.btf().is_product());
        assert_is_part(part.as_ref(), whole.as_ref());
    }
}

fn scattered_pairs_are_selected() {
    let folder = tree([[0, 40], [10, 30], [20, 20], [20, 40], [30, 10], [40, 0]]);
    let whole = select(&folder, ReadOptions::default()).expect("opens");
    let part = select(&folder, ReadOptions { every: Some(2), ..ReadOptions::default() }).expect("opens");
    // Views 0, 20, 40 and lights 0, 20, 40.
    assert_eq!((thetas(part.btf().views()), thetas(part.btf().lights()), part.btf().pairs().len()), (vec![0, 20, 40], vec![0, 20, 40], 4));
    assert_eq!(part.btf().missing(), 5);
    assert_is_part(part.as_ref(), whole.as_ref());
    // A direction without a sample is none of the source's.
    let part = select(&folder, ReadOptions { max_theta: Some(20.0), ..ReadOptions::default() }).expect("opens");
    assert_eq!((thetas(part.btf().views()), thetas(part.btf().lights())), (vec![20], vec![20]));
    assert_is_part(part.as_ref(), whole.as_ref());
}

fn theta_is_limited() {
    let folder = tree((0..6).flat_map(|view| (1..7).map(move |light| [view * 15, light * 12])));
    let whole = select(&folder, ReadOptions::default()).expect("opens");
    for (limit, views, lights) in [(90.0, 6, 6), (72.0, 5, 6), (45.0, 4, 3), (44.999, 3, 3), (12.0, 1, 1)] {
        let part = select(&folder, ReadOptions { max_theta: Some(limit), ..ReadOptions::default() }).expect("opens");
        assert_eq!((part.btf().views().len(), part.btf().lights().len()), (views, lights), "up to {limit}");
        assert_is_part(part.as_ref(), whole.as_ref());
    }
}

fn options_work_together() {
    let folder = tree((0..6).flat_map(|view| (1..7).map(move |light| [view * 15, light * 12])));
    let options = ReadOptions { max_theta: Some(60.0), every: Some(2), scale: Some(2.0), ..ReadOptions::default() };
    let part = select(&folder, options).expect("opens");
    assert_eq!((thetas(part.btf().views()), thetas(part.btf().lights())), (vec![0, 30, 60], vec![12, 36, 60]));
    assert_eq!(part.btf().encoding().scale, 2.0);
    // Lights of a light file are in its order; the view is one.
    let folder = tempfile::tempdir().expect("is writable");
    let image = |index: usize| (format!("s.{index}.png"), encoded(ImageFormat::Png, [1, 1], index));
    let lights = ("lights.txt".to_owned(), b"4\n0.6 0 0.8\n0 0 1\n0.28 0 0.96\n0 0.8 0.6".to_vec());
    write_tree(folder.path(), &[image(0), image(1), image(2), image(3), lights]);
    let part = select(&folder, ReadOptions { max_theta: Some(40.0), every: Some(2), ..ReadOptions::default() }).expect("opens");
    assert_eq!((part.btf().views().len(), thetas(part.btf().lights())), (1, vec![37, 16]));
    assert_is_part(part.as_ref(), select(&folder, ReadOptions::default()).expect("opens").as_ref());
}

fn what_is_not_there_is_refused() {
    let folder = small();
    for (column, row, width, height) in
        [(0, 0, 13, 1), (12, 0, 1, 1), (0, 9, 1, 1), (3, 3, 0, 2), (usize::MAX, 0, 2, 1), (0, 1, 12, usize::MAX)]
    {
        let region = Some(Block { column, row, width, height });
        assert_says(
            select(&folder, ReadOptions { region, ..ReadOptions::default() }),
            &["not within the 12 x 9 texels", &format!("column {column}")],
        );
    }
    assert_says(select(&folder, ReadOptions { every: Some(0), ..ReadOptions::default() }), &["every 1st"]);
    for limit in [14.0, 0.0, f64::NAN] {
        let options = ReadOptions { max_theta: Some(limit), ..ReadOptions::default() };
        let says = ["no sample of", "is left: θ up to", "it has 6 samples, views 2 of θ 0.0 to 45.0, lights 3 of θ 15.0 to 30.0"];
        assert_says(select(&folder, options), &says);
    }
}

fn a_selection_has_a_fingerprint_of_its_own() {
    let folder = small();
    let print = |options| select(&folder, options).expect("opens").fingerprint();
    let none = ReadOptions::default();
    let region = Some(Block { column: 0, row: 0, width: 2, height: 2 });
    let mut prints = vec![
        print(none),
        print(ReadOptions { region, ..none }),
        print(ReadOptions { every: Some(2), ..none }),
        print(ReadOptions { max_theta: Some(60.0), ..none }),
    ];
    assert_eq!(prints[1], print(ReadOptions { region, ..none }));
    prints.sort_unstable();
    prints.dedup();
    assert_eq!(prints.len(), 4);
}
