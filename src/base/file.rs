//! How do files stay whole? A new file is written next to the old one and renamed; an input is never overwritten.
//!
//! [`write()`] follows the name to its target. It writes through an open descriptor, a device or a pipe. It replaces a
//! file by a whole new one with the same owner and permissions. If that is impossible (the file has other names, or the
//! folder is write-protected), it overwrites the file, and restores the old contents if that fails.

use std::fs::{self, File, Metadata, OpenOptions};
use std::hash::{BuildHasher, RandomState};
use std::io::{self, Error as Fault, ErrorKind, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::base::error::{Error, Result};

/// The largest file that is read (bytes), some ten million stations.
pub const MOST: u64 = 256 << 20;

/// The files read and written since [`keep`]; `None` before the call.
static KEPT: Mutex<Option<Vec<Identity>>> = Mutex::new(None);

/// What identifies a file: its path without links, and its number on the disk, which all its names share.
#[derive(Debug)]
struct Identity {
    path: PathBuf,
    number: Option<(u64, u64)>,
}

impl Identity {
    fn of(path: &Path) -> Option<Self> {
        let path = fs::canonicalize(path).ok()?;
        let number = number(&fs::metadata(&path).ok().filter(Metadata::is_file)?);
        Some(Self { path, number })
    }

    fn is(&self, other: &Self) -> bool {
        self.path == other.path || (self.number.is_some() && self.number == other.number)
    }
}

/// From now on [`write()`] refuses to replace a file that was read or written, or the one that standard output goes to.
/// A program calls it, because its user may name one file twice by mistake.
pub fn keep() {
    locked(&KEPT).get_or_insert_default();
    ["/dev/stdout", "/dev/stderr"].iter().for_each(|name| note(Path::new(name)));
}

/// Reads a whole file that a person has named, or everything that a pipe or a device gives.
///
/// # Errors
///
/// [`Error::Read`], also for more than [`MOST`] bytes: a device may never end.
pub fn read(path: &Path) -> Result<Vec<u8>> {
    let failed = |source| Error::Read { path: path.to_owned(), source };
    let bytes = up_to(path, MOST).map_err(failed)?;
    note(path);
    Ok(bytes)
}

/// Reads a whole file that was not named on the command line: another file names it, or it lies where one is expected.
/// Pipes and devices are refused, because a reader may wait for them for ever.
///
/// # Errors
///
/// As [`read`].
pub fn read_plain(path: &Path) -> Result<Vec<u8>> {
    let failed = |source| Error::Read { path: path.to_owned(), source };
    let is = fs::metadata(path).map_err(failed)?;
    if !is.is_file() && !is.is_dir() {
        let said = "it is a pipe or a device, not a file";
        return Err(failed(Fault::new(ErrorKind::InvalidInput, said)));
    }
    read(path)
}

fn up_to(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let file = File::open(path)?;
    let size = file.metadata()?.len();
    let mut bytes = Vec::new();
    if size <= most {
        bytes.reserve(size as usize);
        file.take(most + 1).read_to_end(&mut bytes)?;
    }
    if size > most || bytes.len() as u64 > most {
        let said = format!("it has more than {} MiB, the most that is read", most >> 20);
        return Err(Fault::new(ErrorKind::FileTooLarge, said));
    }
    Ok(bytes)
}

/// Keeps a file from being replaced from now on, if the path leads to one.
pub fn note(path: &Path) {
    if let (Some(file), Some(kept)) = (Identity::of(path), locked(&KEPT).as_mut()) {
        kept.push(file);
    }
}

/// Writes a file so that readers see the old one or the new one, never half of one.
///
/// # Errors
///
/// [`Error::Write`], and [`Error::Value`] if the file is to be [kept](keep). The old contents are still there then.
pub fn write(path: &Path, contents: &[u8]) -> Result<()> {
    let failed = |source| Error::Write { path: path.to_owned(), source };
    let target = end_of_links(path).map_err(failed)?;
    if let Some(descriptor) = Descriptor::at(&target) {
        return unless_closed(descriptor.write(contents)).map_err(failed);
    }
    // Uses the name as given: the system's restrictions on links apply here too.
    let old = match fs::metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => None,
        old => Some(old.map_err(failed)?),
    };
    let written = match old {
        Some(old) if !old.is_file() && !old.is_dir() => {
            let device = OpenOptions::new().append(true).open(path);
            return unless_closed(device.and_then(|mut it| it.write_all(contents))).map_err(failed);
        }
        Some(old) => {
            refuse_kept(path)?;
            replace(path, &target, &old, contents)
        }
        None => write_beside(&target, None, contents),
    };
    written.map_err(failed).inspect(|()| note(path))
}

