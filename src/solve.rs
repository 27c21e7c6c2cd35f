//! The modes of a bat, as accurately as asked: plan, solve, look at the error, refine.

use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::bat::Bat;
use crate::beam::assembly::{Pencil, places};
use crate::beam::element::{self, Element};
use crate::beam::mesh::Mesh;
use crate::beam::motion::Motion;
use crate::beam::statics::Statics;
use crate::certificate::{account, add_neighbours};
use crate::eigen::{dense, shift_invert};
use crate::eigenpairs::{Depth, Eigenpairs};
use crate::error::{Error, Result};
use crate::modes::{Mode, Shape};
use crate::plan::Plan;

type Sparse = nalgebra_sparse::CscMatrix<f64>;

/// How the eigenvalues are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Solver {
    /// Lanczos on the compliance by running sums: any size, round-off of order ε.
    Statics,
    /// Cholesky reduction and a dense eigensolve: small meshes, round-off of order ε n⁴.
    Dense,
    /// Lanczos on a sparsely factored `K + σM`: round-off of order ε n⁴.
    ShiftInvert,
    /// ARPACK on the same, behind the cargo feature `arpack`: the outside referee.
    Arpack,
}

/// What is asked of a solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Request {
    /// Number of bending modes.
    pub modes: usize,
    /// Wanted relative accuracy of every frequency; not enforced where `elements` is given.
    pub tolerance: f64,
    /// This many elements, whatever accuracy that gives.
    pub elements: Option<usize>,
    /// Elements of this degree; with `elements` alone it is 3.
    pub degree: Option<usize>,
    pub solver: Solver,
}

impl Default for Request {
    fn default() -> Self {
        Self { modes: 10, tolerance: 1e-4, elements: None, degree: None, solver: Solver::Statics }
    }
}

/// The modes of a bat, how they were found and how far they may be trusted.
#[derive(Debug, Clone)]
pub struct Solution {
    pub modes: Vec<Mode>,
    pub solver: Solver,
    pub mesh: Mesh,
    /// Degree of the elements' deflection.
    pub degree: usize,
    /// Why this mesh and this degree.
    pub reason: String,
    /// Products with the compliance or the inverse (Lanczos steps); 0 for the dense solver.
    pub steps: usize,
    /// Whether every frequency is within the wanted tolerance by its own estimate, and none missing.
    pub met: bool,
    pub timing: Timing,
}

impl Solution {
    /// The largest relative error of a frequency, by its own estimate.
    pub fn worst(&self) -> f64 {
        self.modes.iter().map(|mode| mode.error.total()).fold(0.0, f64::max)
    }

    /// Whether every mode n has the n + 1 nodes that theory demands: then none is missing.
    pub fn complete(&self) -> bool {
        self.modes.iter().all(Mode::has_its_nodes)
    }

    /// Why the wanted tolerance was not met, for a person; empty if it was.
    pub fn shortfall(&self, tolerance: f64) -> String {
        let round_off = self.modes.iter().map(|mode| mode.error.round_off).fold(0.0, f64::max);
        let lost = self.modes.iter().find(|mode| !mode.has_its_nodes());
        match lost {
            _ if self.met => String::new(),
            _ if round_off > tolerance => format!("round-off alone is {round_off:.1e}"),
            Some(mode) => format!(
                "mode {} has {} nodes, not {}: two frequencies are too near each other to tell \
                 their shapes apart, or a mode is missing",
                mode.order,
                mode.nodes.len(),
                mode.order + 1
            ),
            None => "further refinement gained nothing or grew too large".to_owned(),
        }
    }

    /// Unknowns of the assembled matrices.
    pub fn degrees_of_freedom(&self) -> usize {
        (self.degree - 1) * self.mesh.len() + 2
    }
}

/// Where the time went.
#[derive(Debug, Clone, Copy, Default)]
pub struct Timing {
    pub plan: Duration,
    pub assemble: Duration,
    pub solve: Duration,
}

