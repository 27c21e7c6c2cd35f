//! What is this wood, by scale, ruler, pendulum and tap?
//!
//! | file | question |
//! |---|---|
//! | [`readings`] | what was measured, how exactly, and what was known before |
//! | [`unknowns`] | which properties are sought, how far were they open |
//! | [`wood`] | what would a bat of other wood show, and how does that go with each property |
//! | [`fit`] | which wood shows what was measured |
//! | [`chart`] | which tones has the bat, of all wood that it may be of |
//! | [`labels`] | which line is which mode |
//! | [`posterior`] | how far is the wood open after all that |
//! | [`next`] | which measurement would tell most |
//! | [`estimated`] | what was found of a parameter |
//! | [`calibration`](mod@calibration) | all of it, and how much of it the readings say |

pub mod readings;
pub mod unknowns;
pub mod wood;
pub mod fit;
pub mod chart;
pub mod labels;
pub mod posterior;
pub mod next;
pub mod estimated;
pub mod calibration;
