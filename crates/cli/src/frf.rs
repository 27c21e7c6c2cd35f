//! `sweetspot frf BAT`: the answer to a force that swings, over frequency.

use std::path::PathBuf;

use sweetspot::base::error::Complaint;
use sweetspot::motion::frf::{Frf, ResponseKind, Sample};
use sweetspot::motion::peaks::Peak;
use sweetspot::{Bat, Error, Request, Result, Theory};
use sweetspot_report::exchange::frf_uff::{self, Measured};
use sweetspot_report::plot::{self, Picture, Sheet};
use sweetspot_report::report::frf as report;
use sweetspot_report::report::frf::ToldResponse;
use sweetspot_report::report::frf_set::{self, RowOfSet};
use sweetspot_report::schema::Written;
use sweetspot_report::schema::frf::FrfSetFile;
use sweetspot_study::files::measured::response::{self, Known};
use sweetspot_study::measured::response::{Laid, MeasuredResponse};
use uff58::Stamp;

use crate::beside::PlacesArgs;
use crate::common::{BatArgs, Prepared, SolveArgs, about, examples, on_the_bat};
use crate::done::Done;
use crate::edits::DAMPING;
use crate::frf_grid::{Grid, GridArgs};
use crate::output::{AnswerArgs, MANY, drawing, put};
use crate::value::{PLACE, file_unit, named};

/// The bat's response to a shaker or a tap, over frequency
///
/// What would an accelerometer at one place measure if a harmonic force acts at another? The table gives magnitude and
/// phase of the deflection (receptance), velocity (mobility) or acceleration (accelerance) per unit force, the peaks
/// with their damping, and the possible error due to omitted modes. With --full, --points or --frequencies it has every
/// frequency, otherwise a selection. The grid has every natural frequency in its range and the points around it that
/// its peak needs. The peaks of an undamped bat have no bound: give the material a loss_factor, or use --damping
/// assumed.
#[derive(clap::Args)]
#[command(after_long_help = examples("frf"), mut_arg("plots", drawing("size and phase, with the peaks,")), mut_arg(DAMPING, |arg| arg
    .value_parser(["material", "assumed", "measured"])
    .help("Damping of the computed modes: material, assumed (a metal without a loss factor has the published one), \
           or measured: that of the measured peaks, mode by mode")))]
pub struct Args {
    #[command(flatten)]
    bat: BatArgs,

    /// Position of the force, from the knob end [default: as measured]
    #[arg(long, value_name = "m", help_heading = "The force", required_unless_present = "measured",
          value_parser = PLACE)]
    at: Option<f64>,

    /// Position of the response [default: as measured, else that of the force]
    #[arg(long, value_name = "m", help_heading = "The force", value_parser = PLACE)]
    to: Option<f64>,

    /// Kind of the response: receptance (deflection), mobility (velocity) or accelerance [default: as measured, else
    /// receptance]
    #[arg(long, value_name = "KIND", value_parser = named(ResponseKind::ALL, ResponseKind::name),
          hide_possible_values = true, help_heading = "The force")]
    kind: Option<ResponseKind>,

    #[command(flatten)]
    grid: GridArgs,

    /// Overlay measured frequency responses (UFF, dataset 58) on the computed ones
    ///
    /// Their places are those of their nodes (datasets 15, 2411), from the knob end, unless --at and --to replace them
    /// for one response; the range is that of the measurement. Several responses get a row each.
    #[arg(long, value_name = "FILE", help_heading = "A measured response")]
    measured: Option<PathBuf>,

    /// Choose one of the file's frequency responses, from 1, with all its details [default: all]
    #[arg(long, value_name = "N", requires = "measured", help_heading = "A measured response")]
    function: Option<usize>,

    /// Unit of a file whose axes and datasets name no known one: that of the response per force, such as g/lbf, or a
    /// unit of length; the force is then in N, or in lbf with in and ft
    #[arg(long, value_name = "UNIT", requires = "measured", help_heading = "A measured response")]
    unit: Option<String>,

    #[command(flatten)]
    places: PlacesArgs,

    /// Write a universal file, datasets 151, 164, 2411 and 58, to this file (- = standard output, and no table then).
    /// Its frequencies have six digits, so all are rounded to that first and stay rising; with --linear it has only the
    /// even steps
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    uff: Option<PathBuf>,

    /// Date the universal file 1 January 1970, so that equal input gives equal bytes
    #[arg(long, requires = "uff", help_heading = "Output")]
    reproducible: bool,

    #[command(flatten)]
    solve: SolveArgs,

    #[command(flatten)]
    output: AnswerArgs,
}

