//! What are the modes of a bat, as accurately as asked?
//!
//! [`solve`](fn@solve) plans, solves, looks at the errors and refines; [`solve_within`] takes a
//! time instead of an accuracy. A [`Request`] says what is wanted, a [`Solution`] what was found
//! and how far to trust it.

use std::sync::Arc;
use std::time::Duration;

use crate::base::clock::Clock;
use crate::base::error::{Error, Result};
use crate::base::lanes::WIDTH;
use crate::bat::body::Bat;
use crate::bat::theory::Theory;
use crate::beam::changes::Depth;
use crate::beam::count;
use crate::beam::degree::{OfDegree, of_degree};
use crate::beam::sections;
use crate::beam::mesh::Mesh;
use crate::beam::motion::Motion;
use crate::beam::rule::{DEGREES, Rule};
use crate::beam::statics::Statics;
use crate::eigen::lanczos::Lanczos;
use crate::modes::certificate::{account, add_neighbours, add_sections, is_twin};
use crate::modes::damping::{Damping, damping};
use crate::modes::eigenpairs::Eigenpairs;
use crate::modes::memory::Work;
use crate::modes::mode::{Mode, Shape};
use crate::modes::plan::{Plan, Reason, Wanted};
use crate::modes::referee::{self, Found};

pub use crate::modes::referee::{MOST_DENSE, Solver, own_and_recomputed};

/// What is asked of a solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Request {
    /// Number of bending modes.
    pub modes: usize,
    /// Wanted relative accuracy of every frequency; not enforced where `elements` is given.
    pub tolerance: f64,
    /// Fixed number of elements, whatever accuracy that gives; None plans it from the tolerance.
    pub elements: Option<usize>,
    /// Fixed degree of the elements; None plans it, or takes 3 where `elements` is given.
    pub degree: Option<usize>,
    /// How the eigenvalues are found.
    pub solver: Solver,
    /// The beam theory; [`crate::study::theory_choice::theory`] chooses one.
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
            theory: Theory::EulerBernoulli,
        }
    }
}

