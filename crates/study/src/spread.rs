//! How far do the answers move with what calipers, scale and wood leave open?
//!
//! [`Spread::new`] takes a bat that is analysed and says of every answer how far it may be from that of
//! the bat in hand. To first order, with the inputs taken as independent,
//!
//! ```text
//! σ_Q² = Σ (∂Q/∂p σ_p)²
//! ```
//!
//! each derivative a central difference of two bats that differ in `p` alone. A bat that was weighed has
//! the mass the scale said, whatever its diameters; its densities follow, and the scale's reading stands
//! in the place of the wood's scatter. A tapped frequency does the same for the stiffness. With `s` the
//! factor that is settled by the reading `R`,
//!
//! ```text
//! ∂Q/∂p|_R = ∂Q/∂p − (∂Q/∂s / ∂R/∂s) ∂R/∂p        ∂Q/∂R = ∂Q/∂s / ∂R/∂s
//! ```
//!
//! # Source
//!
//! JCGM 100:2008 (GUM), 5.1.2: the law of propagation of uncertainty for independent inputs.

use std::f64::consts::TAU;

use serde::Serialize;

use crate::bat_changes::{Change, PATCH_FACTOR, Property, changed};
pub use crate::inputs::{Input, Readings};
use sweetspot::base::error::Result;
use sweetspot::base::threads;
use sweetspot::bat::body::{Bat, STANDARD_PIVOT};
use sweetspot::bat::material::Material;
use sweetspot::collision::figures::SwingLaw;
use sweetspot::collision::hit::{Model, Scene};
use sweetspot::collision::hitter::Hitter;
use sweetspot::collision::hoop_wall::{HoopInHit, HoopWall, barrel_walls};
use sweetspot::collision::sweep::Sweep;
use sweetspot::collision::sweet_spot::{FEW, HitsAlong, SweetSpot};
use sweetspot::collision::wall_choice::hoop_request;
use sweetspot::modes::solve::{Request, Solution, solve};

/// Something that is not known exactly.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Source {
    /// What it is: E (and G with it) or density of a material from piece to piece, readings of diameters,
    /// bores, length and mass, the note of a tap, the patch on which the ball presses on a hollow barrel's wall.
    pub input: Input,
    /// The material as the bat file calls it, where the bat has several; empty otherwise.
    pub material: String,
    /// Standard deviation; relative of stiffness, density, tap and patch (of the ball's compression, as a
    /// logarithm), in m of lengths, in kg of the mass.
    #[serde(rename = "standard_deviation")]
    pub deviation: f64,
}

/// An answer that moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum SpreadAnswer {
    /// Mass (kg).
    #[serde(rename = "mass_kg")]
    Mass,
    /// Balance point from the knob end (m).
    #[serde(rename = "balance_point_m")]
    BalancePoint,
    /// Moment of inertia about the point 6 in from the knob end (kg m²).
    #[serde(rename = "inertia_pivot_kg_m2")]
    SwingWeight,
    /// Frequency of the first bending mode (Hz).
    #[serde(rename = "frequency_1_hz")]
    Frequency1,
    /// Frequency of the second bending mode (Hz).
    #[serde(rename = "frequency_2_hz")]
    Frequency2,
    /// Frequency of the third bending mode (Hz).
    #[serde(rename = "frequency_3_hz")]
    Frequency3,
    /// Where the ball leaves fastest, from the knob end (m).
    #[serde(rename = "best_place_m")]
    BestPlace,
    /// Exit speed there (m/s).
    #[serde(rename = "exit_speed_m_s")]
    ExitSpeed,
    /// Where the zone within 1 % of it begins, from the knob end (m).
    #[serde(rename = "zone_from_m")]
    ZoneFrom,
    /// Where the zone ends, from the knob end (m).
    #[serde(rename = "zone_to_m")]
    ZoneTo,
}

impl SpreadAnswer {
    /// All answers, in the order in which they are counted.
    pub const ALL: [Self; 10] = [
        Self::Mass,
        Self::BalancePoint,
        Self::SwingWeight,
        Self::Frequency1,
        Self::Frequency2,
        Self::Frequency3,
        Self::BestPlace,
        Self::ExitSpeed,
        Self::ZoneFrom,
        Self::ZoneTo,
    ];
}

