//! A measured frequency response from a universal file: dataset 58, its places from the nodes.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::path::Path;

use faer::c64;

use crate::engine::{Error, INCH, POUND_FORCE, Quantity, ResponseKind, Result, dot, factor, file};
use crate::files::measured::coherence;
use crate::files::measured::direction::{Vector, axis};
use crate::files::measured::places::Places;
use crate::measured::response::MeasuredResponse;
use uff58::{Dof, Function, Units, Universal, Values, at_line};

/// Standard gravity (m/s²): some programs call their accelerations `g` and mean it.
const GRAVITY: f64 = 9.80665;
/// Number of a frequency response among the functions of dataset 58.
const RESPONSE: i64 = 4;
/// Number of a record in time.
const RECORD: i64 = 1;
/// The message about a response that was turned over.
pub const TURNED: &str =
    "the phase rises through the peaks, as with time as e^(-iwt): it is turned over";
/// Kinds of data of an axis: frequency; displacement, velocity, acceleration; forces.
const FREQUENCY: i64 = 18;
const ANSWERS: [(i64, ResponseKind); 3] =
    [(8, ResponseKind::Receptance), (11, ResponseKind::Mobility), (12, ResponseKind::Accelerance)];
const FORCES: [i64; 2] = [9, 13];

/// Facts that a file of responses does not contain.
#[derive(Debug, Clone, Default)]
pub struct Known {
    /// Number of the chosen response, from 1; `None` for all.
    pub which: Option<usize>,
    /// Its units, for axes without units in a file without dataset 164; by default SI.
    pub unit: Option<Units>,
    /// The unit of the answers, with that of the force, as axes name them: `g/lbf`.
    pub label: Option<String>,
    /// The kind of a response whose axis does not name it.
    pub kind: Option<ResponseKind>,
    /// Positions of the nodes of a file without geometry.
    pub places: Option<Places>,
    /// Whether the positions of the force and of the response are given beside the file.
    pub told: [bool; 2],
}

/// Reads the frequency responses of a universal file, each with its number, from 1.
///
/// # Errors
///
/// [`Error::Read`], those of [`uff58::parse`]; [`Error::Value`] for a file without a response, and for
/// places beside a file that has nodes; [`Error::Input`] with the line for a response that is not of a
/// motion per force over frequency, that is not along one direction, or whose units are not known.
pub fn read(path: &Path, known: &Known) -> Result<Vec<(usize, MeasuredResponse)>> {
    let name = path.display().to_string();
    let bytes = file::read(path)?;
    let universal = uff58::parse_in(&name, &bytes, known.unit.as_ref())?;
    let nodes = nodes(&universal, &name, known.places.as_ref())?;
    let file = ResponseFile { name, bytes, universal: &universal, nodes, known };
    let chosen = chosen(&universal, &file.name, known.which)?;
    chosen.into_iter().map(|(n, k, function)| Ok((n, file.response(k, function)?))).collect()
}

/// A file, and the additional facts about it.
struct ResponseFile<'a> {
    name: String,
    bytes: Vec<u8>,
    universal: &'a Universal,
    nodes: BTreeMap<i64, Vector>,
    known: &'a Known,
}

