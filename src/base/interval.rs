//! Which values can an expression take on an interval, or on a box of the complex plane?
//!
//! [`Interval`] and [`Rectangle`] hold every value that exact arithmetic could give: results are
//! rounded outwards, by one place after `+ − × ÷ √` and by `LIBRARY` after other functions. A
//! [`Jet`] carries the derivative along, so that a range can be had from its middle too:
//! `f(x) ∈ f(m) + f′([a, b]) (x − m)`.
//!
//! # Source
//!
//! R. E. Moore, Interval Analysis (Prentice-Hall, 1966): interval arithmetic, the mean-value form.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::{Add, Mul, Neg, Sub};

/// Relative error allowed to `exp`, `sin` and the other functions of the system's library.
const LIBRARY: f64 = 8.0 * f64::EPSILON;

/// All numbers from `low` to `high`; an infinite end stands for a number too large to write.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

impl Interval {
    /// One number.
    pub fn point(value: f64) -> Self {
        Self { low: value, high: value }
    }

    /// From −`size` to `size`.
    pub fn within(size: f64) -> Self {
        Self { low: -size, high: size }
    }

    /// An interval whose ends were rounded once; 0 is taken to be exact.
    fn rounded(low: f64, high: f64) -> Self {
        let low = if low.is_nan() { f64::NEG_INFINITY } else { low };
        let high = if high.is_nan() { f64::INFINITY } else { high };
        let down = if low == 0.0 { low } else { low.next_down() };
        let up = if high == 0.0 { high } else { high.next_up() };
        Self { low: down, high: up }
    }

    /// An interval whose ends come from the system's library.
    fn library(low: f64, high: f64) -> Self {
        Self::rounded(low - LIBRARY * low.abs(), high + LIBRARY * high.abs())
    }

    /// Whether it is the number 0.
    fn is_zero(self) -> bool {
        self.low == 0.0 && self.high == 0.0
    }

    /// Whether `value` is in it.
    pub fn contains(self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    /// The largest absolute value.
    pub fn largest(self) -> f64 {
        f64::max(-self.low, self.high)
    }

    /// The smallest absolute value.
    pub fn smallest(self) -> f64 {
        f64::max(0.0, f64::max(self.low, -self.high))
    }

    /// What two enclosures of one number leave.
    pub fn and(self, other: Self) -> Self {
        Self { low: self.low.max(other.low), high: self.high.min(other.high) }
    }

    /// The square, which is not negative.
    pub fn square(self) -> Self {
        let (small, large) = (self.smallest(), self.largest());
        let square = Self::rounded(small * small, large * large);
        Self { low: square.low.max(0.0), ..square }
    }

    /// The square root of what is not negative of it.
    fn sqrt(self) -> Self {
        let root = Self::rounded(self.low.max(0.0).sqrt(), self.high.max(0.0).sqrt());
        Self { low: root.low.max(0.0), ..root }
    }

    /// `1/x`, if 0 is not in it.
    fn reciprocal(self) -> Option<Self> {
        (self.low > 0.0 || self.high < 0.0).then(|| Self::rounded(1.0 / self.high, 1.0 / self.low))
    }

    fn exp(self) -> Self {
        let exp = Self::library(self.low.exp(), self.high.exp());
        Self { low: exp.low.max(0.0), ..exp }
    }

    /// The logarithm of what is positive of it.
    fn ln(self) -> Self {
        Self::library(self.low.max(0.0).ln(), self.high.ln())
    }

    fn sinh(self) -> Self {
        Self::library(self.low.sinh(), self.high.sinh())
    }

    fn cosh(self) -> Self {
        Self::library(self.smallest().cosh(), self.largest().cosh())
    }

    fn tanh(self) -> Self {
        Self::library(self.low.tanh(), self.high.tanh()).and(Self::within(1.0))
    }

    fn sin(self) -> Self {
        Self { low: self.low - FRAC_PI_2, high: self.high - FRAC_PI_2 }.wave(self, f64::sin)
    }

    fn cos(self) -> Self {
        self.wave(self, f64::cos)
    }

    /// A wave whose crests lie where this is a multiple of 2π, by its values at the ends of `at`.
    fn wave(self, at: Self, wave: fn(f64) -> f64) -> Self {
        // Beyond that a period is no longer told from the next.
        const FARTHEST: f64 = 1e12;
        let all = Self::within(1.0);
        let span = at.high - at.low;
        if span.is_nan() || span >= TAU || at.largest() > FARTHEST {
            return all;
        }
        let (a, b) = (wave(at.low), wave(at.high));
        let crosses =
            |shift: f64| ((self.low - shift) / TAU).floor() < ((self.high - shift) / TAU).floor();
        let low = if crosses(PI) { -1.0 } else { a.min(b) };
        let high = if crosses(0.0) { 1.0 } else { a.max(b) };
        // The places of crests are rounded too: near one the wave is flat.
        let round = f64::EPSILON * (1.0 + at.largest());
        Self::library(low - round * round, high + round * round).and(all)
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        match (self.is_zero(), other.is_zero()) {
            (true, _) => other,
            (_, true) => self,
            _ => Self::rounded(self.low + other.low, self.high + other.high),
        }
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        if self == Self::point(1.0) {
            return other;
        }
        // 0 times a number too large to write is 0.
        let times = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let corners = [
            times(self.low, other.low),
            times(self.low, other.high),
            times(self.high, other.low),
            times(self.high, other.high),
        ];
        let low = corners.into_iter().fold(f64::INFINITY, f64::min);
        Self::rounded(low, corners.into_iter().fold(f64::NEG_INFINITY, f64::max))
    }
}

/// A box of the complex plane; an interval of real numbers where the imaginary part is 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    /// Real parts.
    pub re: Interval,
    /// Imaginary parts.
    pub im: Interval,
}

