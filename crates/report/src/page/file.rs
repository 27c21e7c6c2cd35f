//! The report as a file, in the format that its name requests.

use std::path::{Path, PathBuf};

use crate::page::content::Report;
use crate::page::markdown;
use crate::plot::Sheet;
use crate::plot::sets::of_analysis;
use sweetspot::base::file;
use sweetspot::{Error, Result};

/// Format of a report.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PageFormat {
    /// One page that needs no other file.
    Html,
    /// Text, with a folder of pictures.
    Markdown,
}

impl PageFormat {
    /// The format requested by that name.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for another extension, or none.
    pub fn of(path: &Path) -> Result<Self> {
        let extension = path.extension().map(|text| text.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("html" | "htm") => Ok(Self::Html),
            Some("md" | "markdown") => Ok(Self::Markdown),
            _ => {
                let expected = "a file name that ends in .html or .md";
                Err(Error::value("--report", path.display(), expected))
            }
        }
    }
}

/// Checks before the report is made that it can be written there: its name has a known extension, and its folder exists
/// or is made before the report with one of `made`.
///
/// # Errors
///
/// Those of [`PageFormat::of`], and [`Error::Write`] where there is no such folder.
pub fn expected(path: &Path, made: &[&Option<PathBuf>]) -> Result<PageFormat> {
    let kind = PageFormat::of(path)?;
    let folder = path.parent().filter(|folder| *folder != Path::new(""));
    // `./a` and `a` are one.
    let plain = |path: &Path| path.strip_prefix(".").unwrap_or(path).to_owned();
    let made = made.iter().filter_map(|made| made.as_deref()).map(plain);
    if folder.is_some_and(|folder| made.into_iter().any(|made| made.starts_with(plain(folder)))) {
        return Ok(kind);
    }
    let is_one = folder.unwrap_or(Path::new(".")).join(".").metadata();
    is_one.map(|_| kind).map_err(|source| Error::Write { path: path.to_owned(), source })
}

/// Whether a page can be expected there, before it is made.
///
/// # Errors
///
/// As [`expected`], and [`Error::Value`] for a name of Markdown.
pub fn expected_page(path: &Path, made: &[&Option<PathBuf>]) -> Result<()> {
    match expected(path, made)? {
        PageFormat::Html => Ok(()),
        PageFormat::Markdown => {
            Err(Error::value("--report", path.display(), "a file name that ends in .html"))
        }
    }
}

/// The folder for the pictures of a report in Markdown: `report.md` has `report_pictures`.
pub fn pictures_of(path: &Path) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}_pictures"))
}

/// Writes the report whole; with Markdown first its pictures, then itself.
///
/// # Errors
///
/// [`Error::Write`], and those of [`PageFormat::of`].
pub fn write(path: &Path, report: &Report) -> Result<()> {
    if PageFormat::of(path)? == PageFormat::Html {
        return file::write(path, report.page().as_bytes());
    }
    let us = report.us;
    let folder = pictures_of(path);
    let failed = |source| Error::Write { path: folder.clone(), source };
    std::fs::create_dir_all(&folder).map_err(failed)?;
    for picture in &of_analysis(Sheet::file(us), report.analysis, report.map)? {
        let path = folder.join(format!("{}.svg", picture.name));
        file::write(&path, picture.svg.as_bytes())?;
    }
    let beside = folder.file_name().unwrap_or_default().to_string_lossy();
    file::write(path, markdown::text(report, &beside).as_bytes())
}
