//! What did a scale and a tap say of the bat?

use serde::{Deserialize, Serialize};

/// Values that were measured on the bat, as far as they are known.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Weighed {
    /// Mass with everything attached (kg).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass: Option<f64>,
    /// Balance point from the knob end (m): a check.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub balance_point: Option<f64>,
    /// Swing weight: moment of inertia about 6 in from the knob end (kg m²): a check.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub swing_weight: Option<f64>,
    /// Time of one swing to and fro of the bat hung from a pivot (s): a check of the swing weight.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pendulum_period: Option<f64>,
    /// Where that pivot is, from the knob end (m); 6 in if it is not said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pendulum_pivot: Option<f64>,
    /// The first bending frequency of the bat as described (Hz).
    #[serde(rename = "first_bending_hz", skip_serializing_if = "Option::is_none")]
    pub first_bending: Option<f64>,
}
