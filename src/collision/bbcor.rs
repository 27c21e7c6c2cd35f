//! BBCOR as laboratories measure it, place by place: computed, and no certificate.
//!
//! The bat is at rest and turns about a pivot 6 in from the knob end; a ball meets it at the test
//! speed, and how fast it comes back tells
//!
//! ```text
//! e_A = v_out/v_in,   BBCOR = e_A (1 + r) + r,   r = m Q²/I
//! ```
//!
//! with Q from the pivot to the impact and I about the pivot. The error of `e_A` is that of the exit
//! speed relative to the closing speed, so that BBCOR may be off by `1 + r` times as much.

use serde::Serialize;

use crate::base::error::{Error, Result};
use crate::base::telling::Tell;
use crate::bat::body::{Bat, STANDARD_PIVOT};
use crate::bat::fixtures::{Fixtures, Held, Support};
use crate::collision::ball::Ball;
use crate::collision::hit::{Impact, Model, Scene};
use crate::collision::hitter::Hitter;
use crate::collision::sweep::{Accuracy, Sweep, Trial, sweep_telling};
use crate::collision::wall_choice::WallChoice;
use crate::collision::wall_figures::WallFigures;

/// Speed of the ball in the test: 136 mph (m/s).
pub const TEST_SPEED: f64 = 136.0 * 0.447_04;
/// Distance from one place of the scan to the next, counted from the tip: half an inch (m).
pub const STEP: f64 = 0.0127;
/// Largest BBCOR that the rules allow.
///
/// # Source
///
/// Letter of the NCAA's Baseball Research Panel and Baseball Rules Committee to bat manufacturers, 16
/// September 2008, as copied on 9county9.com: 0.50 for every length.
pub const LIMIT: f64 = 0.5;
/// Where the limit is from, for the documents.
pub const LIMIT_SOURCE: &str =
    "NCAA letter to bat manufacturers, 16 September 2008, as copied on 9county9.com";
/// Where the ball's restitution is from that is taken if none is given.
pub const COR_SOURCE: &str =
    "A. M. Nathan, Am. J. Phys. 68, 979 (2000), at game speed; the paper's fit at 58 m/s has 0.53";
/// Where the definitions of BESR and BPF are from.
pub const MEASURES_SOURCE: &str = "Sports Science Laboratory, Washington State University, \"Bat Performance \
                                   Measures\", ssl.wsu.edu/glossary/bat-performance-measures";
/// The first and the last place of the scan, from the tip: 12 in and 1 in (m).
const SCAN: [f64; 2] = [12.0 * 0.0254, 0.0254];

/// A test: what is shot at the bat, and where.
#[derive(Debug, Clone, PartialEq)]
pub struct Protocol {
    /// What is shot at the bat.
    pub ball: Ball,
    /// Speed of the ball (m/s).
    pub ball_speed: f64,
    /// Coefficient of restitution of the ball on a rigid wall, unless its own depends on the speed.
    pub cor: f64,
    /// First and last place of the scan (m from the knob end).
    pub scan: [f64; 2],
    /// Whether a hollow barrel's wall gives way.
    pub wall: WallChoice,
}

/// One place of the scan.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Place {
    /// The hit; its exit speed is the rebound.
    pub impact: Impact,
    /// BBCOR about the pivot; None where ball and bat do not meet.
    pub bbcor: Option<f64>,
    /// Error bound of [`Self::bbcor`].
    pub error: Option<f64>,
}

impl Place {
    /// Ball exit speed ratio of a bat at rest, `e_A + 1/2`; None where ball and bat do not meet.
    ///
    /// # Source
    ///
    /// [`MEASURES_SOURCE`].
    pub fn besr(&self) -> Option<f64> {
        Some(self.impact.outcome.as_ref()?.collision_efficiency + 0.5)
    }

    /// Bat performance factor, BBCOR over the ball's coefficient of restitution; None where there is no
    /// BBCOR, or the ball does not bounce.
    ///
    /// # Source
    ///
    /// [`MEASURES_SOURCE`].
    pub fn bpf(&self, protocol: &Protocol) -> Option<f64> {
        let cor = protocol.ball.restitution_at(protocol.ball_speed).unwrap_or(protocol.cor);
        Some(self.bbcor? / cor).filter(|bpf| bpf.is_finite())
    }
}

