//! The document of a lathe map, `sweetspot-lathe/1`: what is written is this type, and so is its schema.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::schema::hit::Scene;
use sweetspot::bat::edit::Edit;
use sweetspot::files::schema::document::{Document, Format, Generator};

/// Changes of outputs by their names, such as `f1_hz`; null where an output has none.
pub type Changes = BTreeMap<String, Option<f64>>;

/// What cuts and weights do to a bat. SI, the unit in every output's name; positions count from the knob end;
/// what does not exist is null. Changes of bands are per millimetre of diameter taken off. Later versions of the
/// same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "Lathe file of sweetspot, sweetspot-lathe/1")]
pub struct LatheFile {
    /// Name of the format and its version: sweetspot-lathe/1.
    pub format: Format<LatheFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// What the bat is called.
    pub bat_name: String,
    /// What was changed about the bat before; left out where nothing was.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// How the bat's bending is counted in hits.
    #[schemars(extend("enum" = ["rigid", "energy-loss", "pulse", "contact"]))]
    pub model: String,
    /// How the bat is swung, and what ball it meets.
    pub scene: Scene,
    /// The beam theory of the modes.
    #[schemars(extend("enum" = ["euler-bernoulli", "rayleigh", "timoshenko"]))]
    pub theory: String,
    /// What changes of bands are per.
    pub per: String,
    /// n of the batter's own law: a bat of moment of inertia I is swung (I₀/I)^n times as fast.
    pub swing_exponent: f64,
    /// What was looked at, with its value for the bat as it is.
    pub outputs: Vec<Output>,
    /// Stretches of the bat, from the knob towards the tip.
    pub bands: Vec<LatheBand>,
    /// Changes of the frequencies along the bat.
    pub curves: Curves,
    /// What a mass on the bat does.
    pub added_mass: AddedMass,
    /// Changes that are solved, as no derivative tells them.
    pub done_to_the_end: Vec<DoneToTheEnd>,
    /// Outputs that are not smooth, each with the reason.
    pub not_smooth_at: Vec<NotSmooth>,
    /// How well the map holds.
    pub check: Check,
    /// Whether the outputs are as accurate as was asked.
    pub tolerance_met: bool,
}

impl Document for LatheFile {
    const NAME: &'static str = "lathe";
}

/// Something that changes with the bat.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Output {
    /// Its name, the unit at the end.
    pub name: String,
    /// Its value for the bat as it is; null where it has none.
    pub value: Option<f64>,
    /// How far the value may be off; null where that is not known.
    pub error: Option<f64>,
    /// How its changes are found.
    #[schemars(extend("enum" = ["formula", "exact", "difference"]))]
    pub method: String,
}

/// A stretch of the bat and what happens per millimetre of diameter that is taken off it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LatheBand {
    /// Where it begins (m).
    pub from_m: f64,
    /// Where it ends (m).
    pub to_m: f64,
    /// Diameter in its middle (m).
    pub diameter_m: f64,
    /// Derivatives, the bat swung at the same angular speed; null under a sleeve.
    pub change: Option<Changes>,
    /// Those of a hit for a swing of the same energy of rotation (n = 1/2).
    pub change_same_energy: Option<Changes>,
    /// Those of a hit by the batter's own law; left out where it is one of the two.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub change_by_law: Option<Changes>,
    /// Errors of the derivatives; those by differences count the step and the modes left out.
    pub error: Option<Changes>,
    /// The change per millimetre when so much comes off; null where it cannot.
    pub finite: Option<FiniteCut>,
    /// Why something is null; left out where nothing is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// A finite cut of a band, solved whole.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FiniteCut {
    /// How much comes off the diameter (mm).
    pub cut_mm: f64,
    /// Changes of hits per millimetre for a swing of the same energy.
    pub same_energy: Changes,
    /// Changes of hits per millimetre by the batter's own law; left out where it is one of the two.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub by_law: Option<Changes>,
    /// Changes per millimetre, the bat swung at the same angular speed.
    #[serde(flatten)]
    pub change: Changes,
}

/// Densities of the frequencies' changes: Hz per millimetre of diameter taken off and millimetre of length, named
/// such as `f1_hz_per_mm_mm`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Curves {
    /// Places (m).
    pub x_m: Vec<f64>,
    /// The densities there.
    #[serde(flatten)]
    pub density: BTreeMap<String, Vec<f64>>,
}

/// What a mass fixed to the axis of the bat does, by formula.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AddedMass {
    /// Places (m).
    pub x_m: Vec<f64>,
    /// Change of each output per gram there.
    pub per_g: BTreeMap<String, Vec<Option<f64>>>,
}

/// A change that was solved.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DoneToTheEnd {
    /// What is done.
    pub what: String,
    /// Changes of the outputs, the bat swung at the same angular speed; null where it cannot be done.
    pub change: Option<Changes>,
    /// Changes of hits for a swing of the same energy.
    pub change_same_energy: Option<Changes>,
    /// Changes of hits by the batter's own law; left out where it is one of the two.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub change_by_law: Option<Changes>,
    /// Why it cannot be done; left out where it can.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// An output that is not smooth. Rivals and a corner leave it without a derivative; after a cut the finite change of
/// some band is another one than the derivative says.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NotSmooth {
    /// The output.
    pub name: String,
    /// Why: two places along the bat are nearly as good, there is a corner at the best place, or a finite cut
    /// makes it jump.
    #[schemars(extend("enum" = ["rivals", "corner", "cut"]))]
    #[serde(default)]
    pub why: String,
    /// The best place and the other, or that after the cut (m).
    pub x_m: [f64; 2],
    /// The values there.
    pub value: [f64; 2],
}

/// How well the map holds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Check {
    /// Largest distance of a frequency's formula and the difference of whole bats, relative to the largest change
    /// of that frequency; null where there was no difference.
    pub formula_against_difference: Option<f64>,
}
