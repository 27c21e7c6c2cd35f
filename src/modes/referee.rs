//! Which modes do solvers find that factor the assembled stiffness?
//!
//! They are independent checks: choose one by [`Solver`] in [`crate::modes::solve::Request::solver`].

use serde::Serialize;

use crate::base::{Error, Result};
use crate::bat::{Bat, Theory};
use crate::beam::assembly::{Pencil, places};
use crate::beam::element::Element;
use crate::beam::hermite::elements;
use crate::beam::{Depth, Mesh, Motion, Statics};
use crate::eigen::dense;
use crate::eigen::shift_invert::{self, Pairs};

type Sparse = nalgebra_sparse::CscMatrix<f64>;

/// Method for the eigenvalues.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Solver {
    /// Lanczos on the compliance by running sums: any size, round-off of order ε.
    Statics,
    /// Cholesky reduction and a dense eigensolve: small meshes, round-off of order ε n⁴.
    Dense,
    /// Lanczos on a sparsely factored `K + σM`: round-off of order ε n⁴.
    ShiftInvert,
    /// ARPACK on the same matrix, with the cargo feature `arpack`: the independent referee.
    Arpack,
}

/// Most unknowns of a plan for the running sums; a fixed mesh may have more.
const MOST_UNKNOWNS: usize = 1 << 21;
/// The dense solver needs n² memory and n³ time.
pub const MOST_DENSE: usize = 4098;
/// With more unknowns a factored `K` loses digits for good.
const MOST_FACTORED: usize = 20_000;

impl Solver {
    /// The most unknowns of a plan for this solver.
    pub fn most_unknowns(self) -> usize {
        match self {
            Self::Statics => MOST_UNKNOWNS,
            Self::Dense => MOST_DENSE - 2,
            Self::ShiftInvert | Self::Arpack => MOST_FACTORED,
        }
    }
}

/// Modes as scaled strains, one after the other.
#[derive(Debug, Default)]
pub struct Found {
    /// The scaled strains of mode after mode.
    pub strains: Vec<f64>,
    /// Products with the compliance or the inverse; 0 for the dense solver.
    pub steps: usize,
    /// ω (rad/s) of the first mode beyond them, if it was found.
    pub beyond: Option<f64>,
    /// Residual of the iteration for every mode, `‖A v − θ v‖/θ`, without the round-off that [`Motion::residual`]
    /// includes; empty for solvers that factor.
    pub residuals: Vec<f64>,
    /// Number of slowest modes that were removed before the others were found.
    pub apart: usize,
}

/// The `count` lowest bending modes as scaled strains in the order of the statics.
///
/// # Errors
///
/// [`Error::TooLarge`], [`Error::Factorization`], [`Error::NotBuilt`], [`Error::NotConverged`].
pub fn strains<const N: usize, const W: usize>(
    bat: &Bat,
    mesh: &Mesh,
    statics: &Statics<f64, N, W>,
    count: usize,
    solver: Solver,
) -> Result<Found> {
    check(statics, solver)?;
    let elements = elements::<N, W>(bat, mesh, statics.theory);
    let pairs = of_pencil(statics, &elements, count, solver)?;
    let strains = |u: &Vec<f64>| strains_of(statics, &elements, u);
    Ok(Found {
        strains: pairs.vectors.iter().take(count).flat_map(strains).collect(),
        steps: pairs.steps,
        beyond: pairs.values.get(count).map(|value| value.max(0.0).sqrt()),
        residuals: vec![],
        apart: 0,
    })
}

/// Checks that a solver that factors `K` can take that bat on that mesh.
fn check<const N: usize, const W: usize>(
    statics: &Statics<f64, N, W>,
    solver: Solver,
) -> Result<()> {
    if statics.fixed.is_some() {
        let expected = "the solver statics: the others take a bare bat";
        return Err(Error::value("solver", "a bat with attachments, joints or supports", expected));
    }
    match statics.dimension() + 2 {
        found if solver == Solver::Dense && found > MOST_DENSE => {
            Err(Error::TooLarge { most: MOST_DENSE, found })
        }
        _ => Ok(()),
    }
}

