//! Which tones does a recording of taps have, which modes are they, and which wood follows?

use serde::Deserialize;
use serde_json::{Value, json};
use sweetspot::base::error::{Error, Result};
use sweetspot_report::parts::note::note;
use sweetspot_report::report::calibrated_bat;
use sweetspot_report::report::tap::{TapReport, unreadable};
use sweetspot_report::schema::tap::TapTone;
use sweetspot_study::answers::Answer;
use sweetspot_study::calibrate::labels::MOST_MODES;
use sweetspot_study::tap::tapped::{Tapped, Told};
use sweetspot_tap::analysis::Analysis;
use sweetspot_tap::recording::{Recording, loudest};

use crate::asked::Question;
use crate::shown;

/// The page's question about sound that the browser has decoded.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Asked {
    name: String,
    rate_hz: f64,
    channels: usize,
    /// Number of lost pieces, which are replaced by silence.
    lost: usize,
    /// Tones with given modes: the frequency (Hz), and the bending mode or null for no mode.
    told: Vec<Told>,
}

pub fn answer(of: &Question, sound: &[u8]) -> Result<Value> {
    let asked = Asked::deserialize(Value::from(of.more.clone()))
        .map_err(|error| Error::value("the request", error, "sound with its rate"))?;
    let recordings = [recording(&asked, sound)?];
    let analysis = Analysis::of(&recordings, None);
    let tapped = Tapped::heard(&of.bat, &analysis, &asked.told)
        .map_err(|error| error.placed(|one| Error::Value(one.naming(str::to_owned))))?;
    let (bat, tapped) = (&of.bat, tapped.as_ref());
    let report = TapReport { bat, recordings: &recordings, analysis: &analysis, tapped };
    let document = report.document();
    let tone = |(k, tone): (usize, &TapTone)| {
        let [frequency, _, loss, is, sure] = report.cells(k);
        let computed = tone.computed_hz.map(|hz| {
            let told = shown::answer(Answer::Frequency(1), of.units, hz);
            json!({ "frequency": told, "note": note(hz) })
        });
        json!({ "frequency": frequency, "note": note(tone.frequency_hz), "loss": loss, "is": is,
                "sure": sure, "computed": computed })
    };
    let wood = tapped.and_then(|tapped| tapped.wood.as_ref());
    let file = wood.map(|wood| calibrated_bat::text((bat, &of.text), wood, &asked.name));
    Ok(json!({
        "document": document,
        "heard": report.heard(0),
        "tones": document.body.tones.iter().enumerate().map(tone).collect::<Vec<_>>(),
        "wood": report.wood(),
        "words": report.words(None),
        "bat_file": file.transpose()?,
        "most_modes": MOST_MODES,
    }))
}

/// The sound after the request: channel after channel, four bytes per sample, the lowest first.
fn recording(asked: &Asked, sound: &[u8]) -> Result<Recording> {
    let (bytes, channels) = (sound.len(), asked.channels);
    if !(1..=8).contains(&channels) || bytes == 0 || !bytes.is_multiple_of(4 * channels) {
        let found = format!("{bytes} bytes of {channels} channels");
        return Err(Error::value("the sound", found, "samples of 1 to 8 channels"));
    }
    let (samples, _) = sound.as_chunks::<4>();
    let samples: Vec<f32> = samples.iter().map(|one| f32::from_le_bytes(*one)).collect();
    let channels = samples.chunks(samples.len() / asked.channels).map(<[f32]>::to_vec).collect();
    let samples = loudest(channels).unwrap_or_default().into_iter().map(f64::from).collect();
    let recording = Recording::of(&asked.name, samples, asked.rate_hz);
    let recording = recording.map_err(|error| unreadable(&asked.name, error))?;
    Ok(Recording { channels: asked.channels, spoilt: asked.lost, ..recording })
}
