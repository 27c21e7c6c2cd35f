//! Where are the elements of the wall: how long along the bat, how thick across?
//!
//! Columns lie between the stations and are refined in geometric steps towards free ends, kinks and corners. The layers
//! of a column beside a kink or a corner are refined towards it in the same way.
//!
//! # Source
//!
//! B. Szabó, I. Babuška, Finite Element Analysis (Wiley 1991), chapter 10: meshes graded by 0.15.

use crate::beam::wall::layers::{Layers, Radius, SAME_RADIUS, Stretch};

/// Columns of equal length are at least this fraction of the wall long: one over this number.
const MOST: f64 = 400.0;
/// Ratio of the lengths of neighbours towards a place where the motion is not smooth.
const STEP: f64 = 0.15;
/// Usual length of a column as a multiple of the radius there.
const LENGTH: f64 = 1.8;
/// Greatest thickness of a part of a layer as a share of the radius: in a core a motion is proportional to `r^n`.
const THICKNESS: f64 = 0.3;
/// Cuts across the wall lie in geometric steps from a corner, and none is closer to it than this share of the distance
/// to the column's far end.
const ACROSS: f64 = 0.05;

/// Number of geometric steps towards each kind of place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grading {
    /// Towards the knob end, if the wall ends there.
    pub knob: usize,
    /// Towards the tip.
    pub tip: usize,
    /// Towards a kink of the profile.
    pub kink: usize,
    /// Least change of slope that counts as a kink.
    pub least_kink: f64,
    /// Towards a corner of layers.
    pub corner: usize,
    /// Towards a corner of layers that are far softer than the wall that continues beside them.
    pub soft: usize,
}

/// A layer of a column, or a part of one: an element.
#[derive(Debug, Clone)]
pub struct LayerElement {
    /// Index of its material.
    pub material: usize,
    /// Radius inside, along the column.
    pub inner: Radius,
    /// Radius outside.
    pub outer: Radius,
}

/// A stack of elements between two places.
#[derive(Debug, Clone)]
pub struct WallColumn {
    /// Where it begins (m).
    pub from: f64,
    /// Where it ends (m).
    pub to: f64,
    /// The elements, from the inside out.
    pub parts: Vec<LayerElement>,
}

impl WallColumn {
    /// Radii between the parts at one end, the far one if `at_end` (m).
    pub fn radii(&self, at_end: bool) -> Vec<f64> {
        let xi = if at_end { 1.0 } else { -1.0 };
        let inner = self.parts[0].inner.at(xi)[0];
        std::iter::once(inner).chain(self.parts.iter().map(|part| part.outer.at(xi)[0])).collect()
    }
}

/// One end of a stretch.
#[derive(Debug, Clone, Default)]
struct StretchEnd {
    /// Geometric steps towards it.
    steps: usize,
    /// Radii at which the motion is not smooth (m).
    corners: Vec<f64>,
    /// Radii where the layers are cut only to match the neighbours.
    matched: Vec<f64>,
}

/// The columns of a wall.
pub fn columns(layers: &Layers, grading: Grading) -> Vec<WallColumn> {
    let stretches = &layers.stretches;
    let first = &stretches[0];
    let graded =
        |soft: bool| if soft { Grading { corner: grading.soft, ..grading } } else { grading };
    let of = |left: &Stretch, right: &Stretch| graded(left.stays_stiff(right, &layers.materials));
    let own = graded(first.is_soft_within(&layers.materials));
    let mut lefts = vec![end(first, &first.radii(first.from), grading.knob, own)];
    let mut rights = vec![];
    for pair in stretches.windows(2) {
        let [left, right] = between(&pair[0], &pair[1], of(&pair[0], &pair[1]));
        rights.push(left);
        lefts.push(right);
    }
    let last = &stretches[stretches.len() - 1];
    rights.push(end(
        last,
        &last.radii(last.to),
        grading.tip,
        graded(last.is_soft_within(&layers.materials)),
    ));
    let mut columns = vec![];
    let shortest = (last.to - first.from) / MOST;
    for ((stretch, left), right) in stretches.iter().zip(&lefts).zip(&rights) {
        divide(stretch, [left, right], shortest, &mut columns);
    }
    columns
}

