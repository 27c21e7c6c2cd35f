//! `sweetspot bbcor BAT`: the laboratories' test, computed.

use std::path::PathBuf;

use crate::base::error::{Error, Result};
use crate::bat::body::Bat;
use crate::collision::bbcor::{Protocol, TEST_SPEED};
use crate::collision::hit::{Model, Scene};
use crate::collision::sweep::Trial;
use crate::show::plot::bbcor as plot;
use crate::show::report::bbcor as report;

use crate::cli::common::{BatArgs, OutputArgs, Prepared, SolveArgs, examples};
use crate::cli::csv_option::CsvArgs;
use crate::cli::done::Done;
use crate::cli::hit::verdict;
use crate::cli::pictures;
use crate::cli::ring_args::on_the_bat;
use crate::cli::value::{CANNON_SPEED, PLACE, STIFFNESS, cor};
use crate::files::balls::ball;

/// BBCOR as laboratories measure it, computed
///
/// The bat is at rest and turns about a pivot 6 in from the knob end; a ball at 136 mph meets it every
/// half inch. For each place the table says how fast the ball comes back, the collision efficiency
/// e_A, BBCOR and how far that may be off by the program's own errors; below it the largest, beside
/// the limit. Supports, springs and hands of the bat file are taken away. What is computed is no
/// certificate: it is as good as the ball's restitution and as the wall of a hollow barrel is known.
#[derive(clap::Args)]
#[command(after_long_help = examples(EXAMPLES))]
pub struct Args {
    #[command(flatten)]
    bat: BatArgs,

    /// Ball: baseball, humid-baseball, softball or a ball file
    #[arg(long, value_name = "BALL", default_value = "baseball", help_heading = "The test")]
    ball: String,

    /// The ball is a linear spring of this stiffness, in place of its own force law
    #[arg(long, value_name = "N/m", help_heading = "The test", allow_hyphen_values = true,
          value_parser = |s: &str| STIFFNESS.read(s))]
    ball_stiffness: Option<f64>,

    /// The ball's coefficient of restitution at the test speed, in place of its own
    #[arg(long, value_name = "E", help_heading = "The test", allow_hyphen_values = true,
          value_parser = cor)]
    cor: Option<f64>,

    /// Speed of the ball [default: 136 mph]
    #[arg(long, value_name = "m/s", help_heading = "The test", allow_hyphen_values = true,
          value_parser = |s: &str| CANNON_SPEED.read(s))]
    speed: Option<f64>,

    /// Where the scan begins, from the knob end [default: 12 in from the tip]
    #[arg(long, value_name = "m", help_heading = "The test", allow_hyphen_values = true,
          value_parser = |s: &str| PLACE.read(s))]
    from: Option<f64>,

    /// Where the scan ends, from the knob end [default: 1 in from the tip]
    #[arg(long, value_name = "m", help_heading = "The test", allow_hyphen_values = true,
          value_parser = |s: &str| PLACE.read(s))]
    to: Option<f64>,

    #[command(flatten)]
    solve: SolveArgs,

    #[command(flatten)]
    csv: CsvArgs,

    /// Draw BBCOR along the bat into this folder, as SVG and PNG
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    plots: Option<PathBuf>,

    #[command(flatten)]
    output: OutputArgs,
}

const EXAMPLES: &str = "\
Examples:
  sweetspot bbcor r161
      a wooden bat, every half inch from 12 in to 1 in from the tip

  sweetspot bbcor r161 --cor 0.53 --json -
      with a livelier ball, as JSON";

pub fn run(args: &Args) -> Result<Done> {
    args.csv.beside(&args.output.json)?;
    args.solve.refuse_budget("bbcor")?;
    let bat = args.bat.read(&args.output)?;
    let protocol = protocol(args, &bat)?;
    let prepared = args.bat.prepare(bat, args.bat.count(), &args.solve, &args.output)?;
    let Prepared { bat, request, warning } = prepared;
    let progress = args.output.progress("modes");
    let tell = |share, what: &str| progress.say(share, what);
    let trial = Trial { model: Model::Contact, scene: &Scene::default() };
    let accuracy = trial.accuracy(&request, args.bat.asked());
    let tested = protocol.test(&bat, &accuracy, &tell)?;
    drop(progress);
    args.solve.say_raised(&tested.sweep.solution, &args.output);
    if let Some(folder) = &args.plots {
        let picture: Vec<_> =
            plot::picture(args.output.sheet(&tested.bat), &tested).into_iter().collect();
        pictures::write(folder, &picture, args.output.quiet)?;
    }
    let source = report::cor_source(&tested, args.cor.is_some());
    let code = verdict(&args.solve, &tested.sweep, &args.output);
    let table = report::text(&tested, &source, args.output.units);
    let out = args.output.deliver(table, || report::document(&tested, &source))?;
    let text = args.csv.deliver(out, || report::csv(&tested))?;
    Ok(Done::new(text, code).with(warning))
}

/// What is asked of that bat, all that is wrong with it at once.
fn protocol(args: &Args, bat: &Bat) -> Result<Protocol> {
    let mut wrong: Vec<Error> = vec![];
    let ball = ball(&args.ball, args.ball_stiffness).map_err(|error| wrong.push(error)).ok();
    let speed = args.speed.unwrap_or(TEST_SPEED);
    if !(speed > 0.0 && speed < 1e6) {
        wrong.push(Error::value("--speed", format!("{speed:?} m/s"), "above 0 and below 1e6 m/s"));
    }
    let mut ends = [None; 2];
    for ((end, name), x) in ends.iter_mut().zip(["--from", "--to"]).zip([args.from, args.to]) {
        let place = x.map(|x| on_the_bat(bat, name, x)).transpose();
        *end = place.unwrap_or_else(|error| {
            wrong.push(error);
            None
        });
    }
    match (ball, wrong.len()) {
        (Some(mut ball), 0) => {
            if args.cor.is_some() {
                ball.cor_by_speed.clear();
            }
            let usual = Protocol::of(bat, ball);
            let scan = [ends[0].unwrap_or(usual.scan[0]), ends[1].unwrap_or(usual.scan[1])];
            Protocol { ball_speed: speed, cor: args.cor.unwrap_or(usual.cor), scan, ..usual }
                .checked()
        }
        (_, 1) => Err(wrong.remove(0)),
        _ => Err(Error::Several { shown: wrong, more: 0 }),
    }
}
