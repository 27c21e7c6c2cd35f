//! What does the lathe take off, station by station and pass by pass?

use crate::study::aim::laying::Station;

/// What is turned off at a station; lengths in m.
#[derive(Debug, Clone, PartialEq)]
pub struct StationCut {
    /// Place from the knob end.
    pub x: f64,
    /// Diameter before.
    pub from: f64,
    /// Diameter after.
    pub to: f64,
    /// How much is off the diameter after each pass.
    pub passes: Vec<f64>,
}

/// What is less is nothing to a lathe (m).
const LEAST: f64 = 5e-6;

/// The cuts at every station that loses wood, in passes that take no more than `pass` off the diameter (m).
/// The last one leaves the new diameter, the others are equally deep.
pub fn cuts(stations: &[Station], pass: f64) -> Vec<StationCut> {
    let cut = |station: &Station| {
        let off = station.old - station.new;
        if off < LEAST {
            return None;
        }
        let count = (off / pass - 1e-9).ceil().max(1.0) as usize;
        let passes = (1..=count).map(|k| off * k as f64 / count as f64).collect();
        Some(StationCut { x: station.x, from: station.old, to: station.new, passes })
    };
    stations.iter().filter_map(cut).collect()
}
