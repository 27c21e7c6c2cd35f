//! Which bats does somebody want to vary, and what is asked of them?
//!
//! [`StudyFile::from_text`] reads a `sweetspot-study/1` file. What it varies it names by its path in the bat file,
//! in the ball file or in the scene; [`put`] puts a value there.

use serde_json::{Map, Value};

use crate::base::error::{Complaint, Error, Result};
use crate::base::mistakes::{self, Mistakes};
use crate::base::number::shortest;
use crate::base::typed;
use crate::collision::ball::Ball;
use crate::collision::setup::Setup;
use crate::files::document::Document;
use crate::files::json_node::{Node, Object};
use crate::files::scene_file;
use crate::study::many::answers::Answer;
use crate::study::many::design::{Design, Row, Spread, Wanted};
use crate::study::many::distribution::Distribution;
use crate::study::many::rows::Asked;

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
/// How something varies.
const WAYS: [&str; 6] = ["values", "grid", "uniform", "normal", "lognormal", "triangular"];
/// The documents whose members may vary.
const SUBJECTS: &[(&str, Subject)] =
    &[("bat", Subject::Bat), ("ball", Subject::Ball), ("scene", Subject::Scene)];
const SPREADS: &[(&str, Spread)] = &[
    ("sobol", Spread::Sobol),
    ("latin-hypercube", Spread::LatinHypercube),
    ("random", Spread::Random),
];
/// Points of a study that does not say how many.
const POINTS: u64 = 1000;

/// Whose member varies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// The bat file's.
    Bat,
    /// The ball file's.
    Ball,
    /// The scene's.
    Scene,
}

/// A member that varies.
#[derive(Debug, Clone)]
pub struct Varied {
    /// Its path, with that of its document before it: `bat.material.density`.
    pub path: String,
    /// Whose it is.
    pub subject: Subject,
    way: Way,
}

#[derive(Debug, Clone)]
enum Way {
    /// One of these, the list by its number.
    Listed(usize, Vec<Value>),
    /// One of these numbers in that unit, which may be none, the list by its number.
    Gridded(usize, Vec<f64>, String),
    /// A number in that unit, which may be none, the distribution by its number.
    Drawn(usize, String),
}

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
}

impl Varied {
    /// Its path inside its document.
    pub fn inside(&self) -> &str {
        self.path.split_once('.').map_or("", |(_, inside)| inside)
    }

    /// Its value in a row, as a document has it.
    pub fn value(&self, row: &Row) -> Value {
        let in_unit = |value: f64, unit: &str| match unit {
            "" => Value::from(value),
            unit => format!("{} {unit}", shortest(value)).into(),
        };
        match &self.way {
            Way::Listed(k, values) => values[row.picks[*k] as usize].clone(),
            Way::Gridded(k, values, unit) => in_unit(values[row.picks[*k] as usize], unit),
            Way::Drawn(k, unit) => in_unit(row.values[*k], unit),
        }
    }

    /// Its value in a row, as a table has it: a number in its unit, or what the list says.
    pub fn cell(&self, row: &Row) -> String {
        match &self.way {
            Way::Drawn(k, _) => shortest(row.values[*k]),
            Way::Gridded(k, values, _) => shortest(values[row.picks[*k] as usize]),
            Way::Listed(..) => match self.value(row) {
                Value::String(text) => text,
                other => other.to_string(),
            },
        }
    }

    /// Whether it is drawn from a distribution.
    pub fn is_drawn(&self) -> bool {
        matches!(self.way, Way::Drawn(..))
    }

    /// Whether all its values are numbers.
    pub fn is_number(&self) -> bool {
        match &self.way {
            Way::Drawn(..) | Way::Gridded(..) => true,
            Way::Listed(_, values) => values.iter().all(Value::is_number),
        }
    }

    /// The unit of its numbers, empty for SI and for what is listed.
    pub fn unit(&self) -> &str {
        match &self.way {
            Way::Drawn(_, unit) | Way::Gridded(_, _, unit) => unit,
            Way::Listed(..) => "",
        }
    }
}

