//! How many elements the wanted accuracy needs, and how sure the answer is.
//!
//! Every answer is computed on two meshes, one with elements twice as long. Cubic elements err by
//! `(βh)⁴/1440` in a frequency, so the error of the longer ones is 16 times that of the shorter
//! ones, and the difference of the two tells both.

use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::bat::Bat;
use crate::beam::assembly::Pencil;
use crate::beam::element::{self, Element};
use crate::beam::mesh::Mesh;
use crate::beam::statics::Statics;
use crate::eigen::{dense, lanczos};
use crate::error::{Error, Result};
use crate::modes::{Mode, ModeError};

/// How the eigenvalues are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Solver {
    /// Lanczos on the compliance by running sums: any size, round-off of order ε.
    Statics,
    /// Cholesky reduction and a dense eigensolve: small meshes, round-off of order ε n⁴.
    Dense,
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
    pub solver: Solver,
}

impl Default for Request {
    fn default() -> Self {
        Self { modes: 10, tolerance: 1e-4, elements: None, solver: Solver::Statics }
    }
}

/// The modes of a bat, how they were found and how far they may be trusted.
#[derive(Debug, Clone)]
pub struct Solution {
    pub modes: Vec<Mode>,
    /// The same modes on the other mesh of the pair, which the errors are estimated from.
    pub companion: Vec<Mode>,
    /// Error of `modes` as a share of their difference from `companion`.
    pub share: f64,
    pub solver: Solver,
    pub elements: usize,
    /// Elements in each piece of the profile.
    pub counts: Vec<usize>,
    /// Products with the compliance (Lanczos steps); 0 for the dense solver.
    pub steps: usize,
    /// Whether every frequency is within the wanted tolerance by its own estimate.
    pub met: bool,
    pub timing: Timing,
}

impl Solution {
    /// The largest relative error of a frequency, by its own estimate.
    pub fn worst(&self) -> f64 {
        self.modes.iter().map(|mode| mode.error.total()).fold(0.0, f64::max)
    }
}

/// Where the time went.
#[derive(Debug, Clone, Copy, Default)]
pub struct Timing {
    pub plan: Duration,
    pub assemble: Duration,
    pub solve: Duration,
}

/// More elements than this and the answer is given as it is.
const MOST_ELEMENTS: usize = 1 << 18;
/// The dense solver needs n² memory and n³ time.
const MOST_DENSE: usize = 1024;

/// The error of the finer mesh of a pair is 1/15 of the difference if all goes as theory says;
/// 1/8 leaves room for meshes that do not resolve the mode yet.
const FINER_SHARE: f64 = 1.0 / 8.0;
/// The error of the coarser mesh is 16/15 of the difference in theory.
const COARSER_SHARE: f64 = 1.2;

/// Finds the lowest bending modes of a free bat, as accurately as asked.
///
/// # Errors
///
/// [`Error::TooFewElements`] where the asked elements cannot bend in so many ways,
/// [`Error::TooLarge`] for the dense solver, [`Error::NotConverged`]. An accuracy that
/// cannot be reached is no error: the best answer comes back with `met` false.
pub fn solve(bat: &Bat, request: &Request) -> Result<Solution> {
    let started = Instant::now();
    let mut timing = Timing::default();
    if let Some(elements) = request.elements {
        let mesh = Mesh::along(bat, elements);
        let least = request.modes.div_ceil(2);
        if mesh.len() < least {
            return Err(Error::TooFewElements { wanted: request.modes, least, found: mesh.len() });
        }
        // The coarser partner is cheaper, but must resolve the modes too.
        let coarser = mesh.coarser(bat).filter(|coarse| coarse.len() > 4 * request.modes);
        let (other, share) = match coarser {
            Some(coarse) => (coarse, FINER_SHARE),
            None => (mesh.finer(bat), COARSER_SHARE),
        };
        timing.plan = started.elapsed();
        let main = on_mesh(bat, &mesh, request, &mut timing)?;
        let other = on_mesh(bat, &other, request, &mut timing)?;
        return Ok(certified(main, other, share, request, timing));
    }
    let mut mesh = Mesh::along(bat, first_guess(request));
    timing.plan = started.elapsed();
    let mut coarse = on_mesh(bat, &mesh, request, &mut timing)?;
    loop {
        mesh = mesh.finer(bat);
        let fine = on_mesh(bat, &mesh, request, &mut timing)?;
        let solution = certified(fine.clone(), coarse, FINER_SHARE, request, timing);
        if solution.met || 2 * mesh.len() > most_elements(request.solver) {
            return Ok(solution);
        }
        coarse = fine;
    }
}

/// The modes on one mesh, with no estimate of what the mesh costs: half the work of [`solve`].
///
/// # Errors
///
/// As [`solve`].
pub fn uncertified(bat: &Bat, mesh: &Mesh, request: &Request) -> Result<Vec<Mode>> {
    Ok(on_mesh(bat, mesh, request, &mut Timing::default())?.modes)
}

fn most_elements(solver: Solver) -> usize {
    match solver {
        Solver::Statics => MOST_ELEMENTS,
        Solver::Dense => MOST_DENSE,
    }
}

/// Half the elements that `(βh)⁴/1440 = tolerance` asks of a uniform bat's highest mode.
fn first_guess(request: &Request) -> usize {
    let beta_l = (request.modes as f64 + 0.5) * std::f64::consts::PI;
    let enough = beta_l / (1440.0 * request.tolerance).powf(0.25);
    let most = most_elements(request.solver) / 2;
    ((0.6 * enough).ceil() as usize).clamp(request.modes.div_ceil(2).max(2), most)
}

/// Modes on one mesh, before their errors are known.
#[derive(Clone)]
struct Answer {
    modes: Vec<Mode>,
    counts: Vec<usize>,
    elements: usize,
    steps: usize,
}

