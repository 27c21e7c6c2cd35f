//! Recordings as files: m4a (AAC-LC, ALAC), wav, mp3, flac, ogg (Vorbis), decoded by symphonia.

use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;

use symphonia::core::codecs::audio::{AudioCodecParameters, AudioDecoder, AudioDecoderOptions};
use symphonia::core::formats::probe::Hint;
use symphonia::core::formats::{FormatOptions, FormatReader, TrackType};
use symphonia::core::io::MediaSourceStream;
use symphonia::core::meta::MetadataOptions;

use crate::recording::{LARGEST, Recording, Unreadable, is_rate, is_short, loudest};

const READ: &str = "a recording as m4a (AAC, ALAC), wav, mp3, flac or ogg (Vorbis)";
const MOST_CHANNELS: usize = 8;
/// Samples of all channels together: two minutes of two at 48,000 a second.
const MOST_SAMPLES: usize = 12_000_000;

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
    /// Up to that time (s); `None` for the end.
    pub to: Option<f64>,
    /// The channel, from 1; `None` for the loudest.
    pub channel: Option<usize>,
}

/// A recording by its file. Of several channels the [`loudest`] is taken.
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
/// [`Unreadable::Sound`] for sound in a format that is not supported (voice notes in Opus or AMR, HE-AAC), and for
/// files that are damaged, empty, or longer than [`LONGEST`](crate::recording::LONGEST).
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
    let Sound { channels, rate, spoilt } = sound(&mut *format, &mut *decoder, track, part)?;
    let count = channels.len();
    let chosen = match part.channel {
        Some(channel) => channel.checked_sub(1).and_then(|k| channels.into_iter().nth(k)),
        None => loudest(channels),
    };
    let Some(chosen) = chosen else {
        let expected = format!("one of its channels, 1 to {count}");
        let asked = part.channel.map_or("no sound".to_owned(), |k| format!("channel {k}"));
        return Err(Unreadable::sound(asked, expected));
    };
    let samples: Vec<f64> = chosen.into_iter().map(f64::from).collect();
    let recording = Recording::of(name, samples, rate)?;
    Ok(Recording { container, codec, channels: count, from: part.from, spoilt, ..recording })
}

/// Refuses the voice notes of messengers, with advice.
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
        [0xff, b, ..] if b & 0xf6 == 0xf0 => "aac",
        [b'I', b'D', b'3', ..] | [0xff, 0xe0..=0xff, ..] => "mp3",
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

struct Sound {
    channels: Vec<Vec<f32>>,
    rate: f64,
    spoilt: usize,
}

/// The samples of every channel in the part, and their rate. A damaged packet becomes silence of the length of the
/// packet before it; a file that ends before its sound counts as damaged too.
fn sound(
    format: &mut dyn FormatReader,
    decoder: &mut dyn AudioDecoder,
    track: u32,
    part: Part,
) -> Result<Sound, Unreadable> {
    let mut channels: Vec<Vec<f32>> = vec![];
    let (mut rate, mut passed, mut spoilt) = (0.0, 0, 0);
    let mut one: Vec<Vec<f32>> = vec![];
    while let Some(packet) = format.next_packet().unwrap_or_else(|_| {
        spoilt += 1;
        None
    }) {
        if packet.track_id != track {
            continue;
        }
        match decoder.decode(&packet) {
            Ok(decoded) => {
                let spec =
                    [f64::from(decoded.spec().rate()), decoded.spec().channels().count() as f64];
                if channels.is_empty() {
                    rate = spec[0];
                    channels = vec![vec![]; decoded.spec().channels().count()];
                    is_taken(channels.len(), rate)?;
                }
                if spec != [rate, channels.len() as f64] {
                    return Err(Unreadable::sound("sound that changes its rate or channels", READ));
                }
                decoded.copy_to_vecs_planar(&mut one);
            }
            Err(_) => {
                spoilt += 1;
                if channels.is_empty() {
                    continue;
                }
                one.iter_mut().for_each(|channel| channel.fill(0.0));
            }
        }
        let frames = one.first().map_or(0, Vec::len);
        let first = ((part.from * rate) as usize).saturating_sub(passed).min(frames);
        let end =
            part.to.map_or(frames, |to| ((to * rate) as usize).saturating_sub(passed).min(frames));
        passed += frames;
        if first < end {
            channels.iter_mut().zip(&one).for_each(|(all, new)| all.extend(&new[first..end]));
        }
        at_most(&channels, rate)?;
        if part.to.is_some_and(|to| passed as f64 >= to * rate) {
            break;
        }
    }
    if passed > 0 && channels.iter().all(Vec::is_empty) {
        let found = format!("{:.1} s of sound", passed as f64 / rate);
        return Err(Unreadable::sound(found, "--from within it, and --to after that"));
    }
    if channels.iter().all(Vec::is_empty) {
        return Err(Unreadable::sound("no sound in it", READ));
    }
    Ok(Sound { channels, rate, spoilt })
}

/// Refuses numbers of channels and rates beyond those that are listened to.
fn is_taken(channels: usize, rate: f64) -> Result<(), Unreadable> {
    if !(1..=MOST_CHANNELS).contains(&channels) {
        let expected = format!("1 to {MOST_CHANNELS}");
        return Err(Unreadable::sound(format!("{channels} channels"), expected));
    }
    is_rate(rate)
}

