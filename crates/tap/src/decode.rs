//! Recordings as files: m4a (AAC-LC, ALAC), wav, mp3, flac, ogg (Vorbis), decoded by symphonia.

use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;

use symphonia::core::codecs::audio::{AudioCodecParameters, AudioDecoder, AudioDecoderOptions};
use symphonia::core::errors::Error;
use symphonia::core::formats::probe::Hint;
use symphonia::core::formats::{FormatOptions, FormatReader, TrackType};
use symphonia::core::io::MediaSourceStream;
use symphonia::core::meta::MetadataOptions;

use crate::recording::{LARGEST, LONGEST, RATES, Recording, Unreadable};

const READ: &str = "a recording as m4a (AAC, ALAC), wav, mp3, flac or ogg (Vorbis)";
const MOST_CHANNELS: usize = 8;

/// Endings of files that hold sound.
pub const ENDINGS: [&str; 13] =
    ["m4a", "mp4", "mov", "aac", "wav", "wave", "mp3", "flac", "ogg", "oga", "opus", "amr", "3gp"];

/// Whether a file's ending is that of a recording.
pub fn is_recording(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    ENDINGS.contains(&&*ending)
}

/// Which part of a file is listened to.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Part {
    /// From that time on (s).
    pub from: f64,
    /// Until then (s); None for the end.
    pub to: Option<f64>,
    /// The channel, from 1; None for the loudest.
    pub channel: Option<usize>,
}

/// A recording by its file. Of several channels the loudest is taken, not their sum: two microphones 15 cm apart
/// cancel above 1 kHz.
///
/// # Errors
///
/// [`Unreadable`] for a file that cannot be opened, that is larger than [`LARGEST`], and as [`decode`].
pub fn read(path: &Path, part: Part) -> Result<Recording, Unreadable> {
    let mut bytes = vec![];
    File::open(path)?.take(LARGEST + 1).read_to_end(&mut bytes)?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    decode(&name, bytes, part)
}

/// A recording by the contents of its file; the name's ending is a hint.
///
/// # Errors
///
/// [`Unreadable::Sound`] for contents that are no sound that is read here: voice notes (Opus, AMR), HE-AAC, files that
/// are spoilt, empty, or longer than [`LONGEST`].
pub fn decode(name: &str, bytes: Vec<u8>, part: Part) -> Result<Recording, Unreadable> {
    if bytes.len() as u64 > LARGEST {
        let expected = format!("at most {} MB: a minute of taps is enough", LARGEST / 1_000_000);
        return Err(Unreadable::sound("a larger file", expected));
    }
    voice_note(&bytes)?;
    let container = container(&bytes);
    let (mut format, track, asked) = opened(name, bytes)?;
    let codec = asked.codec;
    let described = symphonia::default::get_codecs().get_audio_decoder(codec);
    let codec = described.map(|decoder| decoder.codec.info.short_name.to_uppercase());
    let options = AudioDecoderOptions::default();
    let decoder = symphonia::default::get_codecs().make_audio_decoder(&asked, &options);
    let mut decoder = decoder.map_err(|error| {
        let he_aac = asked.extra_data.as_deref().and_then(|data| data.first());
        let found = match he_aac.map(|byte| byte >> 3) {
            Some(5 | 29) if codec.as_deref() == Some("AAC") => "HE-AAC sound".to_owned(),
            _ => format!("sound that is not decoded here ({error})"),
        };
        Unreadable::sound(found, READ)
    })?;
    let (channels, rate) = sound(&mut *format, &mut *decoder, track, part)?;
    let count = channels.len();
    let power = |channel: &Vec<f32>| channel.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>();
    let chosen = match part.channel {
        Some(channel) => channels.into_iter().nth(channel - 1),
        None => channels.into_iter().max_by(|a, b| power(a).total_cmp(&power(b))),
    };
    let Some(chosen) = chosen else {
        let expected = format!("one of its {count}");
        let asked = part.channel.map_or("no sound".to_owned(), |k| format!("channel {k}"));
        return Err(Unreadable::sound(asked, expected));
    };
    let samples: Vec<f64> = chosen.into_iter().map(f64::from).collect();
    let recording = Recording::of(name, samples, rate)?;
    Ok(Recording { container, codec, channels: count, from: part.from, ..recording })
}

