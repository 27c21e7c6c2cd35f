//! How does a ball rebound from a free bat that does not bend?
//!
//! ```text
//! 1/m_eff = 1/M + y²/I          what the bat weighs at the ball, y from the balance point
//! J = μ (1 + e) u               1/μ = 1/m + 1/m_eff,  u = V − v the closing speed
//! v′ = v + J/m,  v_c′ = v_c − J/M,  Ω′ = Ω − J y/I
//! ```
//!
//! The bat moves in +, so a pitched ball has `v < 0` here; it leaves with `v′ > 0` if hit back.
//! The hands do not matter: the contact ends before they feel it.

/// The properties of a rigid free body for a blow across its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidBat {
    /// Mass of the bat (kg).
    pub mass: f64,
    /// Distance of the balance point from the knob end (m).
    pub balance_point: f64,
    /// Moment of inertia about the balance point (kg m²).
    pub inertia: f64,
}

/// Motion of a rigid bat: velocity of its balance point across the axis (m/s), and rotation (rad/s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidVelocity {
    /// Velocity of the balance point across the axis (m/s).
    pub velocity: f64,
    /// Rotation, positive where the tip goes ahead (rad/s).
    pub rotation: f64,
}

/// A ball before the blow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Incoming {
    /// Mass of the ball (kg).
    pub mass: f64,
    /// Velocity of the ball, negative towards the bat (m/s).
    pub velocity: f64,
    /// Coefficient of restitution `e`: separation speed over closing speed.
    pub restitution: f64,
}

/// The result of a blow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rebound {
    /// Impulse `J` on the ball (N s).
    pub impulse: f64,
    /// Velocity `v′` of the ball after the blow (m/s).
    pub ball_velocity: f64,
    /// Motion of the bat after the blow.
    pub bat: RigidVelocity,
    /// Kinetic energy lost, `μ u² (1 − e²)/2` (J).
    pub dissipated: f64,
}

impl RigidBat {
    /// `m_eff` (kg): the point mass at `x` (m from the knob) that would recoil as the bat does.
    pub fn recoil_mass(&self, x: f64) -> f64 {
        let y = x - self.balance_point;
        1.0 / (1.0 / self.mass + y * y / self.inertia)
    }

    /// The motion of a bat turning at `rotation` (rad/s) about a point `pivot` (m) beyond the knob.
    pub fn swung(&self, rotation: f64, pivot: f64) -> RigidVelocity {
        RigidVelocity { velocity: rotation * (pivot + self.balance_point), rotation }
    }

    /// `V = v_c + Ω y` (m/s): the speed of the bat at `x`.
    pub fn speed_at(&self, x: f64, motion: RigidVelocity) -> f64 {
        motion.velocity + motion.rotation * (x - self.balance_point)
    }

    /// `M v_c²/2 + I Ω²/2` (J).
    pub fn kinetic_energy(&self, motion: RigidVelocity) -> f64 {
        (self.mass * motion.velocity.powi(2) + self.inertia * motion.rotation.powi(2)) / 2.0
    }

    /// The motion after giving the impulse `J` (N s) to a ball at `x`.
    pub fn after(&self, motion: RigidVelocity, impulse: f64, x: f64) -> RigidVelocity {
        RigidVelocity {
            velocity: motion.velocity - impulse / self.mass,
            rotation: motion.rotation - impulse * (x - self.balance_point) / self.inertia,
        }
    }

