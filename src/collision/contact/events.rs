//! Where does a step end early: at the largest compression, at the return to it, or at the end of the contact?

use crate::collision::contact::collocation::{LANES, Lanes, POINTS, sum};
use crate::collision::contact::energy::Limits;
use crate::collision::contact::force_law::{ForceLaw, Top};
use crate::collision::contact::step::{CompressionPath, Step};
use crate::collision::contact::table::StepTable;
use crate::collision::contact::touch::{State, Touch};
use crate::motion::phi::moments;

/// Why a step ends early.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// The compression is at its largest.
    Turned,
    /// The compression is as large as its largest again.
    Again,
    /// The compression is back at 0.
    Gone,
}

/// The event at which a step stops, and the limits on its force.
#[derive(Debug, Clone, Copy)]
pub struct Stop {
    /// Why it stops.
    pub event: Event,
    /// Limits on its force.
    pub limits: Limits,
}

/// Largest move of a state by a series, as a share of the step.
const NUDGED: f64 = 1e-4;
/// Allowed error of the energy balance at the end of a contact, as a share of the energy.
pub const CLOSED: f64 = 1e-11;

impl<L: ForceLaw> Touch<'_, L> {
    /// The event in a step, if there is one.
    #[inline(always)]
    pub fn event(&self, step: &Step, next: &State, top: Option<Top>) -> Option<Event> {
        match top {
            None => (self.rate(next) < 0.0).then_some(Event::Turned),
            Some(_) if step.compression[1..].iter().any(|x| *x <= 0.0) => Some(Event::Gone),
            Some(top) => {
                let beyond = step.force[1..].iter().any(|force| *force > top.force);
                beyond.then_some(Event::Again)
            }
        }
    }

    /// Whether the vibrating surface may leave the ball and return between two points of a step. It does not if the
    /// compression there is more than `max|x″| g²/8`, with g the time between two points.
    #[inline(always)]
    pub fn may_pass(&self, now: &State, step: &Step, next: &State) -> bool {
        let least = step.compression[1..].iter().fold(now.compression, |least, x| least.min(*x));
        let mut bend = [0.0; LANES];
        for ((of, before), after) in self.swings.iter().zip(&now.memories).zip(&next.memories) {
            for l in 0..LANES {
                let [before, after] = [before, after].map(|[re, im]| re[l].abs() + im[l].abs());
                bend[l] += of.weight[l] * of.square[l] * before.max(after);
            }
        }
        let bend = sum(bend);
        let way = step.length * (self.rule.at[2] - self.rule.at[1]);
        least < 0.125 * bend * way * way
    }

    /// The quantity that is zero at the event, and its rate.
    #[inline(always)]
    pub fn distance(&self, event: Event, state: &State, top: Option<Top>) -> [f64; 2] {
        if event == Event::Turned {
            let mut rate = -state.force * self.felt.inverse_mass;
            // Im s(sv + F).
            rate -= self.total(state, |of, [re, im], l| {
                let (a, b) = (of.decay[l], of.swing[l]);
                let inner = [a * re[l] - b * im[l] + state.force, a * im[l] + b * re[l]];
                of.weight[l] * (a * inner[1] + b * inner[0])
            });
            return [self.rate(state), rate];
        }
        let rate = self.rate(state);
        match top.filter(|_| event == Event::Again) {
            // The force is known there and need not be that of the step.
            Some(top) => [self.reach(state) - top.compression - self.felt.rest * top.force, rate],
            None => [self.reach(state) - self.felt.rest * state.force, rate],
        }
    }

    /// Moves the state to the event. Returns the relative energy error before its correction, or `None` if it cannot be
    /// corrected.
    #[inline(always)]
    pub fn stop(&self, stop: Stop, now: &State, step: &mut Step, next: &mut State) -> Option<f64> {
        let Stop { event, limits: Limits { top, .. } } = stop;
        // The end of the step, or the first point beyond the event.
        let goal = |x: f64| match (event, top) {
            (Event::Gone, _) => x <= 0.0,
            (Event::Again, Some(top)) => x > top.compression,
            _ => false,
        };
        let beyond = (1..POINTS).find(|i| goal(step.compression[*i])).unwrap_or(POINTS - 1);
        let end = step.length * self.rule.at[beyond];
        if beyond < POINTS - 1 {
            self.within(now, step, end, next);
        }
        let (from, to) = (self.distance(event, now, top), self.distance(event, next, top));
        let mut time = end * crossing(from[0], from[1] * end, to[0], to[1] * end);
        self.within(now, step, time, next);
        let guess = time;
        self.approach(event, step, top, &mut time, next);
        if (time - guess).abs() > NUDGED * step.length {
            self.within(now, step, time, next);
        }
        let mut corrected = self.round_off(stop, now, step, &mut time, next)?;
        self.settle(next, top);
        if event == Event::Gone && self.open(next, top) > CLOSED {
            // The last of the force ends within the step: a step of that length represents it exactly.
            let (mut last, mut end) = (*step, time);
            for _ in 0..4 {
                let table = StepTable::new(self.rule, self.poles, end);
                let course = CompressionPath { from: 0.0, ..self.course(step) };
                (last, _) = self.solve(&table, &self.coupling(&table), now, top, Some(&course));
                self.advance(&table, now, &last, next);
                let [x, rate] = self.distance(event, next, top);
                let by = -x / rate;
                if !(by.abs() > 1e-6 * end && by.abs() < 0.5 * end) {
                    break;
                }
                end += by;
            }
            // Only the correction of the shorter step counts.
            corrected = self.round_off(stop, now, &last, &mut end, next)?;
            *step = last;
        }
        self.settle(next, top);
        Some(corrected)
    }

    /// Relative error of the energy balance.
    #[inline(always)]
    pub fn open(&self, state: &State, top: Option<Top>) -> f64 {
        (self.whole_energy(state, top) - self.energy).abs() / self.energy
    }

    /// Corrects the energy of a state at an event, and then the time of the event.
    #[inline(always)]
    pub fn round_off(
        &self,
        Stop { event, limits }: Stop,
        now: &State,
        step: &Step,
        time: &mut f64,
        next: &mut State,
    ) -> Option<f64> {
        let mut corrected = 0.0;
        if self.damped {
            next.lost = now.lost + self.loss(now, step, *time);
        }
        let (mut known, mut bump) = (f64::NAN, vec![<[Lanes; 2]>::default(); self.swings.len()]);
        for _ in 0..4 {
            let length = *time;
            // A bump is small, so its end need not be exact.
            let as_before = (length - known).abs() <= 1e-6 * length;
            if !as_before {
                known = length;
                for (n, s) in self.modes() {
                    let (_, [_, first, second]) = moments(s * length);
                    let done = (first - second) * length;
                    let (parts, l) = (&mut bump[n / LANES], n % LANES);
                    (parts[0][l], parts[1][l]) = (done.re, done.im);
                }
            }
            corrected += self.correct(next, length, &bump, limits)?;
            let [x, rate] = self.distance(event, next, limits.top);
            let by = -x / rate;
            let there = x.abs() < 1e-14 * self.deepest || by.abs() > 0.1 * step.length;
            if event == Event::Turned || there || !by.is_finite() {
                break;
            }
            *time += by;
            self.nudge(next, step, *time, by);
        }
        Some(corrected)
    }

    /// Newton's method from a state near the event.
    #[inline(always)]
    pub fn approach(
        &self,
        event: Event,
        step: &Step,
        top: Option<Top>,
        time: &mut f64,
        next: &mut State,
    ) {
        for _ in 0..4 {
            let [left, rate] = self.distance(event, next, top);
            let by = -left / rate;
            if by.is_nan() || by.abs() > 0.1 * step.length {
                break;
            }
            *time += by;
            self.nudge(next, step, *time, by);
            if by.abs() <= 1e-8 * step.length {
                break;
            }
        }
    }
}

/// The zero in [0, 1] of the cubic with those values and slopes at both ends.
#[inline(always)]
fn crossing(from: f64, from_slope: f64, to: f64, to_slope: f64) -> f64 {
    let rise = to - from;
    let (square, cube) =
        (3.0 * rise - 2.0 * from_slope - to_slope, from_slope + to_slope - 2.0 * rise);
    let (mut low, mut high) = (0.0, 1.0);
    let mut s = (from / (from - to)).clamp(0.0, 1.0);
    for _ in 0..20 {
        let value = ((cube * s + square) * s + from_slope) * s + from;
        let slope = (3.0 * cube * s + 2.0 * square) * s + from_slope;
        if (value > 0.0) == (from > 0.0) {
            low = s
        } else {
            high = s
        }
        let newton = s - value / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        let done = (next - s).abs() < 1e-10;
        s = next;
        if done {
            break;
        }
    }
    s
}
