//! Where was the bat measured, and are these possible radii?

use serde::{Deserialize, Serialize};

use crate::base::{Error, Mistakes, Result, mistakes};

/// How the radius runs between stations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub enum Interpolation {
    /// A smooth curve without overshoot: the monotone cubic of Fritsch and Butland, split at steps.
    Pchip,
    /// A straight line from station to station.
    Linear,
    /// The value of a station holds until the next; the last station only marks the end of the bat.
    Constant,
}

/// Stations along the axis, from the knob: position, outer and inner radius (m).
///
/// Two stations at the same `x` are a step: the first is the value to its left.
#[derive(Debug, Clone, PartialEq)]
pub struct Stations {
    /// Positions from the knob end (m), the first 0.
    pub x: Vec<f64>,
    /// Outer radius at each station (m).
    pub outer: Vec<f64>,
    /// Inner radius at each station, 0 where the bat is solid.
    pub inner: Vec<f64>,
    /// Interpolation between the stations.
    pub interpolation: Interpolation,
}

/// The outer and inner radius (m) at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// r (m).
    pub outer: f64,
    /// r_i (m), 0 where the bat is solid.
    pub inner: f64,
}

impl Section {
    /// Area `π(r² − rᵢ²)` in m².
    #[inline]
    pub fn area(self) -> f64 {
        let (r, ri) = (self.outer, self.inner);
        std::f64::consts::PI * (r - ri) * (r + ri)
    }

    /// Second moment of area about a diameter, `π/4 (r⁴ − rᵢ⁴)`, in m⁴.
    #[inline]
    pub fn second_moment(self) -> f64 {
        let (r, ri) = (self.outer, self.inner);
        self.area() * (r * r + ri * ri) / 4.0
    }

    /// Factor by which round-off of the radii grows in the wall thickness, `r/(r − rᵢ)`.
    pub fn thinness(self) -> f64 {
        if self.outer == 0.0 { 1.0 } else { self.outer / (self.outer - self.inner) }
    }

    /// The bore as a section: the area inside the inner radius.
    #[inline]
    pub fn bore(self) -> Self {
        Self { outer: self.inner, inner: 0.0 }
    }
}

pub(super) fn check_positions(x: &[f64]) -> Result<()> {
    if x.len() < 2 {
        return Err(Error::value("x", format!("{} station(s)", x.len()), "two stations at least"));
    }
    let mut mistakes = Mistakes::default();
    if x[0] != 0.0 {
        let expected = "0: positions count from the end named in \"measured_from\"";
        mistakes.add(Error::value("x[0]", format!("{} m", x[0]), expected));
    }
    mistakes.note(mistakes::all((1..x.len()).map(|k| check_position(x, k))));
    mistakes.end(())?;
    let last = x.len() - 1;
    if x[last] == 0.0 {
        return Err(Error::value(format!("x[{last}]"), "a bat of no length", "a length above 0"));
    }
    if x[1] == 0.0 || x[last - 1] == x[last] {
        let k = if x[1] == 0.0 { 1 } else { last };
        let expected = "a step inside the bat: at an end only one value can hold";
        return Err(Error::value(format!("x[{k}]"), "a step at an end of the bat", expected));
    }
    Ok(())
}

/// Checks that station `k` lies beyond the one before.
fn check_position(x: &[f64], k: usize) -> Result<()> {
    if x[k] < x[k - 1] || !x[k].is_finite() {
        let expected = format!("a position beyond x[{}]", k - 1);
        return Err(Error::value(format!("x[{k}]"), format!("{} m", x[k]), expected));
    }
    if k > 1 && x[k] == x[k - 2] {
        let expected = "two stations at most at one place (left and right of a step)";
        return Err(Error::value(format!("x[{k}]"), "a third station at one place", expected));
    }
    Ok(())
}

pub(super) fn check_radii(stations: &Stations) -> Result<()> {
    mistakes::all((0..stations.x.len()).map(|k| check_radius(stations, k))).map(|_| ())
}

/// Checks that the radii of station `k` are possible.
fn check_radius(stations: &Stations, k: usize) -> Result<()> {
    let (r, ri) = (stations.outer[k], stations.inner[k]);
    let at_end = k == 0 || k == stations.x.len() - 1;
    let wrong = |role: &str, value: f64, expected: &str| {
        Err(Error::value(format!("{role}[{k}]"), format!("{value} m"), expected))
    };
    if !(r > 0.0 || r == 0.0 && at_end) || !r.is_finite() {
        let pointed = "a radius above 0 (only an end of the bat may come to a point)";
        return wrong("outer", r, if r == 0.0 { pointed } else { "a radius above 0" });
    }
    if !(ri >= 0.0 && ri.is_finite()) {
        return wrong("inner", ri, "0 or more");
    }
    if ri >= r && !(r == 0.0 && ri == 0.0) {
        return wrong("inner", ri, &format!("less than outer[{k}]"));
    }
    let stiffness = Section { outer: r, inner: ri }.second_moment();
    let in_range = stiffness > f64::MIN_POSITIVE && stiffness < f64::MAX;
    if !at_end && !in_range {
        return wrong("outer", r, "a radius whose fourth power is within the range of numbers");
    }
    Ok(())
}

/// `constant` stations written out as steps, each value at both ends of its stretch.
pub(super) fn held(stations: &Stations) -> Result<Stations> {
    let mut steps =
        Stations { x: vec![], outer: vec![], inner: vec![], interpolation: Interpolation::Linear };
    let (x, outer, inner) = (&stations.x, &stations.outer, &stations.inner);
    for k in 0..x.len() - 1 {
        if x[k] == x[k + 1] {
            // If the user wrote out a step, its left value must be the one that holds there.
            for (role, values) in [("outer", outer), ("inner", inner)] {
                if values[k] != values[k - 1] {
                    let expected = format!("{role}[{}], which holds up to here", k - 1);
                    let found = format!("{} m", values[k]);
                    return Err(Error::value(format!("{role}[{k}]"), found, expected));
                }
            }
            continue;
        }
        if outer[k] == 0.0 {
            let expected = "a radius above 0: it holds to the next station";
            return Err(Error::value(format!("outer[{k}]"), "0 m", expected));
        }
        for at in [x[k], x[k + 1]] {
            steps.x.push(at);
            steps.outer.push(outer[k]);
            steps.inner.push(inner[k]);
        }
    }
    Ok(steps)
}