/// Puts a value into a document, at a path such as `attachments[0].mass`. A member that is not there is added
/// to its object; a material that is a name becomes that name with a member of its own.
///
/// # Errors
///
/// How far the path leads, where it leads nowhere.
pub fn put(root: &mut Value, path: &str, value: Value) -> std::result::Result<(), String> {
    let steps: Vec<&str> = path.split(['.', '[']).collect();
    let (mut here, mut passed) = (root, String::new());
    for step in steps {
        let lost = |what: String| format!("{what} at \"{passed}\"");
        match step.strip_suffix(']') {
            Some(k) => {
                let list = here.as_array_mut().ok_or_else(|| lost("no list".to_owned()))?;
                let many = list.len();
                let item = k.parse::<usize>().ok().and_then(|k| list.get_mut(k));
                here = item.ok_or_else(|| lost(format!("{many} items, none of number {k},")))?;
                passed += &format!("[{k}]");
            }
            None => {
                if here.is_string() && passed == "material" {
                    *here = serde_json::json!({ "name": here.clone() });
                }
                let object = here.as_object_mut().ok_or_else(|| lost("no object".to_owned()))?;
                here = object.entry(step).or_insert(Value::Null);
                passed += &format!("{}{step}", if passed.is_empty() { "" } else { "." });
            }
        }
    }
    *here = value;
    Ok(())
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
    let answers = mistakes.note(outputs.and_then(answers));
    let tolerance = root.get("tol").map_or(Ok(1e-4), tolerance);
    let tolerance = mistakes.note(tolerance);
    for (key, number) in [("points", &mut wanted.points), ("seed", &mut wanted.seed)] {
        if let Some(node) = root.get(key) {
            *number = mistakes.note(whole(node));
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
    let design = Design::new(wanted).map_err(placed)?;
    Ok(StudyFile { bats, ball, scene, varied, design, asked: Asked { answers, tolerance } })
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

fn whole(node: &Node) -> Result<u64> {
    /// Whole numbers up to there are what they are as numbers of a JSON file.
    const MOST: f64 = 9_007_199_254_740_992.0;
    let value = node.number()?;
    match value.fract() == 0.0 && (0.0..=MOST).contains(&value) {
        true => Ok(value as u64),
        false => Err(node.error(node.shown(), "a whole number, 0 or more")),
    }
}

fn answers(node: &Node) -> Result<Vec<Answer>> {
    let items = node.items()?;
    if items.is_empty() {
        return Err(node.error("an empty list", "one name at least, such as \"f1_hz\""));
    }
    let mut seen: Vec<Answer> = vec![];
    mistakes::all(items.iter().map(|item| {
        let answer = Answer::named(&item.string()?).map_err(|error| {
            error.placed(|complaint| item.complain(Complaint { field: String::new(), ..complaint }))
        })?;
        if seen.contains(&answer) {
            return Err(item.error(item.shown(), "every output once"));
        }
        seen.push(answer);
        Ok(answer)
    }))
}

fn varied(node: &Node, wanted: &mut Wanted) -> Result<Vec<Varied>> {
    let object = node.members()?;
    let paths = object.keys();
    if paths.is_empty() {
        let expected = "one path at least, such as \"bat.material.density\"";
        return Err(node.error("an empty object", expected));
    }
    mistakes::all(paths.iter().enumerate().map(|(k, (path, node))| {
        if paths[..k].iter().any(|(other, _)| other == path) {
            return Err(node.key().error(format!("\"{path}\" a second time"), "it once"));
        }
        let subject = path.split_once('.').and_then(|(first, inside)| {
            let known = SUBJECTS.iter().find(|(name, _)| *name == first)?;
            (!inside.is_empty()).then_some((known.1, inside))
        });
        let Some((subject, inside)) = subject else {
            let expected = "a path that begins with bat., ball. or scene., such as \
                            \"bat.material.density\"";
            return Err(node.key().error(format!("\"{path}\""), expected));
        };
        if subject == Subject::Scene && !Setup::MEMBERS.contains(&inside) {
            let expected = format!("scene. and one of {}", Setup::MEMBERS.join(", "));
            let complaint = Complaint::new("", format!("\"{path}\""), expected);
            return Err(node.key().complain(complaint.or_nearest(inside, &Setup::MEMBERS)));
        }
        Ok(Varied { path: path.clone(), subject, way: way(node, wanted)? })
    }))
}

/// How a member varies, noted in what the design is made of.
fn way(node: &Node, wanted: &mut Wanted) -> Result<Way> {
    let mut mistakes = Mistakes::default();
    let object = node.object(&WAYS, &mut mistakes)?;
    mistakes.end(())?;
    let Some((way, node)) = object.one_of(&WAYS)? else {
        let expected = format!("one of {}", WAYS.join(", "));
        return Err(node.error("nothing that says how it varies", expected));
    };
    let items = node.items()?;
    let mut list = |length: usize| {
        wanted.lists.push(length as u64);
        wanted.lists.len() - 1
    };
    if way == "values" {
        if items.is_empty() {
            return Err(node.error("an empty list", "one value at least"));
        }
        return Ok(Way::Listed(list(items.len()), items.iter().map(Node::value).collect()));
    }
    let forms: [(&str, &str, usize); 5] = [
        ("grid", "[from, to, how many], such as [\"0 oz\", \"2 oz\", 9]", 3),
        ("uniform", "[from, to], such as [600, 700]", 2),
        ("normal", "[mean, standard deviation], such as [\"27.5 mm\", \"0.2 mm\"]", 2),
        ("lognormal", "[median, standard deviation of the logarithm], such as [650, 0.04]", 2),
        ("triangular", "[from, likeliest, to], such as [600, 650, 720]", 3),
    ];
    let (_, form, count) = forms.into_iter().find(|(name, ..)| *name == way).unwrap_or(forms[0]);
    if items.len() != count {
        return Err(node.error(format!("{} values", items.len()), form));
    }
    // The last number of these two has no unit.
    let with_unit = if matches!(way, "grid" | "lognormal") { count - 1 } else { count };
    let numbers = mistakes::all(items[..with_unit].iter().map(number))?;
    let unit = numbers[0].1.clone();
    if let Some(k) = numbers.iter().position(|(_, other)| *other != unit) {
        let expected = match &*unit {
            "" => "a bare number, as the first".to_owned(),
            unit => format!("it in {unit}, as the first"),
        };
        return Err(items[k].error(items[k].shown(), expected));
    }
    let numbers: Vec<f64> = numbers.into_iter().map(|(number, _)| number).collect();
    if way == "grid" {
        let count = whole(&items[2])?;
        if !(2..=1_000_000).contains(&count) {
            return Err(items[2].error(items[2].shown(), "2 to 1000000 values"));
        }
        let at = |k: u64| {
            let share = k as f64 / (count - 1) as f64;
            (1.0 - share) * numbers[0] + share * numbers[1]
        };
        return Ok(Way::Gridded(list(count as usize), (0..count).map(at).collect(), unit));
    }
    let distribution = match way {
        "uniform" => Distribution::Uniform { from: numbers[0], to: numbers[1] },
        "normal" => Distribution::Normal { mean: numbers[0], deviation: numbers[1] },
        "triangular" => {
            Distribution::Triangular { from: numbers[0], peak: numbers[1], to: numbers[2] }
        }
        _ => Distribution::Lognormal { median: numbers[0], deviation: items[1].number()? },
    };
    distribution.check().map_err(|error| {
        error.placed(|complaint| {
            let found = format!("{} of {}", complaint.found, complaint.field);
            node.complain(Complaint { field: String::new(), found, ..complaint })
        })
    })?;
    wanted.drawn.push(distribution);
    Ok(Way::Drawn(wanted.drawn.len() - 1, unit))
}

/// A number and its unit, which may be none.
fn number(node: &Node) -> Result<(f64, String)> {
    let Ok(text) = node.string() else { return Ok((node.number()?, String::new())) };
    let plain = typed::plain(&text);
    let (number, unit) = typed::split(&plain);
    let value = typed::number(number).or_else(|| typed::mixed(number));
    match value.filter(|value| value.is_finite()) {
        Some(value) => Ok((value, unit.to_owned())),
        None => Err(node.error(node.shown(), "a number, or a number and its unit")),
    }
}

fn correlations(node: &Node, varied: &[Varied]) -> Result<Vec<(usize, usize, f64)>> {
    let drawn = |node: &Node| {
        let path = node.string()?;
        let found = varied.iter().find(|varied| varied.path == path);
        match found.map(|varied| &varied.way) {
            Some(Way::Drawn(k, _)) => Ok(*k),
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
