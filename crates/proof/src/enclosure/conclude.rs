//! Which eigenvalues follow from trials and norms, numbered and without gaps?
//!
//! *Temple.* If `a < σ < b` and `(σ − a)(b − σ) ≥ ε²`, then [a, b] holds an eigenvalue: else
//! `((T − a)(T − b)k, k) > 0`. From trials in falling order of σ, with `l_j`, `h_j` the ends of σ_j's interval:
//!
//! 1. `d_1 = ∞`, `d_j` half way from `h_j` to `c_{j−1}`; `c_j = l_j − ε_j²/(d_j − h_j)`, `c_1 = l_1`, as long as
//!    `d_j > h_j` and `c_j > 0`. The `[c_j, d_j]` are disjoint and each holds an eigenvalue; pick one in each.
//! 2. Every eigenvalue not picked is at most `δ = min(trace − Σc_j, √(|T|² − Σc_j²))`.
//! 3. N is how many `c_j > δ`. The eigenvalues above δ are picked ones, so `[c_j, d_j]` holds exactly one, and that
//!    is `τ_j`, for `j ≤ N`; `τ_{N+1} ≤ max(δ, d_{N+1})`. No mode is missing, with multiplicity.
//! 4. Sharper: `lower_n = l_n − ε²/(b − h_n)`, `b` just below `lower_{n−1}`, from `n = 1` on;
//!    `upper_n = h_n + ε²/(l_n − α)` from `n = N` back, `α` just above `max(δ, d_{N+1})`, then above
//!    `max(α, upper_{n+1})`.
//! 5. `ω_n` is in `[upper_n^{−½}, lower_n^{−½}]`.
//!
//! # Source
//!
//! G. Temple, Proc. R. Soc. A 119 (1928) 276; T. Kato, J. Phys. Soc. Japan 4 (1949) 334.

use std::f64::consts::TAU;

use crate::enclosure::energies::Energies;
use crate::enclosure::norms::Norms;
use sweetspot::base::interval::{Interval, down, up};

/// The proven statements about the eigenvalues of a bat.
#[derive(Debug, Clone, PartialEq)]
pub struct Conclusion {
    /// The modes that are proven, from the first on.
    pub proven: Vec<Eigenvalue>,
    /// Upper bound of every eigenvalue outside the disjoint intervals (s²).
    pub others: f64,
    /// `trace − Σc` and `√(|T|² − Σc²)` (s²); the bound is the smaller one.
    pub by_trace_and_norm: [f64; 2],
    /// An upper bound of the first eigenvalue that is not proven (s²).
    pub next: f64,
}

/// An eigenvalue between two numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eigenvalue {
    /// Which trial it is from.
    pub trial: usize,
    /// Lower and upper bound of `τ = 1/ω²` (s²).
    pub tau: [f64; 2],
    /// Its trial's σ (s²).
    pub quotient: Interval,
    /// Its trial's ε² (s⁴).
    pub residual: f64,
}

impl Eigenvalue {
    /// Lower and upper bound of the frequency (Hz).
    pub fn hertz(&self) -> [f64; 2] {
        let [lower, upper] = self.tau;
        let two_pi = Interval { low: TAU, high: TAU.next_up() };
        let of = |tau: f64| {
            let omega = Interval::point(tau).sqrt().reciprocal();
            let over = two_pi.reciprocal().expect("above 0");
            omega.map_or(Interval { low: 0.0, high: f64::INFINITY }, |omega| omega * over)
        };
        [of(upper).low, of(lower).high]
    }

    /// Width of the interval of the frequency, relative to the frequency.
    pub fn width(&self) -> f64 {
        let [lower, upper] = self.hertz();
        up(up(upper / lower) - 1.0)
    }
}

/// Lower bound `l − ε²/(b − h)`, rounded down; −∞ where nothing follows.
fn below(Energies { quotient, residual, .. }: &Energies, b: f64) -> f64 {
    let gap = down(b - quotient.high);
    if gap > 0.0 { down(quotient.low - up(residual / gap)) } else { f64::NEG_INFINITY }
}

/// Upper bound `h + ε²/(l − a)`, rounded up; ∞ where nothing follows.
fn above(Energies { quotient, residual, .. }: &Energies, a: f64) -> f64 {
    let gap = down(quotient.low - a);
    if gap > 0.0 { up(quotient.high + up(residual / gap)) } else { f64::INFINITY }
}

/// The conclusions from trials in any order; a trial without bounds is `None`.
pub fn conclude(trials: &[Option<Energies>], norms: &Norms) -> Conclusion {
    let mut order: Vec<(usize, Energies)> =
        trials.iter().enumerate().filter_map(|(k, trial)| trial.map(|known| (k, known))).collect();
    order.sort_by(|(_, a), (_, b)| b.quotient.low.total_cmp(&a.quotient.low));
    // 1: disjoint intervals.
    let mut ends: Vec<[f64; 2]> = vec![];
    for (_, energies) in &order {
        let h = energies.quotient.high;
        let end = match ends.last() {
            None => [energies.quotient.low, f64::INFINITY],
            Some([c, _]) => {
                let d = 0.5 * h + 0.5 * c;
                [below(energies, d), d]
            }
        };
        // The interval must lie below the previous one and contain its quotient.
        let apart = ends.last().is_none_or(|[c, _]| end[1] < *c);
        if !(end[1] > h && end[0] > 0.0 && apart) {
            break;
        }
        ends.push(end);
    }
    // Steps 2 and 3: the bound of all others, and the number of the first ones.
    let known: Vec<f64> = ends.iter().map(|[c, _]| *c).collect();
    let by_trace_and_norm = norms.others(&known);
    let others = by_trace_and_norm[0].min(by_trace_and_norm[1]);
    let count = known.iter().take_while(|c| **c > others).count();
    let next = ends.get(count).map_or(others, |[_, d]| others.max(*d));
    // 4: sharper.
    let mut proven: Vec<Eigenvalue> = Vec::with_capacity(count);
    for ((trial, energies), [c, d]) in order.iter().zip(&ends).take(count) {
        let lower = match proven.last() {
            // The greatest eigenvalue is no less than any Rayleigh quotient.
            None => energies.quotient.low,
            Some(last) => below(energies, last.tau[0].next_down()).max(*c),
        };
        proven.push(Eigenvalue {
            trial: *trial,
            tau: [lower, *d],
            quotient: energies.quotient,
            residual: energies.residual,
        });
    }
    let mut beyond = next;
    for (eigenvalue, (_, energies)) in proven.iter_mut().zip(&order).rev() {
        let upper = above(energies, beyond.next_up());
        eigenvalue.tau[1] = eigenvalue.tau[1].min(upper);
        beyond = beyond.max(eigenvalue.tau[1]);
    }
    // An interval without an upper end proves no mode and gives no bound for the others.
    let bounded = proven.iter().take_while(|eigenvalue| eigenvalue.tau[1].is_finite()).count();
    let next = proven.get(bounded).map_or(next, |eigenvalue| eigenvalue.tau[1]);
    proven.truncate(bounded);
    Conclusion { proven, others, by_trace_and_norm, next }
}
