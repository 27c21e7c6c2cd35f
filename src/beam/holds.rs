//! What holds a bat, as conditions on its strains: the force method.
//!
//! Two contacts at most tell the rigid motion, and every further one is a condition on the strains
//! alone, so that the strains that meet the conditions are found by an orthogonal projection.

use crate::beam::sweep::Rigid;
use crate::real::{Over, Real};

/// How the contacts hold the bat.
#[derive(Debug, Clone, Default)]
pub struct Holds<S> {
    /// The rigid motions that stay free.
    pub free: Vec<[S; 2]>,
    /// The contacts that tell the rigid motion, two at most.
    pub primary: Vec<usize>,
    /// The rigid motion of a displacement 1 at each of them and none at the other.
    pub inverse: Vec<[S; 2]>,
    /// Their displacements by strains.
    pub rows: Vec<Vec<S>>,
    /// The contacts beyond.
    pub redundant: Vec<usize>,
    /// How much of the primary contacts' rows is taken out of those of each.
    pub shares: Vec<[S; 2]>,
    /// The conditions on the strains, orthonormal, and their factor `L`: row i is `Σ_j L_ij Q_j`.
    pub basis: Vec<Vec<S>>,
    /// The factor `L`, row by row.
    pub lower: Vec<Vec<S>>,
}

impl<S: Real> Holds<S> {
    /// The rigid motion with these displacements at the primary contacts.
    pub fn rigid_of<R: Over<S>>(&self, of: impl Fn(usize) -> R) -> Rigid<R> {
        let mut rigid = Rigid::<R>::default();
        for (k, inverse) in self.inverse.iter().enumerate() {
            let displacement = of(k);
            rigid.push += displacement * inverse[0];
            rigid.turn += displacement * inverse[1];
        }
        rigid
    }

    /// The free rigid motion that carries force and moment `total`.
    pub fn free_part<R: Over<S>>(&self, mass: S, inertia: S, total: [R; 2]) -> Rigid<R> {
        let mut rigid = Rigid::<R>::default();
        for free in &self.free {
            let carried = total[0] * free[0] + total[1] * free[1];
            let weight = free[0] * free[0] * mass + free[1] * free[1] * inertia;
            let part = carried / R::of(weight);
            rigid.push += part * free[0];
            rigid.turn += part * free[1];
        }
        rigid
    }

    /// Strains under loads whose force and moment are `total` become those of the held bat; leaves
    /// the contacts' reactions.
    pub fn balance<R: Over<S>>(&self, total: [R; 2], y: &mut [R], reactions: &mut [R]) {
        let carried = |inverse: &[S; 2]| total[0] * inverse[0] + total[1] * inverse[1];
        for (k, inverse) in self.inverse.iter().enumerate() {
            let reaction = carried(inverse);
            reactions[self.primary[k]] = reaction;
            y.iter_mut().zip(&self.rows[k]).for_each(|(y, row)| *y -= reaction * *row);
        }
        // L⁻ᵀ of the parts that are projected out.
        let mut parts = self.project(y);
        for i in (0..parts.len()).rev() {
            parts[i] = parts[i] / R::of(self.lower[i][i]);
            let known = parts[i];
            for j in 0..i {
                parts[j] -= known * self.lower[i][j];
            }
            reactions[self.redundant[i]] = known;
            for (k, share) in self.shares[i].iter().enumerate().take(self.primary.len()) {
                reactions[self.primary[k]] -= known * *share;
            }
        }
    }

    /// Takes the conditions' parts out of the strains and returns them.
    pub fn project<R: Over<S>>(&self, strains: &mut [R]) -> Vec<R> {
        let mut parts = vec![R::default(); self.basis.len()];
        for _ in 0..2 {
            for (part, condition) in parts.iter_mut().zip(&self.basis) {
                let more = inner(strains, condition);
                *part += more;
                strains.iter_mut().zip(condition).for_each(|(y, q)| *y -= more * *q);
            }
        }
        parts
    }
}

/// `Σ a_k b_k`.
pub fn inner<S: Real, R: Over<S>>(a: &[R], b: &[S]) -> R {
    let mut sum = R::default();
    a.iter().zip(b).for_each(|(a, b)| sum += *a * *b);
    sum
}
