//! `sweetspot frf BAT`: the answer to a force that swings, over frequency.

use std::fmt::Write;
use std::path::PathBuf;

use faer::c64;

use crate::base::error::{Error, Result};
use crate::base::file;
use crate::base::units::inches;
use crate::bat::body::Bat;
use crate::files::schema::document::{Format, Generator};
use crate::files::schema::frf::{self as schema, Answer, FrfFile, Size};
use crate::files::uff::{self, Stamp, six_digits};
use crate::modes::solve::{self, Request};
use crate::motion::frf::{Frf, Kind, Sample};
use crate::motion::peaks::{Peak, around};
use crate::show::exchange::frf_uff::{self, Measured};
use crate::show::plot::response::{self, Curve};
use crate::show::report::text::{Units, edited, wrapped};

use crate::cli::common::{BatArgs, OutputArgs, Prepared, SolveArgs, examples};
use crate::cli::done::Done;
use crate::cli::pictures;
use crate::cli::value::{FREQUENCY, PLACE, TOP_FREQUENCY, named, shown_length};
use crate::show::csv::Csv;
use crate::show::report::columns::{Columns, numbers};

/// How the bat answers a shaker or a tap, over frequency
///
/// What would an accelerometer at one place see if a force swings at another? The table gives size
/// and phase of the deflection (receptance), velocity (mobility) or acceleration (accelerance) for
/// a unit force, and how much of it the modes left out may be; above it stand the peaks, each looked
/// for by itself. Undamped bats peak without bound at their frequencies: give the material a
/// loss_factor.
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

    /// Lowest frequency [default: a tenth of that of mode 1]
    #[arg(long, value_name = "Hz", help_heading = "The force", allow_hyphen_values = true,
          value_parser = |s: &str| FREQUENCY.read(s))]
    from_hz: Option<f64>,

    /// Highest frequency [default: a fifth beyond the last mode's]
    ///
    /// There are as many modes as it needs.
    #[arg(long, value_name = "Hz", help_heading = "The force", allow_hyphen_values = true,
          value_parser = |s: &str| TOP_FREQUENCY.read(s))]
    to_hz: Option<f64>,

    /// Number of frequencies from the lowest to the highest
    ///
    /// Without --linear more stand around every peak in CSV, JSON, pictures and universal files.
    #[arg(long, value_name = "N", default_value = "61", help_heading = "The force",
          value_parser = clap::value_parser!(u32).range(1..=100_000))]
    points: u32,

    /// Equal steps between them (else equal ratios)
    #[arg(long, help_heading = "The force")]
    linear: bool,

    /// These frequencies, comma-separated, in place of a range
    #[arg(long, value_name = "Hz,Hz,…", help_heading = "The force", value_delimiter = ',', allow_hyphen_values = true,
          conflicts_with_all = ["from_hz", "to_hz", "points", "linear"],
          value_parser = |s: &str| FREQUENCY.read(s))]
    frequencies: Vec<f64>,

    /// Write CSV to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    csv: Option<PathBuf>,

    /// Write a universal file, datasets 151, 164, 2411 and 58, to this file (- = standard output,
    /// and no table then). It has six digits for a frequency, so that all are rounded to that many
    /// first, and they rise; with --linear the steps are even in it
    #[arg(long, value_name = "FILE")]
    uff: Option<PathBuf>,

    /// Draw size and phase over frequency into this folder, as SVG and PNG
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    plots: Option<PathBuf>,

    /// 1 January 1970 for the date in the universal file, so that equal input gives equal bytes
    #[arg(long, requires = "uff")]
    reproducible: bool,

    #[command(flatten)]
    solve: SolveArgs,

    #[command(flatten)]
    output: OutputArgs,
}

const EXAMPLES: &str = "\
Examples:
  sweetspot frf r161 --at \"28 in\" --to \"2 in\" --kind mobility
      struck on the barrel, felt at the handle

  sweetspot frf dowel --at 0.3 --frequencies \"100,200,300\" --csv -
      three frequencies as CSV";

