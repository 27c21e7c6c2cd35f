//! Which diameters do the stations of the changed bat get?
//!
//! They are rounded up or down so that the goals stay in place: each station compensates the effect of those before.
//! Stations where nothing changes keep their digits.
//!
//! The curve between rounded stations is a new one. It may violate a limit: if wood is only taken off, it bulges before
//! the first lower station, by some 7 µm for 0.1 mm. The limit of the station beside the violation is then moved, and
//! the station gets the digits that this needs; in a kept stretch it moves by some µm at most.

use crate::aim::laying::{Laying, Station};
use crate::aim::limits::Broken;
use crate::engine::{Bat, Result, SAME_PLACE};

/// The new stations, and the bat with them.
#[derive(Debug, Clone, PartialEq)]
pub struct Draft {
    /// Stations, from the knob on; two at a step.
    pub stations: Vec<Station>,
    /// The bat.
    pub bat: Bat,
    /// Limits that are still violated, because the stations beside them may not move.
    pub broken: Vec<Broken>,
}

/// A change of a bat's diameter that is to be written.
pub struct Drafting<'a> {
    /// The change.
    pub laying: Laying<'a>,
    /// The stations that were laid for it.
    pub stations: Vec<Station>,
    /// How much each goal moves, in tolerances, per mm of diameter and m of length, as coefficients of the
    /// change's curves.
    pub densities: &'a [Vec<f64>],
}

/// Largest move of a station in a kept stretch to satisfy a limit (m).
const GIVES_WAY: f64 = 1e-5;
/// Least effect of a station on the curve, as a share of the station's move.
const LEAST_FELT: f64 = 1e-2;
/// Rounds of giving way to limits.
const ROUNDS: usize = 60;

impl Drafting<'_> {
    /// The bat as written, with the goals deliberately shifted by `aside` (in tolerances): the error of an earlier
    /// draft.
    ///
    /// # Errors
    ///
    /// Those of [`Laying::profile`] and [`Bat::with`].
    pub fn draft(&self, aside: &[f64]) -> Result<Draft> {
        let mut stations = self.stations.clone();
        let mut finest = f64::INFINITY;
        let mut best: Option<Draft> = None;
        for _ in 0..ROUNDS {
            self.round(&mut stations, aside);
            let new = self.laying.profile(&stations, |station| station.new)?;
            let bat = self.laying.bat.with(|parts| parts.profile = new)?;
            let broken = self.laying.limits.broken_by(&bat);
            let worst = broken.iter().map(|b| b.by.abs()).fold(0.0, f64::max);
            if best.is_none() || worst < finest {
                finest = worst;
                let (stations, broken) = (stations.clone(), broken.clone());
                best = Some(Draft { stations, bat, broken });
            }
            let mut moved = false;
            for broken in &broken {
                moved |= self.give_way(&mut stations, broken);
            }
            if !moved {
                break;
            }
        }
        Ok(best.expect("the first draft is one"))
    }

    /// Moves the limit of the station beside a violation; false if none may move.
    fn give_way(&self, stations: &mut [Station], broken: &Broken) -> bool {
        // Only the stations at both ends of the piece: others would make it worse.
        let x = broken.room.x;
        let left = stations.iter().map(|s| s.x).filter(|s| *s <= x).fold(0.0, f64::max);
        let right = stations.iter().map(|s| s.x).filter(|s| *s >= x).fold(f64::INFINITY, f64::min);
        let middle = (x - left - (right - x)).abs() <= 1e-9 * (right - left);
        let nearest = if x - left < right - x { [left, right] } else { [right, left] };
        let mut moved = false;
        for end in nearest {
            // The other end where the nearer one may not, and both for a place in the middle.
            if !moved || middle {
                // The effect of a station on the curve falls with the distance, to zero at the next one.
                let felt = 1.0 - (x - end).abs() / (right - left).max(SAME_PLACE);
                let by = broken.by / felt.max(LEAST_FELT);
                for station in stations.iter_mut().filter(|station| station.x == end) {
                    moved |= gives_way(station, by, self.laying.grid.round);
                }
            }
        }
        moved
    }

    /// Rounds the diameters, each so that the goals up to there are off least.
    fn round(&self, stations: &mut [Station], aside: &[f64]) {
        let spacing: Vec<f64> = (0..stations.len())
            .map(|k| {
                let before = stations[k.saturating_sub(1)].x;
                let after = stations[(k + 1).min(stations.len() - 1)].x;
                0.5 * (after - before)
            })
            .collect();
        let mut off: Vec<f64> = aside.to_vec();
        for (station, spacing) in stations.iter_mut().zip(spacing) {
            let (splines, _, stretch) = self.laying.change;
            let effect: Vec<f64> = self
                .densities
                .iter()
                .map(|of| 1e3 * spacing * splines.at(of, station.x / stretch))
                .collect();
            let cost = |new: f64| {
                let off = off.iter().zip(&effect).map(|(off, g)| off + g * (new - station.exact));
                // If it affects no goal, the nearest value.
                off.map(|off| off * off).sum::<f64>() + 1e3 * (new - station.exact).abs()
            };
            let candidates = candidates(station);
            let best = candidates.into_iter().min_by(|a, b| cost(*a).total_cmp(&cost(*b)));
            station.new = best.unwrap_or(station.old);
            for (off, g) in off.iter_mut().zip(&effect) {
                *off += g * (station.new - station.exact);
            }
        }
    }
}

/// Moves the limit of a station at which the curve is too thick by `by` (m), or too thin if negative; false if it may
/// not move. Its rounding becomes as fine as needed.
fn gives_way(station: &mut Station, by: f64, round: f64) -> bool {
    let needed = 1.2 * by.abs();
    let step = round * 10.0_f64.powf((needed / round).log10().floor().min(0.0));
    let away = (needed / step).ceil() * step;
    let new = station.new - away.copysign(by);
    let stays = station.kept && (new - station.old).abs() > GIVES_WAY;
    if stays || new < station.low || new > station.high {
        return false;
    }
    if by > 0.0 {
        station.high = new;
    } else {
        station.low = new;
    }
    station.round = station.round.min(step);
    true
}

/// The diameters that a station may have.
fn candidates(station: &Station) -> Vec<f64> {
    let Station { old, exact, low, high, round, .. } = *station;
    let clamped = exact.clamp(low.min(high), high);
    if exact == old {
        return vec![clamped];
    }
    let below = (clamped / round + 1e-9).floor();
    let both = [below * round, (below + 1.0) * round];
    let allowed = |new: &f64| *new >= low - 1e-12 && *new <= high + 1e-12;
    let some: Vec<f64> = both.into_iter().filter(allowed).collect();
    if some.is_empty() { vec![clamped] } else { some }
}
