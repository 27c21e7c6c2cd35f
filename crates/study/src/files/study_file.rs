//! Which bats does somebody want to vary, and what is asked of them?
//!
//! [`StudyFile::from_text`] reads a `sweetspot-study/1` file.

use serde_json::{Map, Value};

use crate::files::study_vary::{Varied, VariedFile, varied};
use crate::many::answers::Answer;
use crate::many::design::{Axis, Design, Spread, Wanted};
use crate::many::rows::Asked;
use sweetspot::base::error::{Complaint, Error, FilePosition, Result};
use sweetspot::base::mistakes::{self, Mistakes};
use sweetspot::collision::ball::Ball;
use sweetspot::files::document::Document;
use sweetspot::files::json_node::{Node, Object};
use sweetspot::files::scene_file;

const KEYS: &[&str] = &[
    "format",
    "name",
    "bat",
    "ball",
    "scene",
    "vary",
    "correlations",
    "design",
    "points",
    "seed",
    "outputs",
    "tol",
    "$schema",
];
const SPREADS: &[(&str, Spread)] = &[
    ("sobol", Spread::Sobol),
    ("latin-hypercube", Spread::LatinHypercube),
    ("random", Spread::Random),
];
/// Points of a study that does not say how many.
const POINTS: u64 = 1000;

/// A study.
#[derive(Debug, Clone)]
pub struct StudyFile {
    /// Files of bats, folders of them, or names of built-in ones.
    pub bats: Vec<String>,
    /// File of the ball, or the name of a built-in one.
    pub ball: Option<String>,
    /// Members of the scene, as written.
    pub scene: Map<String, Value>,
    /// What varies.
    pub varied: Vec<Varied>,
    /// The rows.
    pub design: Design,
    /// What is asked of every bat.
    pub asked: Asked,
    /// The names of the answers, as written.
    pub outputs: Vec<String>,
    /// Its members that say how numbers are drawn, where none is.
    pub idle: Vec<&'static str>,
    /// Where it says what varies, or else which bats there are.
    place: Box<FilePosition>,
    /// Where it names its bats, and its ball.
    naming: [Box<FilePosition>; 2],
}

impl StudyFile {
    /// Reads a study from text; `file` is what messages call it.
    ///
    /// # Errors
    ///
    /// [`Error::Input`] with line and column, or several of them.
    pub fn from_text(file: &str, text: &str) -> Result<Self> {
        from_document(&Document::new(file.to_owned(), text))
    }

    /// Whether anything varies in such a document.
    pub fn varies(&self, subject: VariedFile) -> bool {
        self.varied.iter().any(|varied| varied.subject == subject)
    }

    /// What is wrong with a bat or a ball that the study names: said where it does.
    pub fn names_in_vain(&self, subject: VariedFile, error: Error) -> Error {
        let [of_bats, of_ball] = &self.naming;
        let (place, field, expected) = match subject {
            VariedFile::Ball => (of_ball, "ball", "a ball file or the name of a built-in ball"),
            _ => (of_bats, "bat", "a bat file, a folder of them or the name of a built-in bat"),
        };
        let complaint = match error {
            Error::Read { path, source } => {
                Complaint::new(field, format!("{}: {source}", path.display()), expected)
            }
            Error::Value(complaint) => Complaint { field: field.to_owned(), ..complaint },
            other => return other,
        };
        Error::Input { place: place.clone(), complaint }
    }

    /// What is wrong with a study that comes to nothing in every row that was tried, by what was wrong with one.
    pub fn comes_to_nothing(&self, error: Error) -> Error {
        let complaint = match error {
            Error::Several { mut shown, .. } if !shown.is_empty() => {
                return self.comes_to_nothing(shown.swap_remove(0));
            }
            Error::Input { complaint, .. } | Error::Value(complaint) => complaint,
            other => return other,
        };
        let complaint = complaint.naming(str::to_owned);
        match self.varied.iter().find(|varied| varied.is_meant(&complaint)) {
            Some(varied) => varied.wrong(complaint),
            None => {
                let found = match &*complaint.field {
                    "" => format!("{} in every row that was tried", complaint.found),
                    field => format!("{} for {field} in every row that was tried", complaint.found),
                };
                let complaint = Complaint { field: String::new(), found, ..complaint };
                Error::Input { place: self.place.clone(), complaint }
            }
        }
    }
}

