//! Recordings of taps, read for the command line.

use std::path::Path;

use sweetspot::{Bat, Error, Result};
use sweetspot_report::report::tap::said;
use sweetspot_study::calibrate::readings::BatReadings;
use sweetspot_study::tap::tapped::Tapped;
use sweetspot_tap::analysis::Analysis;
use sweetspot_tap::decode::{self, Part};
use sweetspot_tap::recording::{Recording, Unreadable};

use crate::output::{printed, warn};

/// A recording by its file.
pub fn read(path: &Path, part: Part) -> Result<Recording> {
    decode::read(path, part).map_err(|error| match error {
        Unreadable::File(source) => Error::Read { path: path.to_owned(), source },
        Unreadable::Sound { found, expected } => Error::value(printed(path), found, expected),
        other => Error::value(printed(path), other, "a recording"),
    })
}

/// The lines and the decaying tones in recorded taps of a bat, for `calibrate`.
///
/// # Errors
///
/// For a file that cannot be read, and for one without a tone of this bat.
pub fn readings(path: &Path, bat: &Bat, quiet: bool) -> Result<BatReadings> {
    let recording = read(path, Part::default())?;
    let analysis = Analysis::of(&[recording], None);
    if let Some(refused) = analysis.refused {
        let found = refused.name().replace('_', " ");
        return Err(Error::value(
            printed(path),
            found,
            "taps of this bat: sweetspot tap says more",
        ));
    }
    analysis.warnings.iter().for_each(|(code, _)| warn(&format!("note: {}", said(*code)), quiet));
    let tapped = Tapped::of(bat, &analysis, &[])?;
    let wood = tapped.wood.ok_or_else(|| {
        Error::value(printed(path), "no tone that is a bending mode", "taps of this bat")
    })?;
    Ok(wood.readings)
}
