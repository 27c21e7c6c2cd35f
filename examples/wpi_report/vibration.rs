//! Figures 4 to 15 of the WPI report: the free–free dowel, released from a shape or struck at 0.7 L.
//!
//! Lengths are in units of `L`, `ρA = EI = 1`; so `ω_n = b_n²`, and a displacement after an impulse
//! `J` is `w √(EI ρA)/(J L)`. Shapes are the report's `W_n`, computed without cancellation.

use crate::sums::{partial_sums, struck};
use crate::table::{Table, grid, numbered};
use std::f64::consts::PI;
use sweetspot::beam::dowel::{Ends, UniformMode, beta_l};
use sweetspot::collision::energy_loss::wpi_alpha;
use sweetspot::motion::oscillator::Oscillator;

/// The report sums over 1001 points.
const CELLS: usize = 1000;
/// Where the dowel is struck.
pub const STRUCK_AT: f64 = 0.7;

pub fn all() -> Vec<Table> {
    let mut tables = vec![roots(), frequency_curves(), shapes(), nodes(), orthogonality_table()];
    tables.extend([initial_shape(), partial_sums_in_time(), partial_sum_steps(), coefficients()]);
    tables.extend([released_over_time(), struck_at_two_times(), end_point()]);
    tables.extend(EIGHTHS.map(struck_sums));
    tables
}

/// Sample masses `μ_i` (kg) of a bar with `density_per_length` (kg/m) sampled at rising `x` (m):
/// the trapezoid rule.
fn trapezoid_masses(x: &[f64], density_per_length: &[f64]) -> Vec<f64> {
    let gap = |i: usize, j: usize| x[j] - x[i];
    let last = x.len() - 1;
    (0..=last)
        .map(|i| 0.5 * gap(i.saturating_sub(1), (i + 1).min(last)) * density_per_length[i])
        .collect()
}

/// `I_nm = Σ_i μ_i φ_n(x_i) φ_m(x_i)`: modal masses on the diagonal, and off it the remainder due to imperfect
/// orthogonality or sampling.
fn orthogonality(masses: &[f64], shapes: &[Vec<f64>]) -> Vec<Vec<f64>> {
    shapes.iter().map(|a| shapes.iter().map(|b| dot(masses, a, b)).collect()).collect()
}

/// `A_n = Σ_i μ_i w₀(x_i) φ_n(x_i) / I_nn`: the share of each mode in the shape `w0`.
///
/// # Source
///
/// Chapter 2 and Fig. 9 of the WPI report (named in [`wpi_alpha`]), which leaves out
/// the rigid pair: its sum then tends to `w₀` less its rigid part.
fn expansion(masses: &[f64], shapes: &[Vec<f64>], w0: &[f64]) -> Vec<f64> {
    shapes.iter().map(|shape| dot(masses, shape, w0) / dot(masses, shape, shape)).collect()
}

/// `max_i |w_{N+1}(x_i) − w_N(x_i)|` for successive partial sums: the effect of one more mode.
fn largest_steps(sums: &[Vec<f64>]) -> Vec<f64> {
    let step = |(a, b): (&f64, &f64)| (b - a).abs();
    sums.windows(2).map(|w| w[0].iter().zip(&w[1]).map(step).fold(0.0, f64::max)).collect()
}

/// `Σ μ a b`.
fn dot(masses: &[f64], a: &[f64], b: &[f64]) -> f64 {
    masses.iter().zip(a).zip(b).map(|((mass, a), b)| mass * a * b).sum()
}

fn b(n: usize) -> f64 {
    beta_l(Ends::FreeFree, n)
}

/// The report's un-normalised `W_1 … W_count`, each at every `x`.
pub fn sampled(x: &[f64], count: usize) -> Vec<Vec<f64>> {
    let sample = |n| {
        let (alpha, mode) = (wpi_alpha(n), UniformMode::new(Ends::FreeFree, n));
        x.iter().map(|&x| alpha * mode.deflection(x)).collect()
    };
    (1..=count).map(sample).collect()
}

/// `W_n` as the report's script writes it. The hyperbolic functions are `e^b` large and cancel, so
/// the last digits, and from mode 9 on the fourth, are rounding noise that differs by machine.
pub fn script_shape(n: usize, x: f64) -> f64 {
    let b = if n < 7 { b(n) } else { (2 * n + 1) as f64 * PI / 2.0 };
    let alpha = (b.sinh() - b.sin()) / (b.cos() - b.cosh());
    (b * x).sinh() + (b * x).sin() + alpha * ((b * x).cosh() + (b * x).cos())
}

