//! Reads a `sweetspot-modes/1` file that `sweetspot modes BAT --json FILE` wrote.

use std::path::Path;

use serde::Deserialize;
use serde_json::value::RawValue;

use sweetspot::files::document::Document;
use sweetspot::files::json_node::{Node, Object};
use sweetspot::{Bat, Result};

/// The modes of a bat, sampled along it.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeTable {
    /// The resolved bat in the file.
    pub bat: Bat,
    /// Version of the program that computed the modes; empty where the file does not give it.
    pub version: String,
    /// The places of the samples, rising (m).
    pub x: Vec<f64>,
    /// One at least, in the order of the file.
    pub modes: Vec<SampledMode>,
}

/// A mode at the places of its table.
#[derive(Debug, Clone, PartialEq)]
pub struct SampledMode {
    /// Number of the mode: 1 for the first elastic mode.
    pub order: u32,
    /// Frequency (Hz).
    pub frequency: f64,
    /// Share of critical damping; 0 without damping.
    pub damping_ratio: f64,
    /// Modal mass of the shape with this scale (kg).
    pub modal_mass: f64,
    /// Nodes, where the deflection is 0 (m).
    pub nodes: Vec<f64>,
    /// Deflections, the largest of the whole shape 1.
    pub deflection: Vec<f64>,
    /// Rotations of the sections (rad per m of deflection).
    pub rotation: Vec<f64>,
}

impl ModeTable {
    /// Outer and inner radius (m) at every place; at a step those to its right, except at the tip.
    pub fn radii(&self) -> [Vec<f64>; 2] {
        let sections = || self.x.iter().map(|x| self.bat.profile().at(*x));
        [sections().map(|s| s.outer).collect(), sections().map(|s| s.inner).collect()]
    }
}

/// Reads a modes file. Unknown members are ignored, because a later version may add some.
///
/// # Errors
///
/// [`sweetspot::base::error::Error::Read`] if there is no such file, [`sweetspot::base::error::Error::Input`] with line
/// and column for another format or major version, for anything missing or impossible, and for a
/// file without modes or without samples of their shapes.
pub fn read(path: &Path) -> Result<ModeTable> {
    parse(&Document::read(path)?)
}

/// Reads the text of a modes file; `file` is its name in messages.
///
/// # Errors
///
/// As [`read`].
pub fn from_text(file: &str, text: &str) -> Result<ModeTable> {
    parse(&Document::new(file.to_owned(), text))
}

fn parse(document: &Document) -> Result<ModeTable> {
    let root = Node::root(document)?.members()?;
    check_format(&root)?;
    root.require("bat", "\"bat\": the bat these modes are of")?;
    let bat = bat(document)?;
    let list = root.require("modes", "\"modes\": a list of modes")?;
    let items = list.items()?;
    if items.is_empty() {
        return Err(list.error("no modes", "one at least: sweetspot modes BAT -n 10 --json FILE"));
    }
    let mut x: Option<Vec<f64>> = None;
    let mut modes: Vec<SampledMode> = Vec::new();
    for item in &items {
        let members = item.members()?;
        let shape = members.require("shape", "\"shape\": samples of the mode's shape")?;
        let places = places(shape, bat.length())?;
        match &x {
            None => x = Some(places),
            Some(first) if *first == places => {}
            Some(_) => {
                let expected = "the same places in every mode";
                return Err(shape.error("places other than those of the modes before", expected));
            }
        }
        let count = x.as_ref().map_or(0, Vec::len);
        let mode = mode(&members, &shape.members()?, count, bat.length())?;
        if let Some(before) = modes.last().filter(|before| before.order >= mode.order) {
            let expected = format!("modes in rising order, after {} a higher one", before.order);
            return Err(item.error(format!("mode {}", mode.order), expected));
        }
        modes.push(mode);
    }
    let generator = root.get("generator").and_then(|node| node.members().ok());
    let version = generator.and_then(|members| members.string("version").ok().flatten());
    let version = version.unwrap_or_default();
    Ok(ModeTable { bat, version, x: x.unwrap_or_default(), modes })
}

