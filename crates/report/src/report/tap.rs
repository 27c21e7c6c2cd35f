//! Results of a recording of taps: table, JSON, CSV, words.

use std::f64::consts::LN_2;

use serde_json::{Value, json};

use crate::csv;
use crate::parts::columns::{Columns, first, labels, numbers};
use crate::parts::counted;
use crate::parts::table::Column;
use crate::parts::terminal::{Piece, wrapped};
use crate::report::calibrate::{short, shown};
use crate::report::identify::frequency;
use crate::schema::tap::{TapFile, TapMoment, TapRecording, TapTone};
use crate::schema::{Said, Written};
use sweetspot::base::error::Error;
use sweetspot::base::number::{percent, significant};
use sweetspot::bat::body::Bat;
use sweetspot::files::schema::document::BatName;
use sweetspot_study::calibrate::calibration::{Estimated, Verdict};
use sweetspot_study::calibrate::readings::{Reading, SpectralLine};
use sweetspot_study::tap::heard::Within;
use sweetspot_study::tap::hoops::BatMode;
use sweetspot_study::tap::tapped::{Tapped, ToneLabel};
use sweetspot_tap::analysis::{Analysis, Code, Condition, Tap};
use sweetspot_tap::recording::{Recording, Unreadable};

/// Beyond this half-width an interval is shown as "about".
const ABOUT: f64 = 0.4;
/// Share by which recorded tones may be higher than those of other verbs, without a word.
const LEAST_RAISED: f64 = 5e-4;
/// Half-width of the loss factor above which moving the phone is advised.
const WIDE: f64 = 0.1;

/// Recordings of taps on a bat, and the results.
pub struct TapReport<'a> {
    /// The bat.
    pub bat: &'a Bat,
    /// The recordings.
    pub recordings: &'a [Recording],
    /// Their tones.
    pub analysis: &'a Analysis,
    /// The modes of the tones; None where they were not requested, or where there are no tones.
    pub tapped: Option<&'a Tapped>,
}

