//! What a report says, in order, whatever it is written as.

use crate::base::error::Result;
use crate::collision::hit::Model;
use crate::show::analysis::Analysis;
use crate::show::page::accuracy;
use crate::show::page::inputs::{self, Input};
use crate::show::page::moment::{Moment, moments};
use crate::show::page::summary::{NO_HIT, Summary};
use crate::show::page::table::Table;
use crate::show::page::tables;
use crate::show::plot::picture::Picture;
use crate::show::plot::sets::of_analysis;

/// What a report is made from.
#[derive(Debug, Clone)]
pub struct Report<'a> {
    /// All results.
    pub analysis: &'a Analysis,
    /// The command as it was typed.
    pub command: String,
    /// The files as they were written.
    pub inputs: Vec<Input>,
    /// Every picture of the analysis.
    pub pictures: Vec<Picture>,
    /// Hits in time; none where the model knows no force in time.
    pub moments: Vec<Moment>,
    /// The numbers at the top.
    pub summary: Summary,
    /// Whether inches stand before centimetres there.
    pub us_first: bool,
}

/// A part of the report under a heading.
#[derive(Debug, Clone)]
pub struct Section<'a> {
    /// What links call it.
    pub id: &'static str,
    /// The heading as people read it.
    pub title: &'static str,
    /// What stands under it, from top to bottom.
    pub parts: Vec<Part<'a>>,
}

