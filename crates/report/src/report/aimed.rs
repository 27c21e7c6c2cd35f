//! The bat that meets a wish: its file, its document, its cut list.

use schemars::JsonSchema;
use serde::Serialize;

use crate::csv::Csv;
use crate::parts::{Quantity, Scale};
use crate::report::resolved::{profile, text_in_columns};
use crate::schema::{Written, document};
use sweetspot::Bat;
use sweetspot::base::number::{rounded, shortest, signed, significant};
use sweetspot::base::units::inches;
use sweetspot::files::schema::document::{BatName, Format};
use sweetspot::files::schema::resolved::ResolvedBat;
use sweetspot_study::aim::aimed::{AimedTarget, Outcome};
use sweetspot_study::aim::conflict::Conflict;
use sweetspot_study::aim::cuts::{StationCut, cuts};
use sweetspot_study::aim::rules::{Rule, Ruled};
use sweetspot_study::aim::wish::{Band, Goal};
use sweetspot_study::answers::Answer;
use sweetspot_study::files::rules_file;

/// A value of a goal with its unit, in one system of units.
pub fn shown(goal: Goal, value: f64, us: bool) -> String {
    if !value.is_finite() {
        return "none".to_owned();
    }
    let quantity = match goal {
        // As the trade writes it: three ounces fewer than inches are -3.
        Goal::Drop => return signed(-value, 2),
        goal => Quantity::in_si(goal.unit()),
    };
    let Some(quantity) = quantity else {
        return format!("{} {}", significant(value, 4), goal.unit()).trim_end().to_owned();
    };
    let usual = quantity.scale(us);
    let Scale { per, decimals, name } = match (quantity, us) {
        (Quantity::Length, true) | (Quantity::Inertia, false) | (Quantity::Frequency, _) => {
            usual.finer()
        }
        _ => usual,
    };
    format!("{:.decimals$} {name}", per * value)
}

/// The size of a difference of a goal's values, without a sign.
pub fn size(goal: Goal, value: f64, us: bool) -> String {
    match goal {
        Goal::Drop => shortest(rounded(value.abs(), 3)),
        goal => shown(goal, value.abs(), us),
    }
}

/// The name of a goal for people.
pub fn called(goal: Goal) -> String {
    match goal {
        Goal::Drop => "drop".to_owned(),
        Goal::Answer(answer) => match answer {
            Answer::Mass => "mass".to_owned(),
            Answer::Inertia => "swing weight".to_owned(),
            Answer::BalancePoint => "balance point".to_owned(),
            Answer::CenterOfPercussion => "centre of percussion".to_owned(),
            Answer::ExitSpeed => "best ball".to_owned(),
            Answer::ExitSpeedPlace => "sweet spot".to_owned(),
            Answer::Bbcor => "BBCOR".to_owned(),
            Answer::Frequency(order) => format!("frequency {order}"),
            Answer::Node(order) => format!("node of mode {order}"),
            other => other.name(),
        },
    }
}

/// The requirement of a band, in words.
pub fn asked(band: &Band, us: bool) -> String {
    let said = |value: f64| shown(band.goal, value, us);
    if band.goal == Goal::Drop && !(band.low.is_finite() && band.high.is_finite()) {
        // A limit on the drop is in ounces minus inches, without the sign.
        let (word, limit) =
            if band.high.is_finite() { ("at most", band.high) } else { ("at least", band.low) };
        return format!("{word} {} fewer", shortest(rounded(limit, 3)));
    }
    match (band.low.is_finite(), band.high.is_finite()) {
        (true, true) => {
            let (middle, half) = (0.5 * (band.low + band.high), 0.5 * (band.high - band.low));
            format!(
                "{} ± {}",
                said(middle),
                size(band.goal, half, us).split(' ').next().unwrap_or_default()
            )
        }
        (true, false) => format!("at least {}", said(band.low)),
        _ => format!("at most {}", said(band.high)),
    }
}

/// Whether every search for the members came to rest: another might meet them otherwise.
pub fn settled(conflict: &Conflict) -> bool {
    conflict.members.iter().all(|member| member.settled)
}

/// The contradictory targets, in words.
pub fn conflict_words(conflict: &Conflict, targets: &[AimedTarget], us: bool) -> String {
    let band = |k: usize| &targets[k].band;
    let wish = |k: usize| format!("{} {}", called(band(k).goal), asked(band(k), us));
    let reach = |k: usize, value: f64| {
        format!("{} comes to {}", called(band(k).goal), shown(band(k).goal, value, us))
    };
    match conflict.members.as_slice() {
        [] => "the search has not met the targets, though no smaller set of them was found that cannot be had"
            .to_owned(),
        members => {
            let all: Vec<String> = members.iter().map(|member| wish(member.target)).collect();
            let mut words = match members.len() {
                _ if !settled(conflict) => format!("{} not reached under these limits", all.join(" and ")),
                1 => format!("{} cannot be had under these limits", all[0]),
                2 => format!("{} cannot both be had", all.join(" and ")),
                _ => format!("{} cannot all be had", all.join(" and ")),
            };
            // Only values that a bat reaches while meeting the other targets.
            for member in members.iter().filter(|member| member.others_met) {
                let rest = members.iter().filter(|other| other.target != member.target);
                let rest: Vec<String> = rest.map(|other| wish(other.target)).collect();
                let with = match rest.is_empty() {
                    true => String::new(),
                    false => format!("with {}, ", rest.join(" and ")),
                };
                let sure = if member.settled { "at best" } else { "as far as was searched" };
                words += &format!("; {with}{} {sure}", reach(member.target, member.reaches.unwrap_or(f64::NAN)));
            }
            if !conflict.aside.is_empty() {
                let aside: Vec<String> = conflict.aside.iter().map(|k| wish(*k)).collect();
                words += &format!("; {} left aside there", aside.join(" and "));
            }
            if settled(conflict) {
                words += "; all this by changes with a knot every 5 cm: a sharper cut may do more";
            }
            words
        }
    }
}

