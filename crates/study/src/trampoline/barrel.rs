//! How does a hollow barrel ring, and how does a ball come back from it?

use std::sync::Arc;

use serde::Serialize;

use crate::trampoline::pressed::{BarrelCompression, PressedWall};
use sweetspot::base::error::Result;
use sweetspot::bat::body::Bat;
use sweetspot::bat::fixtures::Fixtures;
use sweetspot::bat::material::Material;
use sweetspot::beam::wall::elastic::{ASSUMED_POISSON_RATIO, poisson_ratio};
use sweetspot::collision::ball::Ball;
use sweetspot::collision::bbcor::TEST_SPEED;
use sweetspot::collision::hit::{Model, Scene};
use sweetspot::collision::hitter::Hitter;
use sweetspot::collision::hoop_wall::{HoopInHit, HoopWall};
use sweetspot::collision::sweep::{Accuracy, sweep};
use sweetspot::collision::wall_figures::WallBbcor;
use sweetspot::modes::hoop::{Hoop, HoopMode, HoopRequest, KnobSide};

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
    /// How many of the lowest hoop modes are asked for.
    pub modes: usize,
    /// Largest relative error of their frequencies.
    pub tol: f64,
    /// How accurate the exit speeds are to be.
    pub accuracy: Accuracy,
    /// The wall of a bat under that ball as it is known already; of another bat it is solved as well.
    pub known: Option<Arc<HoopWall>>,
}

impl BarrelTest {
    /// A ball at the speed of laboratories, 6 in from the tip of that bat, every frequency to that accuracy; exit
    /// speeds to 1e-4, as three digits of BBCOR need it: the patch leaves far more open.
    pub fn of(bat: &Bat, ball: Ball, accuracy: Accuracy) -> Self {
        const ENOUGH: f64 = 1e-4;
        let tol = accuracy.exit_speed;
        let accuracy = Accuracy { exit_speed: ENOUGH, ..accuracy };
        Self {
            at: (bat.length() - FROM_TIP).max(0.5 * bat.length()),
            cor: ball.cor,
            ball,
            ball_speed: TEST_SPEED,
            modes: MODES,
            tol,
            accuracy,
            known: None,
        }
    }
}

/// A barrel that was tested.
#[derive(Debug, Clone)]
pub struct Barrel {
    /// What was asked.
    pub test: BarrelTest,
    /// The lowest hoop modes.
    hoop: Hoop,
    /// What the modes were found with.
    pub model: HoopModel,
    /// Relative change of the first frequency of harmonic 2 by a Poisson's ratio that is 0.05 smaller and larger;
    /// None where the ratio is known.
    pub by_poisson: Option<[f64; 2]>,
    /// The wall and the ball.
    pub struck: BarrelStruck,
}

/// What the modes were found with.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct HoopModel {
    /// Where the stretch that is modelled begins (m).
    pub from_m: f64,
    /// Where the stretch that is modelled ends (m).
    pub to_m: f64,
    /// Wanted relative accuracy of every frequency.
    pub tolerance: f64,
    /// By how much the first mode of harmonic 2 rises if the stretch is clamped where it begins, relative:
    /// how far it is from dead there.
    // None where that cannot be solved.
    pub clamped_change: Option<f64>,
}

/// A barrel that a ball was shot at.
#[derive(Debug, Clone)]
pub struct BarrelStruck {
    /// Frequency of the first mode of harmonic 2 (Hz), as accurate as the hit needs it.
    pub first_hz: Option<f64>,
    /// The wall under the ball; None where the ball does not meet the stretch that is modelled.
    pub wall: Option<PressedWall>,
    /// How the ball comes back; None without a wall under it and for a ball without a force law.
    pub rebound: Option<Rebound>,
}

/// The rebound of a ball from the bat at rest and free, without and with its wall.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Rebound {
    /// The ball.
    pub ball: Ball,
    /// Speed of the ball (m/s).
    pub ball_speed_m_s: f64,
    /// Coefficient of restitution of the ball on a rigid wall, unless its own depends on the speed.
    pub cor: f64,
    /// BBCOR of the bat if its wall did not give way.
    pub stiff: f64,
    /// BBCOR of the bat with its wall.
    pub wall: f64,
    /// BBCOR with the patch of a ball that is squeezed twice as much and half as much, the lesser first: how
    /// much the size of the patch leaves open.
    pub range: [f64; 2],
    /// How far `wall` may be off by the program's own errors.
    pub error: f64,
    /// Largest force between ball and bat (N).
    pub peak_force_n: f64,
    /// How deep that force, acting slowly, dents the wall (m).
    pub dent_m: f64,
    /// Energy that is left in the wall when the ball is gone (J).
    pub left_in_wall_j: f64,
    /// Energy of the ball before (J).
    pub initial_j: f64,
}

