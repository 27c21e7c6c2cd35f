//! What are the lowest bending modes of bats on one mesh?
//!
//! The engine below [`crate::solve()`] and [`crate::modes::batch`]; call those instead. It uses the widest vectors of
//! the machine, and memory that the next bats reuse.
//!
//! Results are equal to the last bit with any vector width and in every lane: sums keep their order, and no product is
//! fused with a sum.

use std::ops::Range;

use crate::base::{Lanes, Over, Real, Result, WIDTH, vectorized};
use crate::bat::{Bat, Theory};
use crate::beam::motion::Known;
use crate::beam::sweep::Rigid;
use crate::beam::{Depth, Loads, Mesh, Motion, Statics, View};
use crate::eigen::lanczos::{Lanczos, Space, Wanted};

/// Bats in the lanes of `R`, elements of degree `N − 1` with `W − 2` strains.
#[derive(Debug, Clone)]
pub struct Eigenpairs<R, const N: usize, const W: usize> {
    /// The compliance of the bats.
    pub statics: Statics<R, N, W>,
    /// The iteration.
    pub lanczos: Lanczos<R>,
    /// The modes evaluated last: the modes of one bat side by side, or one mode of several bats.
    pub motions: Motion<Lanes>,
    /// Their scaled strains.
    strains: Vec<Lanes>,
    loads: Loads<R, W>,
    image: Vec<R>,
    /// The rigid motion that every step of the last iteration removes, each with the loads of its point masses.
    removed: Vec<[R; 2]>,
}

