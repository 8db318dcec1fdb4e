//! DFMF, decorrelated full matrix factorisation: colours are decorrelated, and each channel is a product of all samples and all texels.

use super::{
    BtfFileError, Described,
    bytes::Header,
    color::Color,
    factored::{Channels, Factored, Mean, Product, Set},
    scalar::Table,
};

/// Reads META, BIDIR, size and rotations; `u32` most components, `i32` colour model, `f32[3]` mean and `f32[3][3]` transform of colours;
/// then for each channel `u8` bytes of a scalar, `u32` components, rows, columns, and the matrices.
///
/// Samples are rows, `l + nL v`, and texels columns, `x + W y`; or, transposed, texels are rows and samples columns. Where both fit, it is
/// not transposed.
pub(super) fn read(header: &mut Header<'_>, rotated: bool) -> Result<(Described, Factored), BtfFileError> {
    let described = Described::read(header, rotated)?;
    header.u32("number of components")?;
    let at = header.offset();
    let model = header.i32("colour model")?;
    let mut floats = [0.0; 12];
    for value in &mut floats {
        *value = header.f32("transform of colours")?;
    }
    let [a, b, c, rest @ ..] = floats;
    let color = match model {
        0 => Color::Rgb,
        1 => Color::Yuv,
        3 => Color::Principal { mean: [a, b, c], transform: [0, 3, 6].map(|row| [rest[row], rest[row + 1], rest[row + 2]]) },
        4 => Color::YCoCg,
        11 => Color::LogarithmOfY,
        _ => return Err(header.unsupported(at, "the colour model", "0, 1, 3, 4 and 11", model)),
    };
    let products = (0..3).map(|_| product(header, &described)).collect::<Result<_, _>>()?;
    Ok((described, Factored { sets: vec![Set { products }], color }))
}

fn product(header: &mut Header<'_>, described: &Described) -> Result<Product, BtfFileError> {
    let scalar = header.scalar()?;
    let components = header.positive("number of components")?;
    let at = header.offset();
    let found = [header.u32("rows of a channel's matrix")?, header.u32("columns of a channel's matrix")?];
    header.pass("singular values", &[u64::from(components), scalar.bytes() as u64])?;
    let u = Table::pass(header, "a matrix of factors", [found[0], components], scalar)?;
    let sv = Table::pass(header, "a matrix of factors", [found[1], components], scalar)?;
    let (samples, texels) = (described.samples(), described.texels());
    let (samples_of, texels_of) = match found.map(u64::from) {
        found if found == [samples, texels] => (u, sv),
        found if found == [texels, samples] => (sv, u),
        [rows, columns] => {
            let expected = format!("{samples} x {texels}, or transposed {texels} x {samples} (samples, texels)");
            return Err(header.unexpected(at, "size of a channel's matrix", expected, format_args!("{rows} x {columns}")));
        }
    };
    let samples = samples_of.load(header.container(), |_| None)?;
    Ok(Product { components: texels_of.columns(), samples, texels: texels_of, mean: Mean::None, channels: Channels::One })
}
