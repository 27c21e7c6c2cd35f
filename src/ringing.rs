//! How this bat rings: its rigid and bending motions after a blow or from an initial shape.

use crate::bat::Bat;
use crate::modes::Mode;
use crate::quadrature::gauss;
use crate::response::{Oscillator, expansion, struck};
use crate::shape_file::InitialShape;
use crate::solve::Solution;

/// How the motion begins: mode by mode, an impulse response or a displacement.
#[derive(Debug, Clone)]
pub enum Start {
    Blow { shape_at: Vec<f64>, impulse: f64 },
    Shape(Vec<f64>),
}

/// A bat as oscillators: its rigid pair, if wanted, and its bending modes.
#[derive(Debug, Clone)]
pub struct Ringing<'a> {
    solution: &'a Solution,
    oscillators: Vec<Oscillator>,
    /// Balance point, if the rigid pair takes part.
    rigid: Option<f64>,
}

impl<'a> Ringing<'a> {
    /// The bat's motions, the two rigid ones left out if `bending_only`.
    pub fn new(bat: &Bat, solution: &'a Solution, bending_only: bool) -> Self {
        let inertia = bat.inertia();
        let rigid = |mass| Oscillator { omega: 0.0, damping_ratio: 0.0, mass };
        let turning = match solution.theory.turns() {
            true => inertia.about_balance,
            false => inertia.line_about_balance,
        };
        let pair = [rigid(inertia.mass), rigid(turning)];
        let damping_ratio = 0.5 * bat.material().loss_factor;
        let bending = solution.modes.iter().map(|mode| Oscillator {
            omega: mode.omega,
            damping_ratio,
            mass: mode.modal_mass,
        });
        let skipped = if bending_only { 2 } else { 0 };
        let oscillators = pair.into_iter().skip(skipped).chain(bending).collect();
        Self { solution, oscillators, rigid: (!bending_only).then_some(inertia.balance_point) }
    }

    /// Every motion sampled at `x`.
    pub fn shapes(&self, x: &[f64]) -> Vec<Vec<f64>> {
        let rigid = self
            .rigid
            .iter()
            .flat_map(|balance| [vec![1.0; x.len()], x.iter().map(|x| x - balance).collect()]);
        let along = |mode: &Mode| x.iter().map(|x| mode.shape.deflection(*x)).collect::<Vec<f64>>();
        rigid.chain(self.solution.modes.iter().map(along)).collect()
    }

    /// How far every motion has gone at time `t` (s).
    pub fn amplitudes(&self, start: &Start, t: f64) -> Vec<f64> {
        match start {
            Start::Blow { shape_at, impulse } => struck(&self.oscillators, shape_at, *impulse, t),
            Start::Shape(amplitudes) => {
                let motion = |(o, a): (&Oscillator, &f64)| o.free(*a, 0.0, t)[0];
                self.oscillators.iter().zip(amplitudes).map(motion).collect()
            }
        }
    }

    /// The start by a blow of that impulse (N s) at `x` (m).
    pub fn blow(&self, x: f64, impulse: f64) -> Start {
        Start::Blow { shape_at: self.shapes(&[x]).into_iter().map(|s| s[0]).collect(), impulse }
    }

    /// The start at rest from that shape: how much of every motion is in it.
    pub fn release(&self, bat: &Bat, shape: &InitialShape) -> Start {
        let rule = gauss(7);
        // Gauss points between all places where the bat or the shape has a corner.
        let mut corners: Vec<f64> =
            bat.profile.stations.x.iter().chain(&shape.x).copied().collect();
        corners.extend((0..=200).map(|k| bat.length() * f64::from(k) / 200.0));
        corners.sort_by(f64::total_cmp);
        let (mut x, mut masses) = (Vec::new(), Vec::new());
        for pair in corners.windows(2).filter(|pair| pair[1] > pair[0]) {
            for (s, weight) in &rule {
                let at = pair[0] + s * (pair[1] - pair[0]);
                x.push(at);
                let per_length = bat.worth_at(at).mass;
                masses.push(weight * (pair[1] - pair[0]) * per_length);
            }
        }
        let initial: Vec<f64> = x.iter().map(|x| shape.at(*x)).collect();
        Start::Shape(expansion(&masses, &self.shapes(&x), &initial))
    }
}
