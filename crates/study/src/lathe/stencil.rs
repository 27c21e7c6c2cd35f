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
    /// The value at `x` and its first two derivatives along the bat.
    pub fn derivatives(&self, x: f64) -> Option<[f64; 3]> {
        let h = self.apart;
        let at = |k: f64| self.probe.read(self.hitter, self.hitter.glance(x + k * h).as_ref());
        let within = x - 2.0 * h >= 0.0 && x + 2.0 * h <= self.hitter.profile.length();
        within.then_some(())?;
        let [a, b, c, d, e] = [at(-2.0)?, at(-1.0)?, at(0.0)?, at(1.0)?, at(2.0)?];
        let slope = (8.0 * (d - b) - (e - a)) / (12.0 * h);
        Some([c, slope, (16.0 * (b + d) - 30.0 * c - a - e) / (12.0 * h * h)])
    }

    /// Newton's steps to where the slope is 0, and the derivatives there; `None` if that is farther away than `reach`
    /// (m).
    pub fn polished(&self, start: f64, reach: f64) -> Option<(f64, [f64; 3])> {
        const NEWTON: usize = 12;
        let mut x = start;
        for _ in 0..NEWTON {
            let by = self.derivatives(x)?;
            let step = -by[1] / by[2];
            if !step.is_finite() || (x + step - start).abs() > reach {
                return None;
            }
            if step.abs() < 1e-9 * self.hitter.profile.length() {
                return Some((x, by));
            }
            x += step;
        }
        None
    }

    /// Newton's steps from some micrometres away to the place where the value is `floor`, as close as arithmetic
    /// allows, and the derivatives there; `None` if they lead elsewhere.
    pub fn edge(&self, start: f64, floor: f64) -> Option<(f64, [f64; 3])> {
        const NEWTON: usize = 4;
        let mut x = start;
        for _ in 0..NEWTON {
            let by = self.derivatives(x)?;
            let step = (floor - by[0]) / by[1];
            if !step.is_finite() || (x + step - start).abs() >= self.apart {
                return None;
            }
            if step.abs() < 1e-7 * self.hitter.profile.length() {
                return Some((x, by));
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
