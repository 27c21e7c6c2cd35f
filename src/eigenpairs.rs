//! The lowest bending motions of bats on one mesh, with whatever vectors the machine has and
//! memory that the next bats use again.
//!
//! The same bits whatever the vectors and in every lane: nothing is added in another order, and no
//! product is fused with a sum.

use pulp::{Arch, Simd, WithSimd};

use crate::bat::Bat;
use crate::beam::element::Vector;
use crate::beam::mesh::Mesh;
use crate::beam::motion::Motion;
use crate::beam::statics::Statics;
use crate::eigen::lanczos::{Lanczos, Wanted};
use crate::error::Result;
use crate::lanes::{Lanes, WIDTH};
use crate::real::{Over, Real};

/// Bats in the lanes of `R`, elements of degree `N − 1`.
#[derive(Debug, Clone)]
pub struct Eigenpairs<R, const N: usize> {
    pub statics: Statics<R, N>,
    pub lanczos: Lanczos<R>,
    /// The motions that were looked at last: the modes of one bat side by side, or the bats in one
    /// mode.
    pub motions: Motion<Lanes, N>,
    loads: Vec<Vector<R, N>>,
    /// Their scaled strains.
    strains: Vec<Lanes>,
}

/// How closely a motion is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// Its shape and energies.
    Shape,
    /// Its defect too.
    Defect,
    /// And by how much the shape may be off.
    Changes,
}

impl<R: Real, const N: usize> Eigenpairs<R, N>
where
    Lanes: Over<R>,
{
    /// How many modes are looked at together.
    pub const TOGETHER: usize = WIDTH / R::LANES;

    /// Nothing yet, for bats like this one.
    pub fn new(bat: &Bat) -> Self {
        Self {
            statics: Statics::empty(bat),
            lanczos: Lanczos::default(),
            motions: Motion::default(),
            loads: vec![],
            strains: vec![],
        }
    }

    /// Assembles the bats, one per lane, on meshes of one pattern.
    pub fn assemble(&mut self, bats: &[&Bat], meshes: &[&Mesh]) {
        Arch::new().dispatch(Assembly { statics: &mut self.statics, bats, meshes });
    }

    /// Finds the `count` slowest motions to that residual.
    ///
    /// # Errors
    ///
    /// As [`Lanczos::largest`].
    pub fn solve(&mut self, count: usize, residual: f64) -> Result<()> {
        self.iterate(Wanted { count, residual, earliest: steps_beyond(count, residual) })
    }

    /// The same from a start of one's own: bending moments as [`Statics::strains_of_moments`] asks
    /// for them.
    ///
    /// # Errors
    ///
    /// As [`Lanczos::largest`].
    pub fn solve_from(
        &mut self,
        count: usize,
        residual: f64,
        moments: impl FnMut(&mut [R]),
    ) -> Result<()> {
        let Self { statics, lanczos, loads, .. } = self;
        let wanted = Wanted { count, residual, earliest: 0 };
        let mut start = vec![R::default(); statics.dimension()];
        statics.strains_of_moments(&mut start, moments);
        Arch::new().dispatch(Iteration { statics, lanczos, loads, wanted, start: Some(start) })
    }

    /// Takes that many steps and no more, whatever residual that leaves: [`Motion::defect`] tells.
    ///
    /// # Errors
    ///
    /// As [`Lanczos::largest`].
    pub fn solve_in(&mut self, count: usize, steps: usize) -> Result<()> {
        let earliest = steps.saturating_sub(count);
        self.iterate(Wanted { count, residual: f64::INFINITY, earliest })
    }

    fn iterate(&mut self, wanted: Wanted) -> Result<()> {
        let Self { statics, lanczos, loads, .. } = self;
        Arch::new().dispatch(Iteration { statics, lanczos, loads, wanted, start: None })
    }

    /// Looks at the motions from number `first` of those found on, [`Self::TOGETHER`] of them or as
    /// many as there are, as closely as wanted, their frequencies from the eigenvalues.
    pub fn look(&mut self, first: usize, depth: Depth) {
        let vectors = std::mem::take(&mut self.lanczos.vectors);
        let last = self.lanczos.values.len() - 1;
        let mut values = Lanes::default();
        for lane in 0..WIDTH {
            let k = (first + lane / R::LANES).min(last);
            values.set_lane(lane, self.lanczos.values[k].lane(lane % R::LANES));
        }
        self.gather(&vectors, first);
        self.lanczos.vectors = vectors;
        let Self { statics, motions, strains, .. } = self;
        Arch::new().dispatch(Look { statics, motions, strains, value: Some(values), depth });
    }

    /// The same with the motions of these scaled strains, one after the other, their frequencies
    /// from both energies.
    pub fn look_at(&mut self, vectors: &[R], first: usize, depth: Depth) {
        self.gather(vectors, first);
        let Self { statics, motions, strains, .. } = self;
        Arch::new().dispatch(Look { statics, motions, strains, value: None, depth });
    }

    /// Strains side by side; the last motion again where there are no more.
    fn gather(&mut self, vectors: &[R], first: usize) {
        let dimension = self.statics.dimension();
        let last = vectors.len() / dimension - 1;
        self.strains.resize(dimension, Lanes::default());
        for lane in 0..WIDTH {
            let k = (first + lane / R::LANES).min(last);
            let from = &vectors[k * dimension..(k + 1) * dimension];
            for (strain, from) in self.strains.iter_mut().zip(from) {
                strain.set_lane(lane, from.lane(lane % R::LANES));
            }
        }
    }
}

