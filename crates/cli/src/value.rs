//! How are values on the command line read and shown?

use std::any::TypeId;
use std::ffi::OsStr;
use std::time::Duration;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Arg, Command};
use sweetspot::base::error::Complaint;
use sweetspot::base::number::significant;
use sweetspot::base::typed;
use sweetspot::base::units::{self, Quantity};
use sweetspot::collision::ball::restitution;
use sweetspot::{Solver, Theory};
use sweetspot_report::parts::Units;

/// The unit of length of a universal file, such as `mm`, with the unit of force that goes with it.
pub fn file_unit(text: &str) -> std::result::Result<uff58::Units, String> {
    let metre = units::factor(text.trim(), Quantity::Length).map_err(|wrong| wrong.to_string())?;
    Ok(uff58::Units::of_length(metre, text.trim()))
}

/// The use of a value: its quantity, and its plausible values.
///
/// A bare number is in SI, unless it is implausible so and plausible in a unit of the trade. Then the error names both
/// readings (a pitch of 90 is 201 mph in SI, and the user means 90 mph). Files are read without this check, because
/// programs write them too.
#[derive(Clone, Copy)]
pub struct Use {
    quantity: Quantity,
    /// Smallest and largest plausible size, in SI.
    plausible: [f64; 2],
    /// Units in which the trade may mean it, likeliest first.
    trade: &'static [&'static str],
}

/// A place on a bat, from the knob end.
pub const PLACE: Use = Use::new(Quantity::Length, [0.0, 1.2], &["in", "cm", "mm"]);
/// Length of a bat.
pub const BAT_LENGTH: Use = Use::new(Quantity::Length, [0.45, 1.2], &["in", "cm", "mm"]);
/// Diameter of a bat.
pub const DIAMETER: Use = Use::new(Quantity::Length, [0.005, 0.1], &["in", "cm", "mm"]);
/// A thickness turned off a bat, or put around it.
pub const LITTLE: Use = Use::new(Quantity::Length, [0.0, 0.02], &["mm", "in"]);
/// Rotation centre of a swing, from the knob end.
pub const PIVOT: Use = Use::new(Quantity::Length, [0.0, 0.6], &["in", "cm"]);
/// Distance between places on a bat.
pub const SPACING: Use = Use::new(Quantity::Length, [0.0, 0.3], &["in", "cm", "mm"]);
/// Speed of a ball or of a point of a bat in play.
pub const PLAY_SPEED: Use = Use::new(Quantity::Speed, [0.0, 54.0], &["mph", "km/h"]);
/// Speed of a ball in a laboratory's cannon.
pub const CANNON_SPEED: Use = Use::new(Quantity::Speed, [0.0, 70.0], &["mph", "km/h"]);
/// Angular speed of a swing.
pub const SWING: Use = Use::new(Quantity::AngularSpeed, [0.0, 60.0], &["deg/s", "rpm"]);
/// Stiffness of a ball or of a barrel's wall.
pub const STIFFNESS: Use = Use::new(Quantity::Stiffness, [1e5, 1e12], &["lbf/in"]);
/// The error of a reading of a length.
pub const READING: Use = Use::new(Quantity::Length, [0.0, 0.01], &["mm", "in"]);
/// The error of a scale.
pub const SCALE: Use = Use::new(Quantity::Mass, [0.0, 0.1], &["g", "oz"]);
/// Mass of a part of a bat.
pub const PART_MASS: Use = Use::new(Quantity::Mass, [0.0, 1.5], &["oz", "g"]);
/// Mass of a hammer of a vibration test.
pub const HAMMER: Use = Use::new(Quantity::Mass, [0.01, 2.0], &["g", "oz"]);
/// Moment of inertia of a bat about its handle.
pub const SWING_WEIGHT: Use = Use::new(Quantity::Inertia, [0.01, 1.0], &["oz in^2"]);
/// How long a ball pushes a bat.
pub const CONTACT_TIME: Use = Use::new(Quantity::Time, [0.0, 0.1], &["ms", "us"]);
/// How long a bat is watched.
pub const RINGING_TIME: Use = Use::new(Quantity::Time, [0.0, 2.0], &["ms", "us"]);
/// A moment of a recording.
#[cfg(feature = "audio")]
pub const MOMENT: Use = Use::new(Quantity::Time, [0.0, 3600.0], &[]);
/// Any frequency.
pub const FREQUENCY: Use = Use::new(Quantity::Frequency, [0.0, f64::MAX], &[]);
/// The highest frequency of a range.
pub const TOP_FREQUENCY: Use = Use::new(Quantity::Frequency, [10.0, 1e6], &["kHz"]);
/// Frequency of a bat's first bending mode, as a tap sounds.
pub const TAP: Use = Use::new(Quantity::Frequency, [20.0, 2000.0], &["kHz"]);
/// Impulse of a blow.
pub const IMPULSE: Use = Use::new(Quantity::Impulse, [0.0, 100.0], &[]);

