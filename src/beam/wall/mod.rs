//! What does the wall of a hollow bat store when its sections do not stay round?
//!
//! The wall is a solid of revolution. Around the bat it moves as `cos nθ`; along the bat and across the wall
//! by polynomials, so that no theory of shells is needed.
//!
//! | file | question |
//! |---|---|
//! | [`elastic`] | how does a material resist in all directions |
//! | [`shapes`] | which polynomials, and what are they at the points of a rule |
//! | [`extent`] | which stretch of the bat rings as a wall |
//! | [`layers`] | of which layers is the wall made, and where do they change |
//! | [`columns`] | where are the elements, finer towards ends, kinks and corners |
//! | [`cell`] | what does one element store in one harmonic |
//! | [`unknowns`] | which numbers describe the motion, and how do unequal neighbours share them |

pub mod elastic;
pub mod shapes;
pub mod extent;
pub mod layers;
pub mod columns;
pub mod cell;
pub mod unknowns;
