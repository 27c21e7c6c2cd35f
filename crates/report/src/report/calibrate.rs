//! The wood of a bat: table, JSON, words.

use std::fmt::Write;

use schemars::JsonSchema;
use serde::Serialize;

use crate::csv;
use crate::parts::{Column, Piece, first, in_trade, labels, lines, numbers, wrapped};
use crate::schema::{Written, document};
use sweetspot::Bat;
use sweetspot::base::number::{percent, significant};
use sweetspot::files::schema::document::BatName;
use sweetspot_study::calibrate::calibration::{
    Calibration, Estimated, Property, Verdict, WithoutOutliers, contrary,
};
use sweetspot_study::calibrate::fit::{DatumKind, Residual};
use sweetspot_study::calibrate::next::Proposal;

/// Parameters, data and words, 80 columns wide.
pub fn text(bat: &Bat, found: &Calibration) -> [Piece; 3] {
    let above = format!("The material of {}\n{}", bat.title(), parameters(&found.parameters));
    let mut out = String::new();
    for tone in &found.loss_factors {
        let [lost, damped] = [tone.loss_factor, tone.damping_ratio].map(|v| significant(v, 3));
        let told = format!("dies out with a loss factor of {lost} (damping ratio {damped})");
        out += &format!("Mode {} {told}\n", tone.mode);
    }
    out += "In words\n";
    words(found).iter().for_each(|line| out += &wrapped(&format!("  {line}"), 4));
    [(0, "", above), (2, "readings", data(found, bat.inches())), (1, "words", out)]
}

fn parameters(all: &[Estimated]) -> String {
    lines(
        all,
        &[
            (first(14, "property"), &|one| short(one.property).to_owned()),
            (numbers(13, "value"), &|one| shown(one.property, one.value)),
            (numbers(13, "95 %"), &within),
            (numbers(13, "before"), &|one| shown(one.property, one.prior)),
            (numbers(8, "learned"), &|one| percent(one.learned.max(0.0), 0)),
            (labels(17, "the readings"), &verdict),
        ],
    )
}

/// The 95 % interval about the value, in per cent.
fn within(one: &Estimated) -> String {
    let [low, high] = one.interval95.map(|end| 100.0 * (end / one.value - 1.0));
    match format!("{:.1}", -low) == format!("{high:.1}") {
        true => format!("± {high:.1} %"),
        false => format!("{low:+.1}/{high:+.1} %"),
    }
}

fn data(found: &Calibration, us: bool) -> String {
    let mut out = format!(
        "Readings beside the bat of that wood: chi2 {} of {} data\n",
        significant(found.chi2, 3),
        found.expected
    );
    let sd = |value: f64| format!("{value:+.1} sd");
    // The name in the unit of the bat's file, and the number of these units per SI unit.
    let named = |one: &Residual| {
        let name = one.datum.kind.name();
        let ending = ["_kg_m2", "_kg", "_m"].into_iter().find(|ending| name.ends_with(ending));
        ending.filter(|_| us).map_or((name.clone(), 1.0), |ending| {
            let (unit, per) = in_trade(&ending[1..], us);
            (format!("{}, {unit}", name.trim_end_matches(ending)), per)
        })
    };
    out += &lines(
        &found.data,
        &[
            (first(18, "reading"), &|one| named(one).0),
            (numbers(10, "measured"), &|one| significant(named(one).1 * one.datum.measured, 5)),
            (numbers(10, "computed"), &|one| significant(named(one).1 * one.computed, 5)),
            (numbers(11, "off by"), &|one| sd(one.residual_sd)),
            (numbers(10, "left out"), &|one| sd(one.left_out_sd)),
            (labels(16, ""), &|one| if one.is_outlier() { "does not fit" } else { "" }.to_owned()),
        ],
    );
    let labelled = found.labels.lines_hz.iter().zip(&found.labels.taken);
    for (hz, _) in labelled.filter(|(_, label)| label.is_none()) {
        let hz = significant(*hz, 5);
        let _ = writeln!(out, "{hz} Hz is no bending mode of this bat");
    }
    out
}

/// The name of a parameter in a table.
pub fn short(property: Property) -> &'static str {
    match property {
        Property::YoungsModulus => "E",
        Property::ShearModulus => "G",
        Property::Density => "density",
        Property::BarrelDensity => "barrel density",
        Property::ModulusRatio => "E ratio",
    }
}

