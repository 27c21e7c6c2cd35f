//! What are the diameters of the bat, and their errors?

use serde::{Deserialize, Serialize};
use sweetspot::base::error::Result;
use sweetspot::bat::profile::Profile;
use sweetspot::bat::stations::{Interpolation, Stations};

use crate::trace::camera::{Camera, Outline, Told};

/// The result of one picture, at places that depend only on the length of the bat. Deviations are standard deviations.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Seen {
    pub x_m: Vec<f64>,
    pub diameter_m: Vec<f64>,
    /// Deviation of every diameter due to its own reading.
    reading_m: f64,
    /// Change of every diameter if one end is nearer to the lens by [`TILT`].
    tilt_m: Vec<f64>,
    /// Deviation due to calipers, lens and places, common to all pictures.
    common_m: Vec<f64>,
    turned: bool,
}

/// Standard deviation of the bat's tilt in one picture, and in the mean of two taken end for end.
const TILT: [f64; 2] = [2.5, 0.5];
/// Error of calipers (m).
const CALIPERS: f64 = 1e-4;
/// Error of a place along the bat: that of the measured length (m), and a share of the apparent excess of an end, if
/// the distance was given and if it follows from the ends, which may be round.
const ALONG: (f64, [f64; 2]) = (7e-4, [0.15, 0.4]);
/// Assumed value of one over a distance (1/m) that was not given and seems to be larger.
const USUAL: f64 = 1.0 / 3.0;
/// Relative distortion of a lens at half the bat's length from the middle.
const LENS: f64 = 0.004;

/// Lengths (m) of the knob and of the tip, and the distance of places there.
const KNOB: [f64; 2] = [0.06, 0.004];
const TIP: [f64; 2] = [0.024, 0.006];

/// The places (m): close together along the knob and at the tip, elsewhere 15 mm apart.
fn places(length: f64) -> Vec<f64> {
    const APART: f64 = 0.015;
    let knob = (0..(KNOB[0] / KNOB[1]).round() as usize).map(|k| KNOB[1] * k as f64);
    let body = length - KNOB[0] - TIP[0];
    let parts = (body / APART).round().max(1.0);
    let body = (0..parts as usize).map(|k| KNOB[0] + body * k as f64 / parts);
    let tip = (0..=(TIP[0] / TIP[1]).round() as usize).rev().map(|k| length - TIP[1] * k as f64);
    knob.chain(body).chain(tip).collect()
}

impl Seen {
    /// The result of an outline, given the contrast of bat and ground over the noise.
    pub fn of(outline: &Outline, camera: &Camera, told: Told, contrast: f32) -> Self {
        /// Error of an edge (px), and the contrast below which it is larger.
        const EDGE: (f64, f64) = (0.3, 12.0);
        /// Length averaged to each side (m), at the knob and elsewhere.
        const BESIDE: [f64; 2] = [5e-4, 2.5e-3];
        /// Distance (px) from the ends at which readings begin.
        const INSIDE: f64 = 2.0;
        let inside = INSIDE / camera.per_m;
        let x_m = places(told.length);
        let radius = |x: f64, knob: f64| {
            let beside = if x < KNOB[0] || x > told.length - TIP[0] { knob } else { BESIDE[1] };
            camera.radius(outline, x.clamp(inside, told.length - inside), beside)
        };
        let unsure = (EDGE.1 / f64::from(contrast)).max(1.0);
        let half = 0.5 * told.length;
        let (nearness, share) = match told.distance {
            Some(distance) => (1.0 / distance, ALONG.1[0]),
            None => (camera.nearness.max(USUAL), ALONG.1[1]),
        };
        let place = ALONG.0.hypot(share * half * 0.5 * told.diameter * camera.nearness);
        let common = |x: &f64| {
            let r = radius(*x, BESIDE[0]);
            let scale = CALIPERS / told.diameter;
            let from = |at: f64| ((at - camera.foot) / half).powi(2);
            let lens = LENS * (from(*x) - from(camera.widest));
            let slope = (radius(x + 2e-3, BESIDE[0]) - radius(x - 2e-3, BESIDE[0])) / 4e-3;
            // The blur of a step by perspective is removed as accurately as the distance is known.
            let smeared = share * (x - camera.foot) * r * nearness;
            let along = slope * place.hypot(smeared);
            2.0 * (r * scale).hypot(r * lens).hypot(along)
        };
        let diameter_m: Vec<f64> = x_m.iter().map(|x| 2.0 * radius(*x, BESIDE[0])).collect();
        let doubt = if camera.doubtful(told) { 2.0 } else { 1.0 };
        let per_tilt = doubt * TILT[0].to_radians().sin() * nearness;
        let tilts = x_m.iter().zip(&diameter_m).map(|(x, d)| d * (x - camera.widest) * per_tilt);
        Self {
            tilt_m: tilts.collect(),
            common_m: x_m.iter().map(common).collect(),
            reading_m: EDGE.0 * unsure / camera.per_m,
            turned: outline.turned,
            diameter_m,
            x_m,
        }
    }
}