impl Request {
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
        // Cubic radii; a formula takes more points, which is looked at when the bat is known.
        let work = self.work(elements, degree, degree + 5);
        self.check_memory(bats as f64 * work.gigabytes(), elements)
    }

    /// Elements of that degree, sampled at so many points, as work.
    fn work(&self, elements: usize, degree: usize, points: usize) -> Work {
        let Self { modes, theory, solver, .. } = *self;
        let strains = (degree - 1) * if theory.shears() { 2 } else { 1 };
        let together = if elements > LARGE / strains { 1 } else { WIDTH };
        let residual = stop_at(self);
        Work { elements, degree, points, modes, together, residual, theory, solver }
    }

    /// The memory (GB) that a plan for the bat takes.
    fn memory(&self, bat: &Bat, plan: &Plan) -> f64 {
        let points = Rule::of(bat, plan.degree).count();
        self.work(plan.mesh.len(), plan.degree, points).gigabytes()
    }

    /// Whether so many elements fit into memory.
    fn check_memory(&self, gigabytes: f64, elements: usize) -> Result<()> {
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

/// The modes of a bat, how they were found and how far they may be trusted.
#[derive(Debug, Clone)]
pub struct Solution {
    /// The bending modes, by rising frequency.
    pub modes: Vec<Mode>,
    /// How many motions of the bat are rigid, at frequency 0.
    pub rigid_modes: usize,
    /// How the eigenvalues were found.
    pub solver: Solver,
    /// The beam theory.
    pub theory: Theory,
    /// The elements.
    pub mesh: Mesh,
    /// Degree of the elements' deflection.
    pub degree: usize,
    /// Why this mesh and this degree.
    pub reason: Reason,
    /// Products with the compliance or the inverse (Lanczos steps); 0 for the dense solver.
    pub steps: usize,
    /// Whether every frequency is within the wanted tolerance by its own estimate, and none is
    /// missing.
    pub met: bool,
    /// Whether it is certain that no mode is missing: by the number of nodes where theory demands
    /// it, or by the number of slower motions. None where that could not be counted.
    pub none_missing: Option<bool>,
    /// What ended the refinement before the tolerance was met, if something did.
    pub stopped: Option<String>,
    /// How the modes die out.
    pub damping: Damping,
    /// Where the time went.
    pub timing: Timing,
}

impl Solution {
    /// The largest relative error of a frequency, by its own estimate.
    pub fn worst(&self) -> f64 {
        // NaN must count as unbounded; `f64::max` would drop it.
        let known = |error: f64| if error.is_nan() { f64::INFINITY } else { error };
        self.modes.iter().map(|mode| known(mode.error.total())).fold(0.0, f64::max)
    }

    /// Whether it is certain that no mode is missing.
    pub fn complete(&self) -> bool {
        self.none_missing == Some(true)
    }

    /// Why the wanted tolerance was not met, for a person; empty if it was.
    pub fn shortfall(&self, tolerance: f64) -> String {
        let round_off = self.modes.iter().map(|mode| mode.error.round_off).fold(0.0, f64::max);
        if self.met {
            return String::new();
        }
        if round_off > tolerance {
            return format!("round-off alone is {round_off:.1e}");
        }
        if !self.complete() {
            return "the number of slower motions does not show that no mode is missing: two \
                    frequencies are too near each other to count between them"
                .to_owned();
        }
        self.stopped.clone().unwrap_or_else(|| "further refinement gained nothing".to_owned())
    }

    /// Unknowns of the assembled matrices.
    pub fn degrees_of_freedom(&self) -> usize {
        let strains = if self.theory.shears() { 2 } else { 1 };
        strains * (self.degree - 1) * self.mesh.len() + 2
    }
}

/// Where the time went.
#[derive(Debug, Clone, Copy, Default)]
pub struct Timing {
    /// Planning.
    pub plan: Duration,
    /// Compliance or matrices.
    pub assemble: Duration,
    /// Eigenpairs, shapes and errors.
    pub solve: Duration,
}

/// Upper limit on requested modes; beam theory has no meaning beyond it.
const MOST_MODES: usize = 2000;
/// A mesh that needs more memory is refused.
const MOST_GIGABYTES: f64 = 8.0;
/// Residual of an eigenpair that is as good as arithmetic allows.
const CONVERGED: f64 = 1e-13;
/// Refinements before the answer is given as it is.
const MOST_ROUNDS: usize = 12;

/// Finds the lowest bending modes of a free bat, as accurately as asked.
///
/// # Errors
///
/// Those of [`Request::check`]; [`Error::TooFewElements`] where the asked elements cannot bend in
/// so many ways, [`Error::TooLarge`] for the dense solver, [`Error::Factorization`] for those that
/// factor `K`, [`Error::NotBuilt`] without ARPACK, [`Error::NotConverged`]. An accuracy that cannot
/// be reached is no error: the best answer comes back with `met` false.
pub fn solve(bat: &Bat, request: &Request) -> Result<Solution> {
    request.check(1)?;
    if request.theory.shears() && !bat.knows_shear() {
        let found = format!("timoshenko, but {} has no shear modulus", bat.without_shear());
        let expected = "\"shear_modulus\" or \"poisson_ratio\" there, or a theory without shear";
        return Err(Error::value("theory", found, expected));
    }
    let started = Clock::start();
    let mut timing = Timing::default();
    let mut plan = match request.elements {
        Some(elements) => Plan::fixed(bat, elements, request.degree.unwrap_or(3)),
        None => Plan::cheapest(bat, &wanted(request)),
    };
    timing.plan = started.elapsed();
    let unknowns = |plan: &Plan| (plan.degree - 1) * plan.mesh.len();
    if unknowns(&plan) < request.modes {
        let least = request.modes.div_ceil(plan.degree - 1);
        let found = plan.mesh.len();
        return Err(Error::TooFewElements { wanted: request.modes, least, found });
    }
    request.check_memory(request.memory(bat, &plan), plan.mesh.len())?;
    let mut best: Option<Solution> = None;
    let mut residual = stop_at(request);
    if !bat.fixtures.none_moving() {
        // Two frequencies may be the same, and then are no nearer to the truth than the residual.
        residual = residual.min(request.tolerance).max(CONVERGED);
    }
    for round in 0..MOST_ROUNDS {
        let task = Task { bat, plan: &plan, request, residual };
        let answer = match (task.run(&mut timing), &mut best) {
            (Ok(answer), _) => answer,
            (Err(error), Some(best)) => {
                // The answer before this refinement stands.
                best.stopped = Some(error.to_string());
                break;
            }
            (Err(error), None) => return Err(error),
        };
        let again = request.solver == Solver::Statics && residual > CONVERGED;
        if again && answer.none_missing != Some(true) {
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
        if solution.met || best.is_none() || gain < 1.0 {
            best = Some(solution);
        }
        match next {
            Some(next)
                if unknowns(&next) <= request.solver.most_unknowns()
                    && request.memory(bat, &next) <= MOST_GIGABYTES =>
            {
                plan = next;
            }
            Some(next) => {
                let too_many = format!(
                    "a refinement would take {} unknowns and {:.1} GB",
                    unknowns(&next),
                    request.memory(bat, &next)
                );
                best.iter_mut().for_each(|best| best.stopped = Some(too_many.clone()));
                break;
            }
            None => break,
        }
        if round + 1 == MOST_ROUNDS {
            let rounds = format!("{MOST_ROUNDS} refinements were not enough");
            best.iter_mut().for_each(|best| best.stopped = Some(rounds.clone()));
        }
    }
    let mut best = best.expect("there was a round");
    let body = (&best.mesh, best.degree, best.theory);
    best.damping = damping(bat, body, &best.modes, request.tolerance)?;
    let damped = best.damping.modes.iter().map(|damped| damped.error).fold(0.0, f64::max);
    if best.met && damped > request.tolerance {
        best.met = false;
        best.stopped = Some(format!("the damped motions are known to {damped:.1e} only"));
    }
    Ok(best)
}

/// The most accurate answer that a time allows: one digit after the other, until the next would
/// take too long by the time that the last took. The first digit is given in any case, `met` false
/// if it took longer.
///
/// # Errors
///
/// As [`solve`].
pub fn solve_within(bat: &Bat, request: &Request, budget: Duration) -> Result<Solution> {
    let started = Clock::start();
    let (mut best, mut first) = (None::<Solution>, Duration::ZERO);
    for digits in 1..=14 {
        let begun = Clock::start();
        let digit = Request { tolerance: 10f64.powi(-digits), elements: None, ..*request };
        let solution = match solve(bat, &digit) {
            Ok(solution) => solution,
            // A digit that cannot be had ends the search, not the answer.
            Err(_) if best.is_some() => break,
            Err(error) => return Err(error),
        };
        let (last, spent) = (begun.elapsed(), started.elapsed());
        if best.is_none() {
            first = spent;
        }
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
    best.reason = Reason::Budget(budget);
    if first > budget {
        best.stopped = Some(format!("the first digit took {first:?}, {budget:?} were allowed"));
    }
    Ok(best)
}

/// Modes on one mesh.
struct Answer {
    modes: Vec<Mode>,
    steps: usize,
    /// Each element's part in the worst mode's defect.
    defects: Vec<f64>,
    none_missing: Option<bool>,
    rigid_modes: usize,
}

impl Answer {
    /// The solution, and each element's part in its worst defect.
    fn solution(self, plan: Plan, request: &Request, timing: Timing) -> (Solution, Vec<f64>) {
        let within = |mode: &Mode| mode.error.total() <= request.tolerance;
        let solution = Solution {
            met: self.modes.iter().all(within) && self.none_missing == Some(true),
            none_missing: self.none_missing,
            rigid_modes: self.rigid_modes,
            theory: request.theory,
            modes: self.modes,
            solver: request.solver,
            mesh: plan.mesh,
            degree: plan.degree,
            reason: plan.reason,
            steps: self.steps,
            stopped: None,
            damping: Damping::default(),
            timing,
        };
        (solution, self.defects)
    }
}

/// One mesh to solve, to a residual.
struct Task<'a> {
    bat: &'a Bat,
    plan: &'a Plan,
    request: &'a Request,
    residual: f64,
}

/// A task and the time that its parts take.
struct Timed<'a> {
    task: &'a Task<'a>,
    timing: &'a mut Timing,
}

impl OfDegree for Timed<'_> {
    type Output = Result<Answer>;

    fn with<const N: usize, const W: usize>(self) -> Result<Answer> {
        self.task.of_degree::<N, W>(self.timing)
    }
}

