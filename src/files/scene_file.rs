//! How is a hit's setup written in a file?

use serde_json::{Map, Value};

use crate::base::{Mistakes, Quantity, Result};
use crate::collision::setup::Setup;
use crate::collision::wall_choice::WallChoice;
use crate::collision::{Ball, Model};
use crate::files::ball_file::e0;
use crate::files::document::Document;
use crate::files::json_node::Node;

/// Members that require another one.
const BESIDE: [(&str, &str); 4] = [
    ("bat_speed_at", "bat_speed"),
    ("wall_mass", "wall_stiffness"),
    ("swing_exponent", "reference_inertia"),
    ("reference_inertia", "swing_exponent"),
];
/// Members that exclude each other because they say the same.
const APART: [[&str; 2]; 2] = [["swing_speed", "bat_speed"], ["reference_inertia", "bat_speed"]];

/// The setup from the members of an object, with that ball; members that the object omits are those of
/// [`Setup::default`].
///
/// # Errors
///
/// [`crate::Error::Input`] with line and column, or several of them.
pub fn read(node: &Node, ball: Ball) -> Result<Setup> {
    let mut mistakes = Mistakes::default();
    let object = node.object(&Setup::MEMBERS, &mut mistakes)?;
    for pair in &APART {
        mistakes.note(object.one_of(pair).map(|_| ()));
    }
    for (key, needed) in BESIDE {
        if let (Some(node), None) = (object.get(key), object.get(needed)) {
            let found = format!("no \"{needed}\" beside it");
            mistakes.add(node.key().error(found, "both, or neither of them"));
        }
    }
    let mut of = |key: &str, quantity| {
        mistakes.note(object.get(key).map(|node| node.quantity(quantity)).transpose())
    };
    let mut setup = Setup { ball, ..Setup::default() };
    for (slot, key, quantity) in [
        (&mut setup.swing_speed, "swing_speed", Quantity::AngularSpeed),
        (&mut setup.bat_speed_at, "bat_speed_at", Quantity::Length),
        (&mut setup.pivot, "pivot", Quantity::Length),
        (&mut setup.pitch, "pitch", Quantity::Speed),
        (&mut setup.hands, "hands", Quantity::Length),
    ] {
        *slot = of(key, quantity).unwrap_or(*slot);
    }
    setup.bat_speed = of("bat_speed", Quantity::Speed);
    setup.wall_stiffness = of("wall_stiffness", Quantity::Stiffness);
    setup.wall_mass = of("wall_mass", Quantity::Mass);
    setup.reference_inertia = of("reference_inertia", Quantity::Inertia);
    setup.pulse_duration = of("pulse_duration", Quantity::Time);
    let stiffness = of("ball_stiffness", Quantity::Stiffness);
    for (slot, key) in [
        (&mut setup.swing_exponent, "swing_exponent"),
        (&mut setup.gamma, "gamma"),
        (&mut setup.decay, "decay"),
        (&mut setup.loss_share, "loss_share"),
    ] {
        *slot = mistakes.note(object.get(key).map(not_negative).transpose());
    }
    if let Some(node) = object.get("cor") {
        setup.cor = mistakes.some(e0(node));
    }
    if let Some(node) = object.get("model") {
        let named = Model::all().map(|model| (model.name(), model));
        setup.model = mistakes.some(node.word(&named)).unwrap_or(setup.model);
    }
    if let Some(node) = object.get("wall") {
        setup.wall = mistakes.some(node.word(&WallChoice::ALL)).unwrap_or(setup.wall);
    }
    if let (Some(stiffness), Some(node)) = (stiffness, object.get("ball_stiffness")) {
        let linear = setup.ball.clone().linear(stiffness);
        let linear = linear.map_err(|_| node.error(node.shown(), "a ball's stiffness, above 0"));
        setup.ball = mistakes.some(linear).unwrap_or(setup.ball);
    }
    mistakes.end(setup)
}

/// The setup with these members, which do not come from a file.
///
/// # Errors
///
/// As `read`, of a file called "scene".
pub fn of(members: &Map<String, Value>, ball: Ball) -> Result<Setup> {
    from_text(&Value::Object(members.clone()).to_string(), ball)
}

/// The setup with the members of an object in a text.
///
/// # Errors
///
/// As [`of`].
pub fn from_text(text: &str, ball: Ball) -> Result<Setup> {
    let document = Document::new("scene".to_owned(), text);
    read(&Node::root(&document)?, ball)
}

fn not_negative(node: &Node) -> Result<f64> {
    let value = node.number()?;
    match (0.0..=100.0).contains(&value) {
        true => Ok(value + 0.0),
        false => Err(node.error(node.shown(), "0 to 100")),
    }
}
