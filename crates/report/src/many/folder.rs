//! Where are the rows of a study stored, and which of them exist?
//!
//! A folder holds a manifest and parts with equally many rows. Both are written in one piece, and a part depends only
//! on the study and its number. An existing part is therefore correct, and a missing one can be made at any time.

use std::env::consts::{ARCH, OS};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;

#[cfg(not(target_arch = "wasm32"))]
use crate::exchange::npz;
use crate::many::part::{self, Division, ROWS};
use crate::many::source::Study;
use crate::many::sums;
use crate::schema::{self, document};
use sweetspot::base::error::{Complaint, Error, Result};
use sweetspot::base::{file, threads};
use sweetspot::files::schema::document::{Format, Generator};
use sweetspot_study::many::hash::of_text;
use sweetspot_study::many::rows::TOGETHER;

/// The name of the manifest.
pub const MANIFEST: &str = "manifest.json";
/// The program ends where it stops.
static NEVER: AtomicBool = AtomicBool::new(false);
/// The C library. Another library may round elementary functions differently.
const LIBRARY: &str = match () {
    () if cfg!(target_env = "gnu") => "gnu",
    () if cfg!(target_env = "musl") => "musl",
    () if cfg!(target_env = "msvc") => "msvc",
    () => "own",
};

/// Description of the parts in a folder: the study and its files, the program that made them, the columns, and the
/// number of rows.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Manifest of a study of sweetspot, sweetspot-study-manifest/1")]
pub struct StudyManifest {
    /// Name of the format and its version: sweetspot-study-manifest/1.
    pub format: Format<StudyManifest>,
    /// The program that made the parts.
    pub generator: Generator,
    /// Processor and system that it ran on: others may differ in the last digits.
    pub target: String,
    /// Every file that was read, the study first.
    pub files: Vec<FileRead>,
    /// The columns of every part, in their order.
    pub columns: Vec<ColumnNamed>,
    /// Number of rows.
    pub rows: u64,
    /// Rows of every part but the last.
    pub rows_per_part: u64,
    /// Number of parts: part-000000.csv and so on.
    pub parts: u64,
}

document!(StudyManifest, "study-manifest");

/// A file that a study was made from.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FileRead {
    /// Its name.
    pub name: String,
    /// A number that changes with its text, 16 hexadecimal digits.
    pub hash: String,
}

/// A column of the parts.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ColumnNamed {
    /// Its name.
    pub name: String,
    /// Its unit; empty for numbers without one, for bare numbers of the study and for texts.
    pub unit: String,
}

/// The folder of a study.
pub struct StudyFolder<'a> {
    path: &'a Path,
    study: &'a Study,
    division: Division,
}

/// The manifest of any study.
///
/// # Errors
///
/// [`Error::Value`] for a file that is no manifest of a study; [`Error::Read`].
pub(super) fn manifest_at(path: &Path) -> Result<Value> {
    let found: Value = serde_json::from_slice(&file::read_plain(path)?).unwrap_or_default();
    if found["format"].as_str().is_some_and(|of| of.starts_with("sweetspot-study-manifest/")) {
        return Ok(found);
    }
    let what = "something else than the manifest of a study";
    let expected = "the manifest that was written there, or another folder";
    Err(Error::value(path.display().to_string(), what, expected))
}

impl<'a> StudyFolder<'a> {
    /// The folder with the manifest of this study, created if it does not exist.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a folder of another study or with parts of an unknown one; [`Error::Write`].
    pub fn open(path: &'a Path, study: &'a Study) -> Result<Self> {
        let own = Division::of(&study.rows);
        let mut this = Self { path, study, division: own };
        let manifest = path.join(MANIFEST);
        if sums::is_there(&manifest)? {
            let found = manifest_at(&manifest)?;
            let each = found.get("rows_per_part").map_or(Some(ROWS), Value::as_u64);
            // A folder that was begun with parts of the usual size keeps that size.
            if each == Some(ROWS) {
                this.division.rows_per_part = ROWS;
            }
            this.same(found)?;
            file::remove_lost(path);
            return Ok(this);
        }
        let entries = std::fs::read_dir(path).into_iter().flatten().flatten();
        let is_part = |name: &str| part::is_of_one(name) && !name.ends_with(sums::END);
        if entries.into_iter().any(|entry| entry.file_name().to_str().is_some_and(is_part)) {
            let expected = "another folder, or its manifest.json beside the parts";
            let found = "parts of a study that is not known";
            return Err(Error::value(path.display().to_string(), found, expected));
        }
        let failed = |source| Error::Write { path: path.to_owned(), source };
        std::fs::create_dir_all(path).map_err(failed)?;
        file::remove_lost(path);
        file::write(&manifest, schema::text(&this.manifest()).as_bytes())?;
        Ok(this)
    }

