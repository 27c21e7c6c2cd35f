//! How do files stay whole? They are written beside and renamed, and never over what was read.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::error::{Error, Result};

/// What was read and written since [`keep`]; None before it.
static KEPT: Mutex<Option<Vec<PathBuf>>> = Mutex::new(None);

/// From now on [`write()`] replaces no file that was read or written: for a program, whose user may
/// give the same name to two files by mistake.
pub fn keep() {
    locked(&KEPT).get_or_insert_default();
}

/// Reads a whole file.
///
/// # Errors
///
/// [`Error::Read`].
pub fn read(path: &Path) -> Result<Vec<u8>> {
    let bytes = fs::read(path).map_err(|source| Error::Read { path: path.to_owned(), source })?;
    note(path);
    Ok(bytes)
}

/// A file, if it is one, is kept from now on.
fn note(path: &Path) {
    let file = fs::canonicalize(path).ok().filter(|path| path.is_file());
    if let (Some(file), Some(kept)) = (file, locked(&KEPT).as_mut()) {
        kept.push(file);
    }
}

/// Writes a file so that whoever looks sees the old one or the new one, never half of one.
///
/// # Errors
///
/// [`Error::Write`], and [`Error::Value`] if the file is to be [kept](keep); what was there before
/// is still there then.
pub fn write(path: &Path, contents: &[u8]) -> Result<()> {
    let failed = |source| Error::Write { path: path.to_owned(), source };
    // A link is followed, so that it is the file that is replaced; a path to nothing is itself.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if locked(&KEPT).as_ref().is_some_and(|kept| kept.contains(&target)) {
        let (name, found) =
            (path.display().to_string(), "a file that this run has read or written");
        return Err(Error::value(&name, found, "another name for what is to be written"));
    }
    if fs::metadata(&target).is_ok_and(|old| !old.is_file() && !old.is_dir()) {
        // A device or a pipe cannot be replaced, only written to.
        let mut device = fs::OpenOptions::new().write(true).open(&target).map_err(failed)?;
        return device.write_all(contents).map_err(failed);
    }
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    let beside = target.with_file_name(format!(".{name}.{}.part", std::process::id()));
    let created = {
        // Under the list's lock, so that whoever removes the parts finds this one or forbids it.
        let mut parts = parts();
        parts.push(beside.clone());
        fs::File::create(&beside)
    };
    let written = created
        .and_then(|mut file| file.write_all(contents).and_then(|()| file.sync_all()))
        .and_then(|()| fs::rename(&beside, &target));
    let written = written.map_err(|error| {
        // The part is of no use; that it may not be there is no further error.
        let _ = fs::remove_file(&beside);
        failed(error)
    });
    parts().retain(|part| *part != beside);
    written.inspect(|()| note(path))
}

/// What is being written at this moment.
static PARTS: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn parts() -> MutexGuard<'static, Vec<PathBuf>> {
    locked(&PARTS)
}

/// A list of names is whole whatever happened to the thread that held it.
fn locked<T>(list: &Mutex<T>) -> MutexGuard<'_, T> {
    list.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes every part that is being written, for a program that is told to stop. No further file is
/// begun: whoever tries waits for the end of the program, which must follow.
pub fn abandon() {
    let parts = parts();
    for part in parts.iter() {
        // It may be whole and renamed by now.
        let _ = fs::remove_file(part);
    }
    // The next file's thread must not pass.
    std::mem::forget(parts);
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

    #[cfg(unix)]
    #[test]
    fn a_pipe_stays_a_pipe_and_a_link_a_link() {
        use std::os::unix::fs::{FileTypeExt, symlink};
        let folder = std::env::temp_dir().join(format!("sweetspot-link-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("file"), "old").unwrap();
        symlink(folder.join("file"), folder.join("link")).unwrap();
        write(&folder.join("link"), b"new").unwrap();
        assert!(fs::symlink_metadata(folder.join("link")).unwrap().is_symlink());
        assert_eq!(fs::read_to_string(folder.join("file")).unwrap(), "new");
        let pipe = folder.join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let reader = std::thread::spawn({
            let pipe = pipe.clone();
            move || fs::read_to_string(pipe).unwrap()
        });
        write(&pipe, b"through").unwrap();
        assert_eq!(reader.join().unwrap(), "through");
        assert!(fs::metadata(&pipe).unwrap().file_type().is_fifo());
        fs::remove_dir_all(&folder).unwrap();
    }
}
