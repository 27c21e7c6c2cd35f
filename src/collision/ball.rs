//! What ball: mass, size, bounce and stiffness.

use std::path::Path;

use crate::document::Document;
use crate::error::{Error, Result};
use crate::units::Quantity;

/// A ball, compressed by `u` (m), pushes back with `stiffness · u^exponent` (N).
#[derive(Debug, Clone, PartialEq)]
pub struct Ball {
    pub name: String,
    pub source: String,
    /// Mass (kg).
    pub mass: f64,
    /// Radius (m).
    pub radius: f64,
    /// `k` of the force `k u^α` (N/m^α); not used by the `rigid` and `energy-loss` models.
    pub stiffness: Option<f64>,
    /// `α` of the force `k u^α`.
    pub exponent: Option<f64>,
    /// Coefficient of restitution on a rigid wall, e₀.
    pub cor: f64,
}

const KEYS: &[&str] =
    &["format", "name", "source", "mass", "radius", "stiffness", "exponent", "cor"];

impl Ball {
    /// A baseball: 5 to 5¼ oz and 9 to 9¼ in around by the rules, the middle of both.
    pub fn baseball() -> Self {
        Self {
            name: "baseball".into(),
            source: "mass: middle of the rules' 5 to 5.25 oz; radius, force law and e0 at game \
                     speed: A. M. Nathan, Am. J. Phys. 68, 979 (2000)"
                .into(),
            mass: 5.125 * 0.028_349_523_125,
            radius: 0.0366,
            stiffness: Some(6.53e7),
            exponent: Some(1.84),
            cor: 0.5,
        }
    }

    /// A 12 in softball: 6¼ to 7 oz, 11⅞ to 12⅛ in around by the rules, e₀ 0.44.
    pub fn softball() -> Self {
        Self {
            name: "softball".into(),
            source: "mass and radius: middle of the rules' 6.25 to 7 oz and 11.875 to 12.125 in \
                     around; e0: the common 0.44 ball (0.47 and 0.52 are approved too); force law \
                     not known"
                .into(),
            mass: 6.625 * 0.028_349_523_125,
            radius: 12.0 * 0.0254 / std::f64::consts::TAU,
            stiffness: None,
            exponent: None,
            cor: 0.44,
        }
    }

    /// Reads a `sweetspot-ball/1` file.
    ///
    /// # Errors
    ///
    /// [`Error::Read`], or [`Error::Input`] with line and column.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self> {
        let document = Document::read(path.as_ref())?;
        let root = document.root()?.object(KEYS)?;
        let format = root.require("format", "\"format\": \"sweetspot-ball/1\"")?;
        if format.string().ok().as_deref() != Some("sweetspot-ball/1") {
            return Err(format.error(format.shown(), "\"sweetspot-ball/1\""));
        }
        let positive = |key: &str, quantity: Option<Quantity>| -> Result<Option<f64>> {
            let Some(node) = root.get(key) else { return Ok(None) };
            let value = match quantity {
                Some(quantity) => node.quantity(quantity)?,
                None => node.number()?,
            };
            // Small enough and large enough for its square to be a number.
            if value > 1e-100 && value < 1e100 {
                Ok(Some(value))
            } else {
                Err(node.error(node.shown(), "a value above 0, of a ball's size"))
            }
        };
        let needed = |key: &str, quantity| -> Result<f64> {
            root.require(key, &format!("\"{key}\" of the ball"))?;
            Ok(positive(key, quantity)?.expect("required just above"))
        };
        let cor = root.require("cor", "\"cor\" on a rigid wall")?;
        Ok(Self {
            name: root.string("name")?.unwrap_or_else(|| "unnamed ball".to_owned()),
            source: root.string("source")?.unwrap_or_default(),
            mass: needed("mass", Some(Quantity::Mass))?,
            radius: needed("radius", Some(Quantity::Length))?,
            stiffness: positive("stiffness", None)?,
            exponent: positive("exponent", None)?,
            cor: restitution(cor.number()?).map_err(|_| cor.error(cor.shown(), "0 to 1"))?,
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
