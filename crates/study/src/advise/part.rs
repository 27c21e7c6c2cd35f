//! The fixtures of a bat by kind, and the bat without one kind.

use crate::engine::{Attachment, Bat, Fixtures};
use crate::named::named;

named! {
    /// A kind of fixture that a model of a bat may include or omit, in the order of display.
    #[non_exhaustive]
    pub enum ModelPart {
        /// The materials of `regions`; without them the bat's own is everywhere and bores are empty.
        Materials = "other materials",
        /// Masses of `attachments`, with their offset and rotary inertia.
        Weights = "weights",
        /// Mass spread on the surface of a stretch.
        Tapes = "tape",
        /// Springs of `attachments` to the ground.
        Springs = "springs to ground",
        /// Masses that hang on springs.
        Absorbers = "absorbers",
        /// Joints that are flexible in bending.
        Joints = "joints",
        /// Pins and clamps.
        Supports = "supports",
        /// Hands, as the springs of an elastic bed.
        Grip = "grip",
    }
}

impl ModelPart {
    /// The kinds that are attached to the bat or hold it in a rig.
    pub const ATTACHED: [Self; 6] =
        [Self::Weights, Self::Tapes, Self::Springs, Self::Absorbers, Self::Joints, Self::Supports];

    /// Whether the bat has any.
    pub fn is_on(self, bat: &Bat) -> bool {
        let fixtures = bat.fixtures();
        match self {
            Self::Materials => !fixtures.regions.is_empty(),
            Self::Weights => fixtures.attachments.iter().any(weighs),
            Self::Tapes => fixtures.tapes.iter().any(|tape| tape.mass > 0.0),
            Self::Springs => fixtures.attachments.iter().any(springs),
            Self::Absorbers => !fixtures.absorbers.is_empty(),
            Self::Joints => !fixtures.joints.is_empty(),
            Self::Supports => !fixtures.supports.is_empty(),
            Self::Grip => fixtures.grip.is_some_and(|grip| grip.stiffness > 0.0),
        }
    }

    /// Removes all of this kind from the bat; the density and stiffness of the rest stay the same.
    pub fn take_off(self, fixtures: &mut Fixtures) {
        match self {
            Self::Materials => fixtures.regions.clear(),
            Self::Tapes => fixtures.tapes.clear(),
            Self::Weights => {
                for a in &mut fixtures.attachments {
                    (a.mass, a.offset, a.rotary_inertia) = (0.0, 0.0, 0.0);
                }
            }
            Self::Springs => {
                for a in &mut fixtures.attachments {
                    (a.stiffness, a.rotational_stiffness) = (0.0, 0.0);
                }
            }
            Self::Absorbers => fixtures.absorbers.clear(),
            Self::Joints => fixtures.joints.clear(),
            Self::Supports => fixtures.supports.clear(),
            Self::Grip => fixtures.grip = None,
        }
        fixtures.attachments.retain(|a| weighs(a) || springs(a));
    }
}

fn weighs(a: &Attachment) -> bool {
    a.mass > 0.0 || a.rotary_inertia > 0.0
}

fn springs(a: &Attachment) -> bool {
    a.stiffness > 0.0 || a.rotational_stiffness > 0.0
}