impl TapReport<'_> {
    /// Recordings, tones, wood and words, 80 columns wide.
    pub fn text(&self) -> [Piece; 3] {
        let heard = (0..self.recordings.len()).map(|k| wrapped(&self.heard(k), 2));
        let mut out: String = heard.collect();
        match &self.analysis.refused {
            Some(refused) => out += &wrapped(refused.text(), 0),
            None => out += &self.table(),
        }
        let wood = self.wood().map_or(String::new(), |wood| wrapped(&wood, 2));
        let words: String = self.words(Some(TELL)).iter().map(|line| wrapped(line, 2)).collect();
        [(0, "", out), (0, "", wood), (1, "words", words)]
    }

    /// A line about a recording.
    pub fn heard(&self, k: usize) -> String {
        let (recording, seen) = (&self.recordings[k], &self.analysis.conditions[k]);
        let own: Vec<&Tap> = self.analysis.taps.iter().filter(|tap| tap.recording == k).collect();
        let used: Vec<&&Tap> = own.iter().filter(|tap| tap.used).collect();
        let times = match (used.first(), used.last()) {
            (Some(a), Some(b)) if used.len() > 1 => format!(" at {:.1} to {:.1} s", a.at, b.at),
            (Some(a), _) => format!(" at {:.1} s", a.at),
            _ => String::new(),
        };
        let mut facts = vec![counted(used.len(), "tap") + &times];
        let others = own.len() - used.len();
        if others > 0 && self.analysis.refused.is_none() {
            facts.push(format!("{} left out", counted(others, "other sound")));
        }
        let kinds = [recording.container.as_deref(), recording.codec.as_deref()];
        let rate = format!("{} kHz", significant(1e-3 * recording.rate, 4));
        let kinds: Vec<&str> = kinds.into_iter().flatten().chain([&*rate]).collect();
        facts.push(kinds.join(", "));
        facts.extend(seen.hum.map(|hum| format!("{hum:.0} Hz hum left out")));
        format!("{}: {}", recording.name, facts.join("; "))
    }

    fn table(&self) -> String {
        let columns = Columns::new([
            first(20, "tone"),
            numbers(13, "dies to half"),
            numbers(16, "loss factor"),
            labels(18, "is"),
            numbers(8, "sure"),
        ]);
        let mut out = columns.heads();
        for k in 0..self.analysis.tones.len() {
            out += &columns.row(self.cells(k));
        }
        out
    }

    /// Frequency of a tone, the time in which it falls to half, loss factor, mode, and the probability of that mode.
    pub fn cells(&self, k: usize) -> [String; 5] {
        let (tone, label) = (&self.analysis.tones[k], self.label(k));
        let is = match (self.tapped, label.mode) {
            (None, _) => String::new(),
            (Some(_), None) if !label.tried => "not labelled".to_owned(),
            (Some(_), None) => "no mode of this bat".to_owned(),
            (Some(_), Some(mode)) => named(mode),
        };
        [
            frequency(&Within::frequency(tone)),
            format!("{} ms", significant(1e3 * LN_2 / tone.pole.decay, 3)),
            if self.analysis.has_loss { loss(&Within::loss(tone)) } else { "-".to_owned() },
            is,
            label.mode.map_or(String::new(), |_| percent(label.sure, 1)),
        ]
    }

    fn label(&self, tone: usize) -> ToneLabel {
        self.tapped.map_or(ToneLabel::default(), |tapped| tapped.labels[tone])
    }

    /// The line about the wood; None where that was not asked.
    pub fn wood(&self) -> Option<String> {
        let tapped = self.tapped?;
        let Some(found) = &tapped.wood else {
            return Some(NONE.to_owned());
        };
        let open =
            |one: &&Estimated| !matches!(one.verdict, Verdict::Held | Verdict::NotDetermined);
        let value = |one: &Estimated| {
            let by = 0.5 * (one.interval95[1] - one.interval95[0]) / one.value;
            let (name, value) = (short(one.property), shown(one.property, one.value));
            format!("{name} {value} ± {}", percent(by, 1))
        };
        let mut all: Vec<String> = found.parameters.iter().filter(open).map(value).collect();
        all.extend(tapped.loss.map(|factor| format!("loss factor at most {}", loss(&factor))));
        Some(format!("Its material: {}, with the density of the bat file.", all.join(", ")))
    }

    /// What spoils the recordings, named where there are several, and the labels; `tell` is the way to state the mode
    /// of a tone.
    fn warned(&self, tell: Option<&str>) -> Vec<Said> {
        let of = |(code, recording): &(Code, Option<usize>)| {
            let name = recording.filter(|_| self.recordings.len() > 1);
            let name = name.map(|k| format!("{}: ", self.recordings[k].name));
            Said::new(code.name(), name.unwrap_or_default() + code.text())
        };
        let mut all: Vec<Said> = self.analysis.warnings.iter().map(of).collect();
        all.extend(self.tapped.and_then(|tapped| tapped.unsolved.as_deref()).map(unsolved));
        if self.tapped.is_some_and(Tapped::is_unsure) {
            let text = format!("Not every label is sure{}.", tell.unwrap_or_default());
            all.push(Said::new("unsure", text));
        }
        all
    }

    /// The conclusions, a sentence or two each; `tell` as for the warnings.
    pub fn words(&self, tell: Option<&str>) -> Vec<String> {
        let mut all: Vec<String> = self.warned(tell).into_iter().map(|said| said.text).collect();
        let Some(tapped) = self.tapped else { return all };
        if let Some(second) = tapped.second.as_ref().filter(|second| second.margin < 8.0) {
            let labels = second.labels.iter().map(|one| one.map_or("none".to_owned(), named));
            let labels = labels.collect::<Vec<_>>().join(", ");
            let margin = significant(second.margin, 2);
            all.push(format!("The next best labels are {labels}: chi2 is {margin} larger."));
        }
        if !tapped.fits() {
            all.push(UNFIT.to_owned());
        }
        let tones = self.analysis.tones.iter().zip(&tapped.labels);
        let raised =
            tones.filter_map(|(tone, label)| Some(tone.pole.hz * label.stiffer / label.computed?));
        let raised = raised.fold(1.0, f64::max) - 1.0;
        if tapped.loss.is_some() && raised > LEAST_RAISED {
            let lowest = significant(self.analysis.tones[0].pole.hz, 4);
            all.push(format!(
                "The material is that at {lowest} Hz, where its loss factor stiffens it least; the intervals include \
                 that it does not. Other verbs take it as constant: their tones are up to {} lower.",
                percent(raised, 1)
            ));
        }
        if tapped.loss.is_some_and(|loss| half(&loss) > WIDE) {
            all.push(NEXT.to_owned());
        }
        all
    }

    /// The `sweetspot-tap/1` document.
    pub fn document(&self) -> Written<TapFile> {
        let Self { bat, recordings, analysis, tapped } = self;
        let recording = recordings.iter().zip(&analysis.conditions);
        Written::of(TapFile {
            bat: BatName::of(bat),
            recordings: recording.map(|(one, seen)| of_recording(one, seen)).collect(),
            taps: analysis.taps.iter().map(|tap| of_tap(tap, analysis.refused.is_some())).collect(),
            tones: (0..analysis.tones.len()).map(|k| self.tone(k)).collect(),
            second: tapped.and_then(|tapped| tapped.second.clone()),
            wood: tapped.and_then(|tapped| tapped.wood.clone()),
            loss_factor_at_most: tapped.and_then(|tapped| tapped.loss),
            fits: tapped.map(Tapped::fits),
            warnings: self.warned(Some(TELL)),
            refused: analysis.refused.map(|code| Said::new(code.name(), code.text())),
        })
    }

    fn tone(&self, k: usize) -> TapTone {
        let (tone, label) = (&self.analysis.tones[k], self.label(k));
        let frequency = Within::frequency(tone);
        let loss = Some(Within::loss(tone)).filter(|_| self.analysis.has_loss);
        TapTone {
            frequency_hz: frequency.value,
            frequency_interval95_hz: frequency.interval95,
            loss_factor: loss.map(|loss| loss.value),
            loss_factor_interval95: loss.map(|loss| loss.interval95),
            decay_1_s: tone.pole.decay,
            half_s: LN_2 / tone.pole.decay,
            taps: tone.taps,
            level_db: tone.level,
            twin_hz: tone.twin,
            mode: label.mode,
            tried: label.tried,
            computed_hz: label.computed,
            sure: label.mode.map(|_| label.sure),
        }
    }

    /// The lines of the wood as a readings file, with the stiffness at the lowest tone and the labels of the modes.
    pub fn readings(&self) -> Value {
        let found = self.tapped.and_then(|tapped| tapped.wood.as_ref());
        let (lines, tones) = match found {
            Some(found) => (&found.labels, &found.readings),
            None => return json!({ "format": "sweetspot-readings/1" }),
        };
        let line = |(line, mode): (&SpectralLine, &Option<usize>)| {
            let Reading { value, deviation } = line.frequency;
            let mode = (*mode)?;
            Some(json!({ "hz": value, "within": deviation, "mode": mode }))
        };
        let lines: Vec<Value> = tones.lines.iter().zip(&lines.taken).filter_map(line).collect();
        let died = tones.ring_down.iter();
        let died = died.map(|t| json!({ "mode": t.mode, "loss_factor": t.loss_factor() }));
        let names: Vec<&str> = self.recordings.iter().map(|one| &*one.name).collect();
        json!({ "format": "sweetspot-readings/1", "name": names.join(", "), "lines": lines,
                "ring_down": died.collect::<Vec<_>>() })
    }

    /// The tones as CSV.
    pub fn csv(&self) -> String {
        let tones: Vec<TapTone> = (0..self.analysis.tones.len()).map(|k| self.tone(k)).collect();
        csv::rows(&COLUMNS, &tones)
    }
}

