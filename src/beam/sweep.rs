//! The two passes over the elements: strains are integrated outwards, loads are summed inwards.

use std::ops::Range;

use crate::base::{Over, Real, RunningSum};
use crate::beam::element::{
    Link, MOST_TERMS, MOST_WIDTH, Matrix, Vector, on_strains, over_strains,
};
use crate::beam::walk::side_of;

/// An element on one side of the root, seen in that direction.
#[derive(Debug, Clone, Copy)]
pub struct Cell<R, const W: usize> {
    /// Mass matrix of the element and how its strains move its outer end.
    pub link: Link<R, W>,
    /// `L⁻¹` of the stiffness of its strains.
    pub inverse: Matrix<R, W>,
    /// Distance of the inner end of the element from the balance point, counted outwards (m).
    pub arm: R,
}

impl<S: Real, const W: usize> Default for Cell<S, W> {
    fn default() -> Self {
        let (zero, zeros) = (S::default(), [S::default(); W]);
        let link = Link { mass: [zeros; W], lift: zeros, turn: zeros, length: zero };
        Self { link, inverse: [zeros; W], arm: zero }
    }
}

impl<S: Real, const W: usize> Cell<S, W> {
    /// A view of this cell without its size in its type.
    #[inline(always)]
    pub fn view(&self) -> CellView<'_, S> {
        CellView {
            inverse: self.inverse.as_flattened(),
            mass: self.link.mass.as_flattened(),
            lift: &self.link.lift[..W - 2],
            turn: &self.link.turn[..W - 2],
            length: self.link.length,
            arm: self.arm,
        }
    }
}

/// A cell of any degree and theory.
#[derive(Debug, Clone, Copy)]
pub struct CellView<'a, S> {
    /// Rows of `L⁻¹`, each two entries longer than the number of strains.
    inverse: &'a [S],
    /// Rows of the mass matrix in its scaled strains, deflection and rotation.
    pub mass: &'a [S],
    /// Contributions of its strains to the deflection at its outer end (m).
    pub lift: &'a [S],
    /// Their contributions to the rotation there (rad).
    pub turn: &'a [S],
    /// h (m).
    pub length: S,
    /// Distance of the inner end of the element from the balance point, counted outwards (m).
    pub arm: S,
}

impl<S: Real> CellView<'_, S> {
    /// `L⁻ᵀ q`: strains (curvature in 1/m, shear in 1) from scaled strains, in blocks of that size.
    #[inline(always)]
    pub fn strains<R: Over<S>>(&self, q: &[R], block: usize, strains: &mut [R]) {
        strains.fill(R::default());
        let row = q.len() + 2;
        for (i, q) in q.iter().enumerate() {
            for j in i / block * block..=i {
                strains[j] += *q * self.inverse[i * row + j];
            }
        }
    }

    /// `L⁻¹ f`: scaled strains from loads on the strains, in blocks of that size.
    #[inline(always)]
    pub fn scaled_by_loads(&self, loads: &[S], block: usize, q: &mut [S]) {
        let row = loads.len() + 2;
        for (i, q) in q.iter_mut().enumerate() {
            *q = S::default();
            for j in i / block * block..=i {
                *q += self.inverse[i * row + j] * loads[j];
            }
        }
    }

    /// The loads on the cell's scaled strains, deflection and rotation due to a unit force at the place where the
    /// Legendre polynomials have those values, one for each coefficient of a deflection.
    pub fn point_load(&self, values: &[f64]) -> Vec<S> {
        let mut polynomials = [S::default(); MOST_TERMS];
        polynomials.iter_mut().zip(values).for_each(|(p, value)| *p = S::splat(*value));
        let strains = self.lift.len();
        let mut on = [S::default(); MOST_WIDTH];
        let on = &mut on[..strains + 2];
        on_strains(self.length, &polynomials[..values.len()], on);
        let mut load = on.to_vec();
        self.scaled_by_loads(&on[..strains], values.len() - 2, &mut load[..strains]);
        load
    }
}

