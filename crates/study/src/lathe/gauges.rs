//! Which places of a hit does an answer depend on, and how?
//!
//! An answer about a hit is expressed as a sum of values at fixed places with the same derivative. For a value
//! `v(x; p)` of a hit at `x` on a bat that is changed by `p`,
//!
//! ```text
//! greatest value      dv*/dp = ∂v/∂p at x*                  (v_x = 0 there)
//! its place           dx*/dp = −v_xp/v_xx
//! end of the zone     dx_e/dp = −(∂v/∂p at x_e − 0.99 dv*/dp)/v_x at x_e
//! ```
//!
//! so one pass along the bat serves all its changes, and no change needs a new search.
//!
//! Slopes along the bat are differences between places that must be closer than the features of the value: beside a
//! step of the section, and where a ball is met again, that is less than a millimetre. The distance is halved until
//! half of it gives the same. A value with a corner at its best place has no derivative. The places depend on the
//! distance and on the modes: a gauge is found again for each ([`Gauge::again`]), and the effect on a derivative is
//! part of its error, `δ(dv*/dp) = v_xp δx`.

use serde::Serialize;
use std::cell::OnceCell;

use crate::answers::Answer;
use crate::engine::{Glance, HitsAlong, Hitter, Peak};
pub use crate::lathe::probe::Probe;
use crate::lathe::probe::searched;
use crate::lathe::stencil::{Stencil, by_slope};

/// Why an output is not smooth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WhyNotSmooth {
    /// Two places along the bat have nearly equal values, so a small change makes the best one jump: no derivative.
    Rivals,
    /// The value has a corner at its best place: no derivative.
    Corner,
    /// The change by the finite cut does not agree with the derivative.
    Cut,
}

/// An output that is not smooth. Rivals and a corner leave it without a derivative; with a cut, the finite change of a
/// band contradicts the derivative.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Rivals {
    /// The output.
    #[serde(rename = "name")]
    #[schemars(with = "String")]
    pub answer: Answer,
    /// The reason: two places along the bat are nearly equal, there is a corner at the best place, or a finite cut
    /// makes it jump.
    pub why: WhyNotSmooth,
    /// The best place and the other one, or the best place after the cut (m).
    // Equal for a corner.
    pub x_m: [f64; 2],
    /// The values there.
    pub value: [f64; 2],
}

impl Rivals {
    /// An answer with its best place and the other one.
    pub(super) fn of(answer: Answer, why: WhyNotSmooth, peaks: [Peak; 2]) -> Self {
        let [x_m, value] = [peaks.map(|peak| peak.x), peaks.map(|peak| peak.value)];
        Self { answer, why, x_m, value }
    }
}

/// An answer as a sum of readings at fixed places: `Σ factor · reading`.
#[derive(Debug, Clone, Default)]
pub struct Gauge {
    /// Place (m from the knob end), probe and factor.
    pub terms: Vec<(f64, Probe, f64)>,
    /// Error of the answer per unit of error of a reading, and per unit of error of the slope of the readings along the
    /// bat.
    pub off: [f64; 2],
    /// How its places were found; `None` if they were given.
    sought: Option<Located>,
}

/// The value that a search found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Feature {
    /// The best value.
    Value,
    /// Its place.
    Place,
    /// An end of the zone.
    Edge,
}

/// The data of a search for the places of a gauge.
#[derive(Debug, Clone, Copy)]
struct Located {
    wanted: Feature,
    probe: Probe,
    /// Place of the best value (m).
    best: f64,
    /// The end of the zone, or the best place (m).
    x: f64,
    /// Distance of the places of a difference (m).
    apart: f64,
    /// Possible shift (m) of the best place on a bat with other modes.
    reach: f64,
}

impl Gauge {
    /// A reading at a place.
    fn at(x: f64, probe: Probe) -> Self {
        Self { terms: vec![(x, probe, 1.0)], off: [1.0, 0.0], sought: None }
    }

