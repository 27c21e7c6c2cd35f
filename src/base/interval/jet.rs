//! Which values and which slopes does a function have on a box of the complex plane?
//!
//! The derivative gives a second bound of the values, which is the tighter one on a small box: the mean-value form
//! `f(x) ∈ f(m) + f′([a, b]) (x − m)`.

use std::ops::{Add, Mul, Neg};

use super::{Interval, Rectangle};

/// Values of a function and of its derivative on one box. Operations return `None` where the function is not analytic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet {
    /// Values.
    pub value: Rectangle,
    /// Derivatives.
    pub slope: Rectangle,
}

impl Jet {
    /// A number.
    pub fn constant(value: f64) -> Self {
        Self { value: Rectangle::point(value), slope: Rectangle::point(0.0) }
    }

    /// The variable on a box.
    pub fn variable(value: Rectangle) -> Self {
        Self { value, slope: Rectangle::point(1.0) }
    }

    /// The composition with a function, given its value and its derivative.
    fn chain(self, value: Rectangle, derivative: Rectangle) -> Self {
        Self { value, slope: derivative * self.slope }
    }

    /// `f²`.
    pub fn square(self) -> Self {
        self.chain(self.value.square(), Rectangle::point(2.0) * self.value)
    }

    /// Real values on an interval of half length `half`, by the values and by the mean value around `middle`.
    pub fn range(self, middle: Self, half: f64) -> Interval {
        let around = self.slope.re * Interval::within(half.next_up());
        self.value.re.and(middle.value.re + around)
    }

    /// `1/f`.
    pub fn reciprocal(self) -> Option<Self> {
        let value = self.value.reciprocal()?;
        Some(self.chain(value, -value.square()))
    }

    /// `e^f`.
    pub fn exp(self) -> Self {
        let value = self.value.exp();
        self.chain(value, value)
    }

    /// `ln f`.
    pub fn ln(self) -> Option<Self> {
        Some(self.chain(self.value.ln()?, self.value.steep()))
    }

    /// `√f`.
    pub fn sqrt(self) -> Option<Self> {
        let value = self.value.sqrt()?;
        let twice = Rectangle::point(2.0) * value;
        Some(self.chain(value, twice.steep()))
    }

    /// `sin f`.
    pub fn sin(self) -> Self {
        self.chain(self.value.sin(), self.value.cos())
    }

    /// `cos f`.
    pub fn cos(self) -> Self {
        self.chain(self.value.cos(), -self.value.sin())
    }

    /// `tan f`.
    pub fn tan(self) -> Option<Self> {
        Some(self.sin() * self.cos().reciprocal()?)
    }

    /// `tanh f`.
    pub fn tanh(self) -> Option<Self> {
        let value = self.value.tanh()?;
        Some(self.chain(value, Rectangle::point(1.0) - value.square()))
    }

    /// `f^exponent`: by products where the exponent is a small whole number, else `e^(g ln f)`.
    pub fn power(self, exponent: Self) -> Option<Self> {
        const MOST: f64 = 64.0;
        let n = exponent.value.re.low;
        let whole = exponent == Self::constant(n) && n.fract() == 0.0 && n.abs() <= MOST;
        if !whole {
            return Some((exponent * self.ln()?).exp());
        }
        let count = n.abs() as u32;
        let slope = Rectangle::point(n.abs()) * self.value.powi(count.saturating_sub(1));
        let power = self.chain(self.value.powi(count), slope);
        if n < 0.0 { power.reciprocal() } else { Some(power) }
    }
}

impl Add for Jet {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl Neg for Jet {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}

impl Mul for Jet {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let slope = self.value * other.slope + self.slope * other.value;
        Self { value: self.value * other.value, slope }
    }
}

#[cfg(test)]
mod tests {
    use super::super::*;

    /// Complex arithmetic of plain numbers, from the definitions by `e^z` and `ln z`.
    type C = (f64, f64);

    fn times(a: C, b: C) -> C {
        (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
    }

    fn over(a: C, b: C) -> C {
        let size = b.0 * b.0 + b.1 * b.1;
        let top = times(a, (b.0, -b.1));
        (top.0 / size, top.1 / size)
    }

    fn exp(z: C) -> C {
        (z.0.exp() * z.1.cos(), z.0.exp() * z.1.sin())
    }

    fn ln(z: C) -> C {
        (z.0.hypot(z.1).ln(), z.1.atan2(z.0))
    }

    /// Numbers that look random, in [0, 1).
    fn random(seed: &mut u64) -> f64 {
        *seed =
            seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1_u64 << 53) as f64
    }

