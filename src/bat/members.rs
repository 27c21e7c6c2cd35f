//! Which members has a material, or a part on the bat?
//!
//! One list for each: the reader of bat files, the check of a bat that is made otherwise, and the schema
//! follow from it.

use std::f64::consts::TAU;

use crate::base::error::Result;
use crate::base::units::Quantity;
use crate::bat::edit::{Bore, Cork, Cup, Cut, ScaleDiameter, Shorten, Sleeve};
use crate::bat::fixtures::{Absorber, Attachment, Grip, Joint, Region, Support, Tape};
use crate::bat::layup::Layer;
use crate::bat::material::{Material, PoissonRatios, ShearModuli};
use crate::bat::part::Slot::{self, Number, Unknown};
use crate::bat::part::{Bound, Field, Instead, MemberKind, PLACE, Part, Range};
use crate::bat::weighed::Weighed;

impl Material {
    /// Every value in its possible range: ρ, E, G, κ and the strength positive, η not negative,
    /// −1 < ν ≤ ½, a strain to failure above 0 and below 1.
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
        Field::<Self>::new("density", Quantity::Density, Range::Positive, |m| {
            Number(&mut m.density)
        }),
        Field::<Self>::new("youngs_modulus", Quantity::Pressure, Range::Positive, |m| {
            Number(&mut m.youngs_modulus)
        }),
        Field::<Self>::new("shear_modulus", Quantity::Pressure, Range::Positive, |m| {
            Unknown(&mut m.shear_modulus)
        }),
        Field::<Self>::ratio("poisson_ratio", POISSON, |m| Unknown(&mut m.poisson_ratio))
            .like("0.33"),
        Field::<Self>::ratio("shear_coefficient", Range::Positive, |m| {
            Unknown(&mut m.shear_coefficient)
        })
        .like("0.9"),
        Field::<Self>::ratio("loss_factor", LOSS, |m| Number(&mut m.loss_factor)).like("0.01"),
        Field::<Self>::new("strength", Quantity::Pressure, Range::Positive, |m| {
            Unknown(&mut m.strength)
        })
        .like("103 MPa"),
        Field::<Self>::ratio("strain_to_failure", STRAIN, |m| Unknown(&mut m.strain_to_failure))
            .like("0.02"),
        Field::<Self>::new("hoop_modulus", Quantity::Pressure, Range::Positive, |m| {
            Unknown(&mut m.hoop_modulus)
        })
        .with("radial_modulus", "the \"radial_modulus\" of the composite, across the wall"),
        Field::<Self>::new("radial_modulus", Quantity::Pressure, Range::Positive, |m| {
            Unknown(&mut m.radial_modulus)
        })
        .with("shear_moduli", "the \"shear_moduli\" of the composite"),
        Field::<Self>::of_kind("shear_moduli", MemberKind::ShearModuli, |m| {
            Slot::ShearModuli(&mut m.shear_moduli)
        })
        .with("poisson_ratios", "the \"poisson_ratios\" of the composite"),
        Field::<Self>::of_kind("poisson_ratios", MemberKind::PoissonRatios, |m| {
            Slot::PoissonRatios(&mut m.poisson_ratios)
        })
        .with("hoop_modulus", "the \"hoop_modulus\" of the composite, around the bat"),
    ];
}

impl Part for ShearModuli {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::new("along_around", Quantity::Pressure, Range::Positive, |m| {
            Number(&mut m.along_around)
        })
        .needed("\"along_around\": the modulus in the surface of the wall"),
        Field::<Self>::new("along_across", Quantity::Pressure, Range::Positive, |m| {
            Number(&mut m.along_across)
        })
        .needed("\"along_across\": the modulus along the bat and across the wall"),
        Field::<Self>::new("around_across", Quantity::Pressure, Range::Positive, |m| {
            Number(&mut m.around_across)
        })
        .needed("\"around_across\": the modulus around the bat and across the wall"),
    ];
}

impl Part for PoissonRatios {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::ratio("along_around", DIRECTED, |m| Number(&mut m.along_around))
            .needed("\"along_around\": contraction around when pulled along the bat")
            .like("0.3"),
        Field::<Self>::ratio("along_across", DIRECTED, |m| Number(&mut m.along_across))
            .needed("\"along_across\": contraction across the wall when pulled along the bat")
            .like("0.3"),
        Field::<Self>::ratio("around_across", DIRECTED, |m| Number(&mut m.around_across))
            .needed("\"around_across\": contraction across the wall when pulled around")
            .like("0.3"),
    ];
}

