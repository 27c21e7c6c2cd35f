//! Measured modes from a universal file: nodes (15, 2411) and shapes (55, 2414).
//!
//! The bat's axis is the direction in which the nodes are farthest apart, and a mode's deflection is
//! its motion in the direction normal to the axis in which it moves most: a round bat bends in any.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;
use std::path::Path;

use faer::c64;

use crate::engine::{Error, Result, dot, file};
use crate::files::measured::direction::{Vector, axis, named, normals, positive};
use crate::files::measured::{Beside, FEWEST};
use crate::measured::data::{FrequencyUnit, Measured, MeasuredMode, Otherwise};
use uff58::{Analysis, NodalData, Node, Universal, six_digits};

/// The motion of a node along x, y and z.
type Xyz = [c64; 3];

/// Reads measured modes, with the additional facts.
///
/// # Errors
///
/// [`Error::Read`], those of [`uff58::parse`], and [`Error::Value`] for a file without shapes or without the nodes of
/// its shapes, and for places beside a file that has nodes.
pub fn read(path: &Path, beside: &Beside) -> Result<Measured> {
    let name = path.display().to_string();
    let universal = uff58::parse_in(&name, &file::read(path)?, beside.unit.as_ref())?;
    Ok(placed(&universal, &name, beside)?.sorted())
}

/// No bat has a damping ratio above this.
const MUCH: f64 = 0.2;
/// Nodes closer than this along the axis (relative to the span) are one point.
const SAME: f64 = 1e-4;

/// The modes of a universal file; `file` is its name in messages.
///
/// # Errors
///
/// As [`read`].
pub fn of(universal: &Universal, file: &str) -> Result<Measured> {
    placed(universal, file, &Beside::default())
}

/// As [`of`], with the additional facts.
fn placed(universal: &Universal, file: &str, beside: &Beside) -> Result<Measured> {
    let places = beside.places.as_ref();
    let poles = Poles::of(universal, beside.frequency_unit);
    let shapes = shapes(universal, file, &poles)?;
    let mut nodes: BTreeMap<i64, &Node> =
        universal.nodes().map(|node| (node.label, node)).collect();
    let [moving, still] = told(&shapes);
    let along = stillest(&shapes);
    if places.is_some() && !nodes.is_empty() {
        let expected = "no places beside them, or a file without";
        return Err(Error::value(file, format!("{} nodes with places", nodes.len()), expected));
    }
    let given: Vec<Node> =
        places.into_iter().flatten().map(|(k, x)| Node::new(*k, along.map(|a| a * x))).collect();
    nodes.extend(given.iter().map(|node| (node.label, node)));
    if let Some(label) = moving.iter().find(|label| !nodes.contains_key(label)) {
        let (list, expected) = match places {
            Some(_) => ("places", "its place"),
            None => ("nodes", "it in a dataset 15 or 2411, or its place by --places"),
        };
        let found = format!("node {label} in a shape and not among the {list}");
        return Err(Error::value(file, found, expected));
    }
    let at: Vec<Vector> = moving.iter().map(|label| nodes[label].at).collect();
    let axis = if places.is_some() { along } else { axis(&at) };
    let points = points(&at, axis);
    if points.len() < FEWEST {
        let found = format!("{} moving points along the bat", points.len());
        let expected = format!("{FEWEST} at least; with fewer every shape looks like any other");
        return Err(Error::value(file, found, expected));
    }
    let mut assumed = unread(universal);
    assumed.extend(poles.words());
    assumed.push(format!("the bat's axis is {}", named(axis)));
    let systems = moving.iter().map(|label| nodes[label].systems);
    assumed.extend(taken([moving.len(), points.len(), still.len()], systems));
    let (mut modes, mut directions) = (vec![], vec![]);
    for (k, shape) in shapes.iter().enumerate() {
        let motions = motions(shape.data, &moving);
        let (values, direction, share) = match shape.data.per_node {
            1 => (averaged(&motions, &points, |m| m[0]), "its one direction".to_owned(), 1.0),
            _ => deflection(&motions, &points, axis),
        };
        directions.push((direction, share));
        let mode = shape.mode(k, values, &modes);
        if let Some(ratio) = mode.damping_ratio.filter(|ratio| *ratio > MUCH) {
            let percent = 100.0 * ratio;
            assumed.push(format!(
                "{} has a damping ratio of {ratio}, {percent:.0} % of critical damping: in per cent it would be a hundredth",
                mode.name
            ));
        }
        assumed.extend(gaps(&mode.name, shape.data, &moving));
        modes.push(mode);
    }
    assumed.extend(said(&directions, &modes));
    let along = points.iter().map(|point| point.along).collect();
    let (source, from_knob, otherwise) = (file.to_owned(), places.is_some(), poles.otherwise);
    Ok(Measured { source, modes, along, from_knob, assumed, otherwise })
}