/// A bat that was tested.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct Tested {
    /// The bat as it was held in the test.
    #[serde(skip)]
    pub bat: Bat,
    /// What was done.
    #[serde(skip)]
    pub protocol: Protocol,
    /// The scene of every hit.
    #[serde(skip)]
    pub scene: Scene,
    /// Every place, from the first to the last.
    pub places: Vec<Place>,
    /// The place with the largest BBCOR, among [`Self::places`].
    pub largest: Option<usize>,
    /// What a hollow barrel's wall does at that place; None where it does not give way by its hoop modes.
    #[serde(skip)]
    pub wall: Option<WallFigures>,
    /// The hits as they were computed.
    pub sweep: Sweep,
}

impl Protocol {
    /// The laboratories' test of that bat with that ball, every half inch from 12 in to 1 in from the
    /// tip, as far as that is beyond the middle of the bat.
    pub fn of(bat: &Bat, ball: Ball) -> Self {
        let [from, to] = SCAN.map(|from_tip| bat.length() - from_tip);
        let scan = [from.max(0.5 * bat.length()), to.max(0.5 * bat.length())];
        let wall = WallChoice::Auto;
        Self { cor: ball.cor, ball, ball_speed: TEST_SPEED, scan, wall }
    }

    /// This protocol with its force law and its places checked, before anything is computed.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a ball whose force law is not known, and for a scan that ends before it
    /// begins.
    pub fn checked(self) -> Result<Self> {
        self.scene().force_law(self.cor)?;
        let [from, to] = self.scan;
        if to < from {
            let expected = format!("a place at {from:.4} m or beyond, where the scan begins");
            return Err(Error::value("end of the scan", format!("{to:.4} m"), expected));
        }
        Ok(self)
    }

    /// The places (m from the knob end), whole half inches from the tip.
    fn places(&self, length: f64) -> Vec<f64> {
        /// Share of a step, so that a rounding does not lose the ends.
        const ROUNDING: f64 = 1e-9;
        let [first, last] = self.scan.map(|x| (length - x) / STEP);
        let [most, least] = [(first + ROUNDING).floor(), (last - ROUNDING).ceil()];
        let count = (most - least + 1.0).max(0.0) as usize;
        (0..count).map(|k| length - (most - k as f64) * STEP).collect()
    }

    /// The scene of every hit: nothing swings.
    fn scene(&self) -> Scene {
        let Self { ball, ball_speed, cor, .. } = self.clone();
        Scene { swing: 0.0, ball, ball_speed, cor, ..Scene::default() }
    }

    /// Shoots the ball at every place.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] if there is no place to shoot at, and as
    /// [`sweep`](crate::collision::sweep::sweep).
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
        let inertia = bat.inertia().about(STANDARD_PIVOT);
        let place = |impact: &Impact| {
            let ratio = self.ball.mass * (impact.x - STANDARD_PIVOT).powi(2) / inertia;
            let outcome = impact.outcome.as_ref();
            let bbcor = outcome.map(|outcome| outcome.bbcor_pivoted);
            let error = outcome.map(|outcome| (1.0 + ratio) * outcome.error);
            Place { impact: impact.clone(), bbcor, error }
        };
        let places: Vec<Place> = sweep.impacts.iter().map(place).collect();
        let known = places.iter().enumerate().filter_map(|(k, place)| Some((k, place.bbcor?)));
        let largest = known.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k);
        let hitter = Hitter::new(Model::Contact, &scene, &bat, &sweep.solution, sweep.effort)?;
        let wall = largest.and_then(|k| hitter.wall_figures(places[k].impact.x));
        drop(hitter);
        Ok(Tested { bat, protocol: self, scene, places, largest, wall, sweep })
    }
}

/// The bat on the pivot alone: what else held it is taken away.
fn pivoted(bat: &Bat) -> Result<Bat> {
    let pivot = Support { x: STANDARD_PIVOT, kind: Held::Pinned };
    bat.with(|parts| {
        let fixtures = parts.fixtures.without_springs();
        parts.fixtures = Fixtures { supports: vec![pivot], ..fixtures };
    })
}

impl Tested {
    /// The largest BBCOR of the scan.
    pub fn most(&self) -> Option<&Place> {
        self.places.get(self.largest?)
    }

    /// Whether it is within the limit: None where its error does not tell, that of the patch on which a
    /// ball presses on a hollow barrel included.
    pub fn within(&self) -> Option<bool> {
        let most = self.most()?;
        let (bbcor, error) = (most.bbcor?, most.error?);
        let open = |wall: &WallFigures| {
            let ends = wall.bbcor_pivoted.range.map(|end| (end - wall.bbcor_pivoted.with).abs());
            ends[0].max(ends[1])
        };
        let error = error + self.wall.as_ref().map_or(0.0, open);
        ((bbcor - LIMIT).abs() > error).then_some(bbcor < LIMIT)
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
