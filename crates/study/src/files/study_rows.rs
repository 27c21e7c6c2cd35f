//! Which bat and which hit is row k of a study, and what are its results?
//!
//! [`Rows::answers`] for a row depends only on the study, its bats, its ball and k. If there are several bats, each has
//! every row of the design, one bat after the other.

use std::ops::Range;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::answers::on_the_bat;
use crate::comparison::contender::Figure;
use crate::engine::{Ball, Bat, Error, Result, Setup, marks, scene_file, shortest};
use crate::files::study_file::StudyFile;
use crate::files::study_vary::VariedFile;
use crate::many::design::{DesignRow, MOST_ROWS};
use crate::many::rows::{BatAnswers, BatTrial, Questions};
use sweetspot::files::ball_file::written;

/// Combinations of lists, and rows, that are tried.
const TRIED: u64 = 32;

/// A bat as a file has it.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct BatText {
    /// Its name in tables.
    pub name: String,
    /// The text of its file, which names no other file; or the reason why it is not a bat.
    pub text: std::result::Result<String, String>,
}

/// A study with the documents that it varies.
pub struct Rows {
    /// The study.
    pub study: StudyFile,
    pub(super) bats: Vec<Varying>,
    ball: Base<Ball>,
    setup: Base<Setup>,
}

/// A bat that is varied.
pub(super) struct Varying {
    /// Its name in tables.
    pub name: String,
    /// Its document, or why it is not a bat.
    pub document: std::result::Result<Value, String>,
    /// A row in which it is a valid bat, as a model for the others, and that bat; `None` if there is none.
    pub model: Option<(DesignRow, Bat)>,
}

/// The base of a row's own document: a document, or the finished value if no row changes it.
enum Base<T> {
    Varied(Value),
    Same(T),
}

impl Rows {
    /// Checks that the inputs of a bat and a ball can be varied.
    ///
    /// # Errors
    ///
    /// [`Error::Input`] if no row that was tried gives a bat with an answer, as when a path leads nowhere;
    /// [`Error::Value`] for no bat at all and for more rows than [`MOST_ROWS`].
    pub fn new(study: StudyFile, bats: Vec<BatText>, ball: Ball) -> Result<Self> {
        let varying = |BatText { name, text }: BatText| {
            let document = text.and_then(|text| {
                let text = text.trim_start_matches('\u{feff}');
                serde_json::from_str(text).map_err(|error| error.to_string())
            });
            Varying { name, document, model: None }
        };
        let bats = bats.into_iter().map(varying).collect();
        let varied_ball = study.varies(VariedFile::Ball);
        let varied_scene = study.varies(VariedFile::Scene);
        let setup = match varied_scene || varied_ball {
            true => Base::Varied(Value::Object(study.scene.clone())),
            false => Base::Same(scene_file::of(&study.scene, ball.clone())?),
        };
        let ball = if varied_ball { Base::Varied(written(&ball)) } else { Base::Same(ball) };
        let mut rows = Self { study, bats, ball, setup };
        if rows.bats.len() as u64 > MOST_ROWS / rows.study.design.rows() {
            let found =
                format!("{} bats, each with {} rows", rows.bats.len(), rows.study.design.rows());
            return Err(Error::value("points", found, format!("{MOST_ROWS} rows at most")));
        }
        let (mut wrong, mut right) = (None, false);
        for k in 0..rows.bats.len() {
            if rows.bats[k].document.is_ok() {
                // One bat with an answer is enough.
                let (model, why) = rows.model(&rows.bats[k], right);
                right |= why.is_none();
                (rows.bats[k].model, wrong) = (model, wrong.or(why));
            }
        }
        if right {
            return Ok(rows);
        }
        let unread =
            |bat: &Varying| Some(Error::value("bat", bat.document.as_ref().err()?, "a bat file"));
        let none = || Error::value("bat", "none", "one bat at least");
        let wrong = wrong.map(|error| rows.study.comes_to_nothing(error));
        Err(wrong.or_else(|| rows.bats.iter().find_map(unread)).unwrap_or_else(none))
    }

    /// A row in which a bat has an answer, and that bat. If no row that was tried has one, a row that is at least a
    /// bat, and the first error.
    fn model(
        &self,
        varying: &Varying,
        without_asking: bool,
    ) -> (Option<(DesignRow, Bat)>, Option<Error>) {
        let (mut model, mut wrong) = (None, None);
        for row in self.study.design.examples(TRIED) {
            let bat = self.bat(varying, &row);
            let asked =
                |bat: &Bat| if without_asking { Ok(()) } else { self.can_be_asked(&row, bat) };
            match bat.map(|bat| (asked(&bat), bat)) {
                Ok((Ok(()), bat)) => return (Some((row, bat)), None),
                Ok((Err(error), bat)) => {
                    (model, wrong) = (model.or(Some((row, bat))), wrong.or(Some(error)));
                }
                Err(error) => wrong = wrong.or(Some(error)),
            }
        }
        (model, wrong)
    }

