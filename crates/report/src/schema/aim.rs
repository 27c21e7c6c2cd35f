//! What is wished of a bat, and the rules of a game: `sweetspot-aim/1` and `sweetspot-rules/1`, which are read.

use schemars::JsonSchema;
use schemars::generate::Contract;

use sweetspot::base::units::Quantity;
use sweetspot::files::schema::amount::{Amount, Measures};
use sweetspot::files::schema::document::{Document, Format};
use sweetspot::files::schema::part::{Comment, Material};

/// What somebody wants of a bat: targets, rules of a game, limits of the diameter, what may change and what
/// stays. Places count from the knob end.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(title = "Aim file of sweetspot, sweetspot-aim/1", deny_unknown_fields)]
pub struct AimForm {
    /// Where this schema is, for editors.
    #[schemars(rename = "$schema")]
    pub schema: Option<String>,
    /// Name of the format and its version: sweetspot-aim/1.
    pub format: Format<AimForm>,
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// What it is called.
    pub name: Option<String>,
    /// What is aimed at. The command line may add more.
    pub targets: Option<Vec<AimTarget>>,
    /// Rules of a game: a built-in name, or a rule file from this file's folder.
    #[schemars(example = &"mlb")]
    pub rules: Option<String>,
    /// Whether wood may only be taken off. Without it false.
    pub remove_only: Option<bool>,
    /// Whether wood may be added to a bat that was weighed, which otherwise is only cut. Without it false.
    pub add: Option<bool>,
    /// Stretches that stay as they are. Without it the knob, 0 to 30 mm.
    pub keep: Option<Vec<AimStretch>>,
    /// Limits of the diameter, which hold along the whole curve.
    pub diameter: Option<Vec<AimLimit>>,
    /// Distance of the stations that are written. Without it 10 mm, or 0.5 in of a bat in inches.
    #[schemars(transform = Measures(Quantity::Length))]
    pub stations: Option<Amount>,
    /// What diameters are rounded to. Without it 0.1 mm, or 0.005 in of a bat in inches.
    #[schemars(transform = Measures(Quantity::Length))]
    pub round: Option<Amount>,
    /// Greatest slope of the surface where it is changed: change of the radius over length, 0.01 to 10. Where the
    /// bat is steeper already it becomes no steeper.
    #[schemars(range(min = 0.01, max = 10.0))]
    pub slope_at_most: Option<f64>,
    /// What may change besides the shape.
    pub free: Option<AimFree>,
}

impl Document for AimForm {
    const NAME: &'static str = "aim";
    const CONTRACT: Contract = Contract::Deserialize;
}

/// A target: in words, as on the command line, or in parts.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum AimTarget {
    /// In words, such as "swing weight -3 % within 5 oz in2".
    Words(String),
    /// In parts.
    Parts(AimParts),
}

/// A target in parts: one of change and value, or at_least and at_most.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct AimParts {
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// What is aimed at: the name of an output, drop, or what people call it.
    #[schemars(example = &"inertia_pivot_kg_m2", example = &"sweet spot")]
    pub name: String,
    /// By how much it is to change: a number in SI, or a text with a unit, in % of what it is, or with where
    /// to.
    #[schemars(example = &"-3 %", example = &"1 cm outward")]
    pub change: Option<AimNumber>,
    /// What it is to be.
    #[schemars(example = &"180 Hz", example = &"6.5 in from the tip")]
    pub value: Option<AimNumber>,
    /// What it is to be at least.
    #[schemars(example = &"99.5 %")]
    pub at_least: Option<AimNumber>,
    /// What it is to be at most.
    #[schemars(example = &"31 oz")]
    pub at_most: Option<AimNumber>,
    /// How far beside change or value it may be.
    #[schemars(example = &"5 oz in2")]
    pub within: Option<AimNumber>,
}

/// A number in SI, or a text with a unit, a % or words.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum AimNumber {
    /// In SI.
    Number(f64),
    /// In words.
    Words(String),
}

