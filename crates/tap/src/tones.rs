//! Tones common to the taps, with their frequencies, decays and errors.
//!
//! The error of a tone is
//!
//! ```text
//! s² = max(k spread/√n, c D)² + CRB² + floor²,    k = 1 + 1/(n − 1)
//! ```
//!
//! for the logarithm of its loss factor η, and η/2 of that for the logarithm of its frequency. A disturbance that moves
//! a pole `−δ + 2πi f` moves it equally in both directions, so that 2 Δf/(f η) and Δ ln η have one deviation, which
//! both measure. The spread is that over n taps. D is the difference of fits to an early and a late window, half its
//! own and half the median over the tones; it measures the echo of the room, which is common to all taps if the
//! microphone does not move. CRB is the bound that follows from the residual of the bands.
//!
//! The room's answer to a tap grows relative to a tone as `e^{2(δ − δ_r)t}`, with δ_r the decay of the room (J.-D.
//! Polack, Playing billiards in the concert hall, Appl. Acoust. 38 (1993) 235). Ringing is therefore used from the end
//! of the blow on: 4 ms later, a high tone would have more of the room than of the bat.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use crate::filter::{median, most, quantile};
use crate::fit::{Band, Fit, Pole, fit};
use crate::pencil::two_poles;

/// Beginning of the fitted ringing after the onset (s), after the blow; its end, in decay times; its longest duration
/// (s).
const BEGINS: f64 = 0.8e-3;
const DECAYS: f64 = 3.0;
const LONGEST: f64 = 1.2;
/// Early and late windows, in decay times; the early one begins with the whole.
const EARLY: f64 = 1.3;
const LATE: [f64; 2] = [0.8, 2.5];
/// Tones up to this number of half bands away affect a band's ground.
const BESIDE: f64 = 2.0;
/// Loss factors of a bat's tones.
pub const LOSSES: [f64; 2] = [0.0008, 0.08];
/// Largest residual of a tone's bands, as a share of their power above the ground.
const MISFIT: f64 = 0.30;
/// Least share of the taps in which a tone occurs, for all tones and in the first pass.
const HEARD: f64 = 0.6;
const SOME: f64 = 0.25;
/// A tap with at least this residual in the band does not contain the tone. Below, the largest spread of the taps.
const LOST: f64 = 0.8;
const SPREAD: f64 = 0.012;
/// Two poles replace one if the sum of squares falls to this share, their decays differ by at most this factor, and
/// they are at least this far apart, in δ/π.
const TWIN: f64 = 0.35;
const TWIN_DECAYS: f64 = 2.5;
const TWIN_APART: f64 = 0.3;
/// Largest relative distance of twins of the two planes of the grain; tones farther apart are different ones.
const PLANES: f64 = 0.03;
/// A tap is discarded if its five strongest tones have at least this residual, and this many times the others'.
const NO_TAP: f64 = 0.3;
const WORSE: f64 = 4.0;
/// Share of D, fitted to 60 recordings of `search/taps.py --seed 101`, and least errors of f and of ln η.
const SEEN: f64 = 0.6;
const FLOOR: [f64; 2] = [5e-5, 0.01];

/// A stretch in which one tap rings.
#[derive(Debug, Clone, Copy)]
pub struct Ringing<'a> {
    /// Index of its recording.
    pub recording: usize,
    /// The samples, from the onset to the next one.
    pub samples: &'a [f64],
    /// Samples per second.
    pub rate: f64,
}

/// A tone.
#[derive(Debug, Clone, PartialEq)]
pub struct Tone {
    /// Frequency and decay.
    pub pole: Pole,
    /// Standard deviations of the frequency (relative), and of the logarithm of the loss factor.
    pub deviations: [f64; 2],
    /// Number of taps in which it was found.
    pub taps: usize,
    /// Amplitude at the onset over that of the strongest tone (dB).
    pub level: f64,
    /// Frequency of its twin, in the other plane of the grain (Hz).
    pub twin: Option<f64>,
}

