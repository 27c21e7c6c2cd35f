//! A frequency response and its peaks, as table, CSV and JSON.

use std::fmt::Write;

use crate::csv::Csv;
use crate::parts::{Quantity, Units, lines, numbers, wrapped};
use crate::report::text::edited;
use crate::schema::Written;
use crate::schema::frf::{
    FrfFile, Height, MeasuredAnswer, MeasuredValues, PeakBeside, PeakLine, ResponseValues,
};
use sweetspot::Bat;
use sweetspot::base::units::{POUND_FORCE, gravities, inches};
use sweetspot::motion::frf::{Frf, ResponseKind, Sample};
use sweetspot::motion::peaks::Peak;
use sweetspot_study::ignored::published_damping;
use sweetspot_study::measured::response::{Laid, MeasuredResponse};

/// A response to report.
pub struct ToldResponse<'a> {
    /// The bat that answers.
    pub bat: &'a Bat,
    /// Deflection, velocity or acceleration.
    pub kind: ResponseKind,
    /// Positions of the force and of the response (m from the knob end).
    pub places: [f64; 2],
    /// The response.
    pub frf: &'a Frf,
    /// The answers.
    pub samples: &'a [Sample],
    /// The requested frequencies (Hz); others serve to show the peaks.
    pub asked: &'a [f64],
    /// The peaks of the answer.
    pub peaks: &'a [Peak],
    /// The units of places and answers.
    pub units: Units,
    /// A measured response, laid over it.
    pub measured: Option<(&'a MeasuredResponse, &'a Laid)>,
}

/// The `sweetspot-frf/1` document.
pub fn document(told: &ToldResponse) -> Written<FrfFile> {
    let ToldResponse { bat, kind, places: [at, to], frf, samples, peaks, .. } = *told;
    let of = |part: &dyn Fn(&Sample) -> f64| samples.iter().map(part).collect::<Vec<f64>>();
    let value = |s: &Sample| s.receptance * kind.of(s.frequency);
    let (real, imaginary) = (of(&|s| value(s).re), of(&|s| value(s).im));
    let truncation = of(&|s| s.truncation * kind.of(s.frequency).norm());
    Written::of(FrfFile {
        edits: bat.edits().to_vec(),
        kind: kind.name(),
        at_m: at,
        to_m: to,
        theory: frf.solution.theory.name(),
        modes: frf.solution.modes.len(),
        strains: frf.strains(),
        static_compliance_m_per_n: frf.static_compliance(),
        rigid_modes: frf.solution.rigid_modes,
        frequency_hz: of(&|s| s.frequency),
        answer: ResponseValues::of(kind, real, imaginary, truncation),
        peaks: peaks.iter().map(|peak| line(kind, peak)).collect(),
        measured: told.measured.map(|(response, laid)| beside(kind, response, laid)),
        damping_ratios_as_measured: frf.damping_ratios().to_vec(),
        frequencies_within: frf.solution.worst(),
        ignored: published_damping(bat).into_iter().collect(),
    })
}

/// A peak as in a document.
pub fn line(kind: ResponseKind, peak: &Peak) -> PeakLine {
    PeakLine {
        mode: peak.mode,
        natural_frequency_hz: peak.natural,
        frequency_hz: peak.frequency,
        height: Height::of(kind, peak.height),
        damping_ratio: peak.damping_ratio(),
        half_power_hz: peak.half_power,
    }
}

fn beside(kind: ResponseKind, response: &MeasuredResponse, laid: &Laid) -> MeasuredAnswer {
    let real = laid.measured.iter().map(|(_, value)| value.re).collect();
    let imaginary = laid.measured.iter().map(|(_, value)| value.im).collect();
    let pair = |(computed, measured): &(Peak, Option<Peak>)| PeakBeside {
        computed: line(kind, computed),
        measured: measured.as_ref().map(|peak| line(kind, peak)),
        frequency_difference: measured.map(|m| computed.frequency / m.frequency - 1.0),
        level_difference_db: measured.as_ref().and_then(|m| level(computed, m)),
    };
    MeasuredAnswer {
        source: response.source.clone(),
        assumed: response.assumed.clone(),
        frequency_hz: laid.measured.iter().map(|(f, _)| *f).collect(),
        answer: MeasuredValues::of(kind, real, imaginary),
        frac: laid.frac,
        mean_level_difference_db: laid.level,
        mean_absolute_level_difference_db: laid.apart,
        peaks: laid.peaks.iter().map(pair).collect(),
    }
}

/// Level of a computed peak relative to a measured one (dB).
fn level(computed: &Peak, measured: &Peak) -> Option<f64> {
    let level = 20.0 * (computed.height? / measured.height?).log10();
    Some(level).filter(|level| level.is_finite())
}