pub fn run(args: &Args) -> Result<Done> {
    args.solve.refuse_budget("frf")?;
    args.output.apart(&[("--uff", &args.uff)])?;
    if args.bat.damped_as("measured") && args.measured.is_none() {
        let expected = "--measured FILE beside it, whose peaks tell the damping";
        return Err(Error::value("--damping", "measured", expected));
    }
    let bat = args.bat.read(&args.output)?;
    let known = known(args)?;
    let measured = args.measured.as_ref().map(|path| response::read(path, &known)).transpose()?;
    let measured = measured.unwrap_or_default();
    args.grid.check(bat.fixtures().rigid_modes() > 0)?;
    match measured.as_slice() {
        [] => one(args, bat, None),
        [(_, measured)] => one(args, bat, Some(measured)),
        several => all(args, bat, several),
    }
}

/// The options about a file of responses.
fn known(args: &Args) -> Result<Known> {
    let unit = args.unit.as_deref().and_then(|text| file_unit(text).ok());
    let label = args.unit.clone().filter(|_| unit.is_none());
    let places = args.places.read()?;
    let told = [args.at.is_some(), args.to.is_some()];
    Ok(Known { which: args.function, unit, label, kind: args.kind, places, told })
}

/// A response that was computed.
struct Answered {
    frf: Frf,
    samples: Vec<Sample>,
    grid: Grid,
    /// The frequencies of the grid, rising.
    rising: Vec<f64>,
    peaks: Vec<Peak>,
    laid: Option<Laid>,
    kind: ResponseKind,
    places: [f64; 2],
}

impl Answered {
    fn new(
        args: &Args,
        (bat, request): (&Bat, &Request),
        measured: Option<&MeasuredResponse>,
    ) -> Result<Self> {
        let places = places(args, bat, measured)?;
        let own = Self::damped(args, (bat, request), measured, (places, None))?;
        let Some(laid) = own.laid.as_ref().filter(|_| args.bat.damped_as("measured")) else {
            return Ok(own);
        };
        let mut ratios = vec![None; own.frf.solution.modes.len()];
        for (computed, measured) in &laid.peaks {
            if let Some(ratio) = measured.and_then(|peak| peak.damping_ratio()) {
                ratios[computed.mode - 1] = Some(ratio);
            }
        }
        if ratios.iter().all(Option::is_none) {
            let source = measured.map_or("--damping", |m| &m.source);
            let found = "no measured peak whose width tells its damping";
            return Err(Error::value(source, found, "--damping material, or finer frequencies"));
        }
        Self::damped(args, (&bat.losing(|_| [0.0; 2])?, request), measured, (places, Some(&ratios)))
    }

    /// With these damping ratios of the modes in place of the materials'.
    fn damped(
        args: &Args,
        (bat, request): (&Bat, &Request),
        measured: Option<&MeasuredResponse>,
        (places, ratios): ([f64; 2], Option<&[Option<f64>]>),
    ) -> Result<Self> {
        let asked = asked(args, measured);
        let kind = args.kind.or(measured.map(|m| m.kind)).unwrap_or_default();
        let mut frf = Frf::new(bat, request, places[0], places[1])?;
        if let Some(ratios) = ratios {
            frf = frf.damped_as(ratios);
        }
        let grid = asked.grid(&frf, args.uff.is_some())?;
        // Missing strains are sought at the requested frequencies; the peaks then include them.
        frf.receptances(&grid.asked)?;
        let samples = frf.receptances(&grid.all)?;
        let mut rising = grid.all.clone();
        rising.sort_by(f64::total_cmp);
        let peaks = frf.peaks(kind, &rising);
        let ends = [rising[0], rising[rising.len() - 1]];
        let lay = |measured| Laid::new(&mut frf, measured, kind, (&peaks, ends));
        let laid = measured.map(lay).transpose()?;
        Ok(Self { frf, samples, grid, rising, peaks, laid, kind, places })
    }

