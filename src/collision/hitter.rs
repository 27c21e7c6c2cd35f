//! A bat that can be hit at any place, by one of the models.
//!
//! The result of a hit on a free bat is relative to the ground; the bat moves as it was swung. The result for a held
//! bat (on a test rig's pin, or in hands) is relative to its hands: the bat is at rest and the ball comes at the
//! closing speed. The impulse is the same in both cases.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

use crate::base::error::{Error, Result};
use crate::bat::body::{Bat, STANDARD_PIVOT};
use crate::bat::profile::Profile;
use crate::collision::contact::abreast::meet::Place;
use crate::collision::contact::collider::{Collider, Law};
use crate::collision::contact::encounter::Encounter;
use crate::collision::contact::power_law::PowerLaw;
use crate::collision::contact::touch::DrivingPoint;
use crate::collision::hit::{Effort, Model, Scene, Wall};
use crate::collision::hoop_wall::{HoopWall, WallFelt};
use crate::collision::rigid::{RigidBat, RigidVelocity};
use crate::collision::stated::{QUICK, SLOW};
use crate::collision::struck::{Struck, recoil_between, without_springs};
use crate::modes::compliance::RigidMotion;
use crate::modes::solve::Solution;

/// A bat in a scene: everything that does not depend on the impact point.
pub struct Hitter<'a> {
    pub(super) model: Model,
    /// Swing, pitch and ball.
    pub scene: &'a Scene,
    pub(super) solution: &'a Solution,
    /// Radii along the bat.
    pub profile: &'a Profile,
    pub(super) bat: RigidBat,
    pub(super) motion: RigidVelocity,
    pub(super) held: bool,
    /// Rigid motions of a held bat that does not bend; springs and hands are too slow for a hit.
    pub(super) stiff: Vec<RigidMotion>,
    /// Moment of inertia about the standard pivot, for the pivoted BBCOR (kg m²).
    pivot_inertia: f64,
    pub(super) struck: Arc<Struck<'a>>,
    pub(super) effort: Effort,
    /// ω (rad/s) and damping ratio of every mode.
    pub(super) modes: Vec<[f64; 2]>,
    /// Approximate duration of the compression on a stiff bat (s); NaN without a force law.
    pub(super) pressed: f64,
    pub(super) collider: Option<Collider>,
    /// The same with hoop modes of the wall that are slower by their possible error; `None` without such modes.
    slower: OnceLock<Option<Collider>>,
    /// The wall's response to the ball, and the error of that, relative to the closing speed.
    wall: Option<Wall>,
    pub(super) wall_error: f64,
    /// The wall with its own hoop modes.
    pub(super) hoop: Option<Arc<HoopWall>>,
    /// ω (rad/s) and damping ratio of the wall's modes, which are the first modes of a contact.
    pub(super) wall_modes: Vec<[f64; 2]>,
    /// Steps times modes of all contacts so far.
    work: AtomicU64,
}

/// A hit is refused on a bat that is lighter than this share of the ball's mass and whose first mode turns through less
/// than this phase (rad) during the compression: the ball carries the bat along, and each place takes seconds to
/// compute.
const CARRIED: [f64; 2] = [0.1, 0.1];
/// Longest usual step of a contact, as a share of the duration of the compression: about a quarter of the way to the
/// largest compression. According to the example `tuning_steps`, half of it costs half as many steps more at rough
/// accuracies, and twice as much saves hardly any at good ones.
const LONGEST: f64 = 0.28;

impl<'a> Hitter<'a> {
    /// A bat in that scene. A free bat recoils according to its theory: without rotary inertia, as a line of mass.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a contact with a ball whose force law is not known or that carries the bat along, a held
    /// bat by the WPI report's model, and a contact with a mode that dashpots keep from swinging.
    pub fn new(
        model: Model,
        scene: &'a Scene,
        bat: &'a Bat,
        solution: &'a Solution,
        effort: Effort,
    ) -> Result<Self> {
        let bat = solution.of(bat);
        let struck = Arc::new(Struck::new(bat, solution));
        Self::of(model, scene, bat, struck, effort)
    }

