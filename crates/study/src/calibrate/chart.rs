//! Which tones does the bat have for every possible wood?
//!
//! A bat of one material, whatever its fixtures weigh, has tones of the form
//!
//! ```text
//! f_n(E, G) = √(E/E₀) F_n(G/E)
//! ```
//!
//! because every stiffness is proportional to E if G/E is constant. F_n is solved at a few values of G/E and
//! interpolated in logarithms. A bat of several materials, of which one is sought, is solved at a few values of E too.

use crate::calibrate::fit::Search;
use crate::calibrate::unknowns::{Logs, Property, UNKNOWNS};
use crate::calibrate::wood::Slopes;
use crate::engine::{Result, threads};

/// E is sought from a quarter to four times that of the file.
const STIFFEST: f64 = 4.0;
/// Range of G/E for wood: that of species, 0.058 to 0.111 (Wood Handbook, FPL-GTR-282, table 5-1), extended by as much
/// on both sides.
const SHEAR: [f64; 2] = [0.03, 0.15];
/// Above this value, G/E is that of an isotropic material, `1/(2 (1 + ν))`, and stays as given.
const ISOTROPIC: f64 = 0.3;
/// Values of G/E and of E at which the bat is solved.
const SOLVED: [usize; 2] = [8, 9];
/// Steps of the search: of ln √E, and of ln G/E. Tones then move by 0.3 % at most from one to the next, which is
/// less than the error that a search assumes.
const STEPS: [f64; 2] = [3e-3, 0.08];

/// Tones of the bat over G/E and E.
pub struct Chart {
    /// Logarithms of E and of G/E over those of the file, at which tones were solved.
    stiffness: Vec<f64>,
    shear: Vec<f64>,
    /// Logarithms of the tones over `√(E/E₀)`, by stiffness, then shear.
    tones: Vec<Vec<f64>>,
    /// The unchanged properties of the wood: the weighed density.
    rest: Logs,
    /// Whether E is sought.
    open: bool,
}

impl Chart {
    /// The tones of the first modes over all possible wood.
    ///
    /// # Errors
    ///
    /// As [`crate::calibrate::wood::WoodenBat::shown`].
    pub fn of(search: &Search, modes: usize) -> Result<Self> {
        let wood = search.wood;
        let rest = weighed(search)?;
        let open = !search.held.contains(&Property::YoungsModulus);
        let most = STIFFEST.ln();
        let stiffness = match open && !wood.is_of_one_material() {
            true => between([-most, most], SOLVED[1]),
            false => vec![0.0],
        };
        let known = wood.shear_over_young();
        let shear = if search.held.contains(&Property::ShearModulus) || known > ISOTROPIC {
            vec![0.0]
        } else {
            // The value in the file is part of the range in any case.
            let ends = [SHEAR[0].min(known), SHEAR[1].max(known)].map(|ratio| (ratio / known).ln());
            between(ends, SOLVED[0])
        };
        let count = stiffness.len() * shear.len();
        let solved = threads::map(count, |k| {
            let logs = with(&rest, stiffness[k / shear.len()], shear[k % shear.len()]);
            let shown = wood.shown(&logs, modes)?;
            let tone = |f: &Slopes| f.value.ln() - 0.5 * logs[0];
            Ok::<_, sweetspot::Error>(shown.frequencies.iter().map(tone).collect())
        });
        let tones = solved.into_iter().collect::<Result<_>>()?;
        Ok(Self { stiffness, shear, tones, rest, open })
    }

    /// Calls `look` for every wood of the chart, with its logarithms and those of its tones (Hz).
    pub fn each(&self, mut look: impl FnMut(Logs, &[f64])) {
        let most = STIFFEST.ln();
        let steps = |ends: [f64; 2], step: f64| {
            let count = 1 + ((ends[1] - ends[0]) / step).ceil() as usize;
            between(ends, count)
        };
        let all = if self.open { steps([-most, most], 2.0 * STEPS[0]) } else { vec![0.0] };
        for shear in steps([self.shear[0], self.shear[self.shear.len() - 1]], STEPS[1]) {
            for stiffness in &all {
                let tones = self.at(*stiffness, shear);
                look(with(&self.rest, *stiffness, shear), &tones);
            }
        }
    }

    /// Logarithms of the tones of that wood.
    fn at(&self, stiffness: f64, shear: f64) -> Vec<f64> {
        let ((i, a), (j, b)) = (within(&self.stiffness, stiffness), within(&self.shear, shear));
        let of = |i: usize, j: usize| &self.tones[i * self.shear.len() + j];
        let next = |i: usize, count: usize| (i + 1).min(count - 1);
        let (u, v) = (next(i, self.stiffness.len()), next(j, self.shear.len()));
        let tone = |k: usize| {
            let low = (1.0 - b) * of(i, j)[k] + b * of(i, v)[k];
            let high = (1.0 - b) * of(u, j)[k] + b * of(u, v)[k];
            0.5 * stiffness + (1.0 - a) * low + a * high
        };
        (0..of(0, 0).len()).map(tone).collect()
    }
}

/// A wood of that stiffness and shear.
fn with(rest: &Logs, stiffness: f64, shear: f64) -> Logs {
    let [_, _, handle, barrel, ratio] = *rest;
    [stiffness, shear, handle, barrel, ratio]
}

/// The density from the scale, equal for handle and barrel; that of the file if nothing was weighed.
fn weighed(search: &Search) -> Result<Logs> {
    let mut logs = [0.0; UNKNOWNS];
    let Some(mass) = search.readings.mass else { return Ok(logs) };
    let shown = search.wood.shown(&logs, 0)?.mass;
    let own: f64 = shown.by[2] + shown.by[3];
    let wood = mass.value - (shown.value - own);
    if own > 0.0 && wood > 0.0 && !search.held.contains(&Property::Density) {
        logs[2] = (wood / own).ln();
        logs[3] = logs[2];
    }
    Ok(logs)
}

/// That many numbers, evenly spaced from one end to the other.
fn between([from, to]: [f64; 2], count: usize) -> Vec<f64> {
    let step = (to - from) / (count.max(2) - 1) as f64;
    (0..count).map(|k| from + step * k as f64).collect()
}

/// The interval of rising numbers that contains a value, and the position in it, 0 to 1.
fn within(nodes: &[f64], value: f64) -> (usize, f64) {
    let last = nodes.len().saturating_sub(2);
    let k = nodes.iter().skip(1).take_while(|node| **node < value).count().min(last);
    match nodes.get(k + 1) {
        Some(next) => (k, ((value - nodes[k]) / (next - nodes[k])).clamp(0.0, 1.0)),
        None => (0, 0.0),
    }
}