    /// The best value of a probe there, its place, or an end of the zone.
    fn of(sought: Located, [_, slope, bend]: [f64; 3], sign: f64) -> Self {
        let Located { wanted, probe, best, x, apart, .. } = sought;
        let (terms, off) = match wanted {
            Feature::Value => (vec![(best, probe, 1.0)], [1.0, 0.0]),
            Feature::Place => (by_slope(best, probe, apart, -1.0 / bend), [0.0, 1.0 / bend.abs()]),
            Feature::Edge => {
                let greatest = (1.0 - NEARLY * sign) / slope;
                let terms = vec![(x, probe, -1.0 / slope), (best, probe, greatest)];
                // The speed there is uncertain, and so is the greatest one.
                (terms, [2.0 / slope.abs(), 0.0])
            }
        };
        Self { terms, off, sought: Some(sought) }
    }

    /// The same answer on a bat with other modes, or with places `share` times as far apart; its places are found
    /// again. Unchanged if they are not found nearby.
    pub fn again(&self, hitter: &Hitter, share: f64) -> Self {
        let Some(sought) = self.sought else { return self.clone() };
        let by = Stencil { hitter, probe: sought.probe, apart: share * sought.apart };
        let found = || {
            let (best, top) = by.polished(sought.best, sought.reach, by.exactly())?;
            let sought = Located { best, x: best, apart: by.apart, ..sought };
            if sought.wanted != Feature::Edge {
                return Some(Self::of(sought, top, 1.0));
            }
            let sign = top[0].signum();
            let (x, edge) =
                by.edge(self.sought?.x, top[0] * (1.0 - NEARLY * sign), by.closely())?;
            Some(Self::of(Located { x, ..sought }, edge, sign))
        };
        found().unwrap_or_else(|| self.clone())
    }

    /// Possible error of the answer if speeds are off by `speed` (m/s), an error curve along the bat with half waves of
    /// at least `half_wave` (m); 0 for an answer without speeds.
    pub fn error(&self, speed: f64, half_wave: f64) -> f64 {
        let speeds = [Probe::Speed, Probe::HandsVelocity];
        let of_speeds = self.terms.iter().all(|(_, probe, _)| speeds.contains(probe));
        // The slope of such a curve is at most π/half_wave times its size.
        let [value, slope] = self.off;
        if of_speeds { speed * (value + std::f64::consts::PI / half_wave * slope) } else { 0.0 }
    }

    /// The sum for a bat, from hits at those places.
    pub fn read(&self, hitter: &Hitter, seen: &GaugeHits) -> Option<f64> {
        let of = |&(x, probe, factor): &(f64, Probe, f64)| {
            Some(factor * probe.read(hitter, seen.at(x))?)
        };
        self.terms.iter().map(of).sum()
    }
}

/// The hits at the places that gauges read.
pub struct GaugeHits {
    places: Vec<f64>,
    hits: Vec<Option<Glance>>,
}

impl GaugeHits {
    /// Hits the bat at every place that a gauge reads, once.
    pub fn new<'a>(hitter: &Hitter, gauges: impl Iterator<Item = &'a Gauge>) -> Self {
        let mut places: Vec<f64> = gauges.flat_map(|g| g.terms.iter().map(|term| term.0)).collect();
        places.sort_by(f64::total_cmp);
        places.dedup();
        let hits = hitter.glances(&places);
        Self { places, hits }
    }

    fn at(&self, x: f64) -> Option<&Glance> {
        let k = self.places.binary_search_by(|place| place.total_cmp(&x)).ok()?;
        self.hits[k].as_ref()
    }
}

/// The outer half of a bat after a pass along it, from which gauges are made.
pub struct OuterHalf<'a> {
    /// The pass, made when it is first needed.
    looked: OnceCell<HitsAlong<'a>>,
    /// The best places of a nearly equal bat, and a coarse pass along this bat if needed.
    beside: Option<(&'a BestPlaces, Option<HitsAlong<'a>>)>,
    hitter: &'a Hitter<'a>,
    ends: [f64; 2],
    /// The results.
    found: BestPlaces,
    /// Answers without a derivative.
    pub rivals: Vec<Rivals>,
}

/// The best places of a bat.
#[derive(Clone, Default)]
pub struct BestPlaces {
    /// The result for each probe; `None` if there is none.
    by_probe: Vec<(Probe, Option<Greatest>)>,
    /// The stretch (m) outside which no value is nearly as good as the best.
    good: [f64; 2],
    /// The ends of the zone (m).
    zone: [f64; 2],
}