impl<const W: usize> Cell<f64, W> {
    /// `Lᵀ c`: scaled strains from strains.
    pub fn scaled_strains(&self, c: &Vector<f64, W>) -> Vector<f64, W> {
        let mut q = [0.0; W];
        for i in (0..W - 2).rev() {
            let known: f64 = (i + 1..W - 2).map(|k| self.inverse[k][i] * q[k]).sum();
            q[i] = (c[i] - known) / self.inverse[i][i];
        }
        q
    }
}

/// A rigid motion seen outwards: translation of the balance point and rotation.
#[derive(Debug, Clone, Copy, Default)]
pub struct Rigid<R> {
    /// Translation of the balance point (m).
    pub push: R,
    /// Rotation, seen outwards (rad).
    pub turn: R,
}

impl<R: Real> Rigid<R> {
    /// The deflection at that distance from the balance point.
    #[inline(always)]
    pub fn deflection<S>(&self, arm: S) -> R
    where
        R: Over<S>,
    {
        self.push + self.turn * arm
    }

    /// The motion seen from the other side: a rotation that is outwards there is inwards here.
    pub fn mirrored(self) -> Self {
        Self { turn: -self.turn, ..self }
    }

    /// The motion seen outwards on side 0, the knob's, or 1, the tip's.
    #[inline(always)]
    pub fn on_side(self, side: usize) -> Self {
        if side == 0 { self.mirrored() } else { self }
    }
}

/// A bare bat in the form of the running sums.
#[derive(Debug, Clone, Copy)]
pub struct Body<'a, S, const W: usize> {
    /// Elements of the bat, the knob side first, both sides from the root outwards.
    pub cells: &'a [Cell<S, W>],
    /// Number of elements on the knob side.
    pub split: usize,
    /// Mass of the bat with everything attached (kg).
    pub mass: S,
    /// Moment of inertia about the balance point, with everything attached (kg m²).
    pub inertia: S,
}

impl<S: Real, const W: usize> Body<'_, S, W> {
    /// The cells of side 0, the knob's, or 1, the tip's.
    pub fn side(&self, side: usize) -> Range<usize> {
        side_of(self.split, self.cells.len(), side)
    }
}

/// Cells of any size.
pub trait Cells<S> {
    /// The cell with that index.
    fn at(&self, number: usize) -> CellView<'_, S>;
}

impl<S: Real, const W: usize> Cells<S> for Vec<Cell<S, W>> {
    fn at(&self, number: usize) -> CellView<'_, S> {
        self[number].view()
    }
}

/// A bare bat of elements of any degree and theory.
#[derive(Clone, Copy)]
pub struct Bare<'a, S> {
    /// Legendre polynomials of a deflection of an element.
    pub terms: usize,
    /// Strains of an element.
    pub strains: usize,
    /// Number of cells.
    pub count: usize,
    /// Number of cells on the knob side.
    pub split: usize,
    /// The cells, the knob side first, both sides from the root outwards.
    pub cells: &'a dyn Cells<S>,
    /// Mass with everything attached (kg).
    pub mass: S,
    /// The theory's inertia about the balance point (kg m²).
    pub inertia: S,
    /// Distance of the balance point from the knob end (m).
    pub balance: S,
    /// Energy of `½ qᵀq = 1` (J).
    pub energy_unit: S,
}

impl<S> Bare<'_, S> {
    /// The indices of the cells of one side, outwards.
    pub fn side(&self, side: usize) -> Range<usize> {
        side_of(self.split, self.count, side)
    }
}

/// The loads of a motion's inertia: on the cells and, with fixtures, force and couple of every point mass (outwards)
/// and the force of every contact.
#[derive(Debug, Clone, Default)]
pub struct Loads<R, const W: usize> {
    /// Generalised loads of every cell: strains, deflection, rotation.
    pub cells: Vec<Vector<R, W>>,
    /// Force and couple of every point mass, outwards.
    pub points: Vec<[R; 2]>,
    /// Force of every contact.
    pub contacts: Vec<R>,
}