/// A row for every frequency.
pub fn csv(kind: ResponseKind, samples: &[Sample]) -> String {
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

/// Degrees; 0 for the number 0.
pub fn phase(re: f64, im: f64) -> f64 {
    // A zero without a sign: on the negative axis it would turn the phase over.
    (im + 0.0).atan2(re + 0.0).to_degrees()
}

/// The unit of an answer for people, and the number of these units per SI unit.
pub fn unit(kind: ResponseKind, us: bool) -> (&'static str, f64) {
    match (kind, us) {
        (ResponseKind::Receptance, false) => ("m/N", 1.0),
        (ResponseKind::Mobility, false) => ("m/(s N)", 1.0),
        (ResponseKind::Accelerance, false) => ("1/kg", 1.0),
        (ResponseKind::Receptance, true) => ("in/lbf", inches(POUND_FORCE)),
        (ResponseKind::Mobility, true) => ("in/(s lbf)", inches(POUND_FORCE)),
        (ResponseKind::Accelerance, true) => ("g/lbf", gravities(POUND_FORCE)),
    }
}

/// Frequencies and peaks that a screen has.
const FREQUENCIES: usize = 12;
const PEAKS: usize = 10;

/// The response at the requested frequencies, the peaks, and the settings. `full` gives all of it and `every` all
/// requested frequencies. The screen of a measured response has only the peaks, compared with the measured ones.
pub fn text(told: &ToldResponse, full: bool, every: bool) -> String {
    let ToldResponse { bat, kind, places: [at, to], frf, samples, asked, peaks, measured, units } =
        *told;
    let (us, most) = (units == Units::Us, if full { usize::MAX } else { PEAKS });
    let [at, to] = [at, to].map(|x| Quantity::Length.said(units, x));
    let title = format!(
        "Frequency response of {}: {} from a force at {at} to {to}",
        bat.title(),
        kind.name()
    );
    let mut out = wrapped(&title, 4) + &edited(bat, units);
    if full || every || measured.is_none() {
        out += &answers(told, if full || every { usize::MAX } else { FREQUENCIES });
    }
    if full || measured.is_none() {
        out += &listed(unit(kind, us), peaks, most);
    }
    let between = samples.len().saturating_sub(asked.len());
    if full && between > 0 {
        let so = format!(
            "  {between} more frequencies, at and around the natural ones, show the peaks in files \
             and pictures"
        );
        out += &wrapped(&so, 2);
    }
    if frf.still {
        return out + "  zero: a support keeps the bat at rest there\n";
    }
    let share = |s: &Sample| s.truncation / s.receptance.norm().max(f64::MIN_POSITIVE);
    let missing = samples.iter().map(share).fold(0.0, f64::max);
    let bending = if frf.solution.rigid_modes > 0 { ", of bending alone" } else { "" };
    let (name, per) = unit(ResponseKind::Receptance, us);
    let still = per * frf.static_compliance();
    let _ = writeln!(out, "  under a constant force {still:.6e} {name}{bending}");
    let modes = frf.solution.modes.len();
    let made = format!(
        "  made of {modes} modes and {} shapes for those above; at most {missing:.0e} of a value \
         is missing, and the modes' frequencies are within {:.0e}",
        frf.strains() - modes.min(frf.strains()),
        frf.solution.worst()
    );
    out += &wrapped(&made, 2);
    if let Some((response, laid)) = measured {
        out += &differences((bat, frf), response, laid, most);
    }
    out
}

/// The response at the given number of requested frequencies at most, evenly chosen.
fn answers(told: &ToldResponse, most: usize) -> String {
    let ToldResponse { kind, samples, asked, units, .. } = *told;
    let (name, per) = unit(kind, units == Units::Us);
    let asked_for = samples.iter().filter(|sample| asked.contains(&sample.frequency));
    let value = |sample: &Sample| sample.receptance * kind.of(sample.frequency);
    lines(
        asked_for.step_by(asked.len().div_ceil(most).max(1)),
        &[
            (numbers(16, "frequency, Hz"), &|sample| format!("{:.3}", sample.frequency)),
            (numbers(19, format!("size, {name}")), &|sample| {
                format!("{:.5e}", per * value(sample).norm())
            }),
            (numbers(15, "phase, deg"), &|sample| {
                format!("{:.2}", phase(value(sample).re, value(sample).im))
            }),
        ],
    )
}

/// The number of peaks not shown; empty where all are.
fn beyond(peaks: usize, most: usize) -> String {
    match peaks.saturating_sub(most) {
        0 => String::new(),
        more => format!("  and {more} more\n"),
    }
}

/// The meaning of the criterion.
pub const FRAC: &str = "  FRAC: 1 where both responses are alike but for a factor, 0 where they have nothing in common; peaks \
    that lie apart by more than their width already bring it near 0";

/// A remark about damping as measured, or about an undamped bat compared with a measurement; empty for another.
pub fn damping(bat: &Bat, frf: &Frf) -> String {
    if !frf.damping_ratios().is_empty() {
        let all = frf.damping_ratios().iter().map(|ratio| format!("{:.2}", 100.0 * ratio));
        let all: Vec<String> = all.collect();
        let said = format!(
            "  The computed modes are damped as the measured ones, {} %; those without a measured peak have the \
             mean of the others",
            all.join(", ")
        );
        return wrapped(&said, 2);
    }
    if bat.damped() {
        return String::new();
    }
    let undamped = "  The computed bat has no damping and its peaks no height: beside a measured one its level and \
                    FRAC say nothing of the bat. Take the damping of the measured peaks, --damping measured, or give \
                    the material a \"loss_factor\", twice their damping ratio.";
    wrapped(undamped, 2)
}

/// The comparison of a measured response with the computed one: the given number of peaks at most, and both as a whole.
fn differences(
    (bat, frf): (&Bat, &Frf),
    response: &MeasuredResponse,
    laid: &Laid,
    most: usize,
) -> String {
    let title = format!("\nMeasured, {}, at {} frequencies", response.source, laid.measured.len());
    let mut out = wrapped(&title, 4);
    out += &damping(bat, frf);
    let none = || "-".to_owned();
    let percent = |peak: &Peak| {
        peak.damping_ratio().map_or_else(none, |ratio| format!("{:.3}", 100.0 * ratio))
    };
    let hertz = |peak: &Peak| format!("{:.2}", peak.frequency);
    out += &lines(
        laid.peaks.iter().take(most),
        &[
            (numbers(6, "mode"), &|(peak, _)| peak.mode.to_string()),
            (numbers(14, "computed, Hz"), &|(peak, _)| hertz(peak)),
            (numbers(14, "measured, Hz"), &|(_, m)| m.as_ref().map_or_else(none, hertz)),
            (numbers(10, "apart, %"), &|(peak, m)| {
                let apart = |m: Peak| 100.0 * (peak.frequency / m.frequency - 1.0);
                m.map_or_else(none, |m| format!("{:+.2}", apart(m)))
            }),
            (numbers(12, "higher, dB"), &|(peak, m)| {
                let level = m.as_ref().and_then(|m| level(peak, m));
                level.map_or_else(none, |db| format!("{db:+.1}"))
            }),
            (numbers(11, "damping, %"), &|(peak, _)| percent(peak)),
            (numbers(11, "measured"), &|(_, m)| m.as_ref().map_or_else(none, percent)),
        ],
    );
    out += &beyond(laid.peaks.len(), most);
    let Laid { frac, level, apart, .. } = laid;
    let side = if *level < 0.0 { "below" } else { "above" };
    let whole = format!(
        "  FRAC {frac:.3}; on average the computed response is {:.1} dB {side} the measured one, and \
         {apart:.1} dB from it",
        level.abs()
    );
    out += &wrapped(&whole, 2);
    out += &wrapped(FRAC, 2);
    for assumed in &response.assumed {
        out += &wrapped(&format!("  {assumed}"), 2);
    }
    out
}

/// At most that number of peaks, with the damping from their widths.
fn listed((name, per): (&str, f64), peaks: &[Peak], most: usize) -> String {
    if peaks.is_empty() {
        return String::new();
    }
    let ratio = |ratio: f64| format!("{:.3}", 100.0 * ratio);
    let mut out = lines(
        peaks.iter().take(most),
        &[
            (numbers(16, "peak, Hz"), &|peak| format!("{:.3}", peak.frequency)),
            (numbers(19, format!("size, {name}")), &|peak| {
                peak.height.map_or("no bound".into(), |height| format!("{:.5e}", per * height))
            }),
            (numbers(15, "damping, %"), &|peak| peak.damping_ratio().map_or("-".into(), ratio)),
            (numbers(8, "mode"), &|peak| peak.mode.to_string()),
        ],
    );
    out += &beyond(peaks.len(), most);
    if peaks.iter().any(|peak| peak.height.is_none()) {
        out += "  no bound: nothing damps the bat; give the material a loss_factor\n";
    }
    if peaks.iter().any(|peak| peak.half_power.is_some()) {
        out += "  damping by the half-power points of the peak, as a share of critical damping\n";
    }
    out
}
