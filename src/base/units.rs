//! What is a number with a unit in SI?
//!
//! [`parse`] for a string that must carry its unit, [`parse_or_si`] for one that may be bare.
//!
//! A bare number is SI. A string carries its unit: `"33 in"`, `"2.02e6 psi"`,
//! `"0.0257 lb/in^3"`. A unit is a product of symbols with integer powers
//! (`kg/m^3`, `oz in^2`, `N·s`, `m/s`); a division covers the one symbol after it.
//!
//! Values may be written as people type them: read off an inch rule (`2 5/8 in`, `33-1/2"`, `33½″`),
//! as a sum of two units (`5' 2"`, `1 lb 14 1/2 oz`), with a decimal comma (`33,5 in`) or with
//! thousands apart (`13,600.5 oz in^2`). `1,234` may be either and is refused with both readings.
//!
//! `oz` and `lb` are masses; forces are `lbf`, `ozf`, `N`. Confusing them is the commonest silent error in this field
//! (a factor √g in every frequency), so it is reported, not guessed.
//!
//! # Source
//!
//! The inch, foot, mile, pound and standard gravity are exact by definition (yard and pound
//! agreement of 1959; third CGPM 1901): in = 0.0254 m, lb = 0.453 592 37 kg,
//! g₀ = 9.806 65 m/s². All other factors follow from these.

use crate::base::error::{Complaint, nearest};
use crate::base::typed::{mixed, number, plain, readings, split, terms};

/// An inch (m).
pub const INCH: f64 = 0.0254;
const FOOT: f64 = 0.3048;
const MILE: f64 = 1609.344;
const POUND: f64 = 0.453_592_37;
const OUNCE: f64 = POUND / 16.0;
/// 0.453 592 37 kg × 9.806 65 m/s², exactly.
pub const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// A foot times a pound-force (J), exactly.
pub const FOOT_POUND: f64 = FOOT * POUND_FORCE;
/// One pound-force per foot per second squared.
const SLUG: f64 = POUND_FORCE / FOOT;
/// Pound-force per square inch, rounded once from the exact quotient.
pub const PSI: f64 = 6_894.757_293_168_361;

/// Powers of length, mass, time and angle.
type Dimension = [i8; 4];

