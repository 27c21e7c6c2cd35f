//! `sweetspot validate`: every known answer beside ours.

use std::fmt::Write;

use sweetspot::error::Result;
use sweetspot::promise::{self, Summary};
use sweetspot::validation::{CASES, Row, run as run_case};

use crate::cli::{Done, FAILED, extremes_table, promise_table};

/// Every case under validation/ and the promise about errors, as tables; exit 1 if any fails
#[derive(clap::Args)]
pub struct Args {
    /// One line per case only
    #[arg(long)]
    summary: bool,

    /// The promise only: true beside stated errors, one line per bat and tolerance
    #[arg(long, conflicts_with = "summary")]
    promise: bool,

    /// The extremes only: huge, tiny, thin and stepped bats, a million elements
    #[arg(long, conflicts_with_all = ["summary", "promise"])]
    extremes: bool,
}

pub fn run(args: &Args) -> Result<Done> {
    if args.extremes {
        let (out, good) = extremes_table::table();
        return Ok((out, if good { 0 } else { FAILED }));
    }
    let mut out = String::new();
    let mut good = true;
    if !args.promise {
        good &= known_answers(args.summary, &mut out)?;
        out.push('\n');
    }
    let rows = promise::rows()?;
    if args.promise {
        out += &promise_table::table(&rows);
    }
    out += &promise_table::summary(&rows);
    good &= Summary::of(&rows).holds();
    Ok((out, if good { 0 } else { FAILED }))
}

/// Every known answer beside ours; whether none is missed.
fn known_answers(summary: bool, out: &mut String) -> Result<bool> {
    let (mut rows_in_all, mut misses) = (0, 0);
    if summary {
        *out += "case                          rows  missed  worst error/tolerance\n";
    }
    for (name, text) in CASES {
        let (case, rows) = run_case(name, text)?;
        let missed = rows.iter().filter(|row| !row.passes()).count();
        rows_in_all += rows.len();
        misses += missed;
        if summary {
            let worst = rows.iter().map(share).fold(0.0, f64::max);
            let _ = writeln!(out, "{name:<28} {:>5}  {missed:>6}  {worst:>8.3}", rows.len());
        } else {
            let _ = writeln!(out, "{} ({name})", case.name);
            *out += "  quantity                expected            got     error  tolerance\n";
            rows.iter().for_each(|row| line(row, out));
            out.push('\n');
        }
    }
    let _ = writeln!(out, "{} cases, {rows_in_all} rows, {misses} missed", CASES.len());
    Ok(misses == 0)
}

/// Error in units of the tolerance. A missing value is NaN, which a maximum would pass over.
fn share(row: &Row) -> f64 {
    let share = row.error / row.tolerance;
    if share.is_nan() { f64::INFINITY } else { share }
}

fn line(row: &Row, out: &mut String) {
    let _ = writeln!(
        out,
        "  {:<18} {:>13} {:>14}  {:>8.1e}  {:>8.1e} {}  {}",
        row.quantity,
        significant(row.expected),
        significant(row.found),
        row.error,
        row.tolerance,
        if row.relative { "rel" } else { "abs" },
        if row.passes() { "ok" } else { "MISSED" }
    );
}

/// The number with about nine significant digits.
fn significant(value: f64) -> String {
    let digits = 8 - value.abs().log10().floor().clamp(-8.0, 8.0) as i32;
    format!("{value:.*}", digits.max(0) as usize)
}
