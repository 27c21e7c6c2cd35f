//! Which stations is the changed bat written with?
//!
//! The user's own, and others at even places where the diameter changes: there diameters are rounded. Where
//! nothing changes the bat keeps its stations and their digits, so that its curve is what it was. Rounding goes
//! up or down so that the goals stay where they are: what one station moves, the next ones take back.
//!
//! A curve through stations feels two stations on: beside a stretch that is kept the next two stations stay,
//! where they are near, so that its curve stays too (unless a limit asks for some µm of them).
//!
//! The curve between rounded stations is a new one. Where it breaks a limit (on a bat of which wood is only
//! taken off it bulges before the first station that is lower, by some 7 µm for 0.1 mm) the station beside it
//! gives way, by as many digits more as that takes.

use crate::base::error::Result;
use crate::bat::body::Bat;
use crate::bat::profile::{Interpolation, Profile, Radii, SAME_PLACE, Stations};
use crate::study::aim::limits::{Broken, Limits, section};
use crate::study::aim::spline::Splines;

/// A station of the new bat; lengths in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Place from the knob end.
    pub x: f64,
    /// Diameter that the bat has there.
    pub old: f64,
    /// Diameter by the smooth change.
    pub exact: f64,
    /// Diameter that is written.
    pub new: f64,
    /// Inner radius.
    inner: f64,
    /// What the limits allow, less where a curve between stations asked for it.
    low: f64,
    high: f64,
    /// Whether it is in a stretch that is kept.
    kept: bool,
}

/// How stations are laid and rounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Distance of the stations (m).
    pub every: f64,
    /// What diameters are rounded to (m).
    pub round: f64,
}

/// The new stations, and the bat with them.
#[derive(Debug, Clone, PartialEq)]
pub struct Draft {
    /// Stations, from the knob on; two at a step.
    pub stations: Vec<Station>,
    /// The bat.
    pub bat: Bat,
    /// Limits that are still broken, as the stations beside them may not move.
    pub broken: Vec<Broken>,
}

/// A change of a bat's diameter that is to be written.
pub struct Drafting<'a> {
    /// The bat before the change of its diameter.
    pub bat: &'a Bat,
    /// What its diameter may be.
    pub limits: &'a Limits<'a>,
    /// The change (mm) and the curves it is made of, places as shares of `stretch`.
    pub change: (&'a Splines, &'a [f64], f64),
    /// How much each goal moves, in tolerances, per mm of diameter and m of length, as coefficients of the
    /// same curves.
    pub densities: &'a [Vec<f64>],
    /// How stations are laid.
    pub grid: Grid,
}

/// Two stations beside a stretch that is kept, the nearer one first (m).
#[derive(Debug, Clone, Copy)]
struct Guard {
    first: f64,
    second: f64,
}

impl Guard {
    /// Whether a place is at one of them or between them.
    fn has(&self, x: f64) -> bool {
        x >= self.first.min(self.second) && x <= self.first.max(self.second)
    }
}

/// A place beside a station, as a share of the way to the next.
const BESIDE: f64 = 1e-6;
/// Stations farther apart are not near (m).
const NEAR: f64 = 0.06;
/// A smaller change than this share of the rounding is none.
const NOTHING: f64 = 0.25;
/// Rounds of giving way to limits.
const ROUNDS: usize = 60;

