//! What numbers has a part on the bat, and how large may they be?
//!
//! One list for each part: the reader of bat files, the check of a bat that is made otherwise, and the
//! schema follow from it.

use std::f64::consts::TAU;

use crate::base::error::{Error, Result};
use crate::base::mistakes::Mistakes;
use crate::base::units::Quantity;
use crate::bat::fixtures::{Absorber, Attachment, Grip, Joint, Tape};
use crate::bat::profile::SAME_PLACE;

/// Products of larger values are beyond the range of numbers.
pub(crate) const MOST: f64 = 1e100;
/// A softer spring (N/m or N m/rad) holds nothing.
pub(crate) const SOFTEST: f64 = 1e-12;
/// A larger mass (kg) or inertia (kg m²) is a support.
pub(crate) const HEAVIEST: f64 = 1e8;

/// A number of a part on the bat: how a bat file calls it, what it measures, how large it may be.
pub(crate) struct Field<P> {
    pub key: &'static str,
    pub quantity: Quantity,
    pub range: Range,
    /// Whether 0 is too little.
    pub positive: bool,
    /// What is expected where it is missing; without such words it is 0 then.
    pub needed: Option<&'static str>,
    /// Another key that must be there beside it, and what is expected of that.
    pub with: Option<(&'static str, &'static str)>,
    /// A value in units of the trade, where that of the quantity is another size.
    #[cfg_attr(not(feature = "show"), expect(dead_code, reason = "the schema says it"))]
    pub example: Option<&'static str>,
    pub of: fn(&mut P) -> &mut f64,
}

/// How large a number may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Range {
    /// A place on the bat, its ends included.
    OnBat,
    /// A place inside the bat.
    Inside,
    /// A distance of at most ten lengths of the bat.
    Distance,
    /// What a bat can be told from: [`HEAVIEST`] at most.
    Mass,
    /// 0, or what holds more than a rigid motion: [`SOFTEST`] and more.
    Spring,
    /// 0 or more.
    Dashpot,
}

impl<P> Field<P> {
    const fn new(
        key: &'static str,
        quantity: Quantity,
        range: Range,
        of: fn(&mut P) -> &mut f64,
    ) -> Self {
        Self { key, quantity, range, positive: false, needed: None, with: None, example: None, of }
    }

    const fn place(key: &'static str, of: fn(&mut P) -> &mut f64) -> Self {
        Self::new(key, Quantity::Length, Range::OnBat, of)
    }

    const fn like(self, example: &'static str) -> Self {
        Self { example: Some(example), ..self }
    }

    const fn needed(self, expected: &'static str) -> Self {
        Self { needed: Some(expected), ..self }
    }

    const fn with(self, other: &'static str, expected: &'static str) -> Self {
        Self { with: Some((other, expected)), ..self }
    }

    const fn positive(self) -> Self {
        Self { positive: true, ..self }
    }

    /// Whether it is a place on the bat, which must be there.
    pub fn is_place(&self) -> bool {
        matches!(self.range, Range::OnBat | Range::Inside)
    }

    /// Whether a value is possible on a bat of that length (m); `field` is its path in a bat file.
    fn check(&self, field: String, value: f64, length: f64) -> Result<()> {
        let (unit, same) = (self.quantity.unit(), SAME_PLACE * length);
        let (possible, expected) = match self.range {
            Range::OnBat => return on_the_bat(field, value, length),
            Range::Inside => (
                value > same && value < length - same,
                format!("a place inside the bat, 0 to {length} m"),
            ),
            Range::Distance => (
                value.abs() <= 10.0 * length,
                "a distance of at most ten lengths of the bat".to_owned(),
            ),
            _ if self.positive && !(value > 0.0 && value < MOST) => {
                return positive(field, value, &unit);
            }
            _ if !(0.0..MOST).contains(&value) => (false, format!("0 or more, below {MOST:e}")),
            Range::Mass => {
                (value <= HEAVIEST, format!("{HEAVIEST:e} {unit} at most: more is a support"))
            }
            Range::Spring => (
                value == 0.0 || value >= SOFTEST,
                format!("0, or {SOFTEST:e} {unit} and more: a softer spring holds nothing"),
            ),
            Range::Dashpot => return Ok(()),
        };
        match possible {
            true => Ok(()),
            false => Err(Error::value(field, shown(value, &unit), expected)),
        }
    }
}

/// Something above 0 that a bat file may give in place of a number.
pub(crate) struct Instead<P> {
    pub key: &'static str,
    pub quantity: Quantity,
    /// What it is, for the schema.
    #[cfg_attr(not(feature = "show"), expect(dead_code, reason = "the schema says it"))]
    pub said: &'static str,
    /// The number that it replaces.
    pub of: &'static str,
    /// What is expected where both are missing.
    pub expected: &'static str,
    pub set: fn(&mut P, f64),
}

