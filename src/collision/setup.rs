//! How is a bat hit, before the bat is known?
//!
//! A [`Setup`] describes swing, pitch, ball and wall; [`Setup::scene`] turns it into the [`Scene`] of one bat. Its
//! members have the same names in files, in the paths of a study and, with `-` for `_`, as options of the command line;
//! messages write them in `` `backquotes` ``.

use crate::base::{Error, Result, shown_length};
use crate::bat::Bat;
use crate::collision::ball::Ball;
use crate::collision::energy_loss::EnergyLoss;
use crate::collision::figures::{BarrelSpeed, SwingLaw};
use crate::collision::hit::{Model, Scene, Wall};
use crate::collision::hoop_wall::HoopInHit;
use crate::collision::pulse::Pulse;
use crate::collision::wall_choice::WallChoice;
use crate::modes::hoop::rings;

/// Swing, pitch, ball and wall, before the bat is known.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    /// Collision model, with its own constants unless they are given below.
    pub model: Model,
    /// Angular speed of the swing (rad/s).
    pub swing_speed: f64,
    /// Speed of a point of the barrel (m/s), in place of the angular speed.
    pub bat_speed: Option<f64>,
    /// Distance of that point from the tip (m).
    pub bat_speed_at: f64,
    /// Rotation centre of the swing beyond the knob end (m), negative inside the handle.
    pub pivot: f64,
    /// Speed of the ball towards the bat (m/s).
    pub pitch: f64,
    /// The ball.
    pub ball: Ball,
    /// Coefficient of restitution, in place of the ball's own.
    pub cor: Option<f64>,
    /// Position of the hands (m from the knob end).
    pub hands: f64,
    /// Whether a hollow barrel's wall deflects in its own hoop modes; a given stiffness replaces them.
    pub wall: WallChoice,
    /// Stiffness of a hollow barrel's wall under the ball (N/m).
    pub wall_stiffness: Option<f64>,
    /// Mass of that wall's own vibration (kg).
    pub wall_mass: Option<f64>,
    /// Moment of inertia about the standard pivot (kg m²) of the bat that the angular speed belongs to.
    pub reference_inertia: Option<f64>,
    /// Exponent with which swings slow down with that moment of inertia.
    pub swing_exponent: Option<f64>,
    /// γ of the empirical loss.
    pub gamma: Option<f64>,
    /// Its decay p.
    pub decay: Option<f64>,
    /// Duration of the pulse (s).
    pub pulse_duration: Option<f64>,
    /// κ of the pulse.
    pub loss_share: Option<f64>,
}

impl Default for Setup {
    /// The setup of [`Scene::default`], with the contact model.
    fn default() -> Self {
        let scene = Scene::default();
        Self {
            model: Model::Contact,
            swing_speed: scene.swing,
            bat_speed: None,
            bat_speed_at: BarrelSpeed::BROADCAST,
            pivot: scene.pivot,
            pitch: scene.ball_speed,
            ball: scene.ball,
            cor: None,
            hands: scene.hands,
            wall: WallChoice::Auto,
            wall_stiffness: None,
            wall_mass: None,
            reference_inertia: None,
            swing_exponent: None,
            gamma: None,
            decay: None,
            pulse_duration: None,
            loss_share: None,
        }
    }
}

impl Setup {
    /// The named members, as in files and paths; the ball has its own.
    pub const MEMBERS: [&'static str; 18] = [
        "model",
        "swing_speed",
        "bat_speed",
        "bat_speed_at",
        "pivot",
        "pitch",
        "ball_stiffness",
        "cor",
        "hands",
        "wall",
        "wall_stiffness",
        "wall_mass",
        "reference_inertia",
        "swing_exponent",
        "gamma",
        "decay",
        "pulse_duration",
        "loss_share",
    ];

