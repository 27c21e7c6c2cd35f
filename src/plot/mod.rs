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
pub mod axis;
pub mod plane;
pub mod series;
pub mod place;
pub mod outline;
pub mod profile;
pub mod shapes;
pub mod exit_speed;
pub mod ledger;
pub mod contact;
pub mod hands;
pub mod front;
pub mod u_curve;
pub mod matrix;
pub mod sets;
pub mod compared;
pub mod measured;