const UNFIT: &str = "The tones do not fit this bat: its profile is another one than the file says, or tones are of \
                     something else.";
const NEXT: &str = "Next: move the phone or the bat a hand's breadth between taps, the phone near the barrel; that halves \
                    the ± of the loss factor.";
const NONE: &str =
    "No tone is a bending mode of this bat, of any wood: the bat file is another bat's.";
const TELL: &str = ": tell the mode of a tone that you know, such as --mode \"1187 = 3\"";

fn unsolved(why: &str) -> Said {
    Said::new(
        "wall",
        format!(
            "The modes of the wall are not known ({why}): its tones are told as bending modes or as none."
        ),
    )
}

/// The columns of the tones in files.
const COLUMNS: [Column<TapTone>; 11] = [
    Column::in_files("frequency_hz", |one| one.frequency_hz.into()),
    Column::in_files("frequency_low95_hz", |one| one.frequency_interval95_hz[0].into()),
    Column::in_files("frequency_high95_hz", |one| one.frequency_interval95_hz[1].into()),
    Column::in_files("loss_factor", |one| one.loss_factor.into()),
    Column::in_files("loss_factor_low95", |one| one.loss_factor_interval95.map(|i| i[0]).into()),
    Column::in_files("loss_factor_high95", |one| one.loss_factor_interval95.map(|i| i[1]).into()),
    Column::in_files("half_s", |one| one.half_s.into()),
    Column::in_files("taps", |one| one.taps.into()),
    Column::in_files("mode", |one| one.mode.map_or(String::new(), mode_in_file).into()),
    Column::in_files("computed_hz", |one| one.computed_hz.into()),
    Column::in_files("sure", |one| one.sure.into()),
];

