//! The ball's force and compression in time, from a recorded force.
//!
//! The force tells the compression by the ball's law: on the first branch while it is larger than
//! ever before, on the second one below that ([`crate::collision::force_law`]).

use crate::collision::collocation::polynomial;
use crate::collision::force_law::{ForceLaw, Top};
use crate::collision::step::Piece;

/// The ball at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Since the first touch (s).
    pub time: f64,
    /// N
    pub force: f64,
    /// m
    pub compression: f64,
}

/// The ball from the first touch to the last, so many instants in every piece of the force, ends
/// included.
pub fn history(pieces: &[Piece], law: &ForceLaw, parts: usize) -> Vec<Moment> {
    let mut top = Top { compression: 0.0, force: 0.0 };
    let mut all = vec![];
    for piece in pieces {
        for k in 0..=parts {
            let at = k as f64 / parts as f64;
            // What is left of round-off where it ends.
            let force = polynomial(&piece.powers, at).max(0.0);
            let compression = if force >= top.force {
                top = Top { compression: law.at(force, None), force };
                top.compression
            } else {
                law.at(force, Some(top))
            };
            all.push(Moment { time: piece.start + at * piece.length, force, compression });
        }
    }
    all
}

/// The energy (J) that goes into the ball and does not come back: `∮ F dx`.
pub fn loop_area(moments: &[Moment]) -> f64 {
    let work = |pair: &[Moment]| {
        0.5 * (pair[0].force + pair[1].force) * (pair[1].compression - pair[0].compression)
    };
    moments.windows(2).map(work).sum()
}
