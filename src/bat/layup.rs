//! What is a section worth: stiffness and mass per length of one material around another?
//!
//! [`Layup::of`] a material, [`Layup::worth`] of a section.

use serde::{Deserialize, Serialize};

use crate::bat::material::Material;
use crate::bat::profile::Section;

/// The materials of a stretch of the bat: a tube, or a solid rod, and what fills the bore.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "show", derive(schemars::JsonSchema))]
pub struct Layup {
    /// Material of the wall, from the bore to the surface.
    #[serde(rename = "material")]
    pub outer: Material,
    /// Material that fills the bore, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub core: Option<Material>,
    /// Mass of tape on the surface, which adds no stiffness (kg per m of bat).
    #[serde(skip)]
    pub tape: f64,
}

/// Stiffness and mass of a section, per length of bat.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Worth {
    /// Bending stiffness EI (N m²).
    pub bending: f64,
    /// Mass per length ρA (kg/m).
    pub mass: f64,
    /// Rotary inertia per length ρI (kg m).
    pub turning: f64,
    /// Shear stiffness κGA (N); infinite if a shear modulus is not known.
    pub shear: f64,
}

impl Layup {
    /// One material and nothing in the bore.
    pub fn of(outer: Material) -> Self {
        Self { outer, core: None, tape: 0.0 }
    }

    /// EI (N m²) and ρA (kg/m): all that the Euler–Bernoulli beam knows of a section.
    #[inline(always)]
    pub fn bending_and_mass(&self, section: Section) -> [f64; 2] {
        let (outer, area) = (&self.outer, section.area());
        let (r, ri) = (section.outer, section.inner);
        let mut bending = outer.youngs_modulus * (area * (r * r + ri * ri) / 4.0);
        let mut mass = outer.density * area + self.tape;
        if let Some(core) = &self.core {
            let bore = section.bore();
            bending += core.youngs_modulus * bore.second_moment();
            mass += core.density * bore.area();
        }
        [bending, mass]
    }

    /// ρI (kg m): the rotary inertia per length; of tape on the surface, a ring, `½ m r²`.
    #[inline(always)]
    pub fn turning(&self, section: Section) -> f64 {
        let ring = 0.5 * self.tape * section.outer * section.outer;
        let own = self.outer.density * section.second_moment() + ring;
        let inside = |core: &Material| core.density * section.bore().second_moment();
        own + self.core.as_ref().map_or(0.0, inside)
    }

    /// All four: those of the layers added, each layer bending about the bat's axis.
    ///
    /// `κGA` of the tube is with the κ of a tube whose bore is filled in the measure that the core
    /// is as stiff in shear, `m² (1 − G_core/G)` in the place of `m²`: Cowper's tube where there is
    /// no core, the solid rod where it is of the same material, an interpolation between.
    pub fn worth(&self, section: Section) -> Worth {
        let [bending, mass] = self.bending_and_mass(section);
        let turning = self.turning(section);
        let [outer, inside] = self.shears(section);
        Worth { bending, mass, turning, shear: outer + inside }
    }

    /// κGA (N) of the outer layer and of the core.
    fn shears(&self, section: Section) -> [f64; 2] {
        let hole = (section.inner / section.outer).powi(2);
        let shear = |material: &Material, area: f64, hole: f64| match material.shear_modulus {
            Some(modulus) => material.kappa(hole) * modulus * area,
            None => f64::INFINITY,
        };
        let bore = section.bore();
        let core = self.core.as_ref().filter(|_| bore.outer > 0.0);
        let inside = core.map_or(0.0, |core| shear(core, bore.area(), 0.0));
        [shear(&self.outer, section.area(), hole * self.emptiness()), inside]
    }

    /// `κG` of the core, as a share of the tube's G.
    pub(crate) fn core_in_shear(&self) -> f64 {
        let of = |core: &Material| {
            Some(core.kappa(0.0) * core.shear_modulus? / self.outer.shear_modulus?)
        };
        self.core.as_ref().and_then(of).unwrap_or(0.0)
    }

