//! What are the modes of many bats, as fast as possible?
//!
//! [`each`] solves them on one core, [`all`] on all cores: one after the other, or side by side in the lanes of a
//! vector. [`solutions`] gives for every bat what [`solve`](crate::modes::solve::solve) gives.
//!
//! All bats share the first one's plan, root and number of Lanczos steps, and every lane takes its own steps. A bat's
//! result therefore has the same bits whichever bats share its batch, and also one by one. A bat is planned and solved
//! alone if it has other proportions, a formula, or fixtures other than masses, or if its result misses the tolerance
//! or a mode by its own estimate. If the first bat is of this kind, all are solved alone. After the first bats, almost
//! no memory is allocated.

mod alike;
mod worker;

use crate::base::{Lanes, Over, Real, Result, WIDTH, threads};
use crate::bat::Bat;
use crate::beam::{OfDegree, of_degree};
use crate::modes::batch::alike::{plain, same_pattern};
use crate::modes::batch::worker::Worker;
use crate::modes::mode::Mode;
use crate::modes::plan::Plan;
use crate::modes::prepared::{Prepared, prepare};
use crate::modes::refine::{damped, refine};
use crate::modes::solution::Solution;
use crate::modes::solve::{Request, Solver, wanted};

pub use crate::modes::batch::worker::Found;

/// How the bats are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// One after the other.
    OneByOne,
    /// Eight at a time in the lanes of a vector.
    SideBySide,
}

/// Degrees that a batch is compiled for: code for all of them would be large.
const COMPILED: [usize; 5] = [3, 4, 6, 8, 10];

const fn is_compiled(degree: usize) -> bool {
    let mut k = 0;
    while k < COMPILED.len() && COMPILED[k] != degree {
        k += 1;
    }
    k < COMPILED.len()
}

/// Solves every bat with the statics solver and passes each result to `visit`, with its index among the bats.
///
/// Every estimated error of a frequency is within the tolerance, as far as [`solve`](crate::modes::solve::solve) can
/// reach it. With `request.elements` every bat gets that mesh, and the tolerance covers only the iteration, not the
/// mesh's error.
pub fn each(
    bats: &[Bat],
    request: &Request,
    way: Way,
    mut visit: impl FnMut(usize, Result<Found<'_>>),
) {
    let request = Request { solver: Solver::Statics, ..*request };
    let mut ready = bats.iter().map(|bat| prepare(bat, &request)).peekable();
    let mut place = 0;
    while let Some(first) = ready.next() {
        let Prepared { bat, request, .. } = match first {
            Ok(first) => first,
            Err(error) => {
                visit(place, Err(error));
                place += 1;
                continue;
            }
        };
        // Later bats for which the same theory is chosen share its plan.
        let alike =
            |next: &Result<Prepared>| next.as_ref().is_ok_and(|next| next.request == request);
        let mut run = Vec::with_capacity(bats.len() - place);
        run.push(bat);
        while let Some(Ok(next)) = ready.next_if(alike) {
            run.push(next.bat);
        }
        let run: Vec<&Bat> = run.iter().map(|bat| &**bat).collect();
        let shown = &mut |k: usize, found: Result<Found<'_>>| visit(place + k, found);
        shown_to(run[0], &run, &request, way, Visit::Figures(shown));
        place += run.len();
    }
}

/// Solves every bat for its request, with a plan of `model`, and passes each [`Solution`] to `visit` with the bat's
/// index. A solution has everything that [`solve`](crate::modes::solve::solve) gives except the time. Bats with equal
/// requests must follow each other.
///
/// A bat's solution depends on the bat, its request and the model, not on the other bats. If the request asks for a
/// mesh or another solver, the bat is solved alone.
pub fn solutions(
    model: &Bat,
    asked: &[(&Bat, Request)],
    way: Way,
    mut visit: impl FnMut(usize, Result<Solution>),
) {
    let mut ready: Vec<(usize, Prepared)> = Vec::with_capacity(asked.len());
    for (place, (bat, request)) in asked.iter().enumerate() {
        match prepare(bat, request) {
            Ok(one) => ready.push((place, one)),
            Err(error) => visit(place, Err(error)),
        }
    }
    let mut left: Vec<usize> = (0..ready.len()).collect();
    while let Some(&first) = left.first() {
        let request = ready[first].1.request;
        // The first one always belongs to it: NaN does not even equal itself.
        let alike = |k: &usize| *k == first || ready[*k].1.request == request;
        let (alike, others): (Vec<usize>, Vec<usize>) = left.into_iter().partition(alike);
        let bats: Vec<&Bat> = alike.iter().map(|k| &*ready[*k].1.bat).collect();
        let visit = &mut |k: usize, solution: Result<Solution>| {
            let (place, Prepared { bat, .. }) = &ready[alike[k]];
            visit(*place, solution.map(|solution| solution.of_tapped(bat.clone())));
        };
        shown_to(model, &bats, &request, way, Visit::Solutions(visit));
        left = others;
    }
}

/// The receiver of the bats' results, in order, each with its index.
enum Visit<'a> {
    Figures(&'a mut dyn FnMut(usize, Result<Found<'_>>)),
    Solutions(&'a mut dyn FnMut(usize, Result<Solution>)),
}

