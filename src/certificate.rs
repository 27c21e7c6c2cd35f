//! How far a computed mode may be trusted, beyond what its own defect tells.

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
/// quotient.
pub fn account(mode: &mut Mode, first: Option<&Mode>, elements: usize, factored: bool) {
    let sums = round_off(mode.omega / first.map_or(mode.omega, |m| m.omega), elements);
    mode.error.round_off = sums;
    if factored {
        let solver = 0.5 * mode.error.residual.powi(2);
        mode.error.discretization = (mode.error.discretization - solver).max(0.0);
        mode.error.round_off += solver;
    }
    mode.error.nodes += 10.0 * sums * mode.shape.length() / mode.nodes.len().max(1) as f64;
    mode.error.modal_mass += 10.0 * sums;
    mode.error.shape += 10.0 * sums;
}

/// What a mode's neighbours in frequency add to its errors.
///
/// The defect weighs the share `c` of another mode `j` by the gap `|1 − λ/λ_j|`, so it hardly
/// sees the nearest ones. The eigensolve left no more of them than `c = residual/gap` (Davis and
/// Kahan); the mesh mixes in `c ≈ 2 √(e e_j)/gap`, with `e` the relative errors of both
/// frequencies. Where a deflection is superconvergent, at the ends, that is all its error. Above
/// the highest mode the gap is taken to be the one below. Frequencies nearer to each other than ε
/// count as that near.
pub fn add_neighbours(modes: &mut [Mode], factored: bool) {
    let mut below: Option<(f64, f64)> = None;
    for k in 0..modes.len() {
        let above = modes.get(k + 1).map(|mode| (mode.omega, mode.error.discretization));
        let mode = &mut modes[k];
        let own = (mode.omega, mode.error.discretization);
        let gap = |other: f64| (1.0 - (own.0 / other).powi(2)).abs().max(f64::EPSILON);
        let share = |(omega, error): (f64, f64)| 2.0 * (own.1 * error).sqrt() / gap(omega);
        let shares = [below, above].map(|other| other.map(share));
        let gaps = [below, above].map(|other| other.map_or(1.0, |other| gap(other.0).min(1.0)));
        // The residual of a factored `K` is its round-off, in the fastest modes.
        let residual = if factored { 0.0 } else { mode.error.residual };
        let nearest = gaps[0].min(gaps[1]);
        let single = shares[0].or(shares[1]).unwrap_or(2.0 * own.1);
        let mixed = shares.map(|share| share.unwrap_or(single)).iter().sum::<f64>();
        let mixed = mixed + residual / nearest;
        mode.error.nodes += mixed * mode.shape.length() / mode.nodes.len().max(1) as f64;
        mode.error.modal_mass += 2.0 * mixed;
        mode.error.shape += mixed;
        below = Some(own);
    }
}
