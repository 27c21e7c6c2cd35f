//! Where does the iteration for the slowest motions start?

use crate::base::golden;
use crate::base::real::Real;
use crate::beam::rule::MOST_POINTS;
use crate::beam::statics::Statics;

impl<R: Real, const N: usize, const W: usize> Statics<R, N, W> {
    /// Scaled strains under bending moments (N m): `L⁻¹ ∫ M P_j dx`, the Galerkin solution of
    /// `EI w″ = M`. `moments` gets the places of a cell's points, 0 to 1 along the bat, and leaves
    /// the moments there.
    #[inline(always)]
    pub fn strains_of_moments(&self, out: &mut [R], mut moments: impl FnMut(&mut [R])) {
        out[(W - 2) * self.cells.len()..].fill(R::default());
        let (points, scale) = (self.rule.count(), R::splat(1.0) / self.length);
        let balance = self.balance * scale;
        for (place, (cell, q)) in self.cells.iter().zip(out.chunks_exact_mut(W - 2)).enumerate() {
            let (first, step) = (cell.arm * scale, cell.link.length * scale);
            let mut values = [R::default(); MOST_POINTS];
            for (s, point) in values.iter_mut().zip(&self.rule.points) {
                let arm = first + R::splat(point.s) * step;
                *s = if place < self.split { balance - arm } else { balance + arm };
            }
            moments(&mut values[..points]);
            let mut work = [R::default(); N];
            for (i, (value, point)) in values.iter().zip(&self.rule.points).enumerate() {
                let share = R::splat(point.weight) * cell.link.length * *value;
                for (work, p) in work.iter_mut().zip(self.rule.at::<N>(i)) {
                    *work += share * R::splat(*p);
                }
            }
            q.fill(R::default());
            for i in 0..N - 2 {
                for j in 0..=i {
                    q[i] += cell.inverse[i][j] * work[j];
                }
            }
        }
    }

    /// Where Lanczos starts for `count` modes: bending moments with something of each wanted mode
    /// and little of the others.
    ///
    /// `s²(1 − s)² Σ_j a_j T_j(1 − 2(3s² − 2s³))`, `j ≤ count + 1`, `s` along the bat, `T_j`
    /// Chebyshev's polynomials, so that the terms are nearly `cos jπs`: moment and shear vanish at
    /// the free ends as a mode's do. The `a_j` are golden-ratio fractions, all different. A touch
    /// of every unknown is added, so that no mode is ever left out.
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
                    // Where the bat is held there are moments at its ends too.
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
        self.fixed.iter().for_each(|fixed| fixed.project(out));
    }
}
