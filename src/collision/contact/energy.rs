//! The energy of a step: the bump on its force that corrects it, and the loss by damping.

use faer::c64;

use crate::collision::contact::collocation::{LANES, Lanes, POINTS, sum};
use crate::collision::contact::force_law::{ForceLaw, Top};
use crate::collision::contact::step::Step;
use crate::collision::contact::table::ForcePiece;
use crate::collision::contact::touch::{State, Touch};
use crate::motion::phi::{driven, moments, shortened};

/// A bump may change the impulse by at most this many times the energy that it corrects, both relative.
const ILL: f64 = 3.0;
/// Relative energy error that one bump corrects.
const SMALL: f64 = 1e-8;
/// Relative energy error that shorter steps do not reduce.
const ROUND_OFF: f64 = 1e-12;

/// Limits on a step's force.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// The largest compression, once the ball is on its way back.
    pub top: Option<Top>,
    /// The step's largest force (N).
    pub most: f64,
    /// Largest share of the impulse by which a bump may change it.
    pub slight: f64,
}

impl Limits {
    /// Whether that force is negative somewhere; on the way back it is small and steep.
    #[inline(always)]
    pub fn pulls(&self, piece: &ForcePiece) -> bool {
        self.top.is_some_and(|top| piece.pulls(top.force))
    }
}

impl<L: ForceLaw> Touch<'_, L> {
    /// Adds a bump to the force of a step of that length so that the energy balance closes; returns the relative error
    /// before. Near the largest compression and at the end of the force, a bump does no work. `None` asks for a shorter
    /// step: the bump would be more than twice the largest force, or would change the impulse by more than the `slight`
    /// share and by more than the energy error.
    #[inline(always)]
    pub fn correct(
        &self,
        next: &mut State,
        length: f64,
        bump: &[[Lanes; 2]],
        Limits { top, most, slight }: Limits,
    ) -> Option<f64> {
        let mut off = 0.0;
        for round in 0..4 {
            self.settle(next, top);
            let defect = self.whole_energy(next, top) - self.energy;
            if round == 0 {
                off = (defect - next.defect).abs() / self.energy;
            }
            next.defect = defect;
            if defect.abs() <= 1e-14 * self.energy {
                break;
            }
            // `s(1 − s)` has the area 1/6, half of it to each side of the middle.
            let speed = -length * self.felt.inverse_mass / 6.0;
            let closing = 0.5 * length * speed;
            let [moved, work] = self.done_by(next, bump);
            let slope = next.speed * speed / self.felt.inverse_mass + work;
            let size = -defect / (slope + next.force * (closing + moved));
            // A force does no work while the compression does not change.
            let kick = (size * speed / self.speed).abs();
            let ill = kick > slight.max(ILL * defect.abs() / self.energy);
            if size.is_nan() || size.abs() > 2.0 * most || ill {
                if off > ROUND_OFF {
                    return None;
                }
                break;
            }
            next.speed += size * speed;
            next.closing += size * closing;
            next.impulse += size * length / 6.0;
            next.bump += size;
            for (memory, bump) in next.memories.iter_mut().zip(bump) {
                for part in 0..2 {
                    for l in 0..LANES {
                        memory[part][l] += size * bump[part][l];
                    }
                }
            }
            // The remaining error is the square of this, and is corrected with that of the next step.
            if defect.abs() <= SMALL * self.energy {
                self.settle(next, top);
                next.defect = 0.0;
                break;
            }
        }
        Some(off)
    }

    /// Effect of a bump of 1 N on the modes: their displacement (m/N), and the rate of their energy with its size
    /// (J/N).
    #[inline(always)]
    fn done_by(&self, next: &State, bump: &[[Lanes; 2]]) -> [f64; 2] {
        let count = self.swings.len();
        let (bump, memories) = (&bump[..count], &next.memories[..count]);
        let [mut moved, mut work] = [[0.0; LANES]; 2];
        for k in 0..count {
            let (of, [re, im], [p, q]) = (&self.swings[k], &memories[k], &bump[k]);
            for l in 0..LANES {
                let rate = of.decay[l] * im[l] + of.swing[l] * re[l];
                let other = of.decay[l] * q[l] + of.swing[l] * p[l];
                moved[l] -= of.weight[l] * q[l];
                work[l] += of.flexibility[l] * (rate * other + of.square[l] * im[l] * q[l]);
            }
        }
        [sum(moved), sum(work)]
    }

    /// Energy lost by damping from the beginning of a step to a time in it, `∫ Σ 2ζω m_n q′² dt` (J).
    pub fn loss(&self, now: &State, step: &Step, time: f64) -> f64 {
        let force = shortened(step.powers, time / step.length);
        let of_mode = |(n, s): (usize, &c64)| {
            let square = self.square(*s, time, now.memory(n), &force);
            -2.0 * s.re * self.swings[n / LANES].flexibility[n % LANES] * time * square
        };
        let damped = self.modes().filter(|(_, s)| s.re != 0.0);
        damped.map(of_mode).sum()
    }

    /// `∫₀¹ (Im sv)²` of a mode with that memory under `Σ f_k τ^k`, over the time's share τ.
    ///
    /// A slow mode by Lobatto's rule; for the others `v = A e^{zτ} + P(τ)`, whose products have closed integrals.
    fn square(&self, s: c64, time: f64, memory: c64, force: &[f64; POINTS]) -> f64 {
        const SLOW: f64 = 0.25;
        let z = s * time;
        if z.norm_sqr() < SLOW {
            let rate = |at: f64| (s * driven(s, memory, &shortened(*force, at), at * time)).im;
            let points = self.rule.at.iter().zip(&self.rule.weights);
            return points.map(|(at, weight)| weight * rate(*at).powi(2)).sum();
        }
        let inverse = z.inv();
        // P′ = zP + f from the highest power down; Q = Im sP.
        let (mut above, mut part, mut q) = (c64::default(), c64::default(), [0.0; POINTS]);
        for k in (0..POINTS).rev() {
            part = inverse * (above - time * force[k]);
            q[k] = (s * part).im;
            above = part * k as f64;
        }
        let b = s * (memory - part);
        // (Im B e^{zτ})² = (|B|² e^{2aτ} − Re B² e^{2zτ})/2, a the real part of z.
        let (growth, turned) = ((2.0 * z.re).exp_m1(), moments::<1>(z * 2.0).1[0]);
        let all = b.norm_sqr() * growth / (2.0 * z.re);
        let mut sum = 0.5 * (all - (b * b * turned).re);
        // ∫ τ^k e^{zτ} from k = 0 up.
        let (whole, [mut moment]) = moments::<1>(z);
        for k in 0..POINTS {
            sum += 2.0 * q[k] * (b * moment).im;
            sum += (0..POINTS).map(|j| q[k] * q[j] / (j + k + 1) as f64).sum::<f64>();
            moment = inverse * (whole - moment * (k + 1) as f64);
        }
        sum
    }
}
