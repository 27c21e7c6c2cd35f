//! The physics of bats that no model here has.

use crate::engine::{Bat, rings};
use crate::ignored::thinnest_wall;

/// Effects outside every model, one sentence each, if they can matter to this bat.
pub fn outside(bat: &Bat) -> Vec<String> {
    let mut outside = vec![
        if rings(bat) {
            "hoop modes: the wall of this hollow bat also vibrates as a ring and is compliant \
             under the ball (trampoline effect); the sections of a beam stay round, but a hit \
             includes these modes (--wall) and sweetspot hoop shows them"
        } else if thinnest_wall(bat).is_some() {
            "hoop modes: the wall of this hollow bat of wood also gives way under the ball; sections \
             stay round, and no model has it"
        } else {
            "hoop modes of hollow barrels: sections stay round; this bat has no empty bore"
        },
        "anisotropy beyond E and G: a material has one E and one G along the bat; grain that runs \
         off the axis, or bends differently along and across the rings, is not modelled",
        "motion in other directions: the bat bends in one plane; twist and axial waves are left out",
        "hands as a person: a grip is a bed of springs and dashpots; arms, their mass and muscles \
         are not modelled",
        "large motion: bending is linear in small deflections; the pull of the swing, which would \
         change ω² by the order of the swing's own rate squared, is left out",
        "contact: how knob and hand touch, and how wood dents under the ball, is not modelled",
    ];
    if !bat.fixtures().joints.is_empty() {
        outside.push("joints with play: a joint is a linear spring without slack or friction");
    }
    outside.into_iter().map(str::to_owned).collect()
}
