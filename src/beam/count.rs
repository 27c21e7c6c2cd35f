//! How many modes are slower than a given frequency? A list with that many entries is complete.
//!
//! The number of eigenvalues below σ equals the number of negative pivots of `K − σM` (Sylvester's law of inertia).
//! Each side is eliminated inwards from its free end. The part beyond a border is a quadratic form in the border's
//! deflection and rotation. A cell adds its own form, in its strains, and the rest is handed on after these are
//! eliminated. Working in strains keeps the pivots near 1, and nothing large is subtracted, whatever the number of
//! elements. A contact enters through its reaction `t`, as `t (a·u) − ½ δ t²`, so that no stiffness is ever multiplied.
//! Each such reaction adds one negative pivot.
//!
//! # Source
//!
//! Sylvester's law and its use for eigenvalues: B. N. Parlett, The Symmetric Eigenvalue Problem
//! (1980), chapters 1 and 3; pivots of order 2: J. R. Bunch, B. N. Parlett, SIAM J. Numer. Anal. 8
//! (1971) 639.

use std::ops::{Index, IndexMut};

use crate::base::Real;
use crate::base::linear::{determinant, solve_two};
use crate::beam::element::MOST_WIDTH;
use crate::beam::fixed::unit;
use crate::beam::placed::Placed;
use crate::beam::view::View;
use crate::beam::walk::{Run, What};

/// A symmetric form whose last two unknowns are deflection and rotation.
#[derive(Debug, Clone, Default)]
struct BorderForm<R> {
    size: usize,
    /// Rows one after the other; the upper triangle may be out of date while unknowns are eliminated.
    values: Vec<R>,
    /// The column of a pivot.
    column: Vec<R>,
}

impl<R> Index<(usize, usize)> for BorderForm<R> {
    type Output = R;

    #[inline(always)]
    fn index(&self, (i, j): (usize, usize)) -> &R {
        &self.values[i * self.size + j]
    }
}

impl<R> IndexMut<(usize, usize)> for BorderForm<R> {
    #[inline(always)]
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut R {
        &mut self.values[i * self.size + j]
    }
}

/// Number of modes of the bat, rigid ones included, slower than `omega` (rad/s); `None` if a pivot was too small to
/// decide.
pub fn slower(view: &View<f64>, omega: f64) -> Option<usize> {
    slower_each(view, omega).filter(|count| *count >= 0.0).map(|count| count as usize)
}

/// As [`slower`] for the bat in every lane; with several bats, NaN where a pivot was too small to decide.
#[inline(always)]
pub fn slower_each<R: Real>(view: &View<R>, omega: R) -> Option<R> {
    let tau = omega * omega / view.energy_unit;
    let mut count = R::default();
    let mut knob = inwards(view, 0, tau, &mut count)?;
    let tip = inwards(view, 1, tau, &mut count)?;
    // On the knob side, a rotation counted outwards has the other sign.
    let last = knob.size - 1;
    for i in 0..=last {
        knob[(i, last)] = -knob[(i, last)];
        knob[(last, i)] = -knob[(last, i)];
    }
    let mut whole = knob.beside(tip);
    count += whole.eliminate(0)?;
    let reactions = view.fixed.map_or(0, |fixed| fixed.placed.contacts.len());
    Some(count - R::splat(reactions as f64))
}

/// The form of one side at the root; adds its negative pivots.
#[inline(always)]
fn inwards<R: Real>(view: &View<R>, side: usize, tau: R, count: &mut R) -> Option<BorderForm<R>> {
    let (mut form, mut next) = (BorderForm::new(2), BorderForm::default());
    for form in [&mut form, &mut next] {
        form.values.reserve((view.strains + 4) * (view.strains + 4));
    }
    for Run { cells, stop } in view.runs(side).rev() {
        if let (Some(fixed), Some(what)) = (view.fixed, stop) {
            form.meet(&fixed.placed, what, tau);
        }
        for k in cells.rev() {
            form.behind(view, k, tau, &mut next);
            std::mem::swap(&mut form, &mut next);
            *count += form.eliminate(2)?;
        }
    }
    Some(form)
}

