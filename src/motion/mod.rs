//! How does the bat move after a blow, under a force, at a frequency?
//!
//! The same integral is behind everything ([`phi`]). Modes are oscillators ([`oscillator`]). Their sum is the motion in
//! time ([`ringing`]) and the response at a frequency ([`frf`]).
//!
//! | file | question |
//! |---|---|
//! | [`phi`] | the effect of a force on a motion `e^{st}` |
//! | [`force`], [`shape`] | which force acts on the bat; from which shape is it released |
//! | [`oscillator`] | how does one mode respond, damped or not |
//! | [`ringing`] | how does the bat move in time |
//! | [`peaks`] | where does the response peak, how high and how wide |
//! | [`frf`] | how does the bat respond at a frequency |
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
