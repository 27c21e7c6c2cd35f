//! `sweetspot identify RESPONSES…`: the modes that measured responses share.

use std::path::PathBuf;

use sweetspot::motion::frf::ResponseKind;
use sweetspot::{Error, Result};
use sweetspot_report::exchange::shared_uff;
use sweetspot_report::plot::{identify as plot, sheet::Sheet};
use sweetspot_report::report::identify::IdentifyReport;
use sweetspot_report::schema;
use sweetspot_study::files::measured::places;
use sweetspot_study::files::measured::response::Known;
use sweetspot_study::identify::modes::{Identified, TestKnown};
use sweetspot_study::identify::set::ResponseSet;
use uff58::Stamp;

use crate::common::examples;
use crate::done::{Done, FAILED};
use crate::output::{CsvArgs, FullArgs, LINES, apart, draw, put};
use crate::style;
use crate::value::{FREQUENCY, PART_MASS, RINGING_TIME, file_unit, named};

/// The modes that measured responses share: hammer, accelerometer, a universal file
///
/// Reads frequency responses of one bat (universal files, dataset 58): the hammer strikes many places and an
/// accelerometer stays at one, or the other way round; H1 or H2; deflection, velocity or acceleration per force, in the
/// units that the axes name. It finds the modes that all responses share, with 95 % intervals by the noise of the
/// responses, their shapes, and by a response whose hammer and accelerometer were at one place their modal masses.
/// compare --measured and calibrate read what --out writes. The exit code is 1 where no mode is found.
#[derive(clap::Args)]
#[command(after_long_help = examples(EXAMPLES), next_help_heading = "Output")]
pub struct Args {
    /// Universal files of responses; several are taken together
    #[arg(required = true, help_heading = "The responses")]
    responses: Vec<PathBuf>,

    /// Unit of a file whose axes and datasets name none that is known: of the answer per force, such as g/lbf, or
    /// of length, with N, or lbf for in and ft
    #[arg(long, value_name = "UNIT", help_heading = "The responses")]
    unit: Option<String>,

    /// Where the nodes of a file without geometry are, from the knob end: "1=0 in, 2=3 in", or a CSV file with the
    /// columns node,x_in
    #[arg(long, value_name = "PLACES", help_heading = "The responses")]
    places: Option<String>,

    /// What answers are whose axes do not say it: receptance, mobility or accelerance
    #[arg(long, value_name = "KIND", value_parser = named(ResponseKind::ALL, ResponseKind::name),
          hide_possible_values = true, help_heading = "The responses")]
    kind: Option<ResponseKind>,

    /// Leave out what is below this frequency
    #[arg(long, value_name = "Hz", value_parser = FREQUENCY, help_heading = "The responses")]
    from_hz: Option<f64>,

    /// Leave out what is above this frequency
    #[arg(long, value_name = "Hz", value_parser = FREQUENCY, help_heading = "The responses")]
    to_hz: Option<f64>,

    /// Mass of an accelerometer, such as "5 g", which is taken off: of one that stayed, or of each that stood in a
    /// row
    #[arg(long, value_name = "kg", value_parser = PART_MASS, help_heading = "The responses")]
    accelerometer: Option<f64>,

    /// Time in which the exponential window of the analyser falls to 1/e, whose damping is taken off
    #[arg(long, value_name = "s", value_parser = RINGING_TIME, help_heading = "The responses")]
    window: Option<f64>,

    /// Write the modes as a universal file, datasets 2411 and 55, for compare and calibrate (- = standard output,
    /// and no table then)
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,

    /// 1 January 1970 for the date in the universal file, so that equal input gives equal bytes
    #[arg(long)]
    reproducible: bool,

    /// Write JSON to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,

    #[command(flatten)]
    csv: CsvArgs,

    /// Draw the stability of the poles and the shapes into this folder, as SVG and PNG
    #[arg(long, value_name = "DIR")]
    plots: Option<PathBuf>,

    #[command(flatten)]
    said: FullArgs,
}

const EXAMPLES: &str = "\
Examples:
  sweetspot identify hammer.uff --out modes.uff
  sweetspot compare r161 --measured modes.uff
      the modes of a hammer test, beside those of the bat

  sweetspot identify hammer.uff --to-hz \"2 kHz\" --accelerometer \"5 g\"
      up to 2 kHz, without the mass of the accelerometer";

impl Args {
    /// What the options say of the files.
    fn known(&self) -> Result<Known> {
        let unit = self.unit.as_deref().map(|text| (file_unit(text), text));
        let (unit, label) = match unit {
            None => (None, None),
            Some((Ok(unit), _)) => (Some(unit), None),
            Some((Err(_), text)) => (None, Some(text.to_owned())),
        };
        let places = self.places.as_deref().map(places::read).transpose()?;
        Ok(Known { unit, label, kind: self.kind, places, ..Known::default() })
    }

    fn band(&self) -> Result<[f64; 2]> {
        let band = [self.from_hz.unwrap_or(0.0), self.to_hz.unwrap_or(f64::INFINITY)];
        if band[0] < band[1] && band[0] >= 0.0 {
            return Ok(band);
        }
        let expected = format!("a frequency above {} Hz", band[0].max(0.0));
        Err(Error::value("--to-hz", format!("{} Hz", band[1]), expected))
    }

    fn test(&self) -> Result<TestKnown> {
        for (option, value) in [("--accelerometer", self.accelerometer), ("--window", self.window)] {
            if let Some(value) = value.filter(|value| *value <= 0.0) {
                return Err(Error::value(option, value, "more than 0"));
            }
        }
        Ok(TestKnown { accelerometer: self.accelerometer, window: self.window })
    }
}

pub fn run(args: &Args) -> Result<Done> {
    apart(&[("--json", &args.json), ("--csv", &args.csv.csv), ("--out", &args.out)])?;
    let (band, test) = (args.band()?, args.test()?);
    let set = ResponseSet::read(&args.responses, &args.known()?, band)?;
    let found = Identified::of(&set, &test)?;
    let report = IdentifyReport { set: &set, found: &found };
    let table = args.said.screen(LINES, |_| report.text());
    draw(&args.plots, args.said.quiet, || Ok(plot::pictures(&set, &found, Sheet::file(false))))?;
    let out = args.csv.deliver(style::table(&table), || report.csv())?;
    let out = put(&args.out, out, || {
        let stamp = if args.reproducible { Stamp::fixed() } else { Stamp::now() };
        uff58::write(&shared_uff::modes(&set, &found.modes, &stamp))
    })?;
    let out = put(&args.json, out, || Ok(schema::text(&report.document())))?;
    Ok(Done::new(out, if found.modes.is_empty() { FAILED } else { 0 }))
}
