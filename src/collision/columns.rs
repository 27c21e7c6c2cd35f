//! The figures of an impact, each defined once: its value, and its name in files, which ends in its unit. Tables, CSV,
//! JSON and the page take their values from here; a test compares the JSON with these names.

use crate::collision::hit::{Impact, Outcome};

/// A figure of an impact.
#[derive(Debug, Clone, Copy)]
pub struct Column {
    /// Its name in files.
    pub name: &'static str,
    of: fn(&Impact) -> Option<f64>,
}

impl Column {
    /// The figure for that impact; `None` if it does not exist.
    pub fn at(&self, impact: &Impact) -> Option<f64> {
        (self.of)(impact)
    }
}

/// Distance of the impact point from the knob end (m).
pub const X: Column = Column { name: "x_m", of: |i| Some(i.x) };
/// Speed of the bat there before the hit (m/s).
pub const BAT_SPEED: Column = Column { name: "bat_speed_m_s", of: |i| Some(i.bat_speed) };
/// Speed of the ball off the bat once it has left for good (m/s).
pub const EXIT_SPEED: Column = Column { name: "exit_speed_m_s", of: |i| of(i, |o| o.exit_speed) };
/// Speed of the ball off a bat that did not bend (m/s).
pub const RIGID_EXIT_SPEED: Column =
    Column { name: "rigid_exit_speed_m_s", of: |i| i.rigid_exit_speed };
/// Coefficient of restitution of this hit.
pub const COR: Column = Column { name: "cor", of: |i| of(i, |o| o.cor) };
/// Impulse (N s).
pub const IMPULSE: Column = Column { name: "impulse_n_s", of: |i| of(i, |o| o.impulse) };
/// Contact time (s), all touches together.
pub const CONTACT_TIME: Column =
    Column { name: "contact_time_s", of: |i| i.outcome.as_ref()?.contact_time };
/// Largest force (N).
pub const PEAK_FORCE: Column =
    Column { name: "peak_force_n", of: |i| i.outcome.as_ref()?.peak_force };
/// Largest compression of the ball (m).
pub const PEAK_COMPRESSION: Column =
    Column { name: "peak_compression_m", of: |i| i.outcome.as_ref()?.peak_compression };
/// Collision efficiency e_A.
pub const EFFICIENCY: Column =
    Column { name: "collision_efficiency", of: |i| of(i, |o| o.collision_efficiency) };
/// BBCOR of the free bat.
pub const BBCOR: Column = Column { name: "bbcor", of: |i| of(i, |o| o.bbcor) };
/// BBCOR of the bat held 6 in from the knob.
pub const BBCOR_PIVOTED: Column =
    Column { name: "bbcor_pivoted", of: |i| of(i, |o| o.bbcor_pivoted) };
/// Energy of all bending modes after the hit (J).
pub const VIBRATION: Column = Column { name: "vibration_j", of: |i| of(i, |o| o.energy.vibration) };

/// All figures, in the order of the files.
pub const ALL: [Column; 13] = [
    X,
    BAT_SPEED,
    EXIT_SPEED,
    RIGID_EXIT_SPEED,
    COR,
    IMPULSE,
    CONTACT_TIME,
    PEAK_FORCE,
    PEAK_COMPRESSION,
    EFFICIENCY,
    BBCOR,
    BBCOR_PIVOTED,
    VIBRATION,
];

/// The columns of a curve of exit speeds.
pub const CURVE: [Column; 5] = [X, BAT_SPEED, EXIT_SPEED, RIGID_EXIT_SPEED, VIBRATION];

fn of(impact: &Impact, figure: fn(&Outcome) -> f64) -> Option<f64> {
    impact.outcome.as_ref().map(figure)
}