/// Quantities: the name in words, the dimension, the SI unit, and an example in the units of the trade.
macro_rules! quantities {
    ($($(#[$said:meta])* $quantity:ident: $name:literal, $dimension:expr, $si:literal, $example:literal;)*) => {
        /// A physical quantity: name, dimension, SI unit and an example.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Quantity {
            $($(#[$said])* $quantity,)*
        }

        impl Quantity {
            /// All quantities, for tables and tests.
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$quantity),*];

            /// Name, dimension, SI unit, and an example in the units of the trade.
            fn facts(self) -> (&'static str, Dimension, &'static str, &'static str) {
                match self {
                    $(Self::$quantity => ($name, $dimension, $si, $example),)*
                }
            }
        }
    };
}

quantities! {
    /// A length, in m.
    Length: "a length", [1, 0, 0, 0], "m", "33 in";
    /// A mass, in kg.
    Mass: "a mass", [0, 1, 0, 0], "kg", "31 oz";
    /// A density, in kg/m³.
    Density: "a density", [-3, 1, 0, 0], "kg/m^3", "0.0257 lb/in^3";
    /// A pressure, a stress or a modulus, in Pa.
    Pressure: "a pressure", [-1, 1, -2, 0], "Pa", "18.1 GPa";
    /// A speed, in m/s.
    Speed: "a speed", [1, 0, -1, 0], "m/s", "90 mph";
    /// An angular speed, in rad/s.
    AngularSpeed: "an angular speed", [0, 0, -1, 1], "rad/s", "50 rad/s";
    /// An angle, in rad.
    Angle: "an angle", [0, 0, 0, 1], "rad", "10 deg";
    /// A time, in s.
    Time: "a time", [0, 0, 1, 0], "s", "0.75 ms";
    /// A frequency, in Hz.
    Frequency: "a frequency", [0, 0, -1, 0], "Hz", "170 Hz";
    /// A force, in N.
    Force: "a force", [1, 1, -2, 0], "N", "20 lbf";
    /// A stiffness, in N/m.
    Stiffness: "a stiffness", [0, 1, -2, 0], "N/m", "1000 N/m";
    /// A stiffness against rotation, in N m/rad.
    RotationalStiffness: "a rotational stiffness", [2, 1, -2, -1], "N m/rad", "500 N m/rad";
    /// A stiffness per length of bat, in N/m².
    BedStiffness: "a stiffness per length", [-1, 1, -2, 0], "N/m^2", "4e5 N/m^2";
    /// A damping constant, in N s/m.
    Damping: "a damping", [0, 1, -1, 0], "N s/m", "5 N s/m";
    /// A damping constant per length of bat, in N s/m².
    BedDamping: "a damping per length", [-1, 1, -1, 0], "N s/m^2", "200 N s/m^2";
    /// A moment of inertia, in kg m².
    Inertia: "a moment of inertia", [2, 1, 0, 0], "kg m^2", "10425 oz in^2";
    /// An impulse, in N s.
    Impulse: "an impulse", [1, 1, -1, 0], "N s", "12 N s";
}

impl Quantity {
    /// Whether a unit of that dimension measures this quantity. A stiffness against rotation may leave out its radian:
    /// `N m`.
    fn has(self, dimension: Dimension) -> bool {
        let [length, mass, time, angle] = self.facts().1;
        let without = self == Self::RotationalStiffness && dimension == [length, mass, time, 0];
        dimension == [length, mass, time, angle] || without
    }

    /// The SI unit of this quantity, and the factor to it, 1.
    pub fn si(self) -> (&'static str, f64) {
        (self.facts().2, 1.0)
    }

    /// The SI unit as a person writes it: "kg m²".
    pub fn unit(self) -> String {
        self.facts().2.replace("^2", "²").replace("^3", "³")
    }

    /// The quantity in words, with its article: "a length".
    pub fn name(self) -> &'static str {
        self.facts().0
    }

    /// A value of this quantity in units of the trade.
    pub fn example(self) -> &'static str {
        self.facts().3
    }

    /// An example of this quantity, for error messages.
    pub fn expected(self) -> String {
        self.expected_in(self.facts().2)
    }

    /// An example of this quantity where numbers without a unit are in `unit`, for error messages.
    pub fn expected_in(self, unit: &str) -> String {
        let (name, _, _, example) = self.facts();
        let bare = if unit == "in" { "inches" } else { unit };
        format!("{name} such as \"{example}\" or a number in {bare}")
    }

    /// The symbols that measure this quantity by themselves.
    fn units(self) -> String {
        let (name, dimension, si, _) = self.facts();
        let others = SYMBOLS.iter().filter(|symbol| symbol.2 == dimension && symbol.0 != si);
        let others: Vec<&str> = others.map(|symbol| symbol.0).collect();
        match others[..] {
            [] => String::new(),
            [ref most @ .., last] => {
                let most: Vec<&str> = [si].iter().chain(most).copied().collect();
                format!("{name} is in {} or {last}", most.join(", "))
            }
        }
    }
}

