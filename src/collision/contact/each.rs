//! One number for each of several places that are hit side by side, and the functions that a contact needs of them.
//!
//! These are plain loops over arrays, which the compiler turns into vector instructions. They use only operations that
//! every machine rounds alike, so that a place has the same bits in every lane and whatever the other lanes contain.
//!
//! # Source
//!
//! Reduction by parts of π/2: W. J. Cody, W. Waite, Software Manual for the Elementary Functions (1980).

use crate::base::lanes::{arithmetic, in_every_lane};

/// One number for each place; a condition is 1 where it holds and 0 elsewhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Each<const W: usize>(pub [f64; W]);

arithmetic! { [const W: usize] Each<W>, Each, W }

macro_rules! each {
    ($k:ident => $value:expr) => {
        Each(in_every_lane!(W, $k => $value))
    };
}

impl<const W: usize> Default for Each<W> {
    #[inline(always)]
    fn default() -> Self {
        Self([0.0; W])
    }
}

impl<const W: usize> Each<W> {
    /// That number for every place.
    #[inline(always)]
    pub fn all(value: f64) -> Self {
        Self([value; W])
    }

    /// The smaller of both.
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        each!(k => if self.0[k] < other.0[k] { self.0[k] } else { other.0[k] })
    }

    /// The larger of both.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        each!(k => if self.0[k] > other.0[k] { self.0[k] } else { other.0[k] })
    }

    /// Its size.
    #[inline(always)]
    pub fn abs(self) -> Self {
        each!(k => self.0[k].abs())
    }

    /// Its square root.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        each!(k => self.0[k].sqrt())
    }

    /// Where it is less than the other; not where either is not a number.
    #[inline(always)]
    pub fn below(self, other: Self) -> Self {
        each!(k => if self.0[k] < other.0[k] { 1.0 } else { 0.0 })
    }

    /// Condition: at most the other. False if either is NaN.
    #[inline(always)]
    pub fn within(self, other: Self) -> Self {
        each!(k => if self.0[k] <= other.0[k] { 1.0 } else { 0.0 })
    }

    /// Where both conditions hold.
    #[inline(always)]
    pub fn and(self, other: Self) -> Self {
        self * other
    }

    /// Where either condition holds.
    #[inline(always)]
    pub fn or(self, other: Self) -> Self {
        self.max(other)
    }

    /// Where a condition does not hold.
    #[inline(always)]
    pub fn fails(self) -> Self {
        each!(k => 1.0 - self.0[k])
    }

    /// `then` where this condition holds, `otherwise` elsewhere.
    #[inline(always)]
    pub fn choose(self, then: Self, otherwise: Self) -> Self {
        each!(k => if self.0[k] != 0.0 { then.0[k] } else { otherwise.0[k] })
    }

    /// Whether a condition holds everywhere.
    #[inline(always)]
    pub fn everywhere(self) -> bool {
        let mut least = 1.0_f64;
        let mut k = 0;
        while k < W {
            least = if self.0[k] < least { self.0[k] } else { least };
            k += 1;
        }
        least > 0.0
    }

    /// Whether a condition holds somewhere.
    #[inline(always)]
    pub fn somewhere(self) -> bool {
        !self.fails().everywhere()
    }

    /// The power `p` of several positive, normal numbers at once: `2^(p log₂ x)`, within about `p` ε log₂ x; 0 below
    /// `2^−1000`.
    #[inline(always)]
    pub fn powers<const N: usize>(numbers: [Self; N], p: Self) -> [Self; N] {
        let mut powers = Self::logarithms(numbers);
        for power in &mut powers {
            *power = *power * p;
        }
        Self::exponentials(powers)
    }

    /// `log₂`: the exponent, and `2 artanh s` of a mantissa between `√½` and `√2`, `s = (m − 1)/(m + 1)`, divided by
    /// ln 2, by a polynomial of `s²` through Chebyshev's points.
    #[inline(always)]
    fn logarithms<const N: usize>(numbers: [Self; N]) -> [Self; N] {
        /// The bits of `√½`, and of 1.
        const ROOT: u64 = 0x3fe6_a09e_667f_3bcd;
        const ONE: u64 = 0x3ff0_0000_0000_0000;
        /// `2^52`: a whole number below it is in its last bits.
        const WHOLE: u64 = 0x4330_0000_0000_0000;
        const SERIES: [f64; 8] = [
            2.8853900817779268,
            0.9617966939259898,
            0.5770780163455203,
            0.4121985858409005,
            0.32059853491395984,
            0.262334352504183,
            0.2209130842311768,
            0.2136589569431927,
        ];
        let (mut whole, mut s) = ([Self::default(); N], [Self::default(); N]);
        for i in 0..N {
            let bits = numbers[i].0;
            whole[i] = each!(k => {
                let up = bits[k].to_bits().wrapping_add(ONE - ROOT) >> 52;
                f64::from_bits(up | WHOLE) - (4_503_599_627_370_496.0 + 1023.0)
            });
            let mantissa = each!(k => {
                let up = bits[k].to_bits().wrapping_add(ONE - ROOT) >> 52;
                f64::from_bits(bits[k].to_bits().wrapping_sub(up.wrapping_sub(1023) << 52))
            });
            s[i] = (mantissa - 1.0) / (mantissa + 1.0);
        }
        let sum = polynomials(&SERIES, s.map(|s| s * s));
        for i in 0..N {
            whole[i] += s[i] * sum[i];
        }
        whole
    }

    /// `2^y` by a polynomial of the part left by the nearest whole number, through Chebyshev's points; 0 below −1000.
    #[inline(always)]
    fn exponentials<const N: usize>(y: [Self; N]) -> [Self; N] {
        const SERIES: [f64; 12] = [
            1.0,
            std::f64::consts::LN_2,
            0.24022650695910158,
            0.055504108664821625,
            0.009618129107587256,
            0.001333355814640647,
            0.00015403530463724353,
            1.5252733841556773e-5,
            1.3215432535912375e-6,
            1.0178057087733941e-7,
            7.074194297288521e-9,
            4.4558179083360645e-10,
        ];
        let (mut whole, mut rest) = ([[0; W]; N], [Self::default(); N]);
        for i in 0..N {
            (whole[i], rest[i]) = y[i].max(Self::all(-1001.0)).min(Self::all(1001.0)).nearest();
        }
        let mut sum = polynomials(&SERIES, rest);
        for i in 0..N {
            let (bits, own) = (whole[i], sum[i].0);
            let scaled = each!(k => own[k] * f64::from_bits(bits[k].wrapping_add(1023) << 52));
            sum[i] = y[i].below(Self::all(-1000.0)).choose(Self::default(), scaled);
        }
        sum
    }

    /// The nearest whole number, as an integer in the low bits, and the remainder.
    #[inline(always)]
    fn nearest(self) -> ([u64; W], Self) {
        /// `1.5 · 2^52`: a number added to it is rounded to a whole one.
        const ROUND: f64 = 6_755_399_441_055_744.0;
        let (mut bits, up) = ([0; W], self + ROUND);
        let mut k = 0;
        while k < W {
            bits[k] = up.0[k].to_bits();
            k += 1;
        }
        (bits, self - (up - ROUND))
    }

    /// Sine and cosine, of up to about a million.
    #[inline(always)]
    pub fn sin_cos(self) -> [Self; 2] {
        /// π/2 in parts whose products with a whole number below a million are exact.
        const HIGH: f64 = f64::from_bits(0x3ff9_21fb_5440_0000);
        const MIDDLE: f64 = f64::from_bits(0x3dd0_b461_1a60_0000);
        const LOW: f64 = f64::from_bits(0x3ba3_198a_2e03_7073);
        /// `sin r/r` and `cos r` below π/4 as polynomials of `r²` through Chebyshev's points.
        const SINE: [f64; 7] = [
            1.0,
            -0.16666666666666616,
            0.008333333333320363,
            -0.000198412698286503,
            2.755731337640013e-06,
            -2.5050716974102745e-08,
            1.5894736651849094e-10,
        ];
        const COSINE: [f64; 8] = [
            1.0,
            -0.5,
            0.04166666666666645,
            -0.0013888888888861095,
            2.4801587283881152e-05,
            -2.7557313097790086e-07,
            2.0875582380663952e-09,
            -1.1353379638297575e-11,
        ];
        let (quarter, rest) = (self * std::f64::consts::FRAC_2_PI).nearest();
        let count = self * std::f64::consts::FRAC_2_PI - rest;
        let r = self - count * HIGH - count * MIDDLE - count * LOW;
        let square = r * r;
        let [sine] = polynomials(&SINE, [square]);
        let [cosine] = polynomials(&COSINE, [square]);
        let sine = sine * r;
        let sin = each!(k => {
            let size = if quarter[k] & 1 != 0 { cosine.0[k] } else { sine.0[k] };
            if quarter[k] & 2 != 0 { -size } else { size }
        });
        let cos = each!(k => {
            let size = if quarter[k] & 1 != 0 { sine.0[k] } else { cosine.0[k] };
            if quarter[k].wrapping_add(1) & 2 != 0 { -size } else { size }
        });
        [sin, cos]
    }
}

