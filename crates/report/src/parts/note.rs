//! Frequencies as musicians say them: notes of the tempered scale (A4 is 440 Hz) and cents.

const NAMES: [&str; 12] = ["C", "C♯", "D", "D♯", "E", "F", "F♯", "G", "G♯", "A", "A♯", "B"];
/// Half tones from C of octave 0 to A4.
const TO_A4: f64 = 57.0;

/// The nearest note, and how many cents the frequency (Hz) is above it: "F3 +12".
pub fn note(frequency: f64) -> String {
    let above = TO_A4 + 12.0 * (frequency / 440.0).log2();
    let nearest = above.round();
    if !(0.0..120.0).contains(&nearest) {
        return String::new();
    }
    let name = NAMES[nearest as usize % NAMES.len()];
    format!("{name}{} {:+.0}", (nearest / 12.0).floor(), 100.0 * (above - nearest) + 0.0)
}

/// The frequency (Hz) of a note as a tuner shows it: "E3 +34", "F#3 -12 cents", "Bb2"; None for other texts.
pub fn frequency(text: &str) -> Option<f64> {
    let plain = text.trim().replace(['−', '–'], "-").replace('♯', "#").replace('♭', "b");
    let letter = plain.chars().next()?.to_ascii_uppercase().to_string();
    let natural = NAMES.iter().position(|name| *name == letter)? as f64;
    let rest = &plain[1..];
    let (sign, rest) = match rest.as_bytes().first()? {
        b'#' => (1.0, &rest[1..]),
        b'b' => (-1.0, &rest[1..]),
        _ => (0.0, rest),
    };
    let (octave, cents) = rest.split_at_checked(1)?;
    let octave = f64::from(octave.parse::<u8>().ok()?);
    let cents = cents.trim_end_matches("cents").trim_end_matches("cent").trim_end_matches('c');
    let signed: String = cents.split_whitespace().collect();
    let cents: f64 = match signed.as_bytes().first() {
        None => 0.0,
        Some(b'+' | b'-') => signed.parse().ok()?,
        Some(_) => return None,
    };
    let above = 12.0 * octave + natural + sign + 0.01 * cents - TO_A4;
    (cents.abs() <= 100.0).then(|| 440.0 * (above / 12.0).exp2())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_are_those_of_the_tempered_scale() {
        assert_eq!(note(440.0), "A4 +0");
        assert_eq!(note(261.625_565_300_598_6), "C4 +0");
        assert_eq!(note(174.614 * 1.01), "F3 +17");
        assert_eq!(note(27.5), "A0 +0");
        assert_eq!([note(0.0), note(f64::INFINITY)], ["", ""]);
    }

    #[test]
    fn a_tuners_reading_is_a_frequency() {
        let near = |text: &str, hz: f64| {
            let found = frequency(text).unwrap_or_else(|| panic!("{text} is no note"));
            assert!((found / hz - 1.0).abs() < 1e-9, "{text}: {found}");
        };
        near("A4", 440.0);
        near("a4 +100", 440.0 * 2.0_f64.powf(1.0 / 12.0));
        near("C4", 261.625_565_300_598_6);
        near("Bb3 - 50 cents", 440.0 * 2.0_f64.powf(-11.5 / 12.0));
        near("A♯3−50c", 440.0 * 2.0_f64.powf(-11.5 / 12.0));
        near("E3 +34", 440.0 * 2.0_f64.powf((-17.0 + 0.34) / 12.0));
        for hz in [61.3, 174.5, 4000.0] {
            assert!((1200.0 * (frequency(&note(hz)).unwrap() / hz).log2()).abs() < 0.5001);
        }
        for text in ["", "H3", "E", "E33", "E3 34", "E3 +134", "170", "é3", "E3 +NaN", "E+3"] {
            assert_eq!(frequency(text), None, "{text}");
        }
    }
}
