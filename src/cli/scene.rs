//! The options of a hit.

use std::cell::OnceCell;
use std::path::Path;

use crate::base::error::{Error, Result};
use crate::base::units::shown_length;
use crate::bat::body::Bat;
use crate::collision::ball::Ball;
use crate::collision::energy_loss::EnergyLoss;
use crate::collision::figures::{BarrelSpeed, SwingLaw};
use crate::collision::hit::{Model, Scene, Wall};
use crate::collision::pulse::Pulse;

use crate::cli::balls::{ball, cor, is_built_in};
use crate::cli::common::OutputArgs;
use crate::cli::value::{
    CONTACT_TIME, PART_MASS, PIVOT, PLACE, PLAY_SPEED, STIFFNESS, SWING_WEIGHT, swing_speed,
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
    #[arg(long, value_name = "rad/s", default_value = "43 rad/s", allow_hyphen_values = true,
          value_parser = swing_speed)]
    swing_speed: f64,

    /// Speed of a point of the barrel, such as "72 mph", in place of the angular speed
    #[arg(long, value_name = "m/s", allow_hyphen_values = true,
          conflicts_with_all = ["swing_speed", "reference_inertia"],
          value_parser = |s: &str| PLAY_SPEED.read(s))]
    bat_speed: Option<f64>,

    /// Distance of that point from the tip
    #[arg(long, value_name = "m", default_value = "6 in", allow_hyphen_values = true,
          requires = "bat_speed", value_parser = |s: &str| PLACE.read(s))]
    bat_speed_at: f64,

    /// Rotation centre of the swing beyond the knob end (negative: inside)
    #[arg(long, value_name = "m", default_value = "2.5 in", allow_hyphen_values = true,
          value_parser = |s: &str| PIVOT.read(s))]
    pivot: f64,

    /// Speed of the ball towards the bat, at the plate
    ///
    /// A ball that is thrown at 90 mph has about 83 mph left there.
    #[arg(long, value_name = "m/s", default_value = "83 mph", allow_hyphen_values = true,
          value_parser = |s: &str| PLAY_SPEED.read(s))]
    pitch: f64,

    /// Ball: baseball, humid-baseball, softball or a ball file
    ///
    /// humid-baseball is the baseball kept at 50 instead of 30 % relative humidity. No source was
    /// found for a softball's force law: with --model contact it needs --ball-stiffness.
    #[arg(long, value_name = "BALL", default_value = "baseball")]
    ball: String,

    /// The ball is a linear spring of this stiffness, such as "7000 lbf/in"
    ///
    /// In place of its own force law. A dynamic stiffness measured on a rigid cylinder is meant:
    /// F²/(m v²) for the largest force F at the speed v.
    #[arg(long, value_name = "N/m", allow_hyphen_values = true,
          value_parser = |s: &str| STIFFNESS.read(s))]
    ball_stiffness: Option<f64>,

    /// Coefficient of restitution, in place of the ball's own
    #[arg(long, value_name = "E", allow_hyphen_values = true, value_parser = cor)]
    cor: Option<f64>,

    /// Where the hands feel the hit, from the knob end
    #[arg(long, value_name = "m", default_value = "6 in", allow_hyphen_values = true,
          value_parser = |s: &str| PLACE.read(s))]
    hands: f64,

    /// Stiffness of a hollow barrel's wall under the ball
    ///
    /// For the contact model; without it the wall does not give way.
    #[arg(long, value_name = "N/m", allow_hyphen_values = true,
          value_parser = |s: &str| STIFFNESS.read(s))]
    wall_stiffness: Option<f64>,

    /// Mass of that wall's own vibration [default: none, a spring in series]
    #[arg(long, value_name = "kg", requires = "wall_stiffness",
          allow_hyphen_values = true, value_parser = |s: &str| PART_MASS.read(s))]
    wall_mass: Option<f64>,

    /// The swing speed is that of a bat with this swing weight
    ///
    /// The moment of inertia about a point 6 in from the knob, such as "10000 oz in2".
    #[arg(long, value_name = "kg m2", allow_hyphen_values = true,
          value_parser = |s: &str| SWING_WEIGHT.read(s))]
    reference_inertia: Option<f64>,

    /// How swings slow down with the swing weight [default: 0]
    ///
    /// A bat of another inertia I is swung at (I_ref/I)^N times the speed: 0 is the same angular
    /// speed, 0.5 the same energy of rotation.
    #[arg(long, value_name = "N", requires = "reference_inertia",
          allow_hyphen_values = true, value_parser = |s: &str| not_negative(s, "exponent"))]
    swing_exponent: Option<f64>,

    /// Size of the empirical loss (energy-loss)
    #[arg(long, value_name = "G", allow_hyphen_values = true,
          value_parser = |s: &str| not_negative(s, "gamma"))]
    gamma: Option<f64>,

    /// Power with which that loss falls with the mode number (energy-loss)
    #[arg(long, value_name = "P", allow_hyphen_values = true,
          value_parser = |s: &str| not_negative(s, "decay"))]
    decay: Option<f64>,

    /// Duration of the force (pulse) [default: 0.75 ms]
    #[arg(long, value_name = "s", allow_hyphen_values = true,
          value_parser = |s: &str| CONTACT_TIME.read(s))]
    pulse_duration: Option<f64>,

    /// Share of the vibration's energy the ball need not lose (pulse) [default: 0.6]
    #[arg(long, value_name = "KAPPA", allow_hyphen_values = true,
          value_parser = |s: &str| not_negative(s, "loss share"))]
    loss_share: Option<f64>,

    /// The ball, once it is known.
    #[arg(skip)]
    read: OnceCell<Ball>,
}

