//! Curves and points in a diagram, with their legend.

use crate::plot::plane::{Frame, Plane};
use crate::plot::route::Point;
use crate::plot::svg::{Mark, Pen, Svg};
use crate::plot::theme::{FRAME, Ink, SERIES};
use crate::plot::words::{LABEL, SMALL, fitted, width};

/// A curve, or points.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// Pen of the line.
    pub pen: Pen,
    /// Whether the points are joined.
    pub joined: bool,
    /// Mark at every point, if any.
    pub mark: Option<Mark>,
    /// Half height of an error bar at every point, in the unit of y; 0 for none.
    pub error: f64,
    /// Values in the units of the axes; None leaves a gap.
    pub points: Vec<Option<[f64; 2]>>,
    /// Colour and opacity of the interior of the closed line through its points, if filled.
    pub fill: Option<(Ink, f64)>,
    /// Whether tooltips show its name and values.
    pub told: bool,
}

impl Series {
    /// A curve in the pen of the k-th.
    pub fn curve(name: &str, k: usize, points: Vec<Option<[f64; 2]>>) -> Self {
        let (pen, name) = (Pen::of(k), name.to_owned());
        Self { name, pen, joined: true, mark: None, error: 0.0, points, fill: None, told: true }
    }

    /// The same value from end to end, thin and grey, as a limit is drawn.
    pub fn level(name: &str, value: f64, ends: [f64; 2]) -> Self {
        let points = ends.map(|x| Some([x, value])).to_vec();
        Self::curve(name, 0, points).pen(Pen::new(SERIES[5], 1.4)).untold()
    }

    /// This series drawn with that pen.
    pub fn pen(self, pen: Pen) -> Self {
        Self { pen, ..self }
    }

    /// This series as points of that mark, which no line joins.
    pub fn dots(self, mark: Mark) -> Self {
        Self { joined: false, mark: Some(mark), ..self }
    }

    /// This series without words where a pointer rests.
    pub fn untold(self) -> Self {
        Self { told: false, ..self }
    }

    /// This series with its inside filled.
    pub fn filled(self, ink: Ink, opacity: f64) -> Self {
        Self { fill: Some((ink, opacity)), ..self }
    }

    /// The parts of it without a gap and inside the frame.
    fn runs(&self, plane: &Plane) -> Vec<Vec<[f64; 2]>> {
        let within = |[a, b]: &[f64; 2]| plane.x.holds(*a) && plane.y.holds(*b);
        let seen: Vec<Option<[f64; 2]>> = self.points.iter().map(|p| p.filter(within)).collect();
        seen.split(Option::is_none).map(|run| run.iter().flatten().copied().collect()).collect()
    }

    /// Draws it.
    pub fn draw(&self, svg: &mut Svg, plane: &Plane) {
        for run in self.runs(plane) {
            let points: Vec<Point> = run.iter().map(|point| plane.at(*point)).collect();
            match self.fill {
                Some((ink, opacity)) => {
                    svg.area(&points, ink, opacity, self.joined.then_some(self.pen));
                }
                None if self.joined => svg.line(&points, self.pen),
                None => {}
            }
            for (value, point) in run.iter().zip(&points) {
                self.error_bar(svg, plane, *value);
                if let Some(mark) = self.mark {
                    svg.mark(mark, *point, 4.0, self.pen.ink, false);
                }
            }
        }
    }

    fn error_bar(&self, svg: &mut Svg, plane: &Plane, [a, b]: [f64; 2]) {
        if self.error <= 0.0 {
            return;
        }
        let pen = Pen::new(self.pen.ink, 1.2);
        let ends = [b - self.error, b + self.error].map(|b| plane.at([a, b]));
        svg.line(&ends, pen);
        for [x, y] in ends {
            svg.line(&[[x - 3.0, y], [x + 3.0, y]], pen);
        }
    }

    /// A sample of it with that width.
    fn sample(&self, svg: &mut Svg, [x, y]: Point, wide: f64) {
        if let Some((ink, opacity)) = self.fill {
            svg.rect([[x, y - 5.6], [x + wide, y + 5.4]], ink, opacity, None);
        } else if self.joined {
            svg.line(&[[x, y], [x + wide, y]], self.pen);
        }
        if let Some(mark) = self.mark {
            svg.mark(mark, [x + 0.5 * wide, y], 4.0, self.pen.ink, false);
        }
    }
}

/// The values of all curves.
pub fn heights(curves: &[Series]) -> impl Iterator<Item = f64> {
    curves.iter().flat_map(|curve| curve.points.iter().flatten()).map(|[_, value]| *value)
}

/// Tooltips on curves: sixty places in all, because a curve needs no more to be read.
pub fn hover(svg: &mut Svg, plane: &Plane, curves: &[Series]) {
    const MOST: usize = 60;
    let told: Vec<&Series> = curves.iter().filter(|curve| curve.told).collect();
    let [x, y] = [plane.x.unit, plane.y.unit];
    for curve in &told {
        let name = fitted(&curve.name, LABEL, 240.0);
        let words = |[a, b]: [f64; 2]| {
            let [a, b] = [a * plane.x.per, b * plane.y.per].map(short);
            let value = format!("{name}: {a} {x}, {b} {y}");
            value.trim_end().to_owned()
        };
        let all = curve.runs(plane).concat();
        let points: Vec<_> = all.into_iter().map(|at| (plane.at(at), words(at))).collect();
        svg.hover(&points, (MOST / told.len()).max(8));
    }
}

