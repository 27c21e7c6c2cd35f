//! What are the extreme eigenvalues of an operator, or of two matrices?
//!
//! This chapter is about matrices, not bats. [`crate::solve()`] uses [`lanczos`]; [`dense`], [`shift_invert`] and, with
//! the feature `arpack`, ARPACK are independent checks. [`fronts`] factors long matrices of dense blocks, as for the
//! walls of hollow bats.

pub mod tridiagonal;
pub mod lanczos;
pub mod factor;
pub mod fronts;
pub mod dense;
pub mod shift_invert;
#[cfg(feature = "arpack")]
#[allow(unsafe_code)] // It calls C; nothing else in this crate does.
pub mod arpack;
