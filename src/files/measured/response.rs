//! A measured frequency response from a universal file: dataset 58, its places from the nodes.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::path::Path;

use faer::c64;

use crate::base::error::{Error, Result};
use crate::base::file;
use crate::base::linear::dot;
use crate::base::units::{POUND_FORCE, Quantity, factor};
use crate::files::measured::direction::{Vector, axis};
use crate::files::uff::{self, Dataset, Dof, Function, Units, Universal, Values, at_line};
use crate::motion::frf::Kind;
use crate::study::measured::response::MeasuredResponse;

/// Standard gravity (m/s²): some programs call their accelerations `g` and mean it.
const GRAVITY: f64 = 9.80665;
/// Number of a frequency response among the functions of dataset 58.
const RESPONSE: i64 = 4;
/// Kinds of data of an axis: frequency; displacement, velocity, acceleration; forces.
const FREQUENCY: i64 = 18;
const ANSWERS: [(i64, Kind); 3] =
    [(8, Kind::Receptance), (11, Kind::Mobility), (12, Kind::Accelerance)];
const FORCES: [i64; 2] = [9, 13];

/// Reads one frequency response: number `which` of those in the file, from 1, or the only one. `unit`
/// is that of a file without dataset 164, else SI is taken.
///
/// # Errors
///
/// [`Error::Read`], those of [`uff::parse`]; [`Error::Value`] for a file without a response, with
/// several of which none was chosen; [`Error::Input`] with the line for one that is not of a motion
/// per force over frequency, or not along one direction.
pub fn read(path: &Path, which: Option<usize>, unit: Option<&Units>) -> Result<MeasuredResponse> {
    read_as(path, which, unit, None)
}

/// As [`read`]; `told` is the kind of an answer whose axis does not say it.
///
/// # Errors
///
/// Those of [`read`].
pub fn read_as(
    path: &Path,
    which: Option<usize>,
    unit: Option<&Units>,
    told: Option<Kind>,
) -> Result<MeasuredResponse> {
    let name = path.display().to_string();
    let bytes = file::read(path)?;
    let universal = uff::parse_in(&name, &bytes, unit)?;
    let (k, function) = chosen(&universal, &name, which)?;
    let first = universal.lines.get(k).copied().unwrap_or(1);
    let wrong = |record: usize, found: String, expected: &str| {
        at_line(&name, &bytes, first + record, found, expected)
    };
    let (kind, sign) = meaning(function, told, &wrong)?;
    let named = universal.datasets.iter().any(|dataset| matches!(dataset, Dataset::Units(_)));
    let mut assumed = vec![];
    let mut factor = sign;
    if !named {
        let labels = Labels::of(function, kind);
        // What was told of the file is for axes without a unit of their own.
        let given = unit.cloned().unwrap_or_else(Units::si);
        if let Some(answer) = labels.answer {
            factor *= answer * given.length;
        }
        if let Some(force) = labels.force {
            factor /= force * given.force;
        }
        assumed.extend(labels.words(kind));
        if labels.answer.is_none() && unit.is_none() {
            assumed.push("the file names no units (no dataset 164): they are taken as SI".into());
        }
    } else {
        let own = universal.converted_from.clone().unwrap_or_else(Units::si);
        let labels = Labels::of(function, kind);
        let differ =
            |label: Option<f64>, own: f64| label.is_some_and(|l| (l * own - 1.0).abs() > 1e-3);
        if differ(labels.answer, own.length) || differ(labels.force, own.force) {
            assumed.push(format!(
                "the axes are named {} and {}, which contradicts the units in dataset 164; those of \
                 dataset 164 are taken",
                function.axes[1].unit, function.axes[2].unit
            ));
        }
    }
    if sign < 0.0 {
        assumed.push("force and answer are along opposite directions: the sign is turned".into());
    }
    let (mut values, dropped) = values(function, factor, &wrong)?;
    if turns_back(&values) {
        values.iter_mut().for_each(|(_, value)| *value = value.conj());
        assumed.push(
            "the phase rises through the peaks, as with time as e^(-iwt): it is turned over".into(),
        );
    }
    if dropped > 0 {
        assumed.push(format!("{dropped} values at 0 Hz are left out"));
    }
    let [at, to] = places(&universal, [&function.reference, &function.response]);
    if at.is_some() && to.is_some() {
        assumed.push("the nodes' places are taken from the knob end".to_owned());
    }
    let drive_point = function.reference.node == function.response.node;
    Ok(MeasuredResponse { source: name, kind, at, to, drive_point, values, assumed })
}

