//! The lengths of the steps of places that are computed side by side.

use crate::collision::contact::pressing::USUAL;

/// The next stage at a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stage {
    /// A touch begins.
    Touch,
    /// The ball is compressed beyond its largest compression so far.
    Anew,
    /// The ball springs back.
    Back,
    /// The ball springs back, and the force that was released returns.
    Late,
    /// The ball is gone for good.
    Over,
}

/// The lengths of the steps, as levels. They follow from the accuracy of the steps and the exponent of the law, like
/// those of steps one by one on the way to the largest compression.
pub(super) struct Schedule {
    first: usize,
    /// The level of a usual step.
    pub usual: usize,
    /// Number of steps at each level at the beginning.
    each: usize,
    /// Number of levels by which the first steps back are finer.
    back: usize,
}

impl Schedule {
    /// A schedule for steps of that accuracy and a law whose force begins as that power, `finer` levels below the usual
    /// ones.
    pub fn new(accuracy: f64, exponent: f64, finer: usize) -> Self {
        let first = (1.12 / (3.0 * accuracy).powf(1.0 / (1.0 + exponent))).log2().ceil();
        let usual = ((1e-3 / accuracy).log2() / 5.5).max(0.0) as usize + USUAL + finer;
        let first = (first.max(0.0) as usize + finer).max(usual);
        let fine = accuracy < 5e-4;
        Self { first, usual, each: if accuracy < 2e-7 { 2 } else { 1 }, back: usize::from(fine) }
    }

    /// The level of a step of a stage.
    pub fn level(&self, stage: Stage, step: usize) -> usize {
        match stage {
            Stage::Touch => self.there(step),
            Stage::Back => self.back(step),
            _ => self.usual,
        }
    }

    /// The level of a step on the way to the largest compression.
    fn there(&self, step: usize) -> usize {
        self.first.saturating_sub(step / self.each).max(self.usual)
    }

    /// The level of a step on the way back: the force falls fast at first.
    fn back(&self, step: usize) -> usize {
        let whole = 1 << self.usual;
        let fine = if self.back > 0 { whole } else { 0 };
        match step {
            _ if step < fine => self.usual + self.back,
            _ if step < fine + whole || self.back == 0 => self.usual,
            _ => self.usual - 1,
        }
    }
}
