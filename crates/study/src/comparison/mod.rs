//! Two or more bats in the same scene: what differs, and whether that is more than the errors.
//!
//! The first bat is the reference. What the others have more or less of anything stands beside how
//! far that may be off, which is the sum of both errors; a difference within it is not significant.
//! Beside it stands by how much two pieces of one wood differ, which is more than most errors.

pub mod hidden;
pub mod contender;
pub mod rows;
pub mod stretches;
pub mod pieces;
pub mod table;
