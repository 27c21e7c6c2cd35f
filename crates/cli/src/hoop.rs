//! `sweetspot hoop BAT`: how does a hollow barrel ring, and how does its wall affect the ball?

use std::path::PathBuf;

use sweetspot::base::mistakes::Mistakes;
use sweetspot::collision::sweep::Trial;
use sweetspot::collision::{Model, Scene};
use sweetspot::{Bat, Request, Result};
use sweetspot_report::exchange::barrel::BarrelGrid;
use sweetspot_report::exchange::hoop_files;
use sweetspot_report::plot::{hoop as plot, wall_sweep};
use sweetspot_report::report::hoop as report;
use sweetspot_study::trampoline::barrel::{Barrel, BarrelTest};
use sweetspot_study::trampoline::thickness::wall_sweep as thicknesses;
use uff58::Stamp;

use crate::cannon::CannonArgs;
use crate::common::{BatFileArgs, Prepared, examples, on_the_bat, prepare};
use crate::done::Done;
use crate::output::{AnswerArgs, LINES, drawing, put};
use crate::value::{PLACE, TheoryChoice, tolerance};

/// How the barrel of a hollow bat rings, and how its wall affects the ball
///
/// Which tones does the wall have, how stiff is it under a ball, and how much faster does the ball leave because of it?
/// The wall is computed as an elastic solid from the drawing in the bat file. The table gives each hoop mode's
/// frequency, its error, and the place of its largest motion. Below it are the wall under the ball, BBCOR without and
/// with the wall, the uncertainty due to the size of the ball's patch, and the force of a compression test of the
/// barrel. For bats of metal or of composites; wood is refused.
#[derive(clap::Args)]
#[command(after_long_help = examples("hoop"), mut_arg("plots", drawing("the modes around and along the barrel, and BBCOR against the wall (--wall-sweep),")))]
pub struct Args {
    #[command(flatten)]
    bat: BatFileArgs,

    /// Number of hoop modes in the table and the pictures [default: 10, the table without --full three]
    #[arg(short = 'n', long = "modes", value_name = "N",
          value_parser = clap::value_parser!(u16).range(1..=100), help_heading = "The bat")]
    count: Option<u16>,

    /// Position at which the ball meets the bat, from the knob end [default: 6 in from the tip]
    #[arg(long, value_name = "m", help_heading = "The test", value_parser = PLACE)]
    at: Option<f64>,

    #[command(flatten)]
    cannon: CannonArgs,

    /// BBCOR of the same bat with thinner and thicker walls
    #[arg(long, help_heading = "The test")]
    wall_sweep: bool,

    /// Wanted relative accuracy of every frequency, such as 1e-6 or 0.01%
    #[arg(long, value_name = "T", default_value = "1e-4", value_parser = tolerance,
          help_heading = "Accuracy")]
    tol: f64,

    /// Samples of each mode's shape in the JSON
    #[arg(long, value_name = "N", default_value_t = 41,
          value_parser = clap::value_parser!(u16).range(0..=10_000), help_heading = "Output")]
    shape_points: u16,

    /// Write the modes to this universal file, on a cylinder of points
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    uff: Option<PathBuf>,

    /// Date the universal file 1 January 1970, so that equal input gives equal bytes
    #[arg(long, requires = "uff", help_heading = "Output")]
    reproducible: bool,

    /// Write the modes to this VTK file (.vtu), on a cylinder of points
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    vtu: Option<PathBuf>,

    /// Points around the barrel in these files
    #[arg(long, value_name = "N", default_value_t = 48,
          value_parser = clap::value_parser!(u16).range(3..=360), help_heading = "Output")]
    around: u16,

    #[command(flatten)]
    output: AnswerArgs,
}

/// Number of modes on a screen if no number is given.
const FEW: usize = 3;
/// Most modes in a picture, which would otherwise be too long.
const MOST_DRAWN: usize = 12;
/// Places along the barrel in the files of other programs.
const ALONG: usize = 61;

pub fn run(args: &Args) -> Result<Done> {
    args.output.apart(&[("--uff", &args.uff), ("--vtu", &args.vtu)])?;
    let bat = args.bat.read(args.output.quiet)?;
    let progress = args.output.progress("the barrel");
    let request = Request { tolerance: args.tol, ..Request::default() };
    let Prepared { bat, request, warning } =
        prepare(bat, TheoryChoice(None), request, args.output.quiet)?;
    let barrel = Barrel::of(&bat, test(args, &bat, &request)?, None)?;
    let tried = match args.wall_sweep {
        true => thicknesses(&bat, &barrel, &|share| progress.say(share, "other walls")),
        false => vec![],
    };
    drop(progress);
    let count = modes(args);
    let drawn = |sheet| {
        let modes = plot::picture(sheet, &bat, &barrel, count.min(MOST_DRAWN));
        Ok(modes.into_iter().chain(wall_sweep::picture(sheet, bat.name(), &tried)))
    };
    let units = args.output.units(&bat);
    let sweep = if args.wall_sweep { report::sweep(&tried, units) } else { String::new() };
    let few = args.count.map_or(FEW, usize::from);
    let table = args.output.screen(LINES, |full| {
        let [modes, wall] = report::text(&bat, &barrel, if full { count } else { few }, units);
        [(2, "modes", modes), (3, "what the wall does", wall), (1, "other walls", sweep.clone())]
    });
    let samples = usize::from(args.shape_points);
    let document = || report::document(&bat, &barrel, &tried, samples);
    let rows = || report::csv(&bat, &barrel);
    let text = args.output.answer((&bat, table), drawn, document, rows)?;
    let text = exchanged(args, &bat, &barrel, text)?;
    let code =
        args.output.reached(barrel.unmet().map(|unmet| format!("accuracy not reached: {unmet}")));
    Ok(Done::new(text, code).with(warning))
}

/// How many hoop modes are computed.
fn modes(args: &Args) -> usize {
    args.count.map_or(10, usize::from)
}

/// The test of the barrel; all mistakes are reported at once.
fn test(args: &Args, bat: &Bat, request: &Request) -> Result<BarrelTest> {
    let mut mistakes = Mistakes::default();
    let at = mistakes.note(args.at.map(|x| on_the_bat(bat, "--at", x)).transpose());
    let shot = mistakes.and(args.cannon.shot())?;
    let trial = Trial { model: Model::Contact, scene: &Scene::default() };
    let usual = BarrelTest::of(bat, shot.ball, trial.accuracy(request, false));
    Ok(BarrelTest {
        modes: modes(args),
        at: at.unwrap_or(usual.at),
        ball_speed: shot.speed,
        cor: shot.cor.unwrap_or(usual.cor),
        ..usual
    })
}

/// Writes the files of other programs; returns the text for standard output.
fn exchanged(args: &Args, bat: &Bat, barrel: &Barrel, text: String) -> Result<String> {
    if args.uff.is_none() && args.vtu.is_none() {
        return Ok(text);
    }
    let grid = BarrelGrid::of(bat, barrel.hoop(), ALONG, args.around.into());
    let text = put(&args.uff, text, || {
        let stamp = if args.reproducible { Stamp::fixed() } else { Stamp::now() };
        uff58::write(&hoop_files::uff(bat.name(), &grid, &stamp))
    })?;
    put(&args.vtu, text, || Ok(hoop_files::vtu(&grid)))
}
