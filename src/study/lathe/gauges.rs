//! Which places of a hit does an answer read, and how?
//!
//! An answer about a hit is made a sum of values at fixed places, whose derivative is that of the answer. With
//! a value `v(x; p)` of a hit at `x` on a bat that is changed by `p`,
//!
//! ```text
//! greatest value      dv*/dp = ∂v/∂p at x*                  (v_x = 0 there)
//! its place           dx*/dp = −v_xp/v_xx
//! end of the zone     dx_e/dp = −(∂v/∂p at x_e − 0.99 dv*/dp)/v_x at x_e
//! ```
//!
//! so that one look along the bat serves all its changes, and no change needs a search of its own.

use crate::base::threads;
use crate::collision::hitter::Hitter;
use crate::collision::strike::Glance;
use crate::collision::sweet_spot::{FEW, Looked, Peak};
use crate::study::many::answers::Answer;

/// What is read of a hit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Probe {
    /// Exit speed of the ball (m/s).
    Speed,
    /// Energy left in vibration (J).
    Vibration,
    /// What the hands feel: velocity (m/s).
    HandsVelocity,
    /// What the hands feel: acceleration (m/s²).
    HandsAcceleration,
    /// BBCOR of the free bat.
    Bbcor,
}

impl Probe {
    /// The reading of a hit at a place; None where ball and bat do not meet.
    pub fn read(self, hitter: &Hitter, seen: Option<&Glance>) -> Option<f64> {
        let seen = seen?;
        match self {
            Self::Speed => Some(seen.exit_speed),
            Self::Vibration => seen.vibration,
            Self::HandsVelocity => Some(seen.hands[0]),
            Self::HandsAcceleration => Some(seen.hands[1]),
            Self::Bbcor if hitter.modes_used() == 0 => None,
            Self::Bbcor => Some(hitter.figures(seen.x, seen.exit_speed)[1]),
        }
    }
}

impl Probe {
    /// Whether a value is more than nothing: hands on a pin feel nothing, and without modes nothing shakes them.
    fn feels(self, value: f64) -> bool {
        match self {
            Self::HandsVelocity => value > 1e-9,
            Self::HandsAcceleration => value > 1e-5,
            _ => true,
        }
    }
}

/// A value that two places along the bat have nearly alike, so that a small change makes the best place jump.
#[derive(Debug, Clone, PartialEq)]
pub struct Rivals {
    /// The answer that has no derivative.
    pub answer: Answer,
    /// The best place and the other one, with their values.
    pub peaks: [Peak; 2],
}

/// An answer as a sum of readings at fixed places: `Σ factor · reading`.
#[derive(Debug, Clone, Default)]
pub struct Gauge {
    /// Place (m from the knob end), probe and factor.
    pub terms: Vec<(f64, Probe, f64)>,
    /// How far the answer is off for each unit that a reading is, and for each unit that the slope of the
    /// readings along the bat is.
    pub off: [f64; 2],
}

impl Gauge {
    /// A reading at a place.
    fn at(x: f64, probe: Probe) -> Self {
        Self { terms: vec![(x, probe, 1.0)], off: [1.0, 0.0] }
    }

    /// How far the answer may be off where speeds are by `speed` (m/s), a curve along the bat that is not shorter
    /// than `half_wave` (m): 0 of what is not read of speeds.
    pub fn error(&self, speed: f64, half_wave: f64) -> f64 {
        let speeds = [Probe::Speed, Probe::HandsVelocity];
        let of_speeds = self.terms.iter().all(|(_, probe, _)| speeds.contains(probe));
        // The slope of such a curve is π/half_wave of it at most.
        let [value, slope] = self.off;
        if of_speeds { speed * (value + std::f64::consts::PI / half_wave * slope) } else { 0.0 }
    }

    /// The sum on a bat that is hit, of hits seen at those places.
    pub fn read(&self, hitter: &Hitter, seen: &Seen) -> Option<f64> {
        let of = |&(x, probe, factor): &(f64, Probe, f64)| {
            Some(factor * probe.read(hitter, seen.at(x))?)
        };
        self.terms.iter().map(of).sum()
    }
}

/// The hits at the places that gauges read.
pub struct Seen {
    places: Vec<f64>,
    hits: Vec<Option<Glance>>,
}

