//! What is asked of a solution, and is it possible?

use crate::base::{Error, Result, WIDTH};
use crate::bat::{Bat, Theory};
use crate::beam::{DEGREES, Rule};
use crate::modes::memory::Work;
use crate::modes::plan::{Plan, Wanted};
use crate::modes::referee::Solver;

/// The request for a solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Request {
    /// Number of bending modes.
    pub modes: usize,
    /// Wanted relative accuracy of every frequency; not enforced if `elements` is given.
    pub tolerance: f64,
    /// Fixed number of elements, whatever accuracy that gives; `None` plans it from the tolerance.
    pub elements: Option<usize>,
    /// Fixed degree of the elements; `None` plans it, or takes 3 if `elements` is given.
    pub degree: Option<usize>,
    /// Method for the eigenvalues.
    pub solver: Solver,
    /// The beam theory; [`Theory::Auto`] leaves it to [`crate::modes::theory_choice::theory`].
    pub theory: Theory,
}

impl Default for Request {
    fn default() -> Self {
        Self {
            modes: 10,
            tolerance: 1e-4,
            elements: None,
            degree: None,
            solver: Solver::Statics,
            theory: Theory::Auto,
        }
    }
}

impl Request {
    /// The default request with Euler and Bernoulli's beam.
    pub fn plain() -> Self {
        Self { theory: Theory::EulerBernoulli, ..Self::default() }
    }

    /// Checks that this request is possible for `bats` bats side by side.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for an invalid tolerance, degree or element count, for too many modes, and
    /// for a mesh that would not fit into memory.
    pub fn check(&self, bats: usize) -> Result<()> {
        if self.modes > MOST_MODES {
            return Err(Error::value("modes", self.modes, format!("0 to {MOST_MODES}")));
        }
        if !(self.tolerance > 0.0 && self.tolerance < 1.0) {
            let expected = "a number between 0 and 1, such as 1e-6";
            return Err(Error::value("tolerance", self.tolerance, expected));
        }
        if let Some(degree) = self.degree.filter(|degree| !DEGREES.contains(degree)) {
            return Err(Error::value("degree", degree, "3 to 12"));
        }
        let Some(elements) = self.elements else { return Ok(()) };
        if elements == 0 {
            return Err(Error::value("elements", 0, "1 or more"));
        }
        let degree = self.degree.unwrap_or(3);
        // For cubic radii; a formula takes more points, which is checked when the bat is known.
        let work = self.work(elements, degree, degree + 5);
        self.check_memory(bats as f64 * work.gigabytes(), elements)
    }

    /// The work of an element of that degree, sampled at the given number of points.
    fn work(&self, elements: usize, degree: usize, points: usize) -> Work {
        let Self { modes, theory, solver, .. } = *self;
        let strains = (degree - 1) * if theory.shears() { 2 } else { 1 };
        let together = if elements > LARGE / strains { AT_ONCE } else { WIDTH };
        let residual = stop_at(self);
        Work { elements, degree, points, modes, together, residual, theory, solver }
    }

    /// The memory (GB) for that plan of the bat.
    pub fn memory(&self, bat: &Bat, plan: &Plan) -> f64 {
        let points = Rule::of(bat, plan.mesh.over_stations(), plan.degree).count();
        self.work(plan.mesh.len(), plan.degree, points).gigabytes()
    }

    /// The reason why a refinement to that plan is impossible with this solver and memory; `None` if it is possible.
    pub fn too_large(&self, bat: &Bat, plan: &Plan) -> Option<String> {
        let (unknowns, gigabytes) = (plan.unknowns(), self.memory(bat, plan));
        let fits = unknowns <= self.solver.most_unknowns() && gigabytes <= MOST_GIGABYTES;
        let said = || format!("a refinement would take {unknowns} unknowns and {gigabytes:.1} GB");
        (!fits).then(said)
    }

    /// Checks that the given number of elements fits into memory.
    pub fn check_memory(&self, gigabytes: f64, elements: usize) -> Result<()> {
        if gigabytes <= MOST_GIGABYTES {
            return Ok(());
        }
        let field = if self.elements.is_some() { "elements" } else { "modes" };
        let found = match self.elements {
            Some(_) => format!("{elements} with {} modes, {gigabytes:.0} GB", self.modes),
            None => format!("{} on {elements} elements, {gigabytes:.0} GB", self.modes),
        };
        let expected = format!("what fits into {MOST_GIGABYTES} GB: fewer elements or modes");
        Err(Error::value(field, found, expected))
    }
}

/// Upper limit on requested modes; beam theory has no meaning beyond it.
pub const MOST_MODES: usize = 400;
/// A mesh that needs more memory is refused.
const MOST_GIGABYTES: f64 = 8.0;
/// The smallest residual of an eigenpair that arithmetic allows.
pub const CONVERGED: f64 = 1e-13;
/// With more unknowns than this, modes are evaluated one by one, not side by side.
pub const LARGE: usize = 20_000;
/// Number of modes of a large mesh that are evaluated at a time, each by its own thread: evaluating more would take
/// about as much memory as the mesh itself.
pub const AT_ONCE: usize = 2;

/// The request to the planner.
pub fn wanted(request: &Request) -> Wanted {
    Wanted {
        modes: request.modes,
        tolerance: request.tolerance,
        degree: request.degree,
        most_unknowns: request.solver.most_unknowns(),
        theory: request.theory,
    }
}

/// The residual at which the eigensolver stops, small enough that its error is small beside the mesh's. The error of
/// the eigenvalue is the square of the residual, that of the shape the residual itself. `examples/tuning/plans.rs`
/// prints the error with this residual and with the smallest: they agree to three digits.
pub fn stop_at(request: &Request) -> f64 {
    match request.elements {
        Some(_) => 1e-10,
        None => (0.1 * request.tolerance.powf(0.75)).clamp(CONVERGED, 1e-3),
    }
}
