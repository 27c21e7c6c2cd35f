//! The encounters at places of a bat, as many side by side as there are lanes.

use faer::c64;
use pulp::{Simd, WithSimd};

use crate::base::widest;
use crate::collision::contact::abreast::places::{Abreast, Kept};
use crate::collision::contact::abreast::schedule::{Schedule, Stage};
use crate::collision::contact::collider::{
    Collider, FLIGHT_IN_STEPS, LONGEST_FLIGHT, MOST_TOUCHES,
};
use crate::collision::contact::each::Each;
use crate::collision::contact::encounter::Encounter;
use crate::collision::contact::flight::Landing;
use crate::collision::contact::force_law::{ForceLaw, Top};
use crate::collision::contact::power_law::PowerLaw;
use crate::collision::contact::pressing::Run;
use crate::collision::contact::touch::{DrivingPoint, State, Touch};

/// Exponents on the way back that can be computed side by side. A force that is steeper, or that ends less smoothly, is
/// computed alone.
const EXPONENTS: [f64; 2] = [6.0, 60.0];

/// One of several impact points.
#[derive(Debug, Clone, Copy)]
pub struct Place<'a> {
    /// The bat as the ball feels it there.
    pub felt: &'a DrivingPoint,
    /// Varied bats, with at most as many modes.
    pub others: &'a [DrivingPoint],
    /// The ball's law.
    pub law: PowerLaw,
    /// Closing speed (m/s).
    pub speed: f64,
}

impl Place<'_> {
    /// Number of the last modes in which varied bats differ; at least 1 if there are any.
    fn differ(&self) -> usize {
        let gains = &self.felt.gains;
        let same = |other: &DrivingPoint| {
            let pairs = gains.iter().zip(&other.gains);
            pairs.take_while(|(own, other)| own == other).count().min(gains.len() - 1)
        };
        self.others.iter().map(|other| gains.len() - same(other)).max().unwrap_or(0)
    }
}

impl PowerLaw {
    /// Whether touches of this law can be met side by side.
    fn goes_abreast(&self) -> bool {
        (EXPONENTS[0]..=EXPONENTS[1]).contains(&self.unloading)
            && (1.0..3.0).contains(&self.exponent)
    }
}

/// Number of places that are computed side by side.
pub const ABREAST: usize = 4;

impl Collider {
    /// The encounters at places of one bat, computed side by side; `None` where one must be computed alone.
    ///
    /// An encounter depends only on its own place: it has the same bits when computed alone.
    pub fn meet_abreast(&self, places: &[Place], accuracy: f64) -> Vec<Option<Encounter>> {
        /// For better accuracies, steps whose length is chosen for each place are half as many.
        const FINEST: f64 = 2e-8;
        let mut all = vec![None; places.len()];
        if accuracy < FINEST || self.poles.iter().any(|s| s.re != 0.0) {
            return all;
        }
        let modes = |k: usize| places[k].felt.gains.len();
        let fits = |k: &usize| {
            places[*k].law.goes_abreast() && (1..=self.poles.len()).contains(&modes(*k))
        };
        // Steps have equal lengths, and the bats equal numbers of modes.
        let alike = |a: &usize, b: &usize| {
            places[*a].law.exponent == places[*b].law.exponent && modes(*a) == modes(*b)
        };
        let mut open: Vec<usize> = (0..places.len()).filter(fits).collect();
        // If steps of the usual lengths are too coarse, steps of half the length are used.
        for finer in 0..2 {
            let mut coarse = vec![];
            for which in open.chunk_by(alike).flat_map(|alike| alike.chunks(ABREAST)) {
                let group: Vec<&Place> = which.iter().map(|k| &places[*k]).collect();
                let met = match group[..] {
                    [alone] => {
                        widest(Lanes::<1> { collider: self, places: &[alone], accuracy, finer })
                    }
                    _ => {
                        widest(Lanes::<ABREAST> { collider: self, places: &group, accuracy, finer })
                    }
                };
                for (k, met) in which.iter().zip(met) {
                    match met {
                        Ok(met) => all[*k] = Some(met),
                        Err(TooCoarse(true)) => coarse.push(*k),
                        Err(TooCoarse(false)) => {}
                    }
                }
            }
            open = coarse;
        }
        all
    }
}

