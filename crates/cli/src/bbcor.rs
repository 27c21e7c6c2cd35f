//! `sweetspot bbcor BAT`: the laboratories' test, computed.

use sweetspot::base::mistakes::Mistakes;
use sweetspot::collision::bbcor::Protocol;
use sweetspot::collision::sweep::Trial;
use sweetspot::collision::wall_choice::WallChoice;
use sweetspot::collision::{Model, Scene};
use sweetspot::{Bat, Result};
use sweetspot_report::csv;
use sweetspot_report::parts::terminal;
use sweetspot_report::plot::bbcor as plot;
use sweetspot_report::report::bbcor as report;

use crate::cannon::CannonArgs;
use crate::common::{BatArgs, Prepared, SolveArgs, examples, on_the_bat};
use crate::done::Done;
use crate::hit::verdict;
use crate::output::{AnswerArgs, LINES, drawing};
use crate::value::PLACE;

/// BBCOR as laboratories measure it, computed
///
/// The bat is at rest and turns about a pivot 6 in from the knob end; a ball at 136 mph hits it every half inch. The
/// table gives the rebound speed of the ball, the collision efficiency e_A, BBCOR and its numerical error at the places
/// around the largest BBCOR, or with --full at every place. Below it the largest value is compared with the limit.
/// Supports, springs and hands of the bat file are removed. A computed value is not a certificate: it is only as good
/// as the known restitution of the ball and the known wall of a hollow barrel.
#[derive(clap::Args)]
#[command(after_long_help = examples("bbcor"), mut_arg("plots", drawing("BBCOR along the bat")))]
pub struct Args {
    #[command(flatten)]
    bat: BatArgs,

    #[command(flatten)]
    cannon: CannonArgs,

    /// Start of the scan, from the knob end [default: 12 in from the tip]
    #[arg(long, value_name = "m", help_heading = "The test", value_parser = PLACE)]
    from: Option<f64>,

    /// End of the scan, from the knob end [default: 1 in from the tip]
    #[arg(long, value_name = "m", help_heading = "The test", value_parser = PLACE)]
    to: Option<f64>,

    /// Whether a hollow barrel's wall deflects in its own hoop modes: auto, on or off
    ///
    /// auto: if that changes BBCOR by more than 0.15 of --tol, by an estimate, and the number of modes is not given.
    #[arg(long, value_name = "WHEN", default_value = "auto", help_heading = "The test",
          value_parser = ["auto", "on", "off"], hide_possible_values = true)]
    wall: String,

    #[command(flatten)]
    solve: SolveArgs,

    #[command(flatten)]
    output: AnswerArgs,
}

pub fn run(args: &Args) -> Result<Done> {
    args.output.apart(&[])?;
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
    let code = verdict(&args.solve, &tested.sweep, &args.output);
    let table = args.output.screen(LINES, |full| {
        let (title, parts) = report::report(&tested, args.output.units(&tested.bat), full);
        terminal::text(&title, &parts)
    });
    let text = args.output.answer(
        (&tested.bat, table),
        |sheet| Ok(plot::picture(sheet, &tested)),
        || report::document(&tested),
        || csv::rows(&report::COLUMNS, &tested.scan.places),
    )?;
    Ok(Done::new(text, code).with(warning))
}

/// The test of that bat; all mistakes are reported at once.
fn protocol(args: &Args, bat: &Bat) -> Result<Protocol> {
    let mut mistakes = Mistakes::default();
    let mut end =
        |name: &str, x: Option<f64>| mistakes.note(x.map(|x| on_the_bat(bat, name, x)).transpose());
    let [from, to] = [end("--from", args.from), end("--to", args.to)];
    let shot = mistakes.and(args.cannon.shot())?;
    let usual = Protocol::of(bat, shot.ball);
    let scan = [from.unwrap_or(usual.scan[0]), to.unwrap_or(usual.scan[1])];
    let (cor, wall) = (shot.cor.unwrap_or(usual.cor), WallChoice::named(&args.wall));
    let cor_given = shot.cor.is_some();
    Protocol { ball_speed: shot.speed, cor, cor_given, scan, wall, ..usual }.checked()
}
