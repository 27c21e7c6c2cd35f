//! The content of a report, in order, independent of its format.

use crate::analysis::Analysis;
use crate::page::data::Data;
use crate::page::figure::Figure;
use crate::page::html::Page;
use crate::page::moment::{Moment, moments};
use crate::page::summary::{NO_HIT, Summary};
use crate::page::{accuracy, inputs, players};
use crate::parts::{Fold, Input, Part, Section, Units, sentence};
use crate::plot::sets::of_analysis;
use crate::report::{damped, edits, hit_text, hoop, hoop_notes, lathe, tables};
use sweetspot::Result;
use sweetspot::base::number::rounded;
use sweetspot::collision::aftermath::Aftermath;
use sweetspot::collision::hoop_wall::heard;
use sweetspot::collision::{Hitter, Model};
use sweetspot::motion::sound::{Sound, WallTones, as_heard};
use sweetspot_study::ignored::damping_in_sound;
use sweetspot_study::lathe::map::LatheMap;

/// The data of a report.
#[derive(Clone)]
pub struct Report<'a> {
    /// All results.
    pub analysis: &'a Analysis,
    /// The command as typed.
    pub command: String,
    /// The input files as written.
    pub inputs: Vec<Input>,
    /// Every picture of the analysis.
    pub figures: Vec<Figure>,
    /// Hits in time; empty where the model has no force in time.
    pub moments: Vec<Moment>,
    /// The sounds of a tap on the tip and of the hit at the sweet spot; no hit where there is no force.
    pub sounds: (Sound, Option<Sound>),
    /// The effects of cuts, where they are known.
    pub map: Option<&'a LatheMap>,
    /// The numbers at the top.
    pub summary: Summary,
    /// Whether US units are shown first: as in the file of the bat, unless others are requested.
    pub us: bool,
    /// The address of the live page beside the report.
    pub lab: Option<String>,
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
const NO_CUTS: &str = "What a cut does to this bat is not known.";
/// The link name of the section that only hollow bats have.
const HOOP: &str = "hoop";
const NO_MODES: &str = "No bending modes were asked for.";

impl<'a> Report<'a> {
    /// The report of an analysis, made by that command with those files, with the effects of cuts if they are known.
    ///
    /// # Errors
    ///
    /// Those of a hit that cannot be computed, as of [`sweetspot::collision::hitter::Hitter::new`].
    pub fn new(
        analysis: &'a Analysis,
        command: String,
        inputs: Vec<Input>,
        map: Option<&'a LatheMap>,
    ) -> Result<Self> {
        let figures = Figure::all(|sheet| of_analysis(sheet, analysis, map))?;
        let (moments, sounds) = (moments(analysis)?, sounds(analysis)?);
        let (summary, us, lab) = (Summary::new(analysis), analysis.bat.inches(), None);
        Ok(Self { analysis, command, inputs, figures, moments, sounds, map, summary, us, lab })
    }

    /// The report as one page.
    pub fn page(&'a self) -> String {
        let Self { analysis, summary, moments, sounds, .. } = self;
        let data = Data::new(analysis, summary, moments, sounds);
        let data = serde_json::to_string(&data).expect("numbers and words are JSON");
        let bat = &self.analysis.bat;
        let page = Page {
            kind: "Bat report",
            name: [bat.name(), ": what it does to a ball"],
            source: bat.source(),
            us: self.us,
            sections: [Units::Si, Units::Us].map(|units| self.sections(units)),
            figures: &self.figures,
            data: Some(data),
            lab: self.lab.as_deref(),
        };
        page.text()
    }

