//! Eigenvalues, of whatever operator or matrices they are asked of.

pub mod tridiagonal;
pub mod lanczos;
pub mod dense;
pub mod factor;
pub mod shift_invert;
#[cfg(feature = "arpack")]
#[allow(unsafe_code)] // It calls C; nothing else in this crate does.
pub mod arpack;
