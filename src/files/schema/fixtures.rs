//! The form of what a bat file says is on a bat and what holds it, for its schema.

use schemars::JsonSchema;
use serde_json::{Value, json};

use crate::base::units::Quantity;
use crate::files::schema::amount::{Amount, Measures};
use crate::files::schema::material::{Comment, Material};
use crate::files::schema::resolved::Held;

/// A stretch of another material, of another core, or of both.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[schemars(extend("anyOf" = [{ "required": ["material"] }, { "required": ["core"] }]))]
pub struct Region {
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// Where the region begins.
    #[schemars(transform = Measures(Quantity::Length), extend("minimum" = 0))]
    pub from: Amount,
    /// Where the region ends.
    #[schemars(transform = Measures(Quantity::Length), extend("exclusiveMinimum" = 0))]
    pub to: Amount,
    /// What the wall is made of; the bat's own material without it.
    #[schemars(extend("allOf" = [whole()]))]
    pub material: Option<Material>,
    /// What fills the bore, as cork does.
    #[schemars(extend("allOf" = [whole()]))]
    pub core: Option<Material>,
}

/// A name, or both numbers: nothing that was measured stands in for those of a region's material.
fn whole() -> Value {
    json!({ "anyOf": [{ "type": "string" }, { "required": ["density", "youngs_modulus"] }] })
}

/// A point mass and springs to ground.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[schemars(extend("anyOf" = [
    { "required": ["mass"] },
    { "required": ["rotary_inertia"] },
    { "required": ["stiffness"] },
    { "required": ["rotational_stiffness"] },
]))]
#[schemars(extend("dependentRequired" = { "offset": ["mass"] }))]
pub struct Attachment {
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// Where the attachment is fixed.
    #[schemars(transform = Measures(Quantity::Length), extend("minimum" = 0))]
    pub x: Amount,
    /// Mass of the attachment, as a point at `x` and `offset`.
    #[schemars(transform = Measures(Quantity::Mass), example = &"1 oz")]
    #[schemars(extend("minimum" = 0, "maximum" = 1e8))]
    pub mass: Option<Amount>,
    /// How far beyond `x`, towards the barrel, the centre of the mass is.
    #[schemars(transform = Measures(Quantity::Length), example = &"0.5 in")]
    pub offset: Option<Amount>,
    /// Moment of inertia of the mass about its own centre.
    #[schemars(transform = Measures(Quantity::Inertia), example = &"0.5 oz in^2")]
    #[schemars(extend("minimum" = 0, "maximum" = 1e8))]
    pub rotary_inertia: Option<Amount>,
    /// Spring from the bat to the ground against deflection: 0, or 1e-12 N/m and more.
    #[schemars(transform = Measures(Quantity::Stiffness))]
    #[schemars(extend("minimum" = 0, "exclusiveMaximum" = 1e100))]
    pub stiffness: Option<Amount>,
    /// Spring from the bat to the ground against rotation: 0, or 1e-12 N m/rad and more.
    #[schemars(transform = Measures(Quantity::RotationalStiffness))]
    #[schemars(extend("minimum" = 0, "exclusiveMaximum" = 1e100))]
    pub rotational_stiffness: Option<Amount>,
}

/// A mass spread evenly on a stretch of the surface.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Tape {
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// Where the tape begins.
    #[schemars(transform = Measures(Quantity::Length), extend("minimum" = 0))]
    pub from: Amount,
    /// Where the tape ends.
    #[schemars(transform = Measures(Quantity::Length), extend("exclusiveMinimum" = 0))]
    pub to: Amount,
    /// Mass of the whole tape.
    #[schemars(transform = Measures(Quantity::Mass), example = &"0.7 oz")]
    #[schemars(extend("minimum" = 0, "maximum" = 1e8))]
    pub mass: Amount,
}

/// A mass on a spring and a dashpot: a tuned absorber.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[schemars(extend("oneOf" = [{ "required": ["stiffness"] }, { "required": ["frequency"] }]))]
pub struct Absorber {
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// Where the absorber hangs.
    #[schemars(transform = Measures(Quantity::Length), extend("minimum" = 0))]
    pub x: Amount,
    /// Mass that swings on the spring.
    #[schemars(transform = Measures(Quantity::Mass), example = &"1 oz")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1e8))]
    pub mass: Amount,
    /// Stiffness of the spring.
    #[schemars(transform = Measures(Quantity::Stiffness))]
    #[schemars(extend("minimum" = 1e-12, "exclusiveMaximum" = 1e100))]
    pub stiffness: Option<Amount>,
    /// Frequency of the absorber on a fixed bat, in place of the stiffness.
    #[schemars(transform = Measures(Quantity::Frequency), extend("exclusiveMinimum" = 0))]
    pub frequency: Option<Amount>,
    /// Damping constant of the dashpot.
    #[schemars(transform = Measures(Quantity::Damping))]
    #[schemars(extend("minimum" = 0, "exclusiveMaximum" = 1e100))]
    pub damping: Option<Amount>,
}

/// A place inside the bat where a spring gives way to bending.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Joint {
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// Where the joint is.
    #[schemars(transform = Measures(Quantity::Length), extend("exclusiveMinimum" = 0))]
    pub x: Amount,
    /// Bending moment per angle between both sides.
    #[schemars(transform = Measures(Quantity::RotationalStiffness))]
    #[schemars(extend("minimum" = 1e-12, "exclusiveMaximum" = 1e100))]
    pub rotational_stiffness: Amount,
}

/// A place that is held.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Support {
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// Where the support is.
    #[schemars(transform = Measures(Quantity::Length), extend("minimum" = 0))]
    pub x: Amount,
    /// pinned: the bat does not move there but may turn; clamped: neither.
    #[schemars(rename = "type")]
    pub kind: Held,
}

/// Hands as an elastic bed.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[schemars(extend("anyOf" = [{ "required": ["stiffness"] }, { "required": ["damping"] }]))]
pub struct Grip {
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// Where the hands begin.
    #[schemars(transform = Measures(Quantity::Length), extend("minimum" = 0))]
    pub from: Amount,
    /// Where the hands end.
    #[schemars(transform = Measures(Quantity::Length), extend("exclusiveMinimum" = 0))]
    pub to: Amount,
    /// Force per deflection and per length: 0, or 1e-12 N/m^2 and more.
    #[schemars(transform = Measures(Quantity::BedStiffness))]
    #[schemars(extend("minimum" = 0, "exclusiveMaximum" = 1e100))]
    pub stiffness: Option<Amount>,
    /// Force per velocity and per length.
    #[schemars(transform = Measures(Quantity::BedDamping))]
    #[schemars(extend("minimum" = 0, "exclusiveMaximum" = 1e100))]
    pub damping: Option<Amount>,
}
