//! An elastic bed under one element, eliminated locally.
//!
//! The bed holds the Legendre coefficients of the element's deflection, `c = H q + G u`, by springs of softness σ
//! (`Σ = σ²`). Here `u` is the motion of the element's inner end. The bed's forces are
//!
//! ```text
//! t = (Σ + H Hᵀ)⁻¹ (H q + G u − H Bᵀ λ)
//! ```
//!
//! where `λ` is the load at the outer end and `B` gives what strains add to the motion there.

use crate::base::{Over, Real};
use crate::beam::footing::{
    Crossing, Footing, Given, Meeting, Rest, Span, product, sums, two_springs,
};

/// The springs of an elastic bed.
#[derive(Debug, Clone)]
pub struct Under<S> {
    /// Number of the bed's first contact.
    pub contact: usize,
    /// Index of its first strain.
    pub place: usize,
    /// Extension of each spring for a strain of 1.
    pub softness: Vec<S>,
    /// The rows of each spring: `H` over the strains, and `G` over deflection and rotation at the inner end.
    pub rows: Vec<S>,
}

/// An elastic bed under one element.
#[derive(Debug, Clone)]
pub struct Bed<S> {
    /// The element.
    crossing: Crossing<S>,
    under: Under<S>,
    /// The Cholesky factor of `Σ + H Hᵀ`, row by row.
    lower: Vec<S>,
    /// `H Bᵀ`, `(Σ + H Hᵀ)⁻¹ G` and `(Σ + H Hᵀ)⁻¹ H Bᵀ`.
    outer: Vec<[S; 2]>,
    by_motion: Vec<[S; 2]>,
    by_force: Vec<[S; 2]>,
    /// The bed as two springs at the inner end, `[k, l, r]`.
    own: [S; 3],
    meeting: Meeting<S>,
}

impl<S: Real> Bed<S> {
    /// The bed under an element whose outer end rests on `footing`; also returns the footing at the inner end.
    pub fn new(span: Span<S>, under: Under<S>, footing: Footing) -> (Self, Footing) {
        let (n, lower) = (span.adds.len(), factor(&under, span.adds.len()));
        let rows = || under.rows.chunks_exact(n + 2);
        let outer: Vec<[S; 2]> = rows().map(|row| sums(&span.adds, row)).collect();
        let inner: Vec<[S; 2]> = rows().map(|row| [row[n], row[n + 1]]).collect();
        let solved = |columns: &[[S; 2]]| -> Vec<[S; 2]> {
            let [a, b] = [0, 1].map(|e| {
                let mut column: Vec<S> = columns.iter().map(|c| c[e]).collect();
                solve(&lower, &mut column);
                column
            });
            a.into_iter().zip(b).map(|(a, b)| [a, b]).collect()
        };
        let (by_motion, by_force) = (solved(&inner), solved(&outer));
        let own = two_springs(product(&inner, &by_motion));
        let bare = product(&span.adds, &span.adds);
        let taken = product(&outer, &by_force);
        let compliance: [f64; 3] = std::array::from_fn(|i| bare[i] - taken[i]);
        let compliance = [compliance[0].max(0.0), compliance[1], compliance[2].max(0.0)];
        // Motion of the outer end for a motion of the inner end.
        let moved = |out: usize, inner: usize| -> f64 {
            let parts = outer.iter().zip(&by_motion);
            parts.map(|(o, m)| o[out].lane(0) * m[inner].lane(0)).sum()
        };
        let carried =
            [[1.0 - moved(0, 0), span.length - moved(0, 1)], [-moved(1, 0), 1.0 - moved(1, 1)]];
        let (crossing, seen) = footing.through(span, compliance);
        let (meeting, footing) = seen.meet(carried, own);
        let own = own.map(S::splat);
        let bed = Self { crossing, under, lower, outer, by_motion, by_force, own, meeting };
        (bed, footing)
    }

    /// Every spring's row over the strains and over deflection and rotation at the inner end.
    fn rows(&self) -> impl Iterator<Item = &[S]> {
        self.under.rows.chunks_exact(self.crossing.adds.len() + 2)
    }

    /// The rest positions at the inner side, from those at the outer side. Leaves in `trace` what [`Self::outwards`]
    /// needs.
    pub fn inwards<R: Over<S>>(
        &self,
        rest: Rest<R>,
        given: Given<R>,
        trace: &mut Vec<R>,
    ) -> Rest<R> {
        let mut forces = self.off(given);
        solve(&self.lower, &mut forces);
        let [lift, turn] = sums(&self.outer, &forces);
        let moved = self.crossing.moved(given);
        let outer = self.crossing.inwards(rest, [moved[0] - lift, moved[1] - turn]);
        let n = self.crossing.adds.len();
        let mut push = [R::default(); 2];
        for (row, force) in self.rows().zip(&forces) {
            push[0] += *force * row[n];
            push[1] += *force * row[n + 1];
        }
        let [k, l, r] = self.own;
        let own = [-push[0] / R::of(k), -(push[1] - push[0] * l) / R::of(r)];
        let before = [outer.deflection.value(), outer.rotation.value()];
        let (rest, residual) = self.meeting.rest([before[0], before[1], own[0], own[1]]);
        trace.extend(forces);
        trace.extend([rest.deflection.value(), rest.rotation.value()]);
        trace.extend(residual);
        rest
    }

