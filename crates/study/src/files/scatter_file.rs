//! What differs between bats of one model and swings of one batter, as somebody wrote it down?
//!
//! [`from_text`] reads a `sweetspot-scatter/1` file and tells all its mistakes at once. A covariance in it is the
//! result of a calibration, `sweetspot-calibrate/1`.

use std::path::{Path, PathBuf};

use crate::files::amounts::share;
use crate::many::answers::Answer;
use crate::scatter::rows::{AT_IMPACT, Output};
use crate::scatter::spreads::{Difference, Differences, Differs};
use crate::scatter::turning::Turning;
use sweetspot::base::error::{Complaint, Error, Result};
use sweetspot::base::mistakes::{self, Mistakes};
use sweetspot::base::units::Quantity;
use sweetspot::bat::body::Bat;
use sweetspot::bat::material::Scatter;
use sweetspot::collision::ball::Ball;
use sweetspot::collision::setup::Setup;
use sweetspot::files::balls;
use sweetspot::files::document::Document;
use sweetspot::files::folder::{Folder, Outside};
use sweetspot::files::json_node::{Node, Object};
use sweetspot::files::scene_file;

/// Members that are no difference.
const OTHERS: [&str; 9] =
    ["format", "$schema", "name", "ball", "scene", "outputs", "tol", "correlation", "covariance"];
/// Members that are, and how each varies.
const DIFFERENCES: [(&str, &str); 9] = [
    ("density", "lognormal"),
    ("youngs_modulus", "lognormal"),
    ("shear_over_young", "lognormal"),
    ("turning", "normal"),
    ("moisture", "normal"),
    ("swing_speed", "normal"),
    ("pitch", "normal"),
    ("cor", "normal"),
    ("impact", "normal"),
];
/// Outputs of a file that names none.
const USUAL: [&str; 6] = [
    "f1_hz",
    "mass_kg",
    "inertia_pivot_kg_m2",
    "exit_speed_max.value",
    "exit_speed_max.x_m",
    "node_mode_1_m",
];
/// Accuracy where none is asked for.
const TOLERANCE: f64 = 1e-4;
/// How far along a bat a lathe's error reaches where nobody says so (m): 12 in.
const ALONG: f64 = 0.3048;

/// What a file says.
#[derive(Debug, Clone)]
pub struct ScatterFile {
    /// What differs.
    pub differences: Differences,
    /// How the bat is hit in the middle.
    pub setup: Setup,
    /// Where the ball is hit in the middle (m), if that is said.
    pub impact: Option<f64>,
    /// What is asked.
    pub outputs: Vec<Output>,
    /// Accuracy.
    pub tolerance: f64,
}

/// What differs where nobody says it: the wood, from piece to piece of one species, stiffness and density each by
/// itself ([`sweetspot::bat::material::Material::scatter`]), the usual outputs asked. None for a bat that is not of wood.
pub fn of_wood(bat: &Bat) -> Option<ScatterFile> {
    let Scatter { youngs_modulus, density } = bat.material().scatter()?;
    let one = |what, deviation| Difference { what, deviation };
    let (density, modulus) =
        (one(Differs::Density, density), one(Differs::YoungsModulus, youngs_modulus));
    Some(ScatterFile {
        differences: Differences { all: vec![density, modulus], correlations: vec![] },
        setup: Setup::default(),
        impact: None,
        outputs: usual().ok()?,
        tolerance: TOLERANCE,
    })
}

/// Reads a scatter file.
///
/// # Errors
///
/// [`Error::Read`], or [`Error::Input`] with line and column, or several of them.
pub fn from_file(path: impl AsRef<Path>) -> Result<ScatterFile> {
    let path = path.as_ref();
    let folder = path.parent().unwrap_or(Path::new(""));
    from_document(&Document::read(path)?, &Folder::closed(folder))
}

