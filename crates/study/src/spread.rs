//! How far do the answers change with the uncertainties of calipers, scale and wood?
//!
//! [`Spread::new`] takes an analysed bat and gives for every answer its uncertainty for the bat in hand. To first
//! order, with independent inputs,
//!
//! ```text
//! σ_Q² = Σ (∂Q/∂p σ_p)²
//! ```
//!
//! where each derivative is a central difference of two bats that differ only in `p`. A weighed bat has the weighed
//! mass whatever its diameters; its densities follow, and the error of the scale replaces the wood's scatter. A tapped
//! frequency does the same for the stiffness. With `s` the factor that the reading `R` sets,
//!
//! ```text
//! ∂Q/∂p|_R = ∂Q/∂p − (∂Q/∂s / ∂R/∂s) ∂R/∂p        ∂Q/∂R = ∂Q/∂s / ∂R/∂s
//! ```
//!
//! # Source
//!
//! JCGM 100:2008 (GUM), 5.1.2: the law of propagation of uncertainty for independent inputs.

use serde::{Serialize, Serializer};

use crate::answers::{Answer, figure, quotient};
use crate::bat_changes::{PATCH_FACTOR, Parameter, changed};
use crate::engine::{
    Bat, FEW, HitsAlong, Hitter, Material, Model, Request, Result, Scene, Solution, Sweep,
    SweetSpot, SwingLaw, barrel_walls, solve, threads,
};
pub use crate::inputs::{Input, Readings};

/// A property that is not known exactly.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
#[non_exhaustive]
pub struct Source {
    /// Its kind: E (and G with it) or density of a material from piece to piece; readings of diameters, bores, length
    /// and mass; the note of a tap; the patch on which the ball presses on a hollow barrel's wall.
    pub input: Input,
    /// The material as the bat file calls it, where the bat has several; empty otherwise.
    pub material: String,
    /// Standard deviation; relative of stiffness, density, tap and patch (of the ball's compression, as a
    /// logarithm), in m of lengths, in kg of the mass.
    #[serde(rename = "standard_deviation")]
    pub deviation: f64,
}

/// The answers with an uncertainty, in order.
pub const COUNTED: [Answer; 10] = [
    Answer::Mass,
    Answer::BalancePoint,
    Answer::Inertia,
    Answer::Frequency(1),
    Answer::Frequency(2),
    Answer::Frequency(3),
    Answer::ExitSpeedPlace,
    Answer::ExitSpeed,
    Answer::Zone(false),
    Answer::Zone(true),
];

/// An answer and its uncertainty for the bat in hand.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
#[non_exhaustive]
pub struct Estimate {
    /// Which answer, its unit at the end.
    #[serde(serialize_with = "key")]
    #[schemars(with = "String", extend("enum" = KEYS.map(|[key, _]| key)))]
    pub answer: Answer,
    /// As it is computed.
    pub value: f64,
    /// Standard deviation of all sources together, in the unit of the value; null if a bat that differs in one of them
    /// has no such answer.
    #[serde(rename = "standard_deviation")]
    pub deviation: Option<f64>,
    /// The effect of one standard deviation of each source alone, in the order of the sources; empty if the standard
    /// deviation is null.
    // With its sign.
    #[serde(rename = "by_source")]
    pub parts: Vec<f64>,
}

/// The names of the answers of [`COUNTED`] in JSON, the unit at the end, and in a comparison.
pub(crate) const KEYS: [[&str; 2]; COUNTED.len()] = [
    ["mass_kg", "mass"],
    ["balance_point_m", "balance_point"],
    ["inertia_pivot_kg_m2", "swing_weight"],
    ["frequency_1_hz", "frequency_1"],
    ["frequency_2_hz", "frequency_2"],
    ["frequency_3_hz", "frequency_3"],
    ["best_place_m", "best_place"],
    ["exit_speed_m_s", "best_exit_speed"],
    ["zone_from_m", "zone_from"],
    ["zone_to_m", "zone_to"],
];

/// The name of an answer in JSON.
fn key<S: Serializer>(answer: &Answer, out: S) -> std::result::Result<S::Ok, S::Error> {
    out.serialize_str(place(*answer).map_or("", |k| KEYS[k][0]))
}

impl Estimate {
    /// One standard deviation to both sides: two bats in three lie within.
    pub fn range(&self) -> Option<[f64; 2]> {
        self.deviation.map(|deviation| [self.value - deviation, self.value + deviation])
    }
}

/// The uncertain properties of a bat, and the resulting uncertainty of each answer: to first order, with independent
/// sources.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
#[non_exhaustive]
pub struct Spread {
    /// The sources of uncertainty.
    pub sources: Vec<Source>,
    /// The uncertainty of each answer.
    #[serde(rename = "answers")]
    pub estimates: Vec<Estimate>,
    /// Sources that could not be included, a phrase each.
    pub left_out: Vec<String>,
}

