//! Files that are whole or not there: written beside and renamed.

use std::fs;
use std::io::Write;
use std::path::Path;

use crate::error::{Error, Result};

/// Writes a file so that whoever looks sees the old one or the new one, never half of one.
///
/// # Errors
///
/// [`Error::Write`]; what was there before is still there then.
pub fn write(path: &Path, contents: &[u8]) -> Result<()> {
    let failed = |source| Error::Write { path: path.to_owned(), source };
    if fs::metadata(path).is_ok_and(|there| !there.is_file() && !there.is_dir()) {
        // A device or a pipe is written to, not replaced.
        let device = fs::OpenOptions::new().write(true).open(path);
        return device.and_then(|mut device| device.write_all(contents)).map_err(failed);
    }
    // A link stays one: what it points to is replaced.
    let target = fs::canonicalize(path);
    let path = target.as_deref().unwrap_or(path);
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let beside = path.with_file_name(format!(".{name}.{}.part", std::process::id()));
    let written = fs::File::create(&beside)
        .and_then(|mut file| file.write_all(contents).and_then(|()| file.sync_all()))
        .and_then(|()| fs::rename(&beside, path));
    written.map_err(|error| {
        // The part is of no use; that it may not be there is no further error.
        let _ = fs::remove_file(&beside);
        failed(error)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_write_leaves_the_old_file_and_no_part() {
        let folder = std::env::temp_dir().join(format!("sweetspot-file-{}", std::process::id()));
        fs::create_dir_all(folder.join("taken")).unwrap();
        fs::write(folder.join("taken/inside"), "old").unwrap();
        write(&folder.join("new"), b"new").unwrap();
        write(&folder.join("new"), b"newer").unwrap();
        assert_eq!(fs::read_to_string(folder.join("new")).unwrap(), "newer");
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("new", folder.join("link")).unwrap();
            write(&folder.join("link"), b"through").unwrap();
            assert_eq!(fs::read_to_string(folder.join("new")).unwrap(), "through");
            fs::remove_file(folder.join("link")).unwrap();
        }
        // A folder with something in it cannot be replaced by a file.
        assert!(write(&folder.join("taken"), b"x").is_err());
        assert!(write(&folder.join("missing/new"), b"x").is_err());
        let mut names: Vec<_> =
            fs::read_dir(&folder).unwrap().map(|e| e.unwrap().file_name()).collect();
        names.sort();
        assert_eq!(names, ["new", "taken"]);
        fs::remove_dir_all(&folder).unwrap();
    }
}
