//! Does the program reproduce known values?
//!
//! [`run`] solves one case and compares its numbers with the known ones. The cases are data in the folder `validation/`
//! and are built into the program.

use std::f64::consts::TAU;

use serde_json::Value;

use crate::bundled::bundled_bat;
use crate::case::{Case, Check, Known, bundled_case, read};
use crate::known_hits::KnownFigure;
use sweetspot::base::units::ounce_square_inches;
use sweetspot::base::{Error, Result};
use sweetspot::bat::{Bat, STANDARD_PIVOT, Theory};
use sweetspot::beam::{Dowel, Ends, UniformMode};
use sweetspot::modes::prepared::{Prepared, prepare};
use sweetspot::modes::solve::{Request, Solution, solve};
use sweetspot::motion::frf::Frf;
use sweetspot::motion::ringing::Ringing;

/// A known number compared with ours.
#[derive(Debug, Clone)]
pub struct KnownNumber {
    /// Name of its case.
    pub case: String,
    /// The known quantity, in words.
    pub quantity: String,
    /// The known number.
    pub expected: f64,
    /// Our number.
    pub found: f64,
    /// In the sense of the tolerance: relative, or absolute in the quantity's unit.
    pub error: f64,
    /// Allowed error, in the same sense.
    pub tolerance: f64,
    /// Whether both are relative.
    pub relative: bool,
    /// For information only: neither passed nor missed.
    pub information: bool,
    /// The reason for the tolerance, or for its absence.
    pub note: Option<String>,
}

impl KnownNumber {
    /// Whether the error is within the tolerance; NaN is not.
    pub fn passes(&self) -> bool {
        self.error <= self.tolerance
    }

    /// Whether it is to be within the tolerance and is not.
    pub fn missed(&self) -> bool {
        !self.information && !self.passes()
    }

    /// The error in units of the tolerance. A missing value gives infinity, because a maximum would
    /// drop NaN; a check for information gives 0.
    pub fn share(&self) -> f64 {
        let share = if self.information { 0.0 } else { self.error / self.tolerance };
        if share.is_nan() { f64::INFINITY } else { share }
    }
}

/// The values of a bat that are known to all digits.
#[derive(Debug, Clone)]
pub struct Truth {
    /// The bat.
    pub bat: Bat,
    /// Beam theory of the known numbers.
    pub theory: Theory,
    /// Frequencies of modes 1, 2, … (Hz).
    pub frequencies: Vec<f64>,
    /// Nodes of the lowest modes from the knob end (m); empty where they are unknown.
    pub nodes: Vec<Vec<f64>>,
    /// Modal masses of the lowest modes (kg), where they are known.
    pub modal_masses: Vec<Option<f64>>,
}

impl Truth {
    /// The combined values of those cases, all of the same bat.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for an unknown case, or one without a valid bat.
    pub fn of_cases(names: &[&str]) -> Result<Self> {
        let mut truth: Option<Self> = None;
        for name in names {
            let case = bundled_case(name)?;
            let bat = case.bat()?;
            let theory = case.request()?.theory;
            let (frequencies, nodes, modal_masses) = (vec![], vec![], vec![]);
            let empty = Self { bat, theory, frequencies, nodes, modal_masses };
            case.checks.iter().for_each(|check| truth.get_or_insert(empty.clone()).add(check));
        }
        truth.ok_or_else(|| Error::value("cases", "none", "at least one"))
    }

    /// The `modes` lowest modes of the free dowel of `meshes/dowel.json`, in closed form.
    ///
    /// # Errors
    ///
    /// As [`bundled_bat`].
    pub fn of_dowel(modes: usize) -> Result<Self> {
        let bat = bundled_bat("meshes/dowel.json")?;
        let (dowel, length) = (dowel(&bat), bat.length());
        let nodes = |n| UniformMode::new(Ends::FreeFree, n).nodes();
        Ok(Self {
            bat,
            theory: Theory::EulerBernoulli,
            frequencies: (1..=modes).map(|n| dowel.frequency(Ends::FreeFree, n)).collect(),
            nodes: (1..=modes).map(|n| nodes(n).iter().map(|x| x * length).collect()).collect(),
            modal_masses: (1..=modes).map(|n| Some(dowel.modal_mass(Ends::FreeFree, n))).collect(),
        })
    }

    /// Takes in one known number; the cases list modes and nodes by their order.
    fn add(&mut self, check: &Check) {
        let mode = check.mode.unwrap_or(0);
        match check.quantity {
            Known::FrequencyHz if mode > self.frequencies.len() => {
                self.frequencies.push(check.expected);
            }
            Known::ModalMassKg => {
                self.modal_masses.resize(mode.max(self.modal_masses.len()), None);
                self.modal_masses.last_mut().into_iter().for_each(|m| *m = Some(check.expected));
            }
            Known::NodeM => {
                self.nodes.resize(mode.max(self.nodes.len()), vec![]);
                self.nodes.last_mut().into_iter().for_each(|nodes| nodes.push(check.expected));
            }
            _ => {}
        }
    }
}

