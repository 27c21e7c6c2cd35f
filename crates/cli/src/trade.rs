//! `sweetspot trade BAT`: speed against accuracy, measured on this bat.

use std::path::PathBuf;
use std::time::Duration;

use sweetspot::{Request, Result};
use sweetspot_report::parts::part::Part;
use sweetspot_report::parts::terminal;
use sweetspot_report::plot::{front, sets};
use sweetspot_report::report::{trade, u_curve};
use sweetspot_report::schema;
use sweetspot_report::schema::trade::{TradeFile, UCurveFile};
use sweetspot_study::trade::measure::measure;
use sweetspot_study::trade::reference::Reference;
use sweetspot_study::trade::u_curve as curve;

use crate::common::{BatFileArgs, Prepared, examples, prepare};
use crate::done::Done;
use crate::output::{CsvArgs, FullArgs, LINES, draw, put};
use crate::progress::Progress;
use crate::style;
use crate::value::{TheoryChoice, budget, theory};

/// The cost of accuracy on this bat, measured now on this machine
///
/// How many elements of which degree, and which solver, give how many digits? It solves the bat in many ways, compares
/// each with a reference known to 1e-13, and prints those for which no other is both faster and more accurate; with
/// --full also the program's own choice. With --u-curve it adds cubic elements up to a million and shows where
/// factoring solvers begin to lose digits.
#[derive(clap::Args)]
#[command(after_long_help = examples(EXAMPLES))]
pub struct Args {
    #[command(flatten)]
    bat: BatFileArgs,

    /// Number of bending modes
    #[arg(short = 'n', long = "modes", value_name = "N", default_value = "5", help_heading = "The bat",
          value_parser = clap::value_parser!(u16).range(1..=200))]
    count: u16,

    /// Beam theory: auto, euler-bernoulli, rayleigh or timoshenko
    ///
    /// auto is the simplest theory whose estimated shift of every frequency is within 1e-4.
    #[arg(long, value_name = "THEORY", default_value = "auto", value_parser = theory(),
          hide_possible_values = true, help_heading = "Accuracy")]
    theory: TheoryChoice,

    /// Error against the number of cubic elements, for every solver, instead
    #[arg(long, help_heading = "Accuracy")]
    u_curve: bool,

    /// About how long to measure [default: 5 s, with --u-curve 120 s]
    #[arg(long, value_name = "s", value_parser = budget, help_heading = "Accuracy")]
    budget: Option<Duration>,

    /// Write JSON to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    json: Option<PathBuf>,

    #[command(flatten)]
    csv: CsvArgs,

    /// Draw the front, or the U-curves of the first and the last mode, into this folder, as SVG and PNG
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    plots: Option<PathBuf>,

    #[command(flatten)]
    said: FullArgs,
}

const EXAMPLES: &str = "\
Examples:
  sweetspot trade r161 -n 5
      five modes, for five seconds

  sweetspot trade dowel --u-curve --budget \"20 s\" --csv u-curve.csv
      where more elements begin to hurt, as rows for a plot";

/// Default duration of the measurement (s).
const TRADE: u64 = 5;
const U_CURVE: u64 = 120;
/// Elements of the last mesh of a U-curve.
const MOST: usize = 1_000_000;

pub fn run(args: &Args) -> Result<Done> {
    args.csv.beside(&args.json)?;
    let modes = usize::from(args.count);
    let theory = args.theory.0.unwrap_or_default();
    let request = Request { modes, theory, ..Request::default() };
    let bat = args.bat.read(args.said.quiet)?;
    let Prepared { bat, request, warning } = prepare(bat, args.theory, request, args.said.quiet)?;
    let theory = request.theory;
    let progress = Progress::new(args.said.quiet, "the reference");
    let tell = |share, what: &str| progress.say(share, what);
    let told = |(title, parts): &(String, Vec<Part>)| terminal::text(title, parts);
    let time = |seconds| args.budget.unwrap_or(Duration::from_secs(seconds));
    let (table, document, rows, pictures) = if args.u_curve {
        let reference = Reference::of(&bat, modes, theory)?;
        let (solvers, time) = (curve::SOLVERS, time(U_CURVE));
        let columns = curve::measure(&bat, &reference, solvers, MOST, time, &tell);
        let pictures = sets::of_u_curve(bat.name(), &columns, modes);
        let said = |full| told(&u_curve::report(&bat, (&reference, &columns), full));
        let (screen, rows) = (args.said.screen(LINES, said), u_curve::csv(&columns));
        let document = schema::text(&UCurveFile::of(&bat, reference, columns));
        (screen, document, rows, pictures)
    } else {
        let trade = measure(&bat, modes, theory, time(TRADE), &tell)?;
        let pictures = front::picture(bat.name(), &trade).into_iter().collect();
        let said = |full| told(&trade::report(&bat, &trade, full));
        let (screen, rows) = (args.said.screen(LINES, said), trade::csv(&trade));
        (screen, schema::text(&TradeFile::of(&bat, trade)), rows, pictures)
    };
    draw(&args.plots, args.said.quiet, || Ok(pictures))?;
    let text = args.csv.deliver(style::table(&table), || rows)?;
    let text = put(&args.json, text, || Ok(document))?;
    Ok(Done::new(text, 0).with(warning))
}
