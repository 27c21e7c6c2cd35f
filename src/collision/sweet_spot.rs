//! Where is the sweet spot, by each of its definitions?

use serde::{Deserialize, Serialize};

use crate::base::golden;
use crate::base::threads;
use crate::collision::hit::MOST_WORK;
use crate::collision::hitter::Hitter;
use crate::collision::strike::Glance;

/// A place and the value there.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Peak {
    /// The place (m).
    #[serde(rename = "x_m")]
    pub x: f64,
    /// The value, in the unit of the member that holds it.
    pub value: f64,
}

/// The sweet spot of the outer half of the bat, by each of its definitions; null for a definition that gives none.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct SweetSpot {
    /// Where the ball leaves fastest (m/s).
    pub exit_speed_max: Option<Peak>,
    /// Where the ball is fastest at its first separation (m/s), among places where the bat does not catch up with it as
    /// it leaves. It differs from `exit_speed_max` if that depends on a later contact.
    pub first_separation_max: Option<Peak>,
    /// Where the least energy stays in vibration (J).
    pub vibration_min: Option<Peak>,
    /// The barrel-side node of the first bending mode (m).
    #[serde(rename = "node_mode_1_m")]
    pub node_mode_1: Option<f64>,
    /// The barrel-side node of the second bending mode (m).
    #[serde(rename = "node_mode_2_m")]
    pub node_mode_2: Option<f64>,
    /// The centre of percussion for the swing's own pivot (m).
    #[serde(rename = "center_of_percussion_m")]
    pub center_of_percussion: Option<f64>,
    /// Beginning and end of the zone where the exit speed is within 1 % of its maximum (m).
    #[serde(rename = "zone_m")]
    pub zone: Option<[f64; 2]>,
    /// Where the hands feel the least velocity (m/s).
    // As `Glance::hands` counts it; the next member too.
    pub hands_velocity_min: Option<Peak>,
    /// Where the hands feel the least acceleration (m/s²).
    pub hands_acceleration_min: Option<Peak>,
    /// Exit speeds (m/s) an inch from the best place, towards the knob and towards the tip; null
    /// beyond the tip.
    #[serde(rename = "inch_off_m_s")]
    pub inch_off: Option<[Option<f64>; 2]>,
    /// Distance of the places that were evaluated (m), if the bat catches up with the ball late or again and a closer
    /// search would have taken too long: narrower peaks may be missed. Left out otherwise.
    // Longer than `MOST_WORK`.
    #[serde(default, rename = "looked_every_m", skip_serializing_if = "Option::is_none")]
    pub looked_every: Option<f64>,
}

/// Number of steps of a first pass along the outer half, and the share of it to which a place is then located.
pub const FINE: (usize, f64) = (128, 1e-6);
/// The same if the best places are known to be near others, or for many bats: to about 10 µm, because shifts are
/// reported in tenths of a millimetre.
pub const FEW: (usize, f64) = (32, 2e-5);
/// Number of steps of a closer pass between two places of the first.
const BETWEEN: usize = 4;
/// Number of steps between two places of the first pass if the bat catches up with the ball late or again: touches
/// there appear and vanish within a millimetre, and change the exit speed.
const BETWEEN_LATER: usize = 8;
/// Number of stretches between such places that are searched even more closely.
const CLOSER_LATER: usize = 8;
const INCH: f64 = 0.0254;

impl SweetSpot {
    /// Finds the sweet spot between the middle of the bat and its tip.
    ///
    /// ```
    /// use sweetspot::Bat;
    /// use sweetspot::collision::sweep::{Accuracy, sweep};
    /// use sweetspot::collision::{Hitter, Model, Scene, SweetSpot};
    ///
    /// # fn main() -> sweetspot::Result<()> {
    /// # let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
    /// #     "profile": { "unit": "in", "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5] } }"#;
    /// # let bat = Bat::from_text("bat.json", text, "".as_ref())?;
    /// let scene = Scene { swing: 45.0, ball_speed: 38.0, ..Scene::default() };
    /// let hits = sweep(&bat, Model::Contact, &scene, &Accuracy::default(), &[0.7])?;
    /// let hitter = Hitter::new(Model::Contact, &scene, &bat, &hits.solution, hits.effort)?;
    /// let best = SweetSpot::find(&hitter).exit_speed_max.expect("they meet somewhere");
    /// assert!(best.x > 0.42 && best.x < bat.length());
    /// # Ok(())
    /// # }
    /// ```
    pub fn find(hitter: &Hitter) -> Self {
        Self::within(&HitsAlong::outer(FINE, hitter))
    }

