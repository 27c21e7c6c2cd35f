//! What are the modes of many bats, as fast as the machine can?
//!
//! [`each`] goes through them on one core, [`all`] on all cores: one after the other or side by
//! side in the lanes of a vector.
//!
//! All share the plan of the first and its number of Lanczos steps, so that a bat's answer does not
//! depend on the others (one by one to the last bit, side by side to 1e-12). A bat of other
//! proportions, of a formula, with anything but masses on it, or whose answer misses the tolerance or a
//! mode by its own account is planned and solved on its own; so are all where the first is such a bat.
//! Once warm next to nothing is allocated for the others.

use pulp::{Simd, WithSimd};

use crate::base::error::{Error, Result};
use crate::base::lanes::{Lanes, WIDTH, widest};
use crate::base::real::{Over, Real};
use crate::base::threads;
use crate::bat::body::Bat;
use crate::bat::profile::{Piece, Radii, SAME_PLACE};
use crate::bat::theory::Theory;
use crate::beam::changes::Depth;
use crate::beam::count::slower_each;
use crate::beam::degree::{OfDegree, of_degree};
use crate::beam::mesh::Mesh;
use crate::beam::rule::Rule;
use crate::beam::view::View;
use crate::modes::certificate::{is_twin, round_off, share};
use crate::modes::eigenpairs::Eigenpairs;
use crate::modes::mode::Mode;
use crate::modes::plan::Plan;
use crate::modes::solve::{Request, Solver, solve, stop_at, wanted};

/// The modes of one bat of many. The slices hold until the next bat.
#[derive(Debug, Clone, Copy)]
pub struct Found<'a> {
    /// Angular frequencies ω (rad/s), rising.
    pub omegas: &'a [f64],
    /// Relative errors of the frequencies, estimated; where a mesh was asked for, without what the
    /// mesh costs.
    pub errors: &'a [f64],
    /// `∫ρA φ² dx` (kg).
    pub modal_masses: &'a [f64],
    /// Deflections φ in Legendre polynomials, `degree + 1` numbers an element, knob to tip, mode
    /// after mode; the largest |φ| at the ends and the elements' sample points is 1 (anywhere, of a
    /// bat that was solved on its own), the tip positive.
    pub shapes: &'a [f64],
    /// The elements.
    pub mesh: &'a Mesh,
    /// Degree of their deflection.
    pub degree: usize,
}

/// How the bats are counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// One after the other.
    OneByOne,
    /// Eight at a time in the lanes of a vector.
    SideBySide,
}

/// Degrees that a batch is compiled for: a program for every one would be large.
const COMPILED: [usize; 5] = [3, 4, 6, 8, 10];

const fn is_compiled(degree: usize) -> bool {
    let mut k = 0;
    while k < COMPILED.len() && COMPILED[k] != degree {
        k += 1;
    }
    k < COMPILED.len()
}

/// Solves every bat with the statics solver and shows each result to `visit`, with its place
/// among the bats.
///
/// Every frequency is within the tolerance by its estimate, as far as [`solve`] can reach it. With
/// `request.elements` every bat gets that mesh, whose cost is not counted: the tolerance is that of
/// the iteration alone. Both ways agree to 1e-12.
pub fn each(
    bats: &[Bat],
    request: &Request,
    way: Way,
    mut visit: impl FnMut(usize, Result<Found<'_>>),
) {
    let request = Request { solver: Solver::Statics, ..*request };
    shown_to(bats, &request, way, &mut visit);
}

fn shown_to(bats: &[Bat], request: &Request, way: Way, visit: Visit) {
    let degree = request.degree.or(request.elements.map(|_| 3));
    let degrees = degree.map_or(COMPILED.to_vec(), |degree| vec![degree]);
    let first = bats.first().filter(|first| {
        request.check(WIDTH).is_ok()
            && plain(first)
            && (!request.theory.shears() || bats.iter().all(Bat::knows_shear))
            && COMPILED.contains(&degrees[0])
    });
    let Some(first) = first else { return all_alone(bats, request, visit) };
    let plan = match request.elements {
        Some(elements) => Plan::fixed(first, elements, degrees[0]),
        None => Plan::cheapest_among(first, &wanted(request), degrees),
    };
    of_degree(plan.degree, request.theory, Alike { bats, request, way, plan, visit })
}

/// Bats that may share a plan.
struct Alike<'a> {
    bats: &'a [Bat],
    request: &'a Request,
    way: Way,
    plan: Plan,
    visit: Visit<'a>,
}

