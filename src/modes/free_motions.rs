//! How does a damped bat move freely?

use faer::linalg::solvers::Solve;
use faer::{Mat, c64};

use crate::base::linear::solve_two;
use crate::base::{Error, Result, dot};
use crate::modes::pole::{FreeMotions, Group, Pole, grouped, possible};
use crate::modes::reduced::Reduced;

impl Reduced {
    /// The slowest `wanted` modes of the damped bat, as groups of rising |s|; the rigid motions that dashpots slow
    /// down; and all other modes of the reduced bat. The last are artefacts of the reduction, needed so that the
    /// response to a blow begins at zero. The materials' loss is that of viscous dashpots with the modes' own damping
    /// ratios.
    ///
    /// Strains are added until no s changes by more than `tolerance`, relative to |s|, or until there are no more.
    ///
    /// # Errors
    ///
    /// [`Error::NotConverged`] if the small eigenproblem has no solution; [`Error::Value`] if dashpots are so large
    /// that round-off hides the decay.
    pub fn free_motions(&mut self, wanted: usize, tolerance: f64) -> Result<FreeMotions> {
        const MOST_ROUNDS: usize = 12;
        const MOST_MEMBERS: usize = 400;
        let mut round = 0;
        loop {
            let FreeMotions { mut groups, rigid, mut others } =
                grouped(State::of(self)?.poles()?, self.rigid_unknowns());
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
                let condition = 1.0 / (pole.s * norm).norm();
                if square * condition > tolerance {
                    missing.extend(residual);
                }
                pole.error = (square + self.round_off(&mass, &damping, pole)) * condition;
            }
            let full = round == MOST_ROUNDS || self.len() >= MOST_MEMBERS;
            let before = self.len();
            if !full {
                missing.into_iter().for_each(|strains| {
                    self.add(strains);
                });
            }
            if self.len() == before {
                let mut rigid = rigid;
                let rest = rigid.iter_mut().chain(&mut others);
                rest.for_each(|pole| self.polish(&mass, &damping, pole));
                near_others(&mut groups, &others);
                let all = groups.iter().flat_map(|group| &group.poles).chain(&rigid);
                possible(all)?;
                return Ok(FreeMotions { groups, rigid, others });
            }
            round += 1;
        }
    }

    /// Round-off of `vᵀ Z(s) v`. Each of its terms is known to a relative ε. Strains coupled by dashpots, a share of
    /// `|s| |C v|` and at most 1, are known to 2 ε times the ratio of s to the slowest mode's.
    fn round_off(&self, mass: &Mat<f64>, damping: &Mat<f64>, pole: &Pole) -> f64 {
        let r = self.rigid_unknowns();
        let sizes: Vec<f64> = pole.rigid.iter().chain(&pole.parts).map(|v| v.norm()).collect();
        let s = pole.s.norm();
        let of = |matrix: &Mat<f64>, i: usize| -> f64 {
            sizes.iter().enumerate().map(|(j, v)| v * matrix[(i, j)].abs()).sum()
        };
        let form = |matrix: &Mat<f64>| -> f64 {
            sizes.iter().enumerate().map(|(i, v)| v * of(matrix, i)).sum()
        };
        let strained: f64 = sizes[r..].iter().map(|v| v * v).sum();
        let pulled = (r..sizes.len()).map(|i| of(damping, i).powi(2)).sum::<f64>().sqrt();
        let ratio = self.omega.first().map_or(0.0, |slowest| s / slowest);
        let coupled = 2.0 * ratio * strained * (s * pulled).min(1.0);
        f64::EPSILON * (s * s * form(mass) + s * form(damping) + strained + coupled)
    }

    /// Improves an eigenvalue and its vector as far as arithmetic allows: inverse iteration `Z(s) v ← Z′(s) v` with
    /// `Z = s²M + sC + K`, and the root of Rayleigh's functional `s² vᵀMv + s vᵀCv + vᵀKv`, whose error is the square
    /// of the vector's.
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
        /// A larger change leads to another eigenvalue.
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
}

/// Adapts the first-order error e of every pole, `|vᵀ δZ v|/|s vᵀZ′v|`, to a nearby pole at the relative distance g:
/// `δ (δ + g) = e g`. As two poles meet, `vᵀZ′v` goes to zero, and s depends on the root of the error in Z.
fn near_others(groups: &mut [Group], others: &[Pole]) {
    let all: Vec<c64> =
        groups.iter().flat_map(|group| &group.poles).chain(others).map(|p| p.s).collect();
    let poles = groups.iter_mut().flat_map(|group| &mut group.poles).enumerate();
    for (k, pole) in poles.filter(|(_, pole)| pole.error.is_finite()) {
        let apart = |s: c64| (s - pole.s).norm() / pole.s.norm();
        let beside =
            all.iter().enumerate().filter(|(j, _)| *j != k).flat_map(|(_, s)| [*s, s.conj()]);
        let own = Some(pole.s.conj()).filter(|s| s.im != 0.0);
        let gap = beside.chain(own).map(apart).fold(f64::INFINITY, f64::min);
        pole.error *= 2.0 / (1.0 + (1.0 + 4.0 * pole.error / gap.max(f64::EPSILON)).sqrt());
    }
}