impl Use {
    const fn new(quantity: Quantity, plausible: [f64; 2], trade: &'static [&'static str]) -> Self {
        Self { quantity, plausible, trade }
    }

    /// Whether a value in SI is plausible.
    pub fn has(&self, value: f64) -> bool {
        let [least, most] = self.plausible;
        (least..=most).contains(&value.abs())
    }

    /// The plausible values, for error messages.
    pub fn range(&self) -> String {
        let [least, most] = self.plausible;
        format!("{least} to {most} {}", self.quantity.unit())
    }

    /// A value from the command line in SI.
    pub fn read(&self, text: &str) -> std::result::Result<f64, String> {
        self.sensible(text, self.quantity.si().0)
            .and_then(|()| units::parse_or_si(text, self.quantity))
            .map_err(|complaint| complaint.to_string())
    }

    /// Refuses a bare number that is implausible in the unit of bare numbers here, and plausible in another.
    ///
    /// # Errors
    ///
    /// Both readings, and how each is written.
    pub fn sensible(&self, text: &str, bare: &str) -> std::result::Result<(), Complaint> {
        let Some(number) = typed::number(text) else { return Ok(()) };
        let in_si = |unit: &str| units::factor(unit, self.quantity).map(|factor| number * factor);
        let plausible = |unit: &str| in_si(unit).is_ok_and(|value| self.has(value));
        let meant = self.trade.iter().find(|unit| plausible(unit));
        let Some(meant) = meant.filter(|_| number != 0.0 && !plausible(bare)) else {
            return Ok(());
        };
        let text = text.trim();
        let per_unit = units::factor(meant, self.quantity).unwrap_or(1.0);
        let converted = significant(in_si(bare)? / per_unit, 3);
        let expected = format!(
            "its unit: {text} {meant} or {text} {bare}? Write \"{text} {meant}\", or \"{text} {bare}\" \
             if {converted} {meant} is meant"
        );
        Err(Complaint::new("", text, expected))
    }
}

impl TypedValueParser for Use {
    type Value = f64;

    fn parse_ref(
        &self,
        command: &Command,
        option: Option<&Arg>,
        text: &OsStr,
    ) -> std::result::Result<f64, clap::Error> {
        let of = *self;
        (move |text: &str| of.read(text)).parse_ref(command, option, text)
    }
}

/// The command, in which every number may begin with a minus.
pub fn with_minus(command: Command) -> Command {
    let command =
        command.mut_args(|arg| match arg.get_value_parser().type_id() == TypeId::of::<f64>() {
            true => arg.allow_hyphen_values(true),
            false => arg,
        });
    command.mut_subcommands(with_minus)
}

/// The angular speed of a swing; a speed of the barrel gets a hint about its option.
pub fn swing_speed(text: &str) -> std::result::Result<f64, String> {
    let speed = text.trim();
    let answer = format!("for the speed of a point of the barrel write --bat-speed \"{speed}");
    match (typed::number(text), units::parse(text, Quantity::Speed)) {
        (Some(number), _) if !SWING.has(number) && PLAY_SPEED.has(number * 0.447_04) => {
            Err(format!("found {speed}; {answer} mph\", for an angular speed \"{speed} rad/s\""))
        }
        (None, Ok(_)) => Err(format!("found {speed}, a speed; {answer}\"")),
        _ => SWING.read(text),
    }
}

/// A coefficient of restitution on the command line.
pub fn cor(text: &str) -> std::result::Result<f64, String> {
    text.parse::<f64>().ok().and_then(|e| restitution(e + 0.0).ok()).ok_or("expected 0 to 1".into())
}

/// A relative accuracy from the command line, as a number or in %.
pub fn tolerance(text: &str) -> std::result::Result<f64, String> {
    let (number, scale) = match text.trim().strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text, 1.0),
    };
    match number.trim().parse::<f64>() {
        Ok(value) if value * scale > 0.0 && value * scale < 1.0 => Ok(value * scale),
        _ => Err("expected a number between 0 and 1, such as 1e-6 or 0.01%".into()),
    }
}