impl SceneArgs {
    /// The ball's file, if it has one.
    pub fn ball_file(&self) -> Option<&Path> {
        (!is_built_in(&self.ball)).then(|| Path::new(&self.ball))
    }

    /// The ball, with what the command line says of it; its file, which may be a pipe, is read once.
    fn ball(&self) -> Result<Ball> {
        if let Some(known) = self.read.get() {
            return Ok(known.clone());
        }
        let ball = ball(&self.ball, self.ball_stiffness)?;
        Ok(self.read.get_or_init(|| ball).clone())
    }

    /// The scene on that bat, and where its swing is from.
    pub fn scene(&self, bat: &Bat) -> Result<(Scene, Option<SwingLaw>)> {
        let mut ball = self.ball()?;
        let cor = self.cor.unwrap_or(ball.cor);
        let speeds = [self.pitch, self.swing_speed, self.bat_speed.unwrap_or_default(), self.pivot];
        if !speeds.iter().all(|value| value.abs() < 1e6) {
            let expected = "values below 1e6 m/s, 1e6 rad/s and 1e6 m";
            return Err(Error::value(
                "--pitch, --swing-speed, --bat-speed or --pivot",
                "a larger one",
                expected,
            ));
        }
        if self.pitch < 0.0 {
            let expected = "0 or more: it is the speed towards the bat";
            return Err(Error::value("--pitch", format!("{} m/s", self.pitch), expected));
        }
        if self.cor.is_some() {
            ball.cor_by_speed.clear();
        }
        if !(0.0..=bat.length()).contains(&self.hands) {
            let expected = format!("a place on the bat, 0 to {}", shown_length(bat.length()));
            return Err(Error::value("--hands", shown_length(self.hands), expected));
        }
        let law = self.swing_law()?;
        let (pivot, ball_speed) = (self.pivot, self.pitch);
        let swing = match (law, self.barrel_speed()) {
            (Some(law), _) => law.swing(bat),
            (None, Some(barrel)) => self.swing_of(barrel, bat)?,
            (None, None) => self.swing_speed,
        };
        let (hands, wall) = (self.hands, self.wall()?);
        Ok((Scene { pivot, swing, ball, ball_speed, cor, hands, wall }, law))
    }

    /// The speed of a point of the barrel, where that was given.
    pub fn barrel_speed(&self) -> Option<BarrelSpeed> {
        self.bat_speed.map(|speed| BarrelSpeed { speed, from_tip: self.bat_speed_at })
    }

    /// The swing that gives a point of this bat that speed.
    fn swing_of(&self, barrel: BarrelSpeed, bat: &Bat) -> Result<f64> {
        let from_tip = shown_length(barrel.from_tip);
        if !(0.0..=bat.length()).contains(&barrel.from_tip) {
            let expected = format!("a place on the bat, 0 to {}", shown_length(bat.length()));
            return Err(Error::value("--bat-speed-at", from_tip, expected));
        }
        barrel.swing(bat, self.pivot).ok_or_else(|| {
            let found = format!("a point {from_tip} from the tip");
            Error::value("--bat-speed", found, "one beyond the swing's rotation centre, --pivot")
        })
    }

