//! How does a damped bat move, in as few unknowns as possible?
//!
//! [`Reduced::new`] makes one; [`Reduced::free_motions`] gives its free motions and `Reduced::answer` its response to a
//! force.
//!
//! In scaled strains the stiffness is the identity, and a motion `e^{st}` obeys
//!
//! ```text
//! (s² M + s C + 1 + iK″) q = f,   r = f − (s² M + s C + 1 + iK″) V y
//! ```
//!
//! The unknowns are projected on orthonormal strains V: first the modes, whose M is diagonal. The residual r is what
//! the projection misses. Since the stiffness is the identity, r itself gives the missing strains, which join V until
//! an eigenvalue or a response no longer changes. Both depend on the square of r, because all matrices are symmetric.
//! Rigid motions that a dashpot moves are unknowns too; the others do not couple with the strains.
//!
//! # Source
//!
//! F. Tisseur, K. Meerbergen, The quadratic eigenvalue problem, SIAM Review 43 (2001) 235.

use faer::{Mat, Side, c64};

use crate::base::{Error, Result, dot};
use crate::bat::Bat;
use crate::beam::Elements;
use crate::modes::compliance::{Dashpot, Flexible, RigidMotion};
use crate::modes::pole::Pole;

/// A bat on a few strains.
pub struct Reduced {
    /// The bat on its whole mesh.
    pub flexible: Flexible,
    /// ω (rad/s) of the modes, which come first.
    pub omega: Vec<f64>,
    members: Vec<Member>,
    /// Lower rows of `vᵀMv` (s²) and `vᵀK″v`.
    pub(super) mass: Vec<Vec<f64>>,
    pub(super) loss: Vec<Vec<f64>>,
    /// Whether a dashpot moves rigid motions that nothing else holds.
    pub coupled: bool,
}

/// One of the strains, and its loads.
struct Member {
    strains: Vec<f64>,
    /// `M v` (s²), without the parts in the modes.
    inertia: Vec<f64>,
    /// `K″ v`.
    loss: Vec<f64>,
    /// Extension of every dashpot (m).
    drawn: Vec<f64>,
}

impl Reduced {
    /// The bat on those elements, with `wanted` of its modes and a few more.
    ///
    /// # Errors
    ///
    /// As [`Flexible::slowest`].
    pub fn new(bat: &Bat, elements: Elements, wanted: usize) -> Result<Self> {
        let mut flexible = Flexible::new(bat, elements);
        let (omega, strains, _) = flexible.slowest(wanted + (wanted / 2).max(4))?;
        /// A rigid motion slower than this share of mode 1 is not seen to decay.
        const SLOWEST: f64 = 1e-10;
        let moved = |d: &Dashpot| d.rigid.iter().any(|w| *w != 0.0);
        let rate = |(k, motion): (usize, &RigidMotion)| {
            let constants = flexible.dashpots.iter().map(|d| d.constant * d.rigid[k].powi(2));
            constants.sum::<f64>() / motion.mass
        };
        let fastest = flexible.rigid.iter().enumerate().map(rate).fold(0.0, f64::max);
        let coupled = fastest > SLOWEST * omega.first().copied().unwrap_or(0.0);
        if !coupled {
            flexible.dashpots.retain(|dashpot| !moved(dashpot));
        }
        let mut reduced =
            Self { flexible, omega, members: vec![], mass: vec![], loss: vec![], coupled };
        for strains in strains {
            let member = reduced.member(strains, false);
            reduced.take(member);
        }
        Ok(reduced)
    }

    /// Number of strains.
    pub fn len(&self) -> usize {
        self.members.len()
    }

    /// Whether there are no strains.
    pub fn is_empty(&self) -> bool {
        self.members.is_empty()
    }

    /// The strains of member k.
    pub fn strains(&self, k: usize) -> &[f64] {
        &self.members[k].strains
    }

    /// `ℓ` (s), and the strains for which `M = diag(ℓ²)`: the modes, and the parts of the other strains orthogonal to
    /// them.
    ///
    /// # Errors
    ///
    /// [`Error::NotConverged`] if the small eigenproblem of the other strains has no solution.
    pub(super) fn diagonal(&self) -> Result<(Vec<f64>, Mat<f64>)> {
        let (modes, n) = (self.omega.len(), self.len());
        let (mut lengths, mut turned) = (vec![0.0; n], Mat::<f64>::identity(n, n));
        (0..modes).for_each(|k| lengths[k] = 1.0 / self.omega[k]);
        let extra = n - modes;
        if extra > 0 {
            let block =
                Mat::from_fn(extra, extra, |i, j| self.mass[modes + i.max(j)][modes + i.min(j)]);
            let none = |_| Error::NotConverged { wanted: n, converged: 0, steps: 0 };
            let eigen = block.self_adjoint_eigen(Side::Lower).map_err(none)?;
            for j in 0..extra {
                lengths[modes + j] = eigen.S().column_vector()[j].max(0.0).sqrt();
                (0..extra).for_each(|i| turned[(modes + i, modes + j)] = eigen.U()[(i, j)]);
            }
        }
        Ok((lengths, turned))
    }

