//! Which frequencies does `frf` evaluate, and with how many modes?

use faer::c64;

use sweetspot::modes::solve;
use sweetspot::motion::frf::Frf;
use sweetspot::{Bat, Error, Request, Result};
use uff58::six_digits;

use crate::value::{FREQUENCY, TOP_FREQUENCY};

/// Which frequencies.
#[derive(clap::Args, Clone)]
#[command(next_help_heading = "The force")]
pub struct GridArgs {
    /// Lowest frequency [default: a tenth of that of mode 1]
    #[arg(long, value_name = "Hz", value_parser = FREQUENCY)]
    pub from_hz: Option<f64>,

    /// Highest frequency [default: 1.2 times the last mode's]
    ///
    /// The number of modes follows from it.
    #[arg(long, value_name = "Hz", value_parser = TOP_FREQUENCY)]
    pub to_hz: Option<f64>,

    /// Number of frequencies from the lowest to the highest [default: 61]
    ///
    /// Files and pictures have more: every natural frequency in the range, and those around it that its peak needs.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    points: Option<u32>,

    /// Use equal steps instead of equal ratios
    #[arg(long)]
    linear: bool,

    /// These frequencies and no others, comma-separated, in place of a range
    #[arg(long, value_name = "Hz,Hz,…", value_delimiter = ',',
          conflicts_with_all = ["from_hz", "to_hz", "points", "linear"], value_parser = FREQUENCY)]
    frequencies: Vec<f64>,
}

/// The frequencies of an answer (Hz).
pub struct Grid {
    /// The requested frequencies.
    pub asked: Vec<f64>,
    /// These and those that show the peaks, without repetitions.
    pub all: Vec<f64>,
    /// Start and step if the requested ones are even.
    pub even: Option<[f64; 2]>,
}

impl GridArgs {
    /// Checks that the frequencies are possible.
    pub fn check(&self, free: bool) -> Result<()> {
        const MOST: f64 = 1e6;
        let asked = [("--from-hz", self.from_hz), ("--to-hz", self.to_hz)];
        let listed = self.frequencies.iter().map(|f| ("--frequencies", Some(*f)));
        for (name, f) in asked.into_iter().chain(listed) {
            if let Some(f) = f.filter(|f| !(0.0..=MOST).contains(f)) {
                return Err(Error::value(name, format!("{f:?} Hz"), "0 or more, 1e6 Hz at most"));
            }
        }
        let below = |low: f64, high: f64| low < high || (low == high && self.points == Some(1));
        match (self.from_hz, self.to_hz) {
            (Some(low), Some(high)) if !below(low, high) => {
                let expected = format!("more than {low:?} Hz");
                Err(Error::value("--to-hz", format!("{high:?} Hz"), expected))
            }
            (Some(0.0), _) if !self.linear => {
                Err(Error::value("--from-hz", "0 Hz", "more, or --linear: ratios have no 0"))
            }
            _ if free && (self.from_hz == Some(0.0) || self.frequencies.contains(&0.0)) => {
                Err(Error::value("frequencies", "0 Hz", "above 0 Hz: nothing holds the bat"))
            }
            _ => Ok(()),
        }
    }

    /// Whether the user gave a number of frequencies, or the frequencies.
    pub fn counted(&self) -> bool {
        self.points.is_some() || !self.frequencies.is_empty()
    }

    /// The same grid, with the range of a measurement unless a range was given.
    pub fn as_measured(&self, values: &[(f64, c64)]) -> Self {
        let (first, last) = (values.first().map(|v| v.0), values.last().map(|v| v.0));
        let listed = !self.frequencies.is_empty();
        let or = |asked: Option<f64>, other| if listed { asked } else { asked.or(other) };
        Self { from_hz: or(self.from_hz, first), to_hz: or(self.to_hz, last), ..self.clone() }
    }

    /// Number of modes up to the highest frequency, at least those of the request.
    pub fn reaching(&self, bat: &Bat, request: &Request) -> Result<usize> {
        const MOST: usize = 200;
        let listed = self.frequencies.iter().copied().reduce(f64::max);
        let mut request = *request;
        if let Some(highest) = self.to_hz.or(listed).or(self.from_hz) {
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
        Ok(request.modes)
    }

    /// The frequencies. `in_file` means that a universal file will hold them, which has six digits and no repetitions.
    pub fn grid(&self, frf: &Frf, in_file: bool) -> Result<Grid> {
        let (mut asked, even) = self.asked(frf, in_file);
        if in_file {
            self.rising(&mut asked)?;
        }
        let mut all = asked.clone();
        if self.frequencies.is_empty() && asked.len() > 1 {
            let ends = [asked[0], asked[asked.len() - 1]];
            // With even steps the file has only the even ones.
            let held = |f: f64| if in_file && even.is_none() { six_digits(f) } else { f };
            all.extend(frf.around_modes(ends).into_iter().map(held));
            all.sort_by(f64::total_cmp);
            all.dedup();
        }
        Ok(Grid { asked, all, even })
    }

    /// Enough frequencies for a curve that shows every dip; those of the grid if no range was given.
    pub fn drawn(&self, rising: &[f64]) -> Vec<f64> {
        const STEPS: usize = 1000;
        let (low, high) = (rising[0], rising[rising.len() - 1]);
        let between = (1..STEPS).map(|k| low + (high - low) * k as f64 / STEPS as f64);
        let between = between.filter(|_| self.frequencies.is_empty());
        let mut all: Vec<f64> = rising.iter().copied().chain(between).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }

    /// The requested frequencies, and start and step if they are even.
    fn asked(&self, frf: &Frf, in_file: bool) -> (Vec<f64>, Option<[f64; 2]>) {
        let held = |f: f64| if in_file { six_digits(f) } else { f };
        if !self.frequencies.is_empty() {
            return (self.frequencies.iter().map(|f| held(*f)).collect(), None);
        }
        let modes = &frf.solution.modes;
        let first = modes.first().map_or(1.0, |mode| mode.frequency());
        let last = modes.last().map_or(first, |mode| mode.frequency());
        let lowest = || (0.1 * first).min(0.5 * self.to_hz.unwrap_or(first));
        let low = self.from_hz.unwrap_or_else(lowest);
        let high = self.to_hz.unwrap_or_else(|| (1.2 * last).max(2.0 * low));
        let points = self.points.unwrap_or(61);
        let steps = f64::from(points - 1).max(1.0);
        let even = self.linear.then(|| [held(low), held((high - low) / steps)]);
        let at = |k: u32| match (f64::from(k) / steps, even) {
            (_, Some([start, step])) if in_file => start + f64::from(k) * step,
            (0.0, _) => held(low),
            (1.0, _) => held(high),
            (s, Some(_)) => low + (high - low) * s,
            (s, None) => held(low * (high / low).powf(s)),
        };
        ((0..points).map(at).collect(), even)
    }

    /// The abscissa of a universal file rises, and two values at one place would be two answers.
    fn rising(&self, frequencies: &mut [f64]) -> Result<()> {
        frequencies.sort_by(f64::total_cmp);
        let Some(pair) = frequencies.windows(2).find(|pair| pair[0] == pair[1]) else {
            return Ok(());
        };
        let found =
            format!("{:?} Hz more than once in the six digits of a universal file", pair[0]);
        let (option, expected) = match self.frequencies.is_empty() {
            true => ("--points", "fewer, a wider range, or --linear, whose steps are not rounded"),
            false => ("--frequencies", "each once"),
        };
        Err(Error::value(option, found, expected))
    }
}
