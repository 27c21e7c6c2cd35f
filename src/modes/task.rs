//! The modes on one mesh, whatever accuracy that gives.

use std::sync::Arc;

use crate::base::{Clock, Error, Result, WIDTH, threads};
use crate::bat::{Bat, Theory};
use crate::beam::{Depth, Mesh, Motion, Rule, View, count, sections};
use crate::eigen::lanczos::Lanczos;
use crate::modes::certificate::{account, add_neighbours, add_round_off, is_twin, lost};
use crate::modes::damping::Damping;
use crate::modes::mode::Mode;
use crate::modes::pairs::{Pairs, pairs_of};
use crate::modes::plan::Plan;
use crate::modes::referee::{Found, Solver};
use crate::modes::request::{AT_ONCE, CONVERGED, LARGE, Request};
use crate::modes::solution::{Ending, Solution, Timing};

/// The modes on one mesh.
pub struct MeshModes {
    /// The modes, rising.
    pub modes: Vec<Mode>,
    /// [`Solution::steps`].
    pub steps: usize,
    /// Each element's part in the worst mode's defect.
    pub defects: Vec<f64>,
    /// [`Solution::complete`].
    pub complete: bool,
    /// [`Solution::rigid_modes`].
    pub rigid_modes: usize,
}

impl MeshModes {
    /// The solution, and each element's part in its worst defect.
    pub fn solution(self, plan: Plan, request: &Request, timing: Timing) -> (Solution, Vec<f64>) {
        let solution = Solution {
            ending: self.ending(request.tolerance),
            complete: self.complete,
            rigid_modes: self.rigid_modes,
            theory: request.theory,
            modes: self.modes,
            solver: request.solver,
            mesh: plan.mesh,
            degree: plan.degree,
            reason: plan.reason,
            steps: self.steps,
            damping: Damping::default(),
            timing,
            tuned: None,
        };
        (solution, self.defects)
    }

    /// The ending if nothing follows.
    fn ending(&self, tolerance: f64) -> Ending {
        let within = |mode: &Mode| mode.error.total() <= tolerance;
        let round_off = self.modes.iter().map(|mode| mode.error.round_off).fold(0.0, f64::max);
        if self.complete && self.modes.iter().all(within) {
            Ending::Reached
        } else if round_off > tolerance {
            Ending::RoundOff(round_off)
        } else if self.complete {
            Ending::Stalled
        } else {
            Ending::Uncounted
        }
    }
}

/// One mesh to solve, to a residual.
pub struct Task<'a> {
    /// The bat.
    pub bat: &'a Bat,
    /// Its elements.
    pub plan: &'a Plan,
    /// The request.
    pub request: &'a Request,
    /// Residual of the eigenpairs.
    pub residual: f64,
}

impl Task<'_> {
    /// The modes on the mesh, whatever accuracy that gives.
    pub fn run(&self, timing: &mut Timing) -> Result<MeshModes> {
        let Self { bat, plan, request, .. } = *self;
        let started = Clock::start();
        let mut pairs = pairs_of(bat, plan.degree, request.theory);
        pairs.assemble(bat, &plan.mesh);
        let assembled = Clock::start();
        timing.assemble += started.elapsed();
        if pairs.view().freedom() < request.modes {
            let least = request.modes.div_ceil(pairs.view().strains) + 1;
            let found = plan.mesh.len();
            return Err(Error::TooFewElements { wanted: request.modes, least, found });
        }
        let found = self.strains(&mut *pairs)?;
        let (mut modes, defects) = self.modes(&mut *pairs, &found);
        let factored = request.solver != Solver::Statics;
        add_neighbours(&mut modes, found.beyond, &found.residuals, factored);
        let complete = none_missing(&pairs.view(), &modes, found.beyond, self.residual);
        // Those beyond were evaluated only because near twins matter.
        modes.truncate(request.modes);
        timing.solve += assembled.elapsed();
        let (steps, rigid_modes) = (found.steps, pairs.view().rigid_modes());
        Ok(MeshModes { modes, steps, defects, complete, rigid_modes })
    }

    /// The modes of strains, each with its own errors, and each element's part in the worst defect.
    fn modes(&self, pairs: &mut dyn Pairs, found: &Found) -> (Vec<Mode>, Vec<f64>) {
        let stretches = Arc::new(self.plan.mesh.stretches());
        let mut account = self.account(pairs.view().rule, found);
        let mut defects = vec![0.0; self.plan.mesh.len()];
        let view = pairs.view();
        let (size, split, held) = (view.dimension(), view.split, view.fixed.is_some());
        let strains = &found.strains;
        let count = strains.len() / size.max(1);
        if size > LARGE || held || found.apart > 0 {
            let pairs: &dyn Pairs = pairs;
            let at_once = if size > LARGE { AT_ONCE } else { 1 };
            let mut motions = vec![Motion::<f64>::default(); at_once.min(count)];
            for first in (0..count).step_by(at_once) {
                let some = &mut motions[..at_once.min(count - first)];
                let modes = threads::map_each(some, |k, motion| {
                    let k = first + k;
                    let own = &strains[size * k..size * (k + 1)];
                    // The compliance's round-off in slower modes is not part of this one. On a large mesh its removal
                    // would cost the square of the number of modes.
                    let slower = if size > LARGE || k < found.apart { 0 } else { k };
                    pairs.look_at_one(own, &strains[..size * slower], Depth::Changes, motion);
                    Mode::new(k + 1, &pairs.view(), motion, 0, &stretches)
                });
                modes.into_iter().for_each(|mode| account.add(mode));
                some.iter().for_each(|motion| motion.add_defects(split, &mut defects));
            }
        } else {
            for first in (0..count).step_by(WIDTH) {
                pairs.look_at(strains, first, Depth::Changes);
                let (view, motions) = pairs.looked_at();
                for k in first..count.min(first + WIDTH) {
                    account.add(Mode::new(k + 1, &view, motions, k - first, &stretches));
                }
                motions.add_defects(split, &mut defects);
            }
        }
        (account.modes, defects)
    }

    /// An empty account, with the data for every mode's errors.
    fn account<'a>(&self, rule: &Rule, found: &'a Found) -> Account<'a> {
        Account {
            apart: found.apart,
            factored: self.request.solver != Solver::Statics,
            ..Account::new(self.bat, &self.plan.mesh, rule, self.request.theory, &found.residuals)
        }
    }

    /// Scaled strains of the wanted modes.
    fn strains(&self, pairs: &mut dyn Pairs) -> Result<Found> {
        let Self { bat, plan, request, residual } = *self;
        if request.modes == 0 {
            return Ok(Found::default());
        }
        if request.solver != Solver::Statics {
            return pairs.factored(bat, &plan.mesh, request.modes, request.solver);
        }
        let most = (request.modes + MOST_TWINS).min(pairs.view().freedom());
        for count in request.modes..=most {
            pairs.solve(count, residual)?;
            let Lanczos { values, beyond, .. } = pairs.lanczos();
            let twin = |beyond: f64| is_twin(beyond / values[count - 1], count);
            if !beyond.is_some_and(twin) {
                break;
            }
        }
        // Bats with far slower modes are stiff parts on soft ones, whose modes may be twins. The iteration separates
        // these only at its end.
        let apart = pairs.solve_apart(CONVERGED)?;
        let lanczos = std::mem::take(pairs.lanczos());
        let omega = |value: f64| (pairs.view().energy_unit / value).sqrt();
        let (steps, beyond) = (lanczos.steps, lanczos.beyond.map(omega));
        let residuals = lanczos.residuals;
        Ok(Found { strains: lanczos.vectors, steps, beyond, residuals, apart })
    }
}