fn shown_to(model: &Bat, bats: &[&Bat], request: &Request, way: Way, visit: Visit) {
    let degree = request.degree.or(request.elements.map(|_| 3));
    let degrees = degree.map_or(COMPILED.to_vec(), |degree| vec![degree]);
    let sharing = request.check(WIDTH).is_ok()
        && request.solver == Solver::Statics
        && plain(model)
        && (!request.theory.shears() || model.knows_shear())
        && COMPILED.contains(&degrees[0]);
    // A full solution has all its errors, also those of a mesh that was asked for.
    let whole = matches!(visit, Visit::Solutions(_));
    if !sharing || whole && (request.elements.is_some() || request.modes == 0) {
        return all_alone(bats, request, visit);
    }
    let plan = match request.elements {
        Some(elements) => Plan::fixed(model, elements, degrees[0]),
        None => Plan::cheapest_among(model, &wanted(request), degrees),
    };
    of_degree(plan.degree, request.theory, Alike { model, bats, request, way, plan, visit })
}

/// Bats that may use the plan of a model.
struct Alike<'a, 'v> {
    model: &'a Bat,
    bats: &'a [&'a Bat],
    request: &'a Request,
    way: Way,
    plan: Plan,
    visit: Visit<'v>,
}

impl OfDegree for Alike<'_, '_> {
    type Output = ();

    fn with<const N: usize, const W: usize>(self) {
        // Side by side only for a few degrees: each takes long to compile.
        if const { is_compiled(N - 1) } {
            self.with_degree::<N, W>();
        } else {
            all_alone(self.bats, self.request, self.visit);
        }
    }
}

impl Alike<'_, '_> {
    fn with_degree<const N: usize, const W: usize>(self) {
        let Self { model, bats, request, way, plan, mut visit } = self;
        let theory = request.theory;
        let mut alone = Worker::<f64, N, W>::new(model, theory, plan.clone());
        if alone.iterate(&[model], request).is_err() {
            // The model gives the number of Lanczos steps; without it each bat is solved alone.
            return all_alone(bats, request, visit);
        }
        let mut together = Worker::<Lanes, N, W>::new(model, theory, plan);
        let choices = alone.choices();
        together.choose(choices);
        alone.choose(choices);
        let alike =
            |bat: &&Bat| (!theory.shears() || bat.knows_shear()) && same_pattern(bat, model);
        /// Size of a cache (bytes): if the vectors of eight bats are larger, one bat after the other is faster. The
        /// bits are the same.
        const NEAR: usize = 400_000;
        let near = together.basis(choices) <= NEAR;
        let lanes = if way == Way::SideBySide && near { WIDTH } else { 1 };
        for (group, bats) in bats.chunks(lanes).enumerate() {
            let whole = bats.len() == WIDTH && bats.iter().all(alike);
            let seen = whole && visit.look(&mut together, bats, request);
            for (lane, bat) in bats.iter().enumerate() {
                let one = (lanes * group + lane, *bat, request);
                let shown = seen && visit.show(&mut together, lane, one)
                    || alike(bat)
                        && visit.look(&mut alone, &[bat], request)
                        && visit.show(&mut alone, 0, one);
                if !shown {
                    visit.alone(one);
                }
            }
        }
    }
}