/// Poisson's ratios of a composite, which all together make a positive stiffness.
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
        Field::<Self>::new("mass", Quantity::Mass, Range::Positive, |w| Unknown(&mut w.mass)),
        Field::<Self>::new("balance_point", Quantity::Length, Range::OnBat, |w| {
            Unknown(&mut w.balance_point)
        })
        .like("22 in"),
        Field::<Self>::new("swing_weight", Quantity::Inertia, Range::Positive, |w| {
            Unknown(&mut w.swing_weight)
        })
        .like("10425 oz in^2"),
        Field::<Self>::new("pendulum_period", Quantity::Time, Range::Positive, |w| {
            Unknown(&mut w.pendulum_period)
        })
        .like("1.4 s"),
        Field::<Self>::new("pendulum_pivot", Quantity::Length, Range::OnBat, |w| {
            Unknown(&mut w.pendulum_pivot)
        })
        .like("6 in")
        .with("pendulum_period", "\"pendulum_period\": the time of a swing to and fro about it"),
        Field::<Self>::new("first_bending_hz", Quantity::Frequency, Range::Positive, |w| {
            Unknown(&mut w.first_bending)
        }),
    ];
    const SOME: &'static [&'static str] =
        &["mass", "balance_point", "swing_weight", "pendulum_period", "first_bending_hz"];
}

impl Part for Region {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::place("from", |region| Number(&mut region.from)),
        Field::<Self>::place("to", |region| Number(&mut region.to)),
        Field::<Self>::of_kind("material", MemberKind::Material, |region| {
            Slot::Material(&mut region.layup.outer)
        }),
        Field::<Self>::of_kind("core", MemberKind::Material, |region| {
            Slot::Core(&mut region.layup.core)
        }),
        Field::<Self>::of_kind("layers", MemberKind::Layers, |region| {
            Slot::Layers(&mut region.layup.sleeves)
        }),
    ];
    const SOME: &'static [&'static str] = &["material", "core", "layers"];

    fn stretch(&self) -> Option<[f64; 2]> {
        Some([self.from, self.to])
    }
}

impl Part for Layer {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::new("thickness", Quantity::Length, Range::Positive, |layer| {
            Number(&mut layer.thickness)
        })
        .needed("\"thickness\": how thick the layer is")
        .like("1 mm"),
        Field::<Self>::of_kind("material", MemberKind::Material, |layer| {
            Slot::Material(&mut layer.material)
        })
        .needed("\"material\": what the layer is made of"),
    ];
}

impl Part for Support {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::place("x", |support| Number(&mut support.x)),
        Field::<Self>::of_kind("type", MemberKind::Held, |support| Slot::Held(&mut support.kind))
            .needed("\"type\": \"pinned\" or \"clamped\""),
    ];
}

impl Part for Attachment {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::place("x", |a| Number(&mut a.x)),
        Field::<Self>::new("mass", Quantity::Mass, Range::Mass, |a| Number(&mut a.mass))
            .like("1 oz"),
        Field::<Self>::new("offset", Quantity::Length, Range::Distance, |a| Number(&mut a.offset))
            .with("mass", "the \"mass\" whose centre has that \"offset\"")
            .like("0.5 in"),
        Field::<Self>::new("rotary_inertia", Quantity::Inertia, Range::Mass, |a| {
            Number(&mut a.rotary_inertia)
        })
        .like("0.5 oz in^2"),
        Field::<Self>::new("stiffness", Quantity::Stiffness, Range::Spring, |a| {
            Number(&mut a.stiffness)
        }),
        Field::<Self>::new(
            "rotational_stiffness",
            Quantity::RotationalStiffness,
            Range::Spring,
            |a| Number(&mut a.rotational_stiffness),
        ),
    ];
    const SOME: &'static [&'static str] =
        &["mass", "rotary_inertia", "stiffness", "rotational_stiffness"];
}

impl Part for Tape {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::place("from", |tape| Number(&mut tape.from)),
        Field::<Self>::place("to", |tape| Number(&mut tape.to)),
        Field::<Self>::new("mass", Quantity::Mass, Range::Mass, |tape| Number(&mut tape.mass))
            .needed("the \"mass\" that is spread there")
            .like("0.7 oz"),
    ];

    fn stretch(&self) -> Option<[f64; 2]> {
        Some([self.from, self.to])
    }
}

impl Part for Absorber {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::place("x", |a| Number(&mut a.x)),
        Field::<Self>::new("mass", Quantity::Mass, Range::SomeMass, |a| Number(&mut a.mass))
            .needed("the \"mass\" that hangs there")
            .like("1 oz"),
        Field::<Self>::new("stiffness", Quantity::Stiffness, Range::SomeSpring, |a| {
            Number(&mut a.stiffness)
        }),
        Field::<Self>::new("damping", Quantity::Damping, Range::NotNegative, |a| {
            Number(&mut a.damping)
        }),
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
        Field::<Self>::new("x", Quantity::Length, Range::Inside, |joint| Number(&mut joint.x))
            .needed(PLACE),
        Field::<Self>::new(
            "rotational_stiffness",
            Quantity::RotationalStiffness,
            Range::SomeSpring,
            |joint| Number(&mut joint.rotational_stiffness),
        )
        .needed("\"rotational_stiffness\": the bending moment per angle"),
    ];
}

