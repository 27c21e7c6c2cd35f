//! Which answers can a study ask of a bat, and by which names?
//!
//! Every answer has one name: that of the member in the program's other documents, with its unit at the end.

use serde::Serialize;

use crate::engine::{Bat, Complaint, Error, Result, STANDARD_PIVOT, Solution};

/// A value and its error, both in the unit of the value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Figure {
    /// The value.
    pub value: f64,
    /// Possible error, 0 or more.
    pub error: f64,
}

/// Relative accuracy of masses and lengths.
const EXACT: f64 = 1e-13;

impl Figure {
    /// A value and its error.
    pub fn new(value: f64, error: f64) -> Self {
        Self { value, error }
    }

    /// A value that is off by no more than some roundings of itself.
    pub fn exact(value: f64) -> Self {
        Self { value, error: EXACT * value.abs() }
    }
}

/// Impact points of a barrel that is searched, as shares of the length.
pub const ALONG: [f64; 4] = [0.7, 0.775, 0.85, 0.925];

/// The first modes of a solution.
pub(crate) fn with_modes(solution: &Solution, count: usize) -> Solution {
    let mut fewer = solution.clone();
    fewer.modes.truncate(count);
    fewer
}

/// The quotient of a difference, answer by answer: of a bat with more of something and one with less, `run` apart.
pub fn quotient(more: &[Option<f64>], less: &[Option<f64>], run: f64) -> Vec<Option<f64>> {
    let slope = |(more, less): (&Option<f64>, &Option<f64>)| Some(((*more)? - (*less)?) / run);
    more.iter().zip(less).map(slope).collect()
}

/// An answer about a bat; its name in a document.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(into = "String")]
#[non_exhaustive]
pub enum Answer {
    /// Mass of the bat (kg).
    Mass,
    /// Balance point from the knob end (m).
    BalancePoint,
    /// Moment of inertia about the point 6 in from the knob end (kg m²).
    Inertia,
    /// Centre of percussion of a swing about that point, from the knob end (m).
    CenterOfPercussion,
    /// Frequency of a bending mode, counted from 1 (Hz).
    Frequency(usize),
    /// The node of a bending mode that is nearest to the tip, from the knob end (m).
    Node(usize),
    /// Speed of the fastest ball (m/s).
    ExitSpeed,
    /// Place of the fastest ball, from the knob end (m).
    ExitSpeedPlace,
    /// Beginning or, if true, end of the zone within 1 % of the fastest ball (m).
    Zone(bool),
    /// The least energy that stays in vibration (J).
    Vibration,
    /// Place where the least energy stays in vibration (m).
    VibrationPlace,
    /// The largest BBCOR of the outer half of the bat, free or as it is held.
    Bbcor,
    /// Exit speed of a ball that hits there, from the knob end (m, m/s).
    ExitSpeedAt(f64),
    /// Modal mass of a bending mode, counted from 1 (kg).
    ModalMass(usize),
    /// Energy that a hit there leaves in vibration (m, J).
    VibrationAt(f64),
    /// The least velocity that the hands feel (m/s).
    HandsVelocity,
    /// The least acceleration that the hands feel (m/s²).
    HandsAcceleration,
    /// Velocity that the hands feel of a hit there (m, m/s).
    HandsVelocityAt(f64),
    /// Acceleration that the hands feel of a hit there (m, m/s²).
    HandsAccelerationAt(f64),
}

impl From<Answer> for String {
    fn from(answer: Answer) -> Self {
        answer.name()
    }
}

/// Names and units of the answers without a number.
const NAMED: [(&str, &str, Answer); 14] = [
    ("mass_kg", "kg", Answer::Mass),
    ("balance_point_m", "m", Answer::BalancePoint),
    ("inertia_pivot_kg_m2", "kg m²", Answer::Inertia),
    ("center_of_percussion_m", "m", Answer::CenterOfPercussion),
    ("exit_speed_max.value", "m/s", Answer::ExitSpeed),
    ("exit_speed_max.x_m", "m", Answer::ExitSpeedPlace),
    ("zone_m[0]", "m", Answer::Zone(false)),
    ("zone_m[1]", "m", Answer::Zone(true)),
    ("vibration_min.value", "J", Answer::Vibration),
    ("vibration_min.x_m", "m", Answer::VibrationPlace),
    ("bbcor_max", "", Answer::Bbcor),
    ("hands_velocity_min.value", "m/s", Answer::HandsVelocity),
    ("hands_acceleration_min.value", "m/s²", Answer::HandsAcceleration),
    ("f1_hz", "Hz", Answer::Frequency(1)),
];
/// Most modes that a study of many bats may ask for.
const MOST_MODES: usize = 40;
/// An answer about a hit at a place (m).
type Local = fn(f64) -> Answer;
/// The answers about a hit at a place, each with the beginning of its name and its unit.
const AT: [(&str, &str, Local); 4] = [
    ("exit_speed_m_s@", "m/s", Answer::ExitSpeedAt),
    ("vibration_j@", "J", Answer::VibrationAt),
    ("hands_velocity_m_s@", "m/s", Answer::HandsVelocityAt),
    ("hands_acceleration_m_s2@", "m/s²", Answer::HandsAccelerationAt),
];

