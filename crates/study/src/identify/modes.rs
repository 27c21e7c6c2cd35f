//! The modes that responses share: one pole for all, a residue for each.
//!
//! Residues are `A_jk = φ_j φ_k/m`. With one reference k they are the shape; with several, the shape is the one that
//! fits all of them best. The drive point gives the modal mass, `m = φ_k²/A_kk`.

use std::f64::consts::TAU;

use faer::c64;
use sweetspot_tap::fit::Pole;
use sweetspot_tap::orders::Orders;
use sweetspot_tap::resonances::{Damping, LOSSES, Responses, at, square};

use crate::calibrate::calibration::NINETY_FIVE;
use crate::engine::{Error, ResponseKind, Result};
use crate::identify::fitted::{Fitted, Group, Portion};
use crate::identify::masses::{Masses, Unloaded};
use crate::identify::set::{Place, ResponseSet};
use crate::measured::mac::collinearity;
use crate::tap::heard::Within;

/// A mode that responses share.
#[derive(Debug, Clone, PartialEq)]
pub struct SharedMode {
    /// Undamped natural frequency (Hz).
    pub frequency: Within,
    /// Damping ratio, half the loss factor.
    pub damping: Within,
    /// Deflections at the points of the set, scaled to a largest size of 1, as nearly real as possible, and positive
    /// nearest to the last point. `None` for a point without a response.
    pub shape: Vec<Option<c64>>,
    /// Phase collinearity of the shape.
    pub collinearity: f64,
    /// Modal mass of that shape (kg); None without a drive point.
    pub modal_mass: Option<f64>,
    /// The number of poles from which on it was always found, and the largest number.
    pub orders: [usize; 2],
    /// Relative lowering of the frequency by the accelerometers' masses; `None` if they are not given.
    pub lowered: Option<f64>,
}

/// The modes of a set of responses.
#[derive(Debug, Clone, PartialEq)]
pub struct Identified {
    /// The modes, by rising frequency.
    pub modes: Vec<SharedMode>,
    /// The kind of damping, as far as it can be determined.
    pub damping: Damping,
    /// The poles for 1, 2, … poles.
    pub orders: Vec<Vec<Pole>>,
    /// Sum over the responses of |acceleration per force|², by frequency, of the first grid.
    pub sum: Vec<[f64; 2]>,
    /// Lowest and highest frequency (Hz).
    pub band: [f64; 2],
    /// Number of different grids of frequencies.
    pub grids: usize,
    /// Number of responses with coherence; if all have it, it gives the noise.
    pub coherent: usize,
    /// Place of a reference (m) with hammer and accelerometer in opposite directions, by most modes.
    pub opposite: Option<f64>,
}

/// Facts about a test that its responses do not contain.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct TestKnown {
    /// Mass of an accelerometer (kg).
    pub accelerometer: Option<f64>,
    /// Time in which an exponential window falls to 1/e (s).
    pub window: Option<f64>,
}

/// A pole whose frequency has a larger relative error is not a mode of the band.
const VAGUE: f64 = 0.005;
/// A pole with a larger error of the logarithm of its loss factor is not a mode.
const UNSURE: f64 = 0.35;
/// Poles of two orders nearer than this, over the half-power width, are one.
const STABLE: f64 = 0.5;

