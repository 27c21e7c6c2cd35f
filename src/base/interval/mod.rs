//! Which values can an expression take on an interval, or on a box of the complex plane?
//!
//! [`Interval`] and [`Rectangle`] hold every value that exact arithmetic could give: results are
//! rounded outwards, by one place after `+ − × ÷ √` and by `LIBRARY` after other functions. A
//! [`Jet`] carries the derivative along, so that a range follows from its middle too.
//!
//! # Source
//!
//! R. E. Moore, Interval Analysis (Prentice-Hall, 1966): interval arithmetic, the mean-value form.
//! S. M. Rump, P. Zimmermann, S. Boldo, G. Melquiond, BIT 49 (2009) 419: one place outwards without a
//! branch.

mod rectangle;
mod jet;

pub use jet::Jet;
pub use rectangle::Rectangle;

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::iter::Sum;
use std::ops::{Add, Mul, Neg, Sub};

/// Relative error allowed to `exp`, `sin` and the other functions of the system's library.
const LIBRARY: f64 = 8.0 * f64::EPSILON;

/// Unit round-off `u = 2⁻⁵³`: an operation's result is off by at most this share of it.
pub const UNIT: f64 = 0.5 * f64::EPSILON;
/// `φ = u (1 + 2u)`, with which one place outwards is one multiplication and two sums.
const PHI: f64 = UNIT * (1.0 + 2.0 * UNIT);
/// `η`, the least number above 0.
const LEAST: f64 = f64::from_bits(1);

/// A number below every real number that rounds to this one, `x − (φ|x| + η)`.
pub fn down(x: f64) -> f64 {
    let below = x - (PHI * x.abs() + LEAST);
    match below.is_nan() {
        false => below,
        // A number too large to represent is known only to be large.
        true if x == f64::INFINITY => f64::MAX,
        true => f64::NEG_INFINITY,
    }
}

/// A number above every real number that rounds to this one, `x + (φ|x| + η)`.
pub fn up(x: f64) -> f64 {
    -down(-x)
}

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

    /// The interval from −`size` to `size`.
    pub fn within(size: f64) -> Self {
        Self { low: -size, high: size }
    }

    /// The interval of the numbers within the relative distance `share` of `value`.
    pub fn around(value: f64, share: f64) -> Self {
        Self::point(value) + Self::within(up(share * value.abs()))
    }

    /// π.
    pub fn pi() -> Self {
        // The double nearest to π is below it.
        Self { low: PI, high: PI.next_up() }
    }

    /// An interval whose ends were rounded once, where a result of 0 is exact.
    fn rounded(low: f64, high: f64) -> Self {
        let low = if low == 0.0 { low } else { down(low) };
        Self { low, high: if high == 0.0 { high } else { up(high) } }
    }

    /// An interval whose ends come from the system's library.
    fn library(low: f64, high: f64) -> Self {
        Self::rounded(low - LIBRARY * low.abs(), high + LIBRARY * high.abs())
    }

    /// Whether this is exactly the number 0.
    fn is_zero(self) -> bool {
        self.low == 0.0 && self.high == 0.0
    }

    /// Whether the interval contains `value`.
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

    /// The intersection of two enclosures of one number.
    pub fn and(self, other: Self) -> Self {
        Self { low: self.low.max(other.low), high: self.high.min(other.high) }
    }

    /// The number in the middle, to round-off.
    pub fn middle(self) -> f64 {
        0.5 * self.low + 0.5 * self.high
    }

    /// The largest distance of a number in the interval from `value`.
    pub fn distance(self, value: f64) -> f64 {
        f64::max(up(self.high - value), up(value - self.low)).max(0.0)
    }

    /// The smallest interval that holds both.
    pub fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The square, never negative.
    pub fn square(self) -> Self {
        let (small, large) = (self.smallest(), self.largest());
        let high = if large == 0.0 { 0.0 } else { up(large * large) };
        Self { low: down(small * small).max(0.0), high }
    }

    /// The square root of the part that is not negative.
    pub fn sqrt(self) -> Self {
        let root = Self::rounded(self.low.max(0.0).sqrt(), self.high.max(0.0).sqrt());
        Self { low: root.low.max(0.0), ..root }
    }

    /// `1/x`, if the interval does not contain 0.
    pub fn reciprocal(self) -> Option<Self> {
        (self.low > 0.0 || self.high < 0.0).then(|| Self::rounded(1.0 / self.high, 1.0 / self.low))
    }

    fn exp(self) -> Self {
        let exp = Self::library(self.low.exp(), self.high.exp());
        Self { low: exp.low.max(0.0), high: exp.high.max(f64::MIN_POSITIVE) }
    }

    /// The logarithm of the positive part.
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

    /// The range of a wave with crests where this is a multiple of 2π, given its values at the ends of `at`.
    fn wave(self, at: Self, wave: fn(f64) -> f64) -> Self {
        // Beyond this size, rounding exceeds a period.
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
        // The places of crests are rounded too: near a crest the wave is flat.
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

/// Subtraction is addition of the negative.
macro_rules! differences {
    ($($of:ty)*) => {$(
        impl Sub for $of {
            type Output = Self;

            fn sub(self, other: Self) -> Self {
                self + -other
            }
        }
    )*};
}

differences! { Interval Rectangle Jet }

impl Sum for Interval {
    fn sum<I: Iterator<Item = Self>>(numbers: I) -> Self {
        numbers.fold(Self::point(0.0), Self::add)
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        if self == Self::point(1.0) {
            return other;
        }
        let corners = [
            (self.low, other.low),
            (self.low, other.high),
            (self.high, other.low),
            (self.high, other.high),
        ];
        // 0 times a number too large to represent is 0; a product that rounds to 0 is not exactly 0.
        let round = |(a, b): (f64, f64)| match a == 0.0 || b == 0.0 {
            true => Self::point(0.0),
            false => Self { low: down(a * b), high: up(a * b) },
        };
        corners.into_iter().map(round).reduce(Self::hull).expect("there are four corners")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A number that may be either side of 0 has a reciprocal of any size; the middle is half of the sum of the ends.
    #[test]
    fn middles_and_steep_slopes_are_those_of_their_ends() {
        assert_eq!(Interval { low: 2.0, high: 4.0 }.middle(), 3.0);
        let steep = Rectangle::real(Interval::within(1.0)).steep().re;
        assert_eq!((steep.low, steep.high), (f64::NEG_INFINITY, f64::INFINITY));
        let steep = Rectangle::real(Interval { low: 0.0, high: 2.0 }).steep().re;
        assert!(steep.low <= 0.5 && steep.low > 0.49 && steep.high == f64::INFINITY);
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
}
