//! What do the rules of a game demand of a bat?
//!
//! A [`RuleSet`] is data with its source and date; a result computed from it certifies nothing.

use serde::{Serialize, Serializer};

use crate::engine::{Bat, STANDARD_PIVOT, inches, ounces};

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
    /// The rules.
    pub rules: Vec<Rule>,
    /// Further demands of the rules, which are not computed here.
    pub ask: Vec<String>,
}

/// A rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rule {
    /// Greatest diameter anywhere (m).
    DiameterAtMost(f64),
    /// Greatest length (m).
    LengthAtMost(f64),
    /// Greatest mass (kg).
    MassAtMost(f64),
    /// Greatest drop: length in inches less mass in ounces.
    DropAtMost(f64),
    /// Greatest BBCOR.
    BbcorAtMost(f64),
    /// Least moment of inertia about the point 6 in from the knob end (kg m²).
    InertiaAtLeast(f64),
    /// Greatest depth of a cup in the tip (m).
    CupDepthAtMost(f64),
    /// Least diameter of a cup (m).
    CupDiameterAtLeast(f64),
    /// Greatest diameter of a cup (m).
    CupDiameterAtMost(f64),
    /// The bat is one piece.
    OnePiece,
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

impl Serialize for Rule {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(self.name())
    }
}

impl Rule {
    /// Its name in a rule file.
    pub fn name(self) -> &'static str {
        match self {
            Self::DiameterAtMost(_) => "diameter_at_most",
            Self::LengthAtMost(_) => "length_at_most",
            Self::MassAtMost(_) => "mass_at_most",
            Self::DropAtMost(_) => "drop_at_most",
            Self::BbcorAtMost(_) => "bbcor_at_most",
            Self::InertiaAtLeast(_) => "inertia_at_least",
            Self::CupDepthAtMost(_) => "cup_depth_at_most",
            Self::CupDiameterAtLeast(_) => "cup_diameter_at_least",
            Self::CupDiameterAtMost(_) => "cup_diameter_at_most",
            Self::OnePiece => "one_piece",
        }
    }

    /// Its limit in SI; None where it has no number.
    pub fn limit(self) -> Option<f64> {
        match self {
            Self::DiameterAtMost(limit)
            | Self::LengthAtMost(limit)
            | Self::MassAtMost(limit)
            | Self::DropAtMost(limit)
            | Self::BbcorAtMost(limit)
            | Self::InertiaAtLeast(limit)
            | Self::CupDepthAtMost(limit)
            | Self::CupDiameterAtLeast(limit)
            | Self::CupDiameterAtMost(limit) => Some(limit),
            Self::OnePiece => None,
        }
    }
}

impl RuleSet {
    /// The greatest diameter that the rules allow (m), infinite without one.
    pub fn diameter(&self) -> f64 {
        let of = |rule: &Rule| match rule {
            Rule::DiameterAtMost(most) => *most,
            _ => f64::INFINITY,
        };
        self.rules.iter().map(of).fold(f64::INFINITY, f64::min)
    }

    /// The rules with the bat's value for each, and whether it is kept; `bbcor` is given.
    pub fn judged(&self, bat: &Bat, bbcor: Option<f64>) -> RulesKept {
        let widest = bat.profile().stations.outer.iter().fold(0.0_f64, |a, b| a.max(*b));
        let (body, hole) = (bat.inertia(), cup(bat));
        let of = |rule: &Rule| {
            let (rule, limit) = (*rule, rule.limit());
            let (value, most) = match rule {
                Rule::DiameterAtMost(_) => (Some(2.0 * widest), true),
                Rule::LengthAtMost(_) => (Some(bat.length()), true),
                Rule::MassAtMost(_) => (Some(body.mass), true),
                Rule::DropAtMost(_) => (Some(inches(bat.length()) - ounces(body.mass)), true),
                Rule::BbcorAtMost(_) => (bbcor, true),
                Rule::InertiaAtLeast(_) => (Some(body.about(STANDARD_PIVOT)), false),
                Rule::CupDepthAtMost(_) => (hole.map(|hole| hole[0]), true),
                Rule::CupDiameterAtLeast(_) => (hole.map(|hole| hole[1]), false),
                Rule::CupDiameterAtMost(_) => (hole.map(|hole| hole[1]), true),
                Rule::OnePiece => {
                    return Ruled { rule, limit, value: None, kept: Some(one_piece(bat)) };
                }
            };
            let bound = limit.unwrap_or(f64::INFINITY);
            let slack = 1e-9 * bound.abs().max(1.0);
            let kept = value
                .map(|value| if most { value <= bound + slack } else { value >= bound - slack });
            // A bat without a cup keeps every rule about cups.
            let of_cup = rule.name().starts_with("cup");
            Ruled {
                rule,
                limit,
                value,
                kept: if of_cup { Some(kept.unwrap_or(true)) } else { kept },
            }
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
