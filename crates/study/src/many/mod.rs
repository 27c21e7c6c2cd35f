//! Which bats does a study vary, and what comes of them?
//!
//! | file | question |
//! |---|---|
//! | [`hash`] | which number that looks random belongs to a place |
//! | [`sobol`] | where are points that fill a cube evenly |
//! | [`distribution`] | which value lies below that share of all |
//! | [`design`] | which values does row k have |
//! | [`indices`] | which of the drawn numbers make an answer vary |
//! | [`rows`] | what comes of each of some bats |

pub mod hash;
pub mod sobol;
pub mod distribution;
pub mod indices;
pub mod design;
pub mod rows;
