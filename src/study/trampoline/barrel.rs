//! How does a hollow barrel ring, and how does a ball come back from it?

use std::sync::Arc;

use crate::base::error::Result;
use crate::bat::body::Bat;
use crate::bat::fixtures::Fixtures;
use crate::bat::material::Material;
use crate::beam::wall::elastic::{ASSUMED_POISSON_RATIO, poisson_ratio};
use crate::collision::ball::Ball;
use crate::collision::bbcor::TEST_SPEED;
use crate::collision::hit::{Model, Scene};
use crate::collision::hitter::Hitter;
use crate::collision::hoop_wall::{HoopInHit, HoopWall};
use crate::collision::sweep::{Accuracy, sweep};
use crate::collision::wall_choice::hoop_request;
use crate::collision::wall_figures::{WallBbcor, WallFigures};
use crate::modes::hoop::{Hoop, HoopRequest, KnobSide};
use crate::study::trampoline::pressed::PressedWall;

/// Where a ball meets a barrel if nothing else is said, from the tip: 6 in (m).
pub const FROM_TIP: f64 = 0.1524;

/// What is asked of a barrel.
#[derive(Debug, Clone)]
pub struct BarrelTest {
    /// Where the ball meets the bat (m from the knob end).
    pub at: f64,
    /// What is shot at the bat, which is at rest and free.
    pub ball: Ball,
    /// Speed of the ball (m/s).
    pub ball_speed: f64,
    /// Coefficient of restitution of the ball on a rigid wall, unless its own depends on the speed.
    pub cor: f64,
    /// What is asked of the hoop modes.
    pub hoop: HoopRequest,
    /// How accurate the exit speeds are to be.
    pub accuracy: Accuracy,
}

impl BarrelTest {
    /// A ball at the speed of laboratories, 6 in from the tip of that bat, every frequency to that accuracy; exit
    /// speeds to 1e-4 at best, for the patch leaves far more open.
    pub fn of(bat: &Bat, ball: Ball, accuracy: Accuracy) -> Self {
        const FINEST: f64 = 1e-4;
        let tol = accuracy.exit_speed;
        let accuracy = Accuracy { exit_speed: tol.max(FINEST), ..accuracy };
        Self {
            at: (bat.length() - FROM_TIP).max(0.5 * bat.length()),
            cor: ball.cor,
            ball,
            ball_speed: TEST_SPEED,
            hoop: HoopRequest { tol, least: 3, ..hoop_request(accuracy.exit_speed) },
            accuracy,
        }
    }
}

/// A barrel that was tested.
#[derive(Debug, Clone)]
pub struct Barrel {
    /// What was asked.
    pub test: BarrelTest,
    /// The wall with its modes.
    pub solved: Arc<HoopWall>,
    /// By how much the first mode of harmonic 2 rises where the stretch is clamped at its beginning, relative:
    /// how far the mode is from dead there; None where that cannot be solved.
    pub clamped_change: Option<f64>,
    /// Relative change of the first frequency of harmonic 2 by a Poisson's ratio that is 0.05 smaller and larger;
    /// None where the ratio is known.
    pub by_poisson: Option<[f64; 2]>,
    /// The wall under the ball; None where the ball does not meet the stretch that is modelled.
    pub wall: Option<PressedWall>,
    /// How the ball comes back; None without a wall under it and for a ball without a force law.
    pub rebound: Option<Rebound>,
}

/// A ball that came back from a bat at rest and free.
#[derive(Debug, Clone, PartialEq)]
pub struct Rebound {
    /// BBCOR without and with the wall, the wall's stiffness over the ball's, and the dent.
    pub figures: WallFigures,
    /// How far BBCOR with the wall may be off by the program's own errors.
    pub error: f64,
    /// Largest force between ball and bat (N).
    pub peak_force: f64,
    /// Energy that is left in the wall when the ball is gone (J).
    pub left: f64,
    /// Energy of the ball before (J).
    pub initial: f64,
}

impl Rebound {
    /// BBCOR of the free bat, without the wall and with it.
    pub fn bbcor(&self) -> WallBbcor {
        self.figures.bbcor
    }
}

impl Barrel {
    /// The barrel of that bat, with what is open of it: a Poisson's ratio that is not known, and an end of the
    /// stretch where the first mode is not dead.
    ///
    /// # Errors
    ///
    /// As [`Self::struck`].
    pub fn of(bat: &Bat, test: BarrelTest) -> Result<Self> {
        let mut barrel = Self::struck(bat, test)?;
        let oval =
            HoopRequest { harmonics: vec![2], least: 1, up_to_hz: 0.0, ..barrel.test.hoop.clone() };
        let known = barrel.first();
        let change = |bat: &Bat, request: &HoopRequest| {
            Some(first(&Hoop::of(bat, request).ok()?)? / known? - 1.0)
        };
        barrel.clamped_change =
            change(bat, &HoopRequest { end: KnobSide::Clamped, ..oval.clone() });
        if !knows_poisson(bat) {
            let other = |by: f64| change(&assuming(bat, by).ok()?, &oval);
            barrel.by_poisson = other(-SPREAD).zip(other(SPREAD)).map(|(less, more)| [less, more]);
        }
        Ok(barrel)
    }

