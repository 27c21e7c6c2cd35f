//! A recording of taps: the waveform, the spectrum with its tones, and how the strongest tones die.

use crate::plot::axis::Axis;
use crate::plot::chart::{Chart, Panel};
use crate::plot::picture::Picture;
use crate::plot::series::{Series, short};
use crate::plot::sheet::{Sheet, Unit};
use crate::plot::svg::{MARKS, Pen};
use crate::plot::theme::MUTED;
use crate::report::tap::{TapReport, named};
use sweetspot_tap::analysis::Tap;
use sweetspot_tap::envelope::envelope;
use sweetspot_tap::spectrum::Spectrum;
use sweetspot_tap::tones::Tone;

/// Heights of diagrams (px).
const WAVE: f64 = 160.0;
const ALONE: f64 = 280.0;
/// Number of drawn stretches of a waveform, lines of a spectrum and moments of a decay.
const STRETCHES: usize = 700;
const LINES: usize = 900;
const MOMENTS: usize = 24;
/// Window of the spectrum (s).
const WINDOW: f64 = 0.25;
/// Number of tones whose decay is drawn.
const MOST: usize = 6;
const LEVEL: Unit = Unit { name: "dB", per: 1.0 };

/// The pictures `waveform`, `spectrum` and `decays` of the first recording.
pub fn pictures(report: &TapReport, sheet: Sheet) -> Vec<Picture> {
    let taps: Vec<&Tap> = report.analysis.taps.iter().filter(|tap| tap.recording == 0).collect();
    let mut all = vec![waveform(report, sheet, &taps)];
    if !report.analysis.tones.is_empty() {
        all.push(spectrum(report, sheet, &taps));
        all.extend(decays(report, sheet, &taps));
    }
    all
}

fn waveform(report: &TapReport, sheet: Sheet, taps: &[&Tap]) -> Picture {
    let recording = &report.recordings[0];
    let length = recording.samples.len().div_ceil(STRETCHES).max(1);
    let ends = |(k, part): (usize, &[f64])| {
        let t = recording.from + (k * length) as f64 / recording.rate;
        let low = part.iter().copied().fold(f64::INFINITY, f64::min);
        let high = part.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        [Some([t, low]), Some([t, high])]
    };
    let wave = recording.samples.chunks(length).enumerate().flat_map(ends).collect();
    let wave = Series::curve("sound", 0, wave).untold();
    let most = recording.largest();
    let marks = |used: bool| {
        let these = taps.iter().filter(|tap| tap.used == used);
        these.map(|tap| Some([tap.at, 1.08 * most])).collect::<Vec<_>>()
    };
    let used = Series::curve("taps that are used", 1, marks(true)).dots(MARKS[1]);
    let others = Series::curve("left out", 2, marks(false)).dots(MARKS[2]);
    let mut curves = vec![used, others, wave];
    curves.retain(|curve| !curve.points.is_empty());
    let title = "The recording";
    let facts = format!("{}, {} taps", recording.name, taps.len());
    let until = recording.from + recording.seconds();
    let x = Axis::new("time", [recording.from, until]).counted_in(Unit { name: "s", per: 1.0 });
    let alt =
        format!("{title} {facts}: {:.1} s of sound up to {}.", recording.seconds(), short(most));
    let chart = Chart::new("waveform", title, [report.bat.name(), &facts], x).keys(&curves);
    let panel = Panel::around(WAVE, ("sound", Unit::NONE), curves, &[-most, 1.1 * most]);
    chart.panel(panel.zero()).picture(sheet, &alt)
}

