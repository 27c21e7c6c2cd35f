//! Which physics does a bat need?
//!
//! [`advice::advise`] switches off every part of its model in turn, and finds the smallest model
//! that keeps its frequencies.

pub mod part;
pub mod model;
pub mod effect;
pub mod smallest;
pub mod damping;
pub mod outside;
pub mod advice;