/// Symbols with their factor to SI and their dimension; the first of a family is its short form.
const SYMBOLS: &[(&str, f64, Dimension)] = &[
    ("m", 1.0, [1, 0, 0, 0]),
    ("km", 1e3, [1, 0, 0, 0]),
    ("cm", 1e-2, [1, 0, 0, 0]),
    ("mm", 1e-3, [1, 0, 0, 0]),
    ("um", 1e-6, [1, 0, 0, 0]),
    ("in", INCH, [1, 0, 0, 0]),
    ("inch", INCH, [1, 0, 0, 0]),
    ("inches", INCH, [1, 0, 0, 0]),
    ("ft", FOOT, [1, 0, 0, 0]),
    ("foot", FOOT, [1, 0, 0, 0]),
    ("feet", FOOT, [1, 0, 0, 0]),
    ("kg", 1.0, [0, 1, 0, 0]),
    ("g", 1e-3, [0, 1, 0, 0]),
    ("oz", OUNCE, [0, 1, 0, 0]),
    ("lb", POUND, [0, 1, 0, 0]),
    ("lbm", POUND, [0, 1, 0, 0]),
    ("slug", SLUG, [0, 1, 0, 0]),
    ("lbs", POUND, [0, 1, 0, 0]),
    ("ounces", OUNCE, [0, 1, 0, 0]),
    ("s", 1.0, [0, 0, 1, 0]),
    ("ms", 1e-3, [0, 0, 1, 0]),
    ("us", 1e-6, [0, 0, 1, 0]),
    ("min", 60.0, [0, 0, 1, 0]),
    ("h", 3600.0, [0, 0, 1, 0]),
    ("rad", 1.0, [0, 0, 0, 1]),
    ("deg", std::f64::consts::PI / 180.0, [0, 0, 0, 1]),
    ("rev", std::f64::consts::TAU, [0, 0, 0, 1]),
    ("rpm", std::f64::consts::TAU / 60.0, [0, 0, -1, 1]),
    ("Hz", 1.0, [0, 0, -1, 0]),
    ("kHz", 1e3, [0, 0, -1, 0]),
    ("N", 1.0, [1, 1, -2, 0]),
    ("kN", 1e3, [1, 1, -2, 0]),
    ("lbf", POUND_FORCE, [1, 1, -2, 0]),
    ("ozf", POUND_FORCE / 16.0, [1, 1, -2, 0]),
    ("kgf", 9.806_65, [1, 1, -2, 0]),
    ("Pa", 1.0, [-1, 1, -2, 0]),
    ("kPa", 1e3, [-1, 1, -2, 0]),
    ("MPa", 1e6, [-1, 1, -2, 0]),
    ("GPa", 1e9, [-1, 1, -2, 0]),
    ("psi", PSI, [-1, 1, -2, 0]),
    ("ksi", 1e3 * PSI, [-1, 1, -2, 0]),
    ("mph", MILE / 3600.0, [1, 0, -1, 0]),
    ("kph", 1.0 / 3.6, [1, 0, -1, 0]),
    ("fps", FOOT, [1, 0, -1, 0]),
];

/// The value of `text`, such as `"33 in"`, in SI. The text must carry its unit.
///
/// # Errors
///
/// What was found and what was expected, with an empty field name for the caller to fill in.
pub fn parse(text: &str, quantity: Quantity) -> Result<f64, Complaint> {
    parse_beside(text, quantity, quantity.facts().2)
}

/// The value of a text with its unit, in SI. Numbers without a unit beside this text are in the unit `bare`, which a
/// complaint names.
///
/// # Errors
///
/// As [`parse`].
pub fn parse_beside(text: &str, quantity: Quantity, bare: &str) -> Result<f64, Complaint> {
    let (text, plain) = (text.trim(), plain(text));
    let wrong = |found: String| Complaint::new("", found, quantity.expected_in(bare));
    let terms = terms(&plain);
    let mut values = Vec::with_capacity(terms.len());
    for (number, unit) in &terms {
        if let Some([decimal, thousand]) = readings(number) {
            let hint = format!("it may be {decimal} or {thousand}: write it without the comma");
            return Err(wrong(format!("\"{text}\"")).hinted(hint));
        }
        let value = mixed(number).ok_or_else(|| wrong(format!("\"{text}\"")))?;
        if unit.starts_with(|c: char| c.is_ascii_digit()) {
            return Err(wrong(format!("\"{text}\"")));
        }
        if unit.is_empty() && value.is_finite() {
            let hint = with_unit(number, quantity, bare);
            return Err(wrong(format!("\"{text}\" without a unit")).hinted(hint));
        }
        let of_unit = if unit.is_empty() { Ok(1.0) } else { factor(unit, quantity) };
        let expected = quantity.expected_in(bare);
        values.push((value, of_unit.map_err(|complaint| Complaint { expected, ..complaint })?));
    }
    let value = summed(&values).ok_or_else(|| {
        let expected = "two units together as in \"5 ft 2 in\" or \"1 lb 14 1/2 oz\"";
        Complaint::new("", format!("\"{text}\""), expected)
    })?;
    if value.is_finite() {
        // Turns −0 into 0.
        Ok(value + 0.0)
    } else {
        Err(wrong(format!("\"{text}\", which is beyond the range of numbers")))
    }
}

/// The sum of values with their units' factors, or `None`. The values are whole numbers from large units to small ones,
/// each less than one of the unit before it; only the last may have a fraction.
fn summed(values: &[(f64, f64)]) -> Option<f64> {
    let falls = |pair: &[(f64, f64)]| {
        let [(whole, large), (value, small)] = [pair[0], pair[1]];
        whole.fract() == 0.0 && whole >= 0.0 && value >= 0.0 && value * small < large
    };
    let sum = || values.iter().map(|(value, factor)| value * factor).sum();
    values.windows(2).all(falls).then(sum)
}

