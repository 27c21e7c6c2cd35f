//! Which value of a hit is read?

use crate::answers::Answer;
use crate::engine::{Glance, Hitter};

/// A value of a hit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Probe {
    /// Exit speed of the ball (m/s).
    Speed,
    /// Energy left in vibration (J).
    Vibration,
    /// Velocity at the hands (m/s).
    HandsVelocity,
    /// Acceleration at the hands (m/s²).
    HandsAcceleration,
    /// BBCOR of the bat, free or as it is held.
    Bbcor,
}

impl Probe {
    /// The reading of a hit at a place; None where ball and bat do not meet.
    pub fn read(self, hitter: &Hitter, seen: Option<&Glance>) -> Option<f64> {
        self.of(hitter, seen?)
    }

    /// The reading of a hit that was seen.
    pub(super) fn of(self, hitter: &Hitter, seen: &Glance) -> Option<f64> {
        match self {
            Self::Speed => Some(seen.exit_speed),
            Self::Vibration => seen.vibration,
            Self::HandsVelocity => Some(seen.hands[0]),
            Self::HandsAcceleration => Some(seen.hands[1]),
            Self::Bbcor if hitter.modes_used() == 0 => None,
            Self::Bbcor => Some(hitter.figures(seen.x, seen.exit_speed)[1]),
        }
    }

    /// 1 where the greatest value is the best, −1 where the least is.
    pub(super) fn sign(self) -> f64 {
        if matches!(self, Self::Speed | Self::Bbcor) { 1.0 } else { -1.0 }
    }

    /// Whether a value is above zero: hands on a pin feel nothing, and without modes nothing shakes them.
    pub(super) fn feels(self, value: f64) -> bool {
        match self {
            Self::HandsVelocity => value > 1e-9,
            Self::HandsAcceleration => value > 1e-5,
            _ => true,
        }
    }
}

/// The value that a searched answer reads, and whether the answer is its place.
pub(super) fn searched(answer: Answer) -> Option<(Probe, bool)> {
    Some(match answer {
        Answer::ExitSpeed => (Probe::Speed, false),
        Answer::ExitSpeedPlace => (Probe::Speed, true),
        Answer::Vibration => (Probe::Vibration, false),
        Answer::VibrationPlace => (Probe::Vibration, true),
        Answer::Bbcor => (Probe::Bbcor, false),
        Answer::HandsVelocity => (Probe::HandsVelocity, false),
        Answer::HandsAcceleration => (Probe::HandsAcceleration, false),
        _ => return None,
    })
}
