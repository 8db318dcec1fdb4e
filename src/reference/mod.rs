//! CPU twins of the stages in f64, from the papers, by another route than the kernels. Only tests and benches use them.

mod normals;

pub use normals::normals;
