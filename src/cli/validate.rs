//! `sweetspot validate`: every known answer beside ours.

use std::fmt::Write;

use sweetspot::error::Result;
use sweetspot::validation::{CASES, Row, run as run_case};

use crate::cli::{Done, FAILED};

/// Every case under validation/, as a table; exit 1 if any misses its tolerance
#[derive(clap::Args)]
pub struct Args {
    /// One line per case only
    #[arg(long)]
    summary: bool,
}

pub fn run(args: &Args) -> Result<Done> {
    let (mut out, mut rows_in_all, mut misses) = (String::new(), 0, 0);
    if args.summary {
        out += "case                          rows  missed  worst error/tolerance\n";
    }
    for (name, text) in CASES {
        let (case, rows) = run_case(name, text)?;
        let missed = rows.iter().filter(|row| !row.passes()).count();
        rows_in_all += rows.len();
        misses += missed;
        if args.summary {
            // A missing value is NaN, which a maximum would pass over.
            let share = |row: &Row| {
                let share = row.error / row.tolerance;
                if share.is_nan() { f64::INFINITY } else { share }
            };
            let worst = rows.iter().map(share).fold(0.0, f64::max);
            let _ = writeln!(out, "{name:<28} {:>5}  {missed:>6}  {worst:>8.3}", rows.len());
            continue;
        }
        let _ = writeln!(out, "{} ({name})", case.name);
        out += "  quantity                expected            got     error  tolerance\n";
        for row in &rows {
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
        out.push('\n');
    }
    let _ = writeln!(out, "{} cases, {rows_in_all} rows, {misses} missed", CASES.len());
    Ok((out, if misses > 0 { FAILED } else { 0 }))
}

/// The number with about nine significant digits.
fn significant(value: f64) -> String {
    let digits = 8 - value.abs().log10().floor().clamp(-8.0, 8.0) as i32;
    format!("{value:.*}", digits.max(0) as usize)
}