impl Rectangle {
    /// An interval of real numbers.
    pub fn real(re: Interval) -> Self {
        Self { re, im: Interval::point(0.0) }
    }

    /// One real number.
    pub fn point(value: f64) -> Self {
        Self::real(Interval::point(value))
    }

    /// Whether all of it is real.
    fn is_real(self) -> bool {
        self.im.is_zero()
    }

    /// Absolute values.
    pub fn modulus(self) -> Interval {
        (self.re.square() + self.im.square()).sqrt()
    }

    /// The squares.
    pub fn square(self) -> Self {
        let twice = Interval::point(2.0) * self.re * self.im;
        Self { re: self.re.square() - self.im.square(), im: twice }
    }

    /// `1/z`, if 0 is not in it.
    fn reciprocal(self) -> Option<Self> {
        if self.is_real() {
            return self.re.reciprocal().map(Self::real);
        }
        let one_over = (self.re.square() + self.im.square()).reciprocal()?;
        let within = Interval::within(one_over.high.sqrt().next_up());
        let part = |part: Interval| (part * one_over).and(within);
        Some(Self { re: part(self.re), im: part(-self.im) })
    }

    /// `1/z` for a slope: where 0 is in it, without bound; of what is not negative, not negative.
    fn steep(self) -> Self {
        let all = Interval::within(f64::INFINITY);
        match self.reciprocal() {
            Some(over) => over,
            None if self.is_real() && self.re.low >= 0.0 => {
                Self::real(Interval { low: (1.0 / self.re.high).next_down(), ..all })
            }
            None => Self { re: all, im: if self.is_real() { self.im } else { all } },
        }
    }

    /// Angles in (−π, π), if the box does not touch the real axis left of and at 0.
    fn angle(self) -> Option<Interval> {
        let Self { re, im } = self;
        let right = |re: Interval, im: Interval| {
            let low = im.low.atan2(if im.low < 0.0 { re.low } else { re.high });
            let high = im.high.atan2(if im.high > 0.0 { re.low } else { re.high });
            Interval::library(low, high)
        };
        let quarter = Interval::library(FRAC_PI_2, FRAC_PI_2);
        if re.low > 0.0 {
            Some(right(re, im))
        } else if im.low > 0.0 {
            Some(right(im, -re) + quarter)
        } else if im.high < 0.0 {
            Some(right(-im, re) - quarter)
        } else {
            None
        }
    }

