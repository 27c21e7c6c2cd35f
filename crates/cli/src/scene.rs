//! The options of a hit.

use std::path::Path;

use sweetspot::collision::Model;
use sweetspot::collision::setup::Setup;
use sweetspot::collision::wall_choice::WallChoice;
use sweetspot::files::balls::{ball, is_built_in};
use sweetspot::{Bat, Result};

use crate::common::as_options;
use crate::output::FullArgs;
use crate::value::{
    CONTACT_TIME, PART_MASS, PIVOT, PLACE, PLAY_SPEED, STIFFNESS, SWING_WEIGHT, cor, swing_speed,
};

/// The swing, the pitch and the ball.
#[derive(clap::Args)]
#[command(next_help_heading = "The hit")]
pub struct SceneArgs {
    /// Collision model: contact, pulse, energy-loss or rigid
    ///
    /// contact: ball and bending modes in contact, by a nonlinear lossy spring. pulse: a half sine of
    /// a given duration. energy-loss: the empirical loss of the WPI report. rigid: no bending.
    #[arg(long, value_name = "MODEL", default_value = "contact",
          value_parser = ["contact", "pulse", "energy-loss", "rigid"], hide_possible_values = true)]
    model: String,

    /// Angular speed of the swing
    ///
    /// The default moves the barrel of a 33 in bat at 72 mph 6 in from the tip, as an average batter
    /// of the major leagues does.
    #[arg(long, value_name = "rad/s", default_value = "43 rad/s", value_parser = swing_speed)]
    swing_speed: f64,

    /// Speed of a point of the barrel, such as "72 mph", in place of the angular speed
    #[arg(long, value_name = "m/s", conflicts_with_all = ["swing_speed", "reference_inertia"],
          value_parser = PLAY_SPEED)]
    bat_speed: Option<f64>,

    /// Distance of that point from the tip
    #[arg(long, value_name = "m", default_value = "6 in", requires = "bat_speed",
          value_parser = PLACE)]
    bat_speed_at: f64,

    /// Rotation centre of the swing beyond the knob end (negative: inside)
    #[arg(long, value_name = "m", default_value = "2.5 in", value_parser = PIVOT)]
    pivot: f64,

    /// Speed of the ball towards the bat, at the plate
    ///
    /// A ball thrown at 90 mph reaches the plate at about 83 mph.
    #[arg(long, value_name = "m/s", default_value = "83 mph", value_parser = PLAY_SPEED)]
    pitch: f64,

    /// Ball: baseball, humid-baseball, softball or a ball file
    ///
    /// humid-baseball is the baseball stored at 50 instead of 30 % relative humidity. No source was found for a
    /// softball's force law: with --model contact it needs --ball-stiffness.
    #[arg(long, value_name = "BALL", default_value = "baseball")]
    ball: String,

    /// Make the ball a linear spring of this stiffness, such as "7000 lbf/in"
    ///
    /// It replaces the ball's own force law. It is the dynamic stiffness measured on a rigid cylinder: F²/(m v²) for
    /// the largest force F at the speed v.
    #[arg(long, value_name = "N/m", value_parser = STIFFNESS)]
    ball_stiffness: Option<f64>,

    /// Coefficient of restitution, in place of the ball's own
    #[arg(long, value_name = "E", value_parser = cor)]
    cor: Option<f64>,

    /// Position of the hands, from the knob end
    #[arg(long, value_name = "m", default_value = "6 in", value_parser = PLACE)]
    hands: f64,

    /// Whether a hollow barrel's wall deflects in its own hoop modes: auto, on or off
    ///
    /// For the contact model. auto: if that changes BBCOR by more than 0.15 of --tol, by an estimate, and the number of
    /// modes is not given.
    #[arg(long, value_name = "WHEN", default_value = "auto",
          value_parser = ["auto", "on", "off"], hide_possible_values = true)]
    wall: String,

    /// Stiffness of a hollow barrel's wall under the ball
    ///
    /// For the contact model; in place of the wall's own hoop modes (--wall).
    #[arg(long, value_name = "N/m", value_parser = STIFFNESS)]
    wall_stiffness: Option<f64>,

    /// Mass of that wall's vibration [default: none, a spring in series]
    #[arg(long, value_name = "kg", requires = "wall_stiffness", value_parser = PART_MASS)]
    wall_mass: Option<f64>,

    /// Swing weight of the bat to which the swing speed belongs
    ///
    /// The moment of inertia about a point 6 in from the knob, such as "10000 oz in2". It has an effect only with
    /// --swing-exponent.
    #[arg(long, value_name = "kg m2", value_parser = SWING_WEIGHT)]
    reference_inertia: Option<f64>,

    /// How swings slow down with the swing weight
    ///
    /// A bat of another inertia I is swung at (I_ref/I)^N times the speed: 0 is the same angular
    /// speed, 0.5 the same energy of rotation.
    #[arg(long, value_name = "N", requires = "reference_inertia", value_parser = |s: &str| not_negative(s, "exponent"))]
    swing_exponent: Option<f64>,

    /// Size of the empirical loss (energy-loss)
    #[arg(long, value_name = "G",
          value_parser = |s: &str| not_negative(s, "gamma"))]
    gamma: Option<f64>,

    /// Power with which that loss falls with the mode number (energy-loss)
    #[arg(long, value_name = "P",
          value_parser = |s: &str| not_negative(s, "decay"))]
    decay: Option<f64>,

    /// Duration of the force (pulse) [default: 0.75 ms]
    #[arg(long, value_name = "s", value_parser = CONTACT_TIME)]
    pulse_duration: Option<f64>,

    /// Share of the vibration's energy the ball need not lose (pulse) [default: 0.6]
    #[arg(long, value_name = "KAPPA",
          value_parser = |s: &str| not_negative(s, "loss share"))]
    loss_share: Option<f64>,
}

impl SceneArgs {
    /// The ball's file, if it has one.
    pub fn ball_file(&self) -> Option<&Path> {
        (!is_built_in(&self.ball)).then(|| Path::new(&self.ball))
    }

    /// The setup from these options, before the bat is known, with its model; reads the file of the ball.
    pub fn setup(&self) -> Result<(Setup, Model)> {
        let model = Model::all().into_iter().find(|model| model.name() == self.model);
        let setup = Setup {
            model: model.unwrap_or(Model::Contact),
            swing_speed: self.swing_speed,
            bat_speed: self.bat_speed,
            bat_speed_at: self.bat_speed_at,
            pivot: self.pivot,
            pitch: self.pitch,
            ball: ball(&self.ball, self.ball_stiffness).map_err(as_options)?,
            cor: self.cor,
            hands: self.hands,
            wall: WallChoice::named(&self.wall),
            wall_stiffness: self.wall_stiffness,
            wall_mass: self.wall_mass,
            reference_inertia: self.reference_inertia,
            swing_exponent: self.swing_exponent,
            gamma: self.gamma,
            decay: self.decay,
            pulse_duration: self.pulse_duration,
            loss_share: self.loss_share,
        };
        let model = setup.model().map_err(as_options)?;
        Ok((setup, model))
    }
}

/// Warns of what is strange for a hit on one of these bats.
pub fn warn<'a>(setup: &Setup, bats: impl IntoIterator<Item = &'a Bat>, output: &FullArgs) {
    for (member, strange) in setup.warnings(bats) {
        output.warn(&format!("warning: --{} {strange}", member.replace('_', "-")));
    }
}

fn not_negative(text: &str, what: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..=100.0).contains(&value) => Ok(value + 0.0),
        _ => Err(format!("expected a {what} from 0 to 100")),
    }
}