    fn member(&self, strains: Vec<f64>, with_inertia: bool) -> Member {
        let mut inertia = vec![];
        if with_inertia {
            inertia = self.flexible.inertia(&strains);
            // The remaining part in the modes is round-off, which is large for a slow mode.
            take_out(&mut inertia, &self.members[..self.omega.len()]);
        }
        let loss = if self.flexible.loses() { self.flexible.loss(&strains) } else { vec![] };
        let drawn = self.flexible.dashpots.iter().map(|d| d.strains.by(&strains)).collect();
        Member { strains, inertia, loss, drawn }
    }

    fn take(&mut self, new: Member) {
        let (at, modes) = (self.members.len(), self.omega.len());
        self.members.push(new);
        let new = &self.members[at];
        let both = |a: &[f64], b: &[f64], old: &Member, of_old: &[f64]| {
            if b.is_empty() { 0.0 } else { 0.5 * (dot(a, of_old) + dot(b, &old.strains)) }
        };
        let mass = self.members.iter().enumerate().map(|(k, old)| match k < modes {
            true if k == at => self.omega[k].powi(-2),
            true => 0.0,
            false => both(&new.strains, &new.inertia, old, &old.inertia),
        });
        self.mass.push(mass.collect());
        let loss = self.members.iter().map(|old| both(&new.strains, &new.loss, old, &old.loss));
        self.loss.push(loss.collect());
    }

    /// Adds these strains; returns whether they were new.
    pub fn add(&mut self, mut strains: Vec<f64>) -> bool {
        /// A smaller remainder than this share is round-off.
        const NEW: f64 = 1e-7;
        if self.members.len() >= self.flexible.freedom() {
            return false;
        }
        if !normalize(&mut strains) {
            return false;
        }
        take_out(&mut strains, &self.members);
        let rest = dot(&strains, &strains).sqrt();
        if rest < NEW || !normalize(&mut strains) {
            return false;
        }
        self.flexible.project(&mut strains);
        take_out(&mut strains, &self.members);
        if !normalize(&mut strains) {
            return false;
        }
        let member = self.member(strains, true);
        self.take(member);
        true
    }

    /// The loss factor of mode k by its strain energy: `vᵀK″v/vᵀv`.
    pub fn mode_loss(&self, k: usize) -> f64 {
        self.loss[k][k]
    }

    /// Replaces the materials' loss factors by those of the modes, each alone: modal damping, as measured. The strains
    /// beyond the modes have no loss.
    pub fn lose(&mut self, losses: &[f64]) {
        for (k, loss) in losses.iter().enumerate().take(self.omega.len()) {
            let member = &mut self.members[k];
            member.loss = member.strains.iter().map(|v| loss * v).collect();
            self.loss[k] = vec![0.0; k + 1];
            self.loss[k][k] = *loss;
        }
    }

    /// Damping of mode k by the dashpots, `vᵀC v` (s), for a strain energy of `½ vᵀv = ½`: its damping ratio is half of
    /// it times ω.
    pub fn mode_damping(&self, k: usize) -> f64 {
        let drawn = self.members[k].drawn.iter().zip(&self.flexible.dashpots);
        drawn.map(|(w, d)| d.constant * w * w).sum::<f64>() / self.flexible.energy_unit
    }

    /// Number of unknowns that are rigid motions.
    pub(super) fn rigid_unknowns(&self) -> usize {
        if self.coupled { self.flexible.rigid.len() } else { 0 }
    }

    /// Mass of rigid unknown k, in the unit of energy (s²/m² or s²).
    pub(super) fn rigid_mass(&self, k: usize) -> f64 {
        self.flexible.rigid[k].mass / self.flexible.energy_unit
    }

    /// C (s) of all unknowns due to the dashpots, rigid motions first.
    pub fn damping(&self) -> Mat<f64> {
        let (rigid, n) = (self.rigid_unknowns(), self.members.len());
        let mut c = Mat::zeros(rigid + n, rigid + n);
        for (k, dashpot) in self.flexible.dashpots.iter().enumerate() {
            let constant = dashpot.constant / self.flexible.energy_unit;
            let members = self.members.iter().map(|m| m.drawn[k]);
            let drawn: Vec<f64> = dashpot.rigid[..rigid].iter().copied().chain(members).collect();
            for i in 0..rigid + n {
                for j in 0..rigid + n {
                    c[(i, j)] += constant * drawn[i] * drawn[j];
                }
            }
        }
        c
    }

