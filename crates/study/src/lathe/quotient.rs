//! In how many ways is a derivative computed by differences, and how far do these differ?

use crate::comparison::contender::Figure;
use crate::lathe::gauges::Gauge;

/// Number of ways for a derivative: by the gauges, by places half as far apart, without the last two modes, without the
/// last quarter of them. The gauges of each way have their own places.
pub(super) const WAYS: usize = 4;

/// The gauges of the other ways.
pub(super) struct Ways {
    /// By places half as far apart.
    pub closer: Vec<Option<Gauge>>,
    /// Without the last two modes and without the last quarter, with the remaining number of modes; empty if no modes
    /// are omitted.
    pub fewer: Vec<(usize, Vec<Option<Gauge>>)>,
}

/// The values for differences in every way, answer by answer.
pub(super) type ByWay = [Vec<Option<f64>>; WAYS];

/// A quotient of differences, answer by answer.
pub(super) struct Quotient {
    /// Whether it is central; otherwise one-sided.
    pub central: bool,
    /// In every way.
    pub by_way: ByWay,
}

impl Quotient {
    /// Possible error of an answer's slope due to its way: the effect of the last two modes or the last quarter of
    /// them, and that of the distance of places, whose error is at least proportional to the distance.
    pub(super) fn apart(&self, k: usize) -> f64 {
        let [whole, closer, fewer @ ..] = self.by_way.each_ref().map(|way| way[k]);
        let off = |other: Option<f64>| match (whole, other) {
            (Some(whole), Some(other)) => (whole - other).abs(),
            _ => 0.0,
        };
        2.0 * off(closer) + fewer.map(off).into_iter().fold(0.0, f64::max)
    }
}

/// The differences of a change: by the whole step, and by half of it if that was computed.
pub(super) struct Differences {
    /// By the whole step.
    pub whole: Quotient,
    /// By half of it.
    pub half: Option<Quotient>,
    /// By the whole step, the wall solved finely.
    pub finer: Option<Quotient>,
}

/// Usual values among changes, answer by answer.
#[derive(Default)]
pub(super) struct Usual {
    /// Mean difference of the ways: if two ways agree by chance, their differences elsewhere are more reliable.
    apart: Vec<f64>,
    /// The largest error of the step; None where no step was halved.
    step: Vec<Option<f64>>,
    /// Change by a fine wall as a share of the derivative, and the derivative's usual size.
    wall: Vec<[f64; 2]>,
}

impl Usual {
    pub(super) fn of(found: &[Differences], answers: usize) -> Self {
        let mean =
            |k: usize| found.iter().map(|of| of.whole.apart(k)).sum::<f64>() / found.len() as f64;
        let largest = |k: usize| found.iter().filter_map(|of| of.step(k)).reduce(f64::max);
        let wall = |k: usize| {
            let pair = |of: &Differences| {
                let finer = of.finer.as_ref()?.by_way[0][k]?;
                Some([(finer - of.whole.by_way[0][k]?).abs(), finer.abs()])
            };
            let pairs: Vec<[f64; 2]> = found.iter().filter_map(pair).collect();
            let sum = |which: usize| pairs.iter().map(|pair| pair[which]).sum::<f64>();
            let share = if sum(1) > 0.0 { sum(0) / sum(1) } else { 0.0 };
            [share, sum(1) / pairs.len().max(1) as f64]
        };
        Self {
            apart: (0..answers).map(mean).collect(),
            step: (0..answers).map(largest).collect(),
            wall: (0..answers).map(wall).collect(),
        }
    }
}

impl Differences {
    pub(super) fn new(whole: Quotient) -> Self {
        Self { whole, half: None, finer: None }
    }

    /// The error of a central difference due to its step: four thirds of the change with half of the step.
    fn step(&self, k: usize) -> Option<f64> {
        let half = self.half.as_ref().filter(|half| half.central && self.whole.central)?;
        Some(4.0 / 3.0 * (self.whole.by_way[0][k]? - half.by_way[0][k]?).abs())
    }

    /// The derivative. Its error has three parts: that of the step (if this step was not halved, the largest that was
    /// seen), the difference of the ways (at least the usual one of such an answer), and the change by a finer wall for
    /// derivatives where that was computed.
    pub(super) fn joined(&self, k: usize, usual: &Usual) -> Option<Figure> {
        let whole = self.whole.by_way[0][k]?;
        let [share, size] = usual.wall[k];
        let apart = self.whole.apart(k).max(usual.apart[k]) + share * (whole.abs() + size);
        if let Some(half) = self.half.as_ref().filter(|half| !(half.central && self.whole.central))
        {
            let half = half.by_way[0][k]?;
            return Some(Figure::new(2.0 * half - whole, (whole - half).abs() + apart));
        }
        Some(match self.step(k).or(usual.step[k]) {
            Some(step) => Figure::new(whole, step + apart),
            None => Figure::new(whole, 0.0),
        })
    }

    /// Two steps combined to fourth order, if both were computed and are central.
    pub(super) fn fourth_order(&self, k: usize) -> Option<f64> {
        let half = self.half.as_ref().filter(|half| half.central && self.whole.central)?;
        Some((4.0 * half.by_way[0][k]? - self.whole.by_way[0][k]?) / 3.0)
    }
}
