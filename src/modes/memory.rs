//! How much memory does a solve take?

use crate::bat::Theory;
use crate::modes::eigenpairs::steps_beyond;
use crate::modes::referee::{MOST_DENSE, Solver};

/// The size of a solve.
#[derive(Debug, Clone, Copy)]
pub struct Work {
    /// Number of elements.
    pub elements: usize,
    /// Degree of their deflection.
    pub degree: usize,
    /// Number of points at which each element is sampled.
    pub points: usize,
    /// Number of modes.
    pub modes: usize,
    /// Number of modes evaluated side by side.
    pub together: usize,
    /// Residual at which the iteration stops.
    pub residual: f64,
    /// The beam theory.
    pub theory: Theory,
    /// How the eigenvalues are found.
    pub solver: Solver,
}

impl Work {
    /// The most memory (GB, 10⁹ bytes) in use at one time; it may be 15 % too low.
    ///
    /// The memory of an element is counted from the program's structures. That of the factoring solvers was measured on
    /// a cone (`tests/memory.rs`) and is an upper bound.
    pub fn gigabytes(&self) -> f64 {
        let small = 3.0 * (self.steps() as f64).powi(2);
        8e-9 * (self.elements as f64 * self.numbers_per_element() + small + self.dense())
    }

    /// Strains of an element.
    fn strains(&self) -> usize {
        (self.degree - 1) * if self.theory.shears() { 2 } else { 1 }
    }

    /// Number of steps if the iteration needs one test more than expected.
    fn steps(&self) -> usize {
        let beyond = steps_beyond(self.theory, self.modes, self.residual);
        self.modes + beyond + 1 + self.modes / 8
    }

    /// Numbers stored for every element.
    fn numbers_per_element(&self) -> f64 {
        let (terms, strains, width) = (self.degree + 1, self.strains(), self.strains() + 2);
        // EI, 1/EI, ρA, ρI, κGA and 1/κGA; deflection, rotation and their changes, and the differences of the shear strain.
        let [sections, motions] = match (self.theory.turns(), self.theory.shears()) {
            (_, true) => [6, 5],
            (true, _) => [4, 4],
            _ => [3, 2],
        };
        let statics = 2 * width * width + 2 * width + 2 + sections * self.points + width;
        let shape = if self.theory.shears() { 2 * terms } else { terms };
        // Evaluated modes: shape, its samples, its strains and their image.
        let one = shape + motions * self.points + 2 * strains + width + 1;
        let motion = self.together * one + 2 * self.points;
        let (basis, vectors) = (self.steps() * strains, self.modes * strains);
        // Place, deflection and change at every point, until the nodes are determined.
        let looked_at = self.modes * (shape + 3 * self.points) + motion;
        // Places, lengths and defects of a mesh and of the one before it.
        const MESH: usize = 24;
        let matrices = if self.solver == Solver::Statics { 0 } else { 20 * width * width };
        (MESH + statics + matrices + vectors + basis.max(looked_at)) as f64
    }

    /// Numbers in square matrices of all unknowns.
    fn dense(&self) -> f64 {
        // Larger problems are refused for their number of unknowns.
        let unknowns = self.strains() as f64 * self.elements as f64 + 2.0;
        let unknowns = unknowns.min(MOST_DENSE as f64);
        if self.solver == Solver::Dense { 11.0 * unknowns * unknowns } else { 0.0 }
    }
}
