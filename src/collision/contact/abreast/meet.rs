//! The encounters at places of a bat, as many side by side as there are lanes.

use faer::c64;
use pulp::{Simd, WithSimd};

use crate::base::lanes::widest;
use crate::collision::contact::abreast::each::Each;
use crate::collision::contact::abreast::places::{Abreast, Motion};
use crate::collision::contact::abreast::press::Released;
use crate::collision::contact::collider::{Collider, FLIGHT_IN_STEPS, LONGEST_FLIGHT};
use crate::collision::contact::encounter::Encounter;
use crate::collision::contact::flight::Landing;
use crate::collision::contact::force_law::{ForceLaw, Top};
use crate::collision::contact::power_law::PowerLaw;
use crate::collision::contact::pressing::Run;
use crate::collision::contact::touch::{DrivingPoint, State, Touch};

/// The exponents on the way back that are followed side by side: a force that ends less smoothly, or is steeper, is
/// followed by itself.
const EXPONENTS: [f64; 2] = [6.0, 60.0];

/// A place that is hit beside others.
#[derive(Debug, Clone, Copy)]
pub struct Place<'a> {
    pub felt: &'a DrivingPoint,
    /// Bats beside it, of no more modes.
    pub others: &'a [DrivingPoint],
    pub law: PowerLaw,
    /// Speed (m/s) at which ball and bat near.
    pub speed: f64,
}

impl Place<'_> {
    /// How many of the last modes bats beside have otherwise, 1 at least where there are any.
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

/// How many places go side by side.
pub const ABREAST: usize = 4;

impl Collider {
    /// The encounters at places of one bat, side by side; None where one has to be met by itself.
    ///
    /// An encounter depends on its own place alone: it has the same bits one by one.
    pub fn meet_abreast(&self, places: &[Place], accuracy: f64) -> Vec<Option<Encounter>> {
        /// What is asked beyond this is met one by one.
        const FINEST: f64 = 1e-10;
        let mut all = vec![None; places.len()];
        if accuracy < FINEST || self.poles.iter().any(|s| s.re != 0.0) {
            return all;
        }
        let fits = |k: &usize| places[*k].law.goes_abreast() && !places[*k].felt.gains.is_empty();
        let mut open: Vec<usize> = (0..places.len()).filter(fits).collect();
        // Where steps of the usual lengths are too coarse, by those of half the length.
        for finer in 0..2 {
            let mut coarse = vec![];
            for which in open.chunks(ABREAST) {
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
                        Met::Once(met) => all[*k] = Some(*met),
                        Met::Otherwise => {}
                        Met::TooCoarse => coarse.push(*k),
                    }
                }
            }
            open = coarse;
        }
        all
    }
}

/// What became of a place.
enum Met {
    /// Ball and bat touched once.
    Once(Box<Encounter>),
    /// The steps were too coarse.
    TooCoarse,
    /// Anything else.
    Otherwise,
}

/// As many places as there are lanes, or fewer.
struct Lanes<'a, const W: usize> {
    collider: &'a Collider,
    places: &'a [&'a Place<'a>],
    accuracy: f64,
    finer: usize,
}

impl<const W: usize> WithSimd for Lanes<'_, W> {
    type Output = Vec<Met>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Vec<Met> {
        let Self { collider, places, accuracy, finer } = self;
        let mut touches = Vec::with_capacity(places.len());
        for Place { felt, law, speed, .. } in places.iter().copied() {
            touches.push(collider.touch(felt, *law, *speed, accuracy));
        }
        let differ = places.iter().map(|place| place.differ()).max().unwrap_or(0);
        let mut abreast = Abreast::<W>::new(collider, &touches, differ);
        let mut out = vec![None; places.len()];
        abreast.press(finer, &mut out);
        let mut lasts = Each::default();
        for (l, out) in out.iter().enumerate() {
            lasts.0[l] = out.as_ref().map_or(0.0, |(released, _)| released.last as f64);
        }
        let gradient = (differ > 0).then(|| abreast.gradient(lasts));
        let longest = LONGEST_FLIGHT.max(FLIGHT_IN_STEPS * collider.longest);
        let mut all = Vec::with_capacity(places.len());
        for (l, (touch, out)) in touches.iter().zip(out).enumerate() {
            let coarse = abreast.coarse.0[l] != 0.0;
            let Some((released, motion)) = out else {
                all.push(if coarse { Met::TooCoarse } else { Met::Otherwise });
                continue;
            };
            let met = touch.leave(released, &motion, l, longest).map(|mut met| {
                if let Some(gradient) = &gradient {
                    let change = |other: &DrivingPoint| abreast.change(gradient, other, l);
                    met.changes = places[l].others.iter().map(change).collect();
                    met.first_changes.clone_from(&met.changes);
                }
                Met::Once(Box::new(met))
            });
            all.push(met.unwrap_or(Met::Otherwise));
        }
        all
    }
}

impl Touch<'_, PowerLaw> {
    /// What the meeting left behind, if ball and bat leave each other for good.
    #[inline(always)]
    fn leave<const W: usize>(
        &self,
        released: Released,
        motion: &Motion<W>,
        l: usize,
        longest: f64,
    ) -> Option<Encounter> {
        let mut now = State::at_first(self.swings.len(), motion.speed.0[l]);
        now.time = motion.time.0[l];
        now.closing = motion.closing.0[l];
        now.impulse = motion.impulse.0[l];
        for (n, [re, im]) in motion.memories.iter().enumerate() {
            now.remember(n, c64::new(re.0[l], im.0[l]));
        }
        let top = Some(Top { compression: released.compression, force: released.force });
        let mut run = Run::new(now);
        // It may have left within the last step.
        for _ in 0..3 {
            let reach = self.reach(&run.now);
            if reach >= 0.0 {
                break;
            }
            let time = -reach / self.rate(&run.now);
            self.drift(&mut [&mut run.now], time);
        }
        let reach = self.reach(&run.now);
        if reach > 1e-12 * self.deepest
            && self.fly(&mut run, [0.0, reach], f64::INFINITY) != Landing::Parts
        {
            return None;
        }
        let end = run.now.time;
        if self.fly(&mut run, [f64::NEG_INFINITY, 0.0], longest) != Landing::Gone {
            return None;
        }
        let impulse = run.now.impulse;
        Some(Encounter {
            impulse,
            time: end,
            end,
            first_end: end,
            first_impulse: impulse,
            touches: 1,
            peak_force: released.force,
            compression: released.compression,
            lost_in_ball: self.law.energy(0.0, top)[1],
            in_modes: (0..self.felt.gains.len()).map(|n| self.in_mode(&run.now, n)).collect(),
            corrected: released.corrected,
            steps: released.steps,
            ..Encounter::default()
        })
    }
}
