//! Which ball: mass, size, restitution and stiffness?

use serde::{Deserialize, Serialize};

use crate::base::marks::written_out;
use crate::base::{Error, Result};
use crate::collision::contact::collider::{Law, LawTerms};
use crate::collision::contact::power_law;

/// Makes the force law of a hit.
#[derive(Debug, Clone, Copy)]
pub struct LawOf(pub fn(LawTerms) -> Box<dyn Law>);

impl PartialEq for LawOf {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::fn_addr_eq(self.0, other.0)
    }
}

impl Default for LawOf {
    /// The power law.
    fn default() -> Self {
        Self(power_law::law)
    }
}

/// The ball. Compressed by u (m) it pushes back with the force stiffness·u^exponent (N).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Ball {
    /// Name of the ball.
    pub name: String,
    /// Where the numbers of the ball come from.
    pub source: String,
    /// Mass (kg).
    pub mass_kg: f64,
    /// Radius (m).
    pub radius_m: f64,
    /// Radius (m) of its patch on a flat wall; left out if none was given.
    // By default that of a ball compressed by 8 mm. Only a wall that deflects in its hoop modes needs it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact_radius_m: Option<f64>,
    /// Stiffness (N/m^exponent); null if no force law is known.
    pub stiffness: Option<f64>,
    /// Exponent of the force law; null if no force law is known.
    pub exponent: Option<f64>,
    /// The force law for these two numbers and the e₀ of the ball.
    #[serde(skip)]
    pub law: LawOf,
    /// Coefficient of restitution on a rigid wall.
    pub cor: f64,
    /// Pairs of a speed (m/s) and the coefficient of restitution at that speed, by rising speed.
    // If there are any, they replace `cor`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cor_by_speed: Vec<[f64; 2]>,
}

impl Ball {
    /// The name as one line, for a screen.
    pub fn title(&self) -> String {
        written_out(&self.name)
    }

    /// A baseball, in the middle of the rules' limits: 5 to 5¼ oz, and 9 to 9¼ in around.
    pub fn baseball() -> Self {
        Self {
            name: "baseball".into(),
            source: "mass: middle of the rules' 5 to 5.25 oz; radius, force law and e0 at game \
                     speed: A. M. Nathan, Am. J. Phys. 68, 979 (2000)"
                .into(),
            mass_kg: 5.125 * 0.028_349_523_125,
            radius_m: 0.0366,
            contact_radius_m: None,
            stiffness: Some(6.53e7),
            exponent: Some(1.84),
            law: LawOf(power_law::law),
            cor: 0.5,
            cor_by_speed: vec![],
        }
    }

    /// The baseball stored at 50 instead of 30 % relative humidity, which makes it 1.6 % heavier and e₀ 3.7 % smaller.
    pub fn humid_baseball() -> Self {
        let dry = Self::baseball();
        Self {
            name: "humid baseball".into(),
            source: format!(
                "{}; kept at 50 instead of 30 % relative humidity: mass 1.6 % more, e0 3.7 % less \
                 (A. M. Nathan, Baseball Prospectus, as quoted on arizona.sbnation.com, 26 Feb 2011). \
                 How humid the dry one was is not known: the difference of both counts",
                dry.source
            ),
            mass_kg: 1.016 * dry.mass_kg,
            cor: (1.0 - 0.037) * dry.cor,
            ..dry
        }
    }

    /// The compression δ (m) for which its patch on a flat wall has the radius `√(R δ)`, by Hertz.
    pub fn patch_compression(&self) -> f64 {
        /// Half of the largest compression of a baseball at game speed.
        const USUAL: f64 = 0.008;
        self.contact_radius_m.map_or(USUAL, |contact| contact * contact / self.radius_m)
    }

    /// The ball with a linear spring of that stiffness (N/m).
    ///
    /// Without loss `½ m v² = ½ F²/k`, so a measured force F on a rigid surface at a speed v gives the dynamic
    /// stiffness `k = F²/(m v²)`.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a stiffness that is impossible for a ball.
    pub fn linear(self, stiffness: f64) -> Result<Self> {
        if !(1.0..=1e12).contains(&stiffness) {
            let found = format!("{stiffness:?} N/m");
            return Err(Error::value("stiffness of the ball", found, "1 to 1e12 N/m"));
        }
        let source = format!("{}; a linear spring of {stiffness} N/m, as was asked", self.source);
        Ok(Self {
            source,
            stiffness: Some(stiffness),
            exponent: Some(1.0),
            law: LawOf(power_law::law),
            ..self
        })
    }

    /// A 12 in softball, in the middle of the rules' limits: 6¼ to 7 oz, and 11⅞ to 12⅛ in around; e₀ 0.44.
    pub fn softball() -> Self {
        Self {
            name: "softball".into(),
            source: "mass and radius: middle of the rules' 6.25 to 7 oz and 11.875 to 12.125 in \
                     around; e0: the common 0.44 ball (0.47 and 0.52 are approved too); no source \
                     of a force law was found"
                .into(),
            mass_kg: 6.625 * 0.028_349_523_125,
            radius_m: 12.0 * 0.0254 / std::f64::consts::TAU,
            contact_radius_m: None,
            stiffness: None,
            exponent: None,
            law: LawOf(power_law::law),
            cor: 0.44,
            cor_by_speed: vec![],
        }
    }

    /// Stiffness k (N/m^α) and exponent α of the force law.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a ball whose force law is not known.
    pub fn spring(&self) -> Result<[f64; 2]> {
        self.stiffness.zip(self.exponent).map(<[f64; 2]>::from).ok_or_else(|| {
            let found = format!("{}, of which no force law is known", self.name);
            let expected = "--ball-stiffness with its dynamic stiffness as a laboratory \
                            measures it (force F on a rigid cylinder at speed v: F²/(m v²)), a \
                            ball file with \"stiffness\" and \"exponent\", or --model rigid, \
                            energy-loss or pulse";
            Error::value("ball", found, expected)
        })
    }

    /// e₀ on a rigid wall at that speed (m/s), if it is known by speed: linear between the known speeds, constant
    /// beyond them.
    pub fn restitution_at(&self, speed: f64) -> Option<f64> {
        let (first, last) = (self.cor_by_speed.first()?, self.cor_by_speed.last()?);
        let above = self.cor_by_speed.iter().position(|[known, _]| *known > speed);
        Some(match above {
            Some(0) => first[1],
            None => last[1],
            Some(k) => {
                let ([a, low], [b, high]) = (self.cor_by_speed[k - 1], self.cor_by_speed[k]);
                low + (high - low) * (speed - a) / (b - a)
            }
        })
    }
}

/// A coefficient of restitution, from 0 to 1.
///
/// # Errors
///
/// [`Error::Value`] for any other number.
pub fn restitution(value: f64) -> Result<f64> {
    if (0.0..=1.0).contains(&value) { Ok(value) } else { Err(Error::value("cor", value, "0 to 1")) }
}
