//! Results as pictures: SVG that reads on light and on dark paper, and PNG.
//!
//! A picture is a function of plain results; [`picture::write`] makes files of it. Those of single
//! results are built from one drawing of axes, lines, bands and marks ([`chart`], [`strip`]), with
//! which others can be made. Positions stand twice: from the knob end, in cm, at the bottom; and from the
//! tip, in inches, at the top.

pub mod theme;
pub mod svg;
#[cfg(feature = "png")]
pub mod png;
pub mod picture;
