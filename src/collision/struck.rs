//! A bat as a ball feels it, anywhere along its length.

use crate::base::linear::dot;
use crate::bat::body::Bat;
use crate::collision::contact::touch::DrivingPoint;
use crate::modes::compliance::{Flexible, RigidMotion, taken};
use crate::modes::mode::Mode;
use crate::modes::solve::Solution;

/// A bat's rigid motions, its modes and the flexibility of all others.
pub struct Struck<'a> {
    /// What is struck.
    pub bat: &'a Bat,
    /// The modes that are struck.
    pub solution: &'a Solution,
    flexible: Flexible,
}

impl<'a> Struck<'a> {
    /// The bat on the solution's mesh.
    pub fn new(bat: &'a Bat, solution: &'a Solution) -> Self {
        let flexible = Flexible::new(bat, solution.elements());
        Self { bat, solution, flexible }
    }

    /// ω (rad/s) and damping ratio of every mode, each by itself: dashpots couple them slowly beside
    /// a hit.
    pub fn modes(&self) -> Vec<[f64; 2]> {
        let ratio = |k: usize| self.solution.damping.alone.get(k).copied().unwrap_or(0.0);
        let modes = self.solution.modes.iter().enumerate();
        modes.map(|(k, mode)| [mode.omega, ratio(k)]).collect()
    }

    /// `1/M_eff` (1/kg) at `x` (m): how a stiff bat gives way there.
    pub fn recoil(&self, x: f64) -> f64 {
        recoil_between(&self.flexible.rigid, x, x)
    }

    /// The rigid motions that nothing holds.
    pub fn rigid(&self) -> &[RigidMotion] {
        &self.flexible.rigid
    }

    /// `φ_n²/m_n` (1/kg) at `x` of every mode.
    pub fn gains(&self, x: f64) -> Vec<f64> {
        let gain = |mode: &Mode| mode.shape.deflection(x).powi(2) / mode.modal_mass;
        self.solution.modes.iter().map(gain).collect()
    }

    /// `Σ φ_n²/(m_n ω_n²)` (m/N) and `Σ φ_n²/(m_n ω_n⁴)` (m s²/N) over all modes there are: the
    /// deflection at `x` under a force there in balance with the bat's own inertia, by the statics
    /// operator, and how the inertia of that deflection bends the bat once more.
    pub fn flexibility(&self, x: f64) -> [f64; 2] {
        let row = self.flexible.row(x);
        let unit = self.flexible.energy_unit;
        let kink = self.flexible.unresolved(x, self.bat);
        [dot(&row, &row) / unit + kink, dot(&row, &self.flexible.inertia(&row)) / unit]
    }

    /// The bat as a ball of that mass (kg) feels it at `x` (m), with `count` modes and nothing else.
    pub fn with_modes(&self, x: f64, ball: f64, count: usize) -> DrivingPoint {
        let mut gains = self.gains(x);
        gains.truncate(count);
        DrivingPoint { inverse_mass: 1.0 / ball + self.recoil(x), gains, rest: 0.0 }
    }

    /// The bat as a ball of that mass (kg) feels it at `x` (m), with all modes.
    ///
    /// Of `count` modes, `count − 1` are kept as they are; the last one gets the mass that makes it
    /// stand for all beyond it in a slow motion. The flexibility that is still missing then is added.
    ///
    /// A mode beyond follows a slow force as `y = −c/ω² (F − F″/ω² + …)`. With `C = Σ c/ω²` and `D =
    /// Σ c/ω⁴` of all that are not taken, the gain `D ω⁴` at the first one's own ω and the
    /// flexibility `C − D ω²`, which is never negative, have the same first two terms.
    ///
    /// In hands or on springs a bat has slow modes, whose C and D are so much greater than those of
    /// the fast ones that these are lost in their errors: what is not known then is left out.
    pub fn felt(&self, x: f64, ball: f64, count: usize) -> DrivingPoint {
        self.completed(x, self.with_modes(x, ball, count), self.flexibility(x))
    }

    /// What [`Self::felt`] returns, from [`Self::with_modes`] and [`Self::flexibility`] at `x` (m).
    pub fn completed(&self, x: f64, mut felt: DrivingPoint, all: [f64; 2]) -> DrivingPoint {
        let Some(last) = felt.gains.len().checked_sub(1) else {
            return DrivingPoint { rest: all[0], ..felt };
        };
        let held = self.flexible.rigid.len() < 2;
        let unsure = if held { self.taken(&self.doubt(x)[..last]) } else { [0.0; 2] };
        let square = |k: usize| self.solution.modes[k].omega.powi(2);
        felt.rest = complete(&mut felt.gains, square, all, unsure);
        felt
    }

    /// `Σ c/ω²` (m/N) and `Σ c/ω⁴` (m s²/N) of the modes with those gains.
    pub fn taken(&self, gains: &[f64]) -> [f64; 2] {
        taken(gains, |k| self.solution.modes[k].omega.powi(2))
    }

    /// How far every gain (1/kg) may be off at `x` for the mesh, that of the frequency with it.
    pub fn doubt(&self, x: f64) -> Vec<f64> {
        let doubt = |mode: &Mode| {
            let deflection = mode.shape.deflection(x).abs();
            let relative = mode.error.modal_mass + 2.0 * mode.error.total();
            let off = 2.0 * mode.error.shape + deflection * relative;
            deflection * off / mode.modal_mass
        };
        self.solution.modes.iter().map(doubt).collect()
    }
}

/// Lets the last of some modes stand for all beyond it, as [`Struck::felt`] says, and returns the
/// flexibility (m/N) that is still missing then; `all` are C (m/N) and D (m s²/N) of every mode there
/// is, `unsure` what these are not known to. Without a mode all is flexibility.
fn complete(
    gains: &mut [f64],
    square: impl Fn(usize) -> f64,
    [soft, slow]: [f64; 2],
    [unsure, unsure_slow]: [f64; 2],
) -> f64 {
    /// What is left is known if it is this many times its error.
    const KNOWN: f64 = 10.0;
    let Some((last, before)) = gains.split_last_mut() else { return soft };
    let [here, there] = taken(before, &square);
    let (rest, left) = (soft - here, slow - there);
    let square = square(before.len());
    if left > KNOWN * unsure_slow {
        *last = last.max(left * square * square);
    }
    if rest > KNOWN * unsure { (rest - *last / square).max(0.0) } else { 0.0 }
}

/// The rigid motions of the bat where springs and hands do not hold it.
pub fn without_springs(bat: &Bat, solution: &Solution) -> Vec<RigidMotion> {
    let bare = bat.with(|parts| parts.fixtures = parts.fixtures.without_springs());
    let bare = bare.expect("a bat without its springs is a bat");
    Flexible::new(&bare, solution.elements()).rigid
}

/// The velocity (m/s) at a place that 1 N s at another gives a bat with these motions alone.
pub fn recoil_between(motions: &[RigidMotion], x: f64, there: f64) -> f64 {
    let by = |motion: &RigidMotion| motion.deflection(x) * motion.deflection(there) / motion.mass;
    motions.iter().map(by).sum()
}
