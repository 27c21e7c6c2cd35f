//! The bat that meets a wish, for people: 80 columns wide.

use std::fmt::Write;

use crate::parts::{
    Columns, Piece, Quantity, Units, counted, first, labels, lines, numbers, wrapped,
};
use crate::report::aimed::{asked, called, conflict_words, settled, shown, size, warning};
use sweetspot::base::number::{rounded, shortest, signed, significant};
use sweetspot::base::units::{inches, ounce_square_inches, ounces};
use sweetspot::bat::weighed::Weighed;
use sweetspot_study::aim::aimed::{AimedTarget, Choice, Outcome, Output};
use sweetspot_study::aim::bench::ExtraKind;
use sweetspot_study::aim::cuts::{StationCut, cuts};
use sweetspot_study::aim::rules::{Rule, Ruled, RulesKept};
use sweetspot_study::aim::wish::{Band, Goal};
use sweetspot_study::answers::Answer;

/// A section whose remaining strength is below this share is reported.
const WEAK: f64 = 0.5;
/// Stations of the cut list shown in full, and on a screen.
const SHOWN: [usize; 2] = [24, 3];
/// The answers that a screen compares before and after.
const FIRST: [Answer; 5] = [
    Answer::Mass,
    Answer::Inertia,
    Answer::Frequency(1),
    Answer::ExitSpeed,
    Answer::ExitSpeedPlace,
];

/// The whole text in one system of units; `full` adds all answers and more stations.
pub fn text(outcome: &Outcome, (pass, us, full): (f64, bool, bool)) -> [Piece; 5] {
    let mut out = head(outcome, us);
    out += &targets(outcome, us);
    if let Some(conflict) = &outcome.conflict {
        out +=
            &wrapped(&format!("Conflict: {}.", conflict_words(conflict, &outcome.targets, us)), 0);
        out += "\n";
    }
    let rules = outcome.rules.as_ref().map_or(String::new(), |set| of_rules(set, us));
    let cuts = cut_list(outcome, (pass, us), SHOWN[usize::from(!full)]);
    [
        (0, "", out),
        (2, "before and after", before_and_after(outcome, us, full)),
        (1, "rules", rules),
        (0, "", choices(outcome, us)),
        (3, "cuts", cuts),
    ]
    .map(|(when, name, text)| (when, name, if full { text } else { text.replace("\n\n", "\n") }))
}

/// A diameter, in the maker's unit.
fn across(value: f64, us: bool) -> String {
    Quantity::Small.scale(us).finer().text(value)
}

/// A place on the bat, in the maker's unit.
fn place(x: f64, us: bool) -> String {
    Quantity::Small.scale(us).text(x)
}

/// The verdict, the changes, and remarks.
fn head(outcome: &Outcome, us: bool) -> String {
    let limits = outcome.limits_broken_m > 0.0 || outcome.steeper_by.is_some_and(|by| by > 0.0);
    let verdict = match (outcome.targets_met(), outcome.broken_rules() > 0, limits) {
        (true, false, false) => "the new bat meets every target",
        (true, true, _) => "the new bat meets every target, but breaks a rule",
        (true, _, true) => "the new bat meets every target, but breaks a limit",
        _ if outcome.conflict.as_ref().is_some_and(settled) => {
            "the targets cannot all be had; the new bat comes nearest"
        }
        _ => "the new bat does not meet every target; it comes nearest",
    };
    let added = if outcome.largest_added_m > 1e-9 {
        format!("at most {} added", across(outcome.largest_added_m, us))
    } else {
        "nothing added".into()
    };
    let change = format!(
        "of its diameter at most {} off, {added}; norm of the change {}; {}, {}",
        across(outcome.largest_cut_m, us),
        Quantity::Small.scale(us).finer().finer().text(1e-3 * outcome.norm_mm),
        counted(outcome.iterations, "step"),
        counted(outcome.bats_solved, "bat")
    );
    let warning = warning(outcome, us).map(|line| format!("Warning: {line}"));
    let rigid = outcome.rigid_wall.as_ref().map(|why| format!("Left out: {why}"));
    let lines = [format!("{}: {verdict}", outcome.start.title()), change].into_iter();
    let lines = lines.chain(warning).chain(rigid).chain(to_know(outcome, us));
    lines.map(|line| wrapped(&line, 2)).collect::<String>() + "\n"
}

