//! In which units are numbers shown?

use sweetspot::base::number::{rounded, significant};
use sweetspot::base::units::{
    FOOT, FOOT_POUND, INCH, POUND_FORCE, PSI, inches, miles_per_hour, ounce_square_inches, ounces,
};
use sweetspot::bat::body::Bat;

/// Which units the tables are in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Units {
    /// SI alone.
    Si,
    /// US units alone.
    Us,
    /// Both, side by side, SI first.
    Both,
    /// Both, side by side, US units first.
    BothUsFirst,
}

impl Units {
    /// These units for a bat: where both systems are shown, that of the file of the bat comes first.
    pub fn of(self, bat: &Bat) -> Self {
        match self {
            Self::Both if bat.inches() => Self::BothUsFirst,
            asked => asked,
        }
    }

    /// Whether US units come first, or alone.
    pub fn us_first(self) -> bool {
        matches!(self, Self::Us | Self::BothUsFirst)
    }

    /// Whether both systems are shown.
    pub fn both(self) -> bool {
        matches!(self, Self::Both | Self::BothUsFirst)
    }

    /// The system that comes first, alone.
    pub fn first(self) -> Self {
        if self.us_first() { Self::Us } else { Self::Si }
    }

    /// The shown ones of two values, in SI and in US units, in order.
    pub fn pick<T>(self, si: T, us: T) -> Vec<T> {
        match self {
            Self::Si => vec![si],
            Self::Us => vec![us],
            Self::Both => vec![si, us],
            Self::BothUsFirst => vec![us, si],
        }
    }

    /// A value in SI, in US units, or in both.
    pub fn show(self, si: String, us: String) -> String {
        match &self.pick(si, us)[..] {
            [first, second] => format!("{first:<18} {second}"),
            one => one.concat(),
        }
    }

    /// A value in SI, in US units, or in both with the second in brackets.
    pub fn beside(self, si: String, us: String) -> String {
        match &self.pick(si, us)[..] {
            [first, second] => format!("{first} ({second})"),
            one => one.concat(),
        }
    }

    /// A stress, given in Pa, shown in MPa with that number of decimals and in whole psi.
    pub fn stress(self, pascals: f64, decimals: usize) -> String {
        let psi = format!("{:.0} psi", pascals / PSI);
        self.beside(format!("{:.decimals$} MPa", 1e-6 * pascals), psi)
    }

    /// A force, given in N, shown in kN with that number of decimals and in whole pounds.
    pub fn force(self, newtons: f64, decimals: usize) -> String {
        let us = format!("{:.0} lbf", newtons / POUND_FORCE);
        self.beside(format!("{:.decimals$} kN", 1e-3 * newtons), us)
    }

    /// A stiffness, given in N/m.
    pub fn stiffness(self, value: f64) -> String {
        let si = format!("{} MN/m", significant(1e-6 * value, 3));
        self.beside(si, format!("{} lbf/in", significant(value * INCH / POUND_FORCE, 3)))
    }

    /// A length, given in metres.
    pub fn length(self, metres: f64) -> String {
        self.show(format!("{metres:.4} m"), format!("{:.2} in", inches(metres)))
    }

    /// A place, given in metres, shown in cm and in inches with that number of decimals, as running text.
    pub fn place(self, metres: f64, decimals: usize) -> String {
        let si = format!("{:.decimals$} cm", 100.0 * metres);
        self.beside(si, format!("{:.decimals$} in", inches(metres)))
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

    /// The unit of energies, and its number per joule: joules unless only US units are requested.
    pub fn of_energy(self) -> (&'static str, f64) {
        if self == Self::Us { ("ft·lbf", 1.0 / FOOT_POUND) } else { ("J", 1.0) }
    }

    /// An energy (J) with the given number of decimals.
    pub fn energy(self, value: f64, decimals: usize) -> String {
        let (name, per) = self.of_energy();
        format!("{:.decimals$} {name}", per * value)
    }

    /// A quantity of this type's other functions as running text: `0.0635 m (2.50 in)`.
    pub fn inline(self, value: String) -> String {
        match value.split_once("   ") {
            Some((first, second)) if self.both() => format!("{first} ({})", second.trim()),
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
        self.pick(si, us)
    }
}

/// The trade's unit for an SI unit, and its number per SI unit; unchanged unless `us`.
pub fn in_trade(unit: &str, us: bool) -> (&str, f64) {
    match unit {
        "m" if us => ("in", inches(1.0)),
        "kg" if us => ("oz", ounces(1.0)),
        "kg m²" | "kg_m2" if us => ("oz in²", ounce_square_inches(1.0)),
        "m/s" if us => ("mph", miles_per_hour(1.0)),
        "m/s²" if us => ("ft/s²", 1.0 / FOOT),
        unit => (unit, 1.0),
    }
}
