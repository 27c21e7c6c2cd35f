//! Two or more bats in the same scene: which differences are larger than the errors?
//!
//! The first bat is the reference. Each difference of another bat stands beside its error, the sum of both errors; a
//! difference within it is not significant. Beside it stands the usual difference between two pieces of one wood, which
//! is larger than most errors.

pub mod hidden;
pub mod contender;
pub mod rows;
pub mod stretches;
pub mod pieces;
pub mod table;
