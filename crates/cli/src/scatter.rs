//! `sweetspot scatter BAT SCATTER`: how much do bats of one model differ?

use std::path::{Path, PathBuf};

use sweetspot::base::error::Complaint;
use sweetspot::base::{file, threads};
use sweetspot::{Error, Result};
use sweetspot_report::many::summary::sorted;
use sweetspot_report::many::table::NumberColumn;
use sweetspot_report::plot::{Picture, many};
use sweetspot_report::report::{resolved, scatter};
use sweetspot_report::schema;
use sweetspot_study::files::scatter_file::{self, ScatterForm};
use sweetspot_study::files::written::WrittenFile;
use sweetspot_study::scatter::rows::{ScatterPlan, ScatterRows};
use sweetspot_study::scatter::scattered::{OutputSpread, SHARES, Scattered, WRITTEN};

use crate::common::{self, BatFileArgs, examples, note_outside};
use crate::done::Done;
use crate::output::{DataArgs, LINES, drawing, make, printed};
use crate::progress::Counted;

/// How much bats of one model, and swings of one batter, differ
///
/// Draws bats at random from the given distributions (density, stiffness, errors of the lathe, moisture), and hits from
/// those of the swings (speed, pitch, ball, place). It gives percentiles of every output and the causes of its
/// variation; with --full every percentile with its own error, and every share. The same seed gives the same bytes, on
/// any number of threads.
#[derive(clap::Args)]
#[command(after_long_help = examples("scatter"), mut_arg("plots", drawing("a histogram of every output and the causes of its variation")))]
pub struct Args {
    #[command(flatten)]
    bat: BatFileArgs,

    /// Scatter file (JSON) with the distributions [default: the wood, by 22 % in stiffness and 10 % in density]
    #[arg(help_heading = "The bat")]
    scatter: Option<PathBuf>,

    /// Bats that are drawn, a power of two from 64 to 1048576
    #[arg(long, value_name = "N", default_value = "1024")]
    points: u64,

    /// Another seed draws other bats
    #[arg(long, value_name = "N", default_value = "1")]
    seed: u64,

    /// Number of threads [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=i64::from(threads::MOST)))]
    jobs: Option<u16>,

    /// Write the bats nearest to the 5th, 50th and 95th percentile into this folder, as bat files
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    bats: Option<PathBuf>,

    /// The output for whose percentiles bats are written [default: the first]
    #[arg(long, value_name = "NAME", requires = "bats", help_heading = "Output")]
    of: Option<String>,

    #[command(flatten)]
    said: DataArgs,
}

pub fn run(args: &Args) -> Result<Done> {
    args.said.apart(&[])?;
    let said = args.scatter.as_deref().map(ScatterForm::named_by_a_person).transpose()?;
    let said = said.map(|(said, outside)| {
        args.scatter.iter().for_each(|file| note_outside(file, &outside, args.said.quiet));
        said
    });
    let bat = args.bat.read(args.said.quiet)?;
    let said = match said {
        Some(said) => said,
        None => scatter_file::of_wood(&bat).ok_or_else(|| {
            let expected = "a scatter file that says what differs, such as bats.json: only the scatter of wood \
                            is used without one";
            Error::value("SCATTER", "none", expected)
        })?,
    };
    let (points, seed) = (args.points, args.seed);
    let plan = ScatterPlan { points, seed, ..said };
    let of = output(args, &plan)?;
    let rows = ScatterRows::new(&bat, plan).map_err(|error| named(args, error))?;
    let progress = Counted::new(args.said.quiet, "bats", points, 0);
    let tell = |some| progress.more(some);
    let found = threads::with(args.jobs.map(usize::from), || Scattered::new(&rows, &tell));
    drop(progress);
    if found.answered == 0 {
        let why = found.missing.first().cloned().unwrap_or_default();
        return Err(Error::value(said_by(args), why, "bats that can be"));
    }
    if let Some(folder) = &args.bats {
        write_bats(folder, &rows, &found, of)?;
    }
    let table = args.said.screen(LINES, |full| scatter::text(&rows, &found, full));
    let document = || scatter::document(&rows.bat, &found);
    let lines = || scatter::csv(&rows, &found);
    let text = args.said.answer(&table, || Ok(drawn(&found)), document, lines)?;
    Ok(Done::new(text, 0))
}

/// Writes the bats nearest to some percentiles of an output into a folder.
fn write_bats(folder: &Path, rows: &ScatterRows, found: &Scattered, of: usize) -> Result<()> {
    make(folder)?;
    for percentile in WRITTEN {
        let Some(row) = found.nearest(of, percentile) else { continue };
        let share = SHARES[percentile];
        let source = scatter::told(rows, found, (row, of), share);
        let Some(bat) = scatter::bat(&rows.bat_of(row as u64)?, &source, share) else { continue };
        let path = folder.join(format!("p{:02.0}.json", 100.0 * share));
        file::write(&path, schema::text(&resolved::resolved(&bat)).as_bytes())?;
    }
    Ok(())
}

/// The index of the output for whose percentiles bats are written.
fn output(args: &Args, plan: &ScatterPlan) -> Result<usize> {
    let Some(name) = &args.of else { return Ok(0) };
    let names: Vec<String> = plan.outputs.iter().map(|output| output.name()).collect();
    names.iter().position(|other| other == name).ok_or_else(|| {
        let known: Vec<&str> = names.iter().map(String::as_str).collect();
        let complaint = Complaint::new("--of", format!("\"{name}\""), known.join(", "));
        Error::Value(complaint.or_nearest(name, &known))
    })
}

/// The name of the distributions in messages.
fn said_by(args: &Args) -> String {
    args.scatter.as_deref().map_or("the wood".to_owned(), printed)
}

/// An error about the rows, by the name that its cause has for the user.
fn named(args: &Args, error: Error) -> Error {
    let file = said_by(args);
    error.placed(|complaint| {
        let field = match &*complaint.field {
            "points" => "--points".to_owned(),
            field => format!("{file}: {}", field.trim_matches('`')),
        };
        common::about(field, complaint)
    })
}

fn drawn(found: &Scattered) -> Vec<Picture> {
    let names: Vec<String> = found.inputs.iter().map(|one| one.name.to_owned()).collect();
    let of_one = |one: &OutputSpread| {
        let column = NumberColumn {
            name: one.name.clone(),
            unit: one.unit.to_owned(),
            values: one.values.iter().map(|value| value.unwrap_or(f64::NAN)).collect(),
        };
        let at = |k: usize| one.percentiles.get(k).map_or(f64::NAN, |one| one.value);
        let histogram = many::histogram(&column, &sorted(&column), WRITTEN.map(at));
        let tornado = one.indices.as_ref().map(|indices| many::tornado(&one.name, &names, indices));
        [histogram, tornado].into_iter().flatten()
    };
    found.outputs.iter().flat_map(of_one).collect()
}
