//! How stiff is a material in all directions?

use crate::base::linear::inverse;
use crate::base::{Error, Result};
use crate::bat::{Material, PoissonRatios, ShearModuli};

/// Poisson's ratio assumed for a metal whose own is not known.
pub const ASSUMED_POISSON_RATIO: f64 = 0.33;

/// Stiffness of a material in the directions of a bat: r across the wall, θ around, x along.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    /// Stresses per strain, in the order rr, θθ, xx (Pa).
    pub normal: [[f64; 3]; 3],
    /// Shear modulus between x and r (Pa).
    pub shear_xr: f64,
    /// Shear modulus between r and θ (Pa).
    pub shear_rt: f64,
    /// Shear modulus between x and θ (Pa).
    pub shear_xt: f64,
    /// Density ρ (kg/m³).
    pub density: f64,
    /// Loss factor η.
    pub loss_factor: f64,
}

/// Poisson's ratio of an isotropic material: its own, else `ν = E/2G − 1` if that is possible, else `None`.
pub fn poisson_ratio(material: &Material) -> Option<f64> {
    let of_shear = |shear: f64| 0.5 * material.youngs_modulus / shear - 1.0;
    let possible = |ratio: &f64| (0.0..0.5).contains(ratio);
    material.poisson_ratio.or_else(|| material.shear_modulus.map(of_shear).filter(possible))
}

impl Elastic {
    /// An isotropic material, by Lamé's constants: `λ = Eν/((1 + ν)(1 − 2ν))`, `μ = E/(2(1 + ν))`.
    pub fn isotropic(material: &Material, poisson_ratio: f64) -> Self {
        let (e, nu) = (material.youngs_modulus, poisson_ratio);
        let shear = 0.5 * e / (1.0 + nu);
        let lambda = e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
        let normal = std::array::from_fn(|i| {
            std::array::from_fn(|j| lambda + if i == j { 2.0 * shear } else { 0.0 })
        });
        let (density, loss_factor) = (material.density, material.loss_factor);
        Self { normal, shear_xr: shear, shear_rt: shear, shear_xt: shear, density, loss_factor }
    }

    /// An orthotropic composite: the inverse of the compliance with the diagonal `1/E_r`, `1/E_θ`, `1/E_x` and the
    /// off-diagonal terms `−ν_xθ/E_x`, `−ν_xr/E_x`, `−ν_θr/E_θ`. `None` for a material that gives no such moduli.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] if the compliance is not positive definite: the ratios are too large for these moduli.
    ///
    /// # Source
    ///
    /// R. M. Jones, Mechanics of Composite Materials (2nd ed., 1999), section 2.3.
    pub fn orthotropic(material: &Material) -> Result<Option<Self>> {
        let Material { hoop_modulus, radial_modulus, shear_moduli, poisson_ratios, .. } = material;
        let (Some(around), Some(across)) = (*hoop_modulus, *radial_modulus) else {
            return Ok(None);
        };
        let (Some(shear), Some(ratios)) = (*shear_moduli, *poisson_ratios) else { return Ok(None) };
        let along = material.youngs_modulus;
        let ShearModuli { along_around, along_across, around_across } = shear;
        let (shear_xt, shear_xr, shear_rt) = (along_around, along_across, around_across);
        let PoissonRatios { along_around, along_across, around_across } = ratios;
        let (rt, rx, tx) = (-around_across / around, -along_across / along, -along_around / along);
        let compliance =
            [vec![1.0 / across, rt, rx], vec![rt, 1.0 / around, tx], vec![rx, tx, 1.0 / along]];
        let Some(stiffness) = inverse(&compliance) else {
            let found = format!("{along_around}, {along_across}, {around_across}");
            let expected = "ratios that leave a positive stiffness with these moduli: the square of each \
                            below its first modulus over its second";
            return Err(Error::value("poisson_ratios", found, expected));
        };
        let normal = std::array::from_fn(|i| std::array::from_fn(|j| stiffness[i][j]));
        let (density, loss_factor) = (material.density, material.loss_factor);
        Ok(Some(Self { normal, shear_xr, shear_rt, shear_xt, density, loss_factor }))
    }
}