impl Answer {
    /// The answer of that name.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] with the nearest name.
    pub fn named(name: &str) -> Result<Self> {
        let order = |text: &str| {
            let order = text.parse().ok().filter(|k| (1..=MOST_MODES).contains(k))?;
            (order.to_string() == text).then_some(order)
        };
        let between = |start: &str, end: &str| {
            let inner = name.strip_prefix(start).and_then(|rest| rest.strip_suffix(end));
            inner.and_then(order)
        };
        let known = NAMED.iter().find(|(known, ..)| *known == name).map(|(.., answer)| *answer);
        let at = || {
            let of = |(start, _, of): &(&str, &str, Local)| Some((name.strip_prefix(start)?, *of));
            let (place, of) = AT.iter().find_map(of)?;
            let is_plain = |c: char| c.is_ascii_digit() || c == '.';
            let plain =
                place.starts_with(|c: char| c.is_ascii_digit()) && place.chars().all(is_plain);
            place.parse().ok().filter(|_| plain).map(of)
        };
        let found = known
            .or_else(|| between("f", "_hz").map(Self::Frequency))
            .or_else(|| between("node_mode_", "_m").map(Self::Node))
            .or_else(|| between("modal_mass_mode_", "_kg").map(Self::ModalMass))
            .or_else(at);
        found.ok_or_else(|| {
            let names: Vec<&str> = NAMED.iter().map(|(name, ..)| *name).collect();
            let expected = format!(
                "{}, f2_hz to f{MOST_MODES}_hz, node_mode_1_m to node_mode_{MOST_MODES}_m, \
                 modal_mass_mode_1_kg to modal_mass_mode_{MOST_MODES}_kg, or {}0.70 for a place in m",
                names.join(", "),
                AT.map(|(start, ..)| start).join("0.70, ")
            );
            let complaint = Complaint::new("outputs", format!("\"{name}\""), expected);
            Error::Value(complaint.or_nearest(name, &names))
        })
    }

    /// Its name.
    pub fn name(self) -> String {
        let named = NAMED.iter().find(|(.., answer)| *answer == self);
        match (named, self) {
            (Some((name, ..)), _) => (*name).to_owned(),
            (None, Self::Node(order)) => format!("node_mode_{order}_m"),
            (None, Self::ModalMass(order)) => format!("modal_mass_mode_{order}_kg"),
            (None, Self::Frequency(order)) => format!("f{order}_hz"),
            (None, _) => {
                self.local().map(|(start, _, x)| format!("{start}{x}")).unwrap_or_default()
            }
        }
    }

    /// The beginning of the name, the unit and the place of an answer about a hit at a place.
    fn local(self) -> Option<(&'static str, &'static str, f64)> {
        let x = self.place()?;
        AT.into_iter().find(|(.., of)| of(x) == self).map(|(start, unit, _)| (start, unit, x))
    }

    /// The place (m from the knob end) of its hit.
    pub fn place(self) -> Option<f64> {
        match self {
            Self::ExitSpeedAt(x)
            | Self::VibrationAt(x)
            | Self::HandsVelocityAt(x)
            | Self::HandsAccelerationAt(x) => Some(x),
            _ => None,
        }
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        let named = NAMED.iter().find(|(.., answer)| *answer == self).map(|(_, unit, _)| *unit);
        match self {
            Self::Frequency(_) => "Hz",
            Self::Node(_) => "m",
            Self::ModalMass(_) => "kg",
            _ => named.or(self.local().map(|(_, unit, _)| unit)).unwrap_or_default(),
        }
    }

    /// Whether the barrel must be searched for it.
    pub fn is_searched(self) -> bool {
        self.of_the_hands()
            || matches!(
                self,
                Self::ExitSpeed
                    | Self::ExitSpeedPlace
                    | Self::Zone(_)
                    | Self::Vibration
                    | Self::VibrationPlace
                    | Self::Bbcor
            )
    }

    /// Whether a ball must be hit for it.
    pub fn of_a_hit(self) -> bool {
        self.place().is_some() || self.is_searched()
    }

    /// Whether it describes the motion at the hands.
    pub(crate) fn of_the_hands(self) -> bool {
        matches!(
            self,
            Self::HandsVelocity
                | Self::HandsAcceleration
                | Self::HandsVelocityAt(_)
                | Self::HandsAccelerationAt(_)
        )
    }

    /// How many modes it needs.
    pub fn modes(self) -> usize {
        match self {
            Self::Frequency(order) | Self::Node(order) | Self::ModalMass(order) => order,
            _ => 0,
        }
    }
}

/// Checks that every place in the answers is on the bat.
///
/// # Errors
///
/// [`Error::Value`] about the first one that is not.
pub fn on_the_bat(answers: &[Answer], bat: &Bat) -> Result<()> {
    let beyond = |answer: &&Answer| answer.place().is_some_and(|x| x > bat.length());
    let Some(off) = answers.iter().find(beyond) else { return Ok(()) };
    let expected = format!("a place on the bat, 0 to {} m", bat.length());
    Err(Error::value("outputs", off.name(), expected))
}

/// An answer that needs no hit.
pub fn figure(answer: Answer, bat: &Bat, solution: &Solution) -> Option<Figure> {
    let mode = |order: usize| solution.modes.get(order - 1);
    match answer {
        Answer::Mass => Some(Figure::exact(bat.inertia().mass)),
        Answer::BalancePoint => Some(Figure::exact(bat.inertia().balance_point)),
        Answer::Inertia => Some(Figure::exact(bat.inertia().about(STANDARD_PIVOT))),
        Answer::CenterOfPercussion => {
            bat.inertia().center_of_percussion(STANDARD_PIVOT).map(Figure::exact)
        }
        Answer::Frequency(order) => {
            let mode = mode(order)?;
            Some(Figure::new(mode.frequency(), mode.error.total() * mode.frequency()))
        }
        Answer::Node(order) => {
            let mode = mode(order)?;
            Some(Figure::new(*mode.nodes.last()?, mode.error.nodes))
        }
        Answer::ModalMass(order) => {
            let mode = mode(order)?;
            Some(Figure::new(mode.modal_mass, mode.error.modal_mass * mode.modal_mass))
        }
        _ => None,
    }
}