impl ResponseFile<'_> {
    /// The response in dataset k.
    fn response(&self, k: usize, function: &Function) -> Result<MeasuredResponse> {
        let first = self.universal.lines.get(k).copied().unwrap_or(1);
        let wrong = |record: usize, found: String, expected: &str| {
            at_line(&self.name, &self.bytes, first + record, found, expected)
        };
        let (kind, sign) = meaning(function, self.known.kind, &wrong)?;
        let (units, mut assumed) = self.units(function, kind, &wrong)?;
        if sign < 0.0 {
            assumed
                .push("force and answer are along opposite directions: the sign is turned".into());
        }
        let hertz = frequency_unit(function, &wrong)?;
        let (mut values, dropped) = values(function, [hertz, sign * units], &wrong)?;
        if hertz != 1.0 {
            let unit = &function.axes[0].unit;
            assumed.push(format!("frequencies are taken in {unit}, as their axis is named"));
        }
        let turned = turns_back(&values);
        if turned {
            values.iter_mut().for_each(|(_, value)| *value = value.conj());
            assumed.push(TURNED.into());
        }
        if dropped > 0 {
            assumed.push(format!("{dropped} values at 0 Hz are left out"));
        }
        let [at, to] = self.places([&function.reference, &function.response]);
        let taken =
            [at, to].into_iter().zip(self.known.told).any(|(place, told)| place.is_some() && !told);
        if taken && self.known.places.is_none() {
            assumed.push("the nodes' places are taken from the knob end".to_owned());
        }
        let nodes = [function.reference.node, function.response.node];
        let source = self.name.clone();
        let coherence = coherence::of(self.universal, function, dropped);
        Ok(MeasuredResponse { source, kind, at, to, nodes, coherence, turned, values, assumed })
    }

    /// The factor to SI of a response per force, and a message about it. Record 9 has the response's unit.
    fn units(
        &self,
        function: &Function,
        kind: ResponseKind,
        wrong: &impl Fn(usize, String, &str) -> Error,
    ) -> Result<(f64, Vec<String>)> {
        let mut labels = AxisUnits::of(function, kind);
        let named = [1, 2].map(|k| &*function.axes[k].unit);
        if self.universal.names_units() {
            return Ok((1.0, Vec::from_iter(self.contradiction(&labels, named)?)));
        }
        let mut assumed = vec![];
        if let Some(text) = self.known.label.as_deref() {
            labels = AxisUnits::read(text, "", kind);
            if labels.answer.is_none() || labels.force.is_none() {
                let expected = format!("a unit of {} such as {}", kind.name(), example(kind));
                return Err(Error::value("--unit", text, expected));
            }
        } else if labels.torn {
            let said =
                "the answer's axis names another unit of force than the force's: its own is taken";
            assumed.push(said.to_owned());
        }
        let told = self.known.label.is_some();
        if !told && self.known.unit.is_none() {
            let factors = [labels.answer, labels.force];
            for (record, (label, factor)) in (9..).zip(named.into_iter().zip(factors)) {
                if factor.is_none() && !plain(label).is_empty() {
                    let found = format!("the unit \"{label}\"");
                    let expected = format!("one such as {}, or --unit", example(kind));
                    return Err(wrong(record, found, &expected));
                }
            }
        }
        let given = self.known.unit.clone().unwrap_or_else(Units::si);
        let mut factor = 1.0;
        if let Some(answer) = labels.answer {
            factor *= answer * given.length;
        }
        if let Some(force) = labels.force {
            factor /= force * given.force;
        }
        let by = if told { "as was told" } else { "as their axes are named" };
        assumed.extend(labels.words(kind).map(|words| format!("{words}, {by}")));
        if labels.answer.is_none() && self.known.unit.is_none() {
            assumed.push("the file names no units (no dataset 164): they are taken as SI".into());
        }
        Ok((factor, assumed))
    }

    /// A message if the units of axes with these names contradict the file's own.
    fn contradiction(&self, labels: &AxisUnits, named: [&str; 2]) -> Result<Option<String>> {
        if self.known.label.is_some() {
            let expected = "no unit given beside it";
            return Err(Error::value(&self.name, "its own units, in a dataset 164", expected));
        }
        let own_units = self.universal.converted_from.clone().unwrap_or_else(Units::si);
        let differ =
            |label: Option<f64>, own: f64| label.is_some_and(|l| (l * own - 1.0).abs() > 1e-3);
        let [own, below] = named;
        let contradicts = differ(labels.answer, own_units.length)
            || differ(labels.force, own_units.force)
            || labels.answer.is_none() && !plain(own).is_empty()
            || labels.torn;
        Ok(contradicts.then(|| {
            format!(
                "the axes are named {own} and {below}, which contradicts the units in dataset 164; those of \
                 dataset 164 are taken"
            )
        }))
    }

    /// Positions of these degrees of freedom along the bat's axis, the direction in which the file's nodes are farthest
    /// apart; `None` if a node has no position.
    fn places(&self, dofs: [&Dof; 2]) -> [Option<f64>; 2] {
        let all: Vec<Vector> = self.nodes.values().copied().collect();
        let along =
            if all.iter().any(|at| Some(at) != all.first()) { axis(&all) } else { [1.0, 0.0, 0.0] };
        dofs.map(|dof| self.nodes.get(&dof.node).map(|at| dot(at, &along)))
    }
}