    /// How empty the bore is of what bears shear: 1 without a core, 0 with one as stiff as the tube.
    pub(crate) fn emptiness(&self) -> f64 {
        let of_core = self.core.as_ref().and_then(|core| core.shear_modulus);
        match (of_core, self.outer.shear_modulus) {
            (Some(of_core), Some(of_tube)) => (1.0 - of_core / of_tube).max(0.0),
            _ => 1.0,
        }
    }

    /// The loss factors of the section in bending and in shear: those of the layers, each weighted
    /// with its share of the stiffness, for all layers have one curvature and one shear strain.
    /// The layers share the strain energy in the proportion of their stiffness.
    ///
    /// # Source
    ///
    /// E. E. Ungar, E. M. Kerwin, J. Acoust. Soc. Am. 34 (1962) 954: the loss factor of a
    /// composite is the mean of the parts' weighted with their strain energies.
    pub fn loss(&self, section: Section) -> [f64; 2] {
        let own = self.outer.loss_factor;
        let Some(core) = self.core.as_ref().filter(|core| core.loss_factor != own) else {
            return [own; 2];
        };
        let inside = core.youngs_modulus * section.bore().second_moment();
        let share = inside / self.bending_and_mass(section)[0];
        let [outer, inner] = self.shears(section);
        // Of two that do not give way in shear neither has a share.
        let sheared = if outer.is_finite() { inner / (outer + inner) } else { 0.0 };
        let sheared = if sheared.is_finite() { sheared } else { 1.0 };
        [share, sheared].map(|share| own + share * (core.loss_factor - own))
    }

    /// The materials, the outer one first.
    pub fn materials(&self) -> impl Iterator<Item = &Material> {
        std::iter::once(&self.outer).chain(&self.core)
    }

    /// Makes the materials heavier by one factor and stiffer by another; tape keeps its mass.
    pub fn scaled(&mut self, density: f64, modulus: f64) {
        for material in std::iter::once(&mut self.outer).chain(&mut self.core) {
            material.density *= density;
            material.youngs_modulus *= modulus;
            material.shear_modulus.iter_mut().for_each(|shear| *shear *= modulus);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wood() -> Material {
        let mut wood = Material::new(650.0, 15e9).unwrap();
        wood.shear_modulus = Some(1e9);
        wood
    }

    fn close(a: Worth, b: Worth) {
        for (a, b) in
            [(a.bending, b.bending), (a.mass, b.mass), (a.turning, b.turning), (a.shear, b.shear)]
        {
            assert!((a / b - 1.0).abs() < 1e-14, "{a} {b}");
        }
    }

    #[test]
    fn a_bore_filled_with_its_own_material_and_one_of_no_size_are_solid() {
        let solid = Layup::of(wood()).worth(Section { outer: 0.03, inner: 0.0 });
        let filled = Layup { core: Some(wood()), ..Layup::of(wood()) };
        close(filled.worth(Section { outer: 0.03, inner: 0.02 }), solid);
        close(filled.worth(Section { outer: 0.03, inner: 0.0 }), solid);
        close(Layup::of(wood()).worth(Section { outer: 0.03, inner: 1e-12 }), solid);
    }

    /// Cowper's κ of a thin tube is `2(1 + ν)/(4 + 3ν)`; `EI/ρA` of a thin wall is `E r²/2ρ`.
    #[test]
    fn a_thin_wall_has_the_limits_of_the_textbooks() {
        let r: f64 = 0.03;
        let worth = Layup::of(wood()).worth(Section { outer: r, inner: r * (1.0 - 1e-9) });
        assert!((worth.bending / worth.mass / (15e9 * r * r / 1300.0) - 1.0).abs() < 1e-8);
        let area = worth.mass / 650.0;
        assert!((worth.shear / (1e9 * area) / (2.6 / 4.9) - 1.0).abs() < 1e-8);
    }

    #[test]
    fn a_core_that_bears_nothing_leaves_the_tube() {
        let mut air = Material::new(1e-20, 1e-20).unwrap();
        air.shear_modulus = Some(1e-20);
        let section = Section { outer: 0.03, inner: 0.025 };
        let tube = Layup::of(wood()).worth(section);
        close(Layup { core: Some(air), ..Layup::of(wood()) }.worth(section), tube);
    }
}