/// More unknowns than this and the answer is given as it is.
const MOST_UNKNOWNS: usize = 1 << 21;
/// The dense solver needs n² memory and n³ time.
pub const MOST_DENSE: usize = 4098;
/// Beyond this a factored `K` has lost all digits.
const MOST_FACTORED: usize = 20_000;
/// Residual of an eigenpair that is as good as arithmetic allows.
const CONVERGED: f64 = 1e-13;
/// Refinements before the answer is given as it is.
const MOST_ROUNDS: usize = 12;

/// Finds the lowest bending modes of a free bat, as accurately as asked.
///
/// # Errors
///
/// [`Error::TooFewElements`] where the asked elements cannot bend in so many ways,
/// [`Error::TooLarge`] for the dense solver, [`Error::Factorization`] for those that factor `K`,
/// [`Error::NotBuilt`] without ARPACK, [`Error::NotConverged`]. An accuracy that
/// cannot be reached is no error: the best answer comes back with `met` false.
pub fn solve(bat: &Bat, request: &Request) -> Result<Solution> {
    let started = Instant::now();
    let mut timing = Timing::default();
    let mut plan = match request.elements {
        Some(elements) => Plan::fixed(bat, elements, request.degree.unwrap_or(3)),
        None => Plan::cheapest(bat, request.modes, request.tolerance, request.degree),
    };
    timing.plan = started.elapsed();
    let unknowns = |plan: &Plan| (plan.degree - 1) * plan.mesh.len();
    if unknowns(&plan) < request.modes {
        let least = request.modes.div_ceil(plan.degree - 1);
        let found = plan.mesh.len();
        return Err(Error::TooFewElements { wanted: request.modes, least, found });
    }
    let mut best: Option<Solution> = None;
    let mut residual = stop_at(request);
    for round in 0..MOST_ROUNDS {
        let answer = on_mesh(bat, &plan, request, residual, &mut timing)?;
        let again = request.solver == Solver::Statics && residual > CONVERGED;
        if again && !answer.modes.iter().all(Mode::has_its_nodes) {
            // Two modes of nearly one frequency mix, or one is missing: iterate to the end.
            residual = CONVERGED;
            continue;
        }
        let (solution, defects) = answer.solution(plan, request, timing);
        let gain = best.as_ref().map_or(0.0, |best| solution.worst() / best.worst());
        let floor = solution.modes.iter().map(|mode| mode.error.round_off).fold(0.0, f64::max);
        let done = solution.met
            || request.elements.is_some()
            || floor > request.tolerance
            || (round > 2 && gain > 0.7);
        let next = (!done).then(|| {
            let plan =
                Plan { mesh: solution.mesh.clone(), degree: solution.degree, ..Plan::default() };
            plan.refined(&defects, request.tolerance, request.degree.is_none())
        });
        if best.is_none() || gain < 1.0 {
            best = Some(solution);
        }
        match next {
            Some(next) if unknowns(&next) <= most_unknowns(request.solver) => plan = next,
            _ => break,
        }
    }
    Ok(best.expect("there was a round"))
}

/// The most accurate answer that a time allows: one digit after the other, until the next would
/// take too long by the time that the last took. The first digit is given in any case, `met` false
/// if it took longer.
///
/// # Errors
///
/// As [`solve`].
pub fn solve_within(bat: &Bat, request: &Request, budget: Duration) -> Result<Solution> {
    let started = Instant::now();
    let mut best: Option<Solution> = None;
    for digits in 1..=14 {
        let begun = Instant::now();
        let solution =
            solve(bat, &Request { tolerance: 10f64.powi(-digits), elements: None, ..*request })?;
        let (last, spent) = (begun.elapsed(), started.elapsed());
        let better = best.as_ref().is_none_or(|best| solution.worst() < best.worst());
        let over = spent + last + last / 2 > budget || !solution.met;
        if better && (spent <= budget || best.is_none()) {
            best = Some(Solution { met: spent <= budget && solution.complete(), ..solution });
        }
        if over {
            break;
        }
    }
    let mut best = best.expect("there was a first digit");
    best.reason = format!("the most accurate within {budget:?}");
    Ok(best)
}

