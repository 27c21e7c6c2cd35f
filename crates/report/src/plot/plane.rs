//! A diagram's frame: two axes, their numbers and lines, and from values to pixels.

use crate::plot::axis::{Axis, Tick};
use crate::plot::route::Point;
use crate::plot::sheet::{Paper, Sheet};
use crate::plot::svg::{Pen, Svg};
use crate::plot::theme::{FRAME, GRID, Ink, TINT};
use crate::plot::words::{Anchor, LABEL, SMALL, TITLE, Type, fitted, width};

/// Room for numbers and label of an axis beside a frame (px).
pub const NUMBERS: f64 = 42.0;

/// Length of every tick, outwards from the frame (px).
const TICK: f64 = 5.0;

/// A rectangle of the picture (px).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Left edge of the frame (px).
    pub left: f64,
    /// Upper edge of the frame (px).
    pub top: f64,
    /// Right edge of the frame (px).
    pub right: f64,
    /// Lower edge of the frame (px).
    pub bottom: f64,
}

impl Frame {
    /// A frame as wide as the sheet has room for, from one height to another (px).
    pub fn across(sheet: Sheet, [top, bottom]: [f64; 2]) -> Self {
        Self { left: sheet.left(), top, right: sheet.width() - sheet.right(), bottom }
    }

    /// A frame of that height and the same width, at that distance below this one (px).
    pub fn below(self, apart: f64, height: f64) -> Self {
        let top = self.bottom + apart;
        Self { top, bottom: top + height, ..self }
    }
}

/// A diagram.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    /// Frame of the diagram on the paper.
    pub frame: Frame,
    /// Horizontal axis, from left to right.
    pub x: Axis,
    /// Vertical axis, upwards.
    pub y: Axis,
}

/// The title and, in a muted colour, the subject and facts. For lack of room the name is cut. A page has the title
/// beside the picture, with the facts below it.
pub fn head(svg: &mut Svg, title: &str, [name, facts]: [&str; 2]) {
    svg.facts = facts.to_owned();
    if svg.sheet.paper != Paper::File {
        return;
    }
    let most = svg.width - 40.0;
    svg.text([20.0, 29.0], TITLE, &fitted(title, TITLE, most));
    let between = if name.is_empty() || facts.is_empty() { "" } else { ": " };
    let name = fitted(name, SMALL, (most - width(facts, SMALL) - 10.0).max(0.0));
    svg.text([20.0, 48.0], SMALL, &fitted(&format!("{name}{between}{facts}"), SMALL, most));
}

/// The number of ticks for which there is room along y.
pub fn ticks_up(height: f64) -> usize {
    ((height / 24.0) as usize).clamp(3, 9)
}

impl Plane {
    /// A frame with a horizontal axis and no vertical one.
    pub fn strip(frame: Frame, x: &Axis) -> Self {
        Self { frame, x: x.clone(), y: Axis::new("", [0.0, 1.0]) }
    }

    /// The pixel of a pair of values.
    pub fn at(&self, [a, b]: [f64; 2]) -> Point {
        let Frame { left, top, right, bottom } = self.frame;
        [left + (right - left) * self.x.share(a), bottom + (top - bottom) * self.y.share(b)]
    }

    /// The pixel across of a value of x.
    pub fn across(&self, a: f64) -> f64 {
        self.frame.left + (self.frame.right - self.frame.left) * self.x.share(a)
    }

    fn ticks_up(&self) -> usize {
        ticks_up(self.frame.bottom - self.frame.top)
    }

    /// Grid lines, the left and lower side of the frame, the numbers and the label of y.
    pub fn draw(&self, svg: &mut Svg) {
        let Frame { left, top, right, bottom } = self.frame;
        for tick in self.y.ticks(self.ticks_up()) {
            let y = self.at([self.x.from, tick.value])[1];
            svg.line(&[[left, y], [right, y]], Pen::new(GRID, 1.0));
            svg.line(&[[left - TICK, y], [left, y]], Pen::new(FRAME, 1.0));
            svg.text([left - 9.0, y + 4.4], LABEL.at(Anchor::End), &tick.text);
        }
        for tick in self.x.ticks(ticks_along(self.frame, &self.x)) {
            let x = self.across(tick.value);
            svg.line(&[[x, top], [x, bottom]], Pen::new(GRID, 1.0));
        }
        svg.line(&[[left, top], [left, bottom], [right, bottom]], Pen::new(FRAME, 1.0));
        self.label_up(svg, (left - 58.0).max(15.0), &self.y.label);
    }

