//! PVF, per-view factorisation: each view has principal components of its own.

use super::{
    BtfFileError, Described,
    bytes::Header,
    color::Color,
    factored::{Channels, Factored, Mean, Product, Set},
    header,
    scalar::Table,
};

/// What the older header starts with.
const LEGACY: i32 = 301_074;

/// Reads META, BIDIR, size and rotations, then `u32` components and `u32` views. The older header is instead `i32` 301074, `u32` components,
/// columns, rows and views, and BIDIR, without META and rotations.
///
/// Of each view: `u8` bytes of a scalar; `u32` components n, weights, dimension; eigenvalues, mean `[dimension]`, components C
/// `[dimension][n]`, weights W `[weights][n]`. A value is `W Cᵀ + mean`. Either a weight is a texel, and the dimension `c + 3 l`; or,
/// transposed, a weight is a light, and the dimension `c + 3 (x + W y)`. Where both fit, it is not transposed.
pub(super) fn read(header: &mut Header<'_>, rotated: bool) -> Result<(Described, Factored), BtfFileError> {
    let mut next = header.clone();
    let (described, slots_at, slots) = if next.i32("size of META")? == LEGACY {
        *header = next;
        header.u32("number of components")?;
        let size = header::size(header)?;
        let at = header.offset();
        let slots = header.u32("number of factorised views")?;
        (Described { encoding: header::WITHOUT_META, directions: header::directions(header)?, size }, at, slots)
    } else {
        let described = Described::read(header, rotated)?;
        header.u32("number of components")?;
        let at = header.offset();
        (described, at, header.u32("number of factorised views")?)
    };
    let [views, lights] = described.directions.counts;
    if slots != views {
        return Err(header.unexpected(slots_at, "number of factorised views", format_args!("{views} as there are views"), slots));
    }
    let set = |_| Ok(Set { products: vec![product(header, u64::from(lights), described.texels())?] });
    let sets = (0..views).map(set).collect::<Result<_, _>>()?;
    Ok((described, Factored { sets, color: Color::Rgb }))
}

fn product(header: &mut Header<'_>, lights: u64, texels: u64) -> Result<Product, BtfFileError> {
    let scalar = header.scalar()?;
    let components = header.positive("number of components")?;
    let at = header.offset();
    let [weights, dimension] = [header.u32("number of weights")?, header.u32("dimension")?];
    let (transposed, fits) = match [weights, dimension].map(u64::from) {
        found if found == [texels, 3 * lights] => (false, true),
        [found, dimension] => (true, found == lights && Some(dimension) == texels.checked_mul(3)),
    };
    if !fits {
        let expected = format!("{texels} and 3·{lights}, or transposed {lights} and 3·{texels} (texels, lights)");
        return Err(header.unexpected(at, "weights and dimension", expected, format_args!("{weights} and {dimension}")));
    }
    header.pass("eigenvalues", &[u64::from(components), scalar.bytes() as u64])?;
    let mean = Table::pass(header, "mean", [dimension, 1], scalar)?;
    let vectors = Table::pass(header, "principal components", [dimension, components], scalar)?;
    let weights = Table::pass(header, "weights", [weights, components], scalar)?;
    let components = vectors.columns() + 1;
    if transposed {
        let samples = weights.load(header.container(), |_| Some(1.0))?;
        return Ok(Product { components, samples, texels: vectors, mean: Mean::OfTexels(mean), channels: Channels::OfTexels });
    }
    let mean = mean.load(header.container(), |_| None)?;
    let samples = vectors.load(header.container(), |row| Some(mean[row]))?;
    Ok(Product { components, samples, texels: weights, mean: Mean::OfSamples, channels: Channels::OfSamples })
}
