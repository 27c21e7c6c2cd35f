//! Between which values do the sections of formulas lie, and how well do polynomials hold them?
//!
//! The sections depend on `r²` and `r_i²`. Let these be analytic inside the ellipse whose foci are the ends of a
//! stretch and whose half axes add up to ϱ half lengths, and let `|f| ≤ M` there. Then a polynomial of degree n differs
//! from f on the stretch by at most `2 M ϱ⁻ⁿ/(ϱ − 1)`. This needs no samples: a feature between two samples makes M
//! large.
//!
//! # Source
//!
//! L. N. Trefethen, Approximation Theory and Approximation Practice (SIAM, 2013), theorem 8.2.

use crate::base::interval::{Interval, Rectangle};
use crate::bat::formula_range::On;
use crate::bat::material::Material;
use crate::bat::profile::Curves;

/// The values of ϱ that are tried: the smallest suits the longest stretches, the largest gives the most digits.
const ELLIPSES: [f64; 3] = [1.7, 2.5, 4.0];
/// The degree that the integration points for formulas resolve beyond the products of deflections.
const HELD: i32 = 31;

/// What bounds the sections on a stretch of formulas.
pub(crate) struct Bounds<'a> {
    curves: &'a Curves,
    outer: On,
    inner: Option<On>,
    /// The formulas' `x` in the middle, and half the length (m).
    middle: f64,
    half: f64,
}

/// Bounds of `r²`, `r_i²` and `r² − r_i²` (m²).
struct Squares {
    outer: f64,
    inner: f64,
    wall: f64,
}

impl Squares {
    /// Bending stiffness over the tube's modulus (m⁴); the core has `core` times that modulus.
    fn bending(&self, core: f64) -> f64 {
        self.wall * (self.outer + self.inner) + core * self.inner * self.inner
    }
}

/// The least of the bounds `2 M ϱ⁻ⁿ/(ϱ − 1)`, with the `M` that is found for each ellipse.
fn by_ellipses(most: impl Fn(f64) -> Option<f64>) -> f64 {
    let bound = |ellipse: &f64| Some(2.0 * most(*ellipse)? * ellipse.powi(-HELD) / (ellipse - 1.0));
    let bounds = ELLIPSES.iter().filter_map(bound);
    bounds.filter(|bound| !bound.is_nan()).fold(f64::INFINITY, f64::min)
}

impl Curves {
    /// Bounds on the sections from `s0` to `s1`; `None` where a branch changes its side there or a
    /// formula has no value.
    pub(crate) fn bounds(&self, s0: f64, s1: f64) -> Option<Bounds<'_>> {
        let (from, to) = (self.x(s0), self.x(s1));
        let outer = self.outer.on(from, to)?;
        let inner = match &self.inner {
            Some(inner) => Some(inner.on(from, to)?),
            None => None,
        };
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from).abs());
        Some(Bounds { curves: self, outer, inner, middle, half })
    }
}