impl Identified {
    /// The modes of a set.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for masses of accelerometers without a drive point or with one of wrong sign, for masses larger
    /// than the responses allow, and for a window that damps more than a mode does.
    pub fn of(set: &ResponseSet, known: &TestKnown) -> Result<Self> {
        let masses = known.accelerometer.map(|mass| Masses::of(set, mass)).transpose()?;
        let (groups, coherent) = groups(set);
        let mut all: Vec<Responses> = groups.iter().map(|group| group.responses.clone()).collect();
        let found = Orders::of(&mut all);
        let ends = |f: fn(f64, f64) -> f64, hz: fn(&[f64]) -> f64| {
            all.iter().map(|one| hz(&one.hz)).reduce(f).unwrap_or_default()
        };
        let band = [ends(f64::min, |hz| hz[0]), ends(f64::max, |hz| hz[hz.len() - 1])];
        let first = &all[0];
        let power = |l: usize| [first.hz[l], first.values.iter().map(|v| v[l].norm_sqr()).sum()];
        let sum = (0..first.hz.len()).map(power).collect();
        let grids = all.len();
        let Some(found) = found else {
            let (modes, damping, orders) = (vec![], Damping::Material, vec![]);
            let opposite = None;
            return Ok(Self { modes, damping, orders, sum, band, grids, coherent, opposite });
        };
        let poles = 0..found.fit.poles.len();
        let kept = poles.filter(|p| is_mode(&found, *p, band)).collect();
        let fitted = Fitted::new(set, &groups, all, &found, kept);
        let opposite = fitted.opposite();
        if let Some(x) = opposite.filter(|_| masses.is_some()) {
            let found = format!("hammer and accelerometer at {x} m point opposite ways");
            let expected = "one way: turn the sign of the responses over, or leave the mass out";
            return Err(Error::value("--accelerometer", found, expected));
        }
        let mut modes = fitted
            .kept
            .iter()
            .map(|p| fitted.mode(*p, known, masses.as_ref()))
            .collect::<Result<Vec<SharedMode>>>()?;
        modes.sort_by(|a, b| a.frequency.value.total_cmp(&b.frequency.value));
        let (damping, orders) = (found.damping, found.orders);
        Ok(Self { modes, damping, orders, sum, band, grids, coherent, opposite })
    }
}

/// Whether a pole is a mode: it lowers the sum of squares more than noise, oscillates, is well known and in the band.
fn is_mode(found: &Orders, p: usize, [low, high]: [f64; 2]) -> bool {
    let (pole, [hz, loss]) = (found.fit.poles[p], found.fit.deviations(p));
    let rings = (3.0 * LOSSES[0]..0.5 * LOSSES[1]).contains(&pole.loss());
    found.weights[p] > 1.0
        && rings
        && hz < VAGUE
        && loss < UNSURE
        && (low..=high).contains(&pole.hz)
}

/// Responses by their grids, and the number of those with coherence.
fn groups(set: &ResponseSet) -> (Vec<Group>, usize) {
    let mut grids: Vec<(Vec<f64>, Vec<usize>)> = vec![];
    for (k, one) in set.responses.iter().enumerate() {
        let hz: Vec<f64> = one.measured.values.iter().map(|(f, _)| *f).collect();
        match grids.iter_mut().find(|(other, _)| *other == hz) {
            Some((_, which)) => which.push(k),
            None => grids.push((hz, vec![k])),
        }
    }
    let coherent = set.responses.iter().filter(|one| one.measured.coherence.is_some()).count();
    let all = coherent == set.responses.len();
    let group = |(hz, which): (Vec<f64>, Vec<usize>)| {
        let values = which.iter().map(|k| accelerance(set, *k)).collect::<Vec<_>>();
        let noise = all.then(|| by_coherence(set, &which, &values)).flatten();
        Group { which, responses: Responses::new(hz, values, noise) }
    };
    (grids.into_iter().map(group).collect(), coherent)
}

/// A response as acceleration per force.
fn accelerance(set: &ResponseSet, k: usize) -> Vec<c64> {
    let one = &set.responses[k].measured;
    let turned =
        |(f, value): &(f64, c64)| value * ResponseKind::Accelerance.of(*f) / one.kind.of(*f);
    one.values.iter().map(turned).collect()
}

