//! Where do the rows of a study go, and which of them are there?
//!
//! A folder holds a manifest and parts of so many rows. Both are written whole, and a part depends on the study
//! and its number alone: so whatever is there is right, and what is missing can be made at any time.

use std::env::consts::{ARCH, OS};
use std::io::Read;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::base::error::{Complaint, Error, Result};
use crate::base::file;
use crate::files::schema;
use crate::files::schema::document::{Format, Generator};
use crate::files::schema::study::{ColumnNamed, FileRead, StudyManifest};
use crate::files::study_rows::Rows;
use crate::show::csv::{Cell, Csv};
use crate::show::exchange::npz;
use crate::show::many::source::Study;
use crate::study::many::hash::of_text;
use crate::study::many::rows::in_groups;

/// Rows of a part.
pub const ROWS: u64 = 4096;
const MANIFEST: &str = "manifest.json";
/// The C library, whose elementary functions another may round in another way.
const LIBRARY: &str = match () {
    () if cfg!(target_env = "gnu") => "gnu",
    () if cfg!(target_env = "musl") => "musl",
    () if cfg!(target_env = "msvc") => "msvc",
    () => "own",
};

/// Part k of a study, as a CSV file; `tell` is told how many rows of all are done.
pub fn part(study: &Study, k: u64, tell: &(impl Fn(u64) + Sync)) -> String {
    let rows = &study.rows;
    let all = rows.count();
    let [from, to] = [k.saturating_mul(ROWS).min(all), (k + 1).saturating_mul(ROWS).min(all)];
    let mut table = Csv::new(rows.columns().into_iter().map(|[name, _]| name));
    for cells in in_groups(from..to, |some| rows.cells(some), tell) {
        table.row(cells.into_iter().map(Cell::written));
    }
    table.text()
}

/// Reads part k of a study, which is at `path`, and gives `each` its rows.
///
/// # Errors
///
/// [`Error::Value`] for a part that is not as the study makes it.
pub fn read(
    rows: &Rows,
    k: u64,
    (path, part): (&Path, impl Read),
    mut each: impl FnMut(&csv::StringRecord),
) -> Result<()> {
    let damaged = |found: String, expected: String| {
        let complaint = Complaint::new(path.display().to_string(), found, expected);
        Error::Value(complaint.hinted("without this file the study makes it anew"))
    };
    let table = |error: csv::Error| damaged(error.to_string(), "a table".to_owned());
    let mut reader = csv::Reader::from_reader(part);
    let columns = rows.columns();
    let names: Vec<&str> = columns.iter().map(|[name, _]| &name[..]).collect();
    if reader.headers().map_err(table)? != names {
        return Err(damaged("other columns".to_owned(), names.join(", ")));
    }
    let [mut row, end] = [k, k + 1].map(|k| k.saturating_mul(ROWS).min(rows.count()));
    for cells in reader.records() {
        let cells = cells.map_err(table)?;
        if row == end || cells[0] != *row.to_string() {
            let expected = if row == end { "its end".to_owned() } else { format!("row {row}") };
            return Err(damaged(format!("row \"{}\"", &cells[0]), expected));
        }
        each(&cells);
        row += 1;
    }
    match row == end {
        true => Ok(()),
        false => Err(damaged(format!("no row {row}"), format!("rows to {}", end - 1))),
    }
}

/// The columns of part k that are numbers in every row.
fn columns(rows: &Rows, k: u64, part: (&Path, &str)) -> Result<Vec<(String, Vec<f64>)>> {
    let names = rows.columns();
    let named = |k: &usize| (names[*k][0].clone(), vec![]);
    let numbers = rows.numbers();
    let mut columns: Vec<(String, Vec<f64>)> = numbers.iter().map(named).collect();
    read(rows, k, (part.0, part.1.as_bytes()), |row| {
        for ((_, values), k) in columns.iter_mut().zip(&numbers) {
            values.push(number(&row[*k]));
        }
    })?;
    Ok(columns)
}

/// A cell that is a number; whether something is so is 1 or 0, what is not there is NaN.
pub fn number(cell: &str) -> f64 {
    match cell {
        "true" => 1.0,
        "false" => 0.0,
        cell => cell.parse().unwrap_or(f64::NAN),
    }
}

/// The folder of a study.
pub struct StudyFolder<'a> {
    path: &'a Path,
    study: &'a Study,
}

