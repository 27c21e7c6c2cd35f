//! How far does the bat deflect under a ball, anywhere along its length?

use crate::base::dot;
use crate::bat::Bat;
use crate::collision::contact::touch::DrivingPoint;
use crate::modes::compliance::{Flexible, RigidMotion, taken};
use crate::modes::mode::Mode;
use crate::modes::solve::Solution;

/// A bat's rigid motions, its modes and the flexibility of all others.
pub struct Struck<'a> {
    /// The bat.
    pub bat: &'a Bat,
    /// Its modes.
    pub solution: &'a Solution,
    flexible: Flexible,
}

impl<'a> Struck<'a> {
    /// The bat on the solution's mesh.
    pub fn new(bat: &'a Bat, solution: &'a Solution) -> Self {
        let flexible = Flexible::new(bat, solution.elements());
        Self { bat, solution, flexible }
    }

    /// ω (rad/s) and damping ratio of every mode, each treated alone: the coupling by dashpots is slow compared with a
    /// hit.
    pub fn modes(&self) -> Vec<[f64; 2]> {
        let ratio = |k: usize| self.solution.damping.alone.get(k).copied().unwrap_or(0.0);
        let modes = self.solution.modes.iter().enumerate();
        modes.map(|(k, mode)| [mode.omega, ratio(k)]).collect()
    }

    /// `1/M_eff` (1/kg) at `x` (m): the compliance of the rigid bat there.
    pub fn recoil(&self, x: f64) -> f64 {
        recoil_between(&self.flexible.rigid, x, x)
    }

    /// The free rigid motions.
    pub fn rigid(&self) -> &[RigidMotion] {
        &self.flexible.rigid
    }

    /// `φ_n²/m_n` (1/kg) at `x` of every mode.
    pub fn gains(&self, x: f64) -> Vec<f64> {
        let gain = |mode: &Mode| mode.shape.deflection(x).powi(2) / mode.modal_mass;
        self.solution.modes.iter().map(gain).collect()
    }

    /// `Σ φ_n²/(m_n ω_n²)` (m/N) and `Σ φ_n²/(m_n ω_n⁴)` (m s²/N) over all modes, by the statics operator. The first is
    /// the deflection at `x` under a unit force there, balanced by the bat's inertia; the second is the further bending
    /// by the inertia of that deflection.
    pub fn flexibility(&self, x: f64) -> [f64; 2] {
        let row = self.flexible.row(x);
        let unit = self.flexible.energy_unit;
        let kink = self.flexible.unresolved(x, self.bat);
        [dot(&row, &row) / unit + kink, dot(&row, &self.flexible.inertia(&row)) / unit]
    }

    /// The driving point of the bat at `x` (m) for a ball of that mass (kg), with `count` modes only.
    pub fn with_modes(&self, x: f64, ball: f64, count: usize) -> DrivingPoint {
        let mut gains = self.gains(x);
        gains.truncate(count);
        DrivingPoint { inverse_mass: 1.0 / ball + self.recoil(x), gains, rest: 0.0 }
    }

    /// The driving point of the bat at `x` (m) for a ball of that mass (kg), with all modes.
    ///
    /// Of `count` modes, `count − 1` are kept as they are. The last one gets the mass with which it represents all
    /// further modes in a slow motion. The flexibility that is still missing then is added.
    ///
    /// A further mode follows a slow force as `y = −c/ω² (F − F″/ω² + …)`. Let `C = Σ c/ω²` and `D = Σ c/ω⁴` for all
    /// modes not taken. The gain `D ω⁴` at the ω of the first of these, and the flexibility `C − D ω²`, which is never
    /// negative, have the same first two terms.
    ///
    /// In hands or on springs a bat has slow modes. Their C and D are so much larger than those of the fast modes that
    /// these are lost in the errors; an unknown remainder is omitted.
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

    /// The other extreme for a held bat whose slow modes have errors that hide all further modes: from
    /// [`Self::with_modes`] and [`Self::flexibility`] at `x` (m), with the flexibility (m/N) by which it differs from
    /// [`Self::completed`]. A hidden flexibility is added. If it is known, but not the frequencies of the further
    /// modes, all of it is assigned to the lowest possible one.
    pub fn otherwise(
        &self,
        x: f64,
        modes: &DrivingPoint,
        all: [f64; 2],
    ) -> Option<(DrivingPoint, f64)> {
        let last = modes.gains.len().checked_sub(1).filter(|_| self.flexible.rigid.len() < 2)?;
        let [unsure, unsure_slow] = self.taken(&self.doubt(x)[..last]);
        let [here, there] = self.taken(&modes.gains[..last]);
        let whole = (all[0] - here).max(0.0) + unsure;
        let mut other = self.completed(x, modes.clone(), all);
        let square = self.solution.modes[last].omega.powi(2);
        if all[0] - here > KNOWN * unsure && all[1] - there <= KNOWN * unsure_slow {
            other.gains[last] = other.gains[last].max(whole * square);
            let moved = std::mem::take(&mut other.rest);
            return Some((other, moved));
        }
        let more = (whole - other.gains[last] / square - other.rest).max(0.0);
        other.rest += more;
        Some((other, more))
    }

    /// `Σ c/ω²` (m/N) and `Σ c/ω⁴` (m s²/N) of the modes with those gains.
    pub fn taken(&self, gains: &[f64]) -> [f64; 2] {
        taken(gains, |k| self.solution.modes[k].omega.powi(2))
    }

    /// Possible error of every gain (1/kg) at `x` due to the mesh, including that of the frequency.
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

/// The remainder beyond the modes counts as known if it is this many times its error.
const KNOWN: f64 = 10.0;

/// Lets the last of the modes represent all further ones, as described at [`Struck::felt`], and returns the flexibility
/// (m/N) that is still missing. `all` are C (m/N) and D (m s²/N) of every mode, `unsure` their errors. Without a mode
/// the result is the whole flexibility.
fn complete(
    gains: &mut [f64],
    square: impl Fn(usize) -> f64,
    [soft, slow]: [f64; 2],
    [unsure, unsure_slow]: [f64; 2],
) -> f64 {
    let Some((last, before)) = gains.split_last_mut() else { return soft };
    let [here, there] = taken(before, &square);
    let (rest, left) = (soft - here, slow - there);
    let square = square(before.len());
    if left > KNOWN * unsure_slow {
        *last = last.max(left * square * square);
    }
    if rest > KNOWN * unsure { (rest - *last / square).max(0.0) } else { 0.0 }
}

/// The rigid motions of the bat without its springs and hands.
pub fn without_springs(bat: &Bat, solution: &Solution) -> Vec<RigidMotion> {
    let bare = bat.with(|parts| parts.fixtures = parts.fixtures.without_springs());
    let bare = bare.expect("a bat without its springs is a bat");
    Flexible::new(&bare, solution.elements()).rigid
}

/// The velocity (m/s) at one place due to 1 N s at another, for a bat with these motions alone.
pub fn recoil_between(motions: &[RigidMotion], x: f64, there: f64) -> f64 {
    let by = |motion: &RigidMotion| motion.deflection(x) * motion.deflection(there) / motion.mass;
    motions.iter().map(by).sum()
}