/// The positions of the nodes, or those given for a file without.
fn nodes(
    universal: &Universal,
    file: &str,
    places: Option<&Places>,
) -> Result<BTreeMap<i64, Vector>> {
    let nodes: BTreeMap<i64, Vector> =
        universal.nodes().map(|node| (node.label, node.at)).collect();
    let Some(places) = places else { return Ok(nodes) };
    if nodes.is_empty() {
        return Ok(places.iter().map(|(node, x)| (*node, [*x, 0.0, 0.0])).collect());
    }
    let expected = "no places beside them, or a file without";
    Err(Error::value(file, format!("{} nodes with places", nodes.len()), expected))
}

/// Whether the response runs anticlockwise in the complex plane through its highest peak: with time as e^(+iωt) every
/// resonance runs clockwise, whatever its sign. The area swept around 0 is twice `Σ Im(H̄ₖ Hₖ₊₁)`. It is taken where
/// the response is at least half as high as the peak, since an antiresonance runs the other way. A response without a
/// peak in its range gives no information.
fn turns_back(values: &[(f64, c64)]) -> bool {
    const CLEAR: f64 = 1e-3;
    let size = |k: usize| values[k].1.norm();
    let tops = (1..values.len().saturating_sub(1))
        .filter(|k| size(*k) > size(k - 1) && size(*k) > size(k + 1));
    let Some(top) = tops.max_by(|a, b| size(*a).total_cmp(&size(*b))) else { return false };
    let high = |k: &usize| size(*k) >= 0.5 * size(top);
    let from = (0..top).rev().take_while(high).last().unwrap_or(top);
    let to = (top + 1..values.len()).take_while(high).last().unwrap_or(top);
    let pairs = || values[from..=to].windows(2).map(|pair| pair[0].1.conj() * pair[1].1);
    let swept: f64 = pairs().map(|product| product.im).sum();
    let all: f64 = pairs().map(|product| product.norm()).sum();
    swept > CLEAR * all
}

/// The factors to SI of the units named by the axes.
struct AxisUnits {
    answer: Option<f64>,
    force: Option<f64>,
    /// Whether the answer's axis has another unit of force than the force's own.
    torn: bool,
}

impl AxisUnits {
    fn of(function: &Function, kind: ResponseKind) -> Self {
        Self::read(&function.axes[1].unit, &function.axes[2].unit, kind)
    }

    fn read(own: &str, below: &str, kind: ResponseKind) -> Self {
        let [own, below] = [own, below].map(plain);
        let force = force_unit(&below);
        if let Some(answer) = answer_unit(&own, kind) {
            return Self { answer: Some(answer), force, torn: false };
        }
        if own == "1/kg" && kind == ResponseKind::Accelerance {
            return Self { answer: Some(1.0), force: Some(1.0), torn: false };
        }
        // The whole unit on one axis, the force at any place below a line: g/lbf, m/s2/N, 1/N*m/s2, m/Ns2.
        let parts = |sign: &str| -> Vec<String> { own.split(sign).map(str::to_owned).collect() };
        let slashed = parts("/");
        let whole = (1..slashed.len()).find_map(|k| {
            let force = force_unit(&slashed[k])?;
            let others: Vec<&str> =
                (0..slashed.len()).filter(|j| *j != k).map(|j| &*slashed[j]).collect();
            Some((answer_unit(&others.join("/"), kind)?, force))
        });
        // 1/N times the answer's unit.
        let times = || {
            let rest = own.strip_prefix("1/")?;
            let at = (1..rest.len()).filter(|at| rest.is_char_boundary(*at));
            at.map(|at| rest.split_at(at))
                .find_map(|(per, answer)| Some((answer_unit(answer, kind)?, force_unit(per)?)))
        };
        // Both below one line.
        let below_one = || {
            let (answer, rest) = own.split_once('/')?;
            let seconds = ["s2", "s"].into_iter().find(|seconds| rest.ends_with(seconds))?;
            let force = force_unit(&rest[..rest.len() - seconds.len()])?;
            Some((answer_unit(&format!("{answer}/{seconds}"), kind)?, force))
        };
        match whole.or_else(times).or_else(below_one) {
            Some((answer, per)) => {
                let torn = force.is_some_and(|force| (force / per - 1.0).abs() > 1e-3);
                Self { answer: Some(answer), force: Some(per), torn }
            }
            None => Self { answer: None, force, torn: false },
        }
    }