    /// The bat in another scene.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn in_scene(&self, scene: &'a Scene, bat: &'a Bat) -> Result<Self> {
        let bat = self.struck.solution.of(bat);
        Self::of(self.model, scene, bat, Arc::clone(&self.struck), self.effort)
    }

    fn of(
        model: Model,
        scene: &'a Scene,
        bat: &'a Bat,
        struck: Arc<Struck<'a>>,
        effort: Effort,
    ) -> Result<Self> {
        let held = bat.fixtures().holding();
        if held && matches!(model, Model::EnergyLoss(_)) {
            let expected = "a free bat, which the report's fit is for, or another model";
            return Err(Error::value("model energy-loss", "a bat that is held", expected));
        }
        let solution = struck.solution;
        let body = bat.inertia();
        let line = if solution.theory.turns() { body } else { body.as_line() };
        let rigid = RigidBat {
            mass: line.mass,
            balance_point: line.balance_point,
            inertia: line.about_balance,
        };
        let motion = rigid.swung(scene.swing, scene.pivot);
        let modes = struck.modes();
        let speed = rigid.speed_at(0.75 * bat.length(), motion).abs() + scene.ball_speed;
        let mass = 1.0 / (1.0 / scene.ball.mass_kg + 1.0 / rigid.mass);
        let energy = 0.5 * mass * speed * speed;
        let law = scene.force_law(scene.cor, energy);
        // Approximate duration of the compression; NaN without a law or a speed.
        let pressed = law.as_ref().map_or(f64::NAN, |law| law.pressed_by(energy) / speed);
        let turned = modes.first().map_or(f64::INFINITY, |[omega, _]| omega * pressed);
        let share = rigid.mass / scene.ball.mass_kg;
        if model == Model::Contact && !held && share < CARRIED[0] && turned < CARRIED[1] {
            return Err(carried(rigid.mass, scene.ball.mass_kg, turned));
        }
        let (wall, wall_error) = felt_wall(scene.wall, pressed, effort.accuracy);
        let wall_error = wall_error + scene.hoop.error();
        let hoop = scene.hoop.wall().filter(|_| model == Model::Contact && wall.is_none());
        let hoop = hoop.map(|hoop| hoop.on(bat)).transpose()?;
        let wall_modes = match &hoop {
            Some(hoop) => hoop.modes(),
            None => swinging(wall).into_iter().collect(),
        };
        let collider = match model {
            Model::Contact => {
                law?;
                Some(collider(&modes, &wall_modes, pressed)?)
            }
            _ => None,
        };
        Ok(Self {
            model,
            scene,
            solution,
            profile: bat.profile(),
            bat: rigid,
            motion,
            held,
            stiff: if held { without_springs(bat, solution) } else { vec![] },
            pivot_inertia: body.about(STANDARD_PIVOT),
            struck,
            effort,
            modes,
            pressed,
            collider,
            slower: OnceLock::new(),
            wall,
            wall_error,
            hoop,
            wall_modes,
            work: AtomicU64::new(0),
        })
    }

    /// Steps times modes of all contacts so far.
    pub(super) fn work(&self) -> u64 {
        self.work.load(Ordering::Relaxed)
    }

    /// Number of bending modes that the model counts.
    pub fn modes_used(&self) -> usize {
        match self.model {
            Model::Rigid => 0,
            _ => self.solution.modes.len(),
        }
    }

    /// Number of modes that are slow compared with the contact: less than two thirds as quick as the last one must be.
    pub(super) fn slow_modes(&self) -> usize {
        self.modes.iter().take_while(|[omega, _]| omega * self.pressed < SLOW * QUICK).count()
    }

    /// Approximate number of modes for which the last one is quick compared with the contact; `None` if it is already.
    pub(super) fn modes_for_contact(&self) -> Option<usize> {
        /// Largest factor on the number of modes in one round.
        const AT_ONCE: f64 = 4.0;
        let [last, _] = *self.modes.last()?;
        // Frequencies rise as the square of the number, or more slowly with shear; another round then follows.
        let more = (QUICK / (last * self.pressed)).sqrt();
        let count = self.modes.len() as f64 * more.clamp(1.2, AT_ONCE);
        (self.collider.is_some() && more > 1.0).then_some(count.ceil() as usize)
    }

    /// `e_A` of a ball that leaves from `x` with that speed (m/s), and from it the BBCOR of the free bat and of the bat
    /// held at the standard pivot. A bat that is held has its own effective mass in both.
    pub fn figures(&self, x: f64, exit_speed: f64) -> [f64; 3] {
        let bat_speed = self.bat.speed_at(x, self.motion);
        let efficiency = (exit_speed - bat_speed) / (bat_speed + self.scene.ball_speed);
        let bbcor = |r: f64| efficiency * (1.0 + r) + r;
        let ball = self.scene.ball.mass_kg;
        if self.held {
            return [efficiency, bbcor(ball * self.recoil(x)), bbcor(ball * self.recoil(x))];
        }
        let pivoted = ball * (x - STANDARD_PIVOT).powi(2) / self.pivot_inertia;
        [efficiency, bbcor(ball / self.bat.recoil_mass(x)), bbcor(pivoted)]
    }

    /// `1/M_eff` (1/kg): the mobility of a bat that does not bend at `x`.
    pub(super) fn recoil(&self, x: f64) -> f64 {
        if self.held { recoil_between(&self.stiff, x, x) } else { 1.0 / self.bat.recoil_mass(x) }
    }

    /// The rigid motions of a held bat in this model. If modes are counted, the motions in springs and hands are among
    /// the modes.
    pub(super) fn motions(&self) -> &[RigidMotion] {
        if self.model == Model::Rigid { &self.stiff } else { self.struck.rigid() }
    }

    /// The velocity (m/s) that an impulse of 1 N s at `x` gives a stiff bat at another place.
    pub(super) fn recoil_between(&self, x: f64, there: f64) -> f64 {
        if self.held {
            return recoil_between(self.motions(), x, there);
        }
        let [x, there] = [x, there].map(|x| x - self.bat.balance_point);
        1.0 / self.bat.mass + x * there / self.bat.inertia
    }

    /// The closing speed (m/s); `None` if the bat moves away from the ball.
    pub(super) fn closing(&self, x: f64) -> Option<f64> {
        let closing = self.bat.speed_at(x, self.motion) + self.scene.ball_speed;
        (closing > 0.0).then_some(closing)
    }

    /// μ (kg) and e₀ of a hit at `x` with that closing speed (m/s).
    pub(super) fn blow(&self, x: f64, closing: f64) -> [f64; 2] {
        let mass = 1.0 / (1.0 / self.scene.ball.mass_kg + self.recoil(x));
        [mass, self.scene.restitution(0.5 * mass * closing * closing)]
    }

    /// The exit speed (m/s) of a stiff bat; `None` if the bat moves away from the ball.
    pub(super) fn rigid_exit(&self, x: f64) -> Option<f64> {
        let closing = self.closing(x)?;
        let [mass, cor] = self.blow(x, closing);
        Some(mass * (1.0 + cor) * closing / self.scene.ball.mass_kg - self.scene.ball_speed)
    }

    /// Whether the bat can be hit at `x`: a point would deflect without limit.
    pub(super) fn has_section(&self, x: f64) -> bool {
        matches!(self.model, Model::Rigid | Model::EnergyLoss(_)) || self.profile.at(x).outer > 0.0
    }

    /// The bat's response at `x` (m), with as many modes as the effort takes.
    pub(super) fn felt(&self, x: f64) -> DrivingPoint {
        let beyond = self.effort.completed.then(|| self.struck.flexibility(x));
        self.with_wall(x, self.bent(x, self.by_modes(x), beyond))
    }

    /// The bat's response at `x` (m) by its modes alone.
    pub(super) fn by_modes(&self, x: f64) -> DrivingPoint {
        self.struck.with_modes(x, self.scene.ball.mass_kg, self.modes_used())
    }

    /// That response at `x` (m) with the wall added.
    pub(super) fn with_wall(&self, x: f64, mut felt: DrivingPoint) -> DrivingPoint {
        match self.wall {
            Some(wall) if wall.mass > 0.0 => felt.gains.insert(0, 1.0 / wall.mass),
            Some(wall) => felt.rest += 1.0 / wall.stiffness,
            None => {}
        }
        match self.under(x) {
            Some(under) => under.full.before(felt),
            None => felt,
        }
    }

    /// The bat's response at `x` (m) without its wall: that of these modes, and of all modes beyond if their
    /// flexibility is given.
    pub(super) fn bent(
        &self,
        x: f64,
        modes: DrivingPoint,
        beyond: Option<[f64; 2]>,
    ) -> DrivingPoint {
        match beyond {
            None => modes,
            Some(beyond) => self.struck.completed(x, modes, beyond),
        }
    }

    /// The wall at `x` (m), where it deflects in its hoop modes.
    pub(super) fn under(&self, x: f64) -> Option<WallFelt> {
        Some(self.hoop.as_ref()?.under(x, self.scene.ball.patch_compression()))
    }

    /// The force law with the e₀ of the hit, which later touches of the same hit keep.
    pub(super) fn law_at(&self, x: f64, closing: f64) -> Option<Box<dyn Law>> {
        let [mass, cor] = self.blow(x, closing);
        self.scene.force_law(cor, 0.5 * mass * closing * closing).ok()
    }

    /// The encounter and the accuracy of its steps, which may have to be better than requested.
    pub(super) fn meet(&self, blow: Blow, accuracy: f64) -> Option<(Encounter, f64)> {
        self.meet_all(&[blow], accuracy).pop()?
    }

    fn collider(&self, slower: bool) -> Option<&Collider> {
        let made = || {
            let (off, wall) = (self.hoop.as_ref()?.off(), self.wall_modes.iter());
            let wall: Vec<_> = wall.map(|[omega, ratio]| [omega * (1.0 - off), *ratio]).collect();
            collider(&self.modes, &wall, self.pressed).ok()
        };
        if slower { self.slower.get_or_init(made).as_ref() } else { self.collider.as_ref() }
    }

    /// The encounters at several places, each with the accuracy of its steps; they are computed side by side if
    /// possible, with equal bits. Encounters that magnify small changes are always compared with other bats.
    pub(super) fn meet_all(&self, blows: &[Blow], accuracy: f64) -> Vec<Option<(Encounter, f64)>> {
        let mut all = self.meet_each(blows, accuracy);
        let delicate = |k: &usize| match &all[*k] {
            Some((met, _)) => met.is_delicate() && !blows[*k].compared,
            None => false,
        };
        let again: Vec<usize> = (0..blows.len()).filter(delicate).collect();
        let compared = again.iter().map(|k| Blow { compared: true, ..blows[*k] });
        let met = self.meet_each(&compared.collect::<Vec<_>>(), accuracy);
        again.into_iter().zip(met).for_each(|(k, met)| all[k] = met);
        all
    }

    /// The encounters at several places; those that cannot be computed side by side are computed alone.
    fn meet_each(&self, blows: &[Blow], accuracy: f64) -> Vec<Option<(Encounter, f64)>> {
        let abreast = self.meet_abreast(blows, accuracy).into_iter().zip(blows);
        abreast.map(|(met, blow)| met.or_else(|| self.meet_alone(blow, accuracy))).collect()
    }

    /// The encounters that can be computed side by side.
    fn meet_abreast(&self, blows: &[Blow], accuracy: f64) -> Vec<Option<(Encounter, f64)>> {
        let mut all = vec![None; blows.len()];
        let slower = blows.first().is_some_and(|blow| blow.slower);
        let Some(collider) = self.collider(slower) else { return all };
        let others = |blow: &Blow| if blow.compared { (blow.others)() } else { vec![] };
        let others: Vec<Vec<DrivingPoint>> = blows.iter().map(others).collect();
        let (mut places, mut which) = (vec![], vec![]);
        for (k, Blow { x, felt, closing: speed, .. }) in blows.iter().enumerate() {
            let law = self.law_at(*x, *speed).and_then(|law| law.powers());
            if let Some([stiffness, exponent, unloading]) = law {
                let law = PowerLaw { stiffness, exponent, unloading };
                places.push(Place { felt, others: &others[k], law, speed: *speed });
                which.push(k);
            }
        }
        for (k, met) in which.into_iter().zip(collider.meet_abreast(&places, accuracy)) {
            let Some(met) = met else { continue };
            self.work.fetch_add(met.work(), Ordering::Relaxed);
            let sound = met.is_sound(blows[k].felt, blows[k].closing);
            all[k] = sound.then_some((met, accuracy));
        }
        all
    }

    /// The encounter at a place alone, with steps as short as it needs.
    pub(super) fn meet_alone(&self, blow: &Blow, accuracy: f64) -> Option<(Encounter, f64)> {
        let Blow { x, felt, closing, .. } = *blow;
        let (collider, law) = (self.collider(blow.slower)?, self.law_at(x, closing)?);
        let others = if blow.compared { (blow.others)() } else { vec![] };
        let meet = |accuracy| {
            let met = collider.meet_beside(felt, &others, &*law, closing, accuracy);
            self.work.fetch_add(met.work(), Ordering::Relaxed);
            (met, accuracy)
        };
        resolved(accuracy, meet, felt, closing)
    }
}