/// Reads a scatter file that a person has named, and the files outside of its folder that it names.
///
/// # Errors
///
/// As [`from_file`].
pub fn named_by_a_person(path: &Path) -> Result<(ScatterFile, Vec<PathBuf>)> {
    let outside = Outside::default();
    let file = from_document(&Document::read(path)?, &Folder::of(path, &outside))?;
    Ok((file, outside.paths()))
}

/// Reads it from text; `file` is what messages call it, ball and covariance are sought in `folder`.
///
/// ```
/// use sweetspot_study::files::scatter_file::from_text;
///
/// # fn main() -> sweetspot::Result<()> {
/// let text = r#"{ "format": "sweetspot-scatter/1", "density": { "lognormal": "4 %" } }"#;
/// assert_eq!(from_text("scatter.json", text, "".as_ref())?.differences.all.len(), 1);
/// # Ok(())
/// # }
/// ```
///
/// # Errors
///
/// As [`from_file`].
pub fn from_text(file: &str, text: &str, folder: &Path) -> Result<ScatterFile> {
    from_document(&Document::new(file.to_owned(), text), &Folder::closed(folder))
}

fn from_document(document: &Document, folder: &Folder) -> Result<ScatterFile> {
    let root = Node::root(document)?.members()?;
    root.check_format("sweetspot-scatter/1")?;
    let mut mistakes = Mistakes::default();
    let keys: Vec<&str> = OTHERS.into_iter().chain(DIFFERENCES.map(|(key, _)| key)).collect();
    let root = root.only(&keys, &mut mistakes);
    let format = "\"format\": \"sweetspot-scatter/1\"";
    mistakes.note(root.require("format", format).map(|_| ()));
    mistakes.note(root.string("$schema"));
    mistakes.note(root.string("name"));
    let ball =
        mistakes.some(root.get("ball").map_or(Ok(Ball::baseball()), |node| ball(node, folder)));
    let ball = ball.unwrap_or_else(Ball::baseball);
    let setup = root.get("scene").map(|node| scene_file::read(node, ball.clone()));
    let setup = mistakes.some(setup.unwrap_or(Ok(Setup { ball, ..Setup::default() })));
    let all = mistakes.note(differences(&root));
    let mut differences = Differences { all, correlations: vec![] };
    if let Some(node) = root.get("covariance") {
        mistakes.note(covariance(node, &root, folder, &mut differences));
    }
    if let Some(node) = root.get("correlation") {
        mistakes.note(correlations(node, &mut differences));
    }
    let at = root.get("impact").map(|node| impact(node)).transpose();
    let impact = mistakes.note(at).flatten();
    let outputs = mistakes.note(outputs(&root, &differences));
    let tolerance = root.get("tol").map_or(Ok(TOLERANCE), share);
    let tolerance = mistakes.note(tolerance);
    mistakes.end(())?;
    if differences.all.is_empty() {
        let expected = "one at least, such as \"density\": { \"lognormal\": \"4 %\" }";
        return Err(root.node.error("nothing that differs", expected));
    }
    // Correlations that no numbers can have are told here, where their place is known.
    if let Err(error) = differences.designs(1.0, 64, 0) {
        let node = root.get("correlation").or(root.get("covariance")).unwrap_or(&root.node);
        let placed = |c: Complaint| node.complain(Complaint { field: String::new(), ..c });
        return Err(error.placed(placed));
    }
    let setup = setup.unwrap_or_default();
    Ok(ScatterFile { differences, setup, impact, outputs, tolerance })
}

/// A built-in ball, or that of a file.
fn ball(node: &Node, folder: &Folder) -> Result<Ball> {
    balls::ball_in(&node.string()?, folder).map_err(|error| named_in_vain(node, error))
}

/// What is wrong with a file that a node names: said where it does.
fn named_in_vain(node: &Node, error: Error) -> Error {
    error.placed(|complaint| node.complain(Complaint { field: String::new(), ..complaint }))
}

/// Everything that differs, in the order of the file.
fn differences(root: &Object) -> Result<Vec<Difference>> {
    let known = |key: &String| DIFFERENCES.iter().find(|(name, _)| name == key);
    let here = root.keys().iter().filter_map(|(key, node)| Some((known(key)?, node)));
    mistakes::all(here.map(|((key, way), node)| difference(key, way, node)))
}

