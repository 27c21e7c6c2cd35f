//! By which figures are bats compared, and how does a sweet spot move with the scene?
//!
//! They are computed from this project's models; they certify no standard.

use serde::{Deserialize, Serialize};

use crate::base::{Result, threads};
use crate::bat::{Bat, STANDARD_PIVOT};
use crate::collision::answer::LATER;
use crate::collision::hit::{Impact, Model, Scene};
use crate::collision::hitter::Hitter;
use crate::collision::sweet_spot::{FEW, FINE, HitsAlong, Peak, SweetSpot};
use crate::collision::wall_figures::WallFigures;

/// The swing speed of a bat for a batter who swings a reference bat at the scene's speed: `Ω = Ω₀ (I_ref/I)^n`, with I
/// about the standard pivot.
///
/// `n = 0` is a fixed angular speed, `n = ½` a fixed energy of rotation about that pivot. Measurements of batters lie
/// between.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SwingLaw {
    /// Exponent n of the law.
    pub exponent: f64,
    /// Moment of inertia I_ref of the reference bat (kg m²).
    pub reference: f64,
    /// Angular speed Ω₀ of the swing with the reference bat (rad/s).
    pub of_reference: f64,
}

impl SwingLaw {
    /// The swing of this bat (rad/s).
    pub fn swing(&self, bat: &Bat) -> f64 {
        let ratio = self.reference / bat.inertia().about(STANDARD_PIVOT);
        self.of_reference * ratio.powf(self.exponent)
    }
}

/// Speed of a point of the barrel, as in broadcasts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BarrelSpeed {
    /// Speed of the point (m/s).
    pub speed: f64,
    /// Distance of the point from the tip (m).
    pub from_tip: f64,
}

impl BarrelSpeed {
    /// Distance from the tip of the point whose speed broadcasts give (m): 6 in.
    pub const BROADCAST: f64 = 6.0 * 0.0254;

    /// Speed of the point at that distance from the tip (m) in that scene: `v = Ω (L − at + pivot)`.
    pub fn of(bat: &Bat, scene: &Scene, from_tip: f64) -> Self {
        Self { speed: scene.swing * (bat.length() - from_tip + scene.pivot), from_tip }
    }

    /// The angular speed (rad/s) that gives the point its speed about a centre `pivot` (m) beyond the knob end; `None`
    /// if the point does not move about that centre.
    pub fn swing(&self, bat: &Bat, pivot: f64) -> Option<f64> {
        let radius = bat.length() - self.from_tip + pivot;
        (radius > 0.01 * bat.length()).then_some(self.speed / radius)
    }
}

/// A swing of Ω₀ (I_ref/I)^exponent, and the fastest ball it produces.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Swung {
    /// Exponent of the law: 0 for the same angular speed, 0.5 for the same energy.
    pub exponent: f64,
    /// Angular speed of the swing with this bat (rad/s).
    #[serde(rename = "swing_rad_s")]
    pub swing: f64,
    /// Place and exit speed (m/s) of the fastest ball.
    #[serde(rename = "exit_speed_max")]
    pub best: Option<Peak>,
}

/// The sweet spot of another scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Moved {
    /// Sweet spot of the changed scene.
    #[serde(flatten)]
    pub sweet_spot: SweetSpot,
    /// The difference of the scene, in words.
    pub change: String,
}

/// The figures of a bat in tests and catalogues, and its sweet spot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Figures {
    /// The sweet spot, by every definition.
    #[serde(skip)]
    pub spot: SweetSpot,
    /// The hit at the sweet spot, with its `e_A` and bat-ball speed.
    #[serde(skip)]
    pub best: Option<Impact>,
    /// Energy lost to vibration at [`Self::rigid_best`] (J).
    #[serde(skip)]
    pub vibration_at_rigid_best: Option<f64>,
    /// Largest BBCOR of the outer half, of the free bat.
    pub bbcor_max: Option<Peak>,
    /// Largest BBCOR of the outer half, of a bat held 6 in from the knob.
    pub bbcor_pivoted_max: Option<Peak>,
    /// Place and exit speed (m/s) of the fastest ball off a bat that does not bend.
    #[serde(rename = "rigid_exit_speed_max")]
    pub rigid_best: Option<Peak>,
    /// What a hollow barrel's wall does at the sweet spot; left out if it does not deflect in its hoop modes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall: Option<WallFigures>,
    /// Swings of one batter with this bat, by several laws of swing; empty without a reference inertia.
    pub swings: Vec<Swung>,
    /// The sweet spot of scenes that each differ in one thing; empty if the fastest place depends on a later contact,
    /// because small changes then move it far.
    pub moves: Vec<Moved>,
}

