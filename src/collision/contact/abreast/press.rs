//! Step after step: the balls are pressed at all places, spring back, and the force is let go.
//!
//! The force is let go once what the ball stores is a small share of the energy: that energy goes into the motions as
//! one impulse J, which the energy fixes,
//!
//! ```text
//! ½ a J² − r J = D,    a = 1/μ + Σ c_n, r the rate of x, D the energy that is left in the ball
//! ```

use crate::collision::contact::abreast::each::Each;
use crate::collision::contact::abreast::places::{Abreast, Coupling, Motion, Move, Turned, Walked};
use crate::collision::contact::abreast::schedule::Schedule;
use crate::collision::contact::abreast::solve::Solved;
use crate::collision::contact::collocation::{LANES, POINTS};
use crate::collision::contact::pressing::USUAL;
use crate::collision::contact::step::AHEAD;

/// What became of a place.
#[derive(Debug, Clone, Default)]
pub(super) struct Released {
    /// Largest compression (m) and force (N).
    pub compression: f64,
    pub force: f64,
    /// Energy that the steps were off by, relative.
    pub corrected: f64,
    pub steps: usize,
    /// How many steps are kept for the bats beside it.
    pub last: usize,
}

/// Usual steps of a touch at the accuracy 1e-3, each way, at most.
const MOST: usize = 24;