impl Task<'_> {
    /// The modes on the mesh, whatever accuracy that gives.
    fn run(&self, timing: &mut Timing) -> Result<Answer> {
        of_degree(self.plan.degree, self.request.theory, Timed { task: self, timing })
    }

    fn of_degree<const N: usize, const W: usize>(&self, timing: &mut Timing) -> Result<Answer> {
        let Self { bat, plan, request, .. } = *self;
        let started = Clock::start();
        let mut pairs = Eigenpairs::<f64, N, W>::new(bat, request.theory);
        pairs.assemble(&[bat], &[&plan.mesh]);
        let assembled = Clock::start();
        timing.assemble += started.elapsed();
        if pairs.statics.freedom() < request.modes {
            let least = request.modes.div_ceil(W - 2) + 1;
            let found = plan.mesh.len();
            return Err(Error::TooFewElements { wanted: request.modes, least, found });
        }
        let Found { strains, steps, beyond, residuals, apart } = self.strains(&mut pairs)?;
        let stretches = Arc::new(plan.mesh.stretches());
        let missed = |e| sections::missed(bat, e, pairs.statics.rule, request.theory);
        let missed = plan.mesh.elements.iter().map(missed).fold(0.0, f64::max);
        let rounding = sections::round_off(bat, &plan.mesh);
        let factored = request.solver != Solver::Statics;
        let mut modes: Vec<Mode> = Vec::with_capacity(request.modes);
        let mut defects = vec![0.0; plan.mesh.len()];
        let mut add = |mode: Mode| {
            let mut mode = mode;
            mode.error.discretization += missed;
            // Round-off is that of the slowest mode that was not taken out of the others.
            let slow = modes.len() < apart;
            let first = modes.get(if slow { 0 } else { apart });
            let left = residuals.get(modes.len()).filter(|_| apart > 0 && !slow);
            account(&mut mode, first, plan.mesh.len(), factored, left.copied());
            add_sections(&mut mode, rounding);
            modes.push(mode);
        };
        let (size, split) = (pairs.statics.dimension(), pairs.statics.split);
        if size > LARGE || pairs.statics.fixed.is_some() || apart > 0 {
            let mut motion = Motion::<f64>::default();
            for (k, own) in strains.chunks_exact(size).enumerate() {
                // The compliance's rounding in the slower modes is no part of this one; of a large
                // mesh that would cost the square of the modes.
                let slower = if size > LARGE || k < apart { 0 } else { k };
                pairs.look_at_one(own, &strains[..size * slower], Depth::Changes, &mut motion);
                let cell = |k: usize| pairs.statics.cell(k);
                add(Mode::new(k + 1, &pairs.statics.view(&cell), &motion, 0, &stretches));
                motion.add_defects(split, &mut defects);
            }
        } else {
            let count = strains.len() / size;
            for first in (0..count).step_by(WIDTH) {
                pairs.look_at(&strains, first, Depth::Changes);
                let cell = |k: usize| pairs.statics.cell(k);
                let view = pairs.statics.view(&cell);
                for k in first..count.min(first + WIDTH) {
                    add(Mode::new(k + 1, &view, &pairs.motions, k - first, &stretches));
                }
                pairs.motions.add_defects(split, &mut defects);
            }
        }
        add_neighbours(&mut modes, beyond, &residuals, factored);
        let none_missing = none_missing(&pairs.statics, &modes, beyond, self.residual);
        // Those beyond were looked at for their near twins' sake.
        modes.truncate(request.modes);
        timing.solve += assembled.elapsed();
        Ok(Answer { modes, steps, defects, none_missing, rigid_modes: pairs.statics.rigid_modes() })
    }

    /// Scaled strains of the wanted modes.
    fn strains<const N: usize, const W: usize>(
        &self,
        pairs: &mut Eigenpairs<f64, N, W>,
    ) -> Result<Found> {
        let Self { bat, plan, request, residual } = *self;
        match request.solver {
            _ if request.modes == 0 => Ok(Found::default()),
            Solver::Statics => {
                let coarse = Moments::of(bat, plan, request);
                let most = (request.modes + MOST_TWINS).min(pairs.statics.freedom());
                for count in request.modes..=most {
                    match &coarse {
                        Some(coarse) => {
                            pairs.solve_from(count, residual, |places| coarse.at(places))?;
                        }
                        None => pairs.solve(count, residual)?,
                    }
                    let Lanczos { values, beyond, .. } = &pairs.lanczos;
                    let twin = |beyond: f64| is_twin(beyond / values[count - 1], count);
                    if !beyond.is_some_and(twin) {
                        break;
                    }
                }
                // Bats of far slower modes are stiff parts on soft ones, whose modes may be twins:
                // these are told apart at the end of the iteration only.
                let apart = pairs.solve_apart(CONVERGED)?;
                let lanczos = std::mem::take(&mut pairs.lanczos);
                let omega = |value: f64| (pairs.statics.energy_unit / value).sqrt();
                let (steps, beyond) = (lanczos.steps, lanczos.beyond.map(omega));
                let residuals = lanczos.residuals;
                Ok(Found { strains: lanczos.vectors, steps, beyond, residuals, apart })
            }
            solver => referee::strains(bat, &plan.mesh, &pairs.statics, request.modes, solver),
        }
    }
}

