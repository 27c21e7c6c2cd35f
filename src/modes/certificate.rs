//! How accurate is a computed mode, beyond what its own defect tells?
//!
//! [`crate::solve()`] calls these functions; their results are in [`crate::modes::mode::ModeError`].

use crate::modes::certainty::{Doubt, Shares};
use crate::modes::mode::Mode;

/// Relative round-off of a frequency by the running sums.
///
/// They keep ε for the slowest mode. A faster mode has ε times the ratio of the frequencies, and long sums lose a
/// little more. This was measured on cones, steps and dowels of up to 10⁶ elements; `examples/tuning/round_off.rs`
/// prints true and stated round-off side by side. For a dowel on 100 to 10 000 elements the true one is at most two
/// thirds of the stated one. The moments that describe sections of elements `over` stations are known to a few ε.
pub fn round_off(ratio: f64, elements: usize, over: bool) -> f64 {
    let length = 1.0 + (elements as f64).sqrt() / 25.0;
    let sections = if over { 64.0 } else { 4.0 };
    f64::EPSILON * (sections + 1.5 * ratio.max(1.0) * length)
}

/// Divides the error between mesh and arithmetic; `ratio` is the frequency over the lowest one.
///
/// A factored `K` loses ε n⁴, which shows in the residual; its square is the error of Rayleigh's
/// quotient.
pub fn account(mode: &mut Mode, ratio: f64, (elements, over): (usize, bool), factored: bool) {
    let sums = round_off(ratio, elements, over);
    mode.error.round_off = sums;
    if factored {
        let solver = 0.5 * mode.error.residual.powi(2);
        mode.error.discretization = (mode.error.discretization - solver).max(0.0);
        mode.error.round_off += solver;
    }
    blur(mode, sums);
}

/// Relative loss of accuracy of a frequency, if the residual exceeds that at which the iteration stopped (`left`).
///
/// Much slower modes leave their round-off in the compliance. If they and all other slower modes were removed from a
/// mode (`apart`), the residual beyond `left` shows it, and half of that is the frequency's. Thick parts on thin ones
/// leave round-off too, as in a chain of cylinders. The residual of a usual bat is a few ε times the square of the
/// `ratio` and is not counted. If the iteration stopped at a larger residual, it hides the round-off.
pub fn lost(residual: f64, left: f64, ratio: f64, apart: bool) -> f64 {
    const USUAL: f64 = 3.0 * f64::EPSILON;
    /// Iterations stop at more than this; a smaller residual is round-off.
    const ARITHMETIC: f64 = 3e-14;
    /// If both are a few ε, the frequency may lose three times the residual, but no more than this.
    const CHANCE: f64 = 48.0 * f64::EPSILON;
    let beyond = ((residual - left) * (residual + left)).max(0.0).sqrt();
    if apart {
        0.5 * beyond
    } else if left > 0.1 * residual && residual > ARITHMETIC {
        0.0
    } else {
        let beyond = (beyond - USUAL * ratio * ratio).max(0.0);
        0.5 * beyond + (2.5 * beyond).min(CHANCE)
    }
}

/// Turns a relative round-off of a frequency into that of the shape, the nodes and the modal mass.
///
/// The round-off of the shape is a share of its largest deflection. Where the shape is flat, between stiff springs or
/// in a thick part next to a thin one, the slope gives the shift of a node.
fn blur(mode: &mut Mode, sums: f64) {
    let usual = 10.0 * mode.shape.length() / mode.nodes.len().max(1) as f64;
    mode.error.nodes += sums * usual.max(LOCAL * mode.doubt.flattest);
    mode.doubt.rounding += LOCAL * sums;
    mode.error.modal_mass += 10.0 * sums;
    mode.error.shape += 10.0 * sums;
}

/// Adds the effect of a relative round-off of the frequency, such as that of the sections: a frequency is proportional
/// to `√(EI/ρA)`.
pub fn add_round_off(mode: &mut Mode, relative: f64) {
    mode.error.round_off += relative;
    blur(mode, relative);
}

/// Round-off of a deflection, relative to the largest, over that of the frequency.
const LOCAL: f64 = 3.0;

/// A faster mode's η may be this many times its estimate, or may have changed the gap to it by that much. This and the
/// two constants below were chosen on near twins: `search/bats.py --kind whips` prints the largest ratios of true to
/// stated errors of frequencies, masses and nodes.
const UNSURE: f64 = 2.0;

