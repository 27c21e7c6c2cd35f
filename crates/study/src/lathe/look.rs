//! How is a bat on the lathe hit, and what are the values along it?

use crate::comparison::contender::Figure;
use crate::engine::{Bat, Effort, Hitter, Model, Result, Scene, Solution};
use crate::lathe::gauges::{BestPlaces, Gauge, Rivals};
use crate::lathe::quotient::Ways;

/// How the bat is hit, once modes and steps are planned.
pub(super) struct PlannedHit {
    /// Swing, ball and pitch.
    pub scene: Scene,
    /// How a hit is computed.
    pub model: Model,
    /// Modes and steps.
    pub effort: Effort,
}

/// The results of a pass along the bat.
#[derive(Default)]
pub(super) struct LathePass {
    /// The answers.
    pub values: Vec<Option<Figure>>,
    /// The gauges of answers about a hit.
    pub gauges: Vec<Option<Gauge>>,
    /// Their derivatives by the swing.
    pub by_swing: Vec<Option<f64>>,
    /// The best places of the bat.
    pub best: BestPlaces,
    /// Answers without a derivative.
    pub rivals: Vec<Rivals>,
}

/// The ways in which a difference is taken.
#[derive(Clone, Copy)]
pub(super) enum By<'a> {
    /// By the gauges.
    Gauges,
    /// Also by those of the other ways.
    EveryWay(&'a Ways),
    /// By the finer wall alone.
    FinerWall(&'a (PlannedHit, Vec<Option<Gauge>>)),
}

impl PlannedHit {
    /// Bat and ball in that scene.
    pub fn hitter<'a>(
        &self,
        bat: &'a Bat,
        solution: &'a Solution,
        scene: &'a Scene,
    ) -> Result<Hitter<'a>> {
        Hitter::new(self.model, scene, bat, solution, self.effort)
    }
}