fn check_format(root: &Object) -> Result<()> {
    const FORMAT: &str = "sweetspot-modes/1";
    let expected = "\"sweetspot-modes/1\", as sweetspot modes BAT --json FILE writes it";
    let format = root.require("format", &format!("\"format\": \"{FORMAT}\""))?;
    match format.string() {
        Ok(word) if word == FORMAT => Ok(()),
        Ok(word) if word.starts_with("sweetspot-modes/") => {
            let found = format!("{}, another version of the format", format.shown());
            Err(format.error(found, "\"sweetspot-modes/1\", the one that this program reads"))
        }
        _ => Err(format.error(format.shown(), expected)),
    }
}

/// The resolved bat, which is a complete bat file.
fn bat(document: &Document) -> Result<Bat> {
    #[derive(Deserialize)]
    struct Whole<'a> {
        #[serde(borrow)]
        bat: &'a RawValue,
    }
    let whole: Whole = serde_json::from_str(&document.text).expect("its members were read before");
    let raw = whole.bat.get();
    // Both are slices of the same text, so the difference of addresses is the offset.
    let start = raw.as_ptr() as usize - document.text.as_ptr() as usize;
    // With everything before it blank, a mistake is reported at its place in the whole file.
    let blank = |c: char| if c == '\n' { '\n' } else { ' ' };
    let text: String = document.text[..start].chars().map(blank).chain(raw.chars()).collect();
    Bat::from_text(&document.file, &text, Path::new(""))
}

fn places(shape: &Node, length: f64) -> Result<Vec<f64>> {
    let members = shape.members()?;
    let node = members.require("x_m", "\"x_m\": places along the bat in m")?;
    let x = numbers(node)?;
    if x.len() < 2 {
        let expected = "two at least: make the file again, with --shape-points 101 or nodes";
        return Err(node.error(format!("{} places", x.len()), expected));
    }
    for (k, place) in x.iter().enumerate() {
        if k > 0 && *place <= x[k - 1] {
            let expected = format!("rising places, more than {:?}", x[k - 1]);
            return Err(node.item(k).error(format!("{place:?}"), expected));
        }
        // The last place is the length but for round-off.
        if !(0.0..=length * (1.0 + 1e-12)).contains(place) {
            let expected = format!("a place on the bat, 0 to {length:?}");
            return Err(node.item(k).error(format!("{place:?}"), expected));
        }
    }
    Ok(x)
}

fn numbers(node: &Node) -> Result<Vec<f64>> {
    node.items()?.iter().map(Node::number).collect()
}

fn mode(mode: &Object, shape: &Object, count: usize, length: f64) -> Result<SampledMode> {
    let number = |key: &str, least: f64| {
        let node = mode.require(key, &format!("\"{key}\": a number"))?;
        let value = node.number()?;
        if value < least {
            return Err(node.error(node.shown(), format!("{least} or more")));
        }
        Ok(value)
    };
    let samples = |key: &str| {
        let node = shape.require(key, &format!("\"{key}\": a number at every place"))?;
        let values = numbers(node)?;
        if values.len() != count {
            let found = format!("{} numbers", values.len());
            return Err(node.error(found, format!("{count}, one for each x_m")));
        }
        Ok(values)
    };
    let order = mode.require("order", "\"order\": 1 for the first bending mode")?;
    let whole = order.number().ok().filter(|n| n.fract() == 0.0 && (1.0..1e6).contains(n));
    let whole = whole.ok_or_else(|| order.error(order.shown(), "a whole number from 1"))?;
    let nodes = mode.require("nodes_m", "\"nodes_m\": where the deflection is 0")?;
    let zeros = numbers(nodes)?;
    if let Some(k) = zeros.iter().position(|x| !(0.0..=length).contains(x)) {
        let expected = format!("a place on the bat, 0 to {length:?}");
        return Err(nodes.item(k).error(format!("{:?}", zeros[k]), expected));
    }
    Ok(SampledMode {
        order: whole as u32,
        frequency: number("frequency_hz", 0.0)?,
        damping_ratio: number("damping_ratio", 0.0)?,
        modal_mass: number("modal_mass_kg", 0.0)?,
        nodes: zeros,
        deflection: samples("deflection")?,
        rotation: samples("rotation")?,
    })
}