/// Whether the response runs anticlockwise in the complex plane through its highest peak: with time as e^(+iωt) every
/// resonance runs clockwise, whatever its sign. The area swept around 0 is twice `Σ Im(H̄ₖ Hₖ₊₁)`; it is taken where the
/// response is at least half as high as the peak, since an antiresonance runs the other way round. Without a peak in its
/// range a response says nothing.
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

/// The factors to SI of the units that the axes are named by.
struct Labels {
    answer: Option<f64>,
    force: Option<f64>,
}

impl Labels {
    fn of(function: &Function, kind: Kind) -> Self {
        let [own, below] = [1, 2].map(|k| plain(&function.axes[k].unit));
        let force = force_unit(&below);
        if let Some(answer) = answer_unit(&own, kind) {
            return Self { answer: Some(answer), force };
        }
        // The whole unit on one axis: g/lbf, (m/s2)/N, (1/N)*(m/s^2).
        let split = own.strip_prefix("1/").and_then(|rest| {
            let end = rest.find("m/").or_else(|| rest.find("mm/")).or_else(|| rest.find("in/"));
            end.map(|end| (&rest[end..], &rest[..end]))
        });
        if let Some((answer, per)) = split.or_else(|| own.rsplit_once('/'))
            && let (Some(answer), Some(per)) = (answer_unit(answer, kind), force_unit(per))
        {
            return Self { answer: Some(answer), force: Some(per) };
        }
        let whole = (kind == Kind::Accelerance && own == "1/kg").then_some(1.0);
        Self { answer: whole, force: whole.or(force) }
    }

    /// What other units than SI are taken, for people.
    fn words(&self, kind: Kind) -> Option<String> {
        let said = match (kind, self.answer) {
            (Kind::Accelerance, Some(f)) if f == GRAVITY => {
                "accelerations are taken in g".to_owned()
            }
            (_, Some(f)) if f != 1.0 => format!("answers are taken in units of {f} in SI"),
            _ if self.force.is_some_and(|f| f != 1.0) => "answers are taken in SI".to_owned(),
            _ => return None,
        };
        let force = self.force.filter(|f| *f != 1.0);
        let force = force.map_or(String::new(), |f| format!(", forces in units of {f:.5} N"));
        Some(format!("{said}{force}, as their axes are named"))
    }
}

/// A unit without the signs that programs differ in: `(m/s²)` and `m/sec^2` are `m/s2`.
fn plain(unit: &str) -> String {
    let unit = unit.to_lowercase().replace('\u{b2}', "2").replace("sec", "s");
    unit.chars().filter(|c| !"^*()[]' ".contains(*c)).collect()
}

fn answer_unit(unit: &str, kind: Kind) -> Option<f64> {
    let gravity = ["g", "gs", "gn", "g0", "g_n", "gee"].contains(&unit);
    if kind == Kind::Accelerance && gravity {
        return Some(GRAVITY);
    }
    let length = match kind {
        Kind::Receptance => unit,
        Kind::Mobility => unit.strip_suffix("/s")?,
        Kind::Accelerance => unit.strip_suffix("/s2").or_else(|| unit.strip_suffix("/s/s"))?,
    };
    factor(length, Quantity::Length).ok()
}

fn force_unit(unit: &str) -> Option<f64> {
    match unit {
        "n" | "newton" => Some(1.0),
        "kn" => Some(1e3),
        "lb" | "lbs" => Some(POUND_FORCE),
        unit => factor(unit, Quantity::Force).ok(),
    }
}

