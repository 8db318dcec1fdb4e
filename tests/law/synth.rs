use std::path::Path;

use half::f16;
use overpaint::{
    data::{Block, Direction, Grid, Map},
    gpu::Gpu,
    io::{self, Source},
    model::{HeightField, Synth, SynthPlace, SynthReflectance},
    pipeline::{Progress, Synthetic},
    reference::SynthSurface,
};

use super::path_traced::correlate;
use crate::support::{
    Worst, hold,
    known::{render, upload, wavy, white},
    npy,
};

crate::suite! {
    plain: patterns_repeat_and_stay_in_range, materials_reflect_no_more_than_they_get, grids_have_their_directions;
    gpu: a_flat_white_plane_reads_the_cosine, a_plateau_moves_by_its_height_times_tan, a_plateau_casts_a_shadow_of_its_height_times_tan,
        hidden_texels_are_not_seen, a_mirrored_material_gives_the_mirrored_picture, a_repeated_material_gives_the_repeated_picture,
        lobes_return_no_more_than_they_get, nothing_comes_from_below_the_horizon, a_source_reads_the_same_in_any_part;
    gpu_data: pictures_are_those_of_a_path_tracer;
}

fn degrees(theta: f64, phi: f64) -> Direction {
    Direction::from_degrees(theta, phi)
}

/// `height` on columns 20 to 35 of 64, zero elsewhere.
fn plateau(height: f64) -> Map<f64> {
    Map::from_fn(64, 8, |column, _| if (20..36).contains(&column) { height } else { 0.0 })
}

fn patterns_repeat_and_stay_in_range() {
    for field in HeightField::ALL {
        for seed in 0..4 {
            for (texel, size) in (0..300).zip([[40, 30], [20, 90], [64, 64]].into_iter().cycle()) {
                let place = SynthPlace::texel(size, texel * 7 % size[0], texel * 11 % size[1]);
                let height = field.height(place, seed);
                assert!((0.0..=1.0).contains(&height), "{field}: {height}");
                for shift in [[1.0, 0.0], [0.0, 1.0], [-2.0, 1.0]] {
                    let again = SynthPlace { at: [place.at[0] + shift[0], place.at[1] + shift[1]], ..place };
                    // Rounding of a place, 4e-16, times the steepest slope but a wall's.
                    hold("synth: a pattern repeats", (field.height(again, seed) - height).abs(), 1e-10);
                }
            }
        }
    }
}

fn materials_reflect_no_more_than_they_get() {
    for kind in SynthReflectance::ALL {
        for seed in 0..50 {
            for texel in 0..100 {
                let texel = kind.texel(SynthPlace::texel([40, 30], texel % 40, texel * 7 % 30), seed);
                assert!(texel.diffuse.iter().chain(&texel.specular).all(|&value| value >= 0.0), "{kind}, seed {seed}: {texel:?}");
                hold(&format!("synth: albedo of {kind}"), texel.albedo_bound().into_iter().worst(), 1.0);
            }
        }
    }
}

fn grids_have_their_directions() {
    let grid = |text: &str| text.parse::<Grid>().map(|grid| grid.directions());
    for (text, count, last) in [
        ("zenith", 1, (0.0, 0.0)),
        ("ubo81", 81, (75.0, 345.0)),
        ("ubo151", 151, (75.0, 345.0)),
        ("thesis51", 51, (65.0, 337.5)),
        ("rings:5", 91, (75.0, 348.0)),
        ("0:1,30:4,60:8", 13, (60.0, 315.0)),
        ("85:1", 1, (85.0, 0.0)),
    ] {
        let directions = grid(text).expect("is a grid");
        assert_eq!(directions.len(), count, "{text}");
        let (theta, phi) = directions[count - 1].degrees();
        hold("synth: directions of grids, degrees", (theta - last.0).abs().max((phi - last.1).abs()), 1e-9);
    }
    for text in ["", "ubo", "rings:0", "rings:31", "rings:", "30", "30:0", "30:-1", "86:1", "-1:3", "NaN:3", "0:6", "30:4,30:8", "30:4,", "1:99999999"] {
        assert!(grid(text).is_err(), "{text}");
    }
}