/// At most as many places as there are lanes.
struct Lanes<'a, const W: usize> {
    collider: &'a Collider,
    places: &'a [&'a Place<'a>],
    accuracy: f64,
    finer: usize,
}

impl<const W: usize> WithSimd for Lanes<'_, W> {
    type Output = Vec<std::result::Result<Encounter, TooCoarse>>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let Self { collider, places, accuracy, finer } = self;
        let mut touches = Vec::with_capacity(places.len());
        for Place { felt, law, speed, .. } in places.iter().copied() {
            touches.push(collider.touch(felt, *law, *speed, accuracy));
        }
        let differ = places.iter().map(|place| place.differ()).max().unwrap_or(0);
        let mut abreast = Abreast::<W>::new(collider, &touches, differ);
        abreast.press(&touches, &Schedule::new(accuracy, touches[0].law.exponent, finer));
        // No closures here: they would be compiled without the wider vectors.
        let (mut whole, mut first) = (None, None);
        if differ > 0 {
            whole = Some(abreast.gradient(Each::all(f64::INFINITY)));
            if abreast.met.iter().any(Encounter::again) {
                first = Some(abreast.gradient(abreast.first));
            }
        }
        let mut all = Vec::with_capacity(places.len());
        for l in 0..places.len() {
            if abreast.failed.0[l] != 0.0 {
                all.push(Err(TooCoarse(abreast.coarse.0[l] != 0.0)));
                continue;
            }
            let mut met = std::mem::take(&mut abreast.met[l]);
            met.late |= abreast.late.0[l] != 0.0;
            (met.corrected, met.steps) = (abreast.corrected.0[l], abreast.steps.0[l] as usize);
            if let Some(whole) = whole.as_ref().filter(|_| !places[l].others.is_empty()) {
                for other in places[l].others {
                    met.changes.push(abreast.change(whole, other, l));
                    met.first_changes.push(abreast.change(
                        first.as_ref().unwrap_or(whole),
                        other,
                        l,
                    ));
                }
                met.faster = Some(whole.speed.0[l]);
            }
            all.push(Ok(met));
        }
        all
    }
}

impl<const W: usize> Abreast<'_, W> {
    /// What follows at a place after the remaining force was released: the ball is gone, or the bat catches up with it.
    #[inline(always)]
    pub(super) fn leave(&mut self, l: usize, touch: &Touch<PowerLaw>) -> Stage {
        let mut run = Run::new(self.state(l, touch));
        let released = run.now.time;
        // The ball may have left within the last step.
        for _ in 0..3 {
            let reach = touch.reach(&run.now);
            if reach >= 0.0 {
                break;
            }
            let time = -reach / touch.rate(&run.now);
            touch.drift(&mut [&mut run.now], time);
        }
        let reach = touch.reach(&run.now);
        if reach > 1e-12 * touch.deepest {
            match touch.fly(&mut run, [0.0, reach], f64::INFINITY) {
                Landing::Parts => {}
                Landing::Meets => {
                    self.met[l].late = true;
                    self.known.0[l] = 0.0;
                    self.resume(l, &run.now, released, false);
                    return Stage::Late;
                }
                Landing::Gone | Landing::Open => {
                    self.failed.0[l] = 1.0;
                    return Stage::Over;
                }
            }
        }
        let [compression, force] = self.tops.map(|top| top.0[l]);
        let (end, impulse, met) = (run.now.time, run.now.impulse, &mut self.met[l]);
        met.time += end - self.began[l];
        met.compression = met.compression.max(compression);
        met.peak_force = met.peak_force.max(force);
        (met.end, met.impulse) = (end, impulse);
        if met.touches == 1 {
            (met.first_end, met.first_impulse) = (end, impulse);
            self.first.0[l] = self.kept.len() as f64;
        }
        let top = Some(Top { compression, force });
        self.spent.0[l] += touch.law.energy(0.0, top)[1];
        met.lost_in_ball = self.spent.0[l];
        let longest = LONGEST_FLIGHT.max(FLIGHT_IN_STEPS * self.collider.longest);
        let flight = touch.fly(&mut run, [f64::NEG_INFINITY, 0.0], longest);
        if flight == Landing::Meets && met.touches < MOST_TOUCHES {
            met.touches += 1;
            self.began[l] = run.now.time;
            (self.known.0[l], self.faint.0[l]) = (0.0, 0.0);
            self.resume(l, &run.now, released, true);
            return Stage::Touch;
        }
        if flight != Landing::Gone {
            run.now.spent = self.spent.0[l];
            met.open = touch.most_that_follows(&run.now);
        }
        met.in_modes = (0..self.weights.len()).map(|n| touch.in_mode(&run.now, n)).collect();
        Stage::Over
    }

    /// Ball and bat at a place now.
    #[inline(always)]
    fn state(&self, l: usize, touch: &Touch<PowerLaw>) -> State {
        let now = &self.now;
        let mut state = State::at_first(touch.swings.len(), now.speed.0[l]);
        (state.time, state.closing) = (now.time.0[l], now.closing.0[l]);
        state.impulse = now.impulse.0[l];
        for (n, [re, im]) in now.memories.iter().enumerate() {
            state.remember(n, c64::new(re.0[l], im.0[l]));
        }
        state
    }

    /// Continues from that state at a place, after a flight since that time (s), with a new touch if ball and bat have
    /// `parted`.
    #[inline(always)]
    fn resume(&mut self, l: usize, state: &State, since: f64, parted: bool) {
        let now = &mut self.now;
        (now.time.0[l], now.closing.0[l]) = (state.time, state.closing);
        for (n, [re, im]) in now.memories.iter_mut().enumerate() {
            let memory = state.memory(n);
            (re.0[l], im.0[l]) = (memory.re, memory.im);
        }
        if parted {
            (now.compression.0[l], now.force.0[l]) = (0.0, 0.0);
        }
        if self.differ > 0 {
            let mut only = Each::default();
            only.0[l] = 1.0;
            let parted = if parted { only } else { Each::default() };
            self.kept.push(Kept::Flight { which: only, time: only * (state.time - since), parted });
        }
    }
}