/// The function that is meant, and which dataset it is.
fn chosen<'a>(
    universal: &'a Universal,
    file: &str,
    which: Option<usize>,
) -> Result<(usize, &'a Function)> {
    let functions =
        universal.datasets.iter().enumerate().filter_map(|(k, dataset)| match dataset {
            Dataset::Function(function) => Some((k, &**function)),
            _ => None,
        });
    let functions: Vec<_> = functions.collect();
    let responses: Vec<_> =
        functions.iter().filter(|(_, function)| function.kind == RESPONSE).copied().collect();
    let count = responses.len();
    match (which, &responses[..]) {
        (_, []) => {
            let found = format!("{} functions, none of type 4", functions.len());
            Err(Error::value(file, found, "a frequency response, type 4 in a dataset 58"))
        }
        (Some(which), all) => {
            which.checked_sub(1).and_then(|k| all.get(k)).copied().ok_or_else(|| {
                let expected = format!("1 to {count}, as many as {file} has");
                Error::value("--function", which, expected)
            })
        }
        (None, [one]) => Ok(*one),
        (None, several) => {
            let told = |(n, (_, f)): (usize, &(usize, &Function))| {
                format!("{}: from {} to {}", n + 1, shown(&f.reference), shown(&f.response))
            };
            let all: Vec<String> = several.iter().enumerate().take(6).map(told).collect();
            let more = if count > all.len() { ", …" } else { "" };
            let found = format!("{count} frequency responses ({}{more})", all.join(", "));
            Err(Error::value(file, found, format!("one: --function 1 to {count}")))
        }
    }
}

/// A node and a direction, for people.
fn shown(dof: &Dof) -> String {
    let along = ["", "x", "y", "z"].get(dof.direction.unsigned_abs() as usize).unwrap_or(&"about");
    let sign = if dof.direction < 0 { "-" } else { "" };
    format!("node {} {sign}{along}", dof.node).trim_end().to_owned()
}

/// What is answered, and −1 if force and answer are along opposite directions. Record 6 has the
/// directions, 8 to 10 the axes.
fn meaning(
    function: &Function,
    told: Option<Kind>,
    wrong: &impl Fn(usize, String, &str) -> Error,
) -> Result<(Kind, f64)> {
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

/// Frequencies and values in SI, and how many were at 0 Hz. Record 7 says how they are stored.
fn values(
    function: &Function,
    factor: f64,
    wrong: &impl Fn(usize, String, &str) -> Error,
) -> Result<(Vec<(f64, c64)>, usize)> {
    let Values::Complex(values) = &function.values else {
        let found = "real values of a frequency response".to_owned();
        return Err(wrong(7, found, "complex ones, data type 5 or 6"));
    };
    let at = |(k, [re, im]): (usize, &[f64; 2])| {
        (function.abscissa.at(k), c64::new(factor * re, factor * im))
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
    let count = all.len();
    let above: Vec<(f64, c64)> = all.into_iter().filter(|(f, _)| *f > 0.0).collect();
    let dropped = count - above.len();
    Ok((above, dropped))
}

/// Where these degrees of freedom are along the bat's axis, the direction in which the file's nodes
/// are farthest apart; None where a node has no place.
fn places(universal: &Universal, dofs: [&Dof; 2]) -> [Option<f64>; 2] {
    let lists = universal.datasets.iter().filter_map(|dataset| match dataset {
        Dataset::Nodes(nodes) => Some(&nodes.nodes),
        _ => None,
    });
    let nodes: BTreeMap<i64, Vector> = lists.flatten().map(|node| (node.label, node.at)).collect();
    let all: Vec<Vector> = nodes.values().copied().collect();
    let along = match all.iter().any(|at| Some(at) != all.first()) {
        true => axis(&all),
        false => [1.0, 0.0, 0.0],
    };
    dofs.map(|dof| nodes.get(&dof.node).map(|at| dot(at, &along)))
}
