//! What is fixed to the bat, and what holds it: weights, tape, springs, supports, hands, joints?
//!
//! Fill in [`Fixtures`], with all places in metres from the knob end, and give it to
//! [`crate::bat::body::Builder::build`].

use serde::{Deserialize, Serialize};

use crate::bat::layup::Layup;
use crate::bat::profile::SAME_PLACE;

/// Everything on a bat besides its shape and its material.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Fixtures {
    /// Stretches of other materials.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub regions: Vec<Region>,
    /// Weights and springs to ground.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub attachments: Vec<Attachment>,
    /// Bat tape: mass without stiffness.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tapes: Vec<Tape>,
    /// Masses that hang on springs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub absorbers: Vec<Absorber>,
    /// Joints that are flexible in bending.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<Joint>,
    /// Places that are held.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub supports: Vec<Support>,
    /// Hands that hold the bat as an elastic bed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grip: Option<Grip>,
}

/// A stretch of other materials.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Region {
    /// Where the region begins (m).
    pub from: f64,
    /// Where the region ends (m).
    pub to: f64,
    /// Materials of the region.
    #[serde(flatten)]
    pub layup: Layup,
}

/// A point mass and springs to ground.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Attachment {
    /// Where the attachment is fixed (m).
    pub x: f64,
    /// Mass of the attachment (kg).
    pub mass: f64,
    /// Moment of inertia of the mass about its own centre (kg m²).
    pub rotary_inertia: f64,
    /// Distance from `x` to the centre of the mass, positive towards the barrel (m).
    pub offset: f64,
    /// Spring from the bat at `x` to the ground, against deflection (N/m).
    pub stiffness: f64,
    /// Spring from the bat at `x` to the ground, against rotation (N m/rad).
    pub rotational_stiffness: f64,
}

/// Bat tape: a mass spread evenly on the surface of a stretch, without stiffness.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Tape {
    /// Where the tape begins (m).
    pub from: f64,
    /// Where the tape ends (m).
    pub to: f64,
    /// Mass of the whole tape (kg).
    pub mass: f64,
}

/// A mass on a spring and a dashpot, which hang on the bat: a tuned absorber.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Absorber {
    /// Where the absorber hangs (m).
    pub x: f64,
    /// Mass that swings on the spring (kg).
    pub mass: f64,
    /// Stiffness of the spring (N/m).
    pub stiffness: f64,
    /// Damping constant of the dashpot (N s/m).
    pub damping: f64,
}

/// A joint of two parts of a bat: a rotational spring.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Joint {
    /// Where the joint is (m).
    pub x: f64,
    /// Bending moment per angle between both sides (N m/rad).
    pub rotational_stiffness: f64,
}

/// A place that is held.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Support {
    /// Position of the support (m).
    pub x: f64,
    /// What the support holds.
    #[serde(rename = "type")]
    pub kind: Held,
}

/// What a support holds: the deflection alone, or the rotation too.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "schema", schemars(inline))]
pub enum Held {
    /// The bat does not move at the support but may turn.
    Pinned,
    /// The bat neither moves nor turns at the support.
    Clamped,
}

/// Hands as an elastic bed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Grip {
    /// Where the hands begin (m).
    pub from: f64,
    /// Where the hands end (m).
    pub to: f64,
    /// Force per deflection and per length (N/m²).
    pub stiffness: f64,
    /// Force per velocity and per length (N s/m²).
    pub damping: f64,
}

impl Fixtures {
    /// Whether the bat moves as a bare one. It may have tape and regions of other materials, but no attachments,
    /// absorbers, joints or supports, and no hands with a stiffness.
    pub fn none_moving(&self) -> bool {
        self.attachments.is_empty()
            && self.absorbers.is_empty()
            && self.joints.is_empty()
            && !self.holding()
    }

    /// Whether the only fixtures that affect the motion are rigidly attached masses.
    pub fn only_masses(&self) -> bool {
        self.absorbers.is_empty() && self.joints.is_empty() && !self.holding()
    }

    /// Whether anything holds the bat in place: a support, a spring to ground, a hand.
    pub fn holding(&self) -> bool {
        let spring = |a: &Attachment| a.stiffness > 0.0 || a.rotational_stiffness > 0.0;
        !self.supports.is_empty()
            || self.attachments.iter().any(spring)
            || self.grip.is_some_and(|grip| grip.stiffness > 0.0)
    }

    /// Whether supports keep the bat at rest at one place (m) if it is moved at the other: one is there, or a clamp
    /// stands between them.
    pub fn keeps_still(&self, [a, b]: [f64; 2]) -> bool {
        self.supports.iter().any(|Support { x, kind }| {
            let [to_a, to_b] = [x - a, x - b];
            to_a.abs().min(to_b.abs()) <= SAME_PLACE || *kind == Held::Clamped && to_a * to_b < 0.0
        })
    }

    /// These fixtures without springs to ground and hands, which act only after the hit is over.
    pub fn without_springs(&self) -> Self {
        let mut bare = self.clone();
        for attachment in &mut bare.attachments {
            (attachment.stiffness, attachment.rotational_stiffness) = (0.0, 0.0);
        }
        Self { grip: None, ..bare }
    }