/// Remarks to the maker about the new bat and its limits.
fn to_know(outcome: &Outcome, us: bool) -> Vec<String> {
    let mut told = vec![];
    if outcome.remove_only && outcome.start.weighed() != Weighed::default() {
        told.push(
            "the bat was weighed, so that it exists: material is only taken off; --add lets it be added, for a new bat"
                .to_owned(),
        );
    }
    if outcome.finer > 1.0 {
        let round = match us {
            true => format!("{} in", significant(inches(outcome.grid.round), 2)),
            false => format!("{} mm", shortest(rounded(1e3 * outcome.grid.round, 9))),
        };
        told.push(format!("stations are rounded to {round}: coarser ones would miss a target"));
    }
    if let Some((x, left)) = outcome.weakest().filter(|(_, left)| *left < WEAK) {
        told.push(format!(
            "at {} the section has {} % of its strength in bending left: --diameter \"at least ...\" and --keep \
             set limits",
            place(x, us),
            significant(100.0 * left, 2)
        ));
    }
    if outcome.limits_broken_m > 0.0 {
        let by = Quantity::Small.about(Units::one(us), outcome.limits_broken_m);
        told.push(format!("a limit of the diameter is broken by {by}"));
    }
    if let Some((slope, by)) = outcome.slope.zip(outcome.steeper_by) {
        let kept = if by > 0.0 { format!("is broken by {by:.4}") } else { "is kept".to_owned() };
        told.push(format!("the limit {} of the slope {kept}", shortest(slope)));
    }
    if outcome.kept_within_m > 5e-8 {
        let by = Quantity::Small.about(Units::one(us), outcome.kept_within_m);
        told.push(format!(
            "where the bat is kept, the curve through its stations moves by {by} at most"
        ));
    }
    told
}

fn targets(outcome: &Outcome, us: bool) -> String {
    let columns = Columns::new([
        first(21, "Target"),
        labels(24, "asked"),
        labels(15, "before"),
        labels(14, "after"),
    ]);
    let mut out = columns.heads();
    for target in &outcome.targets {
        let band = &target.band;
        let name = match band.rule {
            Some(_) => format!("{} (rule)", called(band.goal)),
            None => called(band.goal),
        };
        out += &columns.row([
            name,
            asked(band, us),
            shown(band.goal, band.start, us),
            shown(band.goal, target.value(), us),
        ]);
        if !target.met {
            out += &format!("  missed by {}\n", missed_by(band, target.value(), us));
        }
    }
    // The search weighs other free choices too.
    let size = if outcome.free.is_empty() {
        "the norm"
    } else {
        "the size of all changes, free choices too,"
    };
    let priced: Vec<String> =
        outcome.targets.iter().filter_map(|target| priced(target, size, us)).collect();
    if !priced.is_empty() {
        out += &wrapped(&format!("Price: {}.", priced.join("; ")), 2);
    }
    out + "\n"
}

/// The amount by which a target is missed, with more digits where it is small.
fn missed_by(band: &Band, value: f64, us: bool) -> String {
    let limit = if value > band.high { band.high } else { band.low };
    let by = (value - limit).abs();
    match size(band.goal, by, us) {
        little if little == size(band.goal, 0.0, us) => {
            format!("{} {}", significant(by, 2), band.goal.unit()).trim_end().to_owned()
        }
        said => said,
    }
}

/// The cost of tightening a target that binds.
fn priced(AimedTarget { band, price, .. }: &AimedTarget, size: &str, us: bool) -> Option<String> {
    let price = price.filter(|price| *price > 0.0)?;
    let (step, words) = match (band.goal.unit(), us) {
        ("kg", false) => (1e-3, "1 g".to_owned()),
        ("kg", true) => (0.1 / ounces(1.0), "0.1 oz".to_owned()),
        ("m", false) => (1e-3, "1 mm".to_owned()),
        ("m", true) => (0.1 / inches(1.0), "0.1 in".to_owned()),
        ("kg m²", false) => (1e-3, "0.001 kg m²".to_owned()),
        ("kg m²", true) => (100.0 / ounce_square_inches(1.0), "100 oz in²".to_owned()),
        ("", _) => (0.1, "0.1".to_owned()),
        (unit, _) => (1.0, format!("1 {unit}")),
    };
    let cost = Quantity::Small.about(Units::one(us), 1e-3 * price * step);
    Some(format!("{words} more of the {} changes {size} by {cost}", called(band.goal)))
}

fn before_and_after(outcome: &Outcome, us: bool, full: bool) -> String {
    let goal = |of: &Output| Goal::Answer(of.answer);
    let said = |of: &Output, value: Option<f64>| {
        value.map_or("none".to_owned(), |value| shown(goal(of), value, us))
    };
    let change = |of: &Output| {
        of.start.zip(of.found).map_or(String::new(), |(a, b)| match of.answer {
            Answer::Node(_) | Answer::ExitSpeedPlace | Answer::BalancePoint => {
                let way = if b >= a { "outward" } else { "inward" };
                format!("{} {way}", across((b - a).abs(), us))
            }
            _ => format!("{} %", signed(100.0 * (b / a - 1.0), 2)),
        })
    };
    let outputs = outcome.outputs.iter().filter(|of| full || FIRST.contains(&of.answer));
    let out = lines(
        outputs,
        &[
            (first(21, "Before and after"), &|of| called(goal(of))),
            (labels(17, "before"), &|of| said(of, of.start)),
            (labels(17, "after"), &|of| said(of, of.found)),
            (labels(15, "change"), &change),
        ],
    );
    out + "\n"
}