impl<R: Real, const N: usize, const W: usize> Eigenpairs<R, N, W>
where
    Lanes: Over<R>,
{
    /// Number of modes that are evaluated together.
    pub const TOGETHER: usize = WIDTH / R::LANES;

    /// An empty engine for bats like this one.
    pub fn new(bat: &Bat, theory: Theory) -> Self {
        Self {
            statics: Statics::empty(bat, theory),
            lanczos: Lanczos::default(),
            motions: Motion::default(),
            strains: vec![],
            loads: Loads::default(),
            image: vec![],
            removed: vec![],
        }
    }

    /// Assembles the bats, one per lane, on meshes of one pattern.
    pub fn assemble(&mut self, bats: &[&Bat], meshes: &[&Mesh]) {
        vectorized!(self.statics.assemble(bats, meshes));
    }

    /// Finds the `count` slowest modes to that residual.
    ///
    /// # Errors
    ///
    /// As [`Lanczos::largest`].
    pub fn solve(&mut self, count: usize, residual: f64) -> Result<()> {
        let earliest = steps_beyond(self.statics.theory, count, residual);
        self.iterate(self.wanted(count, residual, earliest))
    }

    /// Takes exactly that number of steps, whatever the residual; [`Motion::defect`] gives the accuracy.
    ///
    /// # Errors
    ///
    /// As [`Lanczos::largest`].
    pub fn solve_in(&mut self, count: usize, steps: usize) -> Result<()> {
        let earliest = steps.saturating_sub(count);
        self.iterate(self.wanted(count, f64::INFINITY, earliest))
    }

    /// The request to the iteration: fixtures may have modes of nearly the same frequency.
    fn wanted(&self, count: usize, residual: f64, earliest: usize) -> Wanted {
        let clustered = self.statics.fixed.as_ref().map_or(0, |fixed| fixed.placed.local());
        Wanted { count, residual, earliest, clustered }
    }

    fn iterate(&mut self, wanted: Wanted) -> Result<()> {
        let start = &mut |statics: &Statics<R, N, W>, next: &mut [R]| {
            begin(&statics.view(), wanted.count, next);
        };
        self.run(wanted, &[], start)
    }

    fn run(
        &mut self,
        wanted: Wanted,
        known: &[R],
        start: &mut dyn FnMut(&Statics<R, N, W>, &mut [R]),
    ) -> Result<()> {
        let Self { statics, lanczos, loads, removed, .. } = self;
        removed.clear();
        // Removes what the contacts do not allow: a step divides by a small number and would amplify it.
        let allow =
            &mut |next: &mut [R]| statics.fixed.iter().for_each(|fixed| fixed.project(next));
        let apply = &mut |q: &[R], y: &mut [R]| {
            let Rigid { push, turn } = statics.apply(q, y, loads);
            removed.push([push, turn]);
            removed.extend_from_slice(&loads.points);
        };
        let start = &mut |next: &mut [R]| start(statics, next);
        iterate(lanczos, statics.dimension(), wanted, Space { known, allow }, start, apply)
    }

    /// Evaluates the modes that were found, from index `first` on, to the given depth: [`Self::TOGETHER`] of them or as
    /// many as there are. Frequencies follow from the eigenvalues, rigid motions and loads from those of the steps.
    pub fn look(&mut self, first: usize, depth: Depth) {
        let Self { statics, motions, lanczos, strains, removed, .. } = self;
        let (dimension, last) = (statics.dimension(), lanczos.values.len() - 1);
        strains.resize(dimension, Lanes::default());
        motions.image.clear();
        let each = removed.len() / lanczos.steps;
        let mut values = Lanes::default();
        motions.forces.resize(each, [Lanes::default(); 2]);
        for k in 0..Self::TOGETHER {
            let (pair, lanes) = ((first + k).min(last), k * R::LANES..(k + 1) * R::LANES);
            for (place, sums) in motions.forces.iter_mut().enumerate() {
                let mut own = [R::default(); 2];
                for (step, parts) in removed.chunks_exact(each).enumerate() {
                    let weight = lanczos.weight(pair, step);
                    own[0] += weight * parts[place][0];
                    own[1] += weight * parts[place][1];
                }
                side_by_side(&own, sums, lanes.clone());
            }
            let value = std::slice::from_mut(&mut values);
            side_by_side(&lanczos.values[pair..=pair], value, lanes.clone());
            side_by_side(&lanczos.vectors[pair * dimension..][..dimension], strains, lanes);
        }
        let [push, turn] = motions.forces.remove(0);
        let known = Known { value: Some(values), others: &[] };
        look(&statics.view(), Rigid { push, turn }, motions, strains, known, depth);
    }

    /// Evaluates the modes with these scaled strains, which follow one after the other, from index `first` on; the last
    /// mode fills unused lanes. Frequencies follow from both energies.
    pub fn look_at(&mut self, vectors: &[R], first: usize, depth: Depth) {
        let Self { statics, motions, strains, loads, image, .. } = self;
        let dimension = statics.dimension();
        let last = vectors.len() / dimension - 1;
        strains.resize(dimension, Lanes::default());
        image.resize(dimension, R::default());
        motions.image.resize(dimension, Lanes::default());
        let (mut rigid, mut taken) = (Rigid::<Lanes>::default(), Rigid::default());
        for k in 0..Self::TOGETHER {
            let own = &vectors[(first + k).min(last) * dimension..][..dimension];
            if first + k <= last {
                taken = statics.apply(own, image, loads);
            }
            let lanes = k * R::LANES..(k + 1) * R::LANES;
            motions.forces.resize(loads.points.len(), [Lanes::default(); 2]);
            for (force, load) in motions.forces.iter_mut().zip(&loads.points) {
                side_by_side(load, force, lanes.clone());
            }
            side_by_side(&[taken.push], std::slice::from_mut(&mut rigid.push), lanes.clone());
            side_by_side(&[taken.turn], std::slice::from_mut(&mut rigid.turn), lanes.clone());
            side_by_side(own, strains, lanes.clone());
            side_by_side(image, &mut motions.image, lanes);
        }
        look(&statics.view(), rigid, motions, strains, Known { value: None, others: &[] }, depth);
    }
}

