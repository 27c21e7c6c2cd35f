//! What does the lathe take off, station by station and pass by pass, and where is wood added?

use serde::Serialize;

use crate::aim::laying::Station;

/// A change at a station.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct StationCut {
    /// Position (m).
    pub x_m: f64,
    /// Diameter before (m).
    pub from_m: f64,
    /// Diameter after (m).
    pub to_m: f64,
    /// How much is off the diameter after each pass (m); empty where wood is added.
    pub passes_m: Vec<f64>,
}

impl StationCut {
    /// Amount off the diameter (m), below 0 where wood is added.
    pub fn off(&self) -> f64 {
        self.from_m - self.to_m
    }

    /// Whether wood is added.
    pub fn adds(&self) -> bool {
        self.to_m > self.from_m
    }
}

/// A smaller change of a diameter (m) is below the accuracy of a lathe and of straight lines between stations.
const LEAST: f64 = 5e-6;

/// The change at every station that changes. It is turned off in passes of at most `pass` of the diameter (m); the
/// passes are equally deep, and the last one leaves the new diameter.
pub fn cuts(stations: &[Station], pass: f64) -> Vec<StationCut> {
    let cut = |station: &Station| {
        let off = station.old - station.new;
        if off.abs() < LEAST {
            return None;
        }
        let count = if off > 0.0 { (off / pass - 1e-9).ceil().max(1.0) as usize } else { 0 };
        let passes_m = (1..=count).map(|k| off * k as f64 / count as f64).collect();
        Some(StationCut { x_m: station.x, from_m: station.old, to_m: station.new, passes_m })
    };
    stations.iter().filter_map(cut).collect()
}
