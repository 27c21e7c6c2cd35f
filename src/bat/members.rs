//! Which members has a material, or a fixture of a bat?
//!
//! There is one list for each. The reader of bat files, the check of bats from other sources, and the schema all follow
//! from it.

use std::f64::consts::TAU;

use crate::base::{Quantity, Result};
use crate::bat::edit::{Bore, Cork, Cup, Cut, ScaleDiameter, Shorten, Sleeve};
use crate::bat::fixtures::{Absorber, Attachment, Grip, Joint, Region, Support, Tape};
use crate::bat::layup::Layer;
use crate::bat::material::{Material, PoissonRatios, ShearModuli};
use crate::bat::part::{Bound, Field, Instead, MemberKind, PLACE, Part, Range, Slot};
use crate::bat::weighed::Weighed;

/// A member by its key in a bat file, and its field if that has another name.
macro_rules! member {
    ($key:ident, $kind:expr) => {
        member!($key: $key, $kind)
    };
    ($key:ident: $($kept:ident).+, $kind:expr) => {
        Field::<Self>::of_kind(stringify!($key), $kind, |part| Slot::from(&mut part.$($kept).+))
    };
}

/// A number of a quantity.
macro_rules! number {
    ($key:ident, $quantity:ident, $range:expr) => {
        member!($key, MemberKind::Number(Some(Quantity::$quantity), $range))
    };
}

/// A pure number.
macro_rules! ratio {
    ($key:ident, $range:expr) => {
        member!($key, MemberKind::Number(None, $range))
    };
}

/// A place on the bat, required.
macro_rules! place {
    ($key:ident) => {
        number!($key, Length, Range::OnBat).needed(PLACE)
    };
}

impl Material {
    /// Checks that every value is in its possible range: ρ, E, G, κ and the strength positive, η not negative, −1 < ν ≤
    /// ½, a strain to failure above 0 and below 1.
    ///
    /// # Errors
    ///
    /// [`crate::Error::Value`] with the key of the bat file as its field, or several of them.
    pub fn check(&self) -> Result<()> {
        // A material has no places on the bat.
        Part::check(self, "", 0.0)
    }
}

impl Part for Material {
    const FIELDS: &'static [Field<Self>] = &[
        number!(density, Density, Range::Positive),
        number!(youngs_modulus, Pressure, Range::Positive),
        number!(shear_modulus, Pressure, Range::Positive),
        ratio!(poisson_ratio, POISSON).like("0.33"),
        ratio!(shear_coefficient, Range::Positive).like("0.9"),
        ratio!(loss_factor, LOSS).like("0.01"),
        ratio!(shear_loss_factor, LOSS).like("0.02"),
        number!(strength, Pressure, Range::Positive).like("103 MPa"),
        ratio!(strain_to_failure, STRAIN).like("0.02"),
        number!(hoop_modulus, Pressure, Range::Positive)
            .with("radial_modulus", "the \"radial_modulus\" of the composite, across the wall"),
        number!(radial_modulus, Pressure, Range::Positive)
            .with("shear_moduli", "the \"shear_moduli\" of the composite"),
        member!(shear_moduli, MemberKind::ShearModuli)
            .with("poisson_ratios", "the \"poisson_ratios\" of the composite"),
        member!(poisson_ratios, MemberKind::PoissonRatios)
            .with("hoop_modulus", "the \"hoop_modulus\" of the composite, around the bat"),
    ];
}

impl Part for ShearModuli {
    const FIELDS: &'static [Field<Self>] = &[
        number!(along_around, Pressure, Range::Positive)
            .needed("\"along_around\": the modulus in the surface of the wall"),
        number!(along_across, Pressure, Range::Positive)
            .needed("\"along_across\": the modulus along the bat and across the wall"),
        number!(around_across, Pressure, Range::Positive)
            .needed("\"around_across\": the modulus around the bat and across the wall"),
    ];
}

impl Part for PoissonRatios {
    const FIELDS: &'static [Field<Self>] = &[
        ratio!(along_around, DIRECTED)
            .needed("\"along_around\": contraction around when pulled along the bat")
            .like("0.3"),
        ratio!(along_across, DIRECTED)
            .needed("\"along_across\": contraction across the wall when pulled along the bat")
            .like("0.3"),
        ratio!(around_across, DIRECTED)
            .needed("\"around_across\": contraction across the wall when pulled around")
            .like("0.3"),
    ];
}

/// Poisson's ratios of a composite; together they must give a positive stiffness.
const DIRECTED: Range =
    Range::Between(Bound::Beyond(-10.0), Bound::Beyond(10.0), "a number between -10 and 10");

/// Poisson's ratio: a positive bulk and shear modulus.
const POISSON: Range =
    Range::Between(Bound::Beyond(-1.0), Bound::At(0.5), "a number above -1, 0.5 at most");
const LOSS: Range = Range::Between(
    Bound::At(0.0),
    Bound::Beyond(2.0),
    "0 or more and below 2 (a damping ratio below 1)",
);
const STRAIN: Range = Range::Between(
    Bound::Beyond(0.0),
    Bound::Beyond(1.0),
    "a number above 0 and below 1, such as 0.02",
);

