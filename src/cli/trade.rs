//! `sweetspot trade BAT`: speed against accuracy, measured on this bat.

use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde_json::Value;
use sweetspot::error::{Error, Result};
use sweetspot::plot::{front, picture, sets};
use sweetspot::report::{file, trade, u_curve};
use sweetspot::solve::Request;
use sweetspot::trade::measure::measure;
use sweetspot::trade::reference::Reference;
use sweetspot::trade::u_curve as curve;

use crate::cli::Done;
use crate::cli::common::{Prepared, TheoryChoice, budget, prepare, read, theory};

/// Speed against accuracy, measured on this bat, here and now
///
/// Example: sweetspot trade meshes/r161.json -n 5
#[derive(clap::Args)]
pub struct Args {
    /// Bat file (JSON)
    bat: PathBuf,

    /// Number of bending modes
    #[arg(short = 'n', long = "modes", value_name = "N", default_value = "5",
          value_parser = clap::value_parser!(u16).range(1..=200))]
    count: u16,

    /// Beam theory: auto (the simplest within 1e-4), euler-bernoulli, rayleigh or timoshenko
    #[arg(long, default_value = "auto", value_parser = theory)]
    theory: TheoryChoice,

    /// Error against the number of cubic elements, up to a million, for every solver instead
    #[arg(long)]
    u_curve: bool,

    /// About how long to measure, such as "20 s" (default: 5 s, with --u-curve 120 s)
    #[arg(long, value_name = "TIME", value_parser = budget)]
    budget: Option<Duration>,

    /// Write JSON to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,

    /// Write CSV to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,

    /// Draw the front, or the U-curves of the first and the last mode, into this folder, as SVG and PNG
    #[arg(long, value_name = "DIR")]
    plots: Option<PathBuf>,

    /// No warnings and no progress on standard error
    #[arg(long)]
    quiet: bool,
}

/// Seconds that the measurement takes if nothing is said.
const TRADE: u64 = 5;
const U_CURVE: u64 = 120;
/// Elements of the last mesh of a U-curve.
const MOST: usize = 1_000_000;

pub fn run(args: &Args) -> Result<Done> {
    let standard = Some(Path::new("-"));
    if args.json.as_deref() == standard && args.csv.as_deref() == standard {
        let expected = "one of --json and --csv on standard output";
        return Err(Error::value("--csv", "- and --json -", expected));
    }
    let modes = usize::from(args.count);
    let theory = args.theory.0.unwrap_or_default();
    let request = Request { modes, theory, ..Request::default() };
    let bat = read(&args.bat, args.quiet)?;
    let Prepared { bat, request, warning } = prepare(bat, args.theory, request, args.quiet)?;
    let theory = request.theory;
    let mut progress = Progress::new(args.quiet);
    let time = |seconds| args.budget.unwrap_or(Duration::from_secs(seconds));
    let (table, document, rows, pictures) = if args.u_curve {
        progress.say("the reference");
        let reference = Reference::of(&bat, modes, theory)?;
        let (solvers, time) = (curve::SOLVERS, time(U_CURVE));
        let columns = curve::measure(&bat, &reference, solvers, MOST, time, &mut |what| {
            progress.say(what);
        });
        let document = u_curve::json(&bat, &reference, &columns);
        let pictures = sets::of_u_curve(&bat.name, &columns, modes);
        (u_curve::text(&bat, &reference, &columns), document, u_curve::csv(&columns), pictures)
    } else {
        let say = &mut |what: &str| progress.say(what);
        let trade = measure(&bat, modes, theory, time(TRADE), say)?;
        let pictures = front::picture(&bat.name, &trade).into_iter().collect();
        (trade::text(&bat, &trade), trade::json(&bat, &trade), trade::csv(&trade), pictures)
    };
    if let Some(folder) = &args.plots {
        picture::write(folder, &pictures)?;
    }
    Ok(Done::new(deliver(args, table, &document, rows)?, 0).with(warning))
}

/// Writes the files; what is left for standard output.
fn deliver(args: &Args, table: String, document: &Value, rows: String) -> Result<String> {
    let text = format!("{document:#}\n");
    let mut out = table;
    for (path, contents) in [(&args.csv, rows), (&args.json, text)] {
        match path {
            Some(path) if path == Path::new("-") => out = contents,
            Some(path) => file::write(path, contents.as_bytes())?,
            None => {}
        }
    }
    Ok(out)
}

/// One line on a terminal that says what is being measured, and is gone at the end.
struct Progress {
    shown: bool,
}

impl Progress {
    fn new(quiet: bool) -> Self {
        Self { shown: !quiet && std::io::stderr().is_terminal() }
    }

    fn say(&mut self, what: &str) {
        if self.shown {
            // A closed standard error is no reason to stop.
            let _ = write!(std::io::stderr(), "\r\x1b[Kmeasuring {what}");
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if self.shown {
            let _ = write!(std::io::stderr(), "\r\x1b[K");
        }
    }
}