    /// Finds the sweet spot on a stretch after a pass along it.
    pub fn within(looked: &HitsAlong) -> Self {
        let Hitter { scene, solution, .. } = *looked.hitter;
        let bat = looked.hitter.struck.bat;
        let exit_speed_max = looked.fastest();
        let last_node = |k: usize| solution.modes.get(k).and_then(|m| m.nodes.last().copied());
        let off = |peak: Peak, by: f64| {
            let x = peak.x + by;
            (x <= bat.length())
                .then(|| looked.hitter.glance(x).map(|glance| glance.exit_speed))
                .flatten()
        };
        // The body as the hit treats it: without rotary inertia, a line of mass.
        let body = bat.inertia();
        let body = if solution.theory.turns() { body } else { body.as_line() };
        Self {
            zone: exit_speed_max.map(|peak| looked.zone(peak)),
            inch_off: exit_speed_max.map(|peak| [off(peak, -INCH), off(peak, INCH)]),
            exit_speed_max,
            first_separation_max: looked.first_separation(exit_speed_max),
            vibration_min: looked.least_vibration(),
            hands_velocity_min: looked.least_felt(0),
            hands_acceleration_min: looked.least_felt(1),
            node_mode_1: last_node(0),
            node_mode_2: last_node(1),
            center_of_percussion: body.center_of_percussion(-scene.pivot),
            looked_every: looked.looked_every,
        }
    }
}

/// A stretch of a bat after a first pass along it.
pub struct HitsAlong<'a> {
    ends: [f64; 2],
    /// Accuracy of located places (m).
    width: f64,
    hitter: &'a Hitter<'a>,
    /// Number of steps of the first pass.
    steps: usize,
    /// Places (m), rising, and the hits there.
    places: Vec<f64>,
    seen: Vec<Option<Glance>>,
    /// As [`SweetSpot::looked_every`].
    pub looked_every: Option<f64>,
}

impl<'a> HitsAlong<'a> {
    /// Makes a pass along the outer half of the bat, as [`Self::by`] does along any stretch.
    pub fn outer(look: (usize, f64), hitter: &'a Hitter<'a>) -> Self {
        let length = hitter.profile.length();
        Self::by([0.5 * length, length], look, hitter)
    }

    /// Makes a pass along a stretch (m) in `steps` steps, and locates places to `share` of it. Fewer steps are enough
    /// if the best places are known to be near others, and a larger share if only their distance from others is
    /// reported. The steps are finer where the bat catches up with the ball late or again.
    pub fn by(ends: [f64; 2], (steps, share): (usize, f64), hitter: &'a Hitter<'a>) -> Self {
        let length = ends[1] - ends[0];
        let parts = steps * BETWEEN_LATER;
        let place = |part: usize| ends[0] + length * part as f64 / parts as f64;
        let look = |parts: &[usize]| threads::map(parts.len(), |k| hitter.glance(place(parts[k])));
        let first: Vec<usize> = (0..=steps).map(|k| k * BETWEEN_LATER).collect();
        let before = hitter.work();
        let mut seen: Vec<(usize, Option<Glance>)> =
            first.iter().copied().zip(look(&first)).collect();
        let work = hitter.work() - before;
        let later = |glance: &Option<Glance>| glance.is_some_and(|glance| glance.later);
        let unsettled = seen.windows(2).filter(|pair| later(&pair[0].1) || later(&pair[1].1));
        let unsettled: Vec<usize> = unsettled.map(|pair| pair[0].0).collect();
        let affordable = |apart: &usize| {
            let looks = unsettled.len() * (BETWEEN_LATER / apart - 1);
            looks as u64 * work <= MOST_WORK * first.len() as u64
        };
        let apart = [1, 2, 4].into_iter().find(affordable).unwrap_or(BETWEEN_LATER);
        let within = |from: &usize| (from + apart..from + BETWEEN_LATER).step_by(apart);
        let between: Vec<usize> = unsettled.iter().flat_map(within).collect();
        let looked_every = (apart > 1).then(|| length * apart as f64 / parts as f64);
        seen.extend(between.iter().copied().zip(look(&between)));
        seen.sort_by_key(|(part, _)| *part);
        let (parts, seen): (Vec<usize>, _) = seen.into_iter().unzip();
        let places = parts.into_iter().map(place).collect();
        Self { ends, width: share * length, hitter, steps, places, seen, looked_every }
    }

