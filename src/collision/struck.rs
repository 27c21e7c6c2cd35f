//! A bat as a ball feels it, anywhere along its length.

use crate::bat::Bat;
use crate::collision::contact::Felt;
use crate::eigen::lanczos::dot;
use crate::flexible::Flexible;
use crate::solve::Solution;

/// A bat's rigid motions, its modes and the flexibility of all others.
pub struct Struck<'a> {
    solution: &'a Solution,
    flexible: Flexible,
}

impl<'a> Struck<'a> {
    /// The bat on the solution's mesh.
    pub fn new(bat: &Bat, solution: &'a Solution) -> Self {
        let flexible = Flexible::new(bat, &solution.mesh, solution.degree, solution.theory);
        Self { solution, flexible }
    }

    /// ω (rad/s) and damping ratio of every mode.
    pub fn modes(&self) -> Vec<[f64; 2]> {
        let ratio =
            |k: usize| self.solution.damping.modes.get(k).map_or(0.0, |damped| damped.ratio);
        let modes = self.solution.modes.iter().enumerate();
        modes.map(|(k, mode)| [mode.omega, ratio(k)]).collect()
    }

    /// `1/M_eff` (1/kg) at `x` (m): how a stiff bat gives way there.
    pub fn recoil(&self, x: f64) -> f64 {
        self.flexible.rigid.iter().map(|motion| motion.deflection(x).powi(2) / motion.mass).sum()
    }

    /// `φ_n²/m_n` (1/kg) at `x` of every mode.
    pub fn gains(&self, x: f64) -> Vec<f64> {
        let gain = |mode: &crate::modes::Mode| mode.shape.deflection(x).powi(2) / mode.modal_mass;
        self.solution.modes.iter().map(gain).collect()
    }

    /// `Σ φ_n²/(m_n ω_n²)` (m/N) and `Σ φ_n²/(m_n ω_n⁴)` (m s²/N) over all modes there are: the
    /// deflection at `x` under a force there in balance with the bat's own inertia, by the statics
    /// operator, and how the inertia of that deflection bends the bat once more.
    pub fn flexibility(&self, x: f64) -> [f64; 2] {
        let row = self.flexible.row(x);
        let unit = self.flexible.energy_unit;
        [dot(&row, &row) / unit, dot(&row, &self.flexible.inertia(&row)) / unit]
    }

    /// All of that for a ball of that mass (kg) at `x`, with `count` modes and nothing else.
    pub fn with_modes(&self, x: f64, ball: f64, count: usize) -> Felt {
        let mut gains = self.gains(x);
        gains.truncate(count);
        Felt { inverse_mass: 1.0 / ball + self.recoil(x), gains, rest: 0.0 }
    }

    /// The same with all modes: `count − 1` of them as they are, the last one as heavy as makes it
    /// stand for all beyond it in a slow motion, and the flexibility that is still missing then.
    ///
    /// A mode beyond follows a slow force as `y = −c/ω² (F − F″/ω² + …)`. With `C = Σ c/ω²` and `D =
    /// Σ c/ω⁴` of all that are not taken, the gain `D ω⁴` at the first one's own ω and the
    /// flexibility `C − D ω²`, which is never negative, have the same first two terms.
    pub fn felt(&self, x: f64, ball: f64, count: usize) -> Felt {
        self.completed(self.with_modes(x, ball, count), self.flexibility(x))
    }

    fn completed(&self, felt: Felt, [soft, slow]: [f64; 2]) -> Felt {
        let mut felt = felt;
        let Some((last, taken)) = felt.gains.split_last_mut() else {
            return Felt { rest: soft, ..felt };
        };
        let squares = self.solution.modes.iter().map(|mode| mode.omega.powi(2));
        let (mut rest, mut left) = (soft, slow);
        for (gain, square) in taken.iter().zip(squares) {
            rest -= gain / square;
            left -= gain / (square * square);
        }
        let square = self.solution.modes[taken.len()].omega.powi(2);
        *last = last.max(left * square * square);
        felt.rest = (rest - *last / square).max(0.0);
        felt
    }
}
