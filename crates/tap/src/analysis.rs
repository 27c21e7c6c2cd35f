//! The whole analysis: taps, tones, warnings about the recording, and the reason if it is refused.

use crate::filter::{Pass, filtered, levels, median, quantile};
use crate::hum;
use crate::onsets::onsets;
use crate::recording::Recording;
use crate::spectrum::peaks;
use crate::tones::{Ringing, Tone, tones};

/// Tones are sought up to this share of the rate.
const HIGHEST: f64 = 0.42;
/// Below this sample rate there is a warning (1/s).
const LOW_RATE: f64 = 16_000.0;
/// A recording is clipped if this share of its large samples is near the largest, which is near full scale.
const CLIPPED: f64 = 0.08;
const FULL: f64 = 0.95;
/// Rise of the hiss while a tap rings that indicates gain control (dB).
const RISEN: f64 = 3.0;
/// Defects of a recording that make loss factors wrong.
const SPOILT: [Code; 3] = [Code::Clipped, Code::AutomaticGain, Code::SpoiltFile];
/// If the logarithms of loss factors differ by this between early and late windows, they are those of the room.
const ROOM: f64 = 0.3;

/// A tap.
#[derive(Debug, Clone, PartialEq)]
pub struct Tap {
    /// Index of its recording.
    pub recording: usize,
    /// When it begins (s).
    pub at: f64,
    /// Number of bounces.
    pub bounces: usize,
    /// Whether its ringing is used.
    pub used: bool,
    /// Samples in which it rings.
    pub rings: [usize; 2],
}

/// The subject of a warning or a refusal; [`Code::text`] gives its meaning.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Code {
    Clipped,
    AutomaticGain,
    OneTap,
    Room,
    SpoiltFile,
    LowRate,
    Bounces,
    Hum,
    FewTones,
    NoTap,
    NoTone,
}

impl Code {
    /// Its name in files, and its meaning with advice.
    fn told(self) -> [&'static str; 2] {
        match self {
            Self::Clipped => [
                "clipped",
                "The recording is too loud and clipped: its frequencies are right, its loss factors are wrong and \
                 left out. Record again with less gain, or tap more softly.",
            ],
            Self::AutomaticGain => [
                "automatic_gain",
                "The recorder changes its gain while a tap rings: frequencies are right, loss factors are wrong and \
                 left out. Turn \"enhanced recording\" or automatic gain off.",
            ],
            Self::OneTap => [
                "one_tap",
                "There is only one tap: only several show how accurate each is, and which sound is not a tap.",
            ],
            Self::Room => [
                "room",
                "The room affects the decay of the tones: bring the phone within a hand's breadth of the barrel.",
            ],
            Self::SpoiltFile => {
                ["spoilt_file", "Parts of the file are damaged and were replaced by silence."]
            }
            Self::LowRate => {
                ["low_rate", "The recording has few samples a second: high tones are not in it."]
            }
            Self::Bounces => {
                ["bounces", "Taps bounced: the ringing after the last bounce was used."]
            }
            Self::Hum => ["hum", "Hum of the mains was removed."],
            Self::FewTones => {
                ["few_tones", "Only two tones were found: labels and wood are uncertain."]
            }
            Self::NoTap => [
                "no_tap",
                "No tap was found in it: record five to eight single taps, a second apart.",
            ],
            Self::NoTone => [
                "no_tone",
                "Fewer than two tones were found that the taps share: tap with something hard, the phone within a \
                 hand's breadth of the barrel, the bat hung or held at a node.",
            ],
        }
    }

    /// Its name in files.
    pub fn name(self) -> &'static str {
        self.told()[0]
    }

    /// Its meaning, with advice.
    pub fn text(self) -> &'static str {
        self.told()[1]
    }
}

/// The condition of one recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Condition {
    /// Frequency of the hum that was removed (Hz).
    pub hum: Option<f64>,
    /// Rise of the hiss while a tap rings (dB); `None` if it cannot be measured.
    pub gain_rise: Option<f64>,
    /// Whether it is clipped.
    pub clipped: bool,
}

/// The results of recordings of one bat.
#[derive(Debug, Clone, PartialEq)]
pub struct Analysis {
    /// The condition of every recording.
    pub conditions: Vec<Condition>,
    /// The taps of all.
    pub taps: Vec<Tap>,
    /// The tones.
    pub tones: Vec<Tone>,
    /// Whether loss factors are reliable: not if a recording is clipped or spoilt, or if its gain changes.
    pub has_loss: bool,
    /// Warnings, each with the index of its recording, or `None` if it concerns all together.
    pub warnings: Vec<(Code, Option<usize>)>,
    /// Reason of a refusal.
    pub refused: Option<Code>,
}