/// Whether two names lead to one file, which need not exist yet. A device never counts as one file.
pub fn is_one(first: &Path, second: &Path) -> bool {
    let target = |path: &Path| {
        let target = end_of_links(path).ok()?;
        let device = Descriptor::at(&target).is_some()
            || fs::metadata(&target).is_ok_and(|is| !is.is_file() && !is.is_dir());
        (!device).then_some(target)
    };
    let Some((first, second)) = target(first).zip(target(second)) else { return false };
    let files = Identity::of(&first).zip(Identity::of(&second));
    files.map_or(first == second, |(first, second)| first.is(&second))
}

fn refuse_kept(path: &Path) -> Result<()> {
    let Some(this) = Identity::of(path) else { return Ok(()) };
    if locked(&KEPT).iter().flatten().any(|kept| kept.is(&this)) {
        let (name, found) =
            (path.display().to_string(), "a file that this run has read or written");
        return Err(Error::value(&name, found, "another name for what is to be written"));
    }
    Ok(())
}

/// A closed pipe is not an error: its reader has read enough.
fn unless_closed(written: io::Result<()>) -> io::Result<()> {
    match written {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}

/// The target of a name after all links, whether the file exists yet or not. The link of an open
/// [descriptor](Descriptor) is itself a target: its text is not a path to the open file.
fn end_of_links(path: &Path) -> io::Result<PathBuf> {
    const MOST_LINKS: usize = 40;
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        let (Some(folder), Some(name)) = (path.parent(), path.file_name()) else { return Ok(path) };
        let folder = if folder == Path::new("") { Path::new(".") } else { folder };
        let folder = fs::canonicalize(folder)?;
        let here = folder.join(name);
        path = match fs::read_link(&here) {
            Ok(link) if Descriptor::at(&here).is_none() => folder.join(link),
            _ => return Ok(here),
        };
    }
    Err(Fault::other("too many links, one after the other"))
}

/// A descriptor that a process has open, known by its path in the file system.
#[derive(Debug, PartialEq)]
struct Descriptor<'a> {
    path: &'a Path,
    /// Number of the descriptor, if this process owns it.
    own: Option<i32>,
}

impl<'a> Descriptor<'a> {
    /// The descriptor at a path whose folder has no links.
    fn at(path: &'a Path) -> Option<Self> {
        let number = path.file_name()?.to_str()?.parse().ok()?;
        let folder = path.parent()?;
        if folder == Path::new("/dev/fd") {
            return Some(Self { path, own: Some(number) });
        }
        let process = folder.strip_prefix("/proc").ok().filter(|rest| rest.ends_with("fd"))?;
        let this = std::process::id().to_string();
        let own = process.starts_with(this).then_some(number);
        Some(Self { path, own })
    }

    /// Writes at the descriptor's current position, or appends if it was opened to append.
    fn write(&self, contents: &[u8]) -> io::Result<()> {
        match self.own {
            Some(1) => {
                let mut out = io::stdout().lock();
                out.write_all(contents).and_then(|()| out.flush())
            }
            Some(2) => io::stderr().write_all(contents),
            _ => self.open()?.write_all(contents),
        }
    }

