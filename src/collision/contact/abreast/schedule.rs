//! How long the steps of places side by side are.

use crate::collision::contact::pressing::USUAL;

/// What comes next at a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stage {
    /// A touch begins.
    Touch,
    /// The ball is pressed beyond its largest compression.
    Anew,
    /// The ball springs back.
    Back,
    /// The ball springs back, and the force that was let go returns.
    Late,
    /// The ball is gone for good.
    Over,
}

/// The lengths of the steps, as levels: they follow from the accuracy of the steps and the exponent of the law, as
/// steps one by one have them on the way to the largest compression.
pub(super) struct Schedule {
    first: usize,
    /// The level of a usual step.
    pub usual: usize,
    /// Steps a level at the beginning.
    each: usize,
    /// How much finer the steps back begin.
    back: usize,
}

impl Schedule {
    /// Of steps of that accuracy for a law whose force begins as that power, `finer` levels below the usual ones.
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
