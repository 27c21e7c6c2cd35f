//! The question: its kind, its bat and its scene.

use std::path::Path;

use serde::Deserialize;
use serde_json::{Map, Value, json};
use sweetspot::base::error::{Error, Result};
use sweetspot::collision::hit::Model;
use sweetspot::collision::setup::Setup;
use sweetspot::files::document::Document;
use sweetspot::files::json_node::Node;
use sweetspot::files::{balls, scene_file};
use sweetspot::{Bat, Request};
use sweetspot_report::parts::units::Units;

use crate::{aim, analyze, body, files, hit, lathe, open, sound, tap, trace};

/// A request as the page writes it.
#[derive(Deserialize)]
struct Asked {
    #[serde(default)]
    id: u64,
    ask: String,
    #[serde(default)]
    bat: String,
    #[serde(default)]
    scene: Map<String, Value>,
    #[serde(default)]
    units: String,
    /// Members of this kind of question.
    #[serde(flatten)]
    more: Map<String, Value>,
}

/// A question about a bat that could be read.
#[derive(Clone)]
pub struct Question {
    /// The bat of the question.
    pub bat: Bat,
    /// The text of its file.
    pub text: String,
    /// Swing, pitch and ball.
    pub setup: Setup,
    /// The scene as written in the question.
    pub scene: Map<String, Value>,
    /// The units of all texts.
    pub units: Units,
    /// Members of this kind of question.
    pub more: Map<String, Value>,
}

/// Name of the bat's file in messages.
pub const BAT: &str = "bat.json";

/// The request for hits and modes: the program's default.
pub fn request() -> Request {
    Request::default()
}

/// The answer to a request, both in JSON. The answer also reports what is wrong with the request. `bytes` is the data
/// after the request: a photograph, sound, or nothing.
pub fn answered(text: &str, bytes: &[u8]) -> String {
    let asked: Asked = match serde_json::from_str(text) {
        Ok(asked) => asked,
        Err(error) => return failed(0, &Error::value("the request", error, "a request")),
    };
    let id = asked.id;
    match answer(asked, bytes) {
        Ok(mut answer) => {
            answer["id"] = id.into();
            answer.to_string()
        }
        Err(error) => failed(id, &error),
    }
}

/// The answer that reports a panic.
pub fn panicked(words: &str) -> String {
    json!({ "id": 0, "error": words, "panic": true }).to_string()
}

/// Calls the function of the question.
fn answer(asked: Asked, bytes: &[u8]) -> Result<Value> {
    type Answering = fn(&Question) -> Result<Value>;
    const QUESTIONS: [(&str, Answering); 8] = [
        ("body", body::answer),
        ("live", hit::live),
        ("sure", hit::sure),
        ("analyze", analyze::answer),
        ("lathe", lathe::answer),
        ("aim", aim::answer),
        ("sound", sound::answer),
        ("files", files::answer),
    ];
    // For tests of the page after an internal error; a released core does not have this question.
    debug_assert!(asked.ask != "panic", "asked to panic");
    let units = units(&asked.units)?;
    if asked.ask == "open" {
        return open::answer(&asked.bat, units);
    }
    if asked.ask == "trace" {
        return trace::answer(&asked.more.into(), bytes, units);
    }
    let answering = QUESTIONS.iter().find(|(name, _)| *name == asked.ask);
    if answering.is_none() && asked.ask != "tap" {
        let names: Vec<&str> = QUESTIONS.iter().map(|(name, _)| *name).collect();
        let expected = format!("open, trace, tap, {}", names.join(", "));
        return Err(Error::value("ask", asked.ask, expected));
    }
    let bat = Bat::from_text(BAT, &asked.bat, Path::new(""))?;
    let setup = setup(&asked.scene)?;
    let Asked { bat: text, scene, more, .. } = asked;
    let question = Question { bat, text, setup, scene, units, more };
    match answering {
        Some((_, answering)) => answering(&question),
        None => tap::answer(&question, bytes),
    }
}

fn units(name: &str) -> Result<Units> {
    match name {
        "" | "si" => Ok(Units::Si),
        "us" => Ok(Units::Us),
        other => Err(Error::value("units", other, "si or us")),
    }
}

/// The scene, whose members are the options of `sweetspot hit`, the ball by its name.
fn setup(scene: &Map<String, Value>) -> Result<Setup> {
    let mut members = scene.clone();
    let ball = members.remove("ball").unwrap_or_else(|| "baseball".into());
    let known = ball.as_str().and_then(balls::built_in);
    let ball = known
        .ok_or_else(|| Error::value("`ball`", &ball, "baseball, humid-baseball or softball"))?;
    let document = Document::new("scene".to_owned(), &Value::from(members).to_string());
    let setup = scene_file::read(&Node::root(&document)?, ball)?;
    setup.model()?;
    Ok(setup)
}

impl Question {
    /// A text member of this kind of question.
    pub fn said(&self, name: &str) -> Option<&str> {
        self.more.get(name)?.as_str()
    }

    /// Error of traced diameters (m), which is larger than that of calipers.
    pub fn traced(&self) -> Option<f64> {
        let told = self.more.get("diameter_deviation_m")?.as_f64()?;
        (told >= 0.0).then_some(told.min(0.01))
    }

    /// The collision model.
    pub fn model(&self) -> Result<Model> {
        self.setup.model()
    }
}

/// The mistakes: one sentence, and each mistake with its place in the bat's text.
fn failed(id: u64, error: &Error) -> String {
    let all = match error {
        Error::Several { shown, .. } => &shown[..],
        one => std::slice::from_ref(one),
    };
    let mistake = |error: &Error| match error {
        Error::Input { place, complaint } if place.file == BAT => json!({
            "text": complaint.to_string(), "line": place.line, "column": place.column,
        }),
        other => json!({ "text": other.to_string() }),
    };
    let mistakes: Vec<Value> = all.iter().map(mistake).collect();
    json!({ "id": id, "error": error.to_string(), "mistakes": mistakes }).to_string()
}