fn difference(key: &str, way: &'static str, node: &Node) -> Result<Difference> {
    let mut mistakes = Mistakes::default();
    let more = match key {
        "turning" => Some("along"),
        "impact" => Some("at"),
        _ => None,
    };
    let keys: Vec<&str> = std::iter::once(way).chain(more).collect();
    let object = node.object(&keys, &mut mistakes)?;
    let example = match key {
        "turning" => "\"0.1 mm\"",
        "impact" => "\"0.5 in\"",
        "cor" => "0.016",
        _ => "\"4 %\"",
    };
    let deviation =
        object.require(way, &format!("\"{way}\": a standard deviation, such as {example}"));
    let length = |node: &Node, most: f64, said: &str| {
        let value = node.quantity(Quantity::Length)?;
        if value > 0.0 && value <= most { Ok(value) } else { Err(node.error(node.shown(), said)) }
    };
    let deviation = deviation.and_then(|node| match key {
        "turning" => length(node, 2e-3, "a length above 0 and up to 2 mm"),
        "impact" => length(node, 0.2, "a length above 0 and up to 0.2 m"),
        "cor" => match share(node)? {
            cor if cor <= 0.1 => Ok(cor),
            _ => Err(node.error(node.shown(), "a standard deviation above 0 and up to 0.1")),
        },
        _ => share(node),
    });
    let along = object.get("along").map(|node| {
        let value = node.quantity(Quantity::Length)?;
        match (0.02..=2.0).contains(&value) {
            true => Ok(value),
            false => Err(node.error(node.shown(), "a length from 0.02 to 2 m")),
        }
    });
    let along = mistakes.note(along.transpose()).unwrap_or(ALONG);
    mistakes.and(deviation.map(|deviation| Difference {
        what: match key {
            "density" => Differs::Density,
            "youngs_modulus" => Differs::YoungsModulus,
            "shear_over_young" => Differs::ShearOverYoung,
            "turning" => Differs::Turned(Turning { deviation, along }),
            "moisture" => Differs::Moisture,
            "swing_speed" => Differs::SwingSpeed,
            "pitch" => Differs::Pitch,
            "cor" => Differs::Cor,
            _ => Differs::Impact,
        },
        deviation,
    }))
}

/// Where the ball is hit in the middle, if that is said.
fn impact(node: &Node) -> Result<Option<f64>> {
    let Ok(object) = node.members() else { return Ok(None) };
    object.get("at").map(|node| node.quantity(Quantity::Length)).transpose()
}

/// Triples of two that differ and their correlation.
fn correlations(node: &Node, differences: &mut Differences) -> Result<()> {
    let all = differences.all.clone();
    let names: Vec<&str> = all.iter().map(|one| one.what.name()).collect();
    let place = |node: &Node| {
        let name = node.string()?;
        let found = all.iter().position(|one| one.what.name() == name);
        match found.filter(|k| !matches!(all[*k].what, Differs::Turned(_))) {
            Some(k) => Ok(k),
            None => {
                let expected =
                    format!("something that differs in one number, one of {}", names.join(", "));
                let complaint = Complaint::new("", node.shown(), expected);
                Err(node.complain(complaint.or_nearest(&name, &names)))
            }
        }
    };
    let read = mistakes::all(node.items()?.iter().map(|item| {
        let [a, b, r] = &item.items()?[..] else {
            let expected = "two names and their correlation, such as \
                            [\"density\", \"youngs_modulus\", 0.6]";
            return Err(item.error(item.shown(), expected));
        };
        let (first, second, value) = (place(a)?, place(b)?, r.number()?);
        if first == second {
            return Err(b.error(b.shown(), "another one than the first"));
        }
        match value.abs() < 1.0 {
            true => Ok((first, second, value)),
            false => Err(r.error(r.shown(), "a number between -1 and 1")),
        }
    }))?;
    differences.correlations.extend(read);
    Ok(())
}

