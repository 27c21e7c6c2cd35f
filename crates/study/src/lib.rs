//! What follows for a person who asks?
//!
//! | file | question |
//! |---|---|
//! | [`trade`] | what does a digit cost on this bat |
//! | [`ignored`] | what does a theory leave out, and what does that cost |
//! | [`calibrate`] | what is the wood, by scale, ruler, pendulum and tap |
//! | [`tap`] | which mode is a tone of a recording, and what is the wood by all of them |
//! | [`verdict`] | how far do the answers hold, by all that is known |
//! | [`answers`] | which answers can be asked of a bat, by which names |
//! | [`read_to`], [`inputs`] | to what step were diameters read; what is not known exactly of a bat |
//! | `bat_changes`, [`spread`] | a bat that differs in one input; how far the answers move with all of them |
//! | [`advise`] | which parts of a model matter on this bat |
//! | [`comparison`] | which bat hits harder, where, and is the difference more than the errors |
//! | [`many`] | which bats does a study vary |
//! | [`lathe`] | where does a cut do what |
//! | `aim` | which profile meets a wish |
//! | [`scatter`] | how much do bats of one model and swings of one batter differ |
//! | [`trampoline`] | what does the wall of a hollow barrel do to a ball |
//! | [`files`] | how do people write down what they ask |
//! | [`measured`] | which measured mode is which computed one; is the measurement sound |
//! | [`identify`] | which modes do measured responses share; what would a test of this bat find |

// Matrices are written with the indices of their formulas.
#![allow(clippy::needless_range_loop)]
#![forbid(unsafe_code)]

pub mod trade;
pub mod ignored;
pub mod calibrate;
pub mod tap;
pub mod verdict;
pub mod answers;
pub mod read_to;
pub mod inputs;
pub(crate) mod bat_changes;
pub mod spread;
pub mod advise;
pub mod comparison;
pub mod measured;
pub mod many;
pub mod lathe;
#[cfg(feature = "aim")]
pub mod aim;
pub mod scatter;
pub mod trampoline;
pub mod files;
pub mod identify;
