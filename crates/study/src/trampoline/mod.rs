//! What does the wall of a hollow barrel do to a ball?
//!
//! | file | question |
//! |---|---|
//! | [`pressed`] | how stiff is the wall under a ball, and between two sides |
//! | [`barrel`] | how does the barrel ring, and how does a ball come back from it |
//! | [`thickness`] | what would a thinner or a thicker wall do |

pub mod pressed;
pub mod barrel;
pub mod thickness;