/// The scaled strains of one cell with its deflection and slope in the last two places.
#[inline(always)]
pub fn with_ends<R: Real, const W: usize>(q: &[R], w: R, theta: R) -> Vector<R, W> {
    let mut motion = [R::default(); W];
    motion[..W - 2].copy_from_slice(&q[..W - 2]);
    (motion[W - 2], motion[W - 1]) = (w, theta);
    motion
}

/// The state of a pass outwards: deflection and rotation so far, force and moment of the inertia about the balance
/// point.
#[derive(Debug, Clone, Copy, Default)]
pub struct Outwards<R, const KEEP: bool> {
    /// Deflection so far (m).
    pub w: RunningSum<R, KEEP>,
    /// Rotation so far (rad).
    pub theta: RunningSum<R, KEEP>,
    /// Force of the inertia so far, over ω².
    pub force: RunningSum<R, KEEP>,
    /// Moment of the inertia about the balance point so far, over ω².
    pub moment: RunningSum<R, KEEP>,
}

impl<R: Real, const KEEP: bool> Outwards<R, KEEP> {
    /// Integrates strains over these cells and keeps their loads.
    #[inline(always)]
    pub fn over<S: Real, const W: usize>(
        &mut self,
        cells: &[Cell<S, W>],
        q: &[R],
        loads: &mut [Vector<R, W>],
    ) where
        R: Over<S>,
    {
        let Self { mut w, mut theta, mut force, mut moment } = *self;
        for ((cell, q), kept) in cells.iter().zip(q.chunks_exact(W - 2)).zip(loads) {
            let link = &cell.link;
            let motion = with_ends::<R, W>(q, w.value(), theta.value());
            let load = link.load(&motion);
            *kept = load;
            force.add(load[W - 2]);
            moment.add(load[W - 2] * cell.arm + load[W - 1]);
            w.add(theta.value() * link.length + over_strains(&link.lift, &motion));
            theta.add(over_strains(&link.turn, &motion));
        }
        *self = Self { w, theta, force, moment };
    }
}

/// The state of a pass inwards from a free end: shear force and bending moment so far.
#[derive(Debug, Clone, Copy, Default)]
pub struct Inwards<R, const KEEP: bool> {
    /// Shear force so far.
    pub shear: RunningSum<R, KEEP>,
    /// Bending moment so far.
    pub bending: RunningSum<R, KEEP>,
}

impl<R: Real, const KEEP: bool> Inwards<R, KEEP> {
    /// The scaled strains of these cells under their loads, less those of the rigid motion: the adjoint of
    /// [`Outwards::over`].
    #[inline(always)]
    pub fn over<S: Real, const W: usize>(
        &mut self,
        cells: &[Cell<S, W>],
        loads: &[Vector<R, W>],
        rigid: Rigid<R>,
        y: &mut [R],
    ) where
        R: Over<S>,
    {
        let Self { mut shear, mut bending } = *self;
        for ((cell, load), y) in cells.iter().zip(loads).zip(y.chunks_exact_mut(W - 2)).rev() {
            let link = &cell.link;
            let [lifted, turned] = [&link.mass[W - 2], &link.mass[W - 1]];
            let lift = rigid.deflection(cell.arm);
            let mut f = *load;
            for i in 0..W {
                f[i] -= lift * lifted[i] + rigid.turn * turned[i];
            }
            let (v, m) = (shear.value(), bending.value());
            for k in 0..W - 2 {
                y[k] = f[k] + (v * link.lift[k] + m * link.turn[k]);
            }
            bending.add(v * link.length + f[W - 1]);
            shear.add(f[W - 2]);
        }
        *self = Self { shear, bending };
    }
}
