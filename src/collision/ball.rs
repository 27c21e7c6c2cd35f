//! What ball: mass, size, bounce and stiffness.

use std::path::Path;

use crate::document::Document;
use crate::error::{Error, Result};
use crate::json_node::{Node, Object};
use crate::mistakes::{self, Mistakes};
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

    /// The baseball kept at 50 instead of 30 % relative humidity, so that it is 1.6 % heavier and e₀
    /// 3.7 % smaller.
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
            mass: 1.016 * dry.mass,
            cor: (1.0 - 0.037) * dry.cor,
            ..dry
        }
    }

    /// The ball as a linear spring of that stiffness (N/m).
    ///
    /// Without loss `½ m v² = ½ F²/k`, so that a force F on a rigid surface at a speed v measures
    /// `k = F²/(m v²)`, a dynamic stiffness.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a stiffness that no ball has.
    pub fn linear(self, stiffness: f64) -> Result<Self> {
        if !(1.0..=1e12).contains(&stiffness) {
            let found = format!("{stiffness:?} N/m");
            return Err(Error::value("--ball-stiffness", found, "1 to 1e12 N/m"));
        }
        let source = format!("{}; a linear spring of {stiffness} N/m, as was asked", self.source);
        Ok(Self { source, stiffness: Some(stiffness), exponent: Some(1.0), ..self })
    }

    /// A 12 in softball: 6¼ to 7 oz, 11⅞ to 12⅛ in around by the rules, e₀ 0.44.
    pub fn softball() -> Self {
        Self {
            name: "softball".into(),
            source: "mass and radius: middle of the rules' 6.25 to 7 oz and 11.875 to 12.125 in \
                     around; e0: the common 0.44 ball (0.47 and 0.52 are approved too); no source \
                     of a force law was found"
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
    /// [`Error::Read`], or [`Error::Input`] with line and column, or several of them.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self> {
        let document = Document::read(path.as_ref())?;
        let root = Node::root(&document)?.members()?;
        root.check_format("sweetspot-ball/1")?;
        let mut mistakes = Mistakes::default();
        let root = root.only(KEYS, &mut mistakes);
        mistakes.note(root.require("format", "\"format\": \"sweetspot-ball/1\"").map(|_| ()));
        let needed = |key: &str, quantity| -> Result<f64> {
            let node = root.require(key, &format!("\"{key}\" of the ball"))?;
            positive(node, quantity)
        };
        let optional = |key: &str| root.get(key).map(|node| positive(node, None)).transpose();
        let name = mistakes.note(root.string("name"));
        let source = mistakes.note(root.string("source"));
        let mass = mistakes.note(needed("mass", Some(Quantity::Mass)));
        let radius = mistakes.note(needed("radius", Some(Quantity::Length)));
        let stiffness = mistakes.note(optional("stiffness"));
        let exponent = mistakes.note(optional("exponent"));
        let bounce = mistakes.and(bounce(&root, exponent))?;
        Ok(Self {
            name: name.unwrap_or_else(|| "unnamed ball".to_owned()),
            source: source.unwrap_or_default(),
            mass,
            radius,
            stiffness,
            exponent: if bounce.linear { Some(1.0) } else { exponent },
            cor: bounce.cor,
            cor_by_speed: bounce.by_speed,
        })
    }
}

/// How a ball comes back, in one of the ways in which it may be written.
struct Bounce {
    cor: f64,
    by_speed: Vec<[f64; 2]>,
    /// Whether it was written as the damping of a linear ball.
    linear: bool,
}

fn bounce(root: &Object, exponent: Option<f64>) -> Result<Bounce> {
    let mut mistakes = Mistakes::default();
    let by_speed = mistakes.some(root.get("cor_by_speed").map(by_speed).transpose());
    let known = by_speed.as_ref().and_then(|table| table.as_ref()?.last().map(|[_, cor]| *cor));
    let damped = root.get("damping_ratio").map(|node| linear(node, exponent));
    let linear = damped.is_some();
    mistakes.note(root.one_of(&["cor", "damping_ratio"]).map(|_| ()));
    let cor = match (damped, root.get("cor"), known) {
        (Some(cor), ..) => cor,
        (None, Some(node), _) => e0(node),
        (None, None, Some(cor)) => Ok(cor),
        // A table that could not be read is told already.
        (None, None, None) if by_speed.is_none() => Ok(0.0),
        (None, None, None) => root.require("cor", "\"cor\" on a rigid wall").map(|_| 0.0),
    };
    let cor = mistakes.note(cor);
    mistakes.end(Bounce { cor, by_speed: by_speed.flatten().unwrap_or_default(), linear })
}

/// A number, or a quantity, of a ball's size.
fn positive(node: &Node, quantity: Option<Quantity>) -> Result<f64> {
    let value = match quantity {
        Some(quantity) => node.quantity(quantity)?,
        None => node.number()?,
    };
    // Small enough and large enough for its square to be a number.
    if value > 1e-100 && value < 1e100 {
        Ok(value)
    } else {
        Err(node.error(node.shown(), "a value above 0, of a ball's size"))
    }
}

/// A coefficient of restitution in a file.
fn e0(node: &Node) -> Result<f64> {
    restitution(node.number()?).map_err(|_| node.error(node.shown(), "0 to 1"))
}

/// `[[speed, e₀], …]`, the speeds rising.
fn by_speed(node: &Node) -> Result<Vec<[f64; 2]>> {
    let pairs = node.items()?;
    if pairs.is_empty() {
        return Err(node.error(node.shown(), "one pair at least"));
    }
    let all = mistakes::all(pairs.iter().map(pair))?;
    mistakes::all((1..all.len()).filter(|k| all[*k][0] <= all[k - 1][0]).map(|k| {
        let speed = pairs[k].item(0);
        Err::<(), _>(speed.error(speed.shown(), "speeds of 0 or more, each above the last"))
    }))?;
    Ok(all)
}

/// A speed and the restitution at it.
fn pair(node: &Node) -> Result<[f64; 2]> {
    let [speed, cor] = &node.items()?[..] else {
        let expected = "a speed and the restitution at it, such as [\"58 mph\", 0.546]";
        return Err(node.error(node.shown(), expected));
    };
    let mut mistakes = Mistakes::default();
    let at = mistakes.note(speed.quantity(Quantity::Speed));
    if at < 0.0 {
        mistakes.add(speed.error(speed.shown(), "speeds of 0 or more, each above the last"));
    }
    mistakes.and(e0(cor).map(|cor| [at, cor]))
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
