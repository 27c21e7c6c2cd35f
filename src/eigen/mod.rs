//! What are the extreme eigenvalues of an operator, or of two matrices?
//!
//! It knows matrices, not bats. [`lanczos`] is what [`crate::solve()`] uses; [`dense`],
//! [`shift_invert`] and, with the feature `arpack`, ARPACK are its outside checks. [`fronts`] factors long
//! matrices of dense blocks, as the walls of hollow bats have them.

pub mod tridiagonal;
pub mod lanczos;
pub mod factor;
pub mod fronts;
pub mod dense;
pub mod shift_invert;
#[cfg(feature = "arpack")]
#[allow(unsafe_code)] // It calls C; nothing else in this crate does.
pub mod arpack;