impl Part for Grip {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::place("from", |grip| Number(&mut grip.from)),
        Field::<Self>::place("to", |grip| Number(&mut grip.to)),
        Field::<Self>::new("stiffness", Quantity::BedStiffness, Range::Spring, |grip| {
            Number(&mut grip.stiffness)
        }),
        Field::<Self>::new("damping", Quantity::BedDamping, Range::NotNegative, |grip| {
            Number(&mut grip.damping)
        }),
    ];
    const SOME: &'static [&'static str] = &["stiffness", "damping"];

    fn stretch(&self) -> Option<[f64; 2]> {
        Some([self.from, self.to])
    }
}

/// What is expected where the diameter of a hole is missing.
const DIAMETER: &str = "\"diameter\": how wide the hole is";
const BLEND: &str = "1 in";

impl Part for Cut {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::place("from", |cut| Number(&mut cut.from)),
        Field::<Self>::place("to", |cut| Number(&mut cut.to)),
        Field::<Self>::new("depth", Quantity::Length, Range::Positive, |cut| {
            Number(&mut cut.depth)
        })
        .needed("\"depth\": how much thinner the bat becomes, of the diameter")
        .like("1 mm"),
        Field::<Self>::new("blend", Quantity::Length, Range::NotNegative, |cut| {
            Unknown(&mut cut.blend)
        })
        .like(BLEND),
    ];

    fn stretch(&self) -> Option<[f64; 2]> {
        Some([self.from, self.to])
    }
}

impl Part for Cup {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::new("depth", Quantity::Length, Range::Positive, |cup| {
            Number(&mut cup.depth)
        })
        .needed("\"depth\": how deep the cup goes into the bat")
        .like("1 in"),
        Field::<Self>::new("diameter", Quantity::Length, Range::Positive, |cup| {
            Number(&mut cup.diameter)
        })
        .needed("\"diameter\": how wide the cup is at the tip")
        .like("1.5 in"),
    ];
}

impl Part for Bore {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::place("from", |bore| Number(&mut bore.from)),
        Field::<Self>::place("to", |bore| Number(&mut bore.to)),
        Field::<Self>::new("diameter", Quantity::Length, Range::Positive, |bore| {
            Number(&mut bore.diameter)
        })
        .needed(DIAMETER)
        .like("1 in"),
    ];

    fn stretch(&self) -> Option<[f64; 2]> {
        Some([self.from, self.to])
    }
}

impl Part for Cork {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::place("from", |cork| Number(&mut cork.from)),
        Field::<Self>::place("to", |cork| Number(&mut cork.to)),
        Field::<Self>::new("diameter", Quantity::Length, Range::Positive, |cork| {
            Number(&mut cork.diameter)
        })
        .needed(DIAMETER)
        .like("1 in"),
        Field::<Self>::of_kind("material", MemberKind::Material, |cork| {
            Slot::Material(&mut cork.material)
        })
        .needed("\"material\": what fills the hole"),
    ];

    fn stretch(&self) -> Option<[f64; 2]> {
        Some([self.from, self.to])
    }
}

impl Part for Sleeve {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::place("from", |sleeve| Number(&mut sleeve.from)),
        Field::<Self>::place("to", |sleeve| Number(&mut sleeve.to)),
        Field::<Self>::new("thickness", Quantity::Length, Range::Positive, |sleeve| {
            Number(&mut sleeve.thickness)
        })
        .needed("\"thickness\": how thick the sleeve is")
        .like("1 mm"),
        Field::<Self>::of_kind("material", MemberKind::Material, |sleeve| {
            Slot::Material(&mut sleeve.material)
        })
        .needed("\"material\": what the sleeve is made of"),
    ];

    fn stretch(&self) -> Option<[f64; 2]> {
        Some([self.from, self.to])
    }
}

impl Part for Shorten {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::new("knob", Quantity::Length, Range::Positive, |s| Unknown(&mut s.knob))
            .like("0.5 in"),
        Field::<Self>::new("tip", Quantity::Length, Range::Positive, |s| Unknown(&mut s.tip))
            .like("0.5 in"),
    ];
    const SOME: &'static [&'static str] = &["knob", "tip"];
}

impl Part for ScaleDiameter {
    const FIELDS: &'static [Field<Self>] = &[
        Field::<Self>::place("from", |scale| Number(&mut scale.from)),
        Field::<Self>::place("to", |scale| Number(&mut scale.to)),
        Field::<Self>::ratio("by", Range::Positive, |scale| Number(&mut scale.by))
            .needed("\"by\": the factor on the diameter, such as 1.02")
            .like("1.02"),
        Field::<Self>::new("blend", Quantity::Length, Range::NotNegative, |scale| {
            Unknown(&mut scale.blend)
        })
        .like(BLEND),
    ];

    fn stretch(&self) -> Option<[f64; 2]> {
        Some([self.from, self.to])
    }
}