/// A suggestion of the unit for a number that has none.
fn with_unit(number: &str, quantity: Quantity, bare: &str) -> String {
    let usual = split(quantity.example()).1;
    match number.parse::<f64>() {
        Ok(_) if usual == bare => format!("write \"{number} {bare}\", or {number} without quotes"),
        Ok(_) => format!(
            "write \"{number} {usual}\" or \"{number} {bare}\"; {number} without quotes is in {bare}"
        ),
        Err(_) => format!("write \"{number} {usual}\""),
    }
}

/// As [`parse`], but a bare number is SI: on the command line every value is text.
///
/// # Errors
///
/// As [`parse`].
pub fn parse_or_si(text: &str, quantity: Quantity) -> Result<f64, Complaint> {
    number(text).map_or_else(|| parse(text, quantity), Ok)
}

/// The factor of a single unit, such as `"in"` or `"lb/in^3"`, to SI.
///
/// # Errors
///
/// As [`parse`].
pub fn factor(unit: &str, quantity: Quantity) -> Result<f64, Complaint> {
    let expected =
        || format!("a unit of {}, such as \"{}\"", quantity.name(), split(quantity.example()).1);
    let (factor, dimension) = product(unit).map_err(|(found, hint)| {
        let hint = if hint.is_empty() { quantity.units() } else { hint };
        Complaint::new("", found, expected()).hinted(hint)
    })?;
    if quantity.has(dimension) {
        return Ok(factor);
    }
    let is = Quantity::ALL.iter().find(|q| q.facts().1 == dimension);
    let found = match is {
        Some(q) => format!("unit \"{unit}\", which measures {}", q.name()),
        None => format!("unit \"{unit}\", which does not measure {}", quantity.name()),
    };
    let hint = match advice(quantity, is, unit) {
        "" => quantity.units(),
        advice => advice.to_owned(),
    };
    Err(Complaint::new("", found, expected()).hinted(hint))
}

/// Advice on a force given for a mass, or a mass for a force.
fn advice(wanted: Quantity, found: Option<&Quantity>, unit: &str) -> &'static str {
    let per_area = unit.contains("lb/in^2") || unit.contains("lb/in2");
    let of_mass = unit.contains("lb") && !unit.contains("lbf");
    match (wanted, found) {
        (Quantity::Mass, Some(Quantity::Force)) => {
            "mass is mass here: a bat that a scale shows as 2 lbf has a mass of 2 lb"
        }
        (Quantity::Force, Some(Quantity::Mass)) => "oz and lb are masses here: write ozf or lbf",
        (Quantity::Density, _) if unit.contains("lbf") => "lb is the mass, lbf the force",
        (Quantity::Pressure, _) if per_area => "lb is a mass here: write psi",
        (
            Quantity::Stiffness
            | Quantity::RotationalStiffness
            | Quantity::BedStiffness
            | Quantity::Damping
            | Quantity::BedDamping,
            _,
        ) if of_mass => "lb is a mass here: write lbf",
        _ => "",
    }
}

/// The unrecognised unit and a suggested one.
type Unknown = (String, String);

/// The factor and the dimension of a product of powers of symbols.
fn product(unit: &str) -> Result<(f64, Dimension), Unknown> {
    let unit = unit.replace('²', "^2").replace('³', "^3").replace('µ', "u");
    let (mut total, mut dimension): (f64, Dimension) = (1.0, [0; 4]);
    let mut sign = 1;
    for part in unit.split_inclusive(['*', '·', ' ', '/']) {
        let symbol = part.trim_end_matches(['*', '·', ' ', '/']);
        if !symbol.is_empty() {
            let (base, power) = power(symbol)?;
            let (_, factor, dims) =
                SYMBOLS.iter().find(|(name, ..)| *name == base).ok_or_else(|| unknown(base))?;
            total *= factor.powi(sign * i32::from(power));
            for (sum, d) in dimension.iter_mut().zip(dims) {
                *sum = sum.saturating_add((sign as i8 * power).saturating_mul(*d));
            }
            sign = 1;
        }
        if part.ends_with('/') {
            sign = -1;
        }
    }
    Ok((total, dimension))
}

