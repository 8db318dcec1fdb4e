//! CPU twins of the stages in f64, from the papers, by another route than the kernels. Only tests and benches use them.

mod kubelka_munk;
mod normals;
mod paint_relief;
mod pattern;

pub use kubelka_munk::{film, kubelka_munk};
pub use normals::normals;
pub use paint_relief::paint_relief;
pub use pattern::pattern;
