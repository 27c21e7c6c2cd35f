//! What ball and bat do when they meet at `x`: exit speed, impulse and where the energy went.

use crate::bat::{Bat, STANDARD_PIVOT};
use crate::collision::ball::Ball;
use crate::collision::energy_loss::EnergyLoss;
use crate::collision::rigid::{Incoming, Motion, RigidBat};
use crate::dowel::wpi_alpha;
use crate::modes::Mode;
use crate::solve::Solution;

/// How the bat's bending is counted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Model {
    /// Not at all.
    Rigid,
    /// By the WPI report's empirical loss.
    EnergyLoss(EnergyLoss),
}

/// A swing meets a pitch.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Rotation centre of the swing beyond the knob end (m), negative inside the handle.
    pub pivot: f64,
    /// Angular speed of the swing (rad/s).
    pub swing: f64,
    pub ball: Ball,
    /// Speed of the ball towards the bat (m/s).
    pub ball_speed: f64,
    /// Coefficient of restitution.
    pub cor: f64,
}

/// One impact. What does not exist (no real solution, no contact) is None.
#[derive(Debug, Clone, PartialEq)]
pub struct Impact {
    /// From the knob end (m).
    pub x: f64,
    /// Speed of the bat at `x` before the hit (m/s).
    pub bat_speed: f64,
    /// What the same bat would do if it did not bend (m/s).
    pub rigid_exit_speed: Option<f64>,
    pub outcome: Option<Outcome>,
    /// Why there is no outcome.
    pub flags: Vec<&'static str>,
}

/// What the hit left behind.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Speed of the ball off the bat (m/s).
    pub exit_speed: f64,
    /// `J` (N s).
    pub impulse: f64,
    /// `e_A = (v_out − V)/(v_in + V)`.
    pub collision_efficiency: f64,
    /// `e_A (1 + r) + r`, r = m/M_eff of the free bat.
    pub bbcor: f64,
    /// The same with `r = m Q²/I` of the bat held 6 in from the knob.
    pub bbcor_pivoted: f64,
    pub energy: Energy,
    /// Estimated error of the exit speed, relative to the closing speed.
    pub error: f64,
}

/// The energies (J) before and after, each computed on its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Energy {
    pub initial: f64,
    pub ball: f64,
    pub bat_rigid: f64,
    pub vibration_by_mode: Vec<f64>,
    pub dissipated_ball: f64,
}

impl Energy {
    /// In all bending modes (J).
    pub fn vibration(&self) -> f64 {
        // An empty sum of floats is −0, which is no energy to print.
        self.vibration_by_mode.iter().fold(0.0, |sum, energy| sum + energy)
    }

    /// What the model created (−) or lost sight of (+) (J).
    pub fn imbalance(&self) -> f64 {
        self.initial - self.ball - self.bat_rigid - self.vibration() - self.dissipated_ball
    }
}

/// A bat about to be hit: all that is the same for every impact point.
pub struct Hitter<'a> {
    model: Model,
    scene: &'a Scene,
    solution: &'a Solution,
    bat: RigidBat,
    motion: Motion,
    /// The body's inertia about the standard pivot, for the pivoted BBCOR (kg m²).
    pivot_inertia: f64,
}

impl<'a> Hitter<'a> {
    /// A free bat in that scene. It recoils as its theory says: without rotary inertia, as a line
    /// of mass.
    pub fn new(model: Model, scene: &'a Scene, bat: &Bat, solution: &'a Solution) -> Self {
        let body = bat.inertia();
        let line = if solution.theory.turns() { body } else { body.as_line() };
        let rigid = RigidBat {
            mass: line.mass,
            balance_point: line.balance_point,
            inertia: line.about_balance,
        };
        let motion = rigid.swung(scene.swing, scene.pivot);
        let pivot_inertia = body.about(STANDARD_PIVOT);
        Self { model, scene, solution, bat: rigid, motion, pivot_inertia }
    }

    /// Number of bending modes that the model counts.
    pub fn modes_used(&self) -> usize {
        match self.model {
            Model::Rigid => 0,
            Model::EnergyLoss(_) => self.solution.modes.len(),
        }
    }

    /// The exit speed at `x` (m/s), None where there is none.
    pub fn exit_speed(&self, x: f64) -> Option<f64> {
        let rigid = self.rigid_exit(x)?;
        match self.model {
            Model::Rigid => Some(rigid),
            Model::EnergyLoss(loss) => {
                let shapes = report_shapes(&self.solution.modes, self.bat.mass, x);
                let vibration = loss.vibration(&shapes);
                EnergyLoss::exit_velocity(-self.scene.ball_speed, rigid, vibration)
            }
        }
    }

