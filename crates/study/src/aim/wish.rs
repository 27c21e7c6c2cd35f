//! What does a person want of a bat?
//!
//! A [`Wish`] has targets, rules, limits of the diameter, and the changes that are allowed besides the shape.
//! [`Wish::bands`] turns its targets into allowed ranges of each answer, in SI, for the bat in hand.

use crate::aim::rules::{Rule, RuleSet};
use crate::answers::Answer;
use crate::engine::{
    Bat, Complaint, Error, INCH, Material, Quantity, Result, Weighed, inches, ounces, significant,
};

/// A quantity that can be a target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Goal {
    /// An answer of the bat.
    Answer(Answer),
    /// The drop: length in inches less mass in ounces.
    Drop,
}

/// A number in a wish.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Amount {
    /// In SI.
    Si(f64),
    /// A share of the bat's present value: 0.97 is 97 %.
    Share(f64),
    /// A place this far from the tip (m).
    FromTip(f64),
}

/// The wish for a goal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ask {
    /// A change of the present value, with an optional tolerance; a share is of the present value.
    Change(Amount, Option<Amount>),
    /// This value.
    Value(Amount, Option<Amount>),
    /// Between these, one of which may be missing.
    Between(Option<Amount>, Option<Amount>),
}

/// A target: a goal and the wish for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// The goal.
    pub goal: Goal,
    /// The wish for it.
    pub ask: Ask,
}

/// Limits of the diameter on a stretch (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiameterLimit {
    /// Where the stretch begins.
    pub from: f64,
    /// Where it ends; infinite for the tip.
    pub to: f64,
    /// Least diameter.
    pub at_least: Option<f64>,
    /// Greatest diameter.
    pub at_most: Option<f64>,
}

/// Allowed changes besides the shape.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FreeChoice {
    /// Length, from and to (m): every place on the bat moves with it.
    pub length: Option<[f64; 2]>,
    /// Density of the bat's own material, from and to (kg/m³), with unchanged moduli.
    pub density: Option<[f64; 2]>,
    /// Woods, of which the one that needs the least change is chosen.
    pub woods: Vec<Material>,
    /// Greatest weight on the knob (kg).
    pub knob_weight: Option<f64>,
}

/// All that is wished.
#[derive(Debug, Clone, PartialEq)]
pub struct Wish {
    /// Targets.
    pub targets: Vec<Target>,
    /// Rules of a game.
    pub rules: Option<RuleSet>,
    /// Whether wood may only be taken off.
    pub remove_only: bool,
    /// Whether wood may be added to a bat that was weighed: one that exists can only be cut.
    pub add: bool,
    /// Stretches that are kept (m).
    pub keep: Vec<[f64; 2]>,
    /// Limits of the diameter.
    pub diameter: Vec<DiameterLimit>,
    /// Distance between the written stations (m); `None` for 10 mm, or ½ in for a bat in inches.
    pub stations: Option<f64>,
    /// Step to which diameters are rounded (m); `None` for 0.1 mm, or 0.005 in for a bat in inches.
    pub round: Option<f64>,
    /// Greatest slope of the changed surface: radius over length.
    pub slope: Option<f64>,
    /// Allowed changes besides the shape.
    pub free: FreeChoice,
}

/// The grid of the new bat's stations and its rounding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Distance of the stations (m).
    pub every: f64,
    /// Step to which diameters are rounded (m).
    pub round: f64,
}

/// The allowed range of a goal, in SI, and its present value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// The goal.
    pub goal: Goal,
    /// Least value, which may be minus infinity.
    pub low: f64,
    /// Greatest value, which may be infinity.
    pub high: f64,
    /// The tolerance, in which a miss is measured.
    pub scale: f64,
    /// The present value.
    pub start: f64,
    /// The rule that it belongs to; `None` for a target.
    pub rule: Option<&'static str>,
}

/// The knob, which is kept by default (m).
pub const KNOB: [f64; 2] = [0.0, 0.03];

/// Slopes that a limit may have: radius over length.
pub const SLOPES: std::ops::RangeInclusive<f64> = 0.01..=10.0;

