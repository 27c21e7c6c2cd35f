//! How does a damped bat move, in as few unknowns as tell it?
//!
//! [`Reduced::new`], then [`Reduced::free_motions`] for what goes on by itself and
//! [`Reduced::answer`] for what a force makes of it.
//!
//! In scaled strains the stiffness is the identity, and a motion as `e^{st}` obeys
//!
//! ```text
//! (s² M + s C + 1 + iK″) q = f,   r = f − (s² M + s C + 1 + iK″) V y
//! ```
//!
//! The unknowns are projected on orthonormal strains V: the modes first, whose M is diagonal. What
//! the projection misses is the residual r; the inverse of 1 takes it to the strains that are
//! missing, which join V until an eigenvalue or a response no longer changes. Both depend on the
//! square of r, for everything here is symmetric. Rigid motions that a dashpot moves are unknowns
//! too; the others have nothing to do with the strains.
//!
//! # Source
//!
//! F. Tisseur, K. Meerbergen, The quadratic eigenvalue problem, SIAM Review 43 (2001) 235.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side, c64};

use crate::base::error::{Error, Result};
use crate::bat::body::Bat;
use crate::bat::theory::Theory;
use crate::beam::mesh::Mesh;
use crate::eigen::lanczos::dot;
use crate::modes::compliance::{Dashpot, Flexible, RigidMotion};

/// A bat on a few strains.
pub struct Reduced {
    /// The bat on its whole mesh.
    pub flexible: Flexible,
    /// ω (rad/s) of the modes, which come first.
    pub omega: Vec<f64>,
    members: Vec<Member>,
    /// Lower rows of `vᵀMv` (s²) and `vᵀK″v`.
    mass: Vec<Vec<f64>>,
    loss: Vec<Vec<f64>>,
    /// Whether a dashpot moves rigid motions that nothing else holds.
    pub coupled: bool,
}

/// One of the strains, and what it loads.
struct Member {
    strains: Vec<f64>,
    /// `M v` (s²), without the modes' parts.
    inertia: Vec<f64>,
    /// `K″ v`.
    loss: Vec<f64>,
    /// How far it draws every dashpot out (m).
    drawn: Vec<f64>,
}

/// A motion as `e^{st}` that goes on by itself.
#[derive(Debug, Clone)]
pub struct Pole {
    /// Complex rate `s` of `e^{st}` (1/s).
    pub s: c64,
    /// Parts of the rigid motions, where they are coupled.
    pub rigid: Vec<c64>,
    /// Parts of the strains.
    pub parts: Vec<c64>,
    /// `vᵀ(2sM + C)v` (J s/m²): with it a unit impulse at a makes `v v(a) e^{st}/norm`.
    pub norm: c64,
    /// Error of s, relative to |s|, because the motion is one on few strains.
    pub error: f64,
    /// Share of the rigid motions in the kinetic energy.
    pub rigid_share: f64,
    /// Share of the strains in the sum of both energies: a half where it swings, more where it
    /// creeps back, less where a dashpot stops it.
    pub strain_share: f64,
}

/// How a damped bat goes on by itself.
#[derive(Debug, Clone)]
pub struct FreeMotions {
    /// Groups of motions by rising |s|.
    pub groups: Vec<Group>,
    /// Motions of the rigid bat that dashpots slow down.
    pub rigid: Vec<Pole>,
    /// All other motions of the reduced bat.
    pub others: Vec<Pole>,
}

/// Strains under a force as `e^{iωt}`.
pub struct Answer {
    /// Parts of the rigid motions, where they are coupled.
    pub rigid: Vec<c64>,
    /// Parts of the strains.
    pub parts: Vec<c64>,
    /// What the projection misses, as real and imaginary strains.
    pub residual: [Vec<f64>; 2],
}

/// A force of 1 N somewhere, and the deflection there.
#[derive(Debug, Clone)]
pub struct Place {
    /// Deflection by the free rigid motions (m).
    pub rigid: Vec<f64>,
    /// Deflection by every strain of the reduced bat (m); those that join later have none.
    pub row: Vec<f64>,
}