    /// Members that are strange for one of these bats, such as a speed in another unit, and the warning for each.
    pub fn warnings<'a>(
        &self,
        bats: impl IntoIterator<Item = &'a Bat>,
    ) -> Vec<(&'static str, String)> {
        let all = [
            ("pitch", self.pitch, 60.0, "m/s", "\"90 mph\""),
            ("swing_speed", self.swing_speed, 100.0, "rad/s", "about 43 rad/s"),
            ("bat_speed", self.bat_speed.unwrap_or(0.0), 60.0, "m/s", "\"72 mph\""),
        ];
        let strange = all.into_iter().filter(|(_, value, most, ..)| value.abs() > *most);
        let told = |(member, value, _, unit, usual)| {
            (member, format!("is {value} {unit}; usual is {usual}"))
        };
        let solid = |bat: &Bat| bat.profile().pieces.iter().all(|piece| piece.at(0.5).inner == 0.0);
        let on_solid = self.wall_stiffness.is_some() && bats.into_iter().any(solid);
        let wall = ("wall_stiffness", "gives a wall to a solid bat; leave it out there".to_owned());
        strange.map(told).chain(on_solid.then_some(wall)).collect()
    }

    /// The scene on that bat, and the origin of its swing. `tolerance` is that of exit speeds over the closing speed,
    /// which decides whether a hollow barrel's wall deflects; `None` if the number of modes is prescribed and nothing
    /// else may contribute.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] about a member that is impossible, or impossible on this bat.
    pub fn scene(&self, bat: &Bat, tolerance: Option<f64>) -> Result<(Scene, Option<SwingLaw>)> {
        let mut ball = self.ball.clone();
        let cor = self.cor.unwrap_or(ball.cor);
        let speeds = [self.pitch, self.swing_speed, self.bat_speed.unwrap_or_default(), self.pivot];
        if !speeds.iter().all(|value| value.abs() < 1e6) {
            let expected = "values below 1e6 m/s, 1e6 rad/s and 1e6 m";
            let named = "`pitch`, `swing_speed`, `bat_speed` or `pivot`";
            return Err(Error::value(named, "a larger one", expected));
        }
        if self.pitch < 0.0 {
            let expected = "0 or more: it is the speed towards the bat";
            return Err(Error::value("`pitch`", format!("{} m/s", self.pitch), expected));
        }
        if self.cor.is_some() {
            ball.cor_by_speed.clear();
        }
        if !(0.0..=bat.length()).contains(&self.hands) {
            let expected = format!("a place on the bat, 0 to {}", shown_length(bat.length()));
            return Err(Error::value("`hands`", shown_length(self.hands), expected));
        }
        let law = self.swing_law()?;
        let (pivot, ball_speed) = (self.pivot, self.pitch);
        let swing = match (law, self.barrel_speed()) {
            (Some(law), _) => law.swing(bat),
            (None, Some(barrel)) => self.swing_of(barrel, bat)?,
            (None, None) => self.swing_speed,
        };
        let (hands, wall, hoop) = (self.hands, self.spring_mass()?, HoopInHit::None);
        let scene = Scene { pivot, swing, ball, ball_speed, cor, hands, wall, hoop };
        Ok((scene.with_wall(self.wall, bat, self.model, tolerance)?, law))
    }

    /// Whether a hit on that bat may need the modes of its wall.
    pub fn may_solve_wall(&self, bat: &Bat) -> bool {
        let asked = self.wall != WallChoice::Off && self.wall_stiffness.is_none();
        asked && self.model == Model::Contact && rings(bat)
    }

    /// The speed of a point of the barrel, if it was given.
    pub fn barrel_speed(&self) -> Option<BarrelSpeed> {
        self.bat_speed.map(|speed| BarrelSpeed { speed, from_tip: self.bat_speed_at })
    }

    /// The swing that gives that speed to a point of this bat.
    fn swing_of(&self, barrel: BarrelSpeed, bat: &Bat) -> Result<f64> {
        let from_tip = shown_length(barrel.from_tip);
        if !(0.0..=bat.length()).contains(&barrel.from_tip) {
            let expected = format!("a place on the bat, 0 to {}", shown_length(bat.length()));
            return Err(Error::value("`bat_speed_at`", from_tip, expected));
        }
        barrel.swing(bat, self.pivot).ok_or_else(|| {
            let found = format!("a point {from_tip} from the tip");
            Error::value("`bat_speed`", found, "one beyond the swing's rotation centre, `pivot`")
        })
    }

    fn swing_law(&self) -> Result<Option<SwingLaw>> {
        let Some(reference) = self.reference_inertia else { return Ok(None) };
        if !(reference > 1e-9 && reference < 1e9) {
            let found = format!("{reference:?} kg m2");
            return Err(Error::value("`reference_inertia`", found, "a bat's inertia, above 0"));
        }
        let Some(exponent) = self.swing_exponent else {
            let expected = "`swing_exponent` beside it, for alone it changes no swing: 0 is the same angular \
                            speed, 0.5 the same energy of rotation; what batters do was measured in the field \
                            studies that https://ssl.wsu.edu/glossary/swing-speed/ tells of";
            return Err(Error::value("`reference_inertia`", "no exponent", expected));
        };
        if exponent > 2.0 {
            return Err(Error::value("`swing_exponent`", exponent, "0 to 2"));
        }
        Ok(Some(SwingLaw { exponent, reference, of_reference: self.swing_speed }))
    }

    fn spring_mass(&self) -> Result<Option<Wall>> {
        let Some(stiffness) = self.wall_stiffness else { return Ok(None) };
        if self.model != Model::Contact {
            let found = format!("it with `model` {}", self.model.name());
            let expected = "`model` contact: only there a wall is compliant";
            return Err(Error::value("`wall_stiffness`", found, expected));
        }
        if self.wall == WallChoice::Off {
            let expected = "only one of them: a stiffness is that of a compliant wall";
            return Err(Error::value("`wall_stiffness`", "it with `wall` off", expected));
        }
        let mass = self.wall_mass.unwrap_or(0.0);
        if !(1.0..=1e15).contains(&stiffness) {
            let found = format!("{stiffness:?} N/m");
            return Err(Error::value("`wall_stiffness`", found, "1 to 1e15 N/m"));
        }
        if !(mass == 0.0 || (1e-9..1e6).contains(&mass)) {
            let found = format!("{mass:?} kg");
            return Err(Error::value("`wall_mass`", found, "0, or 1e-9 to 1e6 kg"));
        }
        Ok(Some(Wall { stiffness, mass }))
    }

    /// The model with the constants that were given.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] about a constant of another model, an impossible constant, or a ball whose force law is not
    /// known.
    pub fn model(&self) -> Result<Model> {
        let empirical = self.gamma.is_some() || self.decay.is_some();
        let pulsed = self.pulse_duration.is_some() || self.loss_share.is_some();
        let model = self.model.name();
        for (given, members, needed) in [
            (empirical, "`gamma`, `decay`", "energy-loss"),
            (pulsed, "`pulse_duration`, `loss_share`", "pulse"),
        ] {
            if given && model != needed {
                let found = format!("them with `model` {model}");
                let expected = format!("`model` {needed}, or neither of them");
                return Err(Error::value(members, found, expected));
            }
        }
        Ok(match self.model {
            Model::Rigid => Model::Rigid,
            Model::EnergyLoss(default) => Model::EnergyLoss(EnergyLoss {
                gamma: self.gamma.unwrap_or(default.gamma),
                decay: self.decay.unwrap_or(default.decay),
            }),
            Model::Pulse(default) => Model::Pulse(self.pulse(default)?),
            Model::Contact => {
                // Missing data of the ball are reported before anything is solved.
                self.ball.spring()?;
                Model::Contact
            }
        })
    }

    fn pulse(&self, default: Pulse) -> Result<Pulse> {
        let duration = self.pulse_duration.unwrap_or(default.duration);
        let loss_share = self.loss_share.unwrap_or(default.loss_share);
        if !(1e-9..=1.0).contains(&duration) {
            let expected = "a time from 1 ns to 1 s, such as \"0.75 ms\"";
            return Err(Error::value("`pulse_duration`", format!("{duration} s"), expected));
        }
        if loss_share > 1.0 {
            return Err(Error::value("`loss_share`", loss_share, "0 to 1"));
        }
        Ok(Pulse { duration, loss_share })
    }
}
