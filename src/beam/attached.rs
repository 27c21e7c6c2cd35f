//! A single fixture on the bat: a point mass, the spring of a joint, a contact.
//!
//! A contact is anything that holds a deflection or a rotation: a support, a spring to ground, or one Legendre
//! coefficient of the deflection over an elastic bed. It may deflect by `√δ s`, where `s` is its strain and `δ = U/k` in
//! the unit of energy `U`. A support has `δ = 0`.

use crate::base::{Over, Real};

/// A strain in addition to those of the elements.
#[derive(Debug, Clone, Copy)]
pub struct Spring<S> {
    /// Index of the spring's strain among all strains.
    pub place: usize,
    /// `√(U/k)`: displacement (m or rad) for a strain of 1.
    pub softness: S,
}

/// A point mass, directly on the bat or on a spring.
#[derive(Debug, Clone, Copy)]
pub struct PointMass<S> {
    /// Distance of the point mass from the balance point, outwards (m).
    pub arm: S,
    /// Mass of the point (kg).
    pub mass: S,
    /// Distance from the fixing point to the centre of the mass, outwards (m).
    pub offset: S,
    /// Moment of inertia of the point mass about its own centre (kg m²).
    pub inertia: S,
    /// The spring that it hangs on; `None` if it is fixed to the bat.
    pub spring: Option<Spring<S>>,
}

/// A contact, which holds a deflection or a rotation.
#[derive(Debug, Clone, Copy)]
pub struct Contact<S> {
    /// Where it acts.
    pub at: At,
    /// Whether it holds the rotation; otherwise it holds the deflection.
    pub turning: bool,
    /// 1, or −1 if outwards is towards the knob and the contact holds a rotation.
    pub sign: S,
    /// Its spring; `None` if it is rigid.
    pub spring: Option<Spring<S>>,
}

/// Where a contact is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum At {
    /// At the border of two cells.
    Border,
    /// A Legendre coefficient of the deflection of a cell on an elastic bed.
    Bed,
}

impl<S: Real> PointMass<S> {
    /// Displacement and rotation of the mass, for a bat with deflection `w` and rotation `theta` here.
    pub fn displaced<R: Over<S>>(&self, w: R, theta: R, strains: &[R]) -> [R; 2] {
        let own = self.spring.map_or(R::default(), |s| strains[s.place] * s.softness);
        [w + theta * self.offset + own, theta]
    }

    /// Force and couple of its inertia on the bat, over ω².
    pub fn load<R: Over<S>>(&self, [moved, turned]: [R; 2]) -> [R; 2] {
        let force = moved * self.mass;
        [force, turned * self.inertia + force * self.offset]
    }
}

impl<S: Real> Contact<S> {
    /// Whether it belongs to an elastic bed.
    pub fn in_a_bed(&self) -> bool {
        self.at == At::Bed
    }

    /// Force and couple, outwards, of its reaction on the bat.
    pub fn on_the_bat<R: Over<S>>(&self, reaction: R) -> [R; 2] {
        match (self.at, self.turning) {
            (At::Bed, _) => [R::default(); 2],
            (At::Border, false) => [-reaction, R::default()],
            (At::Border, true) => [R::default(), -(reaction * self.sign)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_mass_moves_with_its_centre_and_its_spring() {
        let spring = Some(Spring { place: 1, softness: 0.5 });
        let mass = PointMass { arm: 0.3, mass: 2.0, offset: 0.1, inertia: 0.05, spring };
        let (w, theta, strains) = (0.2, 0.4, [7.0, 3.0]);
        let moved = w + 0.1 * theta + 0.5 * 3.0;
        let displaced = mass.displaced(w, theta, &strains);
        assert_eq!(displaced, [moved, theta]);
        // The work of the loads on the motion is twice the kinetic energy over ω².
        let ([force, couple], lifted) = (mass.load(displaced), moved - 0.1 * theta);
        let energy = mass.mass * moved * moved + mass.inertia * theta * theta;
        assert!((force * lifted + couple * theta - energy).abs() < 1e-15);
    }

    #[test]
    fn a_reaction_is_a_force_or_a_couple_where_it_is_at_a_border() {
        let contact = |at, turning| Contact {
            at,
            turning,
            sign: if turning { -1.0 } else { 1.0 },
            spring: None,
        };
        assert_eq!(contact(At::Border, false).on_the_bat(3.0), [-3.0, 0.0]);
        assert_eq!(contact(At::Border, true).on_the_bat(3.0), [0.0, 3.0]);
        assert_eq!(contact(At::Bed, false).on_the_bat(3.0), [0.0, 0.0]);
    }
}