    /// The folder that was opened before with that division.
    pub fn again(path: &'a Path, study: &'a Study, division: Division) -> Self {
        Self { path, study, division }
    }

    /// How the rows are shared out.
    pub fn division(&self) -> Division {
        self.division
    }

    /// Path of a part.
    pub fn part(&self, k: u64) -> PathBuf {
        self.path.join(format!("part-{k:06}.csv"))
    }

    /// Part k if it exists.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a part that does not match its sum or, without a sum, its rows.
    pub fn kept(&self, k: u64) -> Result<Option<Vec<u8>>> {
        let path = self.part(k);
        if !sums::is_there(&path)? {
            return Ok(None);
        }
        let part = file::read_plain(&path)?;
        if !sums::fits(&path, &part)? {
            part::check(&self.study.rows, self.division.part(k), (&path, &part))?;
            sums::add(&path, &part)?;
        }
        Ok(Some(part))
    }

    /// The missing parts. On request each existing part gets its numbers as a NumPy archive.
    ///
    /// # Errors
    ///
    /// [`Self::kept`]; [`Error::Write`].
    pub fn missing(&self, npz: bool) -> Result<Vec<u64>> {
        let look = |k: usize| {
            let k = k as u64;
            let Some(part) = self.kept(k)? else { return Ok(Some(k)) };
            self.archive(k, npz, &part)?;
            Ok(None)
        };
        let missing = threads::map(self.division.parts() as usize, look);
        missing.into_iter().filter_map(Result::transpose).collect()
    }

    /// Makes those parts, on request with their numbers as a NumPy archive. `tell` receives the number of rows
    /// completed since the last call.
    ///
    /// # Errors
    ///
    /// [`Error::Write`].
    pub fn make(&self, parts: &[u64], npz: bool, tell: &(impl Fn(u64) + Sync)) -> Result<()> {
        for some in parts.chunks(self.at_once()) {
            let made = threads::map(some.len(), |k| self.make_one(some[k], npz, tell));
            made.into_iter().collect::<Result<()>>()?;
        }
        Ok(())
    }

    /// Number of parts made together, so that every thread has some groups of rows.
    fn at_once(&self) -> usize {
        let rows = 4 * TOGETHER * threads::count() as u64;
        rows.div_ceil(self.division.rows_per_part) as usize
    }

    fn make_one(&self, k: u64, npz: bool, tell: &(impl Fn(u64) + Sync)) -> Result<()> {
        let path = self.part(k);
        let made = part::made(self.study, self.division.part(k), &NEVER, tell);
        let archive = path.with_extension("npz");
        // An existing archive belongs to the part that was lost.
        if npz || archive.exists() {
            sums::write(&archive, &self.numbers(k, made.as_bytes())?)?;
        }
        sums::write(&path, made.as_bytes())
    }

    /// Checks the archive of an existing part, or makes it on request.
    fn archive(&self, k: u64, npz: bool, part: &[u8]) -> Result<()> {
        let path = self.part(k).with_extension("npz");
        if !sums::is_there(&path)? {
            return if npz { sums::write(&path, &self.numbers(k, part)?) } else { Ok(()) };
        }
        let there = file::read_plain(&path)?;
        if sums::fits(&path, &there)? {
            return Ok(());
        }
        match there == self.numbers(k, part)? {
            true => sums::add(&path, &there),
            false => Err(sums::damaged(&path, "another archive", "the numbers of the part")),
        }
    }

    /// The numbers of a part as a NumPy archive.
    fn numbers(&self, k: u64, part: &[u8]) -> Result<Vec<u8>> {
        let path = self.part(k);
        let columns = part::columns(&self.study.rows, self.division.part(k), (&path, part))?;
        #[cfg(not(target_arch = "wasm32"))]
        let archive = npz::columns(&columns);
        // A page writes no files.
        #[cfg(target_arch = "wasm32")]
        let archive =
            Err(std::io::Error::other(format!("{} columns: no archive in a page", columns.len())));
        archive.map_err(|source| Error::Write { path: path.with_extension("npz"), source })
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
            rows_per_part: self.division.rows_per_part,
            parts: self.division.parts(),
        }
    }

    /// An error that states what has changed since the manifest was written.
    fn same(&self, mut found: Value) -> Result<()> {
        let wanted = serde_json::to_value(self.manifest()).unwrap_or_default();
        // Every part had this size before manifests recorded it.
        if let Some(found) = found.as_object_mut() {
            found.entry("rows_per_part").or_insert(ROWS.into());
        }
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
