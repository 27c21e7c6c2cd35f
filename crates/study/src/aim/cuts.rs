//! What does the lathe take off, station by station and pass by pass, and where is wood added?

use crate::aim::laying::Station;

/// What changes at a station; lengths in m.
#[derive(Debug, Clone, PartialEq)]
pub struct StationCut {
    /// Place from the knob end.
    pub x: f64,
    /// Diameter before.
    pub from: f64,
    /// Diameter after.
    pub to: f64,
    /// How much is off the diameter after each pass; empty where wood is added, which no lathe does.
    pub passes: Vec<f64>,
}

impl StationCut {
    /// What comes off the diameter (m), below 0 where wood is added.
    pub fn off(&self) -> f64 {
        self.from - self.to
    }

    /// Whether wood is added.
    pub fn adds(&self) -> bool {
        self.to > self.from
    }
}

/// A smaller change of a diameter (m) is nothing to a lathe, and what straight lines between stations leave.
const LEAST: f64 = 5e-6;

/// The change at every station that changes; what is turned off in passes that take no more than `pass` off the
/// diameter (m). The last one leaves the new diameter, the others are equally deep.
pub fn cuts(stations: &[Station], pass: f64) -> Vec<StationCut> {
    let cut = |station: &Station| {
        let off = station.old - station.new;
        if off.abs() < LEAST {
            return None;
        }
        let count = (off / pass - 1e-9).ceil().max(1.0) as usize;
        let passes = match off > 0.0 {
            true => (1..=count).map(|k| off * k as f64 / count as f64).collect(),
            false => vec![],
        };
        Some(StationCut { x: station.x, from: station.old, to: station.new, passes })
    };
    stations.iter().filter_map(cut).collect()
}