/// Why a place was not computed: whether its steps were too coarse.
struct TooCoarse(bool);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beam::dowel;
    use crate::beam::dowel::Ends;
    use crate::collision::energy_loss;

    const SPEED: f64 = 70.0;

    /// A free uniform dowel of 0.85 kg, 0.838 m and 238.9 Hz at the fraction `at` of its length.
    fn felt(at: f64, modes: usize) -> DrivingPoint {
        let (ball, mass, length) = (0.145, 0.85, 0.838);
        let arm = (at - 0.5) * length;
        let recoil = 1.0 / mass + arm * arm / (mass * length * length / 12.0);
        let gain =
            |n: usize| (energy_loss::wpi_shape(n, at) / energy_loss::wpi_alpha(n)).powi(2) / mass;
        DrivingPoint {
            inverse_mass: 1.0 / ball + recoil,
            gains: (1..=modes).map(gain).collect(),
            rest: 3e-9,
        }
    }

    fn collider(modes: usize) -> Collider {
        let first = dowel::beta_l(Ends::FreeFree, 1);
        let omega = |n: usize| {
            std::f64::consts::TAU * 238.9 * (dowel::beta_l(Ends::FreeFree, n) / first).powi(2)
        };
        let modes: Vec<[f64; 2]> = (1..=modes).map(|n| [omega(n), 0.0]).collect();
        Collider::new(&modes, 8e-5)
    }

    fn dowels() -> Vec<DrivingPoint> {
        (0..41).map(|k| felt(0.5 + 0.0122 * f64::from(k), 10)).collect()
    }

    fn met(places: &[Place], accuracy: f64) -> Vec<Option<Encounter>> {
        collider(10).meet_abreast(places, accuracy)
    }

    /// The same result alone, side by side, and with other places in the other lanes.
    #[test]
    fn a_place_has_the_same_bits_whatever_is_beside_it() {
        let (felt, law) = (dowels(), PowerLaw::new(6.53e7, 1.84, 0.5));
        let others: Vec<_> =
            felt.iter().map(|at| [DrivingPoint { rest: 0.0, ..at.clone() }]).collect();
        let place = |(felt, others)| Place { felt, others, law, speed: SPEED };
        let places: Vec<Place> =
            felt.iter().zip(&others).map(|(f, o)| place((f, &o[..]))).collect();
        for accuracy in [1e-3, 1e-6] {
            let all = met(&places, accuracy);
            // The others are computed one by one.
            assert!(all.iter().flatten().count() > 35);
            let again = all.iter().flatten().filter(|met| met.is_delicate()).count();
            assert!((3..30).contains(&again), "{again}");
            let mut turned = places.clone();
            turned.reverse();
            for ((k, one), other) in all.iter().enumerate().zip(met(&turned, accuracy).iter().rev())
            {
                assert_eq!(one, other);
                assert_eq!(*one, met(&places[k..=k], accuracy)[0]);
            }
        }
    }

    /// Compared with much finer steps one by one: a ball that touches once, again, late, or is pressed again.
    #[test]
    fn side_by_side_a_ball_is_met_as_one_by_one() {
        let felt = dowels();
        for (restitution, stiff) in [(0.3, 1.0), (0.45, 1.0), (0.5, 10.0), (0.6, 0.3)] {
            let law = PowerLaw::new(stiff * 6.53e7, 1.84, restitution);
            let places = felt.iter().map(|felt| Place { felt, others: &[], law, speed: SPEED });
            let places: Vec<Place> = places.collect();
            for accuracy in [1e-3, 1e-5, 1e-7] {
                for (place, met) in places.iter().zip(met(&places, accuracy)) {
                    // A place that fails is computed alone.
                    let Some(met) = met else { continue };
                    let exact = collider(10).meet(place.felt, &law, SPEED, 1e-11);
                    assert!(met.is_sound(place.felt, SPEED));
                    let off = (met.impulse / exact.impulse - 1.0).abs();
                    let most = if exact.is_delicate() { 30.0 } else { 1.0 };
                    assert!(off < most * 1e-2 * accuracy, "{restitution} {accuracy:e} {off:e}");
                    let told = |met: &Encounter| [met.touches, met.reloads];
                    if accuracy < 1e-4 {
                        assert_eq!(told(&met), told(&exact));
                        assert!((met.end / exact.end - 1.0).abs() < 0.3 * accuracy);
                    }
                }
            }
        }
    }

    /// Compared with central differences of encounters: derivatives by the gain of a mode, the flexibility and the
    /// closing speed, at the end and when the ball leaves for the first time.
    #[test]
    fn the_changes_are_the_derivatives_of_the_impulse() {
        const SHARE: f64 = 1e-6;
        let law = PowerLaw::new(6.53e7, 1.84, 0.5);
        let other = |felt: &DrivingPoint, which: usize, share: f64| {
            let mut other = felt.clone();
            match other.gains.get_mut(which) {
                Some(gain) => *gain *= 1.0 + share,
                None => other.rest *= 1.0 + share,
            }
            other
        };
        let mut seen = 0;
        for felt in dowels().iter().step_by(4) {
            let others: Vec<DrivingPoint> =
                [1, 7, 9, 10].map(|which| other(felt, which, SHARE)).to_vec();
            let place = Place { felt, others: &others, law, speed: SPEED };
            // A place that fails is computed alone.
            let Some(all) = met(&[place], 1e-7).remove(0) else { continue };
            seen += 1;
            let impulse = |felt: &DrivingPoint, speed: f64| {
                let met = collider(10).meet(felt, &law, speed, 1e-10);
                [met.impulse, met.first_impulse]
            };
            let near = |found: f64, [a, b]: [f64; 2]| {
                let difference = 0.5 * (a - b);
                let most = 3e-3 * difference.abs() + 1e-12 * all.impulse;
                assert!((found - difference).abs() < most, "{found:e} {difference:e}");
            };
            for (k, which) in [1, 7, 9, 10].into_iter().enumerate() {
                let sides = [SHARE, -SHARE].map(|share| impulse(&other(felt, which, share), SPEED));
                near(all.changes[k], sides.map(|side| side[0]));
                near(all.first_changes[k], sides.map(|side| side[1]));
            }
            let sides = [SHARE, -SHARE].map(|share| impulse(felt, SPEED * (1.0 + share))[0]);
            near(SHARE * all.faster.unwrap(), sides);
        }
        assert!(seen > 7, "{seen}");
    }
}
