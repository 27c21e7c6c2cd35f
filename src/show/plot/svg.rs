//! Lines, areas and words as plain SVG.
//!
//! Coordinates are pixels from the upper left, written to a tenth. No picture needs a file beside
//! it, a font of its own or a name that another picture in the same page might have too.

use std::fmt::Write;

use crate::base::xml::escaped;
use crate::show::plot::route::{Point, px, route};
use crate::show::plot::theme::{self, Ink, PAPER};
use crate::show::plot::words::{Anchor, Type};

/// What the file of every picture begins with, and of hardly any other.
pub const BEGINNING: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"ss\"";

/// A picture in the making.
#[derive(Debug, Clone)]
pub struct Svg {
    /// Width of the paper (px).
    pub width: f64,
    /// Height of the paper (px).
    pub height: f64,
    /// Left, upper, right and lower edge (px) of the frame in which places along the bat can be read
    /// off, from the first place to the last, for a page that does so.
    pub read_off: Option<[f64; 4]>,
    body: String,
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pen {
    /// Colour of the line.
    pub ink: Ink,
    /// Width of the line (px).
    pub width: f64,
    /// Strokes and gaps (px); "" draws a whole line.
    pub dash: &'static str,
}

impl Pen {
    /// A pen of that width (pixels).
    pub const fn new(ink: Ink, width: f64) -> Self {
        Self { ink, width, dash: "" }
    }

    /// The pen of the k-th curve.
    pub fn of(k: usize) -> Self {
        let (ink, dash) = theme::series(k);
        Self { ink, width: 2.0, dash }
    }

    /// This pen with dashes, given as SVG has them.
    pub const fn dashed(self, dash: &'static str) -> Self {
        Self { dash, ..self }
    }
}

/// Marks that differ in form, in the order in which they are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// Round.
    Circle,
    /// Four sides, level.
    Square,
    /// A corner upwards.
    Triangle,
    /// Four sides on a corner.
    Diamond,
    /// Two strokes.
    Cross,
    /// A corner downwards.
    Wedge,
}

/// One for each of six bats.
pub const MARKS: [Mark; 6] =
    [Mark::Circle, Mark::Square, Mark::Triangle, Mark::Diamond, Mark::Cross, Mark::Wedge];

impl Svg {
    /// Empty paper.
    pub fn new(width: f64, height: f64) -> Self {
        Self { width, height, read_off: None, body: String::new() }
    }

    /// The picture with its title and, for those who cannot see it, what is to be seen.
    pub fn finish(self, title: &str, description: &str) -> String {
        let Self { width, height, read_off, body } = self;
        // No pixel of the paper is half a one.
        let [width, height] = [width, height].map(f64::ceil).map(px);
        let read_off = read_off
            .map_or(String::new(), |edges| format!(" data-frame=\"{}\"", edges.map(px).join(" ")));
        format!(
            "{BEGINNING} role=\"img\" \
             viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
             font-family=\"system-ui, sans-serif\" fill=\"none\" stroke-linejoin=\"round\" \
             stroke-linecap=\"butt\"{read_off}>\n<title>{}</title>\n<desc>{}</desc>\n<style>{}</style>\n\
             <rect class=\"ss-f-paper\" fill=\"{}\" width=\"{width}\" height=\"{height}\"/>\n\
             {body}</svg>\n",
            escaped(title),
            escaped(description),
            theme::rules(),
            PAPER.light,
        )
    }

    /// Words on a base line.
    pub fn text(&mut self, [x, y]: Point, look: Type, words: &str) {
        let Type { ink, size, bold, anchor, upwards } = look;
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let weight = if bold { " font-weight=\"600\"" } else { "" };
        let (x, y) = (px(x), px(y));
        let turn = if upwards { format!(" transform=\"rotate(-90 {x} {y})\"") } else { "".into() };
        let _ = writeln!(
            self.body,
            "<text x=\"{x}\" y=\"{y}\"{anchor}{turn} font-size=\"{}\"{weight}{}>{}</text>",
            px(size),
            fill(ink),
            escaped(words)
        );
    }

    /// A line through points.
    pub fn line(&mut self, points: &[Point], pen: Pen) {
        if points.len() > 1 {
            let _ = writeln!(self.body, "<path d=\"{}\"{}/>", route(points), stroke(pen));
        }
    }

