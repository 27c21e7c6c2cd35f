//! The result of a wish: the bat that meets it or comes nearest, and how it was found.

use serde::Serialize;

use crate::aim::bench::ExtraKind;
use crate::aim::conflict::Conflict;
use crate::aim::laying::Station;
use crate::aim::limits::KEPT;
use crate::aim::rules::RulesKept;
use crate::aim::wish::{Band, Grid};
use crate::answers::Answer;
use crate::engine::Bat;

/// The result of a wish.
#[derive(Debug, Clone, Serialize, schemars::JsonSchema)]
pub struct Outcome {
    /// Whether every target is met and every limit kept.
    pub met: bool,
    /// The targets, and the rules that are goals.
    pub targets: Vec<AimedTarget>,
    /// The targets that cannot be had together; null where all can.
    pub conflict: Option<Conflict>,
    /// The rules that the wish names; null without.
    pub rules: Option<RulesKept>,
    /// Root of mean(d²) + (5 cm)⁴ mean(d″²) of the change d of the diameter (mm).
    pub norm_mm: f64,
    /// Largest amount taken off a diameter (m).
    pub largest_cut_m: f64,
    /// Largest amount put on a diameter (m).
    pub largest_added_m: f64,
    /// Largest violation of a limit of the diameter (m); 0 if all are kept to 1e-9 m.
    pub limits_broken_m: f64,
    /// Largest movement of the diameter on the stretches that are kept (m).
    pub kept_within_m: f64,
    /// Largest excess of the slope of the surface over `slope_at_most` (radius over length); 0 if it is kept, null
    /// without it.
    pub steeper_by: Option<f64>,
    /// Quadratic programs of the search.
    pub iterations: usize,
    /// Bats that were computed.
    pub bats_solved: usize,
    /// Why the search ended before it converged; null if it converged.
    pub stopped: Option<&'static str>,
    /// The other free choices.
    pub free: Vec<Choice>,
    /// The material that was chosen; null without a choice.
    pub wood: Option<String>,
    /// Main outputs before and after.
    pub outputs: Vec<Output>,
    /// Every station of the new bat.
    pub change: Vec<Station>,
    /// The bat as it was.
    #[serde(skip)]
    pub start: Bat,
    /// The bat as written.
    #[serde(skip)]
    pub bat: Bat,
    /// How its stations were laid.
    #[serde(skip)]
    pub grid: Grid,
    /// Factor by which the stations are rounded more finely than requested, so that every goal is met.
    #[serde(skip)]
    pub finer: f64,
    /// Greatest slope of the changed surface, if it is limited: radius over length.
    #[serde(skip)]
    pub slope: Option<f64>,
    /// Whether wood was only taken off.
    #[serde(skip)]
    pub remove_only: bool,
    /// The reason why the wall of a hollow barrel is rigid in the hits; `None` if it matters to no goal.
    #[serde(skip)]
    pub rigid_wall: Option<String>,
}

/// A target and its result; SI, in the unit of its name.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct AimedTarget {
    /// Name of the output.
    pub name: String,
    /// The rule it is of; null for a target.
    pub rule: Option<&'static str>,
    /// Least value of the target; null without.
    pub at_least: Option<f64>,
    /// Greatest value of the target; null without.
    pub at_most: Option<f64>,
    /// The value of the bat as it was.
    pub start: f64,
    /// The value of the new bat; null if it has none.
    pub found: Option<f64>,
    /// Whether it is met.
    pub met: bool,
    /// Decrease of the norm (mm), to which the search adds the other free choices, if the binding bound is relaxed by
    /// one unit; 0 if no bound binds, null if the target is missed.
    pub price_mm: Option<f64>,
    /// Its allowed range.
    #[serde(skip)]
    pub band: Band,
    /// The price, also for a missed target; `None` if the change is not a least one that meets all goals.
    #[serde(skip)]
    pub price: Option<f64>,
}

impl AimedTarget {
    /// The target of that band, with its value and price.
    pub(super) fn new(band: Band, value: f64, price: Option<f64>) -> Self {
        let known = |value: f64| value.is_finite().then_some(value);
        let met = band.has(value);
        Self {
            name: band.goal.name(),
            rule: band.rule,
            at_least: known(band.low),
            at_most: known(band.high),
            start: band.start,
            found: known(value),
            met,
            price_mm: price.filter(|_| met),
            band,
            price,
        }
    }

    /// The value of the new bat; NaN if it has none.
    pub fn value(&self) -> f64 {
        self.found.unwrap_or(f64::NAN)
    }
}

/// A choice besides the shape.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Choice {
    /// The choice: length_m, density_kg_m3 or knob_weight_kg.
    #[serde(rename = "name")]
    #[schemars(with = "String")]
    pub what: ExtraKind,
    /// The value before.
    pub start: f64,
    /// The value chosen.
    pub found: f64,
}

/// An output before and after.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Output {
    /// Its name.
    #[serde(rename = "name")]
    #[schemars(with = "String")]
    pub answer: Answer,
    /// Of the bat as it was.
    pub start: Option<f64>,
    /// Of the new bat.
    pub found: Option<f64>,
}

impl Outcome {
    fn is_met(&self) -> bool {
        self.targets_met()
            && self.limits_broken_m <= KEPT
            && self.steeper_by.is_none_or(|by| by <= KEPT)
            && self.broken_rules() == 0
    }

    /// Determines whether each target is met; the conflict is removed if all are.
    pub(super) fn judge(&mut self) {
        self.met = self.is_met();
        if self.targets_met() {
            self.conflict = None;
        }
    }

    /// Whether every target is met, including the rules among the targets.
    pub fn targets_met(&self) -> bool {
        self.targets.iter().all(|target| target.met)
    }

    /// How many rules are broken.
    pub fn broken_rules(&self) -> usize {
        self.rules
            .iter()
            .flat_map(|set| &set.limits)
            .filter(|ruled| ruled.kept == Some(false))
            .count()
    }

    /// The place where a cut section keeps the smallest share of its strength in bending, and that share: the section
    /// modulus `π (d⁴ − d_i⁴) / (32 d)` of a round section of that diameter and bore, after over before.
    pub fn weakest(&self) -> Option<(f64, f64)> {
        let modulus = |across: f64, bore: f64| (across.powi(4) - bore.powi(4)) / across;
        let left = |station: &Station| {
            let [old, new] = [station.old, station.new].map(|d| modulus(d, 2.0 * station.inner));
            new / old
        };
        let cut = self.change.iter().filter(|station| station.new < station.old);
        cut.map(|station| (station.x, left(station))).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The greatest diameter of the written bat (m).
    pub fn widest(&self) -> f64 {
        let radii = &self.bat.profile().stations.outer;
        2.0 * radii.iter().fold(0.0_f64, |a, b| a.max(*b))
    }
}

/// The largest amount taken off a diameter, and the largest added (m).
pub(super) fn largest(stations: &[Station]) -> [f64; 2] {
    let changes = stations.iter().map(|station| station.new - station.old);
    changes.fold([0.0, 0.0], |[off, on]: [f64; 2], by| [off.max(-by), on.max(by)])
}