    /// An error if none of the outputs is possible for a bat in a row.
    fn can_be_asked(&self, row: &DesignRow, bat: &Bat) -> Result<()> {
        let answers = &self.study.asked.answers;
        match answers.iter().any(|answer| answer.of_a_hit()) {
            true => self.trial(row, bat).map(|_| ())?,
            // A path that leads nowhere is an error even if nothing is hit.
            false => self.setup(row).map(|_| ())?,
        }
        on_the_bat(answers, bat)
    }

    /// Number of rows.
    pub fn count(&self) -> u64 {
        self.bats.len() as u64 * self.study.design.rows()
    }

    /// Whether there are several bats.
    pub fn several(&self) -> bool {
        self.bats.len() > 1
    }

    /// Whether walls of hollow barrels are solved in at least one of the rows that are tried of each bat.
    pub fn solves_walls(&self) -> bool {
        let solved = |bat: &Varying, row: &DesignRow| {
            let setup = self.setup(row).ok()?;
            Some(setup.may_solve_wall(&self.bat(bat, row).ok()?))
        };
        let hit = self.study.asked.answers.iter().any(|answer| answer.of_a_hit());
        let mut bats = self.bats.iter().filter(|bat| hit && bat.document.is_ok());
        bats.any(|bat| {
            let rows = self.study.design.examples(TRIED);
            rows.into_iter().any(|row| solved(bat, &row) == Some(true))
        })
    }

    /// The results of those rows, in the order of the outputs, or the reason why there are none. A row's results do not
    /// depend on which other rows are requested.
    pub fn answers(&self, rows: Range<u64>) -> Vec<Result<BatAnswers>> {
        let each = self.study.design.rows();
        let mut found = vec![];
        let mut from = rows.start;
        while from < rows.end {
            let to = rows.end.min((from / each + 1) * each);
            found.extend(self.answers_of_one_bat(from..to));
            from = to;
        }
        found
    }

    fn answers_of_one_bat(&self, rows: Range<u64>) -> Vec<Result<BatAnswers>> {
        let of: Vec<(&Varying, DesignRow)> = rows.map(|k| self.row(k)).collect();
        let Some((bat, _)) = of.first() else { return vec![] };
        self.answers_of_rows(bat, &of.iter().map(|(_, row)| row).collect::<Vec<_>>())
    }

    pub(super) fn answers_of_rows(
        &self,
        varying: &Varying,
        rows: &[&DesignRow],
    ) -> Vec<Result<BatAnswers>> {
        let asked = &self.study.asked;
        let trial = |k: usize, bat: &Bat| self.trial(rows[k], bat);
        let bats = rows.iter().map(|row| self.bat(varying, row));
        let Some((_, model)) = &varying.model else {
            // Each bat is its own model.
            let alone = |(k, bat): (usize, Result<Bat>)| match bat {
                Ok(bat) => {
                    Questions::of_each(&bat.clone(), vec![(asked, Ok(bat))], |_, b| trial(k, b))
                }
                Err(error) => vec![Err(error)],
            };
            return bats.enumerate().flat_map(alone).collect();
        };
        Questions::of_each(model, bats.map(|bat| (asked, bat)).collect(), trial)
    }

    fn row(&self, k: u64) -> (&Varying, DesignRow) {
        let each = self.study.design.rows();
        (&self.bats[(k / each) as usize], self.study.design.row(k % each))
    }

    /// The names of the columns of a table of rows, each with its unit.
    pub fn columns(&self) -> Vec<[String; 2]> {
        let column = |name: String, unit: &str| [name, unit.to_owned()];
        let inputs = self.study.varied.iter().map(|v| column(v.path.clone(), v.unit()));
        let answers = self.study.outputs.iter().zip(&self.study.asked.answers);
        let answers = answers.flat_map(|(name, answer)| {
            let error = format!("{name}_error");
            [column(name.clone(), answer.unit()), column(error, answer.unit())]
        });
        let first = ["row", "bat"].into_iter().take(1 + usize::from(self.several()));
        let first = first.map(|name| column(name.to_owned(), ""));
        let last = ["met", "error"].map(|name| column(name.to_owned(), ""));
        first.chain(inputs).chain(answers).chain(last).collect()
    }

    /// Columns that are numbers in every row, or truth values (`met`).
    pub fn numbers(&self) -> Vec<usize> {
        let before = 1 + usize::from(self.several());
        let varied = &self.study.varied;
        let inputs = varied.iter().enumerate().filter(|(_, varied)| varied.is_number());
        let inputs = inputs.map(|(k, _)| before + k);
        let answers = before + varied.len();
        let last = answers + 2 * self.study.asked.answers.len();
        std::iter::once(0).chain(inputs).chain(answers..=last).collect()
    }

    /// The cells of those rows as text: number, name of the bat if there are several, inputs, results with their
    /// errors, whether they are as accurate as asked, and the reason if there are none.
    pub fn cells(&self, rows: Range<u64>) -> Vec<Vec<String>> {
        rows.clone().zip(self.answers(rows)).map(|(k, found)| self.cells_of(k, found)).collect()
    }

