//! What is a member of a fixture, and is its value possible?

use crate::base::{Error, Mistakes, Quantity, Result, shown_length, significant};
use crate::bat::fixtures::Held;
use crate::bat::layup::Layer;
use crate::bat::material::{Material, PoissonRatios, ShearModuli};
use crate::bat::profile::SAME_PLACE;

/// Products of larger values would overflow.
pub(crate) const MOST: f64 = 1e100;
/// A softer spring (N/m or N m/rad) holds nothing.
pub(crate) const SOFTEST: f64 = 1e-12;
/// A larger mass (kg) or inertia (kg m²) would act as a support.
pub(crate) const HEAVIEST: f64 = 1e8;

/// A member of a fixture: its key in a bat file, its kind and where it is kept.
pub struct Field<P> {
    pub key: &'static str,
    pub kind: MemberKind,
    /// The expected text if it is missing; `None` if it is optional.
    pub needed: Option<&'static str>,
    /// Another key that is required with it, and the expected text for that.
    pub with: Option<(&'static str, &'static str)>,
    /// An example in units of the trade, if that of the quantity is of another size.
    pub example: Option<&'static str>,
    pub of: fn(&mut P) -> Slot<'_>,
}

/// Kind of a member.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MemberKind {
    /// A number of a quantity, or a pure number, with its range.
    Number(Option<Quantity>, Range),
    /// What a support holds.
    Held,
    /// A material by its name or its numbers.
    Material,
    /// Shear moduli of a composite.
    ShearModuli,
    /// Poisson's ratios of a composite.
    PoissonRatios,
    /// Layers of a wall, from the inside out.
    Layers,
}

