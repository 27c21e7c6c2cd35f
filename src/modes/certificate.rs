//! How far may a computed mode be trusted, beyond what its own defect tells?
//!
//! [`crate::solve()`] calls these; what they find is in [`crate::modes::mode::ModeError`].

use crate::modes::certainty::{Doubt, Shares};
use crate::modes::mode::Mode;

/// Relative round-off of a frequency by the running sums.
///
/// They keep ε of the slowest motion; a faster mode keeps ε times the ratio of their frequencies,
/// and long sums lose a little more: measured, on cones, steps and dowels of up to 10⁶
/// elements; `examples/tuning/round_off.rs` prints true and
/// stated round-off side by side: of a dowel on 100 to 10 000 elements the true is up to two thirds of the
/// stated. The sections of elements `over` stations are known by their moments, to some ε.
pub fn round_off(ratio: f64, elements: usize, over: bool) -> f64 {
    let length = 1.0 + (elements as f64).sqrt() / 25.0;
    let sections = if over { 64.0 } else { 4.0 };
    f64::EPSILON * (sections + 1.5 * ratio.max(1.0) * length)
}

/// What is the mesh's fault and what the arithmetic's; `ratio` is that of the frequency to the slowest.
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

/// What a frequency loses of its digits, relative, where the residual is beyond what the iteration stopped at (`left`).
///
/// Far slower modes leave their own round-off in the compliance: of a mode they and all other slower ones were taken
/// out of (`apart`), the residual beyond `left` shows it, and half of that is the frequency's. Thick parts on thin
/// ones leave round-off too, as in a chain of cylinders. The residual of a usual bat is some ε times the square of the
/// `ratio`, and costs nothing. Where the iteration stopped at a larger residual, round-off cannot be seen in it.
pub fn lost(residual: f64, left: f64, ratio: f64, apart: bool) -> f64 {
    const USUAL: f64 = 3.0 * f64::EPSILON;
    /// Iterations stop above; a smaller residual is round-off.
    const ARITHMETIC: f64 = 3e-14;
    /// A frequency may lose three times the residual where both are a few ε, and no more than this.
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

/// What round-off of a frequency, relative, is worth in the shape, the nodes and the modal mass.
///
/// The shape's is a share of its largest deflection, so that where it is flat, between stiff springs or in a thick
/// part beside a thin one, the slope tells how far a node goes with it.
fn blur(mode: &mut Mode, sums: f64) {
    let usual = 10.0 * mode.shape.length() / mode.nodes.len().max(1) as f64;
    mode.error.nodes += sums * usual.max(LOCAL * mode.doubt.flattest);
    mode.doubt.rounding += LOCAL * sums;
    mode.error.modal_mass += 10.0 * sums;
    mode.error.shape += 10.0 * sums;
}

/// What a round-off of the frequency, relative, adds: that of the sections, as it goes as `√(EI/ρA)`.
pub fn add_round_off(mode: &mut Mode, relative: f64) {
    mode.error.round_off += relative;
    blur(mode, relative);
}

/// Round-off of a deflection, of which the largest is 1, over that of the frequency.
const LOCAL: f64 = 3.0;

/// A faster motion's η may be this many times its estimate, or have made as much of the gap to it. This and
/// the two below are chosen on near twins: `search/bats.py --kind whips` prints the largest ratios of true
/// to stated errors, of frequencies, masses and nodes.
const UNSURE: f64 = 2.0;

/// Where that share of the energy may be another motion's nothing is known of the nodes.
const UNKNOWN: f64 = 0.25;

/// Beside a motion as near as that, or the next one, a mode's nodes may move far where its deflection is
/// flat.
const NEAR: f64 = 0.1;

/// Adds to relative errors of frequencies, of rising `omegas`, what near twins share.
///
/// A mesh may hold two motions of one frequency unequally well: of two equal whips, one on longer
/// elements, each rings alone on the mesh, while both ring in every mode of the bat. With `r_j` what
/// is left of the exact compliance's product with motion j, which is orthogonal to the mesh's
/// motions, the exact eigenvalues are those of
///
/// ```text
/// diag(θ_j) + (r_i·r_j)/θ,     (r_j·r_j)/θ² = η_j
/// ```
///
/// but for a factor `1 − λ/λ_l` of the motions l that the mesh does not hold, as in η itself. The
/// second part has no negative eigenvalue and a trace of `Σ η_j`, and slower motions do not raise
/// the k-th eigenvalue (Courant and Fischer): it rises by no more than `η_k` and those `η_j` of
/// faster ones that are not small beside their gap `1 − λ_k/λ_j`.
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

/// Whether the motion beyond `count` others is so near to the last of them that it has to be looked
/// at too, from the `ratio` of their λ (at most 1). A bat's own gaps are about 2/n and more at its
/// n-th mode. `examples/tuning/gaps.rs` prints the least of 40 modes, times n: 0.7 or more on all bats of
/// `meshes/`, but for modes 37 and 38 of the two-piece bat with shear (0.07).
pub fn is_twin(ratio: f64, count: usize) -> bool {
    (1.0 - ratio) * (count as f64) < 0.2
}

/// What is known of a motion beside others: ω (rad/s), the relative error of the frequency, the
/// modal mass.
#[derive(Clone, Copy)]
struct Known {
    omega: f64,
    error: f64,
    mass: f64,
}

/// How much of another motion may be in one.
#[derive(Clone, Copy)]
struct SharedMotion {
    /// Number of the other.
    other: usize,
    /// `|1 − λ/λ_j|`.
    gap: f64,
    /// Sine of the angle towards the other.
    turn: f64,
    /// The other's part of the shape, of which the largest deflection is 1.
    share: f64,
}

/// What motion `other` may have to do with motion `k` where the iteration left that residual.
fn part(all: &[Known], k: usize, other: usize, residual: f64) -> SharedMotion {
    let (own, its) = (all[k], all[other]);
    let gap = (1.0 - (own.omega / its.omega).powi(2)).abs().max(f64::EPSILON);
    let certain = (gap - 2.0 * UNSURE * all[k.max(other)].error).max(f64::EPSILON);
    let mesh = 2.0 * (own.error * its.error).sqrt() / certain;
    let turn = (mesh + residual / gap.min(1.0)).min(1.0);
    SharedMotion { other, gap, turn, share: turn * (own.mass / its.mass).sqrt() }
}

/// What other modes add to a mode's errors; `beyond` is ω (rad/s) of the first mode above the list,
/// `left` the residuals that an iteration stopped at.
///
/// The defect weighs the share `c` of another mode `j` by the gap `|1 − λ/λ_j|`, so it hardly sees
/// the nearest ones. The eigensolve left no more of them than `c = residual/gap` (Davis and Kahan),
/// which costs Rayleigh's quotient `c² gap`; the mesh mixes in `c ≈ 2 √(e e_j)/gap`, with `e` the
/// relative errors of both frequencies: what is off the diagonal in [`share`], over a gap less what
/// the errors may have made of it. Of the two nearest all is counted, because where a deflection is
/// superconvergent, at the ends, that is all its error; of the others what the defect does not see.
/// In a shape of modal mass m the share is `c √(m/m_j)` beside a rest of `√(1 − c²)`. Where there is no mode above or
/// below, the other side counts twice. Frequencies nearer to each other than ε count as that near.
pub fn add_neighbours(modes: &mut [Mode], beyond: Option<f64>, left: &[f64], factored: bool) {
    let (mut lightest, mut worst) = (f64::INFINITY, 0.0_f64);
    let mut all: Vec<Known> = Vec::with_capacity(modes.len() + 1);
    for mode in modes.iter() {
        let known = Known { omega: mode.omega, error: mode.error.total(), mass: mode.modal_mass };
        (lightest, worst) = (lightest.min(known.mass), worst.max(known.error));
        all.push(known);
    }
    all.extend(beyond.map(|omega| Known { omega, error: worst, mass: lightest }));
    let omegas: Vec<f64> = all.iter().map(|known| known.omega).collect();
    let mut errors: Vec<f64> = all.iter().map(|known| known.error).collect();
    share(&omegas, &mut errors);
    let doubts: Vec<Doubt> = modes.iter_mut().map(|mode| std::mem::take(&mut mode.doubt)).collect();
    for k in 0..modes.len() {
        // The residual of a factored `K` is its round-off, in the fastest modes.
        let residual = if factored { 0.0 } else { modes[k].error.residual };
        let below = (k > 0).then(|| part(&all, k, k - 1, residual));
        let above = (k + 1 < all.len()).then(|| part(&all, k, k + 1, residual));
        let both: Vec<SharedMotion> =
            [below.or(above), above.or(below)].into_iter().flatten().collect();
        let far = (0..all.len()).filter(|j| j.abs_diff(k) > 1).map(|j| {
            let part = part(&all, k, j, 0.0);
            let unseen = (1.0 - part.gap).max(0.0);
            SharedMotion { turn: part.turn * unseen, share: part.share * unseen, ..part }
        });
        let parts: Vec<SharedMotion> = both.iter().copied().chain(far).collect();
        let alone = if parts.is_empty() { 4.0 * all[k].error + residual } else { 0.0 };
        let mixed = alone + parts.iter().map(|part| part.share).sum::<f64>();
        let lost = parts.iter().map(|part| part.turn.powi(2)).sum::<f64>().min(1.0);
        let beside = 1.0 / (1.0 - lost).max(f64::EPSILON).sqrt();
        let beside_or_near = |part: &&SharedMotion| part.other.abs_diff(k) == 1 || part.gap < NEAR;
        let near = parts.iter().filter(beside_or_near).filter(|part| part.other < modes.len());
        let nodes = modes[k].shape.slopes(&modes[k].nodes);
        let shift = |part: &SharedMotion| part.share * modes[part.other].shape.shift(&nodes);
        let moved: f64 = near.map(shift).sum();
        let of: Vec<(usize, f64)> = parts.iter().map(|part| (part.other, part.share)).collect();
        let shares = Shares { of: &of, motions: &doubts };
        let told = doubts[k].tell(&modes[k].shape, &modes[k].nodes, shares);
        let nearest = both.iter().map(|part| part.gap).fold(1.0, f64::min);
        let mode = &mut modes[k];
        let length = mode.shape.length();
        // A frequency is never farther from a mode's than the residual, however near others are.
        let cost_of = |left: &f64| 0.5 * left * (left / nearest).min(1.0);
        mode.error.discretization += left.get(k).map_or(0.0, cost_of) + errors[k] - all[k].error;
        mode.error.modal_mass += mixed * (2.0 + mixed) + lost;
        // All of a shape, and no more, may be another's, and its nodes anywhere.
        mode.error.shape += (mixed * beside).min(1.0);
        let spread = (mixed * length / mode.nodes.len().max(1) as f64).max(2.0 * moved);
        let shifted = if lost < UNKNOWN { spread * beside } else { length };
        mode.error.nodes = (mode.error.nodes + shifted.min(length)).max(told.error).min(length);
        (mode.nodes, mode.untold) = (told.nodes, told.untold);
    }
}