fn a_flat_white_plane_reads_the_cosine(gpu: &Gpu) {
    let mut surface = white(Map::from_fn(9, 7, |_, _| 0.0));
    surface.diffuse = Map::from_fn(9, 7, |column, row| [0.1 * column as f64, 0.1 * row as f64, 1.0]);
    for height in [0.0, -3.25, 40.0] {
        // At another height than the base plane's the texels are elsewhere, at whole numbers of texels under 45°.
        surface.heights = surface.heights.map(|_| height);
        let uploaded = upload(gpu, &surface);
        for (view, light) in [(0.0, 0.0), (0.0, 60.0), (30.0, 40.0), (75.0, 80.0)] {
            if height != 0.0 && view != 0.0 {
                continue;
            }
            let picture = &render(gpu, &uploaded, &[(degrees(view, 10.0), degrees(light, 200.0))])[0];
            let cosine = light.to_radians().cos();
            for (found, albedo) in picture.values().iter().zip(surface.diffuse.values()) {
                let error = (0..3).map(|channel| (found[channel] - albedo[channel] * cosine).abs());
                // A half of a value below 1 has a last place of 2^-11; drivers may round either way.
                hold("synth: white reads cos θ_i", error.worst(), 4.9e-4);
            }
        }
    }
}

fn a_plateau_moves_by_its_height_times_tan(gpu: &Gpu) {
    let mut surface = white(plateau(3.0));
    surface.diffuse = Map::from_fn(64, 8, |column, _| [column as f64 / 64.0; 3]);
    // Seen from the right the plateau stands further left on the base plane, from above (y) further down.
    let picture = &render(gpu, &upload(gpu, &surface), &[(degrees(45.0, 0.0), degrees(0.0, 0.0))])[0];
    for row in 0..8 {
        // The rims' own normals are tilted.
        for column in 21..35 {
            hold("synth: a plateau moves", (picture[(column - 3, row)][0] - column as f64 / 64.0).abs(), 4.9e-4);
        }
    }
    surface.heights = Map::from_fn(64, 8, |_, _| 2.0);
    surface.diffuse = Map::from_fn(64, 8, |_, row| [row as f64 / 8.0; 3]);
    let picture = &render(gpu, &upload(gpu, &surface), &[(degrees(45.0, 90.0), degrees(0.0, 0.0))])[0];
    for row in 0..8 {
        assert!((0..64).all(|column| picture[(column, (row + 2) % 8)][0] == row as f64 / 8.0), "rows run against y");
    }
}

fn a_plateau_casts_a_shadow_of_its_height_times_tan(gpu: &Gpu) {
    let surface = upload(gpu, &white(plateau(4.0)));
    for theta in [20.0_f64, 50.0, 60.0, 65.0] {
        // Light from the right: the shadow lies to the left of column 20.
        let pictures = render(gpu, &surface, &[(degrees(0.0, 0.0), degrees(theta, 0.0)), (degrees(0.0, 0.0), degrees(theta, 180.0))]);
        for row in 0..8 {
            // The rims' own normals turn from the light on the other side.
            let [from_right, from_left] = [0, 1].map(|picture: usize| {
                let dark = |column: &usize| pictures[picture][(*column, row)][0] == 0.0 && ![20, 35].contains(column);
                (0..64).filter(dark).collect::<Vec<_>>()
            });
            assert!(from_right.iter().all(|column| (0..20).contains(column)), "{theta}°: {from_right:?}");
            assert!(from_left.iter().all(|column| (36..64).contains(column)), "{theta}°: {from_left:?}");
            for dark in [from_right, from_left] {
                // The wall is a ramp of one texel, and texels are whole.
                hold("synth: length of a shadow, texels", (dark.len() as f64 - 4.0 * theta.to_radians().tan()).abs(), 1.0);
            }
        }
    }
}

