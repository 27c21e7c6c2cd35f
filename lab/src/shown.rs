//! How is a number shown? Its text is that of the program.

use serde_json::{Value, json};
use sweetspot::base::units::{inches, ounces};
use sweetspot::bat::body::Bat;
use sweetspot::modes::mode::Mode;
use sweetspot_report::parts::Quantity;
use sweetspot_report::parts::note::note;
use sweetspot_report::parts::units::Units;
use sweetspot_study::answers::Answer;

/// A number with its text.
pub fn shown(value: f64, text: String) -> Value {
    json!({ "value": value, "text": text })
}

/// An answer as `sweetspot analyze` shows it.
pub fn answer(answer: Answer, units: Units, value: f64) -> Value {
    shown(value, Quantity::of(answer).said(units, value))
}

/// A place on the bat, from the knob and from the tip.
pub fn place(bat: &Bat, units: Units, x: f64) -> Value {
    let text = |x| Quantity::Length.said(units, x);
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

/// The drop: ounces less inches.
pub fn drop(mass: f64, length: f64) -> Value {
    let drop = ounces(mass) - inches(length);
    shown(drop, format!("{drop:+.1}").replace('-', "−"))
}