    /// Warns of speeds that nobody has, most likely bare numbers in other units.
    pub fn warn(&self, output: &OutputArgs) {
        for (option, value, most, unit, hint) in [
            ("--pitch", self.pitch, 60.0, "m/s", "\"90 mph\""),
            ("--swing-speed", self.swing_speed.abs(), 100.0, "rad/s", "about 43 rad/s"),
        ] {
            if value > most {
                let told = format!("warning: {option} is {value} {unit}; usual is {hint}");
                output.warn(&told);
            }
        }
    }

    fn swing_law(&self) -> Result<Option<SwingLaw>> {
        let Some(reference) = self.reference_inertia else { return Ok(None) };
        let exponent = self.swing_exponent.unwrap_or(0.0);
        if !(reference > 1e-9 && reference < 1e9) {
            let found = format!("{reference:?} kg m2");
            return Err(Error::value("--reference-inertia", found, "a bat's inertia, above 0"));
        }
        if exponent > 2.0 {
            return Err(Error::value("--swing-exponent", exponent, "0 to 2"));
        }
        Ok(Some(SwingLaw { exponent, reference, of_reference: self.swing_speed }))
    }

    fn wall(&self) -> Result<Option<Wall>> {
        let Some(stiffness) = self.wall_stiffness else { return Ok(None) };
        if self.model != "contact" {
            let found = format!("it with --model {}", self.model);
            let expected = "--model contact: only there a wall gives way";
            return Err(Error::value("--wall-stiffness", found, expected));
        }
        let mass = self.wall_mass.unwrap_or(0.0);
        if !(1.0..=1e15).contains(&stiffness) {
            let found = format!("{stiffness:?} N/m");
            return Err(Error::value("--wall-stiffness", found, "1 to 1e15 N/m"));
        }
        if !(mass == 0.0 || (1e-9..1e6).contains(&mass)) {
            let found = format!("{mass:?} kg");
            return Err(Error::value("--wall-mass", found, "0, or 1e-9 to 1e6 kg"));
        }
        Ok(Some(Wall { stiffness, mass }))
    }

    pub fn model(&self) -> Result<Model> {
        let empirical = self.gamma.is_some() || self.decay.is_some();
        let pulsed = self.pulse_duration.is_some() || self.loss_share.is_some();
        for (given, options, model) in [
            (empirical, "--gamma, --decay", "energy-loss"),
            (pulsed, "--pulse-duration, --loss-share", "pulse"),
        ] {
            if given && self.model != model {
                let found = format!("them with --model {}", self.model);
                let expected = format!("--model {model}, or neither of them");
                return Err(Error::value(options, found, expected));
            }
        }
        Ok(match self.model.as_str() {
            "rigid" => Model::Rigid,
            "energy-loss" => {
                let default = EnergyLoss::default();
                Model::EnergyLoss(EnergyLoss {
                    gamma: self.gamma.unwrap_or(default.gamma),
                    decay: self.decay.unwrap_or(default.decay),
                })
            }
            "pulse" => Model::Pulse(self.pulse()?),
            _ => {
                // What the ball lacks is told before anything is solved.
                let ball = self.ball()?;
                Scene { ball, ..Scene::default() }.force_law(1.0)?;
                Model::Contact
            }
        })
    }

    fn pulse(&self) -> Result<Pulse> {
        let default = Pulse::default();
        let duration = self.pulse_duration.unwrap_or(default.duration);
        let loss_share = self.loss_share.unwrap_or(default.loss_share);
        if !(1e-9..=1.0).contains(&duration) {
            let expected = "a time from 1 ns to 1 s, such as \"0.75 ms\"";
            return Err(Error::value("--pulse-duration", format!("{duration} s"), expected));
        }
        if loss_share > 1.0 {
            return Err(Error::value("--loss-share", loss_share, "0 to 1"));
        }
        Ok(Pulse { duration, loss_share })
    }
}

fn not_negative(text: &str, what: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..=100.0).contains(&value) => Ok(value + 0.0),
        _ => Err(format!("expected a {what} from 0 to 100")),
    }
}
