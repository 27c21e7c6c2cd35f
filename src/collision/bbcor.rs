//! What BBCOR would a laboratory measure, place by place? A computed value, not a certificate.
//!
//! The bat is at rest and turns about a pivot 6 in from the knob end. A ball hits it at the test speed. Its rebound
//! speed gives
//!
//! ```text
//! e_A = v_out/v_in,   BBCOR = e_A (1 + r) + r,   r = m Q²/I
//! ```
//!
//! with Q the distance from the pivot to the impact and I about the pivot. The error of `e_A` is that of the exit speed
//! relative to the closing speed; that of BBCOR is `1 + r` times as large.

use serde::{Deserialize, Serialize};

use crate::base::{Error, Result, Tell};
use crate::bat::{Bat, Fixtures, Held, STANDARD_PIVOT, Support};
use crate::collision::ball::Ball;
use crate::collision::hit::{Impact, Model, Scene};
use crate::collision::hitter::Hitter;
use crate::collision::sweep::{Accuracy, Sweep, Trial, sweep_telling};
use crate::collision::wall_choice::WallChoice;
use crate::collision::wall_figures::{WallBbcor, WallFigures};

/// Speed of the ball in the test: 136 mph (m/s).
pub const TEST_SPEED: f64 = 136.0 * 0.447_04;
/// Step of the scan, counted from the tip: half an inch (m).
pub const STEP: f64 = 0.0127;
/// Largest BBCOR that the rules allow.
///
/// # Source
///
/// Letter of the NCAA's Baseball Research Panel and Baseball Rules Committee to bat manufacturers, 16
/// September 2008, as copied on 9county9.com: 0.50 for every length.
pub const LIMIT: f64 = 0.5;
/// Source of the limit, for the documents.
pub const LIMIT_SOURCE: &str =
    "NCAA letter to bat manufacturers, 16 September 2008, as copied on 9county9.com";
/// Source of the ball's default restitution.
pub const COR_SOURCE: &str =
    "A. M. Nathan, Am. J. Phys. 68, 979 (2000), at game speed; the paper's fit at 58 m/s has 0.53";
/// Source of the definitions of BESR and BPF.
pub const MEASURES_SOURCE: &str = "Sports Science Laboratory, Washington State University, \"Bat Performance \
                                   Measures\", ssl.wsu.edu/glossary/bat-performance-measures";
/// First and last place of the scan, from the tip: 12 in and 1 in (m).
const SCAN: [f64; 2] = [12.0 * 0.0254, 0.0254];

/// A test: ball, speed and places.
#[derive(Debug, Clone, PartialEq)]
pub struct Protocol {
    /// The ball that is shot at the bat.
    pub ball: Ball,
    /// Speed of the ball (m/s).
    pub ball_speed: f64,
    /// Coefficient of restitution of the ball on a rigid wall, unless the ball's depends on the speed.
    pub cor: f64,
    /// Whether it was given, in place of the ball's own.
    pub cor_given: bool,
    /// First and last place of the scan (m from the knob end).
    pub scan: [f64; 2],
    /// Whether a hollow barrel's wall deflects.
    pub wall: WallChoice,
}

/// The result: the members of a BBCOR document that describe the test.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Scan {
    /// Always false: a computed value is not a certificate.
    pub certified: bool,
    /// The test: ball, speed, and how the bat was held.
    pub protocol: Conditions,
    /// The scan, from the knob towards the tip.
    pub places: Vec<Place>,
    /// The largest BBCOR of the scan; null if no place has one.
    pub largest: Option<Largest>,
    /// What a hollow barrel's wall does at that place; left out if it does not deflect in its hoop modes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall: Option<WallFigures>,
    /// The largest BBCOR that the rules allow.
    pub limit: f64,
    /// Whether the largest BBCOR is below the limit; null if its error leaves that open.
    // The error includes that of the patch on which a ball presses on a hollow barrel.
    pub within_limit: Option<bool>,
    /// Whether every place is as accurate as was asked.
    pub tolerance_met: bool,
}

/// Ball and speed, and how the bat was held.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Conditions {
    /// The pivot about which the bat turns (m).
    pub pivot_m: f64,
    /// Moment of inertia of the bat about the pivot (kg m²).
    pub inertia_pivot_kg_m2: f64,
    /// Speed of the ball (m/s).
    pub ball_speed_m_s: f64,
    /// Distance from one place to the next (m).
    pub step_m: f64,
    /// The ball, with its force law and its restitution.
    pub ball: Ball,
    /// Coefficient of restitution of the ball at the test speed, unless the ball's depends on the speed.
    pub cor: f64,
    /// Source of the coefficient of restitution.
    pub cor_source: String,
    /// Source of the limit.
    pub limit_source: String,
    /// Source of the definitions of BESR and BPF.
    #[serde(default)]
    pub measures_source: String,
}

