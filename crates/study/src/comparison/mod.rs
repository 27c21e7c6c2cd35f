//! Two or more bats in the same scene: which differences are larger than the errors?
//!
//! The first bat is the reference. Each difference of another bat is given with its error, the sum of both errors; a
//! difference within it is not significant. The usual difference between two pieces of one wood is given too, and is
//! larger than most errors.

pub mod hidden;
pub mod contender;
pub mod rows;
pub mod stretches;
pub mod pieces;
pub mod table;
