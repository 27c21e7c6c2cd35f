//! Where does the iteration for the slowest modes start?

use crate::base::{Real, golden};
use crate::beam::element::MOST_STRAINS;
use crate::beam::rule::MOST_POINTS;
use crate::beam::view::View;

impl<R: Real> View<'_, R> {
    /// Scaled strains under bending moments (N m): `L⁻¹ ∫ M P_j dx`, the Galerkin solution of `EI w″ = M`. `moments`
    /// receives the places of a cell's points, 0 to 1 along the bat, and replaces them by the moments there.
    #[inline(always)]
    fn strains_of_moments(&self, out: &mut [R], mut moments: impl FnMut(&mut [R])) {
        let (points, scale) = (self.rule.count(), R::splat(1.0) / self.length);
        let balance = self.balance * scale;
        let (cells, springs) = out.split_at_mut(self.strains * self.count);
        springs.fill(R::default());
        for (place, q) in cells.chunks_exact_mut(self.strains).enumerate() {
            let cell = self.cells.at(place);
            let (first, step) = (cell.arm * scale, cell.length * scale);
            let mut values = [R::default(); MOST_POINTS];
            for (s, point) in values.iter_mut().zip(&self.rule.points) {
                let arm = first + R::splat(point.s) * step;
                *s = if place < self.split { balance - arm } else { balance + arm };
            }
            moments(&mut values[..points]);
            // Moments do no work on the shear strains.
            let mut work = [R::default(); MOST_STRAINS];
            for (i, (value, point)) in values.iter().zip(&self.rule.points).enumerate() {
                let share = R::splat(point.weight) * cell.length * *value;
                let polynomials = self.rule.polynomials(i, self.terms);
                for (work, p) in work.iter_mut().zip(&polynomials[..self.terms - 2]) {
                    *work += share * R::splat(*p);
                }
            }
            cell.scaled_by_loads(&work[..self.strains], self.terms - 2, q);
        }
    }

    /// The start vector of Lanczos for `count` modes: bending moments with a part of each wanted mode and little of the
    /// others.
    ///
    /// `s²(1 − s)² Σ_j a_j T_j(1 − 2(3s² − 2s³))`, `j ≤ count + 1`, `s` along the bat, `T_j` Chebyshev's polynomials,
    /// so that the terms are nearly `cos jπs`. With these, moment and shear vanish at the free ends as a mode's do. The
    /// `a_j` are golden-ratio fractions, all different. A small part of every unknown is added, so that no mode is ever
    /// missing.
    #[inline(always)]
    pub fn start(&self, count: usize, out: &mut [R]) {
        const TOUCH: f64 = 1e-9;
        let number = R::splat;
        let held = self.fixed.is_some();
        self.strains_of_moments(
            out,
            #[inline(always)]
            |places| {
                let [mut wave, mut before, mut now] = [[R::default(); MOST_POINTS]; 3];
                for (wave, s) in wave.iter_mut().zip(places.iter()) {
                    *wave = number(1.0) - number(2.0) * *s * *s * (number(3.0) - number(2.0) * *s);
                }
                // Clenshaw's recurrence, all points at once.
                for j in (0..count + 2).rev() {
                    let amplitude = number(0.2 + golden::fraction(j));
                    for ((wave, before), now) in
                        wave[..places.len()].iter().zip(&mut before).zip(&mut now)
                    {
                        (*now, *before) = (amplitude + (*wave + *wave) * *now - *before, *now);
                    }
                }
                for (i, s) in places.iter_mut().enumerate() {
                    // A held bat has moments at its ends too.
                    let bump = if held { number(0.5) } else { *s * (number(1.0) - *s) };
                    *s = bump * bump * (now[i] - wave[i] * before[i]);
                }
            },
        );
        let mut largest = R::default();
        out.iter().for_each(|q| largest = largest.max(q.abs()));
        for (k, q) in out.iter_mut().enumerate() {
            *q += number(TOUCH * (golden::fraction(k) - 0.5)) * largest;
        }
        if let Some(fixed) = self.fixed {
            fixed.project(out);
        }
    }
}
