//! What is known about a bat or a hit, according to the files of `validation/`?

use std::path::Path;

use schemars::JsonSchema;
use schemars::generate::Contract;
use serde::Deserialize;
use serde_json::Value;

use crate::bundled::{bundled_bat, text};
use crate::known_hits::{KnownFigure, Throw};
use sweetspot::base::{Error, Result};
use sweetspot::bat::{Bat, Theory};
use sweetspot::files::schema::bat::BatFile;
use sweetspot::files::schema::document::{Document, Format};
use sweetspot::modes::solve::Request;

/// One bat, or a rigid wall for a ball, with known values, the sources of the numbers, and the tolerance for ours. SI
/// units, named at the end of each member; positions count from the knob end.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Case of known answers of sweetspot, sweetspot-validation/1")]
pub struct Case {
    /// Name of the format and its version: sweetspot-validation/1.
    pub format: Format<Case>,
    /// Name of the case.
    pub name: String,
    /// Source of the expected numbers.
    pub source: String,
    /// Whose numbers they are; a case without it has an exact answer.
    pub published: Option<Published>,
    /// The bat, or the name of a built-in file; none for a wall.
    #[serde(default)]
    #[schemars(with = "Option<CaseBat>")]
    pub(super) bat: Value,
    /// The request for the modes of the bat.
    #[serde(default)]
    solve: Solve,
    /// The ball that hits the bat, or the wall if all checks are of hits.
    pub hit: Option<Throw>,
    /// The known numbers.
    pub checks: Vec<Check>,
}

impl Document for Case {
    const NAME: &'static str = "validation";
    const CONTRACT: Contract = Contract::Deserialize;
}

/// A bat in a case.
#[derive(JsonSchema)]
#[schemars(untagged)]
#[expect(dead_code, reason = "the form of a value that is read as what it turns out to be")]
enum CaseBat {
    /// The name of a bat file that travels with the program.
    File(String),
    /// A complete bat file.
    Bat(Box<BatFile>),
}

/// The published numbers of a case, and their place in a comparison.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Published {
    /// Cases with the same bat share one table.
    pub bat: String,
    /// Origin of the numbers.
    pub kind: Provenance,
    /// Which of several meshes, where the bat has more than one.
    pub row: Option<String>,
}

/// Origin of published numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Provenance {
    /// Measured on the bat.
    Measured,
    /// Computed with another program.
    Computed,
}

/// The request for the modes of the bat.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Solve {
    /// Number of modes.
    modes: usize,
    /// Requested relative error of a frequency.
    tolerance: Option<f64>,
    /// Number of elements; the planner's own choice if absent.
    elements: Option<usize>,
    /// Name of the beam theory; the plain beam if absent.
    theory: Option<String>,
}

/// One known number.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Check {
    /// The known quantity.
    pub quantity: Known,
    /// Number of the mode, from 1.
    pub mode: Option<usize>,
    /// Number of the node of that mode, from 1 at the knob.
    pub node: Option<usize>,
    /// Position of the hit or force (m).
    pub at: Option<f64>,
    /// Position of the observed deflection (m).
    pub(super) to: Option<f64>,
    /// How fast the force swings (Hz).
    pub(super) frequency_hz: Option<f64>,
    /// How long after a blow (s).
    pub(super) time_s: Option<f64>,
    /// How fast the ball flies at a wall (m/s).
    pub(super) speed_m_per_s: Option<f64>,
    /// The known number, in the quantity's unit.
    pub expected: f64,
    /// Allowed relative error.
    pub(super) relative: Option<f64>,
    /// Allowed error, in the quantity's unit.
    pub(super) absolute: Option<f64>,
    /// Shown with its difference, but neither passed nor missed; the note gives the reason.
    #[serde(default)]
    pub(super) information: bool,
    /// The reason for the tolerance; a check without one shares the note above.
    pub note: Option<String>,
}

