//! What on the bat gives way: joints, and the springs that masses hang on?
//!
//! Each adds one number to the strains `k` of a motion: the kink `κ = θ(x+) − θ(x−)` of a joint, the stretch
//! `s = y − w(x)` of the spring under a mass that is at `y`. With the stiffness `K` of its spring
//!
//! ```text
//! (k, k) gains K κ² or K s²,        (T k)_joint = m(x)/K,        (T k)_hung = μ y/K
//! ```
//!
//! for `(Tk, k′) = ⟨Sk, Sk′⟩`: a kink by 1 moves the bat left of it and works against m, a stretch by 1 moves the mass
//! alone. Masses at the place of a joint are on its knob side.

use sweetspot::base::interval::Interval;

/// What gives way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum YieldingPart {
    /// A joint, to bending.
    Joint,
    /// The spring that a mass hangs on.
    Hung,
}

/// A spring that is part of the bat.
#[derive(Debug, Clone, Copy)]
pub struct Give {
    /// Number of its strain among those of their kind in a trial.
    pub number: usize,
    /// What gives way.
    pub way: YieldingPart,
    /// Stiffness of the spring (N m/rad of a joint, else N/m).
    pub stiffness: Interval,
}

/// By how much a mass is beyond the bat (m), its spring's stretch among these strains.
pub fn stretch(give: Option<Give>, strains: &[Interval]) -> Interval {
    match give {
        Some(Give { number, way: YieldingPart::Hung, .. }) => strains[number],
        _ => Interval::point(0.0),
    }
}

/// The kink of a joint (rad) among these strains.
pub fn kink(give: Option<Give>, strains: &[Interval]) -> Interval {
    match give {
        Some(Give { number, way: YieldingPart::Joint, .. }) => strains[number],
        _ => Interval::point(0.0),
    }
}

/// `1/K` of a spring that gives way; anything at all of one that may have no stiffness.
pub fn softness(give: &Give) -> Interval {
    let any = Interval { low: 0.0, high: f64::INFINITY };
    give.stiffness.reciprocal().unwrap_or(any)
}