/// How nodes are taken, by the numbers of those that move, of their points, and of those that never move, and by the
/// coordinate systems of the first.
fn taken(
    [moving, points, still]: [usize; 3],
    systems: impl Iterator<Item = [i64; 2]> + Clone,
) -> impl Iterator<Item = String> {
    let places = "the nodes' places are taken as in the file's global system".to_owned();
    let motions = "motions are taken as along the file's global axes".to_owned();
    let [placed, moved] = [0, 1].map(|k| systems.clone().any(|systems| systems[k] != 0));
    let all = [
        (points < moving).then(|| {
            format!("{moving} nodes are taken as {points} points, those side by side as one")
        }),
        (still > 0).then(|| format!("{still} nodes that never move are left out")),
        placed.then_some(places),
        moved.then_some(motions),
    ];
    all.into_iter().flatten()
}

/// The coordinate axis along which the shapes move least, the first of equal ones: the axis of a bat whose file has no
/// positions of its nodes.
fn stillest(shapes: &[FileShape]) -> Vector {
    let values = || shapes.iter().flat_map(|shape| &shape.data.values);
    let moved = |k: usize| -> f64 {
        let parts = values().filter_map(|(_, values)| values.get(k));
        // One value per node is the deflection, in no direction.
        let parts = parts.filter(|_| shapes.iter().all(|shape| shape.data.per_node > 1));
        parts.map(|[re, im]| re * re + im * im).sum()
    };
    let least = (0..3).min_by(|a, b| moved(*a).total_cmp(&moved(*b))).unwrap_or(0);
    [0, 1, 2].map(|k| if k == least { 1.0 } else { 0.0 })
}

/// Parts of the file that were ignored, and conversions.
fn unread(universal: &Universal) -> Vec<String> {
    let mut said = vec![];
    if let Some(skipped) = skipped(universal) {
        said.push(format!("{skipped} left out"));
    }
    if let Some(units) = universal.converted_from.as_ref().filter(|units| units.length != 1.0) {
        let unit = six_digits(1.0 / units.length);
        let so = if universal.names_units() { "as its dataset 164 says" } else { "as was told" };
        said.push(format!("the file's unit of length is {unit} m, {so}"));
    }
    said
}

/// The datasets that are not read, each number once.
fn skipped(universal: &Universal) -> Option<String> {
    let mut numbers: Vec<i64> = universal.skipped.iter().map(|skipped| skipped.number).collect();
    numbers.sort_unstable();
    numbers.dedup();
    // A dataset 2414 on nodes would have been read.
    let named = |number: &i64| match number {
        2414 => "2414 (data on elements, not at nodes)".to_owned(),
        number => number.to_string(),
    };
    let list: Vec<String> = numbers.iter().map(named).collect();
    match list.len() {
        0 => None,
        1 => Some(format!("dataset {} is", list[0])),
        _ => Some(format!("datasets {} are", list.join(", "))),
    }
}

/// A word about a mode that does not have all the nodes that move.
fn gaps(name: &str, data: &NodalData, moving: &[i64]) -> Option<String> {
    let listed: BTreeSet<i64> = data.values.iter().map(|(label, _)| *label).collect();
    let there = moving.iter().filter(|label| listed.contains(label)).count();
    let all = moving.len();
    let others = "the others are taken at rest";
    (there < all).then(|| format!("{name} lists {there} of the {all} nodes that move, {others}"))
}

/// Labels of the nodes that move in a shape, and of those that never move.
fn told(shapes: &[FileShape]) -> [Vec<i64>; 2] {
    let mut moving: BTreeMap<i64, bool> = BTreeMap::new();
    for (label, values) in shapes.iter().flat_map(|shape| &shape.data.values) {
        *moving.entry(*label).or_default() |= moves(values);
    }
    [true, false].map(|which| {
        let these = moving.iter().filter(|(_, moves)| **moves == which);
        these.map(|(label, _)| *label).collect()
    })
}

