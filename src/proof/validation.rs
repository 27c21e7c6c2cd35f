//! Does the program reproduce what is known?
//!
//! [`run`] solves one case of [`CASES`] and sets its numbers beside the known ones.
//!
//! The cases are data, in the folder `validation/`, and travel with the program.

use std::f64::consts::TAU;
use std::path::Path;

use schemars::JsonSchema;
use schemars::generate::Contract;
use serde::Deserialize;
use serde_json::Value;

use crate::base::error::{Error, Result};
use crate::base::units::ounce_square_inches;
use crate::bat::body::{Bat, STANDARD_PIVOT};
use crate::bat::theory::Theory;
use crate::beam::dowel::{Dowel, Ends, UniformMode};
use crate::files::schema::bat::BatFile;
use crate::files::schema::document::{Document, Format};
use crate::modes::solve::{Request, Solution, solve};
use crate::motion::frf::Frf;
use crate::motion::ringing::Ringing;
use crate::proof::known_hits::{Seen, Throw};
use crate::study::tuned::tuned;

/// One bat, or a rigid wall for a ball, and what is known about it, with the sources of the numbers and
/// how near ours must be. SI, the unit in every name; positions count from the knob end.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Case of known answers of sweetspot, sweetspot-validation/1")]
pub struct Case {
    /// Name of the format and its version: sweetspot-validation/1.
    pub format: Format<Case>,
    /// What it is about.
    pub name: String,
    /// Where the expected numbers come from.
    pub source: String,
    /// Whose numbers they are; a case without it has an exact answer.
    pub published: Option<Published>,
    /// The bat, or the name of a file that travels with the program; none where a wall is hit.
    #[serde(default)]
    #[schemars(with = "Option<CaseBat>")]
    bat: Value,
    /// What is asked of the bat's modes.
    #[serde(default)]
    solve: Solve,
    /// What is thrown at the bat, or at the wall, where all checks are of hits.
    pub hit: Option<Throw>,
    /// The known numbers.
    pub checks: Vec<Check>,
}

impl Document for Case {
    const NAME: &'static str = "validation";
    const CONTRACT: Contract = Contract::Deserialize;
}

/// A bat in a case.
#[derive(JsonSchema)]
#[schemars(untagged)]
#[expect(dead_code, reason = "the form of a value that is read as what it turns out to be")]
enum CaseBat {
    /// The name of a bat file that travels with the program.
    File(String),
    /// A bat file in its own right.
    Bat(Box<BatFile>),
}

/// Which published numbers a case holds, and where they stand when set side by side.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Published {
    /// Cases of one bat stand in one table.
    pub bat: String,
    /// How the numbers were found.
    pub kind: Kind,
    /// Which of several meshes, where the bat has more than one.
    pub row: Option<String>,
}

/// Where a published number is from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// By somebody, on the bat.
    Measured,
    /// By somebody else's program.
    Computed,
}

/// What is asked of the bat's modes.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Solve {
    /// Number of modes.
    modes: usize,
    /// Relative error of a frequency that is asked for.
    tolerance: Option<f64>,
    /// Number of elements; the planner's own choice if absent.
    elements: Option<usize>,
    /// Name of the beam theory; the plain beam if absent.
    theory: Option<String>,
}

/// One known number.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Check {
    /// What is known.
    pub quantity: Known,
    /// Number of the mode, from 1.
    pub mode: Option<usize>,
    /// Number of the node of that mode, from 1 at the knob.
    pub node: Option<usize>,
    /// Where a ball hits, or a force acts (m).
    pub at: Option<f64>,
    /// Where the deflection under the force is seen (m).
    to: Option<f64>,
    /// How fast the force swings (Hz).
    frequency_hz: Option<f64>,
    /// How long after a blow (s).
    time_s: Option<f64>,
    /// How fast the ball flies at a wall (m/s).
    speed_m_per_s: Option<f64>,
    /// The known number, in the quantity's unit.
    pub expected: f64,
    /// How large the relative error may be.
    relative: Option<f64>,
    /// How large the error may be, in the quantity's unit.
    absolute: Option<f64>,
    /// Shown with its difference and neither passed nor missed; the note says why.
    #[serde(default)]
    information: bool,
    /// Why the tolerance is what it is; a check without it has the note above.
    pub note: Option<String>,
}

