//! Eigenvalues, of whatever operator or matrices they are asked of.

pub mod tridiagonal;
pub mod lanczos;
pub mod dense;
pub mod factor;
pub mod shift_invert;
