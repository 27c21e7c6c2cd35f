//! How are all results printed and written?
//!
//! [`tables`] has the tables of modes and hits, [`text`] and [`hit_text`] what is said about them, [`json`] and
//! [`hit_json`] their documents; the file of a verb has its screen. Columns shared by pictures and CSV are in
//! [`parts::columns`](crate::parts::columns). Nothing here computes physics.

pub mod curve;
pub mod resolved;
pub mod edits;
pub mod text;
pub mod proven;
pub mod frf;
pub mod frf_set;
pub mod sketch;
pub mod wall_text;
pub mod hit_text;
pub mod tables;
pub mod damped;
pub mod json;
pub mod hit_json;
pub mod bbcor;
pub mod aftermath;
pub mod motion;
pub mod u_curve;
pub mod trade;
pub mod advice;
pub mod trust;
pub mod comparison;
pub mod comparison_screen;
pub mod comparison_data;
pub mod measured;
pub mod lathe_table;
pub mod lathe;
pub mod hoop_notes;
pub mod hoop;
pub mod whole;
pub mod calibrate;
pub mod identify;
pub mod tap;
pub mod calibrated_bat;
pub mod shares;
pub mod scatter;
pub mod mistakes;
#[cfg(feature = "aim")]
pub mod aimed;
#[cfg(feature = "aim")]
pub mod aimed_text;