/// What is known, with its unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Known {
    /// Natural frequency (Hz).
    FrequencyHz,
    /// Ratio of a frequency to the first one.
    FrequencyRatio,
    /// Position of a node from the knob end (m).
    NodeM,
    /// Modal mass for a largest deflection of 1 (kg).
    ModalMassKg,
    /// How fast a damped mode dies out and how fast it swings.
    #[serde(rename = "decay_1_per_s")]
    Decay,
    /// How fast a damped mode swings (Hz).
    DampedFrequencyHz,
    /// Real part of deflection per force at a frequency (m/N), with time as `e^{+iωt}`.
    ReceptanceRealMPerN,
    /// Imaginary part of deflection per force at a frequency (m/N), with time as `e^{+iωt}`.
    ReceptanceImaginaryMPerN,
    /// Deflection after an impulse of 1 N s, by the rigid motions and the modes of the case.
    DeflectionAfterBlowM,
    /// Mass (kg).
    MassKg,
    /// Balance point from the knob end (m).
    BalancePointM,
    /// Moment of inertia about the balance point (kg m²).
    InertiaBalanceKgM2,
    /// Moment of inertia about the point 6 in from the knob (kg m²).
    #[serde(rename = "inertia_pivot_kg_m2")]
    InertiaPivotKgM2,
    /// Centre of percussion for a pivot 6 in from the knob, from the knob end (m).
    CenterOfPercussionM,
    /// Swing weight: moment of inertia about the point 6 in from the knob (oz in²).
    InertiaPivotOzIn2,
    /// Something of a hit.
    #[serde(untagged)]
    Hit(Seen),
}

