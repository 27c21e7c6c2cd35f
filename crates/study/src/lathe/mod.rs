//! Where does a cut do what?
//!
//! | file | question |
//! |---|---|
//! | [`same_plan`] | what are the modes of a changed bat on the elements of the one before |
//! | [`samples`] | how do frequencies, mass, balance and swing weight change with the radius: closed formulas |
//! | [`probe`], [`stencil`], [`gauges`] | which places of a hit does an answer read, and how |
//! | [`slopes`], [`quotient`] | how an answer changes with the diameter; by differences |
//! | `look` | how is it hit, and what does a look along it see |
//! | [`workpiece`] | the bat on the lathe: its answers, and how they change with its diameter |
//! | [`found`] | what a map says, as its document has it |
//! | [`map`] | what a cut does band by band, what a weight does, and what has to be solved |
//! | [`recipe`] | how little wood has to come off for a wish |

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