/// The eigenproblem of a reduced bat, `μ = 1/s`.
///
/// With `M = diag(ℓ²)` and `p = ℓq/μ` the problem `(M + μC + μ²) q = 0` is
///
/// ```text μ q = −C q − ℓ p,   μ p = ℓ q, ``` The norm of this matrix is that of the slowest mode, however fast the
/// others are. A rigid motion ρ of mass m, restrained only by dashpots, enters as `ρ′ = ρ + B q` with `B = C_ρρ⁻¹
/// C_ρq`: `μ ρ′ = m C_ρρ⁻¹ (B q − ρ′)`, and C becomes `C − C_qρ B` beside `C_qρ ρ′`.
struct State {
    /// `ℓ` (s), and the strains that make M diagonal, in terms of the members.
    lengths: Vec<f64>,
    turned: Mat<f64>,
    /// Units of the rigid motions that give them the mass of the slowest mode's strains, and that mass (s²).
    unit: Vec<f64>,
    mass: f64,
    /// `B`.
    mixed: Mat<f64>,
    /// The matrix for `(q, p, ρ′)`.
    matrix: Mat<f64>,
}

fn no_solution(wanted: usize) -> Error {
    Error::NotConverged { wanted, converged: 0, steps: 0 }
}

impl State {
    fn of(reduced: &Reduced) -> Result<Self> {
        let (n, r) = (reduced.len(), reduced.rigid_unknowns());
        let (lengths, turned) = reduced.diagonal()?;
        let [_, all] = reduced.viscous();
        let slowest = lengths.first().copied().unwrap_or(1.0);
        let unit: Vec<f64> = (0..r).map(|k| slowest / reduced.rigid_mass(k).sqrt()).collect();
        let mut wide = Mat::<f64>::identity(r + n, r + n);
        (0..r).for_each(|k| wide[(k, k)] = unit[k]);
        for i in 0..n {
            (0..n).for_each(|j| wide[(r + i, r + j)] = turned[(i, j)]);
        }
        let c = wide.transpose() * &all * &wide;
        let inverse = inverted(&c, r);
        let mixed =
            Mat::from_fn(r, n, |i, j| (0..r).map(|k| inverse[i][k] * c[(k, r + j)]).sum::<f64>());
        let mut matrix = Mat::<f64>::zeros(2 * n + r, 2 * n + r);
        for i in 0..n {
            for j in 0..n {
                let bound = (0..r).map(|k| c[(r + i, k)] * mixed[(k, j)]).sum::<f64>();
                matrix[(i, j)] = bound - c[(r + i, r + j)];
            }
            matrix[(i, n + i)] = -lengths[i];
            matrix[(n + i, i)] = lengths[i];
            (0..r).for_each(|k| matrix[(i, 2 * n + k)] = -c[(r + i, k)]);
        }
        let mass = slowest * slowest;
        for k in 0..r {
            for l in 0..r {
                matrix[(2 * n + k, 2 * n + l)] = -mass * inverse[k][l];
                for j in 0..n {
                    matrix[(2 * n + k, j)] += mass * inverse[k][l] * mixed[(l, j)];
                }
            }
        }
        Ok(Self { lengths, turned, unit, mass, mixed, matrix })
    }

    /// All eigenvalues with `Im s ≥ 0`.
    fn poles(&self) -> Result<Vec<Pole>> {
        /// Round-off splits a double eigenvalue by its square root, 1e-8.
        const SAME: f64 = 1e-6;
        let (n, r) = (self.lengths.len(), self.unit.len());
        let eigen = self.matrix.eigen().map_err(|_| no_solution(n))?;
        let mut poles = vec![];
        for (j, mu) in eigen.S().column_vector().iter().enumerate() {
            if mu.im > 0.0 || mu.norm() == 0.0 {
                continue;
            }
            let column = |i: usize| eigen.U()[(i, j)];
            let strains: Vec<c64> = (0..n).map(column).collect();
            let bound = |k: usize| -> c64 { (0..n).map(|i| strains[i] * self.mixed[(k, i)]).sum() };
            let rigid: Vec<c64> = (0..r).map(|k| column(2 * n + k) - bound(k)).collect();
            let one = self.pole(1.0 / *mu, &strains, &rigid);
            // An oscillation has equal parts of both energies. A pair without is one real eigenvalue twice, with an
            // imaginary part from round-off; real and imaginary part are its two vectors.
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
                poles.push(self.pole(c64::new(one.s.re, 0.0), &strains, &rigid));
            }
        }
        Ok(poles)
    }

    /// The motion of that eigenvalue with the given strains and rigid motions of this problem.
    fn pole(&self, s: c64, strains: &[c64], rigid: &[c64]) -> Pole {
        let size = |of: &[c64]| of.iter().map(|p| p.norm_sqr()).sum::<f64>();
        let moving = strains.iter().zip(&self.lengths).map(|(p, l)| p.norm_sqr() * l * l);
        let moving = moving.sum::<f64>() + self.mass * size(rigid);
        let strained = size(strains);
        let n = strains.len();
        let part = |i: usize| (0..n).map(|k| strains[k] * self.turned[(i, k)]).sum();
        Pole {
            s,
            rigid: rigid.iter().zip(&self.unit).map(|(p, unit)| *p * *unit).collect(),
            parts: (0..n).map(part).collect(),
            norm: c64::new(0.0, 0.0),
            error: 0.0,
            rigid_share: self.mass * size(rigid) / moving,
            strain_share: strained / (strained + moving * s.norm_sqr()),
        }
    }
}

/// The root of `a s² + b s + c` that is nearest to a guess.
fn nearest_root(a: c64, b: c64, c: c64, guess: c64) -> c64 {
    let root = (b * b - a * c * 4.0).sqrt();
    // The sum without cancellation.
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
            let block = [[c[(0, 0)], c[(0, 1)]], [c[(1, 0)], c[(1, 1)]]];
            let [a, b] = [[1.0, 0.0], [0.0, 1.0]].map(|unit| solve_two(block, unit));
            [[a[0], b[0]], [a[1], b[1]]]
        }
    }
}
