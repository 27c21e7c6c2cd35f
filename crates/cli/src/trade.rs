//! `sweetspot trade BAT`: speed against accuracy, measured on this bat.

use std::time::Duration;

use sweetspot::{Request, Result};
use sweetspot_report::parts::{Part, terminal};
use sweetspot_report::plot::{front, sets};
use sweetspot_report::report::{trade, u_curve};
use sweetspot_study::trade::measure::measure;
use sweetspot_study::trade::reference::Reference;
use sweetspot_study::trade::u_curve as curve;

use crate::common::{BatFileArgs, Prepared, examples, prepare};
use crate::done::Done;
use crate::output::{DataArgs, LINES, drawing};
use crate::progress::Progress;
use crate::value::{TheoryChoice, budget, theory};

/// The cost of accuracy on this bat, measured now on this machine
///
/// How many elements of which degree, and which solver, give how many digits? It solves the bat in many ways, compares
/// each with a reference known to 1e-13, and prints those for which no other is both faster and more accurate; with
/// --full also the program's own choice. With --u-curve it adds cubic elements up to a million and shows where
/// factoring solvers begin to lose digits.
#[derive(clap::Args)]
#[command(after_long_help = examples("trade"), mut_arg("plots", drawing("the front, or the U-curves of the first and the last mode,")))]
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

    #[command(flatten)]
    said: DataArgs,
}

/// Default duration of the measurement (s).
const TRADE: u64 = 5;
const U_CURVE: u64 = 120;
/// Elements of the last mesh of a U-curve.
const MOST: usize = 1_000_000;

pub fn run(args: &Args) -> Result<Done> {
    args.said.apart(&[])?;
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
    let text = if args.u_curve {
        let reference = Reference::of(&bat, modes, theory)?;
        let (solvers, time) = (curve::SOLVERS, time(U_CURVE));
        let columns = curve::measure(&bat, &reference, solvers, MOST, time, &tell);
        let said = |full| told(&u_curve::report(&bat, (&reference, &columns), full));
        args.said.answer(
            args.said.screen(LINES, said),
            || Ok(sets::of_u_curve(bat.name(), &columns, modes)),
            || u_curve::document(&bat, reference.clone(), columns.clone()),
            || u_curve::csv(&columns),
        )?
    } else {
        let trade = measure(&bat, modes, theory, time(TRADE), &tell)?;
        let said = |full| told(&trade::report(&bat, &trade, full));
        args.said.answer(
            args.said.screen(LINES, said),
            || Ok(front::picture(bat.name(), &trade)),
            || trade::document(&bat, trade.clone()),
            || trade::csv(&trade),
        )?
    };
    Ok(Done::new(text, 0).with(warning))
}
