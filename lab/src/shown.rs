//! What is said of a number: its text is the program's.

use serde_json::{Value, json};
use sweetspot::base::units::{inches, ounces};
use sweetspot::bat::body::Bat;
use sweetspot::modes::mode::Mode;
use sweetspot_report::parts::units::Units;
use sweetspot_report::report::answer_unit::AnswerUnit;
use sweetspot_study::answers::Answer;

/// A number with its text.
pub fn shown(value: f64, text: String) -> Value {
    json!({ "value": value, "text": text })
}

/// An answer as `sweetspot analyze` shows it.
pub fn answer(answer: Answer, units: Units, value: f64) -> Value {
    shown(value, AnswerUnit::of(answer).shown(units, value))
}

/// A place on the bat, from the knob and from the tip.
pub fn place(bat: &Bat, units: Units, x: f64) -> Value {
    let text = |x| AnswerUnit::Length.shown(units, x);
    json!({ "x_m": x, "text": text(x), "from_tip": text(bat.length() - x) })
}

/// A mode in three lines: frequency, the note it is nearest to, nodes.
pub fn mode(bat: &Bat, units: Units, mode: &Mode) -> Value {
    let nodes: Vec<Value> = mode.nodes.iter().map(|x| place(bat, units, *x)).collect();
    json!({
        "order": mode.order,
        "frequency": answer(Answer::Frequency(mode.order), units, mode.frequency()),
        "note": note(mode.frequency()),
        "nodes": nodes,
    })
}

/// The nearest note of the tempered scale (A4 is 440 Hz), and how many cents the frequency (Hz) is above it: "F3 +12".
pub fn note(frequency: f64) -> String {
    const NAMES: [&str; 12] = ["C", "C♯", "D", "D♯", "E", "F", "F♯", "G", "G♯", "A", "A♯", "B"];
    // Half tones above C of octave 0, which is 57 below A4.
    let above = 57.0 + 12.0 * (frequency / 440.0).log2();
    let nearest = above.round();
    if !(0.0..120.0).contains(&nearest) {
        return String::new();
    }
    let name = NAMES[nearest as usize % NAMES.len()];
    format!("{name}{} {:+.0}", (nearest / 12.0).floor(), 100.0 * (above - nearest) + 0.0)
}

/// The drop: ounces less inches.
pub fn drop(mass: f64, length: f64) -> Value {
    let drop = ounces(mass) - inches(length);
    shown(drop, format!("{drop:+.1}").replace('-', "−"))
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
}