fn spectrum(report: &TapReport, sheet: Sheet, taps: &[&Tap]) -> Picture {
    let recording = &report.recordings[0];
    let rings: Vec<[usize; 2]> = taps.iter().filter(|tap| tap.used).map(|tap| tap.rings).collect();
    let found = Spectrum::of(&recording.samples, recording.rate, &rings, WINDOW);
    let tones = &report.analysis.tones;
    let last = tones.last().map_or(1000.0, |tone| tone.pole.hz);
    let end = (1.25 * last).min(0.5 * recording.rate);
    let lines = ((end / found.step) as usize).min(found.levels.len() - 1);
    let group = lines.div_ceil(LINES).max(1);
    let curve = |levels: &[f64]| {
        let highest = |(k, part): (usize, &[f64])| {
            let level = part.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            Some([(k * group) as f64 * found.step, level])
        };
        levels[..lines].chunks(group).enumerate().skip(1).map(highest).collect::<Vec<_>>()
    };
    let at = |tone: &Tone| {
        let k = ((tone.pole.hz / found.step).round() as usize).min(found.levels.len() - 1);
        Some([tone.pole.hz, found.levels[k]])
    };
    let lowest = found.ground[1..lines].iter().copied().fold(f64::INFINITY, f64::min) - 6.0;
    let computed = report.tapped.iter().flat_map(|tapped| &tapped.labels);
    let computed = computed.filter_map(|label| Some(Some([label.computed?, lowest]))).collect();
    let mut curves = vec![
        Series::curve("tones", 1, tones.iter().map(at).collect()).dots(MARKS[1]),
        Series::curve("computed modes", 2, computed).dots(MARKS[2]),
        Series::curve("taps", 0, curve(&found.levels)).untold(),
        Series::curve("ground", 5, curve(&found.ground)).pen(Pen::new(MUTED, 1.2)).untold(),
    ];
    curves.retain(|curve| !curve.points.is_empty());
    let title = "Spectrum of the taps";
    let told = tones.iter().enumerate().map(|(k, tone)| {
        let mode = report.tapped.and_then(|tapped| tapped.labels[k].mode);
        let mode = mode.map_or(String::new(), |mode| format!(" {}", named(mode)));
        format!("{} Hz{mode}", short(tone.pole.hz))
    });
    let alt = format!("{title}: {}.", told.collect::<Vec<_>>().join(", "));
    let x = Axis::new("frequency", [0.0, end]).counted_in(Unit::HZ);
    let facts = "sound after the taps with its tones; below, what the bat of that wood has";
    let chart = Chart::new("spectrum", title, [report.bat.name(), facts], x).keys(&curves);
    let panel = Panel::around(ALONE, ("level", LEVEL), curves, &[]);
    chart.panel(panel).picture(sheet, &alt)
}

/// The strongest tones after the first tap that is used: measured (dotted) and fitted.
fn decays(report: &TapReport, sheet: Sheet, taps: &[&Tap]) -> Option<Picture> {
    let recording = &report.recordings[0];
    let tap = taps.iter().find(|tap| tap.used)?;
    let mut tones: Vec<&Tone> = report.analysis.tones.iter().collect();
    tones.sort_by(|a, b| b.level.total_cmp(&a.level));
    tones.truncate(MOST);
    tones.sort_by(|a, b| a.pole.hz.total_cmp(&b.pole.hz));
    let ringing = &recording.samples[tap.rings[0]..tap.rings[1]];
    let (mut lines, mut heard) = (vec![], vec![]);
    for (k, tone) in tones.iter().enumerate() {
        let until = ((4.0 / tone.pole.decay) * recording.rate) as usize;
        let part = &ringing[..until.min(ringing.len())];
        let window = 0.5 / tone.pole.decay;
        let levels = envelope(part, recording.rate, tone.pole.hz, window, MOMENTS);
        let Some([begins, level]) = levels.first().copied() else { continue };
        let slope = 20.0 / 10.0_f64.ln() * tone.pole.decay;
        let name = format!("{} Hz", short(tone.pole.hz));
        let points = levels.iter().map(|[t, level]| Some([1e3 * t, *level])).collect();
        heard.push(Series::curve(&name, k, points).dots(MARKS[k % MARKS.len()]).untold());
        let fitted = |t: f64| Some([1e3 * t, level - slope * (t - begins)]);
        lines.push(Series::curve(&name, k, vec![fitted(begins), fitted(4.0 / tone.pole.decay)]));
    }
    let longest = tones.iter().map(|tone| 4.0 / tone.pole.decay).fold(0.0, f64::max);
    let title = "How the tones die";
    let told = tones.iter().map(|tone| {
        format!(
            "{} Hz by {} dB/s",
            short(tone.pole.hz),
            short(20.0 / 10.0_f64.ln() * tone.pole.decay)
        )
    });
    let alt = format!("{title}: {}.", told.collect::<Vec<_>>().join(", "));
    let x = Axis::new("time since the tap", [0.0, 1e3 * longest]).counted_in(Unit::MS);
    let facts = "after the first tap: heard, as marks, and fitted to all taps, as lines";
    let chart = Chart::new("decays", title, [report.bat.name(), facts], x).keys(&lines);
    lines.extend(heard);
    let panel = Panel::around(ALONE, ("level", LEVEL), lines, &[]);
    Some(chart.panel(panel).picture(sheet, &alt))
}
