//! Which values does a function take on a box of the complex plane?
//!
//! Functions of a box are bounded through their real and imaginary parts, each an [`Interval`]. Where a function is not
//! analytic it has no bound.

use std::f64::consts::FRAC_PI_2;
use std::ops::{Add, Mul, Neg};

use super::{Interval, LIBRARY};

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

    /// Whether the whole box lies on the real axis.
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

    /// `1/z`, if the box does not contain 0.
    pub(super) fn reciprocal(self) -> Option<Self> {
        if self.is_real() {
            return self.re.reciprocal().map(Self::real);
        }
        let one_over = (self.re.square() + self.im.square()).reciprocal()?;
        let within = Interval::within(one_over.high.sqrt().next_up());
        let part = |part: Interval| (part * one_over).and(within);
        Some(Self { re: part(self.re), im: part(-self.im) })
    }

    /// `1/z` for a slope: unbounded if the box contains 0, and not negative if `z` is not negative.
    pub(super) fn steep(self) -> Self {
        let all = Interval::within(f64::INFINITY);
        match self.reciprocal() {
            Some(over) => over,
            None if self.is_real() && self.re.low >= 0.0 => {
                Self::real(Interval { low: (1.0 / self.re.high).next_down(), ..all })
            }
            None => Self { re: all, im: if self.is_real() { self.im } else { all } },
        }
    }

    /// Angles in (−π, π), if the box does not touch the real axis at or left of 0.
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

    pub(super) fn exp(self) -> Self {
        let size = self.re.exp();
        Self { re: size * self.im.cos(), im: size * self.im.sin() }
    }

    pub(super) fn ln(self) -> Option<Self> {
        if self.is_real() {
            return (self.re.high > 0.0).then(|| Self::real(self.re.ln()));
        }
        Some(Self { re: self.modulus().ln(), im: self.angle()? })
    }

    pub(super) fn sqrt(self) -> Option<Self> {
        if self.is_real() {
            return (self.re.high >= 0.0).then(|| Self::real(self.re.sqrt()));
        }
        let (size, angle) = (self.modulus().sqrt(), self.angle()? * Interval::point(0.5));
        Some(Self { re: size * angle.cos(), im: size * angle.sin() })
    }

    pub(super) fn sin(self) -> Self {
        let Self { re, im } = self;
        Self { re: re.sin() * im.cosh(), im: re.cos() * im.sinh() }
    }

    pub(super) fn cos(self) -> Self {
        let Self { re, im } = self;
        Self { re: re.cos() * im.cosh(), im: -(re.sin() * im.sinh()) }
    }

    /// `tanh z = 1 − 2/(e^{2z} + 1)`, an odd function within `2/(e^{2 Re z} − 1)` of 1.
    pub(super) fn tanh(self) -> Option<Self> {
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

    /// A whole power, 0 or more.
    pub(super) fn powi(self, n: u32) -> Self {
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

impl Mul for Rectangle {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let (a, b) = (self, other);
        Self { re: a.re * b.re - a.im * b.im, im: a.re * b.im + a.im * b.re }
    }
}
