//! Photographs from one view with a file of light directions.

use std::path::Path;

use image::{GrayImage, ImageFormat, Luma};
use overpaint::{
    data::{Direction, RowOrder, Transfer},
    io::{
        self, Kind, ReadOptions, Source,
        lights::{LightFault, parse_harvard, parse_lp, parse_uw},
    },
};
use tempfile::TempDir;

use super::{assert_says, encoded, write_tree};

crate::suite! { plain:
    washington_lights_are_read,
    harvard_lights_are_read,
    rti_lights_are_read,
    names_of_rti_images_are_found_as_written_or_nearly,
    an_lp_file_may_be_named_itself,
    texels_outside_the_mask_are_nan,
    names_with_directions_win,
    wrong_light_files_name_the_line,
    vectors_that_are_no_direction_are_refused,
    images_and_lights_must_agree,
    two_light_files_are_refused;
}

const LIGHTS: &str = "3\n0 0 1\n0.6 0.0 0.8\n0 -0.6 0.8\n";

fn gray(value: u8) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    GrayImage::from_pixel(4, 3, Luma([value])).write_to(&mut bytes, ImageFormat::Png).expect("encodes");
    bytes.into_inner()
}

fn folder(files: &[(&str, Vec<u8>)]) -> TempDir {
    let folder = tempfile::tempdir().expect("is writable");
    write_tree(folder.path(), &files.iter().map(|(name, bytes)| ((*name).to_owned(), bytes.clone())).collect::<Vec<_>>());
    folder
}

/// The codes that uniform images of a source stored.
fn stored(source: &dyn Source) -> Vec<u8> {
    let code = |sample| (source.picture(sample).expect("decodes")[(1, 1)][0] * 255.0).round() as u8;
    (0..source.btf().pairs().len()).map(code).collect()
}

fn degrees(source: &dyn Source) -> Vec<[f64; 2]> {
    let rounded = |direction: &Direction| [direction.degrees().0, direction.degrees().1].map(|angle| (angle * 1e3).round() / 1e3);
    source.btf().lights().iter().map(rounded).collect()
}

fn washington_lights_are_read() {
    let folder = folder(&[
        ("lights.txt", LIGHTS.into()),
        ("cat.2.png", gray(90)),
        ("cat.0.png", gray(70)),
        ("cat.1.png", gray(80)),
        ("cat.txt", Vec::new()),
    ]);
    assert_eq!(io::kind(folder.path()), Kind::Source);
    let source = io::open(folder.path()).expect("opens");
    let btf = source.btf();
    assert_eq!((btf.size(), btf.views(), btf.lights().len()), ([4, 3], &[Direction::from_degrees(0.0, 0.0)][..], 3));
    assert!(btf.is_product() && btf.encoding().transfer == Transfer::Linear && btf.encoding().includes_cosine);
    assert_eq!(degrees(source.as_ref()), [[0.0, 0.0], [36.87, 0.0], [36.87, 270.0]]);
    assert_eq!(stored(source.as_ref()), [70, 80, 90]);
    let options = ReadOptions { transfer: Some(Transfer::Srgb), ..ReadOptions::default() };
    assert_eq!(io::open_with(folder.path(), &options).expect("opens").btf().encoding().transfer, Transfer::Srgb);
}

fn harvard_lights_are_read() {
    let text = " 0.0 0.6  0\r\n 0.0 0.0 -0.6\r\n\r\n 1.0 8.0e-1 0.8\r\n";
    // The second of three comes before the tenth.
    let images = [("set/shot10.png", gray(90)), ("set/shot2.png", gray(80)), ("set/shot1.png", gray(70)), ("other.png", gray(1))];
    let folder = folder(&[&[("set/light_directions.txt", text.into())][..], &images].concat());
    let source = io::open(folder.path()).expect("opens");
    assert_eq!(degrees(source.as_ref()), [[0.0, 0.0], [36.87, 0.0], [36.87, 270.0]]);
    assert_eq!(stored(source.as_ref()), [70, 80, 90]);
}

fn rti_lights_are_read() {
    let text = "3\r\nimages/first shot.jpg 0 0 1\r\nC:\\old place\\B.JPG\t0.6 0 0.8\r\n\"c.jpg\"  0 -0.6 0.8\r\n";
    let images = [("images/first shot.png", gray(70)), ("images/b.png", gray(80)), ("C.png", gray(90)), ("unused.png", gray(1))];
    let folder = folder(&[&[("assembly/x.LP", text.into())][..], &images].concat());
    let source = io::open(folder.path()).expect("opens");
    assert_eq!(degrees(source.as_ref()), [[0.0, 0.0], [36.87, 0.0], [36.87, 270.0]]);
    assert_eq!(stored(source.as_ref()), [70, 80, 90]);
}

