//! What is this wood, by scale, ruler, pendulum and tap?
//!
//! | file | question |
//! |---|---|
//! | [`readings`] | the readings, their errors, and the prior knowledge |
//! | [`unknowns`] | which properties are sought, and their prior covariance |
//! | [`wood`] | the values of a bat of other wood, and their derivatives by each property |
//! | [`fit`] | which wood fits the readings |
//! | [`chart`] | the tones of the bat for all possible wood |
//! | [`labels`] | which line is which mode |
//! | [`posterior`] | the remaining uncertainty of the wood |
//! | [`next`] | which measurement would add most |
//! | [`estimated`] | the estimate of a parameter |
//! | [`calibration`](mod@calibration) | the whole result, and the information in the readings |

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
