//! How does the bat move after a blow, under a force, at a frequency?
//!
//! One integral is behind all of it ([`phi`]). Modes are oscillators ([`oscillator`]); their sum is the motion in time ([`ringing`]) and the
//! response at a frequency ([`frf`]).
//!
//! | file | question |
//! |---|---|
//! | [`phi`] | what does a force do to a motion as `e^{st}` |
//! | [`force`], [`shape`] | which force pushes the bat; from which shape is it let go |
//! | [`oscillator`] | how does one mode answer, damped or not |
//! | [`ringing`] | how does the bat move in time |
//! | [`peaks`] | where does that answer peak, how high and how wide |
//! | [`frf`] | how does it answer at a frequency |
//! | [`sound`] | what does it sound like |

#[doc(hidden)]
pub mod phi;
pub mod force;
pub mod shape;
pub mod oscillator;
pub mod ringing;
pub mod peaks;
pub mod frf;
pub mod sound;
