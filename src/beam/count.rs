//! How many motions are slower than a given one: none can be missing from a list that has as many.
//!
//! The number of eigenvalues below σ is that of the negative pivots of `K − σM` (Sylvester's law of
//! inertia). Each side is eliminated inwards from its free end: what lies beyond a border is a
//! quadratic form in its deflection and rotation, to which a cell adds its own, in its strains, and
//! hands on what is left when they are eliminated. Strains keep the pivots near 1 and nothing large
//! is subtracted, whatever the number of elements. A contact enters as its reaction `t`, with `t
//! (a·u) − ½ δ t²`, so that no stiffness is ever multiplied; every such reaction adds one negative
//! pivot of its own.
//!
//! # Source
//!
//! Sylvester's law and its use for eigenvalues: B. N. Parlett, The Symmetric Eigenvalue Problem
//! (1980), chapters 1 and 3; pivots of order 2: J. R. Bunch, B. N. Parlett, SIAM J. Numer. Anal. 8
//! (1971) 639.

use crate::beam::fixed::{At, Fixed, What};
use crate::beam::statics::Statics;

/// A symmetric form in unknowns of which the last two are deflection and rotation.
#[derive(Debug, Clone, Default)]
struct Form {
    rows: Vec<Vec<f64>>,
}

/// How many motions of the bat, rigid ones included, are slower than `omega` (rad/s); none if a
/// pivot was too small to tell.
pub fn slower<const N: usize, const W: usize>(
    statics: &Statics<f64, N, W>,
    omega: f64,
) -> Option<usize> {
    let tau = omega * omega / statics.energy_unit;
    let mut count = 0;
    let [knob, tip] = [0, 1].map(|side| inwards(statics, side, tau, &mut count));
    let (mut knob, tip) = (knob?, tip?);
    // Outwards on the knob side a rotation has the other sign.
    let last = knob.rows.len() - 1;
    for row in &mut knob.rows {
        row[last] = -row[last];
    }
    knob.rows[last].iter_mut().for_each(|v| *v = -*v);
    let mut whole = knob.beside(tip);
    count += whole.eliminate(0)? as isize;
    let reactions = statics.fixed.as_ref().map_or(0, |fixed| fixed.contacts.len()) as isize;
    usize::try_from(count - reactions).ok()
}

/// The form of one side at the root; adds its negative pivots.
fn inwards<const N: usize, const W: usize>(
    statics: &Statics<f64, N, W>,
    side: usize,
    tau: f64,
    count: &mut isize,
) -> Option<Form> {
    let cells = statics.body().sides()[side].clone();
    let mut form = Form::new(2);
    let mut stops = statics.stops(side).iter().rev().peekable();
    let fixed = statics.fixed.as_deref();
    for k in cells.clone().rev() {
        while let Some(stop) = stops.next_if(|stop| cells.start + stop.after == k + 1) {
            fixed.iter().for_each(|fixed| form.meet(fixed, stop.what, tau));
        }
        form = form.behind(statics, k, tau);
        *count += form.eliminate(2)? as isize;
    }
    for stop in stops {
        fixed.iter().for_each(|fixed| form.meet(fixed, stop.what, tau));
    }
    Some(form)
}

impl Form {
    fn new(size: usize) -> Self {
        Self { rows: vec![vec![0.0; size]; size] }
    }

    /// One unknown more, the first.
    fn extend(&mut self) {
        self.rows.iter_mut().for_each(|row| row.insert(0, 0.0));
        self.rows.insert(0, vec![0.0; self.rows.len() + 1]);
    }

    /// Adds `value (a·u)²`.
    fn add_square(&mut self, value: f64, a: &[(usize, f64)]) {
        for (i, p) in a {
            for (j, q) in a {
                self.rows[*i][*j] += value * p * q;
            }
        }
    }

