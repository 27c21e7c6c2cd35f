//! Modes without the masses of accelerometers.
//!
//! With one accelerometer of mass m that stays at k, the response of the bat alone is
//!
//! ```text
//! H_jk = H′_jk/(1 − m H′_kk)        accelerations per force, H′ as measured
//! ```
//!
//! so its poles are where `m H′_kk = 1`, and its residues follow there. That is exact, because H′ is the sum of
//! everything found, modes beyond the band included. Several accelerometers are removed to first order in each mode:
//! `f² = f′²/(1 − m Σ φ_j²/m_n)`.
//!
//! # Source
//!
//! D. J. Ewins, Modal Testing (2nd ed. 2000): structural modification by a mass at one point.

use faer::c64;
use sweetspot_tap::fit::Pole;
use sweetspot_tap::resonances::{at, square};

use crate::calibrate::calibration::NINETY_FIVE;
use crate::engine::{Error, Result};
use crate::identify::fitted::Fitted;
use crate::identify::set::ResponseSet;

/// Accelerometers that were on the bat.
pub struct Masses {
    /// Mass of each (kg).
    mass: f64,
    /// The response with hammer and accelerometer at one place.
    drive: usize,
    /// Whether it is the only accelerometer.
    pub(super) alone: bool,
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
/// Largest remaining error of masses in a row, over the square of the lowering of a frequency: from virtual tests of
/// solid and hollow bats, with at least [`PER_MODE`] accelerometers for every mode up to that one, and with fewer.
const SECOND: [f64; 2] = [0.7, 5.0];
/// Number of accelerometers per mode that separates it from the others.
const PER_MODE: usize = 3;

impl Masses {
    /// Accelerometers of that mass (kg) at every place of a response.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] without a drive point, which gives the compliance of the bat there.
    pub fn of(set: &ResponseSet, mass: f64) -> Result<Self> {
        let drive = (0..set.references.len()).find_map(|reference| set.drive(reference));
        let drive = drive.ok_or_else(|| {
            let expected = "one where the hammer struck beside the accelerometer: it tells how much the bat gives way \
                            to a mass";
            Error::value("--accelerometer", "no such response among them", expected)
        })?;
        let alone = set.hammer_roves && set.references.len() == 1;
        Ok(Self { mass, drive, alone })
    }

    /// Pole `p` without the masses, and its residues.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for masses that are more than the responses carry.
    pub(super) fn without(&self, of: &Fitted, p: usize) -> Result<Unloaded> {
        let start = square(of.poles()[p]);
        let count = of.set.responses.len();
        let own = of.residue(self.drive, p);
        let residues: Vec<c64> = (0..count).map(|k| of.residue(k, p)).collect();
        let too_much = || self.too_much(of.poles()[p].hz);
        let (z, residues, part) = if self.alone {
            let z = self.root(of, p).ok_or_else(too_much)?;
            // Residues from the slope of 1 − m H′ where it is 0.
            let step = 1e-4 * (start - z).norm() + 1e-9 * z.re;
            let near = |by: f64| of.at(self.drive, None, z + by);
            let slope = (near(step) - near(-step)) * (0.5 / step);
            let residue = |k: usize| of.at(k, None, z) / (slope * z * self.mass) * -1.0;
            let part = of.deviation_at(self.drive, z) / (slope * z).norm();
            (z, (0..count).map(residue).collect(), part)
        } else {
            let sum =
                if of.set.hammer_roves { self.at_references(of, p) } else { moved(&residues, own) };
            let z = self.freed(start, c64::ONE, sum).ok_or_else(too_much)?;
            (z, residues, self.mass * self.unsure(of, p) * (z / start).norm())
        };
        let pole = at(z);
        let lowered = of.poles()[p].hz / pole.hz - 1.0;
        let deviations = self.deviations(of, p, lowered, part);
        let sound = pole.hz.is_finite() && residues.iter().all(|a| a.norm_sqr().is_finite());
        let falls = lowered > 2.0 * NINETY_FIVE * deviations[0] + STILL;
        if falls || !sound { Err(too_much()) } else { Ok(Unloaded { pole, residues, deviations }) }
    }

    /// `z′ rest/(rest − m a)`; `None` if the masses exceed the limit [`CARRIED`].
    fn freed(&self, start: c64, rest: c64, a: c64) -> Option<c64> {
        let left = c64::ONE - a * self.mass / rest;
        (left.re >= CARRIED).then(|| start / left)
    }

    /// The complex square of the frequency where `m H′ = 1`, by a fixed point; `None` if there is none.
    fn root(&self, of: &Fitted, p: usize) -> Option<c64> {
        let (start, own) = (square(of.poles()[p]), of.residue(self.drive, p));
        let mut z = start;
        for _ in 0..TURNS {
            let rest = c64::ONE - of.at(self.drive, Some(p), z) * self.mass;
            let next = self.freed(start, rest, own)?;
            let by = (next - z).norm();
            z = next;
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
        let second = self.second(of, p) * lowered.powi(2) / NINETY_FIVE;
        [(0.5 * re).hypot(second), (im / loss).hypot(second)]
    }

    /// Remaining error of the first order, over the square of the lowering of the frequency.
    fn second(&self, of: &Fitted, p: usize) -> f64 {
        let places = if of.set.hammer_roves { &of.set.references } else { &of.set.points };
        let order = of.poles().iter().filter(|pole| pole.hz <= of.poles()[p].hz).count();
        if self.alone { 0.0 } else { SECOND[usize::from(places.len() < PER_MODE * order)] }
    }

    /// Standard deviation (1/kg) of `Σ φ²/m_n` of several accelerometers, both its parts together.
    fn unsure(&self, of: &Fitted, p: usize) -> f64 {
        if of.set.hammer_roves {
            let drives = (0..of.set.references.len()).filter_map(|r| of.set.drive(r));
            return drives.map(|k| of.deviation(k, p).powi(2)).sum::<f64>().sqrt();
        }
        // Of a sum of squares over the drive point's: twice the error of each, weighed by its size.
        let own = of.residue(self.drive, p).norm_sqr().max(f64::MIN_POSITIVE);
        let each = 0..of.set.responses.len();
        let squares: f64 = each.clone().map(|k| of.residue(k, p).norm_sqr()).sum();
        let noise = each.map(|k| of.residue(k, p).norm_sqr() * of.deviation(k, p).powi(2));
        let noise = 2.0 * (noise.sum::<f64>() / own).sqrt();
        noise.hypot(of.deviation(self.drive, p) * squares / own)
    }

    fn too_much(&self, hz: f64) -> Error {
        let found = format!("{} kg, which the mode at {hz:.4} Hz does not bear", self.mass);
        let expected =
            "the mass of one accelerometer: the masses told are more than the responses carry";
        Error::value("--accelerometer", found, expected)
    }

    /// `Σ φ_k²/m_n` over several accelerometers that stayed.
    fn at_references(&self, of: &Fitted, p: usize) -> c64 {
        let drives = (0..of.set.references.len()).filter_map(|reference| of.set.drive(reference));
        drives.map(|k| of.residue(k, p)).sum()
    }
}

/// `Σ φ_j²/m_n` over accelerometers in a row, `φ_j²/m_n = A_jk²/A_kk`.
fn moved(residues: &[c64], own: c64) -> c64 {
    residues.iter().map(|a| a * a / own).sum()
}
