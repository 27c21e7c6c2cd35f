//! Tones common to the taps, with their frequencies, decays and errors.
//!
//! The error of a tone is
//!
//! ```text
//! s² = W² max(k² S, R) + CRB² + floor²,    k = 1 + 1/(2(n − 1))
//! ```
//!
//! for the logarithm of its loss factor η, and η/2 of that for the logarithm of its frequency. A disturbance moves a
//! pole `−δ + 2πi f` equally in both directions, so that 2 Δf/(f η) and Δ ln η have one deviation, which both measure.
//! S and R are levels of the room's echo, and W is the deviation that an echo of level 1 gives the tone. S follows
//! from the variance over n taps; R from how far fits to an early and to a late window differ, which sees the echo
//! that all taps share where the microphone stays. Both are the median over the tones, but for a tone's own share. CRB
//! is the bound by what is left of the bands.
//!
//! The room's answer to a tap grows against a tone as `e^{2(δ − δ_r)t}`, δ_r its own decay (J.-D. Polack, Playing
//! billiards in the concert hall, Appl. Acoust. 38 (1993) 235). So what it adds to a tone is a random walk, and a fit
//! takes the walk's slope over a window, weighed by `e^{−2δt}`: `walked` has the deviations of such slopes. Ringing
//! is taken from the end of the blow on, since a high tone that is heard 4 ms late has more of the room than of the
//! bat.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use crate::filter::{median, most, quantile};
use crate::fit::{Band, Fit, Pole, fit};
use crate::pencil::two_poles;

