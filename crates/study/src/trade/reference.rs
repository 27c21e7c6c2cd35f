//! The reference for errors: the same bat, solved two times, each time as accurately as possible.

use std::f64::consts::TAU;

use serde::{Serialize, Serializer};

use crate::engine::{Bat, Request, Solution, Solver, Theory, error, solve};

/// A mesh and the solver for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, schemars::JsonSchema)]
pub struct Choice {
    /// Degree of the elements' deflection.
    pub degree: usize,
    /// Number of elements.
    pub elements: usize,
    /// Method for the eigenvalues.
    #[serde(serialize_with = "by_name")]
    #[schemars(with = "String", extend("enum" = SOLVERS.map(solver_name)))]
    pub solver: Solver,
    /// Unknowns of the assembled matrices.
    pub degrees_of_freedom: usize,
}

impl Choice {
    /// The choices of a solution.
    pub fn of(solution: &Solution) -> Self {
        Self {
            degree: solution.degree,
            elements: solution.mesh.len(),
            solver: solution.solver,
            degrees_of_freedom: solution.degrees_of_freedom(),
        }
    }
}

/// Every solver, in the order in which they are listed.
pub const SOLVERS: [Solver; 4] =
    [Solver::Statics, Solver::Dense, Solver::ShiftInvert, Solver::Arpack];

/// The name that the command line and the files use.
pub fn solver_name(solver: Solver) -> &'static str {
    match solver {
        Solver::Statics => "statics",
        Solver::Dense => "dense",
        Solver::ShiftInvert => "shift-invert",
        Solver::Arpack => "arpack",
    }
}

/// Writes a solver as files have it.
pub(crate) fn by_name<S: Serializer>(solver: &Solver, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(solver_name(*solver))
}

/// The reference frequencies, and their accuracy.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Reference {
    /// The choices.
    #[serde(flatten)]
    pub choice: Choice,
    /// Beam theory.
    #[schemars(with = "String", extend("enum" = Theory::ALL.map(Theory::name)))]
    pub theory: Theory,
    /// Frequency of each mode (Hz).
    pub frequencies_hz: Vec<f64>,
    /// Angular frequencies of the same modes (rad/s).
    #[serde(skip)]
    pub omegas: Vec<f64>,
    /// Largest error of a frequency by the solution's own estimate.
    pub stated_error: f64,
    /// Smaller errors cannot be distinguished from 0.
    pub floor: f64,
    /// Another discretisation, solved for confirmation.
    pub confirmed_by: Confirmation,
}

/// Another discretisation.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Confirmation {
    /// Its mesh and its solver.
    #[serde(flatten)]
    pub choice: Choice,
    /// Largest difference of a frequency from the reference.
    pub agreement: f64,
}

/// The requested accuracy of both.
const FINEST: f64 = 1e-13;

impl Reference {
    /// The frequencies of the `modes` lowest bending modes by that theory at a tolerance of 1e-13, or as close to it as
    /// possible; and again with elements of one degree more or less.
    ///
    /// # Errors
    ///
    /// As [`solve`].
    pub fn of(bat: &Bat, modes: usize, theory: Theory) -> error::Result<Self> {
        let request = Request { modes, tolerance: FINEST, theory, ..Request::default() };
        let best = solve(bat, &request)?;
        let degree = if best.degree > 4 { best.degree - 1 } else { best.degree + 1 };
        let other = solve(bat, &Request { degree: Some(degree), ..request })?;
        let [omegas, others] = [&best, &other]
            .map(|solution| solution.modes.iter().map(|m| m.omega).collect::<Vec<f64>>());
        let (stated_error, agreement) = (best.worst(), worst(&errors(&others, &omegas)));
        Ok(Self {
            choice: Choice::of(&best),
            theory,
            frequencies_hz: omegas.iter().map(|omega| omega / TAU).collect(),
            omegas,
            stated_error,
            floor: stated_error.max(agreement).max(f64::EPSILON),
            confirmed_by: Confirmation { choice: Choice::of(&other), agreement },
        })
    }

    /// Relative error of each of these angular frequencies (rad/s), mode by mode.
    pub fn errors(&self, omegas: &[f64]) -> Vec<f64> {
        errors(omegas, &self.omegas)
    }
}

fn errors(omegas: &[f64], exact: &[f64]) -> Vec<f64> {
    omegas.iter().zip(exact).map(|(got, exact)| (got / exact - 1.0).abs()).collect()
}

/// The largest of these errors.
pub fn worst(errors: &[f64]) -> f64 {
    errors.iter().copied().fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use sweetspot::beam::dowel::{Dowel, Ends};

    #[test]
    fn the_reference_of_the_dowel_is_its_closed_form() {
        let bat = Bat::builtin("dowel").unwrap();
        let dowel = Dowel {
            length: bat.length(),
            radius: bat.profile().at(0.0).outer,
            youngs_modulus: bat.material().youngs_modulus,
            density: bat.material().density,
        };
        let reference = Reference::of(&bat, 8, Theory::EulerBernoulli).unwrap();
        let exact: Vec<f64> = (1..=8).map(|n| dowel.omega(Ends::FreeFree, n)).collect();
        let errors = reference.errors(&exact);
        assert!(errors.len() == 8 && worst(&errors) <= reference.floor, "{errors:?}");
        assert!(reference.floor < 1e-13);
        assert_ne!(reference.choice.degree, reference.confirmed_by.choice.degree);
    }

    #[test]
    fn two_discretisations_of_every_bat_agree() {
        for bat in ["cone", "house", "northwestern_aluminium", "r161", "tanh", "torpedo"] {
            let bat = Bat::builtin(bat).unwrap();
            let known = |theory: &Theory| !theory.shears() || bat.knows_shear();
            for theory in Theory::ALL.into_iter().filter(known) {
                let reference = Reference::of(&bat, 5, theory).unwrap();
                let within = reference.confirmed_by.agreement <= 3.0 * reference.stated_error;
                assert!(within && reference.stated_error < 1e-13, "{}: {reference:?}", bat.name());
            }
        }
    }
}
