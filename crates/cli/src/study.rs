//! `sweetspot study FILE`: many bats, one row each.

use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};

use sweetspot::base::error::Complaint;
use sweetspot::base::threads;
use sweetspot::{Error, Result};
use sweetspot_report::many::folder::StudyFolder;
use sweetspot_report::many::fresh;
use sweetspot_report::many::source::Study;
use sweetspot_report::many::summary::{self, answers, names, percentile, sorted};
use sweetspot_report::many::table::{NumberColumn, Table};
use sweetspot_report::plot::{Picture, many};
use sweetspot_study::files::study_rows::Rows;

use crate::common::{examples, note_outside};
use crate::done::{Done, NOT_REACHED};
use crate::output::{FullArgs, LINES, draw, warn};
use crate::progress::Counted;
use crate::style;

/// Many bats: varied inputs and the resulting outputs
///
/// A study names a bat, a ball and a scene, the values that vary (lists, grids, distributions, with correlations) and
/// the outputs for every bat. Each row is a bat, with its errors or the reason why it has no answer. Rows are written
/// in parts of 4096, or of 64 if walls of hollow barrels are solved. Each part depends only on the study and its
/// number: a study that is started again continues where it stopped.
#[derive(clap::Args)]
#[command(after_long_help = examples("study"))]
pub struct Args {
    /// Study file (JSON)
    study: PathBuf,

    /// Folder of the parts and their manifest, created if necessary
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    out: PathBuf,

    /// Also report what makes the answers vary: Sobol indices of first order and total, with their errors
    #[arg(long)]
    summary: bool,

    /// Numbers of every part also as a NumPy archive
    #[arg(long, help_heading = "Output")]
    npz: bool,

    /// Draw histograms, the causes of the variation, and scatter plots into this folder, as SVG and PNG
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    plots: Option<PathBuf>,

    /// Two columns to draw against each other, may be repeated [with --plots]
    #[arg(long, num_args = 2, value_names = ["X", "Y"], requires = "plots", help_heading = "Output")]
    scatter: Vec<String>,

    /// Number of threads [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=i64::from(threads::MOST)))]
    jobs: Option<u16>,

    /// Remove the parts that are in the folder, after asking, and make all anew
    #[arg(long, help_heading = "Output")]
    fresh: bool,

    /// Do not ask for confirmation [with --fresh]
    #[arg(long, requires = "fresh", help_heading = "Output")]
    yes: bool,

    #[command(flatten)]
    said: FullArgs,
}

pub fn run(args: &Args) -> Result<Done> {
    let (study, outside) = Study::named_by_a_person(&args.study)?;
    note_outside(&args.study, &outside, args.said.quiet);
    let rows = &study.rows;
    let pairs = pairs(rows, &args.scatter)?;
    if args.fresh {
        clear(&args.out, args.yes)?;
    }
    let folder = StudyFolder::open(&args.out, &study)?;
    // Before the work, which may take hours.
    rows.warnings().iter().for_each(|told| warn(&format!("warning: {told}"), false));
    let jobs = args.jobs.map(usize::from);
    let missing = threads::with(jobs, || folder.missing(args.npz))?;
    let division = folder.division();
    let left: u64 =
        missing.iter().map(|k| division.part(*k)).map(|rows| rows.end - rows.start).sum();
    let progress = Counted::new(args.said.quiet, "bats", division.rows, division.rows - left);
    let tell = |some| progress.more(some);
    threads::with(jobs, || folder.make(&missing, args.npz, &tell))?;
    drop(progress);
    let table = Table::read(&folder, rows)?;
    draw(&args.plots, args.said.quiet, || Ok(drawn(&table, rows, &pairs)))?;
    let said = summary::text(&table, rows);
    let shares = if args.summary { summary::shares(&table, rows) } else { String::new() };
    let text = args.said.screen(LINES, |_| [(1, "", said.clone()), (2, "shares", shares.clone())]);
    // A row without an answer is still a row; if all rows have none, nothing was reached.
    Ok(Done::new(style::table(&text), if table.met == 0 { NOT_REACHED } else { 0 }))
}

/// Removes the files of studies in a folder, if the person confirms.
fn clear(out: &Path, yes: bool) -> Result<()> {
    let files = fresh::files(out)?;
    if files.is_empty() {
        return Ok(());
    }
    let there = format!("{} files of a study in {}", files.len(), out.display());
    if !yes {
        let refused = |found: String| {
            let expected = "y to the question whether they may be removed, or --yes";
            let complaint = Complaint::new("--fresh", found, expected);
            Error::Value(complaint.hinted("nothing there was changed"))
        };
        if !std::io::stdin().is_terminal() || !std::io::stderr().is_terminal() {
            return Err(refused(format!("{there}, and no terminal for the question")));
        }
        let mut said = String::new();
        let mut errors = std::io::stderr();
        // If the question cannot be shown, there is no answer.
        let _ = write!(errors, "Remove {there}? [y/N] ").and_then(|()| errors.flush());
        let _ = std::io::stdin().read_line(&mut said);
        if !["y", "yes"].contains(&&*said.trim().to_lowercase()) {
            return Err(refused(format!("{there}, and no")));
        }
    }
    fresh::remove(&files)
}

/// The columns to draw against each other.
fn pairs(rows: &Rows, asked: &[String]) -> Result<Vec<[String; 2]>> {
    let columns = rows.columns();
    let known: Vec<&str> = rows.numbers().into_iter().map(|k| columns[k][0].as_str()).collect();
    if let Some(other) = asked.iter().find(|name| !known.contains(&name.as_str())) {
        let expected = format!("columns of numbers: {}", known.join(", "));
        let complaint = Complaint::new("--scatter", format!("\"{other}\""), expected);
        return Err(Error::Value(complaint.or_nearest(other, &known)));
    }
    Ok(asked.chunks_exact(2).map(|pair| [pair[0].clone(), pair[1].clone()]).collect())
}

fn drawn(table: &Table, rows: &Rows, pairs: &[[String; 2]]) -> Vec<Picture> {
    let varied = names(rows);
    let histogram = |column: &NumberColumn| {
        let values = sorted(column);
        let marks = [0.05, 0.5, 0.95].map(|share| percentile(&values, share).unwrap_or(f64::NAN));
        many::histogram(column, &values, marks)
    };
    let tornado = |column: &NumberColumn| {
        let indices = table.shares(rows, &column.name).ok()?;
        Some(many::tornado(&column.name, &varied, &indices))
    };
    let of_one = |column| [histogram(column), tornado(column)].into_iter().flatten();
    let scatter = |[a, b]: &[String; 2]| many::scatter(table.column(a)?, table.column(b)?);
    answers(table, rows).flat_map(of_one).chain(pairs.iter().filter_map(scatter)).collect()
}
