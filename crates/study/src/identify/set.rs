//! Responses that were measured one after the other: where the hammer struck, where accelerometers were.

use std::path::PathBuf;

use crate::engine::{Error, Result};
use crate::files::measured::response::{Known, TURNED, read};
use crate::measured::response::MeasuredResponse;

/// A place on the bat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// The file's label, or a new number if equal labels of several files are different places.
    pub node: i64,
    /// Distance along the axis, from the file's own origin (m).
    pub x: f64,
}

/// A response of a set.
#[derive(Debug, Clone, PartialEq)]
pub struct SetResponse {
    /// Index of its reference, the part that stayed.
    pub reference: usize,
    /// Index of its point, the part that moved.
    pub point: usize,
    /// The response.
    pub measured: MeasuredResponse,
}

/// A set of responses.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponseSet {
    /// Points of the part that moved, along the axis.
    pub points: Vec<Place>,
    /// Places of the part that stayed.
    pub references: Vec<Place>,
    /// Whether the hammer moved; otherwise accelerometers did, or stood in a row.
    pub hammer_roves: bool,
    /// The responses.
    pub responses: Vec<SetResponse>,
    /// Assumptions in reading them, one sentence each.
    pub assumed: Vec<String>,
}

/// Places nearer than this are one (m).
const SAME: f64 = 1e-4;
/// With fewer frequencies no resonance can be found.
const FEWEST: usize = 24;

impl ResponseSet {
    /// Reads the responses of universal files, between two frequencies (Hz).
    ///
    /// # Errors
    ///
    /// Those of [`read`]; [`Error::Value`] for a file that is named twice, for a node without a place, for too few frequencies, and for references
    /// that share no point.
    pub fn read(files: &[PathBuf], known: &Known, band: [f64; 2]) -> Result<Self> {
        let mut all = vec![];
        let path = |file: &PathBuf| file.canonicalize().unwrap_or_else(|_| file.clone());
        for (k, file) in files.iter().enumerate() {
            if files[..k].iter().any(|other| path(other) == path(file)) {
                let name = file.display().to_string();
                return Err(Error::value(name, "it twice", "every file of responses once"));
            }
            all.extend(read(file, known)?.into_iter().map(|(_, response)| response));
        }
        for one in &mut all {
            let within = |(f, _): &(f64, _)| (band[0]..=band[1]).contains(f);
            if let Some(coherence) = &mut one.coherence {
                let mut kept = one.values.iter().map(within);
                coherence.retain(|_| kept.next().unwrap_or(false));
            }
            one.values.retain(within);
        }
        Self::of(all)
    }

    /// The set of these responses.
    ///
    /// # Errors
    ///
    /// As [`Self::read`].
    pub fn of(mut all: Vec<MeasuredResponse>) -> Result<Self> {
        let copies = drop_copies(&mut all);
        turn_alike(&mut all);
        let [mut forces, mut answers] = [vec![], vec![]];
        for one in &all {
            let few = one.values.len();
            if few < FEWEST {
                let expected = format!("{FEWEST} at least, over several resonances");
                return Err(Error::value(&one.source, format!("{few} frequencies"), expected));
            }
            for (places, at, node) in
                [(&mut forces, one.at, one.nodes[0]), (&mut answers, one.to, one.nodes[1])]
            {
                let x = at.ok_or_else(|| no_place(&one.source, node))?;
                if !places.iter().any(|place: &Place| (place.x - x).abs() < SAME) {
                    places.push(Place { node, x });
                }
            }
        }
        let hammer_roves = answers.len() <= forces.len();
        let (mut points, mut references) =
            if hammer_roves { (forces, answers) } else { (answers, forces) };
        renumber(&mut points, &mut references);
        points.sort_by(|a, b| a.x.total_cmp(&b.x));
        let nearest = |places: &[Place], x: Option<f64>| {
            let off = |place: &Place| (place.x - x.unwrap_or(f64::NAN)).abs();
            places.iter().position(|place| off(place) < SAME).unwrap_or(0)
        };
        let mut assumed: Vec<String> = copies.into_iter().collect();
        let mut responses = vec![];
        for measured in all {
            let (roved, stayed) =
                if hammer_roves { (measured.at, measured.to) } else { (measured.to, measured.at) };
            for said in &measured.assumed {
                if !assumed.contains(said) {
                    assumed.push(said.clone());
                }
            }
            let (reference, point) = (nearest(&references, stayed), nearest(&points, roved));
            responses.push(SetResponse { reference, point, measured });
        }
        let set = Self { points, references, hammer_roves, responses, assumed };
        set.check_references()?;
        Ok(set)
    }

