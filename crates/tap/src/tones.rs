//! Tones that the taps share, with what is known of their frequencies and decays.
//!
//! The error of a tone is
//!
//! ```text
//! s² = max(k spread/√n, c D)² + CRB² + floor²,    k = 1 + 1/(n − 1)
//! ```
//!
//! of the logarithm of its loss factor η, and η/2 of that of its frequency: what turns a pole `−δ + 2πi f` turns it
//! alike in both directions, so that 2 Δf/(f η) and Δ ln η have one deviation, and both say what it is. The spread is
//! that over n taps; D how far fits to an early and to a late window differ, half its own and half the median over the
//! tones: it sees the echo of the room, which all taps share where the microphone stays; CRB the bound by what is left
//! of the bands.
//!
//! The room's answer to a tap grows against a tone as `e^{2(δ − δ_r)t}`, δ_r its own decay (J.-D. Polack, Playing
//! billiards in the concert hall, Appl. Acoust. 38 (1993) 235): ringing is taken from the end of the blow on, since a
//! high tone that is heard 4 ms late has more of the room than of the bat.

use std::f64::consts::PI;

use crate::filter::{median, quantile};
use crate::fit::{Band, Fit, Pole, fit};
use crate::pencil::two_poles;

/// Ringing that is fitted begins so long after the onset (s), when the blow is over, and ends after that many decay
/// times and that long (s).
const BEGINS: f64 = 0.8e-3;
const DECAYS: f64 = 3.0;
const LONGEST: f64 = 1.2;
/// Early and late windows, in decay times; the early one begins as the whole.
const EARLY: f64 = 1.3;
const LATE: [f64; 2] = [0.8, 2.5];
/// Tones up to this number of half bands away bend a band's ground.
const BESIDE: f64 = 2.0;
/// Loss factors of a bat's tones.
pub const LOSSES: [f64; 2] = [0.0008, 0.08];
/// What is left of a tone's bands, of their power beside the ground, at most.
const MISFIT: f64 = 0.30;
/// The share of taps a tone is heard in, at least, and how far they may spread.
const HEARD: f64 = 0.6;
const SOME: f64 = 0.25;
/// A tap of whose band so much is left is not heard at all.
const LOST: f64 = 0.8;
const SPREAD: f64 = 0.012;
/// Two poles for one: where the squares fall so far, both decay within that factor and they are so far apart, in δ/π.
const TWIN: f64 = 0.35;
const TWIN_DECAYS: f64 = 2.5;
const TWIN_APART: f64 = 0.3;
/// Twins of the two planes of the grain are no further apart, relative; what is further is another tone.
const PLANES: f64 = 0.03;
/// A tap whose five strongest tones are left so badly, and so much worse than the others, is none.
const NO_TAP: f64 = 0.3;
const WORSE: f64 = 4.0;
/// Share of D, by 60 recordings of `search/taps.py --seed 101`, and errors that are never less: of f, and of ln η.
const SEEN: f64 = 0.6;
const FLOOR: [f64; 2] = [5e-5, 0.01];

/// A stretch in which one tap rings.
#[derive(Debug, Clone, Copy)]
pub struct Ringing<'a> {
    /// Which recording it is in.
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
    /// In how many taps it was heard.
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
    /// Which taps are used.
    pub used: Vec<bool>,
    /// How far early and late windows differ, of ln η.
    pub room: f64,
}

/// A tone on its way.
#[derive(Debug, Clone)]
struct Found {
    whole: Fit,
    misfits: Vec<(usize, f64)>,
    /// Frequencies and logarithms of decays of single taps, by pole.
    singles: Vec<Vec<[f64; 2]>>,
    level: f64,
}

/// Which window of the ringing.
#[derive(Clone, Copy, PartialEq)]
enum Window {
    Whole,
    Early,
    Late,
}

