//! Which files is a study made from?

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use sweetspot::base::error::Complaint;
use sweetspot::base::file;
use sweetspot::collision::Ball;
use sweetspot::files::ball_file::written;
use sweetspot::files::balls::{ball_in, built_in};
use sweetspot::files::bat_file::without_table;
use sweetspot::files::built_in;
use sweetspot::files::document::Document;
use sweetspot::files::folder::{Folder, Outside, json as json_at};
use sweetspot::{Bat, Error, Result};
use sweetspot_study::files::study_file::{StudyFile, StudyForm};
use sweetspot_study::files::study_rows::{BatText, Rows, reason};
use sweetspot_study::files::study_vary::VariedFile;
use sweetspot_study::files::written::WrittenFile;

/// A file that a study was made from.
#[derive(Debug, Clone)]
pub struct Source {
    /// Its name, as the study has it.
    pub name: String,
    /// The text of the file.
    pub text: String,
}

/// A study, and every file that was read for it, the study first.
pub struct Study {
    /// Its rows.
    pub rows: Rows,
    /// The files.
    pub sources: Vec<Source>,
    parcel: Parcel,
}

/// A study as a text that needs no file, to be sent to another machine.
#[derive(Clone, Serialize, Deserialize)]
struct Parcel {
    study: String,
    bats: Vec<BatText>,
    /// Profiles in place of the tables that values name, in the order of the study.
    tables: Vec<Value>,
    /// The ball, if it comes from a file.
    ball: Option<String>,
}

impl Study {
    /// Reads a study with its bats and its ball: files in the folder of the study, or built-in ones.
    ///
    /// # Errors
    ///
    /// The mistakes in one of the files, or as [`Rows::new`].
    pub fn read(path: &Path) -> Result<Self> {
        let Document { file, text, .. } = Document::read(path)?;
        Self::of(&file, &text, path.parent().unwrap_or(Path::new("")))
    }

    /// Reads a study that a person has named, and the files outside of its folder that it names.
    ///
    /// # Errors
    ///
    /// As [`Self::read`].
    pub fn named_by_a_person(path: &Path) -> Result<(Self, Vec<PathBuf>)> {
        let Document { file, text, .. } = Document::read(path)?;
        let outside = Outside::default();
        let study = Self::in_folder(&file, &text, Folder::of(path, &outside))?;
        Ok((study, outside.paths()))
    }

    /// A study from its text. `name` is its name in messages, and its files are in `folder` or below.
    ///
    /// # Errors
    ///
    /// As [`Self::read`].
    pub fn of(name: &str, text: &str, folder: &Path) -> Result<Self> {
        Self::in_folder(name, text, Folder::closed(folder))
    }

    fn in_folder(name: &str, text: &str, folder: Folder) -> Result<Self> {
        let mut study = StudyForm::from_text(name, text, folder.path())?;
        let own = Path::new(name).file_name().map_or(name.into(), |own| own.to_string_lossy());
        let mut sources = vec![Source { name: own.into_owned(), text: text.to_owned() }];
        let bats = bats(folder, &study, &mut sources)
            .map_err(|error| study.names_in_vain(VariedFile::Bat, error))?;
        let tables = tables(folder, &mut study, &mut sources)?;
        let name = study.ball.as_deref().unwrap_or("baseball");
        let (ball, own_ball) = match built_in(name) {
            Some(ball) => (ball, None),
            None => {
                let ball = ball_in(name, &folder)
                    .map_err(|error| study.names_in_vain(VariedFile::Ball, error))?;
                let text = written(&ball).to_string();
                sources.push(Source { name: name.to_owned(), text: text.clone() });
                (ball, Some(text))
            }
        };
        let parcel = Parcel { study: text.to_owned(), bats: bats.clone(), tables, ball: own_ball };
        Ok(Self { rows: Rows::new(study, bats, ball)?, sources, parcel })
    }

    /// The study as one text that needs no file: [`Self::arrived`] reads it on another machine.
    pub fn alone(&self) -> String {
        json!(self.parcel).to_string()
    }

    /// A study that was sent to this machine.
    ///
    /// # Errors
    ///
    /// If the text is not one of [`Self::alone`] of this version.
    pub fn arrived(text: &str) -> Result<Self> {
        let parcel: Parcel = serde_json::from_str(text)
            .map_err(|error| Error::value("study", error, "one sent by this version"))?;
        let mut study = StudyForm::from_text("study", &parcel.study, Path::new(""))?;
        let mut tables = parcel.tables.iter().cloned();
        for varied in &mut study.varied {
            varied.replace_tables(|_| Ok(tables.next().unwrap_or_default()))?;
        }
        let ball = match &parcel.ball {
            Some(text) => Ball::from_text("ball", text)?,
            // A study that was sent names no file on this machine.
            None => built_in(study.ball.as_deref().unwrap_or("baseball"))
                .ok_or_else(|| Error::value("study", "no ball", "one sent by this version"))?,
        };
        let rows = Rows::new(study, parcel.bats.clone(), ball)?;
        Ok(Self { rows, sources: vec![], parcel })
    }
}

