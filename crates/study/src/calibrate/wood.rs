//! What are the values of a bat of other wood, and their derivatives by each property?
//!
//! The derivatives of frequencies follow from shares of energy ([`sweetspot::modes::shares`]), those of rigid-body
//! figures from integrals over the stretches: no differences are needed.
//!
//! ```text
//! ∂M/∂ln ρ_j = M_j      ∂x_b/∂ln ρ_j = (S_j − x_b M_j)/M
//! T = 2π √(I/(M g (x_b − p)))      ∂ln T/∂ln ρ_j = ½ (I_j/I − (S_j − p M_j)/(M (x_b − p)))
//! ```
//!
//! with mass M_j, first moment S_j about the knob end and moment of inertia I_j about the pivot p of stretch j.
//!
//! # Source
//!
//! ASTM F2398, as cited by its users, for the pendulum; g is that of the third CGPM, 9.80665 m/s².

use std::f64::consts::TAU;

use crate::calibrate::unknowns::{Logs, UNKNOWNS};
use crate::engine::{
    Bat, Change, Error, Layup, Material, Region, Request, Result, Shares, Solution, Theory, gauss,
    solve, tuned,
};
use crate::ignored::with_typical_shear;

/// Standard gravity (m/s²).
pub const GRAVITY: f64 = 9.80665;
/// Relative accuracy of the frequencies of a fit: far below any reading.
const TOLERANCE: f64 = 1e-8;

/// A number, and its derivatives by the logarithms of the unknowns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slopes {
    /// The number.
    pub value: f64,
    /// Its derivatives.
    pub by: Logs,
}

/// The values of a bat.
#[derive(Debug, Clone, PartialEq)]
pub struct BatObservations {
    /// Mass (kg).
    pub mass: Slopes,
    /// Balance point (m).
    pub balance_point: Slopes,
    /// Period of the pendulum (s).
    pub period: Slopes,
    /// Frequencies (Hz).
    pub frequencies: Vec<Slopes>,
}

/// A bat whose wood is sought.
#[derive(Debug, Clone)]
pub struct WoodenBat {
    /// The bat of the file, with density and moduli from weighing and tapping.
    pub bat: Bat,
    /// Position of the border of the barrel's region (m), if there are two regions.
    pub split: Option<f64>,
    /// Whether the file gives no shear modulus, so that a typical one was assumed.
    pub typical_shear: bool,
    pivot: f64,
}

impl WoodenBat {
    /// The bat in one region, or divided at `split` (m), with a pendulum's pivot at `pivot` (m).
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a place outside the bat, for two regions of a bat whose file has regions or edits, for a
    /// bat edited to another wood, and for one that is held.
    pub fn new(bat: &Bat, split: Option<f64>, pivot: f64) -> Result<Self> {
        let wood = |change: &Change| matches!(change, Change::Wood(_));
        if bat.edits().iter().any(|edit| wood(&edit.change)) {
            let expected = "a bat of the wood that was measured, without the edit \"wood\"";
            return Err(Error::value("edits", "a bat of another wood", expected));
        }
        if bat.fixtures().holding() || !bat.fixtures().absorbers.is_empty() {
            let expected =
                "a free bat, as it is tapped: without supports, springs, hands and absorbers";
            return Err(Error::value("bat", "a bat that something holds", expected));
        }
        if let Some(x) = split {
            let length = bat.length();
            if !(x > 0.02 * length && x < 0.98 * length) {
                let expected = format!("a place inside the bat, 0 to {length} m");
                return Err(Error::value("regions", format!("{x} m"), expected));
            }
            if !bat.fixtures().regions.is_empty() || !bat.edits().is_empty() {
                let found = "two regions of a bat whose file has regions or edits";
                return Err(Error::value("regions", found, "a bat of one wood all along"));
            }
        }
        let bat = tuned(bat.clone(), Theory::EulerBernoulli, 1e-6)?;
        let typical_shear = !bat.knows_shear();
        Ok(Self { bat: with_typical_shear(&bat), split, typical_shear, pivot })
    }

    /// Number of regions.
    pub fn regions(&self) -> usize {
        1 + usize::from(self.split.is_some())
    }

    /// Whether the whole bat is of the material that is sought, so that every stiffness is proportional to its E.
    pub fn is_of_one_material(&self) -> bool {
        let own = self.bat.material();
        self.bat.layups().iter().flat_map(Layup::materials).all(|material| material == own)
    }

    /// G/E of the file.
    pub fn shear_over_young(&self) -> f64 {
        let own = self.bat.material();
        own.shear_modulus.map_or(0.0, |modulus| modulus / own.youngs_modulus)
    }

    /// The materials of handle and barrel.
    pub fn materials(&self, logs: &Logs) -> [Material; 2] {
        let [e, shear, handle, barrel, ratio] = *logs;
        let own = self.bat.material();
        let make = |stiffer: f64, heavier: f64| Material {
            youngs_modulus: own.youngs_modulus * stiffer.exp(),
            shear_modulus: own.shear_modulus.map(|modulus| modulus * (stiffer + shear).exp()),
            density: own.density * heavier.exp(),
            name: None,
            ..own.clone()
        };
        [make(e, handle), make(e + ratio, barrel)]
    }

    /// The bat of other wood.
    ///
    /// # Errors
    ///
    /// As [`Bat::with`].
    pub fn of(&self, logs: &Logs) -> Result<Bat> {
        let [handle, barrel] = self.materials(logs);
        let own = self.bat.material().clone();
        self.bat.with(|parts| {
            for region in &mut parts.fixtures.regions {
                region.layup.materials_mut().filter(|m| **m == own).for_each(|material| {
                    *material = handle.clone();
                });
            }
            parts.material = handle;
            if let Some(from) = self.split {
                let layup = Layup::of(barrel);
                parts.fixtures.regions.push(Region { from, to: self.bat.length(), layup });
            }
        })
    }