impl OfDegree for Alike<'_> {
    type Output = ();

    fn with<const N: usize, const W: usize>(self) {
        let Self { bats, request, way, plan, visit } = self;
        // Side by side for a few degrees: each takes long to compile.
        if const { is_compiled(N - 1) } {
            with_degree::<N, W>(bats, request, way, plan, visit);
        } else {
            all_alone(bats, request, visit);
        }
    }
}

fn all_alone(bats: &[Bat], request: &Request, visit: Visit) {
    bats.iter().enumerate().for_each(|(k, bat)| solved_alone(k, bat, request, visit));
}

/// Whether a bat is made of stations, with masses on it at most and nothing that holds it.
fn plain(bat: &Bat) -> bool {
    let formula = |piece: &Piece| matches!(piece.radii, Radii::Formula(_));
    bat.fixtures().only_masses() && !bat.profile().pieces.iter().any(formula)
}

/// Solves every bat on all cores, each share of 256 bats planned by its own first one.
///
/// What `read` makes of each result comes in the order of the bats; accuracy and mesh are those of
/// [`each`].
///
/// ```
/// use sweetspot::modes::batch::{Way, all};
/// use sweetspot::{Bat, Request};
///
/// # fn main() -> sweetspot::Result<()> {
/// # let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
/// #     "profile": { "unit": "in", "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5] } }"#;
/// # let bat = Bat::from_text("bat.json", text, "".as_ref())?;
/// let lighter = |k: i32| bat.with(|parts| parts.material.density *= 0.99_f64.powi(k));
/// let bats: Vec<Bat> = (0..100).map(lighter).collect::<sweetspot::Result<_>>()?;
/// let asked = Request { modes: 2, tolerance: 1e-6, ..Request::default() };
/// let first = all(&bats, &asked, Way::SideBySide, |_, found| found.map(|found| found.omegas[0]));
/// assert!(first[0].as_ref().unwrap() < first[99].as_ref().unwrap());
/// # Ok(())
/// # }
/// ```
pub fn all<T: Send>(
    bats: &[Bat],
    request: &Request,
    way: Way,
    read: impl Fn(usize, Result<Found<'_>>) -> T + Sync,
) -> Vec<T> {
    const SHARE: usize = 256;
    let shares: Vec<&[Bat]> = bats.chunks(SHARE).collect();
    let share = |k: usize| {
        let bats = shares[k];
        let mut results = Vec::with_capacity(bats.len());
        each(bats, request, way, |i, found| results.push(read(k * SHARE + i, found)));
        results
    };
    threads::map(shares.len(), share).into_iter().flatten().collect()
}

type Visit<'a> = &'a mut dyn FnMut(usize, Result<Found<'_>>);

fn with_degree<const N: usize, const W: usize>(
    bats: &[Bat],
    request: &Request,
    way: Way,
    plan: Plan,
    visit: Visit,
) {
    let mut alone = Worker::<f64, N, W>::new(&bats[0], request.theory, plan.clone(), 0);
    if alone.solve(&[&bats[0]], request).is_err() {
        // The first bat tells how many Lanczos steps there are to be; without it each is on its
        // own.
        return all_alone(bats, request, visit);
    }
    alone.steps = alone.pairs.lanczos.steps;
    let mut together = Worker::<Lanes, N, W>::new(&bats[0], request.theory, plan, alone.steps);
    let lanes = if way == Way::SideBySide { WIDTH } else { 1 };
    for (group, group_bats) in bats.chunks(lanes).enumerate() {
        let first = lanes * group;
        let alike = |bat: &Bat| same_pattern(bat, &bats[0]);
        if let (Ok(group), true) =
            (<&[Bat; WIDTH]>::try_from(group_bats), group_bats.iter().all(alike))
        {
            together.run(first, &group.each_ref(), request, visit);
            continue;
        }
        for (k, bat) in group_bats.iter().enumerate() {
            if alike(bat) {
                alone.run(first + k, &[bat], request, visit);
            } else {
                solved_alone(first + k, bat, request, visit);
            }
        }
    }
}

/// Whether a bat can share the plan of another: as many pieces, sampled at as many points, of like
/// proportions, and with masses at the same borders, so that the same elements serve both.
fn same_pattern(a: &Bat, b: &Bat) -> bool {
    const ALIKE: f64 = 2.5;
    let widest = |bat: &Bat| bat.profile().stations.outer.iter().fold(0.0_f64, |m, r| m.max(*r));
    let (widest_a, widest_b) = (widest(a), widest(b));
    let pieces = a.profile().pieces.iter().zip(&b.profile().pieces);
    // Where what is on a bat is, by the piece that begins there, and which of it has a mass.
    let masses = |bat: &Bat| -> Vec<bool> {
        bat.fixtures().attachments.iter().map(|a| a.mass + a.rotary_inertia > 0.0).collect()
    };
    let border = |bat: &Bat, x: f64| {
        let same = SAME_PLACE * bat.length();
        bat.profile().pieces.partition_point(|piece| piece.start < x - same)
    };
    let borders = |bat: &Bat| -> Vec<usize> {
        bat.fixtures().borders().into_iter().map(|x| border(bat, x)).collect()
    };
    a.profile().pieces.len() == b.profile().pieces.len()
        && plain(a) == plain(b)
        && masses(a) == masses(b)
        && borders(a) == borders(b)
        && std::ptr::eq(Rule::of(a, false, 3), Rule::of(b, false, 3))
        && pieces.flat_map(|(a, b)| std::iter::zip(a.ends(), b.ends())).all(|(of_a, of_b)| {
            let (of_a, of_b) = (of_a.outer * widest_b, of_b.outer * widest_a);
            of_a <= ALIKE * of_b && of_b <= ALIKE * of_a
        })
}

/// The memory of one way through the bats.
struct Worker<R, const N: usize, const W: usize> {
    plan: Plan,
    /// Lanczos steps for every bat, so that a bat's answer does not depend on its neighbours; 0 for
    /// as many as it takes.
    steps: usize,
    pairs: Eigenpairs<R, N, W>,
    meshes: Vec<Mesh>,
    /// Lane after lane, what [`Found`] shows.
    omegas: Vec<f64>,
    errors: Vec<f64>,
    modal_masses: Vec<f64>,
    shapes: Vec<f64>,
    /// Whether a lane's modes have all nodes that theory demands.
    counted: Vec<bool>,
}

impl<R: Real, const N: usize, const W: usize> Worker<R, N, W>
where
    Lanes: Over<R>,
{
    fn new(bat: &Bat, theory: Theory, plan: Plan, steps: usize) -> Self {
        Self {
            steps,
            pairs: Eigenpairs::new(bat, theory),
            meshes: vec![Mesh::default(); R::LANES],
            plan,
            omegas: vec![],
            errors: vec![],
            modal_masses: vec![],
            shapes: vec![],
            counted: vec![],
        }
    }

    /// Solves as many bats as there are lanes; those that miss are solved on their own.
    fn run(&mut self, first: usize, bats: &[&Bat], request: &Request, visit: Visit) {
        if self.solve(bats, request).is_err() {
            for (k, bat) in bats.iter().enumerate() {
                solved_alone(first + k, bat, request, visit);
            }
            return;
        }
        let (modes, coefficients) = (request.modes, N * self.plan.mesh.len());
        for lane in 0..R::LANES {
            let own = |each: usize| lane * modes * each..(lane + 1) * modes * each;
            let errors = &self.errors[own(1)];
            let met = errors.iter().all(|error| *error <= request.tolerance);
            if !met || !self.counted[lane] {
                solved_alone(first + lane, bats[lane], request, visit);
                continue;
            }
            let found = Found {
                omegas: &self.omegas[own(1)],
                errors,
                modal_masses: &self.modal_masses[own(1)],
                shapes: &self.shapes[own(coefficients)],
                mesh: &self.meshes[lane],
                degree: N - 1,
            };
            visit(first + lane, Ok(found));
        }
    }

    fn solve(&mut self, bats: &[&Bat], request: &Request) -> Result<()> {
        for (mesh, bat) in self.meshes.iter_mut().zip(bats) {
            mesh.fit(bat, &self.plan.mesh);
        }
        let modes = request.modes;
        let numbers = R::LANES * modes;
        for values in [&mut self.omegas, &mut self.errors, &mut self.modal_masses] {
            values.resize(numbers, 0.0);
        }
        self.shapes.resize(numbers * N * self.plan.mesh.len(), 0.0);
        self.counted.clear();
        self.counted.resize(R::LANES, true);
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
        // On an asked mesh both ways are to agree to 1e-12, whatever the tolerance.
        let most = if request.elements.is_some() { 1e-6 } else { 1.0 };
        let tolerant = Request { elements: None, ..*request };
        match self.steps {
            0 => self.pairs.solve(modes, stop_at(&tolerant).min(most))?,
            steps => self.pairs.solve_in(modes, steps)?,
        }
        let depth = if request.elements.is_some() { Depth::Shape } else { Depth::Defect };
        for first in (0..modes).step_by(Eigenpairs::<R, N, W>::TOGETHER) {
            self.pairs.look(first, depth);
            self.keep(first, modes, depth);
        }
        self.add_residuals(modes);
        self.count(modes);
        Ok(())
    }

    /// Whether every bat has as many motions slower than its last mode as it has modes: of a bare bat whose
    /// sections do not turn the nodes tell, of others those between the last mode and the next.
    fn count(&mut self, modes: usize) {
        let Self { pairs, omegas, counted, .. } = self;
        let statics = &pairs.statics;
        if modes == 0 || statics.fixed.is_none() && !statics.theory.turns() {
            return;
        }
        let mut between = R::default();
        for (bat, counted) in counted.iter_mut().enumerate() {
            let (last, unit) = (omegas[(bat + 1) * modes - 1], statics.energy_unit.lane(bat));
            let next = pairs.lanczos.beyond.map(|value| (unit / value.lane(bat)).sqrt());
            *counted &= next.is_some();
            between.set_lane(bat, (last * next.unwrap_or(last)).sqrt());
        }
        let found = widest(Count { view: statics.view(), omega: between });
        for (bat, counted) in counted.iter_mut().enumerate() {
            let slower = found.map(|count| count.lane(bat));
            *counted &= slower == Some((modes + 2) as f64);
        }
    }

    /// What the iteration left, `½ residual²/gap`, and what near twins share, as
    /// [`crate::modes::certificate::add_neighbours`]; a bat with one beyond the list is solved alone.
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
            let last = modes.checked_sub(1).map(|last| lanczos.values[last].lane(bat));
            let twin =
                |beyond: &R| last.is_some_and(|last| is_twin(beyond.lane(bat) / last, modes));
            self.counted[bat] &= !lanczos.beyond.as_ref().is_some_and(twin);
        }
    }

    /// Writes down the motions that were looked at: modes from `first` on, of every bat.
    fn keep(&mut self, first: usize, modes: usize, depth: Depth) {
        let (statics, motions) = (&self.pairs.statics, &self.pairs.motions);
        let mut largest = motions.ends[0][0].abs().max(motions.ends[1][0].abs());
        motions.deflections.iter().for_each(|w| largest = largest.max(w.abs()));
        let scale = Lanes::splat(1.0).copysign(motions.ends[1][0]) / largest;
        let mass = motions.kinetic * scale * scale;
        // Else [`Self::count`] tells whether a mode is missing.
        let by_nodes = statics.fixed.is_none() && !statics.theory.turns();
        let crossings = motions.crossings(statics.split);
        let (elements, over) = (statics.cells.len(), !statics.softness[0].is_empty());
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
            // Outwards is backwards on the knob side, where odd polynomials change sign.
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

/// How many motions are slower than a frequency, of the bats in the lanes.
struct Count<'a, R> {
    view: View<'a, R>,
    omega: R,
}

impl<R: Real> WithSimd for Count<'_, R> {
    type Output = Option<R>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Option<R> {
        slower_each(&self.view, self.omega)
    }
}

/// One bat with a plan of its own.
fn solved_alone(place: usize, bat: &Bat, request: &Request, visit: Visit) {
    let solution = match solve(bat, request) {
        Ok(solution) => solution,
        Err(error) => return visit(place, Err(error)),
    };
    let of = |f: &dyn Fn(&Mode) -> f64| solution.modes.iter().map(f).collect();
    let error = |mode: &Mode| match request.elements {
        Some(_) => mode.error.round_off + 0.5 * mode.error.residual.powi(2),
        None => mode.error.total(),
    };
    let (omegas, errors, modal_masses): (Vec<f64>, Vec<f64>, Vec<f64>) =
        (of(&|m| m.omega), of(&error), of(&|m| m.modal_mass));
    let shapes: Vec<f64> =
        solution.modes.iter().flat_map(|m| m.shape.coefficients()).copied().collect();
    visit(
        place,
        Ok(Found {
            omegas: &omegas,
            errors: &errors,
            modal_masses: &modal_masses,
            shapes: &shapes,
            mesh: &solution.mesh,
            degree: solution.degree,
        }),
    );
}