/// If this share of the energy may belong to another mode, nothing is known about the nodes.
const UNKNOWN: f64 = 0.25;

/// If a mode's neighbour is this close, its nodes may move far where its deflection is flat.
const NEAR: f64 = 0.1;

/// Adds the effect of near twins to relative errors of frequencies; `omegas` rise.
///
/// A mesh may represent two modes of one frequency unequally well. If one of two equal whips has longer elements, each
/// rings alone on the mesh, while both ring in every mode of the bat. Let `r_j` be the remainder of the exact
/// compliance's product with mode j, orthogonal to the mesh's modes. The exact eigenvalues are those of
///
/// ```text
/// diag(θ_j) + (r_i·r_j)/θ,     (r_j·r_j)/θ² = η_j
/// ```
///
/// except for a factor `1 − λ/λ_l` of the modes l that the mesh does not represent, as in η itself. The second matrix
/// has no negative eigenvalue and the trace `Σ η_j`, and slower modes do not raise the k-th eigenvalue (Courant and
/// Fischer): it rises at most by `η_k` and those `η_j` of faster modes that are not small compared with their gap
/// `1 − λ_k/λ_j`.
///
/// # Source
///
/// B. N. Parlett, The Symmetric Eigenvalue Problem (1980), chapters 10 and 11.
pub fn share(omegas: &[f64], errors: &mut [f64]) {
    let worst = errors.iter().fold(0.0, |worst: f64, error| worst.max(*error));
    for k in 0..omegas.len() {
        for j in k + 1..omegas.len() {
            let gap = 1.0 - (omegas[k] / omegas[j]).powi(2);
            if gap > (UNSURE + 1.0) * 2.0 * worst {
                break;
            }
            let part = UNSURE + 1.0 - gap / (2.0 * errors[j]).max(f64::MIN_POSITIVE);
            errors[k] += errors[j] * part.clamp(0.0, 1.0);
        }
    }
}

/// Whether the mode after `count` others is so close to the last of them that it must be evaluated too, from the
/// `ratio` of their λ (at most 1). The gaps of a bat are usually 2/n or more at the n-th mode.
/// `examples/tuning/gaps.rs` prints the smallest of 40 modes, times n: 0.7 or more on all bats of `meshes/`, except for
/// modes 37 and 38 of the two-piece bat with shear (0.07).
pub fn is_twin(ratio: f64, count: usize) -> bool {
    (1.0 - ratio) * (count as f64) < 0.2
}

/// Data of a mode among others: ω (rad/s), the relative error of the frequency, the modal mass.
#[derive(Clone, Copy)]
struct KnownMode {
    omega: f64,
    error: f64,
    mass: f64,
}

/// The possible share of another mode in a mode.
#[derive(Clone, Copy)]
struct SharedMotion {
    /// Index of the other mode.
    other: usize,
    /// `|1 − λ/λ_j|`.
    gap: f64,
    /// Sine of the angle towards the other.
    turn: f64,
    /// The other mode's part in the shape, whose largest deflection is 1.
    share: f64,
}

/// The possible share of mode `other` in mode `k` if the iteration left that residual.
fn part(all: &[KnownMode], k: usize, other: usize, residual: f64) -> SharedMotion {
    let (own, its) = (all[k], all[other]);
    let gap = (1.0 - (own.omega / its.omega).powi(2)).abs().max(f64::EPSILON);
    let certain = (gap - 2.0 * UNSURE * all[k.max(other)].error).max(f64::EPSILON);
    let mesh = 2.0 * (own.error * its.error).sqrt() / certain;
    let turn = (mesh + residual / gap.min(1.0)).min(1.0);
    SharedMotion { other, gap, turn, share: turn * (own.mass / its.mass).sqrt() }
}