/// The tones that were found, and which of the taps are used.
#[derive(Debug, Clone, PartialEq)]
pub struct Tones {
    /// The tones, rising.
    pub tones: Vec<Tone>,
    /// Whether each tap is used.
    pub used: Vec<bool>,
    /// Difference of early and late windows, in ln η.
    pub room: f64,
}

/// A tone during the search.
#[derive(Debug, Clone)]
struct Found {
    whole: Fit,
    /// The residual of every tap.
    misfits: Vec<(usize, f64)>,
    /// Logarithms of frequencies and loss factors in single taps, by pole.
    singles: Vec<Vec<(usize, [f64; 2])>>,
    level: f64,
}

/// A window of the ringing.
#[derive(Clone, Copy, PartialEq)]
enum Window {
    Whole,
    Early,
    Late,
}

/// The tones of these taps, sought at these frequencies (Hz) of every recording.
pub fn tones(taps: &[Ringing], peaks: &[Vec<f64>]) -> Tones {
    // A sound that is not a tap has none of the tones, so tones common to some taps are sought first.
    let rough = heard(taps, peaks, SOME);
    let used: Vec<bool> = (0..taps.len()).map(|tap| !is_none(taps, &rough, tap)).collect();
    let kept = taps.iter().zip(&used).filter(|(_, used)| **used);
    let taps: Vec<Ringing> = kept.map(|(tap, _)| *tap).collect();
    let found = heard(&taps, peaks, HEARD);
    let poles: Vec<Vec<Pole>> = found.iter().map(|one| one.whole.poles.clone()).collect();
    let differences = |k: usize| early_and_late(&taps, &poles[k], &others(&poles, k));
    let differences: Vec<[Option<[f64; 2]>; 2]> = (0..found.len()).map(differences).collect();
    let all = differences.iter().flatten().flatten();
    let room = median(&all.map(|difference| circular(*difference)).collect::<Vec<_>>());
    let loudest = most(&found.iter().map(|one| one.level).collect::<Vec<_>>());
    let mut tones = vec![];
    for (one, differences) in found.iter().zip(&differences) {
        for (p, pole) in one.whole.poles.iter().enumerate() {
            let away = |hz: &f64| (hz / pole.hz - 1.0).abs();
            let all = poles.iter().flatten().map(|other| other.hz).filter(|hz| *hz != pole.hz);
            let twin = all.min_by(|a, b| away(a).total_cmp(&away(b)));
            tones.push(Tone {
                pole: *pole,
                deviations: deviations(one, p, differences[p], room),
                taps: one.singles[p].len(),
                level: one.level - loudest,
                twin: twin.filter(|hz| away(hz) < PLANES),
            });
        }
    }
    tones.sort_by(|a, b| a.pole.hz.total_cmp(&b.pole.hz));
    Tones { tones, used, room }
}

/// The poles of all other tones.
fn others(poles: &[Vec<Pole>], own: usize) -> Vec<Pole> {
    let others = poles.iter().enumerate().filter(|(k, _)| *k != own);
    others.flat_map(|(_, poles)| poles.iter().copied()).collect()
}

/// Whether a tap is not one, because the strongest tones have a large residual in it.
fn is_none(taps: &[Ringing], found: &[Found], tap: usize) -> bool {
    // Tones of its own recording only: a tap has no tones of the other plane of the grain.
    let own =
        |(k, misfit): &(usize, f64)| taps[*k].recording == taps[tap].recording && *misfit < NO_TAP;
    let mut strongest: Vec<&Found> =
        found.iter().filter(|one| one.misfits.iter().any(own)).collect();
    strongest.sort_by(|a, b| b.level.total_cmp(&a.level));
    strongest.truncate(5);
    let of = |one: &&Found| one.misfits.iter().find(|(k, _)| *k == tap).map(|(_, misfit)| *misfit);
    let own = median(&strongest.iter().filter_map(of).collect::<Vec<_>>());
    let all: Vec<f64> = strongest.iter().flat_map(|one| &one.misfits).map(|(_, m)| *m).collect();
    own > NO_TAP && own > WORSE * quantile(&all, 0.25)
}