    /// Adds what stands at this border.
    fn meet(&mut self, fixed: &Fixed<f64>, what: What, tau: f64) {
        match what {
            What::Point(k) => {
                let point = &fixed.points[k];
                if point.spring.is_some() {
                    self.extend();
                }
                let last = self.rows.len() - 1;
                let mut moved = vec![(last - 1, 1.0), (last, point.offset)];
                if let Some(spring) = point.spring {
                    moved.push((0, spring.softness));
                    self.rows[0][0] += 1.0;
                }
                self.add_square(-tau * point.mass, &moved);
                self.add_square(-tau * point.inertia, &[(last, 1.0)]);
            }
            What::Joint(k) => {
                let softness = fixed.joints[k].softness;
                self.extend();
                // The rotation beyond is the one here and that of the joint.
                let last = self.rows.len() - 1;
                let turned: Vec<f64> = self.rows[last].clone();
                for j in 1..=last {
                    self.rows[0][j] += softness * turned[j];
                    self.rows[j][0] += softness * turned[j];
                }
                self.rows[0][0] += 1.0 + softness * softness * turned[last];
            }
            What::Contact(k) => {
                let contact = &fixed.contacts[k];
                self.extend();
                let last = self.rows.len() - 1;
                let held = if contact.turning { last } else { last - 1 };
                self.rows[0][held] += contact.sign;
                self.rows[held][0] += contact.sign;
                self.rows[0][0] -= contact.spring.map_or(0.0, |s| s.softness.powi(2));
            }
        }
    }

    /// The form at the inner end of a cell, its strains and what was left not yet eliminated: the
    /// strains, then the unknowns of this form, then deflection and rotation.
    fn behind<const N: usize, const W: usize>(
        &self,
        statics: &Statics<f64, N, W>,
        k: usize,
        tau: f64,
    ) -> Self {
        let cell = &statics.cells[k];
        let link = &cell.link;
        let (strains, carried) = (W - 2, self.rows.len() - 2);
        let beds = statics.fixed.iter().flat_map(|fixed| &fixed.contacts).filter_map(|contact| {
            let spring = contact.spring?;
            match contact.at {
                At::Bed { cell, point } if cell == k => Some((point, spring.softness)),
                _ => None,
            }
        });
        let beds: Vec<(usize, f64)> = beds.collect();
        let size = strains + carried + beds.len() + 2;
        let (w, theta) = (size - 2, size - 1);
        let place = |i: usize| if i < strains { i } else { size - W + i };
        let mut form = Self::new(size);
        for i in 0..W {
            for j in 0..W {
                form.rows[place(i)][place(j)] = -tau * link.mass[i][j];
            }
        }
        (0..strains).for_each(|i| form.rows[i][i] += 1.0);
        // Deflection and rotation at the outer end.
        let mut outer = [[0.0; 2]; W];
        for i in 0..strains {
            outer[i] = [link.lift[i], link.turn[i]];
        }
        (outer[W - 2], outer[W - 1]) = ([1.0, 0.0], [link.length, 1.0]);
        let ends = [carried, carried + 1];
        for i in 0..W {
            let row: [f64; 2] = std::array::from_fn(|e| {
                outer[i][0] * self.rows[ends[0]][ends[e]]
                    + outer[i][1] * self.rows[ends[1]][ends[e]]
            });
            for j in 0..W {
                form.rows[place(i)][place(j)] += row[0] * outer[j][0] + row[1] * outer[j][1];
            }
            for c in 0..carried {
                let value =
                    outer[i][0] * self.rows[ends[0]][c] + outer[i][1] * self.rows[ends[1]][c];
                form.rows[place(i)][strains + c] += value;
                form.rows[strains + c][place(i)] += value;
            }
        }
        for a in 0..carried {
            for b in 0..carried {
                form.rows[strains + a][strains + b] += self.rows[a][b];
            }
        }
        for (b, (point, softness)) in beds.into_iter().enumerate() {
            let reaction = strains + carried + b;
            let on = statics.body().point_load(k, statics.rule.at::<N>(point));
            for (i, value) in on.into_iter().enumerate() {
                form.rows[reaction][place(i)] += value;
                form.rows[place(i)][reaction] += value;
            }
            form.rows[reaction][reaction] -= softness * softness;
        }
        debug_assert!(w + 1 == theta);
        form
    }

    /// Two sides' forms in one, with the same deflection and rotation.
    fn beside(self, other: Self) -> Self {
        let (own, others) = (self.rows.len() - 2, other.rows.len() - 2);
        let mut form = Self::new(own + others + 2);
        for (rows, first, count) in [(self.rows, 0, own), (other.rows, own, others)] {
            let place = |i: usize| if i < count { first + i } else { own + others + i - count };
            for i in 0..count + 2 {
                for j in 0..count + 2 {
                    form.rows[place(i)][place(j)] += rows[i][j];
                }
            }
        }
        form
    }

