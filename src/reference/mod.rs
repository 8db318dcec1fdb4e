//! CPU twins of the stages in f64, from the papers, by another route than the kernels. Only tests and benches use them.

mod normals;
mod plane;
mod reconstruct;
mod relief;
mod shade;

pub use normals::normals;
pub use plane::plane;
pub use reconstruct::reconstruct;
pub use shade::Surface;
