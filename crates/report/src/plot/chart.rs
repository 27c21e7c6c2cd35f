//! A picture of diagrams one below the other, described by their content.
//!
//! A [`Chart`] has a head, the names of its curves, one axis along and a [`Panel`] for each diagram. The positions of
//! frames, numbers and names follow from these, and the tooltips from the units of the axes.

use crate::plot::axis::Axis;
use crate::plot::picture::Picture;
use crate::plot::place::{self, PlaceRow};
use crate::plot::plane::{Frame, NUMBERS, Plane, head, ticks_up};
use crate::plot::series::{Series, heights, hover, legend};
use crate::plot::sheet::{Sheet, Unit};
use crate::plot::svg::{Pen, Svg};
use crate::plot::theme::{FRAME, Ink, TEXT};
use crate::plot::words::{Anchor, SMALL};

/// Distance between two diagrams, and the height of words above one (px).
const BETWEEN: f64 = 18.0;
const NOTE: f64 = 14.0;

/// Additional drawing in a diagram that only one kind of picture has.
type Extra<'a> = Box<dyn Fn(&mut Svg, &Plane) + 'a>;

/// One diagram of a chart.
pub struct Panel<'a> {
    height: f64,
    y: Option<Axis>,
    curves: Vec<Series>,
    band: Option<([f64; 2], Ink)>,
    zero: bool,
    note: String,
    lines: Vec<(f64, &'static str)>,
    over: Option<Extra<'a>>,
}

impl<'a> Panel<'a> {
    /// Curves, with the first on top, against that axis in a frame of that height (px).
    pub fn new(height: f64, y: Axis, curves: Vec<Series>) -> Self {
        Self { y: Some(y), curves, ..Self::plain(height) }
    }

    /// A stretch of paper of that height (px) without a vertical axis, to be drawn on.
    pub fn plain(height: f64) -> Self {
        let (y, curves, note, lines) = (None, vec![], String::new(), vec![]);
        Self { height, y, curves, band: None, zero: false, note, lines, over: None }
    }

    /// Curves in SI against an axis long enough for them and for those other values.
    pub fn around(
        height: f64,
        (label, unit): (&str, Unit),
        curves: Vec<Series>,
        others: &[f64],
    ) -> Self {
        let values = heights(&curves).chain(others.iter().copied());
        let y = Axis::measured(label, unit, values, ticks_up(height));
        Self::new(height, y, curves)
    }

    /// This diagram with a tinted stretch along it, if one is given.
    pub fn band(self, band: Option<[f64; 2]>, ink: Ink) -> Self {
        Self { band: band.map(|ends| (ends, ink)), ..self }
    }

    /// This diagram with a line at 0.
    pub fn zero(self) -> Self {
        Self { zero: true, ..self }
    }

    /// This diagram with words above its frame, unless they are empty.
    pub fn note(self, note: &str) -> Self {
        Self { note: note.to_owned(), ..self }
    }

