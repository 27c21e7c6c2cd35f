//! The effects of cuts and weights on a bat: the members of a lathe map's document about the bat.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::answers::Answer;
use crate::lathe::gauges::Rivals;
use crate::lathe::slopes::Method;

/// Changes of outputs by their names, such as `f1_hz`; null for an output without one.
pub type Changes = BTreeMap<String, Option<f64>>;

/// The effects of cuts and weights on a bat.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct LatheFound {
    /// The unit of the changes of bands.
    pub per: &'static str,
    /// n of the batter's law: a bat with moment of inertia I is swung (I₀/I)^n times as fast.
    pub swing_exponent: f64,
    /// The outputs, with their values for the unchanged bat.
    pub outputs: Vec<Output>,
    /// Stretches of the bat, from the knob towards the tip.
    pub bands: Vec<TurnedBand>,
    /// Changes of the frequencies along the bat.
    pub curves: Curves,
    /// The effect of a mass on the bat.
    pub added_mass: AddedMass,
    /// Changes that are computed in full, because a derivative cannot describe them.
    pub done_to_the_end: Vec<WholeChange>,
    /// Outputs that are not smooth, each with the reason.
    pub not_smooth_at: Vec<Rivals>,
    /// How well the map holds.
    pub check: Check,
    /// Whether the outputs are as accurate as asked.
    pub tolerance_met: bool,
}

/// Something that changes with the bat.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Output {
    /// Its name, the unit at the end.
    #[schemars(with = "String")]
    pub name: Answer,
    /// Its value for the unchanged bat; null if it has none.
    pub value: Option<f64>,
    /// Error of the value; null if it is not known.
    pub error: Option<f64>,
    /// Method for its changes.
    pub method: Method,
}

/// A stretch of the bat, and the changes per millimetre of diameter that is taken off it.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct TurnedBand {
    /// Beginning (m).
    pub from_m: f64,
    /// End (m).
    pub to_m: f64,
    /// Diameter in its middle (m).
    pub diameter_m: f64,
    /// Derivatives, the bat swung at the same angular speed; null under a sleeve.
    pub change: Option<Changes>,
    /// Those of a hit for a swing of the same energy of rotation (n = 1/2).
    pub change_same_energy: Option<Changes>,
    /// Changes of a hit by the batter's law; left out if it is one of the two.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub change_by_law: Option<Changes>,
    /// Errors of the derivatives; those by differences include the step and the omitted modes.
    pub error: Option<Changes>,
    /// The change per millimetre for a finite cut; null if the cut is impossible.
    pub finite: Option<FiniteCut>,
    /// The reason if a value is null; left out otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Derivative of the moment of inertia about the point 6 in from the knob end, per metre (kg m).
    #[serde(skip)]
    pub inertia: Option<f64>,
}

/// A finite cut of a band, solved whole.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct FiniteCut {
    /// Depth of the cut, taken off the diameter (mm).
    pub cut_mm: f64,
    /// Changes of hits per millimetre for a swing of the same energy.
    pub same_energy: Changes,
    /// Changes of hits per millimetre by the batter's law; left out if it is one of the two.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by_law: Option<Changes>,
    /// Changes per millimetre, the bat swung at the same angular speed.
    #[serde(flatten)]
    pub change: Changes,
}

/// Densities of the frequencies' changes: Hz per millimetre of diameter taken off and millimetre of length, named
/// such as `f1_hz_per_mm_mm`.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Curves {
    /// Places (m).
    pub x_m: Vec<f64>,
    /// The densities there.
    #[serde(flatten)]
    pub density: BTreeMap<String, Vec<f64>>,
}

/// The effect of a mass fixed to the axis of the bat, by formula.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct AddedMass {
    /// Places (m).
    pub x_m: Vec<f64>,
    /// Change of each output per gram there.
    // For frequencies and the rigid body.
    pub per_g: BTreeMap<String, Vec<Option<f64>>>,
}

/// A change that was solved.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct WholeChange {
    /// The change.
    pub what: &'static str,
    /// Changes of the outputs, the bat swung at the same angular speed; null where it cannot be done.
    pub change: Option<Changes>,
    /// Changes of hits for a swing of the same energy.
    pub change_same_energy: Option<Changes>,
    /// Changes of hits by the batter's law; left out if it is one of the two.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub change_by_law: Option<Changes>,
    /// The reason if it is impossible; left out otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// How well the map holds.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Check {
    /// Largest distance of a frequency's formula and the difference of whole bats, relative to the largest change
    /// of that frequency; null where there was no difference.
    pub formula_against_difference: Option<f64>,
}

/// The change of an answer, if it has one.
fn told(changes: Option<&Changes>, answer: Answer) -> Option<f64> {
    *changes?.get(&answer.name())?
}

impl TurnedBand {
    /// From where to where (m from the knob end).
    pub fn ends(&self) -> [f64; 2] {
        [self.from_m, self.to_m]
    }

    /// The derivative of an answer per millimetre of diameter taken off, for a swing law's exponent: 0, ½ or the
    /// batter's.
    pub fn derivative(&self, answer: Answer, exponent: f64) -> Option<f64> {
        let changes = match exponent {
            0.0 => &self.change,
            0.5 => &self.change_same_energy,
            _ => &self.change_by_law,
        };
        told(changes.as_ref(), answer)
    }

    /// As [`Self::derivative`], by the finite cut.
    pub fn when_cut(&self, answer: Answer, exponent: f64) -> Option<f64> {
        let finite = self.finite.as_ref()?;
        let changes = match exponent {
            0.0 => Some(&finite.change),
            0.5 => Some(&finite.same_energy),
            _ => finite.by_law.as_ref(),
        };
        told(changes, answer)
    }

    /// Error of the derivative of an answer.
    pub fn error(&self, answer: Answer) -> Option<f64> {
        told(self.error.as_ref(), answer)
    }
}

impl WholeChange {
    /// The change of an answer, the bat swung at the same angular speed.
    pub fn of(&self, answer: Answer) -> Option<f64> {
        told(self.change.as_ref(), answer)
    }
}