/// The tones of these taps, sought at these frequencies (Hz).
pub fn tones(taps: &[Ringing], peaks: &[f64]) -> Tones {
    let mut used = vec![true; taps.len()];
    // What is no tap has none of the tones: first those are sought that some taps share.
    let rough = heard(taps, &used, peaks, SOME);
    for (tap, used) in used.iter_mut().enumerate() {
        *used = !is_none(taps, &rough, tap);
    }
    let found = if used.contains(&true) { heard(taps, &used, peaks, HEARD) } else { vec![] };
    let mut differences: Vec<[Option<[f64; 2]>; 2]> = vec![];
    let poles: Vec<Vec<Pole>> = found.iter().map(|one| one.whole.poles.clone()).collect();
    for (k, one) in found.iter().enumerate() {
        let others = others(&poles, k);
        differences.push(early_and_late(taps, &used, &one.whole.poles, &others));
    }
    let all = differences.iter().flatten().flatten();
    let room = median(&all.map(|difference| circular(*difference)).collect::<Vec<_>>());
    let most = found.iter().map(|one| one.level).fold(f64::NEG_INFINITY, f64::max);
    let mut tones = vec![];
    for (one, differences) in found.iter().zip(&differences) {
        for (p, pole) in one.whole.poles.iter().enumerate() {
            let away = |hz: &f64| (hz / pole.hz - 1.0).abs();
            let all = poles.iter().flatten().map(|other| other.hz).filter(|hz| *hz != pole.hz);
            let twin = all.min_by(|a, b| away(a).total_cmp(&away(b)));
            let twin = twin.filter(|hz| away(hz) < PLANES);
            tones.push(Tone {
                pole: *pole,
                deviations: deviations(one, p, differences[p], room),
                taps: one.singles[p].len(),
                level: one.level - most,
                twin,
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

/// Whether the strongest tones are left so badly of a tap that it is none.
fn is_none(taps: &[Ringing], found: &[Found], tap: usize) -> bool {
    // Tones that its recording has: of the other plane of the grain a tap has none.
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

fn heard(taps: &[Ringing], used: &[bool], peaks: &[f64], least: f64) -> Vec<Found> {
    // First each alone, then beside the others in its band.
    let alone: Vec<Option<Pole>> = peaks.iter().map(|hz| begun(taps, used, *hz)).collect();
    let first: Vec<Pole> = apart(alone.into_iter().flatten().collect());
    let poles: Vec<Vec<Pole>> = first.iter().map(|pole| vec![*pole]).collect();
    let found: Vec<Vec<Pole>> = first
        .iter()
        .enumerate()
        .filter_map(|(k, pole)| {
            let one = tone((taps, used, least), &[*pole], &others(&poles, k))?;
            // Of two tones in one band each peak finds both: each goes on with its own.
            let mut poles = one.whole.poles;
            let away = |other: &Pole| (other.hz - pole.hz).abs();
            poles.sort_by(|a, b| away(a).total_cmp(&away(b)));
            Some(poles)
        })
        .collect();
    let again =
        (0..found.len()).map(|k| tone((taps, used, least), &found[k][..1], &others(&found, k)));
    let mut kept: Vec<Found> = vec![];
    for one in again.flatten() {
        let near = |other: &Found| {
            let pairs =
                one.whole.poles.iter().flat_map(|a| other.whole.poles.iter().map(move |b| (a, b)));
            pairs.into_iter().any(|(a, b)| is_same(a, b))
        };
        match kept.iter().position(near) {
            Some(k) if kept[k].level < one.level => kept[k] = one,
            Some(_) => {}
            None => kept.push(one),
        }
    }
    kept
}

/// Whether two poles cannot be told apart.
fn is_same(a: &Pole, b: &Pole) -> bool {
    (a.hz - b.hz).abs() < TWIN_APART * a.decay.max(b.decay) / PI
}

fn apart(poles: Vec<Pole>) -> Vec<Pole> {
    let mut kept: Vec<Pole> = vec![];
    for pole in poles {
        if !kept.iter().any(|other| is_same(other, &pole)) {
            kept.push(pole);
        }
    }
    kept
}

/// A pole that begins the fit at that frequency: the best of several decays.
fn begun(taps: &[Ringing], used: &[bool], hz: f64) -> Option<Pole> {
    let start = Pole::of(hz, 0.007);
    let bands = bands(taps, used, start, Window::Whole);
    let mut best: Option<(f64, Pole)> = None;
    for loss in [0.0015, 0.003, 0.006, 0.012, 0.024, 0.045] {
        let pole = Pole::of(hz, loss);
        let left = median(&bands.iter().map(|band| band.misfit(&[pole])).collect::<Vec<_>>());
        if best.is_none_or(|(least, _)| left < least) {
            best = Some((left, pole));
        }
    }
    let found = fit(&bands, &[best?.1], &[])?.poles[0];
    is_tone(&found).then_some(found)
}

fn is_tone(pole: &Pole) -> bool {
    (LOSSES[0]..LOSSES[1]).contains(&pole.loss())
}

/// Half the width of a pole's band (Hz).
fn half(pole: Pole) -> f64 {
    (0.16 * pole.hz).min(30.0 * pole.decay).max(24.0)
}

fn bands(taps: &[Ringing], used: &[bool], pole: Pole, window: Window) -> Vec<Band> {
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
    taps.iter().enumerate().filter(|(k, _)| used[*k]).filter_map(of).collect()
}

/// The poles of other tones that are in a band or near it.
fn near(others: &[Pole], pole: Pole) -> Vec<Pole> {
    let wide = BESIDE * half(pole);
    others
        .iter()
        .filter(|other| (other.hz - pole.hz).abs() < wide && !is_same(other, &pole))
        .copied()
        .collect()
}

/// A tone fitted to all taps, begun at one pole; twins where they are far better. None where there is no tone.
fn tone(
    (taps, used, least): (&[Ringing], &[bool], f64),
    start: &[Pole],
    others: &[Pole],
) -> Option<Found> {
    let beside = near(others, start[0]);
    let mut bands = bands(taps, used, start[0], Window::Whole);
    let share = |bands: &[Band], poles: &[Pole]| -> Vec<(usize, f64)> {
        let all: Vec<Pole> = poles.iter().chain(&beside).copied().collect();
        // What the others make of it is no part of the tone.
        let left = |band: &Band| band.misfit(&all) / band.misfit(&beside).max(1e-300);
        bands.iter().map(|band| (band.tap, left(band))).collect()
    };
    let first = fit(&bands, start, &beside)?;
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
    let misfits = share(&bands, &whole.poles);
    if !whole.poles.iter().all(is_tone)
        || median(&misfits.iter().map(|m| m.1).collect::<Vec<_>>()) > MISFIT
    {
        return None;
    }
    let mut singles = vec![vec![]; whole.poles.len()];
    let mut within = singles.iter().map(|_: &Vec<[f64; 2]>| vec![]).collect::<Vec<Vec<usize>>>();
    for band in &bands {
        let Some(one) = fit(std::slice::from_ref(band), &whole.poles, &beside) else { continue };
        for (p, (pole, joint)) in one.poles.iter().zip(&whole.poles).enumerate() {
            if (pole.hz / joint.hz).ln().abs() < SPREAD {
                singles[p].push([pole.hz.ln(), pole.loss().ln()]);
                within[p].push(band.tap);
            }
        }
    }
    let is_close = |all: &Vec<[f64; 2]>| robust(all, 0) < SPREAD;
    if !singles.iter().all(is_close)
        || !within.iter().all(|heard| is_enough((taps, used, least), heard))
    {
        return None;
    }
    let level = level(&bands, &whole.poles, &beside);
    Some(Found { whole, misfits: of_all, singles, level })
}

/// Whether a tone is in enough taps of one of the recordings: two planes of the grain have tones of their own.
fn is_enough((taps, used, least): (&[Ringing], &[bool], f64), heard: &[usize]) -> bool {
    let mut count = std::collections::BTreeMap::<usize, [f64; 2]>::new();
    for (k, tap) in taps.iter().enumerate().filter(|(k, _)| used[*k]) {
        let [all, own] = count.entry(tap.recording).or_default();
        *all += 1.0;
        *own += f64::from(heard.contains(&k));
    }
    count.values().any(|[all, own]| *own >= least * all)
}

fn weigh(bands: &mut [Band], poles: &[Pole], beside: &[Pole]) {
    let all: Vec<Pole> = poles.iter().chain(beside).copied().collect();
    bands.iter_mut().for_each(|band| band.weigh(&all));
}

/// Two poles in place of one, where they fit far better.
fn twins(bands: &[Band], one: &Fit, beside: &[Pole]) -> Option<Fit> {
    let [a, b] = two_poles(bands)?;
    let single = one.poles[0];
    let close = |pole: &Pole| (pole.hz / single.hz - 1.0).abs() < 0.06;
    if !close(&a) || !close(&b) {
        return None;
    }
    let two = fit(bands, &[a, b], beside)?;
    let [a, b] = [two.poles[0], two.poles[1]];
    let ratio = (a.decay / b.decay).max(b.decay / a.decay);
    let apart = (a.hz - b.hz).abs() > TWIN_APART * a.decay.max(b.decay) / PI;
    (two.square < TWIN * one.square && ratio < TWIN_DECAYS && apart && close(&a) && close(&b))
        .then_some(two)
}

/// Median level of the tone at the onset (dB): its power in the band over that of a tone of size 1.
fn level(bands: &[Band], poles: &[Pole], beside: &[Pole]) -> f64 {
    let all: Vec<Pole> = poles.iter().chain(beside).copied().collect();
    let of = |band: &Band| band.amplitude(&all) + poles[0].decay * BEGINS;
    20.0 / 10.0_f64.ln() * median(&bands.iter().map(of).collect::<Vec<_>>())
}

/// Standard deviation over taps by the middle half, of frequency (0) or loss factor (1).
fn robust(all: &[[f64; 2]], part: usize) -> f64 {
    let values: Vec<f64> = all.iter().map(|one| one[part]).collect();
    let middle = median(&values);
    let away: Vec<f64> = values.iter().map(|value| (value - middle).abs()).collect();
    match away.len() {
        0 | 1 => 0.0,
        2..=4 => {
            let squares: f64 = away.iter().map(|x| x * x).sum();
            (squares / (away.len() - 1) as f64).sqrt()
        }
        // Of a normal distribution the median away is 0.6745 of it; no less than what the outer ones say by a third.
        _ => (1.4826 * median(&away)).max(quantile(&away, 0.85) / 1.44),
    }
}

/// By how much the fits to early and late windows differ, pole by pole: of f in δ/π, and of ln η.
fn early_and_late(
    taps: &[Ringing],
    used: &[bool],
    poles: &[Pole],
    others: &[Pole],
) -> [Option<[f64; 2]>; 2] {
    let beside = near(others, poles[0]);
    let of = |window| {
        let mut bands = bands(taps, used, poles[0], window);
        weigh(&mut bands, poles, &beside);
        fit(&bands, poles, &beside)
    };
    let (Some(early), Some(late)) = (of(Window::Early), of(Window::Late)) else { return [None; 2] };
    let difference = |p: usize| {
        let (a, b) = (early.poles.get(p)?, late.poles.get(p)?);
        Some([(a.hz - b.hz) * PI / poles[p].decay, (a.decay / b.decay).ln()])
    };
    [difference(0), difference(1)]
}

/// Standard deviations of a pole's frequency (relative) and of the logarithm of its loss factor.
fn deviations(one: &Found, p: usize, difference: Option<[f64; 2]>, room: f64) -> [f64; 2] {
    let pole = one.whole.poles[p];
    // Of f told in δ/π half of what is that of ln η is.
    let units = [0.5 * pole.decay / PI / pole.hz, 1.0];
    let both = |parts: [f64; 2]| (0.5 * (parts[0].powi(2) + parts[1].powi(2))).sqrt();
    let count = one.singles[p].len() as f64;
    let factor = if count > 1.5 { 1.0 + 1.0 / (count - 1.0) } else { 2.0 };
    let spread = both([0, 1].map(|part| robust(&one.singles[p], part) / units[part]));
    let own = difference.map_or(room, circular);
    let shared = (factor * spread / count.sqrt()).max(SEEN * 0.5 * (own + room));
    [0, 1]
        .map(|part| (shared * units[part]).hypot(one.whole.deviations[p][part]).hypot(FLOOR[part]))
}

/// Noise turns a pole alike in both directions: 2 Δf π/δ and Δ ln η have one deviation.
fn circular([f, loss]: [f64; 2]) -> f64 {
    (0.5 * ((2.0 * f).powi(2) + loss.powi(2))).sqrt()
}
