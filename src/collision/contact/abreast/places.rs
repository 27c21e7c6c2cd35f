//! Places side by side: their data and state, and the force of the ball at each.

use crate::collision::contact::abreast::schedule::Stage;
use crate::collision::contact::collider::Collider;
use crate::collision::contact::collocation::POINTS;
use crate::collision::contact::each::Each;
use crate::collision::contact::encounter::Encounter;
use crate::collision::contact::power_law::PowerLaw;
use crate::collision::contact::step::AHEAD;
use crate::collision::contact::touch::Touch;

/// Ball and bat at one moment, at every place.
#[derive(Clone, Default)]
pub(super) struct Motion<const W: usize> {
    /// Time since the first touch (s).
    pub time: Each<W>,
    /// Approach z (m) and its speed (m/s).
    pub closing: Each<W>,
    pub speed: Each<W>,
    /// Impulse so far (N s).
    pub impulse: Each<W>,
    /// Compression (m) and force (N).
    pub compression: Each<W>,
    pub force: Each<W>,
    /// Real and imaginary parts of the memory of every mode (N s).
    pub memories: Vec<[Each<W>; 2]>,
}

/// Effect of the force at each point of a step on the compression at each point ahead (m/N).
pub(super) type Coupling<const W: usize> = [[Each<W>; POINTS]; AHEAD];

/// Factors that move one mode on by a time: `e^{iωt}`, and `E_k` ([`crate::motion::phi`]), each as real and imaginary
/// part.
pub(super) type Move<const W: usize> = ([Each<W>; 2], [[Each<W>; 2]; POINTS]);

/// Hits at several places, computed side by side.
pub(super) struct Abreast<'a, const W: usize> {
    pub collider: &'a Collider,
    pub omegas: Vec<f64>,
    /// `c/ω` of every mode (s/kg).
    pub weights: Vec<Each<W>>,
    pub inverse_mass: Each<W>,
    /// `1/μ + Σ c_n` (1/kg).
    pub lightness: Each<W>,
    pub rest: Each<W>,
    pub speed: Each<W>,
    pub energy: Each<W>,
    pub deepest: Each<W>,
    pub stiffness: Each<W>,
    pub exponent: Each<W>,
    pub unloading: Each<W>,
    pub accuracy: f64,
    /// Number of runs of steps at every place.
    pub runs: Each<W>,
    pub couplings: Vec<(usize, Coupling<W>)>,
    pub now: Motion<W>,
    pub next: Motion<W>,
    /// The largest compression (m) and its force (N), if the places that step are on their way back.
    pub top: Option<[Each<W>; 2]>,
    /// The largest compression (m) and its force (N) of every place's last turn.
    pub tops: [Each<W>; 2],
    /// The compression in the last step: length of the step, its end as a share of the length, coefficients of the
    /// powers.
    pub last: ([Each<W>; 2], [Each<W>; POINTS]),
    /// Places where [`Self::last`] is known.
    pub known: Each<W>,
    /// Energy that the ball lost in earlier touches (J).
    pub spent: Each<W>,
    /// Places where the force had almost gone, and places where it then rose again.
    pub faint: Each<W>,
    pub late: Each<W>,
    pub defect: Each<W>,
    pub corrected: Each<W>,
    pub failed: Each<W>,
    /// Places that failed because the steps are too long.
    pub coarse: Each<W>,
    /// Number of the last modes in which other bats differ, and the records for them.
    pub differ: usize,
    pub kept: Vec<Kept<W>>,
    pub steps: Each<W>,
    /// The next stage at every place, and its encounter so far.
    pub stages: [Stage; W],
    pub met: [Encounter; W],
    /// When every place's touch began (s), and the number of records when its first touch ended.
    pub began: [f64; W],
    pub first: Each<W>,
}

/// One record for the changes of the impulse by varied bats.
pub(super) enum Kept<const W: usize> {
    /// A step.
    Step(Walked<W>),
    /// A flight of that time (s) at some places, and those of them where a touch was over before.
    Flight { which: Each<W>, time: Each<W>, parted: Each<W> },
}

/// Record of a step.
pub(super) struct Walked<const W: usize> {
    pub level: usize,
    /// The largest compression (m) and its force (N), on the way back.
    pub top: Option<[Each<W>; 2]>,
    /// The places that took it.
    pub taken: Each<W>,
    pub slope: [Each<W>; AHEAD],
    pub force: [Each<W>; POINTS],
    /// Imaginary parts of the memories of the last modes at the points ahead, mode by mode.
    pub points: Vec<[Each<W>; AHEAD]>,
    pub turned: Option<Turned<W>>,
}

/// The turn of the places that did so in a step.
pub(super) struct Turned<const W: usize> {
    pub which: Each<W>,
    pub time: Each<W>,
    pub moves: Vec<Move<W>>,
    /// The slope (N/m) and the force (N) there, and the last modes' memories.
    pub slope: Each<W>,
    pub force: Each<W>,
    pub memories: Vec<Each<W>>,
}

