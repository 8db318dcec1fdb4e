//! Constants of photometric stereo, read by stage and twin alike.

/// Lights nearer than this to a plane through the surface's point, as the sine of their typical angle to it, cannot tell normals
/// apart: about half a degree, the rounding of angles given in whole degrees.
pub const MIN_SPREAD: f64 = 0.01;

/// Reweighted solutions after the first. After 4, 8, 12 and 24 of them the mean error of normals is 4.74° all along on a
/// photographed sphere, 6.7°, 6.5°, 6.4° and 6.4° on the path-traced blocks, and 4.7°, 4.5°, 4.4° and 4.4° on the weave.
pub const REWEIGHTS: u32 = 12;

/// Cosine of incidence below which a sample's weight falls, to 0 at the horizon: 6°. A step at the horizon would let samples of
/// no weight and of full weight change places between solutions without end.
pub const TERMINATOR: f64 = 0.1;

/// Least scale of residuals over the albedo. 8-bit images are rounded to 0.4 % of white; nearer than this, a few samples that
/// happen to agree would outvote all others.
pub const NOISE: f64 = 0.01;