impl<R: Real> BorderForm<R> {
    fn new(size: usize) -> Self {
        let mut form = Self::default();
        form.clear(size);
        form
    }

    /// Resets to this number of unknowns and zero values.
    fn clear(&mut self, size: usize) {
        self.size = size;
        self.values.clear();
        self.values.resize(size * size, R::default());
    }

    /// Inserts one more unknown at the front.
    fn extend(&mut self) {
        let mut larger = Self::new(self.size + 1);
        for i in 0..self.size {
            for j in 0..self.size {
                larger[(i + 1, j + 1)] = self[(i, j)];
            }
        }
        *self = larger;
    }

    /// Adds `value (a·u)²`.
    fn add_square(&mut self, value: R, a: &[(usize, R)]) {
        for (i, p) in a {
            for (j, q) in a {
                self[(*i, *j)] += value * *p * *q;
            }
        }
    }

    /// Adds the fixture at this border.
    fn meet(&mut self, placed: &Placed<R>, what: What, tau: R) {
        let one = R::splat(1.0);
        match what {
            What::PointMass(k) => {
                let point = &placed.points[k];
                if point.spring.is_some() {
                    self.extend();
                }
                let last = self.size - 1;
                let mut moved = vec![(last - 1, one), (last, point.offset)];
                if let Some(spring) = point.spring {
                    moved.push((0, spring.softness));
                    self[(0, 0)] += one;
                }
                self.add_square(-tau * point.mass, &moved);
                self.add_square(-tau * point.inertia, &[(last, one)]);
            }
            What::Joint(k) => {
                let softness = placed.joints[k].softness;
                self.extend();
                // The rotation beyond the joint is the one here plus the joint's angle.
                let last = self.size - 1;
                for j in 1..=last {
                    let turned = softness * self[(last, j)];
                    self[(0, j)] += turned;
                    self[(j, 0)] += turned;
                }
                let both = softness * softness * self[(last, last)];
                self[(0, 0)] += one + both;
            }
            What::Contact(k) => {
                let contact = &placed.contacts[k];
                self.extend();
                let last = self.size - 1;
                let held = if contact.turning { last } else { last - 1 };
                self[(0, held)] += contact.sign;
                self[(held, 0)] += contact.sign;
                let soft = contact.spring.map_or(R::default(), |s| s.softness);
                self[(0, 0)] -= soft * soft;
            }
        }
    }

    /// The form at the inner end of a cell before elimination: the cell's strains, then the unknowns of this form, then
    /// deflection and rotation. Only the lower triangle.
    #[inline(always)]
    fn behind(&self, view: &View<R>, k: usize, tau: R, form: &mut Self) {
        let (zero, one) = (R::default(), R::splat(1.0));
        let cell = view.cells.at(k);
        let (strains, carried) = (view.strains, self.size - 2);
        let width = strains + 2;
        let placed = view.fixed.iter().map(|fixed| &fixed.placed);
        let beds = placed.filter_map(|placed| Some(&placed.contacts[placed.bed(k, view.terms)?]));
        let beds = beds.flatten().filter_map(|contact| Some(contact.spring?.softness));
        let beds: Vec<R> = beds.collect();
        let size = strains + carried + beds.len() + 2;
        let place = |i: usize| if i < strains { i } else { size - width + i };
        form.clear(size);
        for i in 0..width {
            for j in 0..=i {
                form[(place(i), place(j))] = -tau * cell.mass[i * width + j];
            }
        }
        (0..strains).for_each(|i| form[(i, i)] += one);
        // Deflection and rotation at the outer end.
        let mut outer = [[zero; 2]; MOST_WIDTH];
        for i in 0..strains {
            outer[i] = [cell.lift[i], cell.turn[i]];
        }
        (outer[strains], outer[strains + 1]) = ([one, zero], [cell.length, one]);
        let ends = [carried, carried + 1];
        for i in 0..width {
            let mut row = [zero; 2];
            for e in 0..2 {
                row[e] =
                    outer[i][0] * self[(ends[0], ends[e])] + outer[i][1] * self[(ends[1], ends[e])];
            }
            for j in 0..=i {
                form[(place(i), place(j))] += row[0] * outer[j][0] + row[1] * outer[j][1];
            }
            for c in 0..carried {
                let value = outer[i][0] * self[(ends[0], c)] + outer[i][1] * self[(ends[1], c)];
                form[(place(i), strains + c)] += value;
                form[(strains + c, place(i))] += value;
            }
        }
        for a in 0..carried {
            for b in 0..carried {
                form[(strains + a, strains + b)] += self[(a, b)];
            }
        }
        for (b, softness) in beds.into_iter().enumerate() {
            let reaction = strains + carried + b;
            let on = cell.point_load(&unit(view.terms, b));
            for (i, value) in on.into_iter().enumerate() {
                form[(reaction, place(i))] += value;
                form[(place(i), reaction)] += value;
            }
            form[(reaction, reaction)] -= softness * softness;
        }
    }

