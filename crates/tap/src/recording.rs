//! A recording: sound as a row of samples, and where it came from.

/// The longest recording that is analysed (s).
pub const LONGEST: f64 = 120.0;
/// The largest file that is read (bytes).
pub const LARGEST: u64 = 50_000_000;
/// Sample rates that are accepted (1/s).
pub const RATES: [f64; 2] = [4000.0, 192_000.0];

/// Why a file or its samples cannot be analysed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Unreadable {
    /// The file cannot be opened.
    #[error("cannot be read: {0}")]
    File(#[from] std::io::Error),
    /// Its contents are not sound in a supported format.
    #[error("{found}; expected {expected}")]
    Sound {
        /// The finding.
        found: String,
        /// The expected contents, or advice.
        expected: String,
    },
}

impl Unreadable {
    /// The error of that finding.
    pub fn sound(found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self::Sound { found: found.into(), expected: expected.into() }
    }
}

/// A recording of taps.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Recording {
    /// The file's name.
    pub name: String,
    /// The file's kind, such as "m4a"; `None` for bare samples.
    pub container: Option<String>,
    /// Its codec, such as "AAC"; `None` for bare samples.
    pub codec: Option<String>,
    /// Samples per second.
    pub rate: f64,
    /// Number of channels in the file.
    pub channels: usize,
    /// Time of the first sample in the file (s).
    pub from: f64,
    /// Number of packets that cannot be decoded, which are replaced by silence.
    pub spoilt: usize,
    /// The samples of one channel; full scale is 1.
    pub samples: Vec<f64>,
}

/// The loudest of several channels, not their sum: two microphones 15 cm apart cancel above 1 kHz.
pub fn loudest(channels: Vec<Vec<f32>>) -> Option<Vec<f32>> {
    let power = |channel: &Vec<f32>| channel.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>();
    channels.into_iter().max_by(|a, b| power(a).total_cmp(&power(b)))
}

/// Refuses sample rates outside [`RATES`].
pub(crate) fn is_rate(rate: f64) -> Result<(), Unreadable> {
    if (RATES[0]..=RATES[1]).contains(&rate) {
        return Ok(());
    }
    let expected = format!("{} to {} samples a second", RATES[0], RATES[1]);
    Err(Unreadable::sound(format!("a rate of {rate} 1/s"), expected))
}

/// Refuses more samples than [`LONGEST`].
pub(crate) fn is_short(samples: usize, rate: f64) -> Result<(), Unreadable> {
    if samples as f64 <= LONGEST * rate {
        return Ok(());
    }
    let found = format!("more than {LONGEST} s of sound");
    Err(Unreadable::sound(
        found,
        format!("at most {LONGEST} s: take a part of it, as with --from and --to"),
    ))
}

impl Recording {
    /// Bare samples at that rate (1/s).
    ///
    /// # Errors
    ///
    /// [`Unreadable::Sound`] for samples that are not numbers, more than [`LONGEST`] or a rate beyond [`RATES`].
    pub fn of(name: &str, samples: Vec<f64>, rate: f64) -> Result<Self, Unreadable> {
        is_rate(rate)?;
        if let Some(k) = samples.iter().position(|x| !x.is_finite()) {
            return Err(Unreadable::sound(format!("sample {k} is {}", samples[k]), "numbers"));
        }
        is_short(samples.len(), rate)?;
        Ok(Self { name: name.to_owned(), rate, channels: 1, samples, ..Self::default() })
    }

    /// How long it is (s).
    pub fn seconds(&self) -> f64 {
        self.samples.len() as f64 / self.rate
    }

    /// The largest sample, without its sign.
    pub fn largest(&self) -> f64 {
        self.samples.iter().fold(0.0_f64, |most, x| most.max(x.abs()))
    }

    /// The share of samples above 0.9 of the largest among those above half of it: 0.02 to 0.04 for taps, and more if
    /// they are clipped, with any codec.
    pub fn clipped_share(&self) -> f64 {
        let largest = self.largest();
        let above =
            |share: f64| self.samples.iter().filter(|x| x.abs() > share * largest).count() as f64;
        if largest > 0.0 { above(0.9) / above(0.5) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_sound_is_refused_by_name() {
        let told = |samples: Vec<f64>, rate| Recording::of("x", samples, rate).unwrap_err();
        assert!(told(vec![0.0, f64::NAN], 8000.0).to_string().contains("sample 1 is NaN"));
        assert!(told(vec![0.0], 0.0).to_string().contains("a rate of 0"));
        assert!(told(vec![0.0; 4000 * 121], 4000.0).to_string().contains("more than 120 s"));
    }

    /// In a sine, the share `arccos(0.9)/arccos(0.5)` of the samples above half is above 0.9; in a clipped one the
    /// share is larger.
    #[test]
    fn a_cut_top_is_seen() {
        let sine = |cut: f64| {
            let wave = (0..10_000).map(|n| (n as f64 * 0.01).sin().clamp(-cut, cut)).collect();
            Recording::of("x", wave, 8000.0).unwrap().clipped_share()
        };
        assert!((sine(1.0) - 0.9_f64.acos() / 0.5_f64.acos()).abs() < 2e-3);
        assert!(sine(0.5) > 0.8);
    }
}