/// The border at a free end, where layers of different materials make corners.
fn end(stretch: &Stretch, radii: &[f64], usual: usize, grading: Grading) -> StretchEnd {
    let pairs = stretch.materials.windows(2).zip(&radii[1..]);
    let corners: Vec<f64> =
        pairs.filter(|(pair, _)| pair[0] != pair[1]).map(|(_, radius)| *radius).collect();
    let steps = if corners.is_empty() { usual } else { usual.max(grading.corner) };
    StretchEnd { steps, corners, matched: vec![] }
}

/// The border between two stretches, for the left and for the right one.
fn between(left: &Stretch, right: &Stretch, grading: Grading) -> [StretchEnd; 2] {
    let (inside, beyond) = (left.radii(left.to), right.radii(right.from));
    let same = SAME_RADIUS * inside[inside.len() - 1];
    match left.kinks(right) {
        Some(kinks) => {
            let at = kinks.iter().zip(&inside).filter(|(kink, _)| **kink >= grading.least_kink);
            let corners: Vec<f64> = at.map(|(_, radius)| *radius).collect();
            let steps = if corners.is_empty() { 0 } else { grading.kink };
            let border = StretchEnd { steps, corners, matched: vec![] };
            [border.clone(), border]
        }
        None => {
            let (low, high) = (inside[0].max(beyond[0]), {
                inside[inside.len() - 1].min(beyond[beyond.len() - 1])
            });
            let mut all: Vec<f64> = inside.iter().chain(&beyond).copied().collect();
            all.retain(|radius| *radius >= low - same && *radius <= high + same);
            all.sort_by(f64::total_cmp);
            all.dedup_by(|a, b| (*a - *b).abs() <= same);
            let sides = |radius: f64| {
                [(left, &inside), (right, &beyond)]
                    .map(|(stretch, radii)| around(stretch, radii, radius, same))
            };
            let (corners, matched) = all.into_iter().partition(|radius| {
                let [[a, b], [c, d]] = sides(*radius);
                a != c || b != d
            });
            let border = StretchEnd { steps: grading.corner, corners, matched };
            [border.clone(), border]
        }
    }
}

/// The materials just inside and just outside a radius.
fn around(stretch: &Stretch, radii: &[f64], radius: f64, same: f64) -> [Option<usize>; 2] {
    let at = |r: f64| {
        let k = radii.windows(2).position(|pair| pair[0] < r && r < pair[1])?;
        Some(stretch.materials[k])
    };
    [at(radius - 2.0 * same), at(radius + 2.0 * same)]
}

/// The columns of one stretch.
fn divide(
    stretch: &Stretch,
    [left, right]: [&StretchEnd; 2],
    shortest: f64,
    columns: &mut Vec<WallColumn>,
) {
    let length = stretch.to - stretch.from;
    let usual = (LENGTH * stretch.widest()).max(shortest);
    let count = (length / usual).ceil().max(1.0);
    let reach = length / count;
    // The number of steps for which the shortest column is as long as beside a usual column.
    let steps = |border: &StretchEnd, reach: f64| {
        let fewer = ((usual / reach).ln() / -STEP.ln() - 0.25).round().max(0.0) as usize;
        border.steps.saturating_sub(fewer)
    };
    let both = count < 1.5 && left.steps > 0 && right.steps > 0;
    let reach = if both { 0.5 * reach } else { reach };
    let mut places: Vec<f64> =
        (0..=count as usize).map(|k| stretch.from + length * k as f64 / count).collect();
    if both {
        places.insert(1, stretch.from + 0.5 * length);
    }
    places[0] = stretch.from;
    *places.last_mut().expect("two at least") = stretch.to;
    for k in 1..=steps(left, reach) {
        places.push(stretch.from + reach * STEP.powi(k as i32));
    }
    for k in 1..=steps(right, reach) {
        places.push(stretch.to - reach * STEP.powi(k as i32));
    }
    places.sort_by(f64::total_cmp);
    for pair in places.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let radii = stretch.along(from, to);
        let mut cuts: Vec<Vec<f64>> = vec![vec![]; stretch.materials.len()];
        let near = |place: f64, far: f64| (place - far).abs() <= reach * 1.5;
        for (border, place, far) in [(left, stretch.from, to), (right, stretch.to, from)] {
            if near(place, far) {
                let innermost = place == from || place == to;
                cut(&stretch.radii(place), border, (place - far).abs(), innermost, &mut cuts);
            }
        }
        columns.push(WallColumn { from, to, parts: layered(&stretch.materials, &radii, cuts) });
    }
}