    /// The sum of the forms of both sides, which share deflection and rotation.
    fn beside(self, other: Self) -> Self {
        let (own, others) = (self.size - 2, other.size - 2);
        let mut form = Self::new(own + others + 2);
        for (part, first, count) in [(self, 0, own), (other, own, others)] {
            let place = |i: usize| if i < count { first + i } else { own + others + i - count };
            for i in 0..count + 2 {
                for j in 0..count + 2 {
                    form[(place(i), place(j))] += part[(i, j)];
                }
            }
        }
        form
    }

    /// Copies the lower triangle to the upper one beyond the first unknowns.
    fn mirror(&mut self, first: usize) {
        for i in first..self.size {
            (i + 1..self.size).for_each(|j| self[(i, j)] = self[(j, i)]);
        }
    }

    /// The largest entry of a column from its diagonal to a row, and more than 0.
    #[inline(always)]
    fn largest(&self, first: usize, end: usize) -> R {
        let mut largest = R::splat(f64::MIN_POSITIVE);
        for i in first..end {
            largest = largest.max(self[(i, first)].abs());
        }
        largest
    }

    /// Eliminates all unknowns but the last `kept`; returns the number of negative pivots.
    #[inline(always)]
    fn eliminate(&mut self, kept: usize) -> Option<R> {
        // A pivot in sequence is good enough unless it is small compared with its coupling; the kept unknowns have
        // other units. Several bats side by side must take the same sequence: a small pivot then costs digits, and a
        // count needs few.
        const SMALL: f64 = 0.1;
        const SMALL_TOGETHER: f64 = 1e-7;
        let small = R::splat(if R::LANES == 1 { SMALL } else { SMALL_TOGETHER });
        let (mut negative, mut first) = (R::default(), 0);
        let (size, end) = (self.size, self.size - kept);
        let [one, half] = [1.0, 0.5].map(R::splat);
        while first < end {
            let largest = self.largest(first, end);
            if !(small * largest).within(self[(first, first)].abs()) {
                if R::LANES == 1 {
                    self.mirror(first);
                    let (i, j) = self.pivot(first, end)?;
                    self.exchange(first, i);
                    if i != j {
                        self.exchange(first + 1, j);
                        self.eliminate_two(first)?;
                        negative += one;
                        first += 2;
                        continue;
                    }
                }
                // A bat in a batch then has no result; the others keep theirs.
                for lane in 0..R::LANES {
                    let least = (small * largest).lane(lane);
                    if R::LANES > 1 && self[(first, first)].lane(lane).abs() < least {
                        negative.set_lane(lane, f64::NAN);
                    }
                }
            }
            let Self { values, column, .. } = self;
            column.clear();
            column.extend((first..size).map(|i| values[i * size + first]));
            negative += half - half.copysign(column[0]);
            let scale = one / column[0];
            for (i, value) in column.iter().enumerate().skip(1) {
                let part = *value * scale;
                let row = &mut values[(first + i) * size + first..][..=i];
                for (v, c) in row[1..].iter_mut().zip(&column[1..]) {
                    *v -= part * *c;
                }
            }
            first += 1;
        }
        self.mirror(end);
        for i in 0..kept {
            for j in 0..kept {
                self.values[i * kept + j] = self.values[(end + i) * size + end + j];
            }
        }
        self.size = kept;
        self.values.truncate(kept * kept);
        Some(negative)
    }