/// Polynomials with those coefficients, the lowest first.
#[inline(always)]
fn polynomials<const N: usize, const W: usize>(
    coefficients: &[f64],
    x: [Each<W>; N],
) -> [Each<W>; N] {
    let last = coefficients.len() - 1;
    let mut sum = [Each::all(coefficients[last]); N];
    for k in (0..last).rev() {
        for i in 0..N {
            sum[i] = sum[i] * x[i] + coefficients[k];
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::golden;

    /// Equal to the machine's own functions within some roundings, for numbers of every size.
    #[test]
    fn powers_and_angles_are_those_of_the_machine() {
        for k in 0..20_000 {
            let x: Each<4> = Each(std::array::from_fn(|l| {
                let at = golden::fraction(4 * k + l);
                [at, 1e-300_f64.powf(at), 1.0 + 1e-9 * at, 40.0 * at][l % 4]
            }));
            let p: Each<4> =
                Each(std::array::from_fn(|l| 1.0 + 10.0 * golden::fraction(7 * k + l)));
            let (power, [sin, cos]) = (Each::powers([x], p)[0], (x * 1000.0).sin_cos());
            for l in 0..4 {
                let (x, p) = (x.0[l], p.0[l]);
                let exact = x.powf(p);
                // The rounding of the exponent is amplified.
                let off = 1e-15 + 3e-16 * p * x.ln().abs();
                assert!(
                    (power.0[l] - exact).abs() <= off * exact + 1e-300,
                    "{x}^{p} {}",
                    power.0[l]
                );
                let angle = 1000.0 * x;
                assert!((sin.0[l] - angle.sin()).abs() < 4e-16, "sin {angle}");
                assert!((cos.0[l] - angle.cos()).abs() < 4e-16, "cos {angle}");
            }
        }
    }

    #[test]
    fn conditions_choose() {
        let a = Each([1.0, -2.0, f64::NAN, 0.0]);
        let less = a.below(Each::all(0.5));
        assert_eq!(less.0, [0.0, 1.0, 0.0, 1.0]);
        assert_eq!(less.fails().0, [1.0, 0.0, 1.0, 0.0]);
        assert_eq!(less.choose(Each::all(3.0), Each::all(4.0)).0, [4.0, 3.0, 4.0, 3.0]);
        assert!(less.somewhere() && !less.everywhere() && less.or(less.fails()).everywhere());
        assert!(!less.and(less.fails()).somewhere());
    }
}
