//! The fast Fourier transform of a power of two of numbers.

use std::f64::consts::TAU;

use faer::c64;

/// The power spectrum `|Σ x_n e^{-2πi kn/N}|²`, k from 0 to N/2, of real samples, zero-padded to N, a power of two.
pub fn power(samples: &[f64]) -> Vec<f64> {
    let length = samples.len().next_power_of_two();
    let mut values: Vec<c64> = samples.iter().map(|x| c64::from(*x)).collect();
    values.resize(length, c64::ZERO);
    transform(&mut values);
    values[..=length / 2].iter().map(|value| value.norm_sqr()).collect()
}

/// The discrete Fourier transform in place, of a power of two of values.
fn transform(values: &mut [c64]) {
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
    let turns: Vec<c64> =
        (0..length / 2).map(|k| c64::cis(-TAU * k as f64 / length as f64)).collect();
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
}