    /// Everything, in order, in one system of units.
    pub fn sections(&'a self, units: Units) -> Vec<Section<'a>> {
        let section = |fold, id, title, parts| Section { fold, id, title, parts };
        let strange = self.analysis.bat.warnings();
        let strange = (!strange.is_empty()).then(|| {
            let parts = vec![Part::Text(STRANGE.to_owned()), Part::List(strange)];
            section(Fold::Open, "look", "Look at this first", parts)
        });
        use Fold::{Folded, Open, ScreenOnly};
        let rest = [
            section(Open, "summary", "The sweet spot", self.answers(units)),
            section(Open, "speed", "How fast the ball leaves", self.speed()),
            section(Open, "hit", "The hit, slowed down", self.hit()),
            section(Folded, "bat", "The bat", self.bat(units)),
            section(ScreenOnly, "cuts", "Where a cut does what", self.cuts(units)),
            section(Folded, "spots", "The sweet spot by other measures", self.spots(units)),
            section(Folded, "energy", "Where the energy goes", self.energy(units)),
            section(Folded, "modes", "How the bat vibrates", self.modes(units)),
            section(ScreenOnly, HOOP, "How the barrel rings", self.hoop(units)),
            section(Folded, "figures", "Figures", self.standard(units)),
            section(Folded, "accuracy", "How far to trust this", self.accuracy(units)),
            section(ScreenOnly, "contact", "The ball on the bat, and the hands", self.contact()),
            section(ScreenOnly, "more", "More numbers", self.more(units)),
            section(ScreenOnly, "inputs", "What went in", self.inputs(units)),
            section(ScreenOnly, "provenance", "Where it comes from", self.provenance()),
        ];
        let solid = self.analysis.barrel.is_none();
        let rest = rest.into_iter().filter(|section| section.id != HOOP || !solid);
        strange.into_iter().chain(rest).collect()
    }

    /// Whether a ball is hit anywhere.
    fn hits(&self) -> bool {
        self.analysis.figures.spot.exit_speed_max.is_some()
    }

    /// Where the sweet spot is, how fast the ball leaves, how wide the zone is, and why.
    fn answers(&'a self, units: Units) -> Vec<Part<'a>> {
        if !self.hits() {
            return vec![Part::Missing(NO_HIT)];
        }
        let headline = Part::Facts("headline", self.summary.headline(units, self.analysis));
        let why = hit_text::reason(&self.analysis.figures, units).map(Part::Text);
        [Part::Picture("sweet_spot"), headline].into_iter().chain(why).collect()
    }

    fn speed(&'a self) -> Vec<Part<'a>> {
        if self.hits() { vec![Part::Hovered("exit_speed")] } else { vec![Part::Missing(NOTHING)] }
    }

    fn bat(&'a self, units: Units) -> Vec<Part<'a>> {
        let facts = Part::Facts("facts", self.summary.facts(units, self.analysis));
        let edits = edits::listed(&self.analysis.bat, units);
        let edited = (!edits.is_empty())
            .then(|| Part::Text(format!("Edited after it was weighed: {edits}.")));
        edited.into_iter().chain([facts, Part::Picture("profile")]).collect()
    }

    fn cuts(&'a self, units: Units) -> Vec<Part<'a>> {
        let lines = self.map.map_or(vec![], |map| cuts(map, units));
        if lines.is_empty() {
            return vec![Part::Missing(NO_CUTS)];
        }
        let more = "Inch by inch, with cups, holes and cork: the verb lathe.";
        vec![Part::List(lines), Part::Picture("lathe"), Part::Text(more.to_owned())]
    }

    fn spots(&'a self, units: Units) -> Vec<Part<'a>> {
        let Analysis { bat, figures, .. } = self.analysis;
        match self.hits() {
            true => tables::sweet_spot(bat, &figures.spot, units),
            false => vec![Part::Missing(NOTHING)],
        }
    }

    fn energy(&'a self, units: Units) -> Vec<Part<'a>> {
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
        parts.push(Part::Hovered("ledger"));
        parts.push(Part::Table(tables::ledger(&self.analysis.figures, units)));
        parts
    }

    fn hit(&'a self) -> Vec<Part<'a>> {
        if !self.hits() {
            return vec![Part::Missing(NOTHING)];
        }
        let film = match (self.moments.is_empty(), self.analysis.task.model) {
            (false, _) => Part::Moving(players::moment(&self.moments)),
            (true, Model::Pulse(_)) => Part::Missing(NO_CONTACT),
            (true, _) => Part::Missing(NO_FORCE),
        };
        let (tap, hit) = &self.sounds;
        vec![
            film,
            Part::Moving(players::sounds(tap, hit.as_ref(), damping_in_sound(&self.analysis.bat))),
        ]
    }

    fn more(&'a self, units: Units) -> Vec<Part<'a>> {
        /// Modes whose nodes are listed.
        const LISTED: usize = 6;
        let Analysis { bat, figures, solution, .. } = self.analysis;
        vec![
            Part::Table(tables::moves(bat, figures, units)),
            Part::Heading("Nodes, where a mode is at rest"),
            Part::List(tables::nodes(bat, solution, LISTED, units)),
        ]
    }

    fn contact(&'a self) -> Vec<Part<'a>> {
        match self.moments.is_empty() {
            true => vec![Part::Missing(NOTHING)],
            false => ["contact", "hysteresis", "hands"].map(Part::Picture).to_vec(),
        }
    }

    fn modes(&'a self, units: Units) -> Vec<Part<'a>> {
        let Analysis { bat, solution, .. } = self.analysis;
        if solution.modes.is_empty() {
            return vec![Part::Missing(NO_MODES)];
        }
        let modes = [
            Part::Moving(players::modes(self.analysis)),
            Part::Picture("shapes"),
            Part::Table(tables::modes(bat, solution, units)),
        ];
        modes.into_iter().chain(damped::parts(solution)).collect()
    }

    /// The hoop modes of a hollow barrel, and the effect of its wall on the ball.
    fn hoop(&'a self, units: Units) -> Vec<Part<'a>> {
        const MODES: usize = 10;
        let Some(barrel) = &self.analysis.barrel else { return vec![] };
        let bat = &self.analysis.bat;
        let mut parts = vec![
            Part::Moving(players::hoop(barrel)),
            Part::Picture("hoop"),
            Part::Table(tables::hoop_modes(bat, barrel.hoop(), MODES, units)),
            Part::List(hoop::answers(barrel, units)),
        ];
        let notes: Vec<String> =
            hoop_notes::notes(bat, barrel, units).iter().map(|note| sentence(note)).collect();
        if !notes.is_empty() {
            parts.extend([Part::Heading("What was assumed of the wall"), Part::List(notes)]);
        }
        parts
            .push(Part::Text("More modes, other balls and other walls: the verb hoop.".to_owned()));
        parts
    }

    fn standard(&'a self, units: Units) -> Vec<Part<'a>> {
        // The wall has a part of the page to itself.
        let mut solid = self.analysis.figures.clone();
        solid.wall = None;
        let figures = tables::figures(&solid, units);
        match figures.rows.is_empty() {
            true => vec![Part::Missing(NOTHING)],
            false => vec![Part::Table(figures)],
        }
    }

    fn accuracy(&'a self, units: Units) -> Vec<Part<'a>> {
        let mut parts = vec![
            Part::Heading("The uncertainty due to wood, scale and calipers"),
            Part::List(accuracy::open(self.analysis, units)),
            Part::Heading("The error of the computation"),
            Part::List(accuracy::certified(self.analysis, units)),
            Part::Heading("What was left out, and its effect"),
            Part::List(accuracy::left_out(self.analysis)),
        ];
        let needed = accuracy::needed(self.analysis);
        if !needed.is_empty() {
            parts.extend([Part::Heading("What this bat's model needs"), Part::List(needed)]);
        }
        parts
    }

    fn inputs(&'a self, units: Units) -> Vec<Part<'a>> {
        let mut parts = vec![Part::Command(&self.command)];
        parts.push(Part::Table(inputs::scene(self.analysis, units)));
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

/// The places where a cut has the largest effects, each line with its unit of the cut.
fn cuts(map: &LatheMap, units: Units) -> Vec<String> {
    let per = lathe::per(map, units);
    lathe::strongest(map, units).iter().map(|line| format!("{line}, per {per} off")).collect()
}

/// A tap on the tip, and the hit at the sweet spot where its force is known.
fn sounds(analysis: &Analysis) -> Result<(Sound, Option<Sound>)> {
    let Analysis { bat, solution, task, hits, figures, .. } = analysis;
    let (heard_bat, tapped) = as_heard(bat, solution)?;
    let wall = heard(&heard_bat, &task.scene.ball);
    let wall = wall.as_ref().map(|wall| wall as WallTones);
    let short = |mut sound: Sound| {
        for tone in &mut sound.tones {
            tone.decay_1_s = rounded(tone.decay_1_s, 3);
            tone.amplitude_m_s2 = rounded(tone.amplitude_m_s2, 1);
        }
        sound
    };
    let tap = short(Sound::of_tap(&tapped, wall));
    let Some(best) = figures.spot.exit_speed_max else { return Ok((tap, None)) };
    let hitter = Hitter::new(task.model, &task.scene, bat, &hits.solution, hits.effort)?;
    let (_, struck) = as_heard(bat, &hits.solution)?;
    let hit = hitter.force(best.x).map(|force| {
        short(Aftermath::new(bat, &hits.solution, best.x, force).sound(&struck, wall))
    });
    Ok((tap, hit))
}

/// The sources of the physics.
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
