//! The claims of the WPI report about its results, compared with its model computed again.

use crate::hit::INCOMING;
use crate::table::{Table, grid};
use crate::vibration::{self, sampled};
use sweetspot::beam::dowel::{Dowel, Ends, UniformMode};

/// One line of the table.
pub struct Claim {
    pub claim: &'static str,
    pub printed: &'static str,
    pub ours: String,
    pub verdict: &'static str,
}

fn line(claim: &'static str, printed: &'static str, ours: String, verdict: &'static str) -> Claim {
    Claim { claim, printed, ours, verdict }
}

/// A column of the figure 18 summary for ten modes, by swing speed.
pub fn ten_modes(summary: &Table, column: &str) -> [f64; 3] {
    let (modes, values) = (summary.column("modes"), summary.column(column));
    let picked: Vec<f64> =
        modes.iter().zip(values).filter(|(n, _)| **n == 10.0).map(|(_, v)| v).collect();
    [picked[0], picked[1], picked[2]]
}

pub fn mean(values: [f64; 3]) -> f64 {
    values.iter().sum::<f64>() / 3.0
}

fn percents(values: [f64; 3]) -> String {
    let [a, b, c] = values.map(|v| 100.0 * v);
    format!("{a:.2}, {b:.2}, {c:.2} %, mean {:.2} %", 100.0 * mean(values))
}

/// The claims about the sweet spot and the loss, at 40, 50 and 60 rad/s.
pub fn claims(summary: &Table) -> Vec<Claim> {
    let of = |column| ten_modes(summary, column);
    let [slow, middle, fast] = of("X_peak_vib");
    let (least, most) = (of("min_drop"), of("max_drop"));
    let hidden = of("no_real_J_up_to");
    vec![
        line(
            "sweet spot moves to the tip, relative to its distance from the knob",
            "about 11 %",
            percents(of("relative_shift")),
            "reproduced, as their mean",
        ),
        line("the same in units of L", "", percents(of("shift_in_L")), "smaller by a third"),
        line(
            "energy drop: ball's kinetic energy, peak to peak",
            "20 %",
            percents(of("ball_energy_drop_peak_to_peak")),
            "roughly",
        ),
        line("mean drop of speed, X ≥ 0.135", "", percents(of("mean_velocity_drop")), "roughly"),
        line(
            "drop of speed, peak to peak",
            "",
            percents(of("velocity_drop_peak_to_peak")),
            "half of it",
        ),
        line(
            "the drop is true for all points of impact",
            "true",
            format!(
                "{:.1} to {:.1} % at 50 rad/s, {:.1} to {:.1} % at 40",
                100.0 * least[1],
                100.0 * most[1],
                100.0 * least[0],
                100.0 * most[0]
            ),
            "false",
        ),
        line(
            "the sweet spot lies between the nodes of modes 1 and 2",
            "true",
            format!(
                "{slow:.4}, {middle:.4}, {fast:.4} L; nodes {:.4} and {:.4} L",
                barrel_node(1),
                barrel_node(2)
            ),
            "false: handle side of both",
        ),
        line(
            "ten modes have converged (largest step to 100 modes, T₁/8, T₁/4, T₁/2)",
            "true",
            percents([1, 2, 4].map(unconverged)),
            "by eye",
        ),
        line(
            "points plotted as zero because the root is complex",
            "X < 0.135",
            format!("X ≤ {:.4}, {:.4}, {:.4}", hidden[0], hidden[1], hidden[2]),
            "unsaid there",
        ),
    ]
}

/// The node of mode `n` nearest the barrel end.
pub fn barrel_node(n: usize) -> f64 {
    UniformMode::new(Ends::FreeFree, n).nodes().last().copied().unwrap_or(f64::NAN)
}

/// `max |w₁₀ − w₁₀₀| / max |w₁₀₀|` of figure 11.
pub fn unconverged(eighths: u32) -> f64 {
    let table = vibration::struck_sums(eighths);
    let (ten, hundred) = (table.column("modes10"), table.column("modes100"));
    let largest = hundred.iter().copied().fold(0.0, |a: f64, b| a.max(b.abs()));
    let step = ten.iter().zip(&hundred).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    step / largest
}

/// The report's dowel in SI, its density read as lb/in³ and its modulus as psi.
pub fn dowel() -> Dowel {
    let (inch, pound) = (0.0254_f64, 0.453_592_37);
    Dowel {
        length: 33.0 * inch,
        radius: 0.83885 * inch,
        youngs_modulus: 2.02e6 * pound * 9.806_65 / inch.powi(2),
        density: 0.0257 * pound / inch.powi(3),
    }
}

/// Exit speed at `x` with Eq. 1-7 as printed, the ball's mass in `(M/I) y²`.
pub fn as_printed(omega: f64, x: f64) -> f64 {
    let closing = omega * (2.5 + 33.0 * x) / INCOMING + 1.0;
    9.0 * closing / (7.0 + 2.0 * (x - 0.5).powi(2)) - 1.0
}

/// Share of the dowel on which Eq. 4-15 as printed, with `W_n(a)` unsquared, is a gain.
pub fn gaining_share() -> f64 {
    let x = grid(1000);
    let shapes = sampled(&x, 10);
    let e_v = |i: usize| -> f64 {
        shapes.iter().enumerate().map(|(n, w)| w[i] / ((2 * n + 3) as f64).powi(2)).sum()
    };
    (0..x.len()).filter(|&i| e_v(i) < 0.0).count() as f64 / x.len() as f64
}

/// The numbers of the report after correction of units, misprints and truncation.
pub fn corrections(summary: &Table) -> Vec<Claim> {
    let [f1, f2, f3] = [1, 2, 3].map(|n| dowel().frequency(Ends::FreeFree, n));
    let (overlap, terms) = (vibration::orthogonality_table(), vibration::coefficients());
    let change = |v: f64| v * v - 1.0;
    let peak = |column| change(ten_modes(summary, column)[1]);
    let drop = 1.0 - peak("v_peak_vib") / peak("v_peak_rigid");
    vec![
        line(
            "frequencies, lb/in³ taken as mass over 386.09",
            "",
            format!("{f1:.3}, {f2:.3}, {f3:.3} Hz"),
            "the script's unit makes them 111.5 times too low",
        ),
        line(
            "∫W₁² dX without the trapezoid rule's error",
            "1.035942",
            format!("{:.9}", overlap.column("exact")[0]),
            "α₁², the shape as it comes",
        ),
        line(
            "A₁/L without it",
            "0.030225263",
            format!("{:.10}", terms.column("exact")[0]),
            "the rule is off by 3e-6",
        ),
        line(
            "peak of Eq. 1-7 as printed (50 rad/s)",
            "",
            format!("at the tip, {:.3} of the incoming speed", as_printed(50.0, 1.0)),
            "misprint; the script is right",
        ),
        line(
            "Eq. 4-15 as printed: where the ball gains by vibration",
            "",
            format!("{:.0} % of the dowel", 100.0 * gaining_share()),
            "misprint; the script squares",
        ),
        line(
            "drop of the ball's change of energy at 50 rad/s",
            "20 %",
            format!("{:.0} %", 100.0 * drop),
            "not what they mean",
        ),
    ]
}