    /// Whether anything but the materials takes energy out of the bat.
    pub fn damping(&self) -> bool {
        self.absorbers.iter().any(|absorber| absorber.damping > 0.0)
            || self.grip.is_some_and(|grip| grip.damping > 0.0)
    }

    /// Number of rigid modes: two for a free bat, one for a bat that turns about a pin or is held against turning only.
    pub fn rigid_modes(&self) -> usize {
        let places = self.supports.iter().map(|support| support.x);
        let springs = self.attachments.iter().filter(|a| a.stiffness > 0.0).map(|a| a.x);
        let mut held: Vec<f64> = places.chain(springs).collect();
        held.dedup();
        let turning = self.supports.iter().any(|support| support.kind == Held::Clamped)
            || self.attachments.iter().any(|a| a.rotational_stiffness > 0.0);
        let elsewhere = held.iter().any(|x| *x != held[0]);
        let bed = self.grip.is_some_and(|grip| grip.stiffness > 0.0);
        let lines = usize::from(!held.is_empty() || bed);
        let turns = usize::from(turning || elsewhere || bed);
        2 - lines - turns
    }

    /// Number of constraints that the supports and the springs to ground impose: the order of a mode rises by at most
    /// that many. Hands count as two, because they hold little more than the rigid motions.
    pub fn held(&self) -> usize {
        let supports = self.supports.iter().map(|support| match support.kind {
            Held::Pinned => 1,
            Held::Clamped => 2,
        });
        let springs = self
            .attachments
            .iter()
            .map(|a| usize::from(a.stiffness > 0.0) + usize::from(a.rotational_stiffness > 0.0));
        let bed = self.grip.filter(|grip| grip.stiffness > 0.0).map_or(0, |_| 2);
        supports.chain(springs).sum::<usize>() + bed
    }

    /// The boundary conditions in words.
    pub fn freedom(&self) -> &'static str {
        let pinned = self.supports.iter().any(|support| support.kind == Held::Pinned)
            || self.attachments.iter().any(|a| a.stiffness > 0.0);
        match self.rigid_modes() {
            0 => "held: no rigid motion is free",
            1 if pinned => "and one rigid motion at 0 Hz exactly: it turns about where it is held",
            1 => "and one rigid motion at 0 Hz exactly: it moves sideways without turning",
            _ => "and two rigid ones of the free bat, at 0 Hz exactly",
        }
    }

    /// Where elements must end (m), in no order.
    pub fn borders(&self) -> Vec<f64> {
        self.clone().places().map(|x| *x).collect()
    }

    /// Every place of a fixture (m), in no order.
    pub fn places(&mut self) -> impl Iterator<Item = &mut f64> {
        let regions = self.regions.iter_mut().flat_map(|region| [&mut region.from, &mut region.to]);
        let tapes = self.tapes.iter_mut().flat_map(|tape| [&mut tape.from, &mut tape.to]);
        let grip = self.grip.iter_mut().flat_map(|grip| [&mut grip.from, &mut grip.to]);
        let points = self.attachments.iter_mut().map(|a| &mut a.x);
        let points = points.chain(self.absorbers.iter_mut().map(|a| &mut a.x));
        let points = points.chain(self.joints.iter_mut().map(|joint| &mut joint.x));
        let points = points.chain(self.supports.iter_mut().map(|support| &mut support.x));
        regions.chain(tapes).chain(grip).chain(points)
    }

    /// Merges places that differ only by round-off: into the border that the profile has there (`borders`, rising from
    /// 0 to the length of the bat, m), else into the first of them. Two supports at one place become one, clamped if
    /// either is.
    pub(crate) fn settle(&mut self, borders: &[f64]) {
        let same = SAME_PLACE * borders.last().copied().unwrap_or_default();
        let near = |known: &[f64], x: f64| -> Option<f64> {
            let above = known.partition_point(|y| *y < x);
            let around = &known[above.saturating_sub(1)..known.len().min(above + 1)];
            around.iter().copied().find(|y| (y - x).abs() <= same)
        };
        let mut given = self.borders();
        given.sort_by(f64::total_cmp);
        let mut own: Vec<f64> = vec![];
        for x in given {
            if near(borders, x).is_none() && own.last().is_none_or(|before| x - before > same) {
                own.push(x);
            }
        }
        for x in self.places() {
            *x = near(borders, *x).or_else(|| near(&own, *x)).unwrap_or(*x);
        }
        let mut supports: Vec<Support> = vec![];
        for support in &self.supports {
            match supports.iter_mut().find(|known| known.x == support.x) {
                Some(known) if support.kind == Held::Clamped => known.kind = Held::Clamped,
                Some(_) => {}
                None => supports.push(*support),
            }
        }
        self.supports = supports;
    }

    /// Mass (kg) of everything that is attached or spread on the bat.
    pub fn attached_mass(&self) -> f64 {
        let spread = self.tapes.iter().map(|tape| tape.mass);
        self.masses().map(|[mass, ..]| mass).chain(spread).sum()
    }

    /// Mass (kg), position of its centre from the knob end (m) and own rotary inertia (kg m²) of each mass that is
    /// attached at a point.
    pub fn masses(&self) -> impl Iterator<Item = [f64; 3]> {
        let fixed = self.attachments.iter().map(|a| [a.mass, a.x + a.offset, a.rotary_inertia]);
        fixed.chain(self.absorbers.iter().map(|a| [a.mass, a.x, 0.0]))
    }
}
