//! How much bats of one model differ: table, JSON, CSV, the bats.

use schemars::JsonSchema;
use serde::Serialize;

use crate::csv::Csv;
use crate::parts::{Cell, Columns, first, in_trade, lines, numbers, wrapped};
use crate::report::shares::{LITTLE, shares_of};
use crate::schema::{Written, document};
use sweetspot::Bat;
use sweetspot::base::number::{percent, significant};
use sweetspot::files::schema::document::BatName;
use sweetspot_study::many::indices::Indices;
use sweetspot_study::scatter::rows::ScatterRows;
use sweetspot_study::scatter::scattered::{
    InputSpread, OutputSpread, Percentile, ReasonCounted, SHARES, Scattered, WRITTEN,
};
use sweetspot_study::scatter::spreads::{Difference, Differs};

/// Number of reasons shown.
const REASONS: usize = 3;

/// The causes of the scatter of every output in words, 80 columns wide, with three percentiles; `full` gives all
/// percentiles and every share.
pub fn text(rows: &ScatterRows, found: &Scattered, full: bool) -> String {
    let (count, name) = (rows.count(), rows.bat.title());
    let said = format!("{count} bats like {name}, {} of them as accurate as asked", found.met);
    let mut out = wrapped(&said, 2);
    for ReasonCounted { reason, rows } in found.reasons.iter().take(REASONS) {
        out += &wrapped(&format!("  {rows}: {reason}"), 4);
    }
    let us = rows.bat.inches();
    if !full {
        out += &middle(&found.outputs, us);
    }
    for output in found.outputs.iter().filter(|_| full) {
        out += &spread(output, us);
    }
    for output in found.outputs.iter().filter(|_| full) {
        if let Some(indices) = &output.indices {
            out += &shares(&found.inputs, output, indices);
        }
    }
    out += "In words\n";
    words(found).iter().for_each(|line| out += &wrapped(&format!("  {line}"), 4));
    out
}

/// An output with its unit, and the number of these units per SI unit.
fn named(output: &OutputSpread, us: bool) -> (String, f64) {
    let (unit, per) = in_trade(output.unit, us);
    let unit = if unit.is_empty() { String::new() } else { format!(", in {unit}") };
    (format!("{}{unit}", output.name), per)
}

/// The error of a percentile.
fn error(one: &Percentile, per: f64) -> String {
    match one.error {
        None => "-".to_owned(),
        // Rounding of an output that does not vary.
        Some(error) if error <= 1e-12 * one.value.abs() => "0".to_owned(),
        Some(error) => significant(per * error, 2),
    }
}

/// The middle bat and the ends of the nine tenths about it, a row for every output.
fn middle(outputs: &[OutputSpread], us: bool) -> String {
    let at = |output: &OutputSpread, k: usize| output.percentiles.get(k).copied();
    let value = |output: &OutputSpread, k: usize| {
        let per = named(output, us).1;
        at(output, k).map_or("none".into(), |one| significant(per * one.value, 5))
    };
    let [low, half, high] = WRITTEN;
    lines(
        outputs,
        &[
            (first(36, ""), &|output| named(output, us).0),
            (numbers(11, "5 %"), &|output| value(output, low)),
            (numbers(11, "50 %"), &|output| value(output, half)),
            (numbers(9, "±"), &|output| {
                at(output, half).map_or(String::new(), |one| error(&one, named(output, us).1))
            }),
            (numbers(11, "95 %"), &|output| value(output, high)),
        ],
    )
}

fn spread(output: &OutputSpread, us: bool) -> String {
    let (name, per) = named(output, us);
    let heads = SHARES.map(|share| numbers(10, format!("{} %", significant(100.0 * share, 2))));
    let columns = Columns::new(std::iter::once(first(8, "")).chain(heads));
    let mut out = format!("{name}\n");
    if output.percentiles.is_empty() {
        return out + "  no bat has it\n";
    }
    out += &columns.heads();
    let row = |head: &str, of: &dyn Fn(&Percentile) -> String| {
        std::iter::once(head.to_owned())
            .chain(output.percentiles.iter().map(of))
            .collect::<Vec<_>>()
    };
    out += &columns.row(row("", &|one| significant(per * one.value, 5)));
    out + &columns.row(row("  ±", &|one| error(one, per)))
}

fn shares(inputs: &[InputSpread], output: &OutputSpread, indices: &Indices) -> String {
    let names: Vec<String> = inputs.iter().map(called).collect();
    let [told, _, rest] = shares_of(&names, indices, 0.0, "not explained by the surface");
    format!("What makes {} vary\n{told}{rest}", output.name)
}

/// An input, with the inputs it is conditioned on.
fn called(InputSpread { name, given, .. }: &InputSpread) -> String {
    match &given[..] {
        [] => (*name).to_owned(),
        given => format!("{name} given {}", given.join(", ")),
    }
}