    /// A message about units other than SI.
    fn words(&self, kind: ResponseKind) -> Option<String> {
        let said = match (kind, self.answer) {
            (ResponseKind::Accelerance, Some(f)) if f == GRAVITY => {
                "accelerations are taken in g".to_owned()
            }
            (_, Some(f)) if f != 1.0 => {
                let unit = ["m", "m/s", "m/s²"][kind as usize];
                format!("answers are taken in units of {f} {unit}")
            }
            _ if self.force.is_some_and(|f| f != 1.0) => "answers are taken in SI".to_owned(),
            _ => return None,
        };
        let force = self.force.filter(|f| *f != 1.0);
        let force = force.map_or(String::new(), |f| format!(", forces in units of {f:.5} N"));
        Some(format!("{said}{force}"))
    }
}

/// A unit without the signs that programs differ in: `(m/s²)`, `m/sec^2`, `m s-2` and `m/s**2` are `m/s2`.
fn plain(unit: &str) -> String {
    let unit = unit.to_lowercase().replace('\u{b2}', "2").replace("sec", "s");
    let unit = unit.replace(['\u{b5}', '\u{3bc}'], "u").replace('\u{2212}', "-");
    let unit: String = unit.chars().filter(|c| !"^*()[]'\u{b7}. ".contains(*c)).collect();
    unit.replace("s-2", "/s2").replace("s-1", "/s").replace("n-1", "/n").replace("//", "/")
}

/// The usual notation of the unit of a response per force.
fn example(kind: ResponseKind) -> &'static str {
    match kind {
        ResponseKind::Receptance => "m/N or in/lbf",
        ResponseKind::Mobility => "(m/s)/N or (in/s)/lbf",
        ResponseKind::Accelerance => "(m/s^2)/N or g/lbf",
    }
}

fn answer_unit(unit: &str, kind: ResponseKind) -> Option<f64> {
    let gravity = ["g", "gs", "gn", "g0", "g_n", "gee", "grav"].contains(&unit);
    if kind == ResponseKind::Accelerance && gravity {
        return Some(GRAVITY);
    }
    let length = match (kind, unit) {
        (ResponseKind::Mobility, "ips") => "in",
        (ResponseKind::Mobility, "fps") => "ft",
        (ResponseKind::Accelerance, "ips2") => "in",
        (ResponseKind::Accelerance, "fps2") => "ft",
        (ResponseKind::Accelerance, "gal") => "cm",
        (ResponseKind::Receptance, unit) => unit,
        (ResponseKind::Mobility, unit) => unit.strip_suffix("/s")?,
        (ResponseKind::Accelerance, unit) => {
            unit.strip_suffix("/s2").or_else(|| unit.strip_suffix("/s/s"))?
        }
    };
    match length {
        "mil" | "mils" => Some(1e-3 * INCH),
        length => factor(length, Quantity::Length).ok(),
    }
}

fn force_unit(unit: &str) -> Option<f64> {
    match unit {
        "n" | "newton" | "newtons" => Some(1.0),
        "kn" => Some(1e3),
        "lb" | "lbs" | "lbsf" | "pound" | "pounds" => Some(POUND_FORCE),
        "kip" | "kips" => Some(1e3 * POUND_FORCE),
        "dyn" | "dyne" => Some(1e-5),
        unit => factor(unit, Quantity::Force).ok(),
    }
}

/// A response: its number, from 1, the index of its dataset, and the data.
type Numbered<'a> = (usize, usize, &'a Function);

/// The chosen responses.
fn chosen<'a>(
    universal: &'a Universal,
    file: &str,
    which: Option<usize>,
) -> Result<Vec<Numbered<'a>>> {
    let functions: Vec<_> = universal.functions().collect();
    let responses = functions.iter().filter(|(_, function)| function.kind == RESPONSE);
    let responses: Vec<Numbered> = (1..).zip(responses).map(|(n, (k, f))| (n, *k, *f)).collect();
    let count = responses.len();
    match which {
        _ if count == 0 => {
            let times = functions.iter().filter(|(_, function)| function.kind == RECORD).count();
            let times = match times {
                0 => String::new(),
                count => format!(", {count} of them records in time"),
            };
            let found = format!("{} functions{times}, none of type 4", functions.len());
            Err(Error::value(file, found, "a frequency response, type 4 in a dataset 58"))
        }
        None => Ok(responses),
        Some(which) => match responses.get(which.wrapping_sub(1)) {
            Some(one) => Ok(vec![*one]),
            None => {
                let expected = format!("1 to {count}, as many as {file} has");
                Err(Error::value("--function", which, expected))
            }
        },
    }
}