/// The `count` lowest bending modes, and the next if there is one, by a solver that factors `K`. [`Solver::Statics`],
/// which factors nothing, is solved by shift-invert here.
fn of_pencil<const N: usize, const W: usize>(
    statics: &Statics<f64, N, W>,
    elements: &[Element<f64, N, W>],
    count: usize,
    solver: Solver,
) -> Result<Pairs> {
    let Pencil { stiffness: k, mass: m } = Pencil::assemble(elements);
    // The rigid motions are found too and dropped: a free bat always has two.
    let (shift, rigid) = (shift(statics), 2);
    let all = count + rigid + usize::from(count + rigid + 1 < k.nrows());
    let mut pairs = match solver {
        Solver::Arpack => arpack(&k, &m, shift, all)?,
        Solver::Dense => {
            let (values, vectors) = dense::lowest(&k, &m, shift, all)?;
            Pairs { values, vectors, ..Pairs::default() }
        }
        Solver::ShiftInvert | Solver::Statics => shift_invert::lowest(&k, &m, shift, all, 1e-12)?,
    };
    pairs.values.drain(..rigid);
    pairs.vectors.drain(..rigid);
    Ok(pairs)
}

#[cfg(feature = "arpack")]
fn arpack(k: &Sparse, m: &Sparse, shift: f64, count: usize) -> Result<Pairs> {
    crate::eigen::arpack::lowest(k, m, shift, count, 1e-12)
}

#[cfg(not(feature = "arpack"))]
fn arpack(_: &Sparse, _: &Sparse, _: f64, _: usize) -> Result<Pairs> {
    Err(Error::NotBuilt {
        what: "the solver arpack",
        advice: "install libarpack2-dev and pkg-config, then build with --features arpack",
    })
}

/// Rayleigh's quotient of the start vector: any shift of the size of the lowest modes is good enough.
fn shift<const N: usize, const W: usize>(statics: &Statics<f64, N, W>) -> f64 {
    let mut start = vec![0.0; statics.dimension()];
    statics.view().start(1, &mut start);
    let mut motion = Motion::default();
    motion.take_alone(statics, &start, &[], Depth::Shape);
    motion.omega.powi(2)
}

/// Scaled strains, in the order of the statics, from the unknowns of the assembled matrices.
fn strains_of<const N: usize, const W: usize>(
    statics: &Statics<f64, N, W>,
    elements: &[Element<f64, N, W>],
    u: &[f64],
) -> Vec<f64> {
    let mut strains = Vec::with_capacity(statics.dimension());
    for (place, cell) in statics.cells.iter().enumerate() {
        let knob_side = place < statics.split;
        let e = if knob_side { statics.split - 1 - place } else { place };
        let own: Vec<f64> = places(W, e).into_iter().map(|at| u[at]).collect();
        let mut c = elements[e].strains_of_hermite(&own);
        if knob_side {
            // Odd polynomials change their sign, and so does the shear strain.
            let (bent, sheared) = c.split_at_mut(N - 2);
            bent.iter_mut().skip(1).step_by(2).for_each(|c| *c = -*c);
            sheared.iter_mut().step_by(2).for_each(|g| *g = -*g);
        }
        strains.extend_from_slice(&cell.scaled_strains(&c)[..W - 2]);
    }
    strains
}

/// The frequencies of the lowest bending modes on a mesh of cubic elements (rad/s), each in two ways: the solver's own
/// eigenvalue, `√λ`, and strain energy over kinetic energy of its shape. A λ below 0 counts as 0. Not for
/// [`Solver::Statics`], where both are the same.
///
/// # Errors
///
/// [`Error::Value`] for a bat that is not bare, [`Error::TooLarge`], [`Error::Factorization`],
/// [`Error::NotBuilt`], [`Error::NotConverged`].
pub fn own_and_recomputed(
    bat: &Bat,
    mesh: &Mesh,
    modes: usize,
    solver: Solver,
    theory: Theory,
) -> Result<Vec<[f64; 2]>> {
    if theory.shears() {
        both_of::<4, 6>(bat, mesh, modes, solver, theory)
    } else {
        both_of::<4, 4>(bat, mesh, modes, solver, theory)
    }
}

fn both_of<const N: usize, const W: usize>(
    bat: &Bat,
    mesh: &Mesh,
    modes: usize,
    solver: Solver,
    theory: Theory,
) -> Result<Vec<[f64; 2]>> {
    let mut statics = Statics::<f64, N, W>::empty(bat, theory);
    statics.assemble(&[bat], &[mesh]);
    check(&statics, solver)?;
    let elements = elements::<N, W>(bat, mesh, theory);
    let pairs = of_pencil(&statics, &elements, modes, solver)?;
    let mut motion = Motion::default();
    let both = pairs.values.iter().zip(&pairs.vectors).take(modes).map(|(value, vector)| {
        motion.take_alone(&statics, &strains_of(&statics, &elements, vector), &[], Depth::Shape);
        [value.max(0.0).sqrt(), motion.omega]
    });
    Ok(both.collect())
}