pub fn run(args: &Args) -> Result<Done> {
    args.solve.refuse_budget("frf")?;
    one_on_stdout(args)?;
    let (at, to) = (args.at, args.to.unwrap_or(args.at));
    let bat = args.bat.read(&args.output)?;
    for (name, x) in [("--at", at), ("--to", to)] {
        if !(0.0..=bat.length() * (1.0 + 4.0 * f64::EPSILON)).contains(&x) {
            let expected = format!("a place on the bat, 0 to {}", shown_length(bat.length()));
            return Err(Error::value(name, shown_length(x), expected));
        }
    }
    check(args, bat.fixtures().rigid_modes() > 0)?;
    let modes = args.bat.count().max(1);
    let prepared = args.bat.prepare(bat, modes, &args.solve, &args.output)?;
    let Prepared { bat, request, warning } = prepared;
    let request = Request { modes: request.modes.max(1), ..request };
    let [at, to] = [at, to].map(|x| x.min(bat.length()));
    let _progress = args.output.progress("modes and answers");
    let mut frf = reaching(&bat, &request, [at, to], args)?;
    let (asked, even) = frequencies(args, &frf);
    let mut frequencies = asked.clone();
    let mut samples = frf.receptances(&frequencies)?;
    let peaks = peaks(args, &frf, &frequencies);
    if even.is_none() && !peaks.is_empty() {
        add_peaks(args, &peaks, &mut frequencies);
        samples = frf.receptances(&frequencies)?;
    }
    if args.uff.is_some() {
        rising(args, &mut frequencies)?;
        samples = frf.receptances(&frequencies)?;
    }
    let measured = Measured { bat: bat.name(), kind: args.kind, at, to, even };
    let answers = Answers { bat: &bat, kind: args.kind, samples: &samples, peaks: &peaks };
    let table = || answers.table([at, to], &frf, &asked);
    let text = deliver(args, &measured, &samples)?.unwrap_or_else(table);
    if let Some(folder) = &args.plots {
        let subject = response::Subject {
            name: bat.name(),
            kind: args.kind,
            points: [at, to],
            linear: args.linear,
        };
        let curve = Curve { name: "computed", answers: answers.all() };
        let picture = response::picture(args.output.sheet(&bat), &subject, &[curve]);
        pictures::write(folder, picture.as_slice(), args.output.quiet)?;
    }
    let document = || document(&measured, &answers, &frf);
    let code = match frf.solution.worst() <= args.solve.tol {
        true => 0,
        false => args.solve.verdict(&frf.solution, &args.output),
    };
    Ok(Done::new(args.output.deliver(text, document)?, code).with(warning))
}

/// The peaks between the ends of a range; none of frequencies that were asked for one by one.
fn peaks(args: &Args, frf: &Frf, frequencies: &[f64]) -> Vec<Peak> {
    match (frequencies, args.frequencies.is_empty()) {
        ([low, .., high], true) => frf.peaks(args.kind, [*low, *high]),
        _ => vec![],
    }
}

/// Adds what shows the peaks, as a universal file holds it, each frequency once.
fn add_peaks(args: &Args, peaks: &[Peak], frequencies: &mut Vec<f64>) {
    let [low, high] = [frequencies[0], frequencies[frequencies.len() - 1]];
    let held = |f: f64| if args.uff.is_some() { six_digits(f) } else { f };
    let more = peaks.iter().flat_map(around).map(held).filter(|f| (low..=high).contains(f));
    frequencies.extend(more);
    frequencies.sort_by(f64::total_cmp);
    frequencies.dedup();
}

/// What was found.
struct Answers<'a> {
    bat: &'a Bat,
    kind: Kind,
    samples: &'a [Sample],
    peaks: &'a [Peak],
}