impl Reduced {
    /// The bat on that mesh with `wanted` of its modes and some more.
    ///
    /// # Errors
    ///
    /// As [`Flexible::slowest`].
    pub fn new(
        bat: &Bat,
        mesh: &Mesh,
        degree: usize,
        theory: Theory,
        wanted: usize,
    ) -> Result<Self> {
        let mut flexible = Flexible::new(bat, mesh, degree, theory);
        let (omega, strains, _) = flexible.slowest(wanted + (wanted / 2).max(4))?;
        /// Slower than that share of mode 1 no rigid motion is seen to come to rest.
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

    /// Whether the number of strains is 0.
    pub fn is_empty(&self) -> bool {
        self.members.is_empty()
    }

    /// The strains of member k.
    pub fn strains(&self, k: usize) -> &[f64] {
        &self.members[k].strains
    }

    fn member(&self, strains: Vec<f64>, with_inertia: bool) -> Member {
        let mut inertia = vec![];
        if with_inertia {
            inertia = self.flexible.inertia(&strains);
            // What is left of the modes in it is round-off, and of a slow mode that is much.
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
        let both = |a: &[f64], b: &[f64], old: &Member, of_old: &[f64]| match b.is_empty() {
            true => 0.0,
            false => 0.5 * (dot(a, of_old) + dot(b, &old.strains)),
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

    /// Takes these strains in, if they are not there yet.
    pub fn add(&mut self, mut strains: Vec<f64>) -> bool {
        /// Less than that share of them is round-off.
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

    /// Damping of mode k by the dashpots, `vᵀC v` (s) for a strain energy of `½ vᵀv = ½`: its
    /// damping ratio is half of it times ω.
    pub fn mode_damping(&self, k: usize) -> f64 {
        let drawn = self.members[k].drawn.iter().zip(&self.flexible.dashpots);
        drawn.map(|(w, d)| d.constant * w * w).sum::<f64>() / self.flexible.energy_unit
    }

    /// How many unknowns are rigid motions.
    fn rigid_unknowns(&self) -> usize {
        if self.coupled { self.flexible.rigid.len() } else { 0 }
    }

    /// Mass of an unknown rigid motion, in the unit of energy (s²/m² or s²).
    fn rigid_mass(&self, k: usize) -> f64 {
        self.flexible.rigid[k].mass / self.flexible.energy_unit
    }

    /// C (s) of all unknowns, rigid motions first, as far as it is the dashpots'.
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

    /// Takes the strains' part that the members hold out of a residual `s² M q + s C q + iK″ q` of
    /// those parts; what is left is the residual.
    fn residual(&self, s: c64, hysteretic: bool, rigid: &[c64], parts: &[c64]) -> [Vec<f64>; 2] {
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

    /// The slowest `wanted` motions of the damped bat, as [`Group`]s of rising |s|, those of the
    /// rigid motions that dashpots slow down, and all others of the reduced bat, which are not its
    /// own but make a blow's response begin at zero. The materials' loss is that of viscous dashpots
    /// with the modes' own damping ratios.
    ///
    /// Strains are taken in until no s changes by more than `tolerance`, relative to |s|, or no
    /// further ones are there.
    ///
    /// # Errors
    ///
    /// [`Error::NotConverged`] if the small eigenproblem has no solution, [`Error::Value`] where
    /// dashpots are so large that round-off leaves no motion that dies out.
    pub fn free_motions(&mut self, wanted: usize, tolerance: f64) -> Result<FreeMotions> {
        const MOST_ROUNDS: usize = 12;
        const MOST_MEMBERS: usize = 400;
        let mut round = 0;
        loop {
            let FreeMotions { mut groups, rigid, mut others } =
                grouped(self.poles()?, self.rigid_unknowns());
            let beyond = groups.split_off(wanted.min(groups.len()));
            others.extend(beyond.into_iter().flat_map(|group| group.poles));
            let [mass, damping] = self.viscous();
            let poles = groups.iter_mut().flat_map(|group| &mut group.poles);
            let mut missing = vec![];
            for pole in poles {
                self.polish(&mass, &damping, pole);
                let residual = self.residual(pole.s, false, &pole.rigid, &pole.parts);
                let square: f64 = residual.iter().map(|r| dot(r, r)).sum();
                let norm = pole.norm / self.flexible.energy_unit;
                pole.error = square / (pole.s * norm).norm();
                if pole.error > tolerance {
                    missing.extend(residual);
                }
            }
            let full = round == MOST_ROUNDS || self.members.len() >= MOST_MEMBERS;
            let before = self.members.len();
            if !full {
                missing.into_iter().for_each(|strains| {
                    self.add(strains);
                });
            }
            if self.members.len() == before {
                let mut rigid = rigid;
                let rest = rigid.iter_mut().chain(&mut others);
                rest.for_each(|pole| self.polish(&mass, &damping, pole));
                let all = groups.iter().flat_map(|group| &group.poles).chain(&rigid);
                possible(all)?;
                return Ok(FreeMotions { groups, rigid, others });
            }
            round += 1;
        }
    }

    /// All eigenvalues of the reduced bat with `Im s ≥ 0`.
    ///
    /// With `μ = 1/s`, `M = diag(ℓ²)` and `p = ℓq/μ` the problem `(M + μC + μ²) q = 0` is
    ///
    /// ```text
    /// μ q = −C q − ℓ p,   μ p = ℓ q,
    /// ```
    ///
    /// whose norm is that of the slowest motion, however fast the others are. A rigid motion ρ of
    /// mass m, which only dashpots hold, joins as `ρ′ = ρ + B q`, `B = C_ρρ⁻¹ C_ρq`:
    /// `μ ρ′ = m C_ρρ⁻¹ (B q − ρ′)`, and C becomes `C − C_qρ B` beside `C_qρ ρ′`.
    fn poles(&self) -> Result<Vec<Pole>> {
        let (modes, n, r) = (self.omega.len(), self.members.len(), self.rigid_unknowns());
        let failed = || Error::NotConverged { wanted: n, converged: 0, steps: 0 };
        // M diagonal: the modes' is.
        let extra = n - modes;
        let block =
            Mat::from_fn(extra, extra, |i, j| self.mass[modes + i.max(j)][modes + i.min(j)]);
        let (mut lengths, mut turned) = (vec![0.0; n], Mat::<f64>::identity(n, n));
        (0..modes).for_each(|k| lengths[k] = 1.0 / self.omega[k]);
        if extra > 0 {
            let eigen = block.self_adjoint_eigen(Side::Lower).map_err(|_| failed())?;
            for j in 0..extra {
                lengths[modes + j] = eigen.S().column_vector()[j].max(0.0).sqrt();
                (0..extra).for_each(|i| turned[(modes + i, modes + j)] = eigen.U()[(i, j)]);
            }
        }
        let [_, all] = self.viscous();
        // Rigid motions in units in which their mass is that of the slowest mode's strains.
        let slowest = lengths.first().copied().unwrap_or(1.0);
        let unit: Vec<f64> = (0..r).map(|k| slowest / self.rigid_mass(k).sqrt()).collect();
        let mut wide = Mat::<f64>::identity(r + n, r + n);
        (0..r).for_each(|k| wide[(k, k)] = unit[k]);
        for i in 0..n {
            (0..n).for_each(|j| wide[(r + i, r + j)] = turned[(i, j)]);
        }
        let c = wide.transpose() * &all * &wide;
        let inverse = inverted(&c, r);
        let mixed =
            Mat::from_fn(r, n, |i, j| (0..r).map(|k| inverse[i][k] * c[(k, r + j)]).sum::<f64>());
        let mut state = Mat::<f64>::zeros(2 * n + r, 2 * n + r);
        for i in 0..n {
            for j in 0..n {
                let bound = (0..r).map(|k| c[(r + i, k)] * mixed[(k, j)]).sum::<f64>();
                state[(i, j)] = bound - c[(r + i, r + j)];
            }
            state[(i, n + i)] = -lengths[i];
            state[(n + i, i)] = lengths[i];
            (0..r).for_each(|k| state[(i, 2 * n + k)] = -c[(r + i, k)]);
        }
        let square = slowest * slowest;
        for k in 0..r {
            for l in 0..r {
                state[(2 * n + k, 2 * n + l)] = -square * inverse[k][l];
                for j in 0..n {
                    state[(2 * n + k, j)] += square * inverse[k][l] * mixed[(l, j)];
                }
            }
        }
        /// Round-off takes a double eigenvalue apart by its root, 1e-8.
        const SAME: f64 = 1e-6;
        let eigen = state.eigen().map_err(|_| failed())?;
        let mut poles = vec![];
        for (j, mu) in eigen.S().column_vector().iter().enumerate() {
            if mu.im > 0.0 || mu.norm() == 0.0 {
                continue;
            }
            let column = |i: usize| eigen.U()[(i, j)];
            let strains: Vec<c64> = (0..n).map(column).collect();
            let rigid: Vec<c64> = (0..r)
                .map(|k| {
                    let bound: c64 = (0..n).map(|i| strains[i] * mixed[(k, i)]).sum();
                    column(2 * n + k) - bound
                })
                .collect();
            let pole = |s: c64, strains: &[c64], rigid: &[c64]| {
                let size = |of: &[c64]| of.iter().map(|p| p.norm_sqr()).sum::<f64>();
                let moving = strains.iter().zip(&lengths).map(|(p, l)| p.norm_sqr() * l * l);
                let moving = moving.sum::<f64>() + square * size(rigid);
                let strained = size(strains);
                let part = |i: usize| (0..n).map(|k| strains[k] * turned[(i, k)]).sum();
                Pole {
                    s,
                    rigid: rigid.iter().zip(&unit).map(|(p, unit)| *p * *unit).collect(),
                    parts: (0..n).map(part).collect(),
                    norm: c64::new(0.0, 0.0),
                    error: 0.0,
                    rigid_share: square * size(rigid) / moving,
                    strain_share: strained / (strained + moving * s.norm_sqr()),
                }
            };
            let one = pole(1.0 / *mu, &strains, &rigid);
            // What swings has as much of both energies. A pair that has not is the same real
            // eigenvalue twice, and round-off an imaginary part; its vectors are both parts.
            let twice = mu.im != 0.0
                && mu.im.abs() < SAME * mu.norm()
                && (one.strain_share - 0.5).abs() > SAME;
            if !twice {
                poles.push(one);
                continue;
            }
            for of in [|p: &c64| c64::new(p.re, 0.0), |p: &c64| c64::new(p.im, 0.0)] {
                let [strains, rigid] =
                    [&strains, &rigid].map(|all| all.iter().map(of).collect::<Vec<c64>>());
                poles.push(pole(c64::new(one.s.re, 0.0), &strains, &rigid));
            }
        }
        Ok(poles)
    }

    /// Makes an eigenvalue and its vector as good as arithmetic allows: inverse iteration
    /// `Z(s) v ← Z′(s) v`, `Z = s²M + sC + K`, and the root of Rayleigh's functional
    /// `s² vᵀMv + s vᵀCv + vᵀKv`, whose error is the square of the vector's.
    fn polish(&self, mass: &Mat<f64>, damping: &Mat<f64>, pole: &mut Pole) {
        const STEPS: usize = 3;
        let (r, size) = (self.rigid_unknowns(), mass.nrows());
        let real = pole.s.im == 0.0;
        let (mut s, mut v) = (pole.s, [&pole.rigid[..], &pole.parts].concat());
        let product = |matrix: &Mat<f64>, v: &[c64], i: usize| -> c64 {
            v.iter().enumerate().map(|(j, v)| *v * matrix[(i, j)]).sum()
        };
        let form = |matrix: &Mat<f64>, v: &[c64]| -> c64 {
            v.iter().enumerate().map(|(i, own)| *own * product(matrix, v, i)).sum()
        };
        for _ in 0..STEPS {
            let z = Mat::from_fn(size, size, |i, j| {
                let stiffness = f64::from(u8::from(i == j && i >= r));
                s * s * mass[(i, j)] + s * damping[(i, j)] + stiffness
            });
            let slope = |i: usize, _| s * product(mass, &v, i) * 2.0 + product(damping, &v, i);
            let solved = z.partial_piv_lu().solve(Mat::from_fn(size, 1, slope));
            let next: Vec<c64> = (0..size).map(|i| solved[(i, 0)]).collect();
            let length = next.iter().map(|v| v.norm_sqr()).sum::<f64>().sqrt();
            if !(length.is_finite() && length > 0.0) {
                break;
            }
            v = next.iter().map(|v| *v / length).collect();
            let stiffness = v[r..].iter().map(|v| *v * *v).sum();
            s = nearest_root(form(mass, &v), form(damping, &v), stiffness, s);
            if real {
                s.im = 0.0;
            }
        }
        /// Beyond that it is another one.
        const SAME: f64 = 1e-3;
        if (s - pole.s).norm() < SAME * pole.s.norm() {
            (pole.rigid, pole.parts) = (v[..r].to_vec(), v[r..].to_vec());
            pole.s = s;
        } else {
            v = [&pole.rigid[..], &pole.parts].concat();
        }
        let norm = pole.s * form(mass, &v) * 2.0 + form(damping, &v);
        pole.norm = norm * self.flexible.energy_unit;
    }

    /// M (s²) of all unknowns, rigid motions first, and C (s) with the materials' part.
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

    /// The rigid motions that go on for ever where dashpots move them, at `s = 0`: constant
    /// displacements, with their [`Pole::norm`].
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
            // The second without the first's part, as C measures it.
            _ => {
                let part = c[(0, 1)] / c[(0, 0)];
                let rest = c[(1, 1)] - part * c[(0, 1)];
                vec![pole(vec![1.0, 0.0], c[(0, 0)]), pole(vec![-part, 1.0], rest)]
            }
        }
    }

    /// How much of a pole's motion is in the displacement of these rigid motions and modes when it
    /// is let go at rest: `vᵀ(sM + C)u/norm`.
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

    /// A force or a deflection at x; its static strains join the others.
    pub fn place(&mut self, x: f64) -> Place {
        let row = self.flexible.row(x);
        self.add(row.clone());
        let rigid = self.flexible.rigid.iter().map(|rigid| rigid.deflection(x)).collect();
        Place { rigid, row: self.members.iter().map(|m| dot(&m.strains, &row)).collect() }
    }

    /// The strains under a force of `e^{iωt}` newtons at a place, the materials' stiffness times
    /// `1 + iη`; `damping` is [`Self::damping`].
    pub fn answer(&self, damping: &Mat<f64>, place: &Place, omega: f64) -> Answer {
        let (n, r) = (self.members.len(), self.rigid_unknowns());
        let (square, unit) = (omega * omega, self.flexible.energy_unit);
        let z = Mat::from_fn(r + n, r + n, |i, j| {
            let (mut real, mut imaginary) = (0.0, omega * damping[(i, j)]);
            if i >= r && j >= r {
                let (low, high) = (i.min(j) - r, i.max(j) - r);
                real = f64::from(u8::from(i == j)) - square * self.mass[high][low];
                imaginary += self.loss[high][low];
            } else if i == j {
                real = -square * self.rigid_mass(i);
            }
            c64::new(real, imaginary)
        });
        let forces = place.rigid[..r].iter().chain(&place.row);
        let forces: Vec<f64> = forces.map(|w| w / unit).collect();
        let force = |i: usize, _| c64::new(forces.get(i).copied().unwrap_or(0.0), 0.0);
        let solved = z.partial_piv_lu().solve(Mat::from_fn(r + n, 1, force));
        let of = |range: std::ops::Range<usize>| range.map(|i| solved[(i, 0)]).collect();
        let (rigid, parts): (Vec<c64>, Vec<c64>) = (of(0..r), of(r..r + n));
        let residual = self.residual(c64::new(0.0, omega), true, &rigid, &parts);
        Answer { rigid, parts, residual }
    }
}

impl Answer {
    /// The deflection at a place (m), without the rigid motions that dashpots leave alone.
    pub fn at(&self, place: &Place) -> c64 {
        let strains = self.parts.iter().zip(&place.row).map(|(part, w)| *part * *w);
        let rigid = self.rigid.iter().zip(&place.rigid).map(|(part, w)| *part * *w);
        strains.chain(rigid).sum()
    }

    /// Size of the residual.
    pub fn missed(&self) -> f64 {
        self.residual.iter().map(|r| dot(r, r)).sum::<f64>().sqrt()
    }
}

/// One motion of the damped bat: a complex pair, its half with `Im s > 0`, or two real ones.
#[derive(Debug, Clone)]
pub struct Group {
    /// One, or the two real ones.
    pub poles: Vec<Pole>,
}

impl Group {
    /// `√(s s*)`, or `√(s₁ s₂)` of two real ones (rad/s).
    pub fn natural(&self) -> f64 {
        match &self.poles[..] {
            [a, b] => (a.s.re * b.s.re).abs().sqrt(),
            poles => poles.iter().map(|pole| pole.s.norm()).sum(),
        }
    }

    /// `−Re s/|s|`, or `−½(s₁ + s₂)/√(s₁ s₂)`, which is above 1.
    pub fn ratio(&self) -> f64 {
        let sum: f64 = self.poles.iter().map(|pole| pole.s.re).sum();
        -sum / (self.poles.len() as f64 * self.natural())
    }
}

/// Complex pairs and pairs of real eigenvalues, by rising |s|; those that belong to `rigid` coupled
/// rigid motions apart.
fn grouped(poles: Vec<Pole>, rigid: usize) -> FreeMotions {
    let (mut real, pairs): (Vec<Pole>, Vec<Pole>) = poles.into_iter().partition(|p| p.s.im == 0.0);
    real.sort_by(|a, b| b.rigid_share.total_cmp(&a.rigid_share));
    let strained = real.split_off(rigid.min(real.len()));
    // Of two that belong together one creeps back and the other is stopped, with nearly the same
    // strains; the slowest looks for its own first.
    let (mut slow, mut fast): (Vec<Pole>, Vec<Pole>) =
        strained.into_iter().partition(|pole| pole.strain_share > 0.5);
    slow.sort_by(|a, b| b.s.norm().total_cmp(&a.s.norm()));
    let size = |a: &Pole| a.parts.iter().map(|p| p.norm_sqr()).sum::<f64>().sqrt();
    let alike = |a: &Pole, b: &Pole| {
        let both = a.parts.iter().zip(&b.parts).map(|(a, b)| *a * *b).sum::<c64>();
        both.norm() / (size(a) * size(b))
    };
    let mut groups: Vec<Group> =
        pairs.into_iter().map(|pole| Group { poles: vec![pole] }).collect();
    while let Some(one) = slow.pop() {
        let order =
            |i: &usize, j: &usize| alike(&one, &fast[*i]).total_cmp(&alike(&one, &fast[*j]));
        let Some(partner) = (0..fast.len()).max_by(order) else {
            slow.push(one);
            break;
        };
        groups.push(Group { poles: vec![one, fast.remove(partner)] });
    }
    groups.sort_by(|a, b| a.natural().total_cmp(&b.natural()));
    slow.append(&mut fast);
    FreeMotions { groups, rigid: real, others: slow }
}

/// Whether all of these motions die out, as they must.
fn possible<'a>(mut poles: impl Iterator<Item = &'a Pole>) -> Result<()> {
    const ROUND_OFF: f64 = 1e-9;
    let lost = |pole: &&Pole| !(pole.s.re <= ROUND_OFF * pole.s.norm() && pole.s.norm() > 0.0);
    match poles.find(lost) {
        None => Ok(()),
        Some(_) => {
            let found = "dashpots so strong that round-off hides all that they damp";
            let expected = "a damping that lets the bat move, or a support in its place";
            Err(Error::value("damping", found, expected))
        }
    }
}

/// The root of `a s² + b s + c` that is nearest to a guess.
fn nearest_root(a: c64, b: c64, c: c64, guess: c64) -> c64 {
    let root = (b * b - a * c * 4.0).sqrt();
    // The sum that does not cancel.
    let sum = if (b + root).norm() > (b - root).norm() { b + root } else { b - root };
    let roots = [sum / a * -0.5, c / sum * -2.0];
    let far = |s: &c64| (*s - guess).norm();
    let best = if far(&roots[0]) < far(&roots[1]) { roots[0] } else { roots[1] };
    if best.re.is_finite() && best.im.is_finite() { best } else { guess }
}

/// The inverse of the leading `r × r` block, `r` at most 2.
fn inverted(c: &Mat<f64>, r: usize) -> [[f64; 2]; 2] {
    match r {
        0 => [[0.0; 2]; 2],
        1 => [[1.0 / c[(0, 0)], 0.0], [0.0; 2]],
        _ => {
            let det = c[(0, 0)] * c[(1, 1)] - c[(0, 1)] * c[(1, 0)];
            [[c[(1, 1)] / det, -c[(0, 1)] / det], [-c[(1, 0)] / det, c[(0, 0)] / det]]
        }
    }
}

/// Takes the members' parts out of strains.
fn take_out(strains: &mut [f64], members: &[Member]) {
    for member in members {
        let part = dot(strains, &member.strains);
        strains.iter_mut().zip(&member.strains).for_each(|(r, v)| *r -= part * v);
    }
}

/// Unit strains, unless there are none.
fn normalize(strains: &mut [f64]) -> bool {
    let size = dot(strains, strains).sqrt();
    if !(size > 0.0 && size.is_finite()) {
        return false;
    }
    strains.iter_mut().for_each(|v| *v /= size);
    true
}
