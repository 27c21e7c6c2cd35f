//! `sweetspot validate`: every known answer beside ours.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;

use sweetspot::base::error::{Complaint, Error, Result};
use sweetspot::base::file;
use sweetspot::base::number::significant;
use sweetspot::base::telling::Tell;
use sweetspot_proof::bundled::CASES;
use sweetspot_proof::hit_promise::{self, CheckedHit};
use sweetspot_proof::hoop_promise::{self, CheckedHoop};
use sweetspot_proof::promise::{self, CheckedBat, Summary};
use sweetspot_proof::proven_promise;
use sweetspot_proof::published::PublishedCase;
use sweetspot_proof::validation::{KnownNumber, run as run_case};
use sweetspot_report::hit_figure;
use sweetspot_report::parts::terminal::wrapped;
use sweetspot_report::proof_page;

use crate::done::{Done, FAILED};
use crate::full_option::FullArgs;
use crate::progress::Progress;
use crate::tables::{
    extremes_table, hit_promise_table, hoop_promise_table, promise_table, proven_promise_table,
};
use sweetspot_report::report::columns::{Columns, first, labels, numbers};

/// Every known answer beside ours
///
/// May I trust it? Published bats, measured and computed, and exact answers are computed anew and
/// set beside what is known, each with its tolerance; then stated errors are compared with true
/// ones on bats with exact frequencies. Printed are every miss and of each kind of number the one
/// nearest to its tolerance; with --full every number. The exit code is 1 if anything is missed.
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

    #[command(flatten)]
    full: FullArgs,

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
    let (mut out, mut screen) = (String::new(), String::new());
    let mut good = true;
    if !args.promise {
        let known = known_answers(args, &tell, &mut out)?;
        screen = misses(&known) + &counts(&known) + &kinds(&known);
        good = !known.iter().any(KnownNumber::missed);
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
        screen += &promises(&rows, &hits);
        if args.promise {
            let proven = proven_promise::rows(&tell)?;
            out.push('\n');
            out += &proven_promise_table::summary(&proven);
            good &= proven_promise_table::holds(&proven);
        }
        good &= Summary::of(&rows).holds() && hit_promise::Summary::of(&hits).holds();
    }
    let asked = args.summary || args.promise || !args.cases.is_empty();
    let text = if asked {
        out
    } else {
        args.full.screen(|full| if full { &out } else { &screen }.clone())
    };
    Ok(Done::new(text, if good { 0 } else { FAILED }))
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

/// Every known answer beside ours.
fn known_answers(args: &Args, tell: Tell, out: &mut String) -> Result<Vec<KnownNumber>> {
    let asked = |name: &str| args.cases.is_empty() || args.cases.iter().any(|case| case == name);
    let mut all = vec![];
    if args.summary {
        *out += &of_cases().heads();
    }
    for (k, (name, text)) in CASES.iter().enumerate().filter(|(_, (name, _))| asked(name)) {
        tell(k as f64 / CASES.len() as f64, name);
        let (case, rows) = run_case(name, text)?;
        if args.summary {
            let missed = rows.iter().filter(|row| row.missed()).count();
            let worst = rows.iter().map(KnownNumber::share).fold(0.0, f64::max);
            let [rows, missed] = [rows.len(), missed].map(|count| count.to_string());
            *out += &of_cases().row([name.to_string(), rows, missed, format!("{worst:.3}")]);
        } else {
            *out += &wrapped(&format!("{} ({name})", case.name), 2);
            *out += "  quantity                expected            got    error tolerance\n";
            rows.iter().for_each(|row| line(row, out));
            out.push('\n');
        }
        all.extend(rows);
    }
    *out += &counts(&all);
    Ok(all)
}

fn counts(all: &[KnownNumber]) -> String {
    let cases = all.chunk_by(|a, b| a.case == b.case).count();
    let information = all.iter().filter(|row| row.information).count();
    let misses = all.iter().filter(|row| row.missed()).count();
    let more = match information {
        0 => String::new(),
        shown => format!("; {shown} more for information"),
    };
    format!("{cases} cases, {} rows, {misses} missed{more}\n", all.len() - information)
}

fn misses(all: &[KnownNumber]) -> String {
    let mut out = String::new();
    for row in all.iter().filter(|row| row.missed()) {
        let _ = writeln!(out, "{}", row.case);
        line(row, &mut out);
    }
    out
}

/// The number nearest to its tolerance, of every kind.
fn kinds(all: &[KnownNumber]) -> String {
    let mut kinds: BTreeMap<String, Vec<&KnownNumber>> = BTreeMap::new();
    for row in all.iter().filter(|row| !row.information) {
        let mut kind = String::new();
        for c in row.quantity.chars() {
            match c.is_ascii_digit() || c == '.' {
                true if kind.ends_with('…') => {}
                number => kind.push(if number { '…' } else { c }),
            }
        }
        kinds.entry(kind).or_default().push(row);
    }
    let columns = Columns::new([
        first(20, "kind"),
        numbers(6, "rows"),
        numbers(23, "worst error/tolerance"),
        labels(29, "case"),
    ]);
    let mut out = columns.heads();
    for (kind, rows) in &kinds {
        let worst = rows.iter().max_by(|a, b| a.share().total_cmp(&b.share()));
        let Some(worst) = worst else { continue };
        let share = format!("{:.3}", worst.share());
        out += &columns.row([kind, &rows.len().to_string(), &share, &worst.case]);
    }
    out
}

/// The promise about stated errors: a sentence each where it is kept, else bat by bat.
fn promises(rows: &[CheckedBat], hits: &[CheckedHit]) -> String {
    let (all, struck) = (Summary::of(rows), hit_promise::Summary::of(hits));
    let mut out = match all.holds() {
        false => promise_table::summary(rows),
        true => wrapped(
            &format!(
                "Errors on bats with exact frequencies, true over stated, at most: frequencies {:.2}, nodes {:.2}, \
                 masses {:.2}; 3 is promised.",
                all.frequency_ratio, all.node_ratio, all.mass_ratio
            ),
            2,
        ),
    };
    out += &match struck.holds() {
        false => hit_promise_table::summary(hits),
        true => wrapped(
            &format!(
                "Errors of exit speeds on {} random hits, true over stated, at most: {:.2}.",
                struck.hits, struck.ratio
            ),
            2,
        ),
    };
    out
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
