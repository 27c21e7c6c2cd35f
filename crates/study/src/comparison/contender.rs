//! One of the compared bats: its hits, its sweet spot, and their errors.
//!
//! The stated error of an exit speed is `e` (times the closing speed, m/s). The other errors follow from it:
//!
//! ```text
//! the best place      3 (e/ℓ)/|v″|, v″ the curvature of the exit speed there, and no more than
//!                     where the speed is 2 e less
//! an end of the zone  2 e over the slope of the speed there
//! BBCOR               (1 + r) e / closing speed, r = m/M_eff, as e_A has e / closing speed
//! vibration           m e times the closing speed: what the impulse moves between the energies
//! ```
//!
//! The error is a curve along the barrel too. It changes by its own size within ℓ, half a wave of the first omitted
//! mode, and its slope may be three times that. The first and the last line are estimates, not bounds; the tests
//! compare all of them with far more accurate hits.

pub use crate::answers::Figure;
use crate::answers::{Answer, figure};
use crate::engine::{
    BarrelSpeed, Bat, Glance, HitsAlong, Hitter, Impact, Inertia, Model, Peak, Request, Result,
    STANDARD_PIVOT, Scene, Sweep, SweetSpot, SwingLaw, Trial, sweep,
};
use crate::verdict::Verdict;

/// Accuracy of the exit speeds in a search for places, relative to the closing speed.
const SOUGHT: f64 = 1e-6;
/// A place is located to this share of the bat at best.
const LOCATED: f64 = 1e-6;

/// The terms of the hits, equal for all bats.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Terms {
    /// How a hit is computed.
    pub model: Model,
    /// Whether only the request's modes may contribute.
    pub exactly: bool,
    /// Distance between the compared places (m).
    pub every: f64,
    /// Number of steps in the search for the best places, and the share of the outer half to which they are located.
    pub look: (usize, f64),
    /// Speed of one point of every barrel; `None` if the swings are equal or follow a law.
    pub barrel: Option<BarrelSpeed>,
}

/// A bat, its hits and its sweet spot.
#[derive(Debug, Clone)]
pub struct Contender {
    /// The bat.
    pub bat: Bat,
    /// Mass, balance point and inertia of the bat.
    pub inertia: Inertia,
    /// The scene with this bat's own swing.
    pub scene: Scene,
    /// The swing law, if one batter swings all bats.
    pub law: Option<SwingLaw>,
    /// The hits at the places that are compared.
    pub sweep: Sweep,
    /// The sweet spot by every definition.
    pub spot: SweetSpot,
    /// The fastest ball (m/s).
    pub best_speed: Option<Figure>,
    /// Place of the fastest ball (m from the knob end).
    pub best_place: Option<Figure>,
    /// Energy that the fastest hit leaves in vibration (J).
    pub vibration: Option<Figure>,
    /// The zone where the exit speed is within 1 % of the best (m).
    pub zone: Option<[Figure; 2]>,
    /// Place where the least energy stays in vibration (m).
    pub least_place: Option<Figure>,
    /// Least energy that stays in vibration (J).
    pub least_vibration: Option<Figure>,
    /// The largest BBCOR of the outer half, of the free bat and of one held at the standard pivot.
    pub bbcor: [Option<Figure>; 2],
    /// Doubts about its hits.
    pub verdict: Verdict,
}

/// Places of one bat (m from the knob end), rising: at multiples of `every` from its tip, at quarters between them, and
/// at multiples of `every` from its knob end.
pub fn places(bat: &Bat, every: f64, reach: f64) -> Vec<f64> {
    let length = bat.length();
    let from_tip = multiples([0.0, reach], 0.25 * every).into_iter().map(|k| length - k);
    let from_knob = multiples([length - reach, length], every).into_iter();
    let mut all: Vec<f64> = from_tip.chain(from_knob).map(|x| x.clamp(0.0, length)).collect();
    all.sort_by(f64::total_cmp);
    all.dedup_by(|a, b| (*a - *b).abs() < 1e-9 * length);
    all
}

/// The multiples of a step from one value to another, where a rounding must not lose one.
pub fn multiples([low, high]: [f64; 2], step: f64) -> Vec<f64> {
    let first = (low / step - 1e-9).ceil().max(0.0) as usize;
    let last = (high / step + 1e-9).floor() as usize;
    (first..=last).map(|k| k as f64 * step).collect()
}

impl Contender {
    /// Hits the bat at those places (m, rising) and finds its sweet spot.
    ///
    /// # Errors
    ///
    /// As [`sweep`].
    pub fn new(
        bat: Bat,
        (scene, law): (Scene, Option<SwingLaw>),
        request: &Request,
        terms: &Terms,
        places: &[f64],
    ) -> Result<Self> {
        let trial = Trial { model: terms.model, scene: &scene };
        let accuracy = trial.accuracy(request, terms.exactly);
        let sweep = sweep(&bat, terms.model, &scene, &accuracy, places)?;
        Self::of(bat, (scene, law), terms, sweep)
    }

