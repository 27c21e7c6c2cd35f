//! What is the size of a pixel, and from what distance was the picture taken?
//!
//! A pinhole at the distance `D` above the axis sees a cylinder of radius `r` as `f r / √(D² − r²)` to each side, and
//! the near rim of a flat end at `x` from its foot as if the end were at `x / (1 − r/D)`: ends look longer than the
//! bat. The largest diameter gives the scale, and the excess of the apparent length then gives `D`.

use sweetspot::base::error::{Error, Result};

use crate::trace::edges::Edges;

/// Measurements (m): the bat's length, its largest diameter by calipers and, if known, its distance from the lens.
#[derive(Debug, Clone, Copy)]
pub struct Told {
    pub length: f64,
    pub diameter: f64,
    pub distance: Option<f64>,
}

/// Half the width of the bat at every pixel from its apparent knob end.
pub struct Outline {
    half: Vec<f64>,
    /// The first column, the apparent length and the middle of the picture, from the knob end (px).
    first: f64,
    length: f64,
    foot: f64,
    /// Whether the knob is on the right.
    pub turned: bool,
}

/// The picture's scale and the position of the camera.
#[derive(Debug, Clone, Copy)]
pub struct Camera {
    /// Pixels per metre on the axis: across the widest part, and along it if the two ends determine that. The tip may
    /// be round, which can be seen only if the distance is given.
    pub per_m: f64,
    along: f64,
    /// One over its distance from the axis (1/m).
    pub nearness: f64,
    /// Its position along the axis, from the knob end (m).
    pub foot: f64,
    /// Apparent excess of the knob and of the tip beyond the true ends (m).
    pub beyond: [f64; 2],
    /// Position of the largest diameter (m).
    pub widest: f64,
}

impl Outline {
    /// The outline with the knob first (the end of the thinner half); `middle` is the middle of the picture.
    pub fn of(edges: &Edges, middle: [f64; 2]) -> Self {
        let mut half: Vec<f64> = (0..edges.columns()).map(|k| edges.half(k)).collect();
        let [from, to] = edges.axis.ends;
        let last = edges.first + (half.len() - 1) as f64;
        let [foot, _] = edges.axis.along_across(middle);
        let parts = half.split_at(half.len() / 2);
        let turned = parts.0.iter().sum::<f64>() > parts.1.iter().sum::<f64>();
        if turned {
            half.reverse();
        }
        let (first, foot) =
            if turned { (to - last, to - foot) } else { (edges.first - from, foot - from) };
        Self { half, first, length: to - from, foot, turned }
    }

    /// The outline without the blur of perspective. A circle of radius `r` about the axis appears as an ellipse that
    /// extends `κ r` to both sides along the axis, and the outline is the largest of all ellipses at each place. The
    /// largest circles below it are `r² = min (A² + (s/κ)²)`, over places at the distance `s` with the half width `A`.
    pub fn sharpened(&self, camera: &Camera) -> Self {
        let count = self.half.len();
        let widest = self.half.iter().copied().fold(0.0, f64::max);
        let circle = |k: usize| {
            let u = self.first + k as f64;
            let smear = (u / camera.along - camera.beyond[0] - camera.foot).abs() * camera.nearness;
            let reach = (smear * widest).ceil() as usize;
            let near = k.saturating_sub(reach)..(k + reach + 1).min(count);
            let seen = near.map(|j| self.half[j].powi(2) + (j.abs_diff(k) as f64 / smear).powi(2));
            // There is no outline beyond the ends.
            let end = u.min(self.length - u).max(0.0) / smear;
            let own = self.half[k].powi(2);
            let value =
                if reach == 0 { own } else { seen.filter(|v| v.is_finite()).fold(own, f64::min) };
            value.min(if end.is_finite() { end * end } else { value }).sqrt()
        };
        Self { half: (0..count).map(circle).collect(), ..*self }
    }

    /// Half the width at a place (px from the knob end), averaged over a number of pixels to each side.
    pub fn half(&self, u: f64, beside: f64) -> f64 {
        let last = self.half.len() - 1;
        let column = |u: f64| (u - self.first).round().clamp(0.0, last as f64) as usize;
        let some = &self.half[column(u - beside)..=column(u + beside)];
        some.iter().sum::<f64>() / some.len() as f64
    }
}

