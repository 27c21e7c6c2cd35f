//! How is a ball written in a file?
//!
//! [`Ball::from_file`] reads a `sweetspot-ball/1` file and reports all its mistakes at once.

use std::path::Path;

use serde_json::{Value, json};

use crate::base::{Mistakes, Quantity, Result, mistakes};
use crate::collision::ball::restitution;
use crate::collision::contact::power_law;
use crate::collision::{Ball, LawOf};
use crate::files::document::Document;
use crate::files::json_node::{Node, Object};

const KEYS: &[&str] = &[
    "format",
    "name",
    "source",
    "mass",
    "radius",
    "contact_radius",
    "stiffness",
    "exponent",
    "cor",
    "cor_by_speed",
    "damping_ratio",
];

impl Ball {
    /// Reads a `sweetspot-ball/1` file.
    ///
    /// # Errors
    ///
    /// [`crate::Error::Read`], or [`crate::Error::Input`] with line and column, or several of them.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self> {
        from_document(&Document::read(path.as_ref())?)
    }

    /// Reads a ball from text; `file` is its name in messages.
    ///
    /// # Errors
    ///
    /// As [`Self::from_file`].
    pub fn from_text(file: &str, text: &str) -> Result<Self> {
        from_document(&Document::new(file.to_owned(), text))
    }
}

/// A ball as its file members.
pub fn written(ball: &Ball) -> Value {
    let mut file = json!({
        "format": "sweetspot-ball/1",
        "name": ball.name,
        "source": ball.source,
        "mass": ball.mass_kg,
        "radius": ball.radius_m,
    });
    let optional = [
        ("contact_radius", ball.contact_radius_m),
        ("stiffness", ball.stiffness),
        ("exponent", ball.exponent),
    ];
    for (key, value) in optional {
        if let Some(value) = value {
            file[key] = value.into();
        }
    }
    match ball.cor_by_speed.is_empty() {
        true => file["cor"] = ball.cor.into(),
        false => file["cor_by_speed"] = json!(ball.cor_by_speed),
    }
    file
}

pub(crate) fn from_document(document: &Document) -> Result<Ball> {
    let root = Node::root(document)?.members()?;
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
    let contact_radius = mistakes.note(contact_radius(&root));
    let stiffness = mistakes.note(optional("stiffness"));
    let exponent = mistakes.note(optional("exponent"));
    if contact_radius.is_some_and(|contact| contact > radius) {
        let node = root.require("contact_radius", "\"contact_radius\" of the ball")?;
        mistakes.add(node.error(node.shown(), "no more than the ball's own radius"));
    }
    let bounce = mistakes.and(bounce(&root, exponent))?;
    Ok(Ball {
        name: name.unwrap_or_else(|| "unnamed ball".to_owned()),
        source: source.unwrap_or_default(),
        mass_kg: mass,
        radius_m: radius,
        contact_radius_m: contact_radius,
        stiffness,
        exponent: if bounce.linear { Some(1.0) } else { exponent },
        law: LawOf(power_law::law),
        cor: bounce.cor,
        cor_by_speed: bounce.by_speed,
    })
}

/// The radius of the ball's patch, if there is one.
fn contact_radius(root: &Object) -> Result<Option<f64>> {
    /// A smaller patch would make a hole (m).
    const LEAST: f64 = 1e-3;
    let read = |node: &Node| match positive(node, Some(Quantity::Length))? {
        radius if radius >= LEAST => Ok(radius),
        _ => Err(node.error(node.shown(), "1 mm at least")),
    };
    root.get("contact_radius").map(read).transpose()
}

/// Restitution, in one of the ways of writing it.
struct Bounce {
    cor: f64,
    by_speed: Vec<[f64; 2]>,
    /// Whether it was given as the damping of a linear ball.
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
        // A table that could not be read is already reported.
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
    // Small enough and large enough for its square to be representable.
    if value > 1e-100 && value < 1e100 {
        Ok(value)
    } else {
        Err(node.error(node.shown(), "a value above 0, of a ball's size"))
    }
}

/// A coefficient of restitution in a file.
pub(crate) fn e0(node: &Node) -> Result<f64> {
    restitution(node.number()?).map_err(|_| node.error(node.shown(), "0 to 1"))
}

/// `[[speed, e₀], …]`, with rising speeds.
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
/// The contact is then computed with a spring of exponent 1 that returns as much energy: a dashpot would push at once
/// at first touch, which no ball does.
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