impl<const W: usize> Abreast<'_, W> {
    /// Steps until the force has gone at every place; what became of each, None where it failed.
    #[inline(always)]
    pub(super) fn press(&mut self, finer: usize, out: &mut [Option<(Released, Motion<W>)>]) {
        let schedule = Schedule::new(self.accuracy, self.exponent.0[0], finer);
        let most = MOST << (schedule.usual - USUAL);
        let (mut turned, mut top) = (Each::default(), [Each::default(); 2]);
        for step in 0..most {
            self.step(schedule.there(step), &mut turned, Some(&mut top));
            if turned.or(self.failed).everywhere() {
                break;
            }
        }
        self.failed = self.failed.or(turned.not());
        self.top = Some([self.failed.choose(self.deepest, top[0]), top[1]]);
        let cut = (1e-6 * self.accuracy).clamp(1e-14, 1e-9);
        let (mut done, mut faint) = (Each::default(), Each::default());
        for step in 0..2 * most {
            if done.or(self.failed).everywhere() {
                break;
            }
            let before = self.now.force;
            self.step(schedule.back(step), &mut done, None);
            let rises = faint.and(before.below(self.now.force)).and(done.not());
            self.failed = self.failed.or(rises);
            faint = faint.or(self.now.force.below(top[1] * 0.02));
            let leaves = self.rate(&self.now).below(Each::default());
            let over = leaves.and(self.stored().within(self.energy * cut));
            let over = over.and(done.or(self.failed).not());
            if over.somewhere() {
                self.release(over, out);
                done = done.or(over);
            }
        }
    }

    /// One step of all places that are not done; on the way to the `top`, those that turn in it are done.
    #[inline(always)]
    fn step(&mut self, level: usize, done: &mut Each<W>, top: Option<&mut [Each<W>; 2]>) {
        let table = self.collider.table(level);
        if !self.couplings.iter().any(|(known, _)| *known == level) {
            self.couplings.push((level, self.coupling(table)));
        }
        let (coupling, idle) = (*self.coupled(level), done.or(self.failed));
        let solved = self.solve(table, &coupling, idle);
        let error = self.error_of(&solved.force, table.length);
        let mut fine = solved.found.and(error.within(Each::all(3.0 * self.accuracy)));
        self.advance(table, &solved);
        if self.differ > 0 {
            self.keep(level, &solved, idle.not());
        }
        let [a, b, c, d] = solved.x;
        let course = self.through(&[self.now.compression, a, b, c, d]);
        let (mut length, mut turned, mut good) =
            (Each::all(table.length), Each::default(), Each::all(1.0));
        let mut moves = None;
        match self.top {
            Some([_, most]) => {
                for force in &solved.force[1..] {
                    good = good.and(force.within(most));
                }
            }
            None => {
                turned = self.rate(&self.next).below(Each::default()).and(idle.not());
                fine = fine.and(self.rises(&solved.x).or(turned));
                if turned.somewhere() {
                    let (time, all) = self.turn(table.length, &self.through(&solved.force), turned);
                    (length, moves) = (time, Some(all));
                    self.look(&course, time / table.length, turned);
                }
            }
        }
        self.remember(([Each::all(table.length), length / table.length], course), idle);
        fine = fine.and(self.correct(table, length, [turned, idle], moves.as_deref()));
        self.coarse = self.coarse.or(idle.not().and(good).and(fine.not()));
        self.failed = self.failed.or(idle.not().and(good.and(fine).not()));
        self.steps += idle.not();
        if let Some(top) = top {
            self.hold(idle);
            if let (true, Some(moves)) = (self.differ > 0, moves) {
                self.keep_turn(turned, length, moves);
            }
            let next = &self.next;
            *top = [turned.choose(next.compression, top[0]), turned.choose(next.force, top[1])];
            *done = done.or(turned);
        }
        std::mem::swap(&mut self.now, &mut self.next);
    }

    /// Where the compression grows from point to point.
    #[inline(always)]
    fn rises(&self, x: &[Each<W>; AHEAD]) -> Each<W> {
        let (mut before, mut rises) = (self.now.compression, Each::all(1.0));
        for x in x {
            rises = rises.and(before.within(*x));
            before = *x;
        }
        rises
    }

    /// Keeps a step's compression for the guess of the next one's, but at idle places.
    #[inline(always)]
    fn remember(&mut self, mut last: ([Each<W>; 2], [Each<W>; POINTS]), idle: Each<W>) {
        if let Some((ends, powers)) = self.last {
            for k in 0..2 {
                last.0[k] = idle.choose(ends[k], last.0[k]);
            }
            for k in 0..POINTS {
                last.1[k] = idle.choose(powers[k], last.1[k]);
            }
        }
        self.last = Some(last);
    }

    /// Leaves the next state as it is now at those places.
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

    /// What the ball and the flexibility that follows at once store (J).
    #[inline(always)]
    pub(super) fn stored(&self) -> Each<W> {
        let of_ball =
            self.now.force * self.now.compression.max(Each::default()) / (self.power() + 1.0);
        of_ball + self.rest * self.now.force * self.now.force * 0.5
    }

    /// Lets the force go at those places.
    #[inline(always)]
    pub(super) fn release(&self, over: Each<W>, out: &mut [Option<(Released, Motion<W>)>]) {
        let (now, mut all, mut modes) = (&self.now, self.inverse_mass, Each::default());
        for n in 0..self.weights.len() {
            let [re, im] = now.memories[n];
            let gain = self.weights[n] * self.omegas[n];
            all += gain;
            modes += gain * (re * re + im * im);
        }
        let rigid = now.speed * now.speed / self.inverse_mass;
        let left = self.energy - self.lost() - (rigid + modes) * 0.5;
        let rate = self.rate(now);
        let root = (rate * rate + all * left * 2.0).max(Each::default()).sqrt();
        let kick = left * 2.0 / (root - rate);
        let mut motion = now.clone();
        motion.impulse += kick;
        motion.speed -= kick * self.inverse_mass;
        for memory in &mut motion.memories {
            memory[0] += kick;
        }
        let [compression, force] = self.top.unwrap_or_default();
        for (l, out) in out.iter_mut().enumerate() {
            if over.0[l] != 0.0 {
                let released = Released {
                    compression: compression.0[l],
                    force: force.0[l],
                    corrected: self.corrected.0[l],
                    steps: self.steps.0[l] as usize,
                    last: self.walked.len(),
                };
                *out = Some((released, motion.clone()));
            }
        }
    }

    /// Keeps of a step what bats beside need.
    #[inline(always)]
    pub(super) fn keep(&mut self, level: usize, solved: &Solved<W>, taken: Each<W>) {
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
        let back = self.top.is_some();
        self.walked.push(Walked { level, back, taken, slope, force, points, turned: None });
    }

    /// Keeps of a turn what bats beside need.
    #[inline(always)]
    pub(super) fn keep_turn(&mut self, which: Each<W>, time: Each<W>, moves: Vec<Move<W>>) {
        let (next, first) = (&self.next, self.weights.len() - self.differ);
        let slope = self.slope(next.compression, next.force);
        let memories = next.memories[first..].iter().map(|[_, im]| *im).collect();
        if let Some(walked) = self.walked.last_mut() {
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