impl Bounds<'_> {
    /// Ranges of `r²`, `r_i²` and `r² − r_i²` along the stretch.
    fn ranges(&self) -> [Interval; 3] {
        let of = |on: &On| on.on[1].range(on.middle[1], self.half);
        let outer = of(&self.outer);
        match &self.inner {
            None => [outer, Interval::point(0.0), outer],
            Some(inner) => {
                let middle = self.outer.middle[1] - inner.middle[1];
                let squares = (self.outer.on[1] - inner.on[1]).range(middle, self.half);
                // Two radii that taper alike: their difference has no slope, but the difference of their squares has.
                let [on, middle] =
                    [(self.outer.on[0], inner.on[0]), (self.outer.middle[0], inner.middle[0])]
                        .map(|(outer, inner)| [outer - inner, outer + inner]);
                let [thickness, sum] = [0, 1].map(|i| on[i].range(middle[i], self.half));
                let wall = squares.and(thickness * sum);
                [outer, of(inner), wall]
            }
        }
    }

    /// Lower and upper bounds of the sections; where a section comes to a point, the lower bound is its value in the
    /// middle.
    fn sizes(&self) -> [Squares; 2] {
        let ranges = self.ranges();
        let middle = |on: &On| on.middle[1].value.re.low.max(0.0);
        let (outer, inner) = (middle(&self.outer), self.inner.as_ref().map_or(0.0, middle));
        let [wall, of_outer] = [(ranges[2], outer - inner), (ranges[0], outer)]
            .map(|(range, middle)| if range.low > 0.0 { range.low } else { middle });
        let least = Squares { outer: of_outer, inner: ranges[1].low.max(0.0), wall };
        let [outer, inner, wall] = ranges.map(Interval::largest);
        [least, Squares { outer, inner, wall }]
    }

    /// Whether the outer radius and the wall are above 0 and the inner radius is not below 0. At an end of the bat,
    /// where `ends` allows it, they may rise from 0.
    pub(crate) fn possible(&self, ends: [bool; 2]) -> bool {
        let [outer, _, wall] = self.ranges();
        let own = self.outer.on[1];
        let of_wall = self.inner.as_ref().map_or(own, |inner| own - inner.on[1]);
        let rising = |slope: Interval| ends[0] && slope.low >= -1e-9 * slope.largest();
        let falling = |slope: Interval| ends[1] && slope.high <= 1e-9 * slope.largest();
        let positive =
            |range: Interval, slope: Interval| range.low > 0.0 || rising(slope) || falling(slope);
        let inner = self.inner.as_ref().is_none_or(|inner| {
            inner.on[0].range(inner.middle[0], self.half).low >= -self.curves.floor
        });
        inner && positive(outer, own.slope.re) && positive(wall, of_wall.slope.re)
    }

    /// Relative distance of polynomials from EI and ρA, with a core of `core` times the outer modulus; infinite if no
    /// bound is known.
    pub(crate) fn missed(&self, core: f64) -> f64 {
        let [least, _] = self.sizes();
        by_ellipses(|ellipse| {
            let [outer, inner, wall] = self.around(ellipse)?.map(|f| f.modulus().high);
            let most = Squares { outer, inner, wall };
            let bending = most.bending(core) / least.bending(core);
            Some(bending.max(most.wall / least.wall))
        })
    }

    /// Relative distance of polynomials from κGA; infinite if no bound is known. `empty` says how empty the bore is (1
    /// without a core), and a core resists shear `core` times as much per area as the tube's modulus alone would.
    ///
    /// With `a = r²` and `b = empty · r_i²`, Cowper's κ is `c₁ (a + b)²/(c₂ (a + b)² + c₃ a b)` ([`Material::kappa`]).
    /// It falls as the bore grows.
    pub(crate) fn missed_shear(&self, tube: &Material, empty: f64, core: f64) -> f64 {
        let [least, most] = self.sizes();
        let hole = empty * (most.inner / least.outer).min(1.0);
        let smallest = tube.kappa(hole) * least.wall + core * least.inner;
        by_ellipses(|ellipse| {
            let [outer, inner, wall] = self.around(ellipse)?;
            let kappa = tube.kappa_around(outer, Rectangle::point(empty) * inner)?;
            Some((kappa * wall.modulus().high + core * inner.modulus().high) / smallest)
        })
    }

    /// Boxes that hold `r²`, `r_i²` and `r² − r_i²` inside an ellipse.
    fn around(&self, ellipse: f64) -> Option<[Rectangle; 3]> {
        let axis = |sign: f64| 0.5 * (ellipse + sign / ellipse) * self.half;
        let (re, im) = (Interval::within(axis(1.0)), Interval::within(axis(-1.0)));
        let around = Rectangle { re: Interval::point(self.middle) + re, im };
        let outer = self.curves.outer.square_around(&self.outer, around)?;
        let inner = match (&self.curves.inner, &self.inner) {
            (Some(formula), Some(on)) => formula.square_around(on, around)?,
            _ => Rectangle::point(0.0),
        };
        Some([outer, inner, outer - inner])
    }

    /// Bound on the relative variation of EI and ρA along the stretch.
    pub(crate) fn variation(&self, core: f64) -> f64 {
        let [least, most] = self.sizes();
        let bending = most.bending(core) / least.bending(core);
        bending.max(most.wall / least.wall) - 1.0
    }

    /// Relative round-off of the sections: the width of an evaluation at one place, and the rounding of the place.
    pub(crate) fn round_off(&self) -> f64 {
        let middle = match &self.inner {
            None => self.outer.middle[1],
            Some(inner) => {
                let (outer, inner) = (self.outer.middle[0], inner.middle[0]);
                (outer - inner) * (outer + inner)
            }
        };
        let value = middle.value.re;
        let place = f64::EPSILON * self.middle.abs() * middle.slope.re.largest();
        (value.high - value.low + place) / value.smallest().max(f64::MIN_POSITIVE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::quadrature::{gauss, legendre};
    use crate::bat::formula::Formula;

    /// Terms of the Legendre series of κGA beyond degree 31, relative to its least value, by quadrature with more
    /// points than any bound needs.
    fn tail(curves: &Curves, tube: &Material) -> f64 {
        const POINTS: usize = 80;
        let points = gauss(POINTS);
        let shear = |s: f64| {
            let section = curves.at(s);
            tube.kappa((section.inner / section.outer).powi(2)) * section.area()
        };
        let values: Vec<f64> = points.iter().map(|(s, _)| shear(*s)).collect();
        let least = values.iter().fold(f64::INFINITY, |least, value| least.min(*value));
        let polynomials: Vec<_> = points.iter().map(|(s, _)| legendre(50, 2.0 * s - 1.0)).collect();
        let part = |k: usize| -> f64 {
            let terms = points.iter().zip(&values).zip(&polynomials);
            let sum: f64 = terms.map(|(((_, weight), v), p)| weight * v * p[k]).sum();
            sum * sum * (2 * k + 1) as f64
        };
        (HELD as usize + 1..48).map(part).sum::<f64>().sqrt() / least
    }

    #[test]
    fn no_bore_has_more_in_its_shear_stiffness_than_the_bound() {
        let mut tube = Material::new(700.0, 14e9).unwrap();
        tube.shear_modulus = Some(1e9);
        let mut shown = 0;
        for (outer, inner) in [
            ("0.02 + 0.01*x", "0.015 + 0.012*x"),
            ("0.03", "0.01 + 0.01*exp(-((x - 0.4)/0.05)^2)"),
            ("0.03 + 0.002*sin(30*x)", "0.02 + 0.003*cos(40*x)"),
            ("0.03", "0.029*sqrt(0.1 + x)"),
        ] {
            let [outer, inner] = [outer, inner].map(|text| Formula::parse(text).unwrap());
            for halvings in 0..8 {
                let (from, to) = (0.3, 0.3 + 0.5f64.powi(halvings));
                let (outer, inner) = (outer.clone(), Some(inner.clone()));
                let curves = Curves { outer, inner, from, to, floor: 0.0 };
                let Some(bounds) = curves.bounds(0.0, 1.0) else { continue };
                let (bound, tail) = (bounds.missed_shear(&tube, 1.0, 0.0), tail(&curves, &tube));
                assert!(tail < bound + 1e-13, "{from} {to} {tail:e} {bound:e}");
                shown += usize::from(bound < 1e-6);
            }
        }
        assert!(shown > 10, "{shown}");
    }
}
