//! Where on the mesh are the fixtures?

use std::ops::Range;

use crate::base::Real;
use crate::bat::{Attachment, Bat, Fixtures, Held};
use crate::beam::attached::{At, Contact, PointMass, Spring};
use crate::beam::mesh::Mesh;
use crate::beam::sweep::Bare;
use crate::beam::walk::{Stop, What};

/// A bat's fixtures, each at its place on the mesh.
#[derive(Debug, Clone, Default)]
pub struct Placed<S> {
    /// Masses, on the bat itself or on springs.
    pub points: Vec<PointMass<S>>,
    /// Joints that are flexible in bending.
    pub joints: Vec<Spring<S>>,
    /// Contacts that hold a deflection or a rotation.
    pub contacts: Vec<Contact<S>>,
    /// Stops on the way outwards on the knob side and on the tip side, in this order.
    pub stops: [Vec<Stop>; 2],
    /// Number of strains that springs add to those of the elements.
    pub springs: usize,
    /// Places where the bat is clamped (m).
    pub clamps: Vec<f64>,
    /// Places where it is pinned (m).
    pub pins: Vec<f64>,
    /// The first contact of the bed under a cell; empty without a bed.
    beds: Vec<Option<usize>>,
}

impl<S: Real> Placed<S> {
    /// All fixtures of the bats, one bat in each lane, on meshes of one pattern. Several bats may have only masses, the
    /// same number at the same nodes.
    pub fn new(bare: &Bare<S>, bats: &[&Bat], mesh: &Mesh) -> Self {
        let bat = bats[0];
        let held = |kind: Held| {
            let supports = bat.fixtures().supports.iter().filter(|support| support.kind == kind);
            supports.map(|support| support.x).collect()
        };
        let [clamps, pins] = [held(Held::Clamped), held(Held::Pinned)];
        let mut placed = Self { clamps, pins, ..Self::default() };
        placed.add_joints(bare, bat, mesh);
        placed.add_points(bare, bats, mesh);
        placed.add_holds(bare, bat, mesh);
        placed.add_grip(bare, bat, mesh);
        // Outwards; of fixtures at one place, the knob's comes first seen from the knob, and last seen from the tip.
        let order = |side: usize, what: What| match what {
            What::Joint(_) => usize::from(side == 1) * 2,
            _ => 1,
        };
        for (side, stops) in placed.stops.iter_mut().enumerate() {
            stops.sort_by_key(|stop| (stop.after, order(side, stop.what)));
        }
        placed
    }

    /// The contacts of the bed under a cell, one for each of `terms` Legendre polynomials.
    pub fn bed(&self, cell: usize, terms: usize) -> Option<Range<usize>> {
        let first = self.beds.get(cell).copied().flatten()?;
        Some(first..first + terms)
    }

    /// Number of modes that may lie close together: every mass on a spring, and every stretch between contacts or
    /// joints, has its own.
    pub fn local(&self) -> usize {
        let hung = self.points.iter().filter(|point| point.spring.is_some()).count();
        hung + self.contacts.len() + self.joints.len()
    }

    /// A new strain for a spring of that stiffness (N/m or N m/rad).
    fn spring(&mut self, bare: &Bare<S>, stiffness: f64) -> Spring<S> {
        let place = bare.count * bare.strains + self.springs;
        self.springs += 1;
        Spring { place, softness: (bare.energy_unit / S::splat(stiffness)).sqrt() }
    }

    /// Adds a stop at node `node`; returns its side, 1 for the tip's.
    fn stop(&mut self, split: usize, node: usize, what: What) -> usize {
        // A joint at the root belongs to the tip side; all other fixtures there belong to the knob side.
        let tip_side = node > split || (node == split && matches!(what, What::Joint(_)));
        let after = if tip_side { node - split } else { split - node };
        self.stops[usize::from(tip_side)].push(Stop { after, what });
        usize::from(tip_side)
    }

    fn add_joints(&mut self, bare: &Bare<S>, bat: &Bat, mesh: &Mesh) {
        for joint in &bat.fixtures().joints {
            let spring = self.spring(bare, joint.rotational_stiffness);
            self.joints.push(spring);
            let what = What::Joint(self.joints.len() - 1);
            self.stop(bare.split, node_at(bat, mesh, joint.x), what);
        }
    }

