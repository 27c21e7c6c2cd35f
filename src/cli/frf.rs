//! `sweetspot frf BAT`: the answer to a force that swings, over frequency.

use std::path::PathBuf;

use crate::base::error::{Error, Result};
use crate::bat::body::Bat;
use crate::files::measured::response;
use crate::files::uff::{self, Stamp, Units};
use crate::modes::solve::Request;
use crate::motion::frf::{Kind, Sample};
use crate::show::exchange::frf_uff::{self, Measured};
use crate::show::plot;
use crate::show::report::frf::{self as report, Told};
use crate::study::measured::response::{Laid, MeasuredResponse};

use crate::cli::common::{BatArgs, OutputArgs, Prepared, SolveArgs, examples, on_the_bat};
use crate::cli::delivered::{apart, put};
use crate::cli::done::Done;
use crate::cli::frf_grid::GridArgs;
use crate::cli::pictures;
use crate::cli::value::{PLACE, file_unit, named};

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

    /// Where the force is, from the knob end [default: as measured]
    #[arg(long, value_name = "m", help_heading = "The force", allow_hyphen_values = true,
          required_unless_present = "measured", value_parser = |s: &str| PLACE.read(s))]
    at: Option<f64>,

    /// Where the answer is looked at [default: as measured, else where the force is]
    #[arg(long, value_name = "m", help_heading = "The force", allow_hyphen_values = true,
          value_parser = |s: &str| PLACE.read(s))]
    to: Option<f64>,

    /// What is answered: receptance (deflection), mobility (velocity) or accelerance [default: as
    /// measured, else receptance]
    #[arg(long, value_name = "KIND", value_parser = named(Kind::ALL, Kind::name),
          hide_possible_values = true, help_heading = "The force")]
    kind: Option<Kind>,

    #[command(flatten)]
    grid: GridArgs,

    /// A measured frequency response (UFF, dataset 58) to lay over the computed one
    ///
    /// Its places are those of its nodes (datasets 15, 2411), from the knob end, unless --at and --to
    /// say others; its range is that of the answer.
    #[arg(long, value_name = "FILE", help_heading = "A measured response")]
    measured: Option<PathBuf>,

    /// Which of the file's frequency responses, from 1 [default: the only one]
    #[arg(long, value_name = "N", requires = "measured", help_heading = "A measured response")]
    function: Option<usize>,

    /// Unit of length of a file that names no units (dataset 164), with N, or lbf for in and ft
    #[arg(long, value_name = "UNIT", requires = "measured", help_heading = "A measured response",
          value_parser = file_unit)]
    unit: Option<Units>,

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
      three frequencies as CSV

  sweetspot frf r161 --at \"28 in\" --to \"2 in\" --points 200 --uff tap.uff
  sweetspot frf r161 --measured tap.uff
      a laboratory's universal file laid over the computed response";