/// Noise of lines, the mean of `|H| √(1/γ² − 1)` over the responses; `None` if the coherence gives no information.
fn by_coherence(set: &ResponseSet, which: &[usize], values: &[Vec<c64>]) -> Option<Vec<f64>> {
    let lines = values[0].len();
    let mut noise = vec![0.0; lines];
    for (k, values) in which.iter().zip(values) {
        let coherence = set.responses[*k].measured.coherence.as_ref()?;
        let own = |l: usize| values[l].norm_sqr() * (1.0 / coherence[l].clamp(1e-3, 1.0) - 1.0);
        let mean = (0..lines).map(own).sum::<f64>() / lines as f64;
        (0..lines).for_each(|l| noise[l] += own(l) / mean.max(1e-300));
    }
    let mean = noise.iter().sum::<f64>() / lines as f64;
    (mean > 0.0).then(|| noise.iter().map(|n| (n / mean).max(1e-3).sqrt()).collect())
}

impl Fitted<'_> {
    fn mode(&self, p: usize, known: &TestKnown, masses: Option<&Masses>) -> Result<SharedMode> {
        let pole = self.poles()[p];
        let unloaded = masses.map(|masses| masses.without(self, p)).transpose()?;
        let loaded = || {
            let residue = |k: usize| self.value(k, Portion::Residue(p));
            let residues = (0..self.set.responses.len()).map(residue).collect();
            Unloaded { pole, residues, deviations: [0.0; 2] }
        };
        let Unloaded { pole: free, residues, deviations } = unloaded.unwrap_or_else(loaded);
        let (shape, modal_mass) = shape(self.set, &residues);
        let still = without_window(free, known.window)?;
        let lowered = masses.map(|_| pole.hz / free.hz - 1.0);
        let own = self.found.fit.deviations(p);
        let [hz, loss] = [0, 1].map(|k| NINETY_FIVE * own[k].hypot(deviations[k]));
        let hz = [-hz, hz].map(|by| still.hz * (1.0 + by));
        let damping = |loss: f64| 0.5 * (loss - free.loss() + still.loss()).max(0.0);
        let ratios = [-loss, loss].map(|by| damping(free.loss() * by.exp()));
        let values: Vec<c64> = shape.iter().flatten().copied().collect();
        Ok(SharedMode {
            frequency: Within { value: still.hz, interval95: hz },
            damping: Within { value: damping(free.loss()), interval95: ratios },
            collinearity: collinearity(&values),
            shape,
            modal_mass,
            orders: self.stable(pole),
            lowered,
        })
    }

    /// Place of the first reference (m) at whose drive point most of these poles have a negative residue.
    fn opposite(&self) -> Option<f64> {
        let turned = |reference: &usize| {
            let Some(drive) = self.set.drive(*reference) else { return false };
            let negative = |p: &&usize| self.value(drive, Portion::Residue(**p)).re < 0.0;
            2 * self.kept.iter().filter(negative).count() > self.kept.len()
        };
        let first = (0..self.set.references.len()).find(turned)?;
        Some(self.set.references[first].x)
    }

    /// The number of poles from which on this one is always found, and the largest number.
    fn stable(&self, pole: Pole) -> [usize; 2] {
        let orders = &self.found.orders;
        let near = |other: &Pole| (other.hz - pole.hz).abs() < STABLE * pole.loss() * pole.hz;
        let with = orders.iter().rev().take_while(|poles| poles.iter().any(near)).count();
        [(orders.len() + 1 - with).min(orders.len()), orders.len()]
    }
}

/// The pole without an exponential window, which takes `i/(2πτ)` off the complex frequency `f √(1 + iη)`.
///
/// # Errors
///
/// [`Error::Value`] for a window that damps more than the mode is damped.
fn without_window(pole: Pole, window: Option<f64>) -> Result<Pole> {
    let Some(tau) = window else { return Ok(pole) };
    let own = square(pole).sqrt();
    let moved = own - c64::new(0.0, 1.0 / (TAU * tau));
    if moved.im > 0.0 {
        return Ok(at(moved * moved));
    }
    let found = format!("{tau} s, which damps more than the mode at {:.2} Hz is damped", pole.hz);
    let least = 1.0 / (TAU * own.im.max(f64::MIN_POSITIVE));
    let expected = format!("more than {least:.4} s, or no window: that of the analyser");
    Err(Error::value("--window", found, expected))
}

