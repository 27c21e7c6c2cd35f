//! What does the wall of a hollow bat store if its sections do not stay round?
//!
//! The wall is a solid of revolution. Around the bat it moves as `cos nθ`, along the bat and across the wall as
//! polynomials; no shell theory is needed.
//!
//! | file | question |
//! |---|---|
//! | [`elastic`] | how does a material resist in all directions |
//! | [`shapes`] | the polynomials, and their values at the points of a rule |
//! | [`extent`] | which stretch of the bat is modelled as a wall |
//! | [`layers`] | which layers does the wall have, and where do they change |
//! | [`columns`] | where are the elements, finer towards ends, kinks and corners |
//! | [`cell`] | what does one element store in one harmonic |
//! | [`unknowns`] | which unknowns describe the motion, and how do unequal neighbours share them |

pub mod elastic;
pub mod shapes;
pub mod extent;
pub mod layers;
pub mod columns;
pub mod cell;
pub mod unknowns;