    /// The energy left in vibration at `x` (J), None where there is no outcome or no vibration.
    pub fn vibration(&self, x: f64) -> Option<f64> {
        let outcome = self.strike(x).outcome?;
        (self.modes_used() > 0).then(|| outcome.energy.vibration())
    }

    /// The hit at `x` (m from the knob end).
    pub fn strike(&self, x: f64) -> Impact {
        let bat_speed = self.bat.speed_at(x, self.motion);
        let rigid_exit_speed = self.rigid_exit(x);
        let outcome = self.exit_speed(x).map(|exit_speed| self.outcome(x, bat_speed, exit_speed));
        let flags = match (rigid_exit_speed, &outcome) {
            (None, _) => vec!["no_contact"],
            (_, None) => vec!["no_real_solution"],
            _ => vec![],
        };
        Impact { x, bat_speed, rigid_exit_speed, outcome, flags }
    }

    fn incoming(&self) -> Incoming {
        let Scene { ball, ball_speed, cor, .. } = self.scene;
        Incoming { mass: ball.mass, velocity: -ball_speed, restitution: *cor }
    }

    /// None where the bat runs away from the ball.
    fn rigid_exit(&self, x: f64) -> Option<f64> {
        let closing = self.bat.speed_at(x, self.motion) + self.scene.ball_speed;
        (closing > 0.0).then(|| self.bat.strike(self.motion, self.incoming(), x).ball_velocity)
    }

    fn outcome(&self, x: f64, bat_speed: f64, exit_speed: f64) -> Outcome {
        let Scene { ball, ball_speed, .. } = self.scene;
        let closing = bat_speed + ball_speed;
        let impulse = ball.mass * (exit_speed + ball_speed);
        let kinetic = |speed: f64| 0.5 * ball.mass * speed * speed;
        let efficiency = (exit_speed - bat_speed) / closing;
        let bbcor = |r: f64| efficiency * (1.0 + r) + r;
        let rigid = self.bat.strike(self.motion, self.incoming(), x);
        let mut vibration_by_mode = Vec::new();
        // The models' own formulas are exact to a few roundings.
        let mut error = 8.0 * f64::EPSILON;
        if let Model::EnergyLoss(loss) = self.model {
            let shapes = report_shapes(&self.solution.modes, self.bat.mass, x);
            vibration_by_mode = loss.energies(&shapes, impulse, ball.mass);
            let largest = largest_shapes(&self.solution.modes, self.bat.mass, x);
            let vibration = loss.vibration(&largest);
            let other =
                EnergyLoss::exit_velocity(-self.scene.ball_speed, rigid.ball_velocity, vibration);
            // No bound on the shapes is no bound on the loss.
            let other = other.filter(|v| v.is_finite());
            error += other.map_or(1.0, |v| (v - exit_speed).abs() / closing);
        }
        Outcome {
            exit_speed,
            impulse,
            collision_efficiency: efficiency,
            bbcor: bbcor(ball.mass / self.bat.recoil_mass(x)),
            bbcor_pivoted: bbcor(ball.mass * (x - STANDARD_PIVOT).powi(2) / self.pivot_inertia),
            energy: Energy {
                initial: kinetic(*ball_speed) + self.bat.kinetic_energy(self.motion),
                ball: kinetic(exit_speed),
                bat_rigid: self.bat.kinetic_energy(self.bat.after(self.motion, impulse, x)),
                vibration_by_mode,
                dissipated_ball: rigid.dissipated,
            },
            error,
        }
    }
}

/// Deflections at `x` in the WPI report's scaling, `(1/M) ∫ρA W_n² dx = α_n²`, which on its dowel
/// is exactly the report's raw shape.
fn report_shapes(modes: &[Mode], mass: f64, x: f64) -> Vec<f64> {
    let scaled = |mode: &Mode| {
        mode.shape.deflection(x) * wpi_alpha(mode.order) * (mass / mode.modal_mass).sqrt()
    };
    modes.iter().map(scaled).collect()
}

/// The same, each as large as the errors of its mode allow.
fn largest_shapes(modes: &[Mode], mass: f64, x: f64) -> Vec<f64> {
    let with_error = |mode: &Mode| {
        let deflection = mode.shape.deflection(x).abs() + mode.error.shape;
        let lightest = mode.modal_mass * (1.0 - mode.error.modal_mass).max(0.0);
        deflection * wpi_alpha(mode.order) * (mass / lightest).sqrt()
    };
    modes.iter().map(with_error).collect()
}