/// A number with four digits, without zeros at its end.
pub fn short(value: f64) -> String {
    digits(value, 4)
}

/// A number with the given number of digits, without trailing zeros.
pub fn digits(value: f64, count: i32) -> String {
    if value == 0.0 || !value.is_finite() {
        return "0".into();
    }
    let places = value.abs().log10().floor() as i32;
    if !(-4..7).contains(&places) {
        return format!("{value:.2e}").replace('-', "−");
    }
    let decimals = (count - 1 - places).max(0) as usize;
    let text = format!("{value:.decimals$}").replace('-', "−");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// A legend of names with samples below the head, in as many rows as needed. Returns the base line of the last row, or
/// the end of the head without names.
pub fn legend(svg: &mut Svg, series: &[Series]) -> f64 {
    let sheet = svg.sheet;
    if series.is_empty() {
        return sheet.head();
    }
    let left = if sheet.narrow() { 12.0 } else { sheet.left() };
    let ends = [left, sheet.head() + 10.0, svg.width - 12.0];
    legend_between(svg, series, ends)
}

/// A legend between two ends, with its first row at `y`.
pub fn legend_between(svg: &mut Svg, series: &[Series], [left, mut y, right]: [f64; 3]) -> f64 {
    const SAMPLE: f64 = 28.0;
    let mut x = left;
    for series in series.iter().filter(|series| !series.name.is_empty()) {
        let name = fitted(&series.name, LABEL, right - left - SAMPLE - 7.0);
        let wide = SAMPLE + 7.0 + width(&name, LABEL);
        if x > left && x + wide > right {
            (x, y) = (left, y + 18.0);
        }
        series.sample(svg, [x, y - 4.4], SAMPLE);
        svg.text([x + SAMPLE + 7.0, y], LABEL, &name);
        x += wide + 20.0;
    }
    y
}

/// The names of several bats, each with the line of its number; a single bat is named in the head.
pub fn bats<S: AsRef<str>>(names: &[S]) -> Vec<Series> {
    let all = names.iter().enumerate();
    let all = all.map(|(k, name)| Series::curve(name.as_ref(), k, vec![]));
    all.filter(|_| names.len() > 1).collect()
}

/// A name beside a frame: the height of its target, the words, their colour.
pub type Tag = (f64, String, Ink);

/// Room for the widest of these words on the right of a frame (px), limited to that.
pub fn room(words: &[&str], most: f64) -> f64 {
    let widest = words.iter().map(|words| width(words, LABEL)).fold(0.0, f64::max);
    (widest + 30.0).clamp(RIGHT_LEAST, most)
}

const RIGHT_LEAST: f64 = 28.0;

/// Names on the right of a frame, each as near as possible to the height of its target, and connected to it where it is
/// displaced.
pub fn tags(svg: &mut Svg, frame: Frame, tags: &[Tag]) {
    const APART: f64 = 16.0;
    let wanted: Vec<f64> = tags.iter().map(|tag| tag.0).collect();
    let heights = spread(&wanted, APART, [frame.top + 4.0, frame.bottom]);
    let most = svg.width - frame.right - 24.0;
    for ((wanted, words, ink), y) in tags.iter().zip(heights) {
        let from = frame.right;
        let (near, far) = (from + 4.0, from + 16.0);
        if (wanted - y).abs() > 2.0 {
            svg.line(&[[near, *wanted], [far, y]], Pen::new(FRAME, 1.0));
        } else {
            svg.line(&[[near, y], [far, y]], Pen::new(FRAME, 1.0));
        }
        svg.text([far + 4.0, y + 4.4], LABEL.ink(*ink), &fitted(words, SMALL, most));
    }
}

/// Places as near as possible to the wanted ones, in the same order, at least that distance apart and between those
/// ends; evenly spaced for lack of room.
pub fn spread(wanted: &[f64], apart: f64, [low, high]: [f64; 2]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..wanted.len()).collect();
    order.sort_by(|a, b| wanted[*a].total_cmp(&wanted[*b]));
    let apart = match wanted.len() {
        0 | 1 => apart,
        count => apart.min((high - low) / (count - 1) as f64),
    };
    let mut places = vec![0.0; wanted.len()];
    let mut least = low;
    for k in &order {
        places[*k] = wanted[*k].max(least);
        least = places[*k] + apart;
    }
    // Names beyond the end are pushed back.
    let mut most = high;
    for k in order.iter().rev() {
        places[*k] = places[*k].min(most);
        most = places[*k] - apart;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_keep_their_distance_and_their_order() {
        let places = spread(&[50.0, 52.0, 10.0, 99.0, 98.0], 10.0, [0.0, 100.0]);
        assert_eq!(places, [50.0, 60.0, 10.0, 100.0, 90.0]);
        assert_eq!(spread(&[5.0, 5.0, 5.0], 10.0, [0.0, 10.0]), [0.0, 5.0, 10.0]);
        assert!(spread(&[], 10.0, [0.0, 10.0]).is_empty());
    }

    #[test]
    fn four_digits_are_enough_to_read() {
        let shown = [0.0, 71.23456, 0.5, 1234.56, 1.5e-9, -2.0].map(short);
        assert_eq!(shown, ["0", "71.23", "0.5", "1235", "1.50e−9", "−2"]);
    }
}
