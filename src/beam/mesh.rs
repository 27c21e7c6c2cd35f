//! Where are the elements? They are stretches of the bat that never cross a step or the end of a region.
//!
//! An element lies in one piece of the profile, or it reaches over stations ([`Element::parts`]).

use serde::Serialize;

use crate::bat::{Bat, SAME_PLACE};

/// One element: a stretch of the profile.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Element {
    /// Index of the piece of the profile it begins in.
    pub piece: usize,
    /// Index of the piece it ends in.
    pub last: usize,
    /// Position in its first piece where it begins, in [0, 1).
    pub from: f64,
    /// Position in its last piece where it ends, in (0, 1].
    pub to: f64,
    /// Position of its left end from the knob end (m).
    pub start: f64,
    /// Length h (m).
    pub length: f64,
}

/// A part of an element between two stations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElementPart {
    /// Index of the piece of the profile it lies in.
    pub piece: usize,
    /// Beginning and end in the piece, in [0, 1].
    pub of_piece: [f64; 2],
    /// Beginning and end in the element, in [0, 1].
    pub of_element: [f64; 2],
}

impl Element {
    /// The element from one place to another, each given by a piece and a position in it, in [0, 1].
    fn between(bat: &Bat, [from, to]: [(usize, f64); 2]) -> Self {
        let (piece, from) = if from.1 < 1.0 { from } else { (from.0 + 1, 0.0) };
        let (last, to) = if to.1 > 0.0 { to } else { (to.0 - 1, 1.0) };
        let mut element = Self { piece, last, from, to, start: 0.0, length: 0.0 };
        element.place(bat);
        element
    }

    /// Sets position and length from the bat's pieces.
    fn place(&mut self, bat: &Bat) {
        let [first, last] = [self.piece, self.last].map(|piece| &bat.profile().pieces[piece]);
        self.start = first.start + first.length * self.from;
        self.length = match self.piece == self.last {
            true => first.length * (self.to - self.from),
            false => last.start + last.length * self.to - self.start,
        };
    }

    /// Whether the whole element is within that share of the bat's length from one of the ends.
    pub fn ends_within(&self, share: f64, length: f64) -> bool {
        self.start + self.length <= share * length || self.start >= (1.0 - share) * length
    }

    /// Whether there are stations inside.
    #[inline(always)]
    pub fn over_stations(&self) -> bool {
        self.last > self.piece
    }

    /// Its parts between stations, knob first; a single part if there are no stations inside.
    pub fn parts<'a>(&'a self, bat: &'a Bat) -> impl Iterator<Item = ElementPart> + 'a {
        let mut end = 0.0;
        (self.piece..=self.last).map(move |k| {
            let piece = &bat.profile().pieces[k];
            let from = if k == self.piece { self.from } else { 0.0 };
            let to = if k == self.last { self.to } else { 1.0 };
            let begin = end;
            end = match k == self.last {
                true => 1.0,
                false => (piece.start + piece.length - self.start) / self.length,
            };
            ElementPart { piece: k, of_piece: [from, to], of_element: [begin, end] }
        })
    }

    /// The piece at a place in [0, 1] of the element, and the position in the piece.
    fn at(&self, bat: &Bat, s: f64) -> (usize, f64) {
        let part = self.parts(bat).find(|part| s <= part.of_element[1]);
        let ElementPart { piece, of_piece: [from, to], of_element: [begin, end] } =
            part.expect("the last part ends at 1");
        (piece, from + (to - from) * (s - begin) / (end - begin))
    }
}

/// The elements of a bat from knob to tip.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Mesh {
    /// The elements, knob first; each begins where the last one ends.
    pub elements: Vec<Element>,
}

impl Mesh {
    /// About `wanted` elements distributed by length, equal within each piece: exactly that many if there are at most
    /// as many pieces, else one per piece.
    pub fn along(bat: &Bat, wanted: usize) -> Self {
        let lengths: Vec<f64> = bat.profile().pieces.iter().map(|piece| piece.length).collect();
        Self::with_counts(bat, &spread(&lengths, wanted))
    }

    /// A mesh with that many equal elements in each piece of the profile.
    pub fn with_counts(bat: &Bat, counts: &[usize]) -> Self {
        let mut elements = Vec::with_capacity(counts.iter().sum());
        for (k, (piece, &count)) in bat.profile().pieces.iter().zip(counts).enumerate() {
            let at = |j: usize| j as f64 / count as f64;
            elements.extend((0..count).map(|j| Element {
                piece: k,
                last: k,
                from: at(j),
                to: at(j + 1),
                start: piece.start + piece.length * at(j),
                length: piece.length / count as f64,
            }));
        }
        Self { elements }
    }

    /// A mesh with borders at these places, each given by a piece and a position in it, from 0 to 1 along the bat. The
    /// end of a piece and the beginning of the next are the same place.
    pub fn between(bat: &Bat, borders: &[(usize, f64)]) -> Self {
        let elements = borders.windows(2).map(|pair| Element::between(bat, [pair[0], pair[1]]));
        Self { elements: elements.collect() }
    }

