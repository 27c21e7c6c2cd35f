//! Step after step, the balls are compressed at all places and spring back, until the last of the force is released.
//!
//! The remaining force is released once the energy stored in the ball is a small share of the whole: this energy goes
//! into the motions as one impulse J, which the energy balance determines,
//!
//! ```text
//! ½ a J² − r J = D,    a = 1/μ + Σ c_n, r the rate of x, D the energy that is left in the ball
//! ```

use crate::collision::contact::abreast::places::{Abreast, Coupling, Kept, Move, Turned, Walked};
use crate::collision::contact::abreast::schedule::{Schedule, Stage};
use crate::collision::contact::abreast::solve::SolvedStep;
use crate::collision::contact::collocation::{LANES, POINTS};
use crate::collision::contact::each::Each;
use crate::collision::contact::power_law::PowerLaw;
use crate::collision::contact::pressing::USUAL;
use crate::collision::contact::step::AHEAD;
use crate::collision::contact::touch::Touch;

/// Most steps of the usual length to the largest compression or back, at the accuracy 1e-3.
const MOST: usize = 48;
/// Most runs of steps from one change to the next at a place, and most steps; places that need more are done alone.
const RUNS: f64 = 400.0;
const STEPS: f64 = 4000.0;
/// Allowed error of a return to the largest compression, as a share of it and over the accuracy.
const MISSED: f64 = 1e-3;
/// Energy that the force may still contain when it is released, as a share of the energy with which ball and bat part.
const SLIGHT: f64 = 1e-4;