    fn add_points(&mut self, bare: &Bare<S>, bats: &[&Bat], mesh: &Mesh) {
        let masses = |bat: &Bat| -> Vec<(Attachment, Option<f64>)> {
            let Fixtures { attachments, absorbers, .. } = bat.fixtures();
            let fixed = attachments.iter().filter(|a| a.mass + a.rotary_inertia > 0.0);
            let hung = absorbers.iter().map(|a| {
                let own = Attachment { x: a.x, mass: a.mass, ..Attachment::default() };
                (own, Some(a.stiffness))
            });
            fixed.map(|a| (*a, None)).chain(hung).collect()
        };
        let of_bats: Vec<_> = bats.iter().map(|bat| masses(bat)).collect();
        for (k, (first, stiffness)) in of_bats[0].iter().enumerate() {
            let number = |of: fn(&Attachment) -> f64| {
                let mut number = S::default();
                let lanes = of_bats.iter().enumerate();
                lanes.for_each(|(lane, masses)| number.set_lane(lane, of(&masses[k].0)));
                number
            };
            let what = What::PointMass(self.points.len());
            let side = self.stop(bare.split, node_at(bats[0], mesh, first.x), what);
            let spring = stiffness.map(|stiffness| self.spring(bare, stiffness));
            let outwards = S::splat(if side == 1 { 1.0 } else { -1.0 });
            self.points.push(PointMass {
                arm: outwards * (number(|a| a.x) - bare.balance),
                mass: number(|a| a.mass),
                offset: outwards * number(|a| a.offset),
                inertia: number(|a| a.rotary_inertia),
                spring,
            });
        }
    }

    /// Adds supports and springs to ground.
    fn add_holds(&mut self, bare: &Bare<S>, bat: &Bat, mesh: &Mesh) {
        let mut add = |x: f64, turning: bool, stiffness: Option<f64>| {
            let what = What::Contact(self.contacts.len());
            let side = self.stop(bare.split, node_at(bat, mesh, x), what);
            let spring = stiffness.map(|stiffness| self.spring(bare, stiffness));
            let sign = S::splat(if turning && side == 0 { -1.0 } else { 1.0 });
            self.contacts.push(Contact { at: At::Border, turning, sign, spring });
        };
        for support in &bat.fixtures().supports {
            add(support.x, false, None);
            if support.kind == Held::Clamped {
                add(support.x, true, None);
            }
        }
        for a in &bat.fixtures().attachments {
            let springs = [(false, a.stiffness), (true, a.rotational_stiffness)];
            for (turning, stiffness) in springs.into_iter().filter(|(_, k)| *k > 0.0) {
                add(a.x, turning, Some(stiffness));
            }
        }
    }

    /// Adds the elastic bed of the hands.
    fn add_grip(&mut self, bare: &Bare<S>, bat: &Bat, mesh: &Mesh) {
        let Some(grip) = bat.fixtures().grip.filter(|grip| grip.stiffness > 0.0) else { return };
        self.beds = vec![None; mesh.len()];
        for (cell, e) in in_grip(bat, mesh, bare.split) {
            self.beds[cell] = Some(self.contacts.len());
            for term in 0..bare.terms {
                // ∫P_k² dx.
                let share = mesh.elements[e].length / (2 * term + 1) as f64;
                let spring = Some(self.spring(bare, grip.stiffness * share));
                let (at, turning, sign) = (At::Bed, false, S::splat(1.0));
                self.contacts.push(Contact { at, turning, sign, spring });
            }
        }
    }
}

/// Index of the mesh's node at `x`, or nearest to it; the bat's pieces end there.
pub fn node_at(bat: &Bat, mesh: &Mesh, x: f64) -> usize {
    let pieces = &bat.profile().pieces;
    let start = |k: usize| pieces.get(k).map_or(bat.length(), |piece| piece.start);
    let above = pieces.partition_point(|piece| piece.start <= x).max(1);
    let piece = if x - start(above - 1) <= start(above) - x { above - 1 } else { above };
    mesh.elements.partition_point(|e| e.piece < piece)
}

/// The elements in the grip: index of the cell and of the element.
pub fn in_grip(bat: &Bat, mesh: &Mesh, split: usize) -> Vec<(usize, usize)> {
    let Some(grip) = &bat.fixtures().grip else { return vec![] };
    let held = |e: &usize| {
        let e = &mesh.elements[*e];
        let middle = e.start + 0.5 * e.length;
        middle > grip.from && middle < grip.to
    };
    let cell = |e: usize| if e < split { split - 1 - e } else { e };
    (0..mesh.len()).filter(held).map(|e| (cell(e), e)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_joint_at_the_root_is_on_the_tip_side_and_a_mass_there_on_the_knob_side() {
        let mut placed = Placed::<f64>::default();
        assert_eq!(placed.stop(3, 3, What::Joint(0)), 1);
        assert_eq!(placed.stop(3, 3, What::PointMass(0)), 0);
        assert_eq!(placed.stop(3, 1, What::PointMass(1)), 0);
        assert_eq!(placed.stop(3, 5, What::Joint(1)), 1);
        let after = placed.stops.map(|stops| stops.iter().map(|s| s.after).collect::<Vec<_>>());
        assert_eq!(after, [vec![0, 2], vec![0, 2]]);
    }
}