/// The `sweetspot-frf/1` document.
fn document(measured: &Measured, answers: &Answers, frf: &Frf) -> FrfFile {
    let Answers { bat, kind, samples, peaks } = *answers;
    let of = |part: &dyn Fn(&Sample) -> f64| samples.iter().map(part).collect::<Vec<f64>>();
    let value = |s: &Sample| s.receptance * kind.of(s.frequency);
    let (real, imaginary) = (of(&|s| value(s).re), of(&|s| value(s).im));
    let truncation = of(&|s| s.truncation * kind.of(s.frequency).norm());
    FrfFile {
        format: Format::new(),
        generator: Generator::this(),
        edits: bat.edits().to_vec(),
        kind: kind.name(),
        at_m: measured.at,
        to_m: measured.to,
        theory: frf.solution.theory.name(),
        modes: frf.solution.modes.len(),
        strains: frf.strains(),
        static_compliance_m_per_n: frf.static_compliance(),
        rigid_modes: frf.solution.rigid_modes,
        frequency_hz: of(&|s| s.frequency),
        answer: match kind {
            Kind::Receptance => Answer::Receptance { real, imaginary, truncation },
            Kind::Mobility => Answer::Mobility { real, imaginary, truncation },
            Kind::Accelerance => Answer::Accelerance { real, imaginary, truncation },
        },
        peaks: peaks.iter().map(|peak| of_peak(kind, peak)).collect(),
        frequencies_within: frf.solution.worst(),
    }
}

fn of_peak(kind: Kind, peak: &Peak) -> schema::Peak {
    let magnitude = peak.size;
    schema::Peak {
        mode: peak.mode,
        frequency_hz: peak.frequency,
        size: match kind {
            Kind::Receptance => Size::Receptance { magnitude },
            Kind::Mobility => Size::Mobility { magnitude },
            Kind::Accelerance => Size::Accelerance { magnitude },
        },
        half_power_damping_ratio: peak.damping,
    }
}

/// Standard output is for one document.
fn one_on_stdout(args: &Args) -> Result<()> {
    let named = [("--json", &args.output.json), ("--csv", &args.csv), ("--uff", &args.uff)];
    let mut there = named.into_iter().filter(|(_, path)| to_stdout(path.as_ref()));
    match (there.next(), there.next()) {
        (Some((first, _)), Some((second, _))) => {
            let found = format!("- beside {first} -");
            Err(Error::value(second, found, "one of them on standard output"))
        }
        _ => Ok(()),
    }
}

fn to_stdout(path: Option<&PathBuf>) -> bool {
    path.is_some_and(|path| path.as_os_str() == "-")
}

/// Writes the files that were asked for; what takes the place of the table.
fn deliver(args: &Args, measured: &Measured, samples: &[Sample]) -> Result<Option<String>> {
    let mut instead = None;
    let mut put = |path: &PathBuf, text: String| -> Result<()> {
        if to_stdout(Some(path)) {
            instead = Some(text);
            return Ok(());
        }
        file::write(path, text.as_bytes())
    };
    if let Some(path) = &args.csv {
        put(path, csv(args.kind, samples))?;
    }
    if let Some(path) = &args.uff {
        let stamp = if args.reproducible { Stamp::fixed() } else { Stamp::now() };
        put(path, uff::write(&frf_uff::response(measured, samples, &stamp))?)?;
    }
    Ok(instead)
}

/// Frequencies that can be asked for at all.
fn check(args: &Args, free: bool) -> Result<()> {
    const MOST: f64 = 1e6;
    let asked = [("--from-hz", args.from_hz), ("--to-hz", args.to_hz)];
    let listed = args.frequencies.iter().map(|f| ("--frequencies", Some(*f)));
    for (name, f) in asked.into_iter().chain(listed) {
        if let Some(f) = f.filter(|f| !(0.0..=MOST).contains(f)) {
            return Err(Error::value(name, format!("{f:?} Hz"), "0 or more, 1e6 Hz at most"));
        }
    }
    let below = |low: f64, high: f64| low < high || (low == high && args.points == 1);
    match (args.from_hz, args.to_hz) {
        (Some(low), Some(high)) if !below(low, high) => {
            Err(Error::value("--to-hz", format!("{high:?} Hz"), format!("more than {low:?} Hz")))
        }
        (Some(0.0), _) if !args.linear => {
            Err(Error::value("--from-hz", "0 Hz", "more, or --linear: ratios have no 0"))
        }
        _ if free && (args.from_hz == Some(0.0) || args.frequencies.contains(&0.0)) => {
            Err(Error::value("frequencies", "0 Hz", "above 0 Hz: nothing holds the bat"))
        }
        _ => Ok(()),
    }
}

