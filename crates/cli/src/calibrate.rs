//! `sweetspot calibrate BAT [MEASURED]`: the properties of the wood, from measurements.

use std::io::{IsTerminal, StdinLock, stdin};
use std::path::{Path, PathBuf};

use sweetspot::base::file;
use sweetspot::{Bat, Error, Request, Result};
use sweetspot_report::plot::calibrate as pictures_of;
use sweetspot_report::report::{calibrate, calibrated_bat};
use sweetspot_study::calibrate::calibration::{Calibration, CalibrationPlan, Property};
use sweetspot_study::calibrate::labels::MOST_MODES;
use sweetspot_study::calibrate::readings::{BatReadings, Reading, RingDown, SpectralLine};
use sweetspot_study::files::measured::{self, Beside};
use sweetspot_study::files::readings_file::ReadingsForm;
use sweetspot_study::files::written::WrittenFile;
use sweetspot_study::measured::data::Measured;
use sweetspot_study::measured::pairing::LEAST;
use sweetspot_study::measured::study::{ALIKE, Shapes, Study};

use crate::asking::dialogue::Dialogue;
use crate::asking::draft;
use crate::asking::readings_asked::asked;
use crate::beside::BesideArgs;
use crate::common::{Prepared, about, examples, prepare, read_with_text};
use crate::done::{Done, FAILED};
use crate::edits::EditArgs;
use crate::output::{DataArgs, LINES, drawing, printed, put, warn};
use crate::value::{PLACE, TheoryChoice, choice};

/// The wood of a bat: E, G and density from scale, ruler, pendulum and tap
///
/// Reads measurements of a bat and fits the properties of the wood to them. Each property has its 95 % interval, and
/// the shares of the readings and of prior knowledge in it. It reports readings that do not fit and lines that were
/// assigned to another mode, and it names the measurement that would add most. Without a file of readings it asks for
/// them. A mismatch is reported, not fitted away: the exit code is then 1.
#[derive(clap::Args)]
#[command(after_long_help = examples("calibrate"), mut_arg("plots", drawing("the properties before and after, and the misfits,")), next_help_heading = "Output")]
pub struct Args {
    /// Bat file (JSON), or the name of a built-in bat such as r161
    #[arg(help_heading = "The bat")]
    bat: PathBuf,

    /// Readings file (JSON), a table of measured modes as for compare --measured, or a recording of taps as for tap
    /// [default: it asks]
    #[arg(help_heading = "The bat")]
    measured: Option<PathBuf>,

    /// Fit two regions of wood; the barrel's begins at this place, such as "42 cm"
    #[arg(long, value_name = "m", value_parser = PLACE, help_heading = "The bat")]
    regions: Option<f64>,

    /// Keep as the file has it: E, G (its share of E), density, density-barrel or ratio; may be repeated
    #[arg(long, value_name = "NAME", value_parser = held(), hide_possible_values = true,
          help_heading = "The bat")]
    hold: Vec<Property>,

    /// Assign a line to a bending mode, such as "1187 = 3", or "1187 = none"; may be repeated
    #[arg(long, value_name = "HZ = N", value_parser = label, allow_hyphen_values = true,
          help_heading = "The bat")]
    mode: Vec<(f64, Option<usize>)>,

    #[command(flatten)]
    beside: BesideArgs,

    /// Read answers from standard input, one per line, even when it is not a terminal
    #[arg(long, conflicts_with = "measured", help_heading = "The bat")]
    ask: bool,

    /// Write the answers as a readings file
    #[arg(long, value_name = "FILE", conflicts_with = "measured")]
    readings: Option<PathBuf>,

    /// Write the bat with the fitted wood to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,

    #[command(flatten)]
    said: DataArgs,
}

/// Unknowns by their names on the command line.
fn held() -> impl clap::builder::TypedValueParser<Value = Property> {
    choice(&["E", "G", "density", "density-barrel", "ratio"], |name| match name {
        "E" => Property::YoungsModulus,
        "G" => Property::ShearModulus,
        "density" => Property::Density,
        "density-barrel" => Property::BarrelDensity,
        _ => Property::ModulusRatio,
    })
}

/// A line by its frequency (Hz), and the mode that it is.
pub fn label(text: &str) -> std::result::Result<(f64, Option<usize>), String> {
    let expected = || {
        format!(
            "expected a frequency in Hz and the number of its bending mode, 1 to {MOST_MODES} or none, such as \"1187 = 3\""
        )
    };
    let (hz, mode) = text.split_once('=').ok_or_else(expected)?;
    let hz = hz.trim().trim_end_matches("Hz").trim().parse().map_err(|_| expected())?;
    let mode = match mode.trim() {
        "none" => None,
        mode => {
            let number = mode.parse().ok().filter(|mode| (1..=MOST_MODES).contains(mode));
            Some(number.ok_or_else(expected)?)
        }
    };
    Ok((hz, mode))
}