fn names_of_rti_images_are_found_as_written_or_nearly() {
    let found = |image: &str, files: &[(&str, Vec<u8>)]| {
        let text = format!("1\n{image} 0 0 1\n");
        let folder = folder(&[&[("x.lp", text.into_bytes())][..], files].concat());
        io::open(folder.path()).map(|source| stored(source.as_ref())[0])
    };
    let files = [("a/k.png", gray(10)), ("b/k.png", gray(20)), ("b/k.bmp", encoded(ImageFormat::Bmp, [4, 3], 0)), ("c/m.png", gray(30))];
    assert_eq!(found("b/k.png", &files).expect("by path"), 20);
    assert_eq!(found("./B/K.PNG", &files).expect("by path, whatever the case"), 20);
    assert_eq!(found("/home/somebody/m.png", &files).expect("by base name"), 30);
    assert_eq!(found("M.TIF", &files).expect("by base name without extension"), 30);
    assert_says(found("k.png", &files), &["x.lp: the image k.png of light 1 may be a/k.png or b/k.png"]);
    assert_says(found("n.png", &files), &["x.lp: light 1 belongs to the image n.png, which is not there"]);
}

fn an_lp_file_may_be_named_itself() {
    let folder = folder(&[
        ("one.lp", b"1\ntl000 pl000 tv000 pv000.png 0.6 0 0.8\n".to_vec()),
        ("two.lp", b"1\ntl000 pl000 tv000 pv000.png 0 0 1\n".to_vec()),
        ("tl000 pl000 tv000 pv000.png", gray(70)),
    ]);
    let path = folder.path().join("one.lp");
    assert_eq!(io::kind(&path), Kind::Source);
    let source = io::open(&path).expect("opens");
    assert_eq!(degrees(source.as_ref()), [[36.87, 0.0]]);
    assert_eq!(source.btf().name(), folder.path().file_name().expect("has one").to_str().expect("is ASCII"));
}

fn texels_outside_the_mask_are_nan() {
    let mut mask = std::io::Cursor::new(Vec::new());
    GrayImage::from_fn(4, 3, |x, y| Luma([if x == 2 && y == 0 { 255 } else { 100 * (x / 3) as u8 }]))
        .write_to(&mut mask, ImageFormat::Png)
        .expect("encodes");
    for name in ["cat.mask.png", "MASK.png", "cat_Mask.png"] {
        let files = [
            ("lights.txt", b"2\n0 0 1\n0.6 0 0.8".to_vec()),
            ("cat.0.png", gray(70)),
            ("cat.1.png", gray(80)),
            (name, mask.get_ref().clone()),
        ];
        let folder = folder(&files);
        for (rows, inside) in [(RowOrder::TopDown, (2, 0)), (RowOrder::BottomUp, (2, 2))] {
            let options = ReadOptions { rows: Some(rows), ..ReadOptions::default() };
            let source = io::open_with(folder.path(), &options).expect("opens");
            for sample in 0..2 {
                let picture = source.picture(sample).expect("decodes");
                for (column, row) in (0..12).map(|texel| (texel % 4, texel / 4)) {
                    let is_nan = picture[(column, row)].map(f32::is_nan);
                    assert_eq!(is_nan, [(column, row) != inside; 3], "{name}, column {column}, row {row}");
                }
            }
        }
        write_tree(folder.path(), &[(name.to_owned(), encoded(ImageFormat::Png, [5, 3], 0))]);
        assert_says(io::open(folder.path()), &[name, "5 x 3", "4 x 3"]);
    }
    let files = [("lights.txt", b"1\n0 0 1".to_vec()), ("a.0.png", gray(70)), ("a.mask.png", gray(255)), ("mask.png", gray(255))];
    assert_says(io::open(folder(&files).path()), &["lights.txt: the mask may be a.mask.png or mask.png"]);
}

fn names_with_directions_win() {
    let folder = folder(&[("lights.txt", LIGHTS.into()), ("tl015 pl000 tv030 pv000.0.png", gray(70))]);
    let source = io::open(folder.path()).expect("opens");
    assert_eq!(degrees(source.as_ref()), [[15.0, 0.0]]);
    assert_eq!(source.btf().encoding().transfer, Transfer::Srgb);
}

/// A parser without its result.
type Parser = fn(&str) -> Result<(), LightFault>;

