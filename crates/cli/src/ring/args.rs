//! What `ring` is asked, and what both of its answers need: instants, places, their table, a sound.

use std::path::{Path, PathBuf};

use sweetspot::base::error::Result;
use sweetspot::base::file;
use sweetspot::bat::body::Bat;
use sweetspot::modes::solve::Solution;
use sweetspot::motion::sound::Sound;
use sweetspot_report::exchange::wav;
use sweetspot_study::ignored::thinnest_wall;

use crate::common::{BatArgs, OutputArgs, SolveArgs, examples};
use crate::full_option::FullArgs;
use crate::scene::SceneArgs;
use crate::value::{IMPULSE, PLACE, RINGING_TIME};
use sweetspot_report::csv::Csv;
use sweetspot_report::parts::cell::Cell;

/// How the bat moves after a hit, a blow, a push or a release
///
/// How does the handle move, and how near does the bat come to breaking? With --hit a ball is hit and
/// the table says how the watched places move, where the strain is largest or, where a strength is
/// published for the material, what share of it the stress is; with --full also the spectrum there and
/// the strain along the bat. With --at and --impulse or --force, or with --initial, the deflection at
/// even places and given instants is written as CSV; on a terminal, without --csv, how far the bat is
/// bent at each of them.
#[derive(clap::Args)]
#[command(after_long_help = examples(EXAMPLES))]
pub struct Args {
    #[command(flatten)]
    pub bat: BatArgs,

    /// Hit a ball there, from the knob end
    #[arg(long, value_name = "m", help_heading = "The hit", conflicts_with_all = ["at", "initial", "bending_only"],
          allow_hyphen_values = true, value_parser = |s: &str| PLACE.read(s))]
    pub hit: Option<f64>,

    /// Places to watch after a hit, separated by commas [default: the hands]
    #[arg(long, value_name = "m,m,…", help_heading = "The hit", requires = "hit", value_delimiter = ',',
          allow_hyphen_values = true, value_parser = |s: &str| PLACE.read(s))]
    pub watch: Vec<f64>,

    /// How long to watch after a hit [default: three periods of mode 1]
    #[arg(long, value_name = "s", help_heading = "The hit", requires = "hit", allow_hyphen_values = true,
          value_parser = |s: &str| RINGING_TIME.read(s))]
    pub until: Option<f64>,

    /// Write force, motion and strain at the watched places to this CSV file (- = standard output, and no
    /// table then)
    #[arg(long, value_name = "FILE", help_heading = "Output", requires = "hit")]
    pub history: Option<PathBuf>,

    #[command(flatten)]
    pub scene: SceneArgs,

    /// Where it is struck or pushed, from the knob end
    #[arg(long, value_name = "m", help_heading = "A blow, a push or a release", requires = "load", allow_hyphen_values = true,
          value_parser = |s: &str| PLACE.read(s))]
    pub at: Option<f64>,

    /// The impulse of the blow
    #[arg(long, value_name = "N s", help_heading = "A blow, a push or a release", requires = "at", allow_hyphen_values = true, group = "load",
          value_parser = |s: &str| IMPULSE.read(s))]
    pub impulse: Option<f64>,

    /// Push it with the force in this CSV file
    ///
    /// Columns t_ms,force_n or with other units; straight lines between the rows, nothing before and
    /// after them.
    #[arg(
        long,
        value_name = "FILE",
        help_heading = "A blow, a push or a release",
        requires = "at",
        group = "load"
    )]
    pub force: Option<PathBuf>,

    /// Release it from the shape in this CSV file
    ///
    /// Columns x_m,w_m or with other units.
    #[arg(
        long,
        value_name = "FILE",
        help_heading = "A blow, a push or a release",
        conflicts_with = "at"
    )]
    pub initial: Option<PathBuf>,

    /// Instants, separated by commas [default: nine over a period of mode 1]
    #[arg(long, value_name = "s,s,…", help_heading = "Output", value_delimiter = ',', allow_hyphen_values = true,
          value_parser = |s: &str| RINGING_TIME.read(s))]
    pub times: Vec<f64>,

    /// Leave out the rigid motion
    #[arg(long, help_heading = "A blow, a push or a release")]
    pub bending_only: bool,

    /// Even points from end to end
    #[arg(long, value_name = "N", default_value = "101", help_heading = "Output",
          value_parser = clap::value_parser!(u32).range(2..=100_000))]
    pub shape_points: u32,

    /// Write CSV to this file (- = standard output, the default where that is no terminal)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub csv: Option<PathBuf>,

    /// Draw into this folder, as SVG and PNG: after a hit the motion of the watched places, their
    /// spectrum and the strain along the bat; else the deflected bat at the instants
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    pub plots: Option<PathBuf>,

    /// Write what it sounds like to this file (.wav), where it was struck: after a hit or a blow
    ///
    /// A material without a loss factor gets one for the sound only, and that is said.
    #[arg(long, value_name = "FILE", help_heading = "Output", conflicts_with_all = ["initial", "force"])]
    pub wav: Option<PathBuf>,

    #[command(flatten)]
    pub full: FullArgs,

    #[command(flatten)]
    pub solve: SolveArgs,

    #[command(flatten)]
    pub output: OutputArgs,
}

const EXAMPLES: &str = "\
Examples:
  sweetspot ring r161 --hit \"65 cm\" --watch \"5 in,9 in\" \\
      --history hands.csv
      what two hands feel after a hit near the sweet spot, every instant as CSV

  sweetspot ring meshes/r161.json --hit \"60 cm\" --plots sting
      the same motion and its spectrum, drawn

  sweetspot ring dowel --at \"0.6 m\" --impulse \"1 N s\" --modes 5 \\
      --times \"0,1 ms,2 ms\"
      the deflected dowel after a blow, at three instants

  sweetspot ring meshes/r161.json --hit \"60 cm\" --wav sting.wav
      the crack of a ball hit 10 cm closer to the handle than it should be";

/// Writes a sound of a bat; what was assumed for it and what is not in it is given back.
pub fn write_sound(path: &Path, bat: &Bat, sound: &Sound) -> Result<Vec<String>> {
    file::write(path, &wav::file(&sound.samples(wav::RATE)))?;
    let assumed = sound.assumed_loss_factor.map(|loss| {
        format!(
            "the bat has no damping of its own; a loss factor of {loss} is taken for the sound only \
             (give the material a \"loss_factor\")"
        )
    });
    let ping = thinnest_wall(bat).map(|_| {
        "the ping of this hollow barrel is not in it: its wall rings in hoop modes, which are not \
         bending (sweetspot hoop has their frequencies)"
            .to_owned()
    });
    Ok(assumed.into_iter().chain(ping).collect())
}

/// The instants asked for, or nine over a period of mode 1.
pub fn times(args: &Args, solution: &Solution) -> Vec<f64> {
    let period = solution.modes.first().map_or(0.01, |mode| 1.0 / mode.frequency());
    let nine = || (0..=8).map(|k| period * f64::from(k) / 8.0).collect();
    if args.times.is_empty() { nine() } else { args.times.clone() }
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
