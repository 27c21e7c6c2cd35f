//! What ball: mass, size, bounce and stiffness.

use std::path::Path;

use crate::document::{Document, Node};
use crate::error::{Error, Result};
use crate::units::Quantity;

/// A ball, compressed by `u` (m), pushes back with `stiffness · u^exponent` (N).
#[derive(Debug, Clone, PartialEq)]
pub struct Ball {
    /// What people call it.
    pub name: String,
    /// Where its numbers come from.
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
    /// The same at rising speeds (m/s), in place of it where there are any.
    pub cor_by_speed: Vec<[f64; 2]>,
}

const KEYS: &[&str] = &[
    "format",
    "name",
    "source",
    "mass",
    "radius",
    "stiffness",
    "exponent",
    "cor",
    "cor_by_speed",
    "damping_ratio",
];

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
            cor_by_speed: vec![],
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
            cor_by_speed: vec![],
        }
    }

    /// e₀ on a rigid wall at that speed (m/s), where it is known by speed: straight lines between the
    /// known ones, the first and the last beyond them.
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
        let exponent = positive("exponent", None)?;
        let cor_by_speed = match root.get("cor_by_speed") {
            Some(node) => by_speed(node)?,
            None => vec![],
        };
        let linear = match root.get("damping_ratio") {
            Some(node) => Some(linear(node, exponent)?),
            None => None,
        };
        root.one_of(&["cor", "damping_ratio"])?;
        let cor = match (linear, cor_by_speed.last()) {
            (Some(cor), _) => cor,
            (None, Some([_, cor])) if root.get("cor").is_none() => *cor,
            _ => {
                let cor = root.require("cor", "\"cor\" on a rigid wall")?;
                restitution(cor.number()?).map_err(|_| cor.error(cor.shown(), "0 to 1"))?
            }
        };
        Ok(Self {
            name: root.string("name")?.unwrap_or_else(|| "unnamed ball".to_owned()),
            source: root.string("source")?.unwrap_or_default(),
            mass: needed("mass", Some(Quantity::Mass))?,
            radius: needed("radius", Some(Quantity::Length))?,
            stiffness: positive("stiffness", None)?,
            exponent: if linear.is_some() { Some(1.0) } else { exponent },
            cor,
            cor_by_speed,
        })
    }
}

/// `[[speed, e₀], …]`, the speeds rising.
fn by_speed(node: &Node) -> Result<Vec<[f64; 2]>> {
    let mut all: Vec<[f64; 2]> = vec![];
    for pair in node.items()? {
        let expected = "a speed and the restitution at it, such as [\"58 mph\", 0.546]";
        let [speed, cor] = &pair.items()?[..] else {
            return Err(pair.error(pair.shown(), expected));
        };
        let e0 = restitution(cor.number()?).map_err(|_| cor.error(cor.shown(), "0 to 1"))?;
        let at = speed.quantity(Quantity::Speed)?;
        if at < 0.0 || all.last().is_some_and(|[before, _]| at <= *before) {
            return Err(speed.error(speed.shown(), "speeds of 0 or more, each above the last"));
        }
        all.push([at, e0]);
    }
    if all.is_empty() { Err(node.error(node.shown(), "one pair at least")) } else { Ok(all) }
}

/// e₀ of a linear ball, `m x″ + 2ζ√(km) x′ + k x = 0` until its force is zero:
/// `exp(−2ζ arccos ζ/√(1 − ζ²))`.
///
/// It then is struck as a spring with exponent 1 that returns as much: a dashpot would push at once
/// where a ball is hardly touched, which no ball does.
///
/// # Source
///
/// T. Schwager, T. Pöschel, Granular Matter 9 (2007) 465, for the end of the contact where the
/// force ends.
fn linear(node: &Node, exponent: Option<f64>) -> Result<f64> {
    if exponent.is_some_and(|exponent| exponent != 1.0) {
        let expected = "an exponent of 1, or none: a damping ratio is that of a linear ball";
        return Err(node.error(node.shown(), expected));
    }
    let ratio = node.number()?;
    if !(0.0..1.0).contains(&ratio) {
        return Err(node.error(node.shown(), "0 to below 1"));
    }
    Ok((-2.0 * ratio * ratio.acos() / ((1.0 - ratio) * (1.0 + ratio)).sqrt()).exp())
}

/// A coefficient of restitution, from 0 to 1.
///
/// # Errors
///
/// [`Error::Value`] for any other number.
pub fn restitution(value: f64) -> Result<f64> {
    if (0.0..=1.0).contains(&value) { Ok(value) } else { Err(Error::value("cor", value, "0 to 1")) }
}