/// An answer and how far that of the bat in hand may be from it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Estimate {
    /// Which answer, its unit at the end.
    pub answer: SpreadAnswer,
    /// As it is computed.
    pub value: f64,
    /// Standard deviation of all sources together, in the unit of the value; null where a bat that differs
    /// in one of them has no such answer.
    #[serde(rename = "standard_deviation")]
    pub deviation: Option<f64>,
    /// What one standard deviation of each source alone makes of it, in the order of the sources; empty
    /// where the standard deviation is null.
    // With its sign.
    #[serde(rename = "by_source")]
    pub parts: Vec<f64>,
}

impl Estimate {
    /// One standard deviation to both sides: two bats in three lie within.
    pub fn range(&self) -> Option<[f64; 2]> {
        self.deviation.map(|deviation| [self.value - deviation, self.value + deviation])
    }
}

/// What is not known exactly of a bat, and how far each answer may be off by it: to first order, the
/// sources taken as independent.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Spread {
    /// What is open.
    pub sources: Vec<Source>,
    /// How far each answer may be off.
    #[serde(rename = "answers")]
    pub estimates: Vec<Estimate>,
    /// What could not be counted, a phrase each.
    pub left_out: Vec<String>,
}

/// A bat that was analysed, and what was found of it.
#[derive(Debug, Clone, Copy)]
pub struct Analysed<'a> {
    /// The bat, as heavy and as stiff as it was weighed and tapped.
    pub bat: &'a Bat,
    /// Its modes.
    pub solution: &'a Solution,
    /// How ball and bat meet.
    pub model: Model,
    /// Swing, ball and pitch.
    pub scene: &'a Scene,
    /// How the swing goes with the bat's swing weight, if it does.
    pub law: Option<SwingLaw>,
    /// Its hits: their number of modes and their steps are taken for those of the other bats.
    pub hits: &'a Sweep,
    /// Where it is best.
    pub spot: &'a SweetSpot,
}

/// Relative accuracy of the modes of the bats that differ: a small part of what 0.1 mm do to a frequency,
/// some thousandths.
const TOLERANCE: f64 = 1e-6;
/// Accuracy of exit speeds for which the walls of these bats are solved.
const WALL_TOLERANCE: f64 = 1e-3;
const ANSWERS: usize = SpreadAnswer::ALL.len();

/// The answers of one bat, or what a source makes of them, in the order of [`SpreadAnswer::ALL`]; None where
/// there is none, as of a place that no ball is hit at.
type Answers = [Option<f64>; ANSWERS];

/// A reading of the whole bat that settles a property of all its materials.
struct Settled {
    property: Property,
    source: Source,
    /// What was read; None of a bat that was edited since, whose answer is another one.
    answer: Option<SpreadAnswer>,
    /// Standard deviation of the reading, in the unit of the answer; without one, of the property that
    /// it settled, relative.
    size: f64,
}

/// A source, and what one standard deviation of it makes of every answer.
type Row = (Source, Answers);

impl Spread {
    /// What is open of the answers of a bat that was measured so.
    pub fn new(analysed: &Analysed, readings: &Readings) -> Self {
        let mut left_out = vec![];
        let settled = settled(analysed, readings, &mut left_out);
        let mut open = open(analysed.bat, readings, &settled, &mut left_out);
        if analysed.scene.hoop.wall().is_some() && analysed.spot.exit_speed_max.is_some() {
            let deviation = PATCH_FACTOR.ln();
            let source = Source { input: Input::Patch, material: String::new(), deviation };
            open.push((Change::Patch, source));
        }
        let changes = open.iter().map(|(change, _)| change.clone());
        let factors = settled.iter().map(|settled| Change::All(settled.property));
        let changes: Vec<Change> = changes.chain(factors).collect();
        let mut slopes = analysed.slopes(&changes).into_iter();
        let mut rows: Vec<Row> = vec![];
        let mut failed = |source: &Source| {
            let what = source.input.name();
            left_out.push(format!("{what}, as a bat that differs in it cannot be computed"));
        };
        for ((_, source), slopes) in open.into_iter().zip(&mut slopes) {
            match slopes {
                Some(slopes) => {
                    let parts = slopes.map(|slope| Some(slope? * source.deviation));
                    rows.push((source, parts));
                }
                None => failed(&source),
            }
        }
        for (settled, factor) in settled.into_iter().zip(slopes) {
            let by = factor.and_then(|factor| match settled.answer {
                Some(answer) => settle(&mut rows, &factor, answer),
                None => Some(factor),
            });
            match by {
                Some(by) => {
                    let parts = by.map(|slope| Some(slope? * settled.size));
                    rows.push((settled.source, parts));
                }
                None => failed(&settled.source),
            }
        }
        let estimates = estimates(&analysed.answers(), &rows);
        let sources = rows.into_iter().map(|(source, _)| source).collect();
        Self { sources, estimates, left_out }
    }