/// What stands in a section.
#[derive(Debug, Clone)]
pub enum Part<'a> {
    /// A heading of second order.
    Heading(&'static str),
    /// A paragraph.
    Text(String),
    /// What there is not, and why.
    Missing(&'static str),
    /// One line for each item.
    List(Vec<String>),
    /// Numbers or words in rows.
    Table(Table),
    /// A drawing with its caption.
    Picture(&'a Picture),
    /// A picture of something along the barrel, which a script can read off place by place.
    Hovered(&'a Picture),
    /// How the report was made.
    Command(&'a str),
    /// A file of the user's.
    File(&'a Input),
    /// Something long under a line that opens it.
    Folded(&'static str, Vec<Part<'a>>),
    /// What moves, where there is a script.
    Modes,
    /// The moment of the hit.
    Moment,
}

const STRANGE: &str = "This is unusual for a bat. If it is a slip, mend the bat file and make the \
                       report again.";
const NOTHING: &str = "Without a hit there is nothing to show here.";
const HELD: &str = "The bat is held: energies are as its hands see them, the bat at rest before the \
                    hit, and swinging in what holds it counts as vibration.";
const NO_FORCE: &str = "This model gives no force over time, so the moment of the hit cannot be \
                        shown; the model \"contact\" gives one.";
const NO_CONTACT: &str = "This model takes a half sine of given duration as the force and does not \
                          squeeze the ball, so the moment of the hit cannot be shown; the model \
                          \"contact\" gives one.";
const NO_MODES: &str = "No bending modes were asked for.";

impl<'a> Report<'a> {
    /// The report of an analysis, asked for by that command with those files.
    ///
    /// # Errors
    ///
    /// Those of a hit that cannot be computed, as of [`crate::collision::hitter::Hitter::new`].
    pub fn new(analysis: &'a Analysis, command: String, inputs: Vec<Input>) -> Result<Self> {
        let (pictures, moments) = (of_analysis(analysis)?, moments(analysis)?);
        let summary = Summary::new(analysis);
        Ok(Self { analysis, command, inputs, pictures, moments, summary, us_first: false })
    }

    /// Everything below the summary, in order.
    pub fn sections(&'a self) -> Vec<Section<'a>> {
        let section = |id, title, parts| Section { id, title, parts };
        let strange = self.analysis.bat.warnings();
        let strange = (!strange.is_empty()).then(|| {
            let parts = vec![Part::Text(STRANGE.to_owned()), Part::List(strange)];
            section("look", "Look at this first", parts)
        });
        let rest = [
            section("bat", "The bat", self.pictured(&["profile"])),
            section("sweet-spot", "The sweet spot", self.sweet_spot()),
            section("energy", "Where the energy goes", self.energy()),
            section("hit", "The moment of the hit", self.hit()),
            section("modes", "How the bat vibrates", self.modes()),
            section("figures", "Figures", self.figures()),
            section("accuracy", "How far to trust this", self.accuracy()),
            section("inputs", "What went in", self.inputs()),
            section("provenance", "Where it comes from", self.provenance()),
        ];
        strange.into_iter().chain(rest).collect()
    }

    /// The pictures of those names.
    fn pictured(&'a self, names: &[&str]) -> Vec<Part<'a>> {
        let named = |picture: &&Picture| names.contains(&picture.name.as_str());
        self.pictures.iter().filter(named).map(Part::Picture).collect()
    }

    fn hovered(&'a self, name: &str) -> impl Iterator<Item = Part<'a>> {
        self.pictures.iter().filter(move |p| p.name == name).map(Part::Hovered)
    }

    /// Whether a ball is hit anywhere.
    fn hits(&self) -> bool {
        self.analysis.figures.spot.exit_speed_max.is_some()
    }

    fn sweet_spot(&'a self) -> Vec<Part<'a>> {
        if !self.hits() {
            return vec![Part::Missing(NO_HIT)];
        }
        let mut parts: Vec<Part> =
            accuracy::why(self.analysis).map(Part::Text).into_iter().collect();
        parts.extend(accuracy::left_out_of_hit(self.analysis).into_iter().map(Part::Text));
        parts.extend(self.hovered("exit_speed"));
        parts.push(Part::Table(tables::sweet_spots(self.analysis)));
        parts.extend(self.pictured(&["hands"]));
        parts
    }

    fn energy(&'a self) -> Vec<Part<'a>> {
        if !self.hits() {
            return vec![Part::Missing(NOTHING)];
        }
        let mut parts = vec![];
        if self.analysis.bat.fixtures().holding() {
            parts.push(Part::Text(HELD.to_owned()));
        }
        if matches!(self.analysis.task.model, Model::Rigid) {
            parts.push(Part::Missing("A bat that does not bend takes no vibration."));
        }
        parts.extend(self.hovered("ledger"));
        parts.push(Part::Table(tables::ledger(self.analysis)));
        parts
    }

    fn hit(&'a self) -> Vec<Part<'a>> {
        if !self.hits() {
            return vec![Part::Missing(NOTHING)];
        }
        if self.moments.is_empty() {
            return vec![Part::Missing(match self.analysis.task.model {
                Model::Pulse(_) => NO_CONTACT,
                _ => NO_FORCE,
            })];
        }
        let mut parts = vec![Part::Moment];
        parts.extend(self.pictured(&["contact", "hysteresis"]));
        parts
    }

    fn modes(&'a self) -> Vec<Part<'a>> {
        if self.analysis.solution.modes.is_empty() {
            return vec![Part::Missing(NO_MODES)];
        }
        let freedom = self.analysis.bat.fixtures().freedom();
        let mut parts = vec![Part::Text(format!("Bending modes, {freedom}.")), Part::Modes];
        parts.extend(self.pictured(&["shapes"]));
        parts.push(Part::Table(tables::modes(self.analysis)));
        parts.push(Part::Table(tables::nodes(self.analysis)));
        parts
    }

    fn figures(&'a self) -> Vec<Part<'a>> {
        let figures = tables::figures(self.analysis);
        if figures.rows.is_empty() {
            return vec![Part::Missing(NOTHING)];
        }
        vec![Part::Table(figures), Part::Table(tables::moves(self.analysis))]
    }

    fn accuracy(&'a self) -> Vec<Part<'a>> {
        let mut parts = vec![
            Part::Heading("What is certified"),
            Part::List(accuracy::certified(self.analysis)),
            Part::Heading("What was left out, and what that costs"),
            Part::List(accuracy::left_out(self.analysis)),
        ];
        let needed = accuracy::needed(self.analysis);
        if !needed.is_empty() {
            parts.extend([Part::Heading("What this bat's model needs"), Part::List(needed)]);
        }
        parts
    }

    fn inputs(&'a self) -> Vec<Part<'a>> {
        let mut parts = vec![Part::Command(&self.command)];
        parts.push(Part::Table(inputs::scene(self.analysis)));
        let files = self.inputs.iter().map(Part::File).collect();
        parts.push(Part::Folded("The files as they were written, with their own units", files));
        let values = inputs::values(self.analysis);
        let profile = inputs::profile(self.analysis);
        let understood = vec![Part::Table(values), Part::Table(profile)];
        parts.push(Part::Folded("The bat as it was understood, in SI", understood));
        parts
    }

    fn provenance(&'a self) -> Vec<Part<'a>> {
        let formats = "Formats: sweetspot-bat/1, sweetspot-modes/1, sweetspot-hit/1.";
        let mut method = vec![format!("sweetspot {}. {formats}", env!("CARGO_PKG_VERSION"))];
        method.extend(accuracy::method(self.analysis));
        method.push("Everything here is computed, not certified by any standard.".to_owned());
        vec![
            Part::List(method),
            Part::Heading("Sources of the method"),
            Part::List(SOURCES.map(str::to_owned).to_vec()),
        ]
    }
}

/// Where the physics comes from.
const SOURCES: [&str; 4] = [
    "Ball and bat in contact: A. M. Nathan, \"Dynamics of the baseball-bat collision\", Am. J. Phys. \
     68, 979 (2000).",
    "The beam: S. Timoshenko, Philos. Mag. 41, 744 (1921); shear coefficients: G. R. Cowper, J. Appl. \
     Mech. 33, 335 (1966).",
    "No mode missing: F. R. Gantmacher, M. G. Krein, Oscillation Matrices (1950); an inertia count \
     where that does not apply.",
    "The starting point, and the empirical model \"energy-loss\": the WPI report, Vibrational \
     Analysis of a Bat-Ball Collision.",
];