/// A known number beside ours.
#[derive(Debug, Clone)]
pub struct KnownNumber {
    /// Name of its case.
    pub case: String,
    /// What is known, in words.
    pub quantity: String,
    /// The known number.
    pub expected: f64,
    /// Ours.
    pub found: f64,
    /// In the sense of the tolerance: relative, or absolute in the quantity's unit.
    pub error: f64,
    /// How large the error may be, in the same sense.
    pub tolerance: f64,
    /// Whether both are relative.
    pub relative: bool,
    /// For information only: neither passed nor missed.
    pub information: bool,
    /// Why the tolerance is what it is, or why the check has no tolerance.
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

/// The cases that travel with the program: file name and text.
pub const CASES: &[(&str, &str)] = &[
    ("absorber", include_str!("../../validation/absorber.json")),
    ("clamped_clamped", include_str!("../../validation/clamped_clamped.json")),
    ("clamped_free", include_str!("../../validation/clamped_free.json")),
    ("clamped_pinned", include_str!("../../validation/clamped_pinned.json")),
    ("clamped_tip_mass", include_str!("../../validation/clamped_tip_mass.json")),
    ("cone_1_10", include_str!("../../validation/cone_1_10.json")),
    ("cone_1_100", include_str!("../../validation/cone_1_100.json")),
    ("cone_1_1000", include_str!("../../validation/cone_1_1000.json")),
    ("cone_1_10000", include_str!("../../validation/cone_1_10000.json")),
    ("cone_1_10_60", include_str!("../../validation/cone_1_10_60.json")),
    ("cone_1_2p64", include_str!("../../validation/cone_1_2p64.json")),
    ("cone_1_2p64_60", include_str!("../../validation/cone_1_2p64_60.json")),
    ("cone_complete", include_str!("../../validation/cone_complete.json")),
    ("cork", include_str!("../../validation/cork.json")),
    ("damped_absorber", include_str!("../../validation/damped_absorber.json")),
    ("damped_hands", include_str!("../../validation/damped_hands.json")),
    ("dowel", include_str!("../../validation/dowel.json")),
    ("dumbbell", include_str!("../../validation/dumbbell.json")),
    ("end_springs", include_str!("../../validation/end_springs.json")),
    ("exponential", include_str!("../../validation/exponential.json")),
    ("grip_bed", include_str!("../../validation/grip_bed.json")),
    ("grip_bed_cone_timo", include_str!("../../validation/grip_bed_cone_timo.json")),
    ("handle_1mm", include_str!("../../validation/handle_1mm.json")),
    ("heavy_free", include_str!("../../validation/heavy_free.json")),
    ("heavy_tip", include_str!("../../validation/heavy_tip.json")),
    ("hermite_01", include_str!("../../validation/hermite_01.json")),
    ("hermite_02", include_str!("../../validation/hermite_02.json")),
    ("hermite_04", include_str!("../../validation/hermite_04.json")),
    ("hermite_08", include_str!("../../validation/hermite_08.json")),
    ("hermite_16", include_str!("../../validation/hermite_16.json")),
    ("hermite_32", include_str!("../../validation/hermite_32.json")),
    ("hermite_64", include_str!("../../validation/hermite_64.json")),
    ("hollow_linear", include_str!("../../validation/hollow_linear.json")),
    ("house_reference", include_str!("../../validation/house_reference.json")),
    ("interior_clamp", include_str!("../../validation/interior_clamp.json")),
    ("interior_clamp_middle", include_str!("../../validation/interior_clamp_middle.json")),
    ("joint", include_str!("../../validation/joint.json")),
    ("linear_bat", include_str!("../../validation/linear_bat.json")),
    ("lossy_dowel", include_str!("../../validation/lossy_dowel.json")),
    ("mid_mass", include_str!("../../validation/mid_mass.json")),
    ("nafems_fv2_clamped_pinned", include_str!("../../validation/nafems_fv2_clamped_pinned.json")),
    ("nafems_fv2_pinned_pinned", include_str!("../../validation/nafems_fv2_pinned_pinned.json")),
    ("nafems_fv5", include_str!("../../validation/nafems_fv5.json")),
    ("northwestern_aluminium", include_str!("../../validation/northwestern_aluminium.json")),
    ("northwestern_aluminium_09", include_str!("../../validation/northwestern_aluminium_09.json")),
    ("northwestern_aluminium_20", include_str!("../../validation/northwestern_aluminium_20.json")),
    ("northwestern_aluminium_40", include_str!("../../validation/northwestern_aluminium_40.json")),
    ("northwestern_aluminium_80", include_str!("../../validation/northwestern_aluminium_80.json")),
    (
        "northwestern_aluminium_ansys",
        include_str!("../../validation/northwestern_aluminium_ansys.json"),
    ),
    (
        "northwestern_aluminium_fit",
        include_str!("../../validation/northwestern_aluminium_fit.json"),
    ),
    (
        "northwestern_aluminium_measured",
        include_str!("../../validation/northwestern_aluminium_measured.json"),
    ),
    ("northwestern_wood", include_str!("../../validation/northwestern_wood.json")),
    ("northwestern_wood_09", include_str!("../../validation/northwestern_wood_09.json")),
    ("northwestern_wood_20", include_str!("../../validation/northwestern_wood_20.json")),
    ("northwestern_wood_40", include_str!("../../validation/northwestern_wood_40.json")),
    ("northwestern_wood_80", include_str!("../../validation/northwestern_wood_80.json")),
    ("northwestern_wood_above", include_str!("../../validation/northwestern_wood_above.json")),
    (
        "northwestern_wood_misprint",
        include_str!("../../validation/northwestern_wood_misprint.json"),
    ),
    ("northwestern_wood_side", include_str!("../../validation/northwestern_wood_side.json")),
    ("offset_mass", include_str!("../../validation/offset_mass.json")),
    ("pchip_bat", include_str!("../../validation/pchip_bat.json")),
    ("pin_inside", include_str!("../../validation/pin_inside.json")),
    ("pinned_pinned", include_str!("../../validation/pinned_pinned.json")),
    ("r161_hit_cross", include_str!("../../validation/r161_hit_cross.json")),
    ("r161_hit_fast", include_str!("../../validation/r161_hit_fast.json")),
    ("r161_hit_nathan", include_str!("../../validation/r161_hit_nathan.json")),
    ("r161_hit_slow", include_str!("../../validation/r161_hit_slow.json")),
    ("r161_nathan", include_str!("../../validation/r161_nathan.json")),
    ("r161_nathan_timoshenko", include_str!("../../validation/r161_nathan_timoshenko.json")),
    ("r161_reference", include_str!("../../validation/r161_reference.json")),
    ("r161_rest_free", include_str!("../../validation/r161_rest_free.json")),
    ("r161_rest_pivoted", include_str!("../../validation/r161_rest_pivoted.json")),
    ("r161_slices", include_str!("../../validation/r161_slices.json")),
    ("r161_wolfish", include_str!("../../validation/r161_wolfish.json")),
    ("rayleigh_cone", include_str!("../../validation/rayleigh_cone.json")),
    ("rayleigh_dowel", include_str!("../../validation/rayleigh_dowel.json")),
    ("receptance_dowel", include_str!("../../validation/receptance_dowel.json")),
    ("receptance_timo", include_str!("../../validation/receptance_timo.json")),
    ("russell_little_league", include_str!("../../validation/russell_little_league.json")),
    ("russell_usual", include_str!("../../validation/russell_usual.json")),
    ("sinusoidal", include_str!("../../validation/sinusoidal.json")),
    ("sleeve", include_str!("../../validation/sleeve.json")),
    ("soft_springs", include_str!("../../validation/soft_springs.json")),
    ("squared_up_acuna", include_str!("../../validation/squared_up_acuna.json")),
    ("squared_up_larnach", include_str!("../../validation/squared_up_larnach.json")),
    ("step_1_3", include_str!("../../validation/step_1_3.json")),
    ("step_1_3_60", include_str!("../../validation/step_1_3_60.json")),
    ("steps_many", include_str!("../../validation/steps_many.json")),
    ("stiff_springs", include_str!("../../validation/stiff_springs.json")),
    ("struck_dowel", include_str!("../../validation/struck_dowel.json")),
    ("struck_lossy_dowel", include_str!("../../validation/struck_lossy_dowel.json")),
    ("tanh_bat", include_str!("../../validation/tanh_bat.json")),
    ("taped_dowel", include_str!("../../validation/taped_dowel.json")),
    ("thomson_table", include_str!("../../validation/thomson_table.json")),
    ("three_supports", include_str!("../../validation/three_supports.json")),
    ("timo_clamped_tip_mass", include_str!("../../validation/timo_clamped_tip_mass.json")),
    ("timo_cone", include_str!("../../validation/timo_cone.json")),
    ("timo_dowel", include_str!("../../validation/timo_dowel.json")),
    ("timo_dowel_60", include_str!("../../validation/timo_dowel_60.json")),
    ("timo_pinned_pinned", include_str!("../../validation/timo_pinned_pinned.json")),
    ("timo_slender", include_str!("../../validation/timo_slender.json")),
    ("timo_step", include_str!("../../validation/timo_step.json")),
    ("timo_stubby", include_str!("../../validation/timo_stubby.json")),
    ("timo_tube", include_str!("../../validation/timo_tube.json")),
    ("torpedo_reference", include_str!("../../validation/torpedo_reference.json")),
    ("torpedo_slices", include_str!("../../validation/torpedo_slices.json")),
    ("torpedo_wolfish", include_str!("../../validation/torpedo_wolfish.json")),
    ("torpedo_wolfish_later", include_str!("../../validation/torpedo_wolfish_later.json")),
    ("two_materials", include_str!("../../validation/two_materials.json")),
    ("van_zandt_computed", include_str!("../../validation/van_zandt_computed.json")),
    ("van_zandt_measured", include_str!("../../validation/van_zandt_measured.json")),
    ("wall_nathan", include_str!("../../validation/wall_nathan.json")),
    ("wall_times", include_str!("../../validation/wall_times.json")),
    ("weighed_dowel", include_str!("../../validation/weighed_dowel.json")),
];

/// The bats that travel with the program: path and text.
pub const BATS: &[(&str, &str)] = &[
    ("meshes/cone.json", include_str!("../../meshes/cone.json")),
    ("meshes/corked.json", include_str!("../../meshes/corked.json")),
    ("meshes/dowel.json", include_str!("../../meshes/dowel.json")),
    ("meshes/house.json", include_str!("../../meshes/house.json")),
    (
        "meshes/northwestern_aluminium.json",
        include_str!("../../meshes/northwestern_aluminium.json"),
    ),
    ("meshes/northwestern_wood.json", include_str!("../../meshes/northwestern_wood.json")),
    ("meshes/r161.json", include_str!("../../meshes/r161.json")),
    ("meshes/tanh.json", include_str!("../../meshes/tanh.json")),
    ("meshes/torpedo.json", include_str!("../../meshes/torpedo.json")),
    ("meshes/two_piece.json", include_str!("../../meshes/two_piece.json")),
];

/// One of the bats that travel with the program.
///
/// # Errors
///
/// [`Error::Value`] if there is none of that name.
pub fn bundled_bat(path: &str) -> Result<Bat> {
    let (_, text) = BATS
        .iter()
        .find(|(name, _)| *name == path)
        .ok_or_else(|| Error::value("bat", path, "a bat that travels with the program"))?;
    Bat::from_text(path, text, Path::new(""))
}

/// What is known of a bat to all digits of a number.
#[derive(Debug, Clone)]
pub struct Truth {
    /// The bat.
    pub bat: Bat,
    /// Beam theory of the known numbers.
    pub theory: Theory,
    /// Frequencies of modes 1, 2, … (Hz).
    pub frequencies: Vec<f64>,
    /// Nodes of the lowest modes from the knob end (m); empty where they are not known.
    pub nodes: Vec<Vec<f64>>,
    /// Modal masses of the lowest modes (kg), where they are known.
    pub modal_masses: Vec<Option<f64>>,
}

impl Truth {
    /// What those cases, all of the same bat, say together.
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

/// The uniform bar that a bat with one radius is.
fn dowel(bat: &Bat) -> Dowel {
    Dowel {
        length: bat.length(),
        radius: bat.profile().at(0.0).outer,
        youngs_modulus: bat.material().youngs_modulus,
        density: bat.material().density,
    }
}

/// The worst true and the worst stated relative error of the free dowel's frequencies, solved as
/// requested, against `cos β cosh β = 1`.
///
/// # Errors
///
/// As [`solve`].
pub fn dowel_proof(request: &Request) -> Result<[f64; 2]> {
    let bat = bundled_bat("meshes/dowel.json")?;
    let solution = solve(&bat, request)?;
    let exact = |order: usize| dowel(&bat).frequency(Ends::FreeFree, order);
    let errors =
        solution.modes.iter().map(|mode| (mode.frequency() / exact(mode.order) - 1.0).abs());
    Ok([errors.fold(0.0, f64::max), solution.worst()])
}

/// One of the cases that travel with the program.
///
/// # Errors
///
/// [`Error::Value`] if there is none of that name.
pub fn bundled_case(name: &str) -> Result<Case> {
    read(name, text(name)?)
}

/// The text of the case of that name.
fn text(name: &str) -> Result<&'static str> {
    let found = CASES.iter().find(|(case, _)| *case == name);
    found
        .map(|(_, text)| *text)
        .ok_or_else(|| Error::value("case", name, "a case that travels with the program"))
}

/// A case.
fn read(name: &str, text: &str) -> Result<Case> {
    serde_json::from_str(text)
        .map_err(|error| Error::value(name, error, "a sweetspot-validation/1 case"))
}

impl Case {
    /// The case's bat.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for an unknown name, and whatever its file raises.
    pub fn bat(&self) -> Result<Bat> {
        match &self.bat {
            Value::String(path) => bundled_bat(path),
            Value::Null => Err(Error::value(&self.name, "no bat", "a bat")),
            inline => Bat::from_text(&self.name, &inline.to_string(), Path::new("")),
        }
    }

