//! In which units are numbers said?

use crate::base::number::rounded;
use crate::base::units::{FOOT_POUND, inches, miles_per_hour, ounce_square_inches, ounces};

/// Which units the tables are in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Units {
    /// SI alone.
    Si,
    /// US units alone.
    Us,
    /// Both, side by side.
    Both,
}

impl Units {
    /// A value in SI, in US units, or in both.
    pub fn show(self, si: String, us: String) -> String {
        match self {
            Self::Si => si,
            Self::Us => us,
            Self::Both => format!("{si:<18} {us}"),
        }
    }

    /// A length, given in metres.
    pub fn length(self, metres: f64) -> String {
        self.show(format!("{metres:.4} m"), format!("{:.2} in", inches(metres)))
    }

    /// A mass, given in kilograms.
    pub fn mass(self, kilograms: f64) -> String {
        self.show(format!("{kilograms:.4} kg"), format!("{:.2} oz", ounces(kilograms)))
    }

    /// A moment of inertia, given in kg m².
    pub fn inertia(self, value: f64) -> String {
        let us = format!("{:.0} oz in²", ounce_square_inches(value));
        self.show(format!("{value:.5} kg m²"), us)
    }

    /// A speed, given in m/s.
    pub fn speed(self, value: f64) -> String {
        let (si, us) = (rounded(value, 2), rounded(miles_per_hour(value), 1));
        self.show(format!("{si:.2} m/s"), format!("{us:.1} mph"))
    }

    /// What energies are counted in, and how many of it are a joule: joules unless US units alone are
    /// asked for.
    pub fn of_energy(self) -> (&'static str, f64) {
        if self == Self::Us { ("ft·lbf", 1.0 / FOOT_POUND) } else { ("J", 1.0) }
    }

    /// An energy, given in joules, with so many decimals.
    pub fn energy(self, value: f64, decimals: usize) -> String {
        let (name, per) = self.of_energy();
        format!("{:.decimals$} {name}", per * value)
    }

    /// A quantity of this type's other functions as running text: `0.0635 m (2.50 in)`.
    pub fn inline(self, value: String) -> String {
        match (self, value.split_once("   ")) {
            (Self::Both, Some((si, us))) => format!("{si} ({})", us.trim()),
            _ => value.split_whitespace().collect::<Vec<_>>().join(" "),
        }
    }

    /// A list of positions (m), a line per system of units.
    pub fn positions(self, places: &[f64]) -> Vec<String> {
        let list = |scale: f64, unit: &str| {
            let shown: Vec<String> = places.iter().map(|x| format!("{:.2}", x * scale)).collect();
            format!("{} {unit}", shown.join("  "))
        };
        let (si, us) = (list(100.0, "cm"), list(inches(1.0), "in"));
        match self {
            Self::Si => vec![si],
            Self::Us => vec![us],
            Self::Both => vec![si, us],
        }
    }
}
