//! How does the bat ring, as accurately as asked?
//!
//! [`solve()`](solve::solve) plans elements for a tolerance, solves, states an error for every number,
//! and refines until the stated errors are within the tolerance.
//!
//! | file | question |
//! |---|---|
//! | [`survey`], [`plan`] | how does the wave number go along the bat; which elements does a tolerance need |
//! | `memory` | how much memory does a solve take |
//! | [`eigenpairs`] | the lowest motions on one mesh, one bat or several side by side |
//! | [`mode`] | frequency, shape, nodes and modal mass of a mode |
//! | [`certificate`] | how far may each be off |
//! | [`referee`] | what do other solvers say |
//! | [`solve`](mod@solve), [`up_to`], [`batch`] | solve to a tolerance; up to a frequency; many bats |
//! | [`compliance`], [`reduced`], [`damping`] | how the bat gives way at a place; few modes with dashpots; how motions die out |

pub mod shape;
pub(crate) mod landmarks;
pub mod mode;
pub mod eigenpairs;
pub mod compliance;
pub mod reduced;
pub mod damping;
pub mod certificate;
pub mod referee;
pub mod survey;
pub mod plan;
pub(crate) mod memory;
pub mod request;
pub mod solution;
pub mod task;
pub mod solve;
pub mod up_to;
pub mod batch;
