//! Sound as a WAV file: one channel of 16-bit samples, which every player reads.
//!
//! # Source
//!
//! IBM and Microsoft, "Multimedia Programming Interface and Data Specifications 1.0" (1991), the WAVE
//! form of RIFF: chunks "fmt " and "data", numbers from the lowest byte up.

/// Samples in a second of every file.
pub const RATE: u32 = 44_100;

/// The largest sample, 1 dB below full scale so that no player clips it.
const LARGEST: f64 = 0.89 * i16::MAX as f64;

/// A file of samples from −1 to 1, [`RATE`] per second; larger ones are clipped.
pub fn file(samples: &[f64]) -> Vec<u8> {
    const BYTES: u32 = 2;
    let length = BYTES * samples.len() as u32;
    let mut out = vec![];
    let number = |out: &mut Vec<u8>, value: u32| out.extend(value.to_le_bytes());
    out.extend(b"RIFF");
    number(&mut out, 36 + length);
    out.extend(b"WAVEfmt ");
    number(&mut out, 16);
    // Plain numbers (1), one channel (1).
    out.extend([1, 0, 1, 0]);
    number(&mut out, RATE);
    number(&mut out, RATE * BYTES);
    // Bytes of a sample, bits of a sample.
    out.extend([BYTES as u8, 0, 16, 0]);
    out.extend(b"data");
    number(&mut out, length);
    for sample in samples {
        let sample = (LARGEST * sample.clamp(-1.0, 1.0)).round() as i16;
        out.extend(sample.to_le_bytes());
    }
    out
}
