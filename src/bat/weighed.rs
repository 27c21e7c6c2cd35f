//! What did a scale and a tap say of the bat?

use serde::{Deserialize, Serialize};

/// What a scale and a tap said, where they were asked.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "show", derive(schemars::JsonSchema))]
pub struct Weighed {
    /// Mass with everything attached (kg).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass: Option<f64>,
    /// Balance point from the knob end (m): a check.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub balance_point: Option<f64>,
    /// The first bending frequency of the bat as described (Hz).
    #[serde(rename = "first_bending_hz", skip_serializing_if = "Option::is_none")]
    pub first_bending: Option<f64>,
}
