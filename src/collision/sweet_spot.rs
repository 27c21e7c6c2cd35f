//! Where is the sweet spot, by each of its definitions?

use serde::{Deserialize, Serialize};

use crate::base::search::{boundary, highest};
use crate::base::threads;
use crate::collision::contact::abreast::meet::ABREAST;
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
    /// reported. The steps are finer where the bat catches up with the ball late or again and a best place may be.
    pub fn by(ends: [f64; 2], (steps, share): (usize, f64), hitter: &'a Hitter<'a>) -> Self {
        let length = ends[1] - ends[0];
        let parts = steps * BETWEEN_LATER;
        let place = |part: usize| ends[0] + length * part as f64 / parts as f64;
        // Some at a time, so that they are met side by side.
        let look = |parts: &[usize]| {
            let groups: Vec<_> = parts.chunks(ABREAST).collect();
            let group = |k: usize| {
                let places: Vec<f64> = groups[k].iter().map(|part| place(*part)).collect();
                hitter.glances(&places)
            };
            threads::map(groups.len(), group).concat()
        };
        let first: Vec<usize> = (0..=steps).map(|k| k * BETWEEN_LATER).collect();
        let before = hitter.work();
        let mut seen: Vec<(usize, Option<Glance>)> =
            first.iter().copied().zip(look(&first)).collect();
        let work = hitter.work() - before;
        let later = |glance: &Option<Glance>| glance.is_some_and(|glance| glance.later);
        let open = |k: &usize| later(&seen[*k].1) || later(&seen[k + 1].1);
        let unsettled = (0..steps).filter(open).collect();
        let glances: Vec<_> = seen.iter().map(|(_, glance)| *glance).collect();
        let promising = promising(hitter, &glances, unsettled).into_iter();
        let unsettled: Vec<usize> = promising.map(|k| first[k]).collect();
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
        let at = |places: &[f64]| self.hitter.glances(places).iter().map(of).collect::<Vec<_>>();
        let around = |k: usize| [k.saturating_sub(1), (k + 1).min(self.last())];
        let mut here =
            (Peak { x: self.place(best), value: seen }, around(best).map(|k| self.place(k)));
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
        let step = |k: usize| (self.place(k + 1) - self.place(k)) / BETWEEN as f64;
        let parts = |(k, _): &(usize, f64)| {
            let (k, from, step) = (*k, self.place(*k), step(*k));
            (1..BETWEEN).map(move |part| (k, from + step * part as f64))
        };
        let closer: Vec<(usize, f64)> = settled.iter().flat_map(parts).collect();
        let places: Vec<f64> = closer.iter().map(|(_, x)| *x).collect();
        for ((k, x), value) in closer.into_iter().zip(at(&places)) {
            if value > here.0.value {
                here = (Peak { x, value }, [x - step(k), x + step(k)]);
            }
        }
        let (here, between) = here;
        let known = self.places.iter().zip(&seen).map(|(x, value)| [*x, *value]).collect();
        let [x, value] = highest(between, [here.x, here.value], known, self.width, at);
        Some(Peak { x, value })
    }

    /// Whether a value above `level` was found, or may hide between two places, farther from `x` than two steps.
    pub fn may_exceed(&self, level: f64, x: f64, value: impl Fn(&Glance) -> Option<f64>) -> bool {
        let (seen, near) =
            (self.values(value), 2.0 * (self.ends[1] - self.ends[0]) / self.steps as f64);
        let far = |k: &usize| (0.5 * (self.place(*k) + self.place(k + 1)) - x).abs() > near;
        (0..self.last()).filter(far).any(|k| highest_between(&self.places, &seen, k) > level)
    }

    /// Largest amount by which a value may exceed `best` between the closest places, where the ball is met again: it
    /// changes between two of them as much as from one to the other.
    pub fn missed(&self, best: f64, value: impl Fn(&Glance) -> Option<f64>) -> f64 {
        let seen = self.values(value);
        let step = (self.ends[1] - self.ends[0]) / self.steps as f64;
        let close = |k: &usize| self.places[k + 1] - self.places[*k] < 0.75 * step;
        let above = |k: usize| seen[k].max(seen[k + 1]) + (seen[k] - seen[k + 1]).abs() - best;
        let all = (0..self.last()).filter(close).map(above);
        all.filter(|above| above.is_finite()).fold(0.0, f64::max)
    }

    /// The zone around the peak in which the exit speed stays within 1 %, by the Illinois method on both sides.
    pub fn zone(&self, peak: Peak) -> [f64; 2] {
        let floor = peak.value - 0.01 * peak.value.abs();
        let above = |glance: &Option<Glance>| glance.map_or(f64::NAN, |g| g.exit_speed - floor);
        let [from, to] = self.ends;
        let edge = |end: f64, bad: Option<usize>| {
            let Some(k) = bad else { return end };
            let at =
                |places: &[f64]| self.hitter.glances(places).iter().map(above).collect::<Vec<_>>();
            let known = self.places.iter().zip(&self.seen);
            let known = known.map(|(x, glance)| [*x, above(glance)]).collect();
            let [bad, x] = [self.place(k), peak.x];
            let good = if bad < x { self.place(k + 1).min(x) } else { self.place(k - 1).max(x) };
            boundary([good, bad], known, self.width, at)
        };
        // NaN counts as too low.
        let poor = |k: &usize| above(&self.seen[*k]).is_nan() || above(&self.seen[*k]) < 0.0;
        let below = (0..=self.last()).rev().filter(|k| self.place(*k) < peak.x).find(poor);
        let beyond = (0..=self.last()).filter(|k| self.place(*k) > peak.x).find(poor);
        [edge(from, below), edge(to, beyond)]
    }
}

