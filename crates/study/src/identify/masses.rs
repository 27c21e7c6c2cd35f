//! Modes without the masses of accelerometers.
//!
//! With a mass m at places W the accelerations per force of the bat alone are
//!
//! ```text
//! H = (1 − m H′_WW)⁻¹ H′        H′ as measured
//! ```
//!
//! so its poles are where `1 − m H′_WW` is singular, and its shapes follow there. For one accelerometer that stays, W
//! is the drive point and this is exact but for noise: H′ is the sum of everything found, modes beyond the band
//! included. Of several, one column of H′ is measured. Each mode tells the others by `H′_jl = H′_jk H′_lk/H′_kk`, and
//! so do the rigid motion that the force excites, and modes beyond the band taken as one. The other rigid motion turns
//! the bat about k, with `(x_j − x_k)(x_l − x_k)/I_k`; its moment of inertia is that of bats.
//!
//! # Source
//!
//! D. J. Ewins, Modal Testing (2nd ed. 2000): structural modification by masses.

use faer::linalg::solvers::Solve;
use faer::{Mat, c64};
use sweetspot_tap::fit::Pole;
use sweetspot_tap::resonances::{at, square};

use crate::calibrate::calibration::NINETY_FIVE;
use crate::engine::{Error, Result};
use crate::identify::fitted::{Fitted, Portion};
use crate::identify::set::ResponseSet;

/// Accelerometers that were on the bat.
pub struct Masses {
    /// Mass of each (kg).
    mass: f64,
    /// The responses of the reference with a drive point, and where they were measured or struck (m).
    column: Vec<(usize, f64)>,
    /// The drive point, the response with hammer and accelerometer at one place, by its place among them.
    drive: usize,
    /// Those with an accelerometer, likewise.
    watched: Vec<usize>,
    /// Largest distance from the knob end (m).
    length: f64,
}

/// A mode without the masses.
pub(super) struct Unloaded {
    /// Its pole.
    pub pole: Pole,
    /// Residue (1/kg) of every response.
    pub residues: Vec<c64>,
    /// Contribution of the removal to the standard deviations of the frequency (relative) and of the loss factor (of
    /// its logarithm).
    pub deviations: [f64; 2],
}

/// Most steps of the fixed point for a root; it gains two digits a step if the masses are small.
const TURNS: usize = 60;
/// The root is there where a turn moves it by no more than this, relative.
const SETTLED: f64 = 1e-11;
/// Least `re(1 − m Σ φ²/m_n)` of masses that a bat may carry: they then lower its frequency by 30 %.
const CARRIED: f64 = 0.5;
/// A frequency may fall by this much when the masses are removed: it is then that of a mode in which they do not move.
const STILL: f64 = 1e-4;
/// Balance point and radius of gyration of a bat, over its length.
const BALANCE: f64 = 0.58;
const GYRATION: f64 = 0.27;
/// Error that is left of a frequency where there are several accelerometers, root mean square over the square of the
/// share by which the masses lower it: this much, and that much for one accelerometer for every mode up to that one,
/// which falls with their number by this power. It was found on 300 beams without noise, similar to
/// those of `search/identify.py --masses`.
const LEFT: [f64; 3] = [0.1, 0.75, -1.7];

/// Motions with one shape each: what one answers at two places is its share times both its deflections.
type Motions = Vec<(c64, Vec<c64>)>;

impl Masses {
    /// Accelerometers of that mass (kg) at every place of a response.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] without a drive point, which gives the compliance of the bat there.
    pub fn of(set: &ResponseSet, mass: f64) -> Result<Self> {
        let drive = (0..set.references.len()).find_map(|r| Some((r, set.drive(r)?)));
        let (reference, drive) = drive.ok_or_else(|| {
            let expected = "one where the hammer struck beside the accelerometer: it tells how much the bat gives way \
                            to a mass";
            Error::value("--accelerometer", "no such response among them", expected)
        })?;
        let own = (0..set.responses.len()).filter(|k| set.responses[*k].reference == reference);
        let column: Vec<(usize, f64)> =
            own.map(|k| (k, set.points[set.responses[k].point].x)).collect();
        let place = |k: usize| column.iter().position(|(own, _)| *own == k);
        let watched = match set.hammer_roves {
            true => {
                (0..set.references.len()).filter_map(|r| place(set.beside(reference, r)?)).collect()
            }
            false => (0..column.len()).collect(),
        };
        let drive = place(drive).unwrap_or(0);
        let length =
            set.points.iter().chain(&set.references).map(|place| place.x).fold(0.0, f64::max);
        Ok(Self { mass, column, drive, watched, length })
    }

