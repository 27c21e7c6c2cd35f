//! How far may a computed mode be trusted, beyond what its own defect tells?
//!
//! [`crate::solve()`] calls these; what they find is in [`crate::modes::ModeError`].

use crate::modes::Mode;

/// Relative round-off of a frequency by the running sums.
///
/// They keep ε of the slowest motion; a faster mode keeps ε times the ratio of their frequencies,
/// and long sums lose a little more: measured, on cones, steps and dowels of up to 10⁶ elements.
pub fn round_off(ratio: f64, elements: usize) -> f64 {
    let length = 1.0 + (elements as f64).sqrt() / 25.0;
    f64::EPSILON * (4.0 + 1.5 * ratio.max(1.0) * length)
}

/// What is the mesh's fault and what the arithmetic's.
///
/// A factored `K` loses ε n⁴, which shows in the residual; its square is the error of Rayleigh's
/// quotient. Far slower modes leave their own round-off in the compliance: of a mode they and all
/// other slower ones were taken out of, the residual beyond what the iteration stopped at (`left`)
/// shows it, and half of that is the frequency's.
pub fn account(
    mode: &mut Mode,
    first: Option<&Mode>,
    elements: usize,
    factored: bool,
    left: Option<f64>,
) {
    let mut sums = round_off(mode.omega / first.map_or(mode.omega, |m| m.omega), elements);
    if let Some(left) = left {
        let residual = mode.error.residual;
        sums += 0.5 * ((residual - left) * (residual + left)).max(0.0).sqrt();
    }
    mode.error.round_off = sums;
    if factored {
        let solver = 0.5 * mode.error.residual.powi(2);
        mode.error.discretization = (mode.error.discretization - solver).max(0.0);
        mode.error.round_off += solver;
    }
    blur(mode, sums);
}

/// What round-off of a frequency, relative, is worth in the shape, the nodes and the modal mass.
fn blur(mode: &mut Mode, sums: f64) {
    mode.error.nodes += 10.0 * sums * mode.shape.length() / mode.nodes.len().max(1) as f64;
    mode.error.modal_mass += 10.0 * sums;
    mode.error.shape += 10.0 * sums;
}

/// What round-off of the sections adds, relative: a frequency goes as `√(EI/ρA)`.
pub fn add_sections(mode: &mut Mode, sections: f64) {
    mode.error.round_off += sections;
    blur(mode, sections);
}

/// What other modes add to a mode's errors; `beyond` is ω (rad/s) of the first mode above the list,
/// `left` the residuals that an iteration stopped at.
///
/// The defect weighs the share `c` of another mode `j` by the gap `|1 − λ/λ_j|`, so it hardly sees
/// the nearest ones. The eigensolve left no more of them than `c = residual/gap` (Davis and Kahan),
/// which costs Rayleigh's quotient `c² gap`; the mesh mixes in `c ≈ 2 √(e e_j)/gap`, with `e` the
/// relative errors of both frequencies. Of the two nearest all is counted, because where a
/// deflection is superconvergent, at the ends, that is all its error; of the others what the defect
/// does not see. In a shape of modal mass m the share is `c √(m/m_j)`. Where there is no mode above
/// or below, the other side counts twice. Frequencies nearer to each other than ε count as that
/// near.
pub fn add_neighbours(modes: &mut [Mode], beyond: Option<f64>, left: &[f64], factored: bool) {
    let lightest = modes.iter().fold(f64::INFINITY, |m, mode| m.min(mode.modal_mass));
    let known = |mode: &Mode| (mode.omega, mode.error.discretization, mode.modal_mass);
    let all: Vec<(f64, f64, f64)> = modes.iter().map(known).collect();
    for (k, mode) in modes.iter_mut().enumerate() {
        let (omega, error, mass) = all[k];
        let gap = |other: f64| (1.0 - (omega / other).powi(2)).abs().max(f64::EPSILON);
        // Of the other mode: its gap, and its share of this shape.
        let part = |(other, of_other, its_mass): (f64, f64, f64)| {
            let (gap, larger) = (gap(other), (mass / its_mass).sqrt());
            (gap, larger, 2.0 * (error * of_other).sqrt() / gap * larger)
        };
        let below = (k > 0).then(|| part(all[k - 1]));
        let next = all.get(k + 1).copied();
        let above = next.or(beyond.map(|omega| (omega, error, lightest))).map(part);
        let both = [below.or(above), above.or(below)];
        let mut mixed: f64 = both.iter().flatten().map(|(_, _, share)| share).sum();
        for (_, other) in all.iter().enumerate().filter(|(j, _)| j.abs_diff(k) > 1) {
            let (gap, _, share) = part(*other);
            mixed += share * (1.0 - gap).max(0.0);
        }
        if both == [None, None] {
            mixed = 4.0 * error;
        }
        // The residual of a factored `K` is its round-off, in the fastest modes.
        let residual = if factored { 0.0 } else { mode.error.residual };
        let cost = |(gap, larger, _): &(f64, f64, f64)| residual / gap.min(1.0) * larger;
        mixed += both.iter().flatten().map(cost).fold(residual, f64::max);
        let nearest = both.iter().flatten().map(|(gap, ..)| *gap).fold(1.0, f64::min);
        // A frequency is never farther from a mode's than the residual, however near others are.
        let cost_of = |left: &f64| 0.5 * left * (left / nearest).min(1.0);
        mode.error.discretization += left.get(k).map_or(0.0, cost_of);
        // Two shapes of one frequency mix in any way: all of a shape, and no more, may be the
        // other's.
        mixed = mixed.min(1.0);
        mode.error.nodes += mixed * mode.shape.length() / mode.nodes.len().max(1) as f64;
        mode.error.modal_mass += 2.0 * mixed;
        mode.error.shape += mixed;
    }
}