/// A part that is a list of numbers: reading, checking and the schema follow from it.
pub(crate) trait Part: Copy + Default + 'static {
    /// Its numbers.
    const FIELDS: &'static [Field<Self>];
    /// Keys of which one at least must be there.
    const SOME: &'static [&'static str] = &[];
    /// What may stand in place of one of the numbers, which then must be there.
    const INSTEAD: Option<Instead<Self>> = None;

    /// Where it begins and ends (m), if it lies on a stretch.
    fn stretch(&self) -> Option<[f64; 2]> {
        None
    }

    /// What is wrong with it on a bat of that length (m), its path in a bat file before each field.
    fn check(&self, path: &str, length: f64) -> Result<()> {
        let (mut part, mut mistakes) = (*self, Mistakes::default());
        let ends = self.stretch();
        if let Some(ends) = ends {
            mistakes.note(stretch(path, ends, length));
        }
        for field in Self::FIELDS.iter().filter(|field| ends.is_none() || !field.is_place()) {
            let value = *(field.of)(&mut part);
            mistakes.note(field.check(format!("{path}.{}", field.key), value, length));
        }
        mistakes.end(())
    }
}

impl Part for Attachment {
    const FIELDS: &'static [Field<Self>] = &[
        Field::place("x", |a| &mut a.x),
        Field::<Self>::new("mass", Quantity::Mass, Range::Mass, |a| &mut a.mass).like("1 oz"),
        Field::<Self>::new("offset", Quantity::Length, Range::Distance, |a| &mut a.offset)
            .with("mass", "the \"mass\" whose centre has that \"offset\"")
            .like("0.5 in"),
        Field::<Self>::new("rotary_inertia", Quantity::Inertia, Range::Mass, |a| {
            &mut a.rotary_inertia
        })
        .like("0.5 oz in^2"),
        Field::<Self>::new("stiffness", Quantity::Stiffness, Range::Spring, |a| &mut a.stiffness),
        Field::<Self>::new(
            "rotational_stiffness",
            Quantity::RotationalStiffness,
            Range::Spring,
            |a| &mut a.rotational_stiffness,
        ),
    ];
    const SOME: &'static [&'static str] =
        &["mass", "rotary_inertia", "stiffness", "rotational_stiffness"];
}

impl Part for Tape {
    const FIELDS: &'static [Field<Self>] = &[
        Field::place("from", |tape| &mut tape.from),
        Field::place("to", |tape| &mut tape.to),
        Field::<Self>::new("mass", Quantity::Mass, Range::Mass, |tape| &mut tape.mass)
            .needed("the \"mass\" that is spread there")
            .like("0.7 oz"),
    ];

    fn stretch(&self) -> Option<[f64; 2]> {
        Some([self.from, self.to])
    }
}

impl Part for Absorber {
    const FIELDS: &'static [Field<Self>] = &[
        Field::place("x", |a| &mut a.x),
        Field::<Self>::new("mass", Quantity::Mass, Range::Mass, |a| &mut a.mass)
            .positive()
            .needed("the \"mass\" that hangs there")
            .like("1 oz"),
        Field::<Self>::new("stiffness", Quantity::Stiffness, Range::Spring, |a| &mut a.stiffness)
            .positive(),
        Field::<Self>::new("damping", Quantity::Damping, Range::Dashpot, |a| &mut a.damping),
    ];
    const INSTEAD: Option<Instead<Self>> = Some(Instead {
        key: "frequency",
        quantity: Quantity::Frequency,
        said: "Frequency of the absorber on a fixed bat, in place of the stiffness.",
        of: "stiffness",
        expected: "one of them: the spring, or how fast it swings alone",
        set: |a, frequency| a.stiffness = a.mass * (TAU * frequency).powi(2),
    });
}

impl Part for Joint {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::new("x", Quantity::Length, Range::Inside, |joint| &mut joint.x),
        Field::<Self>::new(
            "rotational_stiffness",
            Quantity::RotationalStiffness,
            Range::Spring,
            |joint| &mut joint.rotational_stiffness,
        )
        .positive()
        .needed("\"rotational_stiffness\": the bending moment per angle"),
    ];
}

impl Part for Grip {
    const FIELDS: &'static [Field<Self>] = &[
        Field::place("from", |grip| &mut grip.from),
        Field::place("to", |grip| &mut grip.to),
        Field::<Self>::new("stiffness", Quantity::BedStiffness, Range::Spring, |grip| {
            &mut grip.stiffness
        }),
        Field::<Self>::new("damping", Quantity::BedDamping, Range::Dashpot, |grip| {
            &mut grip.damping
        }),
    ];
    const SOME: &'static [&'static str] = &["stiffness", "damping"];

    fn stretch(&self) -> Option<[f64; 2]> {
        Some([self.from, self.to])
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
    Err(Error::value(name("to"), shown(to, "m"), format!("a place beyond {from} m")))
}

pub(crate) fn on_the_bat(field: impl Into<String>, x: f64, length: f64) -> Result<()> {
    if x >= 0.0 && x <= length {
        return Ok(());
    }
    Err(Error::value(field, shown(x, "m"), format!("a place on the bat, 0 to {length} m")))
}

pub(crate) fn positive(field: impl Into<String>, value: f64, unit: &str) -> Result<()> {
    if value > 0.0 && value < MOST {
        return Ok(());
    }
    Err(Error::value(field, shown(value, unit), format!("a number above 0, below {MOST:e}")))
}

/// A value without a row of zeros.
pub(crate) fn shown(value: f64, unit: &str) -> String {
    match value.abs() {
        size if !size.is_finite() => "a value beyond the range of numbers".to_owned(),
        0.0 | 1e-4..1e6 => format!("{value} {unit}"),
        _ => format!("{value:e} {unit}"),
    }
}