    /// Pole `p` without the masses, and its residues.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for masses that are more than the responses carry.
    pub(super) fn without(&self, of: &Fitted, p: usize) -> Result<Unloaded> {
        let too_much = || self.too_much(of.poles()[p].hz);
        let z = self.root(of, p).ok_or_else(too_much)?;
        // Residues are products of the shape over the slope of what is 0 at the pole.
        let step = 1e-4 * (square(of.poles()[p]) - z).norm() + 1e-9 * z.re;
        let open = |z: c64| {
            Some(c64::ONE - square(of.poles()[p]) / z - self.freed(of, p, z)?.0 * self.mass)
        };
        let slope = open(z + step).zip(open(z - step)).map(|(a, b)| (a - b) * (0.5 / step));
        let (slope, (_, shape)) = slope.zip(self.freed(of, p, z)).ok_or_else(too_much)?;
        let scale = shape[self.drive]
            / (of.value(self.column[self.drive].0, Portion::Residue(p)) * z * slope);
        let mut residues: Vec<c64> =
            (0..of.set.responses.len()).map(|k| of.value(k, Portion::Residue(p))).collect();
        for ((k, _), own) in self.column.iter().zip(&shape) {
            residues[*k] = own * scale;
        }
        let pole = at(z);
        let lowered = of.poles()[p].hz / pole.hz - 1.0;
        let deviations = self.deviations(of, p, lowered, self.unsure(of, p, z));
        let sound = pole.hz.is_finite() && residues.iter().all(|a| a.norm_sqr().is_finite());
        let falls = lowered > 2.0 * NINETY_FIVE * deviations[0] + STILL;
        if falls || !sound { Err(too_much()) } else { Ok(Unloaded { pole, residues, deviations }) }
    }

    /// `Σ φ x/m_n` over the accelerometers, and the deflections x of the column, of a mode φ that moves all others.
    fn freed(&self, of: &Fitted, p: usize, z: c64) -> Option<(c64, Vec<c64>)> {
        let (motions, own) = (self.others(of, p, z), self.parts(of, Portion::Residue(p)));
        let size = self.watched.len();
        let between = Mat::from_fn(size, size, |i, j| {
            let [i, j] = [i, j].map(|w| self.watched[w]);
            let sum: c64 = motions.iter().map(|(share, shape)| share * shape[i] * shape[j]).sum();
            c64::from(f64::from(i == j)) - sum * self.mass
        });
        let moved =
            between.partial_piv_lu().solve(Mat::from_fn(size, 1, |i, _| own[self.watched[i]]));
        let over = |shape: &[c64]| -> c64 {
            self.watched.iter().enumerate().map(|(i, w)| shape[*w] * moved[(i, 0)]).sum()
        };
        let mut shape = own.clone();
        for (share, other) in &motions {
            let by = share * over(other) * self.mass;
            shape.iter_mut().zip(other).for_each(|(x, other)| *x += by * other);
        }
        let sum = over(&own) / own[self.drive];
        sum.norm_sqr().is_finite().then_some((sum, shape))
    }

    /// A part of every response of the column.
    fn parts(&self, of: &Fitted, part: Portion) -> Vec<c64> {
        self.column.iter().map(|(k, _)| of.value(*k, part)).collect()
    }