/// Copies the lanes of numbers into those of others, up to the shorter of both.
fn side_by_side<R: Real>(from: &[R], into: &mut [Lanes], lanes: Range<usize>) {
    for (into, from) in into.iter_mut().zip(from) {
        lanes.clone().enumerate().for_each(|(k, lane)| into.set_lane(lane, from.lane(k)));
    }
}

/// Number of steps beyond `count = n` after which convergence is likely; a test costs as much as some steps. With a
/// residual of 10^−d it is `2.5 + 0.375 n + 0.35 n^⅓ (d − 4)`, and `2 + 0.65 n + 0.41 √n (d − 4)` with shear, where
/// frequencies lie closer together. It was fitted to a dowel, a cone and two bats with 1 to 60 modes. It is right to
/// one step nearly always, and to two in all runs of `examples/tuning/iterations.rs`, which prints the steps taken
/// beside the formula's.
pub fn steps_beyond(theory: Theory, count: usize, residual: f64) -> usize {
    let (n, digits) = (count as f64, -residual.log10());
    let steps = if theory.shears() {
        2.0 + 0.65 * n + 0.41 * n.sqrt() * (digits - 4.0)
    } else {
        2.5 + 0.375 * n + 0.35 * n.cbrt() * (digits - 4.0)
    };
    steps.ceil().max(2.0) as usize
}

impl<const N: usize, const W: usize> Eigenpairs<f64, N, W> {
    /// To be called after [`Self::solve`]. If a few modes are far slower than the others, as for a bat on soft springs
    /// or with a heavy weight, finds the others again, orthogonal to these, whose round-off they would otherwise
    /// contain. Returns the number of far slower modes.
    ///
    /// # Errors
    ///
    /// As [`Lanczos::largest`].
    pub fn solve_apart(&mut self, residual: f64) -> Result<usize> {
        /// Ratio of eigenvalues of the compliance that counts as far: a factor of 100 in frequency.
        const FAR: f64 = 1e4;
        const MOST: usize = 4;
        let found = &self.lanczos.values;
        let far = |k: &usize| found[k - 1] > FAR * found[*k];
        let Some(apart) = (1..found.len().min(MOST + 1)).rev().find(far) else { return Ok(0) };
        let (count, size) = (found.len() - apart, self.statics.dimension());
        let mut values = found[..apart].to_vec();
        let mut residuals = self.lanczos.residuals[..apart].to_vec();
        let mut vectors = self.lanczos.vectors[..apart * size].to_vec();
        let steps = self.lanczos.steps;
        let earliest = steps_beyond(self.statics.theory, count, residual);
        self.run(self.wanted(count, residual, earliest), &vectors, &mut |statics, next| {
            statics.view().start(count, next);
        })?;
        values.append(&mut self.lanczos.values);
        residuals.append(&mut self.lanczos.residuals);
        vectors.append(&mut self.lanczos.vectors);
        let lanczos = &mut self.lanczos;
        (lanczos.values, lanczos.residuals, lanczos.vectors) = (values, residuals, vectors);
        lanczos.steps += steps;
        Ok(apart)
    }
}

/// The iteration, compiled once for all degrees and theories.
fn iterate<R: Real>(
    lanczos: &mut Lanczos<R>,
    dimension: usize,
    wanted: Wanted,
    space: Space<R>,
    start: &mut dyn FnMut(&mut [R]),
    apply: &mut dyn FnMut(&[R], &mut [R]),
) -> Result<()> {
    vectorized!(lanczos.largest(dimension, wanted, space, start, apply))
}

/// The start of the iteration, compiled once for all degrees and theories.
fn begin<R: Real>(view: &View<R>, count: usize, next: &mut [R]) {
    vectorized!(view.start(count, next));
}

/// The evaluation of modes, compiled once for all degrees and theories.
fn look<S: Real, R: Over<S>>(
    view: &View<S>,
    rigid: Rigid<R>,
    motions: &mut Motion<R>,
    strains: &[R],
    known: Known<R, S>,
    depth: Depth,
) {
    vectorized!(motions.look(view, rigid, strains, known, depth));
}