/// A value in the unit that people use.
pub fn shown(property: Property, value: f64) -> String {
    match property {
        Property::YoungsModulus => format!("{:.2} GPa", 1e-9 * value),
        Property::ShearModulus => format!("{:.3} GPa", 1e-9 * value),
        Property::Density | Property::BarrelDensity => format!("{value:.1} kg/m³"),
        Property::ModulusRatio => format!("{value:.3}"),
    }
}

fn verdict(one: &Estimated) -> String {
    match one.verdict {
        Verdict::Determined => "determine it".to_owned(),
        Verdict::Partly => "say it in part".to_owned(),
        Verdict::OnlyTogether => {
            let with = one.correlated_with.map_or("another", short);
            format!("only with {with}")
        }
        Verdict::NotDetermined => "do not say it".to_owned(),
        Verdict::Held => "held as exact".to_owned(),
    }
}

/// The conclusions, one sentence each.
pub fn words(found: &Calibration) -> Vec<String> {
    let mut all = vec![];
    all.extend(labelled(found));
    all.extend(mismatch(found));
    all.extend(contrary(&found.readings.ring_down).map(|(mode, ends)| {
        let [least, largest] = ends.map(|loss| significant(loss, 3));
        format!("The loss factors of mode {mode}, {least} to {largest}, contradict each other: count again.")
    }));
    all.extend(found.parameters.iter().filter_map(|one| foreign(found, one)));
    if found.typical_shear {
        all.push(
            "The bat file has no shear modulus: one that is typical of the kind was the start."
                .to_owned(),
        );
    }
    for one in found.parameters.iter().filter(|one| one.verdict == Verdict::OnlyTogether) {
        let Some((other, r)) = one.correlated_with.zip(one.correlation) else { continue };
        let sign = if r > 0.0 { "quotient" } else { "product" };
        all.push(format!(
            "{} and {} are known only together (correlation {r:.2}): the readings say a {sign}.",
            short(one.property),
            short(other)
        ));
    }
    let silent = |one: &&Estimated| one.verdict == Verdict::NotDetermined;
    let name = |one: &Estimated| match one.property {
        // G is proportional to E: their ratio is estimated.
        Property::ShearModulus => "G over E",
        other => short(other),
    };
    let silent: Vec<&str> = found.parameters.iter().filter(silent).map(name).collect();
    if !silent.is_empty() {
        all.push(format!(
            "Of {} the readings say nothing: what stands there is what was taken for known before.",
            silent.join(" and ")
        ));
    }
    all.push(advice(found));
    all
}

