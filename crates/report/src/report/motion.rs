//! How a bat moves after a blow, on one screen.

use crate::parts::{Columns, Units, numbers, wrapped};
use sweetspot::base::units::inches;
use sweetspot::{Bat, Solution};

/// Deflections (m) at places of a bat, a frame for every instant.
pub struct Frames<'a> {
    /// Places (m from the knob end).
    pub x: &'a [f64],
    /// Instants (s).
    pub times: &'a [f64],
    /// The deflections at every instant, in the order of the places.
    pub frames: &'a [Vec<f64>],
}

/// The last line of a screen.
pub const MORE: &str = "Every place at every instant: --csv FILE (- = here); drawn: --plots DIR";

/// The deflection of both ends at every instant, and the largest along the bat with its place.
pub fn screen((bat, solution): (&Bat, &Solution), motion: &Frames, units: Units) -> String {
    let modes = solution.modes.len();
    let title = format!("Deflection of {} by {modes} bending modes", bat.title());
    let us = units.us_first();
    let (small, place) = if us { ("in", "in") } else { ("mm", "cm") };
    let columns =
        Columns::new(["time", "knob end", "tip", "largest", "at"].map(|h| numbers(12, h)));
    let mut out = wrapped(&title, 2) + &columns.heads();
    out += &columns.row(["ms", small, small, small, place]);
    let moved = |w: f64| {
        if us { format!("{:.4}", inches(w) + 0.0) } else { format!("{:.3}", 1e3 * w + 0.0) }
    };
    let at = |x: f64| if us { format!("{:.2}", inches(x)) } else { format!("{:.2}", 100.0 * x) };
    for (time, frame) in motion.times.iter().zip(motion.frames) {
        let largest = frame.iter().zip(motion.x).max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        let (Some((most, x)), [knob, .., tip]) = (largest, &frame[..]) else { continue };
        let time = format!("{:.3}", 1e3 * time);
        out += &columns.row([time, moved(*knob), moved(*tip), moved(*most), at(*x)]);
    }
    out
}