/// A node and a direction, for messages.
fn shown(dof: &Dof) -> String {
    let along = ["", "x", "y", "z"].get(dof.direction.unsigned_abs() as usize).unwrap_or(&"about");
    let sign = if dof.direction < 0 { "-" } else { "" };
    format!("node {} {sign}{along}", dof.node).trim_end().to_owned()
}

/// The kind of the response, and −1 if force and response have opposite directions. Record 6 has the directions, 8 to
/// 10 the axes.
fn meaning(
    function: &Function,
    told: Option<ResponseKind>,
    wrong: &impl Fn(usize, String, &str) -> Error,
) -> Result<(ResponseKind, f64)> {
    let Function { reference, response, axes, .. } = function;
    let directions = [reference.direction, response.direction];
    let lateral = |d: &i64| (0..=3).contains(&d.abs());
    let same = directions[0].abs() == directions[1].abs() || directions.contains(&0);
    if !(directions.iter().all(lateral) && same) {
        let found = format!("a force at {} and an answer at {}", shown(reference), shown(response));
        return Err(wrong(6, found, "both along one direction across the bat, such as y and y"));
    }
    let [abscissa, answer, per] = [axes[0].quantity, axes[1].quantity, axes[2].quantity];
    if ![0, FREQUENCY].contains(&abscissa) {
        let found = format!("an abscissa of kind {abscissa}");
        return Err(wrong(8, found, "18, frequency"));
    }
    let general = [0, 1].contains(&answer);
    let known = ANSWERS.into_iter().find(|(quantity, _)| *quantity == answer);
    let Some(kind) = known.map(|(_, kind)| kind).or(told.filter(|_| general)) else {
        let found = format!("an answer of kind {answer}");
        let expected =
            "8 (displacement), 11 (velocity) or 12 (acceleration); of kind 0 or 1, --kind";
        return Err(wrong(9, found, expected));
    };
    if !(FORCES.contains(&per) || told.is_some() && [0, 1].contains(&per)) {
        let found = format!("an answer per data of kind {per}");
        return Err(wrong(10, found, "13 (excitation force) or 9 (reaction force)"));
    }
    let opposite = directions[0] * directions[1] < 0;
    Ok((kind, if opposite { -1.0 } else { 1.0 }))
}

/// The factor from the frequency unit to Hz. Record 8 has it.
fn frequency_unit(
    function: &Function,
    wrong: &impl Fn(usize, String, &str) -> Error,
) -> Result<f64> {
    const TAU: f64 = std::f64::consts::TAU;
    let label = &function.axes[0].unit;
    match plain(label).as_str() {
        "" | "hz" | "hertz" | "1/s" | "cps" | "none" => Ok(1.0),
        "khz" => Ok(1e3),
        "rad/s" | "rads" => Ok(1.0 / TAU),
        "rpm" | "cpm" | "1/min" => Ok(1.0 / 60.0),
        _ => {
            let found = format!("frequencies in \"{label}\"");
            Err(wrong(8, found, "Hz, kHz, rad/s or rpm"))
        }
    }
}