/// An analysed bat and its results.
#[derive(Debug, Clone, Copy)]
pub struct Analysed<'a> {
    /// The bat, with density and moduli from weighing and tapping.
    pub bat: &'a Bat,
    /// Its modes.
    pub solution: &'a Solution,
    /// How ball and bat meet.
    pub model: Model,
    /// Swing, ball and pitch.
    pub scene: &'a Scene,
    /// The dependence of the swing on the bat's swing weight, if there is one.
    pub law: Option<SwingLaw>,
    /// Its hits; the other bats use their number of modes and their steps.
    pub hits: &'a Sweep,
    /// The sweet spot.
    pub spot: &'a SweetSpot,
}

/// Relative accuracy of the modes of the varied bats: a small part of the effect of 0.1 mm on a frequency, which is
/// some thousandths.
const TOLERANCE: f64 = 1e-6;

/// The answers of one bat, or the effect of a source on them, in the order of [`COUNTED`]; `None` if there is none, as
/// for a place that is not hit.
type AnswerValues = Vec<Option<f64>>;

/// A reading of the whole bat that settles a property of all its materials.
struct Settled {
    source: Source,
    /// The index of the reading in [`COUNTED`]; `None` for a bat that was edited since, whose answer is a different
    /// one.
    answer: Option<usize>,
    /// Standard deviation of the reading, in the unit of the answer; without one, of the property that
    /// it settled, relative.
    size: f64,
}

/// A source, and the effect of one standard deviation of it on every answer.
type SourceEffect = (Source, AnswerValues);

