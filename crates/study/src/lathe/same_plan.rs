//! What are the modes of a changed bat on the elements of the one before?
//!
//! A difference of two bats is a derivative only if both are solved in the same way: [`SamePlan`] fixes elements,
//! degree and number of modes, so that the error of the mesh cancels in the difference.

use crate::engine::{Bat, Mesh, Plan, Request, Result, Solution, Task, Timing, solve};
use sweetspot::modes::damping::damping;

/// Elements that are kept while the bat is changed.
#[derive(Debug, Clone)]
pub struct SamePlan {
    mesh: Mesh,
    degree: usize,
    request: Request,
}

/// Residual of the eigenpairs, far below the differences of two bats.
const RESIDUAL: f64 = 1e-12;
/// Accuracy of the frequencies from which elements end at every border of the profile's pieces.
const AT_BORDERS: f64 = 9e-10;
/// Higher accuracies cost more without effect.
const FINEST: f64 = 1e-13;

impl SamePlan {
    /// The plan for a bat, with its modes. Shapes are needed to the request's tolerance; the frequencies, whose error
    /// is the square of the shapes', are computed to the square of the tolerance.
    ///
    /// # Errors
    ///
    /// As [`solve`].
    pub fn new(bat: &Bat, request: &Request) -> Result<(Self, Solution)> {
        let tolerance = request.tolerance.powi(2).clamp(FINEST, AT_BORDERS);
        let request = Request { tolerance, ..*request };
        let solution = solve(bat, &request)?;
        // The theory that is chosen for the first bat holds for all.
        let request = Request { theory: solution.theory, ..request };
        let plan = Self { mesh: solution.mesh.clone(), degree: solution.degree, request };
        Ok((plan, solution))
    }

    /// The modes of a bat whose profile has the same borders as the first bat's.
    ///
    /// # Errors
    ///
    /// As [`solve`].
    pub fn solve(&self, bat: &Bat) -> Result<Solution> {
        let mut mesh = Mesh::default();
        mesh.fit(bat, &self.mesh);
        let plan = Plan { mesh, degree: self.degree, ..Plan::default() };
        let (request, mut timing) = (&self.request, Timing::default());
        let task = Task { bat, plan: &plan, request, residual: RESIDUAL };
        let answer = task.run(&mut timing)?;
        let (mut solution, _) = answer.solution(plan, request, timing);
        solution.damping = damping(bat, solution.elements(), &solution.modes, request.tolerance)?;
        Ok(solution)
    }

    /// The modes of another bat on its own elements, to the same accuracy and number.
    ///
    /// # Errors
    ///
    /// As [`solve`].
    pub fn solve_anew(&self, bat: &Bat) -> Result<Solution> {
        solve(bat, &self.request)
    }
}
