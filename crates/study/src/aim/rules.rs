//! What do the rules of a game demand of a bat?
//!
//! A [`RuleSet`] is data with its source and date; a result computed from it certifies nothing.

use serde::Serialize;

use crate::engine::{Bat, STANDARD_PIVOT, inches, ounces};
use crate::named::named;

/// The numerical rules of a game.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RuleSet {
    /// Short name, such as `mlb`.
    pub name: String,
    /// Which game they are of.
    pub game: String,
    /// Source of the numbers.
    pub source: String,
    /// Year or date of the source.
    pub date: String,
    /// The rules, each with its limit in SI; None where it has no number.
    pub rules: Vec<(Rule, Option<f64>)>,
    /// Further demands of the rules, which are not computed here.
    pub ask: Vec<String>,
}

named! {
    /// A rule, as a rule file calls it.
    pub enum Rule {
        /// Greatest diameter anywhere (m).
        DiameterAtMost = "diameter_at_most",
        /// Greatest length (m).
        LengthAtMost = "length_at_most",
        /// Greatest mass (kg).
        MassAtMost = "mass_at_most",
        /// Least moment of inertia about the point 6 in from the knob end (kg m²).
        InertiaAtLeast = "inertia_at_least",
        /// Greatest depth of a cup in the tip (m).
        CupDepthAtMost = "cup_depth_at_most",
        /// Least diameter of a cup (m).
        CupDiameterAtLeast = "cup_diameter_at_least",
        /// Greatest diameter of a cup (m).
        CupDiameterAtMost = "cup_diameter_at_most",
        /// Greatest drop: length in inches less mass in ounces.
        DropAtMost = "drop_at_most",
        /// Greatest BBCOR.
        BbcorAtMost = "bbcor_at_most",
        /// The bat is one piece.
        OnePiece = "one_piece",
    }
}

/// Rules, and whether the new bat keeps them.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct RulesKept {
    /// Short name.
    pub name: String,
    /// Which game they are of.
    pub game: String,
    /// Source of the numbers.
    pub source: String,
    /// Year or date of the source.
    pub date: String,
    /// Always false: a computed result certifies nothing.
    pub certified: bool,
    /// The rules.
    pub limits: Vec<Ruled>,
    /// Further demands of the rules, which are not computed here.
    pub ask: Vec<String>,
}

/// A rule and its result.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Ruled {
    /// Which, as a rule file calls it.
    #[schemars(with = "String")]
    pub rule: Rule,
    /// Its limit (SI); null where it has no number.
    pub limit: Option<f64>,
    /// The new bat's value (SI); null if it has none.
    pub value: Option<f64>,
    /// Whether it is kept; null if that is not known.
    pub kept: Option<bool>,
}

impl RuleSet {
    /// The greatest diameter that the rules allow (m), infinite without one.
    pub fn diameter(&self) -> f64 {
        let of_diameter = self.rules.iter().filter(|(rule, _)| *rule == Rule::DiameterAtMost);
        of_diameter.filter_map(|(_, most)| *most).fold(f64::INFINITY, f64::min)
    }

    /// The rules with the bat's value for each, and whether it is kept; `bbcor` is given.
    pub fn judged(&self, bat: &Bat, bbcor: Option<f64>) -> RulesKept {
        let widest = bat.profile().stations.outer.iter().fold(0.0_f64, |a, b| a.max(*b));
        let (body, hole) = (bat.inertia(), cup(bat));
        let of = |&(rule, limit): &(Rule, Option<f64>)| {
            let value = match rule {
                Rule::DiameterAtMost => Some(2.0 * widest),
                Rule::LengthAtMost => Some(bat.length()),
                Rule::MassAtMost => Some(body.mass),
                Rule::InertiaAtLeast => Some(body.about(STANDARD_PIVOT)),
                Rule::CupDepthAtMost => hole.map(|hole| hole[0]),
                Rule::CupDiameterAtLeast | Rule::CupDiameterAtMost => hole.map(|hole| hole[1]),
                Rule::DropAtMost => Some(inches(bat.length()) - ounces(body.mass)),
                Rule::BbcorAtMost => bbcor,
                Rule::OnePiece => None,
            };
            let bound = limit.unwrap_or(f64::INFINITY);
            let slack = 1e-9 * bound.abs().max(1.0);
            let least = rule.name().ends_with("_at_least");
            let keeps = |v: f64| if least { v >= bound - slack } else { v <= bound + slack };
            let kept = match rule {
                Rule::OnePiece => Some(one_piece(bat)),
                // A bat without a cup keeps every rule about cups.
                _ if rule.name().starts_with("cup") => Some(value.is_none_or(keeps)),
                _ => value.map(keeps),
            };
            Ruled { rule, limit, value, kept }
        };
        let Self { name, game, source, date, ask, .. } = self.clone();
        let limits = self.rules.iter().map(of).collect();
        RulesKept { name, game, source, date, certified: false, limits, ask }
    }
}

/// A hole that is open at the tip: its depth and its diameter there (m); `None` without one.
fn cup(bat: &Bat) -> Option<[f64; 2]> {
    const SAMPLES: usize = 400;
    let length = bat.length();
    let rim = bat.profile().at(length).inner;
    let hollow = |k: &usize| {
        let x = length * (1.0 - *k as f64 / SAMPLES as f64);
        bat.profile().at(x).inner > 0.0
    };
    let depth = (0..=SAMPLES).take_while(hollow).last()? as f64 / SAMPLES as f64 * length;
    (rim > 0.0).then_some([depth, 2.0 * rim])
}

/// Whether the bat is of one piece, as far as the file tells.
fn one_piece(bat: &Bat) -> bool {
    let fixtures = bat.fixtures();
    fixtures.regions.is_empty() && fixtures.joints.is_empty()
}
