//! How does the wall of a hollow barrel affect a ball?
//!
//! | file | question |
//! |---|---|
//! | [`pressed`] | the stiffness of the wall under a ball, and between two sides |
//! | [`barrel`] | the barrel's modes, and the rebound of a ball from it |
//! | [`thickness`] | the effect of a thinner or a thicker wall |

pub mod pressed;
pub mod barrel;
pub mod thickness;