    /// The residual `s² M q + s C q + iK″ q` of these amplitudes, without its part in the members.
    pub(super) fn residual(
        &self,
        s: c64,
        hysteretic: bool,
        rigid: &[c64],
        parts: &[c64],
    ) -> [Vec<f64>; 2] {
        let mut left = [0, 1].map(|_| vec![0.0; self.flexible.dimension]);
        let mut add = |factor: c64, strains: &[f64]| {
            for (left, factor) in left.iter_mut().zip([factor.re, factor.im]) {
                left.iter_mut().zip(strains).for_each(|(r, v)| *r += factor * v);
            }
        };
        for (member, part) in self.members.iter().zip(parts) {
            add(s * s * *part, &member.inertia);
            if hysteretic {
                add(c64::new(0.0, 1.0) * *part, &member.loss);
            }
        }
        for (k, dashpot) in self.flexible.dashpots.iter().enumerate() {
            let members = self.members.iter().zip(parts).map(|(m, part)| *part * m.drawn[k]);
            let rigid = rigid.iter().zip(&dashpot.rigid).map(|(part, w)| *part * *w);
            let drawn: c64 = members.chain(rigid).sum();
            let force = s * drawn * (dashpot.constant / self.flexible.energy_unit);
            dashpot.strains.add_force(force.re, &mut left[0]);
            dashpot.strains.add_force(force.im, &mut left[1]);
        }
        for left in &mut left {
            self.flexible.project(left);
            take_out(left, &self.members);
        }
        left
    }

    /// M (s²) of all unknowns, rigid motions first, and C (s) including the materials' part.
    pub fn viscous(&self) -> [Mat<f64>; 2] {
        let (n, r) = (self.members.len(), self.rigid_unknowns());
        let mass = Mat::from_fn(r + n, r + n, |i, j| match (i < r, j < r) {
            (false, false) => self.mass[i.max(j) - r][i.min(j) - r],
            (true, true) if i == j => self.rigid_mass(i),
            _ => 0.0,
        });
        let mut damping = self.damping();
        for k in 0..self.omega.len() {
            damping[(r + k, r + k)] += self.mode_loss(k) / self.omega[k];
        }
        [mass, damping]
    }

    /// The rigid motions that draw dashpots out, at `s = 0`: constant displacements, with their [`Pole::norm`].
    pub fn resting(&self) -> Vec<Pole> {
        let r = self.rigid_unknowns();
        let (c, unit) = (self.damping(), self.flexible.energy_unit);
        let zero = c64::new(0.0, 0.0);
        let pole = |rigid: Vec<f64>, norm: f64| Pole {
            s: zero,
            rigid: rigid.into_iter().map(|p| c64::new(p, 0.0)).collect(),
            parts: vec![zero; self.members.len()],
            norm: c64::new(norm * unit, 0.0),
            error: 0.0,
            rigid_share: 1.0,
            strain_share: 0.0,
        };
        match r {
            0 => vec![],
            1 => vec![pole(vec![1.0], c[(0, 0)])],
            // The second one without its part in the first, in the metric of C.
            _ => {
                let part = c[(0, 1)] / c[(0, 0)];
                let rest = c[(1, 1)] - part * c[(0, 1)];
                vec![pole(vec![1.0, 0.0], c[(0, 0)]), pole(vec![-part, 1.0], rest)]
            }
        }
    }

    /// Share of a pole's motion when the bat is released at rest from the displacement of these rigid motions and
    /// modes: `vᵀ(sM + C)u/norm`.
    pub fn share(&self, pole: &Pole, rigid: &[f64], modes: &[f64]) -> c64 {
        let r = self.rigid_unknowns();
        let c = self.damping();
        let mut sum = c64::new(0.0, 0.0);
        for (k, u) in rigid.iter().take(r).enumerate() {
            sum += pole.s * pole.rigid[k] * (self.rigid_mass(k) * u);
        }
        for (k, u) in modes.iter().enumerate() {
            let own = pole.s * self.omega[k].powi(-2) + self.mode_loss(k) / self.omega[k];
            sum += pole.parts[k] * own * *u;
        }
        let v: Vec<c64> = pole.rigid.iter().chain(&pole.parts).copied().collect();
        for (j, u) in rigid[..r].iter().chain(modes).enumerate() {
            let drawn: c64 = v.iter().enumerate().map(|(i, v)| *v * c[(i, j)]).sum();
            sum += drawn * *u;
        }
        sum * self.flexible.energy_unit / pole.norm
    }
}

/// Removes the members' parts from strains.
fn take_out(strains: &mut [f64], members: &[Member]) {
    for member in members {
        let part = dot(strains, &member.strains);
        strains.iter_mut().zip(&member.strains).for_each(|(r, v)| *r -= part * v);
    }
}

/// Scales strains to unit length; false if they are zero.
fn normalize(strains: &mut [f64]) -> bool {
    let size = dot(strains, strains).sqrt();
    if !(size > 0.0 && size.is_finite()) {
        return false;
    }
    strains.iter_mut().for_each(|v| *v /= size);
    true
}
