//! The least change that meets the bands, by a sequence of quadratic programs.
//!
//! Each step linearises the goals in the unknowns and solves [`Program`] for the next unknowns. The objective is
//! exactly quadratic and the goals are nearly linear over a millimetre, so a few steps are enough. A step is halved
//! until the penalty function `pᵀHp + Σ μ_i miss_i` falls. If the bat violates the limits, such as one that is thicker
//! than the rules allow, the first step is taken in full: a gain beyond the limits does not count.

use crate::aim::bench::{Bench, Look};
use crate::aim::limits::{Broken, Limits, Room};
use crate::aim::program::{Bounded, Elastic, Least, Program};
use crate::aim::wish::Band;
use crate::engine::{Error, Result};

/// Steps at most.
const MOST: usize = 24;
/// Why a search ended that took them all.
const STEPS_TAKEN: &str = "24 steps";
/// A step changes no coefficient by more than that (mm).
const TRUST: f64 = 3.0;
/// The trust region grows to this many times its size if the limits leave no room in it.
const WIDEST: f64 = 32.0;
/// The search has converged if a step changes no coefficient by more than this (mm).
const STILL: f64 = 1e-3;
/// A step that reduces the objective by less than this share ends the search: at a corner of the limits, steps would
/// continue without end.
const NO_GAIN: f64 = 1e-7;
/// A goal that misses its band by this share of its tolerance has missed.
pub const MISSED: f64 = 1e-3;
/// Rounds in which places where a limit is broken between others are added.
const ROUNDS: usize = 10;
/// A step that changes a coefficient by more than this (mm) is far from the end. Its limits may be violated by some
/// micrometres between the places where they are checked; the next steps correct that.
const FAR: f64 = 0.1;
const ROUGHLY: f64 = 2e-6;
/// Slopes hold as long as no coefficient has changed by more than that (mm).
const SAME_SLOPES: f64 = 0.05;

/// The objective: this many times the size of the change, plus the price of each band's miss.
#[derive(Debug, Clone, PartialEq)]
pub struct Weights {
    /// Factor of `pᵀHp`.
    pub size: f64,
    /// Price of a miss by one tolerance (mm²), for each band.
    pub miss: Vec<f64>,
}

impl Weights {
    /// Bands are met, if they can be, by the least change.
    pub fn met(bands: usize) -> Self {
        /// More than the price of any tolerance: a centimetre of the sweet spot, about twenty tolerances, costs 50.
        const PENALTY: f64 = 1e3;
        Self { size: 1.0, miss: vec![PENALTY; bands] }
    }

    /// Whether these values meet all bands that have a price.
    fn are_met(&self, bands: &[Band], values: &[f64]) -> bool {
        let mut asked = bands.iter().zip(values).zip(&self.miss);
        asked.all(|((band, value), price)| price.min(1.0) * band.miss(*value) <= MISSED)
    }
}

/// The end of a search.
#[derive(Debug, Clone, PartialEq)]
pub struct Searched {
    /// The unknowns.
    pub p: Vec<f64>,
    /// The goals, in the order of the bands.
    pub values: Vec<f64>,
    /// How the goals change with the unknowns.
    pub slopes: Vec<Vec<f64>>,
    /// Decrease of the squared norm (mm²) if a band's bound is relaxed by one tolerance: above 0 at the upper bound,
    /// below 0 at the lower one.
    pub prices: Vec<f64>,
    /// Quadratic programs.
    pub iterations: usize,
    /// Bats that were computed.
    pub bats: usize,
    /// Why it ended before it converged; `None` if it converged.
    pub stopped: Option<&'static str>,
}

/// A bench with its limits, and the quadratic form of the change.
pub struct Search<'a> {
    bench: &'a Bench,
    limits: &'a Limits<'a>,
    form: Vec<Vec<f64>>,
    rooms: Vec<Room>,
    inclines: Vec<Bounded>,
}

