//! What does a digit cost on this bat, by which elements and which solver?
//!
//! [`measure::measure`] times a ladder of them against one reference: what is measured, what it is
//! measured against, what follows.
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
