//! Which parts on the bat are compliant? These are joints, and springs that carry masses.
//!
//! Each adds one number to the strains `k` of a motion: the kink `κ = θ(x+) − θ(x−)` of a joint, the stretch
//! `s = y − w(x)` of the spring under a mass that is at `y`. With the stiffness `K` of its spring
//!
//! ```text
//! (k, k) gains K κ² or K s²,        (T k)_joint = m(x)/K,        (T k)_hung = μ y/K
//! ```
//!
//! for `(Tk, k′) = ⟨Sk, Sk′⟩`: a unit kink moves the bat on its left and works against m, while a unit stretch moves
//! only the mass. Masses at the place of a joint are on its knob side.

use sweetspot::base::Interval;

/// Kind of a compliant part.
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
    /// Number of its strain among those of its kind in a trial.
    pub number: usize,
    /// Kind of the part.
    pub way: YieldingPart,
    /// Stiffness of the spring (N m/rad for a joint, else N/m).
    pub stiffness: Interval,
}

/// Displacement of a mass relative to the bat (m), with the stretch of its spring among these strains.
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

/// `1/K` of a compliant spring; the whole line if its stiffness may be 0.
pub fn softness(give: &Give) -> Interval {
    let any = Interval { low: 0.0, high: f64::INFINITY };
    give.stiffness.reciprocal().unwrap_or(any)
}
