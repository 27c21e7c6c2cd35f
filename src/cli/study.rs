//! `sweetspot study FILE`: many bats, one row each.

use std::path::PathBuf;
use std::time::Instant;

use crate::base::error::{Complaint, Error, Result};
use crate::base::threads;
use crate::files::study_rows::Rows;
use crate::show::many::folder::StudyFolder;
use crate::show::many::source::Study;
use crate::show::many::summary::{self, answers, names, percentile, sorted};
use crate::show::many::table::{Column, Table};
use crate::show::plot::many;
use crate::show::plot::picture::Picture;

use crate::cli::common::{examples, note_outside};
use crate::cli::done::{Done, NOT_REACHED, warn};
use crate::cli::pictures;
use crate::cli::progress::Progress;
use crate::cli::style;

/// Many bats: what varies from bat to bat, and what comes of it
///
/// A study names a bat, a ball and a scene, what of them varies (lists, grids, distributions, with
/// correlations) and what is asked of every bat. Each row is a bat, with its errors or the reason why there is
/// no answer. Rows are written in parts of 4096, each a function of the study and its number alone: started
/// again, it goes on where it was.
#[derive(clap::Args)]
#[command(after_long_help = examples(EXAMPLES))]
pub struct Args {
    /// Study file (JSON)
    study: PathBuf,

    /// Folder of the parts and their manifest, made if it is not there
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    out: PathBuf,

    /// Say also what makes the answers vary: Sobol indices of first order and total, with their errors
    #[arg(long)]
    summary: bool,

    /// Numbers of every part also as a NumPy archive
    #[arg(long, help_heading = "Output")]
    npz: bool,

    /// Draw histograms, what makes answers vary, and scatters into this folder, as SVG and PNG
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    plots: Option<PathBuf>,

    /// Two columns to draw against each other, may be repeated [with --plots]
    #[arg(long, num_args = 2, value_names = ["X", "Y"], requires = "plots", help_heading = "Output")]
    scatter: Vec<String>,

    /// Threads [default: as many as there are processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,

    /// No progress on standard error
    #[arg(long, help_heading = "Output")]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  sweetspot study scatter.json --out scatter
      the bats of scatter.json, in parts in the folder scatter
  sweetspot study scatter.json --out scatter --summary --plots scatter/plots
      what makes the answers vary, with pictures; rows that are there stay";

pub fn run(args: &Args) -> Result<Done> {
    let (study, outside) = Study::named_by_a_person(&args.study)?;
    note_outside(&args.study, &outside, args.quiet);
    let rows = &study.rows;
    let pairs = pairs(rows, &args.scatter)?;
    let folder = StudyFolder::open(&args.out, &study)?;
    // Before the work, which may take hours.
    rows.warnings().iter().for_each(|warning| warn(warning));
    let count = rows.count();
    let progress = Progress::new(args.quiet, "bats");
    let (begun, before) = (Instant::now(), folder.made());
    let tell = |done: u64| {
        let rate = done.saturating_sub(before) as f64 / begun.elapsed().as_secs_f64();
        progress.say(
            done as f64 / count as f64,
            &format!("{done} of {count} bats, {rate:.0} a second"),
        );
    };
    let make = || (0..folder.parts()).try_for_each(|k| folder.make(k, args.npz, &tell));
    threads::with(args.jobs.map(usize::from), make)?;
    drop(progress);
    let table = Table::read(&folder, rows)?;
    if let Some(folder) = &args.plots {
        pictures::write(folder, &drawn(&table, rows, &pairs), args.quiet)?;
    }
    let mut text = summary::text(&table, rows);
    if args.summary {
        text += &summary::shares(&table, rows);
    }
    // A row without an answer is a row; where all are, nothing that was asked was reached.
    Ok(Done::new(style::table(&text), if table.met == 0 { NOT_REACHED } else { 0 }))
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
    let histogram = |column: &Column| {
        let values = sorted(column);
        let marks = [0.05, 0.5, 0.95].map(|share| percentile(&values, share).unwrap_or(f64::NAN));
        many::histogram(column, &values, marks)
    };
    let tornado = |column: &Column| {
        let indices = table.shares(rows, &column.name).ok()?;
        Some(many::tornado(&column.name, &varied, &indices))
    };
    let of_one = |column| [histogram(column), tornado(column)].into_iter().flatten();
    let scatter = |[a, b]: &[String; 2]| many::scatter(table.column(a)?, table.column(b)?);
    answers(table, rows).flat_map(of_one).chain(pairs.iter().filter_map(scatter)).collect()
}
