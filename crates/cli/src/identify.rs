//! `sweetspot identify RESPONSES…`: the modes that measured responses share.

use std::path::PathBuf;

use sweetspot::base::error::Complaint;
use sweetspot::motion::frf::ResponseKind;
use sweetspot::{Error, Result};
use sweetspot_report::exchange::{frf_uff, shared_uff};
use sweetspot_report::plot::{Sheet, identify as plot};
use sweetspot_report::report::identify::IdentifyReport;
use sweetspot_study::files::measured::places;
use sweetspot_study::files::measured::response::Known;
use sweetspot_study::identify::modes::{Identified, TestKnown};
use sweetspot_study::identify::set::ResponseSet;
use sweetspot_study::identify::simulate::VirtualTest;
use uff58::Stamp;

use crate::common::{examples, read_with_text};
use crate::done::{Done, FAILED};
use crate::edits::EditArgs;
use crate::output::{DataArgs, LINES, drawing, put};
use crate::value::{
    FREQUENCY, HAMMER, PART_MASS, PLACE, RINGING_TIME, STIFFNESS, choice, file_unit, named,
};

/// Modes from measured frequency responses: hammer, accelerometer, a universal file
///
/// Reads frequency responses of one bat (universal files, dataset 58). The hammer strikes many places and an
/// accelerometer stays at one, or the other way round; H1 or H2; deflection, velocity or acceleration per force, in the
/// units that the axes name. It finds the modes that all responses share, with 95 % intervals from the noise of the
/// responses, and their shapes. A response with hammer and accelerometer at one place also gives the modal masses.
/// compare --measured and calibrate read the file of --out. The exit code is 1 if no mode is found.
#[derive(clap::Args)]
#[command(after_long_help = examples("identify"), mut_arg("plots", drawing("the stability of the poles and the shapes")), next_help_heading = "Output")]
pub struct Args {
    /// Universal files of responses; several are used together
    #[arg(required_unless_present = "simulate", help_heading = "The responses")]
    responses: Vec<PathBuf>,

    /// Unit of a file whose axes and datasets name no known one: that of the response per force, such as g/lbf, or a
    /// unit of length; the force is then in N, or in lbf with in and ft
    #[arg(long, value_name = "UNIT", help_heading = "The responses")]
    unit: Option<String>,

    /// Positions of the nodes of a file without geometry, from the knob end: "1=0 in, 2=3 in", or a CSV file with the
    /// columns node,x_in
    #[arg(long, value_name = "PLACES", help_heading = "The responses")]
    places: Option<String>,

    /// Kind of the responses if the axes do not name it: receptance, mobility or accelerance
    #[arg(long, value_name = "KIND", value_parser = named(ResponseKind::ALL, ResponseKind::name),
          hide_possible_values = true, help_heading = "The responses")]
    kind: Option<ResponseKind>,

    /// Ignore everything below this frequency
    #[arg(long, value_name = "Hz", value_parser = FREQUENCY, help_heading = "The responses")]
    from_hz: Option<f64>,

    /// Ignore everything above this frequency
    #[arg(long, value_name = "Hz", value_parser = FREQUENCY, help_heading = "The responses")]
    to_hz: Option<f64>,

    /// Mass of an accelerometer, such as "5 g", at most 100 g, whose effect is removed: of one that stayed, or of each
    /// in a row; in a virtual test 0 is a laser
    #[arg(long, value_name = "kg", value_parser = PART_MASS, help_heading = "The responses")]
    accelerometer: Option<f64>,

    /// Time in which the exponential window of the analyser falls to 1/e; its damping is removed
    #[arg(long, value_name = "s", value_parser = RINGING_TIME, help_heading = "The responses")]
    window: Option<f64>,

    #[command(flatten)]
    virtual_test: TestArgs,

    /// Write the modes as a universal file, datasets 2411 and 55, for compare and calibrate (- = standard output,
    /// and no table then)
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,

    /// Write the responses of the virtual test as a universal file, dataset 58
    #[arg(long, value_name = "FILE", requires = "simulate")]
    uff: Option<PathBuf>,

    /// Date the universal file 1 January 1970, so that equal input gives equal bytes
    #[arg(long)]
    reproducible: bool,

    #[command(flatten)]
    said: DataArgs,
}

/// A virtual test of a bat.
#[derive(clap::Args)]
#[command(next_help_heading = "A virtual test")]
struct TestArgs {
    /// Plan a test: what would a hammer and accelerometers find on this bat (file, or built-in name)
    #[arg(long, value_name = "BAT")]
    simulate: Option<PathBuf>,

    /// The part that moves from response to response: hammer or accelerometers (in a row, all at once)
    #[arg(long, value_name = "WHAT", action = clap::ArgAction::Set, hide_possible_values = true, requires = "simulate", default_value = "hammer",
          value_parser = choice(&["hammer", "accelerometers"], |name| name == "hammer"))]
    rove: bool,

    /// Places from end to end
    #[arg(long, value_name = "N", requires = "simulate", default_value_t = 15)]
    points: usize,

    /// Number of places that are missing, at random
    #[arg(long, value_name = "N", requires = "simulate", default_value_t = 0)]
    missing: usize,

    /// Number of places where the hammer bounces
    #[arg(long, value_name = "N", requires = "simulate", default_value_t = 0)]
    double_hits: usize,

    /// Position of the fixed part, from the knob end [default: the tip]
    #[arg(long, value_name = "m", requires = "simulate", value_parser = PLACE)]
    reference: Option<f64>,

    /// Mass of the hammer
    #[arg(long, value_name = "kg", requires = "simulate", default_value = "0.16", value_parser = HAMMER)]
    hammer: f64,

    /// Stiffness of its tip: some 3e5 for rubber, 2e6 for nylon, 1e7 for steel
    #[arg(long, value_name = "N/m", requires = "simulate", default_value = "1e7", value_parser = STIFFNESS)]
    tip: f64,

    /// Noise over the root mean square of a response, in dB
    #[arg(long, value_name = "dB", requires = "simulate", default_value_t = -50.0, allow_hyphen_values = true,
          value_parser = noise)]
    noise: f64,

    /// Which noise, and which places are missing
    #[arg(long, value_name = "N", requires = "simulate", default_value_t = 1)]
    seed: u64,
}

