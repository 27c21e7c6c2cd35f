//! Which cut has which effect?
//!
//! | file | question |
//! |---|---|
//! | [`same_plan`] | what are the modes of a changed bat on the elements of the one before |
//! | [`samples`] | how do frequencies, mass, balance and swing weight change with the radius: closed formulas |
//! | [`probe`], [`stencil`], [`gauges`] | which places of a hit does an answer depend on, and how |
//! | [`slopes`], [`quotient`] | the derivatives of an answer by the diameter; differences |
//! | `look` | how is the bat hit, and what are the values along it |
//! | [`workpiece`] | the bat on the lathe: its answers and their derivatives |
//! | [`found`] | the results of a map, as in its document |
//! | [`map`] | the effect of a cut band by band, that of a weight, and changes computed in full |
//! | [`recipe`] | the least wood that has to come off for a wish |

pub mod same_plan;
pub mod samples;
pub mod probe;
pub mod stencil;
pub mod gauges;
pub mod slopes;
pub mod quotient;
mod look;
pub mod workpiece;
pub mod found;
pub mod map;
pub mod recipe;
