//! Bats hit at the same places, with all compared figures.

use crate::comparison::contender::{Contender, Terms, multiples, places};
use crate::comparison::pieces::{answer, by_wood, one_piece};
use crate::comparison::rows::{Compared, ComparedFigure, From, figures, speeds};
use crate::comparison::stretches::{Stretch, stretches};
use crate::engine::{Bat, Error, Model, Request, Result, Scene, SwingLaw};

/// A bat with its own swing and its own request: the theories may differ.
#[derive(Debug, Clone)]
pub struct Entry {
    /// The bat.
    pub bat: Bat,
    /// The scene with this bat's swing.
    pub scene: Scene,
    /// The swing law, if one batter swings all bats.
    pub law: Option<SwingLaw>,
    /// The request for its modes; the tolerance is that of the exit speeds.
    pub request: Request,
}

/// All figures of several bats; the first is the one the others are compared with.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// The terms of all hits.
    pub terms: Terms,
    /// The bats, the first the one the others are compared with.
    pub bats: Vec<Contender>,
    /// Everything but the exit speeds by place.
    pub figures: Vec<ComparedFigure>,
    /// Distances from the tip (m), at quarters of the given step.
    pub from_tip: Vec<f64>,
    /// The exit speeds there.
    pub by_tip: Vec<ComparedFigure>,
    /// Distances from the knob end (m) where all bats have a place, at the given step.
    pub from_knob: Vec<f64>,
    /// The exit speeds there.
    pub by_knob: Vec<ComparedFigure>,
}

/// Share of the shortest bat that is compared, from the tip.
const COMPARED: f64 = 0.4;

impl Comparison {
    /// Hits all bats.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for places too close or too far apart, and those of
    /// [`Contender::new`].
    pub fn new(entries: Vec<Entry>, terms: Terms) -> Result<Self> {
        let lengths = || entries.iter().map(|entry| entry.bat.length());
        let shortest = lengths().fold(f64::INFINITY, f64::min);
        let longest = lengths().fold(0.0, f64::max);
        let reach = COMPARED * shortest;
        if !(terms.every >= reach / 250.0 && terms.every <= reach) {
            let found = format!("{:?} m", terms.every);
            let expected = format!("{:.2e} to {:.2e} m on these bats", reach / 250.0, reach);
            return Err(Error::value("every", found, expected));
        }
        let mut bats = vec![];
        for Entry { bat, scene, law, request } in entries {
            let places = places(&bat, terms.every, reach);
            bats.push(Contender::new(bat, (scene, law), &request, &terms, &places)?);
        }
        let from_tip = multiples([0.0, reach], 0.25 * terms.every);
        let from_knob = multiples([longest - reach, shortest], terms.every);
        let mut figures = figures(&bats);
        between_pieces(&mut figures, &bats, terms.model);
        Ok(Self {
            terms,
            figures,
            by_tip: speeds(&bats, From::Tip, &from_tip),
            by_knob: speeds(&bats, From::Knob, &from_knob),
            from_tip,
            from_knob,
            bats,
        })
    }

    /// Whether all bats are equally long.
    pub fn same_length(&self) -> bool {
        !self.figures[0].values.iter().flatten().any(|length| {
            let first = self.bats[0].bat.length();
            (length.value - first).abs() > 1e-9 * first
        })
    }

    /// A figure of a bat; `None` if the bat has none.
    pub fn figure(&self, key: &str, bat: usize) -> Option<Compared> {
        self.figures.iter().find(|row| row.key == key)?.values[bat]
    }

    /// Whether that bat is the first one with edits, or the first is: one and the same piece of wood.
    pub fn one_piece(&self, bat: usize) -> bool {
        one_piece(&self.bats[0].bat, &self.bats[bat].bat)
    }

    /// The stretches where that bat hits harder than the first.
    pub fn stretches(&self, bat: usize) -> Vec<Stretch> {
        stretches(&self.from_tip, &self.by_tip, bat)
    }
}

/// Adds to every figure its difference between another piece of that bat's wood and another of the first's: one
/// standard deviation, if the scatter is known and the bats are not one piece.
fn between_pieces(figures: &mut [ComparedFigure], bats: &[Contender], model: Model) {
    let by_wood: Vec<_> = bats.iter().map(|bat| by_wood(bat, model)).collect();
    let others = (1..bats.len()).filter(|bat| !one_piece(&bats[0].bat, &bats[*bat].bat));
    for bat in others {
        for row in &mut *figures {
            let answer = answer(row.key.trim_end_matches("_from_tip"));
            let open = |bat: usize| by_wood[bat][answer?];
            let by = open(0).zip(open(bat)).map(|(a, b)| a.hypot(b)).filter(|by| *by > 0.0);
            row.values[bat].iter_mut().for_each(|figure| figure.between_pieces = by);
        }
    }
}