/// A stretch of the bat: in words, or its ends.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum AimStretch {
    /// In words, such as "0 to 30 mm".
    Words(String),
    /// Its ends.
    Ends(AimEnds),
}

/// The ends of a stretch.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct AimEnds {
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// Where it begins.
    #[schemars(transform = Measures(Quantity::Length))]
    pub from: Amount,
    /// Where it ends.
    #[schemars(transform = Measures(Quantity::Length))]
    pub to: Amount,
}

/// What the diameter may be on a stretch.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields, extend("anyOf" = [{ "required": ["at_least"] }, { "required": ["at_most"] }]))]
pub struct AimLimit {
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// Where the stretch begins. Without it at the knob end.
    #[schemars(transform = Measures(Quantity::Length))]
    pub from: Option<Amount>,
    /// Where it ends. Without it at the tip.
    #[schemars(transform = Measures(Quantity::Length))]
    pub to: Option<Amount>,
    /// Least diameter.
    #[schemars(transform = Measures(Quantity::Length))]
    pub at_least: Option<Amount>,
    /// Greatest diameter.
    #[schemars(transform = Measures(Quantity::Length))]
    pub at_most: Option<Amount>,
}

/// What may change besides the shape.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct AimFree {
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// Least and greatest length; everything on the bat moves with it.
    pub length: Option<(Amount, Amount)>,
    /// Least and greatest density of the bat's own material, its moduli as they are.
    pub density: Option<(Amount, Amount)>,
    /// Materials, of which the one that needs the least change is taken.
    pub wood: Option<Vec<Material>>,
    /// Greatest weight on the knob end.
    #[schemars(transform = Measures(Quantity::Mass))]
    pub knob_weight: Option<Amount>,
}

/// The rules of a game, as far as they are numbers, with their source and date. What is computed by them
/// certifies nothing: the rules in their newest edition do, and their laboratories.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(title = "Rule file of sweetspot, sweetspot-rules/1", deny_unknown_fields)]
pub struct RulesForm {
    /// Where this schema is, for editors.
    #[schemars(rename = "$schema")]
    pub schema: Option<String>,
    /// Name of the format and its version: sweetspot-rules/1.
    pub format: Format<RulesForm>,
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// Short name.
    pub name: String,
    /// Which game they are of.
    pub game: Option<String>,
    /// Where the numbers are from.
    pub source: String,
    /// Year or date of the source.
    pub date: String,
    /// Greatest diameter anywhere.
    #[schemars(transform = Measures(Quantity::Length))]
    pub diameter_at_most: Option<Amount>,
    /// Greatest length.
    #[schemars(transform = Measures(Quantity::Length))]
    pub length_at_most: Option<Amount>,
    /// Greatest mass.
    #[schemars(transform = Measures(Quantity::Mass))]
    pub mass_at_most: Option<Amount>,
    /// Greatest drop: length in inches less mass in ounces.
    pub drop_at_most: Option<f64>,
    /// Greatest BBCOR.
    pub bbcor_at_most: Option<f64>,
    /// Least moment of inertia about the point 6 in from the knob end.
    #[schemars(transform = Measures(Quantity::Inertia))]
    pub inertia_at_least: Option<Amount>,
    /// Greatest depth of a cup in the tip.
    #[schemars(transform = Measures(Quantity::Length))]
    pub cup_depth_at_most: Option<Amount>,
    /// Least diameter of a cup.
    #[schemars(transform = Measures(Quantity::Length))]
    pub cup_diameter_at_least: Option<Amount>,
    /// Greatest diameter of a cup.
    #[schemars(transform = Measures(Quantity::Length))]
    pub cup_diameter_at_most: Option<Amount>,
    /// Whether the bat must be one piece.
    pub one_piece: Option<bool>,
    /// What the rules ask besides, which nothing here computes.
    pub ask: Option<Vec<String>>,
}

impl Document for RulesForm {
    const NAME: &'static str = "rules";
    const CONTRACT: Contract = Contract::Deserialize;
}