    /// The first cells of a row: its number, its bat, its inputs.
    fn inputs_of(&self, k: u64) -> Vec<String> {
        let (bat, row) = self.row(k);
        let mut cells = vec![k.to_string()];
        cells.extend(self.several().then(|| marks::cell(&bat.name)));
        cells.extend(self.study.varied.iter().map(|varied| varied.cell(&row)));
        cells
    }

    /// The first impossible cell of a row that was read back, and the expected text.
    pub fn wrong_cell(&self, k: u64, cells: &csv::StringRecord) -> Option<(usize, String)> {
        let inputs = self.inputs_of(k);
        if let Some(wrong) = (0..inputs.len()).find(|cell| cells[*cell] != *inputs[*cell]) {
            return Some((wrong, format!("\"{}\"", inputs[wrong])));
        }
        let met = inputs.len() + 2 * self.study.asked.answers.len();
        let explained = !cells[met + 1].is_empty();
        for cell in inputs.len()..met {
            let text = &cells[cell];
            let is_number = text.parse().is_ok_and(|x: f64| x.is_finite() && shortest(x) == text);
            // An unknown error is left out beside its answer.
            let is_error = (cell - inputs.len()) % 2 == 1;
            if !(is_number || text.is_empty() && (explained || is_error)) {
                return Some((cell, "a finite number, or none and why in the row".to_owned()));
            }
        }
        let right = cells[met] == *"true" || (cells[met] == *"false" && explained);
        (!right).then(|| (met, "true, or false and why in the row".to_owned()))
    }

    fn cells_of(&self, k: u64, found: Result<BatAnswers>) -> Vec<String> {
        let (bat, _) = self.row(k);
        let answers = self.study.asked.answers.len();
        let mut cells = self.inputs_of(k);
        let (met, why) = match found {
            Ok(found) => {
                let of =
                    |value: f64| if value.is_finite() { shortest(value) } else { String::new() };
                cells.extend(found.figures.iter().flat_map(|figure| {
                    let both = figure.map(|figure| [figure.value, figure.error].map(of));
                    both.unwrap_or_default()
                }));
                let known = |figure: &Option<Figure>| figure.is_some_and(|of| of.value.is_finite());
                let missing = !found.figures.iter().all(known);
                let why = match (found.off, found.met, missing) {
                    (Some(off), ..) => reason(&off),
                    (None, _, true) => "the bat has no such answer".to_owned(),
                    (None, false, _) => "less accurate than asked".to_owned(),
                    (None, true, false) => String::new(),
                };
                (found.met && !missing, why)
            }
            Err(error) => {
                cells.extend(vec![String::new(); 2 * answers]);
                (false, bat.document.as_ref().err().cloned().unwrap_or_else(|| reason(&error)))
            }
        };
        cells.extend([met.to_string(), marks::cell(&why)]);
        cells
    }

    /// A document with its inputs of a row.
    fn document(&self, subject: VariedFile, base: &Value, row: &DesignRow) -> Result<Value> {
        let mut document = base.clone();
        for varied in self.study.varied.iter().filter(|varied| varied.subject == subject) {
            varied.put(&mut document, row)?;
        }
        Ok(document)
    }

    pub(super) fn bat(&self, bat: &Varying, row: &DesignRow) -> Result<Bat> {
        let document = bat.document.as_ref();
        let document = document.map_err(|why| Error::value("bat", why, "a bat file"))?;
        let text = self.document(VariedFile::Bat, document, row)?.to_string();
        Bat::from_text(&bat.name, &text, Path::new(""))
    }

    fn ball(&self, row: &DesignRow) -> Result<Ball> {
        match &self.ball {
            Base::Same(ball) => Ok(ball.clone()),
            Base::Varied(base) => {
                Ball::from_text("ball", &self.document(VariedFile::Ball, base, row)?.to_string())
            }
        }
    }

    pub(super) fn setup(&self, row: &DesignRow) -> Result<Setup> {
        match &self.setup {
            Base::Same(setup) => Ok(setup.clone()),
            Base::Varied(base) => {
                let members = self.document(VariedFile::Scene, base, row)?;
                let none = Map::new();
                scene_file::of(members.as_object().unwrap_or(&none), self.ball(row)?)
            }
        }
    }

    fn trial(&self, row: &DesignRow, bat: &Bat) -> Result<BatTrial> {
        let setup = self.setup(row)?;
        let (model, tolerance) = (setup.model()?, Some(self.study.asked.tolerance));
        Ok(BatTrial { scene: setup.scene(bat, tolerance)?.0, model })
    }
}

/// The reason why there is no answer, without the position in a row's text, which the program made.
pub fn reason(error: &Error) -> String {
    match error {
        Error::Value(complaint) | Error::Input { complaint, .. } => {
            complaint.clone().naming(str::to_owned).to_string()
        }
        Error::Several { shown, .. } => shown.first().map(reason).unwrap_or_default(),
        other => other.to_string(),
    }
}