    /// Subtracts from the strains the effect of the forces at the inner end and of the bed. Returns the forces at the
    /// outer end.
    pub fn outwards<R: Over<S>>(
        &self,
        [push, turn]: [R; 2],
        trace: &mut Vec<R>,
        strains: &mut [R],
        reactions: &mut [R],
    ) -> [R; 2] {
        let own = trace.split_off(trace.len() - self.under.softness.len() - 6);
        let (forces, rest) = own.split_at(self.under.softness.len());
        let (crossing, meeting) = (&self.crossing, &self.meeting);
        let turned = rest[1] + turn * meeting.softness[1];
        let moved = rest[0] + push * meeting.softness[0] - turned * meeting.at;
        let [push, turn, ..] = meeting.forces([push, turn], &rest[2..]);
        let outer = crossing.outwards([push, turn], strains);
        let carried = [push, push * crossing.at + turn];
        for (k, row) in self.rows().enumerate() {
            let [by, out] = [&self.by_motion[k], &self.by_force[k]];
            let force = forces[k] + (moved * by[0] + turned * by[1])
                - (carried[0] * out[0] + carried[1] * out[1]);
            reactions[self.under.contact + k] = force;
            strains[self.under.place + k] += force * self.under.softness[k];
            let own = strains[crossing.first..].iter_mut().zip(&crossing.adds).zip(row);
            own.for_each(|((q, _), h)| *q -= force * *h);
        }
        outer
    }

    /// Displacements of the bed's springs with the inner end at rest.
    fn off<R: Over<S>>(&self, given: Given<R>) -> Vec<R> {
        let q = match given {
            Given::Displacements(off) => {
                return off[self.under.contact..][..self.under.softness.len()].to_vec();
            }
            Given::Strains(q) => q,
        };
        let own = &q[self.crossing.first..][..self.crossing.adds.len()];
        let springs = self.under.softness.iter().zip(&q[self.under.place..]);
        self.rows()
            .zip(springs)
            .map(|(row, (softness, strain))| {
                let moved = own.iter().zip(row).fold(R::default(), |sum, (q, h)| sum + *q * *h);
                moved - *strain * *softness
            })
            .collect()
    }
}

/// The Cholesky factor of `Σ + H Hᵀ`, row by row, of a bed under an element of `n` strains.
fn factor<S: Real>(under: &Under<S>, n: usize) -> Vec<S> {
    let count = under.softness.len();
    let row = |k: usize| &under.rows[k * (n + 2)..][..n];
    let mut lower = vec![0.0; count * count];
    for i in 0..count {
        for j in 0..=i {
            let products = row(i).iter().zip(row(j)).map(|(a, b)| a.lane(0) * b.lane(0));
            let known = |k: usize| lower[i * count + k] * lower[j * count + k];
            let entry = products.sum::<f64>() - (0..j).map(known).sum::<f64>();
            let own = under.softness[i].lane(0).powi(2);
            lower[i * count + j] = match i == j {
                // A pivot is at least the springs' own flexibility.
                true => (entry + own).max(own).sqrt(),
                false => entry / lower[j * count + j],
            };
        }
    }
    lower.into_iter().map(S::splat).collect()
}

/// Solves `L Lᵀ x = b`.
fn solve<S: Real, R: Over<S>>(lower: &[S], x: &mut [R]) {
    let n = x.len();
    for i in 0..n {
        let row = &lower[i * n..];
        let known = (0..i).fold(R::default(), |sum, k| sum + x[k] * row[k]);
        x[i] = (x[i] - known) / R::of(row[i]);
    }
    for i in (0..n).rev() {
        let known = (i + 1..n).fold(R::default(), |sum, k| sum + x[k] * lower[k * n + i]);
        x[i] = (x[i] - known) / R::of(lower[i * n + i]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_factor_solves_what_it_is_the_factor_of() {
        // Rows of two strains, and the columns of the inner end, which are not used here.
        let rows = vec![1.0, 2.0, 9.0, 9.0, -1.0, 0.5, 9.0, 9.0, 0.3, 0.1, 9.0, 9.0];
        let softness = vec![0.5_f64, 1.0, 2.0];
        let under = Under { contact: 0, place: 0, softness, rows };
        let entry = |i: usize, j: usize| {
            let [a, b] = [i, j].map(|k| &under.rows[4 * k..][..2]);
            let own = if i == j { f64::powi(under.softness[i], 2) } else { 0.0 };
            a[0] * b[0] + a[1] * b[1] + own
        };
        let mut x = [3.0, -1.0, 2.0];
        let wanted = x;
        solve(&factor(&under, 2), &mut x);
        for i in 0..3 {
            let found: f64 = (0..3).map(|j| entry(i, j) * x[j]).sum();
            assert!((found - wanted[i]).abs() < 1e-14, "{i} {found}");
        }
    }
}
