//! How does a hollow barrel ring, and how does a ball come back from it?

use std::sync::Arc;

use serde::Serialize;

use crate::engine::{
    ASSUMED_POISSON_RATIO, Accuracy, Ball, Bat, Fixtures, Hitter, Hoop, HoopInHit, HoopMode,
    HoopRequest, HoopWall, KnobSide, Material, Model, Result, Scene, Sweep, TEST_SPEED, Trial,
    WallBbcor, poisson_ratio, sweep,
};
use crate::trampoline::pressed::{BarrelCompression, PressedWall};

/// Default impact point on a barrel, from the tip: 6 in (m).
pub const FROM_TIP: f64 = 0.1524;

/// The test of a barrel.
#[derive(Debug, Clone)]
pub struct BarrelTest {
    /// Impact point (m from the knob end).
    pub at: f64,
    /// The ball that is shot at the free bat at rest.
    pub ball: Ball,
    /// Speed of the ball (m/s).
    pub ball_speed: f64,
    /// Coefficient of restitution of the ball on a rigid wall, unless the ball's depends on the speed.
    pub cor: f64,
    /// Number of requested hoop modes, the lowest ones.
    pub modes: usize,
    /// Largest relative error of their frequencies.
    pub tol: f64,
    /// How accurate the exit speeds are to be.
    pub accuracy: Accuracy,
    /// The wall of a bat under that ball, if it is already known; for another bat it is solved too.
    pub known: Option<Arc<HoopWall>>,
}

impl BarrelTest {
    /// A ball at the speed of laboratories, 6 in from the tip of that bat, every frequency to that accuracy; exit
    /// speeds to 1e-4, as three digits of BBCOR need it: the uncertainty due to the patch is far larger.
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
    /// The test.
    pub test: BarrelTest,
    /// The lowest hoop modes.
    hoop: Hoop,
    /// The model of the modes.
    pub model: HoopModel,
    /// Relative change of the first frequency of harmonic 2 if Poisson's ratio is 0.05 smaller or larger; `None` if the
    /// ratio is known.
    pub by_poisson: Option<[f64; 2]>,
    /// The wall and the ball.
    pub struck: BarrelStruck,
}

/// The model of the modes.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct HoopModel {
    /// Beginning of the modelled stretch (m).
    pub from_m: f64,
    /// End of the modelled stretch (m).
    pub to_m: f64,
    /// Wanted relative accuracy of every frequency.
    pub tolerance: f64,
    /// Relative rise of the first mode of harmonic 2 if the stretch is clamped at its beginning: a measure of the
    /// remaining motion there.
    // None if that cannot be solved.
    pub clamped_change: Option<f64>,
}

/// A barrel that a ball was shot at.
#[derive(Debug, Clone)]
pub struct BarrelStruck {
    /// Frequency of the first mode of harmonic 2 (Hz), as accurate as the hit needs it.
    pub first_hz: Option<f64>,
    /// The wall under the ball; `None` if the ball does not meet the modelled stretch.
    pub wall: Option<PressedWall>,
    /// The rebound of the ball; `None` without a wall under it and for a ball without a force law.
    pub rebound: Option<Rebound>,
}

/// The rebound of a ball from the bat at rest and free, without and with its wall.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Rebound {
    /// The ball.
    pub ball: Ball,
    /// Speed of the ball (m/s).
    pub ball_speed_m_s: f64,
    /// Coefficient of restitution of the ball on a rigid wall, unless the ball's depends on the speed.
    pub cor: f64,
    /// BBCOR of the bat with a rigid wall.
    pub stiff: f64,
    /// BBCOR of the bat with its wall.
    pub wall: f64,
    /// BBCOR with the patch of a ball compressed twice and half as much, the lesser first: the uncertainty due to the
    /// size of the patch.
    pub range: [f64; 2],
    /// Error of `wall` due to the computation.
    pub error: f64,
    /// Largest force between ball and bat (N).
    pub peak_force_n: f64,
    /// How deep that force, acting slowly, dents the wall (m).
    pub dent_m: f64,
    /// Energy left in the wall after the contact (J).
    pub left_in_wall_j: f64,
    /// Energy of the ball before (J).
    pub initial_j: f64,
}

