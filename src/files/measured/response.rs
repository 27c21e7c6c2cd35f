//! A measured frequency response from a universal file: dataset 58, its places from the nodes.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::path::Path;

use faer::c64;

use crate::base::error::{Error, Result};
use crate::base::file;
use crate::base::linear::dot;
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
    let name = path.display().to_string();
    let bytes = file::read(path)?;
    let universal = uff::parse_in(&name, &bytes, unit)?;
    let (k, function) = chosen(&universal, &name, which)?;
    let first = universal.lines.get(k).copied().unwrap_or(1);
    let wrong = |record: usize, found: String, expected: &str| {
        at_line(&name, &bytes, first + record, found, expected)
    };
    let (kind, sign) = meaning(function, &wrong)?;
    let named = universal.datasets.iter().any(|dataset| matches!(dataset, Dataset::Units(_)));
    let mut assumed = vec![];
    let mut factor = sign;
    if !named {
        let label = function.axes[1].unit.to_lowercase();
        if kind == Kind::Accelerance && ["g", "gn"].contains(&label.as_str()) {
            factor *= GRAVITY;
            assumed.push("accelerations are taken in g, as their axis is named".to_owned());
        } else if unit.is_none() {
            assumed.push("the file names no units (no dataset 164): they are taken as SI".into());
        }
    }
    if sign < 0.0 {
        assumed.push("force and answer are along opposite directions: the sign is turned".into());
    }
    let (values, dropped) = values(function, factor, &wrong)?;
    if dropped > 0 {
        assumed.push(format!("{dropped} values at 0 Hz are left out"));
    }
    let [at, to] = places(&universal, [&function.reference, &function.response]);
    if at.is_some() && to.is_some() {
        assumed.push("the nodes' places are taken from the knob end".to_owned());
    }
    Ok(MeasuredResponse { source: name, kind, at, to, values, assumed })
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
    let Some((_, kind)) = ANSWERS.into_iter().find(|(quantity, _)| *quantity == answer) else {
        let found = format!("an answer of kind {answer}");
        return Err(wrong(9, found, "8 (displacement), 11 (velocity) or 12 (acceleration)"));
    };
    if !FORCES.contains(&per) {
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