fn from_document(document: &Document) -> Result<StudyFile> {
    let root = Node::root(document)?.members()?;
    root.check_format("sweetspot-study/1")?;
    let mut mistakes = Mistakes::default();
    let root = root.only(KEYS, &mut mistakes);
    let format = "\"format\": \"sweetspot-study/1\"";
    mistakes.note(root.require("format", format).map(|_| ()));
    mistakes.note(root.string("$schema"));
    mistakes.note(root.string("name"));
    let bats = root.require("bat", "\"bat\": a bat file or the name of a built-in bat");
    let bats = mistakes.note(bats.and_then(bats_named));
    let ball = mistakes.note(root.string("ball"));
    let scene = mistakes.note(scene(&root));
    let mut wanted = Wanted { points: POINTS, ..Wanted::default() };
    let varied = root.get("vary").map_or(Ok(vec![]), |node| varied(node, &mut wanted));
    let varied = mistakes.note(varied);
    let outputs = root.require("outputs", "\"outputs\": a list of names, such as \"f1_hz\"");
    let (outputs, answers) = mistakes.note(outputs.and_then(answers)).into_iter().unzip();
    let tolerance = root.get("tol").map_or(Ok(1e-4), tolerance);
    let tolerance = mistakes.note(tolerance);
    for (key, number) in [("points", &mut wanted.points), ("seed", &mut wanted.seed)] {
        if let Some(node) = root.get(key) {
            *number = mistakes.note(node.whole());
        }
    }
    if let Some(node) = root.get("design") {
        wanted.spread = mistakes.note(node.word(SPREADS));
    }
    if let Some(node) = root.get("correlations") {
        wanted.correlations = mistakes.note(correlations(node, &varied));
    }
    mistakes.end(())?;
    let placed = |error: Error| {
        error.placed(|complaint| {
            let key = match &*complaint.field {
                "correlation" => "correlations",
                "vary" => "vary",
                _ => "points",
            };
            let node = root.get(key).unwrap_or(&root.node);
            node.complain(Complaint { field: String::new(), ..complaint })
        })
    };
    let says = |key: &&str| root.get(key).is_some();
    let drawing = ["design", "points", "seed"].into_iter().filter(says);
    let idle = if wanted.drawn.is_empty() { drawing.collect() } else { vec![] };
    let design = Design::new(wanted).map_err(placed)?;
    let asked = Asked { answers, tolerance };
    let place = root.get("vary").or(root.get("bat")).unwrap_or(&root.node).place();
    let of = |key: &str| root.get(key).unwrap_or(&root.node).place();
    let naming = ["bat", "ball"].map(of);
    Ok(StudyFile { bats, ball, scene, varied, design, asked, outputs, idle, place, naming })
}

/// One bat, or a list of them.
fn bats_named(node: &Node) -> Result<Vec<String>> {
    if let Ok(one) = node.string() {
        return Ok(vec![one]);
    }
    let expected = "a bat file, a folder of them or the name of a built-in bat, or a list of those";
    let Ok(items) = node.items() else { return Err(node.error(node.shown(), expected)) };
    if items.is_empty() {
        return Err(node.error("an empty list", expected));
    }
    mistakes::all(items.iter().map(Node::string))
}

/// The members of the scene, each of which was read once to see that it can be.
fn scene(root: &Object) -> Result<Map<String, Value>> {
    let Some(node) = root.get("scene") else { return Ok(Map::new()) };
    scene_file::read(node, Ball::baseball())?;
    let members = node.members()?;
    let said = members.keys().iter().filter(|(key, _)| key != "comment");
    Ok(said.map(|(key, node)| (key.clone(), node.value())).collect())
}

fn tolerance(node: &Node) -> Result<f64> {
    let value = node.number()?;
    match value > 0.0 && value < 1.0 {
        true => Ok(value),
        false => Err(node.error(node.shown(), "a number between 0 and 1, such as 1e-4")),
    }
}

/// Answers by the names that they are asked for.
fn answers(node: &Node) -> Result<Vec<(String, Answer)>> {
    let items = node.items()?;
    if items.is_empty() {
        return Err(node.error("an empty list", "one name at least, such as \"f1_hz\""));
    }
    let mut seen: Vec<Answer> = vec![];
    mistakes::all(items.iter().map(|item| {
        let name = item.string()?;
        let answer = Answer::named(&name).map_err(|error| {
            error.placed(|complaint| item.complain(Complaint { field: String::new(), ..complaint }))
        })?;
        if seen.contains(&answer) {
            return Err(item.error(item.shown(), "every output once"));
        }
        seen.push(answer);
        Ok((name, answer))
    }))
}

fn correlations(node: &Node, varied: &[Varied]) -> Result<Vec<(usize, usize, f64)>> {
    let drawn = |node: &Node| {
        let path = node.string()?;
        let found = varied.iter().find(|varied| varied.path == path);
        match found.map(Varied::axis) {
            Some(Axis::Drawn(k)) => Ok(k),
            _ => Err(node.error(node.shown(), "the path of a number that is drawn")),
        }
    };
    let items = node.items()?;
    let all = mistakes::all(items.iter().map(|item| {
        let [a, b, r] = &item.items()?[..] else {
            let expected = "two paths and their correlation, such as \
                            [\"bat.material.density\", \"bat.material.youngs_modulus\", 0.6]";
            return Err(item.error(item.shown(), expected));
        };
        let (first, second) = (drawn(a)?, drawn(b)?);
        if first == second {
            return Err(b.error(b.shown(), "another path than the first"));
        }
        let r_value = r.number()?;
        match r_value.abs() < 1.0 {
            true => Ok((first, second, r_value)),
            false => Err(r.error(r.shown(), "a number between -1 and 1")),
        }
    }))?;
    let pair = |(a, b, _): &(usize, usize, f64)| [*a.min(b), *a.max(b)];
    for (k, item) in items.iter().enumerate() {
        if all[..k].iter().any(|other| pair(other) == pair(&all[k])) {
            return Err(item.error(item.shown(), "one correlation of each two paths"));
        }
    }
    Ok(all)
}
