//! What is the cost of a digit on this bat, with which elements and which solver?
//!
//! [`measure::measure`] times a ladder of elements and solvers and compares them with one reference.
//!
//! ```text
//! Bat ─▶ Reference ─▶ runs (degree, elements, solver: time, error) ─▶ front ─▶ words
//!              └────▶ columns of the U-curve (error against the number of elements)
//! ```

pub mod reference;
pub mod u_curve;
pub mod front;
pub mod words;
pub mod measure;
