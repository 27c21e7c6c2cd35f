//! `sweetspot frf BAT`: the answer to a force that swings, over frequency.

use std::path::PathBuf;

use crate::base::error::Result;
use crate::files::uff::{self, Stamp};
use crate::modes::solve::Request;
use crate::motion::frf::{Kind, Sample};
use crate::show::exchange::frf_uff::{self, Measured};
use crate::show::plot::response;
use crate::show::report::frf::{self as report, Told};

use crate::cli::common::{BatArgs, OutputArgs, Prepared, SolveArgs, examples};
use crate::cli::delivered::{one_on_stdout, put};
use crate::cli::done::Done;
use crate::cli::frf_grid::GridArgs;
use crate::cli::pictures;
use crate::cli::ring_args::on_the_bat;
use crate::cli::value::{PLACE, named};

/// How the bat answers a shaker or a tap, over frequency
///
/// What would an accelerometer at one place see if a force swings at another? The table gives size
/// and phase of the deflection (receptance), velocity (mobility) or acceleration (accelerance) for
/// a unit force, the peaks with their damping, and how much of it the modes left out may be. The
/// grid has every natural frequency in its range and the points around it that its peak needs.
/// Undamped bats peak without bound at their frequencies: give the material a loss_factor.
#[derive(clap::Args)]
#[command(after_long_help = examples(EXAMPLES))]
pub struct Args {
    #[command(flatten)]
    bat: BatArgs,

    /// Where the force is, from the knob end
    #[arg(long, value_name = "m", help_heading = "The force", allow_hyphen_values = true,
          value_parser = |s: &str| PLACE.read(s))]
    at: f64,

    /// Where the answer is looked at [default: where the force is]
    #[arg(long, value_name = "m", help_heading = "The force", allow_hyphen_values = true,
          value_parser = |s: &str| PLACE.read(s))]
    to: Option<f64>,

    /// What is answered: receptance (deflection), mobility (velocity) or accelerance
    #[arg(long, value_name = "KIND", default_value = "receptance", value_parser = named(Kind::ALL, Kind::name),
          hide_possible_values = true, help_heading = "The force")]
    kind: Kind,

    #[command(flatten)]
    grid: GridArgs,

    /// Write CSV to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    csv: Option<PathBuf>,

    /// Write a universal file, datasets 151, 164, 2411 and 58, to this file (- = standard output,
    /// and no table then). It has six digits for a frequency, so that all are rounded to that many
    /// first, and they rise; with --linear it has the even steps alone
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    uff: Option<PathBuf>,

    /// 1 January 1970 for the date in the universal file, so that equal input gives equal bytes
    #[arg(long, requires = "uff", help_heading = "Output")]
    reproducible: bool,

    /// Draw size and phase, with the peaks, into this folder, as SVG and PNG
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    plots: Option<PathBuf>,

    #[command(flatten)]
    solve: SolveArgs,

    #[command(flatten)]
    output: OutputArgs,
}

const EXAMPLES: &str = "\
Examples:
  sweetspot frf r161 --at \"28 in\" --to \"2 in\" --kind mobility
      struck on the barrel, felt at the handle

  sweetspot frf meshes/r161.json --at \"28 in\" --to-hz \"2 kHz\" --plots frf
      the peaks up to 2 kHz, drawn

  sweetspot frf dowel --at 0.3 --frequencies \"100,200,300\" --csv -
      three frequencies as CSV";

pub fn run(args: &Args) -> Result<Done> {
    args.solve.refuse_budget("frf")?;
    let files = [("--json", &args.output.json), ("--csv", &args.csv), ("--uff", &args.uff)];
    one_on_stdout(&files)?;
    let bat = args.bat.read(&args.output)?;
    let at = on_the_bat(&bat, "--at", args.at)?;
    let to = on_the_bat(&bat, "--to", args.to.unwrap_or(args.at))?;
    args.grid.check(bat.fixtures().rigid_modes() > 0)?;
    let modes = args.bat.count().max(1);
    let prepared = args.bat.prepare(bat, modes, &args.solve, &args.output)?;
    let Prepared { bat, request, warning } = prepared;
    let request = Request { modes: request.modes.max(1), ..request };
    let progress = args.output.progress("modes and answers");
    let mut frf = args.grid.reaching(&bat, &request, [at, to])?;
    let grid = args.grid.grid(&frf, args.uff.is_some())?;
    // What the strains miss is looked for where it was asked; then the peaks are those of all of it.
    frf.receptances(&grid.asked)?;
    let samples = frf.receptances(&grid.all)?;
    let mut rising = grid.all.clone();
    rising.sort_by(f64::total_cmp);
    let peaks = frf.peaks(args.kind, &rising);
    drop(progress);
    let (kind, asked) = (args.kind, &grid.asked[..]);
    let told = Told {
        bat: &bat,
        kind,
        places: [at, to],
        frf: &frf,
        samples: &samples,
        asked,
        peaks: &peaks,
    };
    if let Some(folder) = &args.plots {
        let values = samples.iter().map(|s| (s.frequency, s.receptance * kind.of(s.frequency)));
        let mut values: Vec<_> = values.collect();
        values.sort_by(|a, b| a.0.total_cmp(&b.0));
        let subject =
            response::Subject { bat: bat.name(), kind, at, to, values: &values, peaks: &peaks };
        let pictures: Vec<_> =
            response::picture(args.output.sheet(&bat), &subject).into_iter().collect();
        pictures::write(folder, &pictures, args.output.quiet)?;
    }
    let text = args.output.deliver(report::text(&told), || report::document(&told))?;
    let text = put(&args.csv, text, || Ok(report::csv(kind, &samples)))?;
    let text = put(&args.uff, text, || {
        let measured = Measured { bat: bat.name(), kind, at, to, even: grid.even };
        let stamp = if args.reproducible { Stamp::fixed() } else { Stamp::now() };
        let held = |s: &&Sample| grid.even.is_none() || asked.contains(&s.frequency);
        let held: Vec<Sample> = samples.iter().filter(held).copied().collect();
        uff::write(&frf_uff::response(&measured, &held, &stamp))
    })?;
    let code = match frf.solution.worst() <= args.solve.tol {
        true => 0,
        false => args.solve.verdict(&frf.solution, &args.output),
    };
    Ok(Done::new(text, code).with(warning))
}
