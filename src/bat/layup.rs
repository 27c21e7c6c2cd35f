//! What are stiffness and mass per length of a section with one material around another?
//!
//! [`Layup::of`] makes one from a material, [`Layup::worth`] evaluates a section.

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

use crate::bat::material::{Material, ShearModuli};
use crate::bat::profile::Section;

/// The materials of a stretch of the bat: a tube or a solid rod, and the filling of the bore.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Layup {
    /// Material of the wall, from the bore to the surface.
    #[serde(rename = "material")]
    pub outer: Material,
    /// Material that fills the bore, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub core: Option<Material>,
    /// Layers around the wall, from the inside out. The outer radius of a section includes them.
    #[serde(rename = "layers", default, skip_serializing_if = "Vec::is_empty")]
    pub sleeves: Vec<Layer>,
    /// Mass of tape on the surface, which adds no stiffness (kg per m of bat).
    #[serde(skip)]
    pub tape: f64,
}

/// How empty the section is for a ring, and its derivatives by the wall's outer and inner radius (1/m).
#[derive(Debug, Clone, Copy)]
pub(super) struct Hole {
    pub share: f64,
    pub slopes: [f64; 2],
}

/// A layer around the wall, bonded to what is below it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Layer {
    /// Thickness of the layer (m).
    pub thickness: f64,
    /// Material of the layer.
    pub material: Material,
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
    /// One material and an empty bore.
    pub fn of(outer: Material) -> Self {
        Self { outer, core: None, sleeves: vec![], tape: 0.0 }
    }

    /// EI (N m²) and ρA (kg/m), the two properties of a section in the Euler–Bernoulli beam.
    #[inline(always)]
    pub fn bending_and_mass(&self, section: Section) -> [f64; 2] {
        let wall = self.wall(section);
        let (outer, area) = (&self.outer, wall.area());
        let (r, ri) = (wall.outer, wall.inner);
        let mut bending = outer.youngs_modulus * (area * (r * r + ri * ri) / 4.0);
        let mut mass = outer.density * area + self.tape;
        if let Some(core) = &self.core {
            let bore = section.bore();
            bending += core.youngs_modulus * bore.second_moment();
            mass += core.density * bore.area();
        }
        for (sleeve, ring) in self.rings(wall) {
            bending += sleeve.youngs_modulus * ring.second_moment();
            mass += sleeve.density * ring.area();
        }
        [bending, mass]
    }

    /// ρA (kg/m).
    #[inline(always)]
    pub fn mass(&self, section: Section) -> f64 {
        self.bending_and_mass(section)[1]
    }

    /// The section without the sleeves.
    #[inline(always)]
    pub(super) fn wall(&self, section: Section) -> Section {
        if self.sleeves.is_empty() {
            return section;
        }
        let sleeves: f64 = self.sleeves.iter().map(|sleeve| sleeve.thickness).sum();
        // At the edge of a wall that comes to a point, rounding must not make it negative.
        Section { outer: (section.outer - sleeves).max(section.inner), ..section }
    }

    /// The sleeves around that wall, from the inside out, each with its section.
    pub(super) fn rings(&self, wall: Section) -> impl Iterator<Item = (&Material, Section)> {
        self.sleeves.iter().scan(wall.outer, |inner, Layer { thickness, material }| {
            let ring = Section { outer: *inner + thickness, inner: *inner };
            *inner = ring.outer;
            Some((material, ring))
        })
    }

    /// Rotary inertia per length, ρI (kg m). Tape on the surface is a ring and adds `½ m r²`.
    #[inline(always)]
    pub fn turning(&self, section: Section) -> f64 {
        let ring = 0.5 * self.tape * section.outer * section.outer;
        let wall = self.wall(section);
        let own = self.outer.density * wall.second_moment() + ring;
        let inside = |core: &Material| core.density * section.bore().second_moment();
        let own = own + self.core.as_ref().map_or(0.0, inside);
        self.rings(wall)
            .fold(own, |sum, (sleeve, ring)| sum + sleeve.density * ring.second_moment())
    }

    /// All four values, summed over the layers; each layer bends about the bat's axis.
    ///
    /// `κGA` of the tube uses Cowper's κ with `m² (1 − G_core/G)` in place of `m²`, because the core fills the bore as
    /// far as it is stiff in shear. Without a core this is Cowper's tube, with a core of the same material the solid
    /// rod, and an interpolation between. With sleeves, every ring is a part of the whole section in the same way (see
    /// `hole`): layers of one material equal the tube that they form together.
    pub fn worth(&self, section: Section) -> Worth {
        let [bending, mass] = self.bending_and_mass(section);
        let turning = self.turning(section);
        let wall = self.wall(section);
        let [outer, inside] = self.shears(wall);
        let shear = self.shears_of_sleeves(wall).fold(outer + inside, |sum, ring| sum + ring);
        Worth { bending, mass, turning, shear }
    }

    /// Stiffness and mass of the wall alone, without core, sleeves and tape.
    pub fn worth_of_wall(&self, section: Section) -> Worth {
        let wall = self.wall(section);
        let Material { youngs_modulus, density, .. } = self.outer;
        let (area, second) = (wall.area(), wall.second_moment());
        Worth {
            bending: youngs_modulus * second,
            mass: density * area,
            turning: density * second,
            shear: self.shears(wall)[0],
        }
    }

    /// κGA (N) of the wall and of the core.
    fn shears(&self, wall: Section) -> [f64; 2] {
        let hole = match self.sleeves.is_empty() {
            true => (wall.inner / wall.outer).powi(2) * self.emptiness(),
            false => self.hole(wall, 0).share,
        };
        let bore = wall.bore();
        let core = self.core.as_ref().filter(|_| bore.outer > 0.0);
        let inside = core.map_or(0.0, |core| shear(core, bore.area(), 0.0));
        [shear(&self.outer, wall.area(), hole), inside]
    }

    /// κGA (N) of the sleeves around a wall.
    fn shears_of_sleeves(&self, wall: Section) -> impl Iterator<Item = f64> {
        self.rings(wall).enumerate().map(move |(k, (sleeve, ring))| {
            shear(sleeve, ring.area(), self.hole(wall, k + 1).share)
        })
    }

    /// The wall and the sleeves around it, from the inside out.
    pub(super) fn parts(&self, wall: Section) -> impl Iterator<Item = (&Material, Section)> {
        std::iter::once((&self.outer, wall)).chain(self.rings(wall))
    }

    /// The value in place of Cowper's `m² = (r_i/r)²` for one of [`Self::parts`]: how empty the section is for this
    /// part's shear modulus. With the unfilled share `u = 1 − G_other/G` (at least 0) of every other part, and `s` the
    /// difference of its squared radii,
    ///
    /// ```text
    /// h = (Σ_inside s u) / (r² + Σ_outside s (1 − u))
    /// ```
    pub(super) fn hole(&self, wall: Section, own: usize) -> Hole {
        let (material, section) = self.parts(wall).nth(own).unwrap_or((&self.outer, wall));
        let core = unfilled(material, self.core.as_ref());
        // Each with its derivatives by the wall's outer radius, with which the sleeves move, and by its inner radius.
        let mut empty = [wall.inner * wall.inner * core, 0.0, 2.0 * wall.inner * core];
        let mut whole = [section.outer * section.outer, 2.0 * section.outer, 0.0];
        for (k, (other, Section { outer, inner })) in self.parts(wall).enumerate() {
            let square = (outer - inner) * (outer + inner);
            let [moves, bores] = match k {
                0 => [2.0 * outer, -2.0 * inner],
                _ => [2.0 * (outer - inner), 0.0],
            };
            let unfilled = unfilled(material, Some(other));
            let (sum, share) = match k.cmp(&own) {
                Ordering::Less => (&mut empty, unfilled),
                Ordering::Equal => continue,
                Ordering::Greater => (&mut whole, 1.0 - unfilled),
            };
            sum.iter_mut().zip([square, moves, bores]).for_each(|(sum, by)| *sum += share * by);
        }
        let over = if whole[0] > 0.0 { 1.0 / whole[0] } else { 0.0 };
        let share = over * empty[0];
        Hole { share, slopes: [1, 2].map(|k| over * (empty[k] - share * whole[k])) }
    }

    /// `κG` of the core, as a share of the tube's G.
    pub(crate) fn core_in_shear(&self) -> f64 {
        let of = |core: &Material| {
            Some(core.kappa(0.0) * core.shear_modulus? / self.outer.shear_modulus?)
        };
        self.core.as_ref().and_then(of).unwrap_or(0.0)
    }

    /// How empty the bore is in shear: 1 without a core, 0 with a core as stiff as the tube.
    pub(crate) fn emptiness(&self) -> f64 {
        unfilled(&self.outer, self.core.as_ref())
    }

    /// The loss factors of the section in bending and in shear: the mean of the layers' loss factors, weighted with
    /// their share of the stiffness. That is their share of the strain energy, for all layers have one curvature and
    /// one shear strain.
    ///
    /// # Source
    ///
    /// E. E. Ungar, E. M. Kerwin, J. Acoust. Soc. Am. 34 (1962) 954: the loss factor of a
    /// composite is the mean of the parts' weighted with their strain energies.
    pub fn loss(&self, section: Section) -> [f64; 2] {
        let of_wall = self.outer.losses();
        if self.materials().all(|material| material.losses() == of_wall) {
            return of_wall;
        }
        let wall = self.wall(section);
        let [outer, core] = self.shears(wall);
        let inside = |core: &Material| core.youngs_modulus * wall.bore().second_moment();
        let bent = self.parts(wall).map(|(m, ring)| m.youngs_modulus * ring.second_moment());
        let bent = bent.chain(self.core.as_ref().map(inside));
        let sheared = std::iter::once(outer).chain(self.shears_of_sleeves(wall)).chain([core]);
        let losses = self.parts(wall).map(|(material, _)| material.losses());
        let losses: Vec<_> = losses.chain(self.core.as_ref().map(Material::losses)).collect();
        let mean = |strain: usize, stiff: Vec<f64>| {
            // If both are rigid in shear, neither has a share.
            let finite = stiff.iter().all(|k| k.is_finite());
            let whole: f64 = stiff.iter().sum();
            let parts = losses.iter().zip(&stiff).map(|(loss, k)| loss[strain] * k / whole);
            if finite { parts.sum() } else { of_wall[strain] }
        };
        [mean(0, bent.collect()), mean(1, sheared.collect())]
    }

    /// The material at the surface.
    pub fn surface(&self) -> &Material {
        self.sleeves.last().map_or(&self.outer, |sleeve| &sleeve.material)
    }

    /// The materials, that of the wall first.
    pub fn materials(&self) -> impl Iterator<Item = &Material> {
        let sleeves = self.sleeves.iter().map(|sleeve| &sleeve.material);
        std::iter::once(&self.outer).chain(&self.core).chain(sleeves)
    }

    /// The materials to be changed, that of the wall first.
    pub fn materials_mut(&mut self) -> impl Iterator<Item = &mut Material> {
        let sleeves = self.sleeves.iter_mut().map(|sleeve| &mut sleeve.material);
        std::iter::once(&mut self.outer).chain(&mut self.core).chain(sleeves)
    }

    /// Makes the materials heavier by one factor and stiffer by another; tape keeps its mass.
    pub fn scaled(&mut self, density: f64, modulus: f64) {
        for material in self.materials_mut() {
            material.density *= density;
            material.youngs_modulus *= modulus;
            let Material { shear_modulus, hoop_modulus, radial_modulus, shear_moduli, .. } =
                material;
            let single = [shear_modulus, hoop_modulus, radial_modulus];
            single.into_iter().flatten().for_each(|own| *own *= modulus);
            if let Some(ShearModuli { along_around, along_across, around_across }) = shear_moduli {
                for own in [along_around, along_across, around_across] {
                    *own *= modulus;
                }
            }
        }
    }
}