    /// Words along y, as near to its middle as the picture allows.
    fn label_up(&self, svg: &mut Svg, x: f64, words: &str) {
        let half = 0.5 * width(words, SMALL);
        let middle = 0.5 * (self.frame.top + self.frame.bottom);
        let middle = middle.min(svg.height - half - 2.0).max(half + 2.0);
        let look = SMALL.at(Anchor::Middle);
        svg.text([x, middle], Type { upwards: true, ..look }, words);
    }

    /// Numbers and label of x, below the frame.
    pub fn below(&self, svg: &mut Svg) {
        let bottom = self.frame.bottom;
        let ticks = self.x.ticks(ticks_along(self.frame, &self.x));
        along(svg, self.frame, (&self.x, &ticks), [bottom, TICK, 18.0, 36.0]);
    }

    /// Numbers and label of another axis for x, above the frame. It shows distances, so there are none below 0.
    pub fn above(&self, svg: &mut Svg, axis: &Axis) {
        let mut ticks = axis.ticks(ticks_along(self.frame, axis));
        ticks.retain(|tick| tick.value >= 0.0);
        along(svg, self.frame, (axis, &ticks), [self.frame.top, -TICK, -9.0, -26.0]);
    }

    /// A line across the frame at a value of y.
    pub fn level(&self, svg: &mut Svg, value: f64, pen: Pen) {
        svg.line(&[self.x.from, self.x.to].map(|x| self.at([x, value])), pen);
    }

    /// A line from top to bottom of the frame at a value of x.
    pub fn upright(&self, svg: &mut Svg, value: f64, pen: Pen) {
        let x = self.across(value);
        svg.line(&[[x, self.frame.top], [x, self.frame.bottom]], pen);
    }

    /// A stretch of x, tinted from top to bottom.
    pub fn band(&self, svg: &mut Svg, [from, to]: [f64; 2], ink: Ink) {
        let Frame { left, top, right, bottom } = self.frame;
        let [from, to] = [from, to].map(|x| self.across(x).clamp(left, right));
        if to > from {
            svg.rect([[from, top], [to, bottom]], ink, TINT, None);
        }
    }
}

/// The number of ticks for which there is room along x.
fn ticks_along(frame: Frame, axis: &Axis) -> usize {
    let count = |most: &usize| {
        let widest = axis.ticks(*most).iter().map(|t| width(&t.text, LABEL)).fold(0.0, f64::max);
        (widest + 14.0) * *most as f64 <= frame.right - frame.left
    };
    (3..=12).rev().find(count).unwrap_or(2)
}

/// An axis along x: where it is, and from there the ends of its ticks, its numbers and its label.
fn along(
    svg: &mut Svg,
    frame: Frame,
    (axis, ticks): (&Axis, &[Tick]),
    [y, tick, number, label]: [f64; 4],
) {
    let Frame { left, right, .. } = frame;
    for at in ticks {
        let x = left + (right - left) * axis.share(at.value);
        svg.line(&[[x, y], [x, y + tick]], Pen::new(FRAME, 1.0));
        svg.text([x, y + number], LABEL.at(Anchor::Middle), &at.text);
    }
    svg.line(&[[left, y], [right, y]], Pen::new(FRAME, 1.0));
    svg.text([0.5 * (left + right), y + label], SMALL.at(Anchor::Middle), &axis.label);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_of_the_axes_are_the_corners_of_the_frame() {
        let frame = Frame { left: 60.0, top: 20.0, right: 560.0, bottom: 320.0 };
        let (x, y) = (Axis::new("x", [40.0, 80.0]), Axis::new("y", [-1.0, 3.0]));
        let plane = Plane { frame, x, y };
        assert_eq!(plane.at([40.0, -1.0]), [60.0, 320.0]);
        assert_eq!(plane.at([80.0, 3.0]), [560.0, 20.0]);
        assert_eq!(plane.at([50.0, 0.0]), [185.0, 245.0]);
    }
}