    /// Finds the sweet spot of a bat that has been hit.
    ///
    /// # Errors
    ///
    /// As [`Hitter::new`].
    pub fn of(
        bat: Bat,
        (scene, law): (Scene, Option<SwingLaw>),
        terms: &Terms,
        sweep: Sweep,
    ) -> Result<Self> {
        let hitter = Hitter::new(terms.model, &scene, &bat, &sweep.solution, sweep.effort)?;
        let sought = Sought::new(&hitter, terms.look);
        let spot = SweetSpot::within(&sought.looked);
        let fastest = spot.exit_speed_max.map(|peak| sought.hit(peak));
        let best = spot.exit_speed_max.zip(fastest.as_ref());
        let best = best.map(|(peak, hit)| sought.best(peak, hit));
        let zone = spot.exit_speed_max.zip(spot.zone);
        let zone = zone.map(|(peak, zone)| zone.map(|edge| sought.edge(peak, edge)));
        let least = spot.vibration_min.map(|peak| sought.least(peak));
        let bbcor = [1, 2].map(|k| sought.bbcor(k));
        let wall = spot.exit_speed_max.and_then(|peak| hitter.wall_figures(peak.x));
        let verdict = Verdict::of((&bat, &scene), &sweep, fastest.as_ref(), wall);
        Ok(Self {
            inertia: bat.inertia(),
            best_speed: best.map(|best| best[0]),
            best_place: best.map(|best| best[1]),
            vibration: best.map(|best| best[2]).filter(|_| spot.vibration_min.is_some()),
            zone,
            least_place: least.map(|least| least[0]),
            least_vibration: least.map(|least| least[1]),
            bbcor,
            verdict,
            bat,
            law,
            spot,
            sweep,
            scene,
        })
    }

    /// Swing weight (kg m²), about a point 6 in from the knob end.
    pub fn swing_weight(&self) -> f64 {
        self.inertia.about(STANDARD_PIVOT)
    }

    /// The hit at that place (m from the knob end), if it was computed.
    pub fn at(&self, x: f64) -> Option<&Impact> {
        let near = |impact: &&Impact| (impact.x - x).abs() < 1e-8 * self.bat.length();
        self.sweep.impacts.iter().find(near)
    }

    /// The exit speed there (m/s).
    pub fn speed(&self, x: f64) -> Option<Figure> {
        exit_speed(self.at(x)?, &self.scene)
    }

    /// Frequency of a mode (Hz), counted from 1.
    pub fn frequency(&self, order: usize) -> Option<Figure> {
        figure(Answer::Frequency(order), &self.bat, &self.sweep.solution)
    }

    /// A node of a mode (m), both counted from 1.
    pub fn node(&self, order: usize, node: usize) -> Option<Figure> {
        let mode = self.sweep.solution.modes.get(order - 1)?;
        Some(Figure::new(*mode.nodes.get(node - 1)?, mode.error.nodes))
    }
}

/// The exit speed of an impact (m/s); None where ball and bat do not meet.
pub fn exit_speed(impact: &Impact, scene: &Scene) -> Option<Figure> {
    let outcome = impact.outcome.as_ref()?;
    let closing = impact.bat_speed + scene.ball_speed;
    Some(Figure::new(outcome.exit_speed, outcome.error * closing))
}

/// The results of the search on the outer half of a bat, with their errors.
pub struct Sought<'a> {
    /// The outer half after a pass along it.
    pub looked: HitsAlong<'a>,
    length: f64,
    /// The share of the bat to which a place is located.
    located: f64,
    hitter: &'a Hitter<'a>,
}

impl<'a> Sought<'a> {
    /// Makes a pass along the outer half of that hitter's bat; `look` has the number of steps and the accuracy of
    /// places.
    pub fn new(hitter: &'a Hitter<'a>, look: (usize, f64)) -> Self {
        let looked = HitsAlong::outer(look, hitter);
        let length = hitter.profile.length();
        Self { looked, length, located: LOCATED.max(0.5 * look.1), hitter }
    }

    /// Error of the exit speed (m/s), and the closing speed (m/s).
    fn speed_error(&self, x: f64) -> [f64; 2] {
        self.error_of(&self.hitter.strike(x))
    }

    /// The hit at a place that was found.
    pub fn hit(&self, peak: Peak) -> Impact {
        self.hitter.strike(peak.x)
    }

    /// Error of the exit speed of a hit (m/s), and its closing speed (m/s).
    fn error_of(&self, impact: &Impact) -> [f64; 2] {
        let closing = impact.bat_speed + self.hitter.scene.ball_speed;
        // Without an outcome the error is the whole speed.
        let error = impact.outcome.as_ref().map_or(1.0, |outcome| outcome.error);
        [error.max(SOUGHT) * closing, closing]
    }