fn all_alone(bats: &[&Bat], request: &Request, mut visit: Visit) {
    bats.iter().enumerate().for_each(|(k, bat)| visit.alone((k, bat, request)));
}

impl Visit<'_> {
    /// Evaluates as many bats as there are lanes; returns whether they could be solved.
    fn look<R: Real, const N: usize, const W: usize>(
        &self,
        worker: &mut Worker<R, N, W>,
        bats: &[&Bat],
        request: &Request,
    ) -> bool
    where
        Lanes: Over<R>,
    {
        let solved = worker.iterate(bats, request).is_ok();
        match self {
            _ if !solved => {}
            Self::Figures(_) => worker.look(bats, request),
            Self::Solutions(_) => worker.look_closely(bats, request),
        }
        solved
    }

    /// Passes on the bat in an evaluated lane; false if it misses the tolerance or a mode.
    fn show<R: Real, const N: usize, const W: usize>(
        &mut self,
        worker: &mut Worker<R, N, W>,
        lane: usize,
        (place, bat, request): (usize, &Bat, &Request),
    ) -> bool
    where
        Lanes: Over<R>,
    {
        let shown = match self {
            Self::Figures(visit) => {
                worker.found(lane, request).map(|found| visit(place, Ok(found)))
            }
            Self::Solutions(visit) => {
                worker.take(lane).map(|solution| visit(place, damped(bat, request, solution)))
            }
        };
        shown.is_some()
    }

    /// Solves one bat with its own plan.
    fn alone(&mut self, (place, bat, request): (usize, &Bat, &Request)) {
        let solved = refine(bat, request);
        match self {
            Self::Solutions(visit) => visit(place, solved),
            Self::Figures(visit) => match solved {
                Ok(solution) => figures(&solution, request, |found| visit(place, Ok(found))),
                Err(error) => visit(place, Err(error)),
            },
        }
    }
}

/// Passes a solution's figures on, for all modes.
fn figures(solution: &Solution, request: &Request, visit: impl FnOnce(Found)) {
    let of = |f: &dyn Fn(&Mode) -> f64| -> Vec<f64> { solution.modes.iter().map(f).collect() };
    let error = |mode: &Mode| match request.elements {
        Some(_) => mode.error.round_off + 0.5 * mode.error.residual.powi(2),
        None => mode.error.total(),
    };
    let coefficients = solution.modes.iter().flat_map(|mode| mode.shape.coefficients());
    visit(Found {
        omegas: &of(&|mode| mode.omega),
        errors: &of(&error),
        modal_masses: &of(&|mode| mode.modal_mass),
        shapes: &coefficients.copied().collect::<Vec<f64>>(),
        mesh: &solution.mesh,
        degree: solution.degree,
    });
}

/// Solves every bat on all cores; each share of 256 bats uses the plan of its first bat.
///
/// The values that `read` returns come in the order of the bats. Accuracy and mesh are as in [`each`].
///
/// ```
/// use sweetspot::modes::batch::{Way, all};
/// use sweetspot::{Bat, Request};
///
/// # fn main() -> sweetspot::Result<()> {
/// # let bat = Bat::builtin("r161")?;
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
