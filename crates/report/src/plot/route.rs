//! A path through points, in pixels from the upper left, to a tenth.

use std::fmt::Write;

/// A place in pixels.
pub type Point = [f64; 2];

/// A path through points, without those that lie on it anyway.
pub fn route(points: &[Point]) -> String {
    let mut out = String::new();
    for (k, point) in bends(points).into_iter().enumerate() {
        let verb = if k == 0 { 'M' } else { 'L' };
        let [x, y] = point.map(px);
        let _ = write!(out, "{verb}{x} {y}");
    }
    out
}

/// The first point, the last one, and those between that are needed to keep the line within an invisible distance of
/// all points.
pub fn bends(points: &[Point]) -> Vec<Point> {
    /// px
    const SEEN: f64 = 0.06;
    /// Most points left out in a row.
    const MOST: usize = 60;
    let Some(first) = points.first() else { return vec![] };
    let (mut kept, mut from) = (vec![*first], 0);
    for to in 2..points.len() {
        let passed = |point: &Point| distance(*point, points[from], points[to]) <= SEEN;
        if to - from > MOST || !points[from + 1..to].iter().all(passed) {
            from = to - 1;
            kept.push(points[from]);
        }
    }
    kept.extend(points.last().filter(|_| points.len() > 1));
    kept
}

/// From a point to a stretch between two (px).
fn distance([x, y]: Point, [a, b]: Point, [c, d]: Point) -> f64 {
    let (along, up) = (c - a, d - b);
    let square = along * along + up * up;
    let share = if square > 0.0 { ((x - a) * along + (y - b) * up) / square } else { 0.0 };
    let share = share.clamp(0.0, 1.0);
    (x - a - share * along).hypot(y - b - share * up)
}

/// A coordinate to a tenth of a pixel; a missing coordinate is drawn at 0.
pub fn tenth(value: f64) -> f64 {
    if !value.is_finite() {
        return 0.0;
    }
    // Not −0.
    (10.0 * value.clamp(-1e6, 1e6)).round() / 10.0 + 0.0
}

/// A coordinate to a tenth of a pixel, as short as possible.
pub fn px(value: f64) -> String {
    tenth(value).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_short_and_always_numbers() {
        let shown = [1.0, 0.25, -0.01, f64::NAN, f64::INFINITY, 12.34].map(px);
        assert_eq!(shown, ["1", "0.3", "0", "0", "0", "12.3"]);
        assert_eq!(route(&[[0.0, 0.0], [0.5, 1.0], [1.0, 2.0], [2.0, 0.0]]), "M0 0L1 2L2 0");
    }

    #[test]
    fn a_line_of_fewer_points_passes_all_of_them() {
        let wave: Vec<Point> =
            (0..500).map(f64::from).map(|x| [x, 40.0 * (0.05 * x).sin()]).collect();
        let kept = bends(&wave);
        assert!(kept.len() < 200, "{}", kept.len());
        for point in &wave {
            let near = kept.windows(2).map(|pair| distance(*point, pair[0], pair[1]));
            assert!(near.fold(f64::INFINITY, f64::min) <= 0.06);
        }
        // A line that turns back on itself keeps its turn.
        assert_eq!(bends(&[[0.0, 0.0], [9.0, 0.0], [4.0, 0.0]]).len(), 3);
        assert!(bends(&[]).is_empty());
        assert_eq!(bends(&[[1.0, 1.0]]).len(), 1);
    }
}
