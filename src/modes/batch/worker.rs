//! As many bats as there are lanes, on one plan.

use std::sync::Arc;

use crate::base::{Error, Lanes, Over, Real, Result, WIDTH, vectorized};
use crate::bat::{Bat, Theory};
use crate::beam::count::slower_each;
use crate::beam::{Depth, Mesh, View, sections};
use crate::modes::certificate::{add_neighbours, is_twin, round_off, share};
use crate::modes::eigenpairs::Eigenpairs;
use crate::modes::mode::Mode;
use crate::modes::plan::Plan;
use crate::modes::request::{Request, stop_at};
use crate::modes::solution::{Solution, Timing};
use crate::modes::task::{Account, MeshModes};

/// The modes of one bat of a batch. The slices are valid until the next bat.
#[derive(Debug, Clone, Copy)]
pub struct Found<'a> {
    /// Angular frequencies ω (rad/s), rising.
    pub omegas: &'a [f64],
    /// Estimated relative errors of the frequencies; for a mesh that was asked for, without the mesh's error.
    pub errors: &'a [f64],
    /// `∫ρA φ² dx` (kg).
    pub modal_masses: &'a [f64],
    /// Deflections φ in Legendre polynomials: `degree + 1` numbers per element, knob to tip, mode after mode. The
    /// largest |φ| at the ends and the elements' sample points is 1 (for a bat solved alone, the largest anywhere); the
    /// tip is positive.
    pub shapes: &'a [f64],
    /// The elements.
    pub mesh: &'a Mesh,
    /// Degree of their deflection.
    pub degree: usize,
}

/// The memory of one pass over the bats.
pub struct Worker<R, const N: usize, const W: usize> {
    plan: Plan,
    /// Lanczos steps for every bat; `None` if each takes as many as it needs.
    steps: Option<usize>,
    pairs: Eigenpairs<R, N, W>,
    meshes: Vec<Mesh>,
    /// The values of [`Found`], lane after lane.
    omegas: Vec<f64>,
    errors: Vec<f64>,
    modal_masses: Vec<f64>,
    shapes: Vec<f64>,
    /// Whether each lane's list of modes is certainly complete.
    counted: Vec<bool>,
    /// The lanes' solutions that met the tolerance and were not yet taken.
    solutions: Vec<Option<Solution>>,
}

/// Choices that each bat makes for itself unless they are prescribed.
#[derive(Clone, Copy)]
pub struct Choices {
    /// Lanczos steps.
    steps: usize,
    /// Elements on the knob side.
    root: usize,
}