impl<'a> Search<'a> {
    /// A search on that bench.
    pub fn new(bench: &'a Bench, limits: &'a Limits<'a>) -> Self {
        let (n, count) = (bench.splines.len(), bench.unknowns());
        let mut form = vec![vec![0.0; count]; count];
        for (row, of) in form.iter_mut().zip(bench.splines.roughness()) {
            row[..n].copy_from_slice(&of);
        }
        for (k, extra) in bench.extras.iter().enumerate() {
            form[n + k][n + k] = extra.cost.powi(2);
        }
        let changes = |x: f64| bench.splines.basis.iter().any(|curve| curve.at(x) != 0.0);
        let rooms = limits.rows(&changes);
        let steep = |incline: Room| {
            // As a gain or loss over 5 cm, so that all rows have a similar size.
            const OVER: f64 = 0.05;
            let curves = bench.splines.basis.iter();
            let mut row: Vec<f64> = curves.map(|curve| OVER * curve.slope(incline.x)).collect();
            row.resize(count, 0.0);
            let [low, high] = [incline.low, incline.high].map(|slope| 1e3 * OVER * slope);
            Bounded { row, low, high }
        };
        let inclines = limits.inclines(&changes).into_iter().map(steep).collect();
        Self { bench, limits, form, rooms, inclines }
    }

    /// The size of the change of the diameter: root of `mean(d²) + ℓ⁴ mean(d″²)` (mm).
    pub fn norm(&self, p: &[f64]) -> f64 {
        let n = self.bench.splines.len();
        self.square(&self.form, &p[..n]).max(0.0).sqrt()
    }

    fn square(&self, form: &[Vec<f64>], p: &[f64]) -> f64 {
        let product = |row: &Vec<f64>| row.iter().zip(p).map(|(h, p)| h * p).sum::<f64>();
        form.iter().zip(p).map(|(row, p)| p * product(row)).sum()
    }

    /// Searches from those unknowns.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] if the limits of the diameter contradict each other; those of [`Bench::look`].
    pub fn from(&self, start: &[f64], bands: &[Band], weights: &Weights) -> Result<Searched> {
        self.until(false, start, bands, weights)
    }

    /// Searches only until it is clear whether the bands that have a price can be met; if they can, the change is not
    /// the least one.
    ///
    /// # Errors
    ///
    /// As [`Self::from`].
    pub fn meets(&self, start: &[f64], bands: &[Band], weights: &Weights) -> Result<Searched> {
        self.until(true, start, bands, weights)
    }

    /// Searches; `met` tells whether it ends as soon as all bands are met.
    fn until(
        &self,
        met: bool,
        start: &[f64],
        bands: &[Band],
        weights: &Weights,
    ) -> Result<Searched> {
        let mut look = self.bench.look(start)?;
        let mut p = start.to_vec();
        let mut count = 1;
        let mut rooms = self.rooms.clone();
        let mut found = None;
        let mut slopes = vec![];
        let mut of_slopes: Vec<f64> = vec![];
        let mut beyond = self.is_beyond(start);
        for iteration in 1..=MOST {
            if slopes.is_empty() || largest(&p, &of_slopes) > SAME_SLOPES {
                slopes = self.bench.slopes(&look)?;
                of_slopes.clone_from(&p);
                count += self.bench.bats_of_slopes();
            }
            let program = self.program((&p, &look.values, &slopes), bands, weights);
            let mut least = self.solve(program, &p, &mut rooms)?;
            least.prices = asked(&least.prices, weights);
            let ended = |p: &[f64], look: &Look, bats: usize, stopped| Searched {
                p: p.to_vec(),
                values: look.values.clone(),
                slopes: slopes.clone(),
                prices: least.prices.clone(),
                iterations: iteration,
                bats,
                stopped,
            };
            let step = largest(&p, &least.p);
            let mut merit = self.merit(&p, &look.values, bands, weights);
            if std::mem::take(&mut beyond) {
                merit = f64::INFINITY;
            }
            let Some((next, taken, tried)) = self.descend((&p, merit), &least.p, bands, weights)
            else {
                // No part of a step improves the bat although the slopes are its own: there is no better bat nearby.
                if of_slopes == p || step <= 10.0 * STILL {
                    return Ok(ended(&p, &look, count, None));
                }
                found = Some(ended(&p, &look, count, Some(STEPS_TAKEN)));
                slopes.clear();
                continue;
            };
            count += tried;
            (p, look) = (taken, next);
            let gained = merit - self.merit(&p, &look.values, bands, weights);
            let no_gain = merit.is_finite() && gained.abs() < NO_GAIN * merit.abs();
            let still = step < STILL || no_gain;
            found = Some(ended(&p, &look, count, (!still).then_some(STEPS_TAKEN)));
            if still || met && weights.are_met(bands, &look.values) {
                break;
            }
        }
        found.ok_or_else(|| Error::value("aim", "no step at all", "one step at least"))
    }