/// The elements of a column, from the inside out: layers of these materials between these radii, each cut at the given
/// shares and into parts that are thin enough.
fn layered(materials: &[usize], radii: &[Radius], cuts: Vec<Vec<f64>>) -> Vec<LayerElement> {
    let mut parts = vec![];
    for (k, (material, mut cuts)) in materials.iter().zip(cuts).enumerate() {
        let thick = |xi: f64| {
            (radii[k + 1].at(xi)[0] - radii[k].at(xi)[0]) / radii[radii.len() - 1].at(xi)[0]
        };
        let thickest = [-1.0, 0.0, 1.0].map(thick).into_iter().fold(0.0, f64::max);
        even_out(&mut cuts, thickest / THICKNESS);
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|a, b| (*a - *b).abs() < 1e-7);
        let mut inner = radii[k].clone();
        for share in cuts {
            let outer = match share > 1.0 - 1e-7 {
                true => radii[k + 1].clone(),
                false => radii[k].towards(&radii[k + 1], share),
            };
            let next = outer.clone();
            parts.push(LayerElement { material: *material, inner, outer });
            inner = next;
        }
    }
    parts
}

/// Cuts a layer, already cut at these shares, into parts of at most 1/`count` of it; 1 counts as a cut.
fn even_out(cuts: &mut Vec<f64>, count: f64) {
    cuts.sort_by(f64::total_cmp);
    cuts.push(1.0);
    let mut start = 0.0;
    for end in cuts.clone() {
        let parts = ((end - start) * count - 1e-9).ceil().max(1.0);
        let more = (1..parts as usize).map(|k| start + (end - start) * k as f64 / parts);
        cuts.extend(more);
        start = end;
    }
}

/// Where the layers of a column are cut because of a border, as shares of the layers.
///
/// `radii` are the layers' radii at the border, `far` is the distance of the column's other end from it.
fn cut(radii: &[f64], border: &StretchEnd, far: f64, innermost: bool, cuts: &mut [Vec<f64>]) {
    let thickness = radii[radii.len() - 1] - radii[0];
    let same = 1e-6 * thickness;
    let places = border.corners.iter().chain(&border.matched);
    let fine = innermost || ACROSS * far <= thickness;
    let mut borders: Vec<f64> = radii.to_vec();
    if fine {
        borders.extend(
            places.filter(|radius| **radius > radii[0] && **radius < radii[radii.len() - 1]),
        );
    }
    borders.sort_by(f64::total_cmp);
    borders.dedup_by(|a, b| (*a - *b).abs() <= same);
    let mut add = |radius: f64| {
        let layer = radii.windows(2).position(|pair| radius > pair[0] && radius < pair[1]);
        if let Some(k) = layer {
            let share = (radius - radii[k]) / (radii[k + 1] - radii[k]);
            if share > 1e-7 && share < 1.0 - 1e-7 {
                cuts[k].push(share);
            }
        }
    };
    borders.iter().for_each(|radius| add(*radius));
    let is_corner = |radius: f64| border.corners.iter().any(|c| (c - radius).abs() <= same);
    for pair in borders.windows(2) {
        let size = pair[1] - pair[0];
        for (corner, sign) in [(pair[0], 1.0), (pair[1], -1.0)] {
            if !is_corner(corner) {
                continue;
            }
            let mut distance = STEP * size;
            let mut steps = 0;
            while distance >= ACROSS * far && steps < border.steps {
                add(corner + sign * distance);
                distance *= STEP;
                steps += 1;
            }
        }
    }
}
