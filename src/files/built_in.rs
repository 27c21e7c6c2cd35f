//! Which bats are built in?

use std::path::Path;

use crate::base::{Complaint, Error, Result};
use crate::bat::Bat;

/// Name and text of the JSON files in a folder, relative to the calling file; names are those of the files without
/// their ending.
#[doc(hidden)]
#[macro_export]
macro_rules! json_files {
    ($folder:literal: $($name:literal)*) => {
        &[$(($name, include_str!(concat!($folder, "/", $name, ".json")))),*]
    };
}

/// The built-in bats: name and text.
pub const BATS: &[(&str, &str)] = json_files! { "../../meshes":
    "bbcor_made_up" "bbcor_made_up_open" "composite_made_up" "cone" "corked" "dowel" "house"
    "northwestern_aluminium" "northwestern_wood" "r161" "softball_made_up" "softball_made_up_open"
    "tanh" "torpedo" "two_piece"
};

/// The names of the built-in bats, which are those of their files.
pub fn bat_names() -> Vec<&'static str> {
    BATS.iter().map(|(name, _)| *name).collect()
}

/// The text of the built-in bat of that name.
pub fn bat_text(name: &str) -> Option<&'static str> {
    BATS.iter().find(|(other, _)| *other == name).map(|(_, text)| *text)
}

/// The name and the text of a built-in bat, if the path is its name and not a file.
///
/// # Errors
///
/// [`Error::Value`] for a name that is neither a file nor a built-in bat.
pub fn named(path: &Path) -> Result<Option<(&str, &'static str)>> {
    let one_word = path.components().count() == 1 && path.extension().is_none();
    let is_file = path.exists() && !path.is_dir();
    let Some(name) = path.to_str().filter(|_| one_word && !is_file) else { return Ok(None) };
    if let Some(text) = bat_text(name) {
        return Ok(Some((name, text)));
    }
    if path.exists() {
        return Ok(None);
    }
    let names = bat_names();
    let expected = format!("a bat file, or a built-in bat: {}", names.join(", "));
    let found = format!("{}, which is neither a file nor built in", path.display());
    Err(Error::Value(Complaint::new("", found, expected).or_nearest(name, &names)))
}

impl Bat {
    /// The built-in bat of that name, such as `r161`.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for another name.
    pub fn builtin(name: &str) -> Result<Self> {
        let Some(text) = bat_text(name) else {
            let names = bat_names();
            let complaint = Complaint::new("bat", name, format!("one of {}", names.join(", ")));
            return Err(Error::Value(complaint.or_nearest(name, &names)));
        };
        Self::from_text(name, text, Path::new(""))
    }
}