/// A ball about to meet the bat at `x` (m) at that closing speed (m/s).
#[derive(Clone, Copy)]
pub(super) struct Blow<'a> {
    pub x: f64,
    pub felt: &'a DrivingPoint,
    /// Varied bats, of no more modes.
    pub others: &'a dyn Fn() -> Vec<DrivingPoint>,
    pub closing: f64,
    /// Whether it is compared with those also where ball and bat touch once.
    pub compared: bool,
    /// Whether it meets slower hoop modes, as all of its group.
    pub slower: bool,
}

impl<'a> Blow<'a> {
    /// One that is compared with no varied bats.
    pub fn alone(x: f64, felt: &'a DrivingPoint, closing: f64) -> Self {
        Self { x, felt, others: &Vec::new, closing, compared: true, slower: false }
    }
}

/// The error for a bat (kg) that a ball (kg) carries along; its first mode turns through that phase (rad) meanwhile.
fn carried(bat: f64, ball: f64, turned: f64) -> Error {
    let found = format!(
        "a bat of {bat:.2e} kg, whose first mode goes through {turned:.0e} rad while the ball is pressed"
    );
    let expected = format!(
        "one of {:.2e} kg at least, a tenth of the ball's mass, or a stiffer one: the ball carries this one along; \
         `sweetspot modes` has its modes",
        CARRIED[0] * ball
    );
    Error::value("hit", found, expected)
}

