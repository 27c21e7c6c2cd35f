//! Sums of modes in time: the amplitude of each after a blow, and the sum of the first ones.

use sweetspot::motion::oscillator::Oscillator;

/// `q_n(t) = J φ_n(a) h_n(t)`: each mode's displacement after an impulse `J` (N s) at `a`.
///
/// `shape_at_a` holds `φ_n(a)`. With the shapes at `x` this is the response `w(x, t)`; its velocity
/// at `t = 0` is a series that does not converge, because a force of zero duration has no finite power.
pub fn struck(modes: &[Oscillator], shape_at_a: &[f64], impulse: f64, t: f64) -> Vec<f64> {
    modes.iter().zip(shape_at_a).map(|(m, phi)| impulse * phi * m.impulse_response(t)).collect()
}

/// `w_N(x_i) = Σ_{n ≤ N} q_n φ_n(x_i)`; entry `N − 1` is the sum of the first `N` modes.
pub fn partial_sums(shapes: &[Vec<f64>], amplitudes: &[f64]) -> Vec<Vec<f64>> {
    let mut sum = vec![0.0; shapes.first().map_or(0, Vec::len)];
    let add = |(shape, amplitude): (&Vec<f64>, &f64)| {
        sum.iter_mut().zip(shape).for_each(|(w, phi)| *w += amplitude * phi);
        sum.clone()
    };
    shapes.iter().zip(amplitudes).map(add).collect()
}