/// Refuses what messengers write by what is to be done.
fn voice_note(bytes: &[u8]) -> Result<(), Unreadable> {
    let head = &bytes[..bytes.len().min(4096)];
    let has = |word: &[u8]| head.windows(word.len()).any(|part| part == word);
    let codec = match () {
        _ if has(b"OpusHead") => "Opus",
        _ if head.starts_with(b"#!AMR")
            || has(b"ftyp3gp") && bytes.windows(4).any(|w| w == b"samr") =>
        {
            "AMR"
        }
        _ => return Ok(()),
    };
    let expected = "the recording as a file: record in a recorder app and send it as m4a or wav";
    Err(Unreadable::sound(format!("a voice note ({codec}), which is not read"), expected))
}

fn container(bytes: &[u8]) -> Option<String> {
    let kind = match bytes {
        [b'R', b'I', b'F', b'F', ..] => "wav",
        [b'f', b'L', b'a', b'C', ..] => "flac",
        [b'O', b'g', b'g', b'S', ..] => "ogg",
        [_, _, _, _, b'f', b't', b'y', b'p', ..] => "m4a",
        _ => return None,
    };
    Some(kind.to_owned())
}

type Opened = (Box<dyn FormatReader>, u32, AudioCodecParameters);

fn opened(name: &str, bytes: Vec<u8>) -> Result<Opened, Unreadable> {
    let mut hint = Hint::new();
    if let Some(ending) = Path::new(name).extension().and_then(|ending| ending.to_str()) {
        hint.with_extension(ending);
    }
    let stream = MediaSourceStream::new(Box::new(Cursor::new(bytes)), Default::default());
    let (format, meta) = (FormatOptions::default(), MetadataOptions::default());
    let format = symphonia::default::get_probe().probe(&hint, stream, format, meta);
    let format = format.map_err(|error| {
        Unreadable::sound(format!("no sound that is known here ({error})"), READ)
    })?;
    let track = format.default_track(TrackType::Audio);
    let audio = track.and_then(|track| Some((track.id, track.codec_params.as_ref()?.audio()?)));
    let Some((id, audio)) = audio.map(|(id, audio)| (id, audio.clone())) else {
        return Err(Unreadable::sound("a file without sound that is known here", READ));
    };
    Ok((format, id, audio))
}

/// The samples of every channel in the part, and their rate. Packets that are spoilt are left out.
fn sound(
    format: &mut dyn FormatReader,
    decoder: &mut dyn AudioDecoder,
    track: u32,
    part: Part,
) -> Result<(Vec<Vec<f32>>, f64), Unreadable> {
    let mut channels: Vec<Vec<f32>> = vec![];
    let (mut rate, mut passed) = (0.0, 0);
    let mut one: Vec<Vec<f32>> = vec![];
    while let Ok(Some(packet)) = format.next_packet() {
        if packet.track_id != track {
            continue;
        }
        let decoded = match decoder.decode(&packet) {
            Ok(decoded) => decoded,
            Err(Error::DecodeError(_)) => continue,
            Err(_) => break,
        };
        let found = f64::from(decoded.spec().rate());
        if channels.is_empty() {
            rate = found;
            channels = vec![vec![]; decoded.spec().channels().count()];
            if channels.is_empty()
                || channels.len() > MOST_CHANNELS
                || !(RATES[0]..=RATES[1]).contains(&rate)
            {
                let found = format!("{} channels of {rate} samples a second", channels.len());
                return Err(Unreadable::sound(
                    found,
                    format!("1 to {MOST_CHANNELS} of {} to {}", RATES[0], RATES[1]),
                ));
            }
        }
        if found != rate || decoded.spec().channels().count() != channels.len() {
            return Err(Unreadable::sound("sound that changes its rate or channels", READ));
        }
        decoded.copy_to_vecs_planar(&mut one);
        let frames = one.first().map_or(0, Vec::len);
        let first = ((part.from * rate) as usize).saturating_sub(passed).min(frames);
        let end =
            part.to.map_or(frames, |to| ((to * rate) as usize).saturating_sub(passed).min(frames));
        passed += frames;
        if first < end {
            channels.iter_mut().zip(&one).for_each(|(all, new)| all.extend(&new[first..end]));
        }
        if channels[0].len() as f64 > LONGEST * rate {
            let expected = format!("at most {LONGEST} s: take a part of it with --from and --to");
            return Err(Unreadable::sound(format!("more than {LONGEST} s of sound"), expected));
        }
        if part.to.is_some_and(|to| passed as f64 >= to * rate) {
            break;
        }
    }
    if channels.iter().all(Vec::is_empty) {
        return Err(Unreadable::sound("no sound in it", READ));
    }
    Ok((channels, rate))
}