impl Figures {
    /// All figures, from the hits of that hitter. The scene's swing is that of this bat; `law` gives its origin.
    ///
    /// # Errors
    ///
    /// As [`Hitter::new`].
    pub fn new(bat: &Bat, hitter: &Hitter, law: Option<SwingLaw>) -> Result<Self> {
        let Hitter { scene, solution, effort, .. } = *hitter;
        let find = |scene: &Scene| -> Result<SweetSpot> {
            let hitter = hitter.in_scene(scene, bat)?;
            Ok(SweetSpot::within(&HitsAlong::outer(FEW, &hitter)))
        };
        let rigid = Hitter::new(Model::Rigid, scene, bat, solution, effort)?;
        let rigid_best = HitsAlong::outer(FINE, &rigid).fastest();
        let looked = HitsAlong::outer(FINE, hitter);
        let mut swings = vec![];
        if let Some(law) = law {
            let mut exponents = vec![0.0, law.exponent, 0.5];
            exponents.sort_by(f64::total_cmp);
            exponents.dedup();
            for exponent in exponents {
                let swing = SwingLaw { exponent, ..law }.swing(bat);
                let best = find(&Scene { swing, ..scene.clone() })?.exit_speed_max;
                swings.push(Swung { exponent, swing, best });
            }
        }
        let spot = SweetSpot::within(&looked);
        let best = spot.exit_speed_max.map(|peak| hitter.strike(peak.x));
        // If a place depends on a later contact, no small change shows how it moves.
        let later = |best: &Impact| LATER.iter().any(|flag| best.flags.contains(flag));
        let changes = if best.as_ref().is_some_and(later) { vec![] } else { changes(scene) };
        let moved = threads::map(changes.len(), |k| find(&changes[k].1));
        let moves = changes
            .into_iter()
            .zip(moved)
            .map(|((change, _), spot)| Ok(Moved { sweet_spot: spot?, change }));
        Ok(Self {
            best,
            wall: spot.exit_speed_max.and_then(|peak| hitter.wall_figures(peak.x)),
            vibration_at_rigid_best: rigid_best.and_then(|peak| hitter.glance(peak.x)?.vibration),
            rigid_best,
            bbcor_max: looked.largest_figure(1),
            bbcor_pivoted_max: looked.largest_figure(2),
            swings,
            moves: moves.collect::<Result<_>>()?,
            spot,
        })
    }
}

/// Scenes that each differ in one thing.
fn changes(scene: &Scene) -> Vec<(String, Scene)> {
    let ball = &scene.ball;
    let mut all = vec![];
    if scene.swing != 0.0 {
        let faster = Scene { swing: 1.1 * scene.swing, ..scene.clone() };
        all.push(("swing 10 % faster".to_owned(), faster));
        let further = Scene { pivot: scene.pivot + 0.0254, ..scene.clone() };
        all.push(("pivot 1 in further out".to_owned(), further));
    }
    if scene.ball_speed != 0.0 {
        let faster = Scene { ball_speed: 1.1 * scene.ball_speed, ..scene.clone() };
        all.push(("pitch 10 % faster".to_owned(), faster));
    }
    if ball.cor_by_speed.is_empty() && scene.cor <= 0.95 {
        let livelier = Scene { cor: scene.cor + 0.05, ..scene.clone() };
        all.push(("ball livelier by 0.05".to_owned(), livelier));
    }
    if let Some(stiffness) = ball.stiffness {
        let mut harder = scene.clone();
        harder.ball.stiffness = Some(1.1 * stiffness);
        all.push(("ball 10 % harder".to_owned(), harder));
    }
    let mut heavier = scene.clone();
    heavier.ball.mass_kg *= 1.05;
    all.push(("ball 5 % heavier".to_owned(), heavier));
    all
}
