//! Measured modes beside computed ones: which is which, how far apart, and whether the measurement
//! itself is sound.
//!
//! A free bat's bending modes carry neither momentum nor angular momentum, and two of them are
//! orthogonal in the bat's mass: measured shapes are held to both, and so are the computed
//! shapes at the same points, which tells what the few points cost from what the data are worth. A
//! measured frequency response is laid over the computed one ([`response`]).

pub mod data;
pub mod response;
pub mod mac;
pub mod spline;
pub mod weigh;
pub mod place;
pub mod pairing;
pub mod study;
pub mod words;
