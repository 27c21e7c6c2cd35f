//! The results of many bats, on one screen.

use std::fmt::Write;

use crate::many::table::{NumberColumn, Reason, Table};
use crate::parts::{first, labels, lines, numbers, wrapped};
use crate::report::shares::shares_of;
use sweetspot::base::number::significant;
use sweetspot_study::files::study_rows::Rows;
use sweetspot_study::files::study_vary::Varied;
use sweetspot_study::many::design::Axis;
use sweetspot_study::many::indices::Indices;

/// Number of reasons shown.
const REASONS: usize = 5;

/// The number of rows, the reasons for which some have no answer, and percentiles of every answer.
pub fn text(table: &Table, rows: &Rows) -> String {
    let mut out = format!("{} bats, {} of them as accurate as asked\n", table.rows, table.met);
    let mut reasons: Vec<&Reason> = table.reasons.values().collect();
    reasons.sort_by_key(|reason| (std::cmp::Reverse(reason.rows), reason.first));
    for Reason { rows, first, said } in reasons.iter().take(REASONS) {
        out += &wrapped(&format!("  {rows}, such as row {first}: {said}"), 4);
    }
    if reasons.len() > REASONS {
        let _ = writeln!(out, "  and {} other reasons", reasons.len() - REASONS);
    }
    let answers: Vec<_> = answers(table, rows).map(|column| (column, sorted(column))).collect();
    let at = |values: &[f64], share: f64| {
        percentile(values, share).map_or("-".to_owned(), |value| significant(value, 6))
    };
    out += &lines(
        &answers,
        &[
            (first(24, ""), &|(column, _)| column.name.clone()),
            (numbers(12, "5 %"), &|(_, values)| at(values, 0.05)),
            (numbers(12, "half"), &|(_, values)| at(values, 0.5)),
            (numbers(12, "95 %"), &|(_, values)| at(values, 0.95)),
            (labels(8, ""), &|(column, _)| column.unit.clone()),
        ],
    );
    if table.every > 1 {
        let _ = writeln!(out, "Percentiles of one row in {}", table.every);
    }
    out
}

/// What causes the variation of every answer, where that can be determined.
pub fn shares(table: &Table, rows: &Rows) -> String {
    let design = &rows.study.design;
    if rows.several() || design.combinations() > 1 || design.kinds().is_empty() {
        let here = match design.kinds().is_empty() {
            true => "here nothing is drawn",
            false => "here bats or lists differ too",
        };
        let why = format!(
            "What makes answers vary is told of one bat of which nothing varies but what is drawn \
             (uniform, normal, lognormal, triangular): {here}."
        );
        return format!("\n{}", wrapped(&why, 0));
    }
    let mut out = String::new();
    for column in answers(table, rows) {
        let name = &column.name;
        match table.shares(rows, name) {
            Ok(indices) => {
                let Indices { degree, rows: of, .. } = &indices;
                out += &format!("\nWhat makes {name} vary (degree {degree}, {of} rows)\n");
                let rest = "what no polynomial follows";
                out += &shares_of(&names(rows), &indices, f64::NEG_INFINITY, rest).concat();
            }
            Err(why) => out += &wrapped(&format!("\nWhat makes {name} vary is not told: {why}"), 0),
        }
    }
    out + &wrapped(
        "\nShares of the variance with one standard deviation of sampling; of numbers that depend on each \
         other the later one has only what the earlier ones do not explain.",
        0,
    )
}

/// The columns of the answers, without their errors.
pub fn answers<'a>(table: &'a Table, rows: &'a Rows) -> impl Iterator<Item = &'a NumberColumn> {
    rows.study.outputs.iter().filter_map(|name| table.column(name))
}

/// The names of the random inputs, in the order of the indices.
pub fn names(rows: &Rows) -> Vec<String> {
    let is_drawn = |varied: &&Varied| matches!(varied.axis(), Axis::Drawn(_));
    let drawn = rows.study.varied.iter().filter(is_drawn);
    drawn.map(|varied| varied.path.clone()).collect()
}

/// The numbers of a column, rising.
pub fn sorted(column: &NumberColumn) -> Vec<f64> {
    let mut values: Vec<f64> = column.values.iter().copied().filter(|v| v.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    values
}

/// The value below which a share of sorted values lies, linear between neighbours; None without values.
pub fn percentile(sorted: &[f64], share: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let place = share * last as f64;
    let below = place.floor() as usize;
    let above = (below + 1).min(last);
    Some(sorted[below] + (place - below as f64) * (sorted[above] - sorted[below]))
}