/// One place of the scan. Most values are null if ball and bat do not meet; `flags` gives the reason.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Place {
    /// Position at which the ball meets the bat (m).
    pub x_m: f64,
    /// Distance of the impact point from the tip (m).
    pub from_tip_m: f64,
    /// Speed of the ball off the bat (m/s), negative where it follows through.
    pub exit_speed_m_s: Option<f64>,
    /// Collision efficiency e_A, the speed off the bat over the speed onto it.
    pub collision_efficiency: Option<f64>,
    /// BBCOR, e_A (1 + r) + r with r = m Q²/I about the pivot.
    pub bbcor: Option<f64>,
    /// Ball exit speed ratio, e_A + 1/2.
    // Source: MEASURES_SOURCE.
    #[serde(default)]
    pub besr: Option<f64>,
    /// Bat performance factor, BBCOR over the coefficient of restitution of the ball at the test speed.
    // None if the ball does not bounce. Source: MEASURES_SOURCE.
    #[serde(default)]
    pub bpf: Option<f64>,
    /// Flags of anything unusual in the hit, as in a hit file.
    pub flags: Vec<String>,
    /// Estimated errors of the numbers above.
    pub error: PlaceError,
}

/// Estimated errors of a place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlaceError {
    /// Error of the exit speed (m/s).
    pub exit_speed_m_s: Option<f64>,
    /// Error of BBCOR.
    pub bbcor: Option<f64>,
}

/// The largest BBCOR and its place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Largest {
    /// The place (m).
    pub x_m: f64,
    /// Distance of the place from the tip (m).
    pub from_tip_m: f64,
    /// BBCOR there.
    pub bbcor: f64,
    /// Ball exit speed ratio there, e_A + 1/2.
    #[serde(default)]
    pub besr: Option<f64>,
    /// Bat performance factor there, BBCOR over the coefficient of restitution of the ball at the test
    /// speed.
    #[serde(default)]
    pub bpf: Option<f64>,
    /// Error of BBCOR there.
    pub error: f64,
}

/// A bat that was tested.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Tested {
    /// The bat as it was held in the test.
    pub bat: Bat,
    /// The scene of every hit.
    pub scene: Scene,
    /// The result.
    pub scan: Scan,
    /// The hits as they were computed.
    pub sweep: Sweep,
}

impl Protocol {
    /// The laboratories' test of that bat with that ball: every half inch from 12 in to 1 in from the tip, beyond the
    /// middle of the bat.
    pub fn of(bat: &Bat, ball: Ball) -> Self {
        let [from, to] = SCAN.map(|from_tip| bat.length() - from_tip);
        let scan = [from.max(0.5 * bat.length()), to.max(0.5 * bat.length())];
        let wall = WallChoice::Auto;
        Self { cor: ball.cor, cor_given: false, ball, ball_speed: TEST_SPEED, scan, wall }
    }

    /// This protocol after a check of its force law and its places, before anything is computed.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a ball whose force law is not known, and for a scan that ends before it begins.
    pub fn checked(self) -> Result<Self> {
        self.ball.spring()?;
        let [from, to] = self.scan;
        if to < from {
            let expected = format!("a place at {from:.4} m or beyond, where the scan begins");
            return Err(Error::value("end of the scan", format!("{to:.4} m"), expected));
        }
        Ok(self)
    }

    /// The places (m from the knob end), whole half inches from the tip.
    fn places(&self, length: f64) -> Vec<f64> {
        /// Share of a step, so that round-off does not lose the ends.
        const ROUNDING: f64 = 1e-9;
        let [first, last] = self.scan.map(|x| (length - x) / STEP);
        let [most, least] = [(first + ROUNDING).floor(), (last - ROUNDING).ceil()];
        let count = (most - least + 1.0).max(0.0) as usize;
        (0..count).map(|k| length - (most - k as f64) * STEP).collect()
    }

    /// The scene of every hit: the bat is at rest.
    fn scene(&self) -> Scene {
        let Self { ball, ball_speed, cor, .. } = self.clone();
        Scene { swing: 0.0, ball, ball_speed, cor, ..Scene::default() }
    }