    /// Where the case's bat is from: the file that travels with the program, or what it says.
    pub fn bat_source(&self) -> String {
        match &self.bat {
            Value::String(path) => format!("`{path}`."),
            Value::Null => "none, the ball meets a rigid wall.".to_owned(),
            inline => format!("{}.", inline["source"].as_str().unwrap_or("of the case")),
        }
    }

    /// What the case asks of its bat.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for an unknown theory.
    pub fn request(&self) -> Result<Request> {
        let known = |name: &String| Theory::ALL.into_iter().find(|theory| theory.name() == name);
        let theory = match &self.solve.theory {
            None => Theory::EulerBernoulli,
            Some(name) => known(name).ok_or_else(|| Error::value("theory", name, "a theory"))?,
        };
        Ok(Request {
            theory,
            modes: self.solve.modes,
            tolerance: self.solve.tolerance.unwrap_or(Request::default().tolerance),
            elements: self.solve.elements,
            ..Request::default()
        })
    }

    /// What is found of every check, NaN where nothing is: it passes no test.
    fn found(&self) -> Result<Vec<f64>> {
        let seen = |check: &Check| match check.quantity {
            Known::Hit(seen) => Some(seen),
            _ => None,
        };
        if let (Some(throw), Value::Null) = (&self.hit, &self.bat) {
            let on_wall = |check| Some(throw.on_wall(seen(check)?, check.speed_m_per_s?));
            return Ok(self
                .checks
                .iter()
                .map(|check| on_wall(check).unwrap_or(f64::NAN))
                .collect());
        }
        let request = self.request()?;
        let bat = tuned(self.bat()?, request.theory, request.tolerance)?;
        let solution = solve(&bat, &request)?;
        if let Some(throw) = &self.hit {
            let wanted = |check: &Check| Some((seen(check)?, check.at.unwrap_or(f64::NAN)));
            let wanted: Option<Vec<(Seen, f64)>> = self.checks.iter().map(wanted).collect();
            let expected = "checks of hits only, where something is thrown";
            let wanted = wanted.ok_or_else(|| Error::value(&self.name, "others", expected))?;
            return throw.on_bat(&bat, &solution, &wanted);
        }
        let found = |check| found(check, &bat, &solution, &request).unwrap_or(f64::NAN);
        Ok(self.checks.iter().map(found).collect())
    }
}

/// Runs one case: a row for every known number.
///
/// # Errors
///
/// [`Error::Value`] if the case is not well-formed, and whatever its bat and its solution raise.
pub fn run(name: &str, text: &str) -> Result<(Case, Vec<KnownNumber>)> {
    let case = read(name, text)?;
    let mut note = None;
    let mut rows = Vec::new();
    for (check, found) in case.checks.iter().zip(case.found()?) {
        note = check.note.clone().or(note);
        rows.push(KnownNumber { note: note.clone(), ..row(name, check, found) });
    }
    Ok((case, rows))
}

/// A check beside what was found, the note aside.
fn row(case: &str, check: &Check, found: f64) -> KnownNumber {
    // Without a tolerance, places and hits differ by their unit and all else by a share.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The names of the JSON files of a folder of the package.
    fn files(folder: &str) -> Vec<String> {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        let names = std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().file_name());
        let names = names.map(|name| name.into_string().unwrap());
        let mut names: Vec<String> = names.filter(|name| name.ends_with(".json")).collect();
        names.sort();
        names
    }

    #[test]
    fn every_file_of_the_folders_travels_with_the_program() {
        let cases: Vec<String> = CASES.iter().map(|(name, _)| format!("{name}.json")).collect();
        assert_eq!(cases, files("validation"));
        let bats: Vec<String> = BATS.iter().map(|(name, _)| name.replace("meshes/", "")).collect();
        assert_eq!(bats, files("meshes"));
    }

    /// Checks that no reader could take for a pass: every tolerance is one, every reason is there.
    #[test]
    fn every_check_has_a_tolerance_and_a_reason_or_is_for_information() {
        for (name, text) in CASES {
            let case = read(name, text).unwrap();
            assert!(!case.source.is_empty(), "{name}");
            let reason = case.checks.first().and_then(|check| check.note.as_ref());
            assert!(reason.is_some(), "{name}: the first check has no note");
            let mut information = false;
            for check in &case.checks {
                let tolerances = [check.relative, check.absolute];
                let given = tolerances.iter().flatten().filter(|t| **t > 0.0).count();
                assert_eq!(given, usize::from(!check.information), "{name}: {check:?}");
                // A case either counts or has a reason not to, never both.
                assert!(check.note.is_some() || check.information == information, "{name}");
                information = check.information;
            }
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