fn wrong_light_files_name_the_line() {
    let cases: &[(Parser, &[(&str, &str)])] = &[
        (
            |text| parse_uw(text).map(drop),
            &[
                ("", "lists no lights"),
                ("\n\n", "lists no lights"),
                ("0", "lists no lights"),
                ("0.5 0.5 0.7", "line 1: expected the number of lights, found \"0.5 0.5 0.7\""),
                ("-1\n", "line 1: expected the number of lights"),
                ("2\n0 0 1\n", "says 2 lights, but 1 follow"),
                ("99999999999999999999\n0 0 1\n", "line 1: expected the number"),
                ("18446744073709551615\n0 0 1\n", "says 18446744073709551615 lights, but 1 follow"),
                ("1\n0 0 1\n0 0 1\n", "says 1 lights, but 2 follow"),
                ("1\n\n0 0\n", "line 3: expected a vector x y z, found \"0 0\""),
                ("1\n0 0 1 0\n", "line 2: expected a vector x y z"),
                ("1\n0 0 one\n", "line 2: expected a vector x y z"),
            ],
        ),
        (
            |text| parse_harvard(text).map(drop),
            &[
                ("", "lists no lights"),
                ("0 0\n0 0", "found 2 rows"),
                ("0 0\n0 0\n1 1\n1 1", "found 4 rows"),
                ("0 0\n0 0\n1 1 1", "line 3: expected 2 numbers as in the first row, found 3"),
                ("0 0\n0 x\n1 1", "line 2: expected a row of numbers, found \"0 x\""),
                ("0 0\n0 1\n1 -1", "column 2: the light's direction 0 1 -1 has another length than 1"),
            ],
        ),
        (
            |text| parse_lp(text).map(drop),
            &[
                ("", "lists no lights"),
                ("a.jpg 0 0 1", "line 1: expected the number of lights"),
                ("1\n0 0 1", "line 2: expected an image's name and a vector x y z, found \"0 0 1\""),
                ("1\n\"\" 0 0 1", "line 2: expected an image's name"),
                ("1\n1", "line 2: expected an image's name"),
                ("1\na.jpg 0 zero 1", "line 2: expected an image's name and a vector"),
                ("2\na.jpg 0 0 1", "says 2 lights, but 1 follow"),
            ],
        ),
    ];
    for (parse, texts) in cases {
        for (text, says) in *texts {
            let error = parse(text).expect_err(text).to_string();
            assert!(error.contains(says), "\"{error}\" does not contain \"{says}\"");
        }
    }
    let listed = parse_lp("\u{feff}1\n my  file 1.jpg   0  0  1 ").expect("is one");
    assert_eq!(listed[0].0, "my  file 1.jpg");
    let folder = folder(&[("lights.txt", b"1\n0 0\n".to_vec()), ("a.0.png", gray(1))]);
    assert_says(io::open(folder.path()), &["lights.txt: line 2: expected a vector"]);
}

fn vectors_that_are_no_direction_are_refused() {
    for (vector, problem) in [
        ("0 0 0", "is zero"),
        ("nan 0 1", "is not finite"),
        ("0 0 inf", "is not finite"),
        ("0 1e999 1", "is not finite"),
        ("0 0 2", "has another length"),
        ("0.3 0.3 0.3", "has another length"),
        ("1e-200 0 0", "has another length"),
        ("1e200 0 1e200", "has another length"),
        ("1 0 0", "is not above the surface"),
        ("0.6 0 -0.8", "is not above the surface"),
        ("1 0 1e-30", "is not above the surface"),
    ] {
        let error = parse_uw(&format!("2\n0 0 1\n{vector}\n")).expect_err(vector).to_string();
        assert!(error.contains("line 3") && error.contains(problem) && error.contains("z > 0"), "{error}");
    }
    // What rounding leaves of a unit vector is one.
    let light = parse_uw("1\n0.57 0.57 0.6").expect("is nearly of length 1")[0];
    assert!((light.phi.to_degrees() - 45.0).abs() < 1e-12 && light.theta > 0.9 && light.theta < 1.0);
}

fn images_and_lights_must_agree() {
    let refuse = |files: &[(&str, Vec<u8>)], says: &[&str]| assert_says(io::open(folder(files).path()), says);
    let (a, b, c, d) = (gray(1), gray(2), gray(3), gray(4));
    let uw = ("lights.txt", LIGHTS.as_bytes().to_vec());
    refuse(
        &[uw.clone(), ("q.0.png", a.clone()), ("q.2.png", c.clone())],
        &["lights.txt: light 2 belongs to the image q.1.png", "not there"],
    );
    refuse(&[uw.clone(), ("q.png", a.clone())], &["light 1 belongs to the image name.0.png"]);
    refuse(
        &[uw.clone(), ("q.0.png", a.clone()), ("q.1.png", b.clone()), ("q.2.png", c.clone()), ("q.3.png", d.clone())],
        &["lists 3 lights", "4 images (q.0.png to q.3.png)"],
    );
    refuse(
        &[uw, ("q.0.png", a.clone()), ("r.0.png", b.clone()), ("q.1.png", b.clone()), ("q.2.png", c.clone())],
        &["image 0 may be q.0.png or r.0.png"],
    );
    let harvard = ("light_directions.txt", b"0 0 0\n0 0 0\n1 1 1".to_vec());
    refuse(&[harvard.clone(), ("s1.png", a.clone()), ("s2.png", b.clone())], &["lists 3 lights", "2 images (s1.png to s2.png)"]);
    refuse(&[harvard, ("elsewhere/s1.png", a.clone())], &["0 images (none to none)"]);
    refuse(&[("x.lp", b"2\ns.png 0 0 1\nS.PNG 0.6 0 0.8".to_vec()), ("s.png", a)], &["x.lp: lights 1 and 2 belong to one image, s.png"]);
    assert_eq!(io::kind(folder(&[("lights.txt", LIGHTS.into())]).path()), Kind::Neither);
    assert_says(io::open(Path::new("no such.lp")), &["no such.lp does not exist"]);
}

fn two_light_files_are_refused() {
    let folder = folder(&[("x.lp", Vec::new()), ("y.lp", Vec::new()), ("s.png", gray(1))]);
    assert_says(io::open(folder.path()), &["x.lp", "y.lp", "both list lights", "name the .lp file"]);
}
