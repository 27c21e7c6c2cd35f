//! In how many ways is a derivative found by differences, and how far are these apart?

use crate::comparison::contender::Figure;
use crate::lathe::gauges::Gauge;

/// In how many ways a derivative is found: by the gauges, by places half as far apart, without the last two modes,
/// without the last quarter of them. The gauges of each way have the places that it finds.
pub(super) const WAYS: usize = 4;

/// The gauges of the other ways.
pub(super) struct Ways {
    /// By places half as far apart.
    pub closer: Vec<Option<Gauge>>,
    /// Without the last two modes and without the last quarter, with the number of modes that is left; none where
    /// modes are not left out.
    pub fewer: Vec<(usize, Vec<Option<Gauge>>)>,
}

/// What differences are taken of, answer by answer.
#[derive(Debug, Clone, Default)]
pub(super) struct Raw {
    /// In every way.
    pub by_way: [Vec<Option<f64>>; WAYS],
}

/// A quotient of differences, answer by answer.
pub(super) struct Quotient {
    /// Whether it is about the bat as it is; else to one side.
    pub central: bool,
    /// In every way.
    pub by_way: [Vec<Option<f64>>; WAYS],
}

impl Quotient {
    /// How far an answer's slope may be off by its way: by what the last two modes or the last quarter of them do to
    /// it, and by the distance of places, whose error falls with that at least.
    pub(super) fn apart(&self, k: usize) -> f64 {
        let [whole, closer, fewer @ ..] = self.by_way.each_ref().map(|way| way[k]);
        let off = |other: Option<f64>| match (whole, other) {
            (Some(whole), Some(other)) => (whole - other).abs(),
            _ => 0.0,
        };
        2.0 * off(closer) + fewer.map(off).into_iter().fold(0.0, f64::max)
    }
}

/// The derivative from differences by one step or two. Its error is that of the step, and how far the ways are
/// apart, or `usual`ly of such an answer.
pub(super) fn joined(differences: &[Quotient], k: usize, usual: f64) -> Option<Figure> {
    let [first, rest @ ..] = differences else { return None };
    let whole = first.by_way[0][k]?;
    let Some(second) = rest.first() else { return Some(Figure::new(whole, 0.0)) };
    let half = second.by_way[0][k]?;
    let apart = first.apart(k).max(usual);
    match first.central && second.central {
        // The half step's error is a third of the difference.
        true => Some(Figure::new(whole, 4.0 / 3.0 * (whole - half).abs() + apart)),
        false => Some(Figure::new(2.0 * half - whole, (whole - half).abs() + apart)),
    }
}
