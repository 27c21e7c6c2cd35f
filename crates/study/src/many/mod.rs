//! Which bats does a study vary, and what are the results?
//!
//! | file | question |
//! |---|---|
//! | [`hash`] | which pseudo-random number belongs to an index |
//! | [`sobol`] | points that fill a cube evenly |
//! | [`distribution`] | which value lies above that share of a distribution |
//! | [`design`] | which values does row k have |
//! | [`indices`] | which of the random numbers make an answer vary |
//! | [`rows`] | the results of several bats |

pub mod hash;
pub mod sobol;
pub mod distribution;
pub mod indices;
pub mod design;
pub mod rows;