    /// This mesh with an element border at each of these places (m), to round-off. Stations of the bat are at these
    /// places, and elements over stations are cut there.
    pub fn with_nodes(&self, bat: &Bat, places: &[f64]) -> Self {
        let mut elements = Vec::with_capacity(self.len() + places.len());
        for e in &self.elements {
            let inner = (e.piece + 1..=e.last).filter(|k| {
                let start = bat.profile().pieces[*k].start;
                places.iter().any(|x| (x - start).abs() <= SAME_PLACE * bat.length())
            });
            let ends: Vec<(usize, f64)> =
                [(e.piece, e.from)].into_iter().chain(inner.map(|k| (k, 0.0))).collect();
            let ends: Vec<(usize, f64)> = ends.into_iter().chain([(e.last, e.to)]).collect();
            match ends.len() {
                2 => elements.push(*e),
                _ => elements.extend(Self::between(bat, &ends).elements),
            }
        }
        Self { elements }
    }

    /// A finer mesh: this one with element `k` cut into `parts(k)` equal parts.
    pub fn refined(&self, bat: &Bat, parts: impl Fn(usize) -> usize) -> Self {
        let mut elements = Vec::with_capacity(self.len());
        for (k, e) in self.elements.iter().enumerate() {
            let parts = parts(k);
            let share = |j: usize| j as f64 / parts as f64;
            if e.over_stations() && parts > 1 {
                let at = |j: usize| match j {
                    0 => (e.piece, e.from),
                    j if j == parts => (e.last, e.to),
                    j => e.at(bat, share(j)),
                };
                elements.extend((0..parts).map(|j| Element::between(bat, [at(j), at(j + 1)])));
                continue;
            }
            let at = |j: usize| e.from + (e.to - e.from) * share(j);
            elements.extend((0..parts).map(|j| Element {
                from: at(j),
                to: if j + 1 == parts { e.to } else { at(j + 1) },
                start: e.start + e.length * share(j),
                length: e.length / parts as f64,
                ..*e
            }));
        }
        Self { elements }
    }

    /// Sets this mesh to the pattern's mesh on another bat with the same number of pieces, and reuses its memory.
    pub fn fit(&mut self, bat: &Bat, pattern: &Self) {
        self.elements.clone_from(&pattern.elements);
        self.elements.iter_mut().for_each(|e| e.place(bat));
    }

    /// Whether an element has stations inside.
    pub fn over_stations(&self) -> bool {
        self.elements.iter().any(Element::over_stations)
    }

    /// Middle and length of every element (m).
    pub fn stretches(&self) -> Vec<(f64, f64)> {
        self.elements.iter().map(|e| (e.start + 0.5 * e.length, e.length)).collect()
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.elements.len()
    }

    /// Whether there is no element; a bat's mesh has at least one.
    pub fn is_empty(&self) -> bool {
        self.elements.is_empty()
    }

    /// Positions of the nodes, one more than elements (m).
    pub fn nodes(&self) -> Vec<f64> {
        let last = self.elements.last().map(|e| e.start + e.length);
        self.elements.iter().map(|e| e.start).chain(last).collect()
    }
}

/// Distributes `total` elements over pieces of these lengths, so that the longest element is as short as possible.
fn spread(lengths: &[f64], total: usize) -> Vec<usize> {
    if lengths.len() == 1 {
        return vec![total.max(1)];
    }
    let count = |length: &f64, size: f64| ((length / size).ceil() as usize).clamp(1, total.max(1));
    // Rounding up adds at most one element per piece, which brackets the element size.
    let whole: f64 = lengths.iter().sum();
    let spare = total.saturating_sub(lengths.len()) as f64;
    let (mut low, mut high) = (whole / total.max(1) as f64, whole / spare.max(0.5));
    for _ in 0..16 {
        let middle = 0.5 * (low + high);
        let sum: usize = lengths.iter().map(|length| count(length, middle)).sum();
        if sum > total { low = middle } else { high = middle }
    }
    let mut counts: Vec<usize> = lengths.iter().map(|length| count(length, high)).collect();
    // Pieces of nearly equal length leave a remainder: one more element for each of the longest.
    let missing = total.saturating_sub(counts.iter().sum());
    let mut order: Vec<usize> = (0..lengths.len()).collect();
    // In few digits, so that lengths equal but for round-off tie, whatever the unit.
    let size = |k: usize, counts: &[usize]| (lengths[k] / (whole * counts[k] as f64)) as f32;
    order.sort_by(|&a, &b| size(b, &counts).total_cmp(&size(a, &counts)));
    order.iter().cycle().take(missing).for_each(|&k| counts[k] += 1);
    counts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_are_spread_by_length_and_none_is_lost() {
        assert_eq!(spread(&[1.0], 7), [7]);
        assert_eq!(spread(&[1.0, 3.0], 8), [2, 6]);
        assert_eq!(spread(&[1.0, 1.0, 1.0], 2), [1, 1, 1]);
        for total in 3..40 {
            assert_eq!(spread(&[0.3, 0.3, 0.3], total).iter().sum::<usize>(), total);
            assert_eq!(spread(&[0.01, 2.0, 0.4], total).iter().sum::<usize>(), total);
        }
    }

    #[test]
    fn lengths_equal_but_for_their_rounding_tie_in_any_unit() {
        let x = [0.0, 0.065, 0.09, 0.25, 0.275, 0.475, 0.5];
        let lengths =
            |unit: f64| -> Vec<f64> { x.windows(2).map(|x| x[1] * unit - x[0] * unit).collect() };
        for total in 7..30 {
            for unit in [10.0, 1e-3, 25.4] {
                assert_eq!(spread(&lengths(unit), total), spread(&lengths(1.0), total), "{total}");
            }
        }
    }
}
