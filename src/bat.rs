//! What bat is this; is it physical; its mass, balance point and swing weight.

use crate::error::{Error, Result};
use crate::material::Material;
use crate::profile::{Profile, Radii, Section};
use crate::quadrature::{RunningSum, converged, gauss};

/// Where standards hold a bat to measure its swing weight: 6 in from the knob end (m).
pub const STANDARD_PIVOT: f64 = 0.1524;

/// A bat: a shape and a material, checked, so that no later stage checks again.
#[derive(Debug, Clone, PartialEq)]
pub struct Bat {
    pub name: String,
    /// Where its numbers come from.
    pub source: String,
    pub profile: Profile,
    /// The material; its density is the weighed one where a weighed mass was given.
    pub material: Material,
    /// What a scale said (kg), if it was asked.
    pub weighed_mass: Option<f64>,
}

/// What a bat is as a rigid body; positions from the knob end, inertias transverse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inertia {
    /// Mass M (kg).
    pub mass: f64,
    /// Centre of mass (m).
    pub balance_point: f64,
    /// The body's moment of inertia about the balance point (kg m²), as a pendulum measures it.
    pub about_balance: f64,
    /// The same of the bat as a line of mass, without the sections' own `∫ρI dx` (kg m²):
    /// what an Euler–Bernoulli beam swings with.
    pub line_about_balance: f64,
}

impl Bat {
    /// A bat of a shape and a material; a weighed mass (kg) sets the density.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] if the mass or the stiffness is beyond the range of numbers.
    pub fn new(
        name: impl Into<String>,
        profile: Profile,
        material: Material,
        weighed_mass: Option<f64>,
    ) -> Result<Self> {
        let (name, source) = (name.into(), String::new());
        let mut bat = Self { name, source, profile, material, weighed_mass };
        if let Some(mass) = weighed_mass {
            bat.check_range()?;
            bat.material.density *= mass / bat.inertia().mass;
        }
        bat.check_range()?;
        Ok(bat)
    }

    /// From the knob end to the tip (m).
    pub fn length(&self) -> f64 {
        self.profile.length()
    }

    /// Bending stiffness EI (N m²) of a section.
    pub fn bending_stiffness(&self, section: Section) -> f64 {
        self.material.youngs_modulus * section.second_moment()
    }

    /// Mass per length ρA (kg/m) of a section.
    pub fn mass_per_length(&self, section: Section) -> f64 {
        self.material.density * section.area()
    }

    /// Mass, balance point and moments of inertia, exact by quadrature.
    ///
    /// `M = ∫ρA dx`, `x_b = ∫ρA x dx / M`, `I = ∫ρA (x − x_b)² dx + ∫ρI dx`; cubic radii make
    /// the integrands of degree 8 and 12, which five and seven Gauss points integrate exactly.
    /// Formulas take as many points as agree to 2e-14.
    pub fn inertia(&self) -> Inertia {
        let rule = gauss(7);
        let integral = |f: &dyn Fn(f64, Section) -> f64| {
            let mut total = RunningSum::<f64>::default();
            for piece in &self.profile.pieces {
                let at = |s: f64| f(piece.start + s * piece.length, piece.at(s));
                match piece.radii {
                    Radii::Cubic(_) => {
                        rule.iter()
                            .for_each(|(s, weight)| total.add(weight * piece.length * at(*s)));
                    }
                    Radii::Formula(_) => {
                        total.add(piece.length * converged(|s| [at(s)]).values[0]);
                    }
                }
            }
            self.material.density * total.value()
        };
        let mass = integral(&|_, section| section.area());
        let balance_point = integral(&|x, section| x * section.area()) / mass;
        let line = integral(&|x, section| (x - balance_point).powi(2) * section.area());
        let own = integral(&|_, section| section.second_moment());
        Inertia { mass, balance_point, about_balance: line + own, line_about_balance: line }
    }

    /// Possible but strange for a bat: one sentence each, to be shown and not to stop anybody.
    pub fn warnings(&self) -> Vec<String> {
        let inertia = self.inertia();
        let widest = self.profile.stations.outer.iter().fold(0.0_f64, |a, b| a.max(*b));
        let Material { density, youngs_modulus, .. } = self.material;
        let checks = [
            ("length", self.length(), "m", 0.3, 1.2, ""),
            ("largest radius", widest, "m", 0.01, 0.05, " (a diameter given as radius?)"),
            ("mass", inertia.mass, "kg", 0.2, 2.0, ""),
            ("density", density, "kg/m³", 50.0, 20e3, " (wood is 400 to 900: g/cm³ or lb/in³?)"),
            ("youngs_modulus", youngs_modulus, "Pa", 1e9, 1e12, " (wood is 8e9 to 20e9: GPa?)"),
        ];
        checks
            .into_iter()
            .filter(|(_, value, _, low, high, _)| value < low || value > high)
            .map(|(what, value, unit, low, high, hint)| {
                let (value, low, high) = (plain(value), plain(low), plain(high));
                format!("{what} is {value} {unit}; a bat's is {low} to {high}{hint}")
            })
            .collect()
    }

    /// Mass, stiffness and the frequencies they make must be numbers a computer can hold.
    fn check_range(&self) -> Result<()> {
        let Inertia { mass, balance_point, about_balance, line_about_balance } = self.inertia();
        let widest = self.profile.stations.outer.iter().fold(0.0_f64, |a, b| a.max(*b));
        let section = Section { outer: widest, inner: 0.0 };
        let stiffness = self.bending_stiffness(section);
        let scale = stiffness / self.mass_per_length(section) / self.length().powi(4);
        for (what, value, unit) in [
            ("mass", mass, "kg"),
            ("balance point", balance_point, "m"),
            ("moment of inertia", about_balance, "kg m²"),
            ("moment of inertia as a line", line_about_balance, "kg m²"),
            ("bending stiffness", stiffness, "N m²"),
            ("frequency scale EI/(ρA L⁴)", scale, "1/s²"),
        ] {
            // Far enough inside the range for products of two such values.
            if !(value > 1e-100 && value < 1e100) {
                let found = match value.is_finite() {
                    true => format!("{value:e} {unit}"),
                    false => "a value beyond the range of numbers".to_owned(),
                };
                let expected = "a value between 1e-100 and 1e100: check the units";
                return Err(Error::value(what, found, expected));
            }
        }
        Ok(())
    }
}

/// Four digits, with a power of ten where the plain number would be a row of zeros.
fn plain(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().expect("it was written as a number");
    if (1e-3..1e5).contains(&rounded.abs()) { rounded.to_string() } else { format!("{rounded:e}") }
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

    /// The bat as a line of mass: what an Euler–Bernoulli beam has for a rigid body.
    pub fn as_line(self) -> Self {
        Self { about_balance: self.line_about_balance, ..self }
    }
}
