//! What is this wood, by scale, ruler, pendulum and tap?
//!
//! | file | question |
//! |---|---|
//! | [`readings`] | what was measured, how exactly, and what was known before |
//! | [`unknowns`] | which properties are sought, how far were they open |
//! | [`wood`] | what would a bat of other wood show, and how does that go with each property |
//! | [`fit`] | which wood shows what was measured |
//! | [`labels`] | which line is which mode |
//! | [`next`] | which measurement would tell most |
//! | [`calibration`](mod@calibration) | all of it, and how much of it the readings say |

pub mod readings;
pub mod unknowns;
pub mod wood;
pub mod fit;
pub mod labels;
pub mod next;
pub mod calibration;
