//! Which files in a folder were written by studies, and how is the folder cleared?

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use crate::many::folder::{MANIFEST, manifest_at};
use crate::many::part;
use sweetspot::{Error, Result};

/// Files of a study in a folder, with its manifest last; empty where there is no study.
///
/// # Errors
///
/// [`Error::Value`] where the manifest in the folder is not of a study; [`Error::Read`].
pub fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let manifest = folder.join(MANIFEST);
    if !manifest.exists() {
        return Ok(vec![]);
    }
    manifest_at(&manifest)?;
    let failed = |source| Error::Read { path: folder.to_owned(), source };
    let mut files = vec![];
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let of_a_study = entry.file_name().to_str().is_some_and(part::is_of_one);
        if of_a_study && entry.file_type().is_ok_and(|is| is.is_file()) {
            files.push(entry.path());
        }
    }
    files.push(manifest);
    Ok(files)
}

/// Removes those files, in their order.
///
/// # Errors
///
/// [`Error::Write`].
pub fn remove(files: &[PathBuf]) -> Result<()> {
    files.iter().try_for_each(|path| match std::fs::remove_file(path) {
        Err(source) if source.kind() != ErrorKind::NotFound => {
            Err(Error::Write { path: path.clone(), source })
        }
        _ => Ok(()),
    })
}