impl<R: Real, const N: usize, const W: usize> Worker<R, N, W>
where
    Lanes: Over<R>,
{
    /// An empty worker for bats like that model.
    pub fn new(model: &Bat, theory: Theory, plan: Plan) -> Self {
        Self {
            steps: None,
            pairs: Eigenpairs::new(model, theory),
            meshes: vec![Mesh::default(); R::LANES],
            plan,
            omegas: vec![],
            errors: vec![],
            modal_masses: vec![],
            shapes: vec![],
            counted: vec![],
            solutions: vec![],
        }
    }

    /// The choices of the bat that was iterated last.
    pub fn choices(&self) -> Choices {
        Choices { steps: self.pairs.lanczos.steps, root: self.pairs.statics.split }
    }

    /// Prescribes these choices from now on, so that a bat's result does not depend on the others.
    pub fn choose(&mut self, Choices { steps, root }: Choices) {
        self.steps = Some(steps);
        self.pairs.statics.rooted = Some(root);
    }

    /// Memory (bytes) of the vectors of an iteration.
    pub fn basis(&self, Choices { steps, .. }: Choices) -> usize {
        steps * (W - 2) * self.plan.mesh.len() * size_of::<R>()
    }

    /// Finds the eigenpairs of as many bats as there are lanes.
    ///
    /// # Errors
    ///
    /// [`Error::TooFewElements`], [`Error::NotConverged`].
    pub fn iterate(&mut self, bats: &[&Bat], request: &Request) -> Result<()> {
        for (mesh, bat) in self.meshes.iter_mut().zip(bats) {
            mesh.fit(bat, &self.plan.mesh);
        }
        let modes = request.modes;
        if R::LANES == 1 {
            self.pairs.assemble(bats, &[&self.meshes[0]]);
        } else {
            let meshes: [&Mesh; WIDTH] = std::array::from_fn(|lane| &self.meshes[lane]);
            self.pairs.assemble(bats, &meshes);
        }
        if self.pairs.statics.dimension() < modes {
            let (least, found) = (modes.div_ceil(W - 2), self.plan.mesh.len());
            return Err(Error::TooFewElements { wanted: modes, least, found });
        }
        // On a mesh that was asked for, both ways must agree to 1e-12, whatever the tolerance.
        let most = if request.elements.is_some() { 1e-6 } else { 1.0 };
        let tolerant = Request { elements: None, ..*request };
        match self.steps {
            None => self.pairs.solve(modes, stop_at(&tolerant).min(most)),
            Some(steps) => self.pairs.solve_in(modes, steps),
        }
    }

    /// Evaluates all modes of the bats that were iterated, for [`Found`].
    pub fn look(&mut self, bats: &[&Bat], request: &Request) {
        let modes = request.modes;
        let numbers = R::LANES * modes;
        for values in [&mut self.omegas, &mut self.errors, &mut self.modal_masses] {
            values.resize(numbers, 0.0);
        }
        self.shapes.resize(numbers * N * self.plan.mesh.len(), 0.0);
        self.counted.clear();
        self.counted.resize(R::LANES, true);
        let depth = if request.elements.is_some() { Depth::Shape } else { Depth::Defect };
        for first in (0..modes).step_by(Eigenpairs::<R, N, W>::TOGETHER) {
            self.pairs.look(first, depth);
            self.keep(first, modes, depth);
        }
        self.add_residuals(modes);
        let rule = self.pairs.statics.rule;
        for (lane, (bat, mesh)) in bats.iter().zip(&self.meshes).enumerate() {
            let missed = match request.elements {
                Some(_) => 0.0,
                None => sections::missed_on(bat, mesh, rule, request.theory),
            };
            let of_sections = missed + sections::round_off(bat, mesh);
            let own = &mut self.errors[lane * modes..(lane + 1) * modes];
            own.iter_mut().for_each(|error| *error += of_sections);
        }
        // For a bare bat without rotary inertia, the number of nodes decides.
        let statics = &self.pairs.statics;
        if modes > 0 && (statics.fixed.is_some() || statics.theory.turns()) {
            let last = std::array::from_fn(|lane| {
                if lane < R::LANES { self.omegas[(lane + 1) * modes - 1] } else { 0.0 }
            });
            self.count(modes, last);
        }
    }

    /// The result of the bat in a lane; `None` if it misses the tolerance or a mode by its own estimate.
    pub fn found(&self, lane: usize, request: &Request) -> Option<Found<'_>> {
        let (modes, coefficients) = (request.modes, N * self.plan.mesh.len());
        let own = |each: usize| lane * modes * each..(lane + 1) * modes * each;
        let errors = &self.errors[own(1)];
        let met = errors.iter().all(|error| *error <= request.tolerance);
        (met && self.counted[lane]).then(|| Found {
            omegas: &self.omegas[own(1)],
            errors,
            modal_masses: &self.modal_masses[own(1)],
            shapes: &self.shapes[own(coefficients)],
            mesh: &self.meshes[lane],
            degree: N - 1,
        })
    }

    /// The solution of a bat after [`Self::look_closely`], without damping; `None` if it misses the tolerance or a mode
    /// by its own estimate.
    pub fn take(&mut self, lane: usize) -> Option<Solution> {
        self.solutions[lane].take()
    }

    /// Evaluates all modes of the bats that were iterated, with all their errors.
    pub fn look_closely(&mut self, bats: &[&Bat], request: &Request) {
        let modes = request.modes;
        let rule = self.pairs.statics.rule;
        let residuals: Vec<Vec<f64>> = (0..R::LANES)
            .map(|lane| self.pairs.lanczos.residuals.iter().map(|r| r.lane(lane)).collect())
            .collect();
        let accounts = bats.iter().zip(&self.meshes).zip(&residuals);
        let mut accounts: Vec<Account> = accounts
            .map(|((bat, mesh), left)| {
                let mut account = Account::new(bat, mesh, rule, request.theory, left);
                account.by_value = true;
                account
            })
            .collect();
        let stretches: Vec<_> = self.meshes.iter().map(|m| Arc::new(m.stretches())).collect();
        for first in (0..modes).step_by(Eigenpairs::<R, N, W>::TOGETHER) {
            self.pairs.look(first, Depth::Changes);
            let (view, motions) = (self.pairs.statics.view(), &self.pairs.motions);
            for place in 0..WIDTH.min(R::LANES * (modes - first)) {
                let (k, lane) = (first + place / R::LANES, place % R::LANES);
                accounts[lane].add(Mode::new(k + 1, &view, motions, place, &stretches[lane]));
            }
        }
        let mut found: Vec<Vec<Mode>> = accounts.into_iter().map(|all| all.modes).collect();
        let mut last = [0.0; WIDTH];
        self.counted.clear();
        for (lane, modes) in found.iter_mut().enumerate() {
            add_neighbours(modes, self.beyond(lane), &residuals[lane], false);
            last[lane] = modes.last().map_or(0.0, |mode| mode.omega);
            self.counted.push(!self.has_twin(request.modes, lane));
        }
        self.count(modes, last);
        let (steps, rigid_modes) =
            (self.pairs.lanczos.steps, self.pairs.statics.view().rigid_modes());
        let solution = |(lane, modes): (usize, Vec<Mode>)| {
            let complete = self.counted[lane];
            let answer = MeshModes { modes, steps, defects: vec![], complete, rigid_modes };
            let plan = Plan { mesh: self.meshes[lane].clone(), ..self.plan.clone() };
            let solution = answer.solution(plan, request, Timing::default()).0;
            solution.met().then_some(solution)
        };
        self.solutions = found.into_iter().enumerate().map(solution).collect();
    }

    /// Counts the modes of every bat below a frequency between its last mode (rad/s) and the next; the count must equal
    /// the number of its modes.
    fn count(&mut self, modes: usize, last: [f64; WIDTH]) {
        let mut between = R::default();
        for lane in 0..R::LANES {
            let next = self.beyond(lane);
            self.counted[lane] &= next.is_some();
            between.set_lane(lane, (last[lane] * next.unwrap_or(last[lane])).sqrt());
        }
        let found = slower_of_all(&self.pairs.statics.view(), between);
        for (lane, counted) in self.counted.iter_mut().enumerate() {
            let slower = found.map(|count| count.lane(lane));
            *counted &= slower == Some((modes + 2) as f64);
        }
    }

    /// ω (rad/s) of the next mode after those of a lane, if the iteration found it.
    fn beyond(&self, lane: usize) -> Option<f64> {
        let unit = self.pairs.statics.energy_unit.lane(lane);
        self.pairs.lanczos.beyond.map(|value| (unit / value.lane(lane)).sqrt())
    }

    /// Whether the next mode after those of a lane is too close to the last of them.
    fn has_twin(&self, modes: usize, lane: usize) -> bool {
        let lanczos = &self.pairs.lanczos;
        let last = modes.checked_sub(1).map(|last| lanczos.values[last].lane(lane));
        let twin = |beyond: &R| last.is_some_and(|last| is_twin(beyond.lane(lane) / last, modes));
        lanczos.beyond.as_ref().is_some_and(twin)
    }

    /// Adds the error of the iteration, `½ residual²/gap`, and the share of near twins, as
    /// [`crate::modes::certificate::add_neighbours`]. A bat with a near twin beyond the list is solved alone.
    fn add_residuals(&mut self, modes: usize) {
        let lanczos = &self.pairs.lanczos;
        for k in 0..modes {
            for bat in 0..R::LANES {
                let value = |value: &R| value.lane(bat);
                let own = value(&lanczos.values[k]);
                let below = (k > 0).then(|| value(&lanczos.values[k - 1]));
                let above = lanczos.values.get(k + 1).or(lanczos.beyond.as_ref()).map(value);
                let gap = |other: Option<f64>| other.map_or(1.0, |other| (other / own - 1.0).abs());
                let nearest = gap(below).min(gap(above)).clamp(f64::EPSILON, 1.0);
                let residual = lanczos.residuals[k].lane(bat);
                self.errors[bat * modes + k] += 0.5 * residual * residual / nearest;
            }
        }
        for bat in 0..R::LANES {
            let own = bat * modes..(bat + 1) * modes;
            share(&self.omegas[own.clone()], &mut self.errors[own]);
            self.counted[bat] &= !self.has_twin(modes, bat);
        }
    }

    /// Stores the evaluated modes of every bat, from mode `first` on.
    fn keep(&mut self, first: usize, modes: usize, depth: Depth) {
        let (statics, motions) = (&self.pairs.statics, &self.pairs.motions);
        let mut largest = motions.ends[0][0].abs().max(motions.ends[1][0].abs());
        motions.deflections.iter().for_each(|w| largest = largest.max(w.abs()));
        let scale = Lanes::splat(1.0).copysign(motions.ends[1][0]) / largest;
        let mass = motions.kinetic * scale * scale;
        // Otherwise [`Self::count`] tells whether a mode is missing.
        let by_nodes = statics.fixed.is_none() && !statics.theory.turns();
        let crossings = motions.crossings(statics.split);
        let (elements, over) = (statics.cells.len(), statics.over);
        for lane in 0..WIDTH.min(R::LANES * (modes - first)) {
            let (k, bat) = (first + lane / R::LANES, lane % R::LANES);
            let place = bat * modes + k;
            let omega = motions.omega.lane(lane);
            self.omegas[place] = omega;
            self.modal_masses[place] = mass.lane(lane);
            let ratio = omega / self.omegas[bat * modes];
            // An eigenvalue of the compliance is known to ε of the greatest one.
            let round_off = round_off(ratio, elements, over) + 0.5 * f64::EPSILON * ratio * ratio;
            let defect = if depth == Depth::Shape { 0.0 } else { motions.defect.lane(lane).abs() };
            self.errors[place] = round_off + 0.5 * defect;
            self.counted[bat] &= !by_nodes || crossings.lane(lane) == (k + 2) as f64;
            let shape = &mut self.shapes[place * N * elements..(place + 1) * N * elements];
            let (knob, tip) = motions.shape.split_at(N * statics.split);
            let scale = scale.lane(lane);
            // On the knob side, outwards runs backwards, and odd polynomials change sign.
            for (to, from) in shape.chunks_exact_mut(N).zip(knob.chunks_exact(N).rev()) {
                for (j, (to, w)) in to.iter_mut().zip(from).enumerate() {
                    *to = if j % 2 == 1 { -scale } else { scale } * w.lane(lane);
                }
            }
            for (to, from) in
                shape[N * statics.split..].chunks_exact_mut(N).zip(tip.chunks_exact(N))
            {
                to.iter_mut().zip(from).for_each(|(to, w)| *to = scale * w.lane(lane));
            }
        }
    }
}

/// Number of modes slower than a frequency, for the bats in the lanes.
fn slower_of_all<R: Real>(view: &View<R>, omega: R) -> Option<R> {
    vectorized!(slower_each(view, omega))
}
