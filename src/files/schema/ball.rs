//! The form of a ball file, `sweetspot-ball/1`, for its schema.

use schemars::JsonSchema;
use schemars::generate::Contract;

use crate::base::Quantity;
use crate::files::schema::amount::{Amount, Measures};
use crate::files::schema::document::{Document, Format};
use crate::files::schema::part::Comment;

/// A ball: its size, its force law F = k u^alpha (N, m) under compression, and its restitution. A bare number is SI, a
/// text carries its unit.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(title = "Ball file of sweetspot, sweetspot-ball/1", deny_unknown_fields)]
#[schemars(extend("anyOf" = [
    { "required": ["cor"] },
    { "required": ["cor_by_speed"] },
    { "required": ["damping_ratio"] },
]))]
#[schemars(extend("dependentSchemas" = {
    "damping_ratio": { "properties": { "cor": false, "exponent": { "const": 1 } } },
}))]
pub struct BallFile {
    /// Name of the format and its version: sweetspot-ball/1.
    pub format: Format<BallFile>,
    /// A remark for people, which programs ignore.
    pub comment: Option<Comment>,
    /// Name of the ball.
    pub name: Option<String>,
    /// Where these numbers come from.
    pub source: Option<String>,
    /// Mass of the ball.
    #[schemars(transform = Measures(Quantity::Mass), example = &"5.125 oz")]
    #[schemars(extend("exclusiveMinimum" = 1e-100, "exclusiveMaximum" = 1e100))]
    pub mass: Amount,
    /// Radius of the ball.
    #[schemars(transform = Measures(Quantity::Length), example = &"36.6 mm")]
    #[schemars(extend("exclusiveMinimum" = 1e-100, "exclusiveMaximum" = 1e100))]
    pub radius: Amount,
    /// Radius of the patch on which it presses against a flat wall in a hit, for hollow bats; by default that of a ball
    /// compressed by 8 mm.
    #[schemars(transform = Measures(Quantity::Length), example = &"17 mm")]
    #[schemars(extend("exclusiveMinimum" = 1e-100, "exclusiveMaximum" = 1e100))]
    pub contact_radius: Option<Amount>,
    /// Stiffness k of the force law (N/m^alpha).
    #[schemars(extend("exclusiveMinimum" = 1e-100, "exclusiveMaximum" = 1e100), example = 6.53e7)]
    pub stiffness: Option<f64>,
    /// Exponent alpha of the force law.
    #[schemars(extend("exclusiveMinimum" = 1e-100, "exclusiveMaximum" = 1e100), example = 1.84)]
    pub exponent: Option<f64>,
    /// Coefficient of restitution on a rigid wall; by default the last one of the table.
    #[schemars(range(min = 0, max = 1))]
    pub cor: Option<f64>,
    /// Pairs of a speed and the coefficient of restitution at that speed, by rising speed.
    #[schemars(length(min = 1))]
    pub cor_by_speed: Option<Vec<AtSpeed>>,
    /// Damping ratio of a ball with a linear force, in place of the coefficient of restitution.
    #[schemars(extend("minimum" = 0, "exclusiveMaximum" = 1))]
    pub damping_ratio: Option<f64>,
}

impl Document for BallFile {
    const NAME: &'static str = "ball";
    const CONTRACT: Contract = Contract::Deserialize;
}

/// A speed and the coefficient of restitution at that speed.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
pub struct AtSpeed(
    #[schemars(transform = Measures(Quantity::Speed), extend("minimum" = 0))] pub Amount,
    #[schemars(range(min = 0, max = 1))] pub f64,
);