/// Red ground behind a plateau, seen from the right at 60° and more: at least 4·tan 60° = 6.9 texels to its left are hidden.
fn hidden_texels_are_not_seen(gpu: &Gpu) {
    let mut surface = white(plateau(4.0));
    for column in 14..19 {
        for row in 0..8 {
            surface.diffuse[(column, row)] = [1.0, 0.0, 0.0];
        }
    }
    let uploaded = upload(gpu, &surface);
    let red = |view| render(gpu, &uploaded, &[(view, degrees(0.0, 0.0))])[0].values().iter().filter(|pixel| pixel[1] < pixel[0]).count();
    for theta in [60.0, 75.0, 85.0] {
        assert_eq!(red(degrees(theta, 0.0)), 0, "{theta}°");
    }
    assert_eq!(red(degrees(0.0, 0.0)), 5 * 8);
    assert_eq!(red(degrees(60.0, 180.0)), 5 * 8);
}

fn a_mirrored_material_gives_the_mirrored_picture(gpu: &Gpu) {
    fn mirror<T: Copy>(map: &Map<T>) -> Map<T> {
        Map::from_fn(map.width(), map.height(), |column, row| map[(map.width() - 1 - column, row)])
    }
    let surface = wavy(48, 40, 6);
    let mirrored = SynthSurface {
        heights: mirror(&surface.heights),
        diffuse: mirror(&surface.diffuse),
        specular: mirror(&surface.specular),
        lobe: mirror(&surface.lobe),
    };
    let picture = &render(gpu, &upload(gpu, &surface), &[(degrees(45.0, 25.0), degrees(65.0, 140.0))])[0];
    let other = mirror(&render(gpu, &upload(gpu, &mirrored), &[(degrees(45.0, 155.0), degrees(65.0, 40.0))])[0]);
    let off = picture.values().iter().zip(other.values()).filter(|(a, b)| !(0..3).all(|c| (a[c] - b[c]).abs() <= 1e-3)).count();
    // Places are rounded differently on either side, which a silhouette, the edge of a shadow or that of a texel may show.
    hold("synth: share of pixels that mirroring changes", off as f64 / (48.0 * 40.0), 2e-3);
}

/// Cells are counted in integers, so a larger plane loses nothing.
fn a_repeated_material_gives_the_repeated_picture(gpu: &Gpu) {
    let tile = wavy(64, 32, 3);
    let large = SynthSurface {
        heights: tile.heights.repeated(9, 5),
        diffuse: tile.diffuse.repeated(9, 5),
        specular: tile.specular.repeated(9, 5),
        lobe: tile.lobe.repeated(9, 5),
    };
    let samples = [(degrees(70.0, 65.0), degrees(70.0, 10.0)), (degrees(20.0, 165.0), degrees(80.0, 310.0))];
    let (small, large) = (render(gpu, &upload(gpu, &tile), &samples), render(gpu, &upload(gpu, &large), &samples));
    assert!(small.iter().zip(&large).all(|(small, large)| small.repeated(9, 5) == *large));
}

/// Lit from anywhere: the mean of π f_r over the projected hemisphere of lights is the albedo.
fn lobes_return_no_more_than_they_get(gpu: &Gpu) {
    // Midpoints in cos²θ (equal shares of projected solid angle) and φ.
    let (rings, spokes) = (24, 24);
    let light = |index: usize| {
        let cosine = ((f64::from(index as u32 / spokes) + 0.5) / f64::from(rings)).sqrt();
        Direction { theta: cosine.acos(), phi: std::f64::consts::TAU * f64::from(index as u32 % spokes) / f64::from(spokes) }
    };
    let size = [8, 8];
    for kind in SynthReflectance::ALL {
        let texels = Map::from_fn(size[0], size[1], |column, row| kind.texel(SynthPlace::texel(size, column, row), 3));
        let surface = SynthSurface {
            heights: texels.map(|_| 0.0),
            diffuse: texels.map(|texel| texel.diffuse),
            specular: texels.map(|texel| texel.specular),
            lobe: texels.map(|texel| texel.lobe),
        };
        let uploaded = upload(gpu, &surface);
        for theta in [0.0, 40.0, 75.0, 85.0] {
            let samples: Vec<_> = (0..(rings * spokes) as usize).map(|index| (degrees(theta, 20.0), light(index))).collect();
            let pictures = render(gpu, &uploaded, &samples);
            for texel in 0..64 {
                let reflectance = |channel: usize| {
                    let sum: f64 = samples.iter().zip(&pictures).map(|((_, light), picture)| picture.values()[texel][channel] / light.theta.cos()).sum();
                    sum / samples.len() as f64
                };
                hold(&format!("synth: measured albedo of {kind}"), [0, 1, 2].map(reflectance).into_iter().worst(), 1.0);
            }
        }
    }
}