    /// The answers alone, of a bat that would take long to be computed anew.
    pub fn uncounted(analysed: &Analysed) -> Self {
        let left_out = vec!["all of it, as so many pieces would take long".to_owned()];
        Self { sources: vec![], estimates: estimates(&analysed.answers(), &[]), left_out }
    }

    /// What is open of an answer, if there is that answer.
    pub fn of(&self, answer: SpreadAnswer) -> Option<&Estimate> {
        self.estimates.iter().find(|estimate| estimate.answer == answer)
    }

    /// The source that moves an answer most, and its share of the variance; None where nothing does.
    pub fn mostly(&self, answer: SpreadAnswer) -> Option<(&Source, f64)> {
        let estimate = self.of(answer)?;
        let squares = estimate.parts.iter().map(|part| part * part);
        let (most, square) = squares.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let share = square / estimate.deviation?.powi(2);
        share.is_finite().then(|| (&self.sources[most], share))
    }
}

/// The readings of the whole bat: a scale sets its densities, a tap its stiffness. They were of the bat
/// before its edits; of an edited one they settle the properties alone, a frequency going as the root of
/// the stiffness.
fn settled(analysed: &Analysed, readings: &Readings, left_out: &mut Vec<String>) -> Vec<Settled> {
    let before = analysed.bat.unedited();
    let edited = !analysed.bat.edits().is_empty();
    let weighed = before.weighed();
    let whole = |input, deviation| Source { input, material: String::new(), deviation };
    let scale = weighed.mass.map(|mass| Settled {
        property: Property::Density,
        source: whole(Input::Mass, readings.mass),
        answer: (!edited).then_some(SpreadAnswer::Mass),
        size: if edited { readings.mass / mass } else { readings.mass },
    });
    let tap = weighed.first_bending.and_then(|note| {
        let answer = if edited { None } else { analysed.tapped(note) };
        if answer.is_none() && !edited {
            left_out.push("the tap, whose note is of none of the first three modes".to_owned());
            return None;
        }
        Some(Settled {
            property: Property::Stiffness,
            source: whole(Input::Tap, readings.tap),
            answer,
            size: if edited { 2.0 * readings.tap } else { readings.tap * note },
        })
    });
    scale.into_iter().chain(tap).collect()
}

/// What else is open, each with how another bat differs in it. A property of the only material that a
/// reading settles is not.
fn open(
    bat: &Bat,
    readings: &Readings,
    settled: &[Settled],
    left_out: &mut Vec<String>,
) -> Vec<(Change, Source)> {
    let mut open = vec![];
    let materials = materials(bat);
    let only = materials.len() == 1;
    for (place, material) in materials {
        let properties = [Property::Stiffness, Property::Density];
        let unsettled = |property: &Property| {
            let of = settled.iter().find(|settled| settled.property == *property);
            of.is_none_or(|settled| !only && settled.answer.is_some())
        };
        let unsettled: Vec<Property> = properties.into_iter().filter(unsettled).collect();
        let Some(scatter) = material.differs() else {
            if !unsettled.is_empty() {
                left_out.push(format!("the scatter of {place}, of which none is known here"));
            }
            continue;
        };
        for property in unsettled {
            let (input, deviation) = match property {
                Property::Stiffness => (Input::Stiffness, scatter.youngs_modulus),
                Property::Density => (Input::Density, scatter.density),
            };
            let of = if only { String::new() } else { place.clone() };
            let source = Source { input, material: of, deviation };
            open.push((Change::Of(Box::new(material.clone()), property), source));
        }
    }
    let hollow = !barrel_walls(bat).is_empty()
        || bat.profile().stations.inner.iter().any(|inner| *inner > 0.0);
    let bores = hollow.then_some((Change::Bores, Input::Bores, readings.diameter));
    let outside = Some((Change::Diameters, Input::Diameters, readings.diameter));
    let length = match bat.profile().formulas {
        None => Some((Change::Length, Input::Length, readings.length)),
        Some(_) => {
            left_out.push("the length, which is a formula's".to_owned());
            None
        }
    };
    for (change, input, deviation) in outside.into_iter().chain(length).chain(bores) {
        open.push((change, Source { input, material: String::new(), deviation }));
    }
    open
}