impl Default for Wish {
    fn default() -> Self {
        Self {
            targets: vec![],
            rules: None,
            remove_only: false,
            add: false,
            keep: vec![KNOB],
            diameter: vec![],
            stations: None,
            round: None,
            slope: None,
            free: FreeChoice::default(),
        }
    }
}

impl Goal {
    /// The goal of that name: an answer's, or `drop`.
    ///
    /// # Errors
    ///
    /// As [`Answer::named`].
    pub fn named(name: &str) -> Result<Self> {
        match name {
            "drop" => Ok(Self::Drop),
            name => Answer::named(name).map(Self::Answer),
        }
    }

    /// Its name.
    pub fn name(self) -> String {
        if self == Self::Drop { "drop".to_owned() } else { self.answer().name() }
    }

    /// Its unit in SI; empty for the drop and other pure numbers.
    pub fn unit(self) -> &'static str {
        if self == Self::Drop { "" } else { self.answer().unit() }
    }

    /// The quantity of the value; `None` for energies, accelerations and pure numbers, which have only SI units.
    pub fn quantity(self) -> Option<Quantity> {
        match self.unit() {
            "kg" => Some(Quantity::Mass),
            "m" => Some(Quantity::Length),
            "kg m²" => Some(Quantity::Inertia),
            "Hz" => Some(Quantity::Frequency),
            "m/s" => Some(Quantity::Speed),
            _ => None,
        }
    }

    /// Its value, from the underlying answer and the bat's length.
    pub fn of(self, answer: f64, length: f64) -> f64 {
        if self == Self::Drop { inches(length) - ounces(answer) } else { answer }
    }

    /// The answer it is made from.
    pub fn answer(self) -> Answer {
        if let Self::Answer(answer) = self { answer } else { Answer::Mass }
    }

    /// How much more it is where its answer is 1 more.
    pub fn slope(self) -> f64 {
        if self == Self::Drop { -ounces(1.0) } else { 1.0 }
    }

    /// The default tolerance of a target.
    pub fn tolerance(self, start: f64) -> f64 {
        const THOUSANDTH: f64 = 1e-3;
        match self.unit() {
            "kg" => 1e-3,
            "m" => 5e-4,
            "m/s" => 0.05,
            "" if self == Self::Drop => 0.05,
            "" => THOUSANDTH,
            _ => THOUSANDTH * start.abs().max(1e-6),
        }
    }
}

impl Amount {
    /// Its value in SI, for a bat with the present value `start` and that length (m).
    pub fn of(self, start: f64, length: f64) -> f64 {
        match self {
            Self::Si(value) => value,
            Self::Share(share) => share * start,
            Self::FromTip(from_tip) => length - from_tip,
        }
    }

    /// The size of a change or a tolerance.
    fn size(self, start: f64) -> f64 {
        match self {
            Self::Si(value) | Self::FromTip(value) => value,
            Self::Share(share) => share * start.abs(),
        }
    }
}

impl Target {
    /// The allowed range of the goal, for a bat with the present value `start` and that length (m).
    pub fn band(&self, start: f64, length: f64) -> Band {
        let tolerance = |within: Option<Amount>| {
            within.map_or_else(|| self.goal.tolerance(start), |within| within.size(start).abs())
        };
        let about = |value: f64, within: f64| (value - within, value + within, within);
        let (low, high, scale) = match self.ask {
            Ask::Change(by, within) => about(start + by.size(start), tolerance(within)),
            Ask::Value(value, within) => about(value.of(start, length), tolerance(within)),
            Ask::Between(low, high) => {
                let of = |amount: Option<Amount>, without: f64| {
                    amount.map_or(without, |amount| amount.of(start, length))
                };
                (of(low, f64::NEG_INFINITY), of(high, f64::INFINITY), tolerance(None))
            }
        };
        Band { goal: self.goal, low, high, scale, start, rule: None }
    }
}

impl Band {
    /// How far a value is outside, in tolerances; 0 inside.
    pub fn miss(&self, value: f64) -> f64 {
        let over = (value - self.high).max(self.low - value).max(0.0);
        // NaN must count as missed; `f64::max` would drop it.
        if value.is_finite() { over / self.scale } else { f64::INFINITY }
    }

