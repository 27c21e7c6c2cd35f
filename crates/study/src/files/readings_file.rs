//! What did somebody measure of a bat?
//!
//! [`from_text`] reads a `sweetspot-readings/1` file and tells all its mistakes at once.

use std::path::Path;

use crate::calibrate::labels::MOST_MODES;
use crate::calibrate::readings::{
    BatReadings, Pendulum, Priors, Reading, RingDown, ShearPrior, SpectralLine,
};
use crate::files::amounts::{reading, share};
use sweetspot::base::error::Result;
use sweetspot::base::mistakes::{self, Mistakes};
use sweetspot::base::units::Quantity;
use sweetspot::bat::body::STANDARD_PIVOT;
use sweetspot::files::document::Document;
use sweetspot::files::json_node::{Node, Object};

const KEYS: &[&str] = &[
    "format",
    "$schema",
    "name",
    "mass",
    "balance_point",
    "pendulum",
    "lines",
    "ring_down",
    "model",
    "priors",
];
const OF_PRIORS: &[&str] = &[
    "youngs_modulus",
    "shear_over_young",
    "shear_modulus",
    "density",
    "correlation",
    "youngs_modulus_ratio",
    "densities_together",
];
/// What a reading is within, where nobody says so: 1 g, 1 mm, 1 ms, 0.5 Hz.
const USUAL: [f64; 4] = [1e-3, 1e-3, 1e-3, 0.5];
/// What readings of bats lie between: mass (kg), balance point (m), period (s), frequency (Hz).
const RANGES: [[f64; 2]; 4] = [[0.1, 5.0], [0.05, 1.5], [0.3, 5.0], [10.0, 20e3]];

/// Reads a readings file.
///
/// # Errors
///
/// [`sweetspot::Error::Read`], or [`sweetspot::Error::Input`] with line and column, or several of them.
pub fn from_file(path: impl AsRef<Path>) -> Result<BatReadings> {
    from_document(&Document::read(path.as_ref())?)
}

/// Reads readings from text; `file` is what messages call it.
///
/// ```
/// use sweetspot_study::files::readings_file::from_text;
///
/// # fn main() -> sweetspot::Result<()> {
/// let text = r#"{ "format": "sweetspot-readings/1", "mass": "31.2 oz ± 1 g",
///     "lines": [ { "hz": 174.5, "within": 0.3, "mode": 1 } ] }"#;
/// assert_eq!(from_text("mine.json", text)?.lines[0].mode, Some(1));
/// # Ok(())
/// # }
/// ```
///
/// # Errors
///
/// As [`from_file`].
pub fn from_text(file: &str, text: &str) -> Result<BatReadings> {
    from_document(&Document::new(file.to_owned(), text))
}

fn from_document(document: &Document) -> Result<BatReadings> {
    let root = Node::root(document)?.members()?;
    root.check_format("sweetspot-readings/1")?;
    let mut mistakes = Mistakes::default();
    let root = root.only(KEYS, &mut mistakes);
    let format = "\"format\": \"sweetspot-readings/1\"";
    mistakes.note(root.require("format", format).map(|_| ()));
    mistakes.note(root.string("$schema"));
    mistakes.note(root.string("name"));
    let mut read = |key: &str, quantity, k: usize| {
        let node = root.get(key).map(|node| reading(node, quantity, USUAL[k], RANGES[k]));
        mistakes.note(node.transpose())
    };
    let mass = read("mass", Quantity::Mass, 0);
    let balance_point = read("balance_point", Quantity::Length, 1);
    let pendulum = mistakes.note(root.get("pendulum").map(pendulum).transpose());
    let lines = mistakes.note(listed(&root, "lines", line));
    let ring_down = mistakes.note(listed(&root, "ring_down", tone));
    let model = root.get("model").map_or(Ok(BatReadings::MODEL), share);
    let model = mistakes.note(model);
    let priors = mistakes.note(root.get("priors").map(priors).transpose()).unwrap_or_default();
    if let Some(node) = root.get("lines") {
        mistakes.note(each_mode_once(node, &lines));
    }
    let unlike = 0;
    mistakes.end(BatReadings {
        mass,
        balance_point,
        pendulum,
        lines,
        unlike,
        ring_down,
        model,
        priors,
    })
}

fn listed<T>(root: &Object, key: &str, one: impl Fn(&Node) -> Result<T>) -> Result<Vec<T>> {
    let Some(node) = root.get(key) else { return Ok(vec![]) };
    mistakes::all(node.items()?.iter().map(one))
}

fn pendulum(node: &Node) -> Result<Pendulum> {
    let mut mistakes = Mistakes::default();
    let object = node.object(&["pivot", "period"], &mut mistakes)?;
    let pivot =
        object.get("pivot").map_or(Ok(STANDARD_PIVOT), |node| node.quantity(Quantity::Length));
    let pivot = mistakes.note(pivot);
    let period = object
        .require("period", "\"period\" of a swing there and back, such as \"1.470 s ± 1 ms\"");
    let period = period.and_then(|node| reading(node, Quantity::Time, USUAL[2], RANGES[2]));
    mistakes.and(period.map(|period| Pendulum { pivot, period }))
}