/// Profiles in place of the tables that values name, put into the study.
fn tables(folder: Folder, study: &mut StudyFile, sources: &mut Vec<Source>) -> Result<Vec<Value>> {
    let mut all = vec![];
    for varied in &mut study.varied {
        varied.replace_tables(|table| {
            let profile = without_table(table, &folder)?;
            let name = table["csv"].as_str().unwrap_or_default();
            let text =
                String::from_utf8_lossy(&file::read_plain(&folder.find(name)?)?).into_owned();
            sources.push(Source { name: name.to_owned(), text });
            all.push(profile.clone());
            Ok(profile)
        })?;
    }
    Ok(all)
}

/// The bats with those names: files from the folder of the study, all of a folder, or built-in ones. Where there are
/// several, one that is not a valid bat is kept with the reason.
fn bats(folder: Folder, study: &StudyFile, sources: &mut Vec<Source>) -> Result<Vec<BatText>> {
    let mut all: Vec<(String, PathBuf)> = vec![];
    for name in &study.bats {
        let path = folder.find(name)?;
        // A folder with the name of a built-in bat probably holds its results.
        let built_in = || built_in::named(Path::new(name)).is_ok_and(|found| found.is_some());
        match path.is_dir() && !built_in() {
            false => all.push((name.clone(), path)),
            true => all.extend(files_of(name, folder.below(&path))?),
        }
    }
    let mut seen = HashSet::new();
    for (name, path) in &all {
        if !seen.insert(std::fs::canonicalize(path).unwrap_or_else(|_| path.clone())) {
            return Err(Error::value("bat", format!("{name} a second time"), "every bat once"));
        }
        // A missing file is a mistyped name and not an impossible bat.
        if !path.is_file() {
            built_in::named(Path::new(name))?;
        }
    }
    let alone = all.len() == 1;
    let stem = |path: &Path| path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let stems: Vec<String> = all.iter().map(|(_, path)| stem(path)).collect();
    let mut found = vec![];
    for ((name, path), own) in all.iter().zip(&stems) {
        let called = match stems.iter().filter(|other| *other == own).count() {
            1 => own,
            _ => name,
        };
        let text = match bat((name, path), study, sources) {
            Ok(text) => Ok(text),
            Err(error @ (Error::Input { .. } | Error::Several { .. } | Error::Value(_)))
                if !alone =>
            {
                Err(reason(&error))
            }
            Err(error) => return Err(error),
        };
        found.push(BatText { name: called.clone(), text });
    }
    Ok(found)
}

/// The bat files of a folder, by rising name.
fn files_of(name: &str, folder: Folder) -> Result<Vec<(String, PathBuf)>> {
    let failed = |source| Error::Read { path: folder.path().to_owned(), source };
    let entries = std::fs::read_dir(folder.path()).map_err(failed)?;
    let mut files = vec![];
    for entry in entries {
        let own = entry.map_err(failed)?.file_name().to_string_lossy().into_owned();
        if own.ends_with(".json") && folder.path().join(&own).is_file() {
            let path = folder.find(&own)?;
            if !is_another_document(&path) {
                files.push((format!("{}/{own}", name.trim_end_matches('/')), path));
            }
        }
    }
    if files.is_empty() {
        let found = format!("the folder {} without a .json file of a bat", folder.path().display());
        return Err(Error::value("bat", found, "a folder of bat files"));
    }
    files.sort();
    Ok(files)
}

/// Whether a file declares itself another document of this program and no bat, such as the study itself or a manifest.
fn is_another_document(path: &Path) -> bool {
    let text = file::read_plain(path).unwrap_or_default();
    let document: Value = serde_json::from_slice(&text).unwrap_or_default();
    let format = document["format"].as_str().unwrap_or_default();
    format.starts_with("sweetspot-") && !format.starts_with("sweetspot-bat/")
}

/// The text of a bat that needs no other file: the columns of a table are put into the bat itself.
fn bat(
    (name, path): (&str, &Path),
    study: &StudyFile,
    sources: &mut Vec<Source>,
) -> Result<String> {
    let mut read = |name: &str, text: &str| {
        sources.push(Source { name: name.to_owned(), text: text.to_owned() });
    };
    if !path.is_file()
        && let Some((own, text)) = built_in::named(Path::new(name))?
    {
        read(own, text);
        return Ok(text.to_owned());
    }
    let Document { file, text, .. } = json_at(path, "bat")?;
    read(name, &text);
    // This file was not named by a user, so the files that it names must be in its folder.
    let folder = Folder::closed(path.parent().unwrap_or(Path::new("")));
    Bat::from_text_in(&file, &text, &folder)?;
    let mut document: Value = serde_json::from_str(&text).unwrap_or_default();
    let Some(table) = document["profile"]["csv"].as_str() else { return Ok(text) };
    if let Some(varied) = study.varied.iter().find(|varied| varied.path == "bat.profile.unit") {
        let found = format!("it for {file}, whose table may have its own units");
        return Err(varied.wrong(Complaint::new("", found, "columns, such as bat.profile.x")));
    }
    let bytes = file::read_plain(&folder.find(table)?)?;
    read(table, &String::from_utf8_lossy(&bytes));
    document["profile"] = without_table(&document["profile"], &folder)?;
    Ok(document.to_string())
}