/// Frequencies and values in SI, and the number of those at 0 Hz. Record 7 says how they are stored.
fn values(
    function: &Function,
    [hertz, factor]: [f64; 2],
    wrong: &impl Fn(usize, String, &str) -> Error,
) -> Result<(Vec<(f64, c64)>, usize)> {
    let Values::Complex(values) = &function.values else {
        let found = "real values of a frequency response".to_owned();
        return Err(wrong(7, found, "complex ones, data type 5 or 6"));
    };
    let at = |(k, [re, im]): (usize, &[f64; 2])| {
        (hertz * function.abscissa.at(k), c64::new(factor * re, factor * im))
    };
    let all: Vec<(f64, c64)> = values.iter().enumerate().map(at).collect();
    if let Some(pair) =
        all.windows(2).find(|pair| pair[0].0.partial_cmp(&pair[1].0) != Some(Ordering::Less))
    {
        let found = format!("{} Hz after {} Hz", pair[1].0, pair[0].0);
        return Err(wrong(7, found, "frequencies that rise"));
    }
    if all.first().is_some_and(|(f, _)| *f < 0.0) {
        return Err(wrong(7, format!("{} Hz", all[0].0), "frequencies of 0 or more"));
    }
    if let Some((f, value)) = all.iter().find(|(f, v)| !(f.is_finite() && v.norm() < 1e100)) {
        return Err(wrong(7, format!("{} at {f} Hz", value.norm()), "a finite answer"));
    }
    if all.iter().all(|(_, value)| value.norm() == 0.0) {
        return Err(wrong(7, "nothing but 0".to_owned(), "an answer: was the channel on?"));
    }
    let count = all.len();
    let above: Vec<(f64, c64)> = all.into_iter().filter(|(f, _)| *f > 0.0).collect();
    let dropped = count - above.len();
    Ok((above, dropped))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Units as laboratories' programs name them, on one axis or on two.
    #[test]
    fn units_are_known_in_every_usual_spelling() {
        use ResponseKind::{Accelerance, Mobility, Receptance};
        let g = GRAVITY;
        for (kind, own, below, answer, force) in [
            (Accelerance, "g", "lbf", g, POUND_FORCE),
            (Accelerance, "g's", "N", g, 1.0),
            (Accelerance, "gn", "LBF", g, POUND_FORCE),
            (Accelerance, "G", "lb", g, POUND_FORCE),
            (Accelerance, "g/lbf", "", g, POUND_FORCE),
            (Accelerance, "G's/lbs", "", g, POUND_FORCE),
            (Accelerance, "(m/s\u{b2})/N", "", 1.0, 1.0),
            (Accelerance, "m/s^2/N", "N", 1.0, 1.0),
            (Accelerance, "m/s**2", "N", 1.0, 1.0),
            (Accelerance, "m/(N*s^2)", "", 1.0, 1.0),
            (Accelerance, "(1/N)*(m/s^2)", "", 1.0, 1.0),
            (Accelerance, "m s-2", "N", 1.0, 1.0),
            (Accelerance, "m\u{b7}s-2/N", "", 1.0, 1.0),
            (Accelerance, "1/kg", "", 1.0, 1.0),
            (Accelerance, "in/s^2", "lbf", 0.0254, POUND_FORCE),
            (Accelerance, "in/sec/sec", "lbf", 0.0254, POUND_FORCE),
            (Accelerance, "(in/sec^2)/lbf", "", 0.0254, POUND_FORCE),
            (Accelerance, "mm/s\u{b2}", "kN", 1e-3, 1e3),
            (Accelerance, "ft/s^2", "lbf", 0.3048, POUND_FORCE),
            (Mobility, "in/s", "lbf", 0.0254, POUND_FORCE),
            (Mobility, "ips", "lbf", 0.0254, POUND_FORCE),
            (Mobility, "(mm/s)/N", "", 1e-3, 1.0),
            (Mobility, "m/s/N", "", 1.0, 1.0),
            (Receptance, "mils", "lbf", 0.0254e-3, POUND_FORCE),
            (Receptance, "\u{b5}m/N", "", 1e-6, 1.0),
            (Receptance, "in/lbf", "", 0.0254, POUND_FORCE),
            (Receptance, "mm", "N", 1e-3, 1.0),
        ] {
            let found = AxisUnits::read(own, below, kind);
            let near = |a: Option<f64>, b: f64| a.is_some_and(|a| (a / b - 1.0).abs() < 1e-12);
            assert!(near(found.answer, answer), "{own} {below}: {:?}", found.answer);
            assert!(near(found.force, force), "{own} {below}: {:?}", found.force);
        }
        for (kind, own) in
            [(Accelerance, "V"), (Accelerance, "m/s"), (Mobility, "g"), (Receptance, "EU")]
        {
            assert_eq!(AxisUnits::read(own, "", kind).answer, None, "{own}");
        }
    }
}
