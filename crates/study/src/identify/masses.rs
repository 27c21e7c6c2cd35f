//! Modes without the masses of accelerometers.
//!
//! One accelerometer of mass m that stays at k: the bat alone answers
//!
//! ```text
//! H_jk = H′_jk/(1 − m H′_kk)        accelerations per force, H′ as measured
//! ```
//!
//! so its poles are where `m H′_kk = 1`, and its residues follow there: exact, as H′ is the sum of all that was
//! found, modes beyond the band included. Several accelerometers, to first order in each mode:
//! `f² = f′²/(1 − m Σ φ_j²/m_n)`.
//!
//! # Source
//!
//! D. J. Ewins, Modal Testing (2nd ed. 2000): structural modification by a mass at one point.

use sweetspot_tap::complex::Complex;
use sweetspot_tap::fit::Pole;
use sweetspot_tap::resonances::{at, square};

use crate::identify::fitted::Fitted;
use crate::identify::set::ResponseSet;
use sweetspot::base::error::{Error, Result};

/// Accelerometers that were on the bat.
pub struct Masses {
    /// Mass of each (kg).
    mass: f64,
    /// The response whose hammer and accelerometer are at one place.
    drive: usize,
    /// Whether it is the only accelerometer.
    pub(super) alone: bool,
}

/// A mode without the masses.
pub(super) struct Unloaded {
    /// Its pole.
    pub pole: Pole,
    /// Residue (1/kg) of every response.
    pub residues: Vec<Complex>,
}

/// Turns of the fixed point for a root; it gains two digits a turn.
const TURNS: usize = 30;

impl Masses {
    /// Accelerometers of that mass (kg) at every place where answers were measured.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] without a drive point, which tells how much the bat gives way there.
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
    pub(super) fn without(&self, of: &Fitted, p: usize) -> Unloaded {
        let own = of.residue(self.drive, p);
        let start = square(of.poles()[p]);
        let count = of.set.responses.len();
        if !self.alone {
            let residues: Vec<Complex> = (0..count).map(|k| of.residue(k, p)).collect();
            let sum =
                if of.set.hammer_roves { self.at_references(of, p) } else { moved(&residues, own) };
            let z = start / (Complex::ONE - sum * self.mass);
            return Unloaded { pole: at(z), residues };
        }
        let mut z = start;
        for _ in 0..TURNS {
            let rest = Complex::ONE - of.at(self.drive, Some(p), z) * self.mass;
            z = start * rest / (rest - own * self.mass);
        }
        // Residues from the slope of 1 − m H′ where it is 0.
        let step = 1e-4 * (start - z).square().sqrt() + 1e-9 * z.re;
        let near = |by: f64| of.at(self.drive, None, z + Complex::new(by, 0.0));
        let slope = (near(step) - near(-step)) * (0.5 / step);
        let residue = |k: usize| of.at(k, None, z) / (slope * z * self.mass) * -1.0;
        Unloaded { pole: at(z), residues: (0..count).map(residue).collect() }
    }

    /// `Σ φ_k²/m_n` over several accelerometers that stayed.
    fn at_references(&self, of: &Fitted, p: usize) -> Complex {
        let drives = (0..of.set.references.len()).filter_map(|reference| of.set.drive(reference));
        drives.fold(Complex::default(), |sum, k| sum + of.residue(k, p))
    }
}

/// `Σ φ_j²/m_n` over accelerometers in a row, `φ_j²/m_n = A_jk²/A_kk`.
fn moved(residues: &[Complex], own: Complex) -> Complex {
    residues.iter().fold(Complex::default(), |sum, a| sum + *a * *a / own)
}