    /// The motions beside pole `p` at a complex square of the frequency.
    fn others(&self, of: &Fitted, p: usize, z: c64) -> Motions {
        let pole = |s: usize| (Portion::Residue(s), -z / (square(of.poles()[s]) - z));
        let others = of.kept.iter().copied().filter(|s| *s != p).map(pole);
        let others = others.chain([(Portion::Rigid, c64::ONE), (Portion::Beyond(z), c64::ONE)]);
        let motion = |(part, gain): (Portion, c64)| {
            let shape = self.parts(of, part);
            // A mode that noise hides at the drive point says little of others.
            let own = shape[self.drive];
            let noise = match part {
                Portion::Residue(_) if self.watched.len() > 1 => {
                    of.deviation(self.column[self.drive].0, part)
                }
                _ => 0.0,
            };
            let size = (own.norm_sqr() + noise * noise).max(f64::MIN_POSITIVE);
            (gain * own.conj() / size, shape)
        };
        let mut motions: Motions = others.map(motion).collect();
        // Rigid motions answer `(1 + d²/r²)/M` at k, d from the balance point: `1/I_k` is `r²/(r² + d²)²` of that.
        let (drive, here) = self.column[self.drive];
        let rigid = of.value(drive, Portion::Rigid).re;
        let [turned, arm] = [GYRATION * self.length, here - BALANCE * self.length].map(|r| r * r);
        let share = rigid * turned / (turned + arm).powi(2).max(f64::MIN_POSITIVE);
        let arms = self.column.iter().map(|(_, x)| c64::from(x - here));
        motions.push((share.into(), arms.collect()));
        motions
    }

    /// The complex square of the frequency where the pole is free, by a fixed point; `None` if there is none.
    fn root(&self, of: &Fitted, p: usize) -> Option<c64> {
        let start = square(of.poles()[p]);
        let mut z = start;
        for _ in 0..TURNS {
            let left = c64::ONE - self.freed(of, p, z)?.0 * self.mass;
            if left.re < CARRIED {
                return None;
            }
            let by = (start / left - z).norm();
            z = start / left;
            if by <= SETTLED * z.norm() {
                return Some(z);
            }
        }
        None
    }

    /// Contribution of the removal to the deviations of frequency and loss factor.
    ///
    /// The noise of the drive point moves `z` by a complex number of the relative size `part`, half of whose square is
    /// in either component. The errors of the pole also turn the residue: for a single resonance they change its size
    /// by half of the relative error of η, and its phase by that of `f/(η f)`.
    fn deviations(&self, of: &Fitted, p: usize, lowered: f64, part: f64) -> [f64; 2] {
        let (loss, [hz, ln]) = (of.poles()[p].loss(), of.found.fit.deviations(p));
        let part = part / 2.0_f64.sqrt();
        let (re, im) = (part.hypot(lowered * ln), part.hypot(2.0 * lowered * hz / loss));
        let left = self.left(of, p) * lowered.powi(2);
        [(0.5 * re).hypot(left), (im / loss).hypot(left)]
    }

    /// [`LEFT`] of this pole.
    fn left(&self, of: &Fitted, p: usize) -> f64 {
        let order = of.kept.iter().filter(|k| of.poles()[**k].hz <= of.poles()[p].hz).count();
        let [least, by, power] = LEFT;
        let each = self.watched.len() as f64 / order as f64;
        if self.watched.len() > 1 { least + by * each.powf(power) } else { 0.0 }
    }

    /// Standard deviation of z, relative, both its parts together, by the noise of the column.
    ///
    /// `Σ φ²/m_n` is a sum of squares over the drive point's: it has twice the error of each, weighed by its size.
    fn unsure(&self, of: &Fitted, p: usize, z: c64) -> f64 {
        let drive = self.column[self.drive].0;
        let start = square(of.poles()[p]);
        if self.watched.len() == 1 {
            let step = 1e-4 * (start - z).norm() + 1e-9 * z.re;
            let near = |by: f64| of.value(drive, Portion::All(z + by));
            let slope = (near(step) - near(-step)) * (0.5 / step);
            return of.deviation(drive, Portion::All(z)) / (slope * z).norm();
        }
        let part = Portion::Residue(p);
        let own = of.value(drive, part).norm_sqr().max(f64::MIN_POSITIVE);
        let each = || self.watched.iter().map(|w| self.column[*w].0);
        let squares: f64 = each().map(|k| of.value(k, part).norm_sqr()).sum();
        let noise = each().map(|k| of.value(k, part).norm_sqr() * of.deviation(k, part).powi(2));
        let noise = 2.0 * (noise.sum::<f64>() / own).sqrt();
        let noise = noise.hypot(of.deviation(drive, part) * squares / own);
        self.mass * noise * (z / start).norm()
    }

    fn too_much(&self, hz: f64) -> Error {
        let found = format!("{} kg, which the mode at {hz:.4} Hz does not bear", self.mass);
        let expected =
            "the mass of one accelerometer: the masses told are more than the responses carry";
        Error::value("--accelerometer", found, expected)
    }
}