    /// Linux reopens the file at its beginning; only a duplicate descriptor continues at the current position.
    #[cfg(all(target_os = "linux", feature = "descriptors"))]
    fn open(&self) -> io::Result<File> {
        use rustix::process::{PidfdFlags, PidfdGetfdFlags, getpid, pidfd_getfd, pidfd_open};
        let duplicate = |number| {
            let this = pidfd_open(getpid(), PidfdFlags::empty())?;
            pidfd_getfd(this, number, PidfdGetfdFlags::empty()).map(File::from)
        };
        match self.own.filter(|number| inherited(*number)).map(duplicate) {
            Some(Ok(file)) => Ok(file),
            // Before Linux 5.6, or for another process, append: existing contents are not lost.
            _ => OpenOptions::new().append(true).open(self.path),
        }
    }

    #[cfg(not(all(target_os = "linux", feature = "descriptors")))]
    fn open(&self) -> io::Result<File> {
        OpenOptions::new().append(true).open(self.path)
    }
}

/// Whether a descriptor was open when the program began. The program closes on exec every descriptor that it has opened
/// itself, even under a number that was free.
#[cfg(all(target_os = "linux", feature = "descriptors"))]
fn inherited(number: i32) -> bool {
    const CLOSED_ON_EXEC: u32 = 0o2_000_000;
    let told = fs::read_to_string(format!("/proc/self/fdinfo/{number}")).unwrap_or_default();
    let flags = told.lines().find_map(|line| line.strip_prefix("flags:"));
    let flags = flags.and_then(|flags| u32::from_str_radix(flags.trim(), 8).ok());
    flags.is_some_and(|flags| flags & CLOSED_ON_EXEC == 0)
}

/// Replaces a file by a whole one, or overwrites it where that is not possible.
fn replace(path: &Path, target: &Path, old: &Metadata, contents: &[u8]) -> io::Result<()> {
    if old.permissions().readonly() {
        // The superuser could write it, but somebody made the file read-only on purpose.
        return Err(Fault::new(ErrorKind::PermissionDenied, "it is a read-only file"));
    }
    // A user who may not write to the file must not replace it either.
    OpenOptions::new().write(true).open(path)?;
    if names(old) == 1 {
        use ErrorKind::{CrossesDevices, PermissionDenied, ReadOnlyFilesystem, ResourceBusy};
        match write_beside(target, Some(old), contents) {
            // No file can be created in the folder, or not with that owner, or the file cannot be replaced.
            Err(error)
                if matches!(
                    error.kind(),
                    PermissionDenied | ReadOnlyFilesystem | ResourceBusy | CrossesDevices
                ) => {}
            done => return done,
        }
    }
    overwrite(path, contents)
}

/// Overwrites a file, and restores the old contents if that fails.
fn overwrite(path: &Path, contents: &[u8]) -> io::Result<()> {
    // Holds the list's lock, so that a thread that stops the program waits for the end of the write.
    let _parts = parts();
    let mut file = OpenOptions::new().read(true).write(true).open(path)?;
    let mut held = Vec::new();
    file.read_to_end(&mut held)?;
    let mut put = |contents: &[u8]| {
        file.rewind()?;
        file.write_all(contents)?;
        file.set_len(contents.len() as u64)?;
        file.sync_all()
    };
    put(contents).inspect_err(|_| {
        // The reason why the file could not be written is the one to report.
        let _ = put(&held);
    })
}

/// Writes a temporary file in the folder of the target, with the owner and permissions of `old`, and renames it.
fn write_beside(target: &Path, old: Option<&Metadata>, contents: &[u8]) -> io::Result<()> {
    beside(target, old, contents, |part| fs::rename(part, target)).map(drop)
}

/// Writes a temporary file in the folder of the target, with the owner and permissions of `old`, and lets `put` move it
/// to its place. Returns the file, locked where files can be.
pub fn beside(
    target: &Path,
    old: Option<&Metadata>,
    contents: &[u8],
    put: impl FnOnce(&Path) -> io::Result<()>,
) -> io::Result<File> {
    let (part, mut file) = new_part(target)?;
    let written = old
        .map_or(Ok(()), |old| as_before(&file, old))
        .and_then(|()| file.write_all(contents))
        .and_then(|()| file.sync_all())
        .and_then(|()| put(&part));
    if written.is_err() {
        // The temporary file is of no use; it may already be gone, which is not a further error.
        let _ = fs::remove_file(&part);
    }
    parts().retain(|other| *other != part);
    written.map(|()| file)
}