/// Every material of a bat once, with its place in a bat file.
fn materials(bat: &Bat) -> Vec<(String, Material)> {
    let mut all = vec![("material".to_owned(), bat.material().clone())];
    for (place, material) in bat.regional() {
        if all.iter().all(|(_, known)| known != material) {
            all.push((place, material.clone()));
        }
    }
    all
}

/// Holds a reading while a property of the whole bat gives way: takes from every row what moves the
/// answer that was read, and returns what a change of that reading by 1 does. None if the property does
/// not move it.
fn settle(rows: &mut [Row], factor: &Answers, answer: SpreadAnswer) -> Option<Answers> {
    let of_reading = factor[answer as usize].filter(|slope| *slope != 0.0)?;
    let by = factor.map(|slope| Some(slope? / of_reading));
    for (_, parts) in rows {
        let Some(moved) = parts[answer as usize] else { continue };
        *parts = std::array::from_fn(|k| Some(parts[k]? - by[k]? * moved));
        // Not but for round-off.
        parts[answer as usize] = Some(0.0);
    }
    Some(by)
}

/// The answers with what all sources together make of them.
fn estimates(values: &Answers, rows: &[Row]) -> Vec<Estimate> {
    let of = |(answer, value): (SpreadAnswer, &Option<f64>)| {
        let parts: Option<Vec<f64>> =
            rows.iter().map(|(_, parts)| parts[answer as usize]).collect();
        let size = |parts: &Vec<f64>| parts.iter().map(|part| part * part).sum::<f64>().sqrt();
        let parts = parts.filter(|parts| size(parts).is_finite());
        let deviation = parts.as_ref().map(size);
        Some(Estimate { answer, value: (*value)?, deviation, parts: parts.unwrap_or_default() })
    };
    SpreadAnswer::ALL.into_iter().zip(values).filter_map(of).collect()
}