/// κGA (N) of a ring of that area (m²) whose `(r_i/r)²` is `hole`; infinite if G is not known.
fn shear(material: &Material, area: f64, hole: f64) -> f64 {
    match material.shear_modulus {
        Some(modulus) => material.kappa(hole) * modulus * area,
        None => f64::INFINITY,
    }
}

/// How empty a tube is in shear: 1 with an empty bore, 0 with a filling as stiff as the tube.
pub(super) fn unfilled(tube: &Material, inside: Option<&Material>) -> f64 {
    match (inside.and_then(|inside| inside.shear_modulus), tube.shear_modulus) {
        (Some(inside), Some(tube)) => (1.0 - inside / tube).max(0.0),
        _ => 1.0,
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

    /// All layers bend about one axis, so that rings of one material equal the tube that they form together.
    #[test]
    fn sleeves_of_the_wall_s_own_material_are_a_thicker_wall() {
        let section = Section { outer: 0.033, inner: 0.01 };
        let sleeves = [0.001, 0.002].map(|thickness| Layer { thickness, material: wood() }).into();
        let sleeved = Layup { sleeves, ..Layup::of(wood()) };
        let (thick, layered) = (Layup::of(wood()).worth(section), sleeved.worth(section));
        close(layered, thick);
        let solid = Section { outer: 0.033, inner: 0.0 };
        close(sleeved.worth(solid), Layup::of(wood()).worth(solid));
        let lossy = |loss: f64| Material { loss_factor: loss, ..wood() };
        let lossy_layer = Layer { thickness: 0.003, material: lossy(0.04) };
        let two = Layup { sleeves: vec![lossy_layer], ..Layup::of(lossy(0.04)) };
        assert!(two.loss(solid).iter().all(|loss| (loss - 0.04).abs() < 1e-15));
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
