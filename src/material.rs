//! How stiff, how heavy: materials by numbers or by name.

use crate::error::{Error, Result};

/// A material, along the bat's axis where it is wood.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// The built-in name, if it has one.
    pub name: Option<String>,
    /// Density ρ (kg/m³).
    pub density: f64,
    /// Young's modulus E (Pa).
    pub youngs_modulus: f64,
    /// Shear modulus G (Pa), if known.
    pub shear_modulus: Option<f64>,
    /// Poisson's ratio ν, if it was given.
    pub poisson_ratio: Option<f64>,
    /// Timoshenko's shear coefficient κ, if it was given.
    pub shear_coefficient: Option<f64>,
    /// Loss factor η; a mode's damping ratio is ζ = η/2.
    pub loss_factor: f64,
}

impl Material {
    /// A material known by density (kg/m³) and Young's modulus (Pa) alone.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] if one of them is not a positive number.
    pub fn new(density: f64, youngs_modulus: f64) -> Result<Self> {
        let material = Self {
            name: None,
            density,
            youngs_modulus,
            shear_modulus: None,
            poisson_ratio: None,
            shear_coefficient: None,
            loss_factor: 0.0,
        };
        material.check()?;
        Ok(material)
    }

    /// Every value in its possible range: ρ, E, G, κ positive, η not negative, −1 < ν ≤ ½.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] with the key of the bat file as its field.
    pub fn check(&self) -> Result<()> {
        let positive = |key: &str, value: Option<f64>, unit: &str| match value {
            Some(v) if !(v > 0.0 && v.is_finite()) => {
                Err(Error::value(key, format!("{v} {unit}").trim(), "a number above 0"))
            }
            _ => Ok(()),
        };
        positive("density", Some(self.density), "kg/m³")?;
        positive("youngs_modulus", Some(self.youngs_modulus), "Pa")?;
        positive("shear_modulus", self.shear_modulus, "Pa")?;
        positive("shear_coefficient", self.shear_coefficient, "")?;
        if !(self.loss_factor >= 0.0 && self.loss_factor < 2.0) {
            let expected = "0 or more and below 2 (a damping ratio below 1)";
            return Err(Error::value("loss_factor", self.loss_factor, expected));
        }
        match self.poisson_ratio {
            Some(nu) if !(nu > -1.0 && nu <= 0.5) => {
                Err(Error::value("poisson_ratio", nu, "a number above -1, 0.5 at most"))
            }
            _ => Ok(()),
        }
    }

    /// The built-in material of that name.
    pub fn named(name: &str) -> Option<Self> {
        BUILT_IN.iter().find(|m| m.name == name).map(|m| Self {
            name: Some(m.name.to_owned()),
            density: m.density,
            youngs_modulus: m.youngs_modulus,
            shear_modulus: m.shear_modulus,
            poisson_ratio: None,
            shear_coefficient: None,
            loss_factor: 0.0,
        })
    }
}

/// One entry of the built-in list: SI values and where they come from.
#[derive(Debug, Clone, Copy)]
pub struct BuiltIn {
    pub name: &'static str,
    pub density: f64,
    pub youngs_modulus: f64,
    pub shear_modulus: Option<f64>,
    pub source: &'static str,
}

/// The built-in materials. Handbook values come from slow bending tests of small clear pieces;
/// the `-dynamic` ones are what made models of real bats ring at their measured frequencies,
/// 20 to 50 % stiffer. The two kinds are kept apart, so that nobody mixes them unawares.
pub const BUILT_IN: &[BuiltIn] = &[
];
