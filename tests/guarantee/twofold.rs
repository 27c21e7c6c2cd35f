//! Numbers of twice the digits, as unevaluated sums of two doubles.
//!
//! Source: T. J. Dekker, Numer. Math. 18 (1971) 224; D. E. Knuth, The Art of Computer Programming 2, 4.2.2.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// `high + low`, right to about 30 digits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twofold {
    pub high: f64,
    pub low: f64,
}

/// `a + b` exactly, as the rounded sum and the rounding error.
pub fn two_sum(a: f64, b: f64) -> [f64; 2] {
    let sum = a + b;
    let of_b = sum - a;
    [sum, (a - (sum - of_b)) + (b - of_b)]
}

/// `a b` exactly, as the rounded product and the rounding error, away from the ends of the range.
pub fn two_product(a: f64, b: f64) -> [f64; 2] {
    let product = a * b;
    [product, a.mul_add(b, -product)]
}

pub fn number(value: f64) -> Twofold {
    Twofold { high: value, low: 0.0 }
}

impl Twofold {
    fn of([high, low]: [f64; 2]) -> Self {
        let [high, low] = two_sum(high, low);
        Self { high, low }
    }

    /// Its difference from a double.
    pub fn less(self, value: f64) -> f64 {
        (self - number(value)).high
    }
}

impl Add for Twofold {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let [sum, off] = two_sum(self.high, other.high);
        let [low, rest] = two_sum(self.low, other.low);
        let [sum, off] = two_sum(sum, off + low);
        Self::of([sum, off + rest])
    }
}

impl Neg for Twofold {
    type Output = Self;

    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for Twofold {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Twofold {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let [product, off] = two_product(self.high, other.high);
        Self::of([product, off + (self.high * other.low + self.low * other.high)])
    }
}

impl Div for Twofold {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - number(first) * other;
        let second = rest.high / other.high;
        let rest = rest - number(second) * other;
        Self::of([first, second]) + number(rest.high / other.high)
    }
}

/// `P_0 … P_{count−1}` at x.
pub fn legendre(count: usize, x: Twofold) -> Vec<Twofold> {
    let mut all = vec![number(1.0), x];
    for j in 1..count.max(2) - 1 {
        let above = number((2 * j + 1) as f64) * x * all[j] - number(j as f64) * all[j - 1];
        all.push(above / number((j + 1) as f64));
    }
    all
}