/// A known quantity, with its unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Known {
    /// Natural frequency (Hz).
    FrequencyHz,
    /// Ratio of a frequency to the first one.
    FrequencyRatio,
    /// Position of a node from the knob end (m).
    NodeM,
    /// Modal mass for a largest deflection of 1 (kg).
    ModalMassKg,
    /// How fast a damped mode dies out and how fast it swings.
    #[serde(rename = "decay_1_per_s")]
    Decay,
    /// How fast a damped mode swings (Hz).
    DampedFrequencyHz,
    /// Real part of deflection per force at a frequency (m/N), with time as `e^{+iωt}`.
    ReceptanceRealMPerN,
    /// Imaginary part of deflection per force at a frequency (m/N), with time as `e^{+iωt}`.
    ReceptanceImaginaryMPerN,
    /// Deflection after an impulse of 1 N s, by the rigid motions and the modes of the case.
    DeflectionAfterBlowM,
    /// Mass (kg).
    MassKg,
    /// Balance point from the knob end (m).
    BalancePointM,
    /// Moment of inertia about the balance point (kg m²).
    InertiaBalanceKgM2,
    /// Moment of inertia about the point 6 in from the knob (kg m²).
    #[serde(rename = "inertia_pivot_kg_m2")]
    InertiaPivotKgM2,
    /// Centre of percussion for a pivot 6 in from the knob, from the knob end (m).
    CenterOfPercussionM,
    /// Swing weight: moment of inertia about the point 6 in from the knob (oz in²).
    InertiaPivotOzIn2,
    /// A figure of a hit.
    #[serde(untagged)]
    Hit(KnownFigure),
}

/// One of the built-in cases.
///
/// # Errors
///
/// [`Error::Value`] if there is none with that name.
pub fn bundled_case(name: &str) -> Result<Case> {
    read(name, text(name)?)
}

/// A case.
pub(crate) fn read(name: &str, text: &str) -> Result<Case> {
    serde_json::from_str(text)
        .map_err(|error| Error::value(name, error, "a sweetspot-validation/1 case"))
}

impl Case {
    /// The bat of the case.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for an unknown name, and the errors of its file.
    pub fn bat(&self) -> Result<Bat> {
        match &self.bat {
            Value::String(path) => bundled_bat(path),
            Value::Null => Err(Error::value(&self.name, "no bat", "a bat")),
            inline => Bat::from_text(&self.name, &inline.to_string(), Path::new("")),
        }
    }

    /// Source of the bat: the built-in file, or the statement of the case.
    pub fn bat_source(&self) -> String {
        match &self.bat {
            Value::String(path) => format!("`{path}`."),
            Value::Null => "none, the ball meets a rigid wall.".to_owned(),
            inline => format!("{}.", inline["source"].as_str().unwrap_or("of the case")),
        }
    }

    /// The request of the case for its bat.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for an unknown theory.
    pub fn request(&self) -> Result<Request> {
        let known = |name: &String| Theory::ALL.into_iter().find(|theory| theory.name() == name);
        let theory = match &self.solve.theory {
            None => Theory::EulerBernoulli,
            Some(name) => known(name).ok_or_else(|| Error::value("theory", name, "a theory"))?,
        };
        Ok(Request {
            theory,
            modes: self.solve.modes,
            tolerance: self.solve.tolerance.unwrap_or(Request::default().tolerance),
            elements: self.solve.elements,
            ..Request::default()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bundled::CASES;

    /// No check can be mistaken for a pass: every tolerance is valid and every reason is given.
    #[test]
    fn every_check_has_a_tolerance_and_a_reason_or_is_for_information() {
        for (name, text) in CASES {
            let case = read(name, text).unwrap();
            assert!(!case.source.is_empty(), "{name}");
            let reason = case.checks.first().and_then(|check| check.note.as_ref());
            assert!(reason.is_some(), "{name}: the first check has no note");
            let mut information = false;
            for check in &case.checks {
                let tolerances = [check.relative, check.absolute];
                let given = tolerances.iter().flatten().filter(|t| **t > 0.0).count();
                assert_eq!(given, usize::from(!check.information), "{name}: {check:?}");
                // A case either counts or has a reason not to, never both.
                assert!(check.note.is_some() || check.information == information, "{name}");
                information = check.information;
            }
        }
    }
}
