//! FMF, full matrix factorisation: one product of all samples and all texels.

use super::{
    BtfFileError, Described,
    bytes::Header,
    color::Color,
    factored::{Channels, Factored, Mean, Product, Set},
    scalar::Table,
};

/// Reads META, BIDIR, size and rotations; with `extended` a `u8` version, from version 1 on a `u32` whether the logarithm was taken, from
/// version 2 on a height map of `u32` columns and rows and halves, which is passed; then `u32` components, which the matrices tell once
/// more, and the matrices.
///
/// Samples are rows, `c + 3 (l + nL v)`, and texels columns, `x + W y`; or, transposed, texels are rows, `c + 3 (x + W y)`, and samples
/// columns. Where both fit, it is not transposed.
pub(super) fn read(header: &mut Header<'_>, rotated: bool, extended: bool) -> Result<(Described, Factored), BtfFileError> {
    let described = Described::read(header, rotated)?;
    let mut color = Color::Rgb;
    if extended {
        let at = header.offset();
        let version = header.u8("version of the header")?;
        if version > 2 {
            return Err(header.unsupported(at, "the version of the FMF header", "0 to 2", version));
        }
        if version >= 1 && header.u32("dynamic range reduction")? != 0 {
            color = Color::Logarithm;
        }
        if version == 2 {
            let size = [header.u32("columns of the height map")?, header.u32("rows of the height map")?];
            header.pass("height map", &[u64::from(size[0]), u64::from(size[1]), 2])?;
        }
    }
    header.u32("number of components")?;
    let scalar = header.scalar()?;
    let components = header.positive("number of components")?;
    let at = header.offset();
    let found = [header.u32("rows of the factorised matrix")?, header.u32("columns of the factorised matrix")?];
    header.pass("singular values", &[u64::from(components), scalar.bytes() as u64])?;
    let u = Table::pass(header, "a matrix of factors", [found[0], components], scalar)?;
    let sv = Table::pass(header, "a matrix of factors", [found[1], components], scalar)?;
    let (samples, texels) = (described.samples(), described.texels());
    let (samples_of, texels_of, channels) = match found.map(u64::from) {
        [rows, columns] if rows == 3 * samples && columns == texels => (u, sv, Channels::OfSamples),
        [rows, columns] if Some(rows) == texels.checked_mul(3) && columns == samples => (sv, u, Channels::OfTexels),
        [rows, columns] => {
            let expected = format!("3·{samples} x {texels}, or transposed 3·{texels} x {samples} (samples, texels)");
            return Err(header.unexpected(at, "size of the factorised matrix", expected, format_args!("{rows} x {columns}")));
        }
    };
    let samples = samples_of.load(header.container(), |_| None)?;
    let product = Product { components: texels_of.columns(), samples, texels: texels_of, mean: Mean::None, channels };
    Ok((described, Factored { sets: vec![Set { products: vec![product] }], color }))
}