impl Seen {
    /// Hits the bat at every place that a gauge reads, once.
    pub fn new<'a>(hitter: &Hitter, gauges: impl Iterator<Item = &'a Gauge>) -> Self {
        let mut places: Vec<f64> = gauges.flat_map(|g| g.terms.iter().map(|term| term.0)).collect();
        places.sort_by(f64::total_cmp);
        places.dedup();
        let hits = places.iter().map(|x| hitter.glance(*x)).collect();
        Self { places, hits }
    }

    fn at(&self, x: f64) -> Option<&Glance> {
        let k = self.places.binary_search_by(|place| place.total_cmp(&x)).ok()?;
        self.hits[k].as_ref()
    }
}

/// The outer half of a bat after a look along it, from which gauges are made.
pub struct OuterHalf<'a> {
    hitter: &'a Hitter<'a>,
    ends: [f64; 2],
    steps: usize,
    hits: Vec<Option<Glance>>,
    /// Best places that compete with others.
    pub rivals: Vec<Rivals>,
}

/// Steps of a look along the outer half.
pub const CLOSELY: usize = 128;
/// Steps where best places are known to be near others.
pub const ROUGHLY: usize = 32;
/// Distance of the places of a difference along the bat, as a share of the length: 3 mm of 84 cm. The
/// difference is of the fourth order.
const APART: f64 = 1.0 / 280.0;
/// A second best place counts where its value is within this share of the best one's.
const NEARLY: f64 = 0.01;

/// The greatest value and what it is like around its place.
#[derive(Clone, Copy)]
struct Greatest {
    peak: Peak,
    /// Second derivative along the bat; None where the place is an end of the stretch, or the value has a
    /// corner.
    bend: Option<f64>,
}

impl<'a> OuterHalf<'a> {
    /// Looks along the outer half of a bat of that length (m), in so many steps.
    pub fn new(hitter: &'a Hitter<'a>, length: f64, steps: usize) -> Self {
        let ends = [0.5 * length, length];
        let place = |k: usize| ends[0] + (ends[1] - ends[0]) * k as f64 / steps as f64;
        let hits = threads::map(steps + 1, |k| hitter.glance(place(k)));
        Self { hitter, ends, steps, hits, rivals: vec![] }
    }

