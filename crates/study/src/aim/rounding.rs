//! Which rounding of the least change keeps the goals met?
//!
//! A least change lies on the edge of its tolerances, so rounding may move it out: the stations are then rounded again
//! with compensating targets.

use crate::aim::bench::Bench;
use crate::aim::laying::Laying;
use crate::aim::limits::{KEPT, Limits};
use crate::aim::search::Searched;
use crate::aim::stations::{Draft, Drafting};
use crate::aim::wish::{Band, Grid};
use crate::engine::{Result, linear};

/// Roundings at most.
const DRAFTS: usize = 5;

/// The conditions of a rounding.
pub struct Rounding<'a> {
    /// The bat and its goals.
    pub bench: &'a Bench,
    /// The limits of its diameter.
    pub limits: &'a Limits<'a>,
    /// The allowed range of each goal.
    pub bands: &'a [Band],
    /// How stations are laid.
    pub grid: Grid,
    /// How many times finer than it was wished they are rounded.
    pub finer: f64,
}

/// A bat with rounded stations.
pub struct Rounded {
    /// Its stations, and the bat.
    pub draft: Draft,
    /// The grid of its stations.
    pub grid: Grid,
    /// Its goals.
    pub values: Vec<f64>,
    /// The unknowns that were rounded.
    pub p: Vec<f64>,
    /// The size of their change (mm).
    pub norm: f64,
    /// Its worst miss, in tolerances; a broken limit counts by its share of the rounding.
    pub worst: f64,
    /// Excess of its slope over the allowed one: radius over length.
    pub steeper: f64,
    /// Bats that were computed for it.
    pub drafts: usize,
    /// Why the search of the change that was rounded stopped.
    pub stopped: Option<&'static str>,
}

impl Rounded {
    /// The better of two; the first where both are as good.
    pub fn better(self, other: Option<Self>) -> Self {
        match other {
            Some(other) if other.worst <= self.worst => other,
            _ => self,
        }
    }
}

impl Rounding<'_> {
    /// The best of several roundings of a change of that size (mm), and how far it moved each goal, in tolerances.
    ///
    /// # Errors
    ///
    /// Those of [`Laying::stations`], [`Drafting::draft`] and [`Bench::of`].
    pub fn of(&self, found: &Searched, norm: f64) -> Result<(Rounded, Vec<f64>)> {
        let bench = self.bench;
        let base = bench.rechosen(&bench.bat, &found.p)?;
        let limits = self.limits.on(&base);
        let shape = &found.p[..bench.splines.len()];
        let change = (&bench.splines, shape, bench.stretch(&found.p));
        let densities = self.densities(found);
        let laying = Laying { bat: &base, limits: &limits, change, grid: self.grid };
        let stations = laying.stations()?;
        let drafting = Drafting { laying, stations, densities: &densities };
        let inside = self.inside(&densities, found);
        let mut aside = inside.clone();
        let mut best: Option<(Rounded, Vec<f64>)> = None;
        for drafts in 1..=DRAFTS {
            let draft = drafting.draft(&aside)?;
            let values = bench.of(&draft.bat)?;
            let off: Vec<f64> = (0..values.len())
                .map(|k| (values[k] - found.values[k]) / self.bands[k].scale)
                .collect();
            let steeper = limits.steeper_by(&draft.bat);
            let worst =
                self.worst(&draft, &values).max(steeper * self.grid.every / self.grid.round);
            if let Some((best, _)) = &mut best {
                best.drafts = drafts;
            }
            if best.as_ref().is_none_or(|(best, _)| best.worst > worst) {
                let (p, grid) = (found.p.clone(), self.grid);
                let stopped = found.stopped;
                let rounded =
                    Rounded { draft, grid, values, p, norm, worst, steeper, drafts, stopped };
                best = Some((rounded, off.clone()));
            }
            if worst <= 1e-9 {
                break;
            }
            for ((aside, off), inside) in aside.iter_mut().zip(&off).zip(&inside) {
                *aside += off + inside;
            }
        }
        Ok(best.expect("there is a first draft"))
    }

    fn worst(&self, draft: &Draft, values: &[f64]) -> f64 {
        let misses = self.bands.iter().zip(values).map(|(band, value)| band.miss(*value));
        let broken = draft.broken.iter().map(|broken| broken.by.abs()).fold(0.0, f64::max);
        let broken = if broken > KEPT { broken / self.grid.round } else { 0.0 };
        misses.fold(broken, f64::max)
    }

    /// Required distance from the edge of its band for each goal that is there, in tolerances: the effect of rounding
    /// one station.
    fn inside(&self, densities: &[Vec<f64>], found: &Searched) -> Vec<f64> {
        let one = |of: &Vec<f64>| {
            let places = (1..100).map(|k| 0.01 * f64::from(k) * self.bench.bat.length());
            let effect = places.map(|x| self.bench.splines.at(of, x).abs()).fold(0.0, f64::max);
            1e3 * self.grid.round * self.grid.every * effect
        };
        let of = |(k, density): (usize, &Vec<f64>)| {
            let width = (self.bands[k].high - self.bands[k].low) / self.bands[k].scale;
            let far = one(density).clamp(0.02 / self.finer, 0.4).min(0.4 * width);
            match found.prices[k] {
                price if price > 1e-6 => far,
                price if price < -1e-6 => -far,
                _ => 0.0,
            }
        };
        densities.iter().enumerate().map(of).collect()
    }

    /// The effect on each goal, in tolerances, per mm of diameter and m of length, as coefficients of the curves: their
    /// products with the curves are the slopes.
    fn densities(&self, found: &Searched) -> Vec<Vec<f64>> {
        let overlaps = self.bench.splines.overlaps();
        // Curves that are independent have a positive definite matrix.
        let inverse = linear::inverse(&overlaps).unwrap_or_default();
        let of = |(band, slopes): (&Band, &Vec<f64>)| {
            let product = |row: &Vec<f64>| {
                row.iter().zip(slopes).map(|(a, slope)| a * slope / band.scale).sum()
            };
            inverse.iter().map(product).collect()
        };
        self.bands.iter().zip(&found.slopes).map(of).collect()
    }
}