    /// The barrel of that bat and the ball that comes back from it.
    ///
    /// # Errors
    ///
    /// As [`HoopWall::of`], and as [`sweep`] for a hit.
    pub fn struck(bat: &Bat, test: BarrelTest) -> Result<Self> {
        let solved = HoopWall::of(bat, test.ball.radius, &test.hoop)?;
        let wall = PressedWall::under(solved.hoop(), bat, &test.ball, test.at);
        let rebound = match (&wall, test.ball.stiffness) {
            (Some(_), Some(_)) => rebound(bat, &solved, &test)?,
            _ => None,
        };
        Ok(Self { test, solved, clamped_change: None, by_poisson: None, wall, rebound })
    }

    /// The modes of the wall.
    pub fn hoop(&self) -> &Hoop {
        self.solved.hoop()
    }

    /// ω of the first mode of harmonic 2 (rad/s).
    pub fn first(&self) -> Option<f64> {
        first(self.hoop())
    }

    /// Whether every frequency is as accurate as was asked, and BBCOR as accurate as it is said.
    pub fn met(&self) -> bool {
        /// Three digits are said, and the patch leaves ten times as much open and more.
        const SAID: f64 = 1e-3;
        let modes = self.hoop().modes().iter().all(|mode| mode.error <= self.test.hoop.tol);
        modes && self.rebound.as_ref().is_none_or(|rebound| rebound.error <= SAID)
    }

    /// What a test of the barrel's compression takes: the deflection (m) and the force (N).
    pub fn compressed(&self) -> Option<[f64; 2]> {
        self.wall.as_ref().map(|wall| wall.compressed(&self.test.ball))
    }
}

fn first(hoop: &Hoop) -> Option<f64> {
    hoop.modes().iter().find(|mode| mode.harmonic == 2).map(|mode| mode.omega)
}

/// The ball against the bat at rest and free; None where they do not meet.
fn rebound(bat: &Bat, wall: &Arc<HoopWall>, test: &BarrelTest) -> Result<Option<Rebound>> {
    let free = bat.with(|parts| {
        let fixtures = parts.fixtures.without_springs();
        parts.fixtures = Fixtures { supports: vec![], ..fixtures };
    })?;
    let scene = Scene {
        swing: 0.0,
        ball: test.ball.clone(),
        ball_speed: test.ball_speed,
        cor: test.cor,
        hoop: HoopInHit::Counted(Arc::clone(wall)),
        ..Scene::default()
    };
    let hits = sweep(&free, Model::Contact, &scene, &test.accuracy, &[test.at])?;
    let hitter = Hitter::new(Model::Contact, &scene, &free, &hits.solution, hits.effort)?;
    let outcome = hits.impacts.first().and_then(|impact| impact.outcome.as_ref());
    let both = outcome.zip(hitter.wall_figures(test.at));
    Ok(both.and_then(|(outcome, figures)| {
        // BBCOR is `e_A (1 + r) + r`, and `outcome.error` that of `e_A`.
        let per_efficiency = (1.0 + outcome.bbcor) / (1.0 + outcome.collision_efficiency);
        let error = per_efficiency * outcome.error;
        error.is_finite().then_some(Rebound {
            error,
            peak_force: outcome.peak_force?,
            left: outcome.energy.wall,
            initial: outcome.energy.initial,
            figures,
        })
    }))
}

/// By how much Poisson's ratio may be another than the one that is assumed.
const SPREAD: f64 = 0.05;

/// Whether Poisson's ratio of everything in the bat is known.
fn knows_poisson(bat: &Bat) -> bool {
    bat.layups().iter().all(|layup| layup.materials().all(has_poisson))
}

/// Whether a material has a Poisson's ratio, or those of a composite.
fn has_poisson(material: &Material) -> bool {
    material.poisson_ratios.is_some() || poisson_ratio(material).is_some()
}

/// The bat with Poisson's ratio where it is not known that much off the usual one.
fn assuming(bat: &Bat, by: f64) -> Result<Bat> {
    bat.with(|parts| {
        let regions = parts.fixtures.regions.iter_mut();
        let layups = regions.flat_map(|region| region.layup.materials_mut());
        let all = std::iter::once(&mut parts.material).chain(layups);
        for material in all.filter(|material| !has_poisson(material)) {
            material.poisson_ratio = Some(ASSUMED_POISSON_RATIO + by);
        }
    })
}