/// The response with modes up to the highest frequency.
fn reaching(bat: &Bat, request: &Request, [at, to]: [f64; 2], args: &Args) -> Result<Frf> {
    const MOST: usize = 200;
    let listed = args
        .frequencies
        .iter()
        .copied()
        .fold(None, |most: Option<f64>, f| Some(most.map_or(f, |most| most.max(f))));
    let mut request = *request;
    if let Some(highest) = args.to_hz.or(listed).or(args.from_hz) {
        loop {
            let rough = Request { tolerance: request.tolerance.max(1e-3), ..request };
            let last = solve::solve(bat, &rough)?.modes.last().map_or(0.0, |m| m.frequency());
            if last >= highest {
                break;
            }
            if request.modes >= MOST {
                let expected = format!("less than {last:.0} Hz, the frequency of mode {MOST}");
                return Err(Error::value("--to-hz", format!("{highest:?} Hz"), expected));
            }
            request.modes = (2 * request.modes).min(MOST);
        }
    }
    Frf::new(bat, &request, at, to)
}

/// The frequencies; and start and step where they are even.
fn frequencies(args: &Args, frf: &Frf) -> (Vec<f64>, Option<[f64; 2]>) {
    // A universal file has that many digits for them.
    let held = |f: f64| if args.uff.is_some() { six_digits(f) } else { f };
    if !args.frequencies.is_empty() {
        return (args.frequencies.iter().map(|f| held(*f)).collect(), None);
    }
    let modes = &frf.solution.modes;
    let first = modes.first().map_or(1.0, |mode| mode.frequency());
    let last = modes.last().map_or(first, |mode| mode.frequency());
    let low = args.from_hz.unwrap_or_else(|| (0.1 * first).min(0.5 * args.to_hz.unwrap_or(first)));
    let high = args.to_hz.unwrap_or_else(|| (1.2 * last).max(2.0 * low));
    let steps = f64::from(args.points - 1).max(1.0);
    let even = args.linear.then(|| [held(low), held((high - low) / steps)]);
    let at = |k: u32| match (f64::from(k) / steps, even) {
        (_, Some([start, step])) if args.uff.is_some() => start + f64::from(k) * step,
        (0.0, _) => held(low),
        (1.0, _) => held(high),
        (s, Some(_)) => low + (high - low) * s,
        (s, None) => held(low * (high / low).powf(s)),
    };
    ((0..args.points).map(at).collect(), even)
}

/// The abscissa of a universal file rises, and two values at one place would be two answers.
fn rising(args: &Args, frequencies: &mut [f64]) -> Result<()> {
    frequencies.sort_by(f64::total_cmp);
    let Some(pair) = frequencies.windows(2).find(|pair| pair[0] == pair[1]) else { return Ok(()) };
    let found = format!("{:?} Hz more than once in the six digits of a universal file", pair[0]);
    let (option, expected) = match args.frequencies.is_empty() {
        true => ("--points", "fewer, a wider range, or --linear, whose steps are not rounded"),
        false => ("--frequencies", "each once"),
    };
    Err(Error::value(option, found, expected))
}