    /// The index of the last place.
    fn last(&self) -> usize {
        self.seen.len() - 1
    }

    /// The k-th place.
    fn place(&self, k: usize) -> f64 {
        self.places[k]
    }

    /// The places of the pass (m), rising.
    pub fn places(&self) -> &[f64] {
        &self.places
    }

    /// Values at the places of the pass; −∞ where there is none.
    pub fn values(&self, value: impl Fn(&Glance) -> Option<f64>) -> Vec<f64> {
        let of = |glance: &Option<Glance>| glance.as_ref().and_then(&value);
        self.seen.iter().map(|glance| of(glance).unwrap_or(f64::NEG_INFINITY)).collect()
    }

    /// Where the ball leaves fastest (m/s).
    pub fn fastest(&self) -> Option<Peak> {
        self.greatest(|glance| Some(glance.exit_speed))
    }

    /// Where the ball is fastest at its first separation (m/s), among places where the bat does not catch up with it as
    /// it leaves. It is `fastest` if the bat catches up with it nowhere.
    fn first_separation(&self, fastest: Option<Peak>) -> Option<Peak> {
        match self.seen.iter().flatten().any(|glance| glance.later) {
            true => self.greatest(|glance| (!glance.late).then_some(glance.first_exit)),
            false => fastest,
        }
    }

    /// Where the least energy stays in vibration (J).
    pub fn least_vibration(&self) -> Option<Peak> {
        self.least(|glance| glance.vibration)
    }

    /// Where the hands feel the least velocity (m/s, `k` 0) or acceleration (m/s², `k` 1); `None` for hands that feel
    /// nothing anywhere, as on a pin, or if no mode shakes them.
    pub fn least_felt(&self, k: usize) -> Option<Peak> {
        let felt = self.seen.iter().flatten().map(|glance| glance.hands[k]);
        let feels = felt.fold(0.0, f64::max) > [1e-9, 1e-5][k];
        feels.then(|| self.least(|glance| Some(glance.hands[k]))).flatten()
    }

    /// Where one of [`Hitter::figures`] is largest; `None` for a bat that does not bend, whose BBCOR equals the ball's
    /// restitution everywhere.
    pub fn largest_figure(&self, k: usize) -> Option<Peak> {
        let bends = self.hitter.modes_used() > 0;
        let figure = |glance: &Glance| Some(self.hitter.figures(glance.x, glance.exit_speed)[k]);
        bends.then(|| self.greatest(figure)).flatten()
    }

    fn least(&self, value: impl Fn(&Glance) -> Option<f64>) -> Option<Peak> {
        let greatest = self.greatest(|glance| value(glance).map(|value| -value))?;
        Some(Peak { x: greatest.x, value: -greatest.value })
    }

    /// The place of the greatest value: the best of the first pass, of closer ones wherever a greater value may hide
    /// between two places, and then of Brent's search.
    pub fn greatest(&self, value: impl Fn(&Glance) -> Option<f64>) -> Option<Peak> {
        let of =
            |glance: &Option<Glance>| glance.as_ref().and_then(&value).unwrap_or(f64::NEG_INFINITY);
        let best =
            (0..=self.last()).max_by(|&a, &b| of(&self.seen[a]).total_cmp(&of(&self.seen[b])))?;
        let seen = of(&self.seen[best]);
        if seen == f64::NEG_INFINITY {
            return None;
        }
        let at = |x: f64| of(&self.hitter.glance(x));
        let low = self.place(best.saturating_sub(1));
        let high = self.place((best + 1).min(self.last()));
        let mut here = (Peak { x: self.place(best), value: seen }, [low, high]);
        let seen = self.values(&value);
        let mut closer: Vec<(usize, f64)> = (0..self.last())
            .filter(|k| k + 1 < best || *k > best)
            .map(|k| (k, highest_between(&self.places, &seen, k)))
            .collect();
        closer.retain(|(_, highest)| *highest > here.0.value);
        // Where touches come and go, the whole stretch was searched closely: the most promising places are enough
        // there.
        let first = (self.places[self.last()] - self.places[0]) / self.steps as f64;
        let (mut settled, mut later): (Vec<_>, Vec<_>) =
            closer.into_iter().partition(|(k, _)| self.place(k + 1) - self.place(*k) > 0.5 * first);
        later.sort_by(|a, b| b.1.total_cmp(&a.1));
        later.truncate(CLOSER_LATER);
        settled.append(&mut later);
        for (k, highest) in settled {
            if highest <= here.0.value {
                continue;
            }
            let step = (self.place(k + 1) - self.place(k)) / BETWEEN as f64;
            for part in 1..BETWEEN {
                let x = self.place(k) + step * part as f64;
                let found = Peak { x, value: at(x) };
                if found.value > here.0.value {
                    here = (found, [x - step, x + step]);
                }
            }
        }
        let (here, between) = here;
        let found = brent(between, here, self.width, at);
        // The ends of the interval may be the best places, and the search only approaches them.
        Some(if found.value > here.value { found } else { here })
    }

