//! The shot of a laboratory's cannon at a bat at rest.

use sweetspot::base::mistakes::Mistakes;
use sweetspot::collision::Ball;
use sweetspot::collision::bbcor::TEST_SPEED;
use sweetspot::files::balls::ball;
use sweetspot::{Error, Result};

use crate::value::{CANNON_SPEED, STIFFNESS, cor};

/// The ball and its speed.
#[derive(clap::Args)]
#[command(next_help_heading = "The test")]
pub struct CannonArgs {
    /// Ball: baseball, humid-baseball, softball or a ball file
    #[arg(long, value_name = "BALL", default_value = "baseball")]
    ball: String,

    /// Make the ball a linear spring of this stiffness, in place of its own force law
    #[arg(long, value_name = "N/m", value_parser = STIFFNESS)]
    ball_stiffness: Option<f64>,

    /// The ball's coefficient of restitution at the test speed, in place of its own
    #[arg(long, value_name = "E", value_parser = cor)]
    cor: Option<f64>,

    /// Speed of the ball [default: 136 mph]
    #[arg(long, value_name = "m/s", value_parser = CANNON_SPEED)]
    speed: Option<f64>,
}

/// A ball on its way to a bat at rest.
pub struct Shot {
    /// The ball; without a restitution by speed if a restitution was given.
    pub ball: Ball,
    /// Its speed (m/s).
    pub speed: f64,
    /// The given coefficient of restitution.
    pub cor: Option<f64>,
}

impl CannonArgs {
    /// The shot.
    ///
    /// # Errors
    ///
    /// Those of the ball and of its speed, all at once.
    pub fn shot(&self) -> Result<Shot> {
        let mut mistakes = Mistakes::default();
        let ball = mistakes.some(ball(&self.ball, self.ball_stiffness));
        let speed = self.speed.unwrap_or(TEST_SPEED);
        if !(speed > 0.0 && speed < 1e6) {
            let found = format!("{speed:?} m/s");
            mistakes.add(Error::value("--speed", found, "above 0 and below 1e6 m/s"));
        }
        mistakes.end(())?;
        let mut ball = ball.expect("what could not be read was noted");
        if self.cor.is_some() {
            ball.cor_by_speed.clear();
        }
        Ok(Shot { ball, speed, cor: self.cor })
    }
}
