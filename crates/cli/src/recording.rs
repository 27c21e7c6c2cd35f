//! Recordings of taps as they are read from the command line.

use std::path::Path;

use sweetspot::{Bat, Error, Result};
use sweetspot_report::report::tap::{said, unreadable};
use sweetspot_study::calibrate::readings::BatReadings;
use sweetspot_study::tap::tapped::Tapped;
use sweetspot_tap::analysis::Analysis;
use sweetspot_tap::decode::{self, Part};
use sweetspot_tap::recording::Recording;

use crate::output::{printed, warn};

/// A recording by its file.
pub fn read(path: &Path, part: Part) -> Result<Recording> {
    decode::read(path, part).map_err(|error| unreadable(&printed(path), error))
}

/// Recorded taps of a bat as lines and tones that died out, for `calibrate`.
///
/// # Errors
///
/// A file that cannot be read, and one in which there is no tone of this bat.
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