/// Whether no mode is missing, not even a near twin just beyond the list, which an iteration that
/// ends at `residual` does not tell from the last mode: as many motions must be slower than a
/// frequency in the last gap of the list that is wide enough. Where that cannot be counted, or the
/// iteration tells as much as the count would, the nodes do: mode n of a free Euler-Bernoulli bat
/// has n + 1.
fn none_missing<const N: usize, const W: usize>(
    statics: &Statics<f64, N, W>,
    modes: &[Mode],
    beyond: Option<f64>,
    residual: f64,
) -> Option<bool> {
    const WIDE: f64 = 1e-9;
    let oscillates = statics.fixed.is_none() && !statics.theory.turns();
    let by_nodes = (oscillates && modes.iter().all(Mode::has_its_nodes)).then_some(true);
    if residual < WIDE && by_nodes.is_some() {
        return by_nodes;
    }
    let omegas = modes.iter().map(|mode| mode.omega).chain(beyond);
    let omegas: Vec<f64> = omegas.collect();
    let gap = (1..omegas.len()).rev().find(|&k| omegas[k] > (1.0 + WIDE) * omegas[k - 1]);
    let Some(below) = gap else { return by_nodes.or(modes.is_empty().then_some(true)) };
    let between = (omegas[below - 1] * omegas[below]).sqrt();
    let Some(slower) = count::slower(statics, between) else { return by_nodes };
    Some(slower == below + statics.rigid_modes())
}

