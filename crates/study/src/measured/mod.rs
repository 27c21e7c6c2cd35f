//! Measured modes compared with computed ones: the pairs, their differences, and whether the measurement itself is
//! sound.
//!
//! A free bat's bending modes carry neither momentum nor angular momentum, and two of them are orthogonal in the bat's
//! mass. Measured shapes are checked for both. Computed shapes at the same points are checked too, which separates the
//! effect of few points from the quality of the data. A measured frequency response is laid over the computed one
//! ([`response`]).

pub mod data;
pub mod response;
pub mod mac;
pub mod spline;
pub mod weigh;
pub mod place;
pub mod pairing;
pub mod study;
pub mod words;