/// A bat with one radius as a uniform bar.
fn dowel(bat: &Bat) -> Dowel {
    Dowel {
        length: bat.length(),
        radius: bat.profile().at(0.0).outer,
        youngs_modulus: bat.material().youngs_modulus,
        density: bat.material().density,
    }
}

/// The worst true and the worst stated relative error of the free dowel's frequencies, solved as
/// requested but by the theory of Euler and Bernoulli, against its `cos β cosh β = 1`.
///
/// # Errors
///
/// As [`solve`].
pub fn dowel_proof(request: &Request) -> Result<[f64; 2]> {
    let bat = bundled_bat("meshes/dowel.json")?;
    let solution = solve(&bat, &Request { theory: Theory::EulerBernoulli, ..*request })?;
    let exact = |order: usize| dowel(&bat).frequency(Ends::FreeFree, order);
    let errors =
        solution.modes.iter().map(|mode| (mode.frequency() / exact(mode.order) - 1.0).abs());
    Ok([errors.fold(0.0, f64::max), solution.worst()])
}

/// Runs one case: a row for every known number.
///
/// # Errors
///
/// [`Error::Value`] if the case is malformed, and the errors of its bat and its solution.
pub fn run(name: &str, text: &str) -> Result<(Case, Vec<KnownNumber>)> {
    let case = read(name, text)?;
    let mut note = None;
    let mut rows = Vec::new();
    for (check, found) in case.checks.iter().zip(all_found(&case)?) {
        note = check.note.clone().or(note);
        rows.push(KnownNumber { note: note.clone(), ..row(name, check, found) });
    }
    Ok((case, rows))
}

/// A check compared with the result, without the note.
fn row(case: &str, check: &Check, found: f64) -> KnownNumber {
    // Without a tolerance, the differences of places and hits are absolute and all others are relative.
    let absolute = matches!(check.quantity, Known::NodeM | Known::Hit(_));
    let shown = check.information && !absolute;
    let relative = check.relative.is_some() || shown;
    let scale = if relative { check.expected.abs() } else { 1.0 };
    KnownNumber {
        case: case.to_owned(),
        quantity: label(check),
        expected: check.expected,
        found,
        error: (found - check.expected).abs() / scale,
        tolerance: check.relative.or(check.absolute).unwrap_or(0.0),
        relative,
        information: check.information,
        note: None,
    }
}

fn found(check: &Check, bat: &Bat, solution: &Solution, request: &Request) -> Option<f64> {
    let damped = || solution.damping.modes.get(check.mode?.checked_sub(1)?);
    let receptance = || {
        let mut frf = Frf::new(bat, request, check.at?, check.to?).ok()?;
        Some(frf.receptances(&[check.frequency_hz?]).ok()?.first()?.receptance)
    };
    let rung = || {
        let ringing = Ringing::new(bat, solution, request.tolerance, false).ok()?;
        let start = ringing.blow(check.at?, 1.0);
        let amplitudes = ringing.amplitudes(&start, check.time_s?);
        let shapes = ringing.shapes(&[check.to?]);
        Some(shapes.iter().zip(&amplitudes).map(|(shape, part)| shape[0] * part).sum())
    };
    let mode = || solution.modes.get(check.mode?.checked_sub(1)?);
    let inertia = bat.inertia();
    match check.quantity {
        Known::FrequencyHz => Some(mode()?.frequency()),
        Known::FrequencyRatio => Some(mode()?.frequency() / solution.modes.first()?.frequency()),
        Known::NodeM => mode()?.nodes.get(check.node?.checked_sub(1)?).copied(),
        Known::ModalMassKg => Some(mode()?.modal_mass),
        Known::Decay => Some(damped()?.decay),
        Known::DampedFrequencyHz => Some(damped()?.swinging() / TAU),
        Known::ReceptanceRealMPerN => Some(receptance()?.re),
        Known::ReceptanceImaginaryMPerN => Some(receptance()?.im),
        Known::DeflectionAfterBlowM => rung(),
        Known::MassKg => Some(inertia.mass),
        Known::BalancePointM => Some(inertia.balance_point),
        Known::InertiaBalanceKgM2 => Some(inertia.about_balance),
        Known::InertiaPivotKgM2 => Some(inertia.about(STANDARD_PIVOT)),
        Known::InertiaPivotOzIn2 => Some(ounce_square_inches(inertia.about(STANDARD_PIVOT))),
        Known::CenterOfPercussionM => inertia.center_of_percussion(STANDARD_PIVOT),
        // Only of a case with a throw.
        Known::Hit(_) => None,
    }
}