fn nothing_comes_from_below_the_horizon(gpu: &Gpu) {
    let surface = upload(gpu, &wavy(20, 20, 1));
    for (view, light) in [(30.0, 90.0), (30.0, 120.0), (90.0, 30.0), (150.0, 30.0)] {
        let picture = &render(gpu, &surface, &[(degrees(view, 0.0), degrees(light, 0.0))])[0];
        assert!(picture.values().iter().all(|pixel| *pixel == [0.0; 3]));
    }
}

/// Any block and any samples, and so any batch, give the same bits.
fn a_source_reads_the_same_in_any_part(gpu: &Gpu) {
    let recipe = Synth { height_field: HeightField::Bricks, relief: 6.0, reflectance: SynthReflectance::Silk, seed: 2 };
    let directions = |text: &str| text.parse::<Grid>().expect("is a grid").directions();
    let (views, lights) = (directions("0:1,60:3"), directions("15:2,70:3"));
    let size = [45, 31];
    let source = Synthetic::new(gpu, "bricks", recipe, size, views, lights, &Progress::new(gpu.adapter())).expect("fits");
    let read = |samples: &[usize], block: Block| {
        let mut radiance = vec![f16::NAN; 3 * samples.len() * block.texels()];
        source.read(samples, block, &mut radiance, &|_| {}).expect("renders");
        radiance
    };
    let samples: Vec<usize> = (0..20).collect();
    let whole = read(&samples, Block::whole(size));
    for (samples, block) in [
        (vec![0], Block { column: 0, row: 0, width: 1, height: 1 }),
        (vec![19], Block { column: 44, row: 30, width: 1, height: 1 }),
        (vec![1, 4, 5, 11, 12], Block { column: 7, row: 3, width: 13, height: 9 }),
        (samples, Block { column: 0, row: 10, width: 45, height: 21 }),
    ] {
        let part = read(&samples, block);
        for (index, &sample) in samples.iter().enumerate() {
            for channel in 0..3 {
                for texel in 0..block.texels() {
                    let (column, row) = (block.column + texel % block.width, block.row + texel / block.width);
                    let found = part[(index * 3 + channel) * block.texels() + texel];
                    assert_eq!(found, whole[(sample * 3 + channel) * 45 * 31 + row * 45 + column]);
                }
            }
        }
    }
    let truth = source.truth().checked().expect("covers one plane");
    let mean = truth.height.values().iter().map(|&z| f64::from(z)).sum::<f64>() / 1395.0;
    // Rounding of heights below 6 to f32.
    hold("synth: mean of the true height", mean.abs(), 1e-6);
    let normal = |n: &[f32; 3]| (f64::from(n[0]).powi(2) + f64::from(n[1]).powi(2) + f64::from(n[2]).powi(2) - 1.0).abs();
    hold("synth: length of the true normals", truth.normal.values().iter().map(normal).worst(), 1e-6);
}

