//! The ball is compressed and springs back, step after step from the first touch until the force has gone. Each step is
//! as long as the accuracy allows.

use std::sync::OnceLock;

use faer::c64;

use crate::collision::contact::collocation::POINTS;
use crate::collision::contact::encounter::{Encounter, MOST_STEPS};
use crate::collision::contact::energy::Limits;
use crate::collision::contact::events::{CLOSED, Event, Stop};
use crate::collision::contact::force_law::{ForceLaw, Top};
use crate::collision::contact::step::{CompressionPath, Coupling, Step};
use crate::collision::contact::table::{ForcePiece, StepTable};
use crate::collision::contact::tangent::{Tangent, Walked};
use crate::collision::contact::touch::{DrivingPoint, State, Touch};

/// Halvings of the longest step.
pub(super) const LEVELS: usize = 42;
/// Allowed error of a return to the largest compression, as a share of it.
const MISSED: f64 = 1e-8;
/// Share of the energy that the force may still contain when it is dropped.
const NOTHING: f64 = 1e-14;
/// Halvings of the longest step while there is a force; and the most halvings to check whether the surface passes the
/// ball between two points.
pub(super) const USUAL: usize = 2;
const WATCHFUL: usize = 6;

/// The present state of an encounter.
pub(super) struct Run {
    pub now: State,
    pub next: State,
    /// The largest compression of this touch, once the ball is on its way back.
    pub top: Option<Top>,
    /// The last step's compression.
    pub last: Option<CompressionPath>,
    /// Level of the next step, whose length is `longest/2^level`.
    pub level: usize,
    /// Whether the force has almost gone.
    pub faint: bool,
    pub steps: usize,
    /// Effect of the force on the compression, for the levels used so far.
    pub couplings: Vec<(usize, Coupling)>,
    /// Changes by varied bats and by the closing speed.
    pub tangents: Vec<Tangent>,
    /// Any state within a step.
    pub between: State,
}

impl Run {
    /// A run from that state, without changes by varied bats.
    pub fn new(now: State) -> Self {
        let still = State::at_first(now.memories.len(), 0.0);
        Self {
            now,
            next: still.clone(),
            top: None,
            last: None,
            level: 0,
            faint: false,
            steps: 0,
            couplings: Vec::with_capacity(8),
            tangents: vec![],
            between: still,
        }
    }
}

/// The outcome of a step.
enum Taken {
    /// The step failed and is repeated, shorter.
    Finer,
    /// The step is done and another one follows.
    On,
    /// The step was the last: the ball has left, or its force has gone.
    Parted,
}

/// Tables of steps, made when first needed, and the record of the force if it is wanted.
pub(super) struct StepTables<'a> {
    pub all: &'a [c64],
    pub tables: &'a [OnceLock<StepTable>],
    pub longest: f64,
    pub history: Option<&'a mut Vec<ForcePiece>>,
    /// Varied bats.
    pub others: &'a [DrivingPoint],
}

impl StepTables<'_> {
    pub(super) fn record(&mut self, piece: ForcePiece) {
        self.history.iter_mut().for_each(|history| history.push(piece));
    }
}

/// A part of the force that is done: the relative energy error before its correction, the force, and the compression.
struct DoneStep {
    off: f64,
    piece: ForcePiece,
    course: CompressionPath,
}