    /// A closed outline that is filled, so opaque, and drawn around if there is a pen.
    pub fn area(&mut self, outline: &[Point], ink: Ink, opacity: f64, pen: Option<Pen>) {
        if outline.len() < 3 {
            return;
        }
        let _ =
            writeln!(self.body, "<path d=\"{}Z\"{}/>", route(outline), filled(ink, opacity, pen));
    }

    /// A rectangle from its upper left to its lower right.
    pub fn rect(&mut self, [from, to]: [Point; 2], ink: Ink, opacity: f64, pen: Option<Pen>) {
        let [x, y, w, h] = [from[0], from[1], to[0] - from[0], to[1] - from[1]].map(px);
        let _ = writeln!(
            self.body,
            "<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"{}/>",
            filled(ink, opacity, pen)
        );
    }

    /// A mark of that half width (px): paper within, or filled.
    pub fn mark(&mut self, mark: Mark, [x, y]: Point, half: f64, ink: Ink, solid: bool) {
        let inner = if solid { ink } else { PAPER };
        let look = filled(inner, 1.0, Some(Pen::new(ink, 1.8)));
        let shape: &[Point] = match mark {
            Mark::Circle => {
                let [x, y, half] = [x, y, half].map(px);
                let _ = writeln!(self.body, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{half}\"{look}/>");
                return;
            }
            Mark::Square => &[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]],
            Mark::Triangle => &[[-1.1, 0.9], [0.0, -1.1], [1.1, 0.9]],
            Mark::Diamond => &[[-1.2, 0.0], [0.0, -1.2], [1.2, 0.0], [0.0, 1.2]],
            Mark::Wedge => &[[-1.1, -0.9], [1.1, -0.9], [0.0, 1.1]],
            Mark::Cross => {
                let pen = Pen::new(ink, 2.2);
                let at = |a: f64, b: f64| [x + a * half, y + b * half];
                self.line(&[at(-1.0, -1.0), at(1.0, 1.0)], pen);
                self.line(&[at(-1.0, 1.0), at(1.0, -1.0)], pen);
                return;
            }
        };
        let shape: Vec<Point> = shape.iter().map(|[a, b]| [x + a * half, y + b * half]).collect();
        let _ = writeln!(self.body, "<path d=\"{}Z\"{look}/>", route(&shape));
    }

    /// A circle that shows what is under it.
    pub fn ring(&mut self, at: Point, radius: f64, pen: Pen) {
        let [x, y, radius] = [at[0], at[1], radius].map(px);
        let look = stroke(pen);
        let _ = writeln!(self.body, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"{look}/>");
    }

    /// Words that show where a pointer rests, at so many of the points at most.
    pub fn hover(&mut self, points: &[(Point, String)], most: usize) {
        if points.is_empty() {
            return;
        }
        self.body += "<g class=\"ss-hover\" fill=\"#000\" fill-opacity=\"0\">\n";
        let every = points.len().div_ceil(most.max(1));
        for ([x, y], words) in points.iter().step_by(every) {
            let (x, y) = (px(*x), px(*y));
            let words = escaped(words);
            let _ = writeln!(
                self.body,
                "<circle cx=\"{x}\" cy=\"{y}\" r=\"7\"><title>{words}</title></circle>"
            );
        }
        self.body += "</g>\n";
    }
}

fn fill(ink: Ink) -> String {
    format!(" class=\"ss-f-{}\" fill=\"{}\"", ink.name, ink.light)
}

fn stroke(pen: Pen) -> String {
    format!(" class=\"ss-s-{}\"{}", pen.ink.name, line_of(pen))
}

fn line_of(pen: Pen) -> String {
    let dash = match pen.dash {
        "" => String::new(),
        dash => format!(" stroke-dasharray=\"{dash}\""),
    };
    format!(" stroke=\"{}\" stroke-width=\"{}\"{dash}", pen.ink.light, px(pen.width))
}

fn filled(ink: Ink, opacity: f64, pen: Option<Pen>) -> String {
    let faint = if opacity < 1.0 { format!(" fill-opacity=\"{opacity}\"") } else { "".into() };
    let (class, line) = match pen {
        Some(pen) => (format!(" ss-s-{}", pen.ink.name), line_of(pen)),
        None => Default::default(),
    };
    format!(" class=\"ss-f-{}{class}\" fill=\"{}\"{faint}{line}", ink.name, ink.light)
}