fn of_rules(set: &RulesKept, us: bool) -> String {
    let mut out = wrapped(
        &format!("Rules: {} ({}, {}). Computed, not certified.", set.game, set.name, set.date),
        2,
    );
    let said = |ruled: &Ruled, value: Option<f64>| {
        value.map_or(String::new(), |value| of_rule(ruled.rule, value, us))
    };
    out += &lines(
        &set.limits,
        &[
            (first(24, ""), &|ruled| ruled.rule.name().replace('_', " ").replace("bbcor", "BBCOR")),
            (labels(18, "limit"), &|ruled| said(ruled, ruled.limit)),
            (labels(18, "this bat"), &|ruled| said(ruled, ruled.value)),
            (labels(10, ""), &|ruled| {
                ruled
                    .kept
                    .map_or("not known", |kept| if kept { "kept" } else { "broken" })
                    .to_owned()
            }),
        ],
    );
    for ask in &set.ask {
        out += &wrapped(&format!("  not computed: {ask}"), 4);
    }
    out + "\n"
}

/// A value of a rule.
fn of_rule(rule: Rule, value: f64, us: bool) -> String {
    let goal = match rule {
        Rule::BbcorAtMost => Goal::Answer(Answer::Bbcor),
        Rule::MassAtMost => Goal::Answer(Answer::Mass),
        Rule::InertiaAtLeast => Goal::Answer(Answer::Inertia),
        Rule::LengthAtMost => Goal::Answer(Answer::BalancePoint),
        Rule::DropAtMost => Goal::Drop,
        _ => return across(value, us),
    };
    shown(goal, value, us)
}

fn choices(outcome: &Outcome, us: bool) -> String {
    let mut out = outcome.wood.iter().map(|wood| format!("Wood: {wood}\n")).collect::<String>();
    for Choice { what, start, found } in &outcome.free {
        let answer = |answer| move |value| shown(Goal::Answer(answer), value, us);
        let (name, said): (_, &dyn Fn(f64) -> String) = match what {
            ExtraKind::Length => ("Length", &answer(Answer::BalancePoint)),
            ExtraKind::Density => ("Density", &|value| format!("{value:.1} kg/m³")),
            ExtraKind::KnobWeight => ("Weight on the knob", &answer(Answer::Mass)),
        };
        let _ = writeln!(out, "{name}: {}, was {}", said(*found), said(*start));
    }
    if out.is_empty() { out } else { out + "\n" }
}

fn cut_list(outcome: &Outcome, (pass, us): (f64, bool), most: usize) -> String {
    let every = cuts(&outcome.change, pass);
    // Changes that would be shown as zero.
    let least = if us { 1.27e-5 } else { 5e-6 };
    let (all, little): (Vec<StationCut>, Vec<StationCut>) =
        every.into_iter().partition(|cut| cut.off().abs() >= least);
    let mut out = String::new();
    let added = all.iter().filter(|cut| cut.adds()).count();
    if all.is_empty() {
        out += "Nothing is turned off.\n";
    } else {
        out += &cut_rows(&all, us, most);
    }
    if added > 0 {
        let line = format!(
            "Wood is added at {}: that is a bat to be turned anew, from a thicker billet. --remove-only only cuts.",
            counted(added, "station")
        );
        out += &wrapped(&line, 0);
    }
    if all.len() > most {
        let line =
            format!("{} stations in all; --cuts FILE writes every one with its passes.", all.len());
        out += &wrapped(&line, 0);
    }
    if !little.is_empty() {
        let line = format!(
            "{} more change by less than {}, as --cuts FILE has them.",
            counted(little.len(), "station"),
            if us { "0.0005 in" } else { "0.005 mm" }
        );
        out += &wrapped(&line, 0);
    }
    out
}

/// The rows shown: every second, third or later one where there are too many.
fn cut_rows(all: &[StationCut], us: bool, most: usize) -> String {
    let adds = all.iter().any(StationCut::adds);
    let by = |cut: &StationCut| match (adds, cut.adds()) {
        (false, _) => "",
        (true, true) => "+",
        (true, false) => "-",
    };
    let passes = |cut: &StationCut| match cut.passes_m.len() {
        0 => "wood added".to_owned(),
        1 => "one pass".to_owned(),
        count if count > 3 => format!("{count} passes"),
        _ => {
            let passes = cut.passes_m.iter().map(|off| across(cut.from_m - off, us));
            passes.collect::<Vec<_>>().join(", ")
        }
    };
    lines(
        all.iter().step_by(all.len().div_ceil(most)),
        &[
            (first(12, if adds { "Change at" } else { "Cut at" }), &|cut| place(cut.x_m, us)),
            (numbers(12, "from"), &|cut| across(cut.from_m, us)),
            (numbers(12, "to"), &|cut| across(cut.to_m, us)),
            (numbers(12, if adds { "change" } else { "off" }), &|cut| {
                format!("{}{}", by(cut), across(cut.off().abs(), us))
            }),
            (labels(26, "after each pass"), &passes),
        ],
    )
}