/// Beginning and end of the name of a file that is being written.
const PART: &str = ".sweetspot-";
const OF_A_PART: &str = ".part";

/// Removes temporary files that killed programs have left in a folder: no program holds them any more. A file that
/// cannot be read stays.
pub fn remove_lost(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for path in entries.flatten().map(|entry| entry.path()) {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or("");
        if name.starts_with(PART) && name.ends_with(OF_A_PART) {
            let held = OpenOptions::new().write(true).open(&path);
            if held.is_ok_and(|file| file.try_lock().is_ok()) {
                let _ = fs::remove_file(&path);
            }
        }
    }
}

/// A new file in the folder of the target, under a name that cannot be guessed and that stays short even if the
/// target's name is long.
fn new_part(target: &Path) -> io::Result<(PathBuf, File)> {
    const TRIES: usize = 16;
    for _ in 0..TRIES {
        let number = RandomState::new().hash_one(target);
        let part = target.with_file_name(format!("{PART}{number:016x}{OF_A_PART}"));
        // Holds the list's lock, so that a thread that removes the temporary files finds this one or forbids it.
        let mut parts = parts();
        match OpenOptions::new().write(true).create_new(true).open(&part) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
            Ok(file) => {
                // Where files cannot be locked, this file is never taken for an abandoned one.
                let _ = file.try_lock();
                parts.push(part.clone());
                return Ok((part, file));
            }
        }
    }
    Err(Fault::from(ErrorKind::AlreadyExists))
}

/// Gives a new file the owner and the permissions of the file that it replaces.
#[cfg(unix)]
fn as_before(file: &File, old: &Metadata) -> io::Result<()> {
    use std::os::unix::fs::{MetadataExt, fchown};
    let new = file.metadata()?;
    if (new.uid(), new.gid()) != (old.uid(), old.gid()) {
        fchown(file, Some(old.uid()), Some(old.gid()))?;
    }
    file.set_permissions(old.permissions())
}

#[cfg(not(unix))]
fn as_before(file: &File, old: &Metadata) -> io::Result<()> {
    file.set_permissions(old.permissions())
}

/// How many names (hard links) a file has.
#[cfg(unix)]
fn names(file: &Metadata) -> u64 {
    std::os::unix::fs::MetadataExt::nlink(file)
}

#[cfg(not(unix))]
fn names(_: &Metadata) -> u64 {
    1
}

/// Disk and number of a file.
#[cfg(unix)]
pub fn number(file: &Metadata) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    Some((file.dev(), file.ino()))
}

#[cfg(not(unix))]
pub(crate) fn number(_: &Metadata) -> Option<(u64, u64)> {
    None
}

/// The files being written at this moment.
static PARTS: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn parts() -> MutexGuard<'static, Vec<PathBuf>> {
    locked(&PARTS)
}

/// Locks a list. It is intact even if a thread panicked while it held the lock.
fn locked<T>(list: &Mutex<T>) -> MutexGuard<'_, T> {
    list.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes every temporary file, for a program that is told to stop. A thread that tries to begin another file waits
/// for the end of the program, which must follow.
pub fn abandon() {
    remove_all(parts());
}

/// As [`abandon`], but waits only briefly: the thread that writes may be the calling one.
pub fn abandon_at_once() {
    const TRIES: u32 = 50;
    for _ in 0..TRIES {
        if let Ok(parts) = PARTS.try_lock() {
            return remove_all(parts);
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}

fn remove_all(parts: MutexGuard<'static, Vec<PathBuf>>) {
    for part in parts.iter() {
        // The file may be complete and renamed by now.
        let _ = fs::remove_file(part);
    }
    // Keeps the lock, so that no thread begins another file.
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