impl BestPlaces {
    /// Place and size of the best value for an answer about it, its place or its zone.
    pub fn peak(&self, answer: Answer) -> Option<Peak> {
        let probe = match answer {
            Answer::Zone(_) => Probe::Speed,
            _ => searched(answer)?.0,
        };
        Some(self.of(probe)?.as_ref()?.peak)
    }

    fn of(&self, probe: Probe) -> Option<&Option<Greatest>> {
        self.by_probe.iter().find(|(known, _)| *known == probe).map(|(_, found)| found)
    }
}

/// Number of steps of a pass along the outer half.
const STEPS: usize = 128;
/// Number of steps of a pass if the best places are nearly known, and only a better place must be excluded.
const WIDE: usize = 32;
/// Share of the distance from the best value to the worst that counts as good.
const GOOD: f64 = 0.25;
/// Distance of the places of a difference along the bat, as a share of the length: 3 mm of 84 cm. The
/// difference is of the fourth order.
const APART: f64 = 1.0 / 280.0;
/// The distance is halved so often at most: to a tenth of a millimetre.
const HALVED: usize = 5;
/// The distance is small enough if half of it changes the second derivative by at most this share.
const ENOUGH: f64 = 1e-3;
/// If no distance changes it by less than this, there is a corner.
const CORNER: f64 = 0.1;
/// A second best place counts where its value is within this share of the best one's.
const NEARLY: f64 = 0.01;
/// Share of the outer half to which a search locates the best place before slopes do.
const LOCATED: f64 = 2e-5;
/// The last of Newton's steps (m) to the best place of a nearly equal bat, which leaves an error of nanometres.
const FOLLOWED: f64 = 5e-6;

/// The greatest value and its surroundings.
#[derive(Clone, Copy)]
pub(super) struct Greatest {
    peak: Peak,
    /// Value, slope and second derivative there by differences, and the distance of their places (m); None where
    /// the place is an end of the stretch.
    smooth: Option<([f64; 3], f64)>,
    /// Whether the value has a corner there.
    corner: bool,
}

impl<'a> OuterHalf<'a> {
    /// Looks along the outer half of a bat of that length (m).
    pub fn new(hitter: &'a Hitter<'a>, length: f64) -> Self {
        let (looked, ends) = (OnceCell::new(), [0.5 * length, length]);
        Self { looked, beside: None, hitter, ends, found: BestPlaces::default(), rivals: vec![] }
    }

    /// Follows the known best places of a nearly equal bat. They are searched again only if they are lost or, unless
    /// the bats differ only in their swing, if another place may be better.
    pub fn beside(
        hitter: &'a Hitter<'a>,
        length: f64,
        known: &'a BestPlaces,
        same_bat: bool,
    ) -> Self {
        let new = Self::new(hitter, length);
        let share = (known.good[1] - known.good[0]) / (new.ends[1] - new.ends[0]);
        let look = ((share * WIDE as f64).ceil() as usize, LOCATED);
        let wide = (!same_bat).then(|| HitsAlong::by(known.good, look, hitter));
        Self { beside: Some((known, wide)), ..new }
    }

    /// The results.
    pub fn found(self) -> BestPlaces {
        if let Some((known, _)) = self.beside {
            return BestPlaces { by_probe: self.found.by_probe, ..*known };
        }
        let (looked, mut good) = (self.looked(), [self.ends[1], self.ends[0]]);
        let (places, last) = (looked.places(), looked.places().len() - 1);
        for (probe, _) in &self.found.by_probe {
            let values =
                looked.values(|glance| Some(probe.sign() * probe.of(self.hitter, glance)?));
            let [best, worst] = values
                .iter()
                .filter(|value| value.is_finite())
                .fold([f64::MIN, f64::MAX], |[best, worst], value| {
                    [best.max(*value), worst.min(*value)]
                });
            let floor = best - GOOD * (best - worst);
            for k in (0..=last).filter(|k| values[*k] >= floor) {
                good[0] = good[0].min(places[k.saturating_sub(1)]);
                good[1] = good[1].max(places[(k + 1).min(last)]);
            }
        }
        let fastest = self.found.of(Probe::Speed).and_then(Option::as_ref);
        let zone = fastest.map_or(self.ends, |fastest| looked.zone(fastest.peak));
        BestPlaces { by_probe: self.found.by_probe, good, zone }
    }