impl<'a, const W: usize> Abreast<'a, W> {
    /// Places before the first touch; the last one fills the unused lanes. Varied bats differ in that number of the
    /// last modes.
    pub(super) fn new(
        collider: &'a Collider,
        touches: &[Touch<'a, PowerLaw>],
        differ: usize,
    ) -> Self {
        let count = touches[0].felt.gains.len();
        let omegas = Vec::from_iter(collider.poles[..count].iter().map(|s| s.im));
        let (of, weights) = lanes(touches, &omegas);
        let stage = |l: usize| if l < touches.len() { Stage::Touch } else { Stage::Over };
        let mut lightness = of[0];
        for n in 0..count {
            lightness += weights[n] * omegas[n];
        }
        let [inverse_mass, rest, speed, energy, deepest, stiffness, exponent, unloading] = of;
        let still = Motion { memories: vec![Default::default(); count], ..Motion::default() };
        Self {
            collider,
            omegas,
            weights,
            inverse_mass,
            lightness,
            rest,
            speed,
            energy,
            deepest,
            stiffness,
            exponent,
            unloading,
            accuracy: touches[0].accuracy,
            runs: Each::default(),
            couplings: Vec::with_capacity(8),
            now: Motion { speed, ..still.clone() },
            next: still,
            top: None,
            tops: [deepest, Each::default()],
            last: ([Each::all(1.0); 2], [Each::default(); POINTS]),
            known: Each::default(),
            spent: Each::default(),
            faint: Each::default(),
            late: Each::default(),
            defect: Each::default(),
            corrected: Each::default(),
            failed: Each::default(),
            coarse: Each::default(),
            differ,
            kept: vec![],
            steps: Each::default(),
            stages: std::array::from_fn(stage),
            met: std::array::from_fn(|_| Encounter { touches: 1, ..Encounter::default() }),
            began: [0.0; W],
            first: Each::default(),
        }
    }

    /// The exponent of the force at present.
    #[inline(always)]
    pub(super) fn power(&self) -> Each<W> {
        if self.top.is_some() { self.unloading } else { self.exponent }
    }

    /// The forces (N) at compressions (m); 0 for a compression of 0 or less.
    #[inline(always)]
    pub(super) fn forces<const N: usize>(&self, x: [Each<W>; N]) -> [Each<W>; N] {
        let [from, scale] = self.top.unwrap_or([Each::all(1.0), self.stiffness]);
        let mut share = x;
        for i in 0..N {
            share[i] = Each::default().below(x[i]).choose(x[i], from) / from;
        }
        let mut forces = Each::powers(share, self.power());
        for i in 0..N {
            forces[i] = Each::default().below(x[i]).choose(scale * forces[i], Each::default());
        }
        forces
    }

    /// The forces (N) at compressions (m) that differ by `by` from others where the forces are known: `F (1 + δ)^p` by
    /// its series if δ is small.
    #[inline(always)]
    pub(super) fn near<const N: usize>(
        &self,
        x: [Each<W>; N],
        known: [Each<W>; N],
        by: [Each<W>; N],
    ) -> [Each<W>; N] {
        /// The `pδ` up to which the omitted terms are below ε.
        const NEAR: f64 = 0.05;
        const TERMS: usize = 8;
        let power = self.power();
        let most = Each::all(NEAR) / power.max(Each::all(1.0));
        let (mut share, mut near) = (by, [Each::default(); N]);
        let mut all = Each::all(1.0);
        for i in 0..N {
            let before = x[i] - by[i];
            let pressed = Each::default().below(before);
            share[i] = by[i] / pressed.choose(before, Each::all(1.0));
            near[i] = share[i].abs().within(most).and(pressed);
            all = all.and(near[i]);
        }
        let mut sum = [Each::all(1.0); N];
        for k in (1..=TERMS).rev() {
            let factor = (power + (1.0 - k as f64)) * (1.0 / k as f64);
            for i in 0..N {
                sum[i] = factor * share[i] * sum[i] + 1.0;
            }
        }
        for i in 0..N {
            sum[i] = sum[i] * known[i];
        }
        if all.everywhere() {
            return sum;
        }
        let forces = self.forces(x);
        for i in 0..N {
            sum[i] = near[i].choose(sum[i], forces[i]);
        }
        sum
    }

    /// The slopes (N/m) of the forces at those compressions.
    #[inline(always)]
    pub(super) fn slope(&self, x: Each<W>, force: Each<W>) -> Each<W> {
        let pressed = Each::default().below(x);
        pressed.choose(self.power() * force / pressed.choose(x, Each::all(1.0)), Each::default())
    }

    /// `z + Σ y` (m).
    #[inline(always)]
    pub(super) fn reach(&self, state: &Motion<W>) -> Each<W> {
        let mut sum = Each::default();
        for n in 0..self.weights.len() {
            sum += self.weights[n] * state.memories[n][1];
        }
        state.closing - sum
    }

    /// Rate of [`Self::reach`] (m/s).
    #[inline(always)]
    pub(super) fn rate(&self, state: &Motion<W>) -> Each<W> {
        let mut sum = Each::default();
        for n in 0..self.weights.len() {
            sum += self.weights[n] * state.memories[n][0] * self.omegas[n];
        }
        state.speed - sum
    }
}

/// 1/μ, flexibility, closing speed, energy, depth, stiffness and both exponents of every place, and `c/ω` of its modes; the
/// last place fills the unused lanes.
#[inline(always)]
fn lanes<const W: usize>(
    touches: &[Touch<PowerLaw>],
    omegas: &[f64],
) -> ([Each<W>; 8], Vec<Each<W>>) {
    let (mut of, mut weights) = ([Each::default(); 8], vec![Each::default(); omegas.len()]);
    for l in 0..W {
        let Touch { felt, law, speed, energy, deepest, .. } = &touches[l.min(touches.len() - 1)];
        let parts = [felt.inverse_mass, felt.rest, *speed, *energy, *deepest];
        let law = [law.stiffness, law.exponent, law.unloading];
        for (of, part) in of.iter_mut().zip(parts.into_iter().chain(law)) {
            of.0[l] = part;
        }
        for (n, omega) in omegas.iter().enumerate() {
            weights[n].0[l] = felt.gains[n] / omega;
        }
    }
    (of, weights)
}