fn csv(kind: Kind, samples: &[Sample]) -> String {
    let unit = kind.unit();
    let mut table = Csv::new([
        "frequency_hz".to_owned(),
        format!("real_{unit}"),
        format!("imaginary_{unit}"),
        format!("magnitude_{unit}"),
        "phase_deg".to_owned(),
        format!("truncation_{unit}"),
    ]);
    for sample in samples {
        let factor = kind.of(sample.frequency);
        let value = sample.receptance * factor;
        table.row([
            sample.frequency.into(),
            value.re.into(),
            value.im.into(),
            value.norm().into(),
            phase(value.re, value.im).into(),
            (sample.truncation * factor.norm()).into(),
        ]);
    }
    table.text()
}

fn place(x: f64) -> String {
    format!("{x:.4} m ({:.2} in)", inches(x))
}

/// Degrees; 0 of nothing.
fn phase(re: f64, im: f64) -> f64 {
    // A zero without a sign: on the negative axis it would turn the phase over.
    (im + 0.0).atan2(re + 0.0).to_degrees()
}

impl Answers<'_> {
    /// Frequency and answer, in the unit of its kind.
    fn all(&self) -> Vec<(f64, c64)> {
        let of = |s: &Sample| (s.frequency, s.receptance * self.kind.of(s.frequency));
        self.samples.iter().map(of).collect()
    }

    /// The peaks, and the answer at the frequencies that were asked for.
    fn table(&self, [at, to]: [f64; 2], frf: &Frf, asked: &[f64]) -> String {
        let unit = match self.kind {
            Kind::Receptance => "m/N",
            Kind::Mobility => "m/(s N)",
            Kind::Accelerance => "1/kg",
        };
        let name = self.kind.name();
        let title =
            format!("Frequency response: {name} from a force at {} to {}", place(at), place(to));
        let mut out = wrapped(&title, 4) + &edited(self.bat, Units::Both);
        if !self.peaks.is_empty() {
            out += &self.peak_table(unit);
        }
        let columns = Columns::new([
            numbers(16, "frequency, Hz"),
            numbers(19, format!("size, {unit}")),
            numbers(15, "phase, deg"),
        ]);
        out += &columns.heads();
        for (frequency, value) in self.all().into_iter().filter(|(f, _)| asked.contains(f)) {
            out += &columns.row([
                format!("{frequency:.3}"),
                format!("{:.5e}", value.norm()),
                format!("{:.2}", phase(value.re, value.im)),
            ]);
        }
        let share = |s: &Sample| s.truncation / s.receptance.norm().max(f64::MIN_POSITIVE);
        let missing = self.samples.iter().map(share).fold(0.0, f64::max);
        let bending = if frf.solution.rigid_modes > 0 { ", of bending alone" } else { "" };
        let constant = frf.static_compliance();
        let _ = writeln!(out, "  under a constant force {constant:.6e} m/N{bending}");
        let modes = frf.solution.modes.len();
        let made = format!(
            "  made of {modes} modes and {} shapes for those above; at most {missing:.0e} of a value \
             is missing, and the modes' frequencies are within {:.0e}",
            frf.strains() - modes.min(frf.strains()),
            frf.solution.worst()
        );
        out += &wrapped(&made, 2);
        let more = self.samples.len() - asked.len().min(self.samples.len());
        if more > 0 {
            let told =
                format!("  {more} more frequencies around the peaks: --csv, --json, --plots");
            out += &wrapped(&told, 2);
        }
        out
    }

    fn peak_table(&self, unit: &str) -> String {
        let columns = Columns::new([
            numbers(6, "mode"),
            numbers(16, "peak, Hz"),
            numbers(19, format!("size, {unit}")),
            numbers(21, "half-power damping"),
        ]);
        let mut out = columns.heads();
        for peak in self.peaks {
            let size = peak.size.map_or("without bound".to_owned(), |size| format!("{size:.5e}"));
            let damping = match (peak.size, peak.damping) {
                (_, Some(damping)) => format!("{:.4} %", 100.0 * damping),
                (None, _) => "none".to_owned(),
                _ => "-".to_owned(),
            };
            let frequency = format!("{:.3}", peak.frequency);
            out += &columns.row([peak.mode.to_string(), frequency, size, damping]);
        }
        out + "\n"
    }
}