    /// The response of that reference with hammer and accelerometer at one place.
    pub fn drive(&self, reference: usize) -> Option<usize> {
        self.beside(reference, reference)
    }

    /// The response of one reference at the place of another.
    pub fn beside(&self, reference: usize, other: usize) -> Option<usize> {
        let x = self.references[other].x;
        let own = |one: &SetResponse| {
            one.reference == reference && (self.points[one.point].x - x).abs() < SAME
        };
        self.responses.iter().position(own)
    }

    /// Every reference shares a point with the one that has most, or shapes cannot be put together.
    fn check_references(&self) -> Result<()> {
        let of = |r: usize| -> Vec<usize> {
            let own = self.responses.iter().filter(|one| one.reference == r);
            own.map(|one| one.point).collect()
        };
        let count = self.references.len();
        let main = (0..count).max_by_key(|r| of(*r).len()).map_or(vec![], of);
        match (0..count).find(|r| !of(*r).iter().any(|point| main.contains(point))) {
            None => Ok(()),
            Some(r) => {
                let (x, who) = (self.references[r].x, self.fixed());
                let found = format!(
                    "{count} places of the {who}, that at {x} m without a point of the others"
                );
                let expected = "one place, or places that share a point that roved";
                Err(Error::value(&self.responses[0].measured.source, found, expected))
            }
        }
    }

    /// The part that stayed.
    pub fn fixed(&self) -> &'static str {
        if self.hammer_roves { "accelerometer" } else { "hammer" }
    }
}

/// Drops copies of a response, whose noise is the same, and returns a message.
fn drop_copies(all: &mut Vec<MeasuredResponse>) -> Option<String> {
    let before = all.len();
    let mut kept: Vec<MeasuredResponse> = vec![];
    for one in all.drain(..) {
        let same = |other: &MeasuredResponse| {
            (other.kind, other.at, other.to) == (one.kind, one.at, one.to)
                && other.values == one.values
        };
        if !kept.iter().any(same) {
            kept.push(one);
        }
    }
    *all = kept;
    let dropped = before - all.len();
    (dropped > 0).then(|| {
        let what = if dropped == 1 { "response is a copy" } else { "responses are copies" };
        format!("{dropped} {what} of others and left out: they tell nothing new")
    })
}

/// Turns the responses of one test the way that most of them run, because noise may turn one.
fn turn_alike(all: &mut [MeasuredResponse]) {
    let turned = 2 * all.iter().filter(|one| one.turned).count() > all.len();
    for one in all.iter_mut().filter(|one| one.turned != turned) {
        one.values.iter_mut().for_each(|(_, value)| *value = value.conj());
        one.assumed.retain(|said| said != TURNED);
        one.turned = turned;
    }
}

fn no_place(source: &str, node: i64) -> Error {
    let expected = "its place in a dataset 15 or 2411, or by --places";
    Error::value(source, format!("node {node} without a place"), expected)
}

/// Labels of several files that are not one place are numbered anew.
fn renumber(points: &mut [Place], references: &mut [Place]) {
    let twice = |places: &[Place]| {
        (0..places.len()).any(|k| places[..k].iter().any(|other| other.node == places[k].node))
    };
    if twice(points) || twice(references) {
        let all = points.iter_mut().chain(references);
        (1..).zip(all).for_each(|(number, place)| place.node = number);
    }
}