/// One sentence for each output.
pub fn words(found: &Scattered) -> Vec<String> {
    let of = |output| sentence(&found.inputs, output);
    let mut all: Vec<String> = found.outputs.iter().filter_map(of).collect();
    let missing = found.missing.len() - found.answered;
    if missing > 0 {
        all.push(format!("{missing} bats have not every answer and were left out of the shares."));
    }
    all
}

/// "Of the spread of f1_hz, 93 % is youngs_modulus given density, 6 % density."
fn sentence(inputs: &[InputSpread], output: &OutputSpread) -> Option<String> {
    let Some(indices) = &output.indices else {
        let known = output.percentiles.first()?.value;
        let same =
            output.percentiles.iter().all(|one| (one.value - known).abs() <= 1e-8 * known.abs());
        return same.then(|| format!("{} is the same of all bats.", output.name));
    };
    let mut order: Vec<usize> = (0..indices.first.len()).collect();
    order.sort_by(|a, b| indices.first[*b].value.total_cmp(&indices.first[*a].value));
    let seen = order.into_iter().filter(|k| indices.first[*k].value >= LITTLE).take(3);
    let part = |(i, k): (usize, usize)| {
        let is = if i == 0 { " is" } else { "" };
        format!("{}{is} {}", percent(indices.first[k].value, 0), called(&inputs[k]))
    };
    let parts: Vec<String> = seen.enumerate().map(part).collect();
    (!parts.is_empty()).then(|| format!("Of the spread of {}, {}.", output.name, parts.join(", ")))
}

/// How much bats of one model and swings of one batter differ. SI units, named at the end of each member; positions
/// count from the knob end; a value that does not exist is null. Later versions with the same number may have more
/// members.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[schemars(title = "Result of a scatter of sweetspot, sweetspot-scatter-result/1")]
pub struct ScatterResult {
    /// The bat in the middle.
    pub bat: BatName,
    /// The results.
    #[serde(flatten)]
    pub found: Scattered,
    /// All results in sentences.
    pub words: Vec<String>,
}

document!(ScatterResult, "scatter-result");

/// The `sweetspot-scatter-result/1` document.
pub fn document(bat: &Bat, found: &Scattered) -> Written<ScatterResult> {
    Written::of(ScatterResult { bat: BatName::of(bat), found: found.clone(), words: words(found) })
}

/// Every row as a line of CSV: its number and scramble, its inputs (factors and amounts), its outputs, and the reason
/// where one is missing.
pub fn csv(rows: &ScatterRows, found: &Scattered) -> String {
    let all = &rows.plan.differences.all;
    let inputs = all.iter().map(|one| match one.what {
        Differs::Turned(_) => "turning_rms_m".to_owned(),
        what if what.unit().is_empty() => what.name().to_owned(),
        what => format!("{}_{}", what.name(), what.unit()),
    });
    let first = ["row", "scramble"].map(str::to_owned).into_iter();
    let outputs = found.outputs.iter().map(|output| output.name.clone());
    let mut table = Csv::new(first.chain(inputs).chain(outputs).chain(["error".to_owned()]));
    let each = found.points / found.scrambles;
    for (row, why) in found.missing.iter().enumerate() {
        let values = rows.values(row as u64);
        let mut cells: Vec<Cell> = vec![row.into(), (row / each as usize).into()];
        cells.extend((0..all.len()).map(|k| Cell::from(rows.told(&values, k))));
        cells.extend(found.outputs.iter().map(|output| Cell::from(output.values[row])));
        cells.push(why.clone().into());
        table.row(cells);
    }
    table.text()
}

/// The description of the bat of a row in its file: the percentile it is nearest to, and its inputs.
pub fn told(
    rows: &ScatterRows,
    found: &Scattered,
    (row, output): (usize, usize),
    share: f64,
) -> String {
    let values = rows.values(row as u64);
    let one = |(k, difference): (usize, &Difference)| {
        let value = significant(rows.told(&values, k), 6);
        match difference.what.unit() {
            "" => format!("{} {value}", difference.what.name()),
            unit => format!("{} {value} {unit}", difference.what.name()),
        }
    };
    let all: Vec<String> = rows.plan.differences.all.iter().enumerate().map(one).collect();
    let output = &found.outputs[output];
    let value = output.values[row].map_or(String::new(), |value| significant(value, 6));
    format!(
        "Row {row} of a scatter (sweetspot {}, {} points, seed {}), nearest to {} of {} ({value} {}): {}. \
         Swing, pitch, ball and place of the hit are no part of a bat file.",
        env!("CARGO_PKG_VERSION"),
        rows.count(),
        rows.plan.seed,
        percent(share, 0),
        output.name,
        output.unit,
        all.join(", ")
    )
}

/// The bat of a row with that source.
pub fn bat(bat: &Bat, source: &str, share: f64) -> Option<Bat> {
    let name = format!("{}, {}", bat.name(), percent(share, 0));
    let made = bat.with(|parts| {
        parts.name = name;
        parts.source = format!("{source} {}", parts.source).trim_end().to_owned();
    });
    made.ok()
}
