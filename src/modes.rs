//! What the bat does when it rings: frequencies, shapes, nodes, modal masses.

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::beam::element::Deflection;
use crate::beam::statics::Motion;

/// One bending mode of a free bat.
#[derive(Debug, Clone)]
pub struct Mode {
    /// 1 for the lowest bending mode.
    pub order: usize,
    /// Angular frequency ω (rad/s).
    pub omega: f64,
    /// `∫ρA φ² dx` (kg), with the largest |φ| = 1.
    pub modal_mass: f64,
    /// Where the deflection is zero, from the knob end (m).
    pub nodes: Vec<f64>,
    /// Deflection φ, largest |φ| = 1, the barrel end positive.
    pub shape: Shape,
    pub error: ModeError,
}

/// How far a mode's numbers may be off.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ModeError {
    /// Of the frequency, relative, for the mesh being finite.
    pub discretization: f64,
    /// Of the frequency, relative, for numbers having 53 bits.
    pub round_off: f64,
    /// `‖u − λ K⁻¹ M u‖ / ‖u‖` of the computed pair, in the strain energy norm.
    pub residual: f64,
    /// Of the nodes (m).
    pub nodes: f64,
    /// Of the modal mass, relative.
    pub modal_mass: f64,
}

impl ModeError {
    /// Of the frequency, relative, for both reasons.
    pub fn total(&self) -> f64 {
        self.discretization + self.round_off
    }
}

/// A deflection along the bat, a cubic on every element.
#[derive(Debug, Clone)]
pub struct Shape {
    /// Middle and length of every element (m); shared by the modes of one solution.
    stretches: Arc<Vec<(f64, f64)>>,
    coefficients: Vec<Deflection>,
}

impl Mode {
    /// Frequency (Hz).
    pub fn frequency(&self) -> f64 {
        self.omega / TAU
    }

    /// The mode that is that bending motion; `residual` and `round_off` go into its errors.
    pub fn new(
        order: usize,
        omega: f64,
        motion: Motion,
        stretches: &Arc<Vec<(f64, f64)>>,
        [residual, round_off]: [f64; 2],
    ) -> Self {
        let mut shape = Shape { stretches: Arc::clone(stretches), coefficients: motion.shape };
        let scale = 1.0 / shape.largest();
        let scale = if shape.tip() < 0.0 { -scale } else { scale };
        shape.coefficients.iter_mut().flatten().for_each(|w| *w *= scale);
        let (nodes, modal_mass) = (shape.zeros(), motion.kinetic * scale * scale);
        let error = ModeError { residual, round_off, ..ModeError::default() };
        Self { order, omega, modal_mass, nodes, shape, error }
    }
}

impl Shape {
    /// Deflection at `x` (m from the knob end), for a largest deflection of 1.
    pub fn deflection(&self, x: f64) -> f64 {
        let (k, xi) = self.locate(x);
        horner(&power(&self.coefficients[k]), xi)
    }

    /// Slope `dφ/dx` at `x` (rad per m of largest deflection).
    pub fn rotation(&self, x: f64) -> f64 {
        let (k, xi) = self.locate(x);
        let [_, a1, a2, a3] = power(&self.coefficients[k]);
        (a1 + xi * (2.0 * a2 + xi * 3.0 * a3)) * 2.0 / self.stretches[k].1
    }

    /// Element and its coordinate ξ in [−1, 1] at `x`.
    fn locate(&self, x: f64) -> (usize, f64) {
        let k = self.stretches.partition_point(|(middle, length)| middle + 0.5 * length <= x);
        let k = k.min(self.stretches.len() - 1);
        let (middle, length) = self.stretches[k];
        (k, (2.0 * (x - middle) / length).clamp(-1.0, 1.0))
    }

    /// Length of the bat (m).
    pub fn length(&self) -> f64 {
        self.stretches.last().map_or(0.0, |(middle, length)| middle + 0.5 * length)
    }

    /// Positions of the mesh's nodes (m).
    pub fn mesh_nodes(&self) -> Vec<f64> {
        let starts = self.stretches.iter().map(|(middle, length)| middle - 0.5 * length);
        starts.chain([self.length()]).collect()
    }

    /// Deflection at the barrel end.
    fn tip(&self) -> f64 {
        self.coefficients.last().map_or(0.0, |w| w.iter().sum())
    }

    /// Largest |deflection| over the continuous shape.
    fn largest(&self) -> f64 {
        self.coefficients.iter().fold(0.0, |largest, w| {
            // No Legendre polynomial exceeds 1, so most elements are settled by their bound.
            if w.iter().map(|w| w.abs()).sum::<f64>() <= largest {
                return largest;
            }
            let a = power(w);
            turning_points(&a).fold(largest, |m: f64, xi| m.max(horner(&a, xi).abs()))
        })
    }

