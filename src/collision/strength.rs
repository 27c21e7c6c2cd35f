//! How close does a hit come to breaking the bat, where, and which swing would break it?
//!
//! At every place, the bending stress at the outermost fibre is compared with the material's strength, and the strain
//! with its strain to failure. Both values are for clear wood along the grain. Slope of grain, knots, dents and earlier
//! hits are not modelled, nor is the higher strength of wood under a load that lasts a millisecond.

use serde::Serialize;

use crate::bat::{Bat, Material};
use crate::collision::aftermath::{Aftermath, Strained};
use crate::collision::hit::{Effort, Model, Scene};
use crate::collision::hitter::Hitter;
use crate::modes::solve::Solution;

/// The kinds of limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Limit {
    /// Limit of the stress in slow bending (Pa).
    Stress,
    /// Limit of the strain in a blow.
    Strain,
}

impl Limit {
    /// Both of them.
    pub const ALL: [Self; 2] = [Self::Stress, Self::Strain];

    /// The material's limit, if it is known.
    fn of(self, material: &Material) -> Option<f64> {
        match self {
            Self::Stress => material.strength,
            Self::Strain => material.strain_to_failure,
        }
    }
}

/// The place where a hit comes closest to a limit of the material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Load {
    /// Which limit.
    pub limit: Limit,
    /// The strength of the material there (Pa); only for a limit of stress.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strength_pa: Option<f64>,
    /// The strain to failure of the material there; only for a limit of strain.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strain_to_failure: Option<f64>,
    /// The largest strain at the place closest to the limit.
    #[serde(flatten)]
    pub at: Strained,
    /// Largest stress or strain as a share of the limit.
    pub share: f64,
    /// The swing that reaches the limit (rad/s); null if no swing up to 200 rad/s does.
    // Set by `breaking_swing`.
    pub reached_at_swing_rad_s: Option<f64>,
}

/// The load closest to a limit among the largest strains of every place; `None` if no material has that limit.
pub fn nearest(bat: &Bat, envelope: &[Strained], limit: Limit) -> Option<Load> {
    let load = |at: &Strained| {
        let bears = limit.of(bat.layup(bat.profile().piece_at(at.x_m)).surface())?;
        let is = |one: Limit| (limit == one).then_some(bears);
        let reached = if limit == Limit::Stress { at.stress_pa } else { at.strain };
        Some(Load {
            limit,
            strength_pa: is(Limit::Stress),
            strain_to_failure: is(Limit::Strain),
            at: *at,
            share: reached / bears,
            reached_at_swing_rad_s: None,
        })
    };
    envelope.iter().filter_map(load).max_by(|a, b| a.share.total_cmp(&b.share))
}

/// Number of evenly spaced instants at which a hit is evaluated: during the contact, and after it. In three periods of
/// the first mode, there are about a hundred per period of the tenth.
const INSTANTS: [usize; 2] = [100, 2000];
/// Number of places along the bat.
const PLACES: usize = 100;
/// Relative accuracy of the load at the swing that reaches the limit.
const FOUND: f64 = 1e-3;
/// Most hits that are tried for it.
const MOST: usize = 60;

/// How close a hit at one place comes to the limits of the bat.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Strength {
    /// Position at which the ball meets the bat (m).
    pub x_m: f64,
    /// The load for each known limit.
    pub limits: Vec<Load>,
}

impl Strength {
    /// The loads of a hit at `x` (m) over three periods of the first mode; `None` if ball and bat do not meet, or if
    /// the model has no force in time.
    pub fn at(
        bat: &Bat,
        solution: &Solution,
        (scene, effort): (&Scene, Effort),
        x: f64,
    ) -> Option<Self> {
        let until = 3.0 / solution.modes.first()?.frequency();
        let envelope = largest_strains(bat, solution, (scene, effort), (x, until))?;
        let reached = |limit| breaking_swing(bat, solution, (scene, effort), (x, until), limit);
        let load = |limit: &Limit| {
            let load = nearest(bat, &envelope, *limit)?;
            Some(Load { reached_at_swing_rad_s: reached(*limit), ..load })
        };
        Some(Self { x_m: x, limits: Limit::ALL.iter().filter_map(load).collect() })
    }
}

/// The largest strain of places along the bat after a hit at `x` (m), until that time (s) or, if that is later, until
/// the ball leaves.
fn largest_strains(
    bat: &Bat,
    solution: &Solution,
    (scene, effort): (&Scene, Effort),
    (x, until): (f64, f64),
) -> Option<Vec<Strained>> {
    let hitter = Hitter::new(Model::Contact, scene, bat, solution, effort).ok()?;
    let after = Aftermath::new(bat, solution, x, hitter.force(x)?);
    let end = after.end();
    let even = |from: f64, to: f64, count: usize| {
        (0..=count).map(move |k| from + (to - from) * k as f64 / count as f64)
    };
    let [within, beyond] = INSTANTS;
    let times: Vec<f64> =
        even(0.0, end, within).chain(even(end, until.max(end), beyond).skip(1)).collect();
    let places: Vec<f64> = even(0.0, bat.length(), PLACES).collect();
    Some(after.envelope(&places, &after.at(&times), after.count()))
}

/// The swing (rad/s) at which a hit at `x` (m) reaches the limit, with the rest of the scene unchanged. Each hit is
/// computed again, since the ball's force is not proportional to the swing. 0 if the pitch alone is enough; `None` if
/// no swing up to 200 rad/s reaches it.
///
/// # Source
///
/// The Illinois variant of false position: M. Dowell, P. Jarratt, BIT 11 (1971) 168.
pub fn breaking_swing(
    bat: &Bat,
    solution: &Solution,
    (scene, effort): (&Scene, Effort),
    about: (f64, f64),
    limit: Limit,
) -> Option<f64> {
    let beyond = |swing: f64| {
        let scene = Scene { swing, ..scene.clone() };
        let envelope = largest_strains(bat, solution, (&scene, effort), about);
        // A bat that the ball does not reach is not hit and does not break.
        envelope.map_or(Some(-1.0), |all| Some(nearest(bat, &all, limit)?.share - 1.0))
    };
    let (mut low, mut high) = (0.0, 200.0);
    let (mut below, mut above) = (beyond(low)?, beyond(high)?);
    if below >= 0.0 {
        return Some(0.0);
    }
    if above < 0.0 {
        return None;
    }
    for _ in 0..MOST {
        let swing = (low * above - high * below) / (above - below);
        let value = beyond(swing)?;
        if value.abs() < FOUND || high - low < FOUND * high {
            return Some(swing);
        }
        // The weight of an end that stays is halved, so that it does not stay for ever.
        match value < 0.0 {
            true => (low, below, above) = (swing, value, 0.5 * above),
            false => (high, above, below) = (swing, value, 0.5 * below),
        }
    }
    None
}