/// The path-traced sets, rendered as diffuse surfaces from their true heights, against what an outside renderer made of them: parallax,
/// shadows, rows and azimuths are all as they are there. The albedo is read off the picture from above under light from above, where
/// nothing is hidden. The sets have two bounces of light more, in the shadows above all, and the weave a gloss; their walls lie up to half a
/// texel from those of the height, which alone makes 0.03 to 0.07.
fn pictures_are_those_of_a_path_tracer(gpu: &Gpu, data: &Path) {
    for (set, truth, bounds) in
        [("blocks64_ubo81x81.zip", "blocks64_truth_height.npy", BLOCKS), ("weave64_51x51.zip", "weave64_truth_height.npy", WEAVE)]
    {
        let source = io::open(&data.join(set)).expect("opens");
        let btf = source.btf();
        let [width, height] = btf.size();
        // The truth is in tile widths.
        let truth = Map::new(width, height, npy::read(&data.join(truth))).expect("has the same shape").map(|z| z * width as f64);
        let mean = truth.values().iter().sum::<f64>() / btf.texels() as f64;
        let relief = truth.values().iter().fold(0.0, |high: f64, &z| high.max(z)) - truth.values().iter().fold(f64::INFINITY, |low, &z| low.min(z));
        let mut surface = white(truth.map(|z| z - mean));
        let measured = |view: [f64; 2], light: [f64; 2]| {
            let is = |direction: Direction, wanted: [f64; 2]| {
                let (theta, phi) = direction.degrees();
                (theta - wanted[0]).abs() < 0.01 && (phi - wanted[1]).abs() < 0.01
            };
            let found = |&sample: &usize| is(btf.directions(sample).0, view) && is(btf.directions(sample).1, light);
            let sample = (0..btf.pairs().len()).find(found).unwrap_or_else(|| panic!("{set}: no view {view:?}, light {light:?}"));
            (btf.directions(sample), source.picture(sample).expect("reads"))
        };
        let (above, picture) = measured([0.0; 2], [0.0; 2]);
        let cosine = &render(gpu, &upload(gpu, &surface), &[above])[0];
        surface.diffuse =
            Map::from_fn(width, height, |column, row| picture[(column, row)].map(|value| f64::from(value) / cosine[(column, row)][0].max(0.2)));
        let surface = upload(gpu, &surface);
        for &(view, light, bound) in bounds {
            let (sample, measured) = measured(view, light);
            let grey = |[r, g, b]: [f64; 3]| (r + g + b) / 3.0;
            let expected: Vec<f64> = measured.values().iter().map(|&pixel| grey(pixel.map(f64::from))).collect();
            let correlation = |sample| {
                let found: Vec<f64> = render(gpu, &surface, &[sample])[0].values().iter().map(|&pixel| grey(pixel)).collect();
                correlate(&found, &expected)
            };
            let right = correlation(sample);
            hold(&format!("synth: 1 - correlation with {set}, view {view:?}, light {light:?}"), 1.0 - right, bound);
            // With view or light from the other side, or y downwards, it is another picture.
            let turned = |direction: Direction| Direction { phi: direction.phi + std::f64::consts::PI, ..direction };
            let flipped = |direction: Direction| Direction { phi: -direction.phi, ..direction };
            let mut wrong = vec![(sample.0, turned(sample.1)), (flipped(sample.0), flipped(sample.1))];
            // A relief that moves by less shows its parallax too little.
            if relief * view[0].to_radians().tan() > 2.2 {
                wrong.push((turned(sample.0), sample.1));
            }
            for sample in wrong {
                let wrong = correlation(sample);
                assert!(wrong < right - 0.1, "{set}, view {view:?}, light {light:?}: {right}, but {wrong} as {sample:?}");
            }
        }
    }
}

/// View and light (θ, φ), and the bound.
type Pairs = &'static [([f64; 2], [f64; 2], f64)];

const BLOCKS: Pairs = &[
    ([0.0, 0.0], [45.0, 60.0], 0.12),
    ([0.0, 0.0], [75.0, 150.0], 0.115),
    ([60.0, 54.0], [45.0, 300.0], 0.07),
    ([45.0, 200.0], [60.0, 36.0], 0.135),
    ([75.0, 120.0], [60.0, 90.0], 0.145),
];

const WEAVE: Pairs = &[([0.0, 0.0], [50.0, 103.0], 0.092), ([32.0, 60.0], [65.0, 135.0], 0.102), ([65.0, 45.0], [32.0, 300.0], 0.166)];