/// The tones of these taps: of every recording (each plane of the grain has its own tones), then of all taps together.
fn heard(taps: &[Ringing], peaks: &[Vec<f64>], least: f64) -> Vec<Found> {
    let mut found: Vec<Vec<Pole>> = vec![];
    for (recording, peaks) in peaks.iter().enumerate() {
        let own = taps.iter().filter(|tap| tap.recording == recording);
        let own = alone(&own.copied().collect::<Vec<_>>(), peaks, least);
        let before = found.len();
        let is_new = |poles: &Vec<Pole>| !found[..before].iter().any(|o| is_same(&o[0], &poles[0]));
        let new: Vec<Vec<Pole>> = own.into_iter().filter(is_new).collect();
        found.extend(new);
    }
    let mut kept: Vec<Found> = vec![];
    for k in 0..found.len() {
        let Some(one) = tone(taps, least, found[k][0], &others(&found, k)) else { continue };
        let near = |other: &Found| {
            let own = |a: &Pole| other.whole.poles.iter().any(|b| is_same(a, b));
            one.whole.poles.iter().any(own)
        };
        match kept.iter().position(near) {
            Some(k) if kept[k].level < one.level => kept[k] = one,
            Some(_) => {}
            None => kept.push(one),
        }
    }
    kept
}

/// The tones of taps of one recording, its own pole first: each peak alone, then together with the others in its band.
fn alone(taps: &[Ringing], peaks: &[f64], least: f64) -> Vec<Vec<Pole>> {
    let mut first: Vec<Vec<Pole>> = vec![];
    for pole in peaks.iter().filter_map(|hz| begun(taps, *hz)) {
        if !first.iter().any(|other| is_same(&other[0], &pole)) {
            first.push(vec![pole]);
        }
    }
    let beside = |k: usize| {
        let pole = first[k][0];
        let mut poles = tone(taps, least, pole, &others(&first, k))?.whole.poles;
        // Each peak finds both of two tones in one band; each continues with its own.
        let away = |other: &Pole| (other.hz - pole.hz).abs();
        poles.sort_by(|a, b| away(a).total_cmp(&away(b)));
        Some(poles)
    };
    (0..first.len()).filter_map(beside).collect()
}

/// Whether two poles cannot be distinguished.
fn is_same(a: &Pole, b: &Pole) -> bool {
    (a.hz - b.hz).abs() < TWIN_APART * a.decay.max(b.decay) / PI
}

/// A pole that begins the fit at that frequency: the best of several decays.
fn begun(taps: &[Ringing], hz: f64) -> Option<Pole> {
    let bands = bands(taps, Pole::of(hz, 0.007), Window::Whole);
    let left =
        |pole: &Pole| median(&bands.iter().map(|band| band.misfit(&[*pole])).collect::<Vec<_>>());
    let starts = [0.0015, 0.003, 0.006, 0.012, 0.024, 0.045].map(|loss| Pole::of(hz, loss));
    let start = starts.iter().map(|pole| (left(pole), pole)).min_by(|a, b| a.0.total_cmp(&b.0))?.1;
    let found = fit(&bands, &[*start], &[])?.poles[0];
    is_tone(&found).then_some(found)
}

fn is_tone(pole: &Pole) -> bool {
    (LOSSES[0]..LOSSES[1]).contains(&pole.loss())
}

/// Half the width of a pole's band (Hz).
fn half(pole: Pole) -> f64 {
    (0.16 * pole.hz).min(30.0 * pole.decay).max(24.0)
}