    fn told<'a>(
        &'a self,
        args: &Args,
        bat: &'a Bat,
        measured: Option<&'a MeasuredResponse>,
    ) -> ToldResponse<'a> {
        ToldResponse {
            bat,
            kind: self.kind,
            places: self.places,
            frf: &self.frf,
            samples: &self.samples,
            asked: &self.grid.asked,
            peaks: &self.peaks,
            measured: measured.zip(self.laid.as_ref()),
            units: args.output.units(bat),
        }
    }

    fn picture(
        &mut self,
        args: &Args,
        sheet: Sheet,
        bat: &Bat,
        name: &str,
    ) -> Result<Option<Picture>> {
        // At the end, because more frequencies may add to the modes.
        let drawn = self.frf.receptances(&args.grid.drawn(&self.rising))?;
        let kind = self.kind;
        let values = drawn.iter().map(|s| (s.frequency, s.receptance * kind.of(s.frequency)));
        let laid_at = self.laid.iter().flat_map(|laid| {
            laid.measured.iter().zip(&laid.computed).map(|((f, _), value)| (*f, *value))
        });
        let mut values: Vec<_> = values.chain(laid_at).collect();
        values.sort_by(|a, b| a.0.total_cmp(&b.0));
        let subject = plot::response::ResponseCurves {
            bat: bat.name(),
            kind,
            at: self.places[0],
            to: self.places[1],
            values: &values,
            peaks: &self.peaks,
            measured: self.laid.as_ref().map_or(&[], |laid| &laid.measured),
        };
        Ok(plot::response::picture(sheet, &subject, name))
    }

    /// The exit code, after a word where an accuracy was not reached.
    fn verdict(&self, args: &Args) -> u8 {
        match self.frf.solution.worst() <= args.solve.tol {
            true => 0,
            false => args.solve.verdict(&self.frf.solution, &args.output),
        }
    }
}

/// The requested frequencies; by default those of a measured response.
fn asked(args: &Args, measured: Option<&MeasuredResponse>) -> GridArgs {
    match measured {
        Some(measured) => args.grid.as_measured(&measured.values),
        None => args.grid.clone(),
    }
}

/// The bat and its request, with modes up to the highest frequency of any response, and the theory for these.
fn prepared(args: &Args, bat: Bat, measured: &[&MeasuredResponse]) -> Result<Prepared> {
    let prepare = |modes| args.bat.prepare(bat.clone(), modes, &args.solve, &args.output);
    let mut modes = args.bat.count().max(1);
    // Another theory has other frequencies; the number no longer changes after as many rounds as there are theories.
    for _ in 0..Theory::ALL.len() {
        let Prepared { bat, request, warning } = prepare(modes)?;
        let request = Request { modes: request.modes.max(1), ..request };
        let grids = measured.iter().map(|measured| asked(args, Some(measured)));
        let own = measured.is_empty().then(|| asked(args, None));
        let reached = grids.chain(own).map(|grid| grid.reaching(&bat, &request));
        let reached = reached.collect::<Result<Vec<_>>>()?.into_iter().max().unwrap_or(modes);
        if reached <= modes {
            return Ok(Prepared { bat, request, warning });
        }
        modes = reached;
    }
    prepare(modes)
}