/// The lines with the labels of `--mode`; a line labelled none is omitted.
fn told_again(lines: &mut Vec<SpectralLine>, told: &[(f64, Option<usize>)]) -> Result<()> {
    /// A line may be named by a rounded frequency.
    const NEAR: f64 = 0.01;
    for (hz, mode) in told {
        let far = |line: &SpectralLine| (line.frequency.value / hz).ln().abs();
        let near = (0..lines.len()).min_by(|a, b| far(&lines[*a]).total_cmp(&far(&lines[*b])));
        let Some(k) = near.filter(|k| far(&lines[*k]) < NEAR) else {
            let all: Vec<String> =
                lines.iter().map(|line| line.frequency.value.to_string()).collect();
            let expected = format!("one of the lines: {} Hz", all.join(", "));
            return Err(Error::value("--mode", format!("{hz} Hz"), expected));
        };
        match mode {
            None => drop(lines.remove(k)),
            Some(order) => {
                if lines.iter().enumerate().any(|(j, line)| j != k && line.mode == *mode) {
                    let found = format!("mode {order} for a second line");
                    return Err(Error::value("--mode", found, "every mode once"));
                }
                lines[k].mode = *mode;
            }
        }
    }
    Ok(())
}

/// The command with the labels that fit, if the given ones do not.
fn relabelled(args: &Args, found: &Calibration) -> Option<String> {
    let measured = args.measured.as_deref().map_or("readings.json".to_owned(), printed);
    let label = |k: &usize| {
        let mode = found.labels.taken[*k].map_or("none".to_owned(), |mode| mode.to_string());
        format!(" --mode \"{} = {mode}\"", found.labels.lines_hz[*k])
    };
    let labels: String = found.labels.changed().iter().map(label).collect();
    (!labels.is_empty()).then(|| {
        format!(
            "With these labels:\n  sweetspot calibrate {} {measured}{labels}\n",
            printed(&args.bat)
        )
    })
}

pub fn run(args: &Args) -> Result<Done> {
    args.said.apart(&[("--out", &args.out), ("--readings", &args.readings)])?;
    let (bat, text) = read_with_text(&args.bat, &EditArgs::default(), [args.said.quiet, false])?;
    let Some(told) = readings(args, &bat)? else { return Ok(Done::new(String::new(), 0)) };
    let MeasuredArgs { mut readings, name, person } = told;
    told_again(&mut readings.lines, &args.mode)?;
    let plan = CalibrationPlan { split: args.regions, held: args.hold.clone() };
    let found = Calibration::new(&bat, readings, &plan).map_err(as_told(args))?;
    let table = args.said.screen(LINES, |_| {
        let [wood, data, words] = calibrate::text(&bat, &found);
        [wood, data, words, (0, "", relabelled(args, &found).unwrap_or_default())]
    });
    let drawn = || Ok(pictures_of::pictures(bat.name(), &found));
    let document = || calibrate::document(&bat, &found);
    let text_of = || calibrated_bat::text((&bat, &text), &found, &name);
    let out = args.said.answer(table, drawn, document, || calibrate::csv(&found))?;
    let out = put(&args.out, out, text_of)?;
    if let Some(mut person) = person {
        person.done();
    }
    Ok(Done::new(out, if found.fits { 0 } else { FAILED }))
}

/// An error about a reading or an option, by the name that it has for the user.
fn as_told(args: &Args) -> impl Fn(Error) -> Error + '_ {
    let file = args.measured.as_deref().map_or("the answers".to_owned(), printed);
    move |error| {
        error.placed(|complaint| {
            let field = match &*complaint.field {
                "regions" => "--regions".to_owned(),
                "--hold" | "bat" | "edits" => complaint.field.clone(),
                field => format!("{file}: {field}"),
            };
            about(field, complaint)
        })
    }
}

/// The measurements.
struct MeasuredArgs {
    readings: BatReadings,
    /// Their name.
    name: String,
    /// The dialogue, if a person was asked: the answers are kept until the end.
    person: Option<Dialogue<StdinLock<'static>>>,
}