/// Three digits of BBCOR are said, and the patch leaves ten times as much open and more.
const SAID: f64 = 1e-3;
/// So many hoop modes, if nothing else is said.
const MODES: usize = 10;

impl Barrel {
    /// The barrel of that bat, with what is open of it: a Poisson's ratio that is not known, and an end of the
    /// stretch where the first mode is not dead.
    ///
    /// # Errors
    ///
    /// As [`Hoop::first`] and [`BarrelStruck::of`].
    pub fn of(bat: &Bat, test: BarrelTest) -> Result<Self> {
        let hoop = Hoop::first(bat, test.modes, test.tol)?;
        let struck = BarrelStruck::of(bat, &test)?;
        let known = first(&hoop).map(|mode| mode.omega);
        let change = |bat: &Bat, end: KnobSide| {
            let (tol, harmonics) = (test.tol, vec![2]);
            let up_to_hz = 0.0;
            let request = HoopRequest { tol, harmonics, up_to_hz, least: 1, end };
            Some(first(&Hoop::of(bat, &request).ok()?)?.omega / known? - 1.0)
        };
        let model = HoopModel {
            from_m: hoop.from(),
            to_m: hoop.to(),
            tolerance: test.tol,
            clamped_change: change(bat, KnobSide::Clamped),
        };
        let other = |by: f64| change(&assuming(bat, by).ok()?, KnobSide::Free);
        let by_poisson = match knows_poisson(bat) {
            true => None,
            false => other(-SPREAD).zip(other(SPREAD)).map(|(less, more)| [less, more]),
        };
        Ok(Self { test, hoop, model, by_poisson, struck })
    }

    /// The lowest modes of the wall.
    pub fn hoop(&self) -> &Hoop {
        &self.hoop
    }

    /// What is less accurate than was asked, in words: a frequency, or BBCOR, of which three digits are said; None
    /// where all is met.
    pub fn unmet(&self) -> Option<String> {
        let rebound = self.struck.rebound.as_ref().filter(|rebound| rebound.error > SAID);
        let bbcor = rebound.map(|rebound| {
            format!("BBCOR is known to {:.0e}, which its digits are finer than", rebound.error)
        });
        let frequencies = (!self.hoop.met()).then(|| {
            let asked = self.test.tol;
            format!("asked {asked:e}; the error beside every frequency says how far it is known")
        });
        let all: Vec<String> = frequencies.into_iter().chain(bbcor).collect();
        (!all.is_empty()).then(|| all.join("; "))
    }

    /// Whether all is as accurate as was asked, or as it is said.
    pub fn met(&self) -> bool {
        self.unmet().is_none()
    }

    /// What a test of the barrel's compression takes.
    pub fn compressed(&self) -> Option<BarrelCompression> {
        self.struck.wall.as_ref().map(|wall| wall.compressed(&self.test.ball))
    }
}

impl BarrelStruck {
    /// The barrel of that bat and the ball that comes back from it.
    ///
    /// # Errors
    ///
    /// As [`HoopWall::of`], and as [`sweep`] for a hit.
    pub fn of(bat: &Bat, test: &BarrelTest) -> Result<Self> {
        let solved = match &test.known {
            Some(known) => known.on(bat)?,
            None => HoopWall::of(bat, test.ball.radius_m, test.accuracy.exit_speed)?,
        };
        let mut wall = PressedWall::under(&solved, bat, &test.ball, test.at);
        let rebound = match (&mut wall, test.ball.stiffness) {
            (Some(wall), Some(_)) => rebound(bat, &solved, test, wall)?,
            _ => None,
        };
        Ok(Self { first_hz: solved.first_hz(), wall, rebound })
    }
}

fn first(hoop: &Hoop) -> Option<&HoopMode> {
    hoop.modes().iter().find(|mode| mode.harmonic == 2)
}

/// The ball against the bat at rest and free, and how stiff the pressed wall is beside it; None where they do not
/// meet.
fn rebound(
    bat: &Bat,
    wall: &Arc<HoopWall>,
    test: &BarrelTest,
    pressed: &mut PressedWall,
) -> Result<Option<Rebound>> {
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
        let peak_force_n = outcome.peak_force.filter(|_| error.is_finite())?;
        pressed.over_ball = Some(figures.stiffness_over_ball);
        let WallBbcor { stiff, with, range } = figures.bbcor;
        Some(Rebound {
            ball: test.ball.clone(),
            ball_speed_m_s: test.ball_speed,
            cor: test.cor,
            stiff,
            wall: with,
            range,
            error,
            peak_force_n,
            dent_m: figures.dent_m,
            left_in_wall_j: outcome.energy.wall,
            initial_j: outcome.energy.initial,
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
