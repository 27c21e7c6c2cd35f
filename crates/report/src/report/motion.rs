//! How a bat moves after a blow, on one screen.

use crate::parts::{Columns, Quantity, Units, numbers, wrapped};
use crate::schema::ring::Motion;
use sweetspot::Bat;

/// The last line of a screen.
pub const MORE: &str = "Every place at every instant: --csv FILE (- = here); drawn: --plots DIR";

/// The deflection of both ends at every instant, and the largest along the bat with its place.
pub fn screen(bat: &Bat, motion: &Motion, units: Units) -> String {
    let title = format!("Deflection of {} by {} bending modes", bat.title(), motion.modes);
    let us = units.us_first();
    let [small, place] = [Quantity::Small, Quantity::Length].map(|of| of.scale(us));
    let small = small.finer().finer();
    let columns =
        Columns::new(["time", "knob end", "tip", "largest", "at"].map(|h| numbers(12, h)));
    let mut out = wrapped(&title, 2) + &columns.heads();
    out += &columns.row(["ms", small.name, small.name, small.name, place.name]);
    for (time, frame) in motion.times_s.iter().zip(&motion.deflection_m) {
        let largest = frame.iter().zip(&motion.x_m).max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        let (Some((most, x)), [knob, .., tip]) = (largest, &frame[..]) else { continue };
        let time = format!("{:.3}", 1e3 * time);
        let moved = [knob, tip, most].map(|w| small.value(*w));
        out += &columns.row([time].into_iter().chain(moved).chain([place.value(*x)]));
    }
    out
}