fn most_unknowns(solver: Solver) -> usize {
    match solver {
        Solver::Statics => MOST_UNKNOWNS,
        Solver::Dense => MOST_DENSE - 2,
        Solver::ShiftInvert | Solver::Arpack => MOST_FACTORED,
    }
}

/// Modes on one mesh.
struct Answer {
    modes: Vec<Mode>,
    steps: usize,
    /// Each element's part in the worst mode's defect.
    defects: Vec<f64>,
}

impl Answer {
    /// The solution, and each element's part in its worst defect.
    fn solution(self, plan: Plan, request: &Request, timing: Timing) -> (Solution, Vec<f64>) {
        let within = |mode: &Mode| mode.error.total() <= request.tolerance && mode.has_its_nodes();
        let solution = Solution {
            met: self.modes.iter().all(within),
            modes: self.modes,
            solver: request.solver,
            mesh: plan.mesh,
            degree: plan.degree,
            reason: plan.reason,
            steps: self.steps,
            timing,
        };
        (solution, self.defects)
    }
}

/// The modes on one mesh, whatever accuracy that gives.
fn on_mesh(
    bat: &Bat,
    plan: &Plan,
    request: &Request,
    residual: f64,
    timing: &mut Timing,
) -> Result<Answer> {
    match plan.degree {
        3 => of_degree::<4>(bat, plan, request, residual, timing),
        4 => of_degree::<5>(bat, plan, request, residual, timing),
        5 => of_degree::<6>(bat, plan, request, residual, timing),
        6 => of_degree::<7>(bat, plan, request, residual, timing),
        7 => of_degree::<8>(bat, plan, request, residual, timing),
        8 => of_degree::<9>(bat, plan, request, residual, timing),
        9 => of_degree::<10>(bat, plan, request, residual, timing),
        10 => of_degree::<11>(bat, plan, request, residual, timing),
        11 => of_degree::<12>(bat, plan, request, residual, timing),
        _ => of_degree::<13>(bat, plan, request, residual, timing),
    }
}

fn of_degree<const N: usize>(
    bat: &Bat,
    plan: &Plan,
    request: &Request,
    residual: f64,
    timing: &mut Timing,
) -> Result<Answer> {
    let started = Instant::now();
    let mut pairs = Eigenpairs::<f64, N>::new(bat);
    pairs.assemble(&[bat], &[&plan.mesh]);
    let assembled = Instant::now();
    timing.assemble += assembled - started;
    let (strains, steps) = match request.solver {
        _ if request.modes == 0 => (vec![], 0),
        Solver::Statics => {
            match Moments::of(bat, plan, request)? {
                Some(coarse) => {
                    pairs.solve_from(request.modes, residual, |places| coarse.at(places))?;
                }
                None => pairs.solve(request.modes, residual)?,
            }
            let lanczos = std::mem::take(&mut pairs.lanczos);
            (lanczos.vectors, lanczos.steps)
        }
        solver => by_pencil(bat, plan, &pairs.statics, request.modes, solver)?,
    };
    let stretches = Arc::new(plan.mesh.stretches());
    let missed = |e| element::missed(bat, e, pairs.statics.rule);
    let missed = plan.mesh.elements.iter().map(missed).fold(0.0, f64::max);
    // On a mesh so fine the shapes change by round-off only.
    let large = pairs.statics.dimension() > LARGE;
    let depth = if large { Depth::Defect } else { Depth::Changes };
    let factored = request.solver != Solver::Statics;
    let mut modes: Vec<Mode> = Vec::with_capacity(request.modes);
    let mut defects = vec![0.0; plan.mesh.len()];
    for (k, strains) in strains.chunks_exact(pairs.statics.dimension()).enumerate() {
        pairs.look_at(strains, depth);
        let (statics, motion) = (&pairs.statics, &pairs.motion);
        let mut mode = Mode::new(k + 1, statics, motion, 0, &stretches);
        mode.error.discretization += missed;
        account(&mut mode, modes.first(), plan.mesh.len(), factored);
        motion.add_defects(statics, &mut defects);
        modes.push(mode);
    }
    add_neighbours(&mut modes, factored);
    timing.solve += assembled.elapsed();
    Ok(Answer { modes, steps, defects })
}