    /// Shoots the ball at every place.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] if there is no place to shoot at; those of [`sweep`](crate::collision::sweep::sweep).
    pub fn test(self, bat: &Bat, accuracy: &Accuracy, tell: Tell) -> Result<Tested> {
        let beyond = |x: &f64| *x > STANDARD_PIVOT && *x <= bat.length();
        let places: Vec<f64> = self.places(bat.length()).into_iter().filter(beyond).collect();
        if places.is_empty() {
            let expected = "a stretch with a whole half inch from the tip in it, beyond the pivot 6 in \
                            from the knob end";
            let [from, to] = self.scan;
            return Err(Error::value("scan", format!("{from:.4} to {to:.4} m"), expected));
        }
        let (bat, tolerance) =
            (pivoted(bat)?, accuracy.modes.is_none().then_some(accuracy.exit_speed));
        let scene = self.scene().with_wall(self.wall, &bat, Model::Contact, tolerance)?;
        let trial = Trial { model: Model::Contact, scene: &scene };
        let sweep = sweep_telling(&bat, trial, accuracy, &places, tell)?;
        let places: Vec<Place> =
            sweep.impacts.iter().map(|impact| self.place(&bat, impact)).collect();
        let largest =
            places.iter().filter_map(Largest::of).max_by(|a, b| a.bbcor.total_cmp(&b.bbcor));
        let hitter = Hitter::new(Model::Contact, &scene, &bat, &sweep.solution, sweep.effort)?;
        let wall = largest.as_ref().and_then(|most| hitter.wall_figures(most.x_m));
        let wall = wall.map(WallFigures::pivoted);
        drop(hitter);
        let scan = Scan {
            certified: false,
            within_limit: largest.as_ref().and_then(|most| most.within(wall.as_ref())),
            protocol: self.conditions(&bat),
            places,
            largest,
            wall,
            limit: LIMIT,
            tolerance_met: sweep.met(),
        };
        Ok(Tested { bat, scene, scan, sweep })
    }

    fn place(&self, bat: &Bat, impact: &Impact) -> Place {
        let ratio = self.ball.mass_kg * (impact.x - STANDARD_PIVOT).powi(2)
            / bat.inertia().about(STANDARD_PIVOT);
        let cor = self.ball.restitution_at(self.ball_speed).unwrap_or(self.cor);
        let outcome = impact.outcome.as_ref();
        let bbcor = outcome.map(|outcome| outcome.bbcor_pivoted);
        Place {
            x_m: impact.x,
            from_tip_m: bat.length() - impact.x,
            exit_speed_m_s: outcome.map(|o| o.exit_speed),
            collision_efficiency: outcome.map(|o| o.collision_efficiency),
            bbcor,
            besr: outcome.map(|o| o.collision_efficiency + 0.5),
            bpf: bbcor.map(|bbcor| bbcor / cor).filter(|bpf| bpf.is_finite()),
            flags: impact.flags.iter().map(|flag| (*flag).to_owned()).collect(),
            error: PlaceError {
                exit_speed_m_s: outcome.map(|o| o.error * self.ball_speed),
                bbcor: outcome.map(|o| (1.0 + ratio) * o.error),
            },
        }
    }

    fn conditions(self, bat: &Bat) -> Conditions {
        let cor_source = match (self.cor_given, self.ball.name.as_str()) {
            (true, _) => "given with --cor".to_owned(),
            (false, "baseball") => COR_SOURCE.to_owned(),
            (false, _) => format!("the ball's own ({})", self.ball.source),
        };
        Conditions {
            pivot_m: STANDARD_PIVOT,
            inertia_pivot_kg_m2: bat.inertia().about(STANDARD_PIVOT),
            ball_speed_m_s: self.ball_speed,
            step_m: STEP,
            ball: self.ball,
            cor: self.cor,
            cor_source,
            limit_source: LIMIT_SOURCE.to_owned(),
            measures_source: MEASURES_SOURCE.to_owned(),
        }
    }
}

/// The bat held by the pivot alone; other supports are removed.
fn pivoted(bat: &Bat) -> Result<Bat> {
    let pivot = Support { x: STANDARD_PIVOT, kind: Held::Pinned };
    bat.with(|parts| {
        let fixtures = parts.fixtures.without_springs();
        parts.fixtures = Fixtures { supports: vec![pivot], ..fixtures };
    })
}

impl Largest {
    fn of(place: &Place) -> Option<Self> {
        Some(Self {
            x_m: place.x_m,
            from_tip_m: place.from_tip_m,
            bbcor: place.bbcor?,
            besr: place.besr,
            bpf: place.bpf,
            error: place.error.bbcor?,
        })
    }

    /// Whether it is below the limit; `None` if its error leaves that open.
    fn within(&self, wall: Option<&WallFigures>) -> Option<bool> {
        let WallBbcor { with, range, .. } = wall.map(|wall| wall.bbcor).unwrap_or_default();
        let error =
            self.error + range.map(|end| (end - with).abs()).into_iter().fold(0.0, f64::max);
        ((self.bbcor - LIMIT).abs() > error).then_some(self.bbcor < LIMIT)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_whole_half_inches_from_the_tip() {
        let protocol = Protocol {
            ball: Ball::baseball(),
            ball_speed: TEST_SPEED,
            cor: 0.5,
            cor_given: false,
            scan: [0.8382 - 0.3048, 0.8382 - 0.0254],
            wall: WallChoice::Auto,
        };
        let places = protocol.places(0.8382);
        assert_eq!(places.len(), 23);
        for (k, x) in places.iter().enumerate() {
            assert!((0.8382 - x - (24 - k) as f64 * 0.0127).abs() < 1e-12, "{x}");
        }
        let none = Protocol { scan: [0.700, 0.701], ..protocol };
        assert_eq!(none.places(0.8382), [] as [f64; 0]);
    }
}