impl Camera {
    /// # Errors
    ///
    /// [`Error::Value`] where length and diameter do not fit together in the picture.
    pub fn of(outline: &Outline, told: Told) -> Result<Self> {
        /// One over the least distance of a camera (1/m).
        const NEAREST: f64 = 2.0;
        /// Share by which a bat may look too short, because of a tilt of some degrees.
        const SHORT: f64 = 0.015;
        let apparent = |nearness: f64| {
            let camera = Self::at(nearness, outline, told);
            let shown = camera.per_m * (told.length + camera.beyond[0] + camera.beyond[1]);
            (camera, outline.length / shown - 1.0)
        };
        let (mut far, mut near) = (0.0, NEAREST);
        let (flat, excess) = apparent(far);
        let told_so =
            "a length and a largest diameter that fit to the picture, the bat level with the lens";
        let by_diameter = || {
            let length = 1e3 * outline.length / flat.per_m;
            format!(
                "a bat {length:.0} mm long by its diameter, {:.0} mm as told",
                1e3 * told.length
            )
        };
        if excess < -SHORT || apparent(near).1 > 0.0 {
            return Err(Error::value("the picture", by_diameter(), told_so));
        }
        if let Some(distance) = told.distance {
            return Ok(Self::at(1.0 / distance, outline, told));
        }
        if excess <= 0.0 {
            return Ok(flat);
        }
        for _ in 0..50 {
            let middle = 0.5 * (far + near);
            if apparent(middle).1 > 0.0 { far = middle } else { near = middle }
        }
        Ok(apparent(0.5 * (far + near)).0)
    }

    /// The camera for that nearness (1/m).
    fn at(nearness: f64, outline: &Outline, told: Told) -> Self {
        /// The widest part is a mean over this length to each side (m), as by calipers, and this far from the tip (m).
        const CALIPERS: f64 = 5e-3;
        const TIP: f64 = 0.02;
        let radius = 0.5 * told.diameter;
        let rough = outline.length / told.length;
        let inside = (0.5 * outline.length) as usize..(outline.length - rough * TIP) as usize;
        let at = |u: &usize| outline.half(*u as f64, CALIPERS * rough);
        let widest = inside.max_by(|a, b| at(a).total_cmp(&at(b))).unwrap_or(0);
        let per_m = at(&widest) * (1.0 - (radius * nearness).powi(2)).sqrt() / radius;
        let mut camera =
            Self { per_m, along: rough, nearness, foot: 0.0, beyond: [0.0; 2], widest: 0.0 };
        for _ in 0..4 {
            camera.foot = outline.foot / camera.along - camera.beyond[0];
            camera.beyond = [0, 1].map(|end| camera.beyond(end, outline, told.length));
            let [knob, tip] = camera.beyond;
            let [flat, round] =
                [knob + tip, knob].map(|more| outline.length / (told.length + more));
            camera.along = if told.distance.is_some() { per_m.clamp(flat, round) } else { flat };
        }
        camera.widest = widest as f64 / camera.along - camera.beyond[0];
        camera
    }

    /// Apparent excess of an end (m), which is less for a rounded end than for a flat one.
    fn beyond(&self, end: usize, outline: &Outline, length: f64) -> f64 {
        /// Largest distance of the visible end from the true one (m).
        const DEEP: f64 = 0.03;
        let seen = (0..=30).map(|k| {
            let inside = DEEP * f64::from(k) / 30.0;
            let x = if end == 0 { inside } else { length - inside };
            let radius = self.radius(outline, x, 2e-4);
            let arm = if end == 0 { self.foot - x } else { x - self.foot };
            arm / (1.0 - radius * self.nearness) - arm - inside
        });
        seen.fold(0.0, f64::max)
    }

    /// Whether the bat looks shorter than its ends allow, as if its ends were not level.
    pub fn doubtful(&self, told: Told) -> bool {
        /// One over the largest usual distance of a camera (1/m).
        const FAR: f64 = 0.1;
        told.distance.is_none() && self.nearness < FAR
    }

    /// The radius (m) at a place of the bat (m), as a mean over that length to each side.
    pub fn radius(&self, outline: &Outline, x: f64, beside: f64) -> f64 {
        let half = outline.half(self.along * (x + self.beyond[0]), self.along * beside);
        half / self.per_m.hypot(half * self.nearness)
    }
}
