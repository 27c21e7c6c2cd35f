//! What are the lowest modes of a bat on a mesh, whatever the degree of its elements?
//!
//! [`pairs_of`] takes degree and theory at run time. Code that uses [`Pairs`] is compiled once; code that steps through
//! the strains is compiled for every degree and theory.

use crate::base::{Lanes, Result};
use crate::bat::{Bat, Theory};
use crate::beam::fixed::Fixed;
use crate::beam::{Depth, Loads, Mesh, Motion, OfDegree, View, of_degree};
use crate::eigen::lanczos::Lanczos;
use crate::modes::eigenpairs::Eigenpairs;
use crate::modes::referee::{self, Found, Solver};

/// Eigenpairs of a bat on elements of any degree and theory.
pub trait Pairs: Send + Sync {
    /// Assembles the bat on that mesh.
    fn assemble(&mut self, bat: &Bat, mesh: &Mesh);
    /// The bat on its mesh.
    fn view(&self) -> View<'_, f64>;
    /// As [`Eigenpairs::solve`].
    ///
    /// # Errors
    ///
    /// As [`Lanczos::largest`].
    fn solve(&mut self, count: usize, residual: f64) -> Result<()>;
    /// As [`Eigenpairs::solve_apart`].
    ///
    /// # Errors
    ///
    /// As [`Lanczos::largest`].
    fn solve_apart(&mut self, residual: f64) -> Result<usize>;
    /// The results of the iteration.
    fn lanczos(&mut self) -> &mut Lanczos<f64>;
    /// The `count` lowest modes by a solver that factors the stiffness.
    ///
    /// # Errors
    ///
    /// As [`referee::strains`].
    fn factored(&self, bat: &Bat, mesh: &Mesh, count: usize, solver: Solver) -> Result<Found>;
    /// As [`Eigenpairs::look_at`].
    fn look_at(&mut self, vectors: &[f64], first: usize, depth: Depth);
    /// The bat on its mesh, and the modes evaluated last, side by side.
    fn looked_at(&self) -> (View<'_, f64>, &Motion<Lanes>);
    /// As [`Motion::take_alone`].
    fn look_at_one(&self, strains: &[f64], known: &[f64], depth: Depth, motion: &mut Motion<f64>);
    /// `y = A q`.
    fn apply(&self, q: &[f64], y: &mut [f64]);
    /// As [`Fixed::under_force`], also for a bare bat.
    fn under_force(&self, cell: usize, s: f64) -> Vec<f64>;
}

impl<const N: usize, const W: usize> Pairs for Eigenpairs<f64, N, W> {
    fn assemble(&mut self, bat: &Bat, mesh: &Mesh) {
        Self::assemble(self, &[bat], &[mesh]);
    }

    fn view(&self) -> View<'_, f64> {
        self.statics.view()
    }

    fn solve(&mut self, count: usize, residual: f64) -> Result<()> {
        Self::solve(self, count, residual)
    }

    fn solve_apart(&mut self, residual: f64) -> Result<usize> {
        Self::solve_apart(self, residual)
    }

    fn lanczos(&mut self) -> &mut Lanczos<f64> {
        &mut self.lanczos
    }

    fn factored(&self, bat: &Bat, mesh: &Mesh, count: usize, solver: Solver) -> Result<Found> {
        referee::strains(bat, mesh, &self.statics, count, solver)
    }

    fn look_at(&mut self, vectors: &[f64], first: usize, depth: Depth) {
        Self::look_at(self, vectors, first, depth);
    }

    fn looked_at(&self) -> (View<'_, f64>, &Motion<Lanes>) {
        (self.statics.view(), &self.motions)
    }

    fn look_at_one(&self, strains: &[f64], known: &[f64], depth: Depth, motion: &mut Motion<f64>) {
        motion.take_alone(&self.statics, strains, known, depth);
    }

    fn apply(&self, q: &[f64], y: &mut [f64]) {
        self.statics.apply(q, y, &mut Loads::default());
    }

    fn under_force(&self, cell: usize, s: f64) -> Vec<f64> {
        let body = self.statics.body();
        match &self.statics.fixed {
            Some(fixed) => fixed.under_force(&body, N, cell, s),
            None => Fixed::nothing().under_force(&body, N, cell, s),
        }
    }
}

/// An empty engine for bats like this one, on elements of that degree.
pub fn pairs_of(bat: &Bat, degree: usize, theory: Theory) -> Box<dyn Pairs> {
    of_degree(degree, theory, Empty { bat, theory })
}

/// Arguments for an empty engine.
struct Empty<'a> {
    bat: &'a Bat,
    theory: Theory,
}

impl OfDegree for Empty<'_> {
    type Output = Box<dyn Pairs>;

    fn with<const N: usize, const W: usize>(self) -> Box<dyn Pairs> {
        Box::new(Eigenpairs::<f64, N, W>::new(self.bat, self.theory))
    }
}