fn label(check: &Check) -> String {
    let mode = check.mode.unwrap_or(0);
    match check.quantity {
        Known::FrequencyHz => format!("f{mode} Hz"),
        Known::FrequencyRatio => format!("f{mode}/f1"),
        Known::NodeM => format!("mode {mode} node {} m", check.node.unwrap_or(0)),
        Known::ModalMassKg => format!("mode {mode} mass kg"),
        Known::Decay => format!("mode {mode} decay 1/s"),
        Known::DampedFrequencyHz => format!("mode {mode} damped Hz"),
        Known::ReceptanceRealMPerN => format!("Re H m/N, {} Hz", check.frequency_hz.unwrap_or(0.0)),
        Known::ReceptanceImaginaryMPerN => {
            format!("Im H m/N, {} Hz", check.frequency_hz.unwrap_or(0.0))
        }
        Known::DeflectionAfterBlowM => {
            format!("w m, {} s after", check.time_s.unwrap_or(0.0))
        }
        Known::MassKg => "mass kg".into(),
        Known::BalancePointM => "balance point m".into(),
        Known::InertiaBalanceKgM2 => "I balance kg m²".into(),
        Known::InertiaPivotKgM2 => "I 6 in kg m²".into(),
        Known::InertiaPivotOzIn2 => "I 6 in oz in²".into(),
        Known::CenterOfPercussionM => "percussion m".into(),
        Known::Hit(seen) => seen.label(check.at.unwrap_or(0.0), check.speed_m_per_s.unwrap_or(0.0)),
    }
}

/// The result for every check, NaN without one; it passes no test.
fn all_found(case: &Case) -> Result<Vec<f64>> {
    let seen = |check: &Check| match check.quantity {
        Known::Hit(seen) => Some(seen),
        _ => None,
    };
    if let (Some(throw), Value::Null) = (&case.hit, &case.bat) {
        let on_wall = |check| Some(throw.on_wall(seen(check)?, check.speed_m_per_s?));
        return Ok(case.checks.iter().map(|check| on_wall(check).unwrap_or(f64::NAN)).collect());
    }
    let (bat, request) = (case.bat()?, case.request()?);
    let Prepared { bat, request, .. } = prepare(&bat, &request)?;
    let solution = solve(&bat, &request)?;
    if let Some(throw) = &case.hit {
        let wanted = |check: &Check| Some((seen(check)?, check.at.unwrap_or(f64::NAN)));
        let wanted: Option<Vec<(KnownFigure, f64)>> = case.checks.iter().map(wanted).collect();
        let expected = "checks of hits only, where something is thrown";
        let wanted = wanted.ok_or_else(|| Error::value(&case.name, "others", expected))?;
        return throw.on_bat(&bat, &solution, &wanted);
    }
    let found = |check| found(check, &bat, &solution, &request).unwrap_or(f64::NAN);
    Ok(case.checks.iter().map(found).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With every theory of the solution.
    #[test]
    fn the_dowel_is_as_near_to_its_closed_form_as_is_stated() {
        for theory in [Theory::Auto, Theory::EulerBernoulli, Theory::Timoshenko] {
            let request = Request { modes: 10, theory, ..Request::default() };
            let [truth, stated] = dowel_proof(&request).unwrap();
            assert!(
                truth <= 1.1 * stated && stated <= request.tolerance,
                "{theory:?} {truth} {stated}"
            );
        }
    }

    #[test]
    fn what_is_for_information_is_neither_passed_nor_missed() {
        let row = KnownNumber {
            case: String::new(),
            quantity: String::new(),
            expected: 1.0,
            found: 2.0,
            error: 1.0,
            tolerance: 0.0,
            relative: true,
            information: true,
            note: None,
        };
        assert!(!row.missed() && row.share() == 0.0);
        let counted = KnownNumber { information: false, ..row.clone() };
        assert!(counted.missed() && counted.share() > 1.0);
        assert_eq!(
            KnownNumber { found: f64::NAN, error: f64::NAN, ..counted }.share(),
            f64::INFINITY
        );
    }

    #[test]
    fn a_wrong_answer_and_a_missing_one_do_not_pass() {
        let row = |found: f64| KnownNumber {
            case: String::new(),
            quantity: String::new(),
            expected: 1.0,
            found,
            error: (found - 1.0).abs(),
            tolerance: 0.1,
            relative: true,
            information: false,
            note: None,
        };
        assert!(row(1.05).passes() && !row(1.2).passes() && !row(f64::NAN).passes());
    }
}
