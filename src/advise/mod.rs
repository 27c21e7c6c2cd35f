//! Which physics a bat needs: every part of its model switched off in turn, and the smallest model
//! that keeps its frequencies.

pub mod part;
pub mod model;
pub mod effect;
pub mod smallest;
pub mod damping;
pub mod outside;
pub mod advice;
