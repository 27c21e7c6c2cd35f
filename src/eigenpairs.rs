//! The lowest bending motions of bats on one mesh, with whatever vectors the machine has and
//! memory that the next bats use again.
//!
//! The same bits on every machine and in every lane: nothing is added in another order, and no
//! product is fused with a sum.

use pulp::{Arch, Simd, WithSimd};

use crate::bat::Bat;
use crate::beam::element::Vector;
use crate::beam::mesh::Mesh;
use crate::beam::motion::Motion;
use crate::beam::statics::Statics;
use crate::eigen::lanczos::{Lanczos, Wanted};
use crate::error::Result;
use crate::real::Real;

/// Bats in the lanes of `R`, elements of degree `N − 1`.
#[derive(Debug, Clone)]
pub struct Eigenpairs<R, const N: usize> {
    pub statics: Statics<R, N>,
    pub lanczos: Lanczos<R>,
    /// The motion that was looked at last.
    pub motion: Motion<R, N>,
    loads: Vec<Vector<R, N>>,
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

impl<R: Real, const N: usize> Eigenpairs<R, N> {
    /// Nothing yet, for bats like this one.
    pub fn new(bat: &Bat) -> Self {
        Self {
            statics: Statics::empty(bat),
            lanczos: Lanczos::default(),
            motion: Motion::default(),
            loads: vec![],
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
        self.iterate(Wanted { count, residual, earliest: likely(count, residual) })
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

    /// Looks at the motion number `k` of those found, as closely as wanted, its frequency from the
    /// eigenvalue.
    pub fn look(&mut self, k: usize, depth: Depth) {
        let dimension = self.statics.dimension();
        let Self { statics, motion, lanczos, .. } = self;
        let strains = &lanczos.vectors[k * dimension..(k + 1) * dimension];
        let value = Some(lanczos.values[k]);
        Arch::new().dispatch(Look { statics, motion, strains, value, depth });
    }

    /// Looks at the motion with those scaled strains as closely as wanted, its frequency from both
    /// energies.
    pub fn look_at(&mut self, strains: &[R], depth: Depth) {
        let Self { statics, motion, .. } = self;
        Arch::new().dispatch(Look { statics, motion, strains, value: None, depth });
    }
}

/// Looking for convergence costs as much as some steps: not before so many beyond `count` that it
/// is likely. Measured on a dowel, a cone and two bats, 1 to 60 modes, right to one step.
fn likely(count: usize, residual: f64) -> usize {
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

struct Look<'a, R, const N: usize> {
    statics: &'a Statics<R, N>,
    motion: &'a mut Motion<R, N>,
    strains: &'a [R],
    value: Option<R>,
    depth: Depth,
}

impl<R: Real, const N: usize> WithSimd for Look<'_, R, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let with_defect = self.depth != Depth::Shape;
        self.motion.take(self.statics, self.strains, self.value, with_defect);
        if self.depth == Depth::Changes {
            self.motion.take_changes(self.statics);
        } else {
            self.motion.no_changes(self.statics);
        }
    }
}