    /// Speed, place and vibration of the fastest ball, by the hit there.
    pub fn best(&self, peak: Peak, hit: &Impact) -> [Figure; 3] {
        let [error, closing] = self.error_of(hit);
        let off = self.place_error(peak, error, |seen| Some(seen.exit_speed));
        let energy = |x: f64| self.hitter.glance(x).and_then(|seen| seen.vibration);
        let here = energy(peak.x).unwrap_or(0.0);
        let apart = |x: f64| energy(x).map_or(0.0, |there| (there - here).abs());
        let beside = apart((peak.x - off).max(0.0)).max(apart((peak.x + off).min(self.length)));
        let moved = self.hitter.scene.ball.mass_kg * error * closing;
        [
            Figure::new(peak.value, error),
            Figure::new(peak.x, off),
            Figure::new(here, moved + beside),
        ]
    }

    /// Place and value of the least vibration.
    pub fn least(&self, peak: Peak) -> [Figure; 2] {
        let [error, closing] = self.speed_error(peak.x);
        let moved = self.hitter.scene.ball.mass_kg * error * closing;
        let upside_down = Peak { x: peak.x, value: -peak.value };
        let off = self.place_error(upside_down, moved, |seen| Some(-seen.vibration?));
        [Figure::new(peak.x, off), Figure::new(peak.value, moved)]
    }

    /// Possible error of the place (m) of a maximum whose value has that error.
    fn place_error(
        &self,
        peak: Peak,
        error: f64,
        value: impl Fn(&Glance) -> Option<f64> + Copy,
    ) -> f64 {
        let at = |x: f64| self.hitter.glance(x).and_then(|seen| value(&seen));
        let step = 0.01 * self.length;
        let curvature = at(peak.x - step).zip(at(peak.x + step));
        let curvature = curvature.map(|(a, b)| (2.0 * peak.value - a - b) / (step * step));
        let half_wave = self.length / (self.hitter.modes_used() + 1) as f64;
        let reach = self.reach(peak, 2.0 * error, value);
        let near = curvature.filter(|bend| *bend > 0.0).map(|bend| 3.0 * error / half_wave / bend);
        let near = near.map_or(reach, |near| near.min(reach)) + self.located * self.length;
        near.max(self.looked.looked_every.unwrap_or(0.0))
    }

    /// Largest distance from the peak at which the value is lower by at most `by`, on the side where that is farther.
    fn reach(&self, peak: Peak, by: f64, value: impl Fn(&Glance) -> Option<f64>) -> f64 {
        let floor = peak.value - by;
        let enough = |seen: &Option<Glance>| {
            seen.as_ref().and_then(&value).is_some_and(|value| value >= floor)
        };
        let side = |end: f64| {
            // From the peak outwards, doubling the distance; a distant maximum is a different one.
            let (most, sign) = ((end - peak.x).abs(), (end - peak.x).signum());
            let mut far = self.located * self.length;
            loop {
                let next = [1.0, 2.0, 4.0, 8.0].map(|times| far * times);
                let seen = self.hitter.glances(&next.map(|far| peak.x + sign * far.min(most)));
                let last = (0..next.len()).find(|k| next[*k] >= most || !enough(&seen[*k]));
                match last {
                    Some(last) => return next[last].min(most),
                    None => far *= 16.0,
                }
            }
        };
        let ends = [0.5 * self.length, self.length];
        ends.map(side).into_iter().fold(self.located * self.length, f64::max)
    }

    /// An end of the zone, with its error: the speed there and the threshold have the same error.
    pub fn edge(&self, peak: Peak, x: f64) -> Figure {
        let [error, _] = self.speed_error(x);
        let step = 1e-4 * self.length * (peak.x - x).signum();
        let speed = |x: f64| self.hitter.glance(x).map(|seen| seen.exit_speed);
        let slope = speed(x + step).zip(speed(x)).map(|(a, b)| ((a - b) / step).abs());
        let at_an_end = [0.5 * self.length, self.length].iter().any(|end| (x - end).abs() < 1e-9);
        let off = match slope {
            _ if at_an_end => 0.0,
            Some(slope) if slope > 0.0 => 2.0 * error / slope,
            _ => (peak.x - x).abs(),
        };
        Figure::new(x, off.min((peak.x - x).abs()) + self.located * self.length)
    }

    /// The largest BBCOR, one of [`Hitter::figures`].
    pub fn bbcor(&self, which: usize) -> Option<Figure> {
        let peak = self.looked.largest_figure(which)?;
        let [error, closing] = self.speed_error(peak.x);
        let slow = self.hitter.figures(peak.x, 0.0)[which];
        let fast = self.hitter.figures(peak.x, error)[which];
        // BBCOR is linear in the exit speed.
        let off = if closing > 0.0 { (fast - slow).abs() } else { 0.0 };
        Some(Figure::new(peak.value, off))
    }
}