    type Named = (&'static str, fn(Jet) -> Option<Jet>, fn(C) -> C);

    const FUNCTIONS: [Named; 9] = [
        ("exp", |f| Some(f.exp()), exp),
        ("ln", Jet::ln, ln),
        ("sqrt", Jet::sqrt, |z| exp(times((0.5, 0.0), ln(z)))),
        (
            "sin",
            |f| Some(f.sin()),
            |z| {
                let (up, down) = (exp((-z.1, z.0)), exp((z.1, -z.0)));
                over((up.0 - down.0, up.1 - down.1), (0.0, 2.0))
            },
        ),
        (
            "cos",
            |f| Some(f.cos()),
            |z| {
                let (up, down) = (exp((-z.1, z.0)), exp((z.1, -z.0)));
                (0.5 * (up.0 + down.0), 0.5 * (up.1 + down.1))
            },
        ),
        ("tanh", Jet::tanh, |z| {
            let (up, down) = (exp(z), exp((-z.0, -z.1)));
            over((up.0 - down.0, up.1 - down.1), (up.0 + down.0, up.1 + down.1))
        }),
        ("reciprocal", Jet::reciprocal, |z| over((1.0, 0.0), z)),
        ("cube", |f| f.power(Jet::constant(3.0)), |z| times(z, times(z, z))),
        ("power", |f| f.power(Jet::constant(-1.7)), |z| exp(times((-1.7, 0.0), ln(z)))),
    ];

    /// The ranges of a box contain the value and the slope at each of its points.
    #[test]
    fn a_box_holds_the_values_and_slopes_at_its_places() {
        let (mut seed, mut held) = (7, 0);
        for _ in 0..4000 {
            let mut number = |size: f64| size * (2.0 * random(&mut seed) - 1.0);
            let (x, y, w, h) = (number(4.0), number(3.0), number(0.5).abs(), number(0.5).abs());
            let real = number(1.0) > 0.3;
            let (y, h) = if real { (0.0, 0.0) } else { (y, h) };
            let side = |low: f64, size: f64| Interval { low, high: low + size };
            let value = Rectangle { re: side(x, w), im: side(y, h) };
            let at = (x + w * 0.5 * (1.0 + number(1.0)), y + h * 0.5 * (1.0 + number(1.0)));
            for (name, of_box, of) in FUNCTIONS {
                let Some(jet) = of_box(Jet::variable(value)) else { continue };
                if real && at.0 <= 0.0 && ["ln", "sqrt", "power"].contains(&name) {
                    continue;
                }
                let exact = of(at);
                // The plain numbers are rounded too, and differences of them lose half the digits.
                let (size, step) = (exact.0.hypot(exact.1), 1e-6);
                let near = |range: Interval, v: f64, slack: f64| {
                    range.low - slack <= v && v <= range.high + slack
                };
                let round = 1e-12 * (size + 1.0);
                assert!(near(jet.value.re, exact.0, round), "{name} {value:?} {at:?} {jet:?}");
                assert!(near(jet.value.im, exact.1, round), "{name} {value:?} {at:?} {jet:?}");
                let (ahead, back) = (of((at.0 + step, at.1)), of((at.0 - step, at.1)));
                let slope = ((ahead.0 - back.0) / 2e-6, (ahead.1 - back.1) / 2e-6);
                let distance = at.0.hypot(at.1);
                let slack = 1e-5 * (1.0 + size) / distance.powi(4).min(1.0);
                assert!(near(jet.slope.re, slope.0, slack), "{name}′ {value:?} {at:?} {jet:?}");
                assert!(near(jet.slope.im, slope.1, slack), "{name}′ {value:?} {at:?} {jet:?}");
                held += 1;
            }
        }
        assert!(held > 20_000, "{held}");
    }

    #[test]
    fn ranges_of_small_boxes_are_narrow() {
        let side = |low: f64| Interval { low, high: low + 1e-6 };
        for value in [Rectangle::real(side(0.7)), Rectangle { re: side(0.7), im: side(0.4) }] {
            for (name, of_box, _) in FUNCTIONS {
                let jet = of_box(Jet::variable(value)).unwrap();
                let width = |range: Interval| range.high - range.low;
                assert!(width(jet.value.re) < 3e-5 && width(jet.value.im) < 3e-5, "{name} {jet:?}");
                assert!(width(jet.slope.re) < 1e-4 && width(jet.slope.im) < 1e-4, "{name} {jet:?}");
            }
        }
    }

    #[test]
    fn where_a_function_is_not_analytic_there_is_no_bound() {
        let around = Rectangle { re: Interval::within(1.0), im: Interval::within(1.0) };
        for of_box in [Jet::sqrt, Jet::ln, Jet::reciprocal] {
            assert!(of_box(Jet::variable(around)).is_none());
        }
        assert!(Jet::variable(Rectangle::real(Interval { low: 0.0, high: 1.0 })).sqrt().is_some());
    }
}
