//! How does a stiff body turn?

use serde::Serialize;

/// A bat as a rigid body; positions from the knob end, inertias transverse.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Inertia {
    /// Mass M (kg).
    pub mass: f64,
    /// Centre of mass (m).
    pub balance_point: f64,
    /// The body's moment of inertia about the balance point (kg m²), as a pendulum measures it.
    pub about_balance: f64,
    /// Moment of inertia about the balance point of the bat as a line of mass, without the sections' own `∫ρI dx` (kg
    /// m²), as for an Euler–Bernoulli beam.
    pub line_about_balance: f64,
}

impl Inertia {
    /// The body's moment of inertia about the point `x` (kg m²).
    pub fn about(&self, x: f64) -> f64 {
        self.about_balance + self.mass * (self.balance_point - x).powi(2)
    }

    /// The centre of percussion of a bat swung about the point `pivot`: `pivot + I/(M d)`,
    /// `d` from the pivot to the balance point. None if the pivot is the balance point.
    pub fn center_of_percussion(&self, pivot: f64) -> Option<f64> {
        let arm = self.balance_point - pivot;
        let center = pivot + self.about(pivot) / (self.mass * arm);
        center.is_finite().then_some(center)
    }

    /// The bat as a line of mass: the rigid body of an Euler–Bernoulli beam.
    pub fn as_line(self) -> Self {
        Self { about_balance: self.line_about_balance, ..self }
    }
}