/// Figure 4, the roots; the script takes the asymptote from the seventh on.
pub fn roots() -> Table {
    let asymptote = |n: usize| (2 * n + 1) as f64 * PI / 2.0;
    let row = |n| vec![n as f64, b(n), asymptote(n), b(n) - asymptote(n)];
    Table::new("fig04_roots", "n,exact,asymptote,difference", (1..=9).map(row).collect())
}

/// Figure 4, the two curves that meet at the roots.
pub fn frequency_curves() -> Table {
    let row = |i| {
        let b = f64::from(i) * 0.05;
        vec![b, b.cos(), 1.0 / b.cosh()]
    };
    Table::new("fig04_curves", "betaL,cos,sech", (0..=620).map(row).collect())
}

/// Figure 5.
pub fn shapes() -> Table {
    let x = grid(CELLS);
    Table::of_curves("fig05_modes", &format!("X{}", numbered("W", 9)), &x, &sampled(&x, 9))
}

/// The nodes of figure 5.
pub fn nodes() -> Table {
    let row = |n: usize| {
        let mut row = vec![n as f64];
        row.extend(UniformMode::new(Ends::FreeFree, n).nodes());
        row.resize(11, f64::NAN);
        row
    };
    Table::new("fig05_nodes", &format!("n{}", numbered("node", 10)), (1..=9).map(row).collect())
}

/// Figure 6: `∫ W_n W_m dX` by the report's trapezoid rule and exactly.
pub fn orthogonality_table() -> Table {
    let x = grid(CELLS);
    let masses = trapezoid_masses(&x, &vec![1.0; x.len()]);
    let clean = orthogonality(&masses, &sampled(&x, 9));
    let raw: Vec<Vec<f64>> =
        (1..=9).map(|n| x.iter().map(|&x| script_shape(n, x)).collect()).collect();
    let raw = orthogonality(&masses, &raw);
    let exact = |n, m| if n == m { wpi_alpha(n).powi(2) } else { 0.0 };
    let row = |n: usize, m: usize| {
        vec![n as f64, m as f64, clean[n - 1][m - 1], exact(n, m), raw[n - 1][m - 1]]
    };
    let rows = (1..=9).flat_map(|n| (n..=9).map(move |m| row(n, m))).collect();
    Table::new("fig06_orthogonality", "n,m,trapezoid,exact,script_form", rows)
}

/// Figure 7: the initial shape of the script, and the other one of the text (`x` in inches).
pub fn initial_shape() -> Table {
    let row = |x: f64| vec![x, 0.1 * (PI * x).sin(), 0.1 * (33.0 * x / (2.0 * PI)).sin()];
    Table::new("fig07_initial_shape", "X,script,text", grid(CELLS).into_iter().map(row).collect())
}

/// `A_n` of the script's initial shape by its trapezoid rule, rigid part left out as there.
fn trapezoid_coefficients() -> Vec<f64> {
    let x = grid(CELLS);
    let w0: Vec<f64> = x.iter().map(|x| 0.1 * (PI * x).sin()).collect();
    expansion(&trapezoid_masses(&x, &vec![1.0; x.len()]), &sampled(&x, 9), &w0)
}

/// The same integrals in closed form: by parts, `(b⁴ − π⁴) ∫ sin πX W dX = −π³ (W(0) + W(1))`.
fn exact_coefficients() -> Vec<f64> {
    let exact = |n: usize| {
        let ends = if n % 2 == 1 { 4.0 * wpi_alpha(n) } else { 0.0 };
        0.0 - 0.1 * PI.powi(3) * ends / ((b(n).powi(4) - PI.powi(4)) * wpi_alpha(n).powi(2))
    };
    (1..=9).map(exact).collect()
}

/// Figure 9: `A_n/L`.
pub fn coefficients() -> Table {
    let (trapezoid, exact) = (trapezoid_coefficients(), exact_coefficients());
    let row = |n: usize| vec![n as f64, trapezoid[n - 1], exact[n - 1]];
    Table::new("fig09_coefficients", "n,trapezoid,exact", (1..=9).map(row).collect())
}

/// Mode `n`: unit mass per length, so `∫ W_n² dX = α_n²` is the modal mass.
fn modes(count: usize) -> Vec<Oscillator> {
    let mode =
        |n| Oscillator { omega: b(n).powi(2), damping_ratio: 0.0, mass: wpi_alpha(n).powi(2) };
    (1..=count).map(mode).collect()
}