/// Beyond so many unknowns the iteration starts from a coarse solution.
const LARGE: usize = 20_000;

/// Bending moments of all wanted modes together, from a coarse solution: a start from which the
/// iteration needs as many steps as there are modes and hardly more.
struct Moments {
    bat: Bat,
    /// The sum of the shapes, each with the same strain energy.
    sum: Shape,
}

impl Moments {
    /// None where the mesh is not large or not the user's own, or where a coarse one would be
    /// large too: that of a bat of many stations.
    fn of(bat: &Bat, plan: &Plan, request: &Request) -> Result<Option<Self>> {
        let asked = request.elements.is_some();
        let request = Request { tolerance: 1e-12, elements: None, degree: None, ..*request };
        let large = |plan: &Plan| (plan.degree - 1) * plan.mesh.len() > LARGE;
        let stations = bat.profile.pieces.len() > LARGE;
        if !asked || stations || !large(plan) {
            return Ok(None);
        }
        if large(&Plan::cheapest(bat, request.modes, request.tolerance, None)) {
            return Ok(None);
        }
        let coarse = solve(bat, &request)?;
        let scale = |mode: &Mode| 1.0 / (mode.omega * mode.modal_mass.sqrt());
        let parts: Vec<_> = coarse.modes.iter().map(|mode| (scale(mode), &mode.shape)).collect();
        Ok(Some(Self { bat: bat.clone(), sum: Shape::sum(&parts) }))
    }

    /// From places, 0 to 1 along the bat, to the moments there.
    fn at(&self, places: &mut [f64]) {
        let length = self.bat.length();
        for place in places {
            let x = *place * length;
            let stiffness = self.bat.bending_stiffness(self.bat.profile.at(x));
            *place = stiffness * self.sum.curvature(x);
        }
    }
}

/// The residual to stop the eigensolve at: its part of the error is then small beside the mesh's.
/// The eigenvalue's is the square of the residual, the shape's is the residual itself.
pub fn stop_at(request: &Request) -> f64 {
    match request.elements {
        Some(_) => 1e-10,
        None => (0.1 * request.tolerance.powf(0.75)).clamp(CONVERGED, 1e-3),
    }
}

/// The other solvers: eigenvectors of the assembled matrices, as scaled strains.
fn by_pencil<const N: usize>(
    bat: &Bat,
    plan: &Plan,
    statics: &Statics<f64, N>,
    count: usize,
    solver: Solver,
) -> Result<(Vec<f64>, usize)> {
    let elements = element::elements::<N>(bat, &plan.mesh);
    let pairs = of_pencil(statics, &elements, count, solver)?;
    let strains = |u: &Vec<f64>| strains_of(statics, &elements, u);
    Ok((pairs.vectors.iter().flat_map(strains).collect(), pairs.steps))
}

/// What a solver makes of the assembled matrices.
struct Pairs {
    /// Its own λ = ω² (1/s²), rising.
    values: Vec<f64>,
    vectors: Vec<Vec<f64>>,
    steps: usize,
}