/// The modes so far, and the data for their errors besides their own defects.
pub struct Account<'a> {
    /// The modes, rising.
    pub modes: Vec<Mode>,
    /// Number of slowest modes that were removed before the others were found.
    pub apart: usize,
    /// Whether the solver factored `K`.
    pub factored: bool,
    /// Whether frequencies follow from the compliance's eigenvalues, which are known to ε of the greatest.
    pub by_value: bool,
    /// [`Found::residuals`].
    residuals: &'a [f64],
    /// Error of the sections at the points, and the sections' own round-off.
    missed: f64,
    rounding: f64,
    /// Number of elements, and whether they reach over stations.
    elements: (usize, bool),
}

impl<'a> Account<'a> {
    /// An empty account for the bat on that mesh sampled by that rule, with the iteration's residuals.
    pub fn new(bat: &Bat, mesh: &Mesh, rule: &Rule, theory: Theory, residuals: &'a [f64]) -> Self {
        Self {
            modes: Vec::with_capacity(residuals.len()),
            apart: 0,
            factored: false,
            by_value: false,
            residuals,
            missed: sections::missed_on(bat, mesh, rule, theory),
            rounding: sections::round_off(bat, mesh),
            elements: (mesh.len(), mesh.over_stations()),
        }
    }

    /// Adds the next mode and completes its errors.
    pub fn add(&mut self, mut mode: Mode) {
        mode.error.discretization += self.missed;
        // Round-off is relative to the slowest mode that was not removed from the others.
        let slow = self.modes.len() < self.apart;
        let first = self.modes.get(if slow { 0 } else { self.apart });
        let ratio = first.map_or(1.0, |first| mode.omega / first.omega);
        let residual = self.residuals.get(self.modes.len()).copied();
        let left = residual.filter(|_| !(slow || self.factored || self.by_value));
        // The couple of a weight off its place depends on its motion without the rigid motions.
        let mut rounding = self.rounding + 0.5 * f64::EPSILON * mode.doubt.cancelled;
        if self.by_value {
            mode.error.residual = residual.unwrap_or(0.0);
            rounding += 0.5 * f64::EPSILON * ratio * ratio;
        }
        if let Some(left) = left {
            rounding += lost(mode.error.residual, left, ratio, self.apart > 0);
        }
        account(&mut mode, ratio, self.elements, self.factored);
        add_round_off(&mut mode, rounding);
        self.modes.push(mode);
    }
}

/// Whether it is certain that no mode is missing, not even a near twin just beyond the list, which an iteration that
/// ends at `residual` cannot tell from the last mode. The number of modes below a frequency in the last wide gap of the
/// list must equal the number in the list. If that cannot be counted, or the count would not add to what the iteration
/// shows, the nodes decide: mode n of a free Euler–Bernoulli bat has n + 1.
fn none_missing(view: &View<f64>, modes: &[Mode], beyond: Option<f64>, residual: f64) -> bool {
    const WIDE: f64 = 1e-9;
    let oscillates = view.fixed.is_none() && !view.theory.turns();
    let by_nodes = oscillates && modes.iter().all(Mode::has_its_nodes);
    if residual < WIDE && by_nodes {
        return by_nodes;
    }
    let omegas = modes.iter().map(|mode| mode.omega).chain(beyond);
    let omegas: Vec<f64> = omegas.collect();
    let gap = (1..omegas.len()).rev().find(|&k| omegas[k] > (1.0 + WIDE) * omegas[k - 1]);
    let Some(below) = gap else { return by_nodes || modes.is_empty() };
    let between = (omegas[below - 1] * omegas[below]).sqrt();
    let Some(slower) = count::slower(view, between) else { return by_nodes };
    slower == below + view.rigid_modes()
}

/// Most modes beyond the wanted ones that are evaluated because they are near twins.
const MOST_TWINS: usize = 4;