impl Analysed<'_> {
    /// The answers of this bat.
    fn answers(&self) -> Answers {
        let peak = self.spot.exit_speed_max.map(|peak| [peak.x, peak.value]);
        answers(self.bat, self.solution, peak.zip(self.spot.zone))
    }

    /// Which frequency is the tapped note (Hz), up to what a rough accuracy leaves of it.
    fn tapped(&self, note: f64) -> Option<SpreadAnswer> {
        let same = |answer: &&SpreadAnswer| {
            let found = self.answers()[**answer as usize];
            found.is_some_and(|found| (found / note - 1.0).abs() < 0.01)
        };
        [SpreadAnswer::Frequency1, SpreadAnswer::Frequency2, SpreadAnswer::Frequency3]
            .iter()
            .find(same)
            .copied()
    }

    /// What a change by 1 makes of every answer, by central differences; None where a bat that differs
    /// so cannot be computed.
    fn slopes(&self, changes: &[Change]) -> Vec<Option<Answers>> {
        let step = |change: &Change| change.step(self.bat);
        let sides = threads::map(2 * changes.len(), |k| {
            let change = &changes[k / 2];
            let by = if k % 2 == 0 { -step(change) } else { step(change) };
            let mut scene = self.scene.clone();
            if *change == Change::Patch {
                // δ goes as the square of the patch's radius.
                let ball = &mut scene.ball;
                let compression = by.exp() * ball.patch_compression();
                ball.contact_radius_m = Some((ball.radius_m * compression).sqrt());
            }
            self.beside(&changed(self.bat, change, by)?, scene)
        });
        let slope = |(change, sides): (&Change, &[Result<Answers>])| {
            let [Ok(less), Ok(more)] = sides else { return None };
            let over = 2.0 * step(change);
            Some(std::array::from_fn(|k| Some((more[k]? - less[k]?) / over)))
        };
        changes.iter().zip(sides.chunks(2)).map(slope).collect()
    }

    /// The answers of another bat in that scene, by as many modes and such steps. Its wall is solved anew, roughly:
    /// of the two sides of a difference alike.
    fn beside(&self, bat: &Bat, scene: Scene) -> Result<Answers> {
        let modes = self.hits.solution.modes.len();
        let request = Request {
            modes: modes.max(self.solution.modes.len().min(3)),
            tolerance: TOLERANCE,
            theory: self.solution.theory,
            ..Request::default()
        };
        let mut solution = solve(bat, &request)?;
        let notes = answers(bat, &solution, None);
        if self.spot.exit_speed_max.is_none() {
            return Ok(notes);
        }
        solution.modes.truncate(modes);
        let swing = self.law.map_or(self.scene.swing, |law| law.swing(bat));
        let hoop = match &scene.hoop {
            HoopInHit::Counted(_) => {
                let request = hoop_request(WALL_TOLERANCE);
                HoopInHit::Counted(HoopWall::of(bat, scene.ball.radius_m, &request)?)
            }
            other => other.clone(),
        };
        let scene = Scene { swing, hoop, ..scene };
        let hitter = Hitter::new(self.model, &scene, bat, &solution, self.hits.effort)?;
        let looked = HitsAlong::outer(FEW, &hitter);
        let peak = looked.fastest();
        let hit = peak.map(|peak| ([peak.x, peak.value], looked.zone(peak)));
        let hit = answers(bat, &solution, hit);
        Ok(std::array::from_fn(|k| notes[k].or(hit[k])))
    }
}

/// The answers of a bat, its modes, and where and how fast (m, m/s) the fastest ball leaves, with the
/// zone around it (m).
fn answers(bat: &Bat, solution: &Solution, hit: Option<([f64; 2], [f64; 2])>) -> Answers {
    let inertia = bat.inertia();
    let frequency = |k: usize| solution.modes.get(k).map(|mode| mode.omega / TAU);
    let ([best, speed], [from, to]) = hit.unwrap_or(([f64::NAN; 2], [f64::NAN; 2]));
    let of = |answer: SpreadAnswer| match answer {
        SpreadAnswer::Mass => Some(inertia.mass),
        SpreadAnswer::BalancePoint => Some(inertia.balance_point),
        SpreadAnswer::SwingWeight => Some(inertia.about(STANDARD_PIVOT)),
        SpreadAnswer::Frequency1 => frequency(0),
        SpreadAnswer::Frequency2 => frequency(1),
        SpreadAnswer::Frequency3 => frequency(2),
        SpreadAnswer::BestPlace => hit.map(|_| best),
        SpreadAnswer::ExitSpeed => hit.map(|_| speed),
        SpreadAnswer::ZoneFrom => hit.map(|_| from),
        SpreadAnswer::ZoneTo => hit.map(|_| to),
    };
    SpreadAnswer::ALL.map(of)
}

/// Relative standard deviation of every frequency of a bat of one wood by the wood alone, without a
/// computation: `½ √(v_E² + v_ρ²)`, as a frequency goes as `√(E/ρ)`; the density is not open where the bat
/// was weighed. None where the stiffness was tapped, or where no scatter is known.
pub fn of_frequencies(bat: &Bat) -> Option<f64> {
    let [(_, material)] = &materials(bat)[..] else { return None };
    let weighed = bat.unedited().weighed();
    let scatter = material.scatter().filter(|_| weighed.first_bending.is_none())?;
    let density = if weighed.mass.is_some() { 0.0 } else { scatter.density };
    Some(0.5 * scatter.youngs_modulus.hypot(density))
}