impl Analysis {
    /// Analyses recordings of one bat, up to that frequency (Hz) if one is given.
    pub fn of(recordings: &[Recording], highest: Option<f64>) -> Self {
        let heard: Vec<Heard> = recordings.iter().map(Heard::of).collect();
        let (mut taps, mut ringing, mut sought) = (vec![], vec![], vec![]);
        for (k, (heard, one)) in heard.iter().zip(recordings).enumerate() {
            for (tap, rings) in heard.taps.iter().zip(&heard.rings) {
                let (at, rings) = (one.from + tap.at as f64 / one.rate, *rings);
                taps.push(Tap { recording: k, at, bounces: tap.bounces, used: true, rings });
                let samples = &heard.samples[rings[0]..rings[1]];
                ringing.push(Ringing { recording: k, samples, rate: one.rate });
            }
            let most = (HIGHEST * one.rate).min(highest.unwrap_or(f64::INFINITY));
            let found = peaks(&heard.samples, one.rate, &heard.rings, most);
            sought.push(found.iter().map(|peak| peak.hz).collect::<Vec<f64>>());
        }
        let conditions = heard.iter().map(|heard| heard.condition.clone()).collect::<Vec<_>>();
        let found = tones(&ringing, &sought);
        let refused = match () {
            _ if taps.is_empty() => Some(Code::NoTap),
            _ if found.tones.len() < 2 => Some(Code::NoTone),
            _ => None,
        };
        let is_spoilt = |(code, _): &(Code, Option<usize>)| SPOILT.contains(code);
        if refused.is_some() {
            let mut warnings = warnings(recordings, &conditions, &taps, &[], 0.0);
            warnings.retain(is_spoilt);
            return Self { conditions, taps, tones: vec![], has_loss: false, warnings, refused };
        }
        taps.iter_mut().zip(&found.used).for_each(|(tap, used)| tap.used = *used);
        let warnings = warnings(recordings, &conditions, &taps, &found.tones, found.room);
        let has_loss = !warnings.iter().any(is_spoilt);
        Self { conditions, taps, tones: found.tones, has_loss, warnings, refused }
    }
}

struct Heard {
    samples: Vec<f64>,
    taps: Vec<crate::onsets::Onset>,
    rings: Vec<[usize; 2]>,
    condition: Condition,
}

impl Heard {
    fn of(recording: &Recording) -> Self {
        let rate = recording.rate;
        let hum = hum::hum(&recording.samples, rate);
        let samples = match hum {
            Some(hum) => hum::without(&recording.samples, rate, hum),
            None => recording.samples.clone(),
        };
        let taps = onsets(&samples, rate);
        // A codec may smear the next tap, so that it begins early.
        let ahead = (0.008 * rate) as usize;
        let rings: Vec<[usize; 2]> = taps
            .iter()
            .enumerate()
            .map(|(k, tap)| {
                let next =
                    taps.get(k + 1).map_or(samples.len(), |next| next.at.saturating_sub(ahead));
                [tap.rings, next.max(tap.rings)]
            })
            .collect();
        let clipped = recording.clipped_share() > CLIPPED && recording.largest() > FULL;
        let condition = Condition { hum, gain_rise: gain_rise(&samples, rate, &rings), clipped };
        Self { samples, taps, rings, condition }
    }
}

/// Rise of the hiss above 5 kHz after a tap until the next one, the median over the taps (dB).
fn gain_rise(samples: &[f64], rate: f64, rings: &[[usize; 2]]) -> Option<f64> {
    if rate < 24_000.0 {
        return None;
    }
    let hiss = filtered(samples, rate, Pass::Above(5000.0));
    let frame = (0.02 * rate) as usize;
    let rise = |[from, to]: &[usize; 2]| {
        let room = *to as f64 - *from as f64;
        (room > 0.6 * rate).then(|| {
            let part = |a: f64, b: f64| {
                let place = |t: f64| from + (t * room) as usize;
                quantile(&levels(&hiss[place(a)..place(b)], frame), 0.5)
            };
            part(0.85, 0.98) - part(0.35, 0.5).min(part(0.5, 0.65))
        })
    };
    let all: Vec<f64> = rings.iter().filter_map(rise).collect();
    (!all.is_empty()).then(|| median(&all))
}