    fn exp(self) -> Self {
        let size = self.re.exp();
        Self { re: size * self.im.cos(), im: size * self.im.sin() }
    }

    fn ln(self) -> Option<Self> {
        if self.is_real() {
            return (self.re.high > 0.0).then(|| Self::real(self.re.ln()));
        }
        Some(Self { re: self.modulus().ln(), im: self.angle()? })
    }

    fn sqrt(self) -> Option<Self> {
        if self.is_real() {
            return (self.re.high >= 0.0).then(|| Self::real(self.re.sqrt()));
        }
        let (size, angle) = (self.modulus().sqrt(), self.angle()? * Interval::point(0.5));
        Some(Self { re: size * angle.cos(), im: size * angle.sin() })
    }

    fn sin(self) -> Self {
        let Self { re, im } = self;
        Self { re: re.sin() * im.cosh(), im: re.cos() * im.sinh() }
    }

    fn cos(self) -> Self {
        let Self { re, im } = self;
        Self { re: re.cos() * im.cosh(), im: -(re.sin() * im.sinh()) }
    }

    /// `tanh z = 1 − 2/(e^{2z} + 1)`, an odd function that is within `2/(e^{2 Re z} − 1)` of 1.
    fn tanh(self) -> Option<Self> {
        if self.is_real() {
            return Some(Self::real(self.re.tanh()));
        }
        if self.re.high < 0.0 {
            return Some(-(-self).tanh()?);
        }
        let (one, two) = (Self::point(1.0), Self::point(2.0));
        if self.re.low > 1.0 {
            let near = Interval::within(2.0 / (2.0 * self.re.low).exp_m1() * (1.0 + LIBRARY));
            return Some(Self { re: Interval::point(1.0) + near, im: near });
        }
        Some(one - two * ((two * self).exp() + one).reciprocal()?)
    }

    /// A whole power from 0 on.
    fn powi(self, n: u32) -> Self {
        match n {
            0 => Self::point(1.0),
            1 => self,
            _ if n.is_multiple_of(2) => self.square().powi(n / 2),
            _ => self * self.powi(n - 1),
        }
    }
}

impl Add for Rectangle {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl Neg for Rectangle {
    type Output = Self;

    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im }
    }
}

impl Sub for Rectangle {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Rectangle {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let (a, b) = (self, other);
        Self { re: a.re * b.re - a.im * b.im, im: a.re * b.im + a.im * b.re }
    }
}

/// Values of a function and of its derivative on one box. A function that is not analytic there is
/// `None`.
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

    /// A function of it, from its value and its derivative.
    fn chain(self, value: Rectangle, derivative: Rectangle) -> Self {
        Self { value, slope: derivative * self.slope }
    }

    /// `f²`.
    pub fn square(self) -> Self {
        self.chain(self.value.square(), Rectangle::point(2.0) * self.value)
    }

    /// Real values on an interval of half that length around where `middle` is, by the mean value
    /// too.
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

impl Sub for Jet {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
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
    use super::*;

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

    /// Every value and every slope at a place of a box is in what the box gives.
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
    fn waves_reach_their_crests_and_steep_steps_their_ends() {
        let wave = Interval { low: 1.0, high: 2.0 }.sin();
        assert!(wave.contains(1.0) && wave.low > 0.84, "{wave:?}");
        assert_eq!(Interval { low: 3.0, high: 10.0 }.cos(), Interval::within(1.0));
        let far = Rectangle { re: Interval { low: 400.0, high: 1e6 }, im: Interval::within(3e5) };
        let step = far.tanh().unwrap();
        assert!(step.re.contains(1.0) && step.modulus().high < 1.0 + 1e-12, "{step:?}");
        assert!(
            Rectangle { re: Interval::within(0.1), im: Interval::within(2.0) }.tanh().is_none()
        );
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