    /// Eliminates all unknowns but the last `kept` and returns how many pivots were negative.
    fn eliminate(&mut self, kept: usize) -> Option<usize> {
        // A pivot in its turn that is not small beside its column is good enough.
        const SMALL: f64 = 0.1;
        let (mut negative, mut first) = (0, 0);
        let end = self.rows.len() - kept;
        while first < end {
            let largest = |row: &[f64]| row[first..].iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            if self.rows[first][first].abs() <= SMALL * largest(&self.rows[first]) {
                let (i, j) = self.pivot(first, end)?;
                self.exchange(first, i);
                if i != j {
                    self.exchange(first + 1, j);
                    negative += self.eliminate_two(first)?;
                    first += 2;
                    continue;
                }
            }
            let pivot = self.rows[first][first];
            negative += usize::from(pivot < 0.0);
            let row = self.rows[first].clone();
            for i in first + 1..self.rows.len() {
                let part = row[i] / pivot;
                if part != 0.0 {
                    (first + 1..self.rows.len()).for_each(|j| self.rows[i][j] -= part * row[j]);
                }
            }
            first += 1;
        }
        self.rows.drain(..end);
        self.rows.iter_mut().for_each(|row| drop(row.drain(..end)));
        Some(negative)
    }

    /// The next pivot: one place on the diagonal, or two that belong together.
    fn pivot(&self, first: usize, end: usize) -> Option<(usize, usize)> {
        // Bunch and Parlett's bound.
        const ALPHA: f64 = 0.640_388_203_202_208;
        let all = (first..end).flat_map(|i| (first..=i).map(move |j| (i, j)));
        let size = |(i, j): &(usize, usize)| self.rows[*i][*j].abs();
        let on = all.clone().filter(|(i, j)| i == j).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        let off = all.filter(|(i, j)| i != j).max_by(|a, b| size(a).total_cmp(&size(b)));
        match off {
            Some(off) if size(&on) < ALPHA * size(&off) => Some((off.1, off.0)),
            _ if size(&on) > 0.0 => Some(on),
            _ => None,
        }
    }

    fn exchange(&mut self, a: usize, b: usize) {
        self.rows.swap(a, b);
        self.rows.iter_mut().for_each(|row| row.swap(a, b));
    }

    /// Eliminates two unknowns together: one pivot of each sign.
    fn eliminate_two(&mut self, first: usize) -> Option<usize> {
        let [a, b] = [self.rows[first].clone(), self.rows[first + 1].clone()];
        let (p, q, r) = (a[first], a[first + 1], b[first + 1]);
        let det = p * r - q * q;
        if det >= 0.0 {
            return None;
        }
        for i in first + 2..self.rows.len() {
            let (of_a, of_b) = ((r * a[i] - q * b[i]) / det, (p * b[i] - q * a[i]) / det);
            for j in first + 2..self.rows.len() {
                self.rows[i][j] -= of_a * a[j] + of_b * b[j];
            }
        }
        Some(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn form(rows: &[&[f64]]) -> Form {
        Form { rows: rows.iter().map(|row| row.to_vec()).collect() }
    }

    #[test]
    fn negative_pivots_are_negative_eigenvalues_whatever_the_order() {
        // Eigenvalues 3 and −1; ±1; 1, 1, −2 (all ones off the diagonal: 2, −1, −1).
        assert_eq!(form(&[&[1.0, 2.0], &[2.0, 1.0]]).eliminate(0), Some(1));
        assert_eq!(form(&[&[0.0, 1.0], &[1.0, 0.0]]).eliminate(0), Some(1));
        let ones: &[&[f64]] = &[&[0.0, 1.0, 1.0], &[1.0, 0.0, 1.0], &[1.0, 1.0, 0.0]];
        assert_eq!(form(ones).eliminate(0), Some(2));
        assert_eq!(form(&[&[0.0]]).eliminate(0), None);
    }

    #[test]
    fn what_is_kept_is_the_schur_complement() {
        let mut three = form(&[&[2.0, 1.0, 0.0], &[1.0, 3.0, 1.0], &[0.0, 1.0, -4.0]]);
        assert_eq!(three.eliminate(1), Some(0));
        // −4 − 1/(3 − ½).
        assert!((three.rows[0][0] + 4.4).abs() < 1e-15);
    }
}