/// A time limit from the command line.
pub fn budget(text: &str) -> std::result::Result<Duration, String> {
    let seconds = units::parse_or_si(text, Quantity::Time).map_err(|wrong| wrong.to_string())?;
    let expected = "expected a time from 1 us to 1 day, such as \"5 ms\"";
    if (1e-6..=86_400.0).contains(&seconds) {
        Duration::try_from_secs_f64(seconds).map_err(|_| expected.into())
    } else {
        Err(expected.into())
    }
}

/// One of the names, which completions and messages list.
pub fn choice<T: Clone + Send + Sync + 'static>(
    names: &'static [&'static str],
    meant: impl Fn(&str) -> T + Clone + Send + Sync + 'static,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(names).map(move |name| meant(&name))
}

/// One of these by its name, as [`choice`].
pub fn named<T: Copy + Send + Sync + 'static, const N: usize>(
    all: [T; N],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    let of_name = move |text: String| all.into_iter().find(|one| name(*one) == text);
    PossibleValuesParser::new(all.map(name))
        .try_map(move |text| of_name(text).ok_or("no such name"))
}

/// A theory, or `None` for the one that the bat needs.
#[derive(Debug, Clone, Copy)]
pub struct TheoryChoice(pub Option<Theory>);

/// `--theory` on the command line.
pub fn theory() -> impl TypedValueParser<Value = TheoryChoice> {
    choice(&["auto", "euler-bernoulli", "rayleigh", "timoshenko"], |name| {
        TheoryChoice(Theory::ALL.into_iter().find(|theory| theory.name() == name))
    })
}

/// `--solver` on the command line.
pub fn solver() -> impl TypedValueParser<Value = Solver> {
    choice(&["auto", "statics", "dense", "shift-invert", "arpack"], |name| match name {
        "dense" => Solver::Dense,
        "shift-invert" => Solver::ShiftInvert,
        "arpack" => Solver::Arpack,
        _ => Solver::Statics,
    })
}

/// `--units` on the command line.
pub fn unit_system() -> impl TypedValueParser<Value = Units> {
    choice(&["si", "us", "both"], |name| match name {
        "si" => Units::Si,
        "us" => Units::Us,
        _ => Units::Both,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_implausible_bare_number_is_refused_with_both_readings() {
        for (of, text, [trade, si]) in [
            (PLAY_SPEED, "90", ["90 mph", "90 m/s"]),
            (PLACE, "28", ["28 in", "28 m"]),
            (PLACE, "70", ["70 cm", "70 m"]),
            (PLACE, "33,5", ["33,5 in", "33,5 m"]),
            (PIVOT, "-2.5", ["-2.5 in", "-2.5 m"]),
            (PART_MASS, "50", ["50 oz", "50 kg"]),
            (SWING, "2500", ["2500 deg/s", "2500 rad/s"]),
            (STIFFNESS, "7000", ["7000 lbf/in", "7000 N/m"]),
            (SWING_WEIGHT, "10000", ["10000 oz in^2", "10000 kg m^2"]),
            (CONTACT_TIME, "0.75", ["0.75 ms", "0.75 s"]),
            (TOP_FREQUENCY, "2", ["2 kHz", "2 Hz"]),
        ] {
            let said = of.read(text).unwrap_err();
            let written = [trade, si].iter().all(|one| said.contains(&format!("\"{one}\"")));
            assert!(written && said.contains(&format!("{trade} or {si}?")), "{said}");
            assert!(of.read(trade).is_ok() && of.read(si).is_ok(), "{text}");
        }
    }

    #[test]
    fn a_plausible_bare_number_and_one_that_no_unit_helps_are_in_si() {
        for (of, text, value) in [
            (PLAY_SPEED, "40", 40.0),
            (PLAY_SPEED, "0", 0.0),
            (PLAY_SPEED, "1e300", 1e300),
            (PLACE, "0.7", 0.7),
            (PIVOT, "-0.09", -0.09),
            (STIFFNESS, "0", 0.0),
            (IMPULSE, "1e300", 1e300),
        ] {
            assert_eq!(of.read(text), Ok(value), "{text}");
        }
    }

    #[test]
    fn the_speed_of_a_barrel_for_a_swing_is_answered_with_its_own_option() {
        for text in ["70", "70 mph"] {
            let said = swing_speed(text).unwrap_err();
            assert!(said.contains("--bat-speed \"70 mph\""), "{said}");
        }
        assert_eq!(swing_speed("0 rad/s"), Ok(0.0));
        assert_eq!(swing_speed("43"), Ok(43.0));
        assert!(swing_speed("43 lb").unwrap_err().contains("an angular speed"));
    }
}