    /// Whether a value above `level` was found, or may hide between two places, farther from `x` than two steps.
    pub fn may_exceed(&self, level: f64, x: f64, value: impl Fn(&Glance) -> Option<f64>) -> bool {
        let (seen, near) =
            (self.values(value), 2.0 * (self.ends[1] - self.ends[0]) / self.steps as f64);
        let far = |k: &usize| (0.5 * (self.place(*k) + self.place(k + 1)) - x).abs() > near;
        (0..self.last()).filter(far).any(|k| highest_between(&self.places, &seen, k) > level)
    }

    /// The zone around the peak in which the exit speed stays within 1 %, by the Illinois method on both sides.
    pub fn zone(&self, peak: Peak) -> [f64; 2] {
        let floor = peak.value - 0.01 * peak.value.abs();
        let above = |glance: &Option<Glance>| glance.map_or(f64::NAN, |g| g.exit_speed - floor);
        let [from, to] = self.ends;
        let edge = |end: f64, bad: Option<usize>| {
            let Some(k) = bad else { return end };
            let bad = [self.place(k), above(&self.seen[k])];
            let at = |x: f64| above(&self.hitter.glance(x));
            boundary([peak.x, peak.value - floor], bad, self.width, at)
        };
        // NaN counts as too low.
        let poor = |k: &usize| above(&self.seen[*k]).is_nan() || above(&self.seen[*k]) < 0.0;
        let below = (0..=self.last()).rev().filter(|k| self.place(*k) < peak.x).find(poor);
        let beyond = (0..=self.last()).filter(|k| self.place(*k) > peak.x).find(poor);
        [edge(from, below), edge(to, beyond)]
    }
}

/// Upper bound of the values between place k and the next: the higher of both plus the larger second difference there,
/// which is eight times the rise of a parabola. If a neighbour has no value, there is no bound.
fn highest_between(places: &[f64], seen: &[f64], k: usize) -> f64 {
    let step = places[k + 1] - places[k];
    let bent = |at: usize| match (seen.get(at.wrapping_sub(1)..at + 2), at) {
        (Some(&[a, b, c]), 1..) => {
            let [before, after] = [places[at] - places[at - 1], places[at + 1] - places[at]];
            let slopes = (c - b) / after - (b - a) / before;
            (2.0 * slopes / (before + after) * step * step).abs()
        }
        _ => 0.0,
    };
    let bent = [bent(k), bent(k + 1)].map(|by| if by.is_nan() { f64::INFINITY } else { by });
    let [here, next] = [seen[k], seen[k + 1]];
    if here.max(next) == f64::NEG_INFINITY { here } else { here.max(next) + bent[0].max(bent[1]) }
}

