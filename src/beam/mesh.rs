//! Where are the elements: stretches of the bat, none across a station or a step.

use serde::Serialize;

use crate::bat::body::Bat;

/// One element: a part of one piece of the profile.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Element {
    /// Index of the piece of the profile it lies in.
    pub piece: usize,
    /// Where in the piece it begins, in [0, 1].
    pub from: f64,
    /// Where in the piece it ends, in [0, 1].
    pub to: f64,
    /// Position of its left end from the knob end (m).
    pub start: f64,
    /// Length h (m).
    pub length: f64,
}

/// The elements of a bat from knob to tip.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Mesh {
    /// Knob first, each beginning where the last ends.
    pub elements: Vec<Element>,
}

impl Mesh {
    /// About `wanted` elements spread by length, equal within each piece: exactly that many if
    /// there are no more pieces than that, else one per piece.
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
                from: at(j),
                to: at(j + 1),
                start: piece.start + piece.length * at(j),
                length: piece.length / count as f64,
            }));
        }
        Self { elements }
    }

    /// A mesh with borders where `write` puts them on each piece, `s` rising from 0 to 1.
    pub fn with_borders(bat: &Bat, mut write: impl FnMut(usize, &mut Vec<f64>)) -> Self {
        let (mut elements, mut borders) = (Vec::with_capacity(bat.profile().pieces.len()), vec![]);
        for (k, piece) in bat.profile().pieces.iter().enumerate() {
            borders.clear();
            write(k, &mut borders);
            elements.extend(borders.windows(2).map(|s| Element {
                piece: k,
                from: s[0],
                to: s[1],
                start: piece.start + piece.length * s[0],
                length: piece.length * (s[1] - s[0]),
            }));
        }
        Self { elements }
    }

    /// A finer mesh: this one with element `k` cut into `parts(k)` equal parts.
    pub fn refined(&self, parts: impl Fn(usize) -> usize) -> Self {
        let mut elements = Vec::with_capacity(self.len());
        for (k, e) in self.elements.iter().enumerate() {
            let parts = parts(k);
            let share = |j: usize| j as f64 / parts as f64;
            let at = |j: usize| e.from + (e.to - e.from) * share(j);
            elements.extend((0..parts).map(|j| Element {
                piece: e.piece,
                from: at(j),
                to: if j + 1 == parts { e.to } else { at(j + 1) },
                start: e.start + e.length * share(j),
                length: e.length / parts as f64,
            }));
        }
        Self { elements }
    }

    /// Becomes the pattern's mesh on another bat of as many pieces, in the memory that it has.
    pub fn fit(&mut self, bat: &Bat, pattern: &Self) {
        self.elements.clear();
        for e in &pattern.elements {
            let piece = &bat.profile().pieces[e.piece];
            self.elements.push(Element {
                start: piece.start + piece.length * e.from,
                length: piece.length * (e.to - e.from),
                ..*e
            });
        }
    }

    /// Middle and length of every element (m).
    pub fn stretches(&self) -> Vec<(f64, f64)> {
        self.elements.iter().map(|e| (e.start + 0.5 * e.length, e.length)).collect()
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.elements.len()
    }

    /// Whether there is no element; a mesh of a bat has one at least.
    pub fn is_empty(&self) -> bool {
        self.elements.is_empty()
    }

    /// Positions of the nodes, one more than elements (m).
    pub fn nodes(&self) -> Vec<f64> {
        let last = self.elements.last().map(|e| e.start + e.length);
        self.elements.iter().map(|e| e.start).chain(last).collect()
    }
}

/// `total` elements over pieces of these lengths, the longest element as short as can be.
fn spread(lengths: &[f64], total: usize) -> Vec<usize> {
    if lengths.len() == 1 {
        return vec![total.max(1)];
    }
    let count = |length: &f64, size: f64| ((length / size).ceil() as usize).clamp(1, total.max(1));
    // Rounding up adds one element per piece at most: that brackets the element size.
    let whole: f64 = lengths.iter().sum();
    let spare = total.saturating_sub(lengths.len()) as f64;
    let (mut low, mut high) = (whole / total.max(1) as f64, whole / spare.max(0.5));
    for _ in 0..16 {
        let middle = 0.5 * (low + high);
        let sum: usize = lengths.iter().map(|length| count(length, middle)).sum();
        if sum > total { low = middle } else { high = middle }
    }
    let mut counts: Vec<usize> = lengths.iter().map(|length| count(length, high)).collect();
    // Pieces of nearly equal length leave a remainder: one more for the longest elements.
    let missing = total.saturating_sub(counts.iter().sum());
    let mut order: Vec<usize> = (0..lengths.len()).collect();
    // In few digits, so that lengths equal but for their rounding tie, whatever the unit.
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