/// One response, and a measured one laid over it.
fn one(args: &Args, bat: Bat, measured: Option<&MeasuredResponse>) -> Result<Done> {
    let Prepared { bat, request, warning } = prepared(args, bat, measured.as_slice())?;
    let progress = args.output.progress("modes and answers");
    let mut answered = Answered::new(args, (&bat, &request), measured)?;
    drop(progress);
    let told = answered.told(args, &bat, measured);
    let document = report::document(&told);
    let every = args.grid.counted();
    let most = if every { usize::MAX } else { MANY };
    let table = args.output.screen(most, |full| report::text(&told, full, every));
    args.output.draw(&bat, |sheet| answered.picture(args, sheet, &bat, "response"))?;
    let Answered { samples, grid, kind, places: [at, to], .. } = &answered;
    let text = args.output.deliver(table, || document)?;
    let text = args.output.csv.deliver(text, || report::csv(*kind, samples))?;
    let text = put(&args.uff, text, || {
        let (kind, at, to, even) = (*kind, *at, *to, grid.even);
        let measured = Measured { bat: bat.name(), kind, at, to, even };
        let stamp = if args.reproducible { Stamp::fixed() } else { Stamp::now() };
        let held = |s: &&Sample| grid.even.is_none() || grid.asked.contains(&s.frequency);
        let held: Vec<Sample> = samples.iter().filter(held).copied().collect();
        uff58::write(&frf_uff::response(&measured, &held, &stamp))
    })?;
    Ok(Done::new(text, answered.verdict(args)).with(warning))
}

/// Every response of a file, a row each.
fn all(args: &Args, bat: Bat, measured: &[(usize, MeasuredResponse)]) -> Result<Done> {
    let of_one =
        [("--at", args.at.is_some()), ("--to", args.to.is_some()), ("--uff", args.uff.is_some())];
    if let Some((option, _)) = of_one.into_iter().find(|(_, given)| *given) {
        let found = format!("it beside {} responses", measured.len());
        return Err(Error::value(option, found, "one of them: --function N"));
    }
    let responses: Vec<&MeasuredResponse> = measured.iter().map(|(_, measured)| measured).collect();
    let Prepared { bat, request, warning } = prepared(args, bat, &responses)?;
    let progress = args.output.progress("modes and answers");
    let (mut rows, mut pictures, mut code) = (vec![], vec![], 0);
    let mut answers = vec![];
    for (number, measured) in measured {
        let of_it = |complaint: Complaint| {
            about(format!("{}, response {number}", complaint.field), complaint)
        };
        let answered = Answered::new(args, (&bat, &request), Some(measured));
        let mut answered = answered.map_err(|error| error.placed(of_it))?;
        code = code.max(answered.verdict(args));
        let told = answered.told(args, &bat, Some(measured));
        rows.extend(RowOfSet::new(*number, &told));
        answers.push(report::document(&told));
        if args.output.plots.is_some() {
            let sheet = args.output.sheet(&bat);
            pictures.extend(answered.picture(args, sheet, &bat, &format!("response_{number}"))?);
        }
    }
    drop(progress);
    let source = &measured[0].1.source;
    let units = args.output.units(&bat);
    let table = args.output.screen(MANY, |full| frf_set::text(&bat, source, &rows, (units, full)));
    let functions = rows.iter().map(|row| row.number).collect();
    let document = || Written::of(FrfSetFile { functions, responses: answers });
    let drawn = |_| Ok(pictures);
    let text = args.output.answer((&bat, table), drawn, document, || frf_set::csv(&rows))?;
    Ok(Done::new(text, code).with(warning))
}

/// Positions of the force and of the response (m): as given, else as measured.
fn places(args: &Args, bat: &Bat, measured: Option<&MeasuredResponse>) -> Result<[f64; 2]> {
    let missing = |what: &str, options: &str| {
        let source = measured.map_or(String::new(), |m| m.source.clone());
        let expected = format!("its node in a dataset 15 or 2411, or --places, or {options}");
        Error::value(source, format!("no place of the {what}"), expected)
    };
    let at = args.at.or(measured.and_then(|m| m.at));
    let at = at.ok_or_else(|| missing("force", "--at and --to"))?;
    let here = measured.is_none_or(|m| m.is_drive_point()).then_some(at);
    let to = args.to.or(measured.and_then(|m| m.to)).or(here);
    let to = to.ok_or_else(|| missing("answer", "--to"))?;
    // A place of the file is reported as such.
    let named = |option: Option<f64>, name: &str, what: &str| match (option, measured) {
        (None, Some(measured)) => {
            format!("{}: {what}, in its unit of length (--unit)", measured.source)
        }
        _ => name.to_owned(),
    };
    let [force, answer] = [
        named(args.at, "--at", "place of the force"),
        named(args.to, "--to", "place of the answer"),
    ];
    Ok([on_the_bat(bat, &force, at)?, on_the_bat(bat, &answer, to)?])
}