impl Part for Weighed {
    const FIELDS: &'static [Field<Self>] = &[
        number!(mass, Mass, Range::Positive),
        number!(balance_point, Length, Range::OnBat).like("22 in"),
        number!(swing_weight, Inertia, Range::Positive).like("10425 oz in^2"),
        number!(pendulum_period, Time, Range::Positive).like("1.4 s"),
        number!(pendulum_pivot, Length, Range::OnBat).like("6 in").with(
            "pendulum_period",
            "\"pendulum_period\": the time of a swing to and fro about it",
        ),
        member!(first_bending_hz: first_bending, MemberKind::Number(Some(Quantity::Frequency), Range::Positive)),
    ];
    const SOME: &'static [&'static str] =
        &["mass", "balance_point", "swing_weight", "pendulum_period", "first_bending_hz"];
}

impl Part for Region {
    const FIELDS: &'static [Field<Self>] = &[
        place!(from),
        place!(to),
        member!(material: layup.outer, MemberKind::Material),
        member!(core: layup.core, MemberKind::Material),
        member!(layers: layup.sleeves, MemberKind::Layers),
    ];
    const SOME: &'static [&'static str] = &["material", "core", "layers"];
}

impl Part for Layer {
    const FIELDS: &'static [Field<Self>] = &[
        number!(thickness, Length, Range::Positive)
            .needed("\"thickness\": how thick the layer is")
            .like("1 mm"),
        member!(material, MemberKind::Material).needed("\"material\": what the layer is made of"),
    ];
}

impl Part for Support {
    const FIELDS: &'static [Field<Self>] = &[
        place!(x),
        member!(type: kind, MemberKind::Held).needed("\"type\": \"pinned\" or \"clamped\""),
    ];
}

impl Part for Attachment {
    const FIELDS: &'static [Field<Self>] = &[
        place!(x),
        number!(mass, Mass, Range::Mass).like("1 oz"),
        number!(offset, Length, Range::Distance)
            .with("mass", "the \"mass\" whose centre has that \"offset\"")
            .like("0.5 in"),
        number!(rotary_inertia, Inertia, Range::Mass).like("0.5 oz in^2"),
        number!(stiffness, Stiffness, Range::Spring),
        number!(rotational_stiffness, RotationalStiffness, Range::Spring),
    ];
    const SOME: &'static [&'static str] =
        &["mass", "rotary_inertia", "stiffness", "rotational_stiffness"];
}

impl Part for Tape {
    const FIELDS: &'static [Field<Self>] = &[
        place!(from),
        place!(to),
        number!(mass, Mass, Range::Mass).needed("the \"mass\" that is spread there").like("0.7 oz"),
    ];
}

impl Part for Absorber {
    const FIELDS: &'static [Field<Self>] = &[
        place!(x),
        number!(mass, Mass, Range::SomeMass).needed("the \"mass\" that hangs there").like("1 oz"),
        number!(stiffness, Stiffness, Range::SomeSpring),
        number!(damping, Damping, Range::NotNegative),
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
        number!(x, Length, Range::Inside).needed(PLACE),
        number!(rotational_stiffness, RotationalStiffness, Range::SomeSpring)
            .needed("\"rotational_stiffness\": the bending moment per angle"),
    ];
}

impl Part for Grip {
    const FIELDS: &'static [Field<Self>] = &[
        place!(from),
        place!(to),
        number!(stiffness, BedStiffness, Range::Spring),
        number!(damping, BedDamping, Range::NotNegative),
    ];
    const SOME: &'static [&'static str] = &["stiffness", "damping"];
}

/// The expected text if the diameter of a hole is missing.
const DIAMETER: &str = "\"diameter\": how wide the hole is";
const BLEND: &str = "1 in";

impl Part for Cut {
    const FIELDS: &'static [Field<Self>] = &[
        place!(from),
        place!(to),
        number!(depth, Length, Range::Positive)
            .needed("\"depth\": how much thinner the bat becomes, of the diameter")
            .like("1 mm"),
        number!(blend, Length, Range::NotNegative).like(BLEND),
    ];
}

impl Part for Cup {
    const FIELDS: &'static [Field<Self>] = &[
        number!(depth, Length, Range::Positive)
            .needed("\"depth\": how deep the cup goes into the bat")
            .like("1 in"),
        number!(diameter, Length, Range::Positive)
            .needed("\"diameter\": how wide the cup is at the tip")
            .like("1.5 in"),
    ];
}

impl Part for Bore {
    const FIELDS: &'static [Field<Self>] = &[
        place!(from),
        place!(to),
        number!(diameter, Length, Range::Positive).needed(DIAMETER).like("1 in"),
    ];
}

impl Part for Cork {
    const FIELDS: &'static [Field<Self>] = &[
        place!(from),
        place!(to),
        number!(diameter, Length, Range::Positive).needed(DIAMETER).like("1 in"),
        member!(material, MemberKind::Material).needed("\"material\": what fills the hole"),
    ];
}

impl Part for Sleeve {
    const FIELDS: &'static [Field<Self>] = &[
        place!(from),
        place!(to),
        number!(thickness, Length, Range::Positive)
            .needed("\"thickness\": how thick the sleeve is")
            .like("1 mm"),
        member!(material, MemberKind::Material).needed("\"material\": what the sleeve is made of"),
    ];
}

impl Part for Shorten {
    const FIELDS: &'static [Field<Self>] = &[
        number!(knob, Length, Range::Positive).like("0.5 in"),
        number!(tip, Length, Range::Positive).like("0.5 in"),
    ];
    const SOME: &'static [&'static str] = &["knob", "tip"];
}

impl Part for ScaleDiameter {
    const FIELDS: &'static [Field<Self>] = &[
        place!(from),
        place!(to),
        ratio!(by, Range::Positive)
            .needed("\"by\": the factor on the diameter, such as 1.02")
            .like("1.02"),
        number!(blend, Length, Range::NotNegative).like(BLEND),
    ];
}
