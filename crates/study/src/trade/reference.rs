//! What errors are measured against: the same bat, solved as accurately as can be, twice.

use sweetspot::base::error::Result;
use sweetspot::bat::body::Bat;
use sweetspot::bat::theory::Theory;
use sweetspot::modes::solve::{Request, Solution, Solver, solve};

/// How a bat is discretised and solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Choice {
    /// Degree of the elements' deflection.
    pub degree: usize,
    /// Number of elements.
    pub elements: usize,
    /// How the eigenvalues are found.
    pub solver: Solver,
    /// Unknowns of the assembled matrices.
    pub degrees_of_freedom: usize,
}

impl Choice {
    /// What a solution was found with.
    pub fn of(solution: &Solution) -> Self {
        Self {
            degree: solution.degree,
            elements: solution.mesh.len(),
            solver: solution.solver,
            degrees_of_freedom: solution.degrees_of_freedom(),
        }
    }
}

/// The name that the command line and the files use.
pub fn solver_name(solver: Solver) -> &'static str {
    match solver {
        Solver::Statics => "statics",
        Solver::Dense => "dense",
        Solver::ShiftInvert => "shift-invert",
        Solver::Arpack => "arpack",
    }
}

/// The frequencies of the continuous bat, how they were found and how far they may be trusted.
#[derive(Debug, Clone)]
pub struct Reference {
    /// Angular frequencies of the lowest bending modes (rad/s).
    pub omegas: Vec<f64>,
    /// The beam theory.
    pub theory: Theory,
    /// How they were found.
    pub choice: Choice,
    /// Largest relative error of a frequency by the solution's own estimate.
    pub stated: f64,
    /// Another discretisation, of another degree, solved for confirmation.
    pub other: Choice,
    /// Largest relative difference of a frequency between the two.
    pub agreement: f64,
}

/// The accuracy that is asked of both.
const FINEST: f64 = 1e-13;

impl Reference {
    /// The frequencies of the `modes` lowest bending modes by that theory at a tolerance of 1e-13
    /// or, where that cannot be reached, as near as can be; and again with elements of one degree
    /// more or less.
    ///
    /// # Errors
    ///
    /// As [`solve`].
    pub fn of(bat: &Bat, modes: usize, theory: Theory) -> Result<Self> {
        let request = Request { modes, tolerance: FINEST, theory, ..Request::default() };
        let best = solve(bat, &request)?;
        let degree = if best.degree > 4 { best.degree - 1 } else { best.degree + 1 };
        let other = solve(bat, &Request { degree: Some(degree), ..request })?;
        let omegas = |solution: &Solution| solution.modes.iter().map(|m| m.omega).collect();
        let mut reference = Self {
            omegas: omegas(&best),
            theory,
            choice: Choice::of(&best),
            stated: best.worst(),
            other: Choice::of(&other),
            agreement: 0.0,
        };
        reference.agreement = worst(&reference.errors(&omegas(&other)));
        Ok(reference)
    }

    /// Errors below this are not told from none.
    pub fn floor(&self) -> f64 {
        self.stated.max(self.agreement).max(f64::EPSILON)
    }

    /// Relative error of each of these angular frequencies (rad/s), mode by mode.
    pub fn errors(&self, omegas: &[f64]) -> Vec<f64> {
        omegas.iter().zip(&self.omegas).map(|(got, exact)| (got / exact - 1.0).abs()).collect()
    }
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
        assert!(errors.len() == 8 && worst(&errors) <= reference.floor(), "{errors:?}");
        assert!(reference.floor() < 1e-13);
        assert_ne!(reference.choice.degree, reference.other.degree);
    }

    #[test]
    fn two_discretisations_of_every_bat_agree() {
        for bat in ["cone", "house", "northwestern_aluminium", "r161", "tanh", "torpedo"] {
            let bat = Bat::builtin(bat).unwrap();
            let known = |theory: &Theory| !theory.shears() || bat.knows_shear();
            for theory in Theory::ALL.into_iter().filter(known) {
                let reference = Reference::of(&bat, 5, theory).unwrap();
                let within = reference.agreement <= 3.0 * reference.stated;
                assert!(within && reference.stated < 1e-13, "{}: {reference:?}", bat.name());
            }
        }
    }
}