/// Those of the steps where touches come and go, by their first place, in which the best place of some value may be: the
/// better value at both ends, and as much more as such values differ from each other and by further touches, reaches the
/// best one of all.
fn promising(hitter: &Hitter, seen: &[Option<Glance>], unsettled: Vec<usize>) -> Vec<usize> {
    let values = |glance: &Option<Glance>| match glance {
        None => [f64::NEG_INFINITY; 8],
        Some(glance) => {
            let Glance { exit_speed, first_exit, vibration, hands, .. } = *glance;
            let first_exit = if glance.late { f64::NEG_INFINITY } else { first_exit };
            let vibration = vibration.map_or(f64::NEG_INFINITY, |vibration| -vibration);
            let [efficiency, free, pivoted] = hitter.figures(glance.x, exit_speed);
            [exit_speed, first_exit, vibration, -hands[0], -hands[1], efficiency, free, pivoted]
        }
    };
    let values: Vec<[f64; 8]> = seen.iter().map(values).collect();
    let ends = |by: fn(f64, f64) -> f64, from: f64, of: usize| {
        let both = unsettled.iter().flat_map(|k| [values[*k][of], values[k + 1][of]]);
        both.filter(|value| value.is_finite()).fold(from, by)
    };
    let mut reach: [f64; 8] = std::array::from_fn(|of| {
        let best = values.iter().fold(f64::NEG_INFINITY, |best, value| best.max(value[of]));
        best - (ends(f64::max, f64::MIN, of) - ends(f64::min, f64::MAX, of))
    });
    let by_touches = |glance: &Glance| (glance.exit_speed - glance.first_exit).abs();
    let touched = unsettled.iter().flat_map(|k| [&seen[*k], &seen[k + 1]]).flatten();
    reach[0] -= touched.map(by_touches).fold(0.0, f64::max);
    let reaches = |k: &usize| {
        let [here, next] = [values[*k], values[k + 1]];
        (0..8).any(|of| here[of].max(next[of]) >= reach[of])
    };
    unsettled.iter().copied().filter(reaches).collect()
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