/// Adds the effect of other modes to a mode's errors. `beyond` is ω (rad/s) of the first mode above the list, `left`
/// the residuals at which an iteration stopped.
///
/// The defect weights the share `c` of another mode `j` by the gap `|1 − λ/λ_j|`, so the nearest ones hardly contribute
/// to it. The eigensolver leaves at most `c = residual/gap` of them (Davis and Kahan), which costs Rayleigh's quotient
/// `c² gap`. The mesh mixes in `c ≈ 2 √(e e_j)/gap`, with `e` the relative errors of both frequencies: the off-diagonal
/// part in [`share`] over a gap reduced by the possible errors. For the two nearest modes all of it counts, because it
/// is the whole error where a deflection is superconvergent, at the ends. For the others, only the part that is missing
/// from the defect counts. In a shape of modal mass m the share is `c √(m/m_j)` beside a remainder of `√(1 − c²)`. If
/// there is no mode above or below, the other side counts twice. Frequencies closer to each other than ε count as ε
/// apart.
pub fn add_neighbours(modes: &mut [Mode], beyond: Option<f64>, left: &[f64], factored: bool) {
    let (mut lightest, mut worst) = (f64::INFINITY, 0.0_f64);
    let mut all: Vec<KnownMode> = Vec::with_capacity(modes.len() + 1);
    for mode in modes.iter() {
        let known =
            KnownMode { omega: mode.omega, error: mode.error.total(), mass: mode.modal_mass };
        (lightest, worst) = (lightest.min(known.mass), worst.max(known.error));
        all.push(known);
    }
    all.extend(beyond.map(|omega| KnownMode { omega, error: worst, mass: lightest }));
    let omegas: Vec<f64> = all.iter().map(|known| known.omega).collect();
    let mut errors: Vec<f64> = all.iter().map(|known| known.error).collect();
    share(&omegas, &mut errors);
    let doubts: Vec<Doubt> = modes.iter_mut().map(|mode| std::mem::take(&mut mode.doubt)).collect();
    let mut parts: Vec<SharedMotion> = Vec::with_capacity(all.len() + 1);
    let mut of: Vec<(usize, f64)> = Vec::with_capacity(all.len() + 1);
    for k in 0..modes.len() {
        // The residual with a factored `K` is its round-off, in the fastest modes.
        let residual = if factored { 0.0 } else { modes[k].error.residual };
        let below = (k > 0).then(|| part(&all, k, k - 1, residual));
        let above = (k + 1 < all.len()).then(|| part(&all, k, k + 1, residual));
        let both = [below.or(above), above.or(below)].into_iter().flatten();
        let far = (0..all.len()).filter(|j| j.abs_diff(k) > 1).map(|j| {
            let part = part(&all, k, j, 0.0);
            let unseen = (1.0 - part.gap).max(0.0);
            SharedMotion { turn: part.turn * unseen, share: part.share * unseen, ..part }
        });
        parts.clear();
        parts.extend(both.clone().chain(far));
        let alone = if parts.is_empty() { 4.0 * all[k].error + residual } else { 0.0 };
        let mixed = alone + parts.iter().map(|part| part.share).sum::<f64>();
        let lost = parts.iter().map(|part| part.turn.powi(2)).sum::<f64>().min(1.0);
        let beside = 1.0 / (1.0 - lost).max(f64::EPSILON).sqrt();
        let beside_or_near = |part: &&SharedMotion| part.other.abs_diff(k) == 1 || part.gap < NEAR;
        let near = parts.iter().filter(beside_or_near).filter(|part| part.other < modes.len());
        let nodes = modes[k].shape.slopes(&modes[k].nodes);
        let shift = |part: &SharedMotion| part.share * modes[part.other].shape.shift(&nodes);
        let moved: f64 = near.map(shift).sum();
        of.clear();
        of.extend(parts.iter().map(|part| (part.other, part.share)));
        let shares = Shares { of: &of, motions: &doubts };
        let told = doubts[k].tell(&modes[k].shape, &modes[k].nodes, shares);
        let nearest = both.map(|part| part.gap).fold(1.0, f64::min);
        let mode = &mut modes[k];
        let length = mode.shape.length();
        // A frequency is never farther from a mode's than the residual, however close others are.
        let cost_of = |left: &f64| 0.5 * left * (left / nearest).min(1.0);
        mode.error.discretization += left.get(k).map_or(0.0, cost_of) + errors[k] - all[k].error;
        mode.error.modal_mass += mixed * (2.0 + mixed) + lost;
        // At most, the whole shape is that of another mode, and the nodes may be anywhere.
        mode.error.shape += (mixed * beside).min(1.0);
        let spread = (mixed * length / mode.nodes.len().max(1) as f64).max(2.0 * moved);
        let shifted = if lost < UNKNOWN { spread * beside } else { length };
        mode.error.nodes = (mode.error.nodes + shifted.min(length)).max(told.error).min(length);
        (mode.nodes, mode.untold) = (told.nodes, told.untold);
    }
}