/// Beginning of the fitted ringing after the onset (s), after the blow, and its longest duration (s).
const BEGINS: f64 = 0.8e-3;
const LONGEST: f64 = 1.2;
/// The window that is fitted, an early and a late one, in decay times from there on.
const WHOLE: [f64; 2] = [0.0, 3.0];
const EARLY: [f64; 2] = [0.0, 1.3];
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
/// Decay of a furnished room (1/s): 60 dB in 0.35 s.
const ROOM: f64 = 20.0;
/// A tone's own share in the levels of the room, by 200 recordings of `search/taps.py`, seeds 21 and 22.
const OWN: f64 = 0.25;
/// Median of the square of a complex normal number over its mean.
const MEDIAN: f64 = std::f64::consts::LN_2;
/// Least errors of f and of ln η.
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
    let differences: Vec<[Option<f64>; 2]> = (0..found.len()).map(differences).collect();
    let all: Vec<f64> = differences.iter().flatten().flatten().copied().collect();
    let room = median(&all).sqrt();
    let loudest = most(&found.iter().map(|one| one.level).collect::<Vec<_>>());
    let mut levels = vec![];
    for (one, differences) in found.iter().zip(&differences) {
        for (p, pole) in one.whole.poles.iter().enumerate() {
            let [whole, apart] = walked(pole.decay);
            let count = one.singles[p].len() as f64;
            let own = (count > 1.5).then(|| one.variance(p) / (count * whole));
            levels.push([own, differences[p].map(|square| square / apart)]);
        }
    }
    let mut own = levels.iter();
    let usual = [(0, 1.0), (1, MEDIAN)].map(|(k, share)| {
        let all: Vec<f64> = levels.iter().filter_map(|level| level[k]).collect();
        if all.is_empty() { 0.0 } else { median(&all) / share }
    });
    let mut tones = vec![];
    for one in &found {
        for (p, pole) in one.whole.poles.iter().enumerate() {
            let away = |hz: &f64| (hz / pole.hz - 1.0).abs();
            let all = poles.iter().flatten().map(|other| other.hz).filter(|hz| *hz != pole.hz);
            let twin = all.min_by(|a, b| away(a).total_cmp(&away(b)));
            let of =
                |k: usize, own: Option<f64>| usual[k] + OWN * (own.unwrap_or(usual[k]) - usual[k]);
            let [spread, echo] = own.next().map_or(usual, |[a, b]| [of(0, *a), of(1, *b)]);
            tones.push(Tone {
                pole: *pole,
                deviations: one.deviations(p, spread, echo),
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
    // Tones of the tap's recording only: a tap has no tones of the other plane of the grain.
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
    let bands = bands(taps, Pole::of(hz, 0.007), WHOLE);
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

fn bands(taps: &[Ringing], pole: Pole, window: [f64; 2]) -> Vec<Band> {
    let of = |(k, tap): (usize, &Ringing)| {
        let place = |u: f64| {
            let t = BEGINS + (u / pole.decay).min(LONGEST);
            ((t * tap.rate) as usize).min(tap.samples.len())
        };
        let part = &tap.samples[place(window[0])..place(window[1])];
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
    let mut bands = bands(taps, start, WHOLE);
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
        is_enough(taps, least, |tap| all.iter().any(|one| one.0 == tap))
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

/// Differences of the fits to early and late windows, pole by pole, as [`circular`].
fn early_and_late(taps: &[Ringing], poles: &[Pole], others: &[Pole]) -> [Option<f64>; 2] {
    let beside = near(others, poles[0]);
    let of = |window| {
        let mut bands = bands(taps, poles[0], window);
        weigh(&mut bands, poles, &beside);
        fit(&bands, poles, &beside)
    };
    let (Some(early), Some(late)) = (of(EARLY), of(LATE)) else { return [None; 2] };
    let difference = |p: usize| {
        let (a, b) = (early.poles.get(p)?, late.poles.get(p)?);
        Some(circular([(a.hz / b.hz).ln(), (a.loss() / b.loss()).ln()], poles[p].loss()))
    };
    [0, 1].map(difference)
}

/// The square of the one deviation of 2 Δf/(f η) and Δ ln η, of differences of ln f and ln η.
fn circular([f, ln]: [f64; 2], loss: f64) -> f64 {
    0.5 * ((2.0 * f / loss).powi(2) + ln.powi(2))
}

/// Variances of the slope that the room's walk has for a tone of that decay (1/s): over the whole window, and of the
/// difference of early and late ones. With time in decay times u and `q = δ_r/δ` its steps are `√q e^{(1 − q)u}`.
fn walked(decay: f64) -> [f64; 2] {
    const STEPS: usize = 240;
    const STEP: f64 = WHOLE[1] / STEPS as f64;
    let at = |k: usize| STEP * (k as f64 + 0.5);
    // The effect of a step at u on the slope of a window: the integral from u on of `e^{−2u} (u − mean)`.
    let turned = |[from, to]: [f64; 2]| {
        let [first, last] = [from, to].map(|u| (-2.0 * u).exp());
        let mean = 0.5 + (from * first - to * last) / (first - last);
        let rest = |u: f64| (-2.0 * u).exp() * (2.0 * (u - mean) + 1.0);
        let after = |u: f64| if (from..to).contains(&u) { rest(u) - rest(to) } else { 0.0 };
        let after: Vec<f64> = (0..STEPS).map(|k| after(at(k))).collect();
        let size = STEP * after.iter().sum::<f64>();
        after.into_iter().map(|x| x / size).collect::<Vec<f64>>()
    };
    let [whole, early, late] = [WHOLE, EARLY, LATE].map(turned);
    let quick = ROOM / decay;
    let step = |k: usize| STEP * quick * (2.0 * (1.0 - quick) * at(k)).exp();
    let sum = |turn: &dyn Fn(usize) -> f64| (0..STEPS).map(|k| turn(k).powi(2) * step(k)).sum();
    [sum(&|k| whole[k]), sum(&|k| early[k] - late[k])]
}

impl Found {
    /// The variance over taps of one of its poles, [`circular`].
    fn variance(&self, p: usize) -> f64 {
        let singles = &self.singles[p];
        let count = singles.len() as f64;
        let mean = |part: usize| singles.iter().map(|(_, one)| one[part]).sum::<f64>() / count;
        let mean = [0, 1].map(mean);
        let away = |one: &[f64; 2]| {
            circular([one[0] - mean[0], one[1] - mean[1]], self.whole.poles[p].loss())
        };
        singles.iter().map(|(_, one)| away(one)).sum::<f64>() / (count - 1.0)
    }

    /// Standard deviations of the frequency of one of its poles (relative) and of the logarithm of its loss factor, at
    /// these levels of the room.
    fn deviations(&self, p: usize, spread: f64, echo: f64) -> [f64; 2] {
        let pole = self.whole.poles[p];
        let count = self.singles[p].len() as f64;
        let factor = if count > 1.5 { 1.0 + 0.5 / (count - 1.0) } else { 1.0 };
        let shared = (walked(pole.decay)[0] * (factor * factor * spread).max(echo)).sqrt();
        // The deviation of the frequency is half of that of ln η.
        let units = [0.5 * pole.loss(), 1.0];
        [0, 1].map(|part| {
            (shared * units[part]).hypot(self.whole.deviations[p][part]).hypot(FLOOR[part])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The variance over taps is that of two numbers for two taps, of the frequency in half-power widths and of the
    /// loss factor, wherever their means are.
    #[test]
    fn a_variance_is_that_about_the_mean() {
        let loss = 0.01;
        for mean in [[0.0, 0.0], [6.2, -4.6]] {
            let one = |sign: f64| (0, [mean[0] + sign * 0.002, mean[1] + sign * 0.3]);
            let whole =
                Fit { poles: vec![Pole::of(500.0, loss)], deviations: vec![[0.0; 2]], square: 0.0 };
            let singles = vec![vec![one(1.0), one(-1.0)]];
            let found = Found { whole, misfits: vec![], singles, level: 0.0 };
            // Half of (2 · 0.002/0.01)² + 0.3², for each of two taps, over one degree of freedom.
            assert!((found.variance(0) / (0.16 + 0.09) - 1.0).abs() < 1e-9);
        }
    }

    /// The slopes of unit steps agree with weighted least squares.
    #[test]
    fn a_walk_turns_the_slope_as_its_steps_do() {
        let at = |k: usize| (k as f64 + 0.5) * WHOLE[1] / 600.0;
        let slope = |step: usize, [from, to]: [f64; 2]| {
            let rows = (0..600).filter(|k| (from..to).contains(&at(*k)));
            let sums = rows.fold([0.0; 5], |[w, x, xx, y, xy], k| {
                let (weight, u, e) = ((-2.0 * at(k)).exp(), at(k), f64::from(k >= step));
                [
                    w + weight,
                    x + weight * u,
                    xx + weight * u * u,
                    y + weight * e,
                    xy + weight * u * e,
                ]
            });
            let [w, x, xx, y, xy] = sums;
            (w * xy - x * y) / (w * xx - x * x)
        };
        for decay in [5.0, 20.0, 35.0, 300.0] {
            let q = ROOM / decay;
            let sum = |turned: &dyn Fn(usize) -> f64| -> f64 {
                let one = |k: usize| {
                    q * (2.0 * (1.0 - q) * at(k)).exp() * turned(k).powi(2) * WHOLE[1] / 600.0
                };
                (0..600).map(one).sum()
            };
            let whole = sum(&|k| slope(k, WHOLE));
            let apart = sum(&|k| slope(k, EARLY) - slope(k, LATE));
            let found = walked(decay);
            assert!(
                (found[0] / whole - 1.0).abs() < 0.03 && (found[1] / apart - 1.0).abs() < 0.03,
                "{decay} {found:?} {whole} {apart}"
            );
        }
    }
}
