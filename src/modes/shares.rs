//! Where along the bat is a mode's energy?
//!
//! [`Shares::of`] a mode gives, for each stretch, the shares of its strain energy in bending and in shear of the wood,
//! and the share of its kinetic energy in the wood. Rayleigh's quotient is stationary in the motion, so these are the
//! derivatives of the frequency by the properties of the stretch:
//!
//! ```text
//! ∂ln f/∂ln E = ½ U_b/U      ∂ln f/∂ln G = ½ U_s/U      ∂ln f/∂ln ρ = −½ T_ρ/T
//! U_b = ∫EI θ′² dx           U_s = ∫κGA (w′ − θ)² dx    T_ρ = ∫ρA w² + ρI θ² dx      U = ω² m,  T = m
//! ```
//!
//! where m is the modal mass. For a free bat of one material the first two add up to ½, and the third is −½.
//!
//! # Source
//!
//! Lord Rayleigh, The Theory of Sound (1877), § 88: first-order changes of a period by Rayleigh's quotient.

use crate::base::gauss;
use crate::bat::{Bat, Material, Theory};
use crate::modes::mode::Mode;

/// Number of points on every smooth piece of shape and section, for the square of a curvature of degree 10 and a
/// section of degree 12.
const POINTS: usize = 17;

/// Shares of a mode's energies, one for each stretch.
#[derive(Debug, Clone, PartialEq)]
pub struct Shares {
    /// Bending of the wood, as a share of the strain energy.
    pub bending: Vec<f64>,
    /// Shear of the wood, as a share of the strain energy; 0 in a theory without shear.
    pub shear: Vec<f64>,
    /// Motion of the wood, as a share of the kinetic energy.
    pub kinetic: Vec<f64>,
}

impl Shares {
    /// The shares of a mode in the stretches between neighbouring `borders` (m, rising). Only walls of a material that
    /// is `wood` count, not cores, sleeves, tape and other fixtures.
    ///
    /// ```
    /// use sweetspot::modes::shares::Shares;
    /// use sweetspot::{Bat, Request, Theory, solve};
    ///
    /// # fn main() -> sweetspot::Result<()> {
    /// # let bat = Bat::builtin("r161")?;
    /// let theory = Theory::Timoshenko;
    /// let solution = solve(&bat, &Request { modes: 1, tolerance: 1e-9, theory, ..Request::default() })?;
    /// let shares = Shares::of(&bat, &solution.modes[0], theory, &[0.0, bat.length()], |_| true);
    /// assert!((shares.bending[0] + shares.shear[0] - 1.0).abs() < 1e-7);
    /// assert!((shares.kinetic[0] - 1.0).abs() < 1e-7);
    /// # Ok(())
    /// # }
    /// ```
    pub fn of(
        bat: &Bat,
        mode: &Mode,
        theory: Theory,
        borders: &[f64],
        wood: impl Fn(&Material) -> bool,
    ) -> Self {
        let stretches = borders.len().saturating_sub(1);
        let zeros = vec![0.0; stretches];
        let mut shares = Self { bending: zeros.clone(), shear: zeros.clone(), kinetic: zeros };
        let ends = smooth(bat, mode, borders);
        let rule = gauss(POINTS);
        let (mass, energy) = (mode.modal_mass, mode.omega.powi(2) * mode.modal_mass);
        for pair in ends.windows(2) {
            let (from, length) = (pair[0], pair[1] - pair[0]);
            let middle = from + 0.5 * length;
            let layup = bat.layup(bat.profile().piece_at(middle));
            let stretch = borders.windows(2).position(|ends| ends[0] <= middle && middle < ends[1]);
            let Some(stretch) = stretch.filter(|_| wood(&layup.outer)) else { continue };
            let places: Vec<f64> = rule.iter().map(|(s, _)| from + s * length).collect();
            let slopes = mode.shape.slopes(&places);
            for ((x, (_, weight)), (.., slope)) in places.iter().zip(&rule).zip(slopes) {
                let worth = layup.worth_of_wall(bat.profile().at(*x));
                let dx = weight * length;
                let (shape, turn) = (&mode.shape, mode.shape.rotation(*x));
                shares.bending[stretch] +=
                    dx * worth.bending * shape.curvature(*x).powi(2) / energy;
                let turning = if theory.turns() { worth.turning * turn * turn } else { 0.0 };
                let moving = worth.mass * shape.deflection(*x).powi(2);
                shares.kinetic[stretch] += dx * (moving + turning) / mass;
                if theory.shears() {
                    shares.shear[stretch] += dx * worth.shear * (slope - turn).powi(2) / energy;
                }
            }
        }
        shares
    }
}

/// Places where sections, shape or stretches have an edge (m), rising.
fn smooth(bat: &Bat, mode: &Mode, borders: &[f64]) -> Vec<f64> {
    let length = bat.length();
    let pieces = bat.profile().borders().into_iter();
    let mut ends: Vec<f64> =
        pieces.chain(mode.shape.borders()).chain(borders.iter().copied()).collect();
    ends.sort_by(f64::total_cmp);
    ends.dedup_by(|b, a| *b - *a < 1e-12 * length);
    ends
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modes::solve::{Request, solve};

    const TEXT: &str = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
        "tapes": [ { "from": 0, "to": "10 in", "mass": "0.7 oz" } ],
        "profile": { "unit": "in", "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5] } }"#;

    /// The shares of two stretches equal the derivatives by the properties of these stretches.
    #[test]
    fn shares_are_the_derivatives_of_the_frequency() {
        let bat = Bat::from_text("bat.json", TEXT, "".as_ref()).unwrap();
        let length = bat.length();
        let own = bat.material().clone();
        let two = |change: &dyn Fn(&mut Material)| {
            let mut other = own.clone();
            change(&mut other);
            bat.with(|parts| {
                let layup = crate::bat::layup::Layup::of(other);
                parts.fixtures.regions =
                    vec![crate::bat::fixtures::Region { from: 0.42, to: length, layup }];
            })
            .unwrap()
        };
        for theory in Theory::ALL {
            let request = Request { modes: 3, tolerance: 1e-11, theory, ..Request::default() };
            let step = 1e-4_f64;
            let slope = |change: &dyn Fn(&mut Material, f64)| {
                let of = |by: f64| solve(&two(&|m| change(m, by)), &request).unwrap();
                let (up, down) = (of(step.exp()), of((-step).exp()));
                let pair = up.modes.iter().zip(&down.modes);
                pair.map(|(a, b)| (a.omega / b.omega).ln() / (2.0 * step)).collect::<Vec<f64>>()
            };
            let bent = slope(&|m, by| m.youngs_modulus *= by);
            let sheared = slope(&|m, by| m.shear_modulus = m.shear_modulus.map(|shear| by * shear));
            let moved = slope(&|m, by| m.density *= by);
            let whole = two(&|_| {});
            let solution = solve(&whole, &request).unwrap();
            for (k, mode) in solution.modes.iter().enumerate() {
                let shares = Shares::of(&whole, mode, theory, &[0.0, 0.42, length], |_| true);
                let near = |a: f64, b: f64| assert!((a - b).abs() < 2e-7, "{theory:?} {k} {a} {b}");
                near(0.5 * shares.bending[1], bent[k]);
                near(0.5 * shares.shear[1], sheared[k]);
                near(-0.5 * shares.kinetic[1], moved[k]);
            }
        }
    }
}