impl Spread {
    /// The uncertainty of the answers of a bat with these readings.
    pub fn new(analysed: &Analysed, readings: &Readings) -> Self {
        let mut left_out = vec![];
        let settled = settled(analysed, readings, &mut left_out);
        let mut open = open(analysed.bat, readings, &settled, &mut left_out);
        if analysed.scene.hoop.wall().is_some() && analysed.spot.exit_speed_max.is_some() {
            let deviation = PATCH_FACTOR.ln();
            let source = Source { input: Input::Patch, material: String::new(), deviation };
            open.push((Parameter::whole(Input::Patch), source));
        }
        let parameters = open.iter().map(|(parameter, _)| parameter.clone());
        let factors = settled.iter().map(|settled| Parameter::whole(settled.source.input));
        let parameters: Vec<Parameter> = parameters.chain(factors).collect();
        let mut slopes = analysed.slopes(&parameters).into_iter();
        let mut rows: Vec<SourceEffect> = vec![];
        let mut failed = |source: &Source| {
            let what = source.input.name();
            left_out.push(format!("{what}, as a bat that differs in it cannot be computed"));
        };
        for ((_, source), slopes) in open.into_iter().zip(&mut slopes) {
            match slopes {
                Some(slopes) => {
                    let parts = times(slopes, source.deviation);
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
                Some(by) => rows.push((settled.source, times(by, settled.size))),
                None => failed(&settled.source),
            }
        }
        let estimates = estimates(&analysed.answers(), &rows);
        let sources = rows.into_iter().map(|(source, _)| source).collect();
        Self { sources, estimates, left_out }
    }

    /// The answers without uncertainties, for a bat that would take long to recompute.
    pub fn uncounted(analysed: &Analysed) -> Self {
        let left_out = vec!["all of it, because so many pieces take long".to_owned()];
        Self { sources: vec![], estimates: estimates(&analysed.answers(), &[]), left_out }
    }

    /// The uncertainty of an answer, if there is that answer.
    pub fn of(&self, answer: Answer) -> Option<&Estimate> {
        self.estimates.iter().find(|estimate| estimate.answer == answer)
    }

    /// The source with the largest effect on an answer, and its share of the variance; `None` if there is no effect.
    pub fn mostly(&self, answer: Answer) -> Option<(&Source, f64)> {
        let estimate = self.of(answer)?;
        let squares = estimate.parts.iter().map(|part| part * part);
        let (most, square) = squares.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let share = square / estimate.deviation?.powi(2);
        share.is_finite().then(|| (&self.sources[most], share))
    }
}

/// The effect of a change of that size on the answers, from the effect of a unit change.
fn times(slopes: AnswerValues, size: f64) -> AnswerValues {
    slopes.into_iter().map(|slope| Some(slope? * size)).collect()
}

/// The place of an answer in [`COUNTED`].
pub fn place(answer: Answer) -> Option<usize> {
    COUNTED.iter().position(|counted| *counted == answer)
}

/// The readings of the whole bat: a scale sets its densities, a tap its stiffness. They belong to the bat before its
/// edits. For an edited bat they only determine the properties, with a frequency proportional to the root of the
/// stiffness.
fn settled(analysed: &Analysed, readings: &Readings, left_out: &mut Vec<String>) -> Vec<Settled> {
    let before = analysed.bat.unedited();
    let edited = !analysed.bat.edits().is_empty();
    let weighed = before.weighed();
    let whole = |input, deviation| Source { input, material: String::new(), deviation };
    let scale = weighed.mass.map(|mass| Settled {
        source: whole(Input::Mass, readings.mass),
        answer: place(Answer::Mass).filter(|_| !edited),
        size: if edited { readings.mass / mass } else { readings.mass },
    });
    let tap = weighed.first_bending.and_then(|note| {
        let answer = if edited { None } else { analysed.tapped(note) };
        if answer.is_none() && !edited {
            left_out.push("the tap, whose note is of none of the first three modes".to_owned());
            return None;
        }
        Some(Settled {
            source: whole(Input::Tap, readings.tap),
            answer,
            size: if edited { 2.0 * readings.tap } else { readings.tap * note },
        })
    });
    scale.into_iter().chain(tap).collect()
}

/// The other uncertain properties, each with the change of another bat. A property of the only material is certain if a
/// reading sets it.
fn open(
    bat: &Bat,
    readings: &Readings,
    settled: &[Settled],
    left_out: &mut Vec<String>,
) -> Vec<(Parameter, Source)> {
    let mut open = vec![];
    let materials = materials(bat);
    let only = materials.len() == 1;
    for (place, material) in materials {
        // Each property with the reading that would settle it.
        let properties = [(Input::Stiffness, Input::Tap), (Input::Density, Input::Mass)];
        let unsettled = |(_, reading): &(Input, Input)| {
            let of = settled.iter().find(|settled| settled.source.input == *reading);
            of.is_none_or(|settled| !only && settled.answer.is_some())
        };
        let unsettled: Vec<Input> =
            properties.into_iter().filter(unsettled).map(|(property, _)| property).collect();
        let Some(scatter) = material.differs() else {
            if !unsettled.is_empty() {
                left_out.push(format!("the scatter of {place}, of which none is known here"));
            }
            continue;
        };
        for input in unsettled {
            let deviation = match input {
                Input::Stiffness => scatter.youngs_modulus,
                _ => scatter.density,
            };
            let source = Source {
                input,
                material: if only { String::new() } else { place.clone() },
                deviation,
            };
            open.push((Parameter { input, of: Some(material.clone()) }, source));
        }
    }
    let hollow = !barrel_walls(bat).is_empty()
        || bat.profile().stations.inner.iter().any(|inner| *inner > 0.0);
    let bores = hollow.then_some((Input::Bores, readings.diameter));
    let outside = Some((Input::Diameters, readings.diameter));
    let length = match bat.profile().formulas {
        None => Some((Input::Length, readings.length)),
        Some(_) => {
            left_out.push("the length, which is a formula's".to_owned());
            None
        }
    };
    for (input, deviation) in outside.into_iter().chain(length).chain(bores) {
        let source = Source { input, material: String::new(), deviation };
        open.push((Parameter::whole(input), source));
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

/// Holds a reading while a property of the whole bat adapts: subtracts from every row its effect on that answer, and
/// returns the effect of a unit change of the reading. `None` if the property does not affect it.
fn settle(rows: &mut [SourceEffect], factor: &AnswerValues, answer: usize) -> Option<AnswerValues> {
    let of_reading = factor[answer].filter(|slope| *slope != 0.0)?;
    let by: AnswerValues = factor.iter().map(|slope| Some((*slope)? / of_reading)).collect();
    for (_, parts) in rows {
        let Some(moved) = parts[answer] else { continue };
        let held = parts.iter().zip(&by).map(|(part, by)| Some((*part)? - (*by)? * moved));
        *parts = held.collect();
        // Zero, apart from round-off.
        parts[answer] = Some(0.0);
    }
    Some(by)
}

/// The answers with the effect of all sources together.
fn estimates(values: &AnswerValues, rows: &[SourceEffect]) -> Vec<Estimate> {
    let of = |(k, (answer, value)): (usize, (Answer, &Option<f64>))| {
        let parts: Option<Vec<f64>> = rows.iter().map(|(_, parts)| parts[k]).collect();
        let size = |parts: &Vec<f64>| parts.iter().map(|part| part * part).sum::<f64>().sqrt();
        let parts = parts.filter(|parts| size(parts).is_finite());
        let deviation = parts.as_ref().map(size);
        Some(Estimate { answer, value: (*value)?, deviation, parts: parts.unwrap_or_default() })
    };
    COUNTED.into_iter().zip(values).enumerate().filter_map(of).collect()
}

impl Analysed<'_> {
    /// The answers of this bat.
    fn answers(&self) -> AnswerValues {
        let peak = self.spot.exit_speed_max.map(|peak| [peak.x, peak.value]);
        answers(self.bat, self.solution, peak.zip(self.spot.zone))
    }

    /// The index of the frequency that is the tapped note (Hz), within the rough accuracy.
    fn tapped(&self, note: f64) -> Option<usize> {
        let answers = self.answers();
        let same = |k: &usize| answers[*k].is_some_and(|found| (found / note - 1.0).abs() < 0.01);
        (1..=3).filter_map(|order| place(Answer::Frequency(order))).find(same)
    }

    /// The effect of a unit change on every answer, by central differences; `None` if a changed bat cannot be computed.
    fn slopes(&self, parameters: &[Parameter]) -> Vec<Option<AnswerValues>> {
        let patch = parameters.iter().any(|parameter| parameter.input == Input::Patch);
        // The ball's patch does not affect the bat's modes.
        let known = patch.then(|| self.modes(self.bat).ok()).flatten();
        let sides = threads::map(2 * parameters.len(), |k| {
            let parameter = &parameters[k / 2];
            let step = parameter.step(self.bat);
            let by = if k % 2 == 0 { -step } else { step };
            let mut scene = self.scene.clone();
            if parameter.input == Input::Patch {
                // δ is proportional to the square of the patch's radius.
                let ball = &mut scene.ball;
                let compression = by.exp() * ball.patch_compression();
                ball.contact_radius_m = Some((ball.radius_m * compression).sqrt());
            }
            let known = known.clone().filter(|_| parameter.input == Input::Patch);
            let bat = changed(self.bat, parameter, by)?;
            let solution = known.map_or_else(|| self.modes(&bat), Ok)?;
            self.beside(&bat, solution, scene)
        });
        let slope = |(parameter, sides): (&Parameter, &[Result<AnswerValues>])| {
            let [Ok(less), Ok(more)] = sides else { return None };
            Some(quotient(more, less, 2.0 * parameter.step(self.bat)))
        };
        parameters.iter().zip(sides.chunks(2)).map(slope).collect()
    }

    /// As many modes of another bat as the hits of this one use, at least three if they are requested.
    fn modes(&self, bat: &Bat) -> Result<Solution> {
        let modes = self.hits.solution.modes.len().max(self.solution.modes.len().min(3));
        let theory = self.solution.theory;
        solve(bat, &Request { modes, tolerance: TOLERANCE, theory, ..Request::default() })
    }

    /// The answers of another bat in that scene, with the same number of modes and the same steps. Its wall is solved
    /// anew, approximately: equally for both sides of a difference.
    fn beside(&self, bat: &Bat, mut solution: Solution, scene: Scene) -> Result<AnswerValues> {
        let modes = self.hits.solution.modes.len();
        let notes = answers(bat, &solution, None);
        if self.spot.exit_speed_max.is_none() {
            return Ok(notes);
        }
        solution.modes.truncate(modes);
        let swing = self.law.map_or(self.scene.swing, |law| law.swing(bat));
        let scene = Scene { swing, ..scene.with_rough_wall(bat)? };
        let hitter = Hitter::new(self.model, &scene, bat, &solution, self.hits.effort)?;
        let looked = HitsAlong::outer(FEW, &hitter);
        let peak = looked.fastest();
        let hit = peak.map(|peak| ([peak.x, peak.value], looked.zone(peak)));
        let hit = answers(bat, &solution, hit);
        Ok(notes.iter().zip(&hit).map(|(note, hit)| note.or(*hit)).collect())
    }
}

/// The answers of a bat, its modes, and where and how fast (m, m/s) the fastest ball leaves, with the
/// zone around it (m).
fn answers(bat: &Bat, solution: &Solution, hit: Option<([f64; 2], [f64; 2])>) -> AnswerValues {
    let of = |answer: Answer| match answer {
        Answer::ExitSpeedPlace => hit.map(|([best, _], _)| best),
        Answer::ExitSpeed => hit.map(|([_, speed], _)| speed),
        Answer::Zone(end) => hit.map(|(_, zone)| zone[usize::from(end)]),
        answer => figure(answer, bat, solution).map(|figure| figure.value),
    };
    COUNTED.into_iter().map(of).collect()
}

/// Relative standard deviation of every frequency of a bat of one wood due to the wood alone, without a computation:
/// `½ √(v_E² + v_ρ²)`, because a frequency is proportional to `√(E/ρ)`; the density contributes only if the bat was not
/// weighed. `None` if the stiffness was tapped, or if no scatter is known.
pub fn of_frequencies(bat: &Bat) -> Option<f64> {
    let [(_, material)] = &materials(bat)[..] else { return None };
    let weighed = bat.unedited().weighed();
    let scatter = material.scatter().filter(|_| weighed.first_bending.is_none())?;
    let density = if weighed.mass.is_some() { 0.0 } else { scatter.density };
    Some(0.5 * scatter.youngs_modulus.hypot(density))
}