    /// The values of the bat with other wood, and the given number of frequencies.
    ///
    /// # Errors
    ///
    /// Those of [`Self::of`] and of [`solve`].
    pub fn shown(&self, logs: &Logs, modes: usize) -> Result<BatObservations> {
        let bat = self.of(logs)?;
        let theory = Theory::Timoshenko;
        let request = Request { modes, tolerance: TOLERANCE, theory, ..Request::default() };
        let solution = solve(&bat, &request)?;
        let wood = self.materials(logs);
        let [mass, balance_point, period] = self.rigid(&bat, &wood);
        let frequencies = self.frequencies(&bat, &solution, &wood);
        Ok(BatObservations { mass, balance_point, period, frequencies })
    }

    fn borders(&self) -> Vec<f64> {
        [Some(0.0), self.split, Some(self.bat.length())].into_iter().flatten().collect()
    }

    fn frequencies(&self, bat: &Bat, solution: &Solution, wood: &[Material; 2]) -> Vec<Slopes> {
        let of = |mode| {
            let (theory, borders) = (solution.theory, self.borders());
            let shares = Shares::of(bat, mode, theory, &borders, |m| wood.contains(m));
            let sum = |parts: &[f64]| parts.iter().sum::<f64>();
            let (bent, sheared) = (sum(&shares.bending), sum(&shares.shear));
            let barrel = |parts: &[f64]| parts.get(1).copied().unwrap_or(0.0);
            let value = mode.frequency();
            let by = [
                bent + sheared,
                sheared,
                -shares.kinetic[0],
                -barrel(&shares.kinetic),
                barrel(&shares.bending) + barrel(&shares.shear),
            ];
            Slopes { value, by: by.map(|share| 0.5 * value * share) }
        };
        solution.modes.iter().map(of).collect()
    }

    /// Mass, balance point and period.
    fn rigid(&self, bat: &Bat, wood: &[Material; 2]) -> [Slopes; 3] {
        let inertia = bat.inertia();
        let (mass, center) = (inertia.mass, inertia.balance_point);
        let (about, arm) = (inertia.about(self.pivot), center - self.pivot);
        let period = TAU * (about / (mass * GRAVITY * arm)).sqrt();
        let [mut of_mass, mut of_center, mut of_period] = [[0.0; UNKNOWNS]; 3];
        for (k, [own, first, turning]) in self.moments(bat, wood).into_iter().enumerate() {
            let by = k + 2;
            of_mass[by] = own;
            of_center[by] = (first - center * own) / mass;
            let moved = (first - self.pivot * own) / (mass * arm);
            of_period[by] = 0.5 * period * (turning / about - moved);
        }
        let slopes = |value, by| Slopes { value, by };
        [slopes(mass, of_mass), slopes(center, of_center), slopes(period, of_period)]
    }

    /// Mass, first moment about the knob end and moment of inertia about the pivot, of the wood of every stretch.
    fn moments(&self, bat: &Bat, wood: &[Material; 2]) -> Vec<[f64; 3]> {
        let (borders, rule) = (self.borders(), gauss(16));
        let mut all = vec![[0.0; 3]; borders.len() - 1];
        for piece in &bat.profile().pieces {
            let layup = bat.layup(piece);
            if !wood.contains(&layup.outer) {
                continue;
            }
            let middle = piece.start + 0.5 * piece.length;
            let stretch = borders[1..].iter().take_while(|end| **end <= middle).count();
            let sums = &mut all[stretch.min(borders.len() - 2)];
            for (s, weight) in &rule {
                let (x, dx) = (piece.start + s * piece.length, weight * piece.length);
                let worth = layup.worth_of_wall(piece.at(*s));
                sums[0] += dx * worth.mass;
                sums[1] += dx * worth.mass * x;
                sums[2] += dx * (worth.mass * (x - self.pivot).powi(2) + worth.turning);
            }
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
        "attachments": [ { "x": "1 in", "mass": "1 oz" } ],
        "profile": { "unit": "in", "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5] } }"#;

    /// Every derivative is that of bats that differ, in one region and in two.
    #[test]
    fn what_a_bat_shows_goes_with_its_wood_as_stated() {
        let bat = Bat::from_text("bat.json", TEXT, "".as_ref()).unwrap();
        for split in [None, Some(0.42)] {
            let wooden = WoodenBat::new(&bat, split, 0.1524).unwrap();
            let at = [0.1, -0.2, 0.05, 0.02, 0.03];
            let here = wooden.shown(&at, 3).unwrap();
            let step = 1e-4;
            for k in 0..if split.is_some() { 5 } else { 3 } {
                let moved = |by: f64| {
                    let mut logs = at;
                    logs[k] += by;
                    wooden.shown(&logs, 3).unwrap()
                };
                let (up, down) = (moved(step), moved(-step));
                let all = |shown: &BatObservations| {
                    let rigid = [shown.mass, shown.balance_point, shown.period];
                    rigid.into_iter().chain(shown.frequencies.clone()).collect::<Vec<_>>()
                };
                for (i, one) in all(&here).into_iter().enumerate() {
                    let slope = (all(&up)[i].value - all(&down)[i].value) / (2.0 * step);
                    let off = (slope - one.by[k]).abs() / one.value;
                    assert!(off < 1e-6, "{split:?} unknown {k} answer {i}: {slope} {}", one.by[k]);
                }
            }
        }
    }
}