/// Density and moduli as a calibration left them: what it found goes before what the file says.
fn covariance(
    node: &Node,
    root: &Object,
    folder: &Folder,
    differences: &mut Differences,
) -> Result<()> {
    for key in ["density", "youngs_modulus", "shear_over_young"] {
        if let Some(other) = root.get(key) {
            let found = format!("\"{key}\" beside \"covariance\"");
            return Err(other.key().error(found, "one of them: the calibration says it"));
        }
    }
    let document =
        folder.json(&node.string()?, "calibrate").map_err(|error| named_in_vain(node, error))?;
    let file = Node::root(&document)?.members()?;
    file.check_format("sweetspot-calibrate/1")?;
    let listed = file.require("parameters", "\"parameters\" of a calibration")?.items()?;
    let rows = file.require("covariance", "\"covariance\" of a calibration")?;
    let wrong = || rows.error("a list of other size", "a row and a column for each parameter");
    let numbers = |row: &Node| row.items()?.iter().map(Node::number).collect::<Result<Vec<f64>>>();
    let matrix = rows.items()?.iter().map(numbers).collect::<Result<Vec<_>>>()?;
    if matrix.len() != listed.len() || matrix.iter().any(|row| row.len() != listed.len()) {
        return Err(wrong());
    }
    let mut found: Vec<(usize, Difference)> = vec![];
    for (k, item) in listed.iter().enumerate() {
        let object = item.members()?;
        let name = object.require("name", "\"name\" of the parameter")?;
        let what = match &*name.string()? {
            "youngs_modulus" => Differs::YoungsModulus,
            "shear_modulus" => Differs::ShearModulus,
            "density" => Differs::Density,
            "density_barrel" => Differs::BarrelDensity,
            "youngs_modulus_ratio" => Differs::ModulusRatio,
            _ => return Err(name.error(name.shown(), "a parameter of a calibration")),
        };
        // What was held does not differ.
        if matrix[k][k] > 1e-16 {
            found.push((k, Difference { what, deviation: matrix[k][k].sqrt() }));
        }
    }
    let correlation = |i: usize, j: usize| matrix[i][j] / (matrix[i][i] * matrix[j][j]).sqrt();
    let count = found.len();
    let pairs = (0..count).flat_map(|a| (0..a).map(move |b| (b, a)));
    let pairs: Vec<_> = pairs.map(|(a, b)| (a, b, correlation(found[a].0, found[b].0))).collect();
    let found = found.into_iter().map(|(_, difference)| difference);
    let later = std::mem::take(&mut differences.all);
    differences.all = found.chain(later).collect();
    differences.correlations = pairs;
    Ok(())
}

fn usual() -> Result<Vec<Output>> {
    USUAL.iter().map(|name| Answer::named(name).map(Output::Of)).collect()
}

/// What is asked; where a place that is hit differs, the speed there too if nothing is named.
fn outputs(root: &Object, differences: &Differences) -> Result<Vec<Output>> {
    let at_impact = differences.all.iter().any(|one| one.what == Differs::Impact);
    let Some(node) = root.get("outputs") else {
        let mut all = usual()?;
        all.extend(at_impact.then_some(Output::AtImpact));
        return Ok(all);
    };
    let items = node.items()?;
    if items.is_empty() {
        return Err(node.error("an empty list", "one name at least, such as \"f1_hz\""));
    }
    let mut seen: Vec<Output> = vec![];
    mistakes::all(items.iter().map(|item| {
        let name = item.string()?;
        let output = match name == AT_IMPACT {
            true => Output::AtImpact,
            false => Output::Of(Answer::named(&name).map_err(|error: Error| {
                error.placed(|complaint| {
                    item.complain(Complaint { field: String::new(), ..complaint })
                })
            })?),
        };
        if seen.contains(&output) {
            return Err(item.error(item.shown(), "every output once"));
        }
        seen.push(output);
        Ok(output)
    }))
}