    /// Whether a value is inside, apart from rounding.
    pub fn has(&self, value: f64) -> bool {
        self.miss(value) <= 1e-9
    }
}

impl Wish {
    /// This wish for a bat: a weighed bat exists, so wood is only taken off unless adding is allowed.
    pub fn of_bat(&self, bat: &Bat) -> Self {
        let exists = bat.weighed() != Weighed::default();
        Self { remove_only: self.remove_only || exists && !self.add, ..self.clone() }
    }

    /// Every goal of the wish: those of the targets, then those of the rules, each with its rule and the limit.
    pub fn goals(&self) -> Vec<(Goal, Option<(Rule, f64)>)> {
        let of_rule = |&(rule, limit): &(Rule, Option<f64>)| {
            let goal = match rule {
                Rule::MassAtMost => Goal::Answer(Answer::Mass),
                Rule::DropAtMost => Goal::Drop,
                Rule::BbcorAtMost => Goal::Answer(Answer::Bbcor),
                Rule::InertiaAtLeast => Goal::Answer(Answer::Inertia),
                _ => return None,
            };
            Some((goal, Some((rule, limit?))))
        };
        let rules = self.rules.iter().flat_map(|set| &set.rules).filter_map(of_rule);
        self.targets.iter().map(|target| (target.goal, None)).chain(rules).collect()
    }

    /// The grid of the new bat's stations.
    pub fn grid(&self, bat: &Bat) -> Grid {
        let (every, round) = if bat.inches() { (0.5 * INCH, 0.005 * INCH) } else { (0.01, 1e-4) };
        Grid { every: self.stations.unwrap_or(every), round: self.round.unwrap_or(round) }
    }

    /// The allowed range of each goal of [`Self::goals`], for a bat with these present values.
    ///
    /// # Errors
    ///
    /// [`Error::Value`], its field `targets[k]`, about targets that contradict each other or themselves.
    pub fn bands(&self, starts: &[f64], bat: &Bat) -> Result<Vec<Band>> {
        let length = bat.length();
        let goals = self.goals();
        let band = |(k, start): (usize, &f64)| match goals[k] {
            (goal, Some((rule, limit))) => {
                let (low, high) = match rule {
                    Rule::InertiaAtLeast => (limit, f64::INFINITY),
                    _ => (f64::NEG_INFINITY, limit),
                };
                let scale = goal.tolerance(*start);
                Band { goal, low, high, scale, start: *start, rule: Some(rule.name()) }
            }
            (..) => self.targets[k].band(*start, length),
        };
        let bands: Vec<Band> = starts.iter().enumerate().map(band).collect();
        for k in 0..self.targets.len() {
            self.check(k, &bands, bat)?;
        }
        Ok(bands)
    }

    /// Checks that target k is compatible with those before it.
    fn check(&self, k: usize, bands: &[Band], bat: &Bat) -> Result<()> {
        let (band, field) = (&bands[k], format!("targets[{k}]"));
        let said = |value: f64| shown(band.goal, value);
        if band.scale.is_nan() || band.scale <= 0.0 {
            let expected = "a tolerance above 0";
            return Err(Error::value(format!("{field}.within"), said(band.scale), expected));
        }
        if band.low > band.high {
            let found = format!("at least {} and at most {}", said(band.low), said(band.high));
            return Err(Error::value(field, found, "limits that leave something between them"));
        }
        // Masses, swing weights and frequencies are positive.
        let positive = matches!(band.goal.unit(), "kg" | "kg m²" | "Hz");
        if positive && band.high <= band.scale {
            let found = format!("{} {}", band.goal.name(), range(band));
            return Err(Error::value(field, found, "more than nothing"));
        }
        let same = bands[..k].iter().position(|other| other.goal == band.goal);
        let apart = |other: &Band| band.low > other.high || other.low > band.high;
        if let Some(other) = same.filter(|other| apart(&bands[*other])) {
            let found = format!("{}, {}", band.goal.name(), range(band));
            let expected = format!("what targets[{other}] leaves, {}", range(&bands[other]));
            return Err(Error::Value(Complaint::new(field, found, expected)));
        }
        let place = matches!(band.goal.unit(), "m");
        if place && (band.low > bat.length() || band.high < 0.0) {
            let expected = format!("a place on the bat, 0 to {}", said(bat.length()));
            return Err(Error::value(field, range(band), expected));
        }
        // If nothing can be added, the mass can only fall.
        let free = &self.free;
        let heavier =
            free.knob_weight.is_some() || free.density.is_some() || !free.woods.is_empty();
        let gains = matches!(band.goal, Goal::Answer(Answer::Mass | Answer::Inertia));
        if self.remove_only && gains && band.low > band.start && !heavier && free.length.is_none() {
            let found = format!("{} {}", band.goal.name(), range(band));
            let expected =
                format!("at most the {} that there is: wood is only taken off", said(band.start));
            let complaint = Complaint::new(field, found, expected);
            return Err(Error::Value(match bat.weighed() == Weighed::default() || self.add {
                true => complaint,
                false => complaint.hinted("a weighed bat is only cut; --add lets wood be added"),
            }));
        }
        Ok(())
    }
}

