//! Complex numbers, and the fast transform of a power of two of them.

use std::f64::consts::TAU;
use std::ops::{Add, Div, Mul, Sub};

/// A complex number.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Complex {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
}

impl Complex {
    /// One.
    pub const ONE: Self = Self { re: 1.0, im: 0.0 };

    /// The number `re + i im`.
    pub fn new(re: f64, im: f64) -> Self {
        Self { re, im }
    }

    /// `e^{i angle}`.
    pub fn turn(angle: f64) -> Self {
        Self::new(angle.cos(), angle.sin())
    }

    /// The exponential.
    pub fn exp(self) -> Self {
        Self::turn(self.im) * self.re.exp()
    }

    /// The natural logarithm whose angle is from -π to π.
    pub fn ln(self) -> Self {
        Self::new(0.5 * self.square().ln(), self.im.atan2(self.re))
    }

    /// The root with a real part of 0 or more.
    pub fn sqrt(self) -> Self {
        Self::turn(0.5 * self.im.atan2(self.re)) * self.square().sqrt().sqrt()
    }

    /// The conjugate.
    pub fn conj(self) -> Self {
        Self::new(self.re, -self.im)
    }

    /// The square of its size.
    pub fn square(self) -> f64 {
        self.re * self.re + self.im * self.im
    }
}

impl Add for Complex {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }
}

impl Sub for Complex {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.re - other.re, self.im - other.im)
    }
}

impl Mul for Complex {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)
    }
}

impl Mul<f64> for Complex {
    type Output = Self;
    fn mul(self, by: f64) -> Self {
        Self::new(self.re * by, self.im * by)
    }
}

impl Div for Complex {
    type Output = Self;
    fn div(self, by: Self) -> Self {
        self * by.conj() * (1.0 / by.square())
    }
}

/// The power spectrum `|Σ x_n e^{-2πi kn/N}|²`, k from 0 to N/2, of real samples that zeros fill to N, the next power
/// of two.
pub fn power(samples: &[f64]) -> Vec<f64> {
    let length = samples.len().next_power_of_two();
    let mut values: Vec<Complex> = samples.iter().map(|x| Complex::new(*x, 0.0)).collect();
    values.resize(length, Complex::default());
    transform(&mut values);
    values[..=length / 2].iter().map(|value| value.square()).collect()
}

/// The discrete Fourier transform in place, of a power of two of values.
fn transform(values: &mut [Complex]) {
    let length = values.len();
    if length < 2 {
        return;
    }
    let shift = usize::BITS - length.trailing_zeros();
    for k in 0..length {
        let turned = k.reverse_bits() >> shift;
        if k < turned {
            values.swap(k, turned);
        }
    }
    let turns: Vec<Complex> =
        (0..length / 2).map(|k| Complex::turn(-TAU * k as f64 / length as f64)).collect();
    let mut half = 1;
    while half < length {
        let step = length / (2 * half);
        for block in values.chunks_exact_mut(2 * half) {
            let (low, high) = block.split_at_mut(half);
            for (k, (a, b)) in low.iter_mut().zip(high).enumerate() {
                let turned = *b * turns[k * step];
                (*a, *b) = (*a + turned, *a - turned);
            }
        }
        half *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `Σ_k |X_k|² = N Σ |x_n|²`, and a cosine of a whole number of periods is one line of `(N/2)²`.
    #[test]
    fn a_cosine_is_one_line_and_power_is_kept() {
        let cosine: Vec<f64> = (0..64).map(|n| (TAU * 5.0 * n as f64 / 64.0).cos()).collect();
        let lines = power(&cosine);
        for (k, line) in lines.iter().enumerate() {
            let exact = if k == 5 { 1024.0 } else { 0.0 };
            assert!((line - exact).abs() < 1e-9, "{k}: {line}");
        }
        let any: Vec<f64> = (0..32).map(|n| ((n * n) as f64 * 0.37).sin()).collect();
        let lines = power(&any);
        let whole = lines[0] + lines[16] + 2.0 * lines[1..16].iter().sum::<f64>();
        assert!((whole / 32.0 - any.iter().map(|x| x * x).sum::<f64>()).abs() < 1e-12);
    }

    #[test]
    fn root_and_logarithm_undo_square_and_exponential() {
        for z in [Complex::new(0.3, -2.0), Complex::new(-1.0, 1e-9), Complex::new(4.0, 0.0)] {
            let root = z.sqrt();
            assert!((root * root - z).square() < 1e-28);
            assert!((z.ln().exp() - z).square() < 1e-28);
        }
    }
}