/// So many motions beyond the wanted ones are looked at where they are near twins of these.
const MOST_TWINS: usize = 4;

/// Beyond so many unknowns the iteration starts from a coarse solution.
const LARGE: usize = 20_000;

/// Bending moments of all wanted modes together, from a coarse solution: a start from which the
/// iteration needs as many steps as there are modes and hardly more.
struct Moments<'a> {
    bat: &'a Bat,
    /// The sum of the shapes, each with the same strain energy.
    sum: Shape,
}

impl<'a> Moments<'a> {
    /// None where the mesh is not large or not the user's own, and where there is no small and
    /// certain coarse solution: that of a bat of many stations is large too.
    fn of(bat: &'a Bat, plan: &Plan, request: &Request) -> Option<Self> {
        let large = (plan.degree - 1) * plan.mesh.len() > LARGE;
        if request.elements.is_none() || !large || bat.profile.pieces.len() > LARGE / 16 {
            return None;
        }
        let wanted = Request { tolerance: 1e-12, elements: None, degree: None, ..*request };
        let coarse = solve(bat, &wanted).ok().filter(Solution::complete)?;
        let scale = |mode: &Mode| 1.0 / (mode.omega * mode.modal_mass.sqrt());
        let parts: Vec<_> = coarse.modes.iter().map(|mode| (scale(mode), &mode.shape)).collect();
        Some(Self { bat, sum: Shape::sum(&parts) })
    }

    /// Replaces places, 0 to 1 along the bat, by the bending moments there.
    fn at(&self, places: &mut [f64]) {
        let length = self.bat.length();
        for place in places {
            let x = *place * length;
            *place = self.bat.worth_at(x).bending * self.sum.curvature(x);
        }
    }
}

/// What the planner is asked for.
pub fn wanted(request: &Request) -> Wanted {
    Wanted {
        modes: request.modes,
        tolerance: request.tolerance,
        degree: request.degree,
        most_unknowns: request.solver.most_unknowns(),
        theory: request.theory,
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
