//! The pass over one side of a bat: outwards from its root, or reversed, inwards.
//!
//! A side is a row of cells. A [`Stop`] is a border of two cells with a fixture. [`runs`] goes from stop to stop;
//! reversed it is the pass inwards, which reaches a stop before the cells of its run.

use std::ops::Range;

/// A fixture at the border of two cells.
#[derive(Debug, Clone, Copy)]
pub struct Stop {
    /// Number of cells of this side before it.
    pub after: usize,
    /// The fixture.
    pub what: What,
}

/// The kind of a [`Stop`], and its index among its kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum What {
    /// A point mass.
    PointMass(usize),
    /// A joint.
    Joint(usize),
    /// A contact.
    Contact(usize),
}

/// Consecutive cells, and the fixture at their outer end.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The cells, outwards; empty between two stops at one border.
    pub cells: Range<usize>,
    /// The fixture at their outer end; `None` at the end of the bat.
    pub stop: Option<What>,
}

/// The indices of the cells of side 0, the knob's, or 1, the tip's, of `count` cells.
#[inline(always)]
pub fn side_of(split: usize, count: usize, side: usize) -> Range<usize> {
    if side == 0 { 0..split } else { split..count }
}

/// The cells of a side from stop to stop.
#[inline(always)]
pub fn runs(cells: Range<usize>, stops: &[Stop]) -> impl DoubleEndedIterator<Item = Run> {
    let (first, last) = (cells.start, cells.end);
    (0..=stops.len()).map(move |k| Run {
        cells: if k == 0 { first } else { first + stops[k - 1].after }
            ..stops.get(k).map_or(last, |stop| first + stop.after),
        stop: stops.get(k).map(|stop| stop.what),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(cells: Range<usize>, stop: Option<What>) -> Run {
        Run { cells, stop }
    }

    #[test]
    fn stops_at_the_root_at_one_border_and_at_the_end_are_all_met() {
        let what = [What::Contact(0), What::Joint(0), What::PointMass(1), What::Contact(1)];
        let after = [0, 2, 2, 5];
        let stops: Vec<Stop> =
            after.into_iter().zip(what).map(|(after, what)| Stop { after, what }).collect();
        let met: Vec<Run> = runs(3..8, &stops).collect();
        let [a, b, c, d] = what.map(Some);
        assert_eq!(met, [run(3..3, a), run(3..5, b), run(5..5, c), run(5..8, d), run(8..8, None)]);
    }

    #[test]
    fn a_side_without_stops_is_one_run() {
        assert_eq!(runs(0..4, &[]).collect::<Vec<Run>>(), [run(0..4, None)]);
    }
}