/// Whether a node deflects: rotations are of no use here.
fn moves(values: &[uff58::Complex]) -> bool {
    values.iter().take(3).any(|[re, im]| *re != 0.0 || *im != 0.0)
}

/// Whether it deflects by more than can be reckoned with.
fn large(values: &[uff58::Complex]) -> bool {
    values.iter().take(3).flatten().any(|part| part.abs() > LARGEST)
}

/// In any unit.
const LARGEST: f64 = 1e100;

/// A dataset 55 that is a mode.
struct FileShape<'a> {
    number: i64,
    frequency: f64,
    damping_ratio: Option<f64>,
    data: &'a NodalData,
}

impl FileShape<'_> {
    /// The mode with its deflections, number `k` from 0 in the file, after those before it.
    fn mode(&self, k: usize, shape: Vec<c64>, before: &[MeasuredMode]) -> MeasuredMode {
        let number = if self.number == 0 { k as i64 + 1 } else { self.number };
        let mut name = format!("mode_{number}");
        if before.iter().any(|mode| mode.name == name) {
            name = format!("{name}_{}", k + 1);
        }
        let (frequency, damping_ratio) = (self.frequency, self.damping_ratio);
        MeasuredMode { name, order: None, frequency, damping_ratio, shape }
    }

    /// The mistake, and what was expected.
    fn complaint(&self) -> Option<(String, &'static str)> {
        let (kind, count) = (self.data.characteristic, self.data.per_node);
        let known = matches!(
            (kind, count),
            (1, 1) | (NodalData::TRANSLATIONS, 3) | (NodalData::MOTIONS, 6)
        );
        let frequency = self.frequency;
        match self {
            _ if !known => Some((
                format!("a shape of characteristic {kind} with {count} values per node"),
                "1 value, 3 translations, or these and 3 rotations",
            )),
            _ if ![0, 1, 8, 11, 12].contains(&self.data.quantity) => Some((
                format!("a shape of data type {}", self.data.quantity),
                "8 (displacement), 11 (velocity) or 12 (acceleration)",
            )),
            _ if self.damping_ratio.is_some_and(|ratio| ratio > 1.0) => Some((
                format!("a damping ratio of {}", self.damping_ratio.unwrap_or_default()),
                "a share of critical damping, at most 1: 0.006 for 0.6 %",
            )),
            _ if !(frequency >= 0.0 && frequency.is_finite()) => {
                Some((format!("a shape at {frequency} Hz"), "a frequency of 0 or more"))
            }
            _ if self.data.values.iter().any(|(_, values)| large(values)) => Some((
                format!("a shape at {frequency} Hz with values above {LARGEST:e}"),
                "a deflection, in whatever unit",
            )),
            _ if !self.data.values.iter().any(|(_, values)| moves(values)) => Some((
                format!("a shape at {frequency} Hz with every value 0"),
                "a shape that moves somewhere",
            )),
            _ => None,
        }
    }
}

fn shapes<'a>(universal: &'a Universal, file: &str, poles: &Poles) -> Result<Vec<FileShape<'a>>> {
    let shapes = universal.nodal_data().filter_map(|data| shape(data, poles));
    let shapes: Vec<FileShape> = shapes.collect();
    if let Some((found, expected)) = shapes.iter().find_map(FileShape::complaint) {
        return Err(Error::value(file, found, expected));
    }
    if shapes.is_empty() {
        let (found, expected) = match universal.functions().count() {
            0 => {
                let unread = skipped(universal);
                let unread = unread.map_or(String::new(), |list| format!("; {list} not read"));
                (format!("no modes{unread}"), "shapes in datasets 55 or 2414")
            }
            count => (
                format!("{count} functions in datasets 58 and no shapes"),
                "shapes in datasets 55, which a modal analysis finds from them; or the \
                 frequencies of the peaks in a CSV file, mode,frequency_hz",
            ),
        };
        return Err(Error::value(file, found, expected));
    }
    Ok(shapes)
}

