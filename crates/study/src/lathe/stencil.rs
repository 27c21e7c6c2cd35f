//! How does a reading change along the bat: by differences.

use crate::engine::Hitter;
use crate::lathe::probe::Probe;

/// Differences of a reading along the bat, of fourth order, with places that far apart.
#[derive(Clone, Copy)]
pub(super) struct Stencil<'a> {
    /// Bat and ball.
    pub hitter: &'a Hitter<'a>,
    /// The value.
    pub probe: Probe,
    /// Distance of the places (m).
    pub apart: f64,
}

impl Stencil<'_> {
    /// The last of Newton's steps (m) to a best place, for values without an error.
    pub fn exactly(&self) -> f64 {
        1e-9 * self.hitter.profile.length()
    }

    /// The last of Newton's steps (m) to a place where a value is given.
    pub fn closely(&self) -> f64 {
        1e-7 * self.hitter.profile.length()
    }

    /// The value at `x` and its first two derivatives along the bat.
    pub fn derivatives(&self, x: f64) -> Option<[f64; 3]> {
        let h = self.apart;
        let within = x - 2.0 * h >= 0.0 && x + 2.0 * h <= self.hitter.profile.length();
        within.then_some(())?;
        let seen = self.hitter.glances(&[-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| x + k * h));
        let read = |k: usize| self.probe.read(self.hitter, seen[k].as_ref());
        let [a, b, c, d, e] = [read(0)?, read(1)?, read(2)?, read(3)?, read(4)?];
        let slope = (8.0 * (d - b) - (e - a)) / (12.0 * h);
        Some([c, slope, (16.0 * (b + d) - 30.0 * c - a - e) / (12.0 * h * h)])
    }

    /// Newton's steps to where the slope is 0, until one is shorter than `enough` (m), and the derivatives there; `None`
    /// if that is farther away than `reach` (m). The error left is as small as the square of the last step.
    pub fn polished(&self, start: f64, reach: f64, enough: f64) -> Option<(f64, [f64; 3])> {
        let by_slope = |[_, slope, bend]: [f64; 3]| -slope / bend;
        let (x, by, step) = self.stepped(start, reach, enough, by_slope)?;
        Some((x + step, [by[0] + 0.5 * by[1] * step, by[1] + by[2] * step, by[2]]))
    }

    /// Newton's steps from some micrometres away to the place where the value is `floor`, until one is shorter than
    /// `enough` (m), and the derivatives there; `None` if they lead elsewhere.
    pub fn edge(&self, start: f64, floor: f64, enough: f64) -> Option<(f64, [f64; 3])> {
        let by_value = |[value, slope, _]: [f64; 3]| (floor - value) / slope;
        let (x, by, step) = self.stepped(start, self.apart, enough, by_value)?;
        Some((x + step, by))
    }

    /// Steps from `start` within `reach` (m): the last place from which one is shorter than `enough` (m), the
    /// derivatives there, and that step.
    fn stepped(
        &self,
        start: f64,
        reach: f64,
        enough: f64,
        step: impl Fn([f64; 3]) -> f64,
    ) -> Option<(f64, [f64; 3], f64)> {
        const NEWTON: usize = 12;
        let mut x = start;
        for _ in 0..NEWTON {
            let by = self.derivatives(x)?;
            let step = step(by);
            if !step.is_finite() || (x + step - start).abs() > reach {
                return None;
            }
            if step.abs() < enough {
                return Some((x, by, step));
            }
            x += step;
        }
        None
    }
}

/// A multiple of the slope of a reading along the bat at `x`.
pub(super) fn by_slope(x: f64, probe: Probe, h: f64, factor: f64) -> Vec<(f64, Probe, f64)> {
    let unit = factor / (12.0 * h);
    [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)]
        .map(|(k, weight)| (x + k * h, probe, weight * unit))
        .to_vec()
}