impl<L: ForceLaw> Touch<'_, L> {
    /// The level of a touch's first step, in which the force begins as a power of the time.
    #[inline(always)]
    pub(super) fn first_level(&self, now: &State, longest: f64) -> usize {
        let first = (3.0 * self.accuracy).powf(1.0 / (1.0 + self.law.exponent(None))) * self.way;
        let level = (longest * self.rate(now) / first).log2().ceil().max(0.0) as usize;
        level.clamp(USUAL, LEVELS - 1)
    }

    /// Takes steps until the ball has left or its force has gone. Returns whether they come to an end.
    #[inline(always)]
    pub(super) fn press(&self, run: &mut Run, means: &mut StepTables, met: &mut Encounter) -> bool {
        while run.steps < MOST_STEPS && met.corrected <= 1.0 {
            run.steps += 1;
            met.steps = run.steps;
            match self.step(run, means, met) {
                Taken::Finer if run.level + 1 == LEVELS => return false,
                Taken::Finer => run.level += 1,
                Taken::On => {}
                Taken::Parted => return true,
            }
        }
        false
    }

    #[inline(always)]
    fn step(&self, run: &mut Run, means: &mut StepTables, met: &mut Encounter) -> Taken {
        let Run { now, next, top, last, level, .. } = run;
        let length = means.longest * 0.5_f64.powi(*level as i32);
        let (all, tables) = (means.all, means.tables);
        let table = tables[*level].get_or_init(|| StepTable::new(self.rule, all, length));
        let known = run.couplings.iter().position(|(known, _)| known == level);
        let known = known.unwrap_or_else(|| {
            run.couplings.push((*level, self.coupling(table)));
            run.couplings.len() - 1
        });
        let coupling = run.couplings[known].1;
        let (step, converged) = self.solve(table, &coupling, now, *top, last.as_ref());
        let (error, tuning) = (self.error_of(&step), &self.tuning);
        let allowed = if *level < USUAL { tuning.long_error } else { tuning.usual_error };
        // An error that is not a number is too large.
        let small = error <= allowed * self.accuracy;
        if !(converged && small) {
            return Taken::Finer;
        }
        self.advance(table, now, &step, next);
        if self.damped {
            next.lost += self.loss(now, &step, length);
        }
        let event = self.event(&step, next, *top);
        if self.is_coarse(event, run, &step) {
            return Taken::Finer;
        }
        let most = step.force.iter().fold(0.0, |most: f64, f| most.max(*f));
        let limits = Limits { top: run.top, most, slight: tuning.slight * self.accuracy };
        let taken = match event {
            None => self.complete(limits, step, table, run),
            Some(event) => self.stop_short(event, limits, step, run),
        };
        let Some(DoneStep { off, piece, course }) = taken else { return Taken::Finer };
        if !run.tangents.is_empty() {
            let Run { now, next, top, tangents, between, .. } = &mut *run;
            let (top, coupling, step) = (*top, &coupling, &step);
            let walked = Walked { now, next, top, table, coupling, step, event };
            self.follow(tangents, between, walked);
        }
        met.corrected += off;
        means.record(piece);
        run.last = Some(course);
        match event {
            None => self.go_on(error, run, met),
            Some(event) => self.turn(event, limits.top, run, met),
        }
    }

    /// A step to its end; `None` if a shorter one is needed.
    #[inline(always)]
    fn complete(
        &self,
        limits: Limits,
        step: Step,
        table: &StepTable,
        run: &mut Run,
    ) -> Option<DoneStep> {
        let Run { now, next, .. } = run;
        let off = self.correct(next, table.length, &table.bump, limits)?;
        let piece = step.until(now, next);
        (!limits.pulls(&piece)).then(|| DoneStep { off, piece, course: self.course(&step) })
    }

    /// A step to an event in it; `None` if a shorter one is needed.
    #[inline(always)]
    fn stop_short(
        &self,
        event: Event,
        limits: Limits,
        mut step: Step,
        run: &mut Run,
    ) -> Option<DoneStep> {
        let Run { now, next, .. } = run;
        let top = limits.top;
        let off = self.stop(Stop { event, limits }, now, &mut step, next)?;
        let piece = step.until(now, next);
        let missed = match (event, top) {
            // The last of the force does too little work to correct much.
            (Event::Gone, _) => self.open(next, top) > CLOSED || limits.pulls(&piece),
            (Event::Again, Some(top)) => {
                (next.compression - top.compression).abs() > MISSED * top.compression
            }
            _ => false,
        };
        let from = piece.length / step.length;
        (!missed).then(|| DoneStep {
            off,
            piece,
            course: CompressionPath { from, ..self.course(&step) },
        })
    }

    /// From a step's end to the next step, which may be longer.
    #[inline(always)]
    fn go_on(&self, error: f64, run: &mut Run, met: &mut Encounter) -> Taken {
        let Run { now, next, top, level, .. } = run;
        let low = top.is_some_and(|top| next.force < self.tuning.faint * top.force);
        let grown = error * 2.0_f64.powi(POINTS as i32);
        let least = if low { 0 } else { USUAL };
        if grown <= 4.0 * self.accuracy && *level > least {
            *level -= 1;
        }
        *level = (*level).max(least);
        met.late |= run.faint && next.force > now.force;
        run.faint |= low;
        std::mem::swap(now, next);
        if self.is_over(now, *top) { Taken::Parted } else { Taken::On }
    }

    /// From an event to the branch of the law that follows it.
    #[inline(always)]
    fn turn(&self, event: Event, known: Option<Top>, run: &mut Run, met: &mut Encounter) -> Taken {
        let Run { now, next, top, level, .. } = run;
        std::mem::swap(now, next);
        match event {
            Event::Turned => {
                let compression = now.compression;
                let [force, _] = self.law.force(compression, None);
                *top = Some(Top { compression, force });
                now.force = force;
                met.peak_force = met.peak_force.max(force);
            }
            Event::Again => {
                if let Some(known) = known {
                    (now.compression, now.force) = (known.compression, known.force);
                }
                *top = None;
                *level = (*level).max(USUAL);
                met.reloads += 1;
            }
            Event::Gone => {
                now.compression = 0.0;
                return Taken::Parted;
            }
        }
        Taken::On
    }

    /// Whether a step that ends so is too long to be trusted.
    #[inline(always)]
    fn is_coarse(&self, event: Option<Event>, run: &Run, step: &Step) -> bool {
        let Run { now, next, top, level, .. } = run;
        match event {
            // The last of the force is a fractional power of the time, and its end may be overlooked.
            Some(Event::Gone) => {
                self.law.energy(now.compression, *top)[0]
                    > self.tuning.last_energy * self.accuracy * self.energy
            }
            Some(_) => top.is_some_and(|t| step.force[POINTS - 1] < self.tuning.faint * t.force),
            None if *level >= WATCHFUL => false,
            None if top.is_some() => self.may_pass(now, step, next),
            // The compression reached a maximum and a minimum between two points.
            None => step.compression.windows(2).any(|pair| pair[1] < pair[0]),
        }
    }

    /// Whether the ball springs back with a force of no further effect.
    #[inline(always)]
    fn is_over(&self, now: &State, top: Option<Top>) -> bool {
        if top.is_none() || self.rate(now) >= 0.0 {
            return false;
        }
        let bent = 0.5 * self.felt.rest * now.force * now.force;
        self.law.energy_of(now.compression, now.force, top)[0] + bent <= NOTHING * self.energy
    }
}
