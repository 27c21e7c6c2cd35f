//! A picture with its name, and its files.

use std::fs::File;
use std::io::Read;
use std::path::Path;

#[cfg(feature = "png")]
use crate::plot::png::png;
use crate::plot::svg::{BEGINNING, Svg};
use sweetspot::base::error::{Error, Result};
use sweetspot::base::file;

/// One picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Name of its files, without extension, such as `exit_speed`.
    pub name: String,
    /// Title above the picture.
    pub title: String,
    /// Facts beside the title.
    pub facts: String,
    /// Description for readers who cannot see the picture.
    pub alt: String,
    /// The whole picture as `<svg …>…</svg>`, which needs no other file.
    pub svg: String,
    /// The drawing from which `svg` was written.
    pub drawing: Svg,
}

impl Picture {
    /// A drawing with that name.
    pub fn new(name: &str, title: &str, alt: &str, svg: Svg) -> Self {
        let whole = svg.finish(title, alt);
        let [name, title, alt] = [name, title, alt].map(str::to_owned);
        Self { name, title, facts: svg.facts.clone(), alt, svg: whole, drawing: svg }
    }
}

/// Writes every picture into that folder, which is created if it does not exist, as SVG, and as PNG of twice the size
/// where the crate has its feature `png`. Returns the names of other pictures from earlier calls, which are kept.
///
/// # Errors
///
/// [`Error::Write`].
pub fn write(folder: &Path, pictures: &[Picture]) -> Result<Vec<String>> {
    let failed = |source| Error::Write { path: folder.to_owned(), source };
    std::fs::create_dir_all(folder).map_err(failed)?;
    for picture in pictures {
        let path = folder.join(format!("{}.svg", picture.name));
        file::write(&path, picture.svg.as_bytes())?;
        #[cfg(feature = "png")]
        file::write(&path.with_extension("png"), &png(&picture.drawing, 2.0))?;
    }
    Ok(others(folder, pictures))
}

/// The pictures in a folder that are not these, by rising name.
fn others(folder: &Path, pictures: &[Picture]) -> Vec<String> {
    let drawn = |path: &Path| {
        let mut beginning = [0; BEGINNING.len()];
        let mut file = File::open(path).ok()?;
        file.read_exact(&mut beginning).ok()?;
        let name = path.file_stem()?.to_str()?;
        let other = beginning == BEGINNING.as_bytes() && pictures.iter().all(|p| p.name != name);
        (other && path.extension()? == "svg").then(|| name.to_owned())
    };
    let files = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> = files
        .map(|file| file.path())
        .filter(|path| path.is_file())
        .filter_map(|p| drawn(&p))
        .collect();
    names.sort();
    names
}
