//! Are the stated errors correct?
//!
//! [`rows`] compares the stated errors of solutions with the true ones; [`Summary::of`] summarises the result.
//!
//! Every bat with exact frequencies is solved for tolerances from 1e-2 to 1e-12. The promise:
//!
//! ```text
//! true error ≤ 3 × stated error                                always
//! stated error ≤ 30 × true error, where that is above 1e-13    in nine cases of ten
//! ```
//!
//! for every frequency, and the first line for nodes and modal masses where they are known too.
//! A tolerance beyond reach because of round-off breaks no promise if the answer says so.

use crate::validation::Truth;
use sweetspot::base::{Result, Tell};
use sweetspot::modes::mode::Mode;
use sweetspot::modes::solve::{Request, Solution, solve};

/// Number of requested modes where at least this many are known.
pub const MODES: usize = 60;
/// The requested tolerances, as negative powers of ten.
pub const DIGITS: std::ops::RangeInclusive<i32> = 2..=12;

/// Largest allowed ratio of true to stated error.
pub const ALWAYS: f64 = 3.0;
/// Largest allowed ratio of stated to true error in nine cases of ten.
pub const MOSTLY: f64 = 30.0;
/// True errors below this are luck or round-off, so their nearness to the stated ones is meaningless.
pub const VISIBLE: f64 = 1e-13;
/// The known frequencies and masses are doubles: right to half a unit in the last place (relative).
pub const KNOWN_TO: f64 = 1.2e-16;
/// A node is a zero of a sum with as many terms as the degree; this is its round-off (m).
const NODE_KNOWN_TO: f64 = 1e-12;

/// Known nodes closer to an end than this are left out (m).
const BESIDE_AN_END: f64 = 1e-4;

/// The bats: name, and the validation cases with their known values; the dowel is known in closed form.
pub const BATS: &[(&str, &[&str])] = &[
    ("dowel", &[]),
    ("cone 1:2.64", &["cone_1_2p64_60", "cone_1_2p64"]),
    ("cone 1:10", &["cone_1_10_60", "cone_1_10"]),
    ("cone 1:100", &["cone_1_100"]),
    ("cone 1:1000", &["cone_1_1000"]),
    ("cone 1:10000", &["cone_1_10000"]),
    ("complete cone", &["cone_complete"]),
    ("step 1:3", &["step_1_3_60", "step_1_3"]),
    ("many steps", &["steps_many"]),
    ("dumbbell", &["dumbbell"]),
    ("handle 1 mm", &["handle_1mm"]),
    ("linear bat", &["linear_bat"]),
    ("hollow linear", &["hollow_linear"]),
    ("pchip bat", &["pchip_bat"]),
    ("sinusoidal", &["sinusoidal"]),
    ("exponential", &["exponential"]),
    ("tanh bat", &["tanh_bat"]),
    ("dowel, Rayleigh", &["rayleigh_dowel"]),
    ("cone, Rayleigh", &["rayleigh_cone"]),
    ("dowel, shear", &["timo_dowel_60"]),
    ("cone, shear", &["timo_cone"]),
    ("step, shear", &["timo_step"]),
    ("tube, shear", &["timo_tube"]),
    ("L/r = 4, shear", &["timo_stubby"]),
    ("L/r = 1e6, shear", &["timo_slender"]),
    ("deep bar, shear", &["nafems_fv5"]),
    ("cork, shear", &["cork"]),
    ("sleeve", &["sleeve"]),
    ("tape", &["taped_dowel"]),
    ("wood and metal", &["two_materials"]),
    ("joint, shear", &["joint"]),
    ("pinned, pinned", &["pinned_pinned"]),
    ("the same, shear", &["timo_pinned_pinned"]),
    ("clamped, free", &["clamped_free"]),
    ("clamped, pinned", &["clamped_pinned"]),
    ("clamped, clamped", &["clamped_clamped"]),
    ("clamped inside", &["interior_clamp"]),
    ("clamped in middle", &["interior_clamp_middle"]),
    ("pin inside", &["pin_inside"]),
    ("three supports", &["three_supports"]),
    ("end springs", &["end_springs"]),
    ("soft springs", &["soft_springs"]),
    ("stiff springs", &["stiff_springs"]),
    ("hands", &["grip_bed"]),
    ("hands, cone, shear", &["grip_bed_cone_timo"]),
    ("tip mass", &["clamped_tip_mass"]),
    ("tip mass, shear", &["timo_clamped_tip_mass"]),
    ("1e6 kg at the tip", &["heavy_tip"]),
    ("the same, free", &["heavy_free"]),
    ("mass in the middle", &["mid_mass"]),
    ("mass with offset", &["offset_mass"]),
    ("absorber", &["absorber"]),
];