pub fn run(args: &Args) -> Result<Done> {
    args.solve.refuse_budget("frf")?;
    let files = [("--json", &args.output.json), ("--csv", &args.csv), ("--uff", &args.uff)];
    apart(&files)?;
    let bat = args.bat.read(&args.output)?;
    let measured = args.measured.as_ref();
    let measured =
        measured.map(|path| response::read_as(path, args.function, args.unit.as_ref(), args.kind));
    let measured = measured.transpose()?;
    let [at, to] = places(args, &bat, measured.as_ref())?;
    args.grid.check(bat.fixtures().rigid_modes() > 0)?;
    let asked = match &measured {
        Some(measured) => args.grid.as_measured(&measured.values),
        None => args.grid.clone(),
    };
    let kind = args.kind.or(measured.as_ref().map(|m| m.kind)).unwrap_or_default();
    let modes = args.bat.count().max(1);
    let prepared = args.bat.prepare(bat, modes, &args.solve, &args.output)?;
    let Prepared { bat, request, warning } = prepared;
    let request = Request { modes: request.modes.max(1), ..request };
    let progress = args.output.progress("modes and answers");
    let mut frf = asked.reaching(&bat, &request, [at, to])?;
    let grid = asked.grid(&frf, args.uff.is_some())?;
    // What the strains miss is looked for where it was asked; then the peaks are those of all of it.
    frf.receptances(&grid.asked)?;
    let samples = frf.receptances(&grid.all)?;
    let mut rising = grid.all.clone();
    rising.sort_by(f64::total_cmp);
    let peaks = frf.peaks(kind, &rising);
    let ends = [rising[0], rising[rising.len() - 1]];
    let lay = |measured| Laid::new(&mut frf, measured, kind, (&peaks, ends));
    let laid = measured.as_ref().map(lay).transpose()?;
    drop(progress);
    let told = Told {
        bat: &bat,
        kind,
        places: [at, to],
        frf: &frf,
        samples: &samples,
        asked: &grid.asked,
        peaks: &peaks,
        measured: measured.as_ref().zip(laid.as_ref()),
    };
    let (table, document) = (report::text(&told), report::document(&told));
    if let Some(folder) = &args.plots {
        // After what is said: looking at more frequencies may add to the modes.
        let drawn = frf.receptances(&args.grid.drawn(&rising))?;
        let values = drawn.iter().map(|s| (s.frequency, s.receptance * kind.of(s.frequency)));
        let laid_at = laid.iter().flat_map(|laid| {
            laid.measured.iter().zip(&laid.computed).map(|((f, _), value)| (*f, *value))
        });
        let mut values: Vec<_> = values.chain(laid_at).collect();
        values.sort_by(|a, b| a.0.total_cmp(&b.0));
        let subject = plot::response::Subject {
            bat: bat.name(),
            kind,
            at,
            to,
            values: &values,
            peaks: &peaks,
            measured: laid.as_ref().map_or(&[], |laid| &laid.measured),
        };
        let picture = plot::response::picture(args.output.sheet(&bat), &subject);
        pictures::write(folder, picture.as_slice(), args.output.quiet)?;
    }
    let text = args.output.deliver(table, || document)?;
    let text = put(&args.csv, text, || Ok(report::csv(kind, &samples)))?;
    let text = put(&args.uff, text, || {
        let measured = Measured { bat: bat.name(), kind, at, to, even: grid.even };
        let stamp = if args.reproducible { Stamp::fixed() } else { Stamp::now() };
        let held = |s: &&Sample| grid.even.is_none() || grid.asked.contains(&s.frequency);
        let held: Vec<Sample> = samples.iter().filter(held).copied().collect();
        uff::write(&frf_uff::response(&measured, &held, &stamp))
    })?;
    let code = match frf.solution.worst() <= args.solve.tol {
        true => 0,
        false => args.solve.verdict(&frf.solution, &args.output),
    };
    Ok(Done::new(text, code).with(warning))
}

/// Where the force is and where the answer is watched (m): as told, else as measured.
fn places(args: &Args, bat: &Bat, measured: Option<&MeasuredResponse>) -> Result<[f64; 2]> {
    let [at, to] = [measured.and_then(|m| m.at), measured.and_then(|m| m.to)];
    let Some(at) = args.at.or(at) else {
        let source = measured.map_or(String::new(), |m| m.source.clone());
        let expected = "its node in a dataset 15 or 2411, or --at and --to";
        return Err(Error::value(source, "no place of the force", expected));
    };
    let here = measured.is_none_or(|m| m.drive_point);
    let Some(to) = args.to.or(to).or(here.then_some(at)) else {
        let source = measured.map_or(String::new(), |m| m.source.clone());
        let expected = "its node in a dataset 15 or 2411, or --to";
        return Err(Error::value(source, "no place of the answer", expected));
    };
    Ok([on_the_bat(bat, "--at", at)?, on_the_bat(bat, "--to", to)?])
}