fn line(node: &Node) -> Result<SpectralLine> {
    let mut mistakes = Mistakes::default();
    let object = node.object(&["hz", "within", "mode"], &mut mistakes)?;
    let mode = mistakes.note(object.get("mode").map(order).transpose());
    let frequency = object.require("hz", "\"hz\": the frequency of the line");
    let frequency =
        frequency.and_then(|node| reading(node, Quantity::Frequency, USUAL[3], RANGES[3]));
    let within = object.get("within").map(|node| {
        let value = node.quantity(Quantity::Frequency)?;
        let most = frequency.as_ref().map_or(f64::INFINITY, |line| line.value);
        match value > 0.0 && value < most {
            true => Ok(value),
            false => Err(node.error(node.shown(), "an uncertainty above 0 Hz and below the line")),
        }
    });
    let within = mistakes.note(within.transpose());
    mistakes.and(frequency.map(|frequency| {
        let deviation = within.unwrap_or(frequency.deviation);
        SpectralLine { frequency: Reading { deviation, ..frequency }, mode }
    }))
}

fn tone(node: &Node) -> Result<RingDown> {
    let mut mistakes = Mistakes::default();
    let object = node.object(&["mode", "cycles", "ratio"], &mut mistakes)?;
    let mode = mistakes
        .note(object.require("mode", "\"mode\": which bending mode died out").and_then(order));
    let within = |key: &str, expected: &str, [low, high]: [f64; 2]| {
        let node = object.require(key, expected)?;
        let value = node.number()?;
        match value > low && value < high {
            true => Ok(value),
            false => Err(node.error(node.shown(), expected)),
        }
    };
    let cycles = "\"cycles\" that were counted, more than 0 and below 100000";
    let ratio = "\"ratio\" of the amplitude after them to that before, between 0 and 1";
    let cycles = mistakes.note(within("cycles", cycles, [0.0, 1e5]));
    let ratio = within("ratio", ratio, [0.0, 1.0]);
    mistakes.and(ratio.map(|ratio| RingDown { mode, cycles, ratio }))
}

/// The number of a bending mode.
fn order(node: &Node) -> Result<usize> {
    let value = node.number()?;
    if value.fract() == 0.0 && (1.0..=MOST_MODES as f64).contains(&value) {
        Ok(value as usize)
    } else {
        let expected = format!("the number of a bending mode, 1 to {MOST_MODES}");
        Err(node.error(node.shown(), expected))
    }
}

fn each_mode_once(node: &Node, lines: &[SpectralLine]) -> Result<()> {
    let again =
        |k: usize| lines[k].mode.is_some() && lines[..k].iter().any(|l| l.mode == lines[k].mode);
    mistakes::all((0..lines.len()).filter(|k| again(*k)).map(|k| {
        let item = node.item(k);
        Err::<(), _>(item.error("a mode a second time", "every mode once"))
    }))
    .map(|_| ())
}

fn priors(node: &Node) -> Result<Priors> {
    let mut mistakes = Mistakes::default();
    let object = node.object(OF_PRIORS, &mut mistakes)?;
    let mut priors = Priors::default();
    for (key, slot) in [
        ("youngs_modulus", &mut priors.youngs_modulus),
        ("density", &mut priors.density),
        ("youngs_modulus_ratio", &mut priors.modulus_ratio),
    ] {
        if let Some(node) = object.get(key) {
            *slot = mistakes.some(share(node)).unwrap_or(*slot);
        }
    }
    for (key, slot) in [
        ("correlation", &mut priors.correlation),
        ("densities_together", &mut priors.densities_together),
    ] {
        if let Some(node) = object.get(key) {
            *slot = mistakes.some(correlation(node)).unwrap_or(*slot);
        }
    }
    mistakes.note(object.one_of(&["shear_over_young", "shear_modulus"]).map(|_| ()));
    if let Some(node) = object.get("shear_over_young") {
        priors.shear = ShearPrior::OverYoung(mistakes.some(share(node)).unwrap_or(0.35));
    } else if let Some(node) = object.get("shear_modulus") {
        priors.shear = ShearPrior::Alone(mistakes.some(share(node)).unwrap_or(0.35));
    }
    let possible =
        sweetspot::base::linear::inverse(&crate::calibrate::unknowns::covariance(&priors, 2));
    if possible.is_none() {
        let expected =
            "correlations that can be: of density in handle and barrel, and of both with E";
        mistakes.add(node.error("correlations that contradict each other", expected));
    }
    mistakes.end(priors)
}

/// A correlation.
fn correlation(node: &Node) -> Result<f64> {
    let value = node.number()?;
    match value.abs() < 1.0 {
        true => Ok(value),
        false => Err(node.error(node.shown(), "a number between -1 and 1")),
    }
}