fn warnings(
    recordings: &[Recording],
    conditions: &[Condition],
    taps: &[Tap],
    tones: &[Tone],
    room: f64,
) -> Vec<(Code, Option<usize>)> {
    let used = taps.iter().filter(|tap| tap.used).count();
    let mut all = vec![];
    for (k, (one, seen)) in recordings.iter().zip(conditions).enumerate() {
        let bounced = |tap: &Tap| tap.recording == k && tap.used && tap.bounces > 0;
        let own = [
            (Code::Clipped, seen.clipped),
            (Code::AutomaticGain, seen.gain_rise.is_some_and(|rise| rise > RISEN)),
            (Code::SpoiltFile, one.spoilt > 0),
            (Code::LowRate, one.rate < LOW_RATE),
            (Code::Bounces, taps.iter().any(bounced)),
            (Code::Hum, seen.hum.is_some()),
        ];
        all.extend(own.into_iter().filter(|(_, is)| *is).map(|(code, _)| (code, Some(k))));
    }
    let together =
        [(Code::OneTap, used == 1), (Code::Room, room > ROOM), (Code::FewTones, tones.len() < 3)];
    all.extend(together.into_iter().filter(|(_, is)| *is).map(|(code, _)| (code, None)));
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    /// A recording of five taps with tones of a loss factor of 0.01.
    fn recording(tones: &[f64], rate: f64) -> Recording {
        let tap = |n: usize| {
            let (t, k) = ((n % 8400) as f64 / rate, n / 8400);
            let one = |(j, hz): (usize, &f64)| {
                let phase = (7 * k + 3 * j) as f64;
                (1.0 + 0.3 * phase.cos())
                    * (-PI * hz * 0.01 * t).exp()
                    * (TAU * hz * t + phase).sin()
            };
            let noise = 1e-4 * ((n * n % 7919) as f64 / 7919.0 - 0.5);
            noise + tones.iter().enumerate().map(one).sum::<f64>()
        };
        let sound = (0..42_000).map(tap);
        Recording::of("x", std::iter::repeat_n(0.0, 4000).chain(sound).collect(), rate).unwrap()
    }

    /// A recording cut at full scale is called clipped; the same at a tenth of it, or not cut, is not.
    #[test]
    fn what_is_cut_at_full_scale_is_called_clipped() {
        let heard = |gain: f64, cut: f64, after: f64| {
            let mut one = recording(&[175.0, 581.0, 1187.0], 8000.0);
            one.samples.iter_mut().for_each(|x| *x = after * (gain * *x).clamp(-cut, cut));
            let found = Analysis::of(&[one], None);
            let said = found.warnings.iter().any(|(code, _)| *code == Code::Clipped);
            assert_eq!((said, found.has_loss), (found.conditions[0].clipped, !said));
            said
        };
        assert_eq!(
            [heard(0.9, 1.0, 1.0), heard(0.1, 1.0, 1.0), heard(0.9, 1.0, 0.1)],
            [true, false, false]
        );
    }

    /// One tap is called one, and two are not.
    #[test]
    fn one_tap_is_called_one() {
        for taps in [1, 2, 5] {
            let mut one = recording(&[175.0, 581.0, 1187.0], 8000.0);
            one.samples.truncate(4000 + taps * 8400);
            let found = Analysis::of(&[one], None);
            assert_eq!(found.taps.len(), taps);
            let said = found.warnings.iter().any(|(code, _)| *code == Code::OneTap);
            assert_eq!(said, taps == 1, "{taps}");
        }
    }

    /// Hiss that rises by a number of decibels in a second rises by 0.49 of it between the parts that are compared.
    #[test]
    fn a_gain_that_rises_is_measured() {
        let rate = 44_100.0;
        let hiss = |level: &dyn Fn(f64) -> f64| {
            let mut state = 1_u64;
            let one = |n: usize| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                let even = (state >> 33) as f64 / (1_u64 << 30) as f64 - 1.0;
                0.01 * even * 10.0_f64.powf(level(n as f64 / rate) / 20.0)
            };
            let samples: Vec<f64> = (0..44_100).map(one).collect();
            gain_rise(&samples, rate, &[[0, samples.len()]]).unwrap()
        };
        for decibels in [0.0, 6.0, 12.0] {
            let rise = hiss(&|t| decibels * t);
            assert!((rise - 0.49 * decibels).abs() < 0.5, "{decibels} {rise}");
        }
        // The quieter of the two parts before counts: the first one here, which is 10 dB below the rest.
        let rise = hiss(&|t| if t < 0.5 { 0.0 } else { 10.0 });
        assert!((rise - 10.0).abs() < 0.5, "{rise}");
    }

    /// The tones of two planes of the grain, each plane in its own recording, are distinguished from 0.6 of their
    /// half-power widths on.
    #[test]
    fn two_planes_of_the_grain_have_tones_of_their_own() {
        let one = [175.0, 581.0, 1187.0, 1858.0];
        for apart in [1.006, 1.01, 1.015, 1.02, 1.028] {
            let two = one.map(|hz| apart * hz);
            let both = [&one[..], &two].map(|tones| recording(tones, 8000.0));
            let found = Analysis::of(&both, None).tones;
            let all: Vec<f64> = found.iter().map(|tone| tone.pole.hz).collect();
            assert_eq!(all.len(), 8, "{apart}: {all:?}");
            for hz in one.iter().chain(&two) {
                let near = found.iter().find(|tone| (tone.pole.hz / hz - 1.0).abs() < 1e-3);
                let near = near.unwrap_or_else(|| panic!("{apart}: {hz} in {all:?}"));
                assert!(near.taps == 5 && near.twin.is_some(), "{near:?}");
            }
        }
    }
}
