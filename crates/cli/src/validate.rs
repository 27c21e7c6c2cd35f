//! `sweetspot validate`: every known answer beside ours.

use std::fmt::Write;
use std::path::PathBuf;

use sweetspot::base::error::{Complaint, Error, Result};
use sweetspot::base::file;
use sweetspot::base::number::significant;
use sweetspot::base::telling::Tell;
use sweetspot_proof::bundled::CASES;
use sweetspot_proof::hit_promise;
use sweetspot_proof::hoop_promise::{self, CheckedHoop};
use sweetspot_proof::promise::{self, Summary};
use sweetspot_proof::proven_promise;
use sweetspot_proof::published::PublishedCase;
use sweetspot_proof::validation::{KnownNumber, run as run_case};
use sweetspot_report::hit_figure;
use sweetspot_report::parts::terminal::wrapped;
use sweetspot_report::proof_page;

use crate::done::{Done, FAILED};
use crate::progress::Progress;
use crate::tables::{
    extremes_table, hit_promise_table, hoop_promise_table, promise_table, proven_promise_table,
};
use sweetspot_report::report::columns::{Columns, first, numbers};

/// Every known answer beside ours
///
/// May I trust it? Published bats, measured and computed, and exact answers are computed anew and
/// set beside what is known, each with its tolerance; then stated errors are compared with true
/// ones on bats with exact frequencies. The exit code is 1 if anything is missed.
#[derive(clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// One line per case only
    #[arg(long)]
    summary: bool,

    /// This case only, by its name; may be given again
    #[arg(long = "case", value_name = "NAME", value_parser = case)]
    cases: Vec<String>,

    /// Write the page docs/validation.md to this file (- = standard output)
    ///
    /// Published bats side by side and the exact answers in one table; its picture r161_hit.svg is
    /// written beside it.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["summary", "cases"])]
    page: Option<PathBuf>,

    /// True beside stated errors only, a line per bat and tolerance
    #[arg(long, conflicts_with_all = ["summary", "cases", "page"])]
    promise: bool,

    /// Huge, tiny, thin and stepped bats, a million elements only
    #[arg(long, conflicts_with_all = ["summary", "cases", "page", "promise"])]
    extremes: bool,

    /// No progress on standard error
    #[arg(long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  sweetspot validate --summary
      a line for every case, and the promise about stated errors

  sweetspot validate --case r161_nathan_timoshenko --case torpedo_wolfish
      every number of two cases

  sweetspot validate --promise
      true beside stated errors, bat by bat and tolerance by tolerance";

pub fn run(args: &Args) -> Result<Done> {
    let progress = Progress::new(args.quiet, "known answers");
    let tell = |share, what: &str| progress.say(share, what);
    if args.extremes {
        let (out, good) = extremes_table::table(&tell);
        return Ok(Done::new(out, if good { 0 } else { FAILED }));
    }
    if let Some(path) = &args.page {
        return page(path, &tell);
    }
    let mut out = String::new();
    let mut good = true;
    if !args.promise {
        good &= known_answers(args, &tell, &mut out)?;
    }
    if args.cases.is_empty() {
        let rows = promise::rows(&tell)?;
        let hits = hit_promise::rows(&tell)?;
        out += if args.promise { "" } else { "\n" };
        if args.promise {
            out += &promise_table::table(&rows);
            out += &hit_promise_table::table(&hits);
            let hoops = hoop_promise::rows(&tell, hoop_promise::BARRELS)?;
            out += &hoop_promise_table::table(&hoops);
            good &= hoops.iter().all(CheckedHoop::holds);
        }
        out += &promise_table::summary(&rows);
        out.push('\n');
        out += &hit_promise_table::summary(&hits);
        if args.promise {
            let proven = proven_promise::rows(&tell)?;
            out.push('\n');
            out += &proven_promise_table::summary(&proven);
            good &= proven_promise_table::holds(&proven);
        }
        good &= Summary::of(&rows).holds() && hit_promise::Summary::of(&hits).holds();
    }
    Ok(Done::new(out, if good { 0 } else { FAILED }))
}

/// The name of a case that travels with the program.
fn case(name: &str) -> std::result::Result<String, Error> {
    let names: Vec<&str> = CASES.iter().map(|(known, _)| *known).collect();
    if names.contains(&name) {
        return Ok(name.to_owned());
    }
    let complaint = Complaint::new("--case", name, "a name of validation/");
    Err(Error::Value(complaint.or_nearest(name, &names)))
}

/// Writes the page; what is left for standard output.
fn page(path: &std::path::Path, tell: Tell) -> Result<Done> {
    let answers = PublishedCase::all(tell)?;
    let text = proof_page::text(&answers)?;
    let code = if answers.iter().any(PublishedCase::missed) { FAILED } else { 0 };
    if path.as_os_str() == "-" {
        return Ok(Done::new(text, code));
    }
    file::write(path, text.as_bytes())?;
    file::write(&path.with_file_name(hit_figure::FILE), hit_figure::svg()?.as_bytes())?;
    Ok(Done::new(wrapped(&proof_page::verdict(&answers), 0), code))
}

/// Every known answer beside ours; whether none is missed.
fn known_answers(args: &Args, tell: Tell, out: &mut String) -> Result<bool> {
    let asked = |name: &str| args.cases.is_empty() || args.cases.iter().any(|case| case == name);
    let (mut cases, mut counted, mut information, mut misses) = (0, 0, 0, 0);
    if args.summary {
        *out += &of_cases().heads();
    }
    for (k, (name, text)) in CASES.iter().enumerate().filter(|(_, (name, _))| asked(name)) {
        tell(k as f64 / CASES.len() as f64, name);
        let (case, rows) = run_case(name, text)?;
        let missed = rows.iter().filter(|row| row.missed()).count();
        let shown = rows.iter().filter(|row| row.information).count();
        cases += 1;
        counted += rows.len() - shown;
        information += shown;
        misses += missed;
        if args.summary {
            let worst = rows.iter().map(KnownNumber::share).fold(0.0, f64::max);
            let [rows, missed] = [rows.len(), missed].map(|count| count.to_string());
            *out += &of_cases().row([name.to_string(), rows, missed, format!("{worst:.3}")]);
        } else {
            *out += &wrapped(&format!("{} ({name})", case.name), 2);
            *out += "  quantity                expected            got    error tolerance\n";
            rows.iter().for_each(|row| line(row, out));
            out.push('\n');
        }
    }
    let _ = write!(out, "{cases} cases, {counted} rows, {misses} missed");
    if information > 0 {
        let _ = write!(out, "; {information} more for information");
    }
    out.push('\n');
    Ok(misses == 0)
}

fn of_cases() -> Columns {
    Columns::new([
        first(33, "case"),
        numbers(6, "rows"),
        numbers(8, "missed"),
        numbers(23, "worst error/tolerance"),
    ])
}

fn line(row: &KnownNumber, out: &mut String) {
    let (expected, found) = (significant(row.expected, 9), significant(row.found, 9));
    let _ = write!(out, "  {:<17} {expected:>14} {found:>14} {:>8.1e}", row.quantity, row.error);
    let _ = if row.information {
        writeln!(out, "  for information")
    } else {
        let sense = if row.relative { "rel" } else { "abs" };
        let verdict = if row.passes() { "ok" } else { "MISSED" };
        writeln!(out, " {:>8.1e} {sense}  {verdict}", row.tolerance)
    };
}
