//! Which questions about a bat can the program answer?
//!
//! | file | question |
//! |---|---|
//! | `engine` | the names that the studies use of the engine |
//! | `named` | enumerations whose variants have names |
//! | [`trade`] | what is the cost of a digit on this bat |
//! | [`ignored`] | what does a theory leave out, and how large is the effect |
//! | [`calibrate`] | what is the wood, by scale, ruler, pendulum and tap |
//! | [`tap`] | the modes of a recording's tones, and the wood by all of them |
//! | [`verdict`] | how reliable are the answers |
//! | [`answers`] | which answers can a study ask of a bat, and by which names |
//! | [`read_to`], [`inputs`] | to what step were diameters read; which properties of a bat are uncertain |
//! | `bat_changes`, [`spread`] | a bat that differs in one input; how far the answers move with all of them |
//! | [`advise`] | which parts of a model matter on this bat |
//! | [`comparison`] | which bat hits harder, where, and is the difference larger than the errors |
//! | [`many`] | which bats does a study vary |
//! | [`lathe`] | which cut has which effect |
//! | `aim` | which profile meets a wish |
//! | [`scatter`] | how much do bats of one model and swings of one batter differ |
//! | [`trampoline`] | how does the wall of a hollow barrel affect a ball |
//! | [`files`] | how do people write their questions in files |
//! | [`measured`] | which computed mode is each measured one; is the measurement sound |
//! | [`identify`] | which modes do measured responses share; what would a test of this bat find |

// Matrices are written with the indices of their formulas.
#![allow(clippy::needless_range_loop)]
#![forbid(unsafe_code)]

mod engine;
mod named;
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