    /// The objective.
    fn merit(&self, p: &[f64], values: &[f64], bands: &[Band], weights: &Weights) -> f64 {
        let misses = bands.iter().zip(values).map(|(band, value)| band.miss(*value));
        let price: f64 = misses.zip(&weights.miss).map(|(miss, price)| miss * price).sum();
        weights.size * self.square(&self.form, p) + price
    }

    /// The part of the step that reduces the penalty function: the bat there, its unknowns, and the number of bats
    /// tried; `None` if no part does.
    fn descend(
        &self,
        (p, merit): (&[f64], f64),
        to: &[f64],
        bands: &[Band],
        weights: &Weights,
    ) -> Option<(Look, Vec<f64>, usize)> {
        const HALVINGS: i32 = 10;
        let small = largest(p, to) < STILL;
        for k in 0..HALVINGS {
            let share = 0.5_f64.powi(k);
            let tried: Vec<f64> = p.iter().zip(to).map(|(p, to)| p + share * (to - p)).collect();
            // An impossible bat means that the step is too long.
            let Ok(look) = self.bench.look(&tried) else { continue };
            let now = self.merit(&tried, &look.values, bands, weights);
            // At the end round-off decides, and the last step is taken.
            if now < merit || small && now <= merit + 1e-6 * (1.0 + merit.abs()) {
                return Some((look, tried, k as usize + 1));
            }
        }
        None
    }

    /// The program at those unknowns, goals and slopes.
    fn program(
        &self,
        (p, values, slopes): (&[f64], &[f64], &[Vec<f64>]),
        bands: &[Band],
        weights: &Weights,
    ) -> Program {
        let wish = |k: usize| {
            let Band { low, high, scale, .. } = bands[k];
            let at: f64 = slopes[k].iter().zip(p).map(|(g, p)| g * p).sum();
            let row = slopes[k].iter().map(|g| g / scale).collect();
            let rest = values[k] - at;
            let wish = Bounded { row, low: (low - rest) / scale, high: (high - rest) / scale };
            Elastic { wish, penalty: weights.miss[k] }
        };
        let form = self.form.iter().map(|row| row.iter().map(|h| weights.size * h).collect());
        let wishes = (0..bands.len()).filter(|k| weights.miss[*k] > 0.0).map(wish).collect();
        Program { form: form.collect(), wishes, limits: self.ranges() }
    }

    /// The ranges of the free choices.
    fn ranges(&self) -> Vec<Bounded> {
        let n = self.bench.splines.len();
        let range = |(k, extra): (usize, &super::bench::Extra)| {
            let [low, high] = extra.range.map(|value| (value - extra.start) / extra.unit);
            Bounded { row: self.unit(n + k), low, high }
        };
        self.bench.extras.iter().enumerate().map(range).collect()
    }

    fn unit(&self, k: usize) -> Vec<f64> {
        (0..self.bench.unknowns()).map(|j| if j == k { 1.0 } else { 0.0 }).collect()
    }

    /// Solves the program under the limits of the diameter along the whole curve, within the trust region, which is
    /// enlarged if the limits leave no room in it. `rooms` are the places where limits are checked; those where they
    /// would be violated are added.
    fn solve(&self, program: Program, p: &[f64], rooms: &mut Vec<Room>) -> Result<Least> {
        let mut trust = TRUST;
        while trust <= WIDEST * TRUST {
            if let Some(least) = self.within(&program, p, trust, rooms) {
                return Ok(least);
            }
            trust *= 2.0;
        }
        Err(self.no_room(program, p, rooms))
    }