/// A value with its unit, also in units of the trade.
fn shown(goal: Goal, value: f64) -> String {
    let said = significant(value, 7);
    match goal.unit() {
        "kg" => format!("{said} kg ({} oz)", significant(ounces(value), 5)),
        "m" => format!("{said} m ({} in)", significant(inches(value), 5)),
        unit => format!("{said} {unit}").trim_end().to_owned(),
    }
}

/// The range of a band, in words.
fn range(band: &Band) -> String {
    let said = |value: f64| shown(band.goal, value);
    match (band.low.is_finite(), band.high.is_finite()) {
        (true, true) => format!("{} to {}", said(band.low), said(band.high)),
        (true, false) => format!("at least {}", said(band.low)),
        _ => format!("at most {}", said(band.high)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dowel() -> Bat {
        let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash",
            "profile": { "unit": "m", "x": [0, 0.8], "diameter": [0.04, 0.04] } }"#;
        Bat::from_text("dowel.json", text, "".as_ref()).unwrap()
    }

    fn mass(ask: Ask) -> Target {
        Target { goal: Goal::Answer(Answer::Mass), ask }
    }

    #[test]
    fn shares_changes_and_places_from_the_tip_are_what_they_say() {
        let less = mass(Ask::Change(Amount::Share(-0.03), Some(Amount::Si(0.001))));
        let band = less.band(1.0, 0.8);
        assert_eq!([band.low, band.high, band.scale], [0.969, 0.971, 0.001]);
        assert!(band.has(0.97) && !band.has(0.9715) && band.miss(f64::NAN).is_infinite());
        let most = mass(Ask::Between(None, Some(Amount::Share(0.995)))).band(2.0, 0.8);
        assert_eq!([most.low, most.high], [f64::NEG_INFINITY, 1.99]);
        let node = Goal::Answer(Answer::Node(1));
        let at =
            Target { goal: node, ask: Ask::Value(Amount::FromTip(0.1), Some(Amount::Si(0.01))) };
        let band = at.band(0.6, 0.8);
        assert!((band.low - 0.69).abs() < 1e-15 && (band.high - 0.71).abs() < 1e-15);
    }

    #[test]
    fn targets_that_contradict_are_told() {
        let wish = |targets: Vec<Target>, remove_only| {
            let wish = Wish { targets, remove_only, ..Wish::default() };
            let starts = vec![0.6; wish.targets.len()];
            wish.bands(&starts, &dowel()).unwrap_err().to_string()
        };
        let least = mass(Ask::Between(Some(Amount::Si(0.5)), None));
        let most = mass(Ask::Between(None, Some(Amount::Si(0.4))));
        assert!(
            wish(vec![least, most], false).starts_with("targets[1]: found mass_kg, at most 0.4")
        );
        let both = mass(Ask::Between(Some(Amount::Si(0.5)), Some(Amount::Si(0.4))));
        assert!(wish(vec![both], false).contains("leave something between"));
        let more = mass(Ask::Change(Amount::Si(0.1), None));
        assert!(wish(vec![more], true).contains("only taken off"));
        let none = mass(Ask::Change(Amount::Si(-0.1), Some(Amount::Si(0.0))));
        assert!(wish(vec![none], false).contains("a tolerance above 0"));
    }
}
