//! How is a study written: its bats, what varies, and its outputs? The `sweetspot-study/1` file.

use std::collections::BTreeMap;
use std::ops::Bound::Excluded;

use schemars::JsonSchema;
use serde_json::{Map, Value, json};

use crate::answers::Answer;
use crate::engine::{Ball, Complaint, Error, FilePosition, Node, Result, mistakes, scene_file};
use crate::files::amounts::Said;
use crate::files::asked;
use crate::files::form::{Form, later, number, text, whole};
use crate::files::study_vary::{VariationForm, Varied, VariedFile, varied};
use crate::files::written::{Members, written};
use crate::many::design::{Axis, Design, DesignTerms, PointSpread};
use crate::many::rows::Questions;

/// Default number of points.
const POINTS: u64 = 1000;

/// A study.
#[derive(Debug, Clone)]
pub struct StudyFile {
    /// Files of bats, folders of them, or names of built-in bats.
    pub bats: Vec<String>,
    /// File of the ball, or the name of a built-in one.
    pub ball: Option<String>,
    /// Members of the scene, as written.
    pub scene: Map<String, Value>,
    /// The inputs that vary.
    pub varied: Vec<Varied>,
    /// The rows.
    pub design: Design,
    /// The outputs for every bat.
    pub asked: Questions,
    /// The names of the answers, as written.
    pub outputs: Vec<String>,
    /// Members about random numbers in a study without any.
    pub idle: Vec<&'static str>,
    /// Position of the inputs that vary, or else of the bats.
    place: Box<FilePosition>,
    /// Positions of the names of its bats, and of its ball.
    naming: [Box<FilePosition>; 2],
}

impl StudyFile {
    /// Whether anything varies in such a document.
    pub fn varies(&self, subject: VariedFile) -> bool {
        self.varied.iter().any(|varied| varied.subject == subject)
    }

    /// An error in a bat or a ball that the study names, reported at the name.
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

    /// The error of a study in which every row that was tried fails, from the error of one row.
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

/// One bat or several.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum Bats {
    /// A file, a folder or a name.
    One(String),
    /// Several.
    Several(#[schemars(length(min = 1))] Vec<String>),
}

written! {
    /// Many bats: fixed ones or one that varies, their hits, and the outputs for each. Places count from the knob end.
    StudyForm("study", "Study file") {
        /// Name of the study.
        name = text();
        /// The bats: a bat file or a folder of them, from the study's folder, or the name of a built-in bat; one or a
        /// list.
        bat = Form::of::<Bats>(bats_named),
            needed "\"bat\": a bat file or the name of a built-in bat";
        /// The ball: a ball file, from the study's folder, or the name of a built-in ball. By default a baseball.
        ball = text();
        /// The hit: the options of sweetspot hit, such as swing_speed, by their names.
        scene = later::<BTreeMap<String, Said>>();
        /// The inputs that vary, by path: bat., ball. or scene. and the path in that document, such as
        /// bat.material.density. Lists are combined in every way; random numbers share one set of points. By default
        /// each bat as it is.
        vary = later::<BTreeMap<String, VariationForm>>().saying("minProperties", 1);
        /// Triples of two paths that are drawn and the correlation of their normal scores.
        correlations = later::<Vec<(String, String, f64)>>();
        /// How points are spread. Without it sobol.
        design = Form::of::<String>(|node| node.word(&PointSpread::ALL.map(|one| (one.name(), one))))
            .saying("enum", json!(PointSpread::ALL.map(PointSpread::name)));
        /// Points drawn for each combination of the lists. Without it 1000.
        points = whole().saying("minimum", 1);
        /// Another seed draws other points. By default 0.
        seed = whole();
        /// The outputs for every bat, by name.
        outputs = Form::of::<Vec<String>>(|node| asked::outputs(node, Answer::named))
            .saying("minItems", 1)
            .like(json!(["f1_hz", "exit_speed_max.value", "exit_speed_m_s@0.70"])),
            needed "\"outputs\": a list of names, such as \"f1_hz\"";
        /// Wanted accuracy of frequencies, relative, and of exit speeds, relative to the closing speed. Default 1e-4.
        tol = number()
            .within((Excluded(0.0), Excluded(1.0)), "a number between 0 and 1, such as 1e-4");
    }
    |of| -> StudyFile {
        let (outputs, answers) = outputs.into_iter().unzip();
        let scene = scene_of(of.at("scene"));
        let scene = of.mistakes.note(scene);
        let spread = design.unwrap_or(DesignTerms::default().spread);
        let (points, seed) = (points.unwrap_or(POINTS), seed.unwrap_or_default());
        let mut wanted = DesignTerms { points, seed, spread, ..DesignTerms::default() };
        let varied = of.at("vary").map_or(Ok(vec![]), |node| varied(node, &mut wanted));
        let varied = of.mistakes.note(varied);
        if let Some(node) = of.at("correlations") {
            let correlations = correlations_of(node, &varied);
            wanted.correlations = of.mistakes.note(correlations);
        }
        of.sound()?;
        let drawing = ["design", "points", "seed"].into_iter().filter(|key| of.at(key).is_some());
        let idle = if wanted.drawn.is_empty() { drawing.collect() } else { vec![] };
        let design = Design::new(wanted).map_err(|error| of_design(of, error))?;
        let asked = Questions { answers, tolerance: tol.unwrap_or(1e-4) };
        let place = of.at("vary").or(of.at("bat")).unwrap_or(of.node()).place();
        let naming = ["bat", "ball"].map(|key| of.at(key).unwrap_or(of.node()).place());
        Ok(StudyFile { bats: bat, ball, scene, varied, design, asked, outputs, idle, place, naming })
    }
}

/// An error of a design, reported at its place in the study.
fn of_design(of: &Members, error: Error) -> Error {
    error.placed(|complaint| {
        let key = match &*complaint.field {
            "correlation" => "correlations",
            "vary" => "vary",
            _ => "points",
        };
        let node = of.at(key).unwrap_or(of.node());
        node.complain(Complaint { field: String::new(), ..complaint })
    })
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

/// The members of the scene, each of which was read once as a check.
fn scene_of(node: Option<&Node>) -> Result<Map<String, Value>> {
    let Some(node) = node else { return Ok(Map::new()) };
    scene_file::read(node, Ball::baseball())?;
    let members = node.members()?;
    let said = members.keys().iter().filter(|(key, _)| key != "comment");
    Ok(said.map(|(key, node)| (key.clone(), node.value())).collect())
}

fn correlations_of(node: &Node, varied: &[Varied]) -> Result<Vec<(usize, usize, f64)>> {
    let expected = [
        "two paths and their correlation, such as \
         [\"bat.material.density\", \"bat.material.youngs_modulus\", 0.6]",
        "another path than the first",
    ];
    let all = asked::correlations(node, expected, |node| {
        let path = node.string()?;
        match varied.iter().find(|varied| varied.path == path).map(Varied::axis) {
            Some(Axis::Drawn(k)) => Ok(k),
            _ => Err(node.error(node.shown(), "the path of a number that is drawn")),
        }
    })?;
    let pair = |(a, b, _): &(usize, usize, f64)| [*a.min(b), *a.max(b)];
    for k in 0..all.len() {
        if all[..k].iter().any(|other| pair(other) == pair(&all[k])) {
            let item = node.item(k);
            return Err(item.error(item.shown(), "one correlation of each two paths"));
        }
    }
    Ok(all)
}
