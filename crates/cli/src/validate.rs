//! `sweetspot validate`: known answers compared with ours.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;

use sweetspot::base::error::Complaint;
use sweetspot::base::file;
use sweetspot::base::number::significant;
use sweetspot::base::telling::Tell;
use sweetspot::{Error, Result};
use sweetspot_proof::bundled::CASES;
use sweetspot_proof::hit_promise::{self, CheckedHit};
use sweetspot_proof::hoop_promise::{self, CheckedHoop};
use sweetspot_proof::promise::{self, CheckedBat, Summary};
use sweetspot_proof::proven_promise;
use sweetspot_proof::published::PublishedCase;
use sweetspot_proof::validation::{KnownNumber, run as run_case};
use sweetspot_report::parts::{Shown, first, labels, lines, numbers, wrapped};
use sweetspot_report::{hit_figure, proof_page};

use crate::done::{Done, FAILED};
use crate::help::commands;
use crate::output::{FullArgs, MANY, Screen};
use crate::progress::Progress;
use crate::tables;

/// Known answers compared with ours
///
/// Can you trust the program? It computes published bats, measured and computed, and exact answers, and compares each
/// with the known value and its tolerance. Then it compares stated errors with true ones on bats with exact
/// frequencies. It prints every miss, and for each kind of number the one closest to its tolerance; with --full every
/// number. The exit code is 1 if anything is missed.
#[derive(clap::Args)]
#[command(after_long_help = commands("validate"))]
pub struct Args {
    /// One line per case only
    #[arg(long)]
    summary: bool,

    /// Only the case of this name; may be repeated
    #[arg(long = "case", value_name = "NAME", value_parser = case)]
    cases: Vec<String>,

    /// Write the page docs/validation.md to this file (- = standard output)
    ///
    /// Published bats side by side, and the exact answers in one table; its picture r161_hit.svg is written beside it.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["summary", "cases"])]
    page: Option<PathBuf>,

    /// Only compare true and stated errors, a line per bat and tolerance
    #[arg(long, conflicts_with_all = ["summary", "cases", "page"])]
    promise: bool,

    /// Huge, tiny, thin and stepped bats, a million elements only
    #[arg(long, conflicts_with_all = ["summary", "cases", "page", "promise"])]
    extremes: bool,

    #[command(flatten)]
    said: FullArgs,
}

pub fn run(args: &Args) -> Result<Done> {
    let progress = Progress::new(args.said.quiet, "known answers");
    let tell = |share, what: &str| progress.say(share, what);
    if args.extremes {
        let (out, good) = tables::extremes(&tell);
        return Ok(Done::new(out, if good { 0 } else { FAILED }));
    }
    if let Some(path) = &args.page {
        return page(path, &tell);
    }
    // The known answers and their sum, every check of the promise, its tables, and what a screen has of all without options.
    let [mut known, mut sum, mut every, mut short, mut screen] = [const { String::new() }; 5];
    let mut good = true;
    if !args.promise {
        let numbers = known_answers(args, &tell, &mut known)?;
        sum = counts(&numbers);
        screen = misses(&numbers) + &sum + &kinds(&numbers);
        good = !numbers.iter().any(KnownNumber::missed);
    }
    if args.cases.is_empty() {
        let rows = promise::rows(&tell)?;
        let hits = hit_promise::rows(&tell)?;
        if args.promise {
            let hoops = hoop_promise::rows(&tell, hoop_promise::BARRELS)?;
            every = tables::beams(&rows) + &tables::hits(&hits) + &tables::hoops(&hoops);
            good &= hoops.iter().all(CheckedHoop::holds);
        } else {
            sum.push('\n');
        }
        short = tables::beams_in_short(&rows) + "\n" + &tables::hits_in_short(&hits);
        screen += &promises(&rows, &hits);
        if args.promise {
            let proven = proven_promise::rows(&tell)?;
            short += &format!("\n{}", tables::proven(&proven));
            good &= proven.iter().all(|row| row.broken == 0);
        }
        good &= Summary::of(&rows).holds() && hit_promise::Summary::of(&hits).holds();
    }
    let most = if args.cases.is_empty() { MANY } else { usize::MAX };
    let asked = args.summary || args.promise || !args.cases.is_empty();
    let text = args.said.screen(most, |full| match full || asked {
        true => Screen::from([
            (1, "cases", known.clone()),
            (0, "", sum.clone()),
            (3, "every solve, hit and barrel", every.clone()),
            (2, "the promise", short.clone()),
        ]),
        false => Screen::from(screen.clone()),
    });
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

/// Writes the page; returns the text for standard output.
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

/// A case by its file, its name, and its numbers.
type KnownCase = (&'static str, String, Vec<KnownNumber>);

/// Compares every known answer with ours.
fn known_answers(args: &Args, tell: Tell, out: &mut String) -> Result<Vec<KnownNumber>> {
    let asked = |name: &str| args.cases.is_empty() || args.cases.iter().any(|case| case == name);
    let mut cases: Vec<KnownCase> = vec![];
    for (k, (name, text)) in CASES.iter().enumerate().filter(|(_, (name, _))| asked(name)) {
        tell(k as f64 / CASES.len() as f64, name);
        let (case, rows) = run_case(name, text)?;
        cases.push((*name, case.name, rows));
    }
    if args.summary {
        let columns: &[Shown<KnownCase>] = &[
            (first(33, "case"), &|(name, ..)| (*name).to_owned()),
            (numbers(6, "rows"), &|(.., rows)| rows.len().to_string()),
            (numbers(8, "missed"), &|(.., rows)| {
                rows.iter().filter(|row| row.missed()).count().to_string()
            }),
            (numbers(23, "worst error/tolerance"), &|(.., rows)| {
                format!("{:.3}", rows.iter().map(KnownNumber::share).fold(0.0, f64::max))
            }),
        ];
        *out += &lines(&cases, columns);
    } else {
        for (name, title, rows) in &cases {
            *out += &wrapped(&format!("{title} ({name})"), 2);
            *out += "  quantity                expected            got    error tolerance\n";
            rows.iter().for_each(|row| line(row, out));
            out.push('\n');
        }
    }
    let all: Vec<KnownNumber> = cases.into_iter().flat_map(|(.., rows)| rows).collect();
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
    fn worst<'a>(rows: &[&'a KnownNumber]) -> Option<&'a KnownNumber> {
        rows.iter().copied().max_by(|a, b| a.share().total_cmp(&b.share()))
    }
    let columns: &[Shown<(String, Vec<&KnownNumber>)>] = &[
        (first(20, "kind"), &|(kind, _)| kind.clone()),
        (numbers(6, "rows"), &|(_, rows)| rows.len().to_string()),
        (numbers(23, "worst error/tolerance"), &|(_, rows)| {
            worst(rows).map_or(String::new(), |worst| format!("{:.3}", worst.share()))
        }),
        (labels(29, "case"), &|(_, rows)| {
            worst(rows).map_or(String::new(), |worst| worst.case.clone())
        }),
    ];
    lines(&kinds.into_iter().collect::<Vec<_>>(), columns)
}

/// The promise about stated errors: one sentence each if it is kept, otherwise bat by bat.
fn promises(rows: &[CheckedBat], hits: &[CheckedHit]) -> String {
    let (all, struck) = (Summary::of(rows), hit_promise::Summary::of(hits));
    let mut out = match all.holds() {
        false => tables::beams_in_short(rows),
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
        false => tables::hits_in_short(hits),
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