impl<const W: usize> Abreast<'_, W> {
    /// Runs of steps until the ball is gone at every place that does not fail.
    #[inline(always)]
    pub(super) fn press(&mut self, touches: &[Touch<PowerLaw>], schedule: &Schedule) {
        loop {
            let stages = [Stage::Touch, Stage::Anew, Stage::Back, Stage::Late];
            let waits = |stage: &Stage| self.at_stage(*stage).and(self.failed.fails()).somewhere();
            let Some(stage) = stages.into_iter().find(waits) else { return };
            self.runs += self.at_stage(stage);
            let many = Each::all(RUNS).below(self.runs).or(Each::all(STEPS).below(self.steps));
            self.failed = self.failed.or(many);
            self.run(stage, touches, schedule);
        }
    }

    /// The places at that stage.
    #[inline(always)]
    fn at_stage(&self, stage: Stage) -> Each<W> {
        let mut which = Each::default();
        for l in 0..W {
            which.0[l] = f64::from(u8::from(self.stages[l] == stage));
        }
        which
    }

    /// Takes steps at all places of that stage until each has reached another one.
    #[inline(always)]
    fn run(&mut self, stage: Stage, touches: &[Touch<PowerLaw>], schedule: &Schedule) {
        let back = matches!(stage, Stage::Back | Stage::Late);
        self.top = back.then_some(self.tops);
        let cut = self.energy * (1e-6 * self.accuracy).clamp(1e-14, 1e-9);
        let mut done = self.at_stage(stage).fails();
        for step in 0..MOST << (schedule.usual - USUAL) {
            let idle = done.or(self.failed);
            if idle.everywhere() {
                return;
            }
            let before = self.now.force;
            let event = self.step(schedule.level(stage, step), idle);
            let mut gone = Each::default();
            if back {
                let rises = self.faint.and(before.below(self.now.force)).and(idle.fails());
                self.late = self.late.or(rises);
                self.faint = self.faint.or(self
                    .now
                    .force
                    .below(self.tops[1] * self.collider.tuning.faint)
                    .and(idle.fails()));
                let leaves = self.rate(&self.now).below(Each::default());
                // The rest must also be small compared with the energy with which ball and bat part.
                let (stored, rate) = (self.stored(), self.rate(&self.now));
                let little = (self.lightness * stored).within(rate * rate * SLIGHT);
                gone = leaves.and(little).and(stored.within(cut)).and(idle.or(self.failed).fails());
            }
            let event = event.and(self.failed.fails());
            done = done.or(event).or(gone);
            if gone.somewhere() {
                self.release(gone);
            }
            for l in 0..W {
                if gone.0[l] != 0.0 {
                    self.stages[l] = self.leave(l, &touches[l]);
                } else if event.0[l] != 0.0 {
                    self.stages[l] = if back { Stage::Anew } else { Stage::Back };
                    self.met[l].reloads += usize::from(back);
                }
            }
        }
        self.failed = self.failed.or(done.fails());
    }

    /// One step at all places that are not idle. Returns the places where the compression reached its maximum, or on
    /// the way back reached it again.
    #[inline(always)]
    fn step(&mut self, level: usize, idle: Each<W>) -> Each<W> {
        let table = self.collider.table(level);
        if !self.couplings.iter().any(|(known, _)| *known == level) {
            self.couplings.push((level, self.coupling(table)));
        }
        let coupling = *self.coupled(level);
        let solved = self.solve(table, &coupling, idle);
        let error = self.error_of(&solved.force, table.length);
        let mut fine = solved
            .found
            .and(error.within(Each::all(self.collider.tuning.usual_error * self.accuracy)));
        self.advance(table, &solved);
        if self.differ > 0 {
            self.keep(level, &solved, idle.fails());
        }
        let [a, b, c, d] = solved.x;
        let course = self.through(&[self.now.compression, a, b, c, d]);
        let (event, smooth) = self.event(&solved);
        let event = event.and(idle.fails());
        fine = fine.and(smooth.or(event)).and(self.may_pass(&solved, table.length).fails());
        let (mut length, mut moves) = (Each::all(table.length), None);
        if event.somewhere() {
            let (time, all, there) = self.turn(table.length, &self.through(&solved.force), event);
            fine = fine.and(there.or(event.fails()));
            (length, moves) = (time, Some(all));
            self.look(&course, time / table.length, event);
        }
        self.remember(([Each::all(table.length), length / table.length], course), idle);
        fine = fine.and(self.correct(table, length, [event, idle], moves.as_deref()));
        // A comparison with NaN fails, so this rejects a compression that is NaN.
        fine = fine.and(self.next.compression.within(self.next.compression));
        let failed = idle.fails().and(fine.fails());
        (self.coarse, self.failed) = (self.coarse.or(failed), self.failed.or(failed));
        self.steps += idle.fails();
        self.hold(idle);
        if event.somewhere() {
            self.arrive(event);
        }
        if let (true, Some(moves)) = (self.differ > 0, moves) {
            self.keep_turn(event, length, moves);
        }
        std::mem::swap(&mut self.now, &mut self.next);
        event
    }

    /// At a turn, keeps its compression and force as the largest ones. At the return to the largest compression, sets both
    /// to the largest ones; a place where that return was missed fails.
    #[inline(always)]
    fn arrive(&mut self, event: Each<W>) {
        let next = &mut self.next;
        if self.top.is_none() {
            let [x, force] = self.tops;
            self.tops = [event.choose(next.compression, x), event.choose(next.force, force)];
            return;
        }
        let [x, force] = self.tops;
        let near = (next.compression - x).abs().within(x * (MISSED * self.accuracy));
        let missed = event.and(near.fails());
        (self.coarse, self.failed) = (self.coarse.or(missed), self.failed.or(missed));
        next.compression = event.choose(x, next.compression);
        next.force = event.choose(force, next.force);
    }

    /// Where, on the way back, the surface may leave the ball and return between two points of a step
    /// ([`crate::collision::contact::events`]), or where too much energy is left in the last of the force, a fractional
    /// power of the time.
    #[inline(always)]
    fn may_pass(&self, solved: &SolvedStep<W>, length: f64) -> Each<W> {
        let Some([top, _]) = self.top else { return Each::default() };
        let mut least = self.now.compression;
        for x in solved.x {
            least = least.min(x);
        }
        let tuning = &self.collider.tuning;
        let much = (self.energy * (tuning.last_energy * self.accuracy)).below(self.stored());
        let ends = least.within(Each::default());
        if !least.below(top * 0.1).somewhere() {
            return Each::default();
        }
        let mut bend = Each::default();
        for n in 0..self.weights.len() {
            let [before, after] = [&self.now, &self.next].map(|state| {
                let [re, im] = state.memories[n];
                re.abs() + im.abs()
            });
            bend += self.weights[n] * (self.omegas[n] * self.omegas[n]) * before.max(after);
        }
        let way = length * (self.collider.rule.at[2] - self.collider.rule.at[1]);
        ends.choose(much, least.below(bend * (0.125 * way * way)))
    }

    /// The places where the compression reaches its maximum in a step, or reaches it again by its end; and the places
    /// whose points show no other turn.
    #[inline(always)]
    fn event(&self, solved: &SolvedStep<W>) -> (Each<W>, Each<W>) {
        let mut smooth = Each::all(1.0);
        if let Some([_, most]) = self.top {
            for force in &solved.force[1..] {
                smooth = smooth.and(force.within(most));
            }
            return (most.below(solved.force[POINTS - 1]), smooth);
        }
        let mut before = self.now.compression;
        for x in solved.x {
            smooth = smooth.and(before.within(x));
            before = x;
        }
        (self.rate(&self.next).below(Each::default()), smooth)
    }

    /// Keeps a step's compression for the guess of the next one, except at idle places.
    #[inline(always)]
    fn remember(&mut self, (ends, powers): ([Each<W>; 2], [Each<W>; POINTS]), idle: Each<W>) {
        let (last_ends, last_powers) = &mut self.last;
        for k in 0..2 {
            last_ends[k] = idle.choose(last_ends[k], ends[k]);
        }
        for k in 0..POINTS {
            last_powers[k] = idle.choose(last_powers[k], powers[k]);
        }
        self.known = self.known.or(idle.fails());
    }

    /// Sets the next state to the present one at those places.
    #[inline(always)]
    pub(super) fn hold(&mut self, which: Each<W>) {
        if !which.somewhere() {
            return;
        }
        let (now, next) = (&self.now, &mut self.next);
        next.time = which.choose(now.time, next.time);
        next.closing = which.choose(now.closing, next.closing);
        next.speed = which.choose(now.speed, next.speed);
        next.impulse = which.choose(now.impulse, next.impulse);
        next.compression = which.choose(now.compression, next.compression);
        next.force = which.choose(now.force, next.force);
        for n in 0..self.weights.len() {
            for part in 0..2 {
                next.memories[n][part] =
                    which.choose(now.memories[n][part], next.memories[n][part]);
            }
        }
    }

    /// Energy stored in the ball and in the flexibility that follows at once (J).
    #[inline(always)]
    pub(super) fn stored(&self) -> Each<W> {
        let of_ball =
            self.now.force * self.now.compression.max(Each::default()) / (self.power() + 1.0);
        of_ball + self.rest * self.now.force * self.now.force * 0.5
    }

    /// Releases the remaining force at those places.
    #[inline(always)]
    fn release(&mut self, gone: Each<W>) {
        let (now, mut modes) = (&self.now, Each::default());
        for n in 0..self.weights.len() {
            let [re, im] = now.memories[n];
            modes += self.weights[n] * self.omegas[n] * (re * re + im * im);
        }
        let rigid = now.speed * now.speed / self.inverse_mass;
        let left = self.energy - self.spent - self.lost() - (rigid + modes) * 0.5;
        let rate = self.rate(now);
        let square = rate * rate + self.lightness * left * 2.0;
        self.failed = self.failed.or(gone.and(Each::default().below(square).fails()));
        let kick = left * 2.0 / (square.max(Each::default()).sqrt() - rate);
        let kick = gone.choose(kick, Each::default());
        self.corrected += gone.choose(left.abs() / self.energy, Each::default());
        let now = &mut self.now;
        now.impulse += kick;
        now.speed -= kick * self.inverse_mass;
        for memory in &mut now.memories {
            memory[0] += kick;
        }
    }

    /// Records the data of a step that the changes need.
    #[inline(always)]
    pub(super) fn keep(&mut self, level: usize, solved: &SolvedStep<W>, taken: Each<W>) {
        let (table, first) = (self.collider.table(level), self.weights.len() - self.differ);
        let mut points = vec![[Each::default(); AHEAD]; self.differ];
        for k in 0..self.differ {
            let (moves, l) = (&table.moves[(first + k) / LANES], (first + k) % LANES);
            let [a, b] = self.now.memories[first + k];
            for i in 0..AHEAD {
                let [p, q] = &moves.turns[i + 1];
                let mut im = b * p[l] + a * q[l];
                for j in 0..POINTS {
                    im += solved.force[j] * moves.kernels[i + 1][j][1][l];
                }
                points[k][i] = im;
            }
        }
        let (slope, force) = (solved.slope, solved.force);
        let top = self.top;
        let walked = Walked { level, top, taken, slope, force, points, turned: None };
        self.kept.push(Kept::Step(walked));
    }

    /// Records the data of a turn that the changes need.
    #[inline(always)]
    pub(super) fn keep_turn(&mut self, which: Each<W>, time: Each<W>, moves: Vec<Move<W>>) {
        let (next, first) = (&self.next, self.weights.len() - self.differ);
        // The slope of the branch towards larger compressions, at the turn.
        let slope = self.exponent * next.force / next.compression;
        let memories = next.memories[first..].iter().map(|[_, im]| *im).collect();
        if let Some(Kept::Step(walked)) = self.kept.last_mut() {
            walked.turned = Some(Turned { which, time, moves, slope, force: next.force, memories });
        }
    }

    /// The coupling of a level that was stepped at.
    #[inline(always)]
    pub(super) fn coupled(&self, level: usize) -> &Coupling<W> {
        let known = self.couplings.iter().position(|(known, _)| *known == level);
        &self.couplings[known.unwrap_or(0)].1
    }
}