/// BBCOR is printed to three digits; the uncertainty due to the patch is ten times as large.
const SAID: f64 = 1e-3;
/// Default number of hoop modes.
const MODES: usize = 10;

impl Barrel {
    /// The barrel of that bat with its uncertainties: an unknown Poisson's ratio, and motion of the first mode at the
    /// end of the stretch. `hits` of the bat, if there are some, have modes for the ball's rebound too.
    ///
    /// # Errors
    ///
    /// As [`Hoop::first`] and [`BarrelStruck::of`].
    pub fn of(bat: &Bat, test: BarrelTest, hits: Option<&Sweep>) -> Result<Self> {
        let hoop = Hoop::first(bat, test.modes, test.tol)?;
        let struck = BarrelStruck::of(bat, &test, hits)?;
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
        let by_poisson = match knows_poisson(bat, [hoop.from(), hoop.to()]) {
            true => None,
            false => other(-SPREAD).zip(other(SPREAD)).map(|(less, more)| [less, more]),
        };
        Ok(Self { test, hoop, model, by_poisson, struck })
    }

    /// The lowest modes of the wall.
    pub fn hoop(&self) -> &Hoop {
        &self.hoop
    }

    /// The result that is less accurate than requested, in words: a frequency, or BBCOR to three digits; `None` if all
    /// are met.
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

    /// Whether everything is as accurate as requested, or as it is printed.
    pub fn met(&self) -> bool {
        self.unmet().is_none()
    }

    /// The force in a test of the barrel's compression.
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
    pub fn of(bat: &Bat, test: &BarrelTest, hits: Option<&Sweep>) -> Result<Self> {
        let solved = match &test.known {
            Some(known) => known.on(bat)?,
            None => HoopWall::of(bat, test.ball.radius_m, test.accuracy.exit_speed)?,
        };
        let mut wall = PressedWall::under(&solved, bat, &test.ball, test.at);
        let rebound = match (&mut wall, test.ball.stiffness) {
            (Some(wall), Some(_)) => rebound((bat, hits), &solved, test, wall)?,
            _ => None,
        };
        Ok(Self { first_hz: solved.first_hz(), wall, rebound })
    }
}

fn first(hoop: &Hoop) -> Option<&HoopMode> {
    hoop.modes().iter().find(|mode| mode.harmonic == 2)
}

/// The rebound of the ball from the free bat at rest, and the stiffness of the wall compared with the ball's; `None` if
/// they do not meet.
fn rebound(
    (bat, hits): (&Bat, Option<&Sweep>),
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
    let (model, scene) = (Model::Contact, &scene);
    let hits = match hits.filter(|_| free == *bat) {
        Some(hits) => hits.again(bat, Trial { model, scene }, &test.accuracy, &[test.at])?,
        None => sweep(&free, model, scene, &test.accuracy, &[test.at])?,
    };
    let hitter = Hitter::new(model, scene, &free, &hits.solution, hits.effort)?;
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

/// Possible difference of Poisson's ratio from the assumed one.
const SPREAD: f64 = 0.05;

/// Whether Poisson's ratio of everything on that stretch (m) is known.
fn knows_poisson(bat: &Bat, [from, to]: [f64; 2]) -> bool {
    let pieces = bat.profile().pieces.iter();
    let mut there = pieces.filter(|piece| piece.start < to && piece.start + piece.length > from);
    there.all(|piece| bat.layup(piece).materials().all(has_poisson))
}

/// Whether a material has a Poisson's ratio, or those of a composite.
fn has_poisson(material: &Material) -> bool {
    material.poisson_ratios.is_some() || poisson_ratio(material).is_some()
}

/// The bat with an unknown Poisson's ratio assumed that much off the usual one.
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