impl Drafting<'_> {
    /// The change at a place (m of diameter).
    fn change(&self, x: f64) -> f64 {
        let (splines, p, stretch) = self.change;
        1e-3 * splines.at(p, x / stretch)
    }

    /// Whether a place may change.
    fn is_free(&self, x: f64) -> bool {
        let (splines, _, stretch) = self.change;
        let length = self.bat.length();
        let same = SAME_PLACE * length;
        splines.stretches().iter().any(|s| {
            let [from, to] = s.map(|end| end * stretch);
            (x > from + same || from <= same)
                && (x < to - same || to >= length - same)
                && x >= from - same
                && x <= to + same
        })
    }

    /// The stations beside the stretches that are kept.
    fn guards(&self) -> Vec<Guard> {
        let (splines, _, stretch) = self.change;
        let length = self.bat.length();
        let same = SAME_PLACE * length;
        let x = &self.bat.profile().stations.x;
        let mut guards = vec![];
        if !self.is_of_stations() {
            return guards;
        }
        for ends in splines.stretches() {
            let [from, to] = ends.map(|end| end * stretch);
            let outwards: Vec<f64> = x.iter().copied().filter(|x| *x >= from - same).collect();
            let inwards: Vec<f64> = x.iter().rev().copied().filter(|x| *x <= to + same).collect();
            let held = [(from > same, outwards), (to < length - same, inwards)];
            for (_, beside) in held.into_iter().filter(|(held, _)| *held) {
                // At a step the curve begins anew.
                let [first, second] = [beside.first(), beside.get(1)].map(|x| x.copied());
                guards.extend(first.zip(second).map(|(first, second)| Guard { first, second }));
            }
        }
        guards.retain(|guard| (guard.second - guard.first).abs() <= NEAR);
        guards
    }

    /// Whether the profile is what its stations say, so that they alone make the same curve.
    fn is_of_stations(&self) -> bool {
        self.bat.profile().formulas.is_none() && self.bat.edits().is_empty()
    }

    /// The stations with the diameters they would have without rounding.
    fn stations(&self) -> Vec<Station> {
        let profile = self.bat.profile();
        let own = &profile.stations;
        let mut places: Vec<(f64, f64)> = vec![];
        for (k, x) in own.x.iter().enumerate() {
            // At a step the first is of the piece to its left; a bat that is cut has several between two stations.
            let left = k > 0 && (k + 1 == own.x.len() || own.x[k + 1] == *x);
            let to = if left { own.x[k - 1] } else { own.x[(k + 1).min(own.x.len() - 1)] };
            places.push((*x, x + BESIDE * (to - x)));
        }
        let length = profile.length();
        let near = |x: f64| own.x.iter().any(|y| (y - x).abs() < 0.3 * self.grid.every);
        let touched = |x: f64| self.change(x).abs() >= NOTHING * self.grid.round;
        let count = (length / self.grid.every).floor() as usize;
        for k in 1..=count {
            let x = k as f64 * self.grid.every;
            let wanted = self.is_free(x) && touched(x) || !self.is_of_stations();
            if wanted && !near(x) && x < length {
                places.push((x, x));
            }
        }
        places.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let guards = self.guards();
        places.retain(|(x, _)| own.x.contains(x) || guards.iter().all(|guard| !guard.has(*x)));
        let station = |(x, inside): (f64, f64)| {
            let at = section(profile, x, inside);
            let guarded = guards.iter().any(|guard| guard.has(x));
            let (old, kept) = (2.0 * at.outer, !self.is_free(x));
            let room = self.limits.room(x, at);
            let exact = if kept || guarded { old } else { old + self.change(x) };
            let (low, high) = (old + room.low, old + room.high);
            Station { x, old, exact, new: old, inner: at.inner, low, high, kept }
        };
        places.into_iter().map(station).collect()
    }

    /// The bat as it is written, the goals moved by `aside` (in tolerances) on purpose: what an earlier draft
    /// was off by.
    ///
    /// # Errors
    ///
    /// Those of [`Profile::new`] and [`Bat::with`].
    pub fn draft(&self, aside: &[f64]) -> Result<Draft> {
        let mut stations = self.stations();
        let mut finest = f64::INFINITY;
        let mut best: Option<Draft> = None;
        for _ in 0..ROUNDS {
            self.round(&mut stations, aside);
            let bat = self.bat_of(&stations)?;
            let broken = self.limits.broken_by(&bat);
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

    /// Moves the limit of the station beside a broken one; false where none may move.
    fn give_way(&self, stations: &mut [Station], broken: &Broken) -> bool {
        // Only the stations at both ends of the piece: those beyond would make it worse.
        let x = broken.room.x;
        let left = stations.iter().map(|s| s.x).filter(|s| *s <= x).fold(0.0, f64::max);
        let right = stations.iter().map(|s| s.x).filter(|s| *s >= x).fold(f64::INFINITY, f64::min);
        let ends = stations.iter().filter(|s| !s.kept && (s.x == left || s.x == right));
        let nearest = ends.map(|s| (s.x - x).abs()).fold(f64::INFINITY, f64::min);
        if nearest.is_infinite() {
            return false;
        }
        // So much at the station moves the curve beside it by what it is over.
        let needed = 1.5 * broken.by.abs();
        let digit = 10.0_f64.powf((needed / self.grid.round).log10().floor().min(0.0));
        let step = self.grid.round * digit;
        let by = (needed / step).ceil() * step;
        let beside = |s: &&mut Station| {
            !s.kept && (s.x == left || s.x == right) && (s.x - x).abs() <= nearest * (1.0 + 1e-9)
        };
        let mut moved = false;
        for station in stations.iter_mut().filter(beside) {
            let (high, low) = (station.new - by, station.new + by);
            match broken.by > 0.0 {
                true if high >= station.low => station.high = station.high.min(high),
                false if low <= station.high => station.low = station.low.max(low),
                _ => continue,
            }
            moved = true;
        }
        moved
    }

    /// Rounds the diameters, each so that the goals are off least up to there.
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
            let (splines, _, stretch) = self.change;
            let effect: Vec<f64> = self
                .densities
                .iter()
                .map(|of| 1e3 * spacing * splines.at(of, station.x / stretch))
                .collect();
            let cost = |new: f64| {
                let off = off.iter().zip(&effect).map(|(off, g)| off + g * (new - station.exact));
                // Where no goal feels it, the nearest.
                off.map(|off| off * off).sum::<f64>() + 1e3 * (new - station.exact).abs()
            };
            let candidates = self.candidates(station);
            let best = candidates.into_iter().min_by(|a, b| cost(*a).total_cmp(&cost(*b)));
            station.new = best.unwrap_or(station.old);
            for (off, g) in off.iter_mut().zip(&effect) {
                *off += g * (station.new - station.exact);
            }
        }
    }

    /// The diameters that a station may have.
    fn candidates(&self, station: &Station) -> Vec<f64> {
        let Station { old, exact, low, high, kept, .. } = *station;
        if kept {
            return vec![old];
        }
        let round = self.grid.round;
        if (exact - old).abs() < NOTHING * round {
            return vec![old.clamp(low.min(high), high)];
        }
        let clamped = exact.clamp(low.min(high), high);
        let below = (clamped / round + 1e-9).floor();
        let both = [below * round, (below + 1.0) * round];
        let allowed = |new: &f64| *new >= low - 1e-12 && *new <= high + 1e-12;
        let some: Vec<f64> = both.into_iter().filter(allowed).collect();
        if some.is_empty() { vec![clamped] } else { some }
    }

    /// The bat through those stations.
    fn bat_of(&self, stations: &[Station]) -> Result<Bat> {
        let profile = self.bat.profile();
        let bent = |radii: &Radii| match radii {
            Radii::Cubic(cubics) => cubics.degree > 1,
            Radii::Formula(_) => true,
        };
        let interpolation = match profile.pieces.iter().any(|piece| bent(&piece.radii)) {
            true => Interpolation::Pchip,
            false => Interpolation::Linear,
        };
        let column = |of: fn(&Station) -> f64| stations.iter().map(of).collect();
        let new = Profile::new(Stations {
            x: column(|s| s.x),
            outer: column(|s| 0.5 * s.new),
            inner: column(|s| s.inner),
            interpolation,
        })?;
        self.bat.with(|parts| parts.profile = new)
    }
}