fn on_mesh(bat: &Bat, mesh: &Mesh, request: &Request, timing: &mut Timing) -> Result<Answer> {
    let started = Instant::now();
    let elements = element::elements(bat, mesh);
    let statics = Statics::new(&elements);
    let assembled = Instant::now();
    timing.assemble += assembled - started;
    let stretches = Arc::new(elements.iter().map(|e| (e.middle, e.length)).collect());
    let (modes, steps) = match request.solver {
        _ if request.modes == 0 => (vec![], 0),
        Solver::Statics => by_statics(&statics, &stretches, request)?,
        Solver::Dense => (by_dense(&elements, &statics, &stretches, request.modes)?, 0),
    };
    timing.solve += assembled.elapsed();
    Ok(Answer { modes, counts: mesh.counts.clone(), elements: elements.len(), steps })
}

fn by_statics(
    statics: &Statics,
    stretches: &Arc<Vec<(f64, f64)>>,
    request: &Request,
) -> Result<(Vec<Mode>, usize)> {
    let mut loads = Vec::new();
    // The eigenvalue's error is the square of the residual; the shape's is the residual itself.
    let residual = (1e-3 * request.tolerance).clamp(1e-13, 1e-7);
    let apply = |x: &[f64], y: &mut [f64]| {
        statics.apply(x, y, &mut loads);
    };
    let ritz = lanczos::largest(statics.start(request.modes), request.modes, residual, apply)?;
    let mut modes: Vec<Mode> = Vec::with_capacity(request.modes);
    for (k, strains) in ritz.vectors.iter().enumerate() {
        let motion = statics.motion(strains, &mut loads);
        let omega = motion.omega;
        let residual = statics.residual(strains, omega, &motion);
        let errors = [residual, statics_round_off(omega, modes.first())];
        modes.push(Mode::new(k + 1, omega, motion, stretches, errors));
    }
    Ok((modes, ritz.steps))
}

/// The running sums keep ε of the slowest motion; a faster mode keeps ε times the ratio of
/// their frequencies (measured on the dowel: 1e-15 for mode 1, 1e-13 for 10, 4e-12 for 60).
fn statics_round_off(omega: f64, first: Option<&Mode>) -> f64 {
    8.0 * f64::EPSILON * (omega / first.map_or(omega, |mode| mode.omega)).max(1.0)
}

fn by_dense(
    elements: &[Element],
    statics: &Statics,
    stretches: &Arc<Vec<(f64, f64)>>,
    count: usize,
) -> Result<Vec<Mode>> {
    if elements.len() > 2 * MOST_DENSE {
        return Err(Error::TooLarge { most: 2 * MOST_DENSE, found: elements.len() });
    }
    let pencil = Pencil::assemble(elements);
    let failed = Error::NotConverged { wanted: count, converged: 0, steps: 0 };
    // Rayleigh's quotient of the start vector: any shift of the size of the lowest modes will do.
    let mut loads = Vec::new();
    let shift = statics.motion(&statics.start(1), &mut loads).omega.powi(2);
    let (values, vectors) =
        dense::generalized(&pencil.stiffness, &pencil.mass, shift).ok_or(failed)?;
    // The first two are the rigid motions, zero but for round-off; a free bat always has two.
    let pairs = values.iter().zip(&vectors).skip(2).take(count).enumerate();
    let modes = pairs.map(|(k, (lambda, vector))| {
        let strains = statics.strains_of_hermite(vector);
        let omega = lambda.max(0.0).sqrt();
        let motion = statics.motion(&strains, &mut loads);
        let residual = statics.residual(&strains, omega, &motion);
        let errors = [residual, dense_round_off(elements, *lambda)];
        Mode::new(k + 1, omega, motion, stretches, errors)
    });
    Ok(modes.collect())
}

/// Factoring `K` leaves an error of ε times its largest entries: `ε λ_max/λ`, with the largest
/// eigenvalue of a mesh, `8400 EI/(ρA h⁴)` of its shortest element (the exact one of a single
/// free cubic element), in the frequency half of that.
fn dense_round_off(elements: &[Element], lambda: f64) -> f64 {
    let greatest =
        elements.iter().map(|e| 8400.0 * e.stiffness[0] / (e.mass[0] * e.length.powi(4)));
    0.5 * f64::EPSILON * greatest.fold(0.0, f64::max) / lambda
}

/// Errors from the difference of two meshes, `share` of it for the one that is reported.
fn certified(
    main: Answer,
    other: Answer,
    share: f64,
    request: &Request,
    timing: Timing,
) -> Solution {
    let mut modes = main.modes;
    for (mode, other) in modes.iter_mut().zip(&other.modes) {
        let relative = |a: f64, b: f64| share * (a / b - 1.0).abs();
        let nodes = mode.nodes.iter().zip(&other.nodes).map(|(a, b)| share * (a - b).abs());
        let node_error = if mode.nodes.len() == other.nodes.len() {
            nodes.fold(0.0, f64::max) + 10.0 * mode.error.round_off / mode.nodes.len() as f64
        } else {
            mode.shape.length()
        };
        mode.error = ModeError {
            discretization: relative(other.omega, mode.omega),
            nodes: node_error,
            modal_mass: relative(other.modal_mass, mode.modal_mass) + 10.0 * mode.error.round_off,
            ..mode.error
        };
    }
    let within =
        |mode: &Mode| mode.error.discretization + mode.error.round_off <= request.tolerance;
    Solution {
        met: modes.iter().all(within),
        modes,
        companion: other.modes,
        share,
        solver: request.solver,
        elements: main.elements,
        counts: main.counts,
        steps: main.steps,
        timing,
    }
}