    /// The gauge and the value of an answer about a hit; None where there is no such answer, and no gauge
    /// where it has no derivative.
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
            Answer::ExitSpeed => self.extreme(answer, Probe::Speed, false),
            Answer::ExitSpeedPlace => self.extreme(answer, Probe::Speed, true),
            Answer::Vibration => self.extreme(answer, Probe::Vibration, false),
            Answer::VibrationPlace => self.extreme(answer, Probe::Vibration, true),
            Answer::Bbcor => self.extreme(answer, Probe::Bbcor, false),
            Answer::HandsVelocity => self.extreme(answer, Probe::HandsVelocity, false),
            Answer::HandsAcceleration => self.extreme(answer, Probe::HandsAcceleration, false),
            Answer::Zone(end) => self.zone(usize::from(end)),
            _ => (None, None),
        }
    }

    fn value(&self, probe: Probe, x: f64) -> Option<f64> {
        probe.read(self.hitter, self.hitter.glance(x).as_ref())
    }

    fn place(&self, k: usize) -> f64 {
        self.ends[0] + (self.ends[1] - self.ends[0]) * k as f64 / self.steps as f64
    }

    /// Distance of the places of a difference (m).
    fn apart(&self) -> f64 {
        APART * self.ends[1]
    }

    /// The best value of a probe, or its place.
    fn extreme(
        &mut self,
        answer: Answer,
        probe: Probe,
        place: bool,
    ) -> (Option<Gauge>, Option<f64>) {
        let (Some(best), rival) = self.greatest(probe) else { return (None, None) };
        let Greatest { peak, bend } = best;
        if !probe.feels(peak.value) {
            return (None, None);
        }
        let value = if place { peak.x } else { peak.value };
        if let Some(rival) = rival {
            self.rivals.push(Rivals { answer, peaks: [peak, rival] });
            return (None, Some(value));
        }
        if !place {
            return (Some(Gauge::at(peak.x, probe)), Some(value));
        }
        let h = self.apart();
        let gauge = bend.map(|bend| Gauge {
            terms: slope(peak.x, probe, h, -1.0 / bend),
            off: [0.0, 1.0 / bend.abs()],
        });
        (gauge, Some(value))
    }

    /// The greatest speed or BBCOR, or the least of the others, and another one that is nearly as good.
    fn greatest(&self, probe: Probe) -> (Option<Greatest>, Option<Peak>) {
        let sign = if matches!(probe, Probe::Speed | Probe::Bbcor) { 1.0 } else { -1.0 };
        let signed = |k: usize| {
            let value = probe.read(self.hitter, self.hits[k].as_ref());
            value.map_or(f64::NEG_INFINITY, |value| sign * value)
        };
        let values: Vec<f64> = (0..=self.steps).map(signed).collect();
        let Some(k) = (0..=self.steps).max_by(|a, b| values[*a].total_cmp(&values[*b])) else {
            return (None, None);
        };
        if values[k] == f64::NEG_INFINITY {
            return (None, None);
        }
        let found = self.refined(probe, k);
        let near = NEARLY * values[k].abs();
        let higher = |j: usize, other: usize| values[j] >= values[other];
        let top = |j: &usize| {
            let up = *j == 0 || higher(*j, j - 1);
            up && (*j == self.steps || higher(*j, j + 1)) && j.abs_diff(k) > 2
        };
        let rival = (0..=self.steps).filter(top).find(|j| values[k] - values[*j] <= near);
        let rival = rival.map(|j| Peak { x: self.place(j), value: sign * values[j] });
        (found, rival)
    }

    /// Newton's steps to where the value's slope along the bat is 0, from a place of the look.
    fn refined(&self, probe: Probe, k: usize) -> Option<Greatest> {
        const NEWTON: usize = 12;
        let h = self.apart();
        let start = self.place(k);
        let step = self.place(1) - self.place(0);
        let here = |x: f64| Some(Peak { x, value: self.value(probe, x)? });
        let at_end = Greatest { peak: here(start)?, bend: None };
        let mut x = start;
        for _ in 0..NEWTON {
            if (x - start).abs() > 1.5 * step || x + 2.0 * h > self.ends[1] {
                return Some(at_end);
            }
            let Some([value, slope, bend]) = self.derivatives(probe, x, h) else {
                return Some(at_end);
            };
            let by = -slope / bend;
            if !by.is_finite() {
                return Some(at_end);
            }
            if by.abs() < 1e-9 * self.ends[1] {
                return Some(Greatest { peak: Peak { x, value }, bend: Some(bend) });
            }
            x += by;
        }
        Some(at_end)
    }

    /// The value at `x` and its first two derivatives along the bat, by differences of the fourth order.
    fn derivatives(&self, probe: Probe, x: f64, h: f64) -> Option<[f64; 3]> {
        let at = |k: f64| self.value(probe, x + k * h);
        let [a, b, c, d, e] = [at(-2.0)?, at(-1.0)?, at(0.0)?, at(1.0)?, at(2.0)?];
        let slope = (8.0 * (d - b) - (e - a)) / (12.0 * h);
        Some([c, slope, (16.0 * (b + d) - 30.0 * c - a - e) / (12.0 * h * h)])
    }

    /// An end of the stretch within 1 % of the greatest exit speed.
    fn zone(&mut self, end: usize) -> (Option<Gauge>, Option<f64>) {
        let (Some(Greatest { peak, .. }), None) = self.greatest(Probe::Speed) else {
            return (None, None);
        };
        let floor = peak.value - NEARLY * peak.value.abs();
        let zone = Looked::by(self.ends, FEW, self.hitter).zone(peak);
        let h = self.apart();
        let inside = |x: f64| x - 2.0 * h > self.ends[0] && x + 2.0 * h < self.ends[1];
        let mut x = zone[end];
        // From some micrometres to as near as numbers are.
        for _ in 0..3 {
            let Some([value, slope, _]) = self.derivatives(Probe::Speed, x, h) else { break };
            let by = (floor - value) / slope;
            if !(by.abs() < h && inside(x + by)) {
                break;
            }
            x += by;
        }
        let slope = self.derivatives(Probe::Speed, x, h).filter(|_| inside(x));
        let gauge = slope.map(|[_, slope, _]| Gauge {
            terms: vec![
                (x, Probe::Speed, -1.0 / slope),
                (peak.x, Probe::Speed, (1.0 - NEARLY * peak.value.signum()) / slope),
            ],
            // The speed there is off, and so is the greatest one.
            off: [2.0 / slope.abs(), 0.0],
        });
        (gauge, Some(x))
    }
}

/// So many times the slope of a reading along the bat at `x`.
fn slope(x: f64, probe: Probe, h: f64, factor: f64) -> Vec<(f64, Probe, f64)> {
    let unit = factor / (12.0 * h);
    [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)]
        .map(|(k, weight)| (x + k * h, probe, weight * unit))
        .to_vec()
}