/// The bat as a complete bat file, with its edits applied.
pub fn resolved(bat: &Bat, source: &str) -> ResolvedBat {
    ResolvedBat {
        format: Format::new(),
        name: bat.name().to_owned(),
        source: source.to_owned(),
        material: bat.material().clone(),
        profile: profile(bat.profile()),
        fixtures: bat.fixtures().clone(),
        weighed: None,
        edits: vec![],
    }
}

/// The source of the numbers of the new bat.
pub fn source(outcome: &Outcome) -> String {
    let wish = |of: &AimedTarget| format!("{} {}", called(of.band.goal), asked(&of.band, false));
    let wishes = outcome.targets.iter().map(wish);
    let wishes: Vec<String> = wishes.collect();
    format!(
        "{}, changed by sweetspot aim for: {}. Stations where it was changed are rounded to {} mm, with more digits \
         where the change runs out.",
        outcome.start.name(),
        wishes.join("; "),
        shortest(rounded(1e3 * outcome.grid.round, 6))
    )
}

/// The text of the new bat's file: columns in mm, or in inches as the old one.
pub fn bat_text(outcome: &Outcome) -> String {
    let bat = &outcome.bat;
    text_in_columns(&resolved(bat, &source(outcome)), &bat.profile().stations, bat.inches())
}

/// A warning before turning: a barrel forbidden by rules, with the rule.
pub fn warning(outcome: &Outcome, us: bool) -> Option<String> {
    let widest = outcome.widest();
    let shown = |value: f64| Quantity::Small.scale(us).text(value);
    // Requested rules have a separate table.
    let of_diameter = |ruled: &Ruled| ruled.rule == Rule::DiameterAtMost;
    if outcome.rules.as_ref().is_some_and(|set| set.limits.iter().any(of_diameter)) {
        return None;
    }
    let known = |name: &str| rules_file::named(name).ok();
    let games = [
        ("mlb", "rule 3.02 of Major League Baseball"),
        (
            "nfhs",
            "the high schools' (NFHS) and, but for wood, the \
        colleges' (NCAA) rule",
        ),
    ];
    let broken = games.iter().filter_map(|(name, game)| {
        let most = known(name)?.diameter();
        (widest > most + 1e-6).then(|| format!("{game} allows {}", shown(most)))
    });
    let broken: Vec<String> = broken.collect();
    (!broken.is_empty()).then(|| {
        format!(
            "the new bat is {} across: {}; --rules mlb, or that of another game, keeps to it",
            shown(widest),
            broken.join(", ")
        )
    })
}

/// The cut list as CSV: a line for each pass at each station, in mm and in inches. A line with pass 0 and a negative
/// cut means added wood.
pub fn cuts_csv(outcome: &Outcome, pass: f64) -> String {
    let mut table = Csv::new([
        "x_mm",
        "from_mm",
        "to_mm",
        "pass",
        "off_diameter_mm",
        "diameter_mm",
        "x_in",
        "from_in",
        "diameter_in",
    ]);
    let mm = |value: f64| rounded(1e3 * value, 6);
    let inch = |value: f64| rounded(inches(value), 6);
    for cut in cuts(&outcome.change, pass) {
        // Added wood gets pass 0 and a negative cut.
        let added = cut.adds().then(|| (0, cut.off()));
        let passes = cut.passes_m.iter().enumerate().map(|(k, off)| (k + 1, *off));
        for (number, off) in added.into_iter().chain(passes) {
            table.row([
                mm(cut.x_m).into(),
                mm(cut.from_m).into(),
                mm(cut.to_m).into(),
                number.into(),
                mm(off).into(),
                mm(cut.from_m - off).into(),
                inch(cut.x_m).into(),
                inch(cut.from_m).into(),
                inch(cut.from_m - off).into(),
            ]);
        }
    }
    table.text()
}

/// The smallest change of a bat that meets a wish, or comes nearest to it. Every value belongs to the new bat as it is
/// written, with rounded stations. Positions count from the knob end; a value that does not exist is null. Later
/// versions with the same number may have more members.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[schemars(title = "Aimed bat of sweetspot, sweetspot-aimed/1")]
pub struct AimedFile {
    /// The bat before the change.
    pub bat: BatName,
    /// Whether and how well the wish is met.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// The change at each station: how much to turn off, and where wood is added.
    pub cuts: Vec<StationCut>,
    /// Warnings before the bat is turned, for example of a barrel that a rule forbids; left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// The new bat as a complete bat file.
    pub new_bat: ResolvedBat,
}

document!(AimedFile, "aimed");

/// The `sweetspot-aimed/1` document; no pass of the lathe takes more than `pass` off the diameter (m).
pub fn document(outcome: &Outcome, pass: f64) -> Written<AimedFile> {
    let us = outcome.start.inches();
    let mut told = outcome.clone();
    if let Some(conflict) = &mut told.conflict {
        conflict.words = conflict_words(conflict, &outcome.targets, us);
    }
    Written::of(AimedFile {
        bat: BatName::of(&outcome.start),
        outcome: told,
        cuts: cuts(&outcome.change, pass),
        warnings: warning(outcome, us).into_iter().chain(outcome.rigid_wall.clone()).collect(),
        new_bat: resolved(&outcome.bat, &source(outcome)),
    })
}
