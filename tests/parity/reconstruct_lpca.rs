use overpaint::{
    data::{Direction, Grid, Map},
    gpu::Gpu,
    model::{Boundary, TexelSamples},
    reference,
};

use crate::support::{
    directions, hold,
    lpca::{self, Asked, product, radiance, reconstruct, upload},
    random::Random,
    worst_difference,
};

crate::suite! {
    gpu: pictures_agree, places_under_any_directions_agree, pairs_that_are_missing_agree, a_picture_is_its_places,
        a_repeated_material_gives_the_repeated_picture;
}

fn grid(name: &str) -> Vec<Direction> {
    name.parse::<Grid>().expect("is a grid").directions()
}

fn rgb(picture: &Map<[f32; 4]>) -> impl Iterator<Item = f64> {
    picture.values().iter().flat_map(|&[r, g, b, _]| [r, g, b].map(f64::from))
}

/// Weights of directions are good to 4e-7 over the height of a triangle (parity of the meshes), which is at least 0.1 in these grids; values
/// are up to 2, and the sums of up to 225 x 33 terms of them are rounded as often, to either side.
const BOUND: f64 = 5e-6;

fn pictures_agree(gpu: &Gpu) {
    let mut random = Random::new(1);
    let (views, lights) = (grid("0:1,40:7"), grid("thesis51"));
    // Sizes across a workgroup's edge, clusters and components from the least.
    let cases = [
        ([1, 1], [1, 1]),
        ([9, 7], [2, 3]),
        ([8, 8], [16, 8]),
        ([13, 5], [63, 0]),
        ([13, 5], [5, 32]),
        ([100, 50], [16, 8]),
        ([3, 2], [256, 2]),
    ];
    for (size, numbers) in cases {
        let lpca = lpca::random(&mut random, size, product(views.len(), lights.len()), numbers);
        for boundary in [Boundary::Periodic, Boundary::Mirror] {
            let twin = reference::CompressedBtf::new(&lpca, &views, &lights, boundary).expect("fits");
            let btf = upload(gpu, &lpca, &views, &lights, boundary);
            for texel_samples in TexelSamples::ALL {
                let (view, light) = (directions::anywhere(&mut random), directions::anywhere(&mut random));
                let found = reconstruct(gpu, &btf, texel_samples, view, light);
                let expected = reference::reconstruct_lpca(&twin, texel_samples, view, light);
                assert!(found.values().iter().all(|pixel| pixel[3] == 1.0));
                let worst = worst_difference(rgb(&found), expected.values().iter().flatten().copied());
                hold("reconstruct_lpca: pictures", worst, BOUND);
            }
        }
    }
}

fn anywhere(random: &mut Random, [width, height]: [usize; 2]) -> Asked {
    let place = [width, height].map(|side| random.between(-1.5 * side as f64, 2.5 * side as f64));
    (place, directions::anywhere(random), directions::anywhere(random))
}

fn places_under_any_directions_agree(gpu: &Gpu) {
    let mut random = Random::new(2);
    let (views, lights) = (grid("thesis51"), grid("0:1,30:6,60:12"));
    let lpca = lpca::random(&mut random, [9, 7], product(views.len(), lights.len()), [5, 3]);
    for boundary in [Boundary::Periodic, Boundary::Mirror] {
        let twin = reference::CompressedBtf::new(&lpca, &views, &lights, boundary).expect("fits");
        let btf = upload(gpu, &lpca, &views, &lights, boundary);
        for texel_samples in TexelSamples::ALL {
            let asked: Vec<_> = (0..4000).map(|_| anywhere(&mut random, [9, 7])).collect();
            let found = radiance(gpu, &btf, texel_samples, &asked);
            let expected = asked.iter().flat_map(|(place, view, light)| twin.radiance(place.map(|at| f64::from(at as f32)), texel_samples, *view, *light));
            hold("reconstruct_lpca: places", worst_difference(found.into_iter().flatten(), expected), BOUND);
        }
    }
}

fn pairs_that_are_missing_agree(gpu: &Gpu) {
    let mut random = Random::new(3);
    let (views, lights) = (grid("thesis51"), grid("0:1,30:6,60:12"));
    let mut pairs = product(views.len(), lights.len());
    // A view without a sample, others with a few, in no order, some twice.
    pairs.retain(|pair| pair.view != 7 && random.below(3) > 0);
    pairs.sort_by_key(|pair| (31 * pair.view + 17 * pair.light) % 53);
    pairs.extend_from_within(..5);
    let lpca = lpca::random(&mut random, [9, 7], pairs, [3, 2]);
    let twin = reference::CompressedBtf::new(&lpca, &views, &lights, Boundary::Periodic).expect("fits");
    let btf = upload(gpu, &lpca, &views, &lights, Boundary::Periodic);
    let asked: Vec<_> = (0..4000).map(|_| anywhere(&mut random, [9, 7])).collect();
    let found = radiance(gpu, &btf, TexelSamples::Four, &asked);
    let expected = asked.iter().flat_map(|(place, view, light)| twin.radiance(place.map(|at| f64::from(at as f32)), TexelSamples::Four, *view, *light));
    hold("reconstruct_lpca: places, not all pairs measured", worst_difference(found.into_iter().flatten(), expected), BOUND);
}

/// The two ways on the adapter: terms blended once for all texels, and all at each pixel.
fn a_picture_is_its_places(gpu: &Gpu) {
    let mut random = Random::new(4);
    let (views, lights) = (grid("ubo81"), grid("thesis51"));
    let size = [33, 21];
    let lpca = lpca::random(&mut random, size, product(views.len(), lights.len()), [16, 8]);
    let btf = upload(gpu, &lpca, &views, &lights, Boundary::Mirror);
    for texel_samples in TexelSamples::ALL {
        let (view, light) = (directions::anywhere(&mut random), directions::anywhere(&mut random));
        let asked: Vec<_> = (0..size[0] * size[1]).map(|texel| ([(texel % size[0]) as f64, (texel / size[0]) as f64], view, light)).collect();
        let picture = reconstruct(gpu, &btf, texel_samples, view, light);
        let places = radiance(gpu, &btf, texel_samples, &asked);
        // The same numbers in another order: half a unit in the last place of each partial sum, which is below 4.
        hold("reconstruct_lpca: picture and places", worst_difference(rgb(&picture), places.into_iter().flatten()), 4e-6);
    }
}

/// One row past 65,535 workgroups of 64, against a picture of one tile of it.
fn a_repeated_material_gives_the_repeated_picture(gpu: &Gpu) {
    let mut random = Random::new(5);
    let (views, lights) = (grid("0:1,40:7"), grid("0:1,40:7"));
    let tile = lpca::random(&mut random, [64, 32], product(8, 8), [3, 1]);
    let (columns, rows) = (257, 8);
    let large = tile.repeated(columns, rows);
    let (view, light) = (Direction::from_degrees(30.0, 70.0), Direction::from_degrees(40.0, 10.0));
    let [small, large] = [&tile, &large].map(|lpca| {
        let btf = upload(gpu, lpca, &views, &lights, Boundary::Periodic);
        reconstruct(gpu, &btf, TexelSamples::Nine, view, light)
    });
    let small = small.repeated(columns, rows);
    // Offsets between whole numbers are exact in either.
    assert!(small == large);
}