/// Noise in dB below the responses.
fn noise(text: &str) -> std::result::Result<f64, String> {
    let value = text.trim().trim_end_matches("dB").trim().parse::<f64>().ok();
    value.filter(|db| (-200.0..=0.0).contains(db)).ok_or("expected -200 to 0 dB".to_owned())
}

impl TestArgs {
    fn test(&self, of: &Args) -> VirtualTest {
        /// The default mass of an accelerometer (kg) and the default band (Hz).
        const USUAL: (f64, f64) = (0.005, 2000.0);
        VirtualTest {
            hammer_roves: self.rove,
            points: self.points,
            missing: self.missing,
            double_hits: self.double_hits,
            reference: self.reference,
            accelerometer: of.accelerometer.unwrap_or(USUAL.0),
            hammer: self.hammer,
            tip: self.tip,
            noise: self.noise,
            window: of.window,
            top: of.to_hz.unwrap_or(USUAL.1),
            seed: self.seed,
        }
    }
}

impl Args {
    /// The options about the files.
    fn known(&self) -> Result<Known> {
        let unit = self.unit.as_deref().and_then(|text| file_unit(text).ok());
        let label = self.unit.clone().filter(|_| unit.is_none());
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

    /// Refuses options of measured responses in a virtual test.
    fn check(&self) -> Result<()> {
        let given = [
            ("RESPONSES", !self.responses.is_empty()),
            ("--unit", self.unit.is_some()),
            ("--places", self.places.is_some()),
            ("--kind", self.kind.is_some()),
            ("--from-hz", self.from_hz.is_some()),
        ];
        let beside = |(_, given): &&(_, bool)| *given && self.virtual_test.simulate.is_some();
        let Some((name, _)) = given.iter().find(beside) else { return Ok(()) };
        let expected = "measured responses, or --simulate without it";
        Err(Error::value(*name, "it beside --simulate", expected))
    }

    fn test(&self) -> Result<TestKnown> {
        const HEAVIEST: f64 = 0.1;
        let laser = self.virtual_test.simulate.is_some() && self.accelerometer == Some(0.0);
        let none = |value: &f64| *value <= 0.0;
        if let Some(value) = self.accelerometer.filter(|value| none(value) && !laser) {
            return Err(Error::value("--accelerometer", value, "more than 0"));
        }
        if let Some(value) = self.accelerometer.filter(|value| *value > HEAVIEST) {
            return Err(Error::value("--accelerometer", format!("{value} kg"), "0.1 kg at most"));
        }
        if let Some(value) = self.window.filter(none) {
            return Err(Error::value("--window", value, "more than 0"));
        }
        Ok(TestKnown { accelerometer: self.accelerometer, window: self.window })
    }
}

pub fn run(args: &Args) -> Result<Done> {
    args.said.apart(&[("--out", &args.out), ("--uff", &args.uff)])?;
    args.check()?;
    let (band, mut test) = (args.band()?, args.test()?);
    let stamp = if args.reproducible { Stamp::fixed() } else { Stamp::now() };
    let simulated = match &args.virtual_test.simulate {
        None => None,
        Some(bat) => {
            let bat = read_with_text(bat, &EditArgs::default(), [args.said.quiet, false])?.0;
            let wanted = args.virtual_test.test(args);
            test.accelerometer = Some(wanted.accelerometer).filter(|mass| *mass > 0.0);
            Some((wanted.of(&bat)?, bat))
        }
    };
    let set = match &simulated {
        Some((one, _)) => one.set.clone(),
        None => ResponseSet::read(&args.responses, &args.known()?, band)?,
    };
    let found = Identified::of(&set, &test).map_err(|error| match (&simulated, error) {
        (Some(_), Error::Value(told)) => {
            let expected =
                "lighter ones, less noise or a longer window: such a test does not find the modes";
            Error::Value(Complaint { expected: expected.to_owned(), ..told })
        }
        (_, error) => error,
    })?;
    let about = simulated.as_ref().map(|(one, bat)| (one, bat.name()));
    let report = IdentifyReport { set: &set, found: &found, simulated: about };
    let table = args.said.screen(LINES, |full| report.text(full));
    let drawn = || Ok(plot::pictures(&set, &found, Sheet::file(false)));
    let out = args.said.answer(table, drawn, || report.document(), || report.csv())?;
    let name = about.map_or("", |(_, name)| name);
    let out = put(&args.uff, out, || uff58::write(&frf_uff::responses(name, &set, &stamp)))?;
    let out = put(&args.out, out, || uff58::write(&shared_uff::modes(&set, &found.modes, &stamp)))?;
    Ok(Done::new(out, if found.modes.is_empty() { FAILED } else { 0 }))
}