impl<const N: usize> Eigenpairs<f64, N> {
    /// Looks at one motion alone, in the memory that one takes, as [`Self::look_at`].
    pub fn look_at_one(&self, strains: &[f64], depth: Depth, motions: &mut Motion<f64, N>) {
        let statics = &self.statics;
        Arch::new().dispatch(Look { statics, motions, strains, value: None, depth });
    }
}

/// After how many steps beyond `count = n` convergence is likely: looking for it costs as much as some
/// steps. With a residual of 10^−d it is `2.5 + 0.375 n + 0.35 n^⅓ (d − 4)`, fitted to a dowel, a
/// cone and two bats, 1 to 60 modes, right to one step.
fn steps_beyond(count: usize, residual: f64) -> usize {
    let (n, digits) = (count as f64, -residual.log10());
    (2.5 + 0.375 * n + 0.35 * n.cbrt() * (digits - 4.0)).ceil().max(2.0) as usize
}

struct Assembly<'a, R, const N: usize> {
    statics: &'a mut Statics<R, N>,
    bats: &'a [&'a Bat],
    meshes: &'a [&'a Mesh],
}

impl<R: Real, const N: usize> WithSimd for Assembly<'_, R, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.statics.assemble(self.bats, self.meshes);
    }
}

struct Iteration<'a, R, const N: usize> {
    statics: &'a Statics<R, N>,
    lanczos: &'a mut Lanczos<R>,
    loads: &'a mut Vec<Vector<R, N>>,
    wanted: Wanted,
    /// Where to start, if not at the usual place.
    start: Option<Vec<R>>,
}

impl<R: Real, const N: usize> WithSimd for Iteration<'_, R, N> {
    type Output = Result<()>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Result<()> {
        let Self { statics, lanczos, loads, wanted, start } = self;
        lanczos.largest(
            statics.dimension(),
            wanted,
            #[inline(always)]
            |next| match start {
                Some(start) => next.copy_from_slice(&start),
                None => statics.start(wanted.count, next),
            },
            #[inline(always)]
            |x, y| {
                statics.apply(x, y, loads);
            },
        )
    }
}

struct Look<'a, S, R, const N: usize> {
    statics: &'a Statics<S, N>,
    motions: &'a mut Motion<R, N>,
    strains: &'a [R],
    value: Option<R>,
    depth: Depth,
}

impl<S: Real, R: Over<S>, const N: usize> WithSimd for Look<'_, S, R, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: Simd>(self, _: V) {
        let with_defect = self.depth != Depth::Shape;
        self.motions.take(self.statics, self.strains, self.value, with_defect);
        if self.depth == Depth::Changes {
            self.motions.take_changes(self.statics);
        } else {
            self.motions.no_changes(self.statics);
        }
    }
}