/// Storage of a member by the type of its value.
macro_rules! slots {
    ($($(#[$said:meta])* $slot:ident: $kept:ty,)*) => {
        /// Where the value of a member is kept.
        pub enum Slot<'a> {
            $($(#[$said])* $slot(&'a mut $kept),)*
        }

        $(impl<'a> From<&'a mut $kept> for Slot<'a> {
            fn from(value: &'a mut $kept) -> Self {
                Self::$slot(value)
            }
        })*
    };
}

slots! {
    /// A number that is always there.
    Number: f64,
    /// A number that may be unknown.
    Unknown: Option<f64>,
    /// What a support holds.
    Held: Held,
    /// A material that is always there.
    Material: Material,
    /// A material that may be missing.
    Core: Option<Material>,
    /// Shear moduli that may be missing.
    ShearModuli: Option<ShearModuli>,
    /// Poisson's ratios that may be missing.
    PoissonRatios: Option<PoissonRatios>,
    /// Layers of a wall.
    Layers: Vec<Layer>,
}

/// How large a number may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    /// A place on the bat, its ends included.
    OnBat,
    /// A place inside the bat.
    Inside,
    /// A distance of at most ten lengths of the bat.
    Distance,
    /// A mass that does not act as a support: at most `HEAVIEST`.
    Mass,
    /// Such a mass, above 0.
    SomeMass,
    /// 0, or a stiffness that holds the bat measurably: at least `SOFTEST`.
    Spring,
    /// Such a stiffness, above 0.
    SomeSpring,
    /// 0 or more.
    NotNegative,
    /// Above 0.
    Positive,
    /// Between two bounds, with the expected range in words.
    Between(Bound, Bound, &'static str),
}

/// An end of a range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bound {
    /// The end belongs to the range.
    At(f64),
    /// The end is excluded.
    Beyond(f64),
}

/// The expected text if a place is missing.
pub(crate) const PLACE: &str = "a place on the bat, from the knob end";

impl<P> Field<P> {
    pub const fn of_kind(key: &'static str, kind: MemberKind, of: fn(&mut P) -> Slot<'_>) -> Self {
        Self { key, kind, needed: None, with: None, example: None, of }
    }

    pub const fn like(self, example: &'static str) -> Self {
        Self { example: Some(example), ..self }
    }

    pub const fn needed(self, expected: &'static str) -> Self {
        Self { needed: Some(expected), ..self }
    }

    pub const fn with(self, other: &'static str, expected: &'static str) -> Self {
        Self { with: Some((other, expected)), ..self }
    }

    /// Whether it is a place on the bat.
    pub fn is_place(&self) -> bool {
        matches!(self.kind, MemberKind::Number(_, Range::OnBat | Range::Inside))
    }

    /// Checks that the value is possible on a bat of that length (m); `field` is its path in a bat file.
    fn check(&self, field: String, part: &mut P, length: f64) -> Result<()> {
        match (self.kind, (self.of)(part)) {
            (MemberKind::Number(quantity, range), Slot::Number(value)) => {
                range.check(field, *value, quantity, length)
            }
            (MemberKind::Number(quantity, range), Slot::Unknown(Some(value))) => {
                range.check(field, *value, quantity, length)
            }
            (_, Slot::Material(material) | Slot::Core(Some(material))) => {
                Part::check(material, &field, length)
            }
            (_, Slot::ShearModuli(Some(moduli))) => Part::check(moduli, &field, length),
            (_, Slot::PoissonRatios(Some(ratios))) => Part::check(ratios, &field, length),
            (_, Slot::Layers(layers)) => {
                let mut each = layers.iter_mut().enumerate();
                each.try_for_each(|(k, layer)| Part::check(layer, &format!("{field}[{k}]"), length))
            }
            _ => Ok(()),
        }
    }
}

impl Range {
    fn check(
        self,
        field: String,
        value: f64,
        quantity: Option<Quantity>,
        length: f64,
    ) -> Result<()> {
        let unit = quantity.map(Quantity::unit).unwrap_or_default();
        let same = SAME_PLACE * length;
        let (possible, expected) = match self {
            Self::OnBat => return on_the_bat(field, value, length),
            Self::Inside => (
                value > same && value < length - same,
                format!("a place inside the bat, 0 to {}", shown_length(length)),
            ),
            Self::Distance => (
                value.abs() <= 10.0 * length,
                "a distance of at most ten lengths of the bat".to_owned(),
            ),
            Self::Between(low, high, expected) => {
                (low.is_below(value) && high.is_above(value), expected.to_owned())
            }
            Self::Positive | Self::SomeMass | Self::SomeSpring
                if !(value > 0.0 && value < MOST) =>
            {
                (false, format!("a number above 0, below {MOST:e}"))
            }
            _ if !(0.0..MOST).contains(&value) => (false, format!("0 or more, below {MOST:e}")),
            Self::Mass | Self::SomeMass => {
                (value <= HEAVIEST, format!("{HEAVIEST:e} {unit} at most: more is a support"))
            }
            Self::Spring | Self::SomeSpring => (
                value == 0.0 || value >= SOFTEST,
                format!("0, or {SOFTEST:e} {unit} and more: a softer spring holds nothing"),
            ),
            Self::NotNegative | Self::Positive => return Ok(()),
        };
        if possible { Ok(()) } else { Err(Error::value(field, shown(value, &unit), expected)) }
    }
}

impl Bound {
    fn is_below(self, value: f64) -> bool {
        match self {
            Self::At(end) => end <= value,
            Self::Beyond(end) => end < value,
        }
    }

    fn is_above(self, value: f64) -> bool {
        match self {
            Self::At(end) => value <= end,
            Self::Beyond(end) => value < end,
        }
    }
}

/// A value above 0 that a bat file may give in place of a number.
pub struct Instead<P> {
    pub key: &'static str,
    pub quantity: Quantity,
    /// Its meaning, for the schema.
    pub said: &'static str,
    /// The number that it replaces.
    pub of: &'static str,
    /// The expected text if both are missing.
    pub expected: &'static str,
    pub set: fn(&mut P, f64),
}

/// A part that is a list of numbers: reading, checking and the schema follow from it.
pub trait Part: Clone + 'static {
    /// Its members.
    const FIELDS: &'static [Field<Self>];
    /// Keys of which at least one is required.
    const SOME: &'static [&'static str] = &[];
    /// A replacement for one of the numbers; one of the two is then required.
    const INSTEAD: Option<Instead<Self>> = None;

    /// Both ends (m), if the part lies on a stretch.
    fn stretch(&self) -> Option<[f64; 2]> {
        let mut part = self.clone();
        let mut end = |key: &str| {
            let field = Self::FIELDS.iter().find(|field| field.key == key)?;
            match (field.of)(&mut part) {
                Slot::Number(x) => Some(*x),
                _ => None,
            }
        };
        Some([end("from")?, end("to")?])
    }

    /// Checks the part on a bat of that length (m); `path` is its path in a bat file.
    fn check(&self, path: &str, length: f64) -> Result<()> {
        let (mut part, mut mistakes) = (self.clone(), Mistakes::default());
        let ends = self.stretch();
        if let Some(ends) = ends {
            mistakes.note(stretch(path, ends, length));
        }
        for field in Self::FIELDS.iter().filter(|field| ends.is_none() || !field.is_place()) {
            let dot = if path.is_empty() { "" } else { "." };
            mistakes.note(field.check(format!("{path}{dot}{}", field.key), &mut part, length));
        }
        mistakes.end(())
    }
}

pub(crate) fn stretch(path: &str, [from, to]: [f64; 2], length: f64) -> Result<()> {
    let name = |key: &str| format!("{path}.{key}");
    let mut mistakes = Mistakes::default();
    mistakes.note(on_the_bat(name("from"), from, length));
    mistakes.note(on_the_bat(name("to"), to, length));
    mistakes.end(())?;
    if to - from > SAME_PLACE * length {
        return Ok(());
    }
    Err(Error::value(name("to"), shown(to, "m"), format!("a place beyond {}", shown_length(from))))
}

pub(crate) fn on_the_bat(field: impl Into<String>, x: f64, length: f64) -> Result<()> {
    if x >= 0.0 && x <= length {
        return Ok(());
    }
    let expected = format!("a place on the bat, 0 to {}", shown_length(length));
    Err(Error::value(field, shown(x, "m"), expected))
}

/// A value as text, without a row of zeros.
pub(crate) fn shown(value: f64, unit: &str) -> String {
    let text = match value.abs() {
        size if !size.is_finite() => return "a value beyond the range of numbers".to_owned(),
        // A value may be off by the rounding of its unit.
        0.0 | 1e-4..1e6 => format!("{} {unit}", significant(value, 12)),
        _ => format!("{value:e} {unit}"),
    };
    text.trim_end().to_owned()
}