/// One bat solved for one tolerance: the promise and the truth.
#[derive(Debug, Clone)]
pub struct CheckedBat {
    /// Name of the bat in the table.
    pub bat: &'static str,
    /// Wanted relative accuracy of every frequency.
    pub tolerance: f64,
    /// Number of requested modes.
    pub modes: usize,
    /// Degree of the plan that the tolerance made.
    pub degree: usize,
    /// Number of elements of the plan.
    pub elements: usize,
    /// Whether the solution claims the tolerance.
    pub met: bool,
    /// Largest true relative error of a frequency.
    pub truth: f64,
    /// Largest stated relative error of a frequency.
    pub stated: f64,
    /// Largest ratio of true to stated error of any frequency; the limit is 3. It is 0 where nothing is known.
    pub frequency_ratio: f64,
    /// Largest ratio of true to stated error of any node; 0 where nothing is known.
    pub node_ratio: f64,
    /// Largest ratio of true to stated error of any modal mass; 0 where nothing is known.
    pub mass_ratio: f64,
    /// Modes whose true error is above 1e-13.
    pub visible: usize,
    /// Visible errors that are stated within 30 times the true error.
    pub close: usize,
}

impl CheckedBat {
    /// Whether no true error exceeds three times the stated one, and no claim to meet the tolerance is wrong.
    pub fn holds(&self) -> bool {
        let ratios = [self.frequency_ratio, self.node_ratio, self.mass_ratio];
        ratios.iter().all(|ratio| *ratio <= ALWAYS) && !(self.met && self.stated > self.tolerance)
    }

    /// Whether the tolerance was met by the truth, too.
    pub fn truly_met(&self) -> bool {
        self.truth <= self.tolerance
    }
}

/// The promise over several rows.
#[derive(Debug, Clone, Copy, Default)]
pub struct Summary {
    /// Worst of the ratios of true to stated frequency error over all rows.
    pub frequency_ratio: f64,
    /// Worst of the ratios of true to stated node error over all rows.
    pub node_ratio: f64,
    /// Worst of the ratios of true to stated modal mass error over all rows.
    pub mass_ratio: f64,
    /// Number of visible errors.
    pub visible: usize,
    /// Visible errors that are stated within 30 times the true error.
    pub close: usize,
    /// Rows with an error beyond three times the stated one.
    pub broken: usize,
}

impl Summary {
    /// The summary of those rows.
    pub fn of(rows: &[CheckedBat]) -> Self {
        let worst = |ratio: fn(&CheckedBat) -> f64| rows.iter().map(ratio).fold(0.0, f64::max);
        Self {
            frequency_ratio: worst(|row| row.frequency_ratio),
            node_ratio: worst(|row| row.node_ratio),
            mass_ratio: worst(|row| row.mass_ratio),
            visible: rows.iter().map(|row| row.visible).sum(),
            close: rows.iter().map(|row| row.close).sum(),
            broken: rows.iter().filter(|row| !row.holds()).count(),
        }
    }

    /// The share of visible errors that are stated within 30 times.
    pub fn share_close(&self) -> f64 {
        if self.visible == 0 { 1.0 } else { self.close as f64 / self.visible as f64 }
    }

    /// Whether both lines of the promise hold.
    pub fn holds(&self) -> bool {
        self.broken == 0 && 10 * self.close >= 9 * self.visible
    }
}

/// All rows: every bat for every tolerance, the bats in the order of [`BATS`].
///
/// # Errors
///
/// As [`solve`].
pub fn rows(tell: Tell) -> Result<Vec<CheckedBat>> {
    let mut rows = Vec::new();
    let all = BATS.len() * DIGITS.count();
    for (name, cases) in BATS {
        let truth = known(cases)?;
        for digits in DIGITS {
            tell(rows.len() as f64 / all as f64, name);
            rows.push(row(name, &truth, 10f64.powi(-digits))?);
        }
    }
    Ok(rows)
}

fn known(cases: &[&str]) -> Result<Truth> {
    if cases.is_empty() { Truth::of_dowel(MODES) } else { Truth::of_cases(cases) }
}

fn row(bat: &'static str, truth: &Truth, tolerance: f64) -> Result<CheckedBat> {
    let modes = truth.frequencies.len().min(MODES);
    let theory = truth.theory;
    let solution = solve(&truth.bat, &Request { modes, tolerance, theory, ..Request::default() })?;
    Ok(compared(bat, truth, tolerance, &solution))
}

