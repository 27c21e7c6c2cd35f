//! How much stiffness and mass does a section lose per millimetre that is taken off?
//!
//! [`Layup::slopes`] is the derivative of [`Layup::worth`] by the outer and by the inner radius, for constant material
//! and sleeves:
//!
//! ```text
//! ∂EI/∂r = Eπr³    ∂ρA/∂r = 2πρr    ∂ρI/∂r = πρr³    ∂κGA/∂r = 2πκGr + GA ∂κ/∂h ∂h/∂r
//! ```
//!
//! The derivatives by r_i are the same but negative. Here h is the value in place of `(r_i/r)²`. Layers add.

use std::f64::consts::PI;

use crate::bat::layup::{Layup, Worth};
use crate::bat::material::Material;
use crate::bat::profile::Section;

/// A ring of one material, and how far its two radii move with the radius that is changed.
struct MovedRing<'a> {
    material: &'a Material,
    section: Section,
    /// Of the outer and of the inner radius, 0 or 1.
    moves: [f64; 2],
    /// The value in place of `m²` in its κ, and its derivative by the radius that is changed (1/m).
    hole: f64,
    widens: f64,
}

impl MovedRing<'_> {
    /// Derivatives of the ring's values, per metre of radius.
    fn slope(&self) -> Worth {
        let Self {
            material,
            section: Section { outer: r, inner: ri },
            moves: [out, inside],
            hole,
            widens,
        } = *self;
        let area = 2.0 * PI * (out * r - inside * ri);
        let second = PI * (out * r.powi(3) - inside * ri.powi(3));
        let shear = material.shear_modulus.map_or(0.0, |modulus| {
            let [kappa, by_hole] = [material.kappa(hole), material.kappa_slope(hole)];
            modulus * (kappa * area + self.section.area() * by_hole * widens)
        });
        Worth {
            bending: material.youngs_modulus * second,
            mass: material.density * area,
            turning: material.density * second,
            shear,
        }
    }
}

impl Layup {
    /// Derivatives of a section's values by its outer radius and by its inner radius (each number of a [`Worth`], per
    /// m). The shear stiffness of a material without a known shear modulus does not change.
    pub fn slopes(&self, section: Section) -> [Worth; 2] {
        let wall = self.wall(section);
        // The outer radius moves both radii of every sleeve. The bore moves only the wall's, and the filling of all.
        let moved = |of: usize, moves: [[f64; 2]; 2]| {
            let ring = |k: usize, material, section| {
                let (hole, moves) = (self.hole(wall, k), moves[k.min(1)]);
                MovedRing { material, section, moves, hole: hole.share, widens: hole.slopes[of] }
                    .slope()
            };
            let parts = self.parts(wall).enumerate();
            parts.fold(Worth::default(), |sum, (k, (material, section))| {
                plus(sum, ring(k, material, section))
            })
        };
        let taped = Worth { turning: self.tape * section.outer, ..Worth::default() };
        let outer = plus(moved(0, [[1.0, 0.0], [1.0; 2]]), taped);
        let inner = moved(1, [[0.0, 1.0], [0.0; 2]]);
        let bore = |material| {
            let (section, moves) = (wall.bore(), [1.0, 0.0]);
            MovedRing { material, section, moves, hole: 0.0, widens: 0.0 }.slope()
        };
        [outer, self.core.as_ref().map_or(inner, |core| plus(inner, bore(core)))]
    }
}

/// The sum of both.
fn plus(a: Worth, b: Worth) -> Worth {
    Worth {
        bending: a.bending + b.bending,
        mass: a.mass + b.mass,
        turning: a.turning + b.turning,
        shear: a.shear + b.shear,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bat::layup::Layer;

    fn wood(shear: f64) -> Material {
        let mut wood = Material::new(650.0, 15e9).unwrap();
        wood.shear_modulus = Some(shear);
        wood
    }

    /// Compared with central differences of the section's values, for a solid rod, a tube, a filled tube, and one with
    /// tape and sleeves.
    #[test]
    fn the_slopes_are_those_of_the_section_s_worth() {
        let mut cork = Material::new(200.0, 3e7).unwrap();
        cork.shear_modulus = Some(1e7);
        let plain = Layup::of(wood(1e9));
        let filled = Layup { core: Some(cork), tape: 0.03, ..Layup::of(wood(1e9)) };
        let sleeves = [(4e9, 0.001), (2e8, 0.002)]
            .map(|(shear, thickness)| Layer { thickness, material: wood(shear) })
            .into();
        let sleeved = Layup { sleeves, ..filled.clone() };
        for layup in [plain, filled, sleeved] {
            for inner in [0.0, 0.01, 0.02] {
                for which in [0, 1] {
                    let at = |step: f64| {
                        let moved = |k: usize| if k == which { step } else { 0.0 };
                        let section = Section { outer: 0.03 + moved(0), inner: inner + moved(1) };
                        let Worth { bending, mass, turning, shear } = layup.worth(section);
                        [bending, mass, turning, shear]
                    };
                    if which == 1 && inner == 0.0 {
                        continue;
                    }
                    let h = 1e-6;
                    let slope = layup.slopes(Section { outer: 0.03, inner })[which];
                    let slope = [slope.bending, slope.mass, slope.turning, slope.shear];
                    for ((ahead, behind), slope) in at(h).into_iter().zip(at(-h)).zip(slope) {
                        let found = (ahead - behind) / (2.0 * h);
                        assert!(
                            (found / slope - 1.0).abs() < 1e-7,
                            "{which} {inner} {found} {slope}"
                        );
                    }
                }
            }
        }
    }
}
