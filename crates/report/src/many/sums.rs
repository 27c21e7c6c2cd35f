//! Is a file unchanged since it was written?
//!
//! Each part has a second file with its SHA-256, one line in the format of `sha256sum`. The part is written first. If
//! the program is killed in between, the part has no sum and is checked by its content.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use sweetspot::base::error::Complaint;
use sweetspot::base::file;
use sweetspot::{Error, Result};

/// How the name of a sum ends.
pub const END: &str = ".sha256";

/// Whether a file exists.
///
/// # Errors
///
/// [`Error::Value`] for a broken link, because writing would follow it.
pub fn is_there(path: &Path) -> Result<bool> {
    let is_link = path.symlink_metadata().is_ok_and(|is| is.is_symlink());
    if is_link && !path.exists() {
        return Err(damaged(path, "a link to nothing", "a file of the study"));
    }
    Ok(path.exists())
}

/// Whether a file that was read matches its sum; false where it has no sum.
///
/// # Errors
///
/// [`Error::Value`] where it does not match, or where the second file is no sum of it; [`Error::Read`].
pub fn fits(path: &Path, bytes: &[u8]) -> Result<bool> {
    let beside = beside(path);
    if beside.symlink_metadata().is_err_and(|error| error.kind() == ErrorKind::NotFound) {
        return Ok(false);
    }
    let found = file::read_plain(&beside)?;
    let wanted = line(path, bytes);
    let (sum, name) = wanted.split_at(64);
    let found = String::from_utf8_lossy(&found);
    // `sha256sum -b` has a star before the name.
    let read = found.trim_end_matches(['\r', '\n']).split_once([' ']);
    match read.and_then(|(sum, rest)| Some((sum, rest.strip_prefix([' ', '*'])?))) {
        Some((other, of)) if of == name.trim() && is_sum(other) => {
            if other.eq_ignore_ascii_case(sum) {
                Ok(true)
            } else {
                let found = format!("other bytes than {} says", shown_name(&beside));
                Err(damaged(path, &found, "the part as it was written"))
            }
        }
        _ => {
            let complaint = Complaint::new(
                beside.display().to_string(),
                "something else than a sum of its part",
                format!("one line as sha256sum writes it, of {}", shown_name(path)),
            );
            Err(Error::Value(complaint.hinted("without this file the part is checked by its rows")))
        }
    }
}

/// Writes a file and then its sum.
///
/// # Errors
///
/// [`Error::Write`].
pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    let old = beside(path);
    match std::fs::remove_file(&old) {
        // The sum of an earlier file of that name must not be taken for that of this one.
        Err(source) if source.kind() != ErrorKind::NotFound => {
            return Err(Error::Write { path: old, source });
        }
        _ => {}
    }
    file::write(path, bytes)?;
    add(path, bytes)
}

/// Writes the sum of an existing file.
///
/// # Errors
///
/// [`Error::Write`].
pub fn add(path: &Path, bytes: &[u8]) -> Result<()> {
    file::write(&beside(path), line(path, bytes).as_bytes())
}

/// The error about a part that has changed.
pub fn damaged(path: &Path, found: &str, expected: &str) -> Error {
    let complaint = Complaint::new(path.display().to_string(), found, expected);
    Error::Value(complaint.hinted("without this file the study makes it anew"))
}

fn beside(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(END);
    name.into()
}

fn line(path: &Path, bytes: &[u8]) -> String {
    let sum = Sha256::digest(bytes);
    let sum: String = sum.iter().map(|byte| format!("{byte:02x}")).collect();
    format!("{sum}  {}\n", shown_name(path))
}

fn shown_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

fn is_sum(text: &str) -> bool {
    text.len() == 64 && text.bytes().all(|byte| byte.is_ascii_hexdigit())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// FIPS 180-2, the first example of its appendix B.
    #[test]
    fn a_sum_is_that_of_the_standard() {
        assert_eq!(
            line(Path::new("out/abc"), b"abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad  abc\n"
        );
    }
}