    /// The blow at `x`, by momentum, angular momentum and `e`.
    ///
    /// For a ball that does not approach, the equations hold formally but mean nothing.
    ///
    /// # Source
    ///
    /// Newton's impact law with both momenta kept. It is Eq. 1-7 of the WPI report (named in
    /// [`crate::collision::energy_loss::wpi_alpha`]), `v′ = v + k (1 + e) u/(1 + k + (M/I) y²)` with `k = M/m`,
    /// where the report's text misprints the ball's mass for the bat's in `M/I`.
    pub fn strike(&self, motion: RigidVelocity, ball: Incoming, x: f64) -> Rebound {
        let closing = self.speed_at(x, motion) - ball.velocity;
        let reduced = 1.0 / (1.0 / ball.mass + 1.0 / self.recoil_mass(x));
        let impulse = reduced * (1.0 + ball.restitution) * closing;
        Rebound {
            impulse,
            ball_velocity: ball.velocity + impulse / ball.mass,
            bat: self.after(motion, impulse, x),
            dissipated: reduced * closing.powi(2) * (1.0 - ball.restitution.powi(2)) / 2.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BAT: RigidBat = RigidBat { mass: 0.85, balance_point: 0.5, inertia: 0.06 };
    const BALL: Incoming = Incoming { mass: 0.145, velocity: -40.0, restitution: 0.5 };

    #[test]
    fn momentum_is_kept_and_the_energy_balance_closes() {
        let before = BAT.swung(50.0, 0.15);
        for x in [0.0, 0.2, 0.5, 0.7, 0.84] {
            let hit = BAT.strike(before, BALL, x);
            let y = x - BAT.balance_point;
            let linear = |v: f64, bat: RigidVelocity| BALL.mass * v + BAT.mass * bat.velocity;
            let angular =
                |v: f64, bat: RigidVelocity| BALL.mass * v * y + BAT.inertia * bat.rotation;
            let energy =
                |v: f64, bat: RigidVelocity| BALL.mass * v * v / 2.0 + BAT.kinetic_energy(bat);
            let same = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * (1.0 + a.abs()), "{a} {b}");
            let (v, after) = (hit.ball_velocity, hit.bat);
            same(linear(BALL.velocity, before), linear(v, after));
            same(angular(BALL.velocity, before), angular(v, after));
            same(energy(BALL.velocity, before), energy(v, after) + hit.dissipated);
            let closing = BAT.speed_at(x, before) - BALL.velocity;
            same(v - BAT.speed_at(x, after), BALL.restitution * closing);
        }
    }

    #[test]
    fn a_shift_of_the_observer_shifts_every_speed_and_changes_no_impulse() {
        let hit = BAT.strike(BAT.swung(50.0, 0.15), BALL, 0.7);
        let moving =
            RigidVelocity { velocity: BAT.swung(50.0, 0.15).velocity + 25.0, rotation: 50.0 };
        let seen = BAT.strike(moving, Incoming { velocity: -15.0, ..BALL }, 0.7);
        assert!((seen.impulse - hit.impulse).abs() < 1e-13);
        assert!((seen.ball_velocity - hit.ball_velocity - 25.0).abs() < 1e-12);
    }

    /// The WPI report's dowel has 6 ball masses, `(M/I) y² = 12 (y/L)²`, and turns about a point
    /// 2.5/33 of its length beyond the knob.
    #[test]
    fn the_corrected_equation_1_7_is_this_collision() {
        let rod = RigidBat { mass: 6.0, balance_point: 0.5, inertia: 0.5 };
        let ball = Incoming { mass: 1.0, velocity: -48.0, restitution: 0.5 };
        for x in [0.0, 0.3, 0.5, 0.7, 1.0] {
            let closing = 50.0 * (2.5 / 33.0 + x) + 48.0;
            let y_squared = (x - 0.5_f64).powi(2);
            let printed = -48.0 + 6.0 * 1.5 * closing / (1.0 + 6.0 + 12.0 * y_squared);
            let ours = rod.strike(rod.swung(50.0, 2.5 / 33.0), ball, x).ball_velocity;
            assert!((ours - printed).abs() < 1e-13, "{x}");
        }
    }

    #[test]
    fn a_rod_struck_at_its_end_weighs_a_quarter() {
        let rod = RigidBat { mass: 3.0, balance_point: 0.5, inertia: 3.0 / 12.0 };
        assert!((rod.recoil_mass(1.0) - 0.75).abs() < 1e-15);
        assert_eq!(rod.recoil_mass(0.5), 3.0);
    }
}
