//! How similar are two shapes at the same points?
//!
//! ```text
//! MAC(φ, ψ) = |φᴴψ|² / (φᴴφ · ψᴴψ)
//! ```
//!
//! is 1 for multiples of one shape, also complex ones, and 0 for shapes that are orthogonal at these points.
//!
//! # Source
//!
//! R. J. Allemang, The Modal Assurance Criterion: Twenty Years of Use and Abuse, Sound and
//! Vibration, August 2003.

use faer::c64;

/// `φᴴψ`.
pub fn product(a: &[c64], b: &[c64]) -> c64 {
    a.iter().zip(b).fold(c64::new(0.0, 0.0), |sum, (a, b)| sum + a.conj() * b)
}

/// The shape scaled to a largest component of size 1, so that no square overflows.
pub fn unit(shape: &[c64]) -> Vec<c64> {
    let largest = shape.iter().map(|v| v.re.abs().max(v.im.abs())).fold(0.0, f64::max);
    match largest {
        0.0 => shape.to_vec(),
        largest => shape.iter().map(|v| v / largest).collect(),
    }
}

/// The modal assurance criterion of two shapes; 0 if one of them is zero.
pub fn mac(a: &[c64], b: &[c64]) -> f64 {
    let (a, b) = (unit(a), unit(b));
    let sizes = product(&a, &a).re * product(&b, &b).re;
    if sizes > 0.0 { (product(&a, &b).norm_sqr() / sizes).min(1.0) } else { 0.0 }
}

/// The MAC of every shape of one list with every shape of another.
pub fn matrix(rows: &[Vec<c64>], columns: &[Vec<c64>]) -> Vec<Vec<f64>> {
    rows.iter().map(|a| columns.iter().map(|b| mac(a, b)).collect()).collect()
}

/// The factor that makes the computed shape most like the measured one, `ψᴴφ / ψᴴψ`.
pub fn scale(measured: &[c64], computed: &[c64]) -> c64 {
    product(computed, measured) / product(computed, computed).re
}

/// Modal phase collinearity, `|φᵀφ|²/(φᴴφ)²`, the MAC of a shape and its conjugate: 1 where all
/// points move in phase or against it, 0 where the phase runs around.
pub fn collinearity(shape: &[c64]) -> f64 {
    let conjugate: Vec<c64> = shape.iter().map(|v| v.conj()).collect();
    mac(&conjugate, shape)
}

/// Share of `φᴴφ` that is a quarter period off the rest, with the phase that makes it least: ½ (1 −
/// √MPC).
pub fn out_of_phase(shape: &[c64]) -> f64 {
    0.5 * (1.0 - collinearity(shape).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape(values: &[f64]) -> Vec<c64> {
        values.iter().map(|v| c64::new(*v, 0.0)).collect()
    }

    fn turned(shape: &[c64], by: c64) -> Vec<c64> {
        shape.iter().map(|v| by * v).collect()
    }

    #[test]
    fn multiples_are_alike_and_orthogonal_shapes_are_not() {
        let a = shape(&[1.0, -0.3, -0.9, 0.2, 1.4]);
        let b = shape(&[0.3, 1.0, 0.0, 0.0, 0.0]);
        for by in [c64::new(-3.0, 0.0), c64::new(0.0, 2.0), c64::new(1e-200, 7e-201)] {
            assert!((mac(&a, &turned(&a, by)) - 1.0).abs() < 1e-15);
            assert!((collinearity(&turned(&a, by)) - 1.0).abs() < 1e-15);
            let scaled = scale(&turned(&a, by), &a);
            assert!((scaled - by).norm() < 1e-15 * by.norm());
        }
        assert!(mac(&a, &b) < 1e-30);
        assert_eq!(mac(&a, &shape(&[0.0; 5])), 0.0);
    }

    /// A complex phase changes nothing, and the out-of-phase share is the given one.
    #[test]
    fn phase_is_told_from_shape() {
        let (a, b) = ([1.0, -0.3, -0.9, 0.2, 1.4], [0.3, 1.0, 0.0, 0.0, 0.0]);
        let whirl: Vec<c64> = a.iter().zip(b).map(|(a, b)| c64::new(*a, 0.2 * b)).collect();
        let [of_a, of_b] = [a, b].map(|v| v.iter().map(|v| v * v).sum::<f64>());
        let share = 0.04 * of_b / (of_a + 0.04 * of_b);
        for angle in [0.0, 0.4, 2.0] {
            let phase = c64::from_polar(1.0, angle);
            let other = turned(&whirl, phase);
            assert!((out_of_phase(&other) - share).abs() < 1e-15);
            assert!((mac(&other, &shape(&b)) - mac(&whirl, &shape(&b))).abs() < 1e-15);
        }
        assert_eq!(out_of_phase(&shape(&a)), 0.0);
    }
}