fn bands(taps: &[Ringing], pole: Pole, window: Window) -> Vec<Band> {
    let of = |(k, tap): (usize, &Ringing)| {
        let decay = 1.0 / pole.decay;
        let room = tap.samples.len() as f64 / tap.rate;
        let [from, to] = match window {
            Window::Whole => [BEGINS, BEGINS + (DECAYS * decay).min(LONGEST)],
            Window::Early => [BEGINS, BEGINS + EARLY * decay],
            Window::Late => [BEGINS + LATE[0] * decay, BEGINS + LATE[1] * decay],
        };
        let place = |t: f64| ((t.min(room) * tap.rate) as usize).min(tap.samples.len());
        let part = &tap.samples[place(from)..place(to)];
        Band::new(k, part, tap.rate, pole.hz, half(pole))
    };
    taps.iter().enumerate().filter_map(of).collect()
}

/// The poles of other tones that are in a band or near it.
fn near(others: &[Pole], pole: Pole) -> Vec<Pole> {
    let wide = BESIDE * half(pole);
    let near = |other: &&Pole| (other.hz - pole.hz).abs() < wide && !is_same(other, &pole);
    others.iter().filter(near).copied().collect()
}

/// A tone fitted to all taps from one starting pole, or twins if they are far better. `None` if there is no tone.
fn tone(taps: &[Ringing], least: f64, start: Pole, others: &[Pole]) -> Option<Found> {
    let beside = near(others, start);
    let mut bands = bands(taps, start, Window::Whole);
    let share = |bands: &[Band], poles: &[Pole]| -> Vec<(usize, f64)> {
        let all = [poles, &beside].concat();
        // The contribution of other tones is not part of this one.
        let left = |band: &Band| band.misfit(&all) / band.misfit(&beside).max(1e-300);
        bands.iter().map(|band| (band.tap, left(band))).collect()
    };
    let first = fit(&bands, &[start], &beside)?;
    let of_all = share(&bands, &first.poles);
    bands.retain(|band| of_all.iter().any(|(tap, misfit)| *tap == band.tap && *misfit < LOST));
    if bands.is_empty() {
        return None;
    }
    weigh(&mut bands, &first.poles, &beside);
    let mut whole = fit(&bands, &first.poles, &beside)?;
    if let Some(twins) = twins(&bands, &whole, &beside) {
        whole = twins;
    }
    let left: Vec<f64> = share(&bands, &whole.poles).into_iter().map(|(_, left)| left).collect();
    if !whole.poles.iter().all(is_tone) || median(&left) > MISFIT {
        return None;
    }
    let mut singles = vec![vec![]; whole.poles.len()];
    for band in &bands {
        let Some(one) = fit(std::slice::from_ref(band), &whole.poles, &beside) else { continue };
        for ((pole, joint), singles) in one.poles.iter().zip(&whole.poles).zip(&mut singles) {
            if (pole.hz / joint.hz).ln().abs() < SPREAD {
                singles.push((band.tap, [pole.hz.ln(), pole.loss().ln()]));
            }
        }
    }
    let is_shared = |all: &Vec<(usize, [f64; 2])>| {
        robust(all, 0) < SPREAD && is_enough(taps, least, |tap| all.iter().any(|one| one.0 == tap))
    };
    if !singles.iter().all(is_shared) {
        return None;
    }
    let level = level(&bands, &whole.poles, &beside);
    Some(Found { whole, misfits: of_all, singles, level })
}

/// Whether a tone is in enough taps of one of the recordings: each plane of the grain has its own tones.
fn is_enough(taps: &[Ringing], least: f64, is_heard: impl Fn(usize) -> bool) -> bool {
    let mut count = BTreeMap::<usize, [f64; 2]>::new();
    for (k, tap) in taps.iter().enumerate() {
        let [all, own] = count.entry(tap.recording).or_default();
        *all += 1.0;
        *own += f64::from(is_heard(k));
    }
    count.values().any(|[all, own]| *own >= least * all)
}

fn weigh(bands: &mut [Band], poles: &[Pole], beside: &[Pole]) {
    let all = [poles, beside].concat();
    bands.iter_mut().for_each(|band| band.weigh(&all));
}