/// `in^3` and `in3` as symbol and power.
fn power(symbol: &str) -> Result<(&str, i8), Unknown> {
    let base = symbol.trim_end_matches(|c: char| c.is_ascii_digit());
    let exponent = &symbol[base.len()..];
    if exponent.is_empty() {
        return Ok((symbol, 1));
    }
    match exponent.parse() {
        Ok(power @ 1..=9) => Ok((base.strip_suffix('^').unwrap_or(base), power)),
        _ => Err((format!("unit \"{symbol}\""), String::new())),
    }
}

fn unknown(symbol: &str) -> Unknown {
    let names: Vec<&str> = SYMBOLS.iter().map(|s| s.0).collect();
    let hint = nearest(symbol, &names).map(|name| format!("did you mean {name}?"));
    (format!("unknown unit \"{symbol}\""), hint.unwrap_or_default())
}

/// kg m² to ounces (mass) times square inches, the unit of swing weight.
pub fn ounce_square_inches(inertia: f64) -> f64 {
    inertia / (OUNCE * INCH * INCH)
}

/// Metres to inches.
pub fn inches(length: f64) -> f64 {
    length / INCH
}

/// A length as messages show it, in metres and in inches.
pub fn shown_length(length: f64) -> String {
    let rounded = |text: String| text.parse().unwrap_or(f64::NAN);
    let meters: f64 = rounded(format!("{length:.11e}"));
    let inches: f64 = rounded(format!("{:.5e}", inches(length)));
    format!("{meters:?} m ({inches:?} in)")
}

/// Kilograms to avoirdupois ounces.
pub fn ounces(mass: f64) -> f64 {
    mass / OUNCE
}

/// Metres per second to miles per hour.
pub fn miles_per_hour(speed: f64) -> f64 {
    speed / (MILE / 3600.0)
}

