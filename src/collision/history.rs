//! The ball's force and compression in time, from the recorded force.
//!
//! The compression is the distance by which ball and bat have approached. Every motion is exact under a force that is a
//! polynomial in time ([`crate::collision::contact::encounter`] has the equations). The ball's law is not used: near
//! the end its force is too small to give the compression.

use faer::c64;

use serde::Serialize;

use crate::collision::contact::collocation::polynomial;
use crate::collision::contact::table::ForcePiece;
use crate::collision::contact::touch::DrivingPoint;

/// The ball at an instant.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Moment {
    /// Time since the first touch (s).
    pub time: f64,
    /// Force between ball and bat (N).
    pub force: f64,
    /// Compression of the ball (m).
    pub compression: f64,
}

/// The ball from the first touch to the last, with the given number of instants in every piece of the force, ends
/// included. It approaches at `speed` (m/s) a bat with those modes, ω (rad/s) and damping ratio, one for each gain.
pub fn history(
    pieces: &[ForcePiece],
    felt: &DrivingPoint,
    modes: &[[f64; 2]],
    speed: f64,
    parts: usize,
) -> Vec<Moment> {
    let pole = |[omega, ratio]: &[f64; 2]| {
        c64::new(-ratio * omega, omega * ((1.0 - ratio) * (1.0 + ratio)).sqrt())
    };
    let poles: Vec<c64> = modes.iter().map(pole).collect();
    let mut memories = vec![c64::default(); poles.len()];
    let (mut closed, mut closing) = (0.0, speed);
    let mut all = vec![];
    for piece in pieces {
        for k in 0..=parts {
            let at = k as f64 / parts as f64;
            let time = at * piece.length;
            let force = polynomial(&piece.powers, at);
            let until = piece.first(time);
            let [by, _] = until.push();
            let mut nearer = closed + closing * time - felt.inverse_mass * by - felt.rest * force;
            for ((pole, memory), gain) in poles.iter().zip(&memories).zip(&felt.gains) {
                nearer -= gain / pole.im * until.drive(*pole, *memory).im;
            }
            // Round-off at the end.
            let [force, compression] = [force, nearer].map(|value| value.max(0.0));
            all.push(Moment { time: piece.start + time, force, compression });
        }
        let [by, faster] = piece.push();
        closed += closing * piece.length - felt.inverse_mass * by;
        closing -= felt.inverse_mass * faster;
        for (pole, memory) in poles.iter().zip(&mut memories) {
            *memory = piece.drive(*pole, *memory);
        }
    }
    all
}