impl Seen {
    /// Whether every place has its numbers.
    pub fn is_whole(&self) -> bool {
        let columns = [&self.diameter_m, &self.tilt_m, &self.common_m];
        columns.iter().all(|one| one.len() == self.x_m.len() && one.iter().all(|v| v.is_finite()))
            && self.reading_m.is_finite()
    }
}

/// The result of all pictures of one bat.
pub struct Shape {
    pub stations: Stations,
    /// Error of a diameter between knob and tip (m), as root mean square.
    pub deviation: f64,
    /// Whether pictures show it from both ends.
    pub both: bool,
    /// Difference of two pictures over their deviations, if it is too large.
    pub apart: Option<f64>,
}

impl Shape {
    /// The mean of the results of pictures with equal places.
    ///
    /// # Errors
    ///
    /// As [`Profile::new`].
    pub fn of(seen: &[Seen]) -> Result<Self> {
        let count = seen.len() as f64;
        let first = &seen[0];
        let both = seen.iter().any(|one| one.turned != first.turned);
        let tilted = if both { TILT[1] / TILT[0] } else { 1.0 };
        let reading = seen.iter().map(|one| one.reading_m.powi(2)).sum::<f64>().sqrt() / count;
        let mean = |of: fn(&Seen) -> &Vec<f64>, k: usize| {
            seen.iter().map(|one| of(one)[k]).sum::<f64>() / count
        };
        let all = 0..first.x_m.len();
        let deviation = |k: usize| {
            let tilt = seen.iter().map(|one| one.tilt_m[k].abs()).fold(0.0, f64::max) * tilted;
            reading.hypot(mean(|one| &one.common_m, k)).hypot(tilt)
        };
        let deviations: Vec<f64> = all.clone().map(deviation).collect();
        let diameters: Vec<f64> = all.clone().map(|k| mean(|one| &one.diameter_m, k)).collect();
        let apart = |k: usize| {
            let all = || seen.iter().map(|one| one.diameter_m[k]);
            all().fold(0.0, f64::max) - all().fold(f64::INFINITY, f64::min)
        };
        // A bat that is not level shows twice its tilt as the difference of two opposite pictures.
        let allowed =
            |k: usize| 3.0 * (2.0 * reading).hypot(2.0 * first.tilt_m[k]).hypot(first.common_m[k]);
        let length = first.x_m.last().copied().unwrap_or_default();
        let ends = KNOB[0]..=length - TIP[0];
        let body: Vec<usize> = all.filter(|k| ends.contains(&first.x_m[*k])).collect();
        let worst = body.iter().map(|k| apart(*k) - allowed(*k)).fold(0.0, f64::max);
        let square =
            body.iter().map(|k| deviations[*k].powi(2)).sum::<f64>() / body.len().max(1) as f64;
        Ok(Self {
            stations: few(&first.x_m, &diameters, &deviations)?,
            deviation: square.sqrt(),
            both,
            apart: (worst > 0.0).then_some(worst),
        })
    }
}

/// The necessary stations: a station is left out if the curve through the others is within a part of its error.
fn few(x: &[f64], diameters: &[f64], deviations: &[f64]) -> Result<Stations> {
    /// Allowed distance of the curve from a station that is left out, as a share of the deviation.
    const SHARE: f64 = 0.2;
    /// Resolution of the written diameters (m).
    const DIGIT: f64 = 1e-5;
    let stations = |kept: &[usize]| Stations {
        x: kept.iter().map(|k| (x[*k] / DIGIT).round() * DIGIT).collect(),
        outer: kept.iter().map(|k| 0.5 * (diameters[*k] / DIGIT).round() * DIGIT).collect(),
        inner: vec![0.0; kept.len()],
        interpolation: Interpolation::Pchip,
    };
    let mut kept: Vec<usize> = (0..x.len()).collect();
    let mut place = 1;
    while place + 1 < kept.len() {
        let mut fewer = kept.clone();
        fewer.remove(place);
        let profile = Profile::new(stations(&fewer))?;
        let near = fewer[place.saturating_sub(2)]..=fewer[(place + 1).min(fewer.len() - 1)];
        let met =
            |k: usize| (2.0 * profile.at(x[k]).outer - diameters[k]).abs() <= SHARE * deviations[k];
        if near.clone().all(met) {
            kept = fewer;
        } else {
            place += 1;
        }
    }
    Ok(stations(&kept))
}