    /// The next pivot: one diagonal entry, or two that belong together.
    fn pivot(&self, first: usize, end: usize) -> Option<(usize, usize)> {
        // Bunch and Parlett's bound.
        const ALPHA: f64 = 0.640_388_203_202_208;
        let all = (first..end).flat_map(|i| (first..=i).map(move |j| (i, j)));
        let size = |place: &(usize, usize)| self[*place].abs().lane(0);
        let on = all.clone().filter(|(i, j)| i == j).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        let off = all.filter(|(i, j)| i != j).max_by(|a, b| size(a).total_cmp(&size(b)));
        match off {
            Some(off) if size(&on) < ALPHA * size(&off) => Some((off.1, off.0)),
            _ if size(&on) > 0.0 => Some(on),
            _ => None,
        }
    }

    /// Exchanges two unknowns of a form whose upper triangle is up to date.
    fn exchange(&mut self, a: usize, b: usize) {
        for i in 0..self.size {
            self.values.swap(a * self.size + i, b * self.size + i);
        }
        for i in 0..self.size {
            self.values.swap(i * self.size + a, i * self.size + b);
        }
    }

    /// Eliminates two unknowns of one bat together; they give one pivot of each sign.
    fn eliminate_two(&mut self, first: usize) -> Option<()> {
        let row = |i: usize| -> Vec<f64> {
            self.values[i * self.size..][..self.size].iter().map(|v| v.lane(0)).collect()
        };
        let [a, b] = [row(first), row(first + 1)];
        let pivot = [[a[first], a[first + 1]], [a[first + 1], b[first + 1]]];
        if determinant(pivot) >= 0.0 {
            return None;
        }
        for i in first + 2..self.size {
            let [of_a, of_b] = solve_two(pivot, [a[i], b[i]]);
            for j in first + 2..self.size {
                self[(i, j)] -= R::splat(of_a * a[j] + of_b * b[j]);
            }
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn form(rows: &[&[f64]]) -> BorderForm<f64> {
        BorderForm { size: rows.len(), values: rows.concat(), column: vec![] }
    }

    #[test]
    fn negative_pivots_are_negative_eigenvalues_whatever_the_order() {
        // Eigenvalues 3 and −1; ±1; 1, 1, −2 (all ones off the diagonal: 2, −1, −1).
        assert_eq!(form(&[&[1.0, 2.0], &[2.0, 1.0]]).eliminate(0), Some(1.0));
        assert_eq!(form(&[&[0.0, 1.0], &[1.0, 0.0]]).eliminate(0), Some(1.0));
        let ones: &[&[f64]] = &[&[0.0, 1.0, 1.0], &[1.0, 0.0, 1.0], &[1.0, 1.0, 0.0]];
        assert_eq!(form(ones).eliminate(0), Some(2.0));
        assert_eq!(form(&[&[0.0]]).eliminate(0), None);
    }

    #[test]
    fn what_is_kept_is_the_schur_complement() {
        let mut three = form(&[&[2.0, 1.0, 0.0], &[1.0, 3.0, 1.0], &[0.0, 1.0, -4.0]]);
        assert_eq!(three.eliminate(1), Some(0.0));
        // −4 − 1/(3 − ½).
        assert!((three[(0, 0)] + 4.4).abs() < 1e-15);
    }
}