/// Place of the kept answers, which belong to one bat.
fn draft(args: &Args) -> PathBuf {
    let bat = args.bat.file_stem().unwrap_or_default().to_string_lossy();
    draft::stem(args.readings.as_deref(), &format!("{bat}-calibrate"))
}

/// Reads the measurements, or asks for them; `None` if the person left.
fn readings(args: &Args, bat: &Bat) -> Result<Option<MeasuredArgs>> {
    let Some(path) = &args.measured else {
        if !args.ask && !stdin().is_terminal() {
            let expected = "a readings file, such as readings.json, or --ask to answer questions";
            return Err(Error::value("MEASURED", "none", expected));
        }
        let mut person = Dialogue::kept(stdin().lock(), ("calibrate", &draft(args)), bat.name());
        let Some(text) = person.hold(|person| asked(person, bat))? else { return Ok(None) };
        if let Some(path) = &args.readings {
            file::write(path, text.as_bytes())?;
        }
        // Answers without information must not be offered again.
        let readings = ReadingsForm::from_text("the answers", &text, Path::new(""))
            .inspect_err(|_| person.done())?;
        return Ok(Some(MeasuredArgs {
            readings,
            name: "answers".to_owned(),
            person: Some(person),
        }));
    };
    let name = path.file_name().map_or(printed(path), |name| printed(Path::new(name)));
    let beside = args.beside.read()?;
    #[cfg(feature = "audio")]
    if sweetspot_tap::decode::is_recording(path) && beside == Beside::default() {
        let readings = crate::recording::readings(path, bat, args.said.quiet)?;
        return Ok(Some(MeasuredArgs { readings, name, person: None }));
    }
    let readings = if measured::has_modes(path) {
        of_modes(measured::read(path, &beside)?, bat, args.said.quiet)?
    } else if beside != Beside::default() {
        let expected = "a universal file (.uff, .unv): readings have their units";
        return Err(Error::value("--unit, --places or --frequency-unit", name, expected));
    } else {
        ReadingsForm::from_file(path)?
    };
    Ok(Some(MeasuredArgs { readings, name, person: None }))
}

/// Measured modes as lines: their frequencies within 0.5 Hz, their damping as tones over one cycle.
fn of_modes(measured: Measured, bat: &Bat, quiet: bool) -> Result<BatReadings> {
    /// Standard deviation of a frequency in a table (Hz).
    const WITHIN: f64 = 0.5;
    let (measured, labels, unlike) = by_shape(bat, measured)?;
    measured.assumed.iter().for_each(|text| warn(&format!("note: {text}"), quiet));
    let settled = labels.iter().any(Option::is_some);
    let mut readings = BatReadings { unlike, ..BatReadings::default() };
    for (mode, label) in measured.modes.iter().zip(labels) {
        if settled && label.is_none() {
            let text = "is like no bending mode of this bat, or another is more so: left out";
            warn(&format!("note: {} {text}", mode.name), quiet);
            continue;
        }
        let order = mode.order.or(label);
        let frequency = Reading { value: mode.frequency, deviation: WITHIN };
        readings.lines.push(SpectralLine { frequency, mode: order });
        let damped = mode.damping_ratio.filter(|ratio| *ratio > 0.0);
        if let (Some(order), Some(damped)) = (order, damped) {
            let ratio = (-std::f64::consts::TAU * damped).exp();
            readings.ring_down.push(RingDown { mode: order, cycles: 1.0, ratio });
        }
    }
    Ok(readings)
}

/// Measured modes, and for each the number of the computed mode with its shape (`None` if the shape does not decide);
/// also the number of modes whose shape matches none.
fn by_shape(bat: &Bat, measured: Measured) -> Result<(Measured, Vec<Option<usize>>, usize)> {
    let mut labels = vec![None; measured.modes.len()];
    if !measured.has_shapes() {
        return Ok((measured, labels, 0));
    }
    let request = Request { modes: 10, ..Request::default() };
    let Prepared { bat, request, .. } = prepare(bat.clone(), TheoryChoice(None), request, true)?;
    let study = Study::new(&bat, measured, &request, false, Default::default())?;
    for pair in study.pairs.iter().filter(|pair| pair.mac.is_some_and(|mac| mac >= ALIKE)) {
        labels[pair.measured] = Some(pair.computed + 1);
    }
    let best = |row: &Vec<f64>| row.iter().fold(0.0_f64, |most, mac| most.max(*mac));
    let unlike = |shapes: &Shapes| shapes.mac.iter().filter(|row| best(row) < LEAST).count();
    let unlike = study.shapes.as_ref().map_or(0, unlike);
    Ok((study.measured, labels, unlike))
}
