//! How does the bat vibrate: frequencies, shapes, nodes, modal masses?
//!
//! [`crate::solve()`] returns the [`Mode`]s; see [`Mode::frequency`], [`Shape::deflection`] and [`Mode::error`].

use std::f64::consts::TAU;
use std::sync::Arc;

use serde::Serialize;

use crate::base::{Over, Real};
use crate::beam::{Motion, View};
use crate::modes::certainty::{BESIDE_CLAMP, Doubt, RESTING};
use crate::modes::landmarks::Track;

pub use crate::modes::shape::Shape;

/// One bending mode of a bat.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct Mode {
    /// Number of the mode: 1 for the lowest bending mode.
    pub order: usize,
    /// Angular frequency ω (rad/s).
    pub omega: f64,
    /// Modal mass `∫ρA φ² dx` with rotary inertia and fixtures, for a largest |φ| of 1 (kg).
    pub modal_mass: f64,
    /// Nodes that certainly exist: places of zero deflection, from the knob end (m).
    pub nodes: Vec<f64>,
    /// Stretches (m) where the deflection is below its own error, so that further nodes cannot be determined there.
    pub untold: Vec<[f64; 2]>,
    /// Deflection φ, largest |φ| = 1, the barrel end positive.
    pub shape: Shape,
    /// Possible errors of these numbers.
    pub error: ModeError,
    /// Possible error of the deflection, kept until the nodes are determined.
    #[serde(skip)]
    pub(super) doubt: Doubt,
}

/// Possible errors of a mode's numbers.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ModeError {
    /// Relative error of the frequency due to the finite mesh.
    pub discretization: f64,
    /// Relative error of the frequency due to round-off.
    pub round_off: f64,
    /// `‖u − λ K⁻¹ M u‖ / ‖u‖` of the computed pair, in the strain energy norm.
    pub residual: f64,
    /// Error of the positions of [`Mode::nodes`] (m).
    pub nodes: f64,
    /// Relative error of the modal mass.
    pub modal_mass: f64,
    /// Error of the deflection φ anywhere on the bat, for a largest |φ| of 1.
    pub shape: f64,
}

impl ModeError {
    /// Relative error of the frequency, mesh and round-off together.
    pub fn total(&self) -> f64 {
        self.discretization + self.round_off
    }
}

impl Mode {
    /// Frequency (Hz).
    pub fn frequency(&self) -> f64 {
        self.omega / TAU
    }

    /// Whether it crosses zero as often as oscillation theory requires of mode n of a free Euler–Bernoulli bat: n + 1
    /// times (Gantmacher and Krein, Oscillation Matrices, 1950). If all modes of a list do, the list is complete.
    pub fn has_its_nodes(&self) -> bool {
        self.nodes.len() == self.order + 1
    }

    /// The mode of that motion in one lane.
    pub fn new<S: Real, R: Over<S>>(
        order: usize,
        view: &View<S>,
        motion: &Motion<R>,
        lane: usize,
        stretches: &Arc<Vec<(f64, f64)>>,
    ) -> Self {
        let track = Track::new(view, motion, lane);
        let mut shape = Shape::in_lane(view, motion, lane, stretches);
        let (largest, change) = shape.largest(&track);
        let sign = if leading(&track, largest) < 0.0 { -1.0 } else { 1.0 };
        let scale = sign / largest;
        let slack = motion.slack.lane(lane);
        let rest = if view.fixed.is_some() { (STILL * largest).max(2.0 * slack) } else { 0.0 };
        let (mut nodes, mut dips) = shape.zeros(&track, rest);
        if let Some(fixed) = view.fixed {
            // At a clamp the deflection has a multiple zero.
            let near = BESIDE_CLAMP * shape.length();
            // A pinned end does not move and is not a node, but round-off may put one beside it.
            let ends = [0.0, shape.length()];
            let at_end = |pin: &&f64| ends.iter().any(|end| (*pin - end).abs() <= near);
            let pins = fixed.placed.pins.iter().filter(at_end);
            let still: Vec<f64> = fixed.placed.clamps.iter().chain(pins).copied().collect();
            nodes.retain(|x| still.iter().all(|place| (x - place).abs() > near));
            shape.leave_still(&mut nodes, &fixed.placed.clamps, &track, RESTING * largest);
        }
        let [node_error, flattest] = shape.node_error(&nodes, &track);
        let node_error = node_error + slack * flattest;
        dips.iter_mut().for_each(|dip| dip[1] *= scale);
        let held =
            view.fixed.map(|fixed| [&fixed.placed.clamps, &fixed.placed.pins].map(Vec::clone));
        let doubt = Doubt {
            places: track.places(&shape.stretches, scale),
            dips,
            rest: rest / largest,
            held: held.unwrap_or_default(),
            flattest: flattest * largest,
            rounding: slack / largest,
            cancelled: motion.carried.lane(lane) / motion.kinetic.lane(lane),
        };
        shape.scale(scale);
        let kinetic = motion.kinetic.lane(lane);
        let pairs = track.samples.iter().copied().zip(track.changes.iter().copied());
        let ends = track.ends.iter().map(|end| (end[0], end[1]));
        let off = |(w, changed): (f64, f64)| (changed - change * w).abs() / largest;
        let worst = pairs.chain(ends).map(off).fold(0.0, f64::max);
        let error = ModeError {
            discretization: 0.5 * motion.defect.lane(lane).abs(),
            round_off: 0.0,
            residual: motion.residual.lane(lane),
            nodes: node_error,
            // The mass is proportional to the square of the shape. If the parts of its change cancel by chance, the
            // shape's change is the better measure.
            modal_mass: 2.0 * f64::max((motion.work.lane(lane) / kinetic - change).abs(), worst),
            shape: worst,
        };
        let modal_mass = kinetic * scale * scale;
        let (omega, untold) = (motion.omega.lane(lane), vec![]);
        Self { order, omega, modal_mass, nodes, untold, shape, error, doubt }
    }
}

/// The deflection that gives a shape its sign: that of the barrel end; if it is held, of the knob end; if both are
/// held, of the peak.
fn leading(track: &Track, largest: f64) -> f64 {
    const AT_REST: f64 = 1e-9;
    let moving = |end: usize| track.ends[end][0].abs() > AT_REST * largest;
    match (moving(1), moving(0)) {
        (true, _) => track.ends[1][0],
        (_, true) => track.ends[0][0],
        _ => track.samples.iter().fold(0.0, |a: f64, b| if b.abs() > a.abs() { *b } else { a }),
    }
}

/// On a held bat, a deflection below this share of the largest is round-off and counts as 0. Between stiff springs a
/// bat moves by 1e-12 of its largest deflection and still has nodes.
const STILL: f64 = 4.0 * f64::EPSILON;