    /// This diagram with dashed vertical lines at those values, each with its name above the frame.
    pub fn lines(self, lines: Vec<(f64, &'static str)>) -> Self {
        Self { lines, ..self }
    }

    /// This diagram with something drawn over its curves.
    pub fn over(self, over: impl Fn(&mut Svg, &Plane) + 'a) -> Self {
        Self { over: Some(Box::new(over)), ..self }
    }

    /// Height of the content above the frame (px).
    fn above(&self) -> f64 {
        if self.note.is_empty() && self.lines.is_empty() { 0.0 } else { NOTE }
    }

    fn draw(&self, svg: &mut Svg, plane: &Plane) {
        if let Some((ends, ink)) = self.band {
            plane.band(svg, ends, ink);
        }
        if self.y.is_some() {
            plane.draw(svg);
        }
        if self.zero && plane.y.holds(0.0) {
            plane.level(svg, 0.0, Pen::new(FRAME, 1.2));
        }
        if !self.note.is_empty() {
            svg.text([plane.frame.left, plane.frame.top - 7.0], SMALL, &self.note);
        }
        self.curves.iter().rev().for_each(|curve| curve.draw(svg, plane));
        if let Some(over) = &self.over {
            over(svg, plane);
        }
        for (value, name) in &self.lines {
            plane.upright(svg, *value, Pen::new(TEXT, 1.3).dashed("5 3"));
            let above = [plane.across(*value), plane.frame.top - 6.0];
            svg.text(above, SMALL.at(Anchor::Middle), name);
        }
        hover(svg, plane, &self.curves);
    }
}

/// A picture of diagrams one below the other.
pub struct Chart<'a> {
    name: &'a str,
    title: &'a str,
    of: [&'a str; 2],
    x: Axis,
    above: Option<Axis>,
    keys: Vec<Series>,
    panels: Vec<Panel<'a>>,
    rows: Vec<PlaceRow>,
    guides: Option<f64>,
    right: f64,
    read_off: bool,
}

impl<'a> Chart<'a> {
    /// A picture with its name, title, subject and facts, and that horizontal axis.
    pub fn new(name: &'a str, title: &'a str, of: [&'a str; 2], x: Axis) -> Self {
        let (keys, panels, rows, guides) = (vec![], vec![], vec![], None);
        let (above, right, read_off) = (None, 0.0, false);
        Self { name, title, of, x, above, keys, panels, rows, guides, right, read_off }
    }

    /// A picture along a stretch of bats (m), with axes from the knob end and from the tip.
    pub fn along(
        sheet: Sheet,
        (name, title): (&'a str, &'a str),
        of: [&'a str; 2],
        (ends, bats): ([f64; 2], &[(&str, f64)]),
    ) -> Self {
        let [x, tip] = place::axes(sheet, ends, bats);
        Self { above: Some(tip), ..Self::new(name, title, of, x) }
    }

    /// This picture with a legend of those curves above it.
    pub fn keys(self, keys: &[Series]) -> Self {
        Self { keys: keys.to_vec(), ..self }
    }

    /// This picture with one more diagram.
    pub fn panel(mut self, panel: Panel<'a>) -> Self {
        self.panels.push(panel);
        self
    }

    /// This picture with rows of places below its diagrams.
    pub fn rows(self, rows: Vec<PlaceRow>) -> Self {
        Self { rows, ..self }
    }

    /// This picture with thin lines down to the places of its rows, from that distance below the top of the first frame
    /// (px).
    pub fn guides(self, from: f64) -> Self {
        Self { guides: Some(from), ..self }
    }

    /// This picture with that much additional room on the right of its frames (px).
    pub fn right(self, right: f64) -> Self {
        Self { right, ..self }
    }

    /// This picture with a first diagram from which a page reads off places.
    pub fn read_off(self) -> Self {
        Self { read_off: true, ..self }
    }

    /// The picture, with a description for readers who cannot see it.
    pub fn picture(self, sheet: Sheet, alt: &str) -> Picture {
        let mut svg = Svg::on(sheet);
        head(&mut svg, self.title, self.of);
        let named = legend(&mut svg, &self.keys) + if self.keys.is_empty() { 6.0 } else { 14.0 };
        let mut top = named + if self.above.is_some() { NUMBERS } else { 0.0 };
        let mut frames = vec![];
        for panel in &self.panels {
            top += panel.above();
            let frame = Frame::across(sheet, [top, top + panel.height]);
            frames.push(Frame { right: frame.right - self.right, ..frame });
            top += panel.height + BETWEEN;
        }
        let (Some(first), Some(last)) = (frames.first(), frames.last()) else {
            return Picture::new(self.name, self.title, alt, svg);
        };
        let strip = match self.rows.is_empty() {
            true => *last,
            false => last.below(6.0, place::height(sheet, &self.rows)),
        };
        svg.height = strip.bottom + NUMBERS + 4.0;
        svg.read_off = self.read_off.then_some([first.left, first.top, first.right, first.bottom]);
        // Marks at the lower edge lie on the axis, not below it.
        let strip = Plane::strip(strip, &self.x);
        strip.below(&mut svg);
        for (panel, frame) in self.panels.iter().zip(&frames) {
            let mut plane = Plane::strip(*frame, &self.x);
            plane.y = panel.y.clone().unwrap_or(plane.y);
            if let Some(above) = self.above.as_ref().filter(|_| frame == first) {
                plane.above(&mut svg, above);
            }
            panel.draw(&mut svg, &plane);
        }
        let told = place::rows(&mut svg, &strip, &self.rows);
        if let Some(from) = self.guides {
            place::guides(&mut svg, &strip, (&self.rows, &told), first.top + from);
        }
        Picture::new(self.name, self.title, alt, svg)
    }
}