/// `t` such that `ω_1 t = 2π periods`.
fn time(periods: f64) -> f64 {
    2.0 * PI * periods / b(1).powi(2)
}

/// Partial sums of nine modes after release from the initial shape.
fn released(coefficients: &[f64], periods: f64) -> Vec<Vec<f64>> {
    let at = |(mode, a): (Oscillator, &f64)| mode.free(*a, 0.0, time(periods))[0];
    let amplitudes: Vec<f64> = modes(9).into_iter().zip(coefficients).map(at).collect();
    partial_sums(&sampled(&grid(CELLS), 9), &amplitudes)
}

/// Figure 8, the curves: sums of 1 to 9 modes an eighth of a period after release.
pub fn partial_sums_in_time() -> Table {
    let sums = released(&trapezoid_coefficients(), 0.125);
    let header = format!("X{}", numbered("sum", 9));
    Table::of_curves("fig08_partial_sums", &header, &grid(CELLS), &sums)
}

/// Figure 8, the table: the largest change from each sum to the next.
pub fn partial_sum_steps() -> Table {
    let steps = |coefficients: &[f64]| largest_steps(&released(coefficients, 0.125));
    let (trapezoid, exact) = (steps(&trapezoid_coefficients()), steps(&exact_coefficients()));
    let row = |i: usize| vec![(i + 1) as f64, (i + 2) as f64, trapezoid[i], exact[i]];
    Table::new("fig08_steps", "from,to,trapezoid,exact", (0..8).map(row).collect())
}

/// Figure 10: the released dowel at each eighth of a period, seven modes as in the script.
pub fn released_over_time() -> Table {
    let coefficients = trapezoid_coefficients();
    let curve = |i: u32| released(&coefficients, f64::from(i) / 8.0).swap_remove(6);
    let curves: Vec<_> = (0..=8).map(curve).collect();
    let header = (0..=8).map(|i| format!(",t_{i}_eighths")).collect::<String>();
    Table::of_curves("fig10_released", &format!("X{header}"), &grid(CELLS), &curves)
}

/// Sums of 1 … `count` modes at every `x`, after an impulse at 0.7 L.
fn struck_at(x: &[f64], count: usize, periods: f64) -> Vec<Vec<f64>> {
    let at_a: Vec<f64> = sampled(&[STRUCK_AT], count).into_iter().flatten().collect();
    partial_sums(&sampled(x, count), &struck(&modes(count), &at_a, 1.0, time(periods)))
}

/// The report states no time for figure 11; these three, in eighths of the first period, are ours.
const EIGHTHS: [u32; 3] = [1, 2, 4];

/// Figure 11: 1, 2, 5, 10 and 100 modes of the struck dowel.
pub fn struck_sums(eighths: u32) -> Table {
    let sums = struck_at(&grid(CELLS), 100, f64::from(eighths) / 8.0);
    let curves: Vec<_> = [1, 2, 5, 10, 100].map(|n| sums[n - 1].clone()).into();
    let name = match eighths {
        1 => "fig11_struck_t_eighth",
        2 => "fig11_struck_t_quarter",
        _ => "fig11_struck_t_half",
    };
    Table::of_curves(name, "X,modes1,modes2,modes5,modes10,modes100", &grid(CELLS), &curves)
}

/// Figure 12: ten modes, at two times and half a first period after each.
pub fn struck_at_two_times() -> Table {
    let curve = |periods| struck_at(&grid(CELLS), 10, periods).swap_remove(9);
    let curves: Vec<_> = [0.025, 0.525, 0.25, 0.75].map(curve).into();
    let header = "X,t_0.025,t_0.525,t_0.25,t_0.75";
    Table::of_curves("fig12_ten_modes", header, &grid(CELLS), &curves)
}

/// Figures 13 to 15: the barrel end over ten periods of mode 1, by 1, 2, 10 and 100 modes.
pub fn end_point() -> Table {
    let at = |x: f64| sampled(&[x], 100);
    let (at_a, at_end) = (at(STRUCK_AT).concat(), at(1.0));
    let modes = modes(100);
    let row = |i: u32| {
        let periods = f64::from(i) / 500.0;
        let sums = partial_sums(&at_end, &struck(&modes, &at_a, 1.0, time(periods)));
        let mut row = vec![2.0 * PI * periods];
        row.extend([1, 2, 10, 100].map(|n| sums[n - 1][0]));
        row
    };
    let header = "omega1_t,modes1,modes2,modes10,modes100";
    Table::new("fig13_15_end_point", header, (0..=5000).map(row).collect())
}
