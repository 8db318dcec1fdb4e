// Interpolation between texels by B-splines (model::TexelSamples). Places are in texels: x = column, y = row, centres at whole numbers.
// Twin: reference::reconstruct_lpca.
#import boundary

// The number of texels at which the corners of the quadratic spline's nine are left out.
const CROSS: u32 = 5u;

// Texels along an axis: one more than the spline's degree.
fn spline_width(texel_samples: u32) -> u32 {
    return select(select(select(5u, 3u, texel_samples <= 9u), 2u, texel_samples <= 4u), 1u, texel_samples <= 1u);
}

// The centred B-spline that is `width` wide, at up to half of that from its middle.
fn b_spline(width: u32, x: f32) -> f32 {
    let distance = abs(x);
    let rest = 0.5 * f32(width) - distance;
    switch width {
        case 1u: {
            return 1.0;
        }
        case 2u: {
            return rest;
        }
        case 3u: {
            return select(0.5 * rest * rest, 0.75 - distance * distance, distance < 0.5);
        }
        default: {
            let square = distance * distance;
            if distance < 0.5 {
                return 115.0 / 192.0 + square * (0.25 * square - 0.625);
            }
            if distance < 1.5 {
                return (55.0 + distance * (20.0 - distance * (120.0 - distance * (80.0 - 16.0 * distance)))) / 96.0;
            }
            return rest * rest * rest * rest / 24.0;
        }
    }
}

// The texels around a place.
struct Footprint {
    place: vec2<f32>,
    // upper left texel
    first: vec2<f32>,
    width: u32,
    cross: bool,
}

fn footprint_at(place: vec2<f32>, texel_samples: u32) -> Footprint {
    let width = spline_width(texel_samples);
    return Footprint(place, floor(place - 0.5 * f32(width)) + 1.0, width, texel_samples == CROSS);
}

// Column and row of one of its width x width texels, before the boundary, and its weight, from 0; without the cross they sum to 1.
struct Tap {
    texel: vec2<i32>,
    weight: f32,
}

fn tap_at(footprint: Footprint, tap: u32) -> Tap {
    let column = tap % footprint.width;
    let row = tap / footprint.width;
    let texel = footprint.first + vec2(f32(column), f32(row));
    let offset = footprint.place - texel;
    let corner = footprint.cross && column != 1u && row != 1u;
    let weight = select(b_spline(footprint.width, offset.x) * b_spline(footprint.width, offset.y), 0.0, corner);
    return Tap(vec2<i32>(texel), max(weight, 0.0));
}