    /// The error that the limits leave no room, at the worst place of the curve that violates them least.
    fn no_room(&self, mut program: Program, p: &[f64], rooms: &[Room]) -> Error {
        /// Price of a break of 1 mm, far above that of any change (mm²).
        const PENALTY: f64 = 1e4;
        let trust = WIDEST * TRUST;
        program.wishes.clear();
        program.limits.extend(self.trusted(p, trust));
        let elastic = |wish: Bounded| Elastic { wish, penalty: PENALTY };
        program.wishes.extend(rooms.iter().map(|room| elastic(self.row(room, p, trust))));
        program.wishes.extend(self.inclines.iter().cloned().map(elastic));
        let expected = "limits of the diameter that a smooth curve can keep";
        let Some(least) = program.solve() else {
            return Error::value("diameter", "limits that leave no room", expected);
        };
        let by = |k: usize| {
            let wish = &program.wishes[k].wish;
            let value = wish.at(&least.p);
            if value > wish.high { value - wish.high } else { (value - wish.low).min(0.0) }
        };
        let worst = (0..rooms.len()).max_by(|a, b| by(*a).abs().total_cmp(&by(*b).abs()));
        match worst.filter(|k| by(*k) != 0.0) {
            Some(k) => self.limits.no_room(rooms[k].x, 1e-3 * by(k)),
            None => {
                let found = "limits of the diameter and of the slope that leave no room together";
                Error::value("slope", found, "a greater slope, or wider limits of the diameter")
            }
        }
    }

    /// The trust region: the range of each unknown in a step.
    fn trusted<'b>(&'b self, p: &'b [f64], trust: f64) -> impl Iterator<Item = Bounded> + 'b {
        let around = move |(k, p): (usize, &f64)| Bounded {
            row: self.unit(k),
            low: p - trust,
            high: p + trust,
        };
        p.iter().enumerate().map(around)
    }

    fn within(
        &self,
        program: &Program,
        p: &[f64],
        trust: f64,
        rooms: &mut Vec<Room>,
    ) -> Option<Least> {
        let mut least = None;
        for _ in 0..ROUNDS {
            let mut program = program.clone();
            program.limits.extend(self.trusted(p, trust));
            program.limits.extend(self.inclines.iter().cloned());
            program.limits.extend(rooms.iter().map(|room| self.row(room, p, trust)));
            let found = program.solve()?;
            let broken = self.broken(&found.p);
            let worst = broken.iter().map(|broken| broken.by.abs()).fold(0.0, f64::max);
            let enough = worst <= ROUGHLY && largest(p, &found.p) > FAR;
            least = Some(found);
            rooms.extend(broken.iter().map(|broken| broken.room));
            if broken.is_empty() || enough {
                break;
            }
        }
        least
    }

    /// A limit of the diameter as a row of the program (mm), without the side that no step within the trust
    /// region reaches.
    fn row(&self, room: &Room, p: &[f64], trust: f64) -> Bounded {
        let mut row: Vec<f64> =
            self.bench.splines.basis.iter().map(|curve| curve.at(room.x)).collect();
        row.resize(self.bench.unknowns(), 0.0);
        // Far enough inside that the curve between two places is within the limit; where the change ends, this is not
        // needed.
        let inside = 4e-7 * row.iter().sum::<f64>();
        let (low, high) = (1e3 * room.low, 1e3 * room.high);
        // If the diameter is prescribed exactly, there is no inside.
        let inside = if high - low > 2.0 * inside { inside } else { 0.0 };
        let (low, high) = (low + inside, high - inside);
        let now: f64 = row.iter().zip(p).map(|(a, p)| a * p).sum();
        let reach = trust * row.iter().map(|a| a.abs()).sum::<f64>();
        let low = if now - reach > low { f64::NEG_INFINITY } else { low };
        let high = if now + reach < high { f64::INFINITY } else { high };
        Bounded { row, low, high }
    }

    /// Whether those unknowns violate a limit or the range of a free choice.
    fn is_beyond(&self, p: &[f64]) -> bool {
        let broken = self.broken(p).iter().any(|broken| broken.by.abs() > ROUGHLY);
        broken || !self.ranges().iter().all(|range| range.is_kept(p, STILL))
    }

    /// The places where the change of those unknowns violates a limit.
    fn broken(&self, p: &[f64]) -> Vec<Broken> {
        let change = self.bench.change(p);
        self.limits.broken(&self.bench.splines.knots(), &|x, _| change.at(x))
    }
}

/// The prices of all bands, 0 for those without a weight.
fn asked(prices: &[f64], weights: &Weights) -> Vec<f64> {
    let mut prices = prices.iter();
    let of = |miss: &f64| if *miss > 0.0 { prices.next().copied().unwrap_or(0.0) } else { 0.0 };
    weights.miss.iter().map(of).collect()
}

/// The largest difference.
fn largest(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