    fn looked(&self) -> &HitsAlong<'a> {
        self.looked.get_or_init(|| HitsAlong::by(self.ends, (STEPS, LOCATED), self.hitter))
    }

    /// The gauge and the value of an answer about a hit; `None` without such an answer, and no gauge if it has no
    /// derivative.
    pub fn gauge(&mut self, answer: Answer) -> (Option<Gauge>, Option<f64>) {
        let at = |x: f64, probe: Probe| {
            let value = self.value(probe, x).filter(|value| probe.feels(*value));
            (value.map(|_| Gauge::at(x, probe)), value)
        };
        match answer {
            Answer::ExitSpeedAt(x) => at(x, Probe::Speed),
            Answer::VibrationAt(x) => at(x, Probe::Vibration),
            Answer::HandsVelocityAt(x) => at(x, Probe::HandsVelocity),
            Answer::HandsAccelerationAt(x) => at(x, Probe::HandsAcceleration),
            Answer::Zone(end) => self.zone(usize::from(end)),
            _ => match searched(answer) {
                Some((probe, place)) => self.extreme(answer, probe, place),
                None => (None, None),
            },
        }
    }

    fn value(&self, probe: Probe, x: f64) -> Option<f64> {
        probe.read(self.hitter, self.hitter.glance(x).as_ref())
    }

    fn stencil(&self, probe: Probe) -> Stencil<'_> {
        Stencil { hitter: self.hitter, probe, apart: APART * self.ends[1] }
    }

    /// Largest distance (m) between the place found by slopes and the place found by values.
    fn reach(&self) -> f64 {
        1.5 * (self.ends[1] - self.ends[0]) / STEPS as f64
    }

    /// The best value of a probe, or its place.
    fn extreme(
        &mut self,
        answer: Answer,
        probe: Probe,
        place: bool,
    ) -> (Option<Gauge>, Option<f64>) {
        let Some(Greatest { peak, smooth, corner }) = self.greatest(probe) else {
            return (None, None);
        };
        if !probe.feels(peak.value) {
            return (None, None);
        }
        let value = if place { peak.x } else { peak.value };
        let rival = self.rival(probe, peak);
        if let Some(other) = rival.or(corner.then_some(peak)) {
            let why = if rival.is_some() { WhyNotSmooth::Rivals } else { WhyNotSmooth::Corner };
            self.rivals.push(Rivals::of(answer, why, [peak, other]));
            return (None, Some(value));
        }
        let wanted = if place { Feature::Place } else { Feature::Value };
        let reach = self.reach();
        let gauge = smooth.map(|(by, apart)| {
            let sought = Located { wanted, probe, best: peak.x, x: peak.x, apart, reach };
            Gauge::of(sought, by, 1.0)
        });
        (gauge.or_else(|| (!place).then(|| Gauge::at(peak.x, probe))), Some(value))
    }

    /// Another place that is nearly as good.
    fn rival(&self, probe: Probe, best: Peak) -> Option<Peak> {
        if self.beside.is_some() {
            return None;
        }
        let (sign, looked) = (probe.sign(), self.looked());
        let values = looked.values(|glance| Some(sign * probe.of(self.hitter, glance)?));
        let (places, last) = (looked.places(), values.len() - 1);
        let near = NEARLY * best.value.abs();
        let apart = 2.5 * (self.ends[1] - self.ends[0]) / STEPS as f64;
        let top = |j: &usize| {
            let up = *j == 0 || values[*j] >= values[j - 1];
            up && (*j == last || values[*j] >= values[j + 1]) && (places[*j] - best.x).abs() > apart
        };
        let rival = (0..=last).filter(top).find(|j| sign * best.value - values[*j] <= near);
        rival.map(|j| Peak { x: places[j], value: sign * values[j] })
    }

    /// The greatest speed or BBCOR, or the least of the others.
    fn greatest(&mut self, probe: Probe) -> Option<Greatest> {
        if let Some(found) = self.found.of(probe) {
            return *found;
        }
        let found = self.followed(probe).or_else(|| self.sought(probe));
        self.found.by_probe.push((probe, found));
        found
    }

    /// The best place near that of the nearly equal bat.
    fn followed(&self, probe: Probe) -> Option<Greatest> {
        let (known, wide) = self.beside.as_ref()?;
        let Greatest { peak, smooth, .. } = known.of(probe)?.as_ref()?;
        let (sign, (_, apart)) = (probe.sign(), (*smooth)?);
        let stencil = Stencil { apart, ..self.stencil(probe) };
        let (x, by) = stencil.polished(peak.x, self.reach(), FOLLOWED)?;
        let of = |glance: &Glance| Some(sign * probe.of(self.hitter, glance)?);
        let other = wide.as_ref().is_some_and(|wide| wide.may_exceed(sign * by[0], x, of));
        let best = sign * by[2] < 0.0 && !other;
        let found =
            Greatest { peak: Peak { x, value: by[0] }, smooth: Some((by, apart)), corner: false };
        best.then_some(found)
    }

    fn sought(&self, probe: Probe) -> Option<Greatest> {
        let sign = probe.sign();
        let found = self.looked().greatest(|glance| Some(sign * probe.of(self.hitter, glance)?))?;
        let found = Peak { x: found.x, value: sign * found.value };
        if self.ends.contains(&found.x) {
            return Some(Greatest { peak: found, smooth: None, corner: false });
        }
        let mut stencil = self.stencil(probe);
        let mut best: Option<(f64, Greatest)> = None;
        for _ in 0..=HALVED {
            let half = Stencil { apart: 0.5 * stencil.apart, ..stencil };
            let here = || {
                let (x, by) = stencil.polished(found.x, self.reach(), stencil.exactly())?;
                let [value, _, bend] = by;
                // A zero slope also belongs to a valley, and to a mean over a narrow top.
                let rough = 1e-9 * found.value.abs();
                (sign * bend < 0.0 && sign * (value - found.value) >= -rough).then_some(())?;
                let [_, slope, closer] = half.derivatives(x)?;
                let bent = (closer / bend - 1.0).abs();
                let off = bent.max((slope / bend / stencil.apart).abs());
                let peak = Peak { x, value };
                Some((off, Greatest { peak, smooth: Some((by, stencil.apart)), corner: false }))
            };
            let now = here();
            if let Some((off, now)) = now {
                if best.is_none_or(|(least, _)| off < least) {
                    best = Some((off, now));
                }
                if off <= ENOUGH {
                    break;
                }
            }
            stencil = half;
        }
        let corner = Greatest { peak: found, smooth: None, corner: true };
        Some(best.filter(|(off, _)| *off <= CORNER).map_or(corner, |(_, best)| best))
    }

    /// An end of the stretch within 1 % of the greatest exit speed.
    fn zone(&mut self, end: usize) -> (Option<Gauge>, Option<f64>) {
        let Some(Greatest { peak, smooth, corner }) = self.greatest(Probe::Speed) else {
            return (None, None);
        };
        if self.rival(Probe::Speed, peak).is_some() {
            return (None, None);
        }
        let sign = peak.value.signum();
        let floor = peak.value * (1.0 - NEARLY * sign);
        let apart = smooth.map_or(APART * self.ends[1], |(_, apart)| apart);
        let stencil = Stencil { apart, ..self.stencil(Probe::Speed) };
        let followed =
            |(known, _): &(&BestPlaces, _)| stencil.edge(known.zone[end], floor, FOLLOWED);
        if let Some((x, _)) = self.beside.as_ref().and_then(followed) {
            return (None, Some(x));
        }
        let x = self.looked().zone(peak)[end];
        if !self.inside(x, stencil.apart) {
            return (None, Some(x));
        }
        let (Some((x, by)), false) = (stencil.edge(x, floor, stencil.closely()), corner) else {
            let edge = Peak { x, value: floor };
            let answer = Answer::Zone(end == 1);
            self.rivals.push(Rivals::of(answer, WhyNotSmooth::Corner, [edge; 2]));
            return (None, Some(x));
        };
        let reach = self.reach();
        let sought =
            Located { wanted: Feature::Edge, probe: Probe::Speed, best: peak.x, x, apart, reach };
        (Some(Gauge::of(sought, by, sign)), Some(x))
    }

    /// Whether all places of a difference are on the outer half.
    fn inside(&self, x: f64, apart: f64) -> bool {
        x - 2.0 * apart > self.ends[0] && x + 2.0 * apart < self.ends[1]
    }
}
