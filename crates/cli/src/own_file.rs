//! How does the program keep a file that no other may overwrite?
//!
//! An [`OwnFile`] is at a path where there was no file, or is a file whose first line identifies it. It is locked while
//! it is held, so that no two programs keep the same one. Any other file at the path stays untouched: links are not
//! followed, pipes not waited on, devices not read.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{ErrorKind, Read, Result};
use std::path::{Path, PathBuf};

use sweetspot::base::file::{beside, note, number};

/// The largest file that is recognised (bytes).
const MOST: u64 = 4 << 20;

/// A file that only this program writes, held by this run.
#[derive(Debug)]
pub struct OwnFile {
    path: PathBuf,
    /// The file itself, locked where files can be.
    held: File,
}

/// The file at a path.
#[derive(Debug)]
pub enum AtPath {
    /// There is nothing, not even a link that leads nowhere.
    Free,
    /// A file of this program that no other process holds, and its text.
    Own(OwnFile, String),
    /// A file that another run holds.
    Held,
    /// Anything else.
    Other,
}

/// Looks at a path; a file of this program begins with `begins`.
pub fn look(path: &Path, begins: &str) -> AtPath {
    let is = match fs::symlink_metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return AtPath::Free,
        Ok(is) if is.is_file() && is.len() <= MOST && !is.permissions().readonly() => is,
        _ => return AtPath::Other,
    };
    let Ok(held) = OpenOptions::new().read(true).write(true).open(path) else {
        return AtPath::Other;
    };
    if held.metadata().is_ok_and(|opened| number(&opened) != number(&is)) {
        return AtPath::Other;
    }
    // Where files cannot be locked, the file counts as free.
    if let Err(TryLockError::WouldBlock) = held.try_lock() {
        return AtPath::Held;
    }
    let mut text = String::new();
    match (&held).take(MOST).read_to_string(&mut text) {
        Ok(_) if text.starts_with(begins) => {
            note(path);
            AtPath::Own(OwnFile { path: path.to_owned(), held }, text)
        }
        _ => AtPath::Other,
    }
}

impl OwnFile {
    /// A new file at a free path.
    ///
    /// # Errors
    ///
    /// [`ErrorKind::AlreadyExists`] if there is a file, which stays untouched; the system's errors.
    pub fn create(path: &Path, contents: &[u8]) -> Result<Self> {
        let put = |part: &Path| match fs::hard_link(part, path) {
            Ok(()) => fs::remove_file(part),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => Err(error),
            // Not every disk has second names.
            Err(_) if fs::symlink_metadata(path).is_err() => fs::rename(part, path),
            Err(_) => Err(ErrorKind::AlreadyExists.into()),
        };
        let held = beside(path, None, contents, put)?;
        note(path);
        Ok(Self { path: path.to_owned(), held })
    }

    /// Replaces its contents as a whole.
    ///
    /// # Errors
    ///
    /// [`ErrorKind::AlreadyExists`] if another file is at its path by now; the system's errors.
    pub fn write(&mut self, contents: &[u8]) -> Result<()> {
        if !self.is_there() {
            *self = Self::create(&self.path, contents)?;
            return Ok(());
        }
        let old = self.held.metadata()?;
        self.held = beside(&self.path, Some(&old), contents, |part| fs::rename(part, &self.path))?;
        Ok(())
    }

    /// Removes it, if it is still at its path.
    pub fn remove(self) {
        if self.is_there() {
            // It has served: a copy that stays does no harm.
            let _ = fs::remove_file(&self.path);
        }
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether the file at its place is the one that is held.
    fn is_there(&self) -> bool {
        let here = fs::symlink_metadata(&self.path).ok().filter(|is| is.is_file());
        here.zip(self.held.metadata().ok()).is_some_and(|(a, b)| number(&a) == number(&b))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_taken_once_and_what_is_no_own_file_stays() {
        let folder = std::env::temp_dir().join(format!("sweetspot-own-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let [own, other] = ["own", "other"].map(|name| folder.join(name));
        assert!(matches!(look(&own, "# mine"), AtPath::Free));
        let mut file = OwnFile::create(&own, b"# mine 1").unwrap();
        assert!(matches!(look(&own, "# mine"), AtPath::Held));
        file.write(b"# mine 2").unwrap();
        assert!(matches!(look(&own, "# mine"), AtPath::Held));
        let taken = OwnFile::create(&own, b"x").unwrap_err().kind();
        assert_eq!(taken, ErrorKind::AlreadyExists);
        drop(file);
        let AtPath::Own(mut file, text) = look(&own, "# mine") else { panic!() };
        assert_eq!(text, "# mine 2");
        fs::remove_file(&own).unwrap();
        fs::write(&own, b"\xfftheirs").unwrap();
        assert_eq!(file.write(b"# mine 3").unwrap_err().kind(), ErrorKind::AlreadyExists);
        file.remove();
        assert_eq!(fs::read(&own).unwrap(), b"\xfftheirs");
        assert!(matches!(look(&own, "# mine"), AtPath::Other));
        #[cfg(unix)]
        for target in ["/dev/zero", "nowhere", "own"] {
            std::os::unix::fs::symlink(target, &other).unwrap();
            assert!(matches!(look(&other, ""), AtPath::Other), "{target}");
            assert!(OwnFile::create(&other, b"x").is_err() && !folder.join("nowhere").exists());
            fs::remove_file(&other).unwrap();
        }
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::remove_dir_all(&folder).unwrap();
    }
}