impl<'a> StudyFolder<'a> {
    /// The folder, made if it is not there, with the manifest of this study.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a folder of another study or with parts of an unknown one; [`Error::Write`].
    pub fn open(path: &'a Path, study: &'a Study) -> Result<Self> {
        let this = Self { path, study };
        let manifest = path.join(MANIFEST);
        let wanted = schema::text(&this.manifest());
        if manifest.exists() {
            let found = file::read_plain(&manifest)?;
            this.same(&String::from_utf8_lossy(&found), &wanted)?;
            file::remove_lost(path);
            return Ok(this);
        }
        let entries = std::fs::read_dir(path).into_iter().flatten().flatten();
        let is_part = |name: &str| {
            name.starts_with("part-") && (name.ends_with(".csv") || name.ends_with(".parquet"))
        };
        if entries.into_iter().any(|entry| entry.file_name().to_str().is_some_and(is_part)) {
            let expected = "another folder, or its manifest.json beside the parts";
            let found = "parts of a study that is not known";
            return Err(Error::value(path.display().to_string(), found, expected));
        }
        let failed = |source| Error::Write { path: path.to_owned(), source };
        std::fs::create_dir_all(path).map_err(failed)?;
        file::remove_lost(path);
        file::write(&manifest, wanted.as_bytes())?;
        Ok(this)
    }

    /// Number of parts of a study.
    pub fn parts_of(study: &Study) -> u64 {
        study.rows.count().div_ceil(ROWS)
    }

    /// Number of parts.
    pub fn parts(&self) -> u64 {
        Self::parts_of(self.study)
    }

    /// Path of a part.
    pub fn part(&self, k: u64) -> PathBuf {
        self.path.join(format!("part-{k:06}.csv"))
    }

    /// How many rows of all are there.
    pub fn made(&self) -> u64 {
        let there = (0..self.parts()).filter(|k| self.part(*k).exists()).count() as u64;
        (there * ROWS).min(self.study.rows.count())
    }

    /// Makes a part, if it is not there, on request with its numbers as a NumPy archive beside it; `tell` is told
    /// how many rows of all are done.
    ///
    /// # Errors
    ///
    /// [`Error::Write`]; [`read`] of a part that is there and gets its archive.
    pub fn make(&self, k: u64, npz: bool, tell: &(impl Fn(u64) + Sync)) -> Result<()> {
        let path = self.part(k);
        let archive = path.with_extension("npz");
        // One that is there is of the part that is lost.
        let npz = npz || archive.exists();
        let made = match path.exists() {
            true if !npz || archive.exists() => return Ok(()),
            true => String::from_utf8_lossy(&file::read_plain(&path)?).into_owned(),
            false => part(self.study, k, tell),
        };
        if npz {
            let failed = |source| Error::Write { path: archive.clone(), source };
            let columns = columns(&self.study.rows, k, (&path, &made))?;
            let bytes = npz::columns(&columns).map_err(failed)?;
            file::write(&archive, &bytes)?;
        }
        if path.exists() { Ok(()) } else { file::write(&path, made.as_bytes()) }
    }

    fn manifest(&self) -> StudyManifest {
        let hash = |text: &str| format!("{:016x}", of_text(text));
        let files = self.study.sources.iter();
        let files = files.map(|file| FileRead { name: file.name.clone(), hash: hash(&file.text) });
        let columns = self.study.rows.columns().into_iter();
        let columns = columns.map(|[name, unit]| ColumnNamed { name, unit });
        StudyManifest {
            format: Format::new(),
            generator: Generator::this(),
            target: format!("{ARCH}-{OS}-{LIBRARY}"),
            files: files.collect(),
            columns: columns.collect(),
            rows: self.study.rows.count(),
            rows_per_part: ROWS,
            parts: self.parts(),
        }
    }

    /// An error that says what has changed since a manifest was written.
    fn same(&self, found: &str, wanted: &str) -> Result<()> {
        let read = |text: &str| serde_json::from_str::<Value>(text).unwrap_or_default();
        let (mut found, wanted) = (read(found), read(wanted));
        // Under any name it is the same study.
        let own = "/files/0/name";
        if let Some((there, here)) = found.pointer_mut(own).zip(wanted.pointer(own)) {
            there.clone_from(here);
        }
        if found == wanted {
            return Ok(());
        }
        let mut changed = vec![];
        for (key, value) in wanted.as_object().into_iter().flatten() {
            if found[key] == *value {
                continue;
            }
            match key.as_str() {
                "files" => {
                    let files = |of: &Value| of.as_array().cloned().unwrap_or_default();
                    let (there, now) = (files(&found[key]), files(value));
                    let other = now.iter().filter(|file| !there.contains(file));
                    let gone = there.iter().filter(|file| !now.contains(file));
                    for file in other.chain(gone) {
                        let name = file["name"].as_str().unwrap_or_default().to_owned();
                        if !changed.contains(&name) {
                            changed.push(name);
                        }
                    }
                }
                "generator" => changed.push("the program's version".to_owned()),
                "target" => changed.push("the machine".to_owned()),
                other => changed.push(format!("the {}", other.replace('_', " "))),
            }
        }
        let what = match changed.is_empty() {
            true => "a manifest that is not this study's".to_owned(),
            false => format!("the parts of a study that differs in {}", changed.join(", ")),
        };
        let complaint = Complaint::new(
            self.path.display().to_string(),
            what,
            "the parts of this study, or a new folder",
        );
        Err(Error::Value(complaint.hinted("nothing there was changed")))
    }
}