/// How a file writes its frequencies and the poles of its complex modes.
struct Poles {
    /// Unit of the magnitude of a pole: rad/s by the format.
    poles: FrequencyUnit,
    /// Unit of the frequency of a normal mode: Hz by the format.
    normal: FrequencyUnit,
    /// The other possible meaning.
    otherwise: Option<Otherwise>,
    /// Whether the poles are in Hz by other data of the file.
    hertz: bool,
    /// With the opposite sign of the real part, all of them.
    growing: bool,
    /// Some with a positive real part and some with a negative one.
    mixed: bool,
}

impl Poles {
    /// As given, or else by the data that contradict: `B = -λA`, and `A = 2iω` for a modal mass of 1, with λ in rad/s.
    fn of(universal: &Universal, told: Option<FrequencyUnit>) -> Self {
        let poles: Vec<[f64; 4]> = universal.nodal_data().filter_map(pole).collect();
        let both = |[_, size, a, b]: &[f64; 4]| *size > 0.0 && *a > 0.0 && *b > 0.0;
        let ratios: Vec<f64> = poles
            .iter()
            .filter(|[_, size, a, _]| *a > 0.0 && *size > 0.0)
            .map(|[_, size, a, b]| if *b > 0.0 { b / a / size } else { 0.5 * a / size })
            .collect();
        let all_near =
            |to: f64| !ratios.is_empty() && ratios.iter().all(|r| (r / to - 1.0).abs() < 0.01);
        let hertz = told.is_none() && all_near(TAU);
        let settled = hertz || (all_near(1.0) && poles.iter().all(both));
        let grows = poles.iter().any(|pole| pole[0] > 0.0);
        let decays = poles.iter().any(|pole| pole[0] < 0.0);
        let by_format = if hertz { FrequencyUnit::Hertz } else { FrequencyUnit::RadPerS };
        let (poles_in, normal) = (told.unwrap_or(by_format), told.unwrap_or(FrequencyUnit::Hertz));
        // One reading for a file, of poles or of frequencies.
        let normal_mode = |data: &NodalData| matches!(data.analysis, Analysis::NormalMode { .. });
        let others = universal.nodal_data().any(normal_mode);
        let read_in = if poles.is_empty() { normal } else { poles_in };
        let otherwise = Otherwise { read_in, settled };
        let unsure = told.is_none() && (poles.is_empty() || !others);
        let otherwise = unsure.then_some(otherwise);
        let (growing, mixed) = (grows && !decays, grows && decays);
        Self { poles: poles_in, normal, otherwise, hertz, growing, mixed }
    }

    /// The interpretation in words.
    fn words(&self) -> Vec<String> {
        let hertz = "the poles are taken as in Hz: Modal A and B are 2 pi times those of rad/s";
        let growing =
            "the real parts of the poles are positive, all of them: they are taken as damping";
        let mixed = "poles with positive real parts tell no damping: it is left out";
        let all = [(self.hertz, hertz), (self.growing, growing), (self.mixed, mixed)];
        all.into_iter().filter(|(so, _)| *so).map(|(_, word)| word.to_owned()).collect()
    }
}

/// Real part and size of a pole, sizes of Modal A and B.
fn pole(data: &NodalData) -> Option<[f64; 4]> {
    let Analysis::ComplexMode { eigenvalue: [re, im], modal_a, modal_b, .. } = data.analysis else {
        return None;
    };
    let size = |[re, im]: uff58::Complex| re.hypot(im);
    Some([re, size([re, im]), size(modal_a), size(modal_b)])
}

fn shape<'a>(data: &'a NodalData, poles: &Poles) -> Option<FileShape<'a>> {
    let known = |ratio: f64| (ratio > 0.0).then_some(ratio);
    let (number, frequency, damping_ratio) = match data.analysis {
        Analysis::NormalMode { mode, frequency, viscous, hysteretic, .. } => {
            // A loss factor is twice the damping ratio.
            let frequency = frequency * poles.normal.hertz();
            (mode, frequency, known(viscous).or(known(0.5 * hysteretic)))
        }
        Analysis::ComplexMode { mode, eigenvalue: [re, im], .. } => {
            let size = re.hypot(im);
            let re = if poles.growing { -re } else { re };
            (mode, size * poles.poles.hertz(), known(-re / size))
        }
        _ => return None,
    };
    Some(FileShape { number, frequency, damping_ratio, data })
}