fn list(labels: &[Option<usize>]) -> String {
    let one = |label: &Option<usize>| label.map_or("none".to_owned(), |mode| mode.to_string());
    labels.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// The assignment of labels, where it was sought.
fn labelled(found: &Calibration) -> Vec<String> {
    let identified = &found.labels;
    let mut all = vec![];
    if let Some((told, chi2)) = identified.told.as_ref().zip(identified.told_chi2) {
        let changed = |k: &usize| {
            let name =
                |label: Option<usize>| label.map_or("no mode".to_owned(), |m| format!("mode {m}"));
            format!(
                "{} Hz was told as {} and fits as {}",
                identified.lines_hz[*k],
                name(told[*k]),
                name(identified.taken[*k])
            )
        };
        let changed: Vec<String> = identified.changed().iter().map(changed).collect();
        all.push(format!(
            "As modes {} the lines do not fit this bat in any wood (chi2 {}). {}: the wood above is that of \
             these labels.",
            list(told),
            significant(chi2, 3),
            changed.join("; ")
        ));
    } else if found.readings.lines.iter().any(|line| line.mode.is_none()) {
        let taken = match identified.taken.len() {
            1 => "line was taken for mode",
            _ => "lines were taken for modes",
        };
        all.push(format!("The {taken} {}.", list(&identified.taken)));
    }
    if let Some((labels, margin)) = identified.second.as_ref().zip(identified.margin) {
        let unsure = if identified.is_sure() {
            ""
        } else {
            " They may be the right ones, with another wood: tell the mode of a line that you know (\"mode\", or --mode \"HZ = N\")."
        };
        all.push(format!(
            "The next best labels are {}, with a chi2 that is {} larger.{unsure}",
            list(labels),
            significant(margin, 3)
        ));
    }
    if identified.is_mostly_discarded() {
        all.push(
            "Half of what was measured or more is no bending mode of this bat, of wood from a quarter to four times \
             as stiff as the file's: the wood above rests on what is left, and may be wrong. The profile, the \
             readings or their unit are others than was told."
                .to_owned(),
        );
    }
    all
}

/// A wood that differs from the one named in the file.
fn foreign(found: &Calibration, one: &Estimated) -> Option<String> {
    let times = one.foreign()?;
    let kind = found.material.as_deref().unwrap_or("the file's material");
    let what = match one.property {
        Property::Density => {
            "the wall is thicker than the file says, or something inside weighs that is not in it"
        }
        _ => "the bat is of another material, or its profile or a reading is wrong",
    };
    Some(format!(
        "{} of {} is {} times that of {kind} ({}), more than pieces of one material differ by: {what}.",
        match one.property {
            Property::Density => "A density",
            _ => "E",
        },
        shown(one.property, one.value),
        significant(times, 3),
        shown(one.property, one.prior)
    ))
}

fn mismatch(found: &Calibration) -> Option<String> {
    if found.readings_agree {
        return None;
    }
    let name = |residual: &Residual| {
        format!("{} ({:+.1} sd)", residual.datum.kind.name(), residual.left_out_sd)
    };
    let outliers = found.data.iter().filter(|residual| residual.is_outlier());
    let outliers: Vec<String> = outliers.map(name).collect();
    let which = match outliers.is_empty() {
        true => "No one reading stands out".to_owned(),
        false => format!("Beside all others these are far off: {}", outliers.join(", ")),
    };
    let without = found.without_outliers.as_ref().map_or(String::new(), |without| {
        let WithoutOutliers { chi2, expected, .. } = without;
        format!(" Without them chi2 is {} of {expected}.", significant(*chi2, 3))
    });
    Some(format!(
        "The readings do not fit this bat: errors would have to be {} times larger. {which}: the \
         profile, the label or the reading is another one than the file says, and no material mends \
         that.{without}",
        significant(found.errors_larger_by, 2)
    ))
}

/// The name of a datum in a sentence.
fn called(kind: DatumKind) -> String {
    match kind {
        DatumKind::Mass => "the mass".to_owned(),
        DatumKind::BalancePoint => "the balance point".to_owned(),
        DatumKind::Period => "the period as a pendulum".to_owned(),
        DatumKind::Frequency(order) => format!("the frequency of mode {order}"),
    }
}

/// The measurement to make next.
fn advice(found: &Calibration) -> String {
    match found.advice() {
        Some((least, Proposal { kind, .. }, factor)) if factor < 0.95 => format!(
            "Measure {} next: of all that is missing it tells most of {}, whose interval it would \
             make {} times as wide.",
            called(*kind),
            short(least.property),
            significant(factor, 2)
        ),
        _ => "No further measurement of these kinds would tell much more.".to_owned(),
    }
}

/// The wood of a bat by the measurements, and how well they determine it. SI units, named at the end of each member;
/// positions count from the knob end; a value that does not exist is null. Later versions with the same number may have
/// more members.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[schemars(title = "Calibration of sweetspot, sweetspot-calibrate/1")]
pub struct CalibrateFile {
    /// The bat.
    pub bat: BatName,
    /// The results.
    #[serde(flatten)]
    pub found: Calibration,
    /// The measurement to make next, in words.
    pub advice: String,
    /// All results in sentences.
    pub words: Vec<String>,
}

document!(CalibrateFile, "calibrate");

/// The `sweetspot-calibrate/1` document.
pub fn document(bat: &Bat, found: &Calibration) -> Written<CalibrateFile> {
    Written::of(CalibrateFile {
        bat: BatName::of(bat),
        found: found.clone(),
        advice: advice(found),
        words: words(found),
    })
}

/// The columns of the parameters in files.
const COLUMNS: [Column<Estimated>; 9] = [
    Column::in_files("name", |one| one.property.name().into()),
    Column::in_files("unit", |one| one.unit.into()),
    Column::in_files("value", |one| one.value.into()),
    Column::in_files("low95", |one| one.interval95[0].into()),
    Column::in_files("high95", |one| one.interval95[1].into()),
    Column::in_files("relative_sd", |one| one.relative_sd.into()),
    Column::in_files("prior", |one| one.prior.into()),
    Column::in_files("prior_relative_sd", |one| one.prior_relative_sd.into()),
    Column::in_files("learned", |one| one.learned.into()),
];

/// Every parameter as a line of CSV.
pub fn csv(found: &Calibration) -> String {
    csv::rows(&COLUMNS, &found.parameters)
}