/// The `count` lowest bending modes by a solver that factors `K`; for the statics, which factors
/// nothing, by shift-invert.
fn of_pencil<const N: usize>(
    statics: &Statics<f64, N>,
    elements: &[Element<f64, N>],
    count: usize,
    solver: Solver,
) -> Result<Pairs> {
    let unknowns = statics.dimension() + 2;
    if solver == Solver::Dense && unknowns > MOST_DENSE {
        return Err(Error::TooLarge { most: MOST_DENSE, found: unknowns });
    }
    let Pencil { stiffness: k, mass: m } = Pencil::assemble(elements);
    let (shift, all) = (shift(statics), count + 2);
    let mut pairs = match solver {
        Solver::Arpack => arpack(&k, &m, shift, all)?,
        Solver::Dense => {
            let failed = Error::NotConverged { wanted: count, converged: 0, steps: 0 };
            let (values, vectors) = dense::generalized(&k, &m, shift).ok_or(failed)?;
            Pairs { values, vectors, steps: 0 }
        }
        Solver::ShiftInvert | Solver::Statics => {
            shift_invert::lowest(&k, &m, shift, all, 1e-12)?.into()
        }
    };
    // The rigid motions are found too, and left: a free bat always has two.
    pairs.values = pairs.values.drain(2..all.min(pairs.values.len())).collect();
    pairs.vectors = pairs.vectors.drain(2..all.min(pairs.vectors.len())).collect();
    Ok(pairs)
}

impl From<shift_invert::Pairs> for Pairs {
    fn from(pairs: shift_invert::Pairs) -> Self {
        Self { values: pairs.values, vectors: pairs.vectors, steps: pairs.steps }
    }
}

#[cfg(feature = "arpack")]
fn arpack(k: &Sparse, m: &Sparse, shift: f64, count: usize) -> Result<Pairs> {
    Ok(crate::eigen::arpack::lowest(k, m, shift, count, 1e-12)?.into())
}

#[cfg(not(feature = "arpack"))]
fn arpack(_: &Sparse, _: &Sparse, _: f64, _: usize) -> Result<Pairs> {
    Err(Error::NotBuilt {
        what: "the solver arpack",
        advice: "install libarpack2-dev and pkg-config, then build with --features arpack",
    })
}

/// Rayleigh's quotient of the start vector: any shift of the size of the lowest modes will do.
fn shift<const N: usize>(statics: &Statics<f64, N>) -> f64 {
    let mut start = vec![0.0; statics.dimension()];
    statics.start(1, &mut start);
    let mut motion = Motion::default();
    motion.take(statics, &start, None, false);
    motion.omega.powi(2)
}

/// Scaled strains, in the order of the statics, of the unknowns of the assembled matrices.
fn strains_of<const N: usize>(
    statics: &Statics<f64, N>,
    elements: &[Element<f64, N>],
    u: &[f64],
) -> Vec<f64> {
    let mut strains = Vec::with_capacity(statics.dimension());
    for (place, cell) in statics.cells.iter().enumerate() {
        let knob_side = place < statics.split;
        let e = if knob_side { statics.split - 1 - place } else { place };
        let own = places::<N>(e).map(|at| u[at]);
        let mut c = elements[e].strains_of_hermite(&own);
        if knob_side {
            c.iter_mut().skip(1).step_by(2).for_each(|c| *c = -*c);
        }
        strains.extend_from_slice(&cell.scaled_strains(&c)[..N - 2]);
    }
    strains
}

/// The frequencies of the lowest bending modes on a mesh of cubic elements, each as the solver's
/// own eigenvalue gives it, `√λ`, and recomputed from its shape as strain energy over kinetic
/// energy (both rad/s). A λ below 0 counts as 0. Not for [`Solver::Statics`], which has one answer
/// only.
///
/// # Errors
///
/// As [`solve`].
pub fn own_and_recomputed(
    bat: &Bat,
    mesh: &Mesh,
    modes: usize,
    solver: Solver,
) -> Result<Vec<[f64; 2]>> {
    let mut statics = Statics::<f64, 4>::empty(bat);
    statics.assemble(&[bat], &[mesh]);
    let elements = element::elements::<4>(bat, mesh);
    let pairs = of_pencil(&statics, &elements, modes, solver)?;
    let mut motion = Motion::default();
    let both = pairs.values.iter().zip(&pairs.vectors).map(|(value, vector)| {
        motion.take(&statics, &strains_of(&statics, &elements, vector), None, false);
        [value.max(0.0).sqrt(), motion.omega]
    });
    Ok(both.collect())
}
