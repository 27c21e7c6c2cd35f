//! Recordings of taps, read for the command line.

use std::path::Path;

use sweetspot::base::error::Complaint;
use sweetspot::base::number::rounded;
use sweetspot::{Bat, Error, Result};
use sweetspot_report::report::tap::unreadable;
use sweetspot_study::calibrate::readings::BatReadings;
use sweetspot_study::tap::hoops::BatMode;
use sweetspot_study::tap::tapped::{Tapped, ToneLabel};
use sweetspot_tap::analysis::{Analysis, Code};
use sweetspot_tap::decode::{self, Part};
use sweetspot_tap::recording::Recording;

use crate::output::{printed, warn};

/// A recording by its file.
pub fn read(path: &Path, part: Part) -> Result<Recording> {
    decode::read(path, part).map_err(|error| unreadable(&printed(path), error))
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
        let expected = "taps of this bat: sweetspot tap says more";
        return Err(Error::value(printed(path), found, expected));
    }
    analysis.warnings.iter().for_each(|(code, _)| warn(&format!("note: {}", code.text()), quiet));
    let tapped = Tapped::of(bat, &analysis, &[])?;
    let wood = tapped.wood.ok_or_else(|| {
        Error::value(printed(path), "no tone that is a bending mode", "taps of this bat")
    })?;
    Ok(wood.readings)
}

/// The tone of recorded taps that is the first bending mode of a bat, by the text of its file, as written in a bat
/// file.
///
/// # Errors
///
/// For a file that cannot be read, and for taps without that tone.
pub fn first_tone(path: &Path, text: &str) -> std::result::Result<String, Complaint> {
    let wrong = |error: Error| match error {
        Error::Value(complaint) => complaint,
        other => Complaint::new("", other, "a recording of taps"),
    };
    let bat = Bat::from_text("the bat", text, Path::new("")).map_err(wrong)?;
    let analysis = Analysis::of(&[read(path, Part::default()).map_err(wrong)?], None);
    let tapped = Tapped::heard(&bat, &analysis, &[]).map_err(wrong)?;
    let labels = tapped.map_or(vec![], |tapped| tapped.labels);
    let is_first = |label: &ToneLabel| label.mode == Some(BatMode::Bending { order: 1 });
    let tone = analysis.tones.iter().zip(&labels).find(|(_, label)| is_first(label));
    let Some((tone, _)) = tone else {
        let found = analysis.refused.map_or("taps without the lowest tone of this bat", Code::text);
        return Err(Complaint::new("", found, "taps of this bat, or its tone in Hz"));
    };
    Ok(format!("{} Hz", rounded(tone.pole.hz, 2)))
}
