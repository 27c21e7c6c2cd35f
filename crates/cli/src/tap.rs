//! `sweetspot tap BAT RECORDING…`: what follows from a recording of taps about the bat?

use std::path::PathBuf;

use sweetspot::{Error, Result};
use sweetspot_report::plot::sheet::Sheet;
use sweetspot_report::plot::tap as plot;
use sweetspot_report::report::calibrated_bat;
use sweetspot_report::report::tap::TapReport;
use sweetspot_report::schema;
use sweetspot_study::tap::tapped::{Tapped, Told};
use sweetspot_tap::analysis::Analysis;
use sweetspot_tap::decode::Part;

use crate::calibrate::label;
use crate::common::{as_options, examples, read_with_text};
use crate::done::{Done, FAILED};
use crate::edits::EditArgs;
use crate::output::{DataArgs, LINES, drawing, printed, put};
use crate::recording::read;
use crate::value::{MOMENT, TOP_FREQUENCY};

/// Tones of a recorded tap, the mode of each, and the wood
///
/// Reads a recording (m4a, wav, mp3, flac, ogg) in which the bat is tapped. It finds the taps, their tones and their
/// decay, assigns each tone to a mode of the bat or of a hollow barrel's wall, and fits the wood, all with 95 %
/// intervals. It reports what spoils a recording: clipping, gain control, a single tap, the room. The exit code is 1 if
/// there is no tap or no tone, or if the tones do not fit the bat.
///
/// How to tap well: hang the bat, or hold it with two fingers at a node, 6 to 7 in from the tip. Lay the phone a hand's
/// breadth from the barrel and record with a plain recorder app, with "enhanced recording" off. Tap the tip five to
/// eight times, a second apart, with a hard object the size of a knuckle, the label facing up, and let it ring. Move
/// the phone a hand's breadth between taps: that halves the error of the loss factor. Use a furnished room, and do not
/// speak. The other plane of the grain has other tones: turn the bat a quarter for it, record a second file, and name
/// both.
#[derive(clap::Args)]
#[command(after_long_help = examples("tap"), mut_arg("plots", drawing("the waveform, the spectrum and the decays")), next_help_heading = "Output")]
pub struct Args {
    /// Bat file (JSON), or the name of a built-in bat such as r161
    #[arg(help_heading = "The bat")]
    bat: PathBuf,

    /// Recordings of taps of this bat; several are used together
    #[arg(required = true, help_heading = "The recording")]
    recordings: Vec<PathBuf>,

    /// Assign a tone to a bending mode, such as "1187 = 3", or "1187 = none"; may be repeated
    #[arg(long, value_name = "HZ = N", value_parser = label, allow_hyphen_values = true,
          help_heading = "The bat")]
    mode: Vec<Told>,

    /// Tones alone: no modes and no wood
    #[arg(long, conflicts_with_all = ["mode", "out", "readings"], help_heading = "The bat")]
    only_tones: bool,

    /// Use the recording from this time on, such as "2 s"
    #[arg(long, value_name = "s", value_parser = MOMENT, help_heading = "The recording")]
    from: Option<f64>,

    /// Listen until this time
    #[arg(long, value_name = "s", value_parser = MOMENT, help_heading = "The recording")]
    to: Option<f64>,

    /// The channel, from 1 [default: the loudest]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=8),
          help_heading = "The recording")]
    channel: Option<u16>,

    /// Tones up to this frequency alone
    #[arg(long, value_name = "Hz", value_parser = TOP_FREQUENCY, help_heading = "The recording")]
    highest: Option<f64>,

    /// Write the tones as a readings file, for calibrate
    #[arg(long, value_name = "FILE")]
    readings: Option<PathBuf>,

    /// Write the bat with the fitted wood to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,

    #[command(flatten)]
    said: DataArgs,
}

/// The part of the recordings that is used.
fn part(args: &Args) -> Result<Part> {
    /// The lowest tone of a bat is above this (Hz).
    const LOWEST: f64 = 60.0;
    let (from, to) = (args.from.unwrap_or(0.0), args.to);
    if from < 0.0 {
        return Err(Error::value("--from", format!("{from} s"), "0 s or later"));
    }
    if let Some(to) = to.filter(|to| *to <= from) {
        return Err(Error::value("--to", format!("{to} s"), format!("a time after {from} s")));
    }
    if let Some(hz) = args.highest.filter(|hz| *hz < LOWEST) {
        return Err(Error::value("--highest", format!("{hz} Hz"), format!("{LOWEST} Hz or more")));
    }
    Ok(Part { from, to, channel: args.channel.map(usize::from) })
}

pub fn run(args: &Args) -> Result<Done> {
    args.said.apart(&[("--out", &args.out), ("--readings", &args.readings)])?;
    let (bat, text) = read_with_text(&args.bat, &EditArgs::default(), [args.said.quiet, false])?;
    let part = part(args)?;
    let recordings = args.recordings.iter().map(|path| read(path, part));
    let recordings = recordings.collect::<Result<Vec<_>>>()?;
    let again =
        |k: &usize| recordings[..*k].iter().any(|one| one.samples == recordings[*k].samples);
    if let Some(k) = (1..recordings.len()).find(again) {
        let found = "the same taps as in a recording before it";
        let expected = "each recording once: more of the same tells nothing more";
        return Err(Error::value(printed(&args.recordings[k]), found, expected));
    }
    let analysis = Analysis::of(&recordings, args.highest);
    let tapped = match args.only_tones {
        true => None,
        false => Tapped::heard(&bat, &analysis, &args.mode).map_err(as_options)?,
    };
    let report = TapReport {
        bat: &bat,
        recordings: &recordings,
        analysis: &analysis,
        tapped: tapped.as_ref(),
    };
    let table = args.said.screen(LINES, |_| report.text());
    let pictures = || Ok(plot::pictures(&report, Sheet::of(&bat)));
    let found = tapped.as_ref().and_then(|tapped| tapped.wood.as_ref());
    let out = args.said.answer(table, pictures, || report.document(), || report.csv())?;
    let out = match found {
        Some(found) => {
            let names: Vec<&str> = recordings.iter().map(|one| &*one.name).collect();
            let names = names.join(", ");
            let out = put(&args.readings, out, || Ok(schema::text(&report.readings())))?;
            put(&args.out, out, || calibrated_bat::text((&bat, &text), found, &names))?
        }
        None => {
            if args.out.is_some() || args.readings.is_some() {
                args.said.warn("no wood was found: --out and --readings write nothing");
            }
            out
        }
    };
    let fails = analysis.refused.is_some() || tapped.is_some_and(|tapped| !tapped.fits());
    Ok(Done::new(out, if fails { FAILED } else { 0 }))
}
