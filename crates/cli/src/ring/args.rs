//! The options of `ring`, and the common parts of both of its answers: instants, places, their table, a sound.

use std::path::{Path, PathBuf};

use sweetspot::base::file;
use sweetspot::collision::Ball;
use sweetspot::collision::hoop_wall::heard;
use sweetspot::motion::sound::{Sound, WallTones, as_heard};
use sweetspot::{Bat, Result, Solution};
use sweetspot_report::exchange::wav;
use sweetspot_study::ignored::{damping_in_sound, thinnest_wall};

use crate::common::{BatArgs, SolveArgs, examples};
use crate::output::{AnswerArgs, drawing};
use crate::scene::SceneArgs;
use crate::value::{IMPULSE, PLACE, RINGING_TIME};
use sweetspot_report::csv::Csv;
use sweetspot_report::parts::Cell;

/// How the bat moves after a hit, a blow, a push or a release
///
/// How does the handle move, and how close does the bat come to breaking? With --hit a ball hits the bat. The table
/// then shows how the watched places move, where the strain is largest and, if the material has a published strength,
/// the stress as a share of it; with --full also the spectrum there and the strain along the bat. With --at and
/// --impulse or --force, or with --initial, the deflection at even places and given instants is written as CSV; on a
/// terminal, without --csv, the largest deflection at each instant is shown.
#[derive(clap::Args)]
#[command(after_long_help = examples("ring"),
          mut_arg("csv", |arg| arg.help("Write CSV to this file (- = standard output, the default where that is not a terminal)")),
          mut_arg("plots", drawing("the motion (after a hit that of the watched places, their spectrum and the strain along the bat)")))]
pub struct Args {
    #[command(flatten)]
    pub bat: BatArgs,

    /// Hit a ball there, from the knob end
    #[arg(long, value_name = "m", help_heading = "The hit",
          conflicts_with_all = ["at", "initial", "bending_only"], value_parser = PLACE)]
    pub hit: Option<f64>,

    /// Places to watch after a hit, separated by commas [default: the hands]
    #[arg(long, value_name = "m,m,…", help_heading = "The hit", requires = "hit",
          value_delimiter = ',', value_parser = PLACE)]
    pub watch: Vec<f64>,

    /// How long to watch after a hit [default: three periods of mode 1]
    #[arg(long, value_name = "s", help_heading = "The hit", requires = "hit",
          value_parser = RINGING_TIME)]
    pub until: Option<f64>,

    /// Write force, motion and strain at the watched places to this CSV file (- = standard output, and no
    /// table then)
    #[arg(long, value_name = "FILE", help_heading = "Output", requires = "hit")]
    pub history: Option<PathBuf>,

    #[command(flatten)]
    pub scene: SceneArgs,

    /// Position of the blow or push, from the knob end
    #[arg(long, value_name = "m", requires = "load", value_parser = PLACE,
          help_heading = "A blow, a push or a release")]
    pub at: Option<f64>,

    /// The impulse of the blow
    #[arg(long, value_name = "N s", requires = "at", group = "load", value_parser = IMPULSE,
          help_heading = "A blow, a push or a release")]
    pub impulse: Option<f64>,

    /// Push it with the force in this CSV file
    ///
    /// Columns t_ms,force_n, or with other units; straight lines between the rows, 0 before and after.
    #[arg(
        long,
        value_name = "FILE",
        requires = "at",
        group = "load",
        help_heading = "A blow, a push or a release"
    )]
    pub force: Option<PathBuf>,

    /// Release it from the shape in this CSV file
    ///
    /// Columns x_m,w_m or with other units.
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with = "at",
        help_heading = "A blow, a push or a release"
    )]
    pub initial: Option<PathBuf>,

    /// Instants, separated by commas [default: nine over a period of mode 1]
    #[arg(long, value_name = "s,s,…", help_heading = "Output", value_delimiter = ',',
          value_parser = RINGING_TIME)]
    pub times: Vec<f64>,

    /// Leave out the rigid motion
    #[arg(long, help_heading = "A blow, a push or a release")]
    pub bending_only: bool,

    /// Even points from end to end
    #[arg(long, value_name = "N", default_value = "101", help_heading = "Output",
          value_parser = clap::value_parser!(u32).range(2..=100_000))]
    pub shape_points: u32,

    /// Write the sound at the struck place to this file (.wav): after a hit or a blow
    ///
    /// A material without a loss factor gets one for the sound only, with a message.
    #[arg(long, value_name = "FILE", help_heading = "Output", conflicts_with_all = ["initial", "force"])]
    pub wav: Option<PathBuf>,

    #[command(flatten)]
    pub solve: SolveArgs,

    #[command(flatten)]
    pub output: AnswerArgs,
}

/// Writes the sound of a bat with its wall under such a ball; returns what was assumed and what is missing.
pub fn write_sound(
    path: &Path,
    (bat, solution): (&Bat, &Solution),
    ball: &Ball,
    sound: impl FnOnce(&Solution, Option<WallTones>) -> Sound,
) -> Result<Vec<String>> {
    let (heard_bat, solution) = as_heard(bat, solution)?;
    let wall = heard(&heard_bat, ball);
    let sound = sound(&solution, wall.as_ref().map(|wall| wall as WallTones));
    file::write(path, &wav::file(&sound.samples(wav::RATE)))?;
    let ping = thinnest_wall(bat).filter(|_| wall.is_none()).map(|_| {
        "the ping of this hollow barrel is not in it: the hoop modes of its wall cannot be found"
            .to_owned()
    });
    Ok(damping_in_sound(bat).into_iter().chain(ping).collect())
}

/// The period of mode 1 (s), or a typical one if there is no mode.
pub fn period(solution: &Solution) -> f64 {
    solution.modes.first().map_or(0.01, |mode| 1.0 / mode.frequency())
}

/// The given instants, or nine over a period of mode 1 (s).
pub fn times(args: &Args, solution: &Solution) -> Vec<f64> {
    let nine = || (0..=8).map(|k| period(solution) * f64::from(k) / 8.0).collect();
    if args.times.is_empty() { nine() } else { args.times.clone() }
}

/// The even points from end to end (m).
pub fn places(args: &Args, bat: &Bat) -> Vec<f64> {
    let last = f64::from(args.shape_points - 1);
    (0..args.shape_points).map(|k| bat.length() * f64::from(k) / last).collect()
}

pub fn csv(x: &[f64], times: &[f64], frames: &[Vec<f64>]) -> String {
    let names = times.iter().map(|t| format!("w_m_at_{t}_s"));
    let mut table = Csv::new(["x_m".to_owned()].into_iter().chain(names));
    for (k, x) in x.iter().enumerate() {
        let moved = frames.iter().map(|frame| frame[k]);
        table.row([*x].into_iter().chain(moved).map(Cell::from));
    }
    table.text()
}