/// Nodes side by side: where they are along the axis (m), and which they are.
struct NodeGroup {
    along: f64,
    members: Vec<usize>,
}

fn points(at: &[Vector], axis: Vector) -> Vec<NodeGroup> {
    let mut all: Vec<(f64, usize)> =
        at.iter().enumerate().map(|(k, x)| (dot(x, &axis), k)).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let span = all.last().map_or(0.0, |last| last.0 - all[0].0);
    let mut points: Vec<NodeGroup> = vec![];
    for (along, k) in all {
        match points.last_mut().filter(|point| along - point.along <= SAME * span) {
            Some(point) => point.members.push(k),
            None => points.push(NodeGroup { along, members: vec![k] }),
        }
    }
    points
}

/// The motion of these nodes in a shape; a node outside the shape does not move.
fn motions(data: &NodalData, labels: &[i64]) -> Vec<Xyz> {
    let values: BTreeMap<i64, &Vec<uff58::Complex>> =
        data.values.iter().map(|(label, values)| (*label, values)).collect();
    let part = |values: &Vec<uff58::Complex>, k: usize| {
        values.get(k).map_or(c64::new(0.0, 0.0), |[re, im]| c64::new(*re, *im))
    };
    let none = vec![];
    let of = |label: &i64| {
        let values = values.get(label).copied().unwrap_or(&none);
        [part(values, 0), part(values, 1), part(values, 2)]
    };
    labels.iter().map(of).collect()
}

/// The mean over the nodes of every point.
fn averaged(motions: &[Xyz], points: &[NodeGroup], of: impl Fn(&Xyz) -> c64) -> Vec<c64> {
    let mean = |point: &NodeGroup| {
        let sum = point.members.iter().fold(c64::new(0.0, 0.0), |sum, k| sum + of(&motions[*k]));
        sum / point.members.len() as f64
    };
    points.iter().map(mean).collect()
}

/// The deflection in the direction normal to the axis in which a mode moves most: its values, the
/// direction in words, and its share of all the motion.
fn deflection(motions: &[Xyz], points: &[NodeGroup], axis: Vector) -> (Vec<c64>, String, f64) {
    let [one, other] = normals(axis);
    let along = |motion: &Xyz, direction: Vector| {
        (0..3).fold(c64::new(0.0, 0.0), |sum, k| sum + motion[k] * direction[k])
    };
    let common = |a: Vector, b: Vector| -> f64 {
        motions.iter().map(|m| (along(m, a).conj() * along(m, b)).re).sum()
    };
    let [a, b, both] = [common(one, one), common(other, other), common(one, other)];
    let angle = 0.5 * (2.0 * both).atan2(a - b);
    let direction = positive([0, 1, 2].map(|k| angle.cos() * one[k] + angle.sin() * other[k]));
    let total: f64 = motions.iter().flatten().map(|v| v.norm_sqr()).sum();
    let values = averaged(motions, points, |motion| along(motion, direction));
    (values, named(direction), common(direction, direction) / total.max(f64::MIN_POSITIVE))
}

/// The directions of the modes' motion; a single one if it is the same for all.
fn said(directions: &[(String, f64)], modes: &[MeasuredMode]) -> Vec<String> {
    let Some((first, _)) = directions.first() else { return vec![] };
    let least = directions.iter().map(|(_, share)| *share).fold(1.0, f64::min);
    let mut all = if directions.iter().all(|(direction, _)| direction == first) {
        vec![format!("deflections are those along {first}")]
    } else {
        let one = |((direction, _), mode): (&(String, f64), &MeasuredMode)| {
            format!("{} along {direction}", mode.name)
        };
        let list: Vec<String> = directions.iter().zip(modes).map(one).collect();
        vec![format!("deflections: {}", list.join(", "))]
    };
    if least < 0.9 {
        let poor = directions.iter().zip(modes).filter(|((_, share), _)| *share < 0.9);
        let list: Vec<String> = poor
            .map(|((_, share), mode)| format!("{} by {:.0} %", mode.name, 100.0 * (1.0 - share)))
            .collect();
        all.push(format!("motion in other directions is left out: {}", list.join(", ")));
    }
    all
}