/// An acceleration (m/s²) in standard gravities, of 9.80665 m/s² each.
pub fn gravities(acceleration: f64) -> f64 {
    acceleration / 9.806_65
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn si(text: &str, quantity: Quantity) -> f64 {
        parse(text, quantity).unwrap()
    }

    /// Whether two numbers agree to a few roundings.
    fn same(a: f64, b: f64) -> bool {
        (a - b).abs() <= 4.0 * f64::EPSILON * b.abs()
    }

    #[test]
    fn fractions_of_an_inch_rule_are_exact_and_others_are_refused() {
        for (text, inches) in [("2 5/8 in", 2.625), ("5/8in", 0.625), ("33  1/2 in", 33.5)] {
            assert!(same(si(text, Quantity::Length), INCH * inches), "{text}");
        }
        assert!(same(si("31 1/2 oz", Quantity::Mass), 31.5 * OUNCE));
        for text in [
            "2.5 5/8 in",
            "-2 1/8 in",
            "2 5 /8 in",
            "2 5/ in",
            "5/0 in",
            "2 58 in",
            "/8 in",
            "-2-1/8 in",
        ] {
            assert!(parse(text, Quantity::Length).is_err(), "{text}");
        }
        // `5/s` divides by a unit: it is not a fraction of numbers.
        assert!(
            same(si("5/s", Quantity::Frequency), 5.0) || parse("5/s", Quantity::Speed).is_err()
        );
    }

    #[test]
    fn values_are_read_as_people_type_them() {
        for (text, inches) in [
            ("33 1/2\"", 33.5),
            ("33-1/2 in", 33.5),
            ("33½″", 33.5),
            ("28\u{201d}", 28.0),
            ("28''", 28.0),
            ("5' 2\"", 62.0),
            ("5\u{2019}2 1/2\u{201d}", 62.5),
            ("2′ 9″", 33.0),
            ("2 ft 9-1/2 in", 33.5),
            ("33,5 in", 33.5),
            ("0,125 in", 0.125),
            ("1,234.5 in", 1234.5),
            ("1,234,567 in", 1_234_567.0),
            ("\u{2212}3.5 in", -3.5),
        ] {
            assert!(same(si(text, Quantity::Length), INCH * inches), "{text}");
        }
        assert!(same(si("1 lb 14 1/2 oz", Quantity::Mass), 30.5 * OUNCE));
        assert!(same(si("2 lbs 1,5 oz", Quantity::Mass), 33.5 * OUNCE));
        assert!(same(si("10,425.5 oz in2", Quantity::Inertia), 10_425.5 * OUNCE * INCH * INCH));
        assert_eq!(parse_or_si("33,5", Quantity::Length), Ok(33.5));
    }

    #[test]
    fn what_may_be_read_in_two_ways_is_refused_with_both() {
        for text in ["1,234 in", "12,345 in", "1,234"] {
            let said = parse_or_si(text, Quantity::Length).unwrap_err().to_string();
            let [decimal, thousand] =
                [".", ""].map(|comma| text.replace(" in", "").replace(',', comma));
            assert!(said.contains(&format!("{decimal} or {thousand}")), "{said}");
        }
        for text in [
            "2 in 5 ft",
            "1 lb 20 oz",
            "1.5 ft 2 in",
            "-5 ft 2 in",
            "5 ft -2 in",
            "12,34,5 in",
            "1 kg 2",
        ] {
            assert!(
                parse(text, if text.contains("in") { Quantity::Length } else { Quantity::Mass })
                    .is_err(),
                "{text}"
            );
        }
    }

    #[test]
    fn the_units_of_the_trade_have_their_exact_values() {
        use Quantity::*;
        for (text, quantity, expected) in [
            ("33 in", Length, 0.8382),
            ("2 ft", Length, 0.6096),
            ("84 cm", Length, 0.84),
            ("31 oz", Mass, 31.0 * 0.028_349_523_125),
            ("2 lb", Mass, 0.907_184_74),
            ("1 slug", Mass, 14.593_902_937_206_364),
            ("0.0257 lb/in^3", Density, 711.373_551_052_220_2),
            ("0.0257 lb/in3", Density, 711.373_551_052_220_2),
            ("0.6 g/cm^3", Density, 600.0),
            ("2.02e6 psi", Pressure, 13_927_409_732.200_09),
            ("2020 ksi", Pressure, 13_927_409_732.200_09),
            ("18.1 GPa", Pressure, 18.1e9),
            ("1 lbf/in^2", Pressure, PSI),
            ("90 mph", Speed, 40.2336),
            ("100 ft/s", Speed, 30.48),
            ("36 km/h", Speed, 10.0),
            ("60 rpm", AngularSpeed, std::f64::consts::TAU),
            ("180 deg", Angle, std::f64::consts::PI),
            ("0.75 ms", Time, 0.75e-3),
            ("1 lbf", Force, 4.448_221_615_260_5),
            ("1 lbf/in", Stiffness, 4.448_221_615_260_5 / 0.0254),
            ("500 N m/rad", RotationalStiffness, 500.0),
            ("500 N·m/rad", RotationalStiffness, 500.0),
            ("500 N m", RotationalStiffness, 500.0),
            ("0.5 kN m / rad", RotationalStiffness, 500.0),
            ("1 ft lbf/rad", RotationalStiffness, 0.3048 * 4.448_221_615_260_5),
            ("1 lbf ft", RotationalStiffness, 0.3048 * 4.448_221_615_260_5),
            (
                "1 in lbf/deg",
                RotationalStiffness,
                0.0254 * 4.448_221_615_260_5 * 180.0 / std::f64::consts::PI,
            ),
            ("4e5 N/m^2", BedStiffness, 4e5),
            ("0.4 N/mm²", BedStiffness, 4e5),
            ("1 psi", BedStiffness, PSI),
            ("1 lbf/in/in", BedStiffness, PSI),
            ("5 N s/m", Damping, 5.0),
            ("1 lbf s/in", Damping, 4.448_221_615_260_5 / 0.0254),
            ("200 N s/m^2", BedDamping, 200.0),
            ("1 kPa s", BedDamping, 1000.0),
            ("1 oz in^2", Inertia, 0.028_349_523_125 * 0.0254 * 0.0254),
            ("1 oz·in²", Inertia, 0.028_349_523_125 * 0.0254 * 0.0254),
            ("2 N s", Impulse, 2.0),
            ("2 kg m/s", Impulse, 2.0),
            ("-0.09 m", Length, -0.09),
        ] {
            assert!(same(si(text, quantity), expected), "{text}: {:e}", si(text, quantity));
        }
    }

    #[test]
    fn a_force_where_a_mass_is_meant_is_explained() {
        let said = parse("31 lbf", Quantity::Mass).unwrap_err().to_string();
        assert!(said.contains("measures a force") && said.contains("mass is mass"), "{said}");
        let said = parse("5 N", Quantity::Mass).unwrap_err().to_string();
        assert!(said.contains("measures a force"), "{said}");
        let said = parse("2e6 lb/in^2", Quantity::Pressure).unwrap_err().to_string();
        assert!(said.contains("write psi"), "{said}");
        let said = parse("0.0257 lbf/in^3", Quantity::Density).unwrap_err().to_string();
        assert!(said.contains("lb is the mass"), "{said}");
    }

    #[test]
    fn a_mass_or_an_angle_in_a_stiffness_is_explained() {
        let said = parse("10 lb/in", Quantity::Stiffness).unwrap_err().to_string();
        assert!(said.contains("does not measure a stiffness") && said.contains("lbf"), "{said}");
        let said = parse("10 ft lb/rad", Quantity::RotationalStiffness).unwrap_err().to_string();
        assert!(said.contains("write lbf"), "{said}");
        let said = parse("10 N/m", Quantity::RotationalStiffness).unwrap_err().to_string();
        assert!(said.contains("measures a stiffness,"), "{said}");
        // Only a stiffness against rotation may leave the angle out.
        assert!(parse("10 N/rad", Quantity::Stiffness).is_err());
        assert!(parse("10 N m rad", Quantity::RotationalStiffness).is_err());
        assert!(parse("10 1/s", Quantity::AngularSpeed).is_err());
    }

    #[test]
    fn an_unknown_unit_names_its_neighbour() {
        let said = parse("33 inc", Quantity::Length).unwrap_err().to_string();
        assert!(said.contains("did you mean in"), "{said}");
        assert!(parse("33", Quantity::Length).unwrap_err().to_string().contains("without a unit"));
        assert_eq!(parse_or_si(" 33 ", Quantity::Length), Ok(33.0));
        assert_eq!(parse_or_si("33 m", Quantity::Length), Ok(33.0));
        assert!(parse_or_si("inf", Quantity::Length).is_err());
        assert!(parse("33 in^0", Quantity::Length).is_err());
        assert!(parse("in", Quantity::Length).is_err());
        assert!(parse("", Quantity::Length).is_err());
        assert!(parse("1e999 m", Quantity::Length).is_err());
        assert!(parse("nan", Quantity::Length).is_err());
        assert!(parse("inf m", Quantity::Length).is_err());
        assert!(parse(&format!("1 {}", "m^9 ".repeat(100)), Quantity::Length).is_err());
        assert!(parse(&"1 in ".repeat(100_000), Quantity::Length).is_err());
    }

    proptest! {
        /// Writing a value in any unit of its kind and reading it back returns it.
        #[test]
        fn a_value_survives_any_unit_of_its_kind(exponent in -12.0..12.0f64, pick in 0usize..1000) {
            let (name, factor, dimension) = SYMBOLS[pick % SYMBOLS.len()];
            let quantity = Quantity::ALL.into_iter().find(|q| q.facts().1 == dimension).unwrap();
            let value = 10f64.powf(exponent);
            let text = format!("{:e} {name}", value / factor);
            prop_assert!(same(si(&text, quantity), value), "{}", text);
            prop_assert!(same(si(&text.replace(' ', ""), quantity), value), "{}", text);
        }

        /// A quotient of units is the quotient of their factors.
        #[test]
        fn compound_units_multiply(a in 0usize..11, b in 11usize..17, power in 1i8..4) {
            let ((length, l, _), (mass, m, _)) = (SYMBOLS[a], SYMBOLS[b]);
            let (factor, dimension) = product(&format!("{mass}/{length}^{power}")).unwrap();
            prop_assert!(same(factor, m / l.powi(power.into())));
            prop_assert_eq!(dimension, [-power, 1, 0, 0]);
        }

        /// No text makes the parser panic or return something that is not a finite number.
        #[test]
        fn any_text_is_a_finite_number_or_an_error(text in "\\PC{0,12}") {
            for quantity in Quantity::ALL {
                if let Ok(value) = parse(&text, quantity) {
                    prop_assert!(value.is_finite());
                }
            }
        }
    }
}