/// The shape that explains the residues of every response best, and its modal mass.
fn shape(set: &ResponseSet, residues: &[c64]) -> (Vec<Option<c64>>, Option<f64>) {
    let of = |reference: usize, point: usize| -> Vec<c64> {
        let own = |k: &usize| {
            (set.responses[*k].reference, set.responses[*k].point) == (reference, point)
        };
        (0..residues.len()).filter(own).map(|k| residues[k]).collect()
    };
    let mean =
        |all: Vec<c64>| (!all.is_empty()).then(|| all.iter().sum::<c64>() / all.len() as f64);
    let points = 0..set.points.len();
    let rows: Vec<Vec<Option<c64>>> = (0..set.references.len())
        .map(|reference| points.clone().map(|point| mean(of(reference, point))).collect())
        .collect();
    let size = |row: &Vec<Option<c64>>| row.iter().flatten().map(|v| v.norm_sqr()).sum::<f64>();
    let Some(main) = rows.iter().max_by(|a, b| size(a).total_cmp(&size(b))) else {
        return (vec![], None);
    };
    // Every reference's deflection over that of the main one.
    let share = |row: &Vec<Option<c64>>| {
        let both = || row.iter().zip(main).filter_map(|(a, b)| Some(((*a)?, (*b)?)));
        let common: c64 = both().map(|(a, b)| b.conj() * a).sum();
        common / both().map(|(_, b)| b.norm_sqr()).sum::<f64>().max(f64::MIN_POSITIVE)
    };
    let shares: Vec<c64> = rows.iter().map(share).collect();
    let at = |point: usize| {
        let there =
            || rows.iter().zip(&shares).filter_map(|(row, share)| Some((row[point]?, share)));
        let weight: f64 = there().map(|(_, share)| share.norm_sqr()).sum();
        let sum: c64 = there().map(|(value, share)| share.conj() * value).sum();
        (weight > 0.0).then(|| sum / weight)
    };
    scaled(set, points.map(at).collect(), residues)
}

/// A shape turned to be as nearly real as possible, with a largest deflection of 1, and its modal mass.
fn scaled(
    set: &ResponseSet,
    shape: Vec<Option<c64>>,
    residues: &[c64],
) -> (Vec<Option<c64>>, Option<f64>) {
    let sum = shape.iter().flatten().fold(c64::new(0.0, 0.0), |sum, v| sum + v * v);
    let turn = c64::from_polar(1.0, -0.5 * sum.arg());
    let largest = shape.iter().flatten().map(|v| v.norm()).fold(f64::MIN_POSITIVE, f64::max);
    let last = shape.iter().rev().flatten().find(|v| v.norm() > 0.05 * largest);
    let sign = last.map_or(1.0, |v| (v * turn).re.signum());
    let shape: Vec<Option<c64>> =
        shape.into_iter().map(|v| v.map(|v| v * turn * (sign / largest))).collect();
    let mass = |reference: usize| {
        let drive = set.drive(reference)?;
        let phi = shape[set.responses[drive].point]?;
        let residue = residues[drive];
        // A drive point near a node gives no mass.
        (phi.norm() > 0.05 && residue.norm() > 0.0).then(|| (phi.norm(), (phi * phi / residue).re))
    };
    let known = (0..set.references.len()).filter_map(mass);
    let best = known.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, mass)| mass);
    (shape, best.filter(|mass| *mass > 0.0))
}

/// Places and values of the points that have a value.
pub fn placed<'a>(
    points: &'a [Place],
    shape: &'a [Option<c64>],
) -> impl Iterator<Item = (Place, c64)> + 'a {
    points.iter().zip(shape).filter_map(|(place, value)| Some((*place, (*value)?)))
}