fn mode_in_file(mode: BatMode) -> String {
    named(mode).replace(['(', ',', ')'], "")
}

/// The name of a mode.
pub fn named(mode: BatMode) -> String {
    match mode {
        BatMode::Bending { order } => format!("bending {order}"),
        BatMode::Hoop { harmonic, order } => format!("hoop ({harmonic}, {order})"),
    }
}

fn half(loss: &Within) -> f64 {
    0.5 * (loss.interval95[1] - loss.interval95[0]) / loss.value
}

fn loss(loss: &Within) -> String {
    match half(loss) {
        by if by > ABOUT => format!("about {}", significant(loss.value, 1)),
        by => format!("{} ± {}", significant(loss.value, 3), percent(by, 0)),
    }
}

fn of_recording(one: &Recording, seen: &Condition) -> TapRecording {
    TapRecording {
        file: one.name.clone(),
        container: one.container.clone(),
        codec: one.codec.clone(),
        rate_hz: one.rate,
        channels: one.channels,
        seconds: one.seconds(),
        largest: one.largest(),
        clipped_share: one.clipped_share(),
        hum_hz: seen.hum,
        gain_rise_db: seen.gain_rise,
    }
}

fn of_tap(tap: &Tap, refused: bool) -> TapMoment {
    let why_not = match (refused, tap.used) {
        (true, _) => Some("no tones that taps share"),
        (false, false) => Some("has none of the tones that the others share"),
        (false, true) => None,
    };
    TapMoment {
        recording: tap.recording,
        at_s: tap.at,
        used: why_not.is_none(),
        bounces: tap.bounces,
        why_not: why_not.map(str::to_owned),
    }
}

/// The error for a recording that cannot be read, with the name that is shown.
pub fn unreadable(shown: &str, error: Unreadable) -> Error {
    match error {
        Unreadable::File(source) => Error::Read { path: shown.into(), source },
        Unreadable::Sound { found, expected } => Error::value(shown, found, expected),
        other => Error::value(shown, other, "a recording"),
    }
}