/// The greatest value on an interval with one maximum, located to that width: parabolas through the best three places,
/// and golden sections if these do not converge.
///
/// # Source
///
/// R. P. Brent, Algorithms for Minimization without Derivatives (1973), chapter 5.
fn brent(
    [mut low, mut high]: [f64; 2],
    start: Peak,
    width: f64,
    value: impl Fn(f64) -> f64,
) -> Peak {
    const MOST: usize = 60;
    let (mut best, mut second, mut third) = (start, start, start);
    let (mut step, mut before): (f64, f64) = (0.0, 0.0);
    for _ in 0..MOST {
        let middle = 0.5 * (low + high);
        if (best.x - middle).abs() + 0.5 * (high - low) <= 2.0 * width {
            break;
        }
        let (r, q) = (
            (best.x - second.x) * (best.value - third.value),
            (best.x - third.x) * (best.value - second.value),
        );
        let over = 2.0 * (q - r);
        let by = ((best.x - second.x) * r - (best.x - third.x) * q) / over;
        let inside = best.x + by > low + width && best.x + by < high - width;
        // A parabola with NaN fails this test.
        if inside && by.abs() < 0.5 * before.abs() {
            (before, step) = (step, by);
        } else {
            before = if best.x < middle { high - best.x } else { low - best.x };
            step = (1.0 - golden::SECTION) * before;
        }
        let x = best.x + if step.abs() < width { width.copysign(step) } else { step };
        let found = Peak { x, value: value(x) };
        if found.value >= best.value {
            if x > best.x {
                low = best.x
            } else {
                high = best.x
            }
            (third, second, best) = (second, best, found);
        } else {
            if x > best.x {
                high = x
            } else {
                low = x
            }
            if found.value >= second.value || second.x == best.x {
                (third, second) = (second, found);
            } else if found.value >= third.value || third.x == best.x || third.x == second.x {
                third = found;
            }
        }
    }
    best
}

/// The last place that is not below zero, between one that is not (place and value) and one that is below or has no
/// value, located to that width.
///
/// # Source
///
/// The Illinois variant of false position: M. Dowell, P. Jarratt, BIT 11, 168 (1971).
fn boundary(
    [mut good, mut over]: [f64; 2],
    [mut bad, mut under]: [f64; 2],
    width: f64,
    value: impl Fn(f64) -> f64,
) -> f64 {
    const MOST: usize = 60;
    let mut side = 0;
    for _ in 0..MOST {
        if (bad - good).abs() <= width {
            break;
        }
        let share = over / (over - under);
        // Without a value, halve.
        let share = if share > 0.0 && share < 1.0 { share } else { 0.5 };
        // Aims beyond the edge by less than the width, so that the interval closes from both sides.
        let aimed = good + share * (bad - good);
        let least = 0.5 * width / (bad - good).abs();
        let x = match aimed {
            _ if share < least => good + least * (bad - good),
            _ if share > 1.0 - least => bad - least * (bad - good),
            aimed => aimed,
        };
        let found = value(x);
        if found >= 0.0 {
            (good, over) = (x, found);
            under *= if side == 1 { 0.5 } else { 1.0 };
            side = 1;
        } else {
            (bad, under) = (x, found);
            over *= if side == -1 { 0.5 } else { 1.0 };
            side = -1;
        }
    }
    good
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `1 − |x − a|^p` has its greatest value at a, smooth or as a kink. A search that starts near it finds it and
    /// evaluates nothing outside the interval.
    #[test]
    fn the_greatest_value_is_found_to_the_width() {
        for (power, a) in [(2.0, 0.61), (1.0, 0.61), (4.0, 0.61), (2.0, 0.5), (1.0, 0.7)] {
            let value = |x: f64| {
                assert!((0.5..=0.7).contains(&x));
                1.0 - (x - a).abs().powf(power)
            };
            let start = Peak { x: 0.6, value: value(0.6) };
            let found = brent([0.5, 0.7], start, 1e-6, value);
            let flat = f64::EPSILON.powf(1.0 / power);
            assert!((found.x - a).abs() < 3e-6 + 2.0 * flat, "{power} {a} {found:?}");
        }
    }

    #[test]
    fn a_boundary_is_found_to_the_width_where_one_side_has_no_value_too() {
        let value = |x: f64| 0.3 - x * x;
        let exact = 0.3_f64.sqrt();
        let found = boundary([0.0, 0.3], [1.0, -0.7], 1e-9, value);
        assert!(found <= exact && exact - found < 1e-9);
        let none_beyond = |x: f64| if x < 0.4 { 1.0 } else { f64::NAN };
        let found = boundary([0.0, 1.0], [1.0, f64::NAN], 1e-9, none_beyond);
        assert!(found < 0.4 && 0.4 - found < 1e-9);
    }
}