/// Refuses sound that is too long, or too much to hold.
fn at_most(channels: &[Vec<f32>], rate: f64) -> Result<(), Unreadable> {
    is_short(channels[0].len(), rate)?;
    if channels.iter().map(Vec::len).sum::<usize>() > MOST_SAMPLES {
        let expected = "fewer: take a part of it, as with --from and --to, or record at 48 kHz";
        return Err(Unreadable::sound(format!("more than {MOST_SAMPLES} samples"), expected));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of one second of a decaying tone, 16 bits.
    fn wav(channels: u16) -> Vec<u8> {
        let count = 8000;
        let bytes = 2 * u32::from(channels) * count;
        let mut out = b"RIFF".to_vec();
        out.extend((36 + bytes).to_le_bytes());
        out.extend(b"WAVEfmt \x10\0\0\0\x01\0");
        out.extend(channels.to_le_bytes());
        out.extend(8000_u32.to_le_bytes());
        out.extend((8000 * 2 * u32::from(channels)).to_le_bytes());
        out.extend((2 * channels).to_le_bytes());
        out.extend(b"\x10\0data");
        out.extend(bytes.to_le_bytes());
        for n in 0..count {
            let sound = (0.2 * f64::from(n)).sin() * (-f64::from(n) / 2000.0).exp();
            for channel in 1..=channels {
                out.extend(((8000.0 * f64::from(channel) * sound) as i16).to_le_bytes());
            }
        }
        out
    }

    #[test]
    fn the_louder_channel_the_part_and_the_channel_asked_for_are_taken() {
        let read = |part| decode("x.wav", wav(2), part).unwrap();
        let loud = read(Part::default());
        assert_eq!((loud.rate, loud.channels, loud.samples.len()), (8000.0, 2, 8000));
        let first = read(Part { channel: Some(1), ..Part::default() });
        assert!((loud.largest() / first.largest() - 2.0).abs() < 1e-3);
        let part = read(Part { from: 0.25, to: Some(0.75), channel: None });
        assert_eq!(part.samples[..], loud.samples[2000..6000]);
        let none = decode("x.wav", wav(2), Part { channel: Some(3), ..Part::default() });
        assert!(none.unwrap_err().to_string().contains("channel 3"));
    }

    /// Cut and spoilt files are read or refused, and never end the program.
    #[test]
    fn spoilt_files_are_read_or_refused() {
        let mut state = 9_u64;
        let mut next = |below: usize| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as usize % below
        };
        let files = [
            wav(1),
            include_bytes!("../../../fuzz/corpus/recording/taps.m4a").to_vec(),
            include_bytes!("../../../fuzz/corpus/recording/alac.m4a").to_vec(),
            include_bytes!("../../../fuzz/corpus/recording/taps.mp3").to_vec(),
            include_bytes!("../../../fuzz/corpus/recording/taps.flac").to_vec(),
            include_bytes!("../../../fuzz/corpus/recording/taps.ogg").to_vec(),
        ];
        for good in files {
            assert!(decode("x", good.clone(), Part::default()).is_ok());
            for _ in 0..500 {
                let mut bytes = good[..good.len() - next(good.len()) * (next(2))].to_vec();
                for _ in 0..=next(4) {
                    let room = if next(2) == 0 { bytes.len().min(60) } else { bytes.len() };
                    let at = next(room.max(1));
                    if let Some(byte) = bytes.get_mut(at) {
                        *byte = next(256) as u8;
                    }
                }
                if let Ok(read) = decode("x", bytes, Part::default()) {
                    assert!(!read.samples.is_empty() && read.samples.iter().all(|x| x.is_finite()));
                }
            }
        }
        for bytes in [&b""[..], b"OggS", b"ID3", b"fLaC", b"....ftypM4A ", b"\xff\xfb\x90\0"] {
            assert!(decode("x", bytes.to_vec(), Part::default()).is_err());
        }
    }

    /// An AAC packet that cannot be decoded is reported, and the following ones keep their time.
    #[test]
    fn spoilt_packets_are_silence_and_are_told() {
        let good = include_bytes!("../../../fuzz/corpus/recording/taps.m4a");
        let whole = decode("x", good.to_vec(), Part::default()).unwrap();
        assert_eq!(whole.spoilt, 0);
        let spoilt = |at: usize| {
            let mut bytes = good.to_vec();
            bytes[at..at + 12].fill(0xff);
            decode("x", bytes, Part::default()).ok()
        };
        let read: Vec<Recording> = (300..1200).step_by(20).filter_map(spoilt).collect();
        assert!(read.iter().any(|read| read.spoilt > 0));
        // A recording that lacks some of its sound reports that.
        let length = whole.samples.len();
        assert!(read.iter().all(|read| read.samples.len() == length || read.spoilt > 0));
    }

    #[test]
    fn voice_notes_are_refused_by_what_to_do() {
        for (bytes, codec) in [(&b"OggS....OpusHead"[..], "Opus"), (b"#!AMR\n....", "AMR")] {
            let told = decode("x.ogg", bytes.to_vec(), Part::default()).unwrap_err().to_string();
            assert!(told.contains(codec) && told.contains("recorder app"), "{told}");
        }
    }
}