/// The row of a solution, with each known number compared with ours.
fn compared(bat: &'static str, truth: &Truth, tolerance: f64, solution: &Solution) -> CheckedBat {
    let pairs = solution.modes.iter().zip(&truth.frequencies);
    let frequencies: Vec<(f64, f64)> = pairs
        .map(|(mode, exact)| ((mode.frequency() / exact - 1.0).abs(), mode.error.total()))
        .collect();
    let visible = frequencies.iter().filter(|(off, _)| *off > VISIBLE);
    let nodes = solution.modes.iter().zip(&truth.nodes);
    let masses = solution.modes.iter().zip(&truth.modal_masses);
    let mass = |(mode, exact): (&Mode, &Option<f64>)| {
        let off = |exact: f64| {
            ratio((mode.modal_mass / exact - 1.0).abs(), mode.error.modal_mass, KNOWN_TO)
        };
        exact.map_or(0.0, off)
    };
    CheckedBat {
        bat,
        tolerance,
        modes: solution.modes.len(),
        degree: solution.degree,
        elements: solution.mesh.len(),
        met: solution.met(),
        truth: largest(frequencies.iter().map(|(off, _)| *off)),
        stated: solution.worst(),
        frequency_ratio: largest(frequencies.iter().map(|(off, by)| ratio(*off, *by, KNOWN_TO))),
        node_ratio: largest(nodes.map(|(mode, exact)| node_ratio(mode, exact, truth.bat.length()))),
        mass_ratio: largest(masses.map(mass)),
        visible: visible.clone().count(),
        close: visible.filter(|(off, stated)| *stated <= MOSTLY * off).count(),
    }
}

/// True over stated error, where `off ≤ 3 × stated + known_to` is a ratio of at most 3.
fn ratio(off: f64, stated: f64, known_to: f64) -> f64 {
    off / (stated + known_to / ALWAYS)
}

/// The largest ratio for the nodes of one mode; a missing or additional node counts as infinitely wrong. The known
/// nodes exclude those next to a heavy end.
fn node_ratio(mode: &Mode, exact: &[f64], length: f64) -> f64 {
    if exact.is_empty() {
        return 0.0;
    }
    let beside = |x: &&f64| **x < BESIDE_AN_END || length - **x < BESIDE_AN_END;
    let nodes: Vec<&f64> = mode.nodes.iter().filter(|x| !beside(x)).collect();
    if nodes.len() != exact.len() {
        return f64::INFINITY;
    }
    let off = nodes.iter().zip(exact).map(|(node, exact)| (*node - exact).abs());
    ratio(largest(off), mode.error.nodes, NODE_KNOWN_TO)
}

/// The maximum of the values, or infinity if one of them is NaN.
pub fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.map(|v| if v.is_nan() { f64::INFINITY } else { v }).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solved() -> (Truth, Solution) {
        let truth = Truth::of_dowel(3).unwrap();
        let solution = solve(&truth.bat, &Request { modes: 3, ..Request::plain() }).unwrap();
        (truth, solution)
    }

    #[test]
    fn a_false_statement_breaks_the_promise() {
        let (truth, solution) = solved();
        assert!(compared("dowel", &truth, 1e-4, &solution).holds());
        let spoil: [fn(&mut Mode); 5] = [
            |mode| mode.error.discretization *= 0.1,
            |mode| mode.omega *= 1.0 + 1e-3,
            |mode| mode.omega = f64::NAN,
            |mode| mode.modal_mass *= 1.01,
            |mode| mode.nodes.truncate(2),
        ];
        for (k, spoil) in spoil.iter().enumerate() {
            let mut wrong = solution.clone();
            spoil(&mut wrong.modes[2]);
            assert!(!compared("dowel", &truth, 1e-4, &wrong).holds(), "{k}");
        }
    }

    #[test]
    fn a_claim_beyond_the_stated_error_breaks_the_promise() {
        let (truth, solution) = solved();
        assert!(solution.met());
        assert!(!compared("dowel", &truth, 0.5 * solution.worst(), &solution).holds());
    }

    #[test]
    fn estimates_from_far_above_break_the_second_line() {
        let (truth, mut solution) = solved();
        solution.modes.iter_mut().for_each(|mode| mode.error.discretization *= 1e3);
        let row = compared("dowel", &truth, 1.0, &solution);
        assert!(row.holds() && !Summary::of(&[row]).holds());
    }
}