/// The modes of a contact, those of the wall first, for a compression of about that duration (s).
fn collider(modes: &[[f64; 2]], wall: &[[f64; 2]], pressed: f64) -> Result<Collider> {
    if let Some(k) = modes.iter().position(|[_, ratio]| *ratio >= 1.0) {
        let found = format!("mode {} with a damping ratio of {:.2}", k + 1, modes[k][1]);
        let expected = "dashpots that let every mode swing (a ratio below 1), or none: a hit is over \
                        before the hands have felt it";
        return Err(Error::value("hit", found, expected));
    }
    let longest = if pressed.is_finite() { LONGEST * pressed } else { 1.0 };
    let all = [wall, modes].concat();
    Ok(Collider::new(&all, longest))
}

/// The encounter with steps of that accuracy, or of a better one if these fail. `None` if no reasonable number of steps
/// comes to an end, as for a bat so light that the ball carries it along.
pub(super) fn resolved<T>(
    accuracy: f64,
    meet: impl Fn(f64) -> (Encounter, T),
    felt: &DrivingPoint,
    closing: f64,
) -> Option<(Encounter, T)> {
    const TRIES: i32 = 12;
    const FINER: f64 = 0.2;
    let tried = (0..TRIES).map(|k| meet(FINER.powi(k) * accuracy));
    let mut ended = tried.take_while(|(met, _)| !met.is_exhausted());
    ended.find(|(met, _)| met.is_sound(felt, closing))
}

/// ω (rad/s) and damping ratio of a wall that has a mass.
fn swinging(wall: Option<Wall>) -> Option<[f64; 2]> {
    let wall = wall.filter(|wall| wall.mass > 0.0)?;
    Some([(wall.stiffness / wall.mass).sqrt(), 0.0])
}

/// The wall's response to a ball that is compressed for about the time τ (s), and its error, relative to the closing
/// speed. A wall so light that it vibrates many times meanwhile follows the force like a spring, except for about
/// `1/(ωτ)²`.
fn felt_wall(wall: Option<Wall>, time: f64, accuracy: f64) -> (Option<Wall>, f64) {
    /// Share of the steps' accuracy.
    const SHARE: f64 = 0.05;
    let Some([omega, _]) = swinging(wall) else { return (wall, 0.0) };
    let error = (omega * time).powi(-2);
    match error <= SHARE * accuracy {
        true => (wall.map(|wall| Wall { mass: 0.0, ..wall }), error),
        false => (wall, 0.0),
    }
}