/// Two poles in place of one, if they fit far better.
fn twins(bands: &[Band], one: &Fit, beside: &[Pole]) -> Option<Fit> {
    let start = two_poles(bands)?;
    let single = one.poles[0];
    let close = |pole: &Pole| (pole.hz / single.hz - 1.0).abs() < 0.06;
    if !start.iter().all(close) {
        return None;
    }
    let two = fit(bands, &start, beside)?;
    let [a, b] = [two.poles[0], two.poles[1]];
    let ratio = (a.decay / b.decay).max(b.decay / a.decay);
    let far_better = two.square < TWIN * one.square && ratio < TWIN_DECAYS;
    (far_better && !is_same(&a, &b) && two.poles.iter().all(close)).then_some(two)
}

/// Median level of the tone at the onset (dB): its power in the band over that of a tone of size 1.
fn level(bands: &[Band], poles: &[Pole], beside: &[Pole]) -> f64 {
    let all = [poles, beside].concat();
    let of = |band: &Band| band.amplitude(&all) + poles[0].decay * BEGINS;
    20.0 / 10.0_f64.ln() * median(&bands.iter().map(of).collect::<Vec<_>>())
}

/// Robust standard deviation over taps, of frequency (0) or loss factor (1).
fn robust(all: &[(usize, [f64; 2])], part: usize) -> f64 {
    let values: Vec<f64> = all.iter().map(|(_, one)| one[part]).collect();
    let middle = median(&values);
    let away: Vec<f64> = values.iter().map(|value| (value - middle).abs()).collect();
    match away.len() {
        0 | 1 => 0.0,
        2..=4 => {
            let squares: f64 = away.iter().map(|x| x * x).sum();
            (squares / (away.len() - 1) as f64).sqrt()
        }
        // For a normal distribution the median deviation is 0.6745 of it; at least what the 85th percentile gives.
        _ => (1.4826 * median(&away)).max(quantile(&away, 0.85) / 1.44),
    }
}

/// Differences of the fits to early and late windows, pole by pole: of f in δ/π, and of ln η.
fn early_and_late(taps: &[Ringing], poles: &[Pole], others: &[Pole]) -> [Option<[f64; 2]>; 2] {
    let beside = near(others, poles[0]);
    let of = |window| {
        let mut bands = bands(taps, poles[0], window);
        weigh(&mut bands, poles, &beside);
        fit(&bands, poles, &beside)
    };
    let (Some(early), Some(late)) = (of(Window::Early), of(Window::Late)) else { return [None; 2] };
    let difference = |p: usize| {
        let (a, b) = (early.poles.get(p)?, late.poles.get(p)?);
        Some([(a.hz - b.hz) * PI / poles[p].decay, (a.decay / b.decay).ln()])
    };
    [0, 1].map(difference)
}

/// Standard deviations of a pole's frequency (relative) and of the logarithm of its loss factor.
fn deviations(one: &Found, p: usize, difference: Option<[f64; 2]>, room: f64) -> [f64; 2] {
    let singles = &one.singles[p];
    // The deviation of f in δ/π is half of that of ln η.
    let units = [0.5 * one.whole.poles[p].loss(), 1.0];
    let count = singles.len() as f64;
    let factor = if count > 1.5 { 1.0 + 1.0 / (count - 1.0) } else { 2.0 };
    let [f, loss] = [0, 1].map(|part| robust(singles, part) / units[part]);
    let spread = (0.5 * (f.powi(2) + loss.powi(2))).sqrt();
    let own = difference.map_or(room, circular);
    let shared = (factor * spread / count.sqrt()).max(SEEN * 0.5 * (own + room));
    [0, 1]
        .map(|part| (shared * units[part]).hypot(one.whole.deviations[p][part]).hypot(FLOOR[part]))
}

/// Noise moves a pole equally in both directions: 2 Δf π/δ and Δ ln η have one deviation.
fn circular([f, loss]: [f64; 2]) -> f64 {
    (0.5 * ((2.0 * f).powi(2) + loss.powi(2))).sqrt()
}