    /// The isolated zeros of the deflection inside the bat (m), rising.
    fn zeros(&self) -> Vec<f64> {
        let mut zeros = Vec::new();
        let mut before = 0.0;
        for (w, (middle, half)) in self.coefficients.iter().zip(self.stretches.iter()) {
            let bound = w[1].abs() + w[2].abs() + w[3].abs();
            if w[0].abs() > bound && w[0] * before > 0.0 {
                continue;
            }
            let a = power(w);
            let mut left = -1.0;
            for xi in turning_points(&a) {
                let value = horner(&a, xi);
                if value * before < 0.0 {
                    zeros.push(middle + 0.5 * half * zero(&a, left, xi));
                }
                if value != 0.0 {
                    before = value;
                }
                left = xi;
            }
        }
        zeros
    }
}

/// A cubic in Legendre polynomials as powers of ξ.
fn power(w: &Deflection) -> [f64; 4] {
    [w[0] - 0.5 * w[2], w[1] - 1.5 * w[3], 1.5 * w[2], 2.5 * w[3]]
}

fn horner(a: &[f64; 4], xi: f64) -> f64 {
    a[0] + xi * (a[1] + xi * (a[2] + xi * a[3]))
}

/// −1, where the cubic turns inside (−1, 1), and 1, rising: between them it is monotone.
fn turning_points(a: &[f64; 4]) -> impl Iterator<Item = f64> {
    // a₁ + 2 a₂ ξ + 3 a₃ ξ² = 0, the root of larger size first, the other from their product.
    let root = (a[2] * a[2] - 3.0 * a[3] * a[1]).max(0.0).sqrt();
    let sum = -(a[2] + root.copysign(a[2]));
    let (p, q) = (sum / (3.0 * a[3]), a[1] / sum);
    [-1.0, p.min(q), p.max(q), 1.0].into_iter().enumerate().filter_map(|(k, xi)| {
        // A comparison with NaN (no such turning point) is false.
        (k == 0 || k == 3 || xi > -1.0 && xi < 1.0).then_some(xi)
    })
}

/// The zero of a cubic that is monotone between `left` and `right` and changes sign there:
/// Newton's steps where they stay inside the shrinking bracket, halving where they do not.
fn zero(a: &[f64; 4], mut left: f64, mut right: f64) -> f64 {
    let rising = horner(a, right) > 0.0;
    let mut xi = 0.5 * (left + right);
    for _ in 0..100 {
        let value = horner(a, xi);
        if (value > 0.0) == rising {
            right = xi
        } else {
            left = xi
        }
        let slope = a[1] + xi * (2.0 * a[2] + xi * 3.0 * a[3]);
        let newton = xi - value / slope;
        let next = if newton > left && newton < right { newton } else { 0.5 * (left + right) };
        if (next - xi).abs() <= f64::EPSILON {
            return next;
        }
        xi = next;
    }
    xi
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_and_extremes_of_a_cubic_are_found_wherever_they_lie() {
        // ξ³ − ξ/4 on one element from 0 to 2: zeros at 1, 1 ± ½; extremes inside and 3/4 at the ends.
        let stretches = Arc::new(vec![(1.0, 2.0)]);
        let shape = Shape { stretches, coefficients: vec![[0.0, 0.6 - 0.25, 0.0, 0.4]] };
        let zeros = shape.zeros();
        for (zero, exact) in zeros.iter().zip([0.5, 1.0, 1.5]) {
            assert!((zero - exact).abs() < 1e-15, "{zeros:?}");
        }
        assert_eq!(zeros.len(), 3);
        assert!((shape.largest() - 0.75).abs() < 1e-15);
        assert!((shape.deflection(2.0) - 0.75).abs() < 1e-15);
        assert!((shape.rotation(1.0) + 0.25).abs() < 1e-15);
    }

    #[test]
    fn a_zero_on_the_border_of_two_elements_is_one_node() {
        let stretches = Arc::new(vec![(0.5, 1.0), (1.5, 1.0)]);
        for tiny in [0.0, 1e-18, -1e-18] {
            let coefficients = vec![[-0.5, 0.5 + tiny, 0.0, 0.0], [0.5 + tiny, 0.5, 0.0, 0.0]];
            let shape = Shape { stretches: Arc::clone(&stretches), coefficients };
            let zeros = shape.zeros();
            assert_eq!(zeros.len(), 1, "{zeros:?}");
            assert!((zeros[0] - 1.0).abs() < 1e-15);
        }
    }
}
